//! No machine or program makes the layer end a program: it works, or one line says why not.

use crate::support::{
    Compiled, bare, compiled, demo, has, layered, library, manyview, rgb, screen, succeed,
};
use std::path::Path;
use std::process::{Command, Output};
use tempfile::{TempDir, tempdir};

/// A command started by another one, with the same arguments and variables.
fn inside(wrapper: &[&str], command: &Command) -> Command {
    let mut outer = Command::new(wrapper[0]);
    outer
        .args(&wrapper[1..])
        .arg(command.get_program())
        .args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => outer.env(name, value),
            None => outer.env_remove(name),
        };
    }
    outer
}

/// Runs a program on the tests' screen; returns its status and stderr. A signal, or 20 seconds, always fails.
#[track_caller]
fn run(command: &mut Command) -> (i32, String) {
    let screen = screen();
    let mut command = inside(&["timeout", "-k", "2", "20"], command);
    let Output { status, stderr, .. } = screen.give(&mut command).output().expect("it starts");
    let stderr = String::from_utf8_lossy(&stderr).into_owned();
    // timeout returns 128 plus the program's signal, and 124 or 137 where it ended the program itself.
    let code = status.code().filter(|code| *code < 124);
    (
        code.unwrap_or_else(|| panic!("{command:?}: {status}\n{stderr}")),
        stderr,
    )
}

/// Our own lines; other libraries may write to stderr as well.
fn ours(stderr: &str) -> Vec<&str> {
    stderr
        .lines()
        .filter(|line| line.starts_with("manyview: "))
        .collect()
}

/// A folder, and the paths of a report and a picture in it.
fn files() -> (TempDir, String, String) {
    let folder = tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let (report, picture) = (at("report.json"), at("picture.png"));
    (folder, report, picture)
}

fn report(path: &str) -> serde_json::Value {
    let text = std::fs::read_to_string(path).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

/// Checks that the program drew the same last frame as without the layer.
#[track_caller]
fn unharmed(command: &mut Command, name: &str, variables: &[(&str, &str)]) -> String {
    let (_folder, _, picture) = files();
    let arguments = [
        "--frames", "2", "--size", "300x220", "--check", "--dump", &picture,
    ];
    let screen = screen();
    let mut expected = bare(demo(name));
    expected.envs(variables.iter().copied()).args(arguments);
    succeed(screen.give(&mut expected));
    let without = rgb(Path::new(&picture));
    std::fs::remove_file(&picture).expect("removed");
    let (code, stderr) = run(command.envs(variables.iter().copied()).args(arguments));
    assert_eq!(code, 0, "{command:?}: {stderr}");
    let with = rgb(Path::new(&picture));
    assert_eq!(
        manyview::metric::pixels_over(&without, &with, 0),
        0,
        "{command:?}: the frame differs; {stderr}"
    );
    stderr
}

/// OpenGL 2.1: no geometry shaders, no array textures of the core. Every strategy draws, or names what it falls back to.
#[test]
fn a_driver_that_says_it_is_old() {
    for version in ["2.1", "1.4"] {
        let variables = [("MESA_GL_VERSION_OVERRIDE", version)];
        for strategy in [
            "auto",
            "replay",
            "instanced",
            "geometry",
            "depth-image",
            "occlusion",
            "hybrid",
        ] {
            let (_folder, file, _) = files();
            let options = [("VIEWS", "5"), ("STRATEGY", strategy), ("REPORT", &*file)];
            let mut command = layered(demo("gears"), &options);
            let stderr = unharmed(&mut command, "gears", &variables);
            let off = ours(&stderr);
            let named = if Path::new(&file).is_file() {
                let report = report(&file);
                let by = |way: &str| report["draws"][way].as_u64().unwrap_or_default();
                assert_eq!(
                    (by("geometry"), by("instanced")),
                    (0, 0),
                    "{version} {strategy}: {report}"
                );
                // A strategy that is asked for and not available: the report has the reason.
                let reasons = report["fallbacks"]
                    .as_object()
                    .map_or(0, serde_json::Map::len);
                let noted = report["notes"].as_array().is_some_and(|notes| {
                    let told = |note: &serde_json::Value| note.as_str().map(str::to_owned);
                    let mut notes = notes.iter().filter_map(told);
                    notes.any(|note| note.starts_with("all views are drawn: "))
                });
                match strategy {
                    "auto" | "replay" => true,
                    "depth-image" | "occlusion" | "hybrid" => noted,
                    _ => reasons > 0,
                }
            } else {
                false
            };
            assert!(named || off.len() == 1, "{version} {strategy}: {stderr}");
        }
    }
}

/// The command reports it before the program starts, or the layer reports it and the program runs on.
#[test]
fn more_views_than_the_driver_has_layers() {
    let (_folder, file, _) = files();
    // 2048 layers are enough; the window is too large for a texture of this driver to hold it once per view.
    for (views, layout, size) in [
        ("256", "layers", "1900x1100"),
        ("256", "side-by-side", "1900x1100"),
    ] {
        let options = [("VIEWS", views), ("ATLAS", layout), ("REPORT", &*file)];
        let mut command = layered(demo("gears"), &options);
        command.args(["--frames", "2", "--size", size]);
        // Limits the address space, so that a driver that takes the memory does not take the machine's.
        let (code, stderr) = run(&mut inside(&["prlimit", "--as=3000000000", "--"], &command));
        assert_eq!(code, 0, "{layout}: {stderr}");
        assert_eq!(ours(&stderr).len(), 1, "{layout}: one line: {stderr}");
    }
}

#[test]
fn a_closed_stderr_is_no_reason_to_end() {
    let program = demo("gears");
    for (name, value) in [
        ("MANYVIEW_VIEWS", "5"),
        ("MANYVIEW_VIEWS", "none"),
        ("MESA_GL_VERSION_OVERRIDE", "1.4"),
    ] {
        let script = r#"exec "$0" --frames 2 2>&-"#;
        let mut command = layered("sh", &[]);
        command.args(["-c", script]).arg(&program).env(name, value);
        let (code, _) = run(&mut command);
        assert_eq!(code, 0, "{name}={value}");
    }
}

#[test]
fn wrong_variables_are_one_line_and_the_program_runs() {
    let mut command = layered(demo("gears"), &[("VIEWS", "0")]);
    let stderr = unharmed(&mut command, "gears", &[]);
    assert_eq!(ours(&stderr).len(), 1, "{stderr}");
}

/// A program that looks for GL without linking it finds none through the layer, and nothing is written.
#[test]
fn a_program_without_gl() {
    let program = compiled("nogl", Compiled::Program, &["-ldl"]);
    assert_eq!(run(&mut bare(&program)).0, 0, "without the layer");
    let (code, stderr) = run(&mut layered(&program, &[("VIEWS", "5")]));
    assert_eq!((code, &*stderr), (0, ""));
    library();
    let (code, stderr) = run(manyview().args(["run", "--"]).arg(&program));
    assert_eq!((code, &*stderr), (0, ""));
}

/// Like libmujoco's loader: the first exported name that it finds decides which window system it assumes.
#[test]
fn a_program_that_asks_for_every_window_system() {
    let program = compiled("half", Compiled::Program, &["-ldl"]);
    assert_eq!(run(&mut bare(&program)).0, 0, "without the layer");
    let (code, stderr) = run(&mut layered(&program, &[("VIEWS", "5")]));
    assert_eq!((code, &*stderr), (0, ""));
}

/// A program that links libGL and never makes a context.
#[test]
fn a_program_that_never_draws() {
    let (code, stderr) = run(layered(demo("gears"), &[("VIEWS", "5")]).arg("--help"));
    assert_eq!((code, &*stderr), (0, ""));
    let (code, _) = run(layered(demo("gears"), &[("VIEWS", "5")]).arg("--no-such-option"));
    assert_eq!(code, 2, "the program's own status");
}

#[test]
fn helpers_of_a_shell_get_the_layer_too() {
    let (folder, ..) = files();
    library();
    let script = r#"true | cat && "$0" --frames 1 && "$0" --frames 1 --api egl && echo done"#;
    let file = folder.path().join("report.json");
    let screen = screen();
    let mut command = manyview();
    command.args(["run", "--views", "5", "--report"]).arg(&file);
    command.args(["--", "sh", "-c", script]).arg(demo("gears"));
    let output = succeed(screen.give(&mut command));
    assert_eq!(output.stdout, b"done\n");
    assert_eq!(report(file.to_str().expect("UTF-8"))["frames"], 1);
}

#[test]
fn programs_started_by_programs() {
    let program = compiled("nogl", Compiled::Program, &["-ldl"]);
    let (_folder, file, _) = files();
    let options = [("VIEWS", "5"), ("REPORT", &*file)];
    let mut command = layered(&program, &options);
    command.arg(demo("gears")).args(["--frames", "3"]);
    let (code, stderr) = run(&mut command);
    assert_eq!((code, &*stderr), (0, ""));
    assert_eq!(report(&file)["frames"], 3);
}

#[test]
fn a_program_that_forks_while_it_draws() {
    let program = compiled("forks", Compiled::Program, &["-lGL", "-lX11"]);
    let (_folder, file, _) = files();
    let options = [("VIEWS", "5"), ("REPORT", &*file)];
    let (code, stderr) = run(&mut layered(&program, &options));
    assert_eq!((code, &*stderr), (0, ""));
    assert_eq!(report(&file)["frames"], 2);
}

/// The class of an ELF file, 1 for 32 bits and 2 for 64; none where there is no such file.
fn class(path: &Path) -> Option<u8> {
    let head = std::fs::read(path).ok()?;
    head.starts_with(b"\x7fELF").then(|| head[4])
}

/// apitrace's own wrapper, before ours and after it.
#[test]
fn beside_another_wrapper() {
    if !has("apitrace") {
        return;
    }
    let roots = ["/usr/lib", "/usr/local/lib"].map(Path::new);
    let wrapper = roots.iter().flat_map(|root| {
        let inside = std::fs::read_dir(root).into_iter().flatten().flatten();
        inside.map(|entry| entry.path()).chain([root.to_path_buf()])
    });
    let wrapper = wrapper
        .map(|folder| folder.join("apitrace/wrappers/glxtrace.so"))
        .find(|path| class(path).is_some_and(|of| Some(of) == class(&library())));
    let Some(wrapper) = wrapper else {
        return eprintln!("skipped: no glxtrace.so");
    };
    let ours = library();
    for (first, second) in [(&ours, &wrapper), (&wrapper, &ours)] {
        let (folder, file, picture) = files();
        let trace = folder.path().join("a.trace");
        let options = [
            ("VIEWS", "5"),
            ("REPORT", &*file),
            ("CAPTURE_OUT", &*picture),
            ("CAPTURE_FRAMES", "2"),
        ];
        let mut command = layered(demo("gears"), &options);
        let preload = format!("{}:{}", first.display(), second.display());
        command
            .env("LD_PRELOAD", &preload)
            .env("TRACE_FILE", &trace);
        let (code, stderr) = run(command.args(["--frames", "3", "--size", "300x220"]));
        assert_eq!(code, 0, "{preload}: {stderr}");
        assert!(trace.is_file(), "{preload}: not recorded: {stderr}");
        assert_eq!(report(&file)["frames"], 3, "{preload}");
        assert_eq!(rgb(Path::new(&picture)).dimensions(), (300, 220));
    }
}

/// Exported names are those of GL and its window systems, and dlsym; no other can come between a program and its libraries.
#[test]
fn only_hooked_names_are_exported() {
    if !has("nm") {
        return;
    }
    let output = succeed(bare("nm").args(["-D", "--defined-only"]).arg(library()));
    let text = String::from_utf8(output.stdout).expect("text");
    let names: Vec<_> = text
        .lines()
        .filter_map(|line| line.split_whitespace().last())
        .collect();
    assert!(names.len() > 700, "{} names", names.len());
    let api = |name: &str| {
        let mut rest = ["glX", "egl", "OSMesa", "gl"]
            .iter()
            .filter_map(|prefix| name.strip_prefix(prefix));
        rest.any(|rest| rest.starts_with(|c: char| c.is_ascii_uppercase()))
    };
    let others: Vec<_> = names
        .iter()
        .filter(|name| !api(name) && **name != "dlsym")
        .collect();
    assert!(others.is_empty(), "{others:?}");
    assert!(names.contains(&"dlsym") && names.contains(&"glXSwapBuffers"));
}
