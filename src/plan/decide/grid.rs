//! Tiles with fewer samples than the window hold not every command: the grid retreats to one that does.

use super::{Detail, Facts, GridFacts, Rects};
use crate::gl::consts as c;
use crate::plan::Kind;

/// What a command asks of the grid beside what its kind does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Demand {
    /// Nothing.
    None,
    /// It may have lines or points, as display lists may.
    Thin,
    /// The window's own pixels, because the program does this.
    Everything(&'static str),
}

/// The grid that a command needs instead of the present one, and why. None where the present one holds it.
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

/// The same for what the command demands; `full`, `aligned`: the present grid is the window's pixels, or lies where the lenses are.
pub fn retreat(demand: Demand, full: bool, aligned: bool) -> Option<(Detail, &'static str)> {
    match demand {
        Demand::Everything(what) if !full => Some((Detail::Full, what)),
        Demand::Thin if aligned => {
            Some((Detail::Scaled, "may draw lines or points in display lists"))
        }
        _ => None,
    }
}

/// Edges of a part of the window cannot be upright in tiles that lean.
fn leaning(grid: &GridFacts, rects: &Rects) -> Option<(Detail, &'static str)> {
    let [width, height] = rects.window.map(|side| side as i32);
    let whole = [0, 0, width, height];
    let part = rects.viewport != whole || rects.scissor.is_some_and(|scissor| scissor != whole);
    (part && grid.leans).then_some((Detail::Scaled, "draws to parts of the window"))
}

/// Whether a command draws lines or points for certain.
pub(super) fn is_thin(kind: Kind) -> bool {
    match kind {
        Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => mode <= c::LINE_STRIP,
        _ => false,
    }
}
