//! Copies of views with their depths, and how high they are at most, for what makes other views of them.

use super::layers::Layers;
use super::{Atlas, BentTextures, Names, Single};
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
}

impl FieldTextures {
    /// What is known of what is hidden; `several`: there are more views than one.
    pub fn behind(&self, several: bool) -> Behind {
        match self.bent {
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
    peaks: Layers,
    tops: Layers,
    range: Layers,
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
    fn lines(&self, target: FieldTarget) -> &Layers {
        match target {
            FieldTarget::Peaks => &self.peaks,
            FieldTarget::Tops => &self.tops,
            FieldTarget::Range => &self.range,
        }
    }

    pub(super) fn framebuffers(&self) -> impl Iterator<Item = u32> {
        let lines = [&self.peaks, &self.tops, &self.range].into_iter();
        let copies = self.copy.iter().flat_map(Single::framebuffers);
        copies.chain(lines.flat_map(Layers::framebuffers))
    }
}

impl Atlas {
    /// Makes what [`Atlas::take_field`] copies to, for as many views. The caller saves and restores bindings as for [`Atlas::new`].
    pub fn make_field(&mut self, gl: &Gl, names: &mut Names, window: &Window, layers: u32) -> bool {
        let size = [self.tiles.width, self.tiles.height].map(|side| side as i32);
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let mut lines = |width: i32| {
            let format = (c::RG32F, c::RG, c::FLOAT);
            let size = [width, size[1], layers as i32];
            let lines = Layers::new(gl, names, self.flipped, format, size);
            self.textures.push(lines.texture);
            lines
        };
        let (peaks, tops, range) = (lines(blocks), lines(1), lines(blocks));
        let complete = [&peaks, &tops, &range].iter().all(|lines| lines.complete);
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
        let framebuffer = field.lines(target).framebuffer(layer);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
        self.bound_row = u32::MAX;
        match target {
            FieldTarget::Tops => 1,
            FieldTarget::Peaks | FieldTarget::Range => {
                self.tiles.width.div_ceil(BLOCK).max(1) as i32
            }
        }
    }
}
