//! How finely the views are drawn: as few texels as the output shows, and the window's own pixels as soon as the program does what
//! others cannot hold.

use super::Layer;
use crate::atlas::{Grid, ViewSet};
use crate::config::{CaptureWhat, Config, Filter, Optimisation, Output, ViewScale};
use crate::display::{Display, Placement};
use crate::gl::{Gl, consts as c};
use crate::interleave::Form;
use crate::plan::Kind;

/// What a program has left of it. Each holds more kinds of draws than the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Detail {
    /// Triangles over the whole window.
    #[default]
    SampleAligned,
    /// Anything that has a size in the window's pixels.
    Scaled,
    /// Everything.
    Full,
}

/// The texels of the views. `shader`: the output is made on the GPU, which can look tiles up by lenses.
pub(super) fn grid(
    config: &Config,
    display: &Display,
    output: Output,
    placement: &Placement,
    detail: Detail,
    shader: bool,
) -> Grid {
    let window = [placement.width, placement.height];
    let scaled = |share: [f64; 2]| {
        let tile = [0, 1].map(|i| ((f64::from(window[i]) * share[i]).round() as u32).max(1));
        Grid::scaled(tile, window)
    };
    match (config.view_scale, detail) {
        (_, Detail::Full) => Grid::FULL,
        (ViewScale::Fixed(scale), _) => scaled([scale; 2]),
        (ViewScale::Auto, detail) => {
            let form = Form::of(config, display, output);
            (detail == Detail::SampleAligned && shader)
                .then(|| form.sample_aligned(placement, config.views))
                .flatten()
                .unwrap_or_else(|| scaled(form.share(config.views)))
        }
    }
}

impl Layer {
    pub(super) fn grid(&self) -> Grid {
        grid(
            self.session.config,
            self.session
                .fitted
                .as_ref()
                .unwrap_or(&self.session.config.display),
            self.output(),
            &self.placement(),
            self.targets.detail,
            self.targets.interleaver.note().is_none(),
        )
    }

    /// Before a draw: the grid has to be able to hold it.
    pub(super) fn hold(&mut self, gl: &Gl, kind: Kind) {
        let grid = self.targets.atlas.tiles.grid;
        if grid.is_full() || !self.state.draws_to_window() {
            return;
        }
        match kind {
            Kind::Pixels => return self.hold_everything(gl, "draws pixels or bitmaps"),
            Kind::Accum => return self.hold_everything(gl, "uses the accumulation buffer"),
            Kind::Clear { .. } => return self.hold_rects(gl),
            _ => {}
        }
        if self.state.program != 0 || self.state.pipeline != 0 {
            return self.hold_everything(gl, "has shaders of its own");
        }
        if gl.is_enabled(c::POLYGON_STIPPLE) {
            return self.hold_everything(gl, "draws stippled polygons");
        }
        if grid.is_sample_aligned() {
            let thin = match kind {
                Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => {
                    mode <= c::LINE_STRIP
                }
                _ => false,
            };
            if thin || gl.get_integers::<2>(c::POLYGON_MODE) != [c::FILL as i32; 2] {
                return self.give_up(gl, Detail::Scaled, "draws lines or points");
            }
            self.hold_rects(gl);
        }
    }

    /// Before a run of a display list; `thin`: it may have lines or points.
    pub(super) fn hold_list(&mut self, gl: &Gl, thin: bool) {
        if thin && self.targets.atlas.tiles.grid.is_sample_aligned() {
            self.give_up(
                gl,
                Detail::Scaled,
                "may draw lines or points in display lists",
            );
        }
    }

    /// Edges of a part of the window cannot be upright in tiles that lean.
    fn hold_rects(&mut self, gl: &Gl) {
        let window = &self.state.window;
        let whole = [0, 0, window.width as i32, window.height as i32];
        let part =
            self.state.viewport != whole || self.state.scissor_test && self.state.scissor != whole;
        if part && self.targets.atlas.tiles.grid.shear != 0.0 {
            self.give_up(gl, Detail::Scaled, "draws to parts of the window");
        }
    }

    /// Only the window's own pixels can hold what comes.
    pub(super) fn hold_everything(&mut self, gl: &Gl, what: &str) {
        if !self.targets.atlas.tiles.grid.is_full() {
            self.give_up(gl, Detail::Full, what);
        }
    }

    fn give_up(&mut self, gl: &Gl, detail: Detail, what: &str) {
        self.targets.detail = detail;
        let now = match self.grid() {
            grid if grid.is_full() => "at the size of the window",
            _ => "with fewer pixels, but not lens by lens",
        };
        self.diagnostics
            .report
            .note(format!("views are drawn {now}, because the program {what}"));
        self.remake(gl);
    }

    /// Before a frame is shown: tiles that are not of the kind or the size that the output needs now are made anew from what is there.
    pub(super) fn refit(&mut self, gl: &Gl) {
        if self.diagnostics.proving.replays() {
            return;
        }
        let (grid, size) = self.wanted();
        let tiles = &self.targets.atlas.tiles;
        if size != [tiles.width, tiles.height]
            || grid.is_sample_aligned() != tiles.grid.is_sample_aligned()
        {
            self.remake(gl);
        }
    }

    /// After it: the window may have moved, and the next frame is drawn where its lenses are now.
    pub(super) fn realign_tiles(&mut self) {
        if self.diagnostics.proving.replays() {
            return;
        }
        let ((grid, size), shown) = (self.wanted(), self.shown());
        let tiles = &mut self.targets.atlas.tiles;
        if size == [tiles.width, tiles.height] {
            tiles.grid = grid;
        }
        tiles.shown = shown;
    }

    /// The views that the next frame is drawn in.
    pub(super) fn shown(&self) -> ViewSet {
        if self.is_mono() {
            return [].into_iter().collect();
        }
        if self.synthesis.is_on() {
            return self.synthesis.drawn();
        }
        self.wanted_views()
    }

    /// The views that have to be drawn where they are not all the same.
    pub(super) fn wanted_views(&self) -> ViewSet {
        let captured = self
            .session
            .config
            .capture
            .as_ref()
            .map(|capture| capture.what);
        // What is proved is compared view by view.
        if self.targets.undrawn
            || self.session.config.disabled.has(Optimisation::Unseen)
            || self.session.config.prove.is_some()
            || captured.is_some_and(|what| what != CaptureWhat::Output)
        {
            return ViewSet::ALL;
        }
        self.seen()
    }

    /// The views that are in the picture.
    fn seen(&self) -> ViewSet {
        let last = self.session.config.views - 1;
        match self.output() {
            Output::Panel if self.session.config.filter == Filter::Nearest => {
                self.targets.interleaver.shown()
            }
            Output::Interlaced(_) | Output::Anaglyph(_) | Output::Quad => {
                [0, last].into_iter().collect()
            }
            Output::View(view) => [view].into_iter().collect(),
            Output::Rgbd => [].into_iter().collect(),
            _ => ViewSet::ALL,
        }
    }

    /// Whether a picture needs views that were not drawn in this frame; the next one has them all.
    pub(super) fn lacks(&mut self, what: CaptureWhat) -> bool {
        let needed = match what {
            CaptureWhat::Output => self.seen(),
            CaptureWhat::Depth | CaptureWhat::Reference | CaptureWhat::Samples => {
                [].into_iter().collect()
            }
            CaptureWhat::View(view) => [view].into_iter().collect(),
            CaptureWhat::Atlas => ViewSet::ALL,
        };
        let tiles = &self.targets.atlas.tiles;
        self.targets.undrawn = (0..tiles.views).any(|view| needed.has(view) && !tiles.draws(view));
        self.targets.undrawn
    }

    fn wanted(&self) -> (Grid, [u32; 2]) {
        let tiles = &self.targets.atlas.tiles;
        match self.session.config.view_scale {
            // Nothing changes it.
            ViewScale::Fixed(1.0) => (tiles.grid, [tiles.width, tiles.height]),
            _ => self.grid().fit(tiles.window, tiles.views),
        }
    }
}
