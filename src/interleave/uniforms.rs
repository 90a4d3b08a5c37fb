//! The uniforms of the output passes: `struct Uniforms` of `shaders/common.wgsl`.
#![forbid(unsafe_code)]

use super::Layout;
use super::anaglyph::Matrix;
use super::disparities::Disparities;
use crate::atlas::Tiles;
use crate::config::Filter;

/// The parameters of a pass. Sizes are in pixels, width and height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniforms {
    /// Places of the views in the atlas.
    pub tiles: Tiles,
    /// True when row 0 of the views' texture is the top row of the picture.
    pub rows_top_down: bool,
    /// Size of the output picture.
    pub picture: [u32; 2],
    /// Whole views beside each other; only the layout pass reads it.
    pub layout: Layout,
    /// Colours are fetched and written as linear light.
    pub linear: bool,
    /// Only the passes of a panel read it.
    pub mask: MaskUniforms,
    /// The matrices of the left and the right view; only the anaglyph pass reads them.
    pub matrices: (Matrix, Matrix),
    /// Depth buffer values that are shown white and black; only the RGBD pass reads them.
    pub depth: [f32; 2],
    /// Disparities of the depths; only the passes of synthesis read them.
    pub disparities: Disparities,
}

/// The parameters of a panel's passes that describe the mask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaskUniforms {
    /// How a subpixel between views is filtered; only the interleave pass reads it.
    pub filter: Filter,
    /// Columns and rows after which the mask repeats, at least 1.
    pub period: [u32; 2],
    /// Number of low bits of a tile address that are its column; only the passes of texels read it.
    pub column_bits: u32,
    /// Value of the mask at black subpixels.
    pub black: u32,
}

impl Default for MaskUniforms {
    /// Values for a pass without a mask.
    fn default() -> Self {
        MaskUniforms {
            filter: Filter::Nearest,
            period: [1; 2],
            column_bits: 0,
            black: 0,
        }
    }
}

/// Words in the alignment of WGSL: a vector of two begins at a multiple of two words, one of three or four at a multiple of four.
#[derive(Default)]
struct Words(Vec<u32>);

impl Words {
    fn put<const N: usize>(&mut self, values: [u32; N]) {
        let from = self.0.len().next_multiple_of(N.next_power_of_two());
        self.0.resize(from, 0);
        self.0.extend(values);
    }

    fn put_floats<const N: usize>(&mut self, values: [f32; N]) {
        self.put(values.map(f32::to_bits));
    }
}

impl Uniforms {
    /// The words in the order and alignment of the WGSL struct.
    pub fn words(&self) -> Vec<u32> {
        let (tiles, mask) = (&self.tiles, &self.mask);
        let views = tiles.views.max(1);
        let (columns, rows) = self.layout.grid(tiles.views);
        let mut words = Words(Vec::with_capacity(96));
        words.put([tiles.width, tiles.height]);
        words.put(self.picture);
        words.put([columns, rows]);
        words.put([tiles.stride]);
        words.put([tiles.columns.max(1)]);
        words.put([views]);
        words.put([self.layout.first()]);
        words.put([u32::from(self.rows_top_down)]);
        words.put([u32::from(self.layout.from_top())]);
        words.put([u32::from(self.linear)]);
        words.put([match mask.filter {
            Filter::Nearest => 0,
            Filter::Blend => 1,
            Filter::Gaussian => 2,
        }]);
        words.put(mask.period.map(|p| p.max(1)));
        words.put([mask.column_bits]);
        words.put([mask.black]);
        let (left, right) = self.matrices;
        for [red, green, blue] in left.into_iter().chain(right) {
            words.put_floats([red, green, blue, 0.0]);
        }
        let [white, black] = self.depth;
        words.put_floats([white, black, 0.0, 0.0]);
        // Of the window's pixels; the picture may have others.
        let grid = tiles.grid.resized(tiles.window, self.picture);
        let [[x, y], [step_x, step_y]] = [grid.origin, grid.step];
        words.put_floats([grid.across, grid.shear, x, step_x].map(|v| v as f32));
        words.put_floats([0.0, grid.up, y, step_y].map(|v| v as f32));
        for row in self.disparities.rows(views) {
            words.put_floats(row);
        }
        words.0
    }
}
