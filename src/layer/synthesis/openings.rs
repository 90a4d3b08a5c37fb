//! `--holes draw`: the program's own draws are let into views that are made, where the frame before had holes.
//!
//! A scene's draws go to all views then. Before the first of them, the views that are made are shut by depths as near as can be, but for the
//! openings: their vertices are worked on again, their pixels hardly. What is made leaves the openings alone.

use super::{Scene, Synthesis};
use crate::atlas::{FieldTextures, Shown};
use crate::gl::Gl;
use crate::interleave::Heights;
use crate::layer::Layer;

impl Synthesis {
    /// Whether the scene's draws go to all views.
    pub(in crate::layer) fn is_open(&self) -> bool {
        self.scene.is_some_and(|scene| scene.open)
    }
}

impl Layer {
    /// Whether those of a scene that begins with a clear, of colours as well, may go to all views. What those that are made have beneath it
    /// is theirs, unless the last scene went straight to the panel.
    pub(super) fn may_open(&self, colours: bool) -> bool {
        let last = self.synthesis.scene;
        let whole = last.is_none_or(|last| last.open && !last.shown);
        self.synthesis.opened.is_some() && (colours || whole)
    }

    /// The views that have what the last scene began with.
    pub(super) fn whole(&self) -> Shown {
        let last = self.synthesis.scene;
        match last.is_some_and(|last| last.shown) {
            true => self.synthesis.drawn(),
            false => self.atlas.tiles.shown,
        }
    }

    /// Before the first draw of a scene.
    pub(super) fn shut_views(&mut self, gl: &Gl) {
        self.aside(gl, |layer| {
            let synthesis = &layer.synthesis;
            let known = (&synthesis.passes, &synthesis.opened, &synthesis.sources);
            let (Some(passes), Some(heights), Some(drawn)) = known else {
                return;
            };
            gl.color_mask(0, 0, 0, 0);
            let atlas = &mut layer.atlas;
            super::over_depths(gl, || passes.shut(gl, atlas, heights, drawn));
        });
    }

    /// The openings of a scene whose views are made.
    pub(super) fn openings(&self, scene: &Scene) -> Option<u32> {
        let [open, _] = self.atlas.openings().filter(|_| scene.open)?;
        Some(open)
    }

    /// Finds those of the next frame.
    pub(super) fn open_views(&mut self, gl: &Gl, heights: &Heights, textures: &FieldTextures) {
        let passes = self.synthesis.passes.as_ref();
        if let Some(passes) = passes.filter(|passes| passes.opens()) {
            passes.open(gl, &mut self.atlas, heights, textures);
            self.synthesis.opened = Some(*heights);
        }
    }
}
