//! A whole layer on the fake driver, and a program that calls it as the hooks do.

use super::super::{CurrentDrawable, DrawableId, Layer, Primitives};
use crate::config::Config;
use crate::gl::consts as c;
use crate::gl::fake::{Drawn, Fake};
use crate::gl::{FramebufferName, Gl, Vertices};
use crate::state::Touch;
use std::sync::Arc;

/// Extensions of Mesa on the desktop that the layer looks for.
pub(in crate::layer) const MESA: [&str; 2] = [
    "GL_MESA_framebuffer_flip_y",
    "GL_ARB_shader_viewport_layer_array",
];

/// A projection with an angle of view of 90° and planes at 1 and 100, column-major.
pub(in crate::layer) const PERSPECTIVE: [f32; 16] = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.02, -1.0, 0.0, 0.0, -2.02, 0.0,
];

/// Options by the names of the variables `MANYVIEW_*`, without that prefix. The cameras stand still unless one of them is AUTO_DEPTH.
pub(in crate::layer) fn config(options: &[(&str, &str)]) -> &'static Config {
    let config = Config::from_env(|variable| {
        let wanted = variable.strip_prefix("MANYVIEW_")?;
        let mut all = options.iter().chain(&[("AUTO_DEPTH", "0")]);
        let found = all.find(|(name, _)| *name == wanted);
        found.map(|(_, value)| (*value).to_owned())
    });
    Box::leak(Box::new(config.expect("options")))
}

/// A program of one context.
pub(in crate::layer) struct Bench {
    pub(in crate::layer) fake: Fake,
    pub(in crate::layer) gl: Gl,
    pub(in crate::layer) layer: Box<Layer>,
}

impl Bench {
    /// On a desktop driver with fixed function; options are named as the variables `MANYVIEW_*`, without that prefix.
    pub(in crate::layer) fn new(options: &[(&str, &str)]) -> Bench {
        Bench::on(Fake::new().extensions(MESA), options)
    }

    /// On this driver; options as for [`Bench::new`].
    pub(in crate::layer) fn on(fake: Fake, options: &[(&str, &str)]) -> Bench {
        let gl = fake.gl();
        let drawable = CurrentDrawable {
            id: DrawableId(1),
            size: (64, 48),
        };
        let layer = Layer::new(&gl, config(options), drawable, Arc::default());
        let layer = layer.expect("a layer");
        fake.forget();
        Bench { fake, gl, layer }
    }

    /// A command of the program that changes state.
    pub(in crate::layer) fn set(&mut self, groups: Touch, command: impl FnOnce(&Gl)) {
        self.fake.program(command);
        self.layer.touch(groups);
    }

    /// The program binds a framebuffer for drawing and reading.
    pub(in crate::layer) fn bind(&mut self, name: FramebufferName) {
        let gl = self.gl;
        let bind = &mut |target, name| gl.bind_framebuffer(target, name);
        self.layer.bind_framebuffer(c::FRAMEBUFFER, name, bind);
        self.layer.touch(Touch::OBJECTS);
    }

    /// The program sets a projection in perspective and the depth test.
    pub(in crate::layer) fn look(&mut self) {
        self.set(Touch::MODE, |gl| gl.matrix_mode(c::PROJECTION));
        self.set(Touch::PROJECTION, |gl| gl.load_matrix(&PERSPECTIVE));
        self.set(Touch::MODE, |gl| gl.matrix_mode(c::MODELVIEW));
        self.set(Touch::DEPTH, |gl| gl.enable(c::DEPTH_TEST));
    }

    /// glDrawArrays of one triangle.
    pub(in crate::layer) fn draw(&mut self) {
        let (mode, vertices) = (c::TRIANGLES, Vertices::without_arrays(0, 3));
        let primitives = Primitives::Arrays { mode, vertices };
        let gl = self.gl;
        self.layer
            .primitives(&gl, primitives, &mut || gl.draw_arrays(mode, vertices));
    }

    /// glClear of colours and depths.
    pub(in crate::layer) fn clear(&mut self) {
        let gl = self.gl;
        let mask = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;
        self.layer.clear(&gl, mask, &mut || gl.clear(mask));
    }

    /// The end of a frame.
    pub(in crate::layer) fn swap(&mut self) {
        self.layer.show(&self.gl, true);
        self.layer.count_frame();
    }

    /// A frame of one triangle in a scene.
    pub(in crate::layer) fn frame(&mut self) {
        self.clear();
        self.draw();
        self.swap();
    }

    /// What was drawn by a command since the last [`Fake::forget`].
    pub(in crate::layer) fn drawn(&self, command: &str) -> Vec<Drawn> {
        let draws = self.fake.draws().into_iter();
        draws.filter(|drawn| drawn.call.name == command).collect()
    }
}
