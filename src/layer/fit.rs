//! The atlas of a drawable: as the output wants it, with smaller views where there is no memory for those, or none at all.

use super::session::Session;
use super::support::Support;
use super::{Layer, keep_bindings, sampling, with_raw_copies};
use crate::atlas::{Atlas, AtlasError, Grid, Names, Tiles};
use crate::config::{AtlasLayout, Config, Strategy};
use crate::display::Placement;
use crate::gl::Gl;
use crate::plan::decide::{Detail, Mono};
use crate::state::Window;

/// Shares of the window's width and height that views have which are tried where the wanted ones cannot be had.
const SMALLER: [f64; 2] = [0.5, 0.25];

/// An atlas, and what is to be said where it is not the wanted one.
pub(super) struct Fitted {
    pub(super) atlas: Atlas,
    pub(super) told: Option<String>,
}

/// The arrangement of the views in the atlas. The strategies that draw all views at once use layers wherever a shader can choose one, even
/// where views beside each other are asked for: one draw then serves all views without clip distances, and every view lies at the origin.
/// Views beside each other are faster on llvmpipe 22.3 where there are many triangles (`manyview bench --strategy
/// instanced,instanced-distances`), but fail the gate: up to 0.11 % of neverputt's pixels differ by up to 6 steps, against 0.002 % by 1 step
/// with layers (`manyview run --prove 20`).
fn layout(config: &Config, support: &Support, strategy: Strategy) -> AtlasLayout {
    match strategy {
        // The user has asked for clip distances by name, to compare.
        _ if config.clip.is_some() => AtlasLayout::SideBySide,
        // A geometry shader can always choose a layer.
        Strategy::Geometry | Strategy::Splats => AtlasLayout::Layers,
        Strategy::Instanced if support.layers() => AtlasLayout::Layers,
        _ => config.atlas,
    }
}

/// Makes an atlas with this grid.
pub(super) fn make_atlas(
    gl: &Gl,
    names: &mut Names,
    session: &Session,
    window: &Window,
    grid: Grid,
) -> Result<Atlas, AtlasError> {
    let (config, support) = (session.config, &session.support);
    let tiles = Tiles::new(
        config.views,
        [window.width, window.height],
        grid,
        layout(config, support, session.strategy),
        support.limits,
    )?;
    keep_bindings(gl, || Atlas::new(gl, names, window, tiles, support.flip))
}

/// Makes the first atlas of a window, with the finest detail that the driver allows, which it returns as well. `on_gpu`: the output is made on
/// the GPU.
pub(super) fn fit_first(
    gl: &Gl,
    names: &mut Names,
    session: &Session,
    window: &Window,
    on_gpu: bool,
) -> (Detail, Fitted) {
    let detail = match session.support.viewports {
        true => Detail::SampleAligned,
        false => Detail::Full,
    };
    let grid = sampling::grid(
        session.config,
        session.display(),
        session.live.output,
        (
            [window.width, window.height],
            &Placement::full_screen(window.width, window.height),
        ),
        detail,
        on_gpu,
    );
    (detail, fit(gl, names, session, window, grid))
}

/// Makes the atlas of a window: with the wanted grid, with smaller views where that fails, or else a plain one.
fn fit(gl: &Gl, names: &mut Names, session: &Session, window: &Window, wanted: Grid) -> Fitted {
    let mut make = |grid| {
        let made = make_atlas(gl, names, session, window, grid);
        if made.is_err() {
            // The program must not see the errors of the attempt.
            gl.drop_errors();
        }
        made
    };
    let error = match make(wanted) {
        Ok(atlas) => return Fitted { atlas, told: None },
        Err(error) => error,
    };
    let size = [window.width, window.height];
    // As for views that are scaled because the output shows less of them.
    let fits = !gl.is_es() && session.support.viewports;
    let smaller = SMALLER.iter().filter(|_| fits);
    for share in smaller {
        let tile = size.map(|side| ((f64::from(side) * share).round() as u32).max(1));
        if let Ok(atlas) = make(Grid::scaled(tile, size)) {
            let told = format!("{error}; views of {} x {} are drawn", tile[0], tile[1]);
            return Fitted {
                atlas,
                told: Some(told),
            };
        }
    }
    Fitted {
        atlas: Atlas::plain(window, session.config.views),
        told: Some(format!("{error}; this window is shown as it is")),
    }
}

impl Layer {
    /// The drawable has another size, in pixels: makes a new atlas for it.
    pub fn resize(&mut self, gl: &Gl, width: u32, height: u32) {
        let (width, height) = (width.max(1), height.max(1));
        if self.size() == (width, height) {
            return;
        }
        self.flush_points(gl);
        self.drop_proof(gl);
        self.known.mono = Mono::default();
        self.forget_scene();
        self.state.keep_errors(gl);
        let before = (self.is_plain(), self.state.window);
        self.state.window.width = width;
        self.state.window.height = height;
        let grid = self.grid();
        let (names, window) = (&mut self.targets.names, &self.state.window);
        let fitted = fit(gl, names, &self.session, window, grid);
        if fitted.atlas.is_plain() {
            // The true framebuffer 0 gets what was drawn so far.
            self.state.window = before.1;
            with_raw_copies(gl, || self.show_own_view(gl));
            (self.state.window.width, self.state.window.height) = (width, height);
        }
        self.replace_atlas(gl, fitted.atlas);
        self.targets.stuck = fitted.told.is_some();
        if before.0 && !self.is_plain() {
            self.import(gl);
        }
        fitted.told.into_iter().for_each(|told| self.announce(told));
    }

    /// Puts an atlas without contents in the place of the one that there is.
    fn replace_atlas(&mut self, gl: &Gl, atlas: Atlas) {
        std::mem::replace(&mut self.targets.atlas, atlas).delete(gl);
        if let Some(old) = std::mem::take(&mut self.targets.accumulated).buffer {
            old.delete(gl);
        }
        self.apply_buffers(gl);
        self.bind_draw(gl, true, true);
    }

    /// The driver refuses an image that the program's next command needs: the program draws to the true framebuffer 0 from now on, which gets
    /// what was drawn so far. The caller has kept the program's errors.
    pub(super) fn become_plain(&mut self, gl: &Gl) {
        // Those of the attempt.
        gl.drop_errors();
        self.drop_proof(gl);
        self.leave_mono(gl);
        with_raw_copies(gl, || self.show_own_view(gl));
        gl.drop_errors();
        let atlas = Atlas::plain(&self.state.window, self.session.config.views);
        self.replace_atlas(gl, atlas);
        self.targets.stuck = true;
        self.rebind(gl);
        self.announce("the driver makes no image that the program needs, perhaps for lack of memory: this window is shown as it is".into());
    }

    /// Adds a sentence to the report, which the user is also to see at once.
    pub(super) fn announce(&mut self, sentence: String) {
        self.diagnostics.announce(sentence);
    }

    /// Takes the sentences that the user is to see at once.
    pub fn take_announced(&mut self) -> Vec<String> {
        std::mem::take(&mut self.diagnostics.announced)
    }
}
