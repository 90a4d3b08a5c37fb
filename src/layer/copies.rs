//! Textures copied from the frame: each view has its own copy, and is drawn with it.
//!
//! Motion blur, water, heat: the program copies what it has drawn into a texture and draws that over the scene again. The texture
//! itself holds the program's own view; for the others there are textures beside it, bound for the time of their draws.

use super::{Layer, keep_bindings};
use crate::gl::{Gl, consts as c};
use crate::plan::{Method, Plan, Reason};
use std::collections::HashMap;

/// The copies of a context, by the program's texture.
#[derive(Debug)]
pub(super) struct Copies {
    textures: HashMap<u32, Copy>,
    /// Textures of the context can make their mipmaps by themselves, as those of fixed function do.
    mipmaps: bool,
    /// Texture units of the context that are looked at.
    units: u32,
}

/// One texture per view, the program's own texture for its own view.
#[derive(Debug)]
struct Copy {
    target: u32,
    views: Vec<u32>,
}

/// A texture with copies that is bound now.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    unit: u32,
    texture: u32,
}

/// Texture targets that frames are copied to, with the names of their bindings.
const TARGETS: [(u32, u32); 3] = [
    (c::TEXTURE_2D, c::TEXTURE_BINDING_2D),
    (c::TEXTURE_RECTANGLE, c::TEXTURE_BINDING_RECTANGLE),
    (c::TEXTURE_1D, c::TEXTURE_BINDING_1D),
];

/// What a copy looks like beside its image.
const PARAMETERS: [u32; 7] = [
    c::TEXTURE_MIN_FILTER,
    c::TEXTURE_MAG_FILTER,
    c::TEXTURE_WRAP_S,
    c::TEXTURE_WRAP_T,
    c::TEXTURE_WRAP_R,
    c::TEXTURE_BASE_LEVEL,
    c::TEXTURE_MAX_LEVEL,
];

fn binding(target: u32) -> Option<u32> {
    let known = TARGETS.iter().find(|t| t.0 == target);
    known.map(|t| t.1)
}

impl Copies {
    /// For a context with or without fixed function.
    pub(super) fn new(gl: &Gl, compatibility: bool) -> Copies {
        let units = gl.get_integer(c::MAX_COMBINED_TEXTURE_IMAGE_UNITS);
        Copies {
            textures: HashMap::new(),
            mipmaps: compatibility,
            units: units.clamp(1, 32) as u32,
        }
    }

    fn parameters(&self) -> impl Iterator<Item = u32> {
        let mipmaps = self.mipmaps.then_some(c::GENERATE_MIPMAP);
        PARAMETERS.into_iter().chain(mipmaps)
    }

    fn look(&self, gl: &Gl, target: u32) -> Vec<i32> {
        let all = self.parameters();
        all.map(|p| gl.get_tex_parameter(target, p)).collect()
    }

    fn set_look(&self, gl: &Gl, target: u32, look: &[i32]) {
        for (name, &value) in self.parameters().zip(look) {
            gl.tex_parameteri(target, name, value);
        }
    }

    /// Whether a texture is one of ours.
    pub(super) fn owns(&self, name: u32) -> bool {
        self.textures
            .iter()
            .any(|(own, copy)| *own != name && copy.views.contains(&name))
    }

    /// The textures with copies that are bound, by unit.
    pub(super) fn bound(&self, gl: &Gl) -> Vec<Bound> {
        if self.textures.is_empty() {
            return Vec::new();
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        let mut bound = Vec::new();
        for unit in (0..self.units).map(|u| c::TEXTURE0 + u) {
            gl.active_texture(unit);
            for (target, binding) in TARGETS {
                let texture = gl.get_integer(binding) as u32;
                if self
                    .textures
                    .get(&texture)
                    .is_some_and(|c| c.target == target)
                {
                    bound.push(Bound { unit, texture });
                }
            }
        }
        gl.active_texture(active);
        bound
    }

    /// Binds a view's copies.
    pub(super) fn bind(&self, gl: &Gl, bound: &[Bound], view: u32) {
        if bound.is_empty() {
            return;
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        for b in bound {
            let Some(copy) = self.textures.get(&b.texture) else {
                continue;
            };
            let Some(&name) = copy.views.get(view as usize) else {
                continue;
            };
            gl.active_texture(b.unit);
            gl.bind_texture(copy.target, b.texture);
            let parameters = self.look(gl, copy.target);
            gl.bind_texture(copy.target, name);
            if name != b.texture {
                self.set_look(gl, copy.target, &parameters);
            }
        }
        gl.active_texture(active);
    }

    /// The copies of textures are no longer what the program believes, or their textures are gone.
    pub(super) fn forget(&mut self, gl: &Gl, textures: &[u32]) {
        for texture in textures {
            if let Some(copy) = self.textures.remove(texture) {
                let ours = copy.views.into_iter().filter(|v| v != texture);
                ours.for_each(|v| gl.delete_texture(v));
            }
        }
    }

    /// The textures that are ours.
    pub(super) fn ours(&self) -> impl Iterator<Item = u32> {
        self.textures.iter().flat_map(|(texture, copy)| {
            let views = copy.views.iter().copied();
            views.filter(move |v| v != texture)
        })
    }

    /// All of them.
    pub(super) fn clear(&mut self, gl: &Gl) {
        let all: Vec<u32> = self.textures.keys().copied().collect();
        self.forget(gl, &all);
    }
}

impl Layer {
    /// glCopyTexImage* and glCopyTexSubImage*: from each view into its own texture. Columns in pixels.
    pub fn copy_texture(
        &mut self,
        gl: &Gl,
        target: u32,
        x: i32,
        width: i32,
        call: &mut dyn FnMut(),
    ) {
        if self.compiles() || self.state.framebuffers.read != 0 {
            return self.read(gl, x, width, call);
        }
        let texture = binding(target).map_or(0, |b| gl.get_integer(b) as u32);
        if texture == 0 || self.config.views < 2 {
            return self.read(gl, x, width, call);
        }
        self.part(gl);
        if !self.copies.textures.contains_key(&texture) {
            self.make_copies(gl, target, texture);
        }
        self.state.keep_errors(gl);
        self.read(gl, x, width, call);
        if self.state.keep_errors(gl) {
            return; // a wrong call is as wrong in the other views
        }
        self.state.refresh(gl);
        let own = self.atlas.tiles.own();
        let views = match self.copies.textures.get(&texture) {
            Some(copy) => copy.views.clone(),
            None => return,
        };
        let parameters = self.copies.look(gl, target);
        for (view, name) in (0..).zip(views) {
            if view != own {
                self.take_single(gl, view);
                gl.bind_texture(target, name);
                self.copies.set_look(gl, target, &parameters);
                call();
            }
        }
        gl.bind_texture(target, texture);
        self.drain_own_errors(gl);
        let f = &self.state.framebuffers;
        let draw = match f.draw {
            0 => self.atlas.framebuffer(),
            other => other,
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, draw);
        self.bind_draw(gl, true, true);
    }

    /// Textures like the program's, with its image, for the other views.
    fn make_copies(&mut self, gl: &Gl, target: u32, texture: u32) {
        let own = self.atlas.tiles.own();
        let level = |name| gl.get_tex_level_parameter(target, 0, name);
        let size = [level(c::TEXTURE_WIDTH), level(c::TEXTURE_HEIGHT)];
        let internal = level(c::TEXTURE_INTERNAL_FORMAT) as u32;
        let depth = level(c::TEXTURE_DEPTH_SIZE) > 0;
        let copies_images = self.support.version >= (4, 3);
        self.state.keep_errors(gl);
        // An image is copied between complete textures only.
        let filter = gl.get_tex_parameter(target, c::TEXTURE_MIN_FILTER);
        let simple = || gl.tex_parameteri(target, c::TEXTURE_MIN_FILTER, c::NEAREST as i32);
        simple();
        let names = &mut self.names;
        let views = (0..self.config.views).map(|view| {
            if view == own {
                return texture;
            }
            let name = names.texture(gl);
            gl.bind_texture(target, name);
            simple();
            // A part of an image that is there; else the program's own call makes it.
            if size[0] > 0 && target != c::TEXTURE_1D {
                gl.tex_image_2d_empty(target, internal, size[0], size[1], depth);
                if copies_images {
                    gl.copy_image(target, texture, name, [size[0], size[1], 1]);
                }
            }
            name
        });
        let views = keep_bindings(gl, || views.collect());
        gl.bind_texture(target, texture);
        gl.tex_parameteri(target, c::TEXTURE_MIN_FILTER, filter);
        self.drain_own_errors(gl);
        self.copies.textures.insert(texture, Copy { target, views });
    }

    /// The program changes the image of the texture that is bound: all views see the same again.
    pub fn texture_written(&mut self, gl: &Gl, target: u32) {
        if let Some(binding) = binding(target) {
            let texture = gl.get_integer(binding) as u32;
            self.copies.forget(gl, &[texture]);
        }
    }

    /// glDeleteTextures.
    pub fn deleted_textures(&mut self, gl: &Gl, textures: &[u32]) {
        self.copies.forget(gl, textures);
    }

    /// Whether any texture was copied from the frame.
    pub fn has_copies(&self) -> bool {
        !self.copies.textures.is_empty()
    }

    /// A draw with such a texture is replayed: one draw for all views would see one texture.
    pub(super) fn uncopied(&self, gl: &Gl, plan: Plan) -> Plan {
        match plan.method {
            Method::Instanced | Method::Geometry if !self.copies.bound(gl).is_empty() => Plan {
                method: Method::Replay,
                reason: Some(Reason::Kind("draws with a texture copied from the frame")),
                ..plan
            },
            _ => plan,
        }
    }
}
