//! Images that the program draws outside the window, or copies from the frame: they are split into one per view where the views differ.
//!
//! The images of the views are layers of an array beside the program's own texture or renderbuffer. Where no such array can be had, each
//! other view has an object of its own, and the program's object is the image of the own view. The program always reads back its own view:
//! its object gets that before ([`Offscreen::write_back`]). A framebuffer with a split image has one framebuffer per view as well, and one
//! with all views as layers. A draw that samples a split texture has the texture of its view bound. Nothing is split until a draw depends
//! on the view: shadow maps, light maps and other images that are the same in all views stay one image, drawn once.
#![forbid(unsafe_code)]

mod depths;
mod fill;
mod image;
mod images;
mod parameters;
mod target;
#[cfg(test)]
mod tests;

pub use images::Images;
pub use target::Target;

use crate::atlas::{Grid, Names, Tiles, ViewSet};
use crate::gl::{FramebufferName, Gl, Object, TextureName, consts as c};
use crate::view::ViewIndex;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The images of a share group, which several contexts see.
pub type SharedImages = Arc<Mutex<Images>>;

/// The split images and framebuffers of one context. More than 25 methods: it manages textures, framebuffers and bindings.
#[derive(Debug)]
pub struct Offscreen {
    images: SharedImages,
    targets: HashMap<FramebufferName, Target>,
    /// Framebuffers numbered so far (see [`Offscreen::number`]).
    count: u32,
    support: image::ImageSupport,
    /// The places of the views in a framebuffer: one view in each layer.
    tiles: Tiles,
    /// Texture units of the context that are searched for split textures.
    units: u32,
}

/// Pixels from tile to tile where a layer has only one: wider than any framebuffer.
pub const STRIDE: u32 = 1 << 20;

/// Texture units of fixed function at most.
const FIXED_UNITS: u32 = 8;

/// A split texture that is bound: its unit (GL_TEXTURE0 + n), target and name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bound {
    unit: u32,
    target: u32,
    texture: TextureName,
}

impl Offscreen {
    /// For a number of views, in a context with or without fixed function (`compatibility`); `images` are those of its share group.
    pub fn new(gl: &Gl, views: u32, compatibility: bool, images: SharedImages) -> Offscreen {
        let units = gl.get_integer(c::MAX_COMBINED_TEXTURE_IMAGE_UNITS);
        Offscreen {
            images,
            targets: HashMap::new(),
            count: 0,
            support: image::ImageSupport::of(gl, compatibility),
            units: units.clamp(1, 32) as u32,
            tiles: Tiles {
                views,
                window: [0; 2],
                grid: Grid::FULL,
                shown: ViewSet::ALL,
                width: 0,
                height: 0,
                stride: STRIDE,
                columns: 1,
                rows: views,
            },
        }
    }

    fn images(&self) -> MutexGuard<'_, Images> {
        locked(&self.images)
    }

    /// Whether no image is split.
    pub fn is_empty(&self) -> bool {
        self.images().is_empty()
    }

    /// Whether a texture belongs to the layer.
    pub fn owns_texture(&self, name: TextureName) -> bool {
        self.images().owns(Object::Texture(name))
    }

    /// Whether a framebuffer belongs to the layer.
    pub fn owns_framebuffer(&self, name: FramebufferName) -> bool {
        self.framebuffers().any(|f| f == name)
    }

    /// The framebuffers that belong to the layer.
    pub fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> {
        self.targets.values().flat_map(Target::others)
    }

    /// Number of changes of images and attachments so far.
    pub fn changes(&self) -> u64 {
        self.images().changes
    }

    /// The program sets a parameter of a texture, or of some texture; `set` is its name and value, if it is a single number.
    pub fn parameter(&mut self, texture: Option<TextureName>, set: Option<(u32, f32)>) {
        self.images().parameter(texture, set);
    }

    /// How often parameters of split textures have changed.
    pub fn parameter_changes(&self) -> u64 {
        self.images().parameter_changes
    }

    /// Takes note that attachments or draw buffers of some framebuffer have changed.
    pub fn attachments_changed(&mut self) {
        self.images().changes += 1;
    }

    /// Whether an object is split.
    pub fn has(&self, object: Object) -> bool {
        self.images().has(object)
    }

    /// The textures of the views, by view; empty where the texture is not split.
    pub fn views(&self, texture: TextureName) -> Vec<TextureName> {
        let images = self.images();
        let image = images.get(Object::Texture(texture));
        let views = image.into_iter().flat_map(|image| &image.views);
        views.filter_map(|view| view.texture()).collect()
    }

    /// The split texture that is bound at a target of the active unit.
    pub fn bound_at(&self, gl: &Gl, target: u32) -> Option<TextureName> {
        let texture = TextureName(gl.get_integer(image::binding(target)?) as u32);
        self.has(Object::Texture(texture)).then_some(texture)
    }

    /// The program binds a texture. The targets of textures are kept only where the driver does not tell them.
    pub fn binds_texture(&mut self, target: u32, texture: TextureName) {
        if !self.support.targets {
            self.images().bound_at(target, texture);
        }
    }

    /// The program deletes textures.
    pub fn deleted_textures(&mut self, gl: &Gl, textures: &[TextureName]) {
        if !self.support.targets {
            let mut images = self.images();
            textures.iter().for_each(|&texture| images.deleted(texture));
        }
        self.forget(gl, textures.iter().map(|&name| Object::Texture(name)));
    }

    /// Splits the texture that is bound at a target, and copies its contents to every view. The caller preserves errors, and bindings as
    /// for [`crate::atlas::Atlas::new`]. False where it cannot be split: all views then see the same texture.
    pub fn split_texture(
        &mut self,
        gl: &Gl,
        names: &mut Names,
        (target, texture): (u32, TextureName),
    ) -> bool {
        let at = (target, texture);
        self.images()
            .split_texture(gl, &self.support, names, at, &self.tiles)
    }

    /// Splits a texture by its name, whatever its target. As [`Offscreen::split_texture`].
    pub fn split_named(&mut self, gl: &Gl, names: &mut Names, texture: TextureName) -> bool {
        let target = self.images().target_of(gl, &self.support, texture);
        let split = |target| self.split_texture(gl, names, (target, texture));
        image::with_texture(gl, texture, target, split).unwrap_or(false)
    }

    /// Copies the image of the own view back to every program's object that is out of date.
    pub fn write_back(&mut self, gl: &Gl) {
        let layer = self.tiles.slot(self.tiles.own());
        self.images().write_back(gl, layer);
    }

    /// Takes note that a split framebuffer is drawn or copied to.
    pub fn drawn_to(&mut self, target: &Target) {
        let mut images = self.images();
        for attachment in &target.attachments {
            images.written(attachment.object);
        }
    }

    /// Takes note that a split texture is written.
    pub fn written(&mut self, texture: TextureName) {
        self.images().written(Object::Texture(texture));
    }

    /// Splits a framebuffer and all objects that are attached to it. As [`Offscreen::split_texture`].
    pub fn split(&mut self, gl: &Gl, names: &mut Names, framebuffer: FramebufferName) -> bool {
        let attachments = self.target(gl, framebuffer).attachments.clone();
        // A layer of an array needs a name from glGenTextures, which high names are not.
        let mut support = self.support.clone();
        support.arrays &= !names.hidden();
        let (shared, tiles) = (self.images.clone(), self.tiles);
        let mut images = locked(&shared);
        for attachment in attachments {
            if images.has(attachment.object) {
                continue;
            }
            let done = match attachment.object {
                Object::Texture(name) => {
                    let target = images.target_of(gl, &support, name);
                    image::with_texture(gl, name, target, |target| {
                        let at = (target, name);
                        match support.texture_layers(gl, at, &tiles) {
                            Some(image) => {
                                images.insert(attachment.object, image);
                                true
                            }
                            None => images.split_texture(gl, &support, names, at, &tiles),
                        }
                    })
                }
                Object::Renderbuffer(name) => {
                    let image = support.renderbuffer_layers(gl, name, &tiles);
                    let image = image.unwrap_or_else(|| support.renderbuffer(gl, name, &tiles));
                    images.insert(attachment.object, image);
                    Some(true)
                }
            };
            if done != Some(true) {
                drop(images);
                self.target(gl, framebuffer).refused = true;
                return false;
            }
        }
        drop(images);
        self.target(gl, framebuffer);
        let target = self.targets.get_mut(&framebuffer);
        target.is_some_and(|target| target.make(gl, &locked(&shared)))
    }

    /// Whether a framebuffer has one framebuffer per view.
    pub fn is_made(&mut self, gl: &Gl, framebuffer: FramebufferName) -> bool {
        self.target(gl, framebuffer).is_made()
    }

    /// Whether a framebuffer cannot be split.
    pub fn is_refused(&mut self, gl: &Gl, framebuffer: FramebufferName) -> bool {
        self.target(gl, framebuffer).refused
    }

    /// Takes note that a framebuffer is not to be split.
    pub fn refuse(&mut self, gl: &Gl, framebuffer: FramebufferName) {
        self.target(gl, framebuffer).refused = true;
    }

    /// The state of a framebuffer of the program's, brought up to date.
    pub fn target(&mut self, gl: &Gl, framebuffer: FramebufferName) -> &mut Target {
        let target = self.targets.entry(framebuffer);
        let target = target.or_insert_with(|| Target::new(framebuffer, self.tiles));
        target.reattach(gl, &locked(&self.images));
        target
    }

    /// The number of a framebuffer that is drawn to, from 1 in the order of first use.
    pub fn number(&mut self, gl: &Gl, framebuffer: FramebufferName) -> u32 {
        let next = self.count + 1;
        let target = self.target(gl, framebuffer);
        let number = *target.number.get_or_insert(next);
        self.count = self.count.max(number);
        number
    }

    /// Whether a framebuffer has a split object attached.
    pub fn is_split(&mut self, gl: &Gl, framebuffer: FramebufferName) -> bool {
        !framebuffer.is_zero() && !self.is_empty() && self.target(gl, framebuffer).is_split()
    }

    /// The framebuffer of a view; the program's own where it is not split.
    pub fn view(
        &mut self,
        gl: &Gl,
        framebuffer: FramebufferName,
        view: ViewIndex,
    ) -> FramebufferName {
        match self.is_split(gl, framebuffer) {
            true => self.target(gl, framebuffer).view(view),
            false => framebuffer,
        }
    }

    /// Takes out the framebuffers of the views, where there are some, while they are drawn to; `shown`: the views that are drawn.
    pub fn take(&mut self, framebuffer: FramebufferName, shown: ViewSet) -> Option<Target> {
        self.targets.get(&framebuffer).filter(|t| t.is_made())?;
        let mut target = self.targets.remove(&framebuffer)?;
        target.show(shown);
        Some(target)
    }

    /// Puts back the framebuffers of [`Offscreen::take`].
    pub fn put(&mut self, target: Target) {
        self.targets.insert(target.own(), target);
    }

    /// All split textures that are bound at any unit, for draws whose units are not known.
    pub fn bound(&self, gl: &Gl) -> Vec<Bound> {
        let targets = image::TARGETS.into_iter();
        let targets: Vec<u32> = {
            let images = self.images();
            let used = |target: u32| images.iter().any(|(_, image)| image.target == target);
            targets.filter(|&t| used(t)).collect()
        };
        let units = (0..self.units).flat_map(|unit| targets.iter().map(move |&t| (unit, t)));
        self.bound_among(gl, units)
    }

    /// The split textures that are bound at some units (counted from 0) and targets.
    pub fn bound_among(&self, gl: &Gl, units: impl Iterator<Item = (u32, u32)>) -> Vec<Bound> {
        let mut bound = Vec::new();
        let images = self.images();
        if images.is_empty() {
            return bound;
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        let mut now = active;
        for (unit, target) in units {
            let unit = c::TEXTURE0 + unit;
            if std::mem::replace(&mut now, unit) != unit {
                gl.active_texture(unit);
            }
            let texture = image::binding(target).map_or(0, |b| gl.get_integer(b) as u32);
            let texture = TextureName(texture);
            let image = images.get(Object::Texture(texture));
            let new = Bound {
                unit,
                target,
                texture,
            };
            if !texture.is_zero()
                && image.is_some_and(|i| i.target == target)
                && !bound.contains(&new)
            {
                bound.push(new);
            }
        }
        if now != active {
            gl.active_texture(active);
        }
        bound
    }

    /// Those whose target is enabled at their unit, so that fixed function samples them.
    pub fn enabled_among(&self, gl: &Gl, mut bound: Vec<Bound>) -> Vec<Bound> {
        if bound.is_empty() {
            return bound;
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        bound.retain(|b| {
            if b.unit >= c::TEXTURE0 + FIXED_UNITS || !image::is_of_fixed_function(b.target) {
                return false;
            }
            gl.active_texture(b.unit);
            gl.is_enabled(b.target)
        });
        gl.active_texture(active);
        bound
    }

    /// Binds the textures of a view.
    pub fn bind(&self, gl: &Gl, bound: &[Bound], view: ViewIndex) {
        if bound.is_empty() {
            return;
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        let mut images = self.images();
        for b in bound {
            gl.active_texture(b.unit);
            images.bind(gl, &self.support, b.texture, view);
        }
        gl.active_texture(active);
    }

    /// Binds the program's own textures again.
    pub fn unbind(&self, gl: &Gl, bound: &[Bound]) {
        if bound.is_empty() {
            return;
        }
        let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
        for b in bound {
            gl.active_texture(b.unit);
            gl.bind_texture(b.target, b.texture);
        }
        gl.active_texture(active);
    }

    /// Drops the images of objects that the program has redefined or deleted.
    pub fn forget(&mut self, gl: &Gl, objects: impl IntoIterator<Item = Object>) {
        self.images().forget(gl, objects);
    }

    /// Drops framebuffers at glDeleteFramebuffers.
    pub fn forget_targets(&mut self, gl: &Gl, names: &[FramebufferName]) {
        for target in names.iter().filter_map(|name| self.targets.remove(name)) {
            target.delete(gl);
        }
    }

    /// Writes back and drops all images and framebuffers.
    pub fn clear(&mut self, gl: &Gl) {
        self.write_back(gl);
        self.images().clear(gl);
        for (_, target) in self.targets.drain() {
            target.delete(gl);
        }
    }
}

/// Locks the images, also after a panic: that turns the layer off, but the images stay valid.
fn locked(images: &SharedImages) -> MutexGuard<'_, Images> {
    images.lock().unwrap_or_else(PoisonError::into_inner)
}
