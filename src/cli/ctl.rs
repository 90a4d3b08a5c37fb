//! `manyview ctl`
#![forbid(unsafe_code)]

use super::error::CommandError;
use super::{Outcome, print};
use clap::{Args, Subcommand};
use manyview::config::Capture;
use manyview::control::{
    ALL, Answer, ControlError, Explanation, LAYER, Picture, ProfileRequest, Request, line, place,
};
use manyview::window::wake;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// A program answers once per frame; loading may take this long.
const PATIENCE: Duration = Duration::from_secs(10);
/// One that has not answered for so long may be idle, and is woken.
const IDLE: Duration = Duration::from_millis(300);

#[derive(Args)]
pub(crate) struct Arguments {
    /// The program's process; needed only if several listen
    #[arg(long, value_name = "PID")]
    pid: Option<u32>,
    #[command(subcommand)]
    what: What,
}

#[derive(Subcommand)]
enum What {
    /// Change values from the next frame on, all of them or none: output, separation, convergence, eye-spacing, focal-depth,
    /// hud-depth; of a slanted lens sheet pitch, slant, offset
    Set {
        /// Names and values in turn, such as: separation 0.03 convergence 8
        #[arg(
            required = true,
            num_args = 2..,
            value_name = "NAME VALUE",
            allow_negative_numbers = true
        )]
        pairs: Vec<String>,
    },
    /// Print the values in force
    Get {
        /// One of them; all unless given
        name: Option<String>,
    },
    /// Write the next frame as PNG
    Capture {
        /// The file
        path: PathBuf,
        /// What the picture holds [default: output]
        #[arg(long, value_name = "output|atlas|view:I|depth")]
        what: Option<String>,
    },
    /// Explain the next frame: which draw has which class, and why, as `run --explain` does
    Explain {
        /// The files are `explain.png` and `explain.txt` in a folder that exists, else they have the file's name
        path: PathBuf,
    },
    /// Show the program's own view, or all views again
    Toggle,
    /// Move to cameras of --presets
    Preset {
        /// Which, counted from 1
        number: usize,
    },
    /// As `manyview profile`, which has taken its place
    #[command(hide = true)]
    Profile {
        #[command(subcommand)]
        what: WhatOfProfile,
    },
}

/// `manyview profile`
#[derive(Args)]
pub(crate) struct ProfileArguments {
    /// The program's process; needed only if several listen
    #[arg(long, value_name = "PID")]
    pid: Option<u32>,
    #[command(subcommand)]
    what: WhatOfProfile,
}

#[derive(Clone, Subcommand)]
enum WhatOfProfile {
    /// Put the file as it is now in force from the next frame on
    Reload,
    /// Write the rules and the values in force, hud-depth and focal-depth
    Save {
        /// The file [default: the user's own profile of the program, in manyview/profiles in XDG_CONFIG_HOME or ~/.config]
        path: Option<PathBuf>,
    },
}

pub(crate) fn profile(arguments: &ProfileArguments) -> Outcome {
    run(&Arguments {
        pid: arguments.pid,
        what: What::Profile {
            what: arguments.what.clone(),
        },
    })
}

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let request = request(&arguments.what)?;
    let (pid, stream) = find(arguments.pid)?;
    match ask(pid, stream, &request)? {
        Answer::Error(sentence) => Err(ControlError::Refused(sentence).into()),
        Answer::Values(values) => match arguments.what {
            What::Set { .. } | What::Preset { .. } => Ok(ExitCode::SUCCESS),
            What::Get { name: Some(_) } => {
                let values = values.values().map(|value| word(value) + "\n");
                print(&values.collect::<String>())
            }
            _ => {
                let mut text = String::new();
                for (name, value) in &values {
                    // Writing to a string cannot fail.
                    let _ = writeln!(text, "{name} = {}", word(value));
                }
                print(&text)
            }
        },
        Answer::Layer(on) => print(&format!("{LAYER} = {}\n", word(&on.into()))),
        Answer::Profile { path, rules, left } => {
            let done = match arguments.what {
                What::Profile {
                    what: WhatOfProfile::Save { .. },
                } => "wrote",
                _ => "read",
            };
            super::tell(&format_args!("{done} {} (rules: {rules})", path.display()));
            if !left.is_empty() {
                super::tell(&format_args!(
                    "a profile does not hold {}; give them as options",
                    left.join(", ")
                ));
            }
            Ok(ExitCode::SUCCESS)
        }
        Answer::Explained { path, frame } => {
            super::tell(&format_args!(
                "wrote {} and the picture beside it (frame {frame})",
                path.display()
            ));
            Ok(ExitCode::SUCCESS)
        }
        Answer::Captured { path, frame } => {
            super::tell(&format_args!("wrote {} (frame {frame})", path.display()));
            match &arguments.what {
                // The layer alone knows the name of a quilt.
                What::Capture { path: asked, .. } if asked.file_name() != path.file_name() => {
                    print(&format!("{}\n", path.display()))
                }
                _ => Ok(ExitCode::SUCCESS),
            }
        }
    }
}

/// A value in the form that `set` takes.
fn word(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(on) => if *on { "on" } else { "off" }.to_owned(),
        other => other.to_string(),
    }
}

fn request(what: &What) -> Result<Request, CommandError> {
    Ok(match what {
        What::Set { pairs } => {
            let mut values = BTreeMap::new();
            for pair in pairs.chunks(2) {
                let [name, value] = pair else {
                    return Err(ControlError::NoValue(pair.concat()).into());
                };
                values.insert(name.clone(), value.clone().into());
            }
            Request::Set(values)
        }
        What::Get { name } => Request::Get(name.clone().unwrap_or_else(|| ALL.to_owned())),
        What::Capture { path, what } => {
            let path = match what.as_deref() {
                None | Some("output") => Capture::completed(path),
                Some(_) => path.clone(),
            };
            Request::Capture(Picture {
                path: absolute(&path)?,
                what: what.clone(),
            })
        }
        What::Explain { path } => Request::Explain(Explanation {
            path: absolute(path)?,
        }),
        What::Toggle => Request::Toggle(LAYER.to_owned()),
        What::Preset { number } => Request::Preset(*number),
        What::Profile { what } => Request::Profile(match what {
            WhatOfProfile::Reload => ProfileRequest::Reload,
            WhatOfProfile::Save { path } => {
                ProfileRequest::Save(path.as_deref().map(absolute).transpose()?)
            }
        }),
    })
}

/// A path that the program understands, whatever its working directory is.
fn absolute(path: &Path) -> Result<PathBuf, CommandError> {
    let path = std::path::absolute(path)
        .map_err(|source| CommandError::system("finding the current folder", source))?;
    match path.to_str() {
        Some(_) => Ok(path),
        None => Err(ControlError::NotUtf8(path).into()),
    }
}

/// Finds the program to talk to, and removes sockets at which no program listens any more.
fn find(wanted: Option<u32>) -> Result<(u32, UnixStream), CommandError> {
    let user = rustix::process::geteuid().as_raw();
    let mut listening = Vec::new();
    let own = place::folder(std::env::var_os(place::RUNTIME).as_deref(), user);
    for folder in place::all(|name| std::env::var_os(name), user) {
        match place::check(&folder, user) {
            Ok(_) => {}
            // Another one may be anybody's.
            Err(_) if folder != own => continue,
            Err(error) => return Err(error.into()),
        }
        for (number, socket) in sockets(&folder) {
            match UnixStream::connect(&socket) {
                Ok(stream) => listening.push((process(&stream).unwrap_or(number), stream)),
                Err(error) if error.kind() == ErrorKind::ConnectionRefused => {
                    let _ = std::fs::remove_file(&socket);
                }
                // Removed in between, or not a socket.
                Err(_) => {}
            }
        }
    }
    if let Some(wanted) = wanted {
        let found = listening.into_iter().find(|(pid, _)| *pid == wanted);
        return found.ok_or_else(|| ControlError::NoSuchProgram(wanted).into());
    }
    if listening.len() > 1 {
        let programs = listening.iter().map(|(pid, _)| match program(*pid) {
            Some(name) => format!("{pid} ({name})"),
            None => pid.to_string(),
        });
        let programs = programs.collect::<Vec<_>>().join(", ");
        return Err(ControlError::SeveralPrograms(programs).into());
    }
    listening
        .pop()
        .ok_or_else(|| ControlError::NoProgram.into())
}

/// The process ID of the program at the other end, as it is outside of its container.
fn process(stream: &UnixStream) -> Option<u32> {
    let peer = rustix::net::sockopt::socket_peercred(stream).ok()?;
    u32::try_from(peer.pid.as_raw_nonzero().get()).ok()
}

/// Numbers and sockets, in the order of the numbers.
fn sockets(folder: &Path) -> Vec<(u32, PathBuf)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut found: Vec<_> = paths
        .filter_map(|path| Some((place::pid(&path)?, path)))
        .collect();
    found.sort();
    found
}

fn program(pid: u32) -> Option<String> {
    let name = std::fs::read_to_string(format!("/proc/{pid}/comm")).ok()?;
    Some(name.trim_end().to_owned())
}

fn ask(pid: u32, stream: UnixStream, request: &Request) -> Result<Answer, CommandError> {
    let failed = |source: std::io::Error| match source.kind() {
        ErrorKind::WouldBlock | ErrorKind::TimedOut => ControlError::Silent {
            pid,
            seconds: PATIENCE.as_secs(),
        }
        .into(),
        ErrorKind::BrokenPipe | ErrorKind::ConnectionReset => ControlError::Closed(pid).into(),
        _ => CommandError::system("talking to the program", source),
    };
    let limit = Instant::now() + PATIENCE;
    stream
        .set_read_timeout(Some(IDLE))
        .and_then(|()| stream.set_write_timeout(Some(PATIENCE)))
        .and_then(|()| (&stream).write_all(line(request).as_bytes()))
        .map_err(failed)?;
    let mut answer = Vec::new();
    let mut reader = BufReader::new(stream);
    // What has arrived before an error stays in `answer`.
    while let Err(error) = reader.read_until(b'\n', &mut answer) {
        let idle = matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut);
        if !idle || Instant::now() > limit {
            return Err(failed(error));
        }
        wake(pid);
    }
    if answer.is_empty() {
        return Err(ControlError::Closed(pid).into());
    }
    serde_json::from_slice(&answer)
        .map_err(|error| CommandError::system("reading the program's answer", error.into()))
}
