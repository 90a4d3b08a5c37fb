//! Draws on the fake driver: the calls and their order, and that the program's state is restored.

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

/// A projection with a field of view of 90°, near plane 1 and far plane 100, column-major.
const PERSPECTIVE: [f32; 16] = [
    1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.02, -1.0, 0.0, 0.0, -2.02, 0.0,
];

/// A context with an atlas of four views of a window of 64 x 48 pixels, and a program with a perspective projection.
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

    /// A stage in a context with textures of at most `side` pixels.
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

    /// Makes calls of the program, and updates the layer's knowledge of the state.
    fn program(&mut self, calls: impl FnOnce(&Gl)) {
        self.fake.program(calls);
        self.state.touch(crate::state::Touch::ALL);
        self.state.refresh(&self.gl);
        self.fake.forget();
    }

    fn shear(&self) -> Option<Shear> {
        self.rig.shear(&self.state.matrices.projection)
    }

    /// Shift of an infinitely far point by the projection of a view, in clip space over w.
    fn aside(&self, view: ViewIndex) -> f64 {
        -0.25 * self.rig.position(view)
    }
}

/// The shear of the projection that was in force at a draw.
fn sheared(drawn: &Drawn) -> f64 {
    drawn.state.value(c::PROJECTION_MATRIX)[8]
}
