//! The description of a wall with what was measured.
#![forbid(unsafe_code)]

use super::Fit;
use toml::{Table, Value};

/// Fields that a homography takes the place of.
const PLACE: [&str; 3] = ["at", "width", "turn"];

/// The text of a description with the places and the light of a fit. None if it is not the description of the wall that was measured.
#[must_use]
pub fn written(text: &str, fit: &Fit) -> Option<String> {
    let mut table: Table = text.parse().ok()?;
    let panels = table.get_mut("panel")?.as_array_mut()?;
    if panels.len() != fit.to_wall.len() {
        return None;
    }
    for ((panel, to_wall), light) in panels.iter_mut().zip(&fit.to_wall).zip(&fit.light) {
        let panel = panel.as_table_mut()?;
        let row = |row: &[f64; 3]| Value::Array(row.iter().map(|n| Value::Float(*n)).collect());
        for field in PLACE {
            panel.remove(field);
        }
        panel.insert(
            "homography".into(),
            Value::Array(to_wall.iter().map(row).collect()),
        );
        let share = (light * 1e4).round() / 1e4;
        panel.insert("light".into(), Value::Float(share.min(1.0)));
    }
    toml::to_string(&table).ok()
}
