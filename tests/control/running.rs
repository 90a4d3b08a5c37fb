//! A program that draws until it is told to stop, and the command that talks to it.

use crate::support::{Compiled, Screen, compiled, layered, manyview, rgb, run, window_picture};
use image::RgbImage;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

pub(crate) const LIMIT: Duration = Duration::from_secs(60);

/// Checks that two pictures are equal pixel by pixel.
#[track_caller]
pub(crate) fn same(left: &RgbImage, right: &RgbImage, what: &str) {
    assert_eq!(left.dimensions(), right.dimensions(), "{what}");
    let differ = left.pixels().zip(right.pixels()).filter(|(a, b)| a != b);
    assert_eq!(differ.count(), 0, "{what}: pixels that differ");
}

/// Waits until `look` finds something.
#[track_caller]
pub(crate) fn until<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let limit = Instant::now() + LIMIT;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < limit, "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

pub(crate) fn stays() -> PathBuf {
    compiled("stays", Compiled::Program, &["-lGL", "-lX11"])
}

/// A program that draws until it is asked to end.
pub(crate) struct Running {
    child: Option<Child>,
    /// XDG_RUNTIME_DIR of the program and of `ctl`, and the folder of other files.
    pub(crate) folder: TempDir,
}

impl Running {
    pub(crate) fn start(screen: &Screen, options: &[(&str, &str)]) -> Self {
        Self::start_in(
            tempfile::tempdir().expect("a folder"),
            screen,
            &mut layered(stays(), options),
        )
    }

    /// Starts a program that takes the paths of the files `stop` and `shoot` in the folder.
    pub(crate) fn start_in(folder: TempDir, screen: &Screen, command: &mut Command) -> Self {
        command
            .arg(folder.path().join("stop"))
            .arg(folder.path())
            .env("XDG_RUNTIME_DIR", folder.path())
            .current_dir(folder.path())
            .stderr(Stdio::piped());
        let child = screen.give(command).spawn().expect("the program starts");
        Running {
            child: Some(child),
            folder,
        }
    }

    /// Starts a program that runs until it is killed.
    pub(crate) fn start_program(screen: &Screen, command: &mut Command) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        command
            .env("XDG_RUNTIME_DIR", folder.path())
            .current_dir(folder.path())
            .stderr(Stdio::piped());
        let child = screen.give(command).spawn().expect("the program starts");
        Running {
            child: Some(child),
            folder,
        }
    }

    pub(crate) fn controlled(screen: &Screen, options: &[(&str, &str)]) -> Self {
        let mut all = vec![("CONTROL", "1")];
        all.extend(options);
        let running = Self::start(screen, &all);
        until("a socket", || running.socket().exists().then_some(()));
        running
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn pid(&self) -> u32 {
        self.child.as_ref().expect("it runs").id()
    }

    pub(crate) fn socket(&self) -> PathBuf {
        self.path(&format!("manyview/{}.sock", self.pid()))
    }

    pub(crate) fn connect(&self) -> UnixStream {
        let stream = UnixStream::connect(self.socket()).expect("it listens");
        stream.set_read_timeout(Some(LIMIT)).expect("a limit");
        stream
    }

    /// Sends a line and reads the answer.
    pub(crate) fn say(&self, line: &str) -> serde_json::Value {
        let mut stream = self.connect();
        writeln!(stream, "{line}").expect("sent");
        let mut answer = String::new();
        let mut reader = BufReader::new(stream);
        reader.read_line(&mut answer).expect("an answer");
        serde_json::from_str(&answer).unwrap_or_else(|error| panic!("{answer}: {error}"))
    }

    pub(crate) fn ctl(&self, arguments: &[&str]) -> (i32, String, String) {
        run(ctl(self.folder.path()).args(arguments))
    }

    #[track_caller]
    pub(crate) fn done(&self, arguments: &[&str]) -> String {
        let (code, stdout, stderr) = self.ctl(arguments);
        assert_eq!(code, 0, "{arguments:?}: {stderr}");
        stdout
    }

    /// A capture of the next frame.
    #[track_caller]
    pub(crate) fn capture(&self, what: &str) -> RgbImage {
        let path = self.path("captured.png");
        self.done(&["capture", path.to_str().expect("UTF-8"), "--what", what]);
        let picture = rgb(&path);
        std::fs::remove_file(path).expect("removed");
        picture
    }

    /// The picture of the window, read through X.
    #[track_caller]
    pub(crate) fn window(&self) -> RgbImage {
        let shot = self.path("shot.ppm");
        std::fs::write(self.path("shoot"), "").expect("written");
        until("a picture", || (!self.path("shoot").exists()).then_some(()));
        let picture = window_picture(&shot);
        std::fs::remove_file(shot).expect("removed");
        picture
    }

    /// Asks the program to end; returns its status and its stderr.
    pub(crate) fn end(&mut self) -> (Option<i32>, String) {
        std::fs::write(self.path("stop"), "").expect("written");
        let output = self.child.take().expect("it runs").wait_with_output();
        let output = output.expect("it ends");
        let said = String::from_utf8(output.stderr).expect("text");
        (output.status.code(), said)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(mut child) = self.child.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

pub(crate) fn ctl(folder: &Path) -> Command {
    let mut command = manyview();
    command.arg("ctl").env("XDG_RUNTIME_DIR", folder);
    command
}

impl Running {
    /// The picture of the window once two in a row are the same: X has no drawing queued any more.
    pub(crate) fn steady_window(&self) -> RgbImage {
        let mut last = self.window();
        until("a steady picture", || {
            let now = self.window();
            let same = now == last;
            last = now;
            same.then(|| last.clone())
        })
    }
}
