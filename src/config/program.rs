//! The name of this process's program, and the programs that the layer leaves bare.
#![forbid(unsafe_code)]

use super::error::ConfigError;
use super::options::OptionId;
use super::settings::Settings;
use std::path::Path;

/// Programs with OpenGL that come with games and are none: launchers, browsers and dialogues. Several views of them serve nobody, and cost.
const BARE: [&str; 20] = [
    "chrome",
    "chrome_crashpad_handler",
    "chromium",
    "electron",
    "explorer.exe",
    "firefox",
    "gameoverlayui",
    "gamescope",
    "heroic",
    "kdialog",
    "lutris",
    "mangoapp",
    "msedgewebview2.exe",
    "steam",
    "steamwebhelper",
    "steamwebhelper.exe",
    "UnityCrashHandler32.exe",
    "UnityCrashHandler64.exe",
    "WebKitWebProcess",
    "zenity",
];

/// Which programs of a launch have the layer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chosen {
    /// These alone; empty for all.
    only: Vec<String>,
    /// None of these.
    except: Vec<String>,
}

impl Chosen {
    pub(super) fn of(settings: &Settings) -> Result<Self, ConfigError> {
        let names = |id| match settings.field(id) {
            None => Ok(Vec::new()),
            Some((field, text)) => {
                let names: Vec<_> = text.split(',').map(|name| name.trim().to_owned()).collect();
                match names
                    .iter()
                    .any(|name| name.is_empty() || name.contains('/'))
                {
                    false => Ok(names),
                    true => Err(ConfigError::ProgramNames {
                        field,
                        value: text.to_owned(),
                    }),
                }
            }
        };
        Ok(Chosen {
            only: names(OptionId::Only)?,
            except: names(OptionId::Except)?,
        })
    }

    /// Whether a program runs without the layer.
    #[must_use]
    pub fn leaves_bare(&self, program: &str) -> bool {
        let among = |names: &[String]| names.iter().any(|name| name.eq_ignore_ascii_case(program));
        if !self.only.is_empty() {
            return !among(&self.only);
        }
        among(&self.except) || is_helper(program)
    }
}

/// Whether a program is one that comes with games and is none.
#[must_use]
pub fn is_helper(program: &str) -> bool {
    BARE.iter().any(|name| name.eq_ignore_ascii_case(program))
}

/// The file name of the program of this process; under Wine that of the Windows program.
#[must_use]
pub fn this_program() -> Option<String> {
    let path = std::env::current_exe().ok()?;
    let own = program_name(&path.file_name()?.to_string_lossy()).to_owned();
    let words = || std::fs::read("/proc/self/cmdline").ok();
    match is_wine(&own) {
        true => words()
            .and_then(|words| windows_program(&words))
            .or(Some(own)),
        false => Some(own),
    }
}

/// The name without the words that Linux appends to that of a program that has been replaced since it was started, as updates do.
fn program_name(link: &str) -> &str {
    link.strip_suffix(" (deleted)").unwrap_or(link)
}

fn is_wine(program: &str) -> bool {
    matches!(
        program,
        "wine" | "wine64" | "wine-preloader" | "wine64-preloader" | "wine32" | "wine32-preloader"
    )
}

/// The file name of a program for Windows, from the command line that Wine gives its process.
fn windows_program(words: &[u8]) -> Option<String> {
    let first = words.split(|&byte| byte == 0).next()?;
    let path = String::from_utf8_lossy(first);
    let name = path.rsplit(['/', '\\']).next()?;
    let is_program = Path::new(name)
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("exe"));
    is_program.then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::Origin;
    use super::*;

    fn chosen(only: &str, except: &str) -> Result<Chosen, ConfigError> {
        let mut settings = Settings::default();
        for (id, value) in [(OptionId::Only, only), (OptionId::Except, except)] {
            if !value.is_empty() {
                settings.set(id, value, Origin::CommandLine);
            }
        }
        Chosen::of(&settings)
    }

    #[test]
    fn launchers_are_left_bare_and_games_are_not() {
        let all = chosen("", "").expect("names");
        assert!(all.leaves_bare("steamwebhelper") && all.leaves_bare("Explorer.EXE"));
        assert!(!all.leaves_bare("gltron"));
        let except = chosen("", "gltron, Setup.exe").expect("names");
        assert!(except.leaves_bare("gltron") && except.leaves_bare("setup.exe"));
        assert!(except.leaves_bare("zenity") && !except.leaves_bare("quake"));
        let only = chosen("steam,quake", "").expect("names");
        assert!(!only.leaves_bare("steam") && !only.leaves_bare("quake"));
        assert!(only.leaves_bare("gltron"));
    }

    #[test]
    fn names_are_file_names() {
        for wrong in ["/usr/bin/game", "game,,other", " "] {
            let message = chosen(wrong, "").expect_err("no names").to_string();
            assert!(message.contains("--only"), "{message}");
        }
    }

    #[test]
    fn a_program_that_was_replaced_keeps_its_name() {
        assert_eq!(program_name("gears"), "gears");
        assert_eq!(program_name("gears (deleted)"), "gears");
    }

    #[test]
    fn wine_runs_the_program_of_its_command_line() {
        let name = |words: &str| windows_program(words.as_bytes());
        assert_eq!(
            name("C:\\Games\\Quake.exe\0-w\0").as_deref(),
            Some("Quake.exe")
        );
        assert_eq!(name("32/d3d9.exe\0\0\0").as_deref(), Some("d3d9.exe"));
        assert_eq!(name("winecfg\0"), None);
        assert_eq!(name(""), None);
    }
}
