//! The split images of a share group. Its contexts share textures and renderbuffers, but not framebuffers.

use super::image::{Image, ImageSupport};
use crate::atlas::{Names, Tiles};
use crate::gl::{Gl, Object};
use crate::view::ViewIndex;
use std::collections::{HashMap, HashSet};

/// The split objects of a share group.
#[derive(Debug, Default)]
pub struct Images {
    all: HashMap<Object, Image>,
    /// The textures among them that are not the program's own.
    ours: HashSet<u32>,
    /// Changes of attachments, of buffers that are drawn to, and of images.
    pub(super) changes: u64,
    /// Number of changes of texture parameters.
    pub(super) looks: u64,
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
            Object::Renderbuffer(name) => self.all.iter().any(|(object, image)| match object {
                Object::Renderbuffer(own) => {
                    image.array.is_none() && *own != name && image.views.contains(&name)
                }
                Object::Texture(_) => false,
            }),
        }
    }

    /// Splits the texture that is bound at a target, and copies its contents to every view. The caller preserves errors, and bindings as
    /// for [`crate::atlas::Atlas::new`]. False where it cannot be split: all views then see the same texture.
    pub(super) fn split_texture(
        &mut self,
        gl: &Gl,
        support: &ImageSupport,
        names: &mut Names,
        (target, texture): (u32, u32),
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
        match object {
            Object::Texture(own) => self.ours.extend(image.others(own)),
            // Those in an array are textures as well.
            Object::Renderbuffer(_) if image.array.is_some() => self.ours.extend(&image.views),
            Object::Renderbuffer(_) => {}
        }
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

    /// Binds a view's texture at the active unit, where the program's own is bound or another view's.
    pub(super) fn bind(&mut self, gl: &Gl, support: &ImageSupport, texture: u32, view: ViewIndex) {
        let looks = self.looks;
        if let Some(image) = self.all.get_mut(&Object::Texture(texture)) {
            image.bind(gl, support, looks, (texture, view));
        }
    }

    /// Drops the images of objects that the program has redefined or deleted.
    pub(super) fn forget(&mut self, gl: &Gl, objects: impl IntoIterator<Item = Object>) {
        for object in objects {
            let Some(image) = self.all.remove(&object) else {
                continue;
            };
            self.changes += 1;
            let (Object::Texture(own) | Object::Renderbuffer(own)) = object;
            let array = image.array.as_ref().map(|array| array.name);
            // Both kinds of objects may have the same name.
            let textures = matches!(object, Object::Texture(_)) || array.is_some();
            for name in image.others(own).chain(array) {
                if textures {
                    self.ours.remove(&name);
                    gl.delete_texture(name);
                } else {
                    gl.delete_renderbuffer(name);
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
