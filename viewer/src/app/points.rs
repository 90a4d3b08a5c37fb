//! A cloud of points, of which a frame shows as many as there is time for.

use super::arguments::{Arguments, FPS};
use super::content::Content;
use super::input::Change;
use super::title::Title;
use super::viewpoint::Viewpoint;
use super::window::Window;
use crate::draw::{Buffers, Frame, Renderer};
use crate::load::Loading;
use crate::octree::{Choice, Id};
use crate::pace::Pace;
use crate::prepare::Preparation;
use crate::read::Up;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The first picture waits so long for the file, so that a small one is there whole.
const PATIENCE: Duration = Duration::from_millis(700);
const MOMENT: Duration = Duration::from_millis(2);
/// While the file is read, a node is made ready again once one in so many of its points is new.
const GROWTH: u32 = 3;
/// At most so many points are copied to the graphics card before a frame.
const COPIED: usize = 500_000;

/// The cloud, from where it is seen and what it is drawn with.
pub(super) struct PointCloud {
    title: Title,
    loading: Loading,
    preparation: Preparation,
    viewpoint: Viewpoint,
    pace: Pace,
    buffers: Buffers,
    renderer: Option<Renderer>,
    /// The last choice.
    choice: Choice,
    /// Nothing more is read.
    is_finished: bool,
    opened: Instant,
    is_first: bool,
}

impl PointCloud {
    pub(super) fn new(loading: Loading, up: Up, arguments: &Arguments, threads: usize) -> Self {
        let name = arguments.file.file_name().unwrap_or_default();
        Self {
            title: Title::new(name),
            preparation: Preparation::start(&loading, threads),
            loading,
            viewpoint: Viewpoint::new(up, arguments),
            pace: Pace::new(arguments.fps.unwrap_or(FPS)),
            buffers: Buffers::new(arguments.memory / 2),
            renderer: None,
            choice: Choice::default(),
            is_finished: false,
            opened: Instant::now(),
            is_first: true,
        }
    }

    /// Copies what is ready, and chooses the nodes that are drawn.
    fn choose(&mut self, window: &Window) -> Result<(), String> {
        let mut copied = 0;
        while copied < COPIED
            && let Some(ready) = self.preparation.take()
        {
            copied += ready.points.len();
            self.buffers.set(window.gl(), &ready)?;
        }
        // Before the tree is looked at: what is read after this is seen in the next frame.
        let is_read = self.loading.progress.is_done();
        let Some(tree) = self.loading.tree() else {
            self.is_finished = is_read;
            return Ok(());
        };
        self.viewpoint.follow(&tree, !self.is_finished);
        let Some(camera) = &self.viewpoint.camera else {
            return Ok(());
        };
        let budget = self.pace.budget().min(self.buffers.room());
        let look = camera.look(window.size());
        let buffers = &self.buffers;
        self.choice = tree.choose(&look, budget, &|id| buffers.version(id).is_some());
        let is_stale = |id: &Id| {
            let node = tree.node(*id);
            let old = buffers.version(*id).unwrap_or(node.version);
            let new = node.version.wrapping_sub(old);
            new > 0 && (is_read || new > node.count / GROWTH)
        };
        let drawn = self.choice.drawn.iter().map(|chosen| chosen.id);
        let stale: Vec<_> = drawn.clone().filter(is_stale).collect();
        self.preparation
            .want(self.choice.missing.iter().copied().chain(stale));
        self.is_finished = is_read;
        drop(tree);
        self.buffers.begin(window.gl(), drawn);
        Ok(())
    }

    /// Tells once why the file was not read to its end.
    fn tell_faults(&mut self) {
        if let Some(error) = self.loading.progress.take_error() {
            eprintln!("manyview-points: {error}; the points read before are shown");
        }
    }
}

impl Content for PointCloud {
    fn prepare(&mut self, window: &Window) -> Result<(), String> {
        self.renderer = Some(Renderer::new(window.gl())?);
        Ok(())
    }

    fn is_busy(&self) -> bool {
        self.viewpoint.is_turning() || !self.is_finished || !self.preparation.is_idle()
    }

    fn change(&mut self, change: Change) {
        self.viewpoint.change(change);
    }

    fn draw(&mut self, window: &Window, since: Duration) -> Result<Option<String>, String> {
        self.viewpoint.advance(since);
        self.choose(window)?;
        while self.is_first && self.opened.elapsed() < PATIENCE && self.is_busy() {
            sleep(MOMENT);
            self.choose(window)?;
        }
        let frame = Frame {
            size: window.size(),
            scale: self.viewpoint.scale,
            progress: self.loading.progress.share().filter(|_| !self.is_finished),
        };
        if let (Some(camera), Some(renderer)) = (&self.viewpoint.camera, &self.renderer) {
            let drawn = &self.choice.drawn;
            renderer.draw(window.gl(), &self.buffers, drawn, camera, frame);
            self.is_first = false;
        }
        self.tell_faults();
        Ok(self.title.next(&self.loading))
    }

    fn took(&mut self, time: Duration) {
        self.pace.frame(time, self.choice.is_limited);
    }

    fn title(&self) -> String {
        self.title.text(&self.loading)
    }
}
