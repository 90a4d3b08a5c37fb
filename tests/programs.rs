//! Real programs: each is recorded once with apitrace and repeated with and without the layer; docs/compatibility.md is the result.
//!
//! `make programs` runs all of tests/programs/programs.toml and takes about two hours. `MANYVIEW_PROGRAMS=glxgears,cage` runs only
//! these, `-` none; the rows of the others are those of their last run, kept in target/programs. Traces are kept there as well: a program
//! whose folder is deleted is recorded again. `MANYVIEW_PROGRAMS_JOBS` is how many run at a time, 1 unless given;
//! `MANYVIEW_PROGRAMS_FRAMES` how many frames at most, for a quick look.
#![forbid(unsafe_code)]

mod support;

#[path = "programs/depth.rs"]
mod depth;
#[path = "programs/judge.rs"]
mod judge;
#[path = "programs/repeat.rs"]
mod repeat;
#[path = "programs/row.rs"]
mod row;
#[path = "programs/table.rs"]
mod table;

use row::Row;
use std::collections::BTreeSet;
use std::fs;
use std::process::Command;
use std::sync::Mutex;
use std::time::Instant;
use support::{has, own_screen, scratch};
use table::Program;

/// What a person may ask for by a variable.
fn wish(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

/// Runs programs and keeps their rows in target/programs.
fn run(programs: Vec<&Program>) {
    let jobs = wish("MANYVIEW_PROGRAMS_JOBS").map_or(1, |n| n.parse().expect("a number of jobs"));
    let count = programs.len();
    let queue = Mutex::new(programs.into_iter().enumerate());
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| {
                // Windows that cover each other have undefined pixels: a screen for each.
                let screen = own_screen();
                loop {
                    let next = queue.lock().expect("the queue").next();
                    let Some((at, program)) = next else { break };
                    let start = Instant::now();
                    let folder = scratch("programs").join(&program.name);
                    fs::create_dir_all(&folder).expect("a folder");
                    let row = judge::judge(program, &screen, &folder);
                    row.save(&folder);
                    eprintln!(
                        "{}/{count} {}: {} ({} s)",
                        at + 1,
                        program.name,
                        row.summary(),
                        start.elapsed().as_secs()
                    );
                }
            });
        }
    });
}

#[test]
#[ignore = "two hours: make programs"]
fn programs_are_compatible() {
    assert!(has("apitrace") && has("glretrace"), "make packages");
    let table = table::read();
    let wanted: Option<BTreeSet<String>> =
        wish("MANYVIEW_PROGRAMS").map(|names| names.split(',').map(str::to_owned).collect());
    let chosen = |program: &&Program| {
        wanted
            .as_ref()
            .is_none_or(|names| names.contains(&program.name))
    };
    let programs: Vec<_> = table.iter().filter(chosen).collect();
    let none = wish("MANYVIEW_PROGRAMS").is_some_and(|names| names == "-");
    assert!(
        none || !programs.is_empty(),
        "MANYVIEW_PROGRAMS names no program"
    );
    let packages: BTreeSet<_> = programs
        .iter()
        .flat_map(|program| program.package.split(' '))
        .chain(["xdotool"])
        .collect();
    let status = Command::new("sh")
        .args(["scripts/packages.sh", "--optional"])
        .args(packages)
        .status();
    // A package that is not to be had is a row of the table.
    status.expect("sh");
    run(programs);

    let rows: Vec<_> = table
        .iter()
        .filter_map(|program| {
            let row = Row::load(&scratch("programs").join(&program.name))?;
            Some((program, row))
        })
        .collect();
    fs::write("docs/compatibility.md", row::document(&rows)).expect("written");
    let unexplained: Vec<_> = rows
        .iter()
        .filter(|(program, row)| row.fails() != program.known.is_some())
        .map(|(program, row)| format!("{}: {}", program.name, row.summary()))
        .collect();
    assert!(
        unexplained.is_empty(),
        "fix what fails, or give it a `known` in programs.toml with the cause; take out the `known` of what no longer fails:\n{}",
        unexplained.join("\n")
    );
}

#[test]
#[ignore = "minutes: make programs"]
fn programs_stay_within_the_budget_of_the_display() {
    assert!(has("apitrace") && has("glretrace"), "make packages");
    let table = table::read();
    let screen = own_screen();
    let games = depth::GAMES.map(|name| table.iter().find(|program| program.name == name));
    let wrong = games
        .into_iter()
        .map(|game| depth::judge(game.expect("a game of the table"), &screen));
    let wrong: Vec<_> = wrong.flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_table_can_be_read_and_spans_what_programs_draw_with() {
    let table = table::read();
    assert!(table.len() >= 30, "{} programs", table.len());
    let names: BTreeSet<_> = table.iter().map(|program| &program.name).collect();
    assert_eq!(names.len(), table.len(), "each name once");
    for word in [
        "begin/end",
        "lists",
        "client arrays",
        "VBO",
        "GLSL",
        "stencil",
        "texgen",
        "fog",
        "clip",
        "FBO",
        "Bitmap",
        "RasterPos",
        "CopyTex",
        "2 contexts",
        "EGL",
        "GLX",
    ] {
        let uses = |program: &&Program| program.draws.contains(word) || program.api.name() == word;
        assert!(
            table.iter().any(|program| uses(&program)),
            "no program with {word}"
        );
    }
}
