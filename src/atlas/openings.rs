//! Where the program's own draws are let into views that are made of others: a layer of cells for each view.

use super::{Atlas, Names, fetched};
use crate::gl::{Gl, consts as c};

/// Pixels of a view in a cell, each way; as `shaders/open.wgsl` has it.
const CELL: u32 = 4;

/// What is drawn to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpeningTarget {
    /// Cells that have holes, of one view.
    Holes,
    /// The openings of a view in the next frame.
    Next(u32),
}

/// Textures with the framebuffers of their layers.
#[derive(Debug)]
pub(super) struct Openings {
    holes: (u32, u32),
    /// This frame's and the next one's.
    frames: [(u32, Vec<u32>); 2],
}

impl Openings {
    pub(super) fn framebuffers(&self) -> impl Iterator<Item = u32> {
        let frames = self.frames.iter().flat_map(|(_, layers)| layers);
        frames.copied().chain([self.holes.1])
    }
}

impl Atlas {
    /// Columns and rows of cells.
    fn cells(&self) -> [i32; 2] {
        [self.tiles.width, self.tiles.height].map(|side| side.div_ceil(CELL).max(1) as i32)
    }

    /// Makes them. The caller saves and restores bindings as for [`Atlas::new`].
    pub fn make_openings(&mut self, gl: &Gl, names: &mut Names) -> bool {
        let [width, height] = self.cells();
        let mut complete = true;
        let mut layers = |count: u32| {
            let texture = names.texture(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
            let depth = count as i32;
            gl.tex_storage_3d(c::R8, width, height, depth, c::RED, c::UNSIGNED_BYTE);
            fetched(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, 0);
            self.textures.push(texture);
            let mut framebuffer = |layer: u32| {
                let name = gl.gen_framebuffer();
                gl.bind_framebuffer(c::FRAMEBUFFER, name);
                let (point, layer) = (c::COLOR_ATTACHMENT0, layer as i32);
                gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, texture, 0, layer);
                // As the tiles: see `Atlas::make_field`.
                if self.flipped {
                    gl.flip_framebuffer(c::FRAMEBUFFER);
                }
                complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
                name
            };
            let framebuffers: Vec<u32> = (0..count).map(&mut framebuffer).collect();
            (texture, framebuffers)
        };
        let (holes, framebuffers) = layers(1);
        let frames = [0, 1].map(|_| layers(self.tiles.views));
        self.openings = Some(Openings {
            holes: (holes, framebuffers.first().copied().unwrap_or(0)),
            frames,
        });
        complete
    }

    /// The texture of this frame's, and that of the cells that have holes; none before [`Atlas::make_openings`].
    pub fn openings(&self) -> Option<[u32; 2]> {
        let openings = self.openings.as_ref()?;
        Some([openings.frames[0].0, openings.holes.0])
    }

    /// The next frame's are this one's.
    pub fn turn_openings(&mut self) {
        if let Some(openings) = &mut self.openings {
            openings.frames.swap(0, 1);
        }
    }

    /// Binds what is drawn to, and answers its columns and rows.
    pub fn enter_openings(&mut self, gl: &Gl, target: OpeningTarget) -> [i32; 2] {
        let Some(openings) = &self.openings else {
            return [0; 2];
        };
        let framebuffer = match target {
            OpeningTarget::Holes => Some(openings.holes.1),
            OpeningTarget::Next(view) => openings.frames[1].1.get(view as usize).copied(),
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer.unwrap_or(0));
        self.bound_row = u32::MAX;
        self.cells()
    }
}
