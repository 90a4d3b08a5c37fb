//! docs/looks.md: a table of the games, and a section with the pictures of each.

use crate::looks::row::Row;
use crate::looks::table::{ELEMENTS, Game};
use std::collections::BTreeMap;
use std::fmt::Write;

const HEAD: &str = "\
# What it looks like

Games of Debian 12 under the layer as a new user launches them: `manyview run -- GAME`, without any option or profile of the user's.
`make looks` makes this page; it is not edited by hand. [tests/looks/games.toml](../tests/looks/games.toml) has the commands, the keys that lead
into the game, the parts that are looked at, and what a person saw.

Each picture shows the leftmost, the fifth and the rightmost of the 8 views, then an anaglyph of the outermost two (red and cyan), as deep as
the panel shows it, and the disparities of the frames before it.

- disparities: of the nearest and of the farthest point of the scene in all frames, in pixels between neighbouring views, positive behind the
  panel; the budget of the display; the share of frames beyond it, which is no failure (*italic*). The frames are drawn by the processor, so there are few in a second, and a
  camera moves far from one to the next.
- parts: how far a part of the picture moves between neighbouring views, measured in the pixels, and where it belongs. In each of the 8 views it
  has to be there within one pixel.

";

const ELEMENTS_HEAD: &str = "
## Elements

What often looks wrong in several views. Parts of the games that show it, and the [demos](../examples/README.md) whose views the tests compare with what
the demos themselves draw.

| element | parts | demos |
|---|---|---|
";

/// What the page holds of a game.
pub(crate) struct Entry {
    /// Its line in the table.
    line: String,
    /// Its section.
    section: String,
}

impl Entry {
    pub(crate) fn passes(&self) -> bool {
        self.line.ends_with("| passes |")
    }

    /// What the table says of a part.
    fn part(&self, name: &str) -> Option<&str> {
        let cell = self.line.split(" | ").nth(2)?;
        let start = format!("{name} ");
        let parts = cell.split_inclusive(')');
        let mut parts = parts.map(|part| part.trim_start_matches(['*', ',', ' ']));
        parts.find(|part| part.starts_with(&start))
    }

    /// For a line of progress.
    pub(crate) fn summary(&self) -> &str {
        self.line.split_once(" | ").map_or("", |(_, cells)| cells)
    }
}

/// The entry of a game. `pictures`: there are pictures of it.
pub(crate) fn entry(game: &Game, row: &Row, pictures: bool) -> Entry {
    let verdict = if row.failed { "**fails**" } else { "passes" };
    let line = format!(
        "| [{name}](#{name}) | {} | {} | {verdict} |",
        row.cells[0],
        row.cells[1],
        name = game.name,
    );
    let mut section = String::new();
    let mut paragraph = |text: &str| {
        if !text.is_empty() {
            // Writing to a string cannot fail.
            let _ = write!(section, "{text}\n\n");
        }
    };
    paragraph(&format!("`{}`. {}", game.command.join(" "), game.seen));
    if let Some(wrong) = &game.wrong {
        paragraph(&format!("**Wrong**: {wrong}."));
    }
    if let Some(known) = &game.known {
        paragraph(&format!("Why it fails: {known}."));
    }
    if !row.cells[2].is_empty() {
        paragraph(&format!("The layer told: {}.", row.cells[2]));
    }
    if pictures {
        let name = &game.name;
        paragraph(&format!("![](looks/{name}.jpg)"));
        paragraph(&format!(
            "![](looks/{name}-anaglyph.jpg) ![](looks/{name}.svg)"
        ));
    }
    Entry { line, section }
}

/// The entries that a page already has, by name.
pub(crate) fn entries(page: &str) -> BTreeMap<String, Entry> {
    let mut sections = page.split("\n## ");
    let head = sections.next().unwrap_or_default();
    let line = |name: &str| {
        let start = format!("| [{name}]");
        head.lines().find(|line| line.starts_with(&start))
    };
    let entry = |section: &str| {
        let (name, text) = section.split_once("\n\n")?;
        let entry = Entry {
            line: line(name)?.to_owned(),
            section: format!("{}\n\n", text.trim_end()),
        };
        Some((name.to_owned(), entry))
    };
    sections.filter_map(entry).collect()
}

/// The table of elements: the parts that show each, and the demos that the tests compare.
fn elements(known: &[(&Game, &Entry)]) -> String {
    let mut text = String::from(ELEMENTS_HEAD);
    for (element, demos) in ELEMENTS {
        let cell = |(game, entry): &(&Game, &Entry)| {
            let parts = game.part.iter();
            let shown: Vec<_> = parts
                .filter(|part| part.element.as_deref() == Some(element))
                .filter_map(|part| entry.part(&part.name))
                .collect();
            (!shown.is_empty())
                .then(|| format!("[{name}](#{name}): {}", shown.join(", "), name = game.name))
        };
        let cells: Vec<_> = known.iter().filter_map(cell).collect();
        let demos = demos.unwrap_or("none: [on the panel](limits.md)");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {element} | {} | {demos} |", cells.join("; "));
    }
    text
}

/// The page of these games, in their order.
pub(crate) fn page(games: &[Game], entries: &BTreeMap<String, Entry>) -> String {
    let known = || {
        games
            .iter()
            .filter_map(|game| Some((game, entries.get(&game.name)?)))
    };
    let passed = known().filter(|(_, entry)| entry.passes()).count();
    let beyond = known()
        .filter(|(_, entry)| entry.line.contains(" %* of "))
        .count();
    let mut text = format!(
        "{HEAD}{} games, {passed} pass; in {beyond} some frames are beyond the budget. Failures are **bold**.\n\n",
        known().count()
    );
    text.push_str("| game | disparities | parts | verdict |\n|---|---|---|---|\n");
    for (_, entry) in known() {
        text.push_str(&entry.line);
        text.push('\n');
    }
    text.push_str(&elements(&known().collect::<Vec<_>>()));
    for (game, entry) in known() {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n## {}\n\n{}", game.name, entry.section.trim_end());
        text.push('\n');
    }
    text
}

#[test]
fn elements_are_known_and_their_parts_are_found() {
    let games = crate::looks::table::read();
    for part in games.iter().flat_map(|game| &game.part) {
        let element = part.element.as_deref();
        let known = |name| ELEMENTS.iter().any(|(element, _)| *element == name);
        assert!(element.is_none_or(known), "{}: {element:?}", part.name);
    }
    let entry = Entry {
        line: "| [a](#a) | -1 to +1 of 2 | far car +1.00 (scene -0.41 to +1.22), **car: not found (sky)**, map +0.01 (on the panel) | passes |"
            .to_owned(),
        section: String::new(),
    };
    assert_eq!(entry.part("map"), Some("map +0.01 (on the panel)"));
    assert_eq!(
        entry.part("far car"),
        Some("far car +1.00 (scene -0.41 to +1.22)")
    );
    assert_eq!(entry.part("car"), None);
}

#[test]
fn a_page_that_is_read_is_written_as_it_was() {
    let games = crate::looks::table::read();
    let row = |failed| Row {
        failed,
        cells: ["-1 to +1".into(), "sky +1.5".into(), "a note".into()],
    };
    let entries_of = games.iter().enumerate().map(|(at, game)| {
        (
            game.name.clone(),
            entry(game, &row(at % 2 == 1), at % 3 > 0),
        )
    });
    let text = page(&games, &entries_of.collect());
    assert_eq!(page(&games, &entries(&text)), text);
}
