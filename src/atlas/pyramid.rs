//! The disparity pyramid: copies of views with their depths, and the least and greatest disparity of blocks of samples. Other views are
//! synthesised from it.

use super::layers::Layers;
use super::{Atlas, Names, ReferenceTextures, Single};
use crate::config::DisocclusionSource;
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Window;
use crate::view::ViewIndex;

/// Samples of a row in one block.
const BLOCK: u32 = 16;

/// The textures of the drawn views and of their pyramid, array textures with a layer for each view; see `shaders/disparity.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PyramidTextures {
    /// Colours.
    pub colour: TextureName,
    /// Depths.
    pub depth: TextureName,
    /// The greatest and the least disparity of each block.
    pub block_bounds: TextureName,
    /// The greatest disparity of each row.
    pub row_maxima: TextureName,
    /// The greatest and the least disparity of all samples that the rays of a block can meet.
    pub ray_range: TextureName,
    /// Colours and depths are copies of the views; otherwise they are the tiles of the atlas.
    pub copied: bool,
    /// The reference image of an occlusion camera.
    pub reference: Option<ReferenceTextures>,
}

impl PyramidTextures {
    /// The source of colours in disocclusions; `several`: more than one view is drawn.
    pub fn disocclusion_source(&self, several: bool) -> DisocclusionSource {
        match self.reference {
            _ if several => DisocclusionSource::Views,
            Some(_) => DisocclusionSource::Reference,
            None => DisocclusionSource::Nothing,
        }
    }
}

/// The textures of the pyramid and their framebuffers.
#[derive(Debug)]
pub(super) struct Pyramid {
    /// Copies of the views; none with multisampling, where the resolved textures are separate from the tiles.
    copy: Option<Single>,
    block_bounds: Layers,
    row_maxima: Layers,
    ray_range: Layers,
}

/// The targets of the passes that make the pyramid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PyramidTarget {
    /// [`PyramidTextures::block_bounds`]
    BlockBounds,
    /// [`PyramidTextures::row_maxima`]
    RowMaxima,
    /// [`PyramidTextures::ray_range`]
    RayRange,
}

impl Pyramid {
    fn target_layers(&self, target: PyramidTarget) -> &Layers {
        match target {
            PyramidTarget::BlockBounds => &self.block_bounds,
            PyramidTarget::RowMaxima => &self.row_maxima,
            PyramidTarget::RayRange => &self.ray_range,
        }
    }

    pub(super) fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> {
        let targets = [&self.block_bounds, &self.row_maxima, &self.ray_range].into_iter();
        let copies = self.copy.iter().flat_map(Single::framebuffers);
        copies.chain(targets.flat_map(Layers::framebuffers))
    }
}

impl Atlas {
    /// Makes the textures of the pyramid, with `layers` views; false where the driver cannot draw to them. The caller saves and restores
    /// bindings as for [`Atlas::new`].
    pub fn make_pyramid(
        &mut self,
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        layers: u32,
    ) -> bool {
        let size = [self.tiles.width, self.tiles.height].map(|side| side as i32);
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let mut target = |width: i32| {
            let format = (c::RG32F, c::RG, c::FLOAT);
            let size = [width, size[1], layers as i32];
            let made = Layers::new(gl, names, self.flipped, format, size);
            self.textures.push(made.texture);
            made
        };
        let (block_bounds, row_maxima, ray_range) = (target(blocks), target(1), target(blocks));
        let complete = [&block_bounds, &row_maxima, &ray_range]
            .iter()
            .all(|target| target.complete);
        let copy = match self.multisampled() {
            true => None,
            false => {
                let (flip, textures) = (self.flipped, &mut self.textures);
                let size = (size, layers);
                Some(Single::layers(gl, names, window, size, flip, textures))
            }
        };
        self.pyramid = Some(Pyramid {
            copy,
            block_bounds,
            row_maxima,
            ray_range,
        });
        complete
    }

    /// The textures, where [`Atlas::make_pyramid`] has made them: with the copies of the views if `copied`, or with the tiles themselves.
    pub fn pyramid(&self, copied: bool) -> Option<PyramidTextures> {
        let pyramid = self.pyramid.as_ref()?;
        let copy = pyramid.copy.as_ref().filter(|_| copied);
        let [colour, depth] = copy.map_or([self.color, self.depth], Single::textures);
        Some(PyramidTextures {
            colour,
            depth,
            block_bounds: pyramid.block_bounds.texture,
            row_maxima: pyramid.row_maxima.texture,
            ray_range: pyramid.ray_range.texture,
            copied: copy.is_some(),
            reference: None,
        })
    }

    /// Copies some views, each to a layer of its own, so that all tiles can be drawn to while the copies are sampled. Changes the framebuffer
    /// bindings; the scissor test must be off.
    pub fn copy_to_pyramid(&mut self, gl: &Gl, views: impl Iterator<Item = ViewIndex>) {
        for (layer, view) in (0..).zip(views) {
            let (from, x) = self.target(view);
            if let Some(copy) = self
                .pyramid
                .as_ref()
                .and_then(|pyramid| pyramid.copy.as_ref())
            {
                copy.take_to(gl, layer, from, x);
            }
        }
        self.bound_row = u32::MAX;
    }

    /// Binds a layer of a pass's target for drawing, and returns its width in texels.
    pub fn enter_pyramid(&mut self, gl: &Gl, target: PyramidTarget, layer: u32) -> i32 {
        let Some(pyramid) = &self.pyramid else {
            return 0;
        };
        let framebuffer = pyramid.target_layers(target).framebuffer(layer);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
        self.bound_row = u32::MAX;
        match target {
            PyramidTarget::RowMaxima => 1,
            PyramidTarget::BlockBounds | PyramidTarget::RayRange => {
                self.tiles.width.div_ceil(BLOCK).max(1) as i32
            }
        }
    }
}
