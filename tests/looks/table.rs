//! The games of games.toml.

use crate::support::play::Input;
use serde::Deserialize;
use std::collections::BTreeMap;

/// One game.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Game {
    /// Its name, and that of its pictures.
    pub(crate) name: String,
    /// Debian packages, separated by spaces.
    pub(crate) package: String,
    /// Program and arguments.
    pub(crate) command: Vec<String>,
    /// Width and height of the screen, pixels.
    #[serde(default = "screen")]
    pub(crate) screen: (u16, u16),
    /// Seconds from the start to the pictures.
    pub(crate) at: f64,
    /// Input that leads from the menu into the game.
    #[serde(default)]
    pub(crate) input: Vec<Input>,
    /// Files that it finds in its home, by path: what a person would click on before.
    #[serde(default)]
    pub(crate) home: BTreeMap<String, String>,
    /// Whether it writes depths, so that the report has disparities.
    #[serde(default = "yes")]
    pub(crate) depths: bool,
    /// Parts of the picture whose place in depth is known.
    #[serde(default)]
    pub(crate) part: Vec<Part>,
    /// What a person saw.
    #[serde(default)]
    pub(crate) seen: String,
    /// What a person saw that is wrong. The game fails, although no check measures it.
    pub(crate) wrong: Option<String>,
    /// Why a check fails, if one does.
    pub(crate) known: Option<String>,
}

/// A part of the picture.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Part {
    /// What it shows, such as `mountains`.
    pub(crate) name: String,
    /// Left, top, width and height in the leftmost view, pixels from its upper left corner.
    pub(crate) at: [u32; 4],
    /// Where it belongs.
    pub(crate) is: Place,
    /// The element of pictures that it is an example of, one of [`ELEMENTS`].
    pub(crate) element: Option<String>,
}

/// Elements that often look wrong in several views, and the demos that have each. Tests compare the views of those with what the demos themselves
/// draw. `None`: the layer leaves such things on the panel (docs/limits.md).
pub(crate) const ELEMENTS: [(&str, Option<&str>); 12] = [
    ("reflection", Some("`mirror`, `fogtexgen`")),
    ("water", Some("`relief`")),
    ("shadow", Some("`mirror`, `crowd`, `passes`")),
    ("particles", Some("`sky`, `points`")),
    ("decal", Some("`mirror`, `hard`")),
    ("weapon", Some("`sky`")),
    ("crosshair", Some("`shade`, `menu`")),
    ("map", Some("`crowd`")),
    ("name tag", None),
    ("lens flare", None),
    ("bloom", Some("`passes`")),
    ("fog", Some("`fogtexgen`")),
];

/// A place in depth.
#[derive(Clone, Copy, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Place {
    /// At infinity.
    Sky,
    /// On the panel.
    Flat,
    /// Between the nearest and the farthest point of the scene.
    Scene,
    /// Nearer than the part that is listed before it, which it covers.
    Nearer,
}

fn yes() -> bool {
    true
}

fn screen() -> (u16, u16) {
    (800, 600)
}

/// All of them, in the order of the file.
pub(crate) fn read() -> Vec<Game> {
    #[derive(Deserialize)]
    struct Table {
        game: Vec<Game>,
    }
    let table: Table = toml::from_str(include_str!("games.toml")).expect("games.toml");
    table.game
}
