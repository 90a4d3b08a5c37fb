//! Profiles: rules for the classes of one program's draws, where the state of OpenGL alone does not tell them.
//!
//! A profile is a TOML file with a list of rules; the first rule whose every key matches a draw decides it.
#![forbid(unsafe_code)]

use super::class::{Class, DepthRange, DepthState, Projection, Viewport, Word};
use super::error::DEPTH_REMEDY;
use super::file::{one_line, read_capped, user_folder};
use super::flat_depth::FlatDepth;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The value of `--profile` that wants none.
pub const NONE: &str = "none";

/// The rules for a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// The file, for people; empty without one.
    pub file: PathBuf,
    /// File names of the programs for which it is chosen by itself.
    pub executable: Vec<String>,
    /// Depth of flat draws without a rule, unless the user gives another.
    pub hud_depth: Option<FlatDepth>,
    /// Depth of zero parallax, in eye-space units, unless the user gives another.
    pub focal_depth: Option<f64>,
    /// The first that matches decides.
    pub rules: Vec<Rule>,
}

/// One rule. An empty list and `None` match everything. More than 12 fields: one for each key of a rule.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// File names of programs.
    pub executable: Vec<String>,
    /// Names of 2D textures that the draw samples on the active unit; 0 is none.
    pub texture: Vec<u32>,
    /// Checksums of the images of those textures, as `--explain` lists them.
    pub image: Vec<u64>,
    /// Names of display lists that are called.
    pub list: Vec<u32>,
    /// The projection matrix.
    pub projection: Option<Projection>,
    /// How much of the window the viewport covers.
    pub viewport: Option<Viewport>,
    /// Depth test and mask.
    pub depth_state: Option<DepthState>,
    /// The depth range.
    pub depth_range: Option<DepthRange>,
    /// Checksums of the texts of the program's own shaders, as `--explain` lists them.
    pub shader: Vec<u64>,
    /// Programs of shaders, counted as they are linked; 0 is none.
    pub program: Vec<u32>,
    /// Framebuffers, counted as they are first drawn to; 0 is the window.
    pub pass: Vec<u32>,
    /// Number of the draw in its frame, counted from 1; both ends included.
    pub draw: Option<(u32, u32)>,
    /// How often the depths have been cleared in its frame.
    pub clear: Vec<u32>,
    /// Number of the draw since the last clear of the depths, counted from 1; both ends included.
    pub after_clear: Option<(u32, u32)>,
    /// Nothing in perspective has written depth since the frame began or was last cleared.
    pub before_depth: Option<bool>,
    /// The class of the draw.
    pub class: Class,
    /// Where a flat draw stands.
    pub depth: Option<FlatDepth>,
    /// Depth of zero parallax of a scene draw, in eye-space units.
    pub focal_depth: Option<f64>,
}

const PROFILE_KEYS: &[&str] = &["executable", "hud-depth", "focal-depth", "rule"];
const RULE_KEYS: &[&str] = &[
    "executable",
    "texture",
    "image",
    "list",
    "projection",
    "viewport",
    "depth-state",
    "depth-range",
    "shader",
    "program",
    "pass",
    "draw",
    "clear",
    "after-clear",
    "before-depth",
    "class",
    "depth",
    "focal-depth",
];

impl Profile {
    /// Reads a profile; the error is one sentence that names the file, the rule, the key and the remedy.
    pub fn read(path: &Path) -> Result<Self, String> {
        let text = read_capped(path).map_err(|reason| {
            format!(
                "{}: {reason}; give a file of rules, or the name of a profile",
                path.display()
            )
        })?;
        Self::parse(&text, path).map_err(|reason| format!("{}: {reason}", path.display()))
    }

    /// Understands the text of a profile; the error does not name the file.
    pub fn parse(text: &str, path: &Path) -> Result<Self, String> {
        let table: Table = text.parse().map_err(|error: toml::de::Error| {
            let at = error.span().map_or(0, |span| span.start);
            let line = text.get(..at).unwrap_or_default().matches('\n').count() + 1;
            format!("line {line}: {}", one_line(error.message()))
        })?;
        known(&table, PROFILE_KEYS)?;
        let rules = match table.get("rule") {
            None => &Vec::new(),
            Some(Value::Array(rules)) => rules,
            Some(other) => {
                return Err(format!(
                    "rule is of type {}; begin each rule with [[rule]]",
                    other.type_str()
                ));
            }
        };
        let rules = rules.iter().enumerate().map(|(at, rule)| {
            let Value::Table(rule) = rule else {
                return Err(format!(
                    "rule {} is of type {}; write keys and values in {{ }}",
                    at + 1,
                    rule.type_str()
                ));
            };
            Rule::parse(rule).map_err(|reason| format!("rule {}: {reason}", at + 1))
        });
        Ok(Self {
            file: path.to_owned(),
            executable: names(&table, "executable")?,
            hud_depth: depth(&table, "hud-depth")?,
            focal_depth: length(&table, "focal-depth")?,
            rules: rules.collect::<Result<_, _>>()?,
        })
    }

    /// The first profile in some folders that names a program; files with mistakes name none.
    #[must_use]
    pub fn automatic(folders: &[PathBuf], program: &str) -> Option<Self> {
        shelves(folders)
            .iter()
            .filter_map(|path| Self::read(path).ok())
            .find(|profile| profile.executable.iter().any(|name| name == program))
    }

    /// The profile for a name in some folders, or for a file.
    pub fn named(folders: &[PathBuf], value: &str) -> Result<Self, String> {
        if is_file(value) {
            return Self::read(Path::new(value));
        }
        let paths = shelves(folders);
        let name = |path: &Path| path.file_stem().unwrap_or_default().to_os_string();
        if let Some(path) = paths.iter().find(|path| name(path) == OsStr::new(value)) {
            return Self::read(path);
        }
        let known: Vec<_> = paths
            .iter()
            .map(|path| format!(", {}", name(path).to_string_lossy()))
            .collect();
        Err(format!(
            "there is no profile '{value}'; give a file that ends in .toml, or one of {NONE}{}",
            known.concat()
        ))
    }
}

/// Whether a value of `--profile` is a file and not a name.
#[must_use]
pub fn is_file(value: &str) -> bool {
    value.contains('/') || value.ends_with(".toml")
}

/// Where the profiles are that come with a library: in `profiles` beside it or, where it is the one of 32 bits, beside its folder; or of the repository that it was
/// built in.
#[must_use]
pub fn beside(library: &Path) -> Option<PathBuf> {
    let folder = library.parent()?;
    let folders = [
        "profiles",
        "../profiles",
        "../../profiles",
        "../../../profiles",
    ];
    let folders = folders.into_iter().map(|profiles| folder.join(profiles));
    folders.into_iter().find(|profiles| profiles.is_dir())
}

/// The folder of the user's own profiles, which go before those that come with a library; it need not be there.
#[must_use]
pub fn users() -> Option<PathBuf> {
    Some(user_folder()?.join("profiles"))
}

/// The profiles in some folders, one folder after the other.
fn shelves(folders: &[PathBuf]) -> Vec<PathBuf> {
    folders.iter().flat_map(|folder| shelf(folder)).collect()
}

/// The profiles in a folder, in the order of their names.
fn shelf(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut paths: Vec<_> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension() == Some(OsStr::new("toml")))
        .collect();
    paths.sort();
    paths
}

impl Rule {
    fn parse(table: &Table) -> Result<Self, String> {
        known(table, RULE_KEYS)?;
        let class: Class = word(table, "class")?
            .ok_or_else(|| format!("class is missing; give one of {}", words::<Class>()))?;
        let depth = depth(table, "depth")?;
        if let (Some(depth), false) = (depth, class == Class::Flat) {
            return Err(format!(
                "depth is {depth} and class is '{}'; only a flat draw stands at one depth, so leave depth out or make the class flat",
                class.word()
            ));
        }
        let focal_depth = length(table, "focal-depth")?;
        if let (Some(focal), false) = (focal_depth, class == Class::Scene) {
            return Err(format!(
                "focal-depth is {focal} and class is '{}'; only scene draws have depths, so leave focal-depth out or make the class scene",
                class.word()
            ));
        }
        Ok(Self {
            executable: names(table, "executable")?,
            texture: numbers(table, "texture")?,
            image: sums(table, "image")?,
            list: numbers(table, "list")?,
            projection: word(table, "projection")?,
            viewport: word(table, "viewport")?,
            depth_state: word(table, "depth-state")?,
            depth_range: word(table, "depth-range")?,
            shader: sums(table, "shader")?,
            program: numbers(table, "program")?,
            pass: numbers(table, "pass")?,
            draw: range(table, "draw")?,
            clear: numbers(table, "clear")?,
            after_clear: range(table, "after-clear")?,
            before_depth: flag(table, "before-depth")?,
            class,
            depth,
            focal_depth,
        })
    }
}

fn known(table: &Table, keys: &[&str]) -> Result<(), String> {
    match table.keys().find(|key| !keys.contains(&key.as_str())) {
        None => Ok(()),
        Some(key) => Err(format!(
            "the key '{key}' means nothing here; the keys are {}",
            keys.join(", ")
        )),
    }
}

fn wrong(key: &str, value: &Value, remedy: &str) -> String {
    let text = match value {
        Value::String(text) => format!("'{text}'"),
        Value::Integer(_) | Value::Float(_) => value.to_string(),
        other => format!("of type {}", other.type_str()),
    };
    format!("{key} is {text}; {remedy}")
}

/// One value as a list of one.
fn list<'a>(table: &'a Table, key: &str) -> &'a [Value] {
    match table.get(key) {
        None => &[],
        Some(Value::Array(values)) => values,
        Some(value) => std::slice::from_ref(value),
    }
}

fn names(table: &Table, key: &str) -> Result<Vec<String>, String> {
    let one = |value: &Value| match value.as_str() {
        Some(name) if !name.is_empty() && !name.contains('/') => Ok(name.to_owned()),
        _ => Err(wrong(
            key,
            value,
            "give the file name of a program in quotes, without its folder",
        )),
    };
    list(table, key).iter().map(one).collect()
}

fn numbers(table: &Table, key: &str) -> Result<Vec<u32>, String> {
    let one = |value: &Value| {
        let number = value.as_integer().and_then(|n| u32::try_from(n).ok());
        number.ok_or_else(|| wrong(key, value, "give a whole number from 0, or a list of them"))
    };
    list(table, key).iter().map(one).collect()
}

fn sums(table: &Table, key: &str) -> Result<Vec<u64>, String> {
    let one = |value: &Value| {
        let digits = value.as_str().filter(|text| text.len() == 16);
        let sum = digits.and_then(|text| u64::from_str_radix(text, 16).ok());
        sum.ok_or_else(|| {
            let remedy = "give the 16 hexadecimal digits that --explain lists, in quotes";
            wrong(key, value, remedy)
        })
    };
    list(table, key).iter().map(one).collect()
}

fn words<T: Word>() -> String {
    let words: Vec<_> = T::WORDS.iter().map(|(word, _)| *word).collect();
    words.join(", ")
}

fn word<T: Word>(table: &Table, key: &str) -> Result<Option<T>, String> {
    let Some(value) = table.get(key) else {
        return Ok(None);
    };
    match value.as_str().and_then(T::of) {
        Some(known) => Ok(Some(known)),
        None => Err(wrong(key, value, &format!("give one of {}", words::<T>()))),
    }
}

fn flag(table: &Table, key: &str) -> Result<Option<bool>, String> {
    let Some(value) = table.get(key) else {
        return Ok(None);
    };
    match value.as_bool() {
        Some(flag) => Ok(Some(flag)),
        None => Err(wrong(key, value, "give true or false, without quotes")),
    }
}

fn depth(table: &Table, key: &str) -> Result<Option<FlatDepth>, String> {
    let Some((value, number)) = number(table, key) else {
        return Ok(None);
    };
    let word = value.as_str().and_then(FlatDepth::of);
    match number.map_or(word, FlatDepth::at) {
        Some(depth) => Ok(Some(depth)),
        None => Err(wrong(key, value, DEPTH_REMEDY)),
    }
}

/// A length in eye-space units.
fn length(table: &Table, key: &str) -> Result<Option<f64>, String> {
    match number(table, key) {
        Some((_, Some(number))) if number > 0.0 && number.is_finite() => Ok(Some(number)),
        Some((value, _)) => Err(wrong(
            key,
            value,
            "give a number above 0, in the program's eye-space units",
        )),
        None => Ok(None),
    }
}

/// A value and the number that it is.
fn number<'a>(table: &'a Table, key: &str) -> Option<(&'a Value, Option<f64>)> {
    let value = table.get(key)?;
    let number = match value {
        Value::Integer(number) => Some(*number as f64),
        other => other.as_float(),
    };
    Some((value, number))
}

/// `5`, `"5..9"` or `"5.."`, both ends included, counted from 1.
fn range(table: &Table, key: &str) -> Result<Option<(u32, u32)>, String> {
    let Some(value) = table.get(key) else {
        return Ok(None);
    };
    let parsed = match value {
        Value::Integer(number) => u32::try_from(*number).ok().map(|n| (n, n)),
        Value::String(text) => {
            let (first, last) = text.split_once("..").unwrap_or((text, text));
            let last = if last.is_empty() {
                Some(u32::MAX)
            } else {
                last.parse().ok()
            };
            first.parse().ok().zip(last)
        }
        _ => None,
    };
    match parsed {
        Some((first, last)) if 1 <= first && first <= last => Ok(Some((first, last))),
        _ => Err(wrong(
            key,
            value,
            "give a draw counted from 1 such as 5, or a range in quotes such as \"5..9\" or \"5..\"",
        )),
    }
}
