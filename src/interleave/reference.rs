//! The exact picture, on the CPU: the reference for the shaders.
//!
//! Pictures have row 0 on top. Resampling: a pixel centre at place p in (0, 1) of its cell takes the tile's colour at p,
//! bilinear between texel centres and clamped inside the tile, in integers, rounded half up to 8 bits. Where tile and cell
//! have the same size, that is the texel itself. Only [`filtered`] and [`anaglyph`] blend views with each other.
#![forbid(unsafe_code)]

use super::Layout;
use crate::config::{Anaglyph, Filter};
use crate::display::{FINE, GUARD, Mask};
use image::{ImageBuffer, Pixel, Rgb, RgbImage};

/// A view, RGB or RGBA with 8 bits; alpha is ignored.
pub type Tile<P> = ImageBuffer<P, Vec<u8>>;

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReferenceError {
    /// There are no views.
    #[error("no views were given; give at least one tile")]
    NoTiles,
    /// Tiles differ in size, or have no pixels.
    #[error(
        "tile {index} is {width}x{height} pixels, but tile 0 is {first_width}x{first_height}; \
         all tiles must have one size, not 0"
    )]
    TileSize {
        /// Index of the view.
        index: usize,
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Pixels.
        first_width: u32,
        /// Pixels.
        first_height: u32,
    },
    /// Tiles have fewer than three channels.
    #[error("tiles must be RGB or RGBA, found {channels} channels")]
    Channels {
        /// Per pixel.
        channels: u8,
    },
    /// The mask shows a view that does not exist.
    #[error(
        "the mask shows view {view}, but there are {views} tiles; give a mask for {views} views"
    )]
    View {
        /// Index of the view in the mask.
        view: u32,
        /// N.
        views: usize,
    },
    /// The requested view does not exist.
    #[error("there is no view {view}; the views are numbered from 0 and there are {views}")]
    NoView {
        /// The requested view.
        view: u32,
        /// N.
        views: usize,
    },
    /// The picture would have no pixels, or more than 2^28.
    #[error("a picture of {width}x{height} pixels cannot be made; give 1 to 2^28 pixels")]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
}

/// The picture of a panel: each subpixel is from the view that the mask names, and guard subpixels are black. The picture
/// has the size of the mask.
pub fn interleave<P: Pixel<Subpixel = u8>>(
    tiles: &[Tile<P>],
    mask: &Mask,
) -> Result<RgbImage, ReferenceError> {
    let tile = tile_size(tiles)?;
    let size = (mask.width(), mask.height());
    let mut out = picture(size)?;
    let taps = Taps::new(size, (1, 1), tile);
    for (row, views) in (0..).zip(mask.rows()) {
        for (x, views) in (0..).zip(views) {
            let mut pixel = [0; 3];
            for (channel, &view) in views.iter().enumerate() {
                if view == GUARD {
                    continue;
                }
                let missing = ReferenceError::View {
                    view: u32::from(view),
                    views: tiles.len(),
                };
                let tile = tiles.get(usize::from(view)).ok_or(missing)?;
                if let (Some(value), Some(out)) =
                    (taps.colour(tile, x, row), pixel.get_mut(channel))
                {
                    *out = value.0.get(channel).copied().unwrap_or(0);
                }
            }
            out.put_pixel(x, row, Rgb(pixel));
        }
    }
    Ok(out)
}

/// As [`interleave`] for [`Filter::Nearest`]. For other filters the mask is a [fine one](crate::display::Display::fine_mask), and views are
/// weighted as linear light; beyond the first and the last view, that one is repeated.
pub fn filtered<P: Pixel<Subpixel = u8>>(
    tiles: &[Tile<P>],
    mask: &Mask,
    filter: Filter,
) -> Result<RgbImage, ReferenceError> {
    if filter == Filter::Nearest {
        return interleave(tiles, mask);
    }
    let tile = tile_size(tiles)?;
    let size = (mask.width(), mask.height());
    let mut out = picture(size)?;
    let taps = Taps::new(size, (1, 1), tile);
    for (row, steps) in (0..).zip(mask.rows()) {
        for (x, steps) in (0..).zip(steps) {
            let mut pixel = [0; 3];
            for (channel, (out, &step)) in pixel.iter_mut().zip(steps).enumerate() {
                if step == GUARD {
                    continue;
                }
                let light = |view: i64| {
                    let view = view.clamp(0, tiles.len() as i64 - 1) as usize;
                    let colour = taps.colour(tiles.get(view)?, x, row)?;
                    let value = colour.0.get(channel).copied()?;
                    Some(linear(f32::from(value) / 255.0))
                };
                let (mut sum, mut weights) = (0.0, 0.0);
                for (view, weight) in filter.weights(step) {
                    sum += weight * light(view).unwrap_or(0.0);
                    weights += weight;
                }
                *out = (encoded(sum / weights) * 255.0 + 0.5) as u8;
            }
            out.put_pixel(x, row, Rgb(pixel));
        }
    }
    Ok(out)
}

/// Standard deviation of the Gaussian, in views.
const SIGMA: f32 = 0.6;

impl Filter {
    /// The views around the middle of a step of a fine mask, and their weights. Indices may lie outside 0 to N−1.
    fn weights(self, step: u16) -> Vec<(i64, f32)> {
        let place = (f32::from(step) + 0.5) / f32::from(FINE) - 0.5;
        let nearest = (place + 0.5).floor();
        match self {
            Self::Nearest => vec![(nearest as i64, 1.0)],
            Self::Blend => {
                let low = place.floor();
                vec![
                    (low as i64, 1.0 - (place - low)),
                    (low as i64 + 1, place - low),
                ]
            }
            Self::Gaussian => [-1.0, 0.0, 1.0]
                .map(|i: f32| {
                    let distance = (nearest + i - place) / SIGMA;
                    ((nearest + i) as i64, (-0.5 * distance * distance).exp())
                })
                .to_vec(),
        }
    }
}

/// Whole views beside each other, in a picture of any size. A pixel belongs to the cell that its centre lies in.
pub fn arrange<P: Pixel<Subpixel = u8>>(
    tiles: &[Tile<P>],
    layout: Layout,
    size: (u32, u32),
) -> Result<RgbImage, ReferenceError> {
    let tile = tile_size(tiles)?;
    let views = u32::try_from(tiles.len()).unwrap_or(u32::MAX);
    if let Layout::View(view) = layout
        && view >= views
    {
        return Err(ReferenceError::NoView {
            view,
            views: tiles.len(),
        });
    }
    let mut out = picture(size)?;
    let taps = Taps::new(size, layout.grid(views), tile);
    for (x, row, pixel) in out.enumerate_pixels_mut() {
        let tile = taps
            .cell(x, row)
            .and_then(|(column, row)| layout.view_at(column, row, views))
            .and_then(|view| tiles.get(view as usize));
        if let Some(colour) = tile.and_then(|tile| taps.colour(tile, x, row)) {
            *pixel = colour;
        }
    }
    Ok(out)
}

/// The views of the two eyes: the first and the last one.
pub fn eyes<T>(mut views: Vec<T>) -> Vec<T> {
    if views.len() > 2 {
        let last = views.len() - 1;
        views.swap(1, last);
        views.truncate(2);
    }
    views
}

/// The first and the last view through coloured glasses. Colours are sRGB, mixed as linear light.
pub fn anaglyph<P: Pixel<Subpixel = u8>>(
    tiles: &[Tile<P>],
    kind: Anaglyph,
    size: (u32, u32),
) -> Result<RgbImage, ReferenceError> {
    let tile = tile_size(tiles)?;
    let mut out = picture(size)?;
    let taps = Taps::new(size, (1, 1), tile);
    let (left, right) = kind.matrices();
    let (Some(left_tile), Some(right_tile)) = (tiles.first(), tiles.last()) else {
        return Err(ReferenceError::NoTiles);
    };
    for (x, row, pixel) in out.enumerate_pixels_mut() {
        let light = |tile: &Tile<P>| {
            let colour = taps.colour(tile, x, row)?.0;
            Some(colour.map(|value| linear(f32::from(value) / 255.0)))
        };
        let (Some(l), Some(r)) = (light(left_tile), light(right_tile)) else {
            continue;
        };
        for ((out, left), right) in pixel.0.iter_mut().zip(left).zip(right) {
            let sum = |row: [f32; 3], light: [f32; 3]| -> f32 {
                row.iter()
                    .zip(light)
                    .map(|(weight, light)| weight * light)
                    .sum()
            };
            let value = encoded((sum(left, l) + sum(right, r)).clamp(0.0, 1.0));
            *out = (value * 255.0 + 0.5) as u8;
        }
    }
    Ok(out)
}

/// From sRGB to linear light (IEC 61966-2-1).
pub(crate) fn linear(value: f32) -> f32 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        ((value + 0.055) / 1.055).powf(2.4)
    }
}

/// From linear light to sRGB (IEC 61966-2-1).
pub(crate) fn encoded(light: f32) -> f32 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

/// A picture that shows one view in each cell of a grid.
pub(super) fn resample(
    view: &RgbImage,
    grid: (u32, u32),
    size: (u32, u32),
) -> Result<RgbImage, ReferenceError> {
    let tile = tile_size(std::slice::from_ref(view))?;
    let mut out = picture(size)?;
    let taps = Taps::new(size, grid, tile);
    for (x, row, pixel) in out.enumerate_pixels_mut() {
        if let Some(colour) = taps.colour(view, x, row) {
            *pixel = colour;
        }
    }
    Ok(out)
}

fn tile_size<P: Pixel<Subpixel = u8>>(tiles: &[Tile<P>]) -> Result<(u32, u32), ReferenceError> {
    let first = tiles.first().ok_or(ReferenceError::NoTiles)?.dimensions();
    if P::CHANNEL_COUNT < 3 {
        return Err(ReferenceError::Channels {
            channels: P::CHANNEL_COUNT,
        });
    }
    for (index, tile) in tiles.iter().enumerate() {
        let (width, height) = tile.dimensions();
        if (width, height) != first || width == 0 || height == 0 {
            let (first_width, first_height) = first;
            return Err(ReferenceError::TileSize {
                index,
                width,
                height,
                first_width,
                first_height,
            });
        }
    }
    Ok(first)
}

pub(super) fn picture((width, height): (u32, u32)) -> Result<RgbImage, ReferenceError> {
    let pixels = u64::from(width) * u64::from(height);
    if !(1..=1 << 28).contains(&pixels) {
        return Err(ReferenceError::Size { width, height });
    }
    Ok(RgbImage::new(width, height))
}

/// The two texels from which one column or row of the picture takes its colour.
#[derive(Clone, Copy)]
struct Tap {
    /// Cell, from the left or the top.
    cell: u32,
    low: u32,
    high: u32,
    /// Weight of `high`, out of `Taps::full`.
    weight: u64,
}

/// The taps of all columns and rows of a picture.
struct Taps {
    columns: Vec<Tap>,
    rows: Vec<Tap>,
    /// The number that stands for the weight 1, of columns and of rows.
    full: (u64, u64),
}

impl Taps {
    fn new(size: (u32, u32), grid: (u32, u32), tile: (u32, u32)) -> Self {
        Self {
            columns: (0..size.0)
                .map(|at| Tap::new(at, size.0, grid.0, tile.0))
                .collect(),
            rows: (0..size.1)
                .map(|at| Tap::new(at, size.1, grid.1, tile.1))
                .collect(),
            full: (4 * u64::from(size.0), 4 * u64::from(size.1)),
        }
    }

    fn cell(&self, x: u32, row: u32) -> Option<(u32, u32)> {
        Some((
            self.columns.get(x as usize)?.cell,
            self.rows.get(row as usize)?.cell,
        ))
    }

    fn colour<P: Pixel<Subpixel = u8>>(&self, tile: &Tile<P>, x: u32, row: u32) -> Option<Rgb<u8>> {
        let (x, y) = (self.columns.get(x as usize)?, self.rows.get(row as usize)?);
        let at = |x, y| Some(tile.get_pixel_checked(x, y)?.channels());
        let (a, b) = (at(x.low, y.low)?, at(x.high, y.low)?);
        let (c, d) = (at(x.low, y.high)?, at(x.high, y.high)?);
        let (full_x, full_y) = self.full;
        let mut out = [0; 3];
        for (channel, out) in out.iter_mut().enumerate() {
            let value = |texel: &[u8]| texel.get(channel).copied().map(u64::from);
            let upper = value(a)? * (full_x - x.weight) + value(b)? * x.weight;
            let lower = value(c)? * (full_x - x.weight) + value(d)? * x.weight;
            let sum = upper * (full_y - y.weight) + lower * y.weight;
            let one = full_x * full_y;
            // At most 255, as the weights add up to `one`.
            *out = ((2 * sum + one) / (2 * one)) as u8;
        }
        Some(Rgb(out))
    }
}

impl Tap {
    /// Pixel `at` of `size`, cut into `cells` cells of `texels` texels each.
    fn new(at: u32, size: u32, cells: u32, texels: u32) -> Self {
        let [at, size, cells, texels] = [at, size, cells, texels].map(i64::from);
        let centre = (2 * at + 1) * cells;
        let cell = centre / (2 * size);
        // Distance from the centre of the first texel, in texels times 4 · size.
        let place = 2 * (centre - cell * 2 * size) * texels - 2 * size;
        let low = place.div_euclid(4 * size);
        let clamped = |texel: i64| texel.clamp(0, texels - 1) as u32;
        Self {
            cell: cell as u32,
            low: clamped(low),
            high: clamped(low + 1),
            weight: place.rem_euclid(4 * size) as u64,
        }
    }
}
