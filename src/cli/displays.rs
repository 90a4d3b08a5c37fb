//! `manyview displays`
#![forbid(unsafe_code)]

use super::{Outcome, print, print_json};
use clap::Args;
use manyview::config::panel;
use std::fmt::Write;

#[derive(Args)]
pub(crate) struct Arguments {
    /// As JSON
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let panels = panel::builtins();
    if arguments.json {
        return print_json(&panels);
    }
    let width = panels
        .iter()
        .map(|panel| panel.name.len())
        .max()
        .unwrap_or(0)
        .max("NAME".len());
    let mut text = format!("{:width$}  VIEWS  KIND\n", "NAME");
    for panel in panels {
        let views = panel
            .views
            .map_or("N".to_owned(), |views| views.to_string());
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:width$}  {:>5}  {}", panel.name, views, panel.kind);
    }
    print(&text)
}
