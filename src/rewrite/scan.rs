//! Tokens of a shader with their positions; comments and spaces lie between them.
//!
//! Based on: The OpenGL Shading Language 4.60, section 3: a backslash at the end of a line joins it with the next, then
//! comments become spaces, then lines that begin with `#` are directives. A line ends with a carriage return, a line feed or both.
//! Any bytes are tokens of some kind, and time and memory are linear in the length of the source.

use std::borrow::Cow;
use std::ops::Range;

/// The kind of a token, as far as the rewriter needs it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Letters, digits and underscores; keywords too.
    Name,
    /// A number as the preprocessor sees it.
    Number,
    /// One byte of anything else.
    Mark(u8),
}

/// A token and its position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    /// First byte.
    pub(super) start: usize,
    /// Byte after the last.
    pub(super) end: usize,
    /// Part of a directive, its `#` included.
    pub(super) directive: bool,
    /// It contains a line continuation: a backslash before the end of a line.
    joined: bool,
}

/// A line that begins with `#`.
#[derive(Clone, Debug)]
pub(super) struct Directive {
    /// Its tokens, as indices of [`Scan::tokens`]; the first is the `#`.
    pub(super) tokens: Range<usize>,
    /// The byte of the end of its line, or the end of the source.
    pub(super) end: usize,
}

/// A source and its tokens.
pub(super) struct Scan<'a> {
    pub(super) source: &'a [u8],
    pub(super) tokens: Vec<Token>,
    pub(super) directives: Vec<Directive>,
}

/// Length in bytes of the end of a line at this byte: 1 or 2, and 0 if no line ends here.
pub(super) fn line_end(source: &[u8], at: usize) -> usize {
    match (source.get(at), source.get(at + 1)) {
        (Some(b'\r'), Some(b'\n')) | (Some(b'\n'), Some(b'\r')) => 2,
        (Some(b'\r' | b'\n'), _) => 1,
        _ => 0,
    }
}

fn in_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// A position in a source, which steps over line continuations.
struct Cursor<'a> {
    source: &'a [u8],
    at: usize,
    joined: bool,
}

impl Cursor<'_> {
    /// The byte at the position, after all line continuations.
    fn peek(&mut self) -> Option<u8> {
        while self.source.get(self.at) == Some(&b'\\') {
            match line_end(self.source, self.at + 1) {
                0 => break,
                length => {
                    self.at += 1 + length;
                    self.joined = true;
                }
            }
        }
        self.source.get(self.at).copied()
    }

    /// The byte after the one at the position.
    fn second(&mut self) -> Option<u8> {
        self.peek()?;
        let mut next = Cursor {
            source: self.source,
            at: self.at + 1,
            joined: false,
        };
        next.peek()
    }

    /// Advances while bytes are wanted; returns the end of the last one.
    fn take(&mut self, mut wanted: impl FnMut(u8) -> bool) -> usize {
        let mut end = self.at;
        let mut joined = self.joined;
        while let Some(byte) = self.peek() {
            if !wanted(byte) {
                break;
            }
            self.at += 1;
            end = self.at;
            joined = self.joined;
        }
        // A line continuation after the last byte belongs to the next token.
        self.at = end;
        self.joined = joined;
        end
    }
}

impl<'a> Scan<'a> {
    /// Reads all tokens of a source.
    pub(super) fn new(source: &'a [u8]) -> Self {
        let mut cursor = Cursor {
            source,
            at: 0,
            joined: false,
        };
        let mut tokens = Vec::new();
        let mut directives: Vec<Directive> = Vec::new();
        let mut inside = false;
        let mut line_is_empty = true;
        while let Some(byte) = cursor.peek() {
            let start = cursor.at;
            let ending = line_end(source, start);
            if ending != 0 {
                close(&mut inside, &mut directives, tokens.len(), start);
                line_is_empty = true;
                cursor.at += ending;
                continue;
            }
            match (byte, cursor.second()) {
                (b' ' | b'\t' | 0x0b | 0x0c, _) => {
                    cursor.at += 1;
                    continue;
                }
                (b'/', Some(b'/')) => {
                    cursor.take(|byte| !matches!(byte, b'\r' | b'\n'));
                    continue;
                }
                (b'/', Some(b'*')) => {
                    skip_comment(&mut cursor);
                    continue;
                }
                _ => {}
            }
            if byte == b'#' && line_is_empty {
                inside = true;
                directives.push(Directive {
                    tokens: tokens.len()..tokens.len(),
                    end: source.len(),
                });
            }
            line_is_empty = false;
            cursor.joined = false;
            let (kind, end) = token(&mut cursor, byte);
            tokens.push(Token {
                kind,
                start,
                end,
                directive: inside,
                joined: cursor.joined,
            });
        }
        close(&mut inside, &mut directives, tokens.len(), source.len());
        Self {
            source,
            tokens,
            directives,
        }
    }

    /// The text of a token without line continuations.
    pub(super) fn text(&self, token: &Token) -> Cow<'a, [u8]> {
        let raw = self.source.get(token.start..token.end).unwrap_or_default();
        if !token.joined {
            return Cow::Borrowed(raw);
        }
        let mut whole = Vec::with_capacity(raw.len());
        let mut at = 0;
        while let Some(&byte) = raw.get(at) {
            match line_end(raw, at + 1) {
                length if byte == b'\\' && length != 0 => at += 1 + length,
                _ => {
                    whole.push(byte);
                    at += 1;
                }
            }
        }
        Cow::Owned(whole)
    }

    /// The text of the token at an index if it is a name, else nothing.
    pub(super) fn name(&self, at: usize) -> Cow<'a, [u8]> {
        match self.tokens.get(at) {
            Some(token) if token.kind == Kind::Name => self.text(token),
            _ => Cow::Borrowed(b""),
        }
    }

    /// The number at an index, if it is whole and in decimal digits.
    pub(super) fn number(&self, at: usize) -> Option<u32> {
        let token = self.tokens.get(at)?;
        if token.kind != Kind::Number {
            return None;
        }
        let text = self.text(token);
        // A leading zero makes it octal.
        if text.first() == Some(&b'0') && text.len() > 1 {
            return None;
        }
        std::str::from_utf8(&text).ok()?.parse().ok()
    }

    /// Whether the token at an index is this mark.
    pub(super) fn is(&self, at: usize, mark: u8) -> bool {
        self.tokens
            .get(at)
            .is_some_and(|token| token.kind == Kind::Mark(mark))
    }

    /// The name of a directive: `version`, `define`, …
    pub(super) fn called(&self, directive: &Directive) -> Cow<'a, [u8]> {
        self.name(directive.tokens.start + 1)
    }

    /// The number of the line on which a byte is, from 1.
    pub(super) fn line_of(&self, place: usize) -> usize {
        let mut lines = 1;
        let mut at = 0;
        while at < place.min(self.source.len()) {
            match line_end(self.source, at) {
                0 => at += 1,
                length => {
                    lines += 1;
                    at += length;
                }
            }
        }
        lines
    }
}

/// Ends a line, and so the directive on it.
fn close(inside: &mut bool, directives: &mut [Directive], tokens: usize, end: usize) {
    if *inside && let Some(last) = directives.last_mut() {
        last.tokens.end = tokens;
        last.end = end;
    }
    *inside = false;
}

/// Steps over a `/* */` comment; one without an end goes to the end of the source.
fn skip_comment(cursor: &mut Cursor) {
    // The two bytes of its beginning, then all up to a star and a slash.
    let (mut begin, mut star, mut done) = (2, false, false);
    cursor.take(|byte| {
        if done {
            return false;
        }
        if begin > 0 {
            begin -= 1;
        } else {
            done = star && byte == b'/';
            star = byte == b'*';
        }
        true
    });
}

fn token(cursor: &mut Cursor, first: u8) -> (Kind, usize) {
    if first.is_ascii_alphabetic() || first == b'_' {
        return (Kind::Name, cursor.take(in_name));
    }
    let fraction = first == b'.' && cursor.second().is_some_and(|byte| byte.is_ascii_digit());
    if first.is_ascii_digit() || fraction {
        // The sign of an exponent belongs to the number; 0xE+x is a sum.
        let (mut length, mut hexadecimal, mut exponent) = (0_usize, false, false);
        let end = cursor.take(|byte| {
            let wanted = in_name(byte) || byte == b'.' || (exponent && matches!(byte, b'+' | b'-'));
            hexadecimal |= length == 1 && first == b'0' && matches!(byte, b'x' | b'X');
            exponent = !hexadecimal && matches!(byte, b'e' | b'E');
            length += 1;
            wanted
        });
        return (Kind::Number, end);
    }
    cursor.at += 1;
    (Kind::Mark(first), cursor.at)
}
