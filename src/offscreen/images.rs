//! The split images of a share group. Its contexts share textures and renderbuffers, but not framebuffers.

use super::image::{Image, ImageSupport};
#[cfg(doc)]
use super::parameters::Parameters;
use crate::atlas::{Names, Tiles};
use crate::gl::{Gl, Object, TextureName};
use crate::view::ViewIndex;
use std::collections::{HashMap, HashSet};

/// The split objects of a share group.
#[derive(Debug, Default)]
pub struct Images {
    all: HashMap<Object, Image>,
    /// The textures of the images that belong to the layer.
    ours: HashSet<TextureName>,
    /// The targets of the program's textures, where the driver does not tell them.
    targets: HashMap<TextureName, u32>,
    /// Number of changes of attachments, draw buffers and images.
    pub(super) changes: u64,
    /// How often parameters of split textures have changed.
    pub(super) parameter_changes: u64,
}

impl Images {
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    pub(super) fn has(&self, object: Object) -> bool {
        self.all.contains_key(&object)
    }

    pub(super) fn get(&self, object: Object) -> Option<&Image> {
        self.all.get(&object)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&Object, &Image)> {
        self.all.iter()
    }

    /// Whether a texture or renderbuffer belongs to the layer.
    pub fn owns(&self, object: Object) -> bool {
        match object {
            Object::Texture(name) => self.ours.contains(&name),
            Object::Renderbuffer(_) => self
                .all
                .iter()
                .any(|(own, image)| *own != object && image.views.contains(&object)),
        }
    }

    /// Takes note of the target at which the program binds a texture.
    pub(super) fn bound_at(&mut self, target: u32, texture: TextureName) {
        if !texture.is_zero() {
            // At another target the driver refuses it.
            self.targets.entry(texture).or_insert(target);
        }
    }

    /// Takes note that a texture is deleted, and its name free for another one.
    pub(super) fn deleted(&mut self, texture: TextureName) {
        self.targets.remove(&texture);
    }

    /// The target of a texture; none where the program has bound it in no context of ours.
    pub(super) fn target_of(
        &self,
        gl: &Gl,
        support: &ImageSupport,
        texture: TextureName,
    ) -> Option<u32> {
        match support.targets {
            true => Some(gl.texture_target(texture)),
            false => self.targets.get(&texture).copied(),
        }
    }

    /// Splits the texture that is bound at a target, and copies its contents to every view. The caller preserves errors, and bindings as
    /// for [`crate::atlas::Atlas::new`]. False where it cannot be split: all views then see the same texture.
    pub(super) fn split_texture(
        &mut self,
        gl: &Gl,
        support: &ImageSupport,
        names: &mut Names,
        (target, texture): (u32, TextureName),
        tiles: &Tiles,
    ) -> bool {
        if self.has(Object::Texture(texture)) {
            return true;
        }
        let Some(image) = support.texture(gl, names, (target, texture), tiles) else {
            return false;
        };
        self.insert(Object::Texture(texture), image);
        true
    }

    pub(super) fn insert(&mut self, object: Object, image: Image) {
        // The layers of a renderbuffer's array are textures as well.
        let textures = image.others(object).filter_map(Object::texture);
        self.ours.extend(textures);
        self.ours
            .extend(image.array.as_ref().map(|array| array.name));
        self.all.insert(object, image);
        self.changes += 1;
    }

    /// Copies the image of the own view back to every program's object that is out of date.
    pub(super) fn write_back(&mut self, gl: &Gl, own_layer: u32) {
        for (object, image) in &mut self.all {
            image.write_back(gl, *object, own_layer);
        }
    }

    /// Takes note that a split object is written, so that the program's own object is out of date.
    pub(super) fn written(&mut self, object: Object) {
        if let Some(image) = self.all.get_mut(&object) {
            image.stale = true;
        }
    }

    /// Binds a view's texture at the active unit, in place of the program's own or another view's.
    pub(super) fn bind(
        &mut self,
        gl: &Gl,
        support: &ImageSupport,
        texture: TextureName,
        view: ViewIndex,
    ) {
        if let Some(image) = self.all.get_mut(&Object::Texture(texture)) {
            image.bind(gl, support, (texture, view));
        }
    }

    /// The program sets a parameter of a texture, or of some texture; `set` as for [`Parameters::change`].
    pub(super) fn parameter(&mut self, texture: Option<TextureName>, set: Option<(u32, f32)>) {
        let changes = &mut self.parameter_changes;
        let mut change =
            |image: &mut Image, set| *changes += u64::from(image.parameters.change(set));
        match texture {
            Some(texture) => {
                if let Some(image) = self.all.get_mut(&Object::Texture(texture)) {
                    change(image, set);
                }
            }
            None => self.all.values_mut().for_each(|image| change(image, None)),
        }
    }

    /// Drops the images of objects that the program has redefined or deleted.
    pub(super) fn forget(&mut self, gl: &Gl, objects: impl IntoIterator<Item = Object>) {
        for object in objects {
            let Some(image) = self.all.remove(&object) else {
                continue;
            };
            self.changes += 1;
            let array = image.array.as_ref();
            let array = array.map(|array| Object::Texture(array.name));
            for other in image.others(object).chain(array) {
                match other {
                    Object::Texture(name) => {
                        self.ours.remove(&name);
                        gl.delete_texture(name);
                    }
                    Object::Renderbuffer(name) => gl.delete_renderbuffer(name),
                }
            }
        }
    }

    /// Drops all images.
    pub(super) fn clear(&mut self, gl: &Gl) {
        let all: Vec<Object> = self.all.keys().copied().collect();
        self.forget(gl, all);
    }
}
