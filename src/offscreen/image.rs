//! A texture or renderbuffer of the program's, and those like it for the views.
//!
//! What is drawn to has its views in the layers of one array, so that all of them can be drawn to without another framebuffer being bound,
//! and is sampled through a texture for each layer (glTextureView). The program's own object then gets what its view has where something
//! else than drawing reads it. Where that is not to be had there is an object like the program's for each other view.

use crate::atlas::{Names, Tiles};
use crate::gl::{Gl, Level, Object, consts as c, is_multisampled};

/// One image per view.
#[derive(Debug)]
pub(super) struct Image {
    /// The target of the textures; GL_RENDERBUFFER.
    pub(super) target: u32,
    /// By view; without an array the program's own object is that of its own view.
    pub(super) views: Vec<u32>,
    /// The array of which the views are layers.
    pub(super) array: Option<Array>,
    /// The program's own object lacks what was drawn since.
    pub(super) stale: bool,
    /// Up to which change of parameters each texture has those of the program's.
    looks: Vec<u64>,
}

/// The layers of an image.
#[derive(Clone, Debug)]
pub(super) struct Array {
    /// The array texture.
    pub(super) name: u32,
    /// Of one layer, by level.
    levels: Vec<Level>,
}

/// What of the context decides how images are made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Means {
    pub(super) version: (u32, u32),
    /// Textures can make their mipmaps by themselves, as those of fixed function do.
    pub(super) mipmaps: bool,
    /// Changes of parameters so far.
    pub(super) looks: u64,
    /// Layers of an array can be textures of their own.
    pub(super) arrays: bool,
}

/// Texture targets with the names of their bindings.
pub(super) const TARGETS: [(u32, u32); 9] = [
    (c::TEXTURE_2D, c::TEXTURE_BINDING_2D),
    (c::TEXTURE_RECTANGLE, c::TEXTURE_BINDING_RECTANGLE),
    (c::TEXTURE_1D, c::TEXTURE_BINDING_1D),
    (c::TEXTURE_2D_MULTISAMPLE, c::TEXTURE_BINDING_2D_MULTISAMPLE),
    (c::TEXTURE_CUBE_MAP, c::TEXTURE_BINDING_CUBE_MAP),
    (c::TEXTURE_2D_ARRAY, c::TEXTURE_BINDING_2D_ARRAY),
    (c::TEXTURE_3D, c::TEXTURE_BINDING_3D),
    (
        c::TEXTURE_2D_MULTISAMPLE_ARRAY,
        c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
    ),
    (c::TEXTURE_CUBE_MAP_ARRAY, c::TEXTURE_BINDING_CUBE_MAP_ARRAY),
];

/// What a texture looks like beside its image.
const PARAMETERS: [u32; 12] = [
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
    c::GENERATE_MIPMAP,
];

/// The name of the binding of a target.
pub(super) fn binding(target: u32) -> Option<u32> {
    let target = match target {
        c::TEXTURE_CUBE_MAP_POSITIVE_X..=c::TEXTURE_CUBE_MAP_NEGATIVE_Z => c::TEXTURE_CUBE_MAP,
        other => other,
    };
    let known = TARGETS.iter().find(|t| t.0 == target);
    known.map(|t| t.1)
}

/// Runs with a texture bound at its target, which is tried out; none where it has none that is known. The caller keeps errors.
pub(super) fn with_texture<R>(gl: &Gl, name: u32, work: impl FnOnce(u32) -> R) -> Option<R> {
    for (target, binding) in TARGETS {
        let before = gl.get_integer(binding) as u32;
        if before != name {
            gl.bind_texture(target, name);
        }
        if gl.get_error() == c::NO_ERROR && gl.get_integer(binding) as u32 == name {
            let done = work(target);
            gl.bind_texture(target, before);
            return Some(done);
        }
    }
    None
}

impl Image {
    /// The names of ours that are of the program's kind of object.
    pub(super) fn others(&self, own: u32) -> impl Iterator<Item = u32> + use<> {
        let views = self.views.clone();
        let array = self.array.is_some();
        views.into_iter().filter(move |&name| array || name != own)
    }

    /// Gives the program's own object what its view has.
    pub(super) fn settle(&mut self, gl: &Gl, object: Object, own_layer: u32) {
        let Some(array) = self.array.as_ref().filter(|_| self.stale) else {
            return;
        };
        let (to, kind) = match object {
            Object::Texture(name) => (name, self.target),
            Object::Renderbuffer(name) => (name, c::RENDERBUFFER),
        };
        let first = array.levels.first();
        let (_, layered) = first.map_or((c::NONE, c::TEXTURE_2D_ARRAY), Level::layered);
        for (at, level) in (0..).zip(&array.levels) {
            let [w, h, _] = level.size;
            let from = (array.name, layered, own_layer);
            gl.copy_layer(from, (to, kind, 0), at, [w, h]);
        }
        self.stale = false;
    }

    /// Binds a view's texture at the active unit, where the program's own is bound or another view's.
    pub(super) fn bind(&mut self, gl: &Gl, means: &Means, own: u32, view: u32) {
        let at = view as usize;
        let (Some(&name), Some(look)) = (self.views.get(at), self.looks.get_mut(at)) else {
            return;
        };
        if name != own && *look != means.looks && !is_multisampled(self.target) {
            gl.bind_texture(self.target, own);
            let (values, border) = means.look(gl, self.target);
            gl.bind_texture(self.target, name);
            means.set_look(gl, self.target, &values, &border);
            *look = means.looks;
        }
        gl.bind_texture(self.target, name);
    }
}

impl Means {
    fn parameters(&self) -> impl Iterator<Item = u32> {
        let mipmaps = self.mipmaps;
        PARAMETERS
            .into_iter()
            .filter(move |&p| p != c::GENERATE_MIPMAP || mipmaps)
    }

    fn look(&self, gl: &Gl, target: u32) -> (Vec<i32>, [f32; 4]) {
        let values = self.parameters().map(|p| gl.get_tex_parameter(target, p));
        (values.collect(), gl.border_color(target))
    }

    fn set_look(&self, gl: &Gl, target: u32, values: &[i32], border: &[f32; 4]) {
        for (name, &value) in self.parameters().zip(values) {
            gl.tex_parameteri(target, name, value);
        }
        gl.set_border_color(target, border);
    }

    /// Textures like the program's, which is bound, with what is in it.
    pub(super) fn texture(
        &self,
        gl: &Gl,
        names: &mut Names,
        (target, texture): (u32, u32),
        tiles: &Tiles,
    ) -> Option<Image> {
        binding(target)?;
        let samples = is_multisampled(target);
        let levels: Vec<_> = (0..16)
            .map_while(|at| gl.tex_level(target, at))
            .take(if samples { 1 } else { 16 })
            .collect();
        // An image is copied between complete textures only.
        let filter = match samples {
            true => None,
            false => Some(gl.get_tex_parameter(target, c::TEXTURE_MIN_FILTER)),
        };
        let simple = |filter: i32| {
            if !samples {
                gl.tex_parameteri(target, c::TEXTURE_MIN_FILTER, filter);
            }
        };
        simple(c::NEAREST as i32);
        let views = (0..tiles.views).map(|view| {
            if view == tiles.own() {
                return texture;
            }
            let name = names.texture(gl);
            gl.bind_texture(target, name);
            simple(c::NEAREST as i32);
            for (at, level) in (0..).zip(&levels) {
                gl.tex_level_empty(target, at, level);
                if self.version >= (4, 3) {
                    let [w, h, d] = level.size;
                    let layers = if target == c::TEXTURE_CUBE_MAP { 6 } else { d };
                    gl.copy_image(target, at, texture, name, [w, h, layers.max(1)]);
                }
            }
            name
        });
        let views: Vec<u32> = views.collect();
        gl.bind_texture(target, texture);
        if let Some(filter) = filter {
            simple(filter);
        }
        Some(Image {
            target,
            looks: vec![0; views.len()],
            views,
            array: None,
            stale: false,
        })
    }

    /// Layers like the program's texture, which is bound at GL_TEXTURE_2D or its multisampled kin, with what is in it.
    pub(super) fn texture_layers(
        &self,
        gl: &Gl,
        (target, texture): (u32, u32),
        tiles: &Tiles,
    ) -> Option<Image> {
        let samples = is_multisampled(target);
        let first = gl.tex_level(target, 0)?;
        if first.layered().0 != target {
            return None;
        }
        let mut levels = vec![first];
        if !samples {
            let filter = gl.get_tex_parameter(target, c::TEXTURE_MIN_FILTER) as u32;
            let all = (1..16).map_while(|at| gl.tex_level(target, at));
            levels.extend(all);
            // Those that are still to be made.
            if levels.len() == 1
                && (c::NEAREST_MIPMAP_NEAREST..=c::LINEAR_MIPMAP_LINEAR).contains(&filter)
            {
                let mut level = first;
                while level.size[0].max(level.size[1]) > 1 {
                    level.size = level.size.map(|side| (side / 2).max(1));
                    levels.push(level);
                }
            }
        }
        self.layers(gl, Object::Texture(texture), target, levels, tiles)
    }

    /// Layers like the program's renderbuffer, with what is in it.
    pub(super) fn renderbuffer_layers(&self, gl: &Gl, name: u32, tiles: &Tiles) -> Option<Image> {
        let before = gl.get_integer(c::RENDERBUFFER_BINDING) as u32;
        gl.bind_renderbuffer(name);
        let level = Level::of_renderbuffer(gl.renderbuffer_storage());
        gl.bind_renderbuffer(before);
        self.layers(
            gl,
            Object::Renderbuffer(name),
            c::RENDERBUFFER,
            vec![level],
            tiles,
        )
    }

    fn layers(
        &self,
        gl: &Gl,
        own: Object,
        kind: u32,
        levels: Vec<Level>,
        tiles: &Tiles,
    ) -> Option<Image> {
        let first = *levels.first()?;
        let internal = first.sized().filter(|_| self.arrays)?;
        let (plane, layered) = first.layered();
        let count = levels.len() as i32;
        let binding = binding(layered)?;
        let before = gl.get_integer(binding) as u32;
        let array = gl.gen_texture();
        gl.bind_texture(layered, array);
        gl.tex_storage_layers(layered, count, internal, tiles.views, &first);
        if plane == c::TEXTURE_2D {
            gl.tex_parameteri(layered, c::TEXTURE_MIN_FILTER, c::NEAREST as i32);
        }
        gl.bind_texture(layered, before);
        let views: Vec<u32> = (0..tiles.views)
            .map(|view| gl.texture_view(plane, array, internal, count, tiles.slot(view)))
            .collect();
        let own = match own {
            Object::Texture(name) | Object::Renderbuffer(name) => name,
        };
        for (at, level) in (0..).zip(&levels) {
            let [w, h, _] = level.size;
            if at > 0 && kind != c::RENDERBUFFER && gl.tex_level(kind, at).is_none() {
                break;
            }
            for layer in 0..tiles.views {
                gl.copy_layer((own, kind, 0), (array, layered, layer), at, [w, h]);
            }
        }
        let image = Image {
            target: plane,
            looks: vec![0; views.len()],
            views,
            array: Some(Array {
                name: array,
                levels,
            }),
            stale: false,
        };
        if gl.get_error() != c::NO_ERROR {
            image.others(own).for_each(|name| gl.delete_texture(name));
            gl.delete_texture(array);
            return None;
        }
        Some(image)
    }

    /// Renderbuffers like the program's, with what is in it.
    pub(super) fn renderbuffer(&self, gl: &Gl, name: u32, tiles: &Tiles) -> Image {
        let before = gl.get_integer(c::RENDERBUFFER_BINDING) as u32;
        gl.bind_renderbuffer(name);
        let storage = gl.renderbuffer_storage();
        let views = (0..tiles.views).map(|view| {
            if view == tiles.own() {
                return name;
            }
            let new = gl.renderbuffer(storage);
            if self.version >= (4, 3) {
                gl.copy_image(c::RENDERBUFFER, 0, name, new, [storage[1], storage[2], 1]);
            }
            new
        });
        let views: Vec<u32> = views.collect();
        gl.bind_renderbuffer(before);
        Image {
            target: c::RENDERBUFFER,
            looks: vec![0; views.len()],
            views,
            array: None,
            stale: false,
        }
    }
}
