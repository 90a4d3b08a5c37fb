//! Observers: they report a draw, and change nothing of it.

use super::super::Layer;
use super::method_name;
use crate::config::{Class, Word};
use crate::gl::Gl;
use crate::plan::class::{Classed, Why};
use crate::plan::{Facts, Method, Plan};

impl Layer {
    /// Reports a draw that is decided and about to be made.
    pub(super) fn observe_decision(&mut self, gl: &Gl, facts: &Facts, plan: &Plan) {
        if self.explains().is_some() {
            self.explain_this(&facts.traits, &self.told(facts, plan));
        }
        self.prove_this(gl, &facts.traits, plan);
        if plan.method == Method::Once {
            self.queries.drawn();
        } else {
            self.frame.draws();
        }
        // An amplified draw is counted when it is known that it can be made.
        if matches!(plan.method, Method::Once | Method::Replay) {
            self.count_draw(plan.method, plan);
        }
    }

    /// The class of a draw as an explanation tells it, with what its plan adds to the reason.
    fn told(&self, facts: &Facts, plan: &Plan) -> Classed {
        let program = self.state.in_use.program;
        match facts.classed.why {
            Why::Rule(_) => facts.classed,
            _ if plan.variant && self.is_by_clip_form(program) && plan.class == Class::Scene => {
                Classed {
                    class: plan.class,
                    why: Why::ClipForm,
                    ..facts.classed
                }
            }
            // Its own view stays as it is where w is 1, and a sky is one by its shader or its matrices.
            _ if plan.variant && facts.classed.class == Class::Flat => Classed {
                why: Why::FlatShaders,
                ..facts.classed
            },
            _ if plan.variant && plan.class != Class::Sky => Classed {
                class: plan.class,
                why: Why::Shaders,
                ..facts.classed
            },
            _ => facts.classed,
        }
    }

    /// Counts a draw in the report, by its method and class.
    pub(in crate::layer) fn count_draw(&mut self, method: Method, plan: &Plan) {
        let report = &mut self.diagnostics.report;
        report.draw(method_name(method), plan.class.word());
    }
}
