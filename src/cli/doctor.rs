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
    let findings = Findings::gather(&arguments.command)?;
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
    lines.extend(way(findings));
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

/// How the program reaches the screen, and what the user should change.
fn way(findings: &Findings) -> Vec<(&str, String)> {
    let way = &findings.way;
    let mut lines = Vec::new();
    if let Some(windows) = &way.windows {
        let class = windows.class.map_or_else(
            || "of an unknown class".to_owned(),
            |class| format!("of {} bits", class.bits()),
        );
        let api = windows
            .api
            .as_deref()
            .unwrap_or("no API that its file names");
        let name = windows.path.display();
        lines.push(("Windows", format!("{name}, {class}, draws by {api}")));
        let becomes = match windows.backend.as_deref() {
            Some("OpenGL") => "drawn by OpenGL: in views",
            Some("wined3d") => "drawn by wined3d, by OpenGL: in views",
            Some(_) => "drawn by Vulkan: as it is, without views",
            None => "what it loads when it runs is not known; `run` shows it",
        };
        lines.push(("", becomes.to_owned()));
    }
    if let Some(container) = &way.container {
        lines.push(("container", container.clone()));
    }
    if let Some(desk) = &way.desk {
        lines.push(("desk", desk.clone()));
    }
    lines.extend(way.advice.iter().map(|advice| ("advice", advice.clone())));
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
