//! `manyview completions`: what Bash, Zsh and fish complete, made of the same options as the help texts. For `make install`.
#![forbid(unsafe_code)]

use super::Outcome;
use super::error::CommandError;
use clap::builder::Resettable;
use clap::{Args, Command, CommandFactory, Id};
use clap_complete::aot::{Generator, Shell};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const NAME: &str = "manyview";
const SHELLS: [Shell; 3] = [Shell::Bash, Shell::Zsh, Shell::Fish];

#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder to write manyview.bash, _manyview and manyview.fish to
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    write(&arguments.out).map_err(|source| CommandError::system("writing completions", source))?;
    Ok(ExitCode::SUCCESS)
}

/// Writes a file for each shell.
fn write(folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let mut command = shown(&super::Arguments::command());
    command.set_bin_name(NAME);
    command.build();
    for shell in SHELLS {
        let mut text = Vec::new();
        shell.try_generate(&command, &mut text)?;
        std::fs::write(folder.join(shell.file_name(NAME)), text)?;
    }
    Ok(())
}

/// A command without what is hidden. clap_complete would offer that as well.
fn shown(command: &Command) -> Command {
    let arguments = command.get_arguments().filter(|known| !known.is_hide_set());
    // A conflict may name an option that is hidden, which clap forbids where that is gone.
    let arguments = arguments.map(|known| known.clone().conflicts_with(Resettable::<Id>::Reset));
    let subcommands = command.get_subcommands();
    let subcommands = subcommands.filter(|known| !known.is_hide_set()).map(shown);
    let mut kept = Command::new(command.get_name().to_owned())
        .disable_help_subcommand(true)
        .args(arguments)
        .subcommands(subcommands);
    if let Some(about) = command.get_about() {
        kept = kept.about(about.clone());
    }
    if let Some(version) = command.get_version() {
        kept = kept.version(version.to_owned());
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use manyview::config::{OPTIONS, Scope};

    /// The files by name.
    fn files() -> Vec<(String, String)> {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        let file = |shell: Shell| {
            let name = shell.file_name(NAME);
            let text = std::fs::read_to_string(folder.path().join(&name)).unwrap();
            (name, text)
        };
        SHELLS.map(file).into()
    }

    /// The words of a text, such as `--views` and `run`.
    fn words(text: &str) -> Vec<&str> {
        let part = |c: char| c.is_ascii_alphanumeric() || c == '-';
        text.split(|c| !part(c)).collect()
    }

    #[test]
    fn each_shell_has_its_file() {
        let names: Vec<_> = files().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["manyview.bash", "_manyview", "manyview.fish"]);
    }

    #[test]
    fn every_subcommand_that_is_not_hidden_is_completed() {
        for (file, text) in files() {
            let words = words(&text);
            for known in super::super::Arguments::command().get_subcommands() {
                let name = known.get_name();
                // `man` is a word of its own in no text of help.
                assert_eq!(
                    words.contains(&name),
                    !known.is_hide_set(),
                    "{file}: {name}"
                );
            }
        }
    }

    #[test]
    fn every_option_of_the_layer_is_completed_and_no_former_one() {
        for (file, text) in files() {
            // fish writes options as `-l views`.
            let text = text.replace(" -l ", " --");
            let words = words(&text);
            for spec in OPTIONS.iter().filter(|spec| spec.scope == Scope::Layer) {
                let has = |flag| words.contains(&&*format!("--{flag}"));
                assert!(has(spec.flag.unwrap()), "{file}: {:?}", spec.flag);
                if let Some(former) = spec.former.flag {
                    assert!(!has(former), "{file}: --{former}");
                }
            }
        }
    }
}
