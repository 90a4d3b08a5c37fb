//! The picture of a wall on the CPU: the reference for `shaders/wall.wgsl`.
#![forbid(unsafe_code)]

use super::reference::{ReferenceError, Tile, encoded, linear};
use crate::display::{CELL, GUARD, Mask, Node};
use image::{Pixel, Rgb, RgbImage};

/// The sheet of a wall, of the size of its mask: each subpixel is from the view that the mask names, at the place that the nodes give; black beyond the
/// picture. `columns` of nodes. Views are bilinear between texel centres.
pub fn wall<P: Pixel<Subpixel = u8>>(
    tiles: &[Tile<P>],
    mask: &Mask,
    nodes: &[Node],
    columns: u32,
) -> Result<RgbImage, ReferenceError> {
    let mut out = RgbImage::new(mask.width(), mask.height());
    for (row, views) in (0..).zip(mask.rows()) {
        for (x, views) in (0..).zip(views) {
            let [u, v, light] = warped(nodes, columns, [x, row]);
            if !(0.0..=1.0).contains(&u) || !(0.0..=1.0).contains(&v) {
                continue;
            }
            let mut pixel = [0; 3];
            for (channel, &view) in views.iter().enumerate().filter(|(_, view)| **view != GUARD) {
                let tile = tiles.get(usize::from(view)).ok_or(ReferenceError::View {
                    view: view.into(),
                    views: tiles.len(),
                })?;
                let value = (bilinear(tile, [u, v], channel) / 255.0) as f32;
                let value = match light < 1.0 {
                    true => encoded(linear(value) * light),
                    false => value,
                };
                pixel[channel] = (value * 255.0).round() as u8;
            }
            out.put_pixel(x, row, Rgb(pixel));
        }
    }
    Ok(out)
}

/// What a pixel of the sheet shows.
fn warped(nodes: &[Node], columns: u32, at: [u32; 2]) -> Node {
    let place = at.map(|at| (at as f32 + 0.5) / CELL as f32);
    let cell = place.map(|place| place as usize);
    let [across, down] = place.map(f32::fract);
    let node = |right: usize, below: usize| {
        let at = (cell[1] + below) * columns as usize + cell[0] + right;
        nodes.get(at).copied().unwrap_or_default()
    };
    let mix = |a: Node, b: Node, weight: f32| [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * weight);
    let upper = mix(node(0, 0), node(1, 0), across);
    mix(upper, mix(node(0, 1), node(1, 1), across), down)
}

/// A channel of a view at a place, 0 to 1 from its left and top.
fn bilinear<P: Pixel<Subpixel = u8>>(tile: &Tile<P>, place: [f32; 2], channel: usize) -> f64 {
    let size = [tile.width(), tile.height()];
    let texel = |axis: usize| {
        let at = place[axis] * size[axis] as f32 - 0.5;
        at.clamp(0.0, (size[axis] - 1) as f32)
    };
    let at = [texel(0), texel(1)];
    let low = at.map(|at| at as u32);
    let high = [0, 1].map(|axis| (low[axis] + 1).min(size[axis] - 1));
    let [across, down] = at.map(|at| f64::from(at.fract()));
    let value = |x: u32, y: u32| f64::from(tile.get_pixel(x, y).channels()[channel]);
    let along = |y: u32| value(low[0], y) * (1.0 - across) + value(high[0], y) * across;
    along(low[1]) * (1.0 - down) + along(high[1]) * down
}
