//! Malformed sources: the rewriter does not panic, takes linear time, and keeps the numbers of lines.

use super::*;
use proptest::prelude::*;
use proptest::test_runner::{RngAlgorithm, RngSeed};
use std::time::{Duration, Instant};

/// Far more than a rewrite of a few kilobytes takes, which is microseconds.
const LONGEST: Duration = Duration::from_millis(100);
/// A word that the rewriter neither moves nor writes.
const MARK: &str = "qq";
const WAYS: [Options; 5] = [REPLAY, LAYERS, TILES, ES, DISTORTED];

/// Fragments that the rewriter looks for, to be combined at random.
const WORDS: [&str; 49] = [
    MARK,
    "main",
    "gl_FragCoord",
    "gl_InstanceID",
    "gl_Position",
    "gl_ClipDistance",
    "gl_PerVertex",
    "out",
    "in",
    "vec4",
    "float",
    "EmitVertex",
    "EmitStreamVertex",
    "uniform",
    "mat4",
    "layout",
    "mv_main",
    "void",
    "#version 120",
    "#version 330",
    "#version 300 es",
    "#extension a : b",
    "#define",
    "#ifdef A",
    "#if 1",
    "#else",
    "#endif",
    "#line 7",
    "#",
    "##",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ";",
    ",",
    ".",
    "0",
    "12",
    "1e+",
    "//",
    "/*",
    "*/",
    "\\\n",
    "\n",
    "\r\n",
    " ",
];

fn seeded(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20_26),
        rng_algorithm: RngAlgorithm::ChaCha,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Numbers of the lines with [`MARK`].
fn lines(text: &[u8]) -> Vec<usize> {
    let (mut found, mut line, mut at) = (Vec::new(), 1, 0);
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        if rest.starts_with(MARK.as_bytes()) {
            found.push(line);
        }
        let ending = scan::line_end(text, at);
        line += usize::from(ending != 0);
        at += ending.max(1);
    }
    found
}

fn directives(text: &[u8]) -> usize {
    text.windows(6).filter(|&part| part == b"#line ").count()
}

/// Rewrites in bounded time. Lines keep their numbers, unless a `#line` was added.
fn check(source: &[u8], stage: Stage, options: &Options) {
    let begun = Instant::now();
    let result = rewrite(source, stage, options);
    let taken = begun.elapsed();
    let show = || String::from_utf8_lossy(source).into_owned();
    assert!(taken < LONGEST, "{taken:?}: {}", show());
    if let Ok(Rewritten { text, .. }) = result
        && directives(&text) == directives(source)
    {
        assert_eq!(lines(&text), lines(source), "{}", show());
    }
}

proptest! {
    #![proptest_config(seeded(4000))]

    #[test]
    fn any_bytes(source in proptest::collection::vec(any::<u8>(), 0..300), stage in 0..6_usize, way in 0..4_usize) {
        check(&source, Stage::ALL[stage], &WAYS[way]);
    }

    #[test]
    fn words_in_any_order(words in proptest::collection::vec(0..WORDS.len(), 0..80), stage in 0..6_usize, way in 0..4_usize) {
        let source: String = words.into_iter().map(|word| WORDS[word]).collect();
        check(source.as_bytes(), Stage::ALL[stage], &WAYS[way]);
        let spaced = source.replace(MARK, " MARK ").replace("MARK", MARK);
        check(spaced.as_bytes(), Stage::ALL[stage], &WAYS[way]);
    }
}

/// Time is linear: no search through the source is repeated for each occurrence of a word.
#[test]
fn long_texts_take_their_length() {
    for word in WORDS {
        let source = word.repeat(1_000_000 / word.len());
        for (stage, options) in [
            (Stage::Vertex, TILES),
            (Stage::Geometry, REPLAY),
            (Stage::Fragment, ES),
        ] {
            let begun = Instant::now();
            let _ = rewrite(source.as_bytes(), stage, &options);
            let taken = begun.elapsed();
            assert!(
                taken < Duration::from_secs(5),
                "{word:?}, {stage:?}: {taken:?}"
            );
        }
    }
}

/// A generator of numbers with a seed: xorshift64* (S. Vigna, 2016).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let next = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D);
        usize::try_from(next >> 33).unwrap() % bound.max(1)
    }
}

fn spoil(text: &mut Vec<u8>, other: &[u8], numbers: &mut Numbers) {
    let at = numbers.below(text.len() + 1);
    let to = (at + numbers.below(40)).min(text.len());
    match numbers.below(6) {
        0 => drop(text.drain(at..to)),
        1 => {
            let word = WORDS[numbers.below(WORDS.len())];
            drop(text.splice(at..at, word.bytes()));
        }
        2 => {
            let from = numbers.below(other.len());
            let part = &other[from..(from + numbers.below(60)).min(other.len())];
            drop(text.splice(at..to, part.iter().copied()));
        }
        3 => {
            let part = text[at..to].to_vec();
            let place = numbers.below(text.len() + 1);
            drop(text.splice(place..place, part));
        }
        4 => {
            if let Some(byte) = text.get_mut(at) {
                *byte = u8::try_from(numbers.below(256)).unwrap();
            }
        }
        _ => drop(text.splice(at..at, MARK.bytes())),
    }
}

#[test]
#[ignore = "a minute"]
fn full_a_million_spoilt_shaders() {
    let mut texts: Vec<_> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    texts.sort();
    let texts: Vec<_> = texts.iter().map(|path| fs::read(path).unwrap()).collect();
    let mut numbers = Numbers(20_26);
    for round in 0..1_000_000 {
        let mut text = texts[numbers.below(texts.len())].clone();
        let other = &texts[numbers.below(texts.len())];
        for _ in 0..=numbers.below(4) {
            spoil(&mut text, other, &mut numbers);
        }
        check(
            &text,
            Stage::ALL[numbers.below(Stage::ALL.len())],
            &WAYS[round % WAYS.len()],
        );
    }
}
