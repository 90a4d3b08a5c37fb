//! A program that runs without the layer runs under it: whatever its callbacks, threads, descriptors, libraries and files are. Each program
//! prints what it can see, and that is the same with the layer as without it.

use crate::support::{
    Compiled, Screen, bare, built, demo, layered, manyview, own_screen, programs_folder, screen,
    succeed,
};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::tempdir;

/// What a program has written, and how it has ended.
struct Ran {
    stdout: String,
    stderr: String,
    end: String,
}

impl Ran {
    fn visible(&self) -> (&str, &str) {
        (&self.stdout, &self.end)
    }

    /// The layer's own lines; other libraries may write to stderr as well.
    fn sentences(&self) -> Vec<&str> {
        let lines = self.stderr.lines();
        lines
            .filter(|line| line.starts_with("manyview: "))
            .collect()
    }
}

/// Runs a program for at most 20 seconds.
fn run(command: &Command, screen: &Screen) -> Ran {
    let mut limited = Command::new("timeout");
    limited
        .args(["-k", "2", "20"])
        .arg(command.get_program())
        .args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => limited.env(name, value),
            None => limited.env_remove(name),
        };
    }
    // The driver takes compiled shaders from this cache, which spares it much of its stack.
    limited.env("MESA_SHADER_CACHE_DISABLE", "1");
    let output = screen.give(&mut limited).output();
    let Output {
        status,
        stdout,
        stderr,
    } = output.expect("it starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ran {
        stdout: text(&stdout),
        stderr: text(&stderr),
        end: status.to_string(),
    }
}

/// Checks that a program prints the same and ends in the same way under the layer, whose window shows the program's own view.
#[track_caller]
fn same(program: &Path, words: &[&str], variables: &[(&str, &str)]) -> Ran {
    let screen = own_screen();
    let with = |mut command: Command| {
        command.args(words).envs(variables.iter().copied());
        run(&command, &screen)
    };
    let expected = with(bare(program));
    assert_eq!(
        expected.end, "exit status: 0",
        "without the layer: {words:?}: {}{}",
        expected.stdout, expected.stderr
    );
    let options = [("VIEWS", "3"), ("STRATEGY", "replay"), ("OUTPUT", "view:1")];
    let actual = with(layered(program, &options));
    assert_eq!(
        expected.visible(),
        actual.visible(),
        "{words:?} {variables:?}: {}",
        actual.stderr
    );
    actual
}

/// Builds a program of `tests/harm` that draws in the windows of `tests/hosts`.
fn windowed(source: &str, more: &[&str]) -> PathBuf {
    let own = Path::new("tests/harm").join(source);
    let name = format!("harm-{}", source.split('.').next().unwrap_or(source));
    let mut libraries = vec!["-lGL", "-lX11"];
    libraries.extend(more);
    built(
        &name,
        &[own.as_path(), Path::new("tests/hosts/window.c")],
        Compiled::Program,
        &libraries,
    )
}

#[test]
fn a_list_name_is_made_while_a_list_is_compiled() {
    let names = windowed("names.c", &[]);
    for way in ["compile", "execute", "empty"] {
        for list in ["3", "20"] {
            same(&names, &[way, list], &[]);
        }
    }
}

#[test]
fn names_of_lists_end_with_the_highest_number() {
    let names = windowed("names.c", &[]);
    for list in [
        "0xffffffff",
        "0xfffffffe",
        "0xfffffffd",
        "0xfffffffc",
        "0xfffffff0",
    ] {
        same(&names, &["high", list], &[]);
    }
}

#[test]
fn a_program_may_use_any_name_for_a_list() {
    let names = windowed("names.c", &[]);
    for list in ["0xfffffffa", "0xfffffff0", "0x80000000"] {
        same(&names, &["taken", list], &[]);
    }
}

/// The layers of both contexts have textures, whose names the program takes.
#[test]
fn a_program_may_use_any_name_for_a_texture_in_contexts_that_share() {
    let shares = windowed("shares.c", &[]);
    for way in ["bind", "delete", "late"] {
        same(&shares, &[way], &[]);
    }
}

#[test]
fn a_program_may_use_any_name_for_other_objects() {
    let numbers = windowed("numbers.c", &[]);
    same(&numbers, &[], &[]);
}

/// Calls that the driver reports as wrong. The first of them have hooks that work on the layer.
const WRONG: [&str; 14] = [
    "draw", "elements", "clear", "pixels", "read", "blit", "bind", "buffer", "state", "link",
    "query", "begin", "list", "message",
];

#[test]
fn an_exception_leaves_the_debug_callback() {
    let throws = windowed("throws.cc", &["-lstdc++"]);
    for call in WRONG {
        same(&throws, &["throw", call], &[]);
    }
}

#[test]
fn a_jump_leaves_the_debug_callback() {
    let throws = windowed("throws.cc", &["-lstdc++"]);
    for call in WRONG {
        same(&throws, &["jump", call], &[]);
    }
}

fn threads() -> PathBuf {
    windowed("threads.c", &["-lpthread"])
}

#[test]
fn a_thread_is_cancelled_in_a_call() {
    for call in ["swap", "draw"] {
        same(&threads(), &["cancel", call], &[]);
    }
}

/// On softpipe: llvmpipe of Mesa 22.3 looks through the unfinished work of all contexts whenever one of them reads or writes a resource, while
/// their threads go on with it (`llvmpipe_flush_resource`), and crashes in one of ten runs with eight threads of 1000 frames.
#[test]
fn threads_draw_at_the_same_time() {
    let together = windowed("together.c", &["-lpthread"]);
    same(&together, &["8", "100"], &[("GALLIUM_DRIVER", "softpipe")]);
}

#[test]
fn a_thread_ends_in_the_debug_callback() {
    same(&threads(), &["exit"], &[]);
}

/// Variables with which the layer has something to say: when the program is loaded, and at its first context.
const SAYS: [&[(&str, &str)]; 2] = [
    &[("MANYVIEW_VIEWS", "0")],
    &[
        ("MESA_GL_VERSION_OVERRIDE", "2.1"),
        ("MESA_EXTENSION_OVERRIDE", "-GL_EXT_texture_array"),
    ],
];

#[track_caller]
fn silent(mode: &str) {
    let silent = windowed("silent.c", &[]);
    let folder = tempdir().expect("a folder");
    for variables in SAYS {
        let file = folder.path().join("file");
        let file = file.to_str().expect("UTF-8");
        let _ = std::fs::remove_file(file);
        same(&silent, &[mode, file], variables);
    }
}

#[test]
fn nobody_reads_stderr_any_more() {
    silent("broken");
}

#[test]
fn stderr_is_full() {
    silent("full");
}

#[test]
fn the_device_of_stderr_is_full() {
    silent("device");
}

#[test]
fn the_file_of_stderr_has_reached_its_limit() {
    silent("limit");
}

#[test]
fn a_terminal_stops_what_writes_to_stderr() {
    silent("terminal");
}

#[test]
fn stderr_is_closed() {
    silent("closed");
}

#[test]
fn a_file_of_the_program_has_the_number_of_stderr() {
    silent("number");
}

#[test]
fn files_of_the_layer_may_exceed_the_limit() {
    let silent = windowed("silent.c", &[]);
    let folder = tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    same(
        &silent,
        &["limit", &at("file")],
        &[("MANYVIEW_REPORT", &at("report.json"))],
    );
}

#[test]
fn what_cannot_be_shown_is_said_once() {
    let ran = same(&loads(), &["system"], SAYS[1]);
    assert_eq!(ran.sentences().len(), 1, "{}", ran.stderr);
}

const MESSAGES: [&str; 4] = ["callback", "log", "wrong", "state"];

#[test]
fn a_program_is_told_of_its_own_calls() {
    let messages = windowed("messages.c", &[]);
    for mode in MESSAGES {
        for kind in ["debug", "plain"] {
            same(&messages, &[mode, kind], &[]);
        }
    }
}

/// In such a context a wrong call may do anything.
#[test]
fn a_context_without_errors_gets_no_wrong_calls() {
    let messages = windowed("messages.c", &[]);
    for mode in ["callback", "log"] {
        same(&messages, &[mode, "plain"], &[("MESA_NO_ERROR", "1")]);
    }
}

fn loads() -> PathBuf {
    let source = Path::new("tests/harm/loads.c");
    built("harm-loads", &[source], Compiled::Program, &["-ldl"])
}

/// A folder with a libEGL.so and a libGLESv2.so of a program's own, and a plugin that is linked with them.
fn private() -> PathBuf {
    let folder = programs_folder("private");
    let library = |name: &str, source: &str, more: &[&str]| {
        let source = Path::new("tests/harm").join(source);
        let found = format!("-L{}", folder.display());
        let mut all = vec!["-Wl,-rpath,$ORIGIN", found.as_str()];
        all.extend(more);
        all.push("-ldl");
        built(
            &format!("private/{name}"),
            &[source.as_path()],
            Compiled::Library,
            &all,
        );
    };
    let gl = "-l:libGLESv2.so";
    library("libGLESv2", "private.c", &["-Wl,-soname,libGLESv2.so"]);
    library(
        "libEGL",
        "private.c",
        &["-DEGL", "-Wl,-soname,libEGL.so", gl],
    );
    library("loads-plugin", "loads.c", &["-DLINKED", "-l:libEGL.so", gl]);
    folder
}

#[track_caller]
fn own_libraries(mode: &str) {
    let folder = private();
    same(&loads(), &[mode, folder.to_str().expect("UTF-8")], &[]);
}

#[test]
fn a_program_opens_libraries_named_as_those_of_gl() {
    own_libraries("own");
}

#[test]
fn libraries_named_as_those_of_gl_draw_by_gl() {
    own_libraries("over");
}

#[test]
fn libraries_named_as_those_of_gl_are_used_beside_gl() {
    own_libraries("beside");
}

#[test]
fn libraries_named_as_those_of_gl_have_a_namespace_of_their_own() {
    own_libraries("space");
    own_libraries("spaces");
}

/// The utility library and GLEW have names that begin like those of OpenGL's libraries.
#[test]
fn a_plugin_bound_to_its_own_libraries_draws_by_the_utility_library() {
    let host = windowed("deep.c", &["-ldl"]);
    let plugin = built(
        "harm-deep-plugin",
        &[Path::new("tests/harm/deep.c")],
        Compiled::Library,
        &["-DPLUGIN", "-lGLU", "-lGL"],
    );
    let folder = tempdir().expect("a folder");
    let report = folder.path().join("report.json");
    same(
        &host,
        &[plugin.to_str().expect("UTF-8")],
        &[("MANYVIEW_REPORT", report.to_str().expect("UTF-8"))],
    );
    // Four frames of a clear and of a sphere in many strips.
    let draws = json(&report)["draws"]["replay"].as_u64();
    assert!(draws.is_some_and(|draws| draws > 8), "{draws:?}");
}

fn json(path: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(path).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

/// Whoever may write to the folder of a report may have put something else under the name by which it grows.
#[test]
fn a_report_replaces_no_other_file() {
    let folder = tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("precious"), "precious").expect("written");
    symlink("precious", at("report.json.tmp")).expect("a link");
    let report = at("report.json");
    same(
        &threads(),
        &["main"],
        &[("MANYVIEW_REPORT", report.to_str().expect("UTF-8"))],
    );
    let left = std::fs::read_to_string(at("precious")).expect("still there");
    assert_eq!(left, "precious");
    assert_eq!(json(&report)["frames"], 4);
}

#[test]
fn a_report_waits_for_nobody() {
    let folder = tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    succeed(Command::new("mkfifo").arg(at("report.json.tmp")));
    let report = at("report.json");
    same(
        &threads(),
        &["main"],
        &[("MANYVIEW_REPORT", report.to_str().expect("UTF-8"))],
    );
    assert_eq!(json(&report)["frames"], 4);
}

/// The layer takes little of the stack of a program that has 64 KiB of it. Mesa's compiler of shaders takes 50 KiB, so Mesa may not find shaders
/// in its cache. A large environment would take of the stack as well, and up to 8 KiB of it would be left out at random.
#[test]
fn a_small_stack_is_enough() {
    let screen = own_screen();
    for name in ["gears", "immediate", "shade"] {
        let mut command = layered("sh", &[("VIEWS", "5")]);
        command
            .args(["-c", "ulimit -s 64; exec setarch -R \"$0\" \"$@\""])
            .arg(demo(name))
            .args(["--frames", "3"])
            .env("MESA_SHADER_CACHE_DISABLE", "true");
        screen.give(&mut command);
        let set = command.get_envs();
        let set = set.filter_map(|(name, value)| Some((name.to_owned(), value?.to_owned())));
        let set: Vec<_> = set.collect();
        command.env_clear().envs(set);
        command.envs(std::env::vars_os().filter(|(name, _)| name == "PATH"));
        succeed(&mut command);
    }
}

#[test]
fn a_captured_picture_replaces_no_other_file() {
    let folder = tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("precious"), "precious").expect("written");
    symlink("precious", at("picture.png.tmp")).expect("a link");
    let screen = screen();
    let mut command = manyview();
    command
        .args(["capture", "--views", "3", "--frame", "2", "--out"])
        .arg(at("picture.png"))
        .arg("--")
        .arg(demo("gears"))
        .args(["--frames", "4"]);
    succeed(screen.give(&mut command));
    let left = std::fs::read_to_string(at("precious")).expect("still there");
    assert_eq!(left, "precious");
    let kind = std::fs::symlink_metadata(at("picture.png")).expect("a picture");
    assert!(kind.is_file(), "{kind:?}");
}
