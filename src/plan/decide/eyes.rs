//! Draws of a program that draws a picture for each eye itself: its eyes are views, and nothing is shifted.

use super::{Decision, Facts, Known, Method, Plan};

/// The decision about a command: made once, or in the own view's tile of the window.
pub(super) fn decide(facts: &Facts, mut known: Known) -> Decision {
    // The own view alone is drawn. The eyes become views when the frame is shown.
    known.mono.active = true;
    let method = match facts.destination.is_window() {
        true => Method::Replay,
        false => Method::Once,
    };
    Decision {
        plan: Plan {
            method,
            ..Plan::once(facts)
        },
        effects: Vec::new(),
        known,
    }
}
