//! Ways to start a program under the layer: {64, 32 bits} × {as it is, a container with another `/usr`, one that is closed as Flatpak's are} × {X11, XWayland, Wayland}.
//! `make test-launch`, which installs packages and makes the other `/usr`.

use crate::support::wayland::{Compositor, Monitor};
use crate::support::{Screen, library, manyview, own_screen, rgb, target_folder};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const LIMIT: Duration = Duration::from_secs(60);
const MONITOR: Monitor = Monitor {
    size: (640, 480),
    turned: "normal",
    scale: "1",
};
const CLASSES: [&str; 2] = ["x86_64-linux-gnu", "i386-linux-gnu"];

#[derive(Clone, Copy, Debug, PartialEq)]
enum Container {
    None,
    /// Another `/usr`, private `/tmp` and `/run`, and the user's home: as Steam's.
    OtherUsr,
    /// The same without the home and the network, and with the layer at another path: as Flatpak's.
    Closed,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Desk {
    X11,
    XWayland,
    Wayland,
}

/// A desk, and what programs need to be shown there.
struct Shown {
    desk: Desk,
    screen: Option<Screen>,
    compositor: Option<Compositor>,
}

impl Shown {
    fn new(desk: Desk) -> Self {
        match desk {
            Desk::X11 => Shown {
                desk,
                screen: Some(own_screen()),
                compositor: None,
            },
            Desk::XWayland | Desk::Wayland => Shown {
                desk,
                screen: None,
                compositor: Some(Compositor::weston_with_x(&[MONITOR])),
            },
        }
    }

    fn program(&self, class: &str) -> String {
        let name = match self.desk {
            Desk::X11 | Desk::XWayland => "glxgears",
            Desk::Wayland => "es2gears_wayland",
        };
        format!("/usr/bin/{name}.{class}")
    }

    /// Where programs find the desk. `runtime`: the runtime folder that they see.
    fn give(&self, command: &mut Command, runtime: &Path) {
        command.env("XDG_RUNTIME_DIR", runtime);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        if let Some(screen) = &self.screen {
            screen.give(command);
        }
        if let Some(compositor) = &self.compositor {
            match self.desk {
                Desk::Wayland => command.env("WAYLAND_DISPLAY", compositor.socket()),
                _ => command.env("DISPLAY", compositor.x_display()),
            };
        }
    }
}

fn other_usr() -> PathBuf {
    let root = target_folder().with_file_name("launch").join("trixie");
    assert!(root.join("usr/bin").is_dir(), "make test-launch");
    root
}

/// The words before a program that put it into a container.
fn words(container: Container, home: &Path, shown: &Shown) -> Vec<String> {
    if container == Container::None {
        return Vec::new();
    }
    let root = other_usr();
    let path = |path: &Path| path.to_str().expect("UTF-8").to_owned();
    let mut all = vec!["bwrap".to_owned()];
    let mut add = |words: &[&str]| all.extend(words.iter().map(|&word| word.to_owned()));
    add(&["--ro-bind", &path(&root.join("usr")), "/usr"]);
    add(&["--ro-bind", &path(&root.join("etc")), "/etc"]);
    for name in ["bin", "sbin", "lib", "lib64"] {
        add(&["--symlink", &format!("usr/{name}"), &format!("/{name}")]);
    }
    add(&["--proc", "/proc", "--dev", "/dev"]);
    // The program ends with the container, of which `run` knows alone.
    add(&["--unshare-pid", "--die-with-parent"]);
    add(&[
        "--tmpfs",
        "/tmp",
        "--tmpfs",
        "/run",
        "--dir",
        "/run/private",
    ]);
    add(&["--setenv", "XDG_RUNTIME_DIR", "/run/private"]);
    add(&["--ro-bind-try", "/tmp/.X11-unix", "/tmp/.X11-unix"]);
    if let Some(compositor) = shown
        .compositor
        .as_ref()
        .filter(|_| shown.desk == Desk::Wayland)
    {
        // The socket lies in the runtime folder, under the name that the variable has.
        let inside = format!("/run/private/{}", compositor.socket());
        add(&[
            "--ro-bind",
            &path(&compositor.folder().join(compositor.socket())),
            &inside,
        ]);
    }
    let target = target_folder().parent().expect("a target folder");
    match container {
        Container::OtherUsr => {
            add(&["--bind", &path(home), &path(home)]);
            add(&["--ro-bind", &path(target), &path(target)]);
        }
        _ => {
            let sockets = path(&home.join(".cache/manyview/sockets"));
            let pictures = path(&home.join("pictures"));
            add(&["--unshare-net", "--unshare-ipc"]);
            add(&["--bind", &sockets, &sockets, "--bind", &pictures, &pictures]);
            add(&["--ro-bind", &path(target), "/app/target"]);
            let preload = "/app/target/release/by-class/$LIB/libmanyview.so";
            add(&["--setenv", "LD_PRELOAD", preload]);
        }
    }
    all
}

/// A program that runs until it is dropped.
struct Running {
    child: Option<Child>,
    home: TempDir,
    runtime: TempDir,
}

impl Running {
    fn start(shown: &Shown, home: TempDir, program: &[String]) -> Self {
        let mut command = manyview();
        command.args(["run", "--views", "3", "--display", "huebner8", "--control"]);
        command.arg("--").args(program);
        Self::started(shown, home, command)
    }

    /// By a command that starts a program under the layer.
    fn started(shown: &Shown, home: TempDir, mut command: Command) -> Self {
        let runtime = tempfile::tempdir().expect("a folder");
        let outside = match (&shown.compositor, shown.desk) {
            (Some(compositor), Desk::Wayland) => compositor.folder().to_owned(),
            _ => runtime.path().to_owned(),
        };
        shown.give(&mut command, &outside);
        command
            .env("HOME", home.path())
            .env_remove("MANYVIEW_DISPLAY");
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let child = child.spawn().expect("manyview");
        Running {
            child: Some(child),
            home,
            runtime,
        }
    }

    /// `manyview ctl`, outside; whether it succeeds.
    fn ctl(&self, shown: &Shown, arguments: &[&str]) -> Result<(), String> {
        let mut command = manyview();
        command.arg("ctl").args(arguments);
        let outside = match (&shown.compositor, shown.desk) {
            (Some(compositor), Desk::Wayland) => compositor.folder().to_owned(),
            _ => self.runtime.path().to_owned(),
        };
        command.env("HOME", self.home.path());
        command.env("XDG_RUNTIME_DIR", outside);
        let output = command.output().expect("manyview");
        match output.status.success() {
            true => Ok(()),
            false => Err(String::from_utf8_lossy(&output.stderr).into_owned()),
        }
    }

    /// Ends the program, and returns what was told.
    fn end(mut self) -> String {
        let child = self.child.take().expect("it runs");
        // It is forwarded to the program.
        let pid = rustix::process::Pid::from_child(&child);
        let _ = rustix::process::kill_process(pid, rustix::process::Signal::TERM);
        let output = child.wait_with_output().expect("ended");
        String::from_utf8_lossy(&output.stderr).into_owned()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.child {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn home() -> TempDir {
    let home = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(home.path().join("pictures")).expect("a folder");
    home
}

/// Starts a program in one of the ways, reaches it from outside, and looks at its views.
fn check(container: Container, shown: &Shown, class: &str) {
    let what = format!("{class} in {container:?} on {:?}", shown.desk);
    let home = home();
    // A container can be given a folder only where it is.
    std::fs::create_dir_all(home.path().join(".cache/manyview")).expect("a folder");
    let sockets = home.path().join(".cache/manyview/sockets");
    std::fs::create_dir(&sockets).expect("a folder");
    std::fs::set_permissions(
        &sockets,
        std::os::unix::fs::PermissionsExt::from_mode(0o700),
    )
    .expect("a mode");
    let mut program = words(container, home.path(), shown);
    program.push(shown.program(class));
    let running = Running::start(shown, home, &program);
    let picture = running.home.path().join("pictures/views.png");
    let picture = picture.to_str().expect("UTF-8").to_owned();
    let limit = Instant::now() + LIMIT;
    while let Err(told) = running.ctl(shown, &["capture", &picture, "--what", "atlas"]) {
        assert!(Instant::now() < limit, "{what}: {told}{}", running.end());
        std::thread::sleep(Duration::from_millis(200));
    }
    let views = rgb(Path::new(&picture));
    let width = views.width() / 3;
    let tile =
        |view| image::imageops::crop_imm(&views, view * width, 0, width, views.height()).to_image();
    let [left, own, right] = [0, 1, 2].map(tile);
    assert!(
        left != own && own != right,
        "{what}: the views are the same"
    );
    let told = running.end();
    assert!(!told.contains("without the layer"), "{what}: {told}");
    eprintln!("{what}: passed");
}

#[test]
#[ignore = "packages and another /usr: make test-launch"]
fn ways_all_show_views_and_are_reached_from_outside() {
    library();
    for desk in [Desk::X11, Desk::XWayland, Desk::Wayland] {
        let shown = Shown::new(desk);
        for container in [Container::None, Container::OtherUsr, Container::Closed] {
            for class in CLASSES {
                check(container, &shown, class);
            }
        }
    }
}

#[test]
#[ignore = "packages and another /usr: make test-launch"]
fn ways_without_the_layer_are_one_line_that_names_the_remedy() {
    library();
    let shown = Shown::new(Desk::X11);
    let told = |home: TempDir, program: &[String]| {
        let running = Running::start(&shown, home, program);
        std::thread::sleep(Duration::from_secs(5));
        running.end()
    };
    // The home alone: the layer's folder is not shown.
    let home_folder = home();
    let mut program = words(Container::OtherUsr, home_folder.path(), &shown);
    let target = target_folder().parent().expect("a target folder");
    let at = program.iter().position(|word| Path::new(word) == target);
    program.drain(at.expect("the folder") - 1..=at.expect("the folder") + 1);
    program.push(shown.program(CLASSES[0]));
    let said = told(home_folder, &program);
    let lines: Vec<_> = said
        .lines()
        .filter(|line| line.contains("without the layer"))
        .collect();
    assert_eq!(lines.len(), 1, "{said}");
    assert!(
        lines[0].contains("its container does not show")
            && lines[0].contains("give it that folder"),
        "{said}"
    );
    // A script that clears the environment.
    let program = ["env", "-u", "LD_PRELOAD", &shown.program(CLASSES[0])].map(str::to_owned);
    let said = told(home(), &program);
    let lines: Vec<_> = said
        .lines()
        .filter(|line| line.contains("without the layer"))
        .collect();
    assert_eq!(lines.len(), 1, "{said}");
    assert!(lines[0].contains("LD_PRELOAD was taken"), "{said}");
}
