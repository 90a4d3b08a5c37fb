//! A program under the layer: its environment, its start and its exit status.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use super::library::Libraries;
use super::lost::Lost;
use super::{flatpak, library, preflight, preload, signals};
use crate::config::{Config, OPTIONS, OptionId, Origin, Settings, program};
use crate::control::place;
use rustix::process::{Pid, Signal, kill_process};
use std::ffi::OsString;
use std::io::ErrorKind;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::sync::mpsc::RecvTimeoutError;
use tempfile::TempDir;

/// A program that has passed every check and can be started.
#[derive(Debug)]
pub struct Launch {
    app: PathBuf,
    name: OsString,
    arguments: Vec<OsString>,
    libraries: Libraries,
    variables: Vec<(String, String)>,
    /// The program is in Flatpak, and this is its ID: `app` is `flatpak`, and the arguments are the program's.
    flatpak: Option<OsString>,
    /// Has a folder for each start, in which its processes claim the paths that they write to. None where nothing is written.
    claims: Option<TempDir>,
    /// The parsed options.
    pub config: Config,
}

/// How a program ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ended(pub ExitStatus);

impl Ended {
    /// Its exit status, or 128 + the number of the signal that killed it, as in a shell.
    #[must_use]
    pub fn code(self) -> u8 {
        let code = self
            .0
            .code()
            .or_else(|| self.0.signal().map(|signal| 128 + signal));
        code.and_then(|code| u8::try_from(code).ok())
            .unwrap_or(u8::MAX)
    }

    /// The end in words.
    #[must_use]
    pub fn describe(self) -> String {
        match (self.0.code(), self.0.signal()) {
            (Some(code), _) => format!("with status {code}"),
            (_, Some(signal)) => format!("by signal {signal}"),
            _ => "for an unknown reason".to_owned(),
        }
    }
}

impl Launch {
    /// Checks options, files, program and library, in this order. `command` is the program and its arguments.
    pub fn prepare(command: &[OsString], settings: &Settings) -> Result<Self, LaunchError> {
        Self::prepared(command, None, settings)
    }

    /// The same for a program in Flatpak and its arguments: the first word is its ID.
    pub fn in_flatpak(command: &[OsString], settings: &Settings) -> Result<Self, LaunchError> {
        let Some((id, arguments)) = command.split_first() else {
            return Err(LaunchError::AppNotFound("no program".to_owned()));
        };
        let mut words = vec![OsString::from(flatpak::COMMAND)];
        words.extend_from_slice(arguments);
        Self::prepared(&words, Some(id.clone()), settings)
    }

    fn prepared(
        command: &[OsString],
        flatpak: Option<OsString>,
        settings: &Settings,
    ) -> Result<Self, LaunchError> {
        let mut settings = settings.clone();
        let libraries = library::find();
        let beside = libraries.as_ref().ok().map(Libraries::main);
        settings.find_profiles(beside);
        let mut config = Config::from_settings(&settings)?;
        preflight::check_files(&config)?;
        let Some((name, arguments)) = command.split_first() else {
            return Err(LaunchError::AppNotFound("no program".to_owned()));
        };
        let (app, class) = preflight::check_app(name)?;
        let known = match &flatpak {
            Some(_) => None,
            None => program_name(&app),
        };
        config.choose_profile(&settings, known.clone());
        // What the user starts is what the user wants to see, even where it is left bare as a part of another launch.
        let started = known.filter(|name| program::is_helper(name));
        if let Some(name) = started.filter(|_| settings.get(OptionId::Only).is_none()) {
            settings.set(OptionId::Only, name, Origin::Default);
        }
        let libraries = libraries?;
        preflight::check_class(&app, class.filter(|_| flatpak.is_none()), &libraries)?;
        if config.control || config.panel.is_some() {
            let user = rustix::process::geteuid().as_raw();
            let folders = place::give(|name| std::env::var_os(name), user);
            // A path with a colon is left out: no list can hold it.
            let whole = folders
                .iter()
                .filter(|path| std::env::join_paths([path]).is_ok());
            if let Ok(folders) = std::env::join_paths(whole) {
                settings.set(
                    OptionId::Sockets,
                    folders.to_string_lossy(),
                    Origin::Default,
                );
            }
        }
        let folder = std::env::current_dir().map_err(|source| LaunchError::System {
            doing: "finding the current folder",
            source,
        })?;
        let variables = settings.to_env(&folder);
        let writes = config.report.is_some()
            || config.explain.is_some()
            || config.capture.is_some()
            || config.status.is_some();
        let claims = writes.then(tempfile::tempdir).transpose();
        let claims = claims.map_err(|source| LaunchError::System {
            doing: "making a temporary folder",
            source,
        })?;
        Ok(Self {
            app,
            name: name.clone(),
            arguments: arguments.to_vec(),
            libraries,
            variables,
            flatpak,
            claims,
            config,
        })
    }

    /// Runs the program to its end. Signals to the launcher are forwarded to it.
    /// `tell` gets a sentence for each program of the launch that draws without the layer.
    pub fn run(&self, tell: impl Fn(&str) + Send + 'static) -> Result<Ended, LaunchError> {
        let mut signals = signals::catch()?;
        let mut child = self.spawn(self.command()?)?;
        let pid = Pid::from_child(&child);
        let handle = signals.handle();
        let forwarder = std::thread::spawn(move || {
            for signal in signals.forever() {
                if !signals::from_keyboard(signal) {
                    forward(pid, signal);
                }
            }
        });
        let (stop, stopped) = std::sync::mpsc::channel::<()>();
        let mut lost = Lost::new(child.id(), self.libraries.clone());
        let watcher = std::thread::spawn(move || {
            while stopped.recv_timeout(lost.pause()) == Err(RecvTimeoutError::Timeout) {
                lost.look().iter().for_each(|sentence| tell(sentence));
            }
        });
        let status = child.wait().map_err(|source| LaunchError::System {
            doing: "waiting for the program",
            source,
        });
        handle.close();
        drop(stop);
        // As below.
        let _ = watcher.join();
        // The thread only forwards signals, so its failure does not matter now.
        let _ = forwarder.join();
        status.map(Ended)
    }

    /// The command with the layer in its environment, or in that of its sandbox.
    pub(super) fn command(&self) -> Result<Command, LaunchError> {
        let mut command = match &self.flatpak {
            None => Command::new(&self.app),
            Some(_) => without_layer(&self.app, &[]),
        };
        let claims = self.claims.as_ref().map(tempfile::tempdir_in);
        // Without the folder, paths are claimed as by programs that were started without the launcher.
        let claims = claims.and_then(Result::ok).map(TempDir::keep);
        let launch = OptionId::Launch.spec().variable;
        if let Some(id) = &self.flatpak {
            let mut variables = self.variables.clone();
            variables.extend(claims.map(|path| (launch.to_owned(), path.display().to_string())));
            let words = flatpak::words(id, &variables, &self.arguments, &self.libraries)?;
            command.args(words);
            return Ok(command);
        }
        command.arg0(&self.name).args(&self.arguments);
        for spec in OPTIONS {
            for name in spec.variables() {
                command.env_remove(name);
            }
        }
        command.envs(self.variables.iter().map(|(name, value)| (name, value)));
        if let Some(claims) = claims {
            command.env(launch, claims);
        }
        command.env("LD_PRELOAD", preload_value(&self.libraries));
        Ok(command)
    }

    /// Starts the command. All other causes were checked before, so an error is due to the program.
    pub(super) fn spawn(&self, mut command: Command) -> Result<Child, LaunchError> {
        command.spawn().map_err(|error| {
            let reason = match error.kind() {
                ErrorKind::NotFound => "the interpreter it asks for is missing".to_owned(),
                _ => format!("it cannot be executed ({error})"),
            };
            LaunchError::AppNotExecutable {
                path: self.app.clone(),
                reason,
            }
        })
    }
}

/// The command for a program without the layer and without the caller's settings.
pub(super) fn without_layer(program: &Path, arguments: &[OsString]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).env_remove("LD_PRELOAD");
    for option in OPTIONS {
        for name in option.variables() {
            command.env_remove(name);
        }
    }
    command
}

/// The name by which the layer will know a program: that of its file, links followed.
fn program_name(app: &Path) -> Option<String> {
    let path = app.canonicalize().ok()?;
    Some(path.file_name()?.to_string_lossy().into_owned())
}

/// The value of `LD_PRELOAD` with these libraries and the current environment.
pub(super) fn preload_value(libraries: &Libraries) -> OsString {
    preload::with_library(
        libraries.preload(),
        std::env::var_os("LD_PRELOAD").as_deref(),
    )
}

fn forward(pid: Pid, signal: i32) {
    if let Some(signal) = Signal::from_named_raw(signal) {
        // The program may have ended in between.
        let _ = kill_process(pid, signal);
    }
}
