//! Checksums of the images of textures. Rules of a profile know an image by them in every run, while names of textures change.
//!
//! An image is read where a rule or an explanation asks for it, once until the program writes to the texture again. What another context
//! writes to a shared texture, and what is drawn to it, is not noticed.

use super::Layer;
use crate::checksum::fnv1a;
use crate::gl::{Gl, Object, PixelStore, TextureName, consts as c};
use rustc_hash::FxHashMap;

/// The longest side, in texels, of an image that is read: 64 MiB.
const LONGEST: i32 = 4096;

/// What a user is told whose rules need images on OpenGL ES.
const UNREADABLE: &str = "rules with `image` have no effect: OpenGL ES does not give the images of textures back; give them `shader` instead";

/// Checksums by texture.
#[derive(Debug, Default)]
pub(super) struct ImageSums(FxHashMap<TextureName, u64>);

impl ImageSums {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The image of a texture changes.
    pub(super) fn forget(&mut self, texture: TextureName) {
        self.0.remove(&texture);
    }
}

impl Layer {
    /// The checksum of a 2D texture's image: width, height and RGBA bytes of level 0. 0 where there is no image, where it has no colours, where each view has its own,
    /// where it has a side longer than [`LONGEST`], while a display list is compiled, and on OpenGL ES, which does not give images back.
    pub(super) fn image_sum(&mut self, gl: &Gl, texture: TextureName) -> u64 {
        let own = self.targets.offscreen.has(Object::Texture(texture));
        if texture.is_zero() || own {
            return 0;
        }
        if let Some(&sum) = self.cameras.image_sums.0.get(&texture) {
            return sum;
        }
        if gl.is_es() {
            if self.cameras.classifier.has_rules_for_images() {
                self.diagnostics.report.note(UNREADABLE.to_owned());
            }
            self.cameras.image_sums.0.insert(texture, 0);
            return 0;
        }
        if self.state.list.is_some() {
            // The list that is open would take the bindings.
            return 0;
        }
        self.state.keep_errors(gl);
        let before = TextureName(gl.get_integer(c::TEXTURE_BINDING_2D) as u32);
        gl.bind_texture(c::TEXTURE_2D, texture);
        let sum = read_sum(gl);
        gl.bind_texture(c::TEXTURE_2D, before);
        self.drain_own_errors(gl);
        self.cameras.image_sums.0.insert(texture, sum);
        sum
    }

    /// Whether writes to textures have to be reported: views have images of their own, or checksums are kept.
    pub fn follows_textures(&self) -> bool {
        self.has_copies() || !self.cameras.image_sums.is_empty()
    }
}

/// The checksum of the 2D texture that is bound.
fn read_sum(gl: &Gl) -> u64 {
    let Some(level) = gl.tex_level(c::TEXTURE_2D, 0) else {
        return 0;
    };
    let size = [level.size[0], level.size[1]];
    // Depths and integers are no colours: the driver would refuse.
    if !level.has_colours() || size.iter().any(|side| !(1..=LONGEST).contains(side)) {
        return 0;
    }
    let store = PixelStore::enter(gl);
    let texels = gl.read_texture(&store, size);
    store.leave(gl);
    let size = size.into_iter().flat_map(i32::to_le_bytes);
    fnv1a(size.chain(texels))
}
