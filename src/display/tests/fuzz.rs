//! Descriptions, calibrations and mask pictures with mistakes in them: an error that names what is wrong, or a panel whose mask can
//! be made; never a panic.

use super::*;
use crate::display::{calibration, file};

/// What files are made of; mistakes are put in from here.
const WORDS: [&str; 58] = [
    "kind",
    "views",
    "pitch",
    "slant",
    "offset",
    "order",
    "mask",
    "version",
    "name",
    "screen",
    "dpi",
    "cone",
    "rotation",
    "quilt",
    "spacing",
    "bias",
    "colour-offsets",
    "horizontal",
    "modulus",
    "table",
    "pattern",
    "subpixels",
    "p-over-du",
    "colour-slant",
    "calibration",
    "\"slanted\"",
    "\"integer\"",
    "\"leia\"",
    "\"pattern\"",
    "\"looking-glass\"",
    "\"lenticular\"",
    "\"wall\"",
    "[[panel]]",
    "monitor",
    "width",
    "homography",
    "mesh-x",
    "light",
    "border",
    "viewer",
    "0",
    "-1",
    "1e300",
    "-1e-300",
    "nan",
    "inf",
    "9223372036854775807",
    "\"1/3\"",
    "\"1/0\"",
    "\"-9223372036854775808/999999937\"",
    "[]",
    "{}",
    "true",
    "\"\"",
    "1000000",
    "-1000000",
    "\"LRb\"",
    "0.1",
];

const DESCRIPTIONS: [&str; 8] = [
    "kind = \"slanted\"\nviews = 9\npitch = \"16/3\"\nslant = \"2/3\"\noffset = 0.5\norder = \"bgr\"\ncolour-offsets = [0, 0.1, 0.2]\nscreen = \"64x48\"\nrotation = 90",
    "kind = \"slanted\"\nviews = 9\npitch = 18.6579\nbias = { columns = 2, rows = 2, values = [0, 1, 2, 3] }\nrotation = 270",
    "kind = \"integer\"\nviews = 4\nhorizontal = 3\nsubpixel = 1\nvertical = 2\noffset = 1\nmodulus = 96\ntable = [0, 1, \"b\", 3]",
    "kind = \"leia\"\nviews = 12\np-over-du = 3\np-over-dv = 0.8\ncolour-slant = 0.1\noffset = 0.25\ncolour-inversion = true",
    "kind = \"pattern\"\npattern = [\"LRb\", \"RLb\"]\nsubpixels = true\nrotation = 180",
    "kind = \"huebner\"\nviews = 8\ndpi = 338\ncone = 40\nquilt = \"8x6\"",
    "kind = \"lenticular\"\nviews = 5\nname = \"x\"\nversion = 1",
    "kind = \"wall\"\nviews = 8\n[[panel]]\nmonitor = \"a\"\ndisplay = \"rows\"\npixels = \"64x32\"\nat = [0, 0]\nwidth = 40\nturn = 3\nlight = 0.9\nborder = [1, 1, 1, 1]",
];

const CALIBRATION: &str = r#"{"serial": "LKG-P1", "pitch": {"value": 52.59}, "slope": {"value": -7.21}, "center": {"value": 0.4},
"viewCone": {"value": 40}, "invView": {"value": 1}, "DPI": {"value": 324}, "screenW": {"value": 1536}, "screenH": {"value": 2048},
"flipImageX": {"value": 0}, "CellPatternMode": 1, "subpixelCells": [
{"ROffsetX": -0.25, "ROffsetY": 0.1, "GOffsetX": 0, "GOffsetY": -0.2, "BOffsetX": 0.3, "BOffsetY": 0},
{"ROffsetX": 0.2, "ROffsetY": 0, "GOffsetX": 0.01, "GOffsetY": 0.3, "BOffsetX": -0.3, "BOffsetY": 0.125}]}"#;

/// splitmix64
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

/// One to four mistakes: bytes changed, cut or doubled, or a value replaced by a word.
fn spoil(random: &mut Random, text: &str) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        match random.below(6) {
            0 if !bytes.is_empty() => bytes[at] = random.next() as u8,
            1 => bytes.truncate(at),
            2 => {
                let end = (at + random.below(20)).min(bytes.len());
                bytes.drain(at..end);
            }
            3 => {
                let end = (at + random.below(20)).min(bytes.len());
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            _ => {
                // From here to the next mark, as values and keys are.
                let marks = b"=,:\n]}";
                let start = bytes[at..]
                    .iter()
                    .position(|b| marks.contains(b))
                    .map_or(at, |i| at + i + 1);
                let end = bytes[start.min(bytes.len())..]
                    .iter()
                    .position(|b| marks.contains(b));
                let end = end.map_or(bytes.len(), |i| start + i);
                let word = WORDS[random.below(WORDS.len())];
                bytes.splice(start.min(end)..end, word.bytes());
            }
        }
    }
    bytes
}

/// A message is one sentence about the file; a panel makes a mask.
fn survives(result: Result<Display, DisplayError>, what: &str) -> bool {
    match result {
        Err(error) => {
            let message = error.to_string();
            assert!(
                message.contains('`') && !message.contains(char::is_control) && message.len() > 30,
                "{what}\n{message}"
            );
            false
        }
        Ok(display) => {
            let at = Placement {
                screen_width: 64,
                screen_height: 48,
                x: -3,
                y: 7,
                width: 9,
                height: 3,
            };
            for views in [1, display.views.min(256), 256] {
                if let Ok(mask) = display.mask(&at, views) {
                    let largest = mask
                        .data()
                        .as_flattened()
                        .iter()
                        .filter(|&&view| view != GUARD)
                        .max();
                    assert!(
                        largest.is_none_or(|&view| u32::from(view) < views),
                        "{what}: {largest:?} of {views}"
                    );
                }
            }
            assert!(display.describe().len() > 2);
            true
        }
    }
}

fn fuzz(count: u64) {
    let mut random = Random(20_26);
    let mut good = 0u64;
    let whole = mask(&Display::default(), 8, 6, 8);
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("mask.png");
    whole.to_png(&picture).unwrap();
    let png = fs::read(&picture).unwrap();
    for i in 0..count {
        let result = match i % 10 {
            // Pictures go through a file and are slower.
            0 => {
                let mut bytes = png.clone();
                for _ in 0..=random.below(3) {
                    let at = random.below(bytes.len());
                    bytes[at] = random.next() as u8;
                }
                bytes.truncate(1 + random.below(2 * bytes.len()));
                fs::write(&picture, &bytes).unwrap();
                file::load(&picture, false)
            }
            1..=3 => match String::from_utf8(spoil(&mut random, CALIBRATION)) {
                Ok(text) => calibration::read("x.json", "x".into(), &text),
                Err(_) => continue,
            },
            _ => {
                let description = DESCRIPTIONS[random.below(DESCRIPTIONS.len())];
                match String::from_utf8(spoil(&mut random, description)) {
                    Ok(text) => file::from_toml(Path::new("x.toml"), &text, false),
                    Err(_) => continue,
                }
            }
        };
        good += u64::from(survives(result, &format!("input {i}")));
    }
    println!("{count} inputs, {good} of them panels");
    // Both ways were taken.
    assert!(good > count / 100 && good < count / 2, "{good} of {count}");
}

#[test]
fn ten_thousand_spoilt_files() {
    fuzz(10_000);
}

#[test]
#[ignore = "a minute"]
fn a_million_spoilt_files() {
    fuzz(1_000_000);
}
