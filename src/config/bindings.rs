//! Keys for the layer while a program runs, and what they do; `--bind` and `--presets`.
#![forbid(unsafe_code)]

use super::Camera;
use super::error::ConfigError;
use super::options::OptionId;
use super::settings::Settings;

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Switches between the program's own picture and all views.
    Toggle,
    /// Increases or decreases the first number of the cameras: separation or eye-spacing.
    Spread(bool),
    /// Increases or decreases the second number of the cameras: convergence or focal-depth.
    Focus(bool),
    /// Moves flat draws farther or nearer.
    HudDepth(bool),
    /// Selects the next output.
    Output,
    /// Writes the next frame to a file.
    Capture,
    /// Explains the next frame.
    Explain,
    /// Writes the values in force to the program's own profile.
    Save,
    /// Selects cameras of `--presets`, counted from 0.
    Preset(usize),
    /// Selects the next ones.
    NextPreset,
}

/// The words of actions, but for the numbers of presets.
const ACTIONS: [(&str, Action); 12] = [
    ("toggle", Action::Toggle),
    ("spread+", Action::Spread(true)),
    ("spread-", Action::Spread(false)),
    ("focus+", Action::Focus(true)),
    ("focus-", Action::Focus(false)),
    ("hud+", Action::HudDepth(true)),
    ("hud-", Action::HudDepth(false)),
    ("output", Action::Output),
    ("capture", Action::Capture),
    ("explain", Action::Explain),
    ("save", Action::Save),
    ("preset", Action::NextPreset),
];
/// Before the number of a preset, counted from 1.
const PRESET: &str = "preset:";
/// Before an action that ends with the key.
const HOLD: &str = "hold:";
/// The word for no action.
const NONE: &str = "none";

/// Keys that change others while they are held, the left and the right one alike.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modifiers {
    /// Control.
    pub control: bool,
    /// Alt.
    pub alt: bool,
    /// Shift.
    pub shift: bool,
    /// Super, the key with a logo.
    pub logo: bool,
}

/// Control and Alt, which all keys have that are not bound by the user.
const USUAL: Modifiers = Modifiers {
    control: true,
    alt: true,
    shift: false,
    logo: false,
};

/// A key with those that are held with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chord {
    /// Held with it.
    pub modifiers: Modifiers,
    /// The X keysym without Shift.
    pub keysym: u32,
}

/// A key, what it does, and whether only while it is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The key.
    pub chord: Chord,
    /// What it does.
    pub action: Action,
    /// The action ends when the key is let go.
    pub hold: bool,
}

/// Names of keys that are not one character, with their keysyms (X11/keysymdef.h).
const NAMES: [(&str, u32); 28] = [
    ("Space", 0x20),
    ("Backspace", 0xff08),
    ("Tab", 0xff09),
    ("Return", 0xff0d),
    ("Pause", 0xff13),
    ("Scroll_Lock", 0xff14),
    ("Escape", 0xff1b),
    ("Home", 0xff50),
    ("Left", 0xff51),
    ("Up", 0xff52),
    ("Right", 0xff53),
    ("Down", 0xff54),
    ("Page_Up", 0xff55),
    ("Page_Down", 0xff56),
    ("End", 0xff57),
    ("Print", 0xff61),
    ("Insert", 0xff63),
    ("Menu", 0xff67),
    ("Num_Lock", 0xff7f),
    ("KP_Enter", 0xff8d),
    ("KP_Multiply", 0xffaa),
    ("KP_Add", 0xffab),
    ("KP_Subtract", 0xffad),
    ("KP_Decimal", 0xffae),
    ("KP_Divide", 0xffaf),
    ("Delete", 0xffff),
    ("Comma", 0x2c),
    ("Plus", 0x2b),
];
/// The first function key and the last one that is named, and the first number of the key pad.
const F1: u32 = 0xffbe;
const FUNCTION_KEYS: u32 = 24;
const KEYPAD: u32 = 0xffb0;

/// The keys that are there unless they are bound anew. Those that window managers and X itself use with Ctrl and Alt (arrows, Delete, Backspace, function keys) are not
/// among them.
const USUAL_KEYS: [(u32, Action); 12] = [
    (0x6d, Action::Toggle),
    (0xff55, Action::Spread(true)),
    (0xff56, Action::Spread(false)),
    (0xff50, Action::Focus(true)),
    (0xff57, Action::Focus(false)),
    (0x6b, Action::HudDepth(true)),
    (0x6a, Action::HudDepth(false)),
    (0x6f, Action::Output),
    (0x63, Action::Capture),
    (0x65, Action::Explain),
    (0x73, Action::Save),
    (0x70, Action::NextPreset),
];

/// All keys of the layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bindings(Vec<Binding>);

impl Default for Bindings {
    fn default() -> Self {
        let usual = USUAL_KEYS.map(|(keysym, action)| Binding {
            chord: Chord {
                modifiers: USUAL,
                keysym,
            },
            action,
            hold: false,
        });
        Bindings(usual.into())
    }
}

impl Bindings {
    /// Understands `--bind`; `presets`: how many there are.
    pub(super) fn of(settings: &Settings, presets: usize) -> Result<Self, ConfigError> {
        let mut all = Bindings::default();
        let Some((field, text)) = settings.field(OptionId::Bind) else {
            return Ok(all);
        };
        for item in text.split(',') {
            let wrong = |reason: String| ConfigError::Binding {
                field: field.clone(),
                item: item.trim().to_owned(),
                reason,
            };
            let (chord, action) = item
                .trim()
                .rsplit_once('=')
                .ok_or_else(|| wrong("give KEY=ACTION, such as F9=toggle".to_owned()))?;
            let chord = chord_of(chord).map_err(wrong)?;
            all.0.retain(|binding| binding.chord != chord);
            if action == NONE {
                continue;
            }
            let (hold, word) = match action.strip_prefix(HOLD) {
                Some(word) => (true, word),
                None => (false, action),
            };
            let action = action_of(word, presets).map_err(wrong)?;
            if hold && !matches!(action, Action::Toggle | Action::Preset(_)) {
                return Err(wrong(format!(
                    "{word} does not end; hold goes with toggle and preset:N"
                )));
            }
            all.0.push(Binding {
                chord,
                action,
                hold,
            });
        }
        Ok(all)
    }

    /// The binding of a key, while these others are held.
    #[must_use]
    pub fn find(&self, keysym: u32, modifiers: Modifiers) -> Option<Binding> {
        let chord = Chord { modifiers, keysym };
        self.0
            .iter()
            .copied()
            .find(|binding| binding.chord == chord)
    }
}

fn action_of(word: &str, presets: usize) -> Result<Action, String> {
    if let Some(number) = word.strip_prefix(PRESET) {
        return match number.parse() {
            Ok(number) if (1..=presets).contains(&number) => Ok(Action::Preset(number - 1)),
            _ => Err(format!("--presets has {presets}, which are counted from 1")),
        };
    }
    let found = ACTIONS.iter().find(|(known, _)| *known == word);
    found.map(|(_, action)| *action).ok_or_else(|| {
        let known: Vec<_> = ACTIONS.iter().map(|(known, _)| *known).collect();
        format!("the actions are {}, {PRESET}N and {NONE}", known.join(", "))
    })
}

/// A chord such as `Ctrl+Shift+F9`.
fn chord_of(text: &str) -> Result<Chord, String> {
    let mut modifiers = Modifiers::default();
    let mut parts = text.split('+').map(str::trim).peekable();
    while let Some(part) = parts.next() {
        if parts.peek().is_none() {
            let keysym = keysym_of(part).ok_or_else(|| {
                let names: Vec<_> = NAMES.iter().map(|(name, _)| *name).collect();
                format!(
                    "'{part}' is no key; give a character, F1 to F{FUNCTION_KEYS}, KP_0 to KP_9, {}",
                    names.join(", ")
                )
            })?;
            return Ok(Chord { modifiers, keysym });
        }
        match part.to_ascii_lowercase().as_str() {
            "ctrl" | "control" => modifiers.control = true,
            "alt" => modifiers.alt = true,
            "shift" => modifiers.shift = true,
            "super" => modifiers.logo = true,
            _ => return Err(format!("'{part}' is none of Ctrl, Alt, Shift and Super")),
        }
    }
    Err("there is no key".to_owned())
}

fn keysym_of(name: &str) -> Option<u32> {
    let mut characters = name.chars();
    if let (Some(one), None) = (characters.next(), characters.next()) {
        // Keysyms of Latin 1 are its codes; a key is known without Shift.
        let code = u32::from(one.to_ascii_lowercase());
        return (one.is_ascii_graphic()).then_some(code);
    }
    let lower = name.to_ascii_lowercase();
    let number = |prefix: &str| lower.strip_prefix(prefix)?.parse::<u32>().ok();
    if let Some(number) = number("kp_") {
        return (number < 10).then_some(KEYPAD + number);
    }
    if let Some(number) = number("f") {
        return (1..=FUNCTION_KEYS)
            .contains(&number)
            .then(|| F1 + number - 1);
    }
    let known = |known: &str| {
        known.eq_ignore_ascii_case(name) || known.replace('_', "").eq_ignore_ascii_case(name)
    };
    let found = NAMES.iter().find(|(name, _)| known(name));
    found.map(|(_, keysym)| *keysym)
}

/// Cameras to choose from while the program runs, and how long the way to others takes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Presets {
    /// Each places the cameras; [`Camera::Measured`] lets them follow the depths.
    pub cameras: Vec<Camera>,
    /// Seconds.
    pub ramp: f64,
}

/// Seconds of the way to other cameras, unless the user says otherwise.
const RAMP: f64 = 0.4;
const LONGEST_RAMP: f64 = 60.0;

impl Presets {
    /// Understands `--presets` and `--ramp`.
    pub(super) fn of(settings: &Settings) -> Result<Self, ConfigError> {
        let cameras = match settings.field(OptionId::Presets) {
            None => Vec::new(),
            Some((field, text)) => {
                let cameras: Option<Vec<_>> = text.split(',').map(camera_of).collect();
                cameras.ok_or_else(|| ConfigError::Presets {
                    field,
                    value: text.to_owned(),
                })?
            }
        };
        let ramp = match settings.field(OptionId::Ramp) {
            None => RAMP,
            Some((field, text)) => match text.trim().parse() {
                Ok(seconds) if (0.0..=LONGEST_RAMP).contains(&seconds) && !cameras.is_empty() => {
                    seconds
                }
                Ok(_) if cameras.is_empty() => {
                    let remedy = field.sibling(OptionId::Presets);
                    return Err(ConfigError::NoPresets { field, remedy });
                }
                _ => {
                    let value = text.to_owned();
                    return Err(ConfigError::Ramp { field, value });
                }
            },
        };
        Ok(Presets { cameras, ramp })
    }
}

/// `separation:convergence`, or `auto`.
fn camera_of(text: &str) -> Option<Camera> {
    let text = text.trim();
    if text == "auto" {
        return Some(Camera::Measured(None));
    }
    let (separation, convergence) = text.split_once(':')?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let [separation, convergence] = [number(separation)?, number(convergence)?];
    (convergence > 0.0).then_some(Camera::Clip {
        separation,
        convergence,
    })
}

#[cfg(test)]
mod tests {
    use super::super::Origin;
    use super::*;

    fn bound(bind: &str, presets: &str) -> Result<Bindings, String> {
        let mut settings = Settings::default();
        settings.set(OptionId::Bind, bind, Origin::CommandLine);
        if !presets.is_empty() {
            settings.set(OptionId::Presets, presets, Origin::CommandLine);
        }
        let presets = Presets::of(&settings).map_err(|error| error.to_string())?;
        Bindings::of(&settings, presets.cameras.len()).map_err(|error| error.to_string())
    }

    #[test]
    fn a_key_is_bound_anew_and_the_others_stay() {
        let all = bound(
            "F9=toggle, Ctrl+Shift+KP_Add=hold:preset:2,Ctrl+Alt+m=none",
            "0.1:4, auto",
        );
        let all = all.expect("bindings");
        let action = |keysym, modifiers| all.find(keysym, modifiers).map(|b| (b.action, b.hold));
        let none = Modifiers::default();
        assert_eq!(action(F1 + 8, none), Some((Action::Toggle, false)));
        assert_eq!(action(F1 + 8, USUAL), None);
        let shifted = Modifiers {
            control: true,
            shift: true,
            ..none
        };
        assert_eq!(action(0xffab, shifted), Some((Action::Preset(1), true)));
        assert_eq!(action(u32::from('m'), USUAL), None, "unbound");
        assert_eq!(action(0xff55, USUAL), Some((Action::Spread(true), false)));
        assert_eq!(keysym_of("PageUp"), keysym_of("page_up"));
        assert_eq!(keysym_of("F25"), None);
        assert_eq!(keysym_of("kp_7"), Some(0xffb7));
    }

    #[test]
    fn every_mistake_names_what_is_wrong_and_what_is_right() {
        for (bind, told) in [
            ("F9", "KEY=ACTION"),
            ("F9=jump", "actions are toggle"),
            ("Hyper+F9=toggle", "none of Ctrl"),
            ("F99=toggle", "no key"),
            ("=toggle", "no key"),
            ("F9=preset:3", "--presets has 2"),
            ("F9=hold:capture", "does not end"),
        ] {
            let message = bound(bind, "0.1:4,0.2:8").expect_err(bind);
            assert!(
                message.contains(told) && !message.contains('\n'),
                "{message}"
            );
        }
        for presets in ["0.1", "x:4", "0.1:0", "0.1:4,,"] {
            let message = bound("F9=toggle", presets).expect_err(presets);
            assert!(message.contains("--presets"), "{message}");
        }
    }
}
