//! The checks of one game, as a row of docs/looks.md.

use crate::looks::launch::{Launched, VIEWS};
use crate::looks::shift::shifts;
use crate::looks::table::{Game, Part, Place};
use serde_json::Value;

/// Largest distance of a part from its place, pixels.
const TOLERANCE: f64 = 1.0;

/// The row of a game.
pub(crate) struct Row {
    pub(crate) failed: bool,
    /// The cells after the name.
    pub(crate) cells: [String; 3],
}

/// A game that could not be launched.
pub(crate) fn failed(reason: &str) -> Row {
    Row {
        failed: true,
        cells: [format!("**{reason}**"), String::new(), String::new()],
    }
}

/// Disparities of the frame of the views, pixels between neighbouring views: nearest, farthest, and infinity.
struct Depths {
    near: f64,
    far: f64,
    infinity: f64,
}

fn depths(launched: &Launched) -> Option<Depths> {
    let frames = launched.report["disparity"]["last_frames"].as_array()?;
    // The frame itself may have no scene, or be younger than the report.
    let frame = frames.iter().rfind(|frame| {
        frame["frame"]
            .as_u64()
            .is_some_and(|number| number <= launched.frame)
    })?;
    let width = f64::from(launched.views[0].width());
    Some(Depths {
        near: frame["px"][0].as_f64()?,
        far: frame["px"][2].as_f64()?,
        // A camera that moves by one unit of the panel's plane, whose half width is 1, sees infinity move by half of the picture.
        infinity: frame["separation"].as_f64()? * width / 2.0,
    })
}

pub(crate) fn row(game: &Game, launched: &Launched) -> Row {
    let parts = parts(game, launched);
    let wrong = parts.iter().any(Result::is_err) || game.depths && depths(launched).is_none();
    let parts = parts
        .into_iter()
        .map(|part| part.unwrap_or_else(|wrong| format!("**{wrong}**")));
    Row {
        cells: [
            disparities(game, &launched.report),
            parts.collect::<Vec<_>>().join(", "),
            notes(&launched.report),
        ],
        failed: wrong || game.wrong.is_some(),
    }
}

/// A sentence about each part; an error where it is not where it belongs.
pub(crate) fn parts(game: &Game, launched: &Launched) -> Vec<Result<String, String>> {
    let depths = depths(launched);
    let mut covered = None;
    let parts = game.part.iter().map(|part| {
        let shifts = shifts(&launched.views, part.at);
        let judged = match &shifts {
            Some(shifts) => judged(part, shifts, depths.as_ref(), covered),
            None => Err(format!("{}: not found again", part.name)),
        };
        covered = shifts.as_deref().map(step);
        judged
    });
    parts.collect()
}

/// The depths of all frames, against the budget.
fn disparities(game: &Game, report: &Value) -> String {
    let about = &report["disparity"];
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let frames = about["frames"].as_f64().unwrap_or(0.0);
    if frames == 0.0 {
        let text = match game.depths {
            true => "**no scene with depths**",
            false => "it writes no depths",
        };
        return text.into();
    }
    let rate = 1000.0 / number(&report["frame_ms"]["median"]);
    let over = 100.0 * number(&about["frames_over_budget"]) / frames;
    let share = match over {
        0.0 => format!("none of {frames} frames"),
        _ => format!("*{over:.1} %* of {frames} frames"),
    };
    format!(
        "{:+.2} to {:+.2} of {:.2}; {share}, {rate:.0} a second",
        number(&about["px"]["min"]),
        number(&about["px"]["max"]),
        number(&about["budget_px"]),
    )
}

/// By so much at least is a part nearer than what it covers, in pixels between neighbouring views.
const MARGIN: f64 = 0.1;

/// The shift between neighbouring views of a part that has these in the views, in pixels.
fn step(shifts: &[f64]) -> f64 {
    shifts[VIEWS as usize - 1] / f64::from(VIEWS - 1)
}

/// The sentence about a part with these shifts in the views; an error where it is not where it belongs. `covered` is the shift of the part
/// before it between neighbouring views.
fn judged(
    part: &Part,
    found: &[f64],
    depths: Option<&Depths>,
    covered: Option<f64>,
) -> Result<String, String> {
    let (name, step) = (&part.name, step(found));
    let (expected, [least, most]) = match (part.is, depths, covered) {
        (Place::Flat, ..) => ("on the panel".to_owned(), [0.0; 2]),
        (Place::Sky, Some(d), _) => (format!("infinity {:+.2}", d.infinity), [d.infinity; 2]),
        (Place::Scene, Some(d), _) => {
            let text = format!("scene {:+.2} to {:+.2}", d.near, d.far);
            (text, [d.near, d.far])
        }
        (Place::Nearer, Some(d), Some(covered)) => {
            let text = format!("before {covered:+.2}, to {:+.2}", d.near);
            (text, [d.near, covered])
        }
        (Place::Nearer, _, None) => return Err(format!("{name}: what it covers is not found")),
        (_, None, _) => return Err(format!("{name}: no scene with depth")),
    };
    // In every view, from the leftmost on.
    let good = found.iter().enumerate().all(|(view, shift)| {
        let views = view as f64;
        (least * views - TOLERANCE..=most * views + TOLERANCE).contains(shift)
    });
    let text = format!("{name} {step:+.2} ({expected})");
    match good && (part.is != Place::Nearer || step < most - MARGIN) {
        true => Ok(text),
        false => Err(text),
    }
}

/// What the layer has told, and what it could not do.
fn notes(report: &Value) -> String {
    let notes = report["notes"].as_array().into_iter().flatten();
    let notes = notes
        .filter_map(Value::as_str)
        .map(|note| note.replace('|', "/"));
    notes.collect::<Vec<_>>().join("; ")
}

#[test]
fn a_part_that_covers_another_is_nearer() {
    let part = Part {
        name: "arm".into(),
        at: [0; 4],
        is: Place::Nearer,
        element: None,
    };
    let depths = Depths {
        near: -0.5,
        far: 1.2,
        infinity: 1.2,
    };
    let good = |step: f64, covered: Option<f64>| {
        let shifts: Vec<_> = (0..VIEWS).map(|view| step * f64::from(view)).collect();
        judged(&part, &shifts, Some(&depths), covered).is_ok()
    };
    assert!(good(-0.4, Some(0.85)));
    assert!(!good(1.03, Some(0.94)), "behind it");
    assert!(
        !good(0.9, Some(0.94)),
        "no nearer than the measurement is exact"
    );
    assert!(!good(-0.9, Some(0.85)), "nearer than all there is");
    assert!(!good(-0.4, None));
}
