//! The proof on the running program: every so many frames, a frame is drawn twice from the same calls, as always and by replay at the size of
//! the window into a second atlas. Then both are compared.
//!
//! Each draw goes to the second atlas first, and all state is put back; then it goes to the first one as always. So the program sees the
//! state and the framebuffer 0 that it would see without a proof. Such frames are slow and are not timed. Some frames between them are timed:
//! as many by the chosen strategy as by replay alone, in turns.

use super::draw::Images;
use super::{Layer, explain, fit::make_atlas, frame::tile, keep_bindings};
use crate::atlas::{Atlas, Grid, ViewSet};
use crate::config::{Output, Strategy, Word};
use crate::draw::{ReplayHazard, replay};
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::metric::triptych;
use crate::plan::{Kind, Method, Plan, Shear, Traits};
use crate::present::capture;
use crate::report::{Culprit, Difference, Proof, Worst};
use crate::state::{BACK, Neutral};
use crate::view::ViewIndex;
use image::RgbImage;
use std::time::{Duration, Instant};

/// How the frames after a proved one are drawn to be timed; true stands for replay. There are as many of either, and neither is always first.
const TRIALS: [bool; 4] = [false, true, true, false];
/// Number of frames that search for the draw which caused the worst pixel. They are slow: after each draw a view is read from both atlases.
const SEARCHES: u32 = 3;
/// Time that one search may take.
const PATIENCE: Duration = Duration::from_secs(10);

const FRONT: &str = "the program draws to the front buffer or reads from it";
const COPIES: &str = "the program draws with a texture copied from the frame";
const BLOCKS: &str = "shaders compute positions from places on the screen by a matrix in a uniform block, which each view has of its own";
const WRITES: &str = "the program's shaders write to memory";
const ACCUM: &str = "the program uses the accumulation buffer";
const ONCE: &str = "a profile keeps draws in the program's own view only";
const STACK: &str = "the program's attribute stack was full";
const LISTS: &str = "the program draws while it compiles a display list";
const CHANGED: &str = "the window's size or format changed in the middle of the frame";
const EMPTY: &str = "nothing was drawn";
const MEMORY: &str = "the driver makes no second atlas";

/// Role of the frame that is being drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Now {
    #[default]
    Plain,
    Proved,
    Timed {
        by_replay: bool,
    },
}

/// State of the proof: some of it is kept from frame to frame, some belongs to the frame that is being drawn.
#[derive(Debug, Default)]
pub(super) struct Proving {
    /// The second atlas, which replay draws to. While a frame is drawn by replay alone, the two atlases change places.
    atlas: Option<Atlas>,
    now: Now,
    /// Why the frame cannot be compared.
    refused: Option<&'static str>,
    /// The frame's first draw or clear was made.
    begun: bool,
    /// The frame did not begin with a clear of the whole window, so it shows contents of earlier frames. Kept until the next proved frame,
    /// because a program begins all its frames alike.
    keeps_contents: bool,
    /// Start of a frame that is timed.
    since: Option<Instant>,
    trials: usize,
    search: Option<Search>,
    searches: u32,
    /// The view with a pixel whose draw is to be found.
    suspect: Option<ViewIndex>,
}

/// A draw to the window.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    facts: Traits,
    class: &'static str,
    method: Method,
}

/// A search for the draws that made pixels of one view differ.
#[derive(Debug)]
struct Search {
    view: ViewIndex,
    draws: Vec<Drawn>,
    /// For each pixel that differs, the number of draws when it began to; else 0.
    since: Vec<usize>,
    /// A draw has been made since the view was read.
    pending: bool,
    began: Instant,
}

impl Search {
    fn attribute(&mut self, [exact, shown]: &[RgbImage; 2]) {
        self.pending = false;
        self.since.resize(exact.pixels().len(), 0);
        let pixels = exact.pixels().zip(shown.pixels());
        for (since, (exact, shown)) in self.since.iter_mut().zip(pixels) {
            if exact == shown {
                *since = 0;
            } else if *since == 0 {
                *since = self.draws.len();
            }
        }
    }

    /// The draw that caused the worst pixel of the view at the end of the frame.
    fn culprit(&self, frame: u64, width: u32, difference: &Difference) -> Option<Culprit> {
        let [x, y] = difference.at();
        let since = *self.since.get(y as usize * width as usize + x as usize)?;
        let drawn = self.draws.get(since.checked_sub(1)?)?;
        Some(Culprit {
            worst: Worst {
                difference: difference.worst(),
                x,
                y,
                frame,
            },
            view: self.view.0,
            draw: drawn.facts.draw,
            kind: explain::kind(drawn.facts.kind),
            class: drawn.class.to_owned(),
            method: super::draw::method_name(drawn.method).to_owned(),
            texture: drawn.facts.texture.0,
            list: drawn.facts.list.map(|list| list.0),
        })
    }
}

impl Proving {
    fn proves(&self) -> bool {
        self.now == Now::Proved && self.refused.is_none() && self.atlas.is_some()
    }

    /// Whether the frame is drawn by replay alone, to the second atlas.
    pub(super) fn replays(&self) -> bool {
        self.now == Now::Timed { by_replay: true }
    }

    fn refuse(&mut self, why: &'static str) {
        self.refused.get_or_insert(why);
        self.search = None;
    }

    /// Refuses the comparison, because a draw while a display list is compiled goes to one atlas only.
    pub(super) fn refuse_lists(&mut self) {
        self.refuse(LISTS);
    }

    /// Ends the search, because something is drawn that is not among its draws.
    pub(super) fn stop_search(&mut self) {
        self.search = None;
    }

    /// The last draw was made by replay after all.
    pub(super) fn replayed(&mut self) {
        let search = self.search.as_mut();
        if let Some(last) = search.and_then(|search| search.draws.last_mut()) {
            last.method = Method::Replay;
        }
    }

    /// The second atlas.
    pub(super) fn atlas(&self) -> Option<&Atlas> {
        self.atlas.as_ref()
    }
}

impl Layer {
    /// Notes a draw that is about to be made.
    pub(super) fn prove_this(&mut self, gl: &Gl, facts: &Traits, plan: &Plan) {
        let first = match self.diagnostics.proving.now {
            Now::Plain => return,
            Now::Proved if !self.state.draws_to_window() => return,
            Now::Proved | Now::Timed { .. } => {
                !std::mem::replace(&mut self.diagnostics.proving.begun, true)
            }
        };
        if let Now::Timed { .. } = self.diagnostics.proving.now {
            if first {
                gl.finish();
                self.diagnostics.proving.since = Some(Instant::now());
            }
            return;
        }
        if first {
            let clears = matches!(facts.kind, Kind::Clear { .. });
            self.diagnostics.proving.keeps_contents = !clears || self.state.rectangles.scissor_test;
        }
        match plan.method {
            Method::Once if self.state.primitives.render_mode == c::RENDER => {
                self.diagnostics.proving.refuse(ONCE)
            }
            _ if facts.kind == Kind::Accum => self.diagnostics.proving.refuse(ACCUM),
            _ => {}
        }
        self.attribute_last_draw(gl);
        if let Some(search) = &mut self.diagnostics.proving.search {
            search.draws.push(Drawn {
                facts: *facts,
                class: plan.class.word(),
                method: plan.method,
            });
            search.pending = true;
        }
    }

    /// Sends a draw, or a clear, to the second atlas by replay, if the frame is proved. All state is as before.
    pub(super) fn prove(
        &mut self,
        gl: &Gl,
        shear: Option<Shear>,
        hazard: ReplayHazard,
        images: &Images,
        call: &mut dyn FnMut(ViewIndex),
    ) {
        if !self.diagnostics.proving.proves() {
            return;
        }
        if !self.state.draws_to_window() {
            return;
        }
        if images.differ() {
            return self.diagnostics.proving.refuse(COPIES);
        }
        if !images.unprojections.in_blocks.is_empty() {
            return self.diagnostics.proving.refuse(BLOCKS);
        }
        if self.writes_memory() {
            return self.diagnostics.proving.refuse(WRITES);
        }
        let mut sent = true;
        self.in_proof(gl, |layer| {
            let (atlas, state, rig) = (&mut layer.targets.atlas, &layer.state, &layer.known.rig);
            sent = replay(gl, atlas, state, rig, shear, hazard, false, call);
        });
        if !sent {
            self.diagnostics.proving.refuse(STACK);
        }
    }

    /// Runs `work` with the second atlas in the place of the first one, if the frame is proved; queries do not count it.
    pub(super) fn in_proof(&mut self, gl: &Gl, work: impl FnOnce(&mut Self)) {
        if self.diagnostics.proving.proves() && self.state.framebuffers.uses_front() {
            self.diagnostics.proving.refuse(FRONT);
        }
        if !self.diagnostics.proving.proves() {
            return;
        }
        let mut queries = std::mem::take(&mut self.queries);
        queries.pause(gl);
        self.change_places();
        self.bind_draw(gl, true, true);
        work(self);
        self.change_places();
        self.bind_draw(gl, true, true);
        queries.resume(gl);
        self.queries = queries;
    }

    fn change_places(&mut self) {
        if let Some(other) = &mut self.diagnostics.proving.atlas {
            std::mem::swap(&mut self.targets.atlas, other);
        }
    }

    /// The picture that the window would show of the second atlas. The true framebuffer 0 is bound and is drawn to.
    pub(super) fn exact_picture(
        &mut self,
        gl: &Gl,
        image: u32,
        neutral: &Neutral,
    ) -> Option<RgbImage> {
        // These outputs are made of more than one picture of colours.
        let single = !matches!(self.output(), Output::Quad | Output::Rgbd);
        if !single || !self.diagnostics.proving.proves() || !self.frame.drawn() {
            return None;
        }
        self.change_places();
        self.targets
            .atlas
            .resolve(gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        self.draw_picture(gl, image, None, neutral);
        self.change_places();
        Some(self.window_picture(gl, neutral))
    }

    fn window_picture(&self, gl: &Gl, neutral: &Neutral) -> RgbImage {
        let (width, height) = self.size();
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
        capture::read_rgb(gl, neutral, 0, 0, width, height)
    }

    /// After the picture was drawn: compares, or takes the time. `exact` is the picture of the second atlas, where the two can be compared.
    pub(super) fn judge_proof(&mut self, gl: &Gl, neutral: &Neutral, exact: Option<RgbImage>) {
        let now = self.diagnostics.proving.now;
        if let (Now::Timed { by_replay }, Some(since)) =
            (now, self.diagnostics.proving.since.take())
        {
            gl.finish();
            let ms = since.elapsed().as_secs_f64() * 1e3;
            self.tell(|proof| proof.timed(by_replay, ms));
        }
        if now == Now::Proved {
            let refused = self
                .diagnostics
                .proving
                .refused
                .or((!self.frame.drawn()).then_some(EMPTY));
            if let Some(why) = refused {
                self.diagnostics.proving.search = None;
                self.tell(|proof| proof.skipped(why));
            } else {
                self.compare(gl, neutral, exact);
            }
        }
    }

    fn tell(&mut self, what: impl FnOnce(&mut Proof)) {
        let frame = self.diagnostics.report.frames() + 1;
        if let Some(proof) = &mut self.diagnostics.report.proof {
            what(proof);
        }
        self.diagnostics.write(self.session.config, frame);
    }

    fn compare(&mut self, gl: &Gl, neutral: &Neutral, exact: Option<RgbImage>) {
        let frame = self.diagnostics.report.frames() + 1;
        let shown = exact.as_ref().map(|_| self.window_picture(gl, neutral));
        let panel: Vec<_> = exact
            .zip(shown)
            .and_then(|(exact, shown)| Difference::new(&exact, &shown))
            .into_iter()
            .collect();
        self.resolve_both(gl);
        let mut search = self.diagnostics.proving.search.take();
        let mut culprit = None;
        let mut views: Vec<Difference> = Vec::new();
        let mut least = self
            .diagnostics
            .report
            .proof
            .as_ref()
            .map_or(0.0, Proof::psnr);
        let mut worst_pair = None;
        for view in ViewIndex::all(self.session.config.views) {
            let pair = self.pair(gl, neutral, view);
            let Some(difference) = Difference::new(&pair[0], &pair[1]) else {
                return;
            };
            if let Some(search) = search.as_mut().filter(|search| search.view == view) {
                if search.pending {
                    search.attribute(&pair);
                }
                culprit = search.culprit(frame, pair[0].width(), &difference);
            }
            if difference.psnr() < least {
                least = difference.psnr();
                worst_pair = Some(pair);
            }
            views.push(difference);
        }
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        let picture = worst_pair.and_then(|[exact, shown]| self.draw_failure(&exact, &shown));
        let carried = self.diagnostics.proving.keeps_contents;
        self.tell(|proof| {
            proof.frame(frame, carried, &views, &panel);
            culprit.into_iter().for_each(|c| proof.culprit(c));
            picture.into_iter().for_each(|file| proof.picture(file));
        });
        let explained = self
            .diagnostics
            .report
            .proof
            .as_ref()
            .map_or(0, Proof::worst_explained);
        let worst = (0..).zip(&views).max_by_key(|(_, d)| d.worst());
        self.diagnostics.proving.suspect = worst
            .filter(|(_, d)| d.worst() > explained)
            .map(|(view, _)| ViewIndex(view));
    }

    /// Writes the picture by replay, the difference and the picture that is shown to a file beside the report, and returns its path.
    fn draw_failure(&mut self, exact: &RgbImage, shown: &RgbImage) -> Option<String> {
        let config = self.session.config;
        let report = config.report.as_ref()?;
        let file = report.with_extension("proof.png");
        let file = self.diagnostics.report.claims.path(config, report, file);
        match capture::write(&triptych(exact, shown), &file) {
            Ok(()) => Some(file.display().to_string()),
            Err(error) => {
                self.diagnostics
                    .report
                    .note(format!("picture of the proof: {error}"));
                None
            }
        }
    }

    fn resolve_both(&self, gl: &Gl) {
        self.targets
            .atlas
            .resolve(gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
        if let Some(other) = &self.diagnostics.proving.atlas {
            other.resolve(gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
        }
    }

    /// A view by replay, and as it is shown, stretched to the window where it has fewer pixels. The state is neutral; changes the
    /// framebuffers that are bound.
    fn pair(&mut self, gl: &Gl, neutral: &Neutral, view: ViewIndex) -> [RgbImage; 2] {
        let exact = self.diagnostics.proving.atlas.as_ref();
        let exact = exact.map_or_else(RgbImage::default, |atlas| tile(gl, neutral, atlas, view));
        if self.targets.atlas.tiles.grid.is_full() {
            return [exact, tile(gl, neutral, &self.targets.atlas, view)];
        }
        self.make_singles(gl, false);
        self.targets.atlas.take_single(gl, view, BACK);
        let (width, height) = self.size();
        [exact, capture::read_rgb(gl, neutral, 0, 0, width, height)]
    }

    /// Before a draw: finds the pixels that the draw before it has made differ.
    fn attribute_last_draw(&mut self, gl: &Gl) {
        let Some(mut search) = self.diagnostics.proving.search.take() else {
            return;
        };
        if search.began.elapsed() > PATIENCE {
            return self.diagnostics.report.note(format!(
                "the draw that brought the worst pixel was not found within {} s",
                PATIENCE.as_secs()
            ));
        }
        if search.pending {
            let view = search.view;
            let pair = self.in_neutral(gl, |layer, neutral| {
                layer.reading(gl, BACK, |layer| {
                    layer.resolve_both(gl);
                    layer.pair(gl, neutral, view)
                })
            });
            search.attribute(&pair);
        }
        self.diagnostics.proving.search = Some(search);
    }

    /// At the end of a frame: decides how the next one is drawn. The state is neutral; changes the framebuffers that are bound.
    pub(super) fn next_proof(&mut self, gl: &Gl) {
        let Some(every) = self.session.config.prove else {
            return;
        };
        if self.diagnostics.proving.replays() {
            self.choose_again(gl, true);
        }
        self.diagnostics.proving.now = Now::Plain;
        self.diagnostics.proving.refused = None;
        self.diagnostics.proving.begun = false;
        self.diagnostics.proving.search = None;
        // The number of the next frame: this one is not counted yet.
        let at = (self.diagnostics.report.frames() + 2) % every;
        if at == 0 {
            self.begin_proof(gl);
        } else if at <= TRIALS.len() as u64 && self.diagnostics.proving.atlas.is_some() {
            self.begin_trial(gl);
        }
    }

    fn uses_front(&self) -> bool {
        self.targets.atlas.has_front() || self.state.framebuffers.uses_front()
    }

    fn begin_proof(&mut self, gl: &Gl) {
        self.diagnostics.proving.now = Now::Proved;
        if self.uses_front() {
            return self.diagnostics.proving.refuse(FRONT);
        }
        if self.diagnostics.proving.atlas.is_none() {
            let (names, window) = (&mut self.targets.names, &self.state.window);
            match make_atlas(gl, names, &self.session, window, Grid::FULL) {
                Ok(atlas) => self.diagnostics.proving.atlas = Some(atlas),
                Err(error) => {
                    self.diagnostics
                        .report
                        .note(format!("nothing is proved: {error}"));
                    return self.diagnostics.proving.refuse(MEMORY);
                }
            }
            self.apply_buffers(gl);
        }
        self.copy_to_second(gl);
        if let Some(view) = self.diagnostics.proving.suspect.take()
            && self.diagnostics.proving.searches < SEARCHES
        {
            self.diagnostics.proving.searches += 1;
            self.diagnostics.proving.search = Some(Search {
                view,
                draws: Vec::new(),
                since: Vec::new(),
                pending: false,
                began: Instant::now(),
            });
        }
    }

    /// Copies the first atlas to the second one, for what the program does not clear.
    fn copy_to_second(&mut self, gl: &Gl) {
        let Some(mut other) = self.diagnostics.proving.atlas.take() else {
            return;
        };
        self.reading(gl, BACK, |layer| {
            if other.tiles.lies_like(&layer.targets.atlas.tiles) {
                return other.copy(gl, &layer.targets.atlas);
            }
            let (names, window) = (&mut layer.targets.names, &layer.state.window);
            keep_bindings(gl, || {
                other.copy_spread(gl, &mut layer.targets.atlas, names, window);
            });
        });
        self.diagnostics.proving.atlas = Some(other);
    }

    fn begin_trial(&mut self, gl: &Gl) {
        let full = self.targets.atlas.tiles.grid.is_full();
        // Contents of earlier frames, the front buffer and the accumulation buffer would have to be in the second atlas as well.
        if self.uses_front()
            || self.targets.accumulated.buffer.is_some()
            || self.diagnostics.proving.keeps_contents && !full
        {
            return;
        }
        let trial = TRIALS.get(self.diagnostics.proving.trials % TRIALS.len());
        let by_replay = trial.is_some_and(|by_replay| *by_replay);
        self.diagnostics.proving.trials += 1;
        self.diagnostics.proving.now = Now::Timed { by_replay };
        if by_replay {
            if full {
                self.copy_to_second(gl);
            }
            self.session.strategy = Strategy::Replay;
            self.put_other(gl);
        }
    }

    /// After a frame by replay alone: returns to the chosen strategy and the first atlas. `whole`: the frame is at its end.
    fn choose_again(&mut self, gl: &Gl, whole: bool) {
        self.diagnostics.proving.now = Now::Plain;
        self.session.strategy = self.session.chosen();
        let full = |atlas: &Atlas| atlas.tiles.grid.is_full();
        if whole && self.diagnostics.proving.atlas.as_ref().is_some_and(full) {
            self.copy_to_second(gl);
        }
        self.put_other(gl);
    }

    fn put_other(&mut self, gl: &Gl) {
        self.change_places();
        self.cameras.comfort.leave_pictures();
        self.apply_buffers(gl);
    }

    /// Deletes the second atlas, because the window or the names of our textures change. The caller binds framebuffers.
    pub(super) fn drop_proof(&mut self, gl: &Gl) {
        if self.diagnostics.proving.replays() {
            self.choose_again(gl, false);
        }
        if self.diagnostics.proving.now == Now::Proved {
            self.diagnostics.proving.refuse(CHANGED);
        }
        if let Some(other) = self.diagnostics.proving.atlas.take() {
            other.delete(gl);
        }
    }
}
