//! The hard cases: `manyview bench --hard` measures them, and every bound holds but for those of `MISSES`, whose reasons are known.
//!
//! A case that meets its bound again has to leave that list.

use crate::support;
use crate::support::share;
use crate::support::{demo, library, manyview, refused, run};
use manyview::bench::hard::{CASES, MISSES, Subject, configurations};
use serde_json::Value;
use std::collections::BTreeSet;

/// Runs cases under some configurations, a third of them in the ordinary run, and compares the misses with the known ones.
#[track_caller]
fn check(strategies: &[&str]) {
    let cases: Vec<_> = CASES.iter().step_by(share::every(3)).collect();
    let names: Vec<_> = cases.iter().map(|case| case.name).collect();
    library();
    demo("hard");
    let folder = tempfile::tempdir().expect("a folder");
    let json = folder.path().join("hard.json");
    let mut command = manyview();
    command
        .args([
            "bench",
            "--hard",
            "--api",
            "egl",
            "--strategy",
            &strategies.join(","),
            "--case",
            &names.join(","),
        ])
        .arg("--json")
        .arg(&json)
        .env_remove("DISPLAY");
    let (status, table, stderr) = run(&mut command);
    let text = std::fs::read_to_string(&json).unwrap_or_else(|_| panic!("{stderr}"));
    let outcomes: Vec<Value> = serde_json::from_str(&text).expect("JSON");
    let scenes = cases
        .iter()
        .filter(|case| matches!(case.subject, Subject::Scene { .. }));
    let bounds: usize = scenes.map(|case| case.bounds.len()).sum();
    assert!(outcomes.len() >= bounds * strategies.len(), "{table}");
    let word = |outcome: &Value, key: &str| outcome[key].as_str().expect("text").to_owned();
    let missed: BTreeSet<_> = outcomes
        .iter()
        .filter(|outcome| outcome["verdict"] == "missed")
        .map(|outcome| (word(outcome, "case"), word(outcome, "strategy")))
        .collect();
    let known: BTreeSet<_> = MISSES
        .iter()
        .flat_map(|miss| {
            miss.strategies
                .iter()
                .map(|strategy| (miss.case, *strategy))
        })
        .filter(|(case, strategy)| names.contains(case) && strategies.contains(strategy))
        .map(|(case, strategy)| (case.to_owned(), strategy.to_owned()))
        .collect();
    assert_eq!(missed, known, "{table}");
    assert_eq!(status, i32::from(!missed.is_empty()), "{stderr}");
}

#[test]
fn replay_holds_its_bounds() {
    check(&["replay"]);
}

#[test]
fn instanced_holds_its_bounds() {
    check(&["instanced"]);
}

#[test]
#[ignore = "half a minute: make test-long"]
fn geometry_holds_its_bounds() {
    check(&["geometry"]);
}

#[test]
#[ignore = "the layouts that are not taken unless they are asked for, for make test-long"]
fn every_layout_holds_its_bounds() {
    let others = configurations().map(|configuration| configuration.name);
    let others: Vec<_> = others
        .filter(|name| !["replay", "instanced", "geometry"].contains(name))
        .collect();
    assert!(others.len() >= 5, "{others:?}");
    check(&others);
}

/// Every scene of the program has a row of the table, and the other way round.
#[test]
fn every_scene_has_a_case() {
    let (status, list, stderr) = run(support::bare(demo("hard"))
        .args(["--list", "--api", "egl"])
        .env_remove("DISPLAY"));
    assert_eq!(status, 0, "{stderr}");
    let listed: BTreeSet<_> = list
        .lines()
        .filter_map(|line| line.split(' ').next())
        .collect();
    let drawn: BTreeSet<_> = CASES
        .iter()
        .filter_map(|case| match case.subject {
            Subject::Scene { scene, .. } => Some(scene),
            _ => None,
        })
        .collect();
    assert_eq!(listed, drawn);
}

#[test]
fn names_that_nobody_has_are_one_line() {
    refused(
        &["bench", "--hard", "--case", "easy"],
        2,
        "--case is 'easy'; this version knows depths, ",
    );
    refused(
        &["bench", "--hard", "--strategy", "magic"],
        2,
        "--strategy is 'magic'",
    );
}
