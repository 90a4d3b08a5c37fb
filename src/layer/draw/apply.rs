//! Apply: makes targets and variants ready before a draw.

use super::super::Layer;
use super::Request;
use crate::gl::Gl;
use crate::plan::Unrepresentable;
use crate::plan::decide::{Detail, Effect, Preparation, Scene};

impl Layer {
    /// Carries out a preparation, which changes the facts. The next observation tells whether it has succeeded.
    pub(super) fn prepare(&mut self, gl: &Gl, preparation: Preparation) {
        match preparation {
            Preparation::ChangeGrid(detail, why) => self.give_up(gl, detail, why),
            Preparation::LinkVariant(program) => self.link_variant(gl, program),
            Preparation::LinkLayers { program, all } => {
                self.link_layer_variant(gl, program, all);
            }
            Preparation::Split(framebuffer) => {
                if !self.split(gl, framebuffer) {
                    self.targets.offscreen.refuse(gl, framebuffer);
                }
            }
            Preparation::MeasureDepths => {
                self.known.depths.begun = true;
                self.begin_frame(gl);
            }
        }
    }

    /// Carries out the effects of a decision, in order. `known` still is what was known before the decision.
    pub(super) fn apply(&mut self, gl: &Gl, request: &Request, effects: Vec<Effect>) {
        for effect in effects {
            match effect {
                Effect::TakeDepths => self.save_depths(gl),
                Effect::MapDepths {
                    ramp,
                    projection,
                    focal,
                    foreground,
                    viewport,
                } => {
                    let mappings = &mut self.cameras.comfort.mappings;
                    mappings.drawn(ramp, &projection, (focal, foreground), viewport);
                }
                Effect::MapSky => self.cameras.comfort.mappings.sky = true,
                Effect::ForgetDepths => self.cameras.comfort.mappings.clear(),
                Effect::BeginScene { depth } => self.begin_scene(gl, depth),
                Effect::CaptureSurface => self.capture_surface(gl, request.primitives),
                Effect::SynthesiseViews => self.synthesise_views(gl),
                Effect::LeaveMono => self.draw_all_views(gl),
                Effect::Fallback(reason) => self.diagnostics.fallback(reason),
                Effect::NoCamera(program) => self.tell_of_no_camera(program),
            }
        }
    }

    /// Gives up a grid that cannot hold what the program draws, for the rest of the run, and makes the atlas anew. `what` continues the note
    /// "because the program". Where the driver makes no other atlas, this one stays; the next command that it cannot hold gets the true
    /// framebuffer 0.
    pub(in crate::layer) fn give_up(&mut self, gl: &Gl, detail: Detail, what: Unrepresentable) {
        self.targets.detail = detail;
        self.state.keep_errors(gl);
        if !self.remake(gl) {
            if self.targets.stuck {
                return self.become_plain(gl);
            }
            self.targets.stuck = true;
            gl.drop_errors();
            return;
        }
        self.targets.stuck = false;
        let now = match self.grid() {
            grid if grid.is_full() => "at the size of the window",
            _ => "with fewer pixels, but not aligned with the panel's samples",
        };
        self.diagnostics
            .report
            .note(format!("views are drawn {now}, because the program {what}"));
    }

    /// A clear has begun a scene that is drawn to some views only.
    fn begin_scene(&mut self, gl: &Gl, depth: f32) {
        self.synthesis
            .begin(self.targets.atlas.tiles.own(), self.session.config.views);
        self.known.scene = Some(Scene {
            clear: depth,
            ..Scene::default()
        });
        self.targets.atlas.tiles.shown = self.shown();
        self.begin_reference(gl);
    }
}
