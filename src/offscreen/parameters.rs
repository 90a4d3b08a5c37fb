//! The texture parameters that affect sampling, which the textures of the views have from the program's texture.

use crate::gl::{Gl, TextureName, consts as c};
use crate::view::ViewIndex;

/// Those that exist in every context.
const ALWAYS: [u32; 11] = [
    c::TEXTURE_MIN_FILTER,
    c::TEXTURE_MAG_FILTER,
    c::TEXTURE_WRAP_S,
    c::TEXTURE_WRAP_T,
    c::TEXTURE_WRAP_R,
    c::TEXTURE_BASE_LEVEL,
    c::TEXTURE_MAX_LEVEL,
    c::TEXTURE_MIN_LOD,
    c::TEXTURE_MAX_LOD,
    c::TEXTURE_COMPARE_MODE,
    c::TEXTURE_COMPARE_FUNC,
];
/// Further parameters of OpenGL 3.3 and OpenGL ES 3.0.
const SWIZZLES: [u32; 4] = [
    c::TEXTURE_SWIZZLE_R,
    c::TEXTURE_SWIZZLE_G,
    c::TEXTURE_SWIZZLE_B,
    c::TEXTURE_SWIZZLE_A,
];
/// Further parameters of contexts with fixed function.
const OLD: [u32; 2] = [c::GENERATE_MIPMAP, c::DEPTH_TEXTURE_MODE];

/// The parameters that a context has.
#[derive(Clone, Debug)]
pub(super) struct ParameterNames {
    /// Of one value.
    single: Vec<u32>,
    /// Textures have border colours.
    borders: bool,
}

impl ParameterNames {
    /// Asks the current context; `compatibility`: it has fixed function.
    pub(super) fn of(gl: &Gl, compatibility: bool) -> ParameterNames {
        let mut single = ALWAYS.to_vec();
        if gl.since((3, 3), Some((3, 0))) {
            single.extend(SWIZZLES);
        }
        if compatibility {
            single.extend(OLD);
        }
        if gl.since((1, 4), None) {
            single.push(c::TEXTURE_LOD_BIAS);
        }
        if gl.since((4, 3), Some((3, 1))) {
            single.push(c::DEPTH_STENCIL_TEXTURE_MODE);
        }
        if gl.has_extension("GL_EXT_texture_filter_anisotropic") || gl.since((4, 6), None) {
            single.push(c::TEXTURE_MAX_ANISOTROPY);
        }
        ParameterNames {
            single,
            borders: gl.since((1, 0), Some((3, 2))),
        }
    }

    /// The values of the texture that is bound at a target.
    pub(super) fn values(&self, gl: &Gl, target: u32) -> Values {
        let all = self.single.iter();
        let single = all.map(|&name| (name, gl.tex_parameter_floats(target, name)[0]));
        Values {
            single: single.collect(),
            border: self
                .borders
                .then(|| gl.tex_parameter_floats(target, c::TEXTURE_BORDER_COLOR)),
        }
    }
}

/// Values of parameters.
#[derive(Clone, Debug)]
pub(super) struct Values {
    /// Name and value.
    single: Vec<(u32, f32)>,
    border: Option<[f32; 4]>,
}

impl Values {
    /// Sets them for the texture that is bound at a target.
    pub(super) fn set(&self, gl: &Gl, target: u32) {
        for &(name, value) in &self.single {
            gl.tex_parameterf(target, name, value);
        }
        if let Some(border) = &self.border {
            gl.set_border_color(target, border);
        }
    }
}

/// The parameters of a split texture.
#[derive(Debug)]
pub(super) struct Parameters {
    /// Those of the program's texture, once the driver was asked for them.
    values: Option<Values>,
    /// By view: its texture has them.
    copied: Vec<bool>,
}

impl Parameters {
    pub(super) fn new(views: usize) -> Parameters {
        Parameters {
            values: None,
            copied: vec![false; views],
        }
    }

    /// The program sets a parameter of its texture; `set` is its name and value, if it is a single number. Where it has that value already,
    /// nothing changes: programs set the same ones again in each frame. Returns whether something may have changed.
    pub(super) fn change(&mut self, set: Option<(u32, f32)>) -> bool {
        let known = self.values.as_ref();
        let same = |set: (u32, f32)| known.is_some_and(|values| values.single.contains(&set));
        if set.is_some_and(same) {
            return false;
        }
        self.values = None;
        self.copied.fill(false);
        true
    }

    /// Gives a view's texture those of the program's own, if it does not have them. Leaves either bound at the target.
    pub(super) fn give(
        &mut self,
        gl: &Gl,
        names: &ParameterNames,
        target: u32,
        (own, view): (TextureName, ViewIndex),
        name: TextureName,
    ) {
        let Some(copied) = self.copied.get_mut(view.0 as usize) else {
            return;
        };
        if *copied {
            return;
        }
        let values = self.values.get_or_insert_with(|| {
            gl.bind_texture(target, own);
            names.values(gl, target)
        });
        gl.bind_texture(target, name);
        values.set(gl, target);
        *copied = true;
    }
}
