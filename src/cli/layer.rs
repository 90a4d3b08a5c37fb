//! The options of the layer as options of the subcommands that start a program, made from the one table.
#![forbid(unsafe_code)]

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use manyview::config::{
    ConfigError, OPTIONS, OptionId, OptionSpec, Origin, PathKind, Scope, Settings,
};

/// Values stay as they are written: [`manyview::config`] understands them, wherever they come from.
#[derive(Default)]
struct Given(Vec<(OptionId, String)>);

/// The options of every subcommand that starts a program under the layer.
#[derive(Default)]
pub(crate) struct LayerArguments(Given);

/// The options of `manyview capture` beside those.
#[derive(Default)]
pub(crate) struct CaptureArguments(Given);

/// The rows of a scope that have a flag, with it.
fn rows(scope: Scope) -> impl Iterator<Item = (&'static OptionSpec, &'static str)> {
    let rows = OPTIONS.iter().filter(move |spec| spec.scope == scope);
    rows.filter_map(|spec| Some((spec, spec.flag?)))
}

fn argument(spec: &OptionSpec, flag: &'static str) -> Arg {
    let argument = Arg::new(flag).long(flag).help(spec.command_help());
    let argument = match spec.scope {
        Scope::Layer => argument.help_heading("Layer"),
        Scope::Capture | Scope::Variable => argument,
    };
    let argument = argument.visible_aliases(spec.alias);
    if spec.id.is_switch() {
        return argument.action(ArgAction::SetTrue);
    }
    // What is neither a word nor a path may be a negative number.
    let number = spec.choices.is_empty() && spec.path == PathKind::No;
    argument
        .value_name(spec.value_name())
        .allow_hyphen_values(number)
}

impl Given {
    fn read(scope: Scope, matches: &ArgMatches) -> Self {
        let value = |(spec, flag): (&OptionSpec, &str)| {
            let value = if spec.id.is_switch() {
                matches.get_flag(flag).then(|| "1".to_owned())
            } else {
                matches.get_one::<String>(flag).cloned()
            };
            Some((spec.id, value?))
        };
        Self(rows(scope).filter_map(value).collect())
    }

    fn give(&self, settings: &mut Settings) {
        for (id, value) in &self.0 {
            settings.set(*id, value, Origin::CommandLine);
        }
    }
}

/// What clap's derive would write for a field of each row.
macro_rules! arguments_of {
    ($scope:expr, $arguments:ident) => {
        impl Args for $arguments {
            fn augment_args(command: Command) -> Command {
                command.args(rows($scope).map(|(spec, flag)| argument(spec, flag)))
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
    /// These options over the variables over the TOML file.
    pub(crate) fn settings(&self) -> Result<Settings, ConfigError> {
        let mut settings = Settings::default();
        self.0.give(&mut settings);
        settings
            .over(Settings::from_variables(variable))
            .with_file()
    }
}

impl CaptureArguments {
    /// Puts these options over what is set.
    pub(crate) fn give(&self, settings: &mut Settings) {
        self.0.give(settings);
    }

    /// The value of one of them.
    pub(crate) fn get(&self, id: OptionId) -> Option<&str> {
        let given = self.0.0.iter().find(|(given, _)| *given == id);
        given.map(|(_, value)| value.as_str())
    }
}

/// A variable as text; what is not text turns into a value that the checks refuse by name.
pub(super) fn variable(name: &str) -> Option<String> {
    std::env::var_os(name).map(|value| value.to_string_lossy().into_owned())
}
