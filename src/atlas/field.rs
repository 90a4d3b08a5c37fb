//! Copies of views with their depths, and how high they are at most, for what makes other views of them.

use super::{Atlas, BentTextures, Names, Single, fetched};
use crate::config::Behind;
use crate::gl::{Gl, consts as c};
use crate::state::Window;

/// Samples of a row in one texel of the peaks.
const BLOCK: u32 = 16;

/// The textures of pictures with depths, array textures with a layer for each; see `shaders/field.wgsl`.
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
    /// The pictures are copies, else they lie in their tiles.
    pub copied: bool,
    /// The reference image of an occlusion camera.
    pub bent: Option<BentTextures>,
    /// Where views that are made have the program's own draws.
    pub open: Option<u32>,
}

impl FieldTextures {
    /// What is known of what is hidden; `several`: there are more views than one.
    pub fn behind(&self, several: bool) -> Behind {
        match self.bent {
            _ if several && self.open.is_some() => Behind::Draws,
            _ if several => Behind::Views,
            Some(_) => Behind::Reference,
            None => Behind::Nothing,
        }
    }
}

/// Where they are drawn to.
#[derive(Debug)]
pub(super) struct Field {
    /// None where what the tiles are resolved to is no tile.
    copy: Option<Single>,
    peaks: Lines,
    tops: Lines,
    range: Lines,
}

/// A texture, and the framebuffers of its layers.
#[derive(Debug)]
struct Lines {
    texture: u32,
    framebuffers: Vec<u32>,
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
    fn lines(&self, target: FieldTarget) -> &Lines {
        match target {
            FieldTarget::Peaks => &self.peaks,
            FieldTarget::Tops => &self.tops,
            FieldTarget::Range => &self.range,
        }
    }

    pub(super) fn framebuffers(&self) -> impl Iterator<Item = u32> {
        let lines = [&self.peaks, &self.tops, &self.range].into_iter();
        let copies = self.copy.iter().flat_map(Single::framebuffers);
        copies.chain(lines.flat_map(|lines| lines.framebuffers.iter().copied()))
    }
}

impl Atlas {
    /// Makes what [`Atlas::take_field`] copies to, for as many views. The caller saves and restores bindings as for [`Atlas::new`].
    pub fn make_field(&mut self, gl: &Gl, names: &mut Names, window: &Window, layers: u32) -> bool {
        let size = [self.tiles.width, self.tiles.height].map(|side| side as i32);
        let mut complete = true;
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let mut lines = |width: i32| {
            let texture = names.texture(gl);
            let target = c::TEXTURE_2D_ARRAY;
            gl.bind_texture(target, texture);
            let depth = layers as i32;
            gl.tex_storage_3d(c::RG32F, width, size[1], depth, c::RG, c::FLOAT);
            fetched(gl);
            gl.bind_texture(target, 0);
            self.textures.push(texture);
            let mut framebuffer = |layer: u32| {
                let name = gl.gen_framebuffer();
                gl.bind_framebuffer(c::FRAMEBUFFER, name);
                let layer = layer as i32;
                gl.framebuffer_texture_layer(
                    c::FRAMEBUFFER,
                    c::COLOR_ATTACHMENT0,
                    texture,
                    0,
                    layer,
                );
                // As the tiles: Mesa 22.3 turns a polygon stipple for the framebuffer that is drawn to first, and keeps it so.
                if self.flipped {
                    gl.flip_framebuffer(c::FRAMEBUFFER);
                }
                complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
                name
            };
            let framebuffers = (0..layers).map(&mut framebuffer).collect();
            Lines {
                texture,
                framebuffers,
            }
        };
        let (peaks, tops, range) = (lines(blocks), lines(1), lines(blocks));
        let copy = match self.multisampled() {
            true => None,
            false => {
                let (flip, textures) = (self.flipped, &mut self.textures);
                let size = (size, layers);
                Some(Single::layers(gl, names, window, size, flip, textures))
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

    /// The textures of the views, where [`Atlas::make_field`] has made them: of copies, or of the tiles themselves.
    pub fn field(&self, copied: bool) -> Option<FieldTextures> {
        let field = self.field.as_ref()?;
        let copy = field.copy.as_ref().filter(|_| copied);
        let [colour, depth] = copy.map_or([self.color, self.depth], Single::textures);
        Some(FieldTextures {
            colour,
            depth,
            peaks: field.peaks.texture,
            tops: field.tops.texture,
            range: field.range.texture,
            copied: copy.is_some(),
            bent: None,
            open: None,
        })
    }

    /// Copies some views, each to a layer of its own, so that all tiles can be drawn to. Changes the framebuffer bindings; the scissor test must be off.
    pub fn take_field(&mut self, gl: &Gl, views: impl Iterator<Item = u32>) {
        for (layer, view) in (0..).zip(views) {
            let (from, x) = self.target(view);
            if let Some(copy) = self.field.as_ref().and_then(|field| field.copy.as_ref()) {
                copy.take_to(gl, layer, from, x);
            }
        }
        self.bound_row = u32::MAX;
    }

    /// Binds what a pass draws to, of a layer, and answers its width in texels.
    pub fn enter_field(&mut self, gl: &Gl, target: FieldTarget, layer: u32) -> i32 {
        let Some(field) = &self.field else { return 0 };
        let framebuffer = field.lines(target).framebuffers.get(layer as usize);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer.copied().unwrap_or(0));
        self.bound_row = u32::MAX;
        match target {
            FieldTarget::Tops => 1,
            FieldTarget::Peaks | FieldTarget::Range => {
                self.tiles.width.div_ceil(BLOCK).max(1) as i32
            }
        }
    }
}
