//! Control of a running program: requests and answers, one JSON object per line, and the place of the socket.
//!
//! The preloaded library answers, `manyview ctl` asks. Only the folder of the socket touches the file system.
#![forbid(unsafe_code)]

mod error;
pub mod keys;
mod lines;
pub mod panel;
pub mod place;
mod ramp;

pub use error::ControlError;
pub use lines::Lines;
pub use ramp::Ramp;

use crate::config::{Knob, Live, OptionId};
use crate::display::LensPart;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The name of all current values in a [`Request::Get`].
pub const ALL: &str = "all";
/// The name of the layer in a [`Request::Toggle`], and of the value that says whether it is on.
pub const LAYER: &str = "layer";
/// The name of the number of views, which can be read but not set.
pub const VIEWS: &str = "views";
/// The content of a [`Request::Capture`] that names none.
const OUTPUT: &str = "output";

/// A request as it is sent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Request {
    /// Sets values by name, all of them or none.
    Set(BTreeMap<String, Value>),
    /// Reads the value of one name, or of [`ALL`].
    Get(String),
    /// Takes a picture of the next frame.
    Capture(Picture),
    /// Explains the next frame.
    Explain(Explanation),
    /// Switches the third dimension off or on; the name is [`LAYER`].
    Toggle(String),
    /// Reads or writes the program's profile.
    Profile(ProfileRequest),
    /// Selects cameras of `--presets`, counted from 1.
    Preset(usize),
}

/// What is to be done with the profile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProfileRequest {
    /// Reads its file again.
    Reload,
    /// Writes the values in force into a file with an absolute path, or into the user's own profile of the program.
    Save(Option<PathBuf>),
}

/// A requested picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// Path of the file; absolute, because the program may have another working directory than the client.
    pub path: PathBuf,
    /// Content, as for `--what`; the output unless given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub what: Option<String>,
}

/// A requested explanation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Explanation {
    /// Absolute path of a folder, or of a file whose name is that of the picture and the list but for the extension.
    pub path: PathBuf,
}

/// A parsed request.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Sets options to values, as text.
    Set(Vec<(Knob, String)>),
    /// Reads one value by its name, or all values.
    Get(Option<String>),
    /// Takes a picture, with its path and content.
    Capture(PathBuf, String),
    /// Explains the next frame to such files.
    Explain(PathBuf),
    /// Switches the third dimension off or on.
    Toggle,
    /// Reads or writes the profile.
    Profile(ProfileRequest),
    /// Selects cameras of `--presets`, counted from 0.
    Preset(usize),
}

/// An answer as it is sent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// Current values, by name.
    Values(Map<String, Value>),
    /// Whether the third dimension is on.
    Layer(bool),
    /// A picture is written.
    Captured {
        /// Path of the file.
        path: PathBuf,
        /// The frame that it shows, counted from 1.
        frame: u64,
    },
    /// A frame is explained.
    Explained {
        /// Path of the list of its draws; the picture lies beside it.
        path: PathBuf,
        /// The frame, counted from 1.
        frame: u64,
    },
    /// The profile was read or written.
    Profile {
        /// Path of the file.
        path: PathBuf,
        /// The number of its rules.
        rules: usize,
        /// Values in force that a profile does not hold.
        left: Vec<String>,
    },
    /// Why nothing has changed, in one sentence.
    Error(String),
}

impl From<Result<Answer, ControlError>> for Answer {
    fn from(outcome: Result<Answer, ControlError>) -> Self {
        outcome.unwrap_or_else(|error| Self::Error(error.to_string()))
    }
}

/// A request or an answer as a line.
pub fn line(message: &impl Serialize) -> String {
    // Names are text and paths were received as text, so serialisation cannot fail.
    let mut text = serde_json::to_string(message).unwrap_or_default();
    text.push('\n');
    text
}

/// Parses a line as a request.
pub fn order(line: &str) -> Result<Order, ControlError> {
    let request =
        serde_json::from_str(line).map_err(|error| ControlError::Request(error.to_string()))?;
    match request {
        Request::Set(values) => {
            let values = values.into_iter().map(|(name, value)| {
                let setting = settable(&name)?;
                match value {
                    Value::String(text) => Ok((setting, text)),
                    Value::Number(number) => Ok((setting, number.to_string())),
                    _ => Err(ControlError::Type { name }),
                }
            });
            Ok(Order::Set(values.collect::<Result<_, _>>()?))
        }
        Request::Get(name) if name == ALL => Ok(Order::Get(None)),
        Request::Get(name) if names().any(|known| known == name) => Ok(Order::Get(Some(name))),
        Request::Get(name) => Err(ControlError::UnknownName {
            name,
            known: names().collect::<Vec<_>>().join(", "),
        }),
        Request::Capture(Picture { path, .. })
        | Request::Explain(Explanation { path })
        | Request::Profile(ProfileRequest::Save(Some(path)))
            if !path.is_absolute() =>
        {
            Err(ControlError::RelativePath(path))
        }
        Request::Capture(Picture { path, what }) => Ok(Order::Capture(
            path,
            what.unwrap_or_else(|| OUTPUT.to_owned()),
        )),
        Request::Explain(Explanation { path }) => Ok(Order::Explain(path)),
        Request::Profile(what) => Ok(Order::Profile(what)),
        Request::Preset(number) => match number.checked_sub(1) {
            Some(number) => Ok(Order::Preset(number)),
            None => Err(ControlError::Preset(number)),
        },
        Request::Toggle(what) if what == LAYER => Ok(Order::Toggle),
        Request::Toggle(what) => Err(ControlError::Toggle(what)),
    }
}

/// All options that can be set, with their names in a TOML file and in a panel's description.
fn settings() -> impl Iterator<Item = (Knob, &'static str)> {
    let named = |id: OptionId| Some((Knob::Option(id), id.spec().key?));
    let options = Live::OPTIONS.into_iter().filter_map(named);
    options.chain(LensPart::ALL.map(|part| (Knob::Lens(part), part.name())))
}

/// The names of all values that can be read.
fn names() -> impl Iterator<Item = &'static str> {
    settings().map(|(_, name)| name).chain([VIEWS, LAYER])
}

fn settable(name: &str) -> Result<Knob, ControlError> {
    let found = settings().find(|(_, known)| *known == name);
    found.map(|(setting, _)| setting).ok_or_else(|| {
        let known = settings().map(|(_, name)| name);
        ControlError::NotSettable {
            name: name.to_owned(),
            known: known.collect::<Vec<_>>().join(", "),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_understood() {
        assert_eq!(
            order(r#"{"set": {"separation": 0.03, "output": "view:1"}}"#),
            Ok(Order::Set(vec![
                (Knob::Option(OptionId::Output), "view:1".to_owned()),
                (Knob::Option(OptionId::Separation), "0.03".to_owned()),
            ]))
        );
        assert_eq!(
            order(r#"{"set": {"pitch": "16/3"}}"#),
            Ok(Order::Set(vec![(
                Knob::Lens(LensPart::Pitch),
                "16/3".to_owned()
            )]))
        );
        assert_eq!(order(r#"{"get": "all"}"#), Ok(Order::Get(None)));
        assert_eq!(
            order(r#"{"get": "hud-depth"}"#),
            Ok(Order::Get(Some("hud-depth".to_owned())))
        );
        assert_eq!(
            order(r#"{"capture": {"path": "/a.png"}}"#),
            Ok(Order::Capture("/a.png".into(), "output".to_owned()))
        );
        assert_eq!(
            order(r#"{"explain": {"path": "/a"}}"#),
            Ok(Order::Explain("/a".into()))
        );
        assert_eq!(order(r#"{"toggle": "layer"}"#), Ok(Order::Toggle));
        assert_eq!(order(r#"{"preset": 2}"#), Ok(Order::Preset(1)));
        let profile = |what| order(&line(&Request::Profile(what)));
        for what in [
            ProfileRequest::Reload,
            ProfileRequest::Save(None),
            ProfileRequest::Save(Some("/a.toml".into())),
        ] {
            assert_eq!(profile(what.clone()), Ok(Order::Profile(what)));
        }
        let reload = order(r#"{"profile": "reload"}"#);
        assert_eq!(reload, Ok(Order::Profile(ProfileRequest::Reload)));
    }

    #[test]
    fn what_is_sent_is_understood() {
        let request = Request::Capture(Picture {
            path: "/x/y.png".into(),
            what: Some("view:2".to_owned()),
        });
        let sent = line(&request);
        assert_eq!(
            sent,
            "{\"capture\":{\"path\":\"/x/y.png\",\"what\":\"view:2\"}}\n"
        );
        assert_eq!(
            order(&sent),
            Ok(Order::Capture("/x/y.png".into(), "view:2".to_owned()))
        );
        let answer = Answer::Captured {
            path: "/x/y.png".into(),
            frame: 31,
        };
        let sent = line(&answer);
        assert_eq!(
            sent,
            "{\"captured\":{\"path\":\"/x/y.png\",\"frame\":31}}\n"
        );
        assert_eq!(serde_json::from_str::<Answer>(&sent).unwrap(), answer);
    }

    #[test]
    fn every_refusal_is_one_sentence() {
        let all = [
            "",
            "separation 0.03",
            "{}",
            "[]",
            r#"{"set": 3}"#,
            r#"{"set": {"views": 3}}"#,
            r#"{"set": {"separation": [1]}}"#,
            r#"{"set": {"separation": true}}"#,
            r#"{"get": "strategy"}"#,
            r#"{"capture": {"path": "a.png"}}"#,
            r#"{"capture": {"path": "/a.png", "frames": 3}}"#,
            r#"{"explain": {"path": "a"}}"#,
            r#"{"toggle": "sound"}"#,
            r#"{"preset": 0}"#,
            r#"{"profile": "forget"}"#,
            r#"{"profile": {"save": "a.toml"}}"#,
            r#"{"stop": "now"}"#,
        ]
        .map(|line| order(line).unwrap_err().to_string());
        assert!(all.iter().all(|message| !message.contains('\n')));
        insta::assert_snapshot!(all.join("\n"));
    }
}
