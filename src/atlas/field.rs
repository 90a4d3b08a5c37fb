//! A copy of the program's own view with its depths, and how high they are at most, for what makes views of it.

use super::{Atlas, BentTextures, Names, Single, fetched};
use crate::gl::{Gl, consts as c};
use crate::state::Window;

/// Samples of a row in one texel of the peaks.
const BLOCK: u32 = 16;

/// The textures of a picture with depths, array textures of one layer in use; see `shaders/field.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldTextures {
    /// Colours.
    pub colour: u32,
    /// Depths.
    pub depth: u32,
    /// The greatest and the least height of each block.
    pub peaks: u32,
    /// The greatest of each row.
    pub tops: u32,
    /// The greatest and the least of all that the rays of a block can meet.
    pub range: u32,
    /// The reference image of an occlusion camera.
    pub bent: Option<BentTextures>,
}

/// Where they are drawn to.
#[derive(Debug)]
pub(super) struct Field {
    /// None where what the tiles are resolved to is no tile.
    copy: Option<Single>,
    /// Texture and framebuffer.
    peaks: (u32, u32),
    tops: (u32, u32),
    range: (u32, u32),
}

/// What is drawn to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldTarget {
    /// [`FieldTextures::peaks`]
    Peaks,
    /// [`FieldTextures::tops`]
    Tops,
    /// [`FieldTextures::range`]
    Range,
}

impl Field {
    pub(super) fn framebuffers(&self) -> impl Iterator<Item = u32> + use<> {
        let copy = self.copy.as_ref().map(Single::framebuffer);
        copy.into_iter()
            .chain([self.peaks.1, self.tops.1, self.range.1])
    }
}

impl Atlas {
    /// Makes what [`Atlas::take_field`] copies to. The caller saves and restores bindings as for [`Atlas::new`].
    pub fn make_field(&mut self, gl: &Gl, names: &mut Names, window: &Window) -> bool {
        let size = [self.tiles.width, self.tiles.height].map(|side| side as i32);
        let mut complete = true;
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let mut line = |width: i32| {
            let name = names.texture(gl);
            let target = c::TEXTURE_2D_ARRAY;
            gl.bind_texture(target, name);
            gl.tex_storage_3d(c::RG32F, width, size[1], 1, c::RG, c::FLOAT);
            fetched(gl);
            gl.bind_texture(target, 0);
            let framebuffer = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, name, 0, 0);
            // As the tiles: Mesa 22.3 turns a polygon stipple for the framebuffer that is drawn to first, and keeps it so.
            if self.flipped {
                gl.flip_framebuffer(c::FRAMEBUFFER);
            }
            complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
            self.textures.push(name);
            (name, framebuffer)
        };
        let (peaks, tops, range) = (line(blocks), line(1), line(blocks));
        let copy = match self.multisampled() {
            true => None,
            false => {
                let (flip, textures) = (self.flipped, &mut self.textures);
                Some(Single::new(gl, names, window, size, flip, textures))
            }
        };
        self.field = Some(Field {
            copy,
            peaks,
            tops,
            range,
        });
        complete
    }

    /// The textures of the own view, where [`Atlas::make_field`] has made them: of a copy, or of the tile itself.
    pub fn field(&self, copied: bool) -> Option<FieldTextures> {
        let field = self.field.as_ref()?;
        let copy = field.copy.as_ref().filter(|_| copied);
        let [colour, depth] = copy.map_or([self.color, self.depth], Single::textures);
        Some(FieldTextures {
            colour,
            depth,
            peaks: field.peaks.0,
            tops: field.tops.0,
            range: field.range.0,
            bent: None,
        })
    }

    /// Copies the own view, so that all tiles can be drawn to. Changes the framebuffer bindings; the scissor test must be off.
    pub fn take_field(&mut self, gl: &Gl) {
        let own = self.tiles.own();
        self.resolve(gl, true, c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
        let (from, x) = self.target(own);
        if let Some(copy) = self.field.as_ref().and_then(|field| field.copy.as_ref()) {
            copy.take(gl, from, x);
        }
        self.bound_row = u32::MAX;
    }

    /// Binds what a pass draws to, and answers its width in texels.
    pub fn enter_field(&mut self, gl: &Gl, target: FieldTarget) -> i32 {
        let Some(field) = &self.field else { return 0 };
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let (framebuffer, width) = match target {
            FieldTarget::Tops => (field.tops.1, 1),
            FieldTarget::Peaks => (field.peaks.1, blocks),
            FieldTarget::Range => (field.range.1, blocks),
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
        self.bound_row = u32::MAX;
        width
    }
}
