//! Options as they were written, before their values are understood: read, merged, passed on.
//!
//! Command line wins over variables, variables over the TOML file, the file over the defaults.
#![forbid(unsafe_code)]

use super::error::ConfigError;
use super::field::{Field, Origin, Renaming};
use super::file::{one_line, read_capped};
use super::options::{OPTIONS, OptionId, PathKind};
use super::{panel, profile};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A value as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The text.
    pub value: String,
    /// Who wrote it.
    pub origin: Origin,
}

/// The options that somebody set.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    entries: BTreeMap<OptionId, Setting>,
    renamings: Vec<Renaming>,
}

impl Settings {
    /// Sets one option.
    pub fn set(&mut self, id: OptionId, value: impl Into<String>, origin: Origin) {
        self.entries.insert(
            id,
            Setting {
                value: value.into(),
                origin,
            },
        );
    }

    /// Sets a value as a user wrote it: former words become the present ones. `old` is how the option was written, if that is a former name.
    fn write(&mut self, id: OptionId, value: String, origin: Origin, old: Option<String>) {
        let field = Field {
            id,
            origin: origin.clone(),
        };
        let new = field.name();
        self.renamings.extend(old.map(|old| Renaming { old, new }));
        let (value, renamings) = field.present(value);
        self.renamings.extend(renamings);
        self.set(id, value, origin);
    }

    /// Sets an option as the command line gives it, by its flag or, `former`, by the one of the version before.
    pub fn command_line(&mut self, id: OptionId, value: &str, former: bool) {
        let flag = id.spec().former.flag.filter(|_| former);
        let old = flag.map(|flag| format!("--{flag}"));
        self.write(id, value.to_owned(), Origin::CommandLine, old);
    }

    /// The former names that somebody used, each with the present one.
    #[must_use]
    pub fn renamings(&self) -> &[Renaming] {
        &self.renamings
    }

    /// Sets those of these options that the command line gives.
    pub fn give<'a>(&mut self, given: impl IntoIterator<Item = (OptionId, &'a Option<String>)>) {
        for (id, value) in given {
            if let Some(value) = value {
                self.command_line(id, value, false);
            }
        }
    }

    /// The value of one option.
    #[must_use]
    pub fn get(&self, id: OptionId) -> Option<&Setting> {
        self.entries.get(&id)
    }

    /// The value of one option with its name as the user wrote it.
    #[must_use]
    pub fn field(&self, id: OptionId) -> Option<(Field, &str)> {
        self.get(id).map(|s| {
            (
                Field {
                    id,
                    origin: s.origin.clone(),
                },
                s.value.as_str(),
            )
        })
    }

    /// The variables alone; an empty variable counts as not set.
    pub fn from_variables(lookup: impl Fn(&str) -> Option<String>) -> Self {
        let mut settings = Self::default();
        for spec in OPTIONS {
            let value = |name: &str| lookup(name).filter(|value| !value.is_empty());
            if let Some(value) = value(spec.variable) {
                settings.write(spec.id, value, Origin::Variable, None);
            } else if let Some(name) = spec.former.variable
                && let Some(value) = value(name)
            {
                settings.write(spec.id, value, Origin::Variable, Some(name.to_owned()));
            }
        }
        settings
    }

    /// The variables and the TOML file that they name.
    pub fn from_env(lookup: impl Fn(&str) -> Option<String>) -> Result<Self, ConfigError> {
        Self::from_variables(lookup).with_file()
    }

    /// Puts these options over weaker ones. A source that places the cameras replaces all camera options.
    #[must_use]
    pub fn over(self, weaker: Self) -> Self {
        let cameras = self.entries.keys().any(|id| id.places_cameras());
        let mut entries = weaker.entries;
        entries.retain(|id, _| !(cameras && id.places_cameras()));
        entries.extend(self.entries);
        let mut renamings = weaker.renamings;
        renamings.extend(self.renamings);
        Self { entries, renamings }
    }

    /// Reads the TOML file named by [`OptionId::Config`], if any, and puts these options over it.
    pub fn with_file(self) -> Result<Self, ConfigError> {
        let Some((field, value)) = self.field(OptionId::Config) else {
            return Ok(self);
        };
        let path = PathBuf::from(value);
        let text = read_capped(&path).map_err(|reason| ConfigError::File {
            field: field.clone(),
            path,
            reason,
        })?;
        let weaker = Self::from_toml(&text, &field, Path::new(value))?;
        Ok(self.over(weaker))
    }

    /// Understands the text of a TOML file. Paths in it are relative to its folder.
    fn from_toml(text: &str, field: &Field, path: &Path) -> Result<Self, ConfigError> {
        let table: toml::Table =
            text.parse()
                .map_err(|error: toml::de::Error| ConfigError::File {
                    field: field.clone(),
                    path: path.to_owned(),
                    reason: one_line(error.message()),
                })?;
        let mut settings = Self::default();
        for (key, value) in &table {
            let named = |name: Option<&str>| name == Some(key.as_str());
            let spec = OPTIONS.iter().find(|spec| named(spec.key));
            let former = || OPTIONS.iter().find(|spec| named(spec.former.key));
            let Some(spec) = spec.or_else(former) else {
                let known: Vec<_> = OPTIONS.iter().filter_map(|spec| spec.key).collect();
                return Err(ConfigError::UnknownKey {
                    path: path.to_owned(),
                    key: key.clone(),
                    known: known.join(", "),
                });
            };
            let origin = Origin::File(path.to_owned());
            let text = match value {
                toml::Value::String(text) => text.clone(),
                toml::Value::Integer(number) => number.to_string(),
                toml::Value::Float(number) => number.to_string(),
                toml::Value::Boolean(on) if spec.id.is_switch() => u8::from(*on).to_string(),
                other => {
                    let field = Field {
                        id: spec.id,
                        origin,
                    };
                    return Err(ConfigError::KeyType {
                        field,
                        kind: other.type_str(),
                    });
                }
            };
            let old = !named(spec.key);
            if old && spec.key.is_some_and(|present| table.contains_key(present)) {
                // The present name wins.
                continue;
            }
            let folder = path.parent().unwrap_or(Path::new(""));
            let old = old.then(|| format!("{key} in {}", path.display()));
            settings.write(spec.id, rebase(spec.path, &text, folder), origin, old);
        }
        Ok(settings)
    }

    /// Notes where the profiles are that come with a library, unless a folder is set.
    pub fn find_profiles(&mut self, library: Option<&Path>) {
        if self.get(OptionId::Profiles).is_none()
            && let Some(folder) = library.and_then(profile::beside)
        {
            self.set(
                OptionId::Profiles,
                folder.to_string_lossy(),
                Origin::Default,
            );
        }
    }

    /// The variables that pass these options to the program, paths relative to `folder` made absolute.
    ///
    /// The TOML file is not among them: its keys are, already merged.
    #[must_use]
    pub fn to_env(&self, folder: &Path) -> Vec<(String, String)> {
        let passed = self
            .entries
            .iter()
            .filter(|(id, _)| **id != OptionId::Config);
        passed
            .map(|(id, setting)| {
                let spec = id.spec();
                (
                    spec.variable.to_owned(),
                    rebase(spec.path, &setting.value, folder),
                )
            })
            .collect()
    }
}

/// Puts a relative path behind `folder`; leaves names and other values alone.
fn rebase(kind: PathKind, value: &str, folder: &Path) -> String {
    let is_path = match kind {
        PathKind::No => false,
        PathKind::File => true,
        PathKind::NameOrFile => !panel::is_builtin(value),
        PathKind::ProfileOrFile => profile::is_file(value),
    };
    if is_path {
        folder.join(value).to_string_lossy().into_owned()
    } else {
        value.to_owned()
    }
}
