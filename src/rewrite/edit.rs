//! Edits of a source by byte positions, applied all at once.
//!
//! The lines of the program's source keep their numbers: an insertion stays within an existing line, or is followed by `#line`.
//! Whole lines are appended at the end.

use super::error::Refusal;
use super::scan::{Directive, Scan, Token, line_end};
use super::version::Version;
use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::Write;

/// Goes before the appended lines: the program's last line may be a comment, may end in a backslash, and may lack a newline.
const BEFORE_TAIL: &str = "\n\n";

/// The edits to be made in one source.
pub(super) struct Edits<'s, 'a> {
    scan: &'s Scan<'a>,
    version: Version,
    /// First byte, byte after the last, new text.
    changes: Vec<(usize, usize, String)>,
    extensions: Vec<&'static str>,
    /// Declarations, and the index of the token before which they have to stand.
    head: Option<(String, usize)>,
    tail: String,
}

/// A position at which a declaration can be inserted.
struct Place {
    at: usize,
    /// Before a directive: the declaration needs a line of its own.
    directive: bool,
}

impl<'s, 'a> Edits<'s, 'a> {
    pub(super) fn new(scan: &'s Scan<'a>, version: Version) -> Self {
        Self {
            scan,
            version,
            changes: Vec::new(),
            extensions: Vec::new(),
            head: None,
            tail: String::new(),
        }
    }

    /// Replaces a token by a text without newlines.
    pub(super) fn replace(&mut self, token: &Token, text: impl Into<String>) {
        let mut text = text.into();
        let raw = self.scan.source.get(token.start..token.end);
        let raw = raw.unwrap_or_default();
        let mut at = 0;
        // Line continuations inside the token are kept, so that the lines after it keep their numbers.
        while at < raw.len() {
            match line_end(raw, at) {
                0 => at += 1,
                length => {
                    text.push_str("\\\n");
                    at += length;
                }
            }
        }
        self.changes.push((token.start, token.end, text));
    }

    /// Inserts a text without newlines before a token.
    pub(super) fn insert(&mut self, token: &Token, text: impl Into<String>) {
        self.changes.push((token.start, token.start, text.into()));
    }

    /// Replaces every token of this name; returns the index of the first.
    pub(super) fn replace_name(&mut self, name: &str, text: &str) -> Option<usize> {
        let mut first = None;
        for (at, token) in self.scan.tokens.iter().enumerate() {
            if *self.scan.name(at) == *name.as_bytes() {
                first.get_or_insert(at);
                self.replace(token, text);
            }
        }
        first
    }

    /// Adds `#extension NAME : require` after `#version`.
    pub(super) fn require(&mut self, extension: &'static str) {
        self.extensions.push(extension);
    }

    /// Adds a declaration that has to stand before a token, preferably of one line.
    pub(super) fn declare(&mut self, declaration: impl Into<String>, before: usize) {
        self.head = Some((declaration.into(), before));
    }

    /// Appends a line to the program's source.
    pub(super) fn append(&mut self, line: impl AsRef<str>) {
        self.tail.push_str(line.as_ref());
        self.tail.push('\n');
    }

    /// Applies the edits; the result is borrowed where there are none.
    pub(super) fn finish(mut self) -> Result<Cow<'a, [u8]>, Refusal> {
        self.check_macros()?;
        self.insert_extensions();
        self.insert_head()?;
        if self.changes.is_empty() && self.tail.is_empty() {
            return Ok(Cow::Borrowed(self.scan.source));
        }
        // An insertion at the first byte of a replacement comes before it.
        self.changes.sort_by_key(|&(start, end, _)| (start, end));
        let source = self.scan.source;
        let mut text = Vec::with_capacity(source.len() + self.tail.len() + 1024);
        let mut done = 0;
        for (start, end, new) in &self.changes {
            text.extend_from_slice(source.get(done..*start).unwrap_or_default());
            text.extend_from_slice(new.as_bytes());
            done = *end;
        }
        text.extend_from_slice(source.get(done..).unwrap_or_default());
        if !self.tail.is_empty() {
            text.extend_from_slice(BEFORE_TAIL.as_bytes());
            text.extend_from_slice(self.tail.as_bytes());
        }
        Ok(Cow::Owned(text))
    }

    /// Refuses if a macro of the program has the name of a token in the added text.
    fn check_macros(&self) -> Result<(), Refusal> {
        let scan = self.scan;
        let define = |directive: &&Directive| *scan.called(directive) == *b"define";
        let defined: HashSet<_> = scan
            .directives
            .iter()
            .filter(define)
            .map(|directive| scan.name(directive.tokens.start + 2))
            .collect();
        if defined.is_empty() {
            return Ok(());
        }
        let head = self.head.iter().map(|(text, _)| text);
        let changed = self.changes.iter().map(|(_, _, text)| text);
        for text in changed.chain(head).chain([&self.tail]) {
            let ours = Scan::new(text.as_bytes());
            for at in 0..ours.tokens.len() {
                let name = ours.name(at);
                if !name.is_empty() && defined.contains(&name) {
                    let name = String::from_utf8_lossy(&name).into_owned();
                    return Err(Refusal::Defined(name));
                }
            }
        }
        Ok(())
    }

    fn insert_extensions(&mut self) {
        if self.extensions.is_empty() {
            return;
        }
        let mut text = String::new();
        for name in &self.extensions {
            let _ = writeln!(text, "#extension {name} : require");
        }
        let mut directives = self.scan.directives.iter();
        match directives.find(|directive| *self.scan.called(directive) == *b"version") {
            Some(version) => {
                let next = self.scan.line_of(version.end) + 1;
                let line = self.version.line_directive(next);
                let text = format!("\n{text}#line {line}");
                self.changes.push((version.end, version.end, text));
            }
            None => {
                let line = self.version.line_directive(1);
                self.changes.push((0, 0, format!("{text}#line {line}\n")));
            }
        }
    }

    fn insert_head(&mut self) -> Result<(), Refusal> {
        let Some((declaration, before)) = self.head.take() else {
            return Ok(());
        };
        let place = self.place(before)?;
        let lines = declaration.contains('\n');
        let text = if place.directive || lines {
            let line = self.version.line_directive(self.numbered_line(place.at));
            // A declaration of several lines begins on a new line.
            let before = if lines { "\n" } else { "" };
            format!("{before}{declaration}\n#line {line}\n")
        } else {
            format!("{declaration} ")
        };
        self.changes.push((place.at, place.at, text));
        Ok(())
    }

    /// The position of a declaration, which has to be outside all conditions and after the program's `#extension` lines: before the
    /// first token outside all conditions, or before the outermost condition that holds the use.
    fn place(&self, before: usize) -> Result<Place, Refusal> {
        let scan = self.scan;
        let mut directives = scan.directives.iter();
        let (mut depth, mut outermost) = (0_usize, None);
        let mut at = 0;
        while let Some(token) = scan.tokens.get(at) {
            if token.directive {
                let Some(directive) = directives.next() else {
                    break;
                };
                match &*scan.called(directive) {
                    b"if" | b"ifdef" | b"ifndef" => {
                        if depth == 0 {
                            outermost = Some((at, token.start));
                        }
                        depth += 1;
                    }
                    b"endif" => depth = depth.saturating_sub(1),
                    _ => {}
                }
                at = directive.tokens.end.max(at + 1);
            } else if depth == 0 {
                return Ok(Place {
                    at: token.start,
                    directive: false,
                });
            } else if at >= before {
                break;
            } else {
                at += 1;
            }
        }
        let (first, start) = outermost.ok_or(Refusal::NoPlace)?;
        let mut later = scan.directives.iter();
        if later.any(|other| other.tokens.start > first && *scan.called(other) == *b"extension") {
            return Err(Refusal::NoPlace);
        }
        Ok(Place {
            at: start,
            directive: true,
        })
    }

    /// The number that the driver gives to the line of a byte, as far as the program's own `#line` can be read.
    fn numbered_line(&self, place: usize) -> usize {
        let scan = self.scan;
        let here = scan.line_of(place);
        let earlier = scan
            .directives
            .iter()
            .rev()
            .find(|directive| directive.end <= place && *scan.called(directive) == *b"line");
        let set = earlier.and_then(|directive| {
            let number = scan.number(directive.tokens.start + 2)?;
            Some((directive.end, usize::try_from(number).ok()?))
        });
        match set {
            Some((end, number)) => {
                let since = here.saturating_sub(scan.line_of(end) + 1);
                // The number that the directive gives to the line after it.
                let next = number + (1 - self.version.line_directive(1));
                next + since
            }
            None => here,
        }
    }
}
