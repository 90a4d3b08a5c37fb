//! What the program draws outside the window: once where all views are the same, else once per view, into framebuffers of their own
//! and with textures of their own (see [`crate::offscreen`]).
//!
//! A framebuffer is the window's, in as many views, as soon as a part of the scene is drawn into it in perspective, and it has the shape of
//! the window or the camera has. Shadow maps, cube faces, light maps have neither. Whatever samples, copies or blits from one that differs
//! makes its own target differ.

use super::programs::{Entered, VariantUse};
use super::{Layer, keep_bindings};
use crate::atlas::Surface;
use crate::config::Class;
use crate::draw::{ReplayHazard, Variant};
use crate::gl::{Gl, consts as c};
use crate::offscreen;
use crate::plan::class::Target;
use crate::plan::{Flat, Kind, Method, Plan, Reason, camera};
use crate::state::{Touch, uniform_change};

/// Pixels along the longer side of a window up to which nobody looks at it.
const HIDDEN: u32 = 16;

impl Layer {
    /// Where a draw goes. The state is refreshed.
    pub(super) fn target(&mut self, gl: &Gl) -> Target {
        let name = self.state.framebuffers.draw;
        if !self.state.makes_pictures() {
            return Target::Nothing;
        }
        if name == 0 {
            return Target::Window;
        }
        let number = self.targets.offscreen.number(gl, name);
        if self.session.config.views > 1 && self.is_pass(gl, name) {
            Target::Pass(number)
        } else {
            Target::Framebuffer(number)
        }
    }

    /// Whether what is drawn into a framebuffer of the program's with its camera of now is what the window's viewer sees.
    fn is_pass(&mut self, gl: &Gl, framebuffer: u32) -> bool {
        let camera = match self.state.program {
            0 => camera::equivalent(&self.state.projection),
            program => {
                self.know(gl, program);
                match self.camera_of(gl, program) {
                    Some(camera) => camera,
                    None => camera::equivalent(&self.state.projection),
                }
            }
        };
        let target = self.targets.offscreen.target(gl, framebuffer);
        if target.is_cube() || target.attachments.is_empty() {
            return false;
        }
        let alone = target.is_depth_only();
        let [_, _, width, height] = self.state.viewport.map(i64::from);
        let [w, h] = self.picture_size();
        // Within a pixel, since half of an odd size is rounded.
        let fits = (width * h - height * w).abs() <= w.max(h);
        let Some(camera) = camera else {
            return fits;
        };
        let a = f64::from(camera[0]);
        if alone && width == height {
            // The map of a lamp, unless it sees what the window does.
            return self
                .cameras
                .lens
                .is_some_and(|lens| (a - lens).abs() <= 0.01 * lens);
        }
        let pass = fits || camera::fits(&camera, self.aspect());
        if pass {
            self.cameras.lens = Some(a);
        }
        pass
    }

    /// Width and height in pixels of the picture that is drawn: of the window, or, where there is none to be seen, of the viewport.
    fn picture_size(&self) -> [i64; 2] {
        let window = [self.state.window.width, self.state.window.height].map(i64::from);
        let [_, _, width, height] = self.state.viewport.map(i64::from);
        match self.is_hidden() && width > 0 && height > 0 {
            true => [width, height],
            false => window,
        }
    }

    /// Whether the context draws for another one: its own window is but a place to be current at, as those of toolkits' widgets.
    pub fn is_hidden(&self) -> bool {
        let window = &self.state.window;
        window.width.max(window.height) <= HIDDEN
    }

    /// Width over height of the picture.
    pub(super) fn aspect(&self) -> f64 {
        let [w, h] = self.picture_size().map(|side| side as f64);
        w / h
    }

    /// Where each view has its own images of what a draw samples or draws to, it is replayed; a target gets them when something that depends
    /// on the view is drawn to it.
    pub(super) fn track_pass(&mut self, gl: &Gl, kind: Kind, plan: Plan) -> Plan {
        if self.session.config.views < 2 || !self.state.makes_pictures() {
            return plan;
        }
        let whole = matches!(kind, Kind::Clear { .. } | Kind::Accum);
        if whole {
            self.variants.sampled.clear();
            self.variants.sampled_by = None;
        } else {
            self.sample(gl);
        }
        let framebuffer = self.state.framebuffers.draw;
        let mut plan = plan;
        if !self.variants.sampled.is_empty() {
            // A picture of a view stands where that view has it.
            if plan.flat != Flat::Scene {
                plan.flat = Flat::Still;
            }
            if plan.class == Class::Flat {
                plan.shear = None;
            }
            if matches!(plan.method, Method::Instanced | Method::Geometry) {
                plan.method = Method::Replay;
                plan.reason = Some(Reason::Kind(
                    "draws with a texture that each view has its own of",
                ));
            }
        }
        // Depths of a view are of its own camera.
        self.variants.unprojections = match plan.variant && !self.variants.sampled.is_empty() {
            true => self.unprojections_of(gl, self.state.program),
            false => Vec::new(),
        };
        if framebuffer == 0 {
            return plan;
        }
        let differs = !self.variants.sampled.is_empty()
            || (plan.method != Method::Once && !whole && plan.shear.is_some());
        let split = match differs {
            true => self.split(gl, framebuffer),
            false => {
                self.targets.offscreen.is_split(gl, framebuffer) && self.split(gl, framebuffer)
            }
        };
        if split
            && plan.variant
            && self
                .targets
                .offscreen
                .target(gl, framebuffer)
                .layered()
                .is_some()
        {
            self.know_layers(gl, self.state.program, false);
        }
        plan.method = if split { Method::Replay } else { Method::Once };
        plan.reason = None;
        plan
    }

    /// A draw to a framebuffer that each view has its own of: to the layers of one where a variant chooses among them.
    pub(super) fn replay_aside(
        &mut self,
        gl: &Gl,
        mut target: offscreen::Target,
        plan: &Plan,
        hazard: ReplayHazard,
        call: &mut dyn FnMut(u32),
    ) {
        let program = self.state.program;
        let mut variants = std::mem::take(&mut self.variants.own);
        let layered = target.layered();
        let with = layered.map_or(VariantUse::Views, |_| VariantUse::Layers);
        let variant = match plan.variant {
            true => variants.enter(gl, program, with),
            false => None,
        };
        let by_layers =
            variant.as_ref().is_some_and(|variant| variant.layers) || hazard == ReplayHazard::Clear;
        let layered = layered.filter(|_| by_layers);
        if let Some(name) = layered {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, name);
        }
        target.take_layers(layered.is_some());
        match &variant {
            // All layers at once.
            None if layered.is_some() => call(self.targets.atlas.tiles.own()),
            None => {
                let shear = plan.shear.filter(|_| !plan.variant);
                self.replay_by(gl, Some(&mut target), shear, hazard, call);
            }
            Some(Entered { variant, layers }) => {
                let (rig, tiles) = (self.cameras.rig, target.tiles());
                let unproject = self.unproject(plan);
                self.replay_by(gl, Some(&mut target), None, hazard, &mut |view| {
                    let shifts = (plan.shear, plan.flat);
                    variant.set_views(gl, shifts, &[rig.position(view)], tiles.stride);
                    unproject(gl, variant, rig.position(view));
                    if *layers {
                        variant.set_layers(gl, &[tiles.slot(view)]);
                    }
                    call(view);
                });
            }
        }
        if variant.is_some() {
            gl.use_program(program);
        }
        self.variants.own = variants;
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.state.framebuffers.draw);
        self.targets.offscreen.drawn_to(&target);
        self.targets.offscreen.put(target);
    }

    /// Gives a variant that is in use the unprojections of the view at a place.
    pub(super) fn unproject(&mut self, plan: &Plan) -> impl Fn(&Gl, &Variant, f64) + use<> {
        let (matrices, shear) = (std::mem::take(&mut self.variants.unprojections), plan.shear);
        move |gl, variant, place| {
            for (location, m) in &matrices {
                let m = shear.map_or(*m, |shear| camera::unprojection(m, &shear, place));
                variant.set_matrix(gl, *location, &m);
            }
        }
    }

    /// Looks which textures with an image per view a draw reads.
    fn sample(&mut self, gl: &Gl) {
        let program = self.state.program;
        let key = Some((program, uniform_change(), self.targets.offscreen.changes()));
        let bound = self.state.touched.has(Touch::UNITS);
        if std::mem::replace(&mut self.variants.sampled_by, key) == key && !bound {
            return;
        }
        self.state.touched = self.state.touched.without(Touch::UNITS);
        self.variants.sampled = match program {
            _ if self.targets.offscreen.is_empty() => Vec::new(),
            0 => self.targets.offscreen.bound(gl),
            program => {
                let units = self.units_of(gl, program);
                self.targets.offscreen.bound_among(gl, units.into_iter())
            }
        };
    }

    /// Each view gets a framebuffer like this one of the program's; false where the driver makes none.
    pub(super) fn split(&mut self, gl: &Gl, framebuffer: u32) -> bool {
        if self.targets.offscreen.is_made(gl, framebuffer) {
            return true;
        }
        if self.targets.offscreen.is_refused(gl, framebuffer) {
            return false;
        }
        self.state.keep_errors(gl);
        let split = keep_bindings(gl, || {
            self.targets
                .offscreen
                .split(gl, &mut self.targets.names, framebuffer)
        });
        self.drain_own_errors(gl);
        if !split {
            self.diagnostics.report.note(format!(
                "the driver makes no other framebuffer like the program's {framebuffer}: what is drawn there is the same in all views"
            ));
        }
        split
    }
}
