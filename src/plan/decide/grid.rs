//! Tiles with fewer samples than the window cannot represent every command. The grid then falls back to one that can.

use super::{Detail, Facts, GridFacts, Rects};
use crate::gl::consts as c;
use crate::plan::Kind;

/// A demand on the grid that does not follow from a command's kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// No demand.
    None,
    /// The command may draw lines or points, as display lists may.
    Thin,
    /// The window's own pixels are needed, because the program does this.
    Everything(&'static str),
}

/// The grid that a command needs instead of the present one, and why. None where the present one can represent the command.
pub(super) fn demanded(facts: &Facts) -> Option<(Detail, &'static str)> {
    let grid = facts.grid.as_ref()?;
    if !facts.destination.is_window() {
        return None;
    }
    let kind = facts.traits.kind;
    match kind {
        Kind::Pixels => return Some((Detail::Full, "draws pixels or bitmaps")),
        Kind::Accum => return Some((Detail::Full, "uses the accumulation buffer")),
        Kind::Clear { .. } => return leaning(grid, &facts.rects),
        _ => {}
    }
    if facts.shaders.programmed() {
        return Some((Detail::Full, "has shaders of its own"));
    }
    if grid.stippled {
        return Some((Detail::Full, "draws stippled polygons"));
    }
    if !grid.aligned {
        return None;
    }
    if is_thin(kind) || grid.outlined {
        return Some((Detail::Scaled, "draws lines or points"));
    }
    leaning(grid, &facts.rects)
}

/// The grid that a demand needs instead of the present one, and why. `full`: the present grid is the window's pixels; `aligned`: its samples
/// lie where the panel shows the view.
pub fn retreat(demand: Demand, full: bool, aligned: bool) -> Option<(Detail, &'static str)> {
    match demand {
        Demand::Everything(what) if !full => Some((Detail::Full, what)),
        Demand::Thin if aligned => {
            Some((Detail::Scaled, "may draw lines or points in display lists"))
        }
        _ => None,
    }
}

/// Falls back where a command draws to a part of the window in slanted tiles: its upright edges cannot be drawn there.
fn leaning(grid: &GridFacts, rects: &Rects) -> Option<(Detail, &'static str)> {
    let [width, height] = rects.window.map(|side| side as i32);
    let whole = [0, 0, width, height];
    let part = rects.viewport != whole || rects.scissor.is_some_and(|scissor| scissor != whole);
    (part && grid.leans).then_some((Detail::Scaled, "draws to parts of the window"))
}

/// Whether a command certainly draws lines or points.
pub(super) fn is_thin(kind: Kind) -> bool {
    match kind {
        Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => mode <= c::LINE_STRIP,
        _ => false,
    }
}
