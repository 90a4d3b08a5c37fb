//! Compute shaders that read images which differ between the views: each view gets images of its own to be written to.

use super::{Layer, keep_bindings};
use crate::atlas::Tiles;
use crate::gl::{Gl, ImageUnit, Object, ProgramName};

impl Layer {
    /// glDispatchCompute: dispatches once, or for each view with its textures and images. Buffers are written by every dispatch. A shader
    /// that writes to no image is dispatched once, with the textures and images of the program's own view.
    pub fn compute(&mut self, gl: &Gl, call: &mut dyn FnMut()) {
        self.shaders_wrote();
        if !self.has_copies() {
            return call();
        }
        self.state.refresh(gl);
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
        if !reads || !images.iter().any(|image| writes(&image)) {
            self.write_back_textures(gl);
            return call();
        }
        self.state.keep_errors(gl);
        keep_bindings(gl, || {
            for image in images.iter().filter(writes) {
                self.targets
                    .offscreen
                    .split_named(gl, &mut self.targets.names, image.texture);
            }
        });
        self.drain_own_errors(gl);
        let tiles = Tiles {
            shown: self.wanted_views(),
            ..self.targets.atlas.tiles
        };
        let own = tiles.own();
        self.queries.pause(gl);
        for view in tiles.order().filter(|&view| view != own).chain([own]) {
            self.targets.offscreen.bind(gl, &sampled, view);
            for image in &images {
                let views = self.targets.offscreen.views(image.texture);
                if let Some(&name) = views.get(view.0 as usize) {
                    gl.bind_image(image, name);
                }
            }
            if view == own {
                self.queries.resume(gl);
            }
            call();
        }
        self.targets.offscreen.unbind(gl, &sampled);
        for image in &images {
            gl.bind_image(image, image.texture);
        }
        for image in images.iter().filter(writes) {
            self.targets.offscreen.written(image.texture);
        }
    }
}
