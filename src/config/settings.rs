//! Options as they were written, before their values are understood: read, merged, passed on.
//!
//! Command line wins over variables, variables over the TOML file, the file over the defaults.
#![forbid(unsafe_code)]

use super::error::ConfigError;
use super::options::{Field, OPTIONS, OptionId, Origin, PathKind};
use super::{panel, profile};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A TOML file of options is never larger.
const MAX_FILE_BYTES: u64 = 64 * 1024;

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

    /// Sets what the command line gives of these options.
    pub fn give<'a>(&mut self, given: impl IntoIterator<Item = (OptionId, &'a Option<String>)>) {
        for (id, value) in given {
            if let Some(value) = value {
                self.set(id, value, Origin::CommandLine);
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
            if let Some(value) = lookup(spec.variable).filter(|value| !value.is_empty()) {
                settings.set(spec.id, value, Origin::Variable);
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
        Self { entries }
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
            let Some(spec) = OPTIONS.iter().find(|spec| spec.key == Some(key)) else {
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
            let folder = path.parent().unwrap_or(Path::new(""));
            settings.set(spec.id, rebase(spec.path, &text, folder), origin);
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

pub(super) fn read_capped(path: &Path) -> Result<String, String> {
    let about = std::fs::metadata(path).map_err(|error| error.to_string())?;
    if !about.is_file() {
        return Err("it is not a file".to_owned());
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(format!("it is larger than {MAX_FILE_BYTES} bytes"));
    }
    std::fs::read_to_string(path).map_err(|error| error.to_string())
}

pub(super) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
