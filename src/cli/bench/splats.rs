//! `manyview bench --preset huebner-chart1` and the like: no program is started; clouds are drawn as blended splats by our own helper.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use super::{Arguments, measure, write_json};
use crate::cli::{Outcome, print, tell};
use manyview::bench::chart::Format;
use manyview::bench::splats::{Splats, text, write_chart, write_csv};
use manyview::bench::{BenchError, Preset};
use manyview::launch::measured;
use std::process::ExitCode;
use std::time::SystemTime;

/// Refuses options that are for programs.
pub(super) fn check(arguments: &Arguments, preset: &'static Preset) -> Result<(), BenchError> {
    let given = [
        ("--display", arguments.display.is_some()),
        ("--frames", arguments.frames.is_some()),
        ("--api", arguments.api.is_some()),
        ("--size", !arguments.size.is_empty()),
    ];
    if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
        let preset = preset.name;
        return Err(BenchError::NoProgram { option, preset });
    }
    arguments
        .chart
        .as_deref()
        .map_or(Ok(()), |file| Format::of(file).map(drop))
}

pub(super) fn run(arguments: &Arguments, preset: &'static Preset) -> Outcome {
    let mut words = vec!["points-chart".to_owned()];
    words.extend(
        preset
            .splats
            .iter()
            .flat_map(|(points, size)| [points.to_string(), size.to_string()]),
    );
    let bar = measure::bar(preset.splats.len() as u64);
    let (mut rows, mut bad) = (Vec::new(), None);
    measured::lines(&words, &mut |line| {
        match serde_json::from_str(line) {
            Ok(row) => rows.push(row),
            Err(error) => bad = Some(error),
        }
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    if let Some(error) = bad {
        return Err(CommandError::system(
            "reading what was measured",
            error.into(),
        ));
    }
    let splats = Splats {
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        command: std::env::args().collect(),
        preset: preset.name,
        rows,
    };
    print(&format!(
        "{}: {}\n\n{}",
        preset.name,
        preset.about,
        text(&splats)
    ))?;
    if let Some(file) = &arguments.json {
        write_json(&splats, file)?;
    }
    if let Some(file) = &arguments.csv {
        write_csv(&splats, file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    if let Some(file) = &arguments.chart {
        write_chart(&splats, file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    Ok(ExitCode::SUCCESS)
}
