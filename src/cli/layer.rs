//! The options of the layer as options of the subcommands that start a program, made from the one table.
#![forbid(unsafe_code)]

use super::tell;
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use manyview::config::{ConfigError, OPTIONS, OptionId, OptionSpec, PathKind, Scope, Settings};

/// One option as it was written.
struct Written {
    id: OptionId,
    value: String,
    /// Written with the flag of the version before.
    former: bool,
}

/// Values stay as they are written: [`manyview::config`] understands them, wherever they come from.
#[derive(Default)]
struct Given(Vec<Written>);

/// The options of every subcommand that starts a program under the layer.
#[derive(Default)]
pub(crate) struct LayerArguments(Given);

/// More options of `manyview capture`.
#[derive(Default)]
pub(crate) struct CaptureArguments(Given);

/// The rows of a scope that have a flag, with it.
fn rows(scope: Scope) -> impl Iterator<Item = (&'static OptionSpec, &'static str)> {
    let rows = OPTIONS.iter().filter(move |spec| spec.scope == scope);
    rows.filter_map(|spec| Some((spec, spec.flag?)))
}

/// The flag of the version before: hidden, and in conflict with the present one.
fn former(spec: &OptionSpec, flag: &'static str) -> Option<Arg> {
    let former = spec.former.flag?;
    let argument = Arg::new(former)
        .long(former)
        .value_name(spec.value_name())
        .conflicts_with(flag);
    Some(argument.hide(true))
}

fn argument(spec: &OptionSpec, flag: &'static str) -> Arg {
    let argument = Arg::new(flag).long(flag).help(spec.command_help());
    let argument = match spec.scope {
        Scope::Layer => argument.help_heading("Layer"),
        Scope::Capture | Scope::Variable => argument,
    };
    let argument = argument.visible_aliases(spec.alias);
    if spec.id.is_switch() {
        // On without a value; 0 takes back what a variable or a file says.
        return argument
            .value_name("0|1")
            .num_args(0..=1)
            .require_equals(true)
            .default_missing_value("1");
    }
    // A value that is neither a word nor a path may be a negative number.
    let number = spec.choices.is_empty() && spec.path == PathKind::No;
    argument
        .value_name(spec.value_name())
        .allow_hyphen_values(number)
}

impl Given {
    fn read(scope: Scope, matches: &ArgMatches) -> Self {
        let mut given = Vec::new();
        for (spec, flag) in rows(scope) {
            let mut write = |value, former| {
                let id = spec.id;
                given.push(Written { id, value, former });
            };
            if let Some(value) = matches.get_one::<String>(flag) {
                write(value.clone(), false);
            }
            if let Some(former) = spec.former.flag
                && let Some(value) = matches.get_one::<String>(former)
            {
                write(value.clone(), true);
            }
        }
        Self(given)
    }

    fn give(&self, settings: &mut Settings) {
        for written in &self.0 {
            settings.command_line(written.id, &written.value, written.former);
        }
    }
}

/// The implementations that clap's derive would write for a field of each row.
macro_rules! arguments_of {
    ($scope:expr, $arguments:ident) => {
        impl Args for $arguments {
            fn augment_args(command: Command) -> Command {
                let formers = rows($scope).filter_map(|(spec, flag)| former(spec, flag));
                command
                    .args(rows($scope).map(|(spec, flag)| argument(spec, flag)))
                    .args(formers)
            }

            fn augment_args_for_update(command: Command) -> Command {
                Self::augment_args(command)
            }
        }

        impl FromArgMatches for $arguments {
            fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
                Ok(Self(Given::read($scope, matches)))
            }

            fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
                *self = Self::from_arg_matches(matches)?;
                Ok(())
            }
        }
    };
}

arguments_of!(Scope::Layer, LayerArguments);
arguments_of!(Scope::Capture, CaptureArguments);

impl LayerArguments {
    /// These options over the variables over the TOML file. Warns of former names.
    pub(crate) fn settings(&self) -> Result<Settings, ConfigError> {
        let mut settings = Settings::default();
        self.0.give(&mut settings);
        let settings = settings
            .over(Settings::from_variables(variable))
            .with_file()?;
        for renaming in settings.renamings() {
            tell(renaming);
        }
        Ok(settings)
    }
}

impl CaptureArguments {
    /// Puts these options over the present settings.
    pub(crate) fn give(&self, settings: &mut Settings) {
        self.0.give(settings);
    }

    /// The value of one of them.
    pub(crate) fn get(&self, id: OptionId) -> Option<&str> {
        let given = self.0.0.iter().find(|written| written.id == id);
        given.map(|written| written.value.as_str())
    }
}

/// A variable as text. A value that is not UTF-8 is replaced by one that the checks refuse by name.
pub(super) fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
}
