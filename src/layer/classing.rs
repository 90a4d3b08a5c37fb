//! What a draw is: reads what the classifier asks for, and keeps what it must know of the frame.

use super::Layer;
use crate::config::{DepthRange, DepthState, Projection};
use crate::gl::{Gl, consts as c};
use crate::plan::class::Target;
use crate::plan::{Classed, Facts, Kind};
use crate::state::Touch;

/// What has happened in the frame so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    /// Draws, without clears.
    pub(super) draws: u32,
    /// The list that is called.
    pub(super) list: Option<u32>,
    /// Something in perspective has written depth since the frame began or was last cleared.
    pub(super) deep: bool,
    /// Nearer things have larger depths, by the first draw of the scene.
    pub(super) nearer_is_larger: Option<bool>,
    /// Something was drawn that is to be shown.
    pub(super) drawn: bool,
    /// A draw since the last swap was made by another strategy than replay.
    pub(super) amplifies: bool,
}

impl Layer {
    /// Classes the draw that is about to be made; [`crate::state::State::refresh`] has been called.
    pub(super) fn classify(&mut self, gl: &Gl, kind: Kind) -> (Facts, Classed) {
        let target = self.target(gl);
        let shown = matches!(target, Target::Window | Target::Pass(_));
        let clear = matches!(kind, Kind::Clear { .. } | Kind::Accum);
        if clear && shown {
            self.frame.deep = false;
        }
        if !clear && self.state.list.is_none() {
            self.frame.draws += 1;
        }
        let first = !self.frame.deep;
        let seen = match shown && !clear {
            true => self.looks_through(gl),
            false => None,
        };
        let projection = seen.unwrap_or_else(|| self.state.projection_kind());
        if shown {
            let needs = self.cameras.classifier.needs(kind, projection, first);
            self.state.read_classification(gl, needs);
            let depth = self.state.classification.depth;
            let behind = self.state.classification.range == DepthRange::Far;
            if !clear && projection == Projection::Perspective && first && !behind {
                if self
                    .cameras
                    .classifier
                    .needs_modelview(projection, first, depth)
                {
                    self.state.read_classification(gl, Touch::MODELVIEW);
                }
                self.frame.deep = depth == DepthState::On;
            }
        }
        let (program, shader) = match self.state.program {
            0 => (0, 0),
            program if self.cameras.classifier.needs_shader() => self.told_of(program),
            _ => (0, 0),
        };
        let facts = Facts {
            target,
            program,
            shader,
            draw: self.frame.draws,
            list: self.frame.list,
            raster: self.cameras.raster_placed,
            first,
            projection,
            ..Facts::of(kind, &self.state)
        };
        let classed = self.cameras.classifier.class(&facts);
        (facts, classed)
    }

    /// The call once, in the program's own view only.
    pub(super) fn once(&mut self, gl: &Gl, call: &mut dyn FnMut()) {
        if self.has_copies() && (!self.variants.sampled.is_empty() || self.state.transform_feedback)
        {
            self.write_back_textures(gl);
        }
        // What is fed back or hit is not drawn, and is told in the program's own viewport.
        if self.state.draws_to_window() && self.state.render_mode == c::RENDER {
            // The tiles beside it are others' views.
            self.scissored(gl, self.targets.atlas.tiles.own(), 0, call);
        } else {
            call();
        }
    }
}
