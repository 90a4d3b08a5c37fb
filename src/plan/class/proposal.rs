//! The rule that an explanation proposes for a draw: with keys that are the same in every run, where there are such.

use super::{Classed, Traits};
use crate::config::{Class, DepthRange, DepthState, Projection, Viewport, Word};
use crate::plan::Kind;

impl Traits {
    /// Whether a person may see a sky in a draw of the scene: it is drawn around the eye, or without depths before the rest.
    fn may_be_sky(&self) -> bool {
        let before = self.first && self.depth_state != DepthState::On;
        self.projection == Projection::Perspective && (self.is_around_eye() || before)
    }

    /// The line of a profile that would give this draw another class; none where no picture is drawn.
    pub fn rule(&self, classed: &Classed) -> Option<String> {
        let pass = self.pass()?;
        let mut keys = Vec::new();
        if pass != 0 {
            keys.push(format!("pass = {pass}"));
        }
        if self.shader != 0 {
            keys.push(format!("shader = \"{:016x}\"", self.shader));
        }
        if let Some(list) = self.list {
            keys.push(format!("list = {list}"));
        }
        // Shaders and images are the same in every run, names of textures are not.
        if self.shader == 0 && self.image != 0 {
            keys.push(format!("image = \"{:016x}\"", self.image));
        } else if self.shader == 0 && !self.texture.is_zero() {
            keys.push(format!("texture = {}", self.texture));
        }
        if keys.is_empty() || (self.shader == 0 && pass != 0 && keys.len() == 1) {
            // No other key tells it from its neighbours.
            keys.extend(self.place());
        }
        keys.push(format!("projection = \"{}\"", self.projection.word()));
        if self.viewport != Viewport::Main {
            keys.push(format!("viewport = \"{}\"", self.viewport.word()));
        }
        keys.push(format!("depth-state = \"{}\"", self.depth_state.word()));
        if self.range != DepthRange::Whole {
            keys.push(format!("depth-range = \"{}\"", self.range.word()));
        }
        if classed.class == Class::Scene && self.may_be_sky() && self.first {
            keys.push("before-depth = true".to_owned());
        }
        let other = match (classed.class, self.projection) {
            (Class::Scene, _) if self.may_be_sky() => Class::Sky,
            (Class::Scene, _) => Class::Flat,
            (Class::OffScreen, _) => Class::Scene,
            (Class::Sky, _) => Class::Scene,
            (_, Projection::Perspective) if self.kind != Kind::Pixels => Class::Scene,
            // It has no depths of its own, so it can only be placed at another depth.
            _ => Class::Flat,
        };
        keys.push(format!("class = \"{}\"", other.word()));
        if classed.class == Class::Flat && other == Class::Flat {
            keys.push("depth = 0.25".to_owned());
        }
        Some(format!("{{ {} }},", keys.join(", ")))
    }

    /// The keys for its place in the frame. Where the depths are cleared within the frame, the number since then varies less from frame to frame.
    fn place(&self) -> Vec<String> {
        match self.clear {
            0 | 1 => vec![format!("draw = {}", self.draw)],
            clear => vec![
                format!("clear = {clear}"),
                format!("after-clear = {}", self.after_clear),
            ],
        }
    }
}
