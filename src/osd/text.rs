//! Text as pixels.
#![forbid(unsafe_code)]

use ab_glyph::{Font, FontRef, GlyphId, OutlinedGlyph, PxScale, ScaleFont, point};

/// Pixels of a text on its dark ground.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Raster {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Red, green, blue and 255 for each pixel; rows from the bottom up.
    pub texels: Vec<u8>,
}

/// The dark ground.
const GROUND: u8 = 16;
/// The text.
const INK: u8 = 255;
/// Lines of text that a picture has room for, from top to bottom.
const LINES: u32 = 24;
/// Heights of a line, in pixels: readable on a small window, and not larger than needed on a large panel.
const HEIGHTS: (u32, u32) = (14, 120);
/// Lens widths that a letter is at least high, so that its strokes are about as wide as a lens.
const LENSES: f64 = 16.0;

/// Height of a line in pixels, in a picture of this height. `spread`: columns of pixels from one sample of a view to the next, the width of a lens.
#[must_use]
pub fn text_height(picture: u32, spread: f64) -> u32 {
    let most = HEIGHTS.1.min(picture / 8).max(HEIGHTS.0);
    let of_lenses = (spread - 1.0) * LENSES + f64::from(HEIGHTS.0);
    (picture / LINES)
        .max(of_lenses as u32)
        .clamp(HEIGHTS.0, most)
}

/// Writes lines of this height. What is wider than `most[0]` pixels goes on in the next line; lines below `most[1]` pixels are left out. None if there
/// is nothing to write, or no room. The pixels are averaged over `spread` columns, so that a view which has one sample in as many shows all strokes.
#[must_use]
pub fn write(lines: &[String], height: u32, most: [u32; 2], spread: f64) -> Option<Raster> {
    let font = FontRef::try_from_slice(epaint_default_fonts::HACK_REGULAR).ok()?;
    // The scale is the height from the lowest to the highest point of the font, with some space between lines.
    let scale = PxScale::from(height as f32 * 0.9);
    let scaled = font.as_scaled(scale);
    let margin = height / 3;
    let wide = most[0].checked_sub(2 * margin)? as f32;
    let mut rows: Vec<Vec<(GlyphId, f32)>> = Vec::new();
    for line in lines {
        rows.extend(broken(line, wide, |letter| {
            let glyph = font.glyph_id(letter);
            (glyph, scaled.h_advance(glyph))
        }));
    }
    rows.truncate((most[1].checked_sub(2 * margin)? / height) as usize);
    let ends = rows
        .iter()
        .filter_map(|row| row.last().map(|(_, end)| *end));
    let width = ends.fold(0.0, f32::max).ceil() as u32 + 2 * margin;
    let size = [width.min(most[0]), rows.len() as u32 * height + 2 * margin];
    if rows.is_empty() {
        return None;
    }
    let mut ink = vec![0.0_f32; size[0] as usize * size[1] as usize];
    for (number, row) in rows.iter().enumerate() {
        let base = (margin + number as u32 * height) as f32 + scaled.ascent();
        let mut start = margin as f32;
        for &(id, end) in row {
            let glyph = id.with_scale_and_position(scale, point(start, base));
            start = margin as f32 + end;
            if let Some(outline) = font.outline_glyph(glyph) {
                draw(&outline, size, &mut ink);
            }
        }
    }
    average(&mut ink, size[0] as usize, spread.round() as usize);
    let texel = |ink: &f32| {
        let grey = f32::from(GROUND) + ink.clamp(0.0, 1.0) * f32::from(INK - GROUND);
        let grey = grey.round() as u8;
        [grey, grey, grey, 255]
    };
    let texels = ink.iter().flat_map(texel).collect();
    Some(Raster { size, texels })
}

/// Adds a glyph to the ink of a picture, rows from the bottom up.
fn draw(outline: &OutlinedGlyph, size: [u32; 2], ink: &mut [f32]) {
    let bounds = outline.px_bounds();
    outline.draw(|x, y, coverage| {
        let x = bounds.min.x as i64 + i64::from(x);
        let y = i64::from(size[1]) - 1 - (bounds.min.y as i64 + i64::from(y));
        let inside = |at: i64, side: u32| {
            let at = usize::try_from(at).ok();
            at.filter(|at| *at < side as usize)
        };
        if let (Some(x), Some(y)) = (inside(x, size[0]), inside(y, size[1])) {
            ink[y * size[0] as usize + x] += coverage;
        }
    });
}

/// The mean of each pixel and those beside it, `columns` in all.
fn average(ink: &mut [f32], width: usize, columns: usize) {
    if columns < 2 {
        return;
    }
    for row in ink.chunks_exact_mut(width) {
        let before = row.to_vec();
        for (at, pixel) in row.iter_mut().enumerate() {
            let from = at.saturating_sub(columns / 2);
            let to = (at + columns.div_ceil(2)).min(width);
            *pixel = before[from..to].iter().sum::<f32>() / columns as f32;
        }
    }
}

/// The rows of a line: its glyphs, each with its right edge in pixels. A row ends between words where it can.
fn broken(
    line: &str,
    wide: f32,
    glyph: impl Fn(char) -> (GlyphId, f32),
) -> Vec<Vec<(GlyphId, f32)>> {
    let letters: Vec<(char, GlyphId, f32)> = line
        .chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .map(|letter| {
            let (id, advance) = glyph(letter);
            (letter, id, advance)
        })
        .collect();
    let mut rows = Vec::new();
    let mut rest = letters.as_slice();
    while !rest.is_empty() {
        let mut end = 0.0;
        let fits = rest.iter().take_while(|(_, _, advance)| {
            end += advance;
            end <= wide
        });
        let fits = fits.count().max(1);
        let space = rest[..fits].iter().rposition(|(letter, ..)| *letter == ' ');
        let count = match space {
            Some(at) if fits < rest.len() && at > 0 => at + 1,
            _ => fits,
        };
        let mut end = 0.0;
        let row = rest[..count].iter().map(|(_, id, advance)| {
            end += advance;
            (*id, end)
        });
        rows.push(row.collect());
        rest = &rest[count..];
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ink(raster: &Raster) -> usize {
        raster
            .texels
            .chunks_exact(4)
            .filter(|texel| texel[0] > 200)
            .count()
    }

    #[test]
    fn lines_have_their_height_and_their_ink() {
        let one = write(&["separation 0.033".into()], 24, [800, 600], 1.0).unwrap();
        assert_eq!(one.size[1], 24 + 16);
        let two = write(
            &["a".into(), "separation 0.033".into()],
            24,
            [800, 600],
            1.0,
        )
        .unwrap();
        assert_eq!((two.size[0], two.size[1]), (one.size[0], 48 + 16));
        assert!(
            ink(&one) > 300 && ink(&two) > ink(&one),
            "{} {}",
            ink(&one),
            ink(&two)
        );
        assert_eq!(
            one.texels.len(),
            4 * one.size[0] as usize * one.size[1] as usize
        );
    }

    #[test]
    fn long_lines_are_broken_and_what_has_no_room_is_left_out() {
        let text = "the driver takes no mask of the panel, perhaps for lack of memory".to_owned();
        let broken = write(std::slice::from_ref(&text), 20, [300, 600], 1.0).unwrap();
        assert!(
            broken.size[0] <= 300 && broken.size[1] >= 3 * 20,
            "{:?}",
            broken.size
        );
        let low = write(&[text], 20, [300, 60], 1.0).unwrap();
        assert!(low.size[1] <= 60, "{:?}", low.size);
        assert_eq!(write(&["a".into()], 20, [300, 30], 1.0), None);
        assert_eq!(write(&[], 20, [300, 300], 1.0), None);
        assert!(
            write(
                &["w".repeat(500), "\u{1b}[1m".into(), "é".into()],
                20,
                [30, 3000],
                1.0
            )
            .is_some()
        );
    }

    #[test]
    fn the_text_grows_with_the_picture() {
        let plain = |picture| text_height(picture, 1.0);
        assert_eq!([100, 1080, 10_000].map(plain), [14, 45, 120]);
        // A Looking Glass Portrait has lenses 6.2 pixels wide.
        assert_eq!(text_height(2048, 6.2), 97);
        assert_eq!(text_height(240, 6.2), 30);
    }

    #[test]
    fn a_view_with_one_column_in_eight_shows_all_strokes() {
        let columns = |spread: f64| {
            let raster = write(&["illinois".into()], 60, [800, 600], spread).unwrap();
            let width = raster.size[0] as usize;
            let row = raster.size[1] as usize / 2;
            let grey = |x: usize| u32::from(raster.texels[4 * (row * width + x)]);
            // What views see of the row: each one column in eight.
            let seen = |view: usize| (view..width).step_by(8).map(grey).sum::<u32>();
            let all: Vec<u32> = (0..8).map(seen).collect();
            let (least, most) = (all.iter().min().unwrap(), all.iter().max().unwrap());
            f64::from(most - least) / f64::from(*most)
        };
        assert!(
            columns(1.0) > 0.2 && columns(8.0) < 0.1,
            "{} {}",
            columns(1.0),
            columns(8.0)
        );
    }
}
