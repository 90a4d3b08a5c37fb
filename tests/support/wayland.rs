//! A Wayland compositor for a test, with monitors of its own, and a user who looks at them.

use super::x::User;
use super::{Screen, has, sized_screen};
use image::RgbImage;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const LIMIT: Duration = Duration::from_secs(20);

/// A monitor.
#[derive(Clone, Copy)]
pub(crate) struct Monitor {
    /// Pixels before it is turned.
    pub(crate) size: (u16, u16),
    /// As the compositor's own file calls it.
    pub(crate) turned: &'static str,
    pub(crate) scale: &'static str,
}

impl Monitor {
    /// Its mode, turn and scale for a compositor's own file.
    fn words(&self) -> [String; 3] {
        let (width, height) = self.size;
        [
            format!("{width}x{height}"),
            self.turned.to_owned(),
            self.scale.to_owned(),
        ]
    }
}

/// A compositor that runs until it is dropped.
pub(crate) struct Compositor {
    child: Child,
    folder: TempDir,
    socket: String,
    /// What it draws on, where that is an X server.
    screen: Option<Screen>,
}

/// Whether sway can run here, with the program that looks at its monitors.
pub(crate) fn has_sway() -> bool {
    let may = || {
        as_user("true")
            .status()
            .is_ok_and(|status| status.success())
    };
    has("sway") && has("grim") && may()
}

/// A program that does not run as root: root gives it a name space of users.
fn as_user(program: &str) -> Command {
    if !rustix::process::geteuid().is_root() {
        return Command::new(program);
    }
    let mut command = Command::new("unshare");
    command.args(["--user", "--map-user=1000", "--map-group=1000", program]);
    command
}

impl Compositor {
    /// Weston in a window of an X server for each monitor. Its monitors are called X0 and so on.
    pub(crate) fn weston(monitors: &[Monitor]) -> Self {
        Self::weston_with(monitors, &[])
    }

    /// The same with an X server for programs of X (Xwayland).
    pub(crate) fn weston_with_x(monitors: &[Monitor]) -> Self {
        Self::weston_with(monitors, &["--xwayland"])
    }

    fn weston_with(monitors: &[Monitor], more: &[&str]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let output = |(number, monitor): (usize, &Monitor)| {
            let [mode, turned, scale] = monitor.words();
            format!("[output]\nname=X{number}\nmode={mode}\ntransform={turned}\nscale={scale}\n")
        };
        let outputs: String = monitors.iter().enumerate().map(output).collect();
        let text = format!("[core]\nidle-time=0\n[shell]\npanel-position=none\n{outputs}");
        let file = folder.path().join("weston.ini");
        std::fs::write(&file, text).expect("written");
        let screen = sized_screen((2000, 1400));
        let mut command = Command::new("weston");
        command
            .args(["--backend=x11-backend.so", "--use-pixman"])
            .args(["--socket=wayland-test"])
            .arg(format!("--output-count={}", monitors.len()))
            .arg(format!("--config={}", file.display()))
            .arg(format!("--log={}", folder.path().join("log").display()))
            .args(more);
        screen.give(&mut command);
        Self::start(command, folder, Some(screen))
    }

    /// Sway without a screen. Its monitors are called HEADLESS-1 and so on.
    pub(crate) fn sway(monitors: &[Monitor]) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let output = |(number, monitor): (usize, &Monitor)| {
            let [mode, turned, scale] = monitor.words();
            format!("output HEADLESS-{number} mode {mode} transform {turned} scale {scale}\n")
        };
        let text: String = (1..).zip(monitors).map(output).collect();
        let file = folder.path().join("sway.txt");
        std::fs::write(&file, text).expect("written");
        let mut command = as_user("sway");
        command
            .arg("--config")
            .arg(&file)
            .env("WLR_BACKENDS", "headless")
            .env("WLR_RENDERER", "pixman")
            .env("WLR_LIBINPUT_NO_DEVICES", "1")
            .env("WLR_HEADLESS_OUTPUTS", monitors.len().to_string())
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY");
        Self::start(command, folder, None)
    }

    fn start(mut command: Command, folder: TempDir, screen: Option<Screen>) -> Self {
        command
            .env("XDG_RUNTIME_DIR", folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let child = command.spawn().expect("a compositor");
        let mut compositor = Self {
            child,
            folder,
            socket: String::new(),
            screen,
        };
        let limit = Instant::now() + LIMIT;
        compositor.socket = loop {
            if let Some(name) = compositor.listening() {
                break name;
            }
            assert!(Instant::now() < limit, "the compositor has no socket");
            std::thread::sleep(Duration::from_millis(20));
        };
        compositor
    }

    /// The socket that it has made.
    fn listening(&self) -> Option<String> {
        self.file(|name| name.starts_with("wayland-") && !name.ends_with(".lock"))
    }

    fn file(&self, is: impl Fn(&str) -> bool) -> Option<String> {
        let all = std::fs::read_dir(self.folder.path()).expect("a folder");
        let mut names = all.filter_map(|file| file.ok()?.file_name().into_string().ok());
        names.find(|name| is(name))
    }

    /// Lets a program use it, and no X server.
    pub(crate) fn give<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("XDG_RUNTIME_DIR", self.folder.path())
            .env("WAYLAND_DISPLAY", &self.socket)
            .env_remove("DISPLAY")
    }

    /// The runtime folder in which its socket lies, and the name of that.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    pub(crate) fn socket(&self) -> &str {
        &self.socket
    }

    /// The display of its X server.
    pub(crate) fn x_display(&self) -> String {
        let limit = Instant::now() + LIMIT;
        loop {
            let log = std::fs::read_to_string(self.folder.path().join("log")).unwrap_or_default();
            let told = log.split_once("xserver listening on display ");
            if let Some((_, rest)) = told {
                return rest.lines().next().unwrap_or_default().to_owned();
            }
            assert!(Instant::now() < limit, "no X server: {log}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// The pixels of a monitor as they are sent to it, before it is turned.
    pub(crate) fn pixels(&self, number: usize) -> Option<RgbImage> {
        if let Some(screen) = &self.screen {
            let user = User::at(screen.display());
            let title = format!("Weston Compositor - X{number}");
            let window = user.window(&title)?;
            // One below the other, because X has no pixels of what is covered.
            user.move_to(window, [0, 700 * number as i16]);
            return Some(user.picture(window));
        }
        let file: PathBuf = self.folder.path().join("shown.png");
        let mut command = Command::new("grim");
        let name = format!("HEADLESS-{}", number + 1);
        let taken = self.give(&mut command).args(["-o", &name]).arg(&file);
        let taken = taken.stderr(Stdio::null()).status().expect("grim");
        taken.success().then_some(())?;
        Some(image::open(file).ok()?.into_rgb8())
    }
}

impl Compositor {
    /// Whether it has a window of this title that can get the keyboard. None where the compositor does not tell (weston).
    pub(crate) fn has_window(&self, title: &str) -> Option<bool> {
        let socket = self.file(|name| name.starts_with("sway-ipc"))?;
        let mut command = Command::new("swaymsg");
        command.arg("--socket").arg(self.folder.path().join(socket));
        let output = command.args(["--raw", "-t", "get_tree"]).output();
        let tree = String::from_utf8(output.expect("swaymsg").stdout).expect("text");
        assert!(tree.contains("HEADLESS-1"), "{tree}");
        Some(tree.contains(&format!("\"{title}\"")))
    }
}

impl Drop for Compositor {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
