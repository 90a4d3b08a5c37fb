//! `manyview displays`
#![forbid(unsafe_code)]

use super::{Outcome, print, print_json};
use clap::{Args, Subcommand};
use manyview::display::{Display, builtins};
use serde_json::{Map, Value, json};
use std::fmt::Write;

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
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.command {
        Some(Action::Show { display }) => show(display, arguments.json),
        None => list(arguments.json),
    }
}

fn list(as_json: bool) -> Outcome {
    let panels = builtins();
    if as_json {
        let panels: Vec<_> = panels
            .iter()
            .map(|panel| json!({"name": panel.name, "views": panel.views, "kind": panel.about}))
            .collect();
        return print_json(&panels);
    }
    let lines = panels.iter().map(|panel| {
        let views = panel
            .views
            .map_or("N".to_owned(), |views| views.to_string());
        (panel.name.as_str(), views, panel.about)
    });
    let lines: Vec<_> = lines.collect();
    let width = lines.iter().map(|line| line.0.len()).max().unwrap_or(0);
    let mut text = format!("{:width$}  VIEWS  KIND\n", "NAME");
    for (name, views, about) in lines {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name:width$}  {views:>5}  {about}");
    }
    print(&text)
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
