//! `manyview doctor`: collects findings, then prints them as a table or as JSON.
#![forbid(unsafe_code)]

use super::{Outcome, print, print_json, tell};
use clap::Args;
use manyview::launch::{Findings, LaunchError, Probe};
use std::ffi::OsString;
use std::fmt::Write;
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    /// As JSON
    #[arg(long)]
    json: bool,
    /// The program to look at; it is not started
    #[arg(trailing_var_arg = true, value_name = "APP")]
    command: Vec<OsString>,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let findings = Findings::gather(arguments.command.first().map(OsString::as_os_str))?;
    if arguments.json {
        print_json(&findings)?;
    } else {
        print(&table(&findings))?;
    }
    match findings.obstacle() {
        None => Ok(ExitCode::SUCCESS),
        Some(obstacle) => {
            tell(&obstacle);
            Ok(ExitCode::from(LaunchError::NoOpenGl.exit_status()))
        }
    }
}

fn table(findings: &Findings) -> String {
    let mut text = String::new();
    for (name, value) in lines(findings) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name:<12}{value}");
    }
    text
}

/// Names and values; an empty name continues the value above.
fn lines(findings: &Findings) -> Vec<(&str, String)> {
    let mut lines = Vec::new();
    if let Some(app) = &findings.app {
        let class = match findings.class {
            Some(class) => format!(", {} bits", class.bits()),
            None => ", a script; the programs that it starts have the layer".to_owned(),
        };
        lines.push(("program", app.display().to_string() + &class));
    }
    lines.push((
        "layer",
        match &findings.library {
            Ok(path) => path.display().to_string(),
            Err(reason) => format!("missing: {reason}"),
        },
    ));
    match (&findings.narrow, &findings.library) {
        (Some(path), Ok(main)) if path != main => {
            lines.push(("", format!("{} for 32-bit programs", path.display())));
        }
        (None, Ok(_)) => lines.push((
            "",
            "none for 32-bit programs; `make build-32` makes it".to_owned(),
        )),
        _ => {}
    }
    if findings.disabled {
        let off = "MANYVIEW_DISABLE is set: the layer stays out of every program".to_owned();
        lines.push(("", off));
    }
    let mut families: Vec<_> = findings.hooks.iter().collect();
    families.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let hooks: Vec<_> = families
        .into_iter()
        .map(|(family, count)| format!("{count} {family}"))
        .collect();
    lines.push((
        "hooks",
        if hooks.is_empty() {
            "none".to_owned()
        } else {
            hooks.join(", ")
        },
    ));
    lines.extend(libraries(findings));
    lines.push((
        "screen",
        match &findings.display {
            Some(display) => display.clone(),
            None if findings.own_screen => {
                "DISPLAY is not set; tried on an Xvfb of our own, as capture does".to_owned()
            }
            None if findings.probes.is_empty() => "DISPLAY is not set".to_owned(),
            None => {
                "DISPLAY is not set, and Xvfb does not start; the package xvfb has it".to_owned()
            }
        },
    ));
    for probe in &findings.probes {
        lines.extend(context(probe, findings.library.is_ok()));
    }
    if findings.probes.is_empty() {
        let why = "not tried; the helper manyview-probe is not there for this class".to_owned();
        lines.push(("contexts", why));
    }
    lines
}

fn libraries(findings: &Findings) -> Vec<(&str, String)> {
    let mut lines = Vec::new();
    for library in &findings.libraries {
        let path = match &library.path {
            Some(path) => path.display().to_string(),
            None => "not installed".to_owned(),
        };
        let by = match &library.linked_by {
            Some(by) => format!(", linked by {by}"),
            None => String::new(),
        };
        let name = if lines.is_empty() { "OpenGL" } else { "" };
        lines.push((name, format!("{}: {path}{by}", library.name)));
    }
    if findings.app.is_some() && lines.is_empty() {
        let dynamic =
            "none linked; the program may load one by name when it runs, and the layer sees that";
        lines.push(("OpenGL", dynamic.to_owned()));
    }
    lines
}

fn context(probe: &Probe, library: bool) -> Vec<(&str, String)> {
    if let Some(error) = &probe.error {
        return vec![(&probe.api, format!("no context: {error}"))];
    }
    let version = probe.version.as_deref().unwrap_or("unknown version");
    let renderer = probe.renderer.as_deref().unwrap_or("unknown renderer");
    let mut lines = vec![(
        probe.api.as_str(),
        format!("OpenGL {version} on {renderer}"),
    )];
    let strategies = if probe.strategies.is_empty() {
        "none; a program is shown as it is".to_owned()
    } else {
        probe.strategies.join(", ")
    };
    lines.push(("", format!("strategies: {strategies}")));
    if library && !probe.hooked {
        lines.push((
            "",
            "the layer did not get between program and driver".to_owned(),
        ));
    }
    let notes = probe.notes.iter();
    lines.extend(notes.map(|note| ("", note.clone())));
    lines
}
