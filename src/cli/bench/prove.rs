//! `manyview bench -- APP`: the user's own program under each configuration, one after the other, each proved.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use super::super::layer::variable;
use super::super::run::StatusFile;
use super::super::{Outcome, print, tell};
use super::{Arguments, measure, write_json};
use manyview::bench::{
    BenchError, CONFIGURATIONS, DEFAULT_CONFIGURATIONS, ProofRow, Proofs, Variant, find,
};
use manyview::config::{OptionId, Origin, Settings};
use manyview::launch::{Launch, ProveJob, Screen, Stop};
use std::process::ExitCode;
use std::time::{Duration, SystemTime};

/// Proves every fifth frame; the four in between are timed.
const EVERY: &str = "5";
/// For one configuration.
const LIMIT: Duration = Duration::from_secs(60);

/// One configuration, ready to start.
struct Turn {
    name: String,
    launch: Launch,
    status: StatusFile,
}

pub(super) fn run(arguments: &Arguments, frames: u32) -> Outcome {
    let turns = turns(arguments)?;
    let date = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let mut stop = Stop::watch()?;
    let screen = Screen::find()?;
    let bar = measure::bar(turns.len() as u64);
    let mut rows = Vec::new();
    for turn in &turns {
        bar.set_message(turn.name.clone());
        let job = ProveJob {
            launch: &turn.launch,
            screen: &screen,
            status: turn.status.file(),
            frames: frames.into(),
            limit: LIMIT,
        };
        let notes = job.run(&mut stop)?;
        let proof = turn.status.proof().unwrap_or_default();
        rows.push(ProofRow {
            configuration: turn.name.clone(),
            verdict: proof.verdict(),
            proof,
            notes,
        });
        bar.inc(1);
    }
    bar.finish_and_clear();
    let nothing = |row: &ProofRow| row.proof.frames == 0 && row.proof.skipped.is_empty();
    if rows.iter().all(nothing) {
        let note = rows.into_iter().flat_map(|row| row.notes).last();
        return Err(BenchError::Unproved(note.unwrap_or_default()).into());
    }
    let command = arguments.command.iter();
    let proofs = Proofs {
        date,
        command: command
            .map(|word| word.to_string_lossy().into_owned())
            .collect(),
        rows,
    };
    print(&proofs.text())?;
    if let Some(file) = &arguments.json {
        write_json(&proofs, file)?;
    }
    if let Some(file) = &arguments.csv {
        proofs.write_csv(file)?;
        tell(&format_args!("wrote {}", file.display()));
    }
    Ok(ExitCode::SUCCESS)
}

/// All configurations, checked before the first is started.
fn turns(arguments: &Arguments) -> Result<Vec<Turn>, CommandError> {
    let mut variants = Vec::new();
    let variant = |name: &str, view_scale: &str| {
        let configuration = find(CONFIGURATIONS, |known| known.name, "--strategy", name)?;
        Ok::<_, BenchError>(Variant {
            configuration,
            view_scale: view_scale.to_owned(),
            display: arguments.display.clone(),
            disabled: None,
        })
    };
    let (names, scales) = (&arguments.strategy, &arguments.view_scale);
    for name in super::or_default(names, DEFAULT_CONFIGURATIONS) {
        for scale in super::or_default(scales, &["1"]) {
            variants.push(variant(&name, &scale)?);
        }
    }
    if names.is_empty() && scales.is_empty() {
        variants.push(variant("replay", "auto")?);
    }
    let several = arguments.views.len() > 1;
    let mut turns = Vec::new();
    // Without a number it is the display's own.
    for views in super::or_default(&arguments.views, &[""]) {
        for variant in &variants {
            let mut settings = Settings::default();
            let ours = [
                (OptionId::ViewScale, &*variant.view_scale),
                (OptionId::Prove, EVERY),
                (OptionId::Views, &*views),
                (
                    OptionId::Display,
                    variant.display.as_deref().unwrap_or_default(),
                ),
            ];
            let options = variant.configuration.options.iter().copied();
            for (id, value) in options.chain(ours).filter(|(_, value)| !value.is_empty()) {
                settings.set(id, value, Origin::CommandLine);
            }
            let status = StatusFile::new(&mut settings)?;
            let settings = settings.over(Settings::from_env(variable)?);
            let name = variant.name();
            turns.push(Turn {
                name: match several {
                    true => format!("{name}, {views} views"),
                    false => name,
                },
                launch: Launch::prepare(&arguments.command, &settings)?,
                status,
            });
        }
    }
    Ok(turns)
}
