//! Shared by the tests: paths of the binaries, a screen, demos bare and under the layer, pictures.

pub(crate) mod near;
pub(crate) mod play;
pub(crate) mod share;
pub(crate) mod views;
pub(crate) mod wayland;
pub(crate) mod x;

use image::{ImageBuffer, RgbImage, Rgba};
use manyview::config::OPTIONS;
use manyview::launch::{LaunchError, Xvfb};
use manyview::model::{Corner, Surface, triangles};
use manyview::volume::{Triangle, Vertex};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// An 8-bit picture, row 0 on top.
pub(crate) type Picture = ImageBuffer<Rgba<u8>, Vec<u8>>;

/// The folder with `manyview` and `libmanyview.so`, of the profile that the tests are built in.
pub(crate) fn target_folder() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_manyview"))
        .parent()
        .expect("a binary lies in a folder")
}

/// Whether the programs of the tests and the layer in them have 32 bits, which `make test-32` asks for.
pub(crate) fn is_32_bit() -> bool {
    std::env::var("MANYVIEW_TESTS_BITS").is_ok_and(|bits| bits == "32")
}

/// The layer's library. `make check-shadow` names another one.
pub(crate) fn library() -> PathBuf {
    if let Some(path) = std::env::var_os("MANYVIEW_TESTS_LIBRARY") {
        return path.into();
    }
    let folder = target_folder();
    let (path, target) = match (is_32_bit(), folder.parent(), folder.file_name()) {
        (true, Some(all), Some(profile)) => {
            let folder = all.join("i686-unknown-linux-gnu").join(profile);
            (folder.join("libmanyview.so"), "build-32")
        }
        _ => (folder.join("libmanyview.so"), "build"),
    };
    assert!(
        path.is_file(),
        "{} is missing: run `make {target}` first",
        path.display()
    );
    path
}

/// A demo program of `examples/`, such as `gears`.
pub(crate) fn demo(name: &str) -> PathBuf {
    let target = if is_32_bit() { "demos-32" } else { "demos" };
    let path = target_folder().with_file_name(target).join(name);
    assert!(
        path.is_file(),
        "{} is missing: run `make {target}` first",
        path.display()
    );
    path
}

/// The command without the caller's own settings.
pub(crate) fn manyview() -> Command {
    let mut command = without_layer(Command::new(env!("CARGO_BIN_EXE_manyview")));
    // `run` without a display would show on the panel of whoever runs the tests.
    command.env("MANYVIEW_DISPLAY", "huebner8");
    command
}

/// Runs the command and returns exit status, stdout and stderr.
pub(crate) fn run(command: &mut Command) -> (i32, String, String) {
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().expect("the command starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (
        status.code().expect("an exit status"),
        text(stdout),
        text(stderr),
    )
}

/// Checks that the arguments are refused with one line that holds `part`.
#[track_caller]
pub(crate) fn refused(arguments: &[&str], status: i32, part: &str) {
    let (code, stdout, stderr) = run(manyview().args(arguments));
    assert_eq!(code, status, "{arguments:?}: {stderr}");
    assert!(stderr.contains(part), "{arguments:?}: {stderr}");
    assert_eq!(stderr.lines().count(), 1, "one line: {stderr}");
    assert_eq!(stdout, "", "nothing on stdout");
}

/// A program without the caller's own settings.
pub(crate) fn bare(program: impl AsRef<std::ffi::OsStr>) -> Command {
    without_layer(Command::new(program))
}

/// What is preloaded for the layer: the library, and before it the runtime of a sanitizer that watches it, if there is one.
pub(crate) fn preloaded() -> String {
    let library = library().display().to_string();
    match std::env::var("MANYVIEW_TESTS_RUNTIME") {
        Ok(first) => format!("{first}:{library}"),
        Err(_) => library,
    }
}

/// A program with the layer preloaded, by variables only. `options` are names without `MANYVIEW_` and values.
pub(crate) fn layered(program: impl AsRef<std::ffi::OsStr>, options: &[(&str, &str)]) -> Command {
    let mut command = bare(program);
    command.env("LD_PRELOAD", preloaded());
    command.envs(
        options
            .iter()
            .map(|(name, value)| (format!("MANYVIEW_{name}"), value)),
    );
    command
}

fn without_layer(mut command: Command) -> Command {
    command
        .env_remove("LD_PRELOAD")
        .env_remove("MANYVIEW_DISABLE")
        .env_remove("MANYVIEW_LIBRARY")
        .env("XDG_CONFIG_HOME", "/dev/null/none")
        // Tests run side by side, and llvmpipe of Mesa 22.3 may free a fence while the thread that signals it still unlocks it: this
        // damages the heap, with or without the layer.
        .env("LP_NUM_THREADS", "0")
        // Most programs of the tests draw a few frames, and the oracle takes a sixth less time without optimised shaders.
        .env("GALLIVM_PERF", "nopt");
    for spec in OPTIONS {
        for name in spec.variables() {
            command.env_remove(name);
        }
    }
    // Pictures are compared without text over them.
    command.env("MANYVIEW_OSD", "off");
    // Frames can be compared where cameras stand still.
    command.env("MANYVIEW_AUTO_DEPTH", "0");
    // `auto` would try strategies and keep the outcome for the user; tests/auto.rs asks for it.
    command.env("MANYVIEW_STRATEGY", "replay");
    command
}

/// Adds a screen: the one of this test process, started with the first call.
///
/// It ends with the returned [`Screen`]s: keep one in a variable as long as programs run.
pub(crate) fn screen() -> Screen {
    let mut shared = SHARED
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    if shared.users == 0 {
        shared.server = Some(Xvfb::start().expect("Xvfb; `make packages` installs it"));
    }
    shared.users += 1;
    Screen {
        display: shared
            .server
            .as_ref()
            .expect("just started")
            .display()
            .to_owned(),
        own: None,
    }
}

/// Adds a screen of its own: the picture of a window is undefined where another one covers it.
pub(crate) fn own_screen() -> Screen {
    Screen::own(Xvfb::start())
}

/// The same of this width and height, pixels.
pub(crate) fn sized_screen(size: (u16, u16)) -> Screen {
    Screen::own(Xvfb::sized(size))
}

static SHARED: Mutex<Shared> = Mutex::new(Shared {
    users: 0,
    server: None,
});

struct Shared {
    users: usize,
    server: Option<Xvfb>,
}

/// A share in the screen of this process. The last share to be dropped ends the server: statics are never dropped.
pub(crate) struct Screen {
    display: String,
    own: Option<Xvfb>,
}

impl Screen {
    fn own(server: Result<Xvfb, LaunchError>) -> Self {
        let server = server.expect("Xvfb; `make packages` installs it");
        Self {
            display: server.display().to_owned(),
            own: Some(server),
        }
    }

    /// The value of `DISPLAY`.
    pub(crate) fn display(&self) -> &str {
        &self.display
    }

    /// Lets a program use this screen.
    pub(crate) fn give<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        command
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if self.own.is_some() {
            return;
        }
        let mut shared = SHARED
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        shared.users -= 1;
        if shared.users == 0 {
            shared.server = None;
        }
    }
}

/// Runs a command to its end; any status but 0 fails the test with the command's output.
#[track_caller]
pub(crate) fn succeed(command: &mut Command) -> Output {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(
        output.status.success(),
        "{command:?}\n{}\n{}{}",
        output.status,
        text(&output.stdout),
        text(&output.stderr)
    );
    output
}

/// Reads a picture as 8-bit RGBA.
#[track_caller]
pub(crate) fn read_png(path: &Path) -> Picture {
    image::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgba8()
}

/// Runs `demo ARGUMENTS --dump PNG` without the layer and reads its picture.
#[track_caller]
pub(crate) fn dump(demo_name: &str, arguments: &[&str]) -> Picture {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out.png");
    let screen = screen();
    succeed(
        screen.give(
            bare(demo(demo_name))
                .args(arguments)
                .arg("--dump")
                .arg(&out),
        ),
    );
    read_png(&out)
}

/// Runs `demo ARGUMENTS` under the layer and reads the picture of one frame.
#[track_caller]
pub(crate) fn capture(demo_name: &str, arguments: &[&str], frame: u64, layer: &[&str]) -> Picture {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out.png");
    library();
    let screen = screen();
    let mut command = manyview();
    command
        .arg("capture")
        .arg("--out")
        .arg(&out)
        .args(["--frame", &frame.to_string()])
        .args(layer);
    succeed(screen.give(command.arg("--").arg(demo(demo_name)).args(arguments)));
    read_png(&out)
}

/// Reads a picture as 8-bit RGB.
#[track_caller]
pub(crate) fn rgb(path: &Path) -> RgbImage {
    image::open(path)
        .unwrap_or_else(|error| panic!("{}: {error}", path.display()))
        .into_rgb8()
}

/// The stdout of a program that runs without a screen.
pub(crate) fn lines(command: &mut Command) -> String {
    let output = succeed(command.env_remove("DISPLAY"));
    String::from_utf8(output.stdout).expect("text")
}

/// The first and the last column of one colour in the middle row of a view; `all` has `views` of them side by side.
pub(crate) fn extent(all: &RgbImage, views: u32, view: u32, colour: [u8; 3]) -> [f64; 2] {
    let width = all.width() / views;
    let at = |x: u32| all.get_pixel(view * width + x, all.height() / 2).0;
    let mut lit = (0..width).filter(|&x| at(x) == colour);
    let left = lit.next().expect("it is drawn");
    [left, lit.next_back().unwrap_or(left)].map(f64::from)
}

/// A folder in `target/` for files that a person may look at after a test; created if need be.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let path = target_folder().with_file_name(name);
    std::fs::create_dir_all(&path).expect("a folder in target");
    path
}

/// Builds `tests/support/c/NAME.c`, a library to preload or a program, with the C compiler that builds the demos.
pub(crate) fn compiled(name: &str, kind: Compiled, libraries: &[&str]) -> PathBuf {
    let source = Path::new("tests/support/c").join(name).with_extension("c");
    built(name, &[source.as_path()], kind, libraries)
}

/// The folder, or a folder in it, of programs and libraries that the tests build.
pub(crate) fn programs_folder(inside: &str) -> PathBuf {
    let folder = match is_32_bit() {
        true => "test-programs-32",
        false => "test-programs",
    };
    scratch(&format!("{folder}/{inside}"))
}

/// Builds a library or a program from C files of the repository; `more` are the compiler's last arguments.
pub(crate) fn built(name: &str, sources: &[&Path], kind: Compiled, more: &[&str]) -> PathBuf {
    let folder = programs_folder("");
    let out = match kind {
        Compiled::Library => folder.join(format!("{name}.so")),
        Compiled::Program => folder.join(name),
    };
    // Tests run side by side, also as processes: each builds its own and renames it, which is atomic.
    let own = tempfile::Builder::new()
        .tempfile_in(&folder)
        .expect("a file")
        .into_temp_path();
    let mut command = Command::new("cc");
    command.args(["-O1", "-Wall", "-Wextra"]);
    command.args(is_32_bit().then_some("-m32"));
    if let Compiled::Library = kind {
        command.args(["-shared", "-fPIC"]);
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    command.arg("-o").arg(&own);
    command.args(sources.iter().map(|source| root.join(source)));
    succeed(command.args(more));
    own.persist(&out).expect("renamed");
    out
}

/// The output of [`compiled`].
#[derive(Clone, Copy)]
pub(crate) enum Compiled {
    Library,
    Program,
}

/// Makes a command write the pixels of its X window after a swap (counted from 1), to be read by [`window_picture`].
///
/// This avoids glReadPixels, which Mesa answers unresolved for multisampled windows.
pub(crate) fn watch_window(command: &mut Command, library: &Path, frame: u32, out: &Path) {
    let before = command
        .get_envs()
        .find(|(name, _)| *name == "LD_PRELOAD")
        .and_then(|(_, value)| value)
        .map(|value| value.to_os_string());
    // First in the list, so that its swap is called before the layer's and reads the window after it.
    let mut preload = library.as_os_str().to_os_string();
    if let Some(before) = before {
        preload.push(":");
        preload.push(before);
    }
    command
        .env("LD_PRELOAD", preload)
        .env("WINDOW_FRAME", frame.to_string())
        .env("WINDOW_DUMP", out);
}

/// The library for [`watch_window`].
pub(crate) fn window_library() -> PathBuf {
    compiled("window", Compiled::Library, &["-lX11", "-ldl"])
}

/// Reads the picture that [`watch_window`] had written: a binary PPM.
#[track_caller]
pub(crate) fn window_picture(path: &Path) -> RgbImage {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = bytes.splitn(4, |&byte| byte == b'\n');
    assert_eq!(lines.next(), Some(&b"P6"[..]), "a binary PPM");
    let size = std::str::from_utf8(lines.next().expect("a size")).expect("text");
    let (width, height) = size.split_once(' ').expect("two numbers");
    assert_eq!(lines.next(), Some(&b"255"[..]), "8 bits");
    let data = lines.next().expect("pixels").to_vec();
    RgbImage::from_raw(
        width.parse().expect("a width"),
        height.parse().expect("a height"),
        data,
    )
    .expect("all pixels")
}

/// Whether a program of an optional package is installed; prints a line if not.
pub(crate) fn has(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&path).any(|folder| folder.join(program).is_file());
    if !found {
        eprintln!("skipped: {program} is not installed (make packages)");
    }
    found
}

/// Starts a program that never ends by itself, waits until a file is there, and ends only this program.
#[track_caller]
pub(crate) fn run_until(command: &mut Command, file: &Path) {
    let mut child = command
        .spawn()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let limit = Instant::now() + Duration::from_secs(60);
    let mut ended = None;
    while !file.is_file() && ended.is_none() && Instant::now() < limit {
        std::thread::sleep(Duration::from_millis(10));
        ended = child.try_wait().expect("a child");
    }
    let _ = child.kill();
    let _ = child.wait();
    assert!(
        file.is_file(),
        "{command:?}: no {} ({ended:?})",
        file.display()
    );
}

/// Records the calls of a program with apitrace, cut to the frames 0 to 30. The program is interrupted after some seconds.
pub(crate) fn record(
    screen: &Screen,
    program: &[&str],
    seconds: u32,
    api: &str,
    folder: &Path,
) -> PathBuf {
    let (full, cut) = (folder.join("full.trace"), folder.join("cut.trace"));
    let mut command = bare("timeout");
    command
        .args(["-k", "5", "-s", "INT", &seconds.to_string()])
        .args(["apitrace", "trace", "-a", api, "-o"])
        .arg(&full)
        .args(program)
        // Games find no sound card and need none.
        .env("SDL_AUDIODRIVER", "dummy")
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    // The program is interrupted, so only the trace shows whether this worked.
    let _ = screen.give(&mut command).status().expect("timeout");
    let mut trim = bare("apitrace");
    trim.args(["trim", "--frames=0-30", "-o"])
        .arg(&cut)
        .arg(&full);
    succeed(&mut trim);
    cut
}

/// The triangles of a model, in the form that the volumetric display takes.
pub(crate) fn geometry(scene: &[Surface]) -> Vec<Triangle> {
    let vertex = |corner: Corner| Vertex {
        at: corner.at,
        colour: corner.colour,
    };
    triangles(scene).map(|solid| solid.map(vertex)).collect()
}
