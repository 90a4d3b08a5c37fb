//! Flat draws that follow the scene: how far away it is in the middle of the window and under the pointer, by the depths of the last frame.

use super::Layer;
use super::comfort::Taken;
use crate::atlas::DepthPicture;
use crate::config::FlatDepth;
use crate::plan::{SceneDepths, parallax};

/// How far from its place a crosshair looks, in samples of the picture of depths.
const REACH: usize = 2;
/// Part of the way to a new depth that is gone with each frame: a crosshair that jumps is hard to look at.
const STEP: f64 = 0.5;

impl Layer {
    /// Whether draws follow the pointer, so that [`Layer::point`] has to be called before each frame is shown.
    pub fn wants_pointer(&self) -> bool {
        self.session.config.views > 1 && self.cameras.classifier.follows(FlatDepth::Cursor)
    }

    /// Sets where the pointer is: pixels of the window from its left and lower edge.
    pub fn point(&mut self, at: [i32; 2]) {
        self.session.pointer = Some(at);
    }

    /// There is no scene to follow: what follows it stands on the panel.
    pub(super) fn follow_nothing(&mut self) {
        self.cameras.classifier.change_scene(SceneDepths::default());
    }

    /// Sends what follows the scene to where it was in a picture of its depths; `p` is the scene's projection.
    pub(super) fn follow(&mut self, taken: &Taken, picture: &DepthPicture, p: &[f32; 16]) {
        let pointer = self.session.pointer.and_then(|at| self.within(taken, at));
        let before = self.cameras.classifier.scene();
        let depth = |place, before| {
            let found = self.depth_at(taken, picture, p, place);
            found.map_or(0.0, |found| before + STEP * (found - before))
        };
        let scene = SceneDepths {
            middle: depth([0.5; 2], before.middle),
            pointer: pointer.map_or(0.0, |place| depth(place, before.pointer)),
        };
        self.cameras.classifier.change_scene(scene);
    }

    /// A place in the window as parts of a picture's width and height; none outside of it.
    fn within(&self, taken: &Taken, at: [i32; 2]) -> Option<[f64; 2]> {
        let (width, height) = self.size();
        let whole = [0, 0, width as i32, height as i32];
        let area = taken.area.unwrap_or(whole);
        let place = [0, 1].map(|axis| {
            let [low, high] = [area[axis], area[axis + 2]].map(f64::from);
            (f64::from(at[axis]) + 0.5 - low) / (high - low)
        });
        let inside = place.iter().all(|part| (0.0..1.0).contains(part));
        inside.then_some(place)
    }

    /// Where the scene stands at a place of a picture, in parts of the separation at infinity.
    fn depth_at(
        &self,
        taken: &Taken,
        picture: &DepthPicture,
        p: &[f32; 16],
        place: [f64; 2],
    ) -> Option<f64> {
        let around = picture.around(place, REACH);
        let seen = taken.mappings.distances(&around, taken.clear);
        let infinity = self.known.rig.at_depth(p, 1.0)?.separation(1.0);
        let elsewhere = seen.scene.len() + seen.foreground.len() + seen.others.len();
        let beyond = around.len().saturating_sub(elsewhere);
        // What most samples show: beside a thin pole it is the sky.
        let middle = seen.scene.get(seen.scene.len() / 2);
        let disparity = match middle.filter(|_| seen.scene.len() >= beyond) {
            Some(inverse) => {
                let (separation, convergence) = self.cameras_in_force(p)?;
                separation * (1.0 - convergence * inverse)
            }
            // The sky, or nothing at all.
            None if parallax::flat(p) => return None,
            None => self.known.rig.sky(p)?.separation(1.0),
        };
        let depth = disparity / infinity;
        depth.is_finite().then(|| FlatDepth::in_range(depth))
    }
}
