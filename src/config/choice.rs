//! Options whose values are words.
#![forbid(unsafe_code)]

use super::error::ConfigError;
use super::options::OptionId;
use super::settings::Settings;

/// The value of a word that is given, of those in the table.
pub(super) fn choice<T: Copy>(
    settings: &Settings,
    id: OptionId,
    table: &[(&str, T)],
) -> Result<Option<T>, ConfigError> {
    let Some((field, value)) = settings.field(id) else {
        return Ok(None);
    };
    match table.iter().find(|(name, _)| *name == value) {
        Some((_, choice)) => Ok(Some(*choice)),
        None => Err(ConfigError::Choice {
            choices: choices(id),
            field,
            value: value.to_owned(),
        }),
    }
}

/// The words that an option knows, for a message.
pub(super) fn choices(id: OptionId) -> String {
    let listed = id.spec().listed("and");
    match id {
        OptionId::Output | OptionId::WindowOutput => format!(
            "{listed}, with KIND red-cyan, green-magenta or amber-blue, and -half or -grey after it"
        ),
        OptionId::Disable | OptionId::Osd => {
            format!("{listed}, several of them with commas between")
        }
        _ => listed,
    }
}

/// An option that is on or off; off where it is not given.
pub(super) fn switch(settings: &Settings, id: OptionId) -> Result<bool, ConfigError> {
    match settings.field(id) {
        None | Some((_, "0")) => Ok(false),
        Some((_, "1")) => Ok(true),
        Some((field, value)) => Err(ConfigError::Switch {
            field,
            value: value.to_owned(),
        }),
    }
}
