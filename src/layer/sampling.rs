//! Resolution of the views: as few texels as the output shows, or the window's own pixels as soon as the program does what only those can
//! hold.

use super::Layer;
use crate::atlas::{Grid, ViewSet};
use crate::config::{CaptureWhat, Config, Filter, Optimisation, Output, ViewScale};
use crate::display::{Display, Placement};
use crate::gl::Gl;
use crate::interleave::Form;
use crate::plan::Unrepresentable;
use crate::plan::decide::{Demand, Detail, retreat};
use crate::view::ViewIndex;

/// The grid of the views of a window of this size. `shader`: the output is made on the GPU, so that it can sample tiles that are aligned with the
/// panel's lenses.
pub(super) fn grid(
    config: &Config,
    display: &Display,
    output: Output,
    ([width, height], placement): ([u32; 2], &Placement),
    detail: Detail,
    shader: bool,
) -> Grid {
    let (window, picture) = ([width, height], [placement.width, placement.height]);
    let scaled = |share: [f64; 2], of: [u32; 2]| {
        let side = |i: usize| (f64::from(of[i]) * share[i]).round() as u32;
        let tile = [0, 1].map(|i| side(i).clamp(1, window[i]));
        Grid::scaled(tile, window)
    };
    match (config.view_scale, detail) {
        (_, Detail::Full) => Grid::FULL,
        (ViewScale::Fixed(scale), _) => scaled([scale; 2], window),
        (ViewScale::Auto, detail) => {
            let form = Form::of(config, display, output);
            (detail == Detail::SampleAligned && shader)
                .then(|| form.sample_aligned(placement, config.views))
                .flatten()
                .map(|grid| grid.resized(picture, window))
                .unwrap_or_else(|| scaled(form.share(config.views), picture))
        }
    }
}

impl Layer {
    /// Whether the program draws to the true framebuffer 0 (see [`crate::atlas::Atlas::plain`]).
    pub(super) fn is_plain(&self) -> bool {
        self.targets.atlas.is_plain()
    }

    pub(super) fn grid(&self) -> Grid {
        grid(
            self.session.config,
            self.session.display(),
            self.output(),
            (self.size().into(), &self.placement()),
            self.targets.detail,
            self.targets.interleaver.on_gpu(),
        )
    }

    /// Goes over to the window's own pixels, because only those can hold what comes. `what` continues the note "because the program".
    pub(super) fn hold_everything(&mut self, gl: &Gl, what: Unrepresentable) {
        if self.targets.stuck {
            return;
        }
        let grid = self.targets.atlas.tiles.grid;
        let demand = Demand::Everything(what);
        if let Some((detail, why)) = retreat(demand, grid.is_full(), grid.is_sample_aligned()) {
            self.give_up(gl, detail, why);
        }
    }

    /// Before a frame is shown: makes the atlas anew, with its contents, where the output now needs tiles of another kind or size.
    pub(super) fn refit(&mut self, gl: &Gl) {
        if self.diagnostics.proving.replays() || self.is_plain() || self.targets.stuck {
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

    /// After a frame was shown: aligns the tiles of the next one with the panel's lenses, because the window may have moved.
    pub(super) fn realign_tiles(&mut self) {
        if self.diagnostics.proving.replays() || self.is_plain() {
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
        if self.is_mono() || self.is_plain() {
            return [].into_iter().collect();
        }
        if self.known.scene.is_some() {
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
        // A proof compares view by view.
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
        let panel = self.seen_in(self.output());
        let window = self.window_output().map(|output| self.seen_in(output));
        window.map_or(panel, |window| panel.union(window))
    }

    /// The views that are in the picture of an output.
    fn seen_in(&self, output: Output) -> ViewSet {
        let last = self.session.config.views - 1;
        match output {
            Output::Panel if self.session.config.filter == Filter::Nearest => {
                self.targets.interleaver.shown()
            }
            Output::Interlaced(_) | Output::Anaglyph(_) | Output::Quad => {
                [0, last].map(ViewIndex).into_iter().collect()
            }
            Output::View(view) => [ViewIndex(view)].into_iter().collect(),
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
            CaptureWhat::View(view) => [ViewIndex(view)].into_iter().collect(),
            CaptureWhat::Atlas => ViewSet::ALL,
        };
        let tiles = &self.targets.atlas.tiles;
        self.targets.undrawn =
            ViewIndex::all(tiles.views).any(|view| needed.has(view) && !tiles.draws(view));
        self.targets.undrawn
    }

    fn wanted(&self) -> (Grid, [u32; 2]) {
        let tiles = &self.targets.atlas.tiles;
        match self.session.config.view_scale {
            // Nothing changes a grid of this scale.
            ViewScale::Fixed(1.0) => (tiles.grid, [tiles.width, tiles.height]),
            _ => self.grid().fit(tiles.window, tiles.views),
        }
    }
}
