//! docs/looks-strategies.md: whether the parts of the games are in the same place under every strategy.

use crate::looks::launch::Launched;
use crate::looks::row;
use crate::looks::table::Game;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Beside `auto`, which a first launch has.
pub(crate) const STRATEGIES: [&str; 3] = ["replay", "depth-image", "hybrid"];

const HEAD: &str = "\
# Looks under each strategy

Games of [What it looks like](looks.md), played with `--strategy` as the only option: sky, gauges and hand have to be in the same place
whatever strategy draws the views. `make looks-strategies` makes this page; it is not edited by hand.

A cell says how many of the parts are where they belong in each of the 8 views, which are out of place (**bold**, in pixels between neighbouring views), and in
how many frames views were synthesised. Each cell is a game of its own.

";

/// The cells of a page, by game.
pub(crate) type Cells = BTreeMap<String, Vec<String>>;

/// The cell of one game under one strategy.
pub(crate) fn cell(game: &Game, strategy: &str, launched: &Result<Launched, String>) -> String {
    let launched = match launched {
        Ok(launched) => launched,
        Err(reason) => return format!("**{}**", reason.replace('|', "/")),
    };
    let wrong: Vec<_> = row::parts(game, launched)
        .into_iter()
        .filter_map(Result::err)
        .collect();
    let mut text = format!(
        "{} of {} parts",
        game.part.len() - wrong.len(),
        game.part.len()
    );
    for wrong in wrong {
        // Writing to a string cannot fail.
        let _ = write!(text, ", **{wrong}**");
    }
    let synthesised = launched.report["frames_synthesised"].as_object();
    if synthesised.is_none() && strategy != "replay" {
        let reasons = launched.report["fallbacks"].as_object();
        let told = |start: &str| {
            let mut reasons = reasons.into_iter().flatten();
            reasons.find_map(|(reason, _)| reason.strip_prefix(start))
        };
        let whole = told("no view is synthesised: ");
        let part = told("views are synthesised before ");
        let _ = match (part, whole) {
            (Some(what), _) => write!(text, "; synthesised before {what}"),
            (None, Some(reason)) => write!(text, "; all views drawn: {reason}"),
            (None, None) => write!(
                text,
                "; **no views were synthesised, and no reason is told**"
            ),
        };
    }
    let frames = synthesised.map(|by| {
        by.values()
            .filter_map(serde_json::Value::as_u64)
            .sum::<u64>()
    });
    if let Some(frames) = frames {
        let _ = write!(text, "; synthesised in {frames} frames");
    }
    text
}

/// The cells that a page already has.
pub(crate) fn cells(page: &str) -> Cells {
    let rows = page.lines().filter_map(|line| {
        let mut cells = line
            .strip_prefix("| ")?
            .strip_suffix(" |")?
            .split(" | ")
            .map(str::to_owned);
        Some((cells.next()?, cells.collect()))
    });
    rows.filter(|(name, _)| name != "game").collect()
}

/// The page of these games, in their order.
pub(crate) fn page(games: &[Game], cells: &Cells) -> String {
    let mut text = HEAD.to_owned();
    let _ = writeln!(text, "| game | {} |", STRATEGIES.join(" | "));
    let _ = writeln!(text, "|---{}|", "|---".repeat(STRATEGIES.len()));
    for game in games {
        if let Some(cells) = cells.get(&game.name) {
            let _ = writeln!(text, "| {} | {} |", game.name, cells.join(" | "));
        }
    }
    text
}

#[test]
fn a_page_of_strategies_that_is_read_is_written_as_it_was() {
    let games = crate::looks::table::read();
    let row = |game: &Game| {
        (
            game.name.clone(),
            vec![
                "2 of 2 parts".into(),
                "**no**".into(),
                "1 of 2 parts, **sky +1 (infinity +2)**".into(),
            ],
        )
    };
    let text = page(&games, &games.iter().map(row).collect());
    assert_eq!(page(&games, &cells(&text)), text);
    assert!(text.lines().count() > games.len());
}
