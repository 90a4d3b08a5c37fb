//! A split texture or renderbuffer: the program's object and the images of the views.
//!
//! An object that is drawn to has its views in the layers of one array, so that one framebuffer serves them all. It is sampled through a
//! texture for each layer (glTextureView). The program's own object gets the image of its view where something other than a draw reads it.
//! Where such an array cannot be had, each other view has an object like the program's.

use super::fill::{Layer, copy_layer, fill};
use super::parameters::{ParameterNames, Parameters};
use crate::atlas::{Names, Tiles};
use crate::gl::{
    Gl, Level, Object, RenderbufferName, TextureName, consts as c, is_multisampled, texture_binding,
};
use crate::view::ViewIndex;

/// A split object: one image per view.
#[derive(Debug)]
pub(super) struct Image {
    /// The target of the textures, or GL_RENDERBUFFER.
    pub(super) target: u32,
    /// The objects by view; without an array, the program's own object is the one of the own view.
    pub(super) views: Vec<Object>,
    /// The array whose layers are the views, if there is one.
    pub(super) array: Option<Array>,
    /// The program's own object is out of date.
    pub(super) stale: bool,
    /// Of the textures.
    pub(super) parameters: Parameters,
}

/// The layers of an image.
#[derive(Clone, Debug)]
pub(super) struct Array {
    /// The array texture.
    pub(super) name: TextureName,
    /// The mipmap levels of one layer.
    levels: Vec<Level>,
}

/// The features of a context that decide how images are made.
#[derive(Clone, Debug)]
pub(super) struct ImageSupport {
    parameters: ParameterNames,
    /// A layer of an array can be a texture of its own (glTextureView).
    pub(super) arrays: bool,
    /// The driver tells the target of a texture.
    pub(super) targets: bool,
}

/// Texture targets.
pub(super) const TARGETS: [u32; 9] = [
    c::TEXTURE_2D,
    c::TEXTURE_RECTANGLE,
    c::TEXTURE_1D,
    c::TEXTURE_2D_MULTISAMPLE,
    c::TEXTURE_CUBE_MAP,
    c::TEXTURE_2D_ARRAY,
    c::TEXTURE_3D,
    c::TEXTURE_2D_MULTISAMPLE_ARRAY,
    c::TEXTURE_CUBE_MAP_ARRAY,
];

/// Whether fixed function samples textures of a target, where that is enabled.
pub(super) fn is_of_fixed_function(target: u32) -> bool {
    [
        c::TEXTURE_1D,
        c::TEXTURE_2D,
        c::TEXTURE_3D,
        c::TEXTURE_CUBE_MAP,
        c::TEXTURE_RECTANGLE,
    ]
    .contains(&target)
}

/// The name of the binding of one of [`TARGETS`].
pub(super) fn binding(target: u32) -> Option<u32> {
    let target = match target {
        c::TEXTURE_CUBE_MAP_POSITIVE_X..=c::TEXTURE_CUBE_MAP_NEGATIVE_Z => c::TEXTURE_CUBE_MAP,
        other => other,
    };
    texture_binding(target).filter(|_| TARGETS.contains(&target))
}

/// Targets that OpenGL ES does not have.
const DESKTOP: [u32; 2] = [c::TEXTURE_RECTANGLE, c::TEXTURE_1D];

/// The target of a texture that the program has bound in no context of ours, found by trying all targets. The caller preserves errors.
fn tried_target(gl: &Gl, name: TextureName) -> Option<u32> {
    let targets = TARGETS.into_iter();
    let mut targets = targets.filter(|target| !(gl.is_es() && DESKTOP.contains(target)));
    targets.find(|&target| {
        let Some(binding) = binding(target) else {
            return false;
        };
        let before = TextureName(gl.get_integer(binding) as u32);
        if before != name {
            gl.bind_texture(target, name);
        }
        let bound = TextureName(gl.get_integer(binding) as u32) == name;
        let fits = gl.get_error() == c::NO_ERROR && bound;
        if fits && before != name {
            gl.bind_texture(target, before);
        }
        fits
    })
}

/// Runs `work` with a texture bound at its target, where that is one of [`TARGETS`]; `target` is none where it is not known. The caller
/// preserves errors.
pub(super) fn with_texture<R>(
    gl: &Gl,
    name: TextureName,
    target: Option<u32>,
    work: impl FnOnce(u32) -> R,
) -> Option<R> {
    let target = target.or_else(|| tried_target(gl, name))?;
    let before = TextureName(gl.get_integer(binding(target)?) as u32);
    if before != name {
        gl.bind_texture(target, name);
    }
    let done = work(target);
    gl.bind_texture(target, before);
    Some(done)
}

/// Runs `work` with the minification filter of the bound texture at GL_NEAREST, so that each level is complete by itself: images can be
/// copied between complete textures only.
fn complete<R>(gl: &Gl, target: u32, work: impl FnOnce() -> R) -> R {
    if is_multisampled(target) {
        return work();
    }
    let filter = gl.get_tex_parameter(target, c::TEXTURE_MIN_FILTER);
    gl.tex_parameteri(target, c::TEXTURE_MIN_FILTER, c::NEAREST as i32);
    let done = work();
    gl.tex_parameteri(target, c::TEXTURE_MIN_FILTER, filter);
    done
}

impl Image {
    fn new(target: u32, views: Vec<Object>, array: Option<Array>) -> Image {
        Image {
            target,
            parameters: Parameters::new(views.len()),
            views,
            array,
            stale: false,
        }
    }

    /// The objects of the views that belong to the layer.
    pub(super) fn others(&self, own: Object) -> impl Iterator<Item = Object> + use<> {
        let views = self.views.clone();
        let array = self.array.is_some();
        views.into_iter().filter(move |&name| array || name != own)
    }

    /// Copies the image of the own view to the program's object, if that is out of date.
    pub(super) fn write_back(&mut self, gl: &Gl, object: Object, own_layer: u32) {
        let Some(array) = self.array.as_ref().filter(|_| self.stale) else {
            return;
        };
        let kind = match object {
            Object::Texture(_) => self.target,
            Object::Renderbuffer(_) => c::RENDERBUFFER,
        };
        let first = array.levels.first();
        let (_, layered) = first.map_or((c::NONE, c::TEXTURE_2D_ARRAY), Level::layered);
        let copy = || {
            for (at, level) in (0..).zip(&array.levels) {
                if kind != c::RENDERBUFFER && gl.tex_level(kind, at) != Some(*level) {
                    break; // never made by the program
                }
                let from = Layer {
                    object: Object::Texture(array.name),
                    target: layered,
                    layer: own_layer,
                };
                let to = Layer {
                    object,
                    target: kind,
                    layer: 0,
                };
                copy_layer(gl, [from, to], at, level);
            }
        };
        match object {
            Object::Texture(name) => {
                let before = binding(kind).map_or(0, |b| gl.get_integer(b) as u32);
                let before = TextureName(before);
                gl.bind_texture(kind, name);
                complete(gl, kind, copy);
                gl.bind_texture(kind, before);
            }
            Object::Renderbuffer(_) => copy(),
        }
        self.stale = false;
    }

    /// Binds a view's texture at the active unit, in place of the program's own or another view's.
    pub(super) fn bind(
        &mut self,
        gl: &Gl,
        support: &ImageSupport,
        (own, view): (TextureName, ViewIndex),
    ) {
        let Some(&Object::Texture(name)) = self.views.get(view.0 as usize) else {
            return;
        };
        if name != own && !is_multisampled(self.target) {
            let (names, target) = (&support.parameters, self.target);
            self.parameters.give(gl, names, target, (own, view), name);
        }
        gl.bind_texture(self.target, name);
    }
}

impl ImageSupport {
    /// Asks the current context; `compatibility`: it has fixed function.
    pub(super) fn of(gl: &Gl, compatibility: bool) -> ImageSupport {
        ImageSupport {
            parameters: ParameterNames::of(gl, compatibility),
            // On OpenGL ES the layer draws to one layer at a time, so an array has no use.
            arrays: gl.since((4, 3), None),
            // Mesa tells them in core profiles alone.
            targets: gl.since((4, 5), None) && !compatibility,
        }
    }

    /// A texture like the program's for each other view, with its contents. The program's texture is bound.
    pub(super) fn texture(
        &self,
        gl: &Gl,
        names: &mut Names,
        (target, texture): (u32, TextureName),
        tiles: &Tiles,
    ) -> Option<Image> {
        binding(target)?;
        let levels = gl.tex_levels(target);
        let immutable = gl.is_immutable(target);
        let own = Object::Texture(texture);
        let mut like = || {
            let name = names.texture(gl);
            gl.bind_texture(target, name);
            complete(gl, target, || {
                gl.tex_levels_empty(target, &levels, immutable);
                for (at, level) in (0..).zip(&levels) {
                    let objects = (own, Object::Texture(name));
                    fill(gl, target, objects, at, level);
                }
            });
            gl.bind_texture(target, texture);
            Object::Texture(name)
        };
        let views = ViewIndex::all(tiles.views).map(|view| match view == tiles.own() {
            true => own,
            false => like(),
        });
        let views = complete(gl, target, || views.collect());
        Some(Image::new(target, views, None))
    }

    /// An array with a layer for each view, with the contents of the program's texture, which is bound at GL_TEXTURE_2D or
    /// GL_TEXTURE_2D_MULTISAMPLE.
    pub(super) fn texture_layers(
        &self,
        gl: &Gl,
        (target, texture): (u32, TextureName),
        tiles: &Tiles,
    ) -> Option<Image> {
        let mut levels = gl.tex_levels(target);
        let first = *levels.first()?;
        if first.layered().0 != target {
            return None;
        }
        if !is_multisampled(target) {
            let filter = gl.get_tex_parameter(target, c::TEXTURE_MIN_FILTER) as u32;
            // Mipmap levels that the program has not made yet.
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

    /// An array with a layer for each view, with the contents of the program's renderbuffer.
    pub(super) fn renderbuffer_layers(
        &self,
        gl: &Gl,
        name: RenderbufferName,
        tiles: &Tiles,
    ) -> Option<Image> {
        let before = RenderbufferName(gl.get_integer(c::RENDERBUFFER_BINDING) as u32);
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
        let before = TextureName(gl.get_integer(binding) as u32);
        let array = gl.gen_texture();
        gl.bind_texture(layered, array);
        gl.tex_storage_layers(layered, count, internal, tiles.views, &first);
        if plane == c::TEXTURE_2D {
            gl.tex_parameteri(layered, c::TEXTURE_MIN_FILTER, c::NEAREST as i32);
        }
        gl.bind_texture(layered, before);
        let views: Vec<TextureName> = ViewIndex::all(tiles.views)
            .map(|view| gl.texture_view(plane, array, internal, count, tiles.slot(view)))
            .collect();
        let copy = || {
            let from = Layer {
                object: own,
                target: kind,
                layer: 0,
            };
            for (at, level) in (0..).zip(&levels) {
                if at > 0 && kind != c::RENDERBUFFER && gl.tex_level(kind, at).is_none() {
                    break;
                }
                for layer in 0..tiles.views {
                    let to = Layer {
                        object: Object::Texture(array),
                        target: layered,
                        layer,
                    };
                    copy_layer(gl, [from, to], at, level);
                }
            }
        };
        match kind {
            c::RENDERBUFFER => copy(),
            target => complete(gl, target, copy),
        }
        let of = Array {
            name: array,
            levels,
        };
        if gl.get_error() != c::NO_ERROR {
            views.iter().for_each(|&name| gl.delete_texture(name));
            gl.delete_texture(array);
            return None;
        }
        let views = views.into_iter().map(Object::Texture).collect();
        Some(Image::new(plane, views, Some(of)))
    }

    /// A renderbuffer like the program's for each other view, with its contents.
    pub(super) fn renderbuffer(&self, gl: &Gl, name: RenderbufferName, tiles: &Tiles) -> Image {
        let before = RenderbufferName(gl.get_integer(c::RENDERBUFFER_BINDING) as u32);
        gl.bind_renderbuffer(name);
        let storage = gl.renderbuffer_storage();
        let level = Level::of_renderbuffer(storage);
        let views = ViewIndex::all(tiles.views).map(|view| {
            let own = Object::Renderbuffer(name);
            if view == tiles.own() {
                return own;
            }
            let new = Object::Renderbuffer(gl.renderbuffer(storage));
            fill(gl, c::RENDERBUFFER, (own, new), 0, &level);
            new
        });
        let views: Vec<Object> = views.collect();
        gl.bind_renderbuffer(before);
        Image::new(c::RENDERBUFFER, views, None)
    }
}
