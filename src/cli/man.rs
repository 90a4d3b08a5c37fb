//! `manyview man`: the manual pages, made of the same options as the help texts. For `make man` and `make install`.
#![forbid(unsafe_code)]

use super::Outcome;
use super::error::CommandError;
use clap::{Args, CommandFactory};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[derive(Args)]
pub(crate) struct Arguments {
    /// Folder to write manyview.1, manyview-run.1 and so on to
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    write(&arguments.out)
        .map_err(|source| CommandError::system("writing the manual pages", source))?;
    Ok(ExitCode::SUCCESS)
}

/// Writes a page for the command, and one for each subcommand that is not hidden.
fn write(folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let command = super::Arguments::command().disable_help_subcommand(true);
    clap_mangen::generate_to(command, folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use manyview::config::{OPTIONS, Scope};

    /// The pages by name, with plain dashes.
    fn pages() -> Vec<(String, String)> {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path()).unwrap();
        let files = std::fs::read_dir(folder.path()).unwrap();
        let files = files.map(|file| file.unwrap().path());
        let page = |path: PathBuf| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).unwrap();
            (name, text.replace("\\-", "-"))
        };
        files.map(page).collect()
    }

    #[test]
    fn every_subcommand_has_its_page() {
        let pages = pages();
        let has = |name: &str| pages.iter().any(|(page, _)| page == name);
        assert!(has("manyview.1"));
        let command = super::super::Arguments::command();
        for subcommand in command.get_subcommands() {
            let name = format!("manyview-{}.1", subcommand.get_name());
            assert_eq!(has(&name), !subcommand.is_hide_set(), "{name}");
        }
    }

    #[test]
    fn the_page_of_run_has_every_option_of_the_layer() {
        let pages = pages();
        let (_, run) = pages
            .iter()
            .find(|page| page.0 == "manyview-run.1")
            .unwrap();
        for spec in OPTIONS.iter().filter(|spec| spec.scope == Scope::Layer) {
            let flag = spec.flag.unwrap();
            assert!(run.contains(&format!("--{flag}")), "--{flag}");
            if let Some(former) = spec.former.flag {
                assert!(!run.contains(&format!("--{former}")), "--{former}");
            }
        }
    }
}
