//! Where the value of an option comes from, and how its user wrote it.
#![forbid(unsafe_code)]

use super::options::OptionId;
use std::fmt;
use std::path::PathBuf;

/// A spelling that somebody used and that goes with the next version. Its text is one line for that person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renaming {
    /// As it was written.
    pub old: String,
    /// As it is called.
    pub new: String,
}

impl fmt::Display for Renaming {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { old, new } = self;
        write!(
            f,
            "{old} is now called {new}; this version is the last one that takes the old name"
        )
    }
}

/// Where a value comes from, the strongest first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A request to the running program.
    Request,
    /// An option of the command.
    CommandLine,
    /// An environment variable.
    Variable,
    /// A key of this TOML file.
    File(PathBuf),
    /// Nobody asked: the default.
    Default,
}

/// An option as its user wrote it: `--views`, `MANYVIEW_VIEWS` or `views in panel.toml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Which option.
    pub id: OptionId,
    /// Where its value comes from.
    pub origin: Origin,
}

impl Field {
    /// The same kind of spelling for another option, to name the remedy.
    #[must_use]
    pub fn sibling(&self, id: OptionId) -> Self {
        Self {
            id,
            origin: self.origin.clone(),
        }
    }
}

impl Field {
    /// A value in present words, and the renamings that this took.
    pub(super) fn present(&self, value: String) -> (String, Vec<Renaming>) {
        let spec = self.id.spec();
        if spec.former.words.is_empty() {
            return (value, Vec::new());
        }
        let words: Vec<_> = value
            .split(',')
            .map(|word| (word, spec.present_word(word)))
            .collect();
        let renamed = words.iter().filter(|(word, present)| word != present);
        let renamings = renamed.map(|(word, present)| Renaming {
            old: format!("{} of {self}", word.trim()),
            new: (*present).to_owned(),
        });
        let renamings = renamings.collect();
        let present: Vec<_> = words.iter().map(|(_, present)| *present).collect();
        (present.join(","), renamings)
    }

    /// Its name alone, as it is written there.
    pub(super) fn name(&self) -> String {
        let spec = self.id.spec();
        match (&self.origin, spec.key) {
            (Origin::File(_), Some(key)) => key.to_owned(),
            _ => self.to_string(),
        }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spec = self.id.spec();
        match (&self.origin, spec.flag, spec.key) {
            (Origin::Request, _, Some(key)) => f.write_str(key),
            (Origin::File(path), _, Some(key)) => write!(f, "{key} in {}", path.display()),
            (Origin::CommandLine | Origin::Default, Some(flag), _) => write!(f, "--{flag}"),
            _ => f.write_str(spec.variable),
        }
    }
}
