//! Compute shaders that read images which differ between the views: each view gets images of its own to be written to.

use super::Layer;
use crate::atlas::Tiles;
use crate::gl::{Gl, ImageUnit, Object, ProgramName};

impl Layer {
    /// glDispatchCompute: dispatches once, or for each view with its textures and images. Buffers are written once. A shader that writes to no
    /// image is dispatched once, with the textures and images of the program's own view.
    pub fn compute(&mut self, gl: &Gl, call: &mut dyn FnMut()) {
        self.shaders_wrote();
        if !self.has_copies() {
            return call();
        }
        self.state.refresh(gl);
        self.refresh_parameters();
        let program = self.state.in_use.program;
        let (sampled, images) = match program {
            // Nothing is known of a program pipeline.
            ProgramName::ZERO => Default::default(),
            program => {
                let units = self.units_of(gl, program).into_iter();
                let sampled = self.targets.offscreen.bound_among(gl, units);
                (sampled, self.images_of(gl, program))
            }
        };
        let differs =
            |image: &ImageUnit| self.targets.offscreen.has(Object::Texture(image.texture));
        let reads = !sampled.is_empty() || images.iter().any(differs);
        let writes = |image: &&ImageUnit| image.is_written();
        if program.is_zero() && self.state.in_use.pipeline != 0 {
            // What it stores to is the program's own texture again.
            for image in self.pipeline_images(gl).iter().filter(writes) {
                self.written(gl, Object::Texture(image.texture));
            }
        }
        if !reads || !images.iter().any(|image| writes(&image)) {
            self.write_back_textures(gl);
            return call();
        }
        for image in images.iter().filter(writes) {
            self.split_image(gl, image.texture);
        }
        let mut redirection = self.redirect(gl, &images, Vec::new());
        let tiles = Tiles {
            shown: self.wanted_views(),
            ..self.targets.atlas.tiles
        };
        let own = tiles.own();
        self.queries.pause(gl);
        for view in tiles.order().filter(|&view| view != own).chain([own]) {
            self.targets.offscreen.bind(gl, &sampled, view);
            redirection.enter(gl, view, own);
            if view == own {
                self.queries.resume(gl);
            }
            call();
        }
        self.targets.offscreen.unbind(gl, &sampled);
        redirection.leave(gl);
    }
}
