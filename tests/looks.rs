//! First launches: games are played without any option, and looked at; docs/looks.md is the result.
//!
//! `make looks` plays all of tests/looks/games.toml and takes about an hour. `MANYVIEW_LOOKS=torcs,neverball` plays only these, `-` none; the
//! others keep what the page has. Views, report and log of each are kept in target/looks; with `MANYVIEW_LOOKS_KEPT=1` these are judged again and
//! nothing is played, which helps to name parts.
#![forbid(unsafe_code)]

mod support;

#[path = "looks/launch.rs"]
mod launch;
#[path = "looks/page.rs"]
mod page;
#[path = "looks/pictures.rs"]
mod pictures;
#[path = "support/play.rs"]
mod play;
#[path = "looks/row.rs"]
mod row;
#[path = "looks/shift.rs"]
mod shift;
#[path = "looks/table.rs"]
mod table;

use std::fs;
use std::path::Path;
use support::scratch;
use table::Game;

const PAGE: &str = "docs/looks.md";
const PICTURES: &str = "docs/looks";

/// Plays a game and writes its pictures.
fn look(game: &Game) -> page::Entry {
    let folder = scratch("looks").join(&game.name);
    fs::create_dir_all(&folder).expect("a folder");
    let launched = match std::env::var_os("MANYVIEW_LOOKS_KEPT") {
        Some(_) => launch::kept(&folder, u64::MAX),
        None => launch::launch(game, &folder),
    };
    let launched = match launched {
        Ok(launched) => launched,
        Err(reason) => return page::entry(game, &row::failed(&reason), false),
    };
    fs::create_dir_all(PICTURES).expect("a folder");
    pictures::write(&game.name, &launched, Path::new(PICTURES)).expect("pictures");
    page::entry(game, &row::row(game, &launched), true)
}

#[test]
#[ignore = "an hour: make looks"]
fn looks_of_games() {
    let games = table::read();
    let chosen = play::chosen("MANYVIEW_LOOKS", &games, |game| &game.name);
    play::install(chosen.iter().map(|game| game.package.as_str()));
    let kept = || page::entries(&fs::read_to_string(PAGE).unwrap_or_default());
    let write = |entries| fs::write(PAGE, page::page(&games, &entries)).expect("written");
    write(kept());
    for (at, game) in chosen.iter().enumerate() {
        let entry = look(game);
        eprintln!(
            "{}/{} {}: {}",
            at + 1,
            chosen.len(),
            game.name,
            entry.summary()
        );
        let mut entries = kept();
        entries.insert(game.name.clone(), entry);
        write(entries);
    }
    let entries = kept();
    let expected = |game: &&Game| {
        entries
            .get(&game.name)
            .is_none_or(|entry| entry.passes() == (game.known.is_none() && game.wrong.is_none()))
    };
    let unexplained: Vec<_> = games
        .iter()
        .filter(|game| !expected(game))
        .map(|game| game.name.as_str())
        .collect();
    assert!(
        unexplained.is_empty(),
        "fix what fails, or give it a `known` in games.toml with the cause; take out the `known` of what no longer fails: {}",
        unexplained.join(", ")
    );
}
