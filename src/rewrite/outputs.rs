//! Declarations and uses of the built-in outputs of a vertex: `gl_PerVertex` and `gl_ClipDistance`.

use super::error::Refusal;
use super::scan::Scan;
use std::ops::Range;

/// The built-in outputs of a source.
#[derive(Default)]
pub(super) struct Outputs {
    /// `out gl_PerVertex { …`, as tokens, up to the closing brace.
    pub(super) blocks: Vec<Range<usize>>,
    /// One of the blocks has no `gl_Position`.
    pub(super) no_position: bool,
    /// Declarations of `gl_ClipDistance` with a size: the token of the number.
    pub(super) sized: Vec<usize>,
    /// Declarations without a size: the token of the closing bracket.
    pub(super) open: Vec<usize>,
    /// The size in those declarations that have one.
    size: Option<u32>,
    /// One more than the greatest index.
    used: u32,
    /// An index that is not a plain number.
    computed: bool,
    /// There is something that cannot be understood token by token.
    unclear: bool,
}

/// The block that a token is in.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Inside {
    Nothing,
    /// `in gl_PerVertex`, of the stage before.
    Input,
    Output {
        start: usize,
        position: bool,
    },
}

impl Outputs {
    pub(super) fn of(scan: &Scan) -> Self {
        let mut all = Self::default();
        let mut inside = Inside::Nothing;
        for at in 0..scan.tokens.len() {
            if scan.is(at, b'}') {
                if let Inside::Output { start, position } = inside {
                    all.blocks.push(start..at);
                    all.no_position |= !position;
                }
                inside = Inside::Nothing;
            }
            let directive = scan.tokens.get(at).is_some_and(|token| token.directive);
            match &*scan.name(at) {
                b"gl_PerVertex" if directive => all.unclear = true,
                b"gl_PerVertex" if scan.is(at + 1, b'{') => {
                    inside = match &*scan.name(at.wrapping_sub(1)) {
                        b"out" => Inside::Output {
                            start: at.saturating_sub(1),
                            position: false,
                        },
                        _ => Inside::Input,
                    }
                }
                b"gl_Position" => {
                    if let Inside::Output { position, .. } = &mut inside {
                        *position = true;
                    }
                }
                b"gl_ClipDistance" if directive => all.unclear = true,
                // An input, such as `gl_in[0].gl_ClipDistance`, belongs to the stage before.
                b"gl_ClipDistance"
                    if inside != Inside::Input && !scan.is(at.wrapping_sub(1), b'.') =>
                {
                    all.distance(scan, at);
                }
                _ => {}
            }
        }
        all
    }

    /// Notes one occurrence of `gl_ClipDistance`.
    fn distance(&mut self, scan: &Scan, at: usize) {
        if !scan.is(at + 1, b'[') {
            self.unclear = true;
            return;
        }
        let number = scan.number(at + 2).filter(|_| scan.is(at + 3, b']'));
        let declared = *scan.name(at.wrapping_sub(1)) == *b"float";
        match number {
            Some(index) if !declared => self.used = self.used.max(index.saturating_add(1)),
            None if !declared => self.computed = true,
            Some(size) if self.size.is_none_or(|other| other == size) => {
                self.size = Some(size);
                self.sized.push(at + 2);
            }
            None if scan.is(at + 2, b']') => self.open.push(at + 2),
            _ => self.unclear = true,
        }
    }

    /// Number of clip distances that the program writes.
    pub(super) fn distances(&self) -> Result<u32, Refusal> {
        match self.size {
            _ if self.unclear => Err(Refusal::Distances),
            Some(size) if self.open.is_empty() => Ok(size),
            None if !self.computed => Ok(self.used),
            _ => Err(Refusal::Distances),
        }
    }
}
