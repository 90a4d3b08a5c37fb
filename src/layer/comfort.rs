//! Cameras that follow the depth buffer, and the disparities of the frames: which depths are read, and when.

use super::{Layer, keep_bindings};
use crate::config::{Camera, Config, Kept};
use crate::display::Budget;
use crate::gl::{BufferName, FramebufferName, Gl, consts as c};
use crate::plan::decide::DepthWatch;
use crate::plan::depths::{DepthMapping, Distances};
use crate::plan::{Cuts, DepthMappings, Shear, Slant, Slanting, comfort, orthographic, parallax};
use crate::report::Disparity;
use crate::state::Neutral;

/// State of the measurement of depths.
#[derive(Debug)]
pub(super) struct Comfort {
    readers: Readers,
    cameras: comfort::Comfort,
    /// The same for an orthographic scene.
    slanting: Slanting,
    /// Separation and convergence that were found, in force from the next frame on.
    next: Option<(f64, f64)>,
    /// The same of what is drawn before everything else, where they differ.
    foreground: Option<(f64, f64)>,
    /// Cameras of an orthographic scene that were found, in force from the next frame on.
    slant: Option<Slant>,
    pub(super) mappings: DepthMappings,
    /// Depth pictures of this frame; `sent` has those of the previous one that were not read yet.
    taken: Vec<Taken>,
    sent: Vec<Taken>,
    /// The pictures in `sent` are of other cameras or of another atlas, and must not be used.
    stale: bool,
    /// Jumps of the program's camera.
    pub(super) cuts: Cuts,
    /// See [`Layer::tell_of_orthographic_scene`].
    pub(super) told_orthographic: bool,
}

/// Who reads the depths.
#[derive(Clone, Copy, Debug, Default)]
struct Readers {
    /// The cameras follow them, or the report has disparities.
    cameras: bool,
    /// Flat draws follow the scene.
    draws: bool,
}

/// What has to be known to use one depth picture.
#[derive(Clone, Debug)]
pub(super) struct Taken {
    frame: u64,
    pub(super) mappings: DepthMappings,
    pub(super) clear: f32,
    /// The part of the window that the picture shows: left, bottom, right, top in its pixels; none for a framebuffer of the program's.
    pub(super) area: Option<[i32; 4]>,
    /// Separation and convergence that the frame is drawn with.
    cameras: Option<(f64, f64)>,
    /// The same of what is drawn before everything else.
    foreground: Option<(f64, f64)>,
    /// Disparity of a sky, in pixels of the window.
    sky: f64,
}

impl Comfort {
    pub(super) fn new(config: &Config, camera: Camera) -> Self {
        let mut comfort = Comfort {
            readers: Readers::default(),
            cameras: comfort::Comfort::new(None),
            next: None,
            foreground: None,
            slanting: Slanting::default(),
            slant: None,
            mappings: DepthMappings::default(),
            taken: Vec::new(),
            sent: Vec::new(),
            stale: false,
            cuts: Cuts::default(),
            told_orthographic: false,
        };
        comfort.change(config, camera, config.profile.focal_depth);
        comfort
    }

    /// Whether depths are read.
    pub(super) fn looks(&self) -> bool {
        self.readers.cameras || self.readers.draws
    }

    /// Has depths read for flat draws, or no longer.
    pub(super) fn follow(&mut self, follows: bool) {
        self.readers.draws = follows;
    }

    /// The user asks for other cameras; `focal` is the focal depth of the profile.
    pub(super) fn change(&mut self, config: &Config, camera: Camera, focal: Option<f64>) {
        let measured = match camera {
            Camera::Measured(kept) => {
                let focal = focal.map(Kept::FocalDepth);
                self.cameras = comfort::Comfort::new(kept.or(focal));
                (self.next, self.foreground) = (None, None);
                (self.slant, self.slanting) = (None, Slanting::default());
                self.stale = !self.sent.is_empty();
                true
            }
            _ => false,
        };
        self.readers.cameras = config.views > 1 && (measured || config.report.is_some());
    }

    /// The depths of the frames before say nothing of this one.
    pub(super) fn restart(&mut self) {
        self.cameras.restart();
        (self.next, self.foreground) = (None, None);
        self.stale = !self.sent.is_empty();
    }

    /// Whether cameras were found, for a scene in perspective or an orthographic one.
    pub(super) fn has_found(&self) -> bool {
        self.next.is_some() || self.slant.is_some()
    }

    /// The next frame is drawn to another atlas: the depth pictures of this one are not used.
    pub(super) fn leave_pictures(&mut self) {
        self.stale = !self.sent.is_empty();
    }
}

impl Layer {
    /// Reads the depths of the previous frame, if they have arrived. With a driver that is a frame behind they have not, and are read at the
    /// end of this frame.
    pub(super) fn begin_frame(&mut self, gl: &Gl) {
        self.known.rig.set_reach(self.reach());
        self.tell_of_orthographic_scene();
        if self.cameras.comfort.sent.is_empty() || !self.targets.atlas.depths_are_there(gl) {
            return;
        }
        let pack = BufferName(gl.get_integer(c::PIXEL_PACK_BUFFER_BINDING) as u32);
        self.read_depths(gl);
        gl.bind_buffer(c::PIXEL_PACK_BUFFER, pack);
        self.set_measured_cameras();
    }

    fn set_measured_cameras(&mut self) {
        if let Camera::Measured(_) = self.session.live.camera {
            let budget = self.reach().budget;
            if let Some(cameras) = self.cameras.comfort.next {
                let farthest = self.cameras.comfort.cameras.farthest(cameras, budget);
                let foreground = self.cameras.comfort.foreground;
                self.known.rig.set_measured(cameras, farthest, foreground);
            }
            if let Some(slant) = self.cameras.comfort.slant {
                self.known.rig.set_slant(slant);
            }
        }
    }

    /// Takes a depth picture within a frame, before a draw or clear.
    pub(super) fn save_depths(&mut self, gl: &Gl) {
        self.in_neutral(gl, |layer, neutral| layer.take_depths(gl, neutral));
    }

    /// Takes a depth picture of the scene, if there is anything to take.
    fn take_depths(&mut self, gl: &Gl, neutral: &Neutral) {
        self.known.depths.pending = false;
        let framebuffer = self.known.depths.framebuffer;
        let there = !framebuffer.is_zero() || self.state.window.bits[4] > 0;
        if !there || self.cameras.comfort.mappings.is_empty() {
            return;
        }
        // The buffer holds the pictures of one frame.
        if self.cameras.comfort.taken.is_empty() {
            self.read_depths(gl);
        }
        let first = !self.targets.atlas.has_depths();
        if first {
            self.state.keep_errors(gl);
            let (names, window) = (&mut self.targets.names, &self.state.window);
            keep_bindings(gl, || self.targets.atlas.make_depths(gl, names, window));
            self.refuse_depths_of_errors(gl);
        }
        let clear = gl.get_floats::<1>(c::DEPTH_CLEAR_VALUE)[0];
        let taken = match framebuffer.is_zero() {
            true => {
                let area = self.known.depths.area;
                self.targets.atlas.take_depths(gl, neutral, area)
            }
            false => self.take_depths_of(gl, neutral, framebuffer),
        };
        if first {
            self.refuse_depths_of_errors(gl);
        }
        if taken {
            let mappings = self.cameras.comfort.mappings.clone();
            let way = mappings.most().map(|way| way.projection);
            self.cameras.comfort.taken.push(Taken {
                frame: self.diagnostics.report.frames() + 1,
                cameras: way.and_then(|p| self.cameras_in_force(&p)),
                foreground: way.and_then(|p| numbers(self.known.rig.foreground(&p))),
                sky: way
                    .and_then(|p| self.known.rig.sky(&p))
                    .map_or(0.0, |shear| shear.separation(1.0) * self.half_width()),
                mappings,
                clear,
                area: framebuffer.is_zero().then_some(self.known.depths.area),
            });
        }
    }

    /// Takes no depths any more where the layer's calls have brought errors, which the program does not see.
    fn refuse_depths_of_errors(&mut self, gl: &Gl) {
        if gl.drop_errors() > 0 {
            self.targets.atlas.refuse_depths();
            let why = "disparities are not measured: the driver makes no picture of the depths";
            self.diagnostics.report.note(why.into());
        }
    }

    /// Takes the depths of a framebuffer of the program's.
    fn take_depths_of(&mut self, gl: &Gl, neutral: &Neutral, framebuffer: FramebufferName) -> bool {
        let offscreen = &mut self.targets.offscreen;
        let first = offscreen.lacks_depths(gl, framebuffer);
        if first {
            self.state.keep_errors(gl);
            offscreen.make_depths(gl, framebuffer);
            gl.drop_errors();
        }
        let small = offscreen.shrink_depths(gl, framebuffer, self.known.depths.area);
        let taken = small.is_some_and(|(small, size)| {
            self.targets.atlas.take_depths_of(gl, neutral, small, size)
        });
        let refused = first && gl.drop_errors() > 0;
        if refused {
            offscreen.refuse_depths(gl, framebuffer);
        }
        taken && !refused
    }

    /// At the end of a frame: reads the depths of the previous one, and takes those of this one. Changes the framebuffer bindings.
    pub(super) fn track_depths(&mut self, gl: &Gl, neutral: &Neutral) {
        if !self.cameras.comfort.looks() {
            return;
        }
        if self.known.depths.pending && !self.known.depths.overwritten {
            self.take_depths(gl, neutral);
        }
        if self.cameras.comfort.taken.is_empty() {
            self.read_depths(gl);
        }
        self.cameras.comfort.sent = std::mem::take(&mut self.cameras.comfort.taken);
        let without_depths = self.cameras.comfort.sent.is_empty();
        self.targets.atlas.send_depths(gl);
        if without_depths {
            self.follow_nothing();
        }
        let measured = matches!(self.session.live.camera, Camera::Measured(_));
        if measured && !self.cameras.comfort.has_found() {
            // No cameras were found yet: it is better to wait for the depths than to show another shallow frame.
            self.read_depths(gl);
        }
        if measured
            && without_depths
            && !self.cameras.comfort.has_found()
            && let Some(p) = self.known.depths.projection.filter(|p| !parallax::flat(p))
        {
            let (_, scale) = parallax::lens(&p);
            let planes = parallax::planes(&p).map(|distance| distance * scale);
            let limits = self.reach().limits(parallax::lens(&p));
            let comfort = &mut self.cameras.comfort;
            let seen = comfort::Seen::by_planes(planes);
            comfort.next = comfort.cameras.assume(&seen, &limits);
        }
        self.set_measured_cameras();
        self.cameras.comfort.cuts.end_frame();
        self.known.depths = DepthWatch::default();
        self.cameras.comfort.mappings = DepthMappings::default();
    }

    fn read_depths(&mut self, gl: &Gl) {
        let sent = std::mem::take(&mut self.cameras.comfort.sent);
        if sent.is_empty() {
            return;
        }
        let pictures = self.targets.atlas.read_depths(gl);
        // After a change of the window's size the atlas is another one, with other pictures.
        let stale = std::mem::take(&mut self.cameras.comfort.stale);
        if stale || pictures.len() != sent.len() {
            return;
        }
        let mut all = Distances::default();
        for (picture, taken) in pictures.iter().zip(&sent) {
            all.join(taken.mappings.distances(&picture.depths, taken.clear));
        }
        let most = |(_, taken): &(_, &Taken)| taken.mappings.most().map(DepthMapping::draws);
        if let Some((picture, taken)) = pictures.iter().zip(&sent).max_by_key(most)
            && let Some(way) = taken.mappings.most()
        {
            if let Some(scene) = all.scene() {
                self.judge(taken, &way.projection, scene, &all);
            }
            if self.cameras.comfort.readers.draws {
                self.follow(taken, picture, &way.projection);
            }
        }
    }

    /// The disparity that the display can show between neighbouring views.
    fn budget(&self) -> Budget {
        let (width, views) = (
            self.session.picture_width(self.size()),
            self.session.config.views,
        );
        match self.output().is_stereo() {
            true => self.session.config.display.budget_of_eyes(views, width),
            false => self.session.config.display.budget(views, width),
        }
    }

    /// What the display can show, in normalised device coordinates.
    fn reach(&self) -> comfort::Reach {
        let budget = self.budget();
        comfort::Reach {
            budget: budget.px / self.half_width(),
            neighbours: budget.neighbours,
        }
    }

    /// Pixels of the panel per unit of normalised device coordinates.
    fn half_width(&self) -> f64 {
        f64::from(self.session.picture_width(self.size())) / 2.0
    }

    /// Finds the cameras for the distances that were seen in a frame; `p` is the projection of its scene.
    fn find_cameras(&mut self, p: &[f32; 16], seen: &comfort::Seen) {
        if let Camera::Measured(_) = self.session.live.camera {
            if parallax::flat(p) {
                return self.find_slant(p, seen);
            }
            let limits = self.reach().limits(parallax::lens(p));
            self.cameras.comfort.next = self.cameras.comfort.cameras.track(seen, &limits);
        }
    }

    /// The same for an orthographic scene, whose distances are parts of the way from the far plane to the near one.
    fn find_slant(&mut self, p: &[f32; 16], seen: &comfort::Seen) {
        let (reach, planes) = (self.reach(), self.depth_planes());
        let most = orthographic::orthoscopic(p, &planes, reach.neighbours);
        if let Some([far, near]) = seen.scene {
            let ends = [1.0 - near, 1.0 - far];
            let slanting = &mut self.cameras.comfort.slanting;
            self.cameras.comfort.slant = slanting.track(ends, reach.budget, most);
        }
    }

    /// Separation and convergence of a scene with this projection, as for distances 1/w; for an orthographic scene, whose distances are parts of
    /// the way from the far plane to the near one, those that give the same disparities.
    pub(super) fn cameras_in_force(&self, p: &[f32; 16]) -> Option<(f64, f64)> {
        if !parallax::flat(p) {
            return numbers(self.known.rig.shear(p));
        }
        let planes = self.depth_planes();
        let shear = self.known.rig.orthographic(p, &planes)?;
        let beyond = planes.at(1.0) - shear.conv;
        Some((shear.separation(1.0) * beyond, planes.extent() / beyond))
    }

    /// Finds the cameras for a frame with these distances (1/w), and adds its disparities to the report.
    fn judge(
        &mut self,
        taken: &Taken,
        p: &[f32; 16],
        [far, middle, near]: [f64; 3],
        all: &Distances,
    ) {
        let (_, scale) = parallax::lens(p);
        let ratios = all.others.iter();
        let ratios = ratios.map(|(inverse, focal)| inverse * focal * scale);
        let range = |r: Option<[f64; 2]>, v: f64| r.map_or([v; 2], |[a, b]| [a.min(v), b.max(v)]);
        let seen = comfort::Seen {
            scene: Some([far, near]),
            others: ratios.fold(None, |r, v| Some(range(r, v))),
            sky: all.sky,
        };
        let foreground = all.foreground().map(|[far, _, nearest]| [far, nearest]);
        if let Some(foreground) = foreground {
            self.cameras.comfort.cameras.see_foreground(foreground);
        }
        self.find_cameras(p, &seen);
        let budget = self.reach().budget;
        let comfort = &mut self.cameras.comfort;
        comfort.cuts.judge([far, near], budget);
        comfort.foreground =
            foreground.and_then(|range| comfort.cameras.foreground(near, range, budget));
        if self.session.config.report.is_none() {
            return;
        }
        let (budget, px) = (self.budget(), self.half_width());
        let (separation, convergence) = taken.cameras.unwrap_or_default();
        let at = |ratio: f64| separation * (1.0 - ratio) * px;
        let ends = [near, far].map(|inverse| at(convergence * inverse));
        let own = seen.others.into_iter().flatten().map(at);
        let sky = all.sky.then_some(taken.sky);
        let before = foreground.zip(taken.foreground);
        let before = before.map(|(range, (separation, convergence))| {
            range.map(|inverse| separation * (1.0 - convergence * inverse) * px)
        });
        let all = ends.into_iter().chain(own).chain(sky);
        let all = all.chain(before.into_iter().flatten());
        self.diagnostics.report.disparity(Disparity {
            frame: taken.frame,
            cameras: (separation, convergence),
            least: all.clone().fold(f64::INFINITY, f64::min),
            middle: at(convergence * middle),
            most: all.fold(f64::NEG_INFINITY, f64::max),
            budget: budget.px,
            mm_per_px: budget.mm_per_px,
            ends: [near, far],
            px,
        });
    }
}

/// Separation and convergence of a shift.
fn numbers(shear: Option<Shear>) -> Option<(f64, f64)> {
    shear.map(|shear| (shear.separation(1.0), shear.conv))
}
