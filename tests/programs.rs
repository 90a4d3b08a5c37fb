//! Real programs: each is recorded once with apitrace and repeated with and without the layer; docs/compatibility.md is the result.
//!
//! `make programs` runs all of tests/programs/programs.toml and takes about two hours. `MANYVIEW_PROGRAMS=glxgears,cage` runs only
//! these, `-` none; the others keep the rows that the document has. Traces are kept in target/programs: a program whose folder is deleted is
//! recorded again. `MANYVIEW_PROGRAMS_JOBS` is how many run at a time, 1 unless given;
//! `MANYVIEW_PROGRAMS_FRAMES` how many frames at most, for a quick look.

mod cloud;
mod depth;
mod judge;
mod parallax;
mod pictures;
mod repeat;
mod row;
mod table;
mod tally;

use crate::support::play;
use crate::support::{has, own_screen, scratch, sized_screen};
use row::Row;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::sync::Mutex;
use std::time::Instant;
use table::Program;

/// A variable by which a person chooses what runs.
fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

/// The document that holds the rows.
const DOCUMENT: &str = "docs/compatibility.md";

/// The rows that the document already has.
fn kept(table: &[Program]) -> BTreeMap<String, Row> {
    let mut rows = row::rows(&fs::read_to_string(DOCUMENT).unwrap_or_default());
    for program in table {
        if let Some(row) = rows.get_mut(&program.name) {
            row.adapt(program);
        }
    }
    rows
}

/// Rows in the order of the table.
fn in_order<'a>(
    table: &'a [Program],
    rows: &'a BTreeMap<String, Row>,
) -> Vec<(&'a Program, &'a Row)> {
    let row = |program: &'a Program| Some((program, rows.get(&program.name)?));
    table.iter().filter_map(row).collect()
}

fn write(table: &[Program], rows: &BTreeMap<String, Row>) {
    fs::write(DOCUMENT, row::document(&in_order(table, rows))).expect("written");
}

/// Runs programs; each row is written to the document as soon as it is there.
fn run(programs: Vec<&Program>, table: &[Program]) {
    let jobs =
        variable("MANYVIEW_PROGRAMS_JOBS").map_or(1, |n| n.parse().expect("a number of jobs"));
    let count = programs.len();
    let writing = Mutex::new(());
    let queue = Mutex::new(programs.into_iter().enumerate());
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().expect("the queue").next();
                    let Some((at, program)) = next else { break };
                    // A screen for each program: windows that cover each other have undefined pixels.
                    let screen = program.screen.map_or_else(own_screen, sized_screen);
                    let start = Instant::now();
                    let folder = scratch("programs").join(&program.name);
                    fs::create_dir_all(&folder).expect("a folder");
                    let row = judge::judge(program, &screen, &folder);
                    eprintln!(
                        "{}/{count} {}: {} ({} s)",
                        at + 1,
                        program.name,
                        row.summary(),
                        start.elapsed().as_secs()
                    );
                    // Read again: another run may have written rows meanwhile.
                    let _alone = writing.lock().expect("the document");
                    let mut rows = kept(table);
                    rows.insert(program.name.clone(), row);
                    write(table, &rows);
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
    let programs = play::chosen("MANYVIEW_PROGRAMS", &table, |program| &program.name);
    play::install(programs.iter().map(|program| program.package.as_str()));
    cloud::write();
    run(programs, &table);

    let rows = kept(&table);
    write(&table, &rows);
    let expected = |(program, row): &&(&Program, &Row)| match row.fails() {
        true => program.known.is_some(),
        false => program.known.is_none() || program.varies,
    };
    let unexplained: Vec<_> = in_order(&table, &rows)
        .iter()
        .filter(|row| !expected(row))
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
    let unexplained = |program: &&Program| program.varies && program.known.is_none();
    assert!(!table.iter().any(|program| unexplained(&program)));
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
