//! Current values (colour, normal, texture coordinates, material), which are restored between two replays of the same immediate-mode calls.

use crate::gl::{Gl, consts as c};
use crate::state::Effect;

/// The current values that a sequence of calls starts from.
///
/// They are restored by the calls that set them, not by glPopAttrib. Measured on Mesa 22.3: after glPopAttrib, a first point that takes its
/// colour from before glBegin got the last colour of the sequence.
#[derive(Debug, Default)]
pub struct Current {
    color: Option<[f32; 4]>,
    normal: Option<[f32; 3]>,
    texture: Vec<[f32; 4]>,
    secondary: Option<[f32; 4]>,
    fog: Option<f32>,
    edge: Option<bool>,
    material: Vec<(u32, u32, [f32; 4])>,
    /// The material follows the colour (GL_COLOR_MATERIAL), and may be out of date.
    follows: bool,
}

const PARAMETERS: [u32; 5] = [
    c::AMBIENT,
    c::DIFFUSE,
    c::SPECULAR,
    c::EMISSION,
    c::SHININESS,
];

impl Current {
    /// Reads the values of some kinds from the driver. `popped`: something other than immediate-mode calls may change them
    /// before they are restored, such as a glPopAttrib.
    pub fn take(gl: &Gl, kinds: Effect, popped: bool) -> Current {
        let mut current = Current::default();
        // It is not known which values an evaluator sets.
        let kinds = if kinds.has(Effect::UNKNOWN) {
            Effect::ALL
        } else {
            kinds
        };
        if kinds.has(Effect::COLOR) {
            current.color = Some(gl.get_floats(c::CURRENT_COLOR));
            current.follows = popped && gl.is_enabled(c::COLOR_MATERIAL);
        }
        if kinds.has(Effect::NORMAL) {
            current.normal = Some(gl.get_floats(c::CURRENT_NORMAL));
        }
        if kinds.has(Effect::SECONDARY) {
            current.secondary = Some(gl.get_floats(c::CURRENT_SECONDARY_COLOR));
        }
        if kinds.has(Effect::FOG) {
            current.fog = Some(gl.get_floats::<1>(c::CURRENT_FOG_COORD)[0]);
        }
        if kinds.has(Effect::EDGE) {
            current.edge = Some(gl.get_integer(c::EDGE_FLAG) != 0);
        }
        if kinds.has(Effect::TEXCOORD) || kinds.has(Effect::MULTITEX) {
            let all = gl.get_integer(c::MAX_TEXTURE_COORDS).clamp(1, 32) as u32;
            let units = if kinds.has(Effect::MULTITEX) { all } else { 1 };
            let coordinates = (0..units).map(|unit| gl.get_coordinates(unit));
            current.texture = coordinates.collect();
        }
        if kinds.has(Effect::MATERIAL) {
            let places = [c::FRONT, c::BACK]
                .into_iter()
                .flat_map(|face| PARAMETERS.map(|name| (face, name)));
            // What follows the colour now may not do so when it is restored after a glPopAttrib.
            let material = places
                .filter(|&(face, name)| popped || !gl.follows_colour(face, name))
                .map(|(face, name)| (face, name, gl.get_material(face, name)));
            current.material = material.collect();
        }
        current
    }

    /// Restores the values.
    pub fn put(&self, gl: &Gl) {
        for (face, name, v) in &self.material {
            gl.material(*face, *name, v);
        }
        if let Some([r, g, b, a]) = self.color {
            gl.color_4f(r, g, b, a);
        }
        if self.follows {
            // Mesa 22.3 leaves the material at the last colour of the earlier calls; enabling takes the current colour anew.
            gl.disable(c::COLOR_MATERIAL);
            gl.enable(c::COLOR_MATERIAL);
        }
        if let Some([x, y, z]) = self.normal {
            gl.normal_3f(x, y, z);
        }
        if let Some([r, g, b, _]) = self.secondary {
            gl.secondary_color_3f(r, g, b);
        }
        if let Some(f) = self.fog {
            gl.fog_coordf(f);
        }
        if let Some(e) = self.edge {
            gl.edge_flag(e.into());
        }
        for (unit, [s, t, r, q]) in (0u32..).zip(self.texture.iter().copied()) {
            gl.multi_tex_coord_4f(c::TEXTURE0 + unit, s, t, r, q);
        }
    }
}
