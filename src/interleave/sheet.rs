//! A mask as the smallest possible texture: one period, in bytes where values fit.
#![forbid(unsafe_code)]

use crate::display::{GUARD, Mask};

/// The texture to upload.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Sheet {
    /// Columns and rows; the mask repeats after them.
    pub(super) period: [u32; 2],
    /// Each pixel names one view.
    pub(super) whole: bool,
    /// The value of black subpixels.
    pub(super) black: u16,
    /// R, G, B and nothing; row 0 on top.
    pub(super) texels: Texels,
}

/// In the format of the texture.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Texels {
    Bytes(Vec<[u8; 4]>),
    Words(Vec<[u16; 4]>),
}

impl Sheet {
    /// From a mask, with `code(view)` in place of each view; a [`GUARD`] is black.
    pub(super) fn new(mask: &Mask, code: impl Fn(u16) -> u16) -> Self {
        let (columns, rows) = period(mask);
        let rows_of = mask.data().chunks_exact(mask.width() as usize);
        let pixels = rows_of.take(rows).flat_map(|row| row.iter().take(columns));
        let words = || {
            pixels.clone().map(|&pixel| {
                let [r, g, b] = pixel.map(|view| if view == GUARD { GUARD } else { code(view) });
                [r, g, b, 0]
            })
        };
        let lit = words().flatten().filter(|&code| code != GUARD);
        let bytes = lit.max().unwrap_or(0) < u16::from(u8::MAX);
        Self {
            period: [columns as u32, rows as u32],
            whole: pixels.clone().all(|&[r, g, b]| r == g && g == b),
            black: if bytes { u16::from(u8::MAX) } else { GUARD },
            texels: if bytes {
                // The guard becomes the largest byte.
                Texels::Bytes(words().map(|texel| texel.map(|code| code as u8)).collect())
            } else {
                Texels::Words(words().collect())
            },
        }
    }
}

/// The smallest numbers of columns and of rows after which a mask repeats; its size where it does not.
fn period(mask: &Mask) -> (usize, usize) {
    let width = mask.width() as usize;
    let mut columns = vec![0; width];
    let mut rows = Vec::with_capacity(mask.height() as usize);
    for row in mask.rows() {
        let mut of_row = 0;
        for (of_column, pixel) in columns.iter_mut().zip(row) {
            let [r, g, b] = pixel.map(u64::from);
            let pixel = r | g << 16 | b << 32;
            *of_column = mixed(*of_column, pixel);
            of_row = mixed(of_row, pixel);
        }
        rows.push(of_row);
    }
    let (x, y) = (smallest_period(&columns), smallest_period(&rows));
    let repeats = |pixels: &[[u16; 3]], after: usize| {
        pixels.get(after..) == pixels.get(..pixels.len() - after)
    };
    // Different columns or rows may have the same hash.
    if mask.rows().all(|row| repeats(row, x)) && repeats(mask.data(), y * width) {
        (x, y)
    } else {
        (width, rows.len())
    }
}

/// A hash with one more value.
fn mixed(sum: u64, value: u64) -> u64 {
    (sum ^ value)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .rotate_left(29)
}

/// The smallest period of the symbols, at most their number: the number without the longest proper prefix that is also a suffix.
/// Computed with the failure function of Knuth, Morris and Pratt.
fn smallest_period(symbols: &[u64]) -> usize {
    let mut borders: Vec<usize> = Vec::with_capacity(symbols.len());
    for symbol in symbols {
        let mut border = borders.last().copied().unwrap_or(0);
        if !borders.is_empty() {
            while border > 0 && symbols.get(border) != Some(symbol) {
                border = borders.get(border - 1).copied().unwrap_or(0);
            }
            border += usize::from(symbols.get(border) == Some(symbol));
        }
        borders.push(border);
    }
    symbols.len() - borders.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::display::{Display, Placement};

    /// The value that a shader reads at a pixel.
    fn read(sheet: &Sheet, x: u32, row: u32) -> [u16; 3] {
        let [columns, rows] = sheet.period;
        let at = (row % rows * columns + x % columns) as usize;
        let [r, g, b, _] = match &sheet.texels {
            Texels::Bytes(texels) => texels[at].map(u16::from),
            Texels::Words(texels) => texels[at],
        };
        [r, g, b].map(|code| if code == sheet.black { GUARD } else { code })
    }

    #[test]
    fn sheets_are_their_masks() {
        let irrational = "kind = \"slanted\"\nviews = 7\npitch = 18.6579\nslant = -0.41";
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("panel.toml");
        std::fs::write(&file, irrational).expect("written");
        let slanted = Display::load(file.to_str().expect("UTF-8")).expect("a display");
        let size = (280, 170);
        let named = |name| Display::named(name).expect("a display");
        for (display, views, period, whole, bytes) in [
            (named("huebner8"), 8, None, false, true),
            (named("slanted8"), 8, None, false, true),
            (named("lenticular-5"), 5, Some([5, 1]), true, true),
            (named("lenticular-5"), 300, Some([280, 1]), true, false),
            (named("checkerboard"), 2, Some([2, 2]), true, true),
            (slanted, 45, Some([280, 170]), false, true),
        ] {
            let placement = Placement {
                x: 7,
                y: -3,
                ..Placement::full_screen(size.0, size.1)
            };
            let mask = display.mask(&placement, views).expect("a mask");
            let sheet = Sheet::new(&mask, |view| view);
            let small = sheet.period[0] <= 64 && sheet.period[1] <= 64;
            assert_eq!(
                period.unwrap_or(sheet.period),
                sheet.period,
                "{}",
                display.name
            );
            assert!(
                period.is_some() || small,
                "{}: {:?}",
                display.name,
                sheet.period
            );
            assert_eq!(sheet.whole, whole, "{}", display.name);
            assert_eq!(matches!(sheet.texels, Texels::Bytes(_)), bytes);
            for (row, pixels) in (0..).zip(mask.rows()) {
                for (x, &pixel) in (0..).zip(pixels) {
                    assert_eq!(read(&sheet, x, row), pixel, "{} {x} {row}", display.name);
                }
            }
        }
    }

    #[test]
    fn one_odd_pixel_is_no_period() {
        let mut pixels = vec![[0, 1, 2]; 12 * 8];
        let plain = Mask::new(12, 8, pixels.clone()).expect("a mask");
        assert_eq!(Sheet::new(&plain, |view| view).period, [1, 1]);
        pixels[95] = [0, GUARD, 2];
        let odd = Mask::new(12, 8, pixels).expect("a mask");
        let sheet = Sheet::new(&odd, |view| view + 300);
        assert_eq!(sheet.period, [12, 8]);
        assert_eq!(read(&sheet, 11, 7), [300, GUARD, 302]);
        assert_eq!(read(&sheet, 10, 7), [300, 301, 302]);
    }

    #[test]
    fn black_has_a_value_of_its_own() {
        for (largest, black) in [(254, 255), (255, GUARD)] {
            let mask = Mask::new(1, 2, vec![[0, 0, GUARD], [largest; 3]]).expect("a mask");
            let sheet = Sheet::new(&mask, |view| view);
            assert_eq!(sheet.black, black);
            assert_eq!(read(&sheet, 0, 0), [0, 0, GUARD]);
            assert_eq!(read(&sheet, 0, 1), [largest; 3]);
        }
    }

    #[test]
    fn periods_of_words() {
        for (word, period) in [
            ("a", 1),
            ("aaaa", 1),
            ("abab", 2),
            ("ababa", 2),
            ("aabaa", 3),
            ("abcd", 4),
        ] {
            let symbols: Vec<u64> = word.bytes().map(u64::from).collect();
            assert_eq!(smallest_period(&symbols), period, "{word}");
        }
    }
}
