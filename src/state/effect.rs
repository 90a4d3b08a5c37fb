//! The effects of recorded immediate-mode calls on the current values.

/// A set of effects of calls: the current values that they set, and whether they emit a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effect(u32);

impl core::ops::BitOr for Effect {
    type Output = Effect;
    fn bitor(self, other: Effect) -> Effect {
        Effect(self.0 | other.0)
    }
}

impl Effect {
    /// Emits a vertex.
    pub const VERTEX: Effect = Effect(1);
    /// Primary colour (with colour material: the material too).
    pub const COLOR: Effect = Effect(2);
    /// Normal.
    pub const NORMAL: Effect = Effect(4);
    /// Texture coordinates of some unit.
    pub const MULTITEX: Effect = Effect(2048);
    /// Texture coordinates of unit 0.
    pub const TEXCOORD: Effect = Effect(8);
    /// Secondary colour.
    pub const SECONDARY: Effect = Effect(16);
    /// Fog coordinate.
    pub const FOG: Effect = Effect(32);
    /// Edge flag.
    pub const EDGE: Effect = Effect(64);
    /// Colour index.
    pub const INDEX: Effect = Effect(128);
    /// Material.
    pub const MATERIAL: Effect = Effect(256);
    /// Generic attribute; attribute 0 emits a vertex.
    pub const ATTRIB: Effect = Effect(512);
    /// Evaluators and calls of lists: may set anything and emits a vertex.
    pub const UNKNOWN: Effect = Effect(1024);
    /// An array element: sets the values of all arrays that are on, the same ones for each element, then emits a vertex.
    pub const ELEMENT: Effect = Effect(4096);
    /// Nothing.
    pub const NONE: Effect = Effect(0);
    /// Everything.
    pub const ALL: Effect = Effect(4095);

    /// Whether any of `other` is in `self`.
    pub fn has(self, other: Effect) -> bool {
        self.0 & other.0 != 0
    }
}

/// Whether the calls between glBegin and glEnd give the same picture when they are sent a second time.
///
/// They do unless a vertex used a current value that a later call changed: then the first vertices of the second sending would
/// see the new value.
#[derive(Clone, Copy, Debug, Default)]
pub struct Immediate {
    before_vertex: u32,
    after_vertex: u32,
    vertex_seen: bool,
    /// Some vertex was given by a call of its own.
    own_vertex: bool,
    /// Some vertex was an array element.
    elements: bool,
}

impl Immediate {
    /// Notes one call.
    #[inline]
    pub fn note(&mut self, e: Effect) {
        if e == Effect::VERTEX || e == Effect::ELEMENT {
            self.vertex_seen = true;
            self.own_vertex |= e == Effect::VERTEX;
            self.elements |= e == Effect::ELEMENT;
            return;
        }
        if self.vertex_seen {
            self.after_vertex |= e.0;
        } else {
            self.before_vertex |= e.0;
        }
        if e == Effect::UNKNOWN || e == Effect::ATTRIB {
            self.vertex_seen = true;
            self.after_vertex |= e.0;
            self.before_vertex &= !e.0;
        }
    }

    /// Whether a material changes between glBegin and glEnd, or may change by a call whose effect is unknown.
    pub fn changes_material(&self) -> bool {
        self.sets().has(Effect::MATERIAL | Effect::UNKNOWN)
    }

    /// Everything that the calls set.
    pub fn sets(&self) -> Effect {
        let elements = match self.elements {
            true => Effect::UNKNOWN,
            false => Effect::NONE,
        };
        Effect(self.before_vertex | self.after_vertex) | elements
    }

    /// The current values that must be restored before the calls are sent again; [`Effect::NONE`] if none must be.
    pub fn must_restore(&self) -> Effect {
        // Texture coordinates of several units and materials of two faces share a bit, so one that was set before the first vertex does
        // not mean that all were.
        let shared = Effect::MULTITEX.0 | Effect::MATERIAL.0;
        let restore = Effect(self.after_vertex & (!self.before_vertex | shared));
        // Elements alone give each vertex its values from the arrays. Other vertices among them may use what an element has left.
        match self.elements && self.own_vertex {
            true => restore | Effect::UNKNOWN,
            false => restore,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(calls: &[Effect]) -> bool {
        let mut i = Immediate::default();
        calls.iter().for_each(|&c| i.note(c));
        i.must_restore() != Effect::NONE
    }

    #[test]
    fn a_value_changed_after_its_first_use_must_be_restored() {
        assert!(!run(&[
            Effect::COLOR,
            Effect::VERTEX,
            Effect::COLOR,
            Effect::VERTEX
        ]));
        assert!(run(&[Effect::VERTEX, Effect::COLOR, Effect::VERTEX]));
        assert!(run(&[
            Effect::NORMAL,
            Effect::VERTEX,
            Effect::COLOR,
            Effect::VERTEX
        ]));
        assert!(!run(&[Effect::VERTEX, Effect::VERTEX]));
        assert!(run(&[Effect::UNKNOWN]), "an evaluator may set anything");
        let [element, vertex] = [Effect::ELEMENT, Effect::VERTEX];
        assert!(!run(&[element, element]), "arrays give all their values");
        assert!(run(&[element, Effect::COLOR, element]));
        for mixed in [[element, vertex], [vertex, element]] {
            assert!(run(&mixed), "a vertex may use what an element has left");
        }
        assert!(
            run(&[Effect::MULTITEX, Effect::VERTEX, Effect::MULTITEX]),
            "it may be another unit"
        );
    }
}
