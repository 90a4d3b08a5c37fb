//! First launches: games are played without any option, and looked at; docs/looks.md is the result.
//!
//! `make looks` plays all of tests/looks/games.toml and takes about an hour. `MANYVIEW_LOOKS=torcs,neverball` plays only these, `-` none; the
//! others keep what the page has. Views, report and log of each are kept in target/looks; with `MANYVIEW_LOOKS_KEPT=1` these are judged again and
//! nothing is played, which helps to name parts. `make looks-strategies` plays them once more under each strategy; docs/looks-strategies.md.

mod launch;
mod page;
mod pictures;
mod row;
mod shift;
mod strategies;
mod table;

use crate::support::play;
use crate::support::scratch;
use launch::Launched;
use std::fs;
use std::path::Path;
use table::Game;

const PAGE: &str = "docs/looks.md";
const PICTURES: &str = "docs/looks";
const STRATEGIES: &str = "docs/looks-strategies.md";

/// A game that is played now, or was played before.
fn launched(game: &Game, folder: &Path, strategy: Option<&str>) -> Result<Launched, String> {
    match std::env::var_os("MANYVIEW_LOOKS_KEPT") {
        Some(_) => launch::kept(folder, u64::MAX),
        None => launch::launch(game, folder, strategy),
    }
}

/// Plays a game and writes its pictures.
fn look(game: &Game) -> page::Entry {
    let folder = scratch("looks").join(&game.name);
    fs::create_dir_all(&folder).expect("a folder");
    let launched = match launched(game, &folder, None) {
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

#[test]
#[ignore = "two hours: make looks-strategies"]
fn looks_are_right_under_every_strategy() {
    let games = table::read();
    let chosen = play::chosen("MANYVIEW_LOOKS", &games, |game| &game.name);
    let chosen: Vec<_> = chosen.into_iter().filter(|game| game.depths).collect();
    play::install(chosen.iter().map(|game| game.package.as_str()));
    let mut wrong = Vec::new();
    for (at, game) in chosen.iter().enumerate() {
        let cells = strategies::STRATEGIES.map(|strategy| {
            let folder = scratch("looks-strategies").join(&game.name).join(strategy);
            fs::create_dir_all(&folder).expect("a folder");
            let cell = strategies::cell(game, strategy, &launched(game, &folder, Some(strategy)));
            eprintln!(
                "{}/{} {} {strategy}: {cell}",
                at + 1,
                chosen.len(),
                game.name
            );
            if cell.contains("**") {
                wrong.push(format!("{} {strategy}", game.name));
            }
            cell
        });
        let mut all = strategies::cells(&fs::read_to_string(STRATEGIES).unwrap_or_default());
        all.insert(game.name.clone(), cells.to_vec());
        fs::write(STRATEGIES, strategies::page(&games, &all)).expect("written");
    }
    assert!(
        wrong.is_empty(),
        "parts are not where they belong: {}",
        wrong.join(", ")
    );
}
