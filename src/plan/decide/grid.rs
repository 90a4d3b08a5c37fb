//! Tiles with fewer samples than the window cannot represent every command. The grid then falls back to one that can.

use super::{Demand, Detail, Facts, GridFacts, Rects};
use crate::gl::consts as c;
use crate::plan::Kind;
use crate::plan::reason::Unrepresentable;

/// The grid that a command needs instead of the present one, and why. None where the present one can represent the command.
pub(super) fn demanded(facts: &Facts) -> Option<(Detail, Unrepresentable)> {
    let grid = facts.grid.as_ref()?;
    if !facts.destination.is_window() {
        return None;
    }
    if let Some(found) = retreat(grid.demand, false, grid.aligned) {
        return Some(found);
    }
    let kind = facts.traits.kind;
    match kind {
        Kind::Pixels => return Some((Detail::Full, Unrepresentable::Pixels)),
        Kind::Accum => return Some((Detail::Full, Unrepresentable::Accumulation)),
        Kind::Clear { .. } => return slanted(grid, &facts.rects),
        _ => {}
    }
    if facts.shaders.programmed() {
        return Some((Detail::Full, Unrepresentable::Shaders));
    }
    if grid.stippled {
        return Some((Detail::Full, Unrepresentable::Stipple));
    }
    if !grid.aligned {
        return None;
    }
    if is_lines_or_points(kind) || grid.outlined {
        return Some((Detail::Scaled, Unrepresentable::LinesOrPoints));
    }
    slanted(grid, &facts.rects)
}

/// The grid that a demand needs instead of the present one, and why. `full`: the present grid is the window's pixels; `aligned`: its samples
/// lie where the panel shows the view.
pub fn retreat(demand: Demand, full: bool, aligned: bool) -> Option<(Detail, Unrepresentable)> {
    match demand {
        Demand::Everything(what) if !full => Some((Detail::Full, what)),
        Demand::LinesOrPoints if aligned => Some((Detail::Scaled, Unrepresentable::ListsOfLines)),
        _ => None,
    }
}

/// Falls back where a command draws to a part of the window in slanted tiles: its upright edges cannot be drawn there.
fn slanted(grid: &GridFacts, rects: &Rects) -> Option<(Detail, Unrepresentable)> {
    let [width, height] = rects.window.map(|side| side as i32);
    let whole = [0, 0, width, height];
    let part = rects.viewport != whole || rects.scissor.is_some_and(|scissor| scissor != whole);
    (part && grid.slanted).then_some((Detail::Scaled, Unrepresentable::PartsOfWindow))
}

/// Whether a command certainly draws lines or points.
pub(super) fn is_lines_or_points(kind: Kind) -> bool {
    match kind {
        Kind::Begin(mode) | Kind::Arrays(mode) | Kind::Elements(mode) => mode <= c::LINE_STRIP,
        _ => false,
    }
}
