//! `manyview displays`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::{Outcome, print, print_json, tell};
use clap::{Args, Subcommand};
use manyview::display::{Builtin, Display, Kind, builtins};
use manyview::plugged::{Attached, Chosen, Panel, Plugged};
use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    /// As JSON
    #[arg(long, global = true)]
    json: bool,
    #[command(subcommand)]
    command: Option<Action>,
}

#[derive(Subcommand)]
enum Action {
    /// Print a panel and the numbers that follow from its description.
    Show {
        /// A built-in name, a description (.toml), a calibration (.json) or a mask (.png)
        display: String,
    },
    /// Set a panel up: `manyview run` shows on it unless it is told otherwise.
    Use {
        /// A built-in name, a description (.toml), a calibration (.json) or a mask (.png)
        display: String,
        /// Show in a window of the panel's own on this monitor [default: in the program's window]
        #[arg(long, value_name = "MONITOR|auto", allow_hyphen_values = true)]
        panel: Option<String>,
    },
    /// Forget the panel that is set up.
    Forget,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        Some(Action::Show { display }) => show(display, arguments.json),
        Some(Action::Use { display, panel }) => set_up(display, panel.as_deref()),
        Some(Action::Forget) => {
            let was = Chosen::forget()?;
            tell(&if was {
                "no panel is set up any more"
            } else {
                "no panel was set up"
            });
            Ok(ExitCode::SUCCESS)
        }
        None => list(arguments.json),
    }
}

fn list(as_json: bool) -> Outcome {
    let (plugged, chosen) = (Plugged::find(), Chosen::read()?);
    if as_json {
        let monitor = |attached: &Attached| {
            let calibration = plugged.calibration_of(attached);
            json!({
                "monitor": attached.monitor.name,
                "size": [attached.monitor.size.0, attached.monitor.size.1],
                "name": attached.name(),
                "tracked": attached.tracked(),
                "calibration": calibration.map(|found| &found.file),
            })
        };
        let panel = |panel: &Builtin| json!({"name": panel.name, "views": panel.views, "kind": panel.about});
        return print_json(&json!({
            "monitors": plugged.monitors.iter().map(monitor).collect::<Vec<_>>(),
            "calibrations": plugged.calibrations.iter().map(|found| &found.file).collect::<Vec<_>>(),
            "set-up": chosen,
            "built-in": builtins().iter().map(panel).collect::<Vec<_>>(),
        }));
    }
    let mut text = "PLUGGED IN\n".to_owned();
    if plugged.monitors.is_empty() {
        text += "no monitor is found\n";
    }
    text += &table(
        plugged
            .monitors
            .iter()
            .map(|monitor| attached(&plugged, monitor))
            .collect(),
    );
    for calibration in &plugged.calibrations {
        let about = match &calibration.display {
            Ok(_) => calibration.name(),
            Err(reason) => reason.clone(),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}  {about}", calibration.file.display());
    }
    text += "\nSET UP\n";
    text += &match &chosen {
        Some(Chosen { display, panel }) => match panel {
            Some(monitor) => format!("{display}, in a window of its own on monitor {monitor}\n"),
            None => format!("{display}, in the program's window\n"),
        },
        None => set_up_by(&plugged.panel()),
    };
    text += "\nBUILT IN\n";
    let builtins = builtins().into_iter().map(|panel| {
        let views = panel
            .views
            .map_or("N views".to_owned(), |views| format!("{views} views"));
        [panel.name, views, panel.about.to_owned()]
    });
    text += &table(builtins.collect());
    print(&text)
}

/// Name, size and what it is, of a monitor.
fn attached(plugged: &Plugged, attached: &Attached) -> [String; 3] {
    let (width, height) = attached.monitor.size;
    let mut about = attached.name().unwrap_or_default();
    if let Some(calibration) = plugged.calibration_of(attached) {
        let _ = write!(about, ", calibrated by {}", calibration.file.display());
    }
    if let Some(model) = attached.tracked() {
        let _ = write!(
            about,
            ": {model}, a tracked panel of two views; measure its lenses with `manyview calibrate`"
        );
    }
    [
        attached.monitor.name.clone(),
        format!("{width}x{height}"),
        about,
    ]
}

/// What `run` shows on where no panel is set up.
fn set_up_by(panel: &Panel) -> String {
    let shown = match panel {
        Panel::Calibrated { name, .. } => {
            format!("nothing; `manyview run` shows on {name}, which is plugged in")
        }
        Panel::Uncalibrated(_) | Panel::None => {
            "nothing; `manyview run` shows an anaglyph for red-cyan glasses".to_owned()
        }
    };
    format!(
        "{shown}\nA panel is set up with `manyview displays use NAME|FILE`; one that nobody has described is measured with `manyview calibrate`\n"
    )
}

/// Lines of three columns.
fn table(rows: Vec<[String; 3]>) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let (first, second) = (width(0), width(1));
    let line = |[a, b, c]: &[String; 3]| {
        format!("{a:first$}  {b:second$}  {c}")
            .trim_end()
            .to_owned()
            + "\n"
    };
    rows.iter().map(line).collect()
}

fn set_up(display: &str, panel: Option<&str>) -> Outcome {
    let loaded = Display::load(display)?;
    if matches!(loaded.kind, Kind::Uncalibrated) {
        return Err(CommandError::Model(display.to_owned()));
    }
    let display = if manyview::config::panel::is_builtin(display) {
        display.to_owned()
    } else {
        let absolute = std::path::absolute(display);
        let absolute = absolute.map_err(|error| CommandError::system("finding the file", error))?;
        absolute.to_string_lossy().into_owned()
    };
    let chosen = Chosen {
        display,
        panel: panel.map(str::to_owned),
    };
    let file = chosen.write()?;
    tell(&format_args!(
        "wrote {}; `manyview run -- PROGRAM` shows on this panel from now on",
        file.display()
    ));
    Ok(ExitCode::SUCCESS)
}

fn show(display: &str, as_json: bool) -> Outcome {
    let lines = Display::load(display)?.describe();
    if as_json {
        let object = lines
            .into_iter()
            .map(|(label, value)| (label.to_owned(), Value::String(value)));
        return print_json(&object.collect::<Map<_, _>>());
    }
    let width = lines.iter().map(|line| line.0.len()).max().unwrap_or(0);
    let mut text = String::new();
    for (label, value) in lines {
        let _ = writeln!(text, "{label:width$}  {value}");
    }
    print(&text)
}
