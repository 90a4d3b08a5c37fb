//! Draws on the fake driver: which calls, in which order, and that the state is the program's again.

mod amplified;
mod current;
mod fixed_state;
mod fragment_state;
mod reference;
mod replayed;
mod scaled;
mod variant;

use crate::atlas::{Atlas, Grid, Limits, Names, Tiles};
use crate::config::{AtlasLayout, Camera};
use crate::gl::fake::{Drawn, Fake};
use crate::gl::{Gl, consts as c};
use crate::plan::{Rig, Shear};
use crate::state::{State, Window};
use crate::view::ViewIndex;

/// A projection with a right angle of view, from 1 to 100.
const PERSPECTIVE: [f32; 16] = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.02, -1.0, 0.0, 0.0, -2.02, 0.0,
];

/// A context with an atlas of four views of a window of 64 x 48 pixels, and a program that looks into a scene.
struct Stage {
    fake: Fake,
    gl: Gl,
    atlas: Atlas,
    state: State,
    rig: Rig,
}

impl Stage {
    fn new(layout: AtlasLayout, grid: Grid) -> Stage {
        Stage::on(Fake::new(), layout, grid)
    }

    fn on(fake: Fake, layout: AtlasLayout, grid: Grid) -> Stage {
        Stage::within(fake, layout, grid, 4096)
    }

    /// With textures of at most so many pixels a side.
    fn within(fake: Fake, layout: AtlasLayout, grid: Grid, side: u32) -> Stage {
        let gl = fake.gl();
        let window = Window::ask(&gl, 64, 48, true);
        let limits = Limits { side, layers: 64 };
        let tiles = Tiles::new(4, [64, 48], grid, layout, limits).expect("fits");
        let atlas = Atlas::new(&gl, &mut Names::default(), &window, tiles, true);
        let atlas = atlas.expect("an atlas");
        gl.bind_framebuffer(c::FRAMEBUFFER, atlas.framebuffer());
        let camera = Camera::Clip {
            separation: 0.25,
            convergence: 2.0,
        };
        let mut stage = Stage {
            gl,
            atlas,
            state: State::new(window, true),
            rig: Rig::new(4, camera, None),
            fake,
        };
        stage.program(|gl| {
            gl.matrix_mode(c::PROJECTION);
            gl.load_matrix(&PERSPECTIVE);
            gl.matrix_mode(c::MODELVIEW);
        });
        stage
    }

    /// Calls of the program, after which the layer knows the state.
    fn program(&mut self, calls: impl FnOnce(&Gl)) {
        self.fake.program(calls);
        self.state.touch(crate::state::Touch::ALL);
        self.state.refresh(&self.gl);
        self.fake.forget();
    }

    fn shear(&self) -> Option<Shear> {
        self.rig.shear(&self.state.matrices.projection)
    }

    /// What the projection of a view moves the far distance by, in clip space over w.
    fn aside(&self, view: ViewIndex) -> f64 {
        -0.25 * self.rig.position(view)
    }
}

/// How the projection that something was drawn with is sheared.
fn sheared(drawn: &Drawn) -> f64 {
    drawn.state.value(c::PROJECTION_MATRIX)[8]
}
