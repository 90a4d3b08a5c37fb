//! A cloud of Gaussians, sorted again whenever the viewer has moved.

use super::arguments::Arguments;
use super::content::Content;
use super::input::Change;
use super::title::grouped;
use super::viewpoint::Viewpoint;
use super::window::Window;
use crate::draw::GaussianRenderer;
use crate::gaussian::Gaussians;
use crate::gaussian::sort::Sorted;
use crate::read::Up;
use glam::{Mat4, Vec3};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::Duration;

/// Where a viewer is: view matrix and place.
type Place = (Mat4, Vec3);

/// The cloud, from where it is seen and what it is drawn with.
pub(super) struct GaussianCloud {
    name: String,
    gaussians: Arc<Gaussians>,
    /// Middle and radius.
    extent: (Vec3, f32),
    viewpoint: Viewpoint,
    renderer: Option<GaussianRenderer>,
    /// To the thread that sorts, and from it.
    wanted: Sender<Place>,
    sorted: Receiver<(Place, Sorted)>,
    /// For which place the order is made, and for which one it was.
    sorting: Option<Place>,
    shown: Option<Place>,
}

impl GaussianCloud {
    pub(super) fn new(gaussians: Gaussians, up: Up, arguments: &Arguments) -> Self {
        let mut viewpoint = Viewpoint::new(up, arguments);
        let extent = gaussians.extent();
        viewpoint.see(extent);
        if arguments.fps.is_some() {
            eprintln!("manyview-points: --fps has no effect on Gaussians, of which all are drawn");
        }
        let gaussians = Arc::new(gaussians);
        let (wanted, places) = channel::<Place>();
        let (sender, sorted) = channel();
        let own = gaussians.clone();
        thread::spawn(move || {
            for (view, eye) in places {
                let sorted = Sorted::new(&own, &view, eye);
                if sender.send(((view, eye), sorted)).is_err() {
                    return;
                }
            }
        });
        let name = arguments.file.file_name().unwrap_or_default();
        Self {
            name: name.to_string_lossy().into_owned(),
            gaussians,
            extent,
            viewpoint,
            renderer: None,
            wanted,
            sorted,
            sorting: None,
            shown: None,
        }
    }

    /// Takes an order that is ready, and asks for another where the viewer has moved. The first one is waited for.
    fn sort(&mut self, window: &Window, place: Place) {
        if self.sorting.is_none() && self.shown != Some(place) && self.wanted.send(place).is_ok() {
            self.sorting = Some(place);
        }
        let ready = match self.shown {
            None => self.sorted.recv().ok(),
            Some(_) => self.sorted.try_recv().ok(),
        };
        if let (Some((place, sorted)), Some(renderer)) = (ready, &mut self.renderer) {
            renderer.set(window.gl(), sorted);
            self.shown = Some(place);
            self.sorting = None;
        }
    }
}

impl Content for GaussianCloud {
    fn prepare(&mut self, window: &Window) -> Result<(), String> {
        self.renderer = Some(GaussianRenderer::new(window.gl(), &self.gaussians)?);
        Ok(())
    }

    fn is_busy(&self) -> bool {
        self.viewpoint.is_turning() || self.sorting.is_some()
    }

    fn change(&mut self, change: Change) {
        self.viewpoint.change(change);
        self.viewpoint.see(self.extent);
    }

    fn draw(&mut self, window: &Window, since: Duration) -> Result<Option<String>, String> {
        self.viewpoint.advance(since);
        let Some(camera) = self.viewpoint.camera else {
            return Ok(None);
        };
        let size = window.size();
        self.sort(window, (camera.view(), camera.look(size).eye));
        if let Some(renderer) = &self.renderer {
            renderer.draw(window.gl(), &camera, size, self.viewpoint.scale);
        }
        Ok(None)
    }

    fn took(&mut self, _: Duration) {}

    fn title(&self) -> String {
        let mut title = format!(
            "{} - {} Gaussians",
            self.name,
            grouped(self.gaussians.all.len() as u64)
        );
        if self.gaussians.skipped > 0 {
            title += &format!(", {} left out", grouped(self.gaussians.skipped));
        }
        title
    }
}
