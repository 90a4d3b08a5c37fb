//! State that is measured in pixels, for tiles whose pixels are larger than the window's: widths of lines and points, polygon offsets,
//! and the level of detail of textures.

use crate::atlas::Grid;
use crate::gl::{Gl, consts as c};
use crate::state::State;

/// The program's values, which are restored after the draw.
#[derive(Debug, Default)]
pub(super) struct PixelSizeGuard {
    /// GL_LINE_WIDTH and GL_POINT_SIZE.
    widths: Option<[f32; 2]>,
    /// GL_POLYGON_OFFSET_FACTOR, _UNITS and _CLAMP.
    offset: Option<[f32; 3]>,
    /// By texture unit: GL_TEXTURE_LOD_BIAS.
    biases: Vec<(u32, f32)>,
    /// GL_ACTIVE_TEXTURE.
    active: u32,
}

/// Which texture units of fixed function need a bias of the level of detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Units {
    /// None: a generated fragment stage computes the level of detail itself.
    None,
    /// The units that are enabled now.
    Enabled,
    /// All units, because the draw may enable any of them.
    All,
}

/// The most texture units of fixed function that are biased.
const UNITS: u32 = 8;

const TARGETS: [u32; 5] = [
    c::TEXTURE_2D,
    c::TEXTURE_CUBE_MAP,
    c::TEXTURE_3D,
    c::TEXTURE_1D,
    c::TEXTURE_RECTANGLE,
];

impl PixelSizeGuard {
    pub(super) fn enter(gl: &Gl, state: &State, grid: &Grid, units: Units) -> PixelSizeGuard {
        if grid.is_full() {
            return PixelSizeGuard::default();
        }
        let widths = [c::LINE_WIDTH, c::POINT_SIZE].map(|w| gl.get_floats::<1>(w)[0]);
        let [line, point] = widths.map(|width| width / grid.spacing() as f32);
        gl.line_width(line);
        gl.point_size(point);
        let mut pixel_sizes = PixelSizeGuard {
            widths: Some(widths),
            offset: flatten(gl, state, grid),
            ..PixelSizeGuard::default()
        };
        if state.has.compatibility && units != Units::None {
            pixel_sizes.sharpen(gl, grid, units == Units::All);
        }
        pixel_sizes
    }

    fn sharpen(&mut self, gl: &Gl, grid: &Grid, unknown: bool) {
        let bias = grid.level_bias() as f32;
        self.active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        let units = gl.get_integer(c::MAX_TEXTURE_UNITS).max(0) as u32;
        let mut now = self.active;
        for unit in (0..units.min(UNITS)).map(|unit| c::TEXTURE0 + unit) {
            if unit != now {
                gl.active_texture(unit);
                now = unit;
            }
            if unknown || TARGETS.iter().any(|&target| gl.is_enabled(target)) {
                let was = gl.get_tex_env_float(c::TEXTURE_FILTER_CONTROL, c::TEXTURE_LOD_BIAS);
                gl.tex_envf(c::TEXTURE_FILTER_CONTROL, c::TEXTURE_LOD_BIAS, was + bias);
                self.biases.push((unit, was));
            }
        }
        if now != self.active {
            gl.active_texture(self.active);
        }
    }

    pub(super) fn leave(&self, gl: &Gl) {
        if let Some([line, point]) = self.widths {
            gl.line_width(line);
            gl.point_size(point);
        }
        if let Some(offset) = self.offset {
            put_offset(gl, offset);
        }
        for &(unit, was) in &self.biases {
            gl.active_texture(unit);
            gl.tex_envf(c::TEXTURE_FILTER_CONTROL, c::TEXTURE_LOD_BIAS, was);
        }
        if !self.biases.is_empty() {
            gl.active_texture(self.active);
        }
    }
}

/// Divides the factor of a polygon offset by the spacing of texels; returns the program's values. The factor multiplies the change of depth
/// from pixel to pixel, which grows with that spacing. Where the spacing differs between the axes no factor is right for all slopes, so the
/// mean is used.
fn flatten(gl: &Gl, state: &State, grid: &Grid) -> Option<[f32; 3]> {
    if !gl.is_enabled(c::POLYGON_OFFSET_FILL) {
        return None;
    }
    let [factor, units] =
        [c::POLYGON_OFFSET_FACTOR, c::POLYGON_OFFSET_UNITS].map(|name| gl.get_floats::<1>(name)[0]);
    let clamp = match state.has.offset_clamp {
        true => gl.get_floats::<1>(c::POLYGON_OFFSET_CLAMP)[0],
        false => 0.0,
    };
    put_offset(gl, [factor / grid.spacing() as f32, units, clamp]);
    Some([factor, units, clamp])
}

fn put_offset(gl: &Gl, [factor, units, clamp]: [f32; 3]) {
    if clamp == 0.0 {
        gl.polygon_offset(factor, units);
    } else {
        gl.polygon_offset_clamp(factor, units, clamp);
    }
}
