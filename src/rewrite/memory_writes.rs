//! Where a source writes to memory: storage blocks, images and counters.
//!
//! Based on: The OpenGL Shading Language 4.60, sections 4.3.7 (buffer variables), 4.10 (memory qualifiers) and 8.10 to 8.12 (functions). In
//! doubt, a block counts as written.

use super::scan::{Kind, Scan};
use super::version::Version;
use std::collections::BTreeSet;

/// The memory that a source writes to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MemoryWrites {
    /// Names of its storage blocks that are written.
    pub blocks: BTreeSet<String>,
    /// It has atomic counters.
    pub counters: bool,
    /// It stores to images.
    pub images: bool,
    /// Macros declare storage blocks, so it cannot be told which are written.
    pub unclear: bool,
}

/// A storage block of a source.
struct Block {
    name: String,
    /// The name by which its members are reached, or else the members' own.
    names: Vec<Vec<u8>>,
    readonly: bool,
    /// Indices of the tokens of its declaration.
    tokens: core::ops::Range<usize>,
}

impl MemoryWrites {
    /// Whether nothing is written.
    pub fn is_empty(&self) -> bool {
        *self == MemoryWrites::default()
    }

    /// With those of another source of the same program.
    #[must_use]
    pub fn and(mut self, other: MemoryWrites) -> MemoryWrites {
        self.blocks.extend(other.blocks);
        self.counters |= other.counters;
        self.images |= other.images;
        self.unclear |= other.unclear;
        self
    }

    pub(super) fn of(scan: &Scan, version: Version) -> Self {
        let named =
            |wanted: fn(&[u8]) -> bool| (0..scan.tokens.len()).any(|at| wanted(&scan.name(at)));
        // `buffer` is a plain name in versions without storage blocks; sources that get them by extension name the extension.
        let has_blocks = version.desktop(430)
            || (version.es && version.number >= 310)
            || named(|name| name == b"GL_ARB_shader_storage_buffer_object");
        let blocks = match has_blocks {
            true => blocks(scan),
            false => Vec::new(),
        };
        let out = passes_out(scan) || has_macros(scan);
        let in_macro = |at: &usize| scan.tokens[*at].directive && *scan.name(*at) == *b"buffer";
        let unclear = has_blocks && (0..scan.tokens.len()).any(|at| in_macro(&at));
        let written = blocks.iter().filter(|block| is_written(scan, block, out));
        MemoryWrites {
            blocks: written.map(|block| block.name.clone()).collect(),
            unclear,
            counters: named(|name| name == b"atomic_uint"),
            images: named(|name| {
                name.starts_with(b"imageStore") || name.starts_with(b"imageAtomic")
            }),
        }
    }
}

/// The index behind the bracket that closes the one at an index.
fn behind(scan: &Scan, at: usize) -> usize {
    let (mut depth, mut at) = (0_usize, at);
    while let Some(token) = scan.tokens.get(at) {
        match token.kind {
            Kind::Mark(b'(' | b'[' | b'{') => depth += 1,
            Kind::Mark(b')' | b']' | b'}') => depth = depth.saturating_sub(1),
            _ => {}
        }
        at += 1;
        if depth == 0 {
            break;
        }
    }
    at
}

/// The storage blocks that a source declares.
fn blocks(scan: &Scan) -> Vec<Block> {
    let mut found = Vec::new();
    for at in 0..scan.tokens.len() {
        if *scan.name(at) != *b"buffer" || scan.tokens[at].directive {
            continue;
        }
        let ends = |at: &usize| {
            let marks = [b';', b'{', b'}'];
            !scan.tokens[*at].directive && marks.iter().any(|&mark| scan.is(*at, mark))
        };
        let start = (0..at).rev().find(ends).map_or(0, |end| end + 1);
        let Some(open) = (at..scan.tokens.len())
            .find(ends)
            .filter(|&open| scan.is(open, b'{'))
        else {
            continue;
        };
        let close = behind(scan, open);
        let name = String::from_utf8_lossy(&scan.name(open - 1)).into_owned();
        let end = (close..scan.tokens.len()).find(|&at| scan.is(at, b';'));
        let instance = scan.name(close).into_owned();
        let names = match instance.is_empty() {
            false => vec![instance],
            true => members(scan, open + 1..close - 1),
        };
        found.push(Block {
            name,
            names,
            readonly: (start..open)
                .any(|at| *scan.name(at) == *b"readonly" && !scan.tokens[at].directive),
            tokens: start..end.unwrap_or(close),
        });
    }
    found
}

/// The names that a block's members may have: each name before a bracket, a comma or a semicolon.
fn members(scan: &Scan, tokens: core::ops::Range<usize>) -> Vec<Vec<u8>> {
    let ends = |at: usize| [b'[', b',', b';'].iter().any(|&mark| scan.is(at, mark));
    let names = tokens
        .filter(|&at| ends(at + 1))
        .map(|at| scan.name(at).into_owned());
    names.filter(|name| !name.is_empty()).collect()
}

/// Whether some function has a parameter that it writes.
fn passes_out(scan: &Scan) -> bool {
    let opens = |at: usize| scan.is(at, b'(') || scan.is(at, b',');
    (1..scan.tokens.len()).any(|at| {
        let name = scan.name(at);
        let before = (0..at).rev().find(|&at| !qualifies(&scan.name(at)));
        (*name == *b"out" || *name == *b"inout") && before.is_some_and(opens)
    })
}

/// Whether there are macros with parameters, which may write to what is passed to them.
fn has_macros(scan: &Scan) -> bool {
    let mut directives = scan.directives.iter();
    directives.any(|directive| {
        let name = directive.tokens.start + 2;
        *scan.called(directive) == *b"define"
            && scan.is(name + 1, b'(')
            && scan.tokens[name].end == scan.tokens[name + 1].start
    })
}

/// Whether a word may stand before `out`.
fn qualifies(name: &[u8]) -> bool {
    matches!(
        name,
        b"precise"
            | b"highp"
            | b"mediump"
            | b"lowp"
            | b"const"
            | b"coherent"
            | b"restrict"
            | b"volatile"
    )
}

/// Whether a source writes to a block. `out`: functions may write to what is passed to them.
fn is_written(scan: &Scan, block: &Block, out: bool) -> bool {
    let uses = (0..scan.tokens.len()).filter(|at| !block.tokens.contains(at));
    let mut uses = uses.filter(|&at| block.names.iter().any(|name| **name == *scan.name(at)));
    !block.readonly && uses.any(|at| writes_at(scan, at, out))
}

/// Whether a variable is written where it is named, by an assignment or a function.
fn writes_at(scan: &Scan, at: usize, out: bool) -> bool {
    let mark = |at: usize| match scan.tokens.get(at).map(|token| token.kind) {
        Some(Kind::Mark(mark)) => mark,
        _ => 0,
    };
    // A macro may be used in any way.
    if scan.tokens[at].directive {
        return true;
    }
    // The first token of what is written, and the one behind it.
    let (mut start, mut end) = (at, at + 1);
    let before = |start: usize, steps: usize| start.checked_sub(steps).map_or(0, mark);
    if before(start, 1) == b'.' {
        return false;
    }
    let called = |start: usize| match start.checked_sub(2) {
        Some(at) => scan.name(at),
        None => Default::default(),
    };
    loop {
        match mark(end) {
            b'[' => end = behind(scan, end),
            b'.' => end += 2,
            // In parentheses of its own.
            b')' if before(start, 1) == b'(' && called(start).is_empty() => {
                (start, end) = (start - 1, end + 1);
            }
            _ => break,
        }
    }
    let stepped = [[b'+'; 2], [b'-'; 2]].contains(&[before(start, 1), before(start, 2)]);
    let next = [mark(end), mark(end + 1), mark(end + 2)];
    let assigned = match next {
        [b'=', after, _] => after != b'=',
        [b'+', b'+', _] | [b'-', b'-', _] => true,
        [
            b'+' | b'-' | b'*' | b'/' | b'%' | b'&' | b'|' | b'^',
            b'=',
            _,
        ] => true,
        [b'<', b'<', b'='] | [b'>', b'>', b'='] => true,
        _ => false,
    };
    let opens = before(start, 1);
    let atomic = opens == b'(' && called(start).starts_with(b"atomic");
    let passed = matches!(opens, b'(' | b',') && matches!(next[0], b')' | b',');
    stepped || assigned || atomic || out && passed
}

#[cfg(test)]
mod tests {
    use super::*;

    fn writes(text: &str) -> MemoryWrites {
        let facts = crate::rewrite::facts(text.as_bytes(), false);
        facts.expect("a shader").writes
    }

    /// Whether a block with a member `a`, and an array `b` of structures with a member `c`, is written by a statement.
    fn is_written(statement: &str) -> bool {
        let with = |instance: &str, statement: &str| {
            let text = format!(
                "#version 430\nstruct S {{ int c; }};\nlayout(std430, binding = 1) buffer Name {{ int a; S b[]; }}{instance};\nvoid main() {{ {statement} }}"
            );
            writes(&text).blocks.contains("Name")
        };
        let named = statement.replace("$", "one.");
        let found = with("", &statement.replace("$", ""));
        assert_eq!(with(" one", &named), found, "{statement}");
        found
    }

    #[test]
    fn writes_to_blocks_are_found() {
        for written in [
            "$a = 1;",
            "$a += 1;",
            "$a <<= 1;",
            "++$a;",
            "$a--;",
            "$b[$b[0].c].c = 2;",
            "int old = atomicAdd($b[3].c, 1);",
            "if (x) $b[f(1, 2)].c |= 4;",
            "($a) = 1;",
            "atomicAdd(($b[0].c), 1);",
        ] {
            assert!(is_written(written), "{written}");
        }
        for read in [
            "int x = $a;",
            "if ($a == 1) discard;",
            "if ($a <= 1 || $a >= 2 || $a != 3) x = $b[0].c;",
            "x = f($a, $b[1].c) << $a;",
            "int n = $b.length();",
            "if (($a) == 1) x = ($b[0].c) + 1;",
            "s.a = 1; s.b[0].c = 2;",
        ] {
            assert!(!is_written(read), "{read}");
        }
    }

    #[test]
    fn what_cannot_be_told_counts_as_written() {
        let block = "#version 430\nbuffer B { int a; };\n";
        assert!(
            !writes(&format!("{block}void main() {{ f(a); }}"))
                .blocks
                .contains("B")
        );
        let out = format!("{block}void f(out int x) {{ x = 1; }} void main() {{ f(a); }}");
        assert!(writes(&out).blocks.contains("B"));
        let defined = format!("{block}#define SET a =\nvoid main() {{ SET 1; }}");
        assert!(writes(&defined).blocks.contains("B"));
        let macros = format!("{block}#define ADD(x) atomicAdd(x, 1)\nvoid main() {{ ADD(a); }}");
        assert!(writes(&macros).blocks.contains("B"));
        let declared = "#version 430\n#define RO readonly buffer\n#define RW buffer\nRW B { int a; };\nvoid main() { a = 1; }";
        assert!(writes(declared).unclear);
        let after =
            "#version 430\n#define RO readonly\nbuffer B { int a; };\nvoid main() { a = 1; }";
        assert!(writes(after).blocks.contains("B"));
        let readonly = "#version 430\nreadonly buffer B { int a; };\nvoid main() { int a = 1; }";
        assert!(writes(readonly).is_empty());
        let outputs =
            format!("{block}layout(location = 0) out vec4 colour; void main() {{ f(a); }}");
        assert!(writes(&outputs).is_empty());
    }

    #[test]
    fn counters_and_images_are_found() {
        assert!(writes("#version 430\nuniform atomic_uint n;").counters);
        assert!(writes("#version 430\nvoid f() { imageAtomicAdd(i, ivec2(0), 1u); }").images);
        assert!(writes("#version 430\nvoid f() { imageStore(i, ivec2(0), vec4(0)); }").images);
        assert!(writes("#version 430\nvec4 f() { return imageLoad(i, ivec2(0)); }").is_empty());
        assert!(writes("#version 120\nuniform sampler2D buffer; struct A { int a; }; void main() { a = 1; }").is_empty());
        let by_extension = "#version 420\n#extension GL_ARB_shader_storage_buffer_object : enable\nbuffer B { int a; }; void main() { a = 1; }";
        assert!(writes(by_extension).blocks.contains("B"));
    }
}
