//! Several programs of one launch write what the user asks for: each to files of its own, and the last one, or the one that began to write while
//! no other did, to the path that he has named.

use crate::support::{demo, layered, library, manyview, own_screen, screen, succeed};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

/// A program that waits for `>&3` to draw, another one that comes and goes meanwhile, and the end of the first one. `wait` is for its first file.
const AT_ONCE: &str = r#"
    mkfifo "$1/go"; "$0" --bench --size 64x48 <"$1/go" >/dev/null & exec 3>"$1/go"
    echo 1 >&3; until test -s "$1/$2"; do sleep 0.02; done
    "$0" --frames 2 --size 32x32
    echo 2 >&3; exec 3>&-; wait"#;

/// A program, which tells its process ID, and then another one.
const IN_TURN: &str = r#"sh -c 'echo $$; exec "$0" --frames 2' "$0"; "$0" --frames 3"#;

/// Frames of the reports in a folder, by the names of the files. The process ID in `told` is `PID` there.
fn reports(folder: &Path, told: &str) -> BTreeMap<String, u64> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let report = |path: &Path| {
        let text = std::fs::read_to_string(path).expect("a report");
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        json["frames"].as_u64().expect("a number")
    };
    entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy();
            let name = match told {
                "" => name.into_owned(),
                process => name.replace(process, "PID"),
            };
            (name, report(&path))
        })
        .collect()
}

/// The numbers of frames of the report at the path and of that of the other process.
fn at_once(mut command: Command, folder: &Path) -> [u64; 2] {
    command.args(["sh", "-c", AT_ONCE]).arg(demo("gears"));
    command.arg(folder).arg("report.json");
    succeed(screen().give(&mut command));
    let all = reports(folder, "");
    assert_eq!(all.len(), 2, "{all:?}");
    let other = all.keys().find(|name| *name != "report.json");
    let name = other.expect("another name");
    let process = name
        .strip_prefix("report.")
        .and_then(|n| n.strip_suffix(".json"));
    assert!(process.is_some_and(|n| n.parse::<u32>().is_ok()), "{name}");
    [all["report.json"], all[name]]
}

#[test]
fn programs_that_run_at_once_have_a_report_each() {
    library();
    let folder = tempdir().expect("a folder");
    let mut command = manyview();
    command.args(["run", "--views", "3", "--report"]);
    command.arg(folder.path().join("report.json")).arg("--");
    assert_eq!(at_once(command, folder.path()), [3, 2]);
}

#[test]
fn programs_without_the_launcher_have_a_report_each() {
    let [folder, runtime] = [(); 2].map(|()| tempdir().expect("a folder"));
    let report = folder.path().join("report.json");
    let options = [("VIEWS", "3"), ("REPORT", report.to_str().expect("UTF-8"))];
    let mut command = layered("env", &options);
    command.env("XDG_RUNTIME_DIR", runtime.path());
    assert_eq!(at_once(command, folder.path()), [3, 2]);
    // Another launch, without another program: the report is replaced.
    let mut again = layered(demo("gears"), &options);
    again.env("XDG_RUNTIME_DIR", runtime.path());
    succeed(screen().give(again.args(["--frames", "4"])));
    let all = reports(folder.path(), "");
    assert_eq!((all.len(), all["report.json"]), (2, 4), "{all:?}");
}

#[test]
fn a_program_that_ends_makes_room_for_the_next() {
    library();
    let folder = tempdir().expect("a folder");
    let mut expected = [("report.PID.json", 2), ("report.json", 3)].to_vec();
    // The second launch replaces the report of the first one, and leaves the other file.
    for launch in 0..2 {
        let mut command = manyview();
        command.args(["run", "--views", "3", "--report"]);
        command.arg(folder.path().join("report.json"));
        command.args(["--", "sh", "-c", IN_TURN]).arg(demo("gears"));
        let output = succeed(screen().give(&mut command));
        let told = String::from_utf8(output.stdout).expect("UTF-8");
        let all = reports(folder.path(), told.trim());
        let names: Vec<_> = all
            .iter()
            .map(|(name, frames)| (name.as_str(), *frames))
            .collect();
        assert_eq!(names, expected, "launch {launch}");
        let other = folder.path().join(format!("report.{}.json", told.trim()));
        std::fs::rename(other, folder.path().join("report.0.json")).expect("renamed");
        expected.insert(0, ("report.0.json", 2));
    }
}

#[test]
fn pictures_of_one_capture_are_of_one_program() {
    library();
    let folder = tempdir().expect("a folder");
    let screen = own_screen();
    let mut command = manyview();
    command.args([
        "capture", "--views", "3", "--output", "view:1", "--frames", "1..3", "--out",
    ]);
    command.arg(folder.path().join("a.png"));
    command.args(["--", "sh", "-c", AT_ONCE]).arg(demo("gears"));
    command.arg(folder.path()).arg("a-000001.png");
    succeed(screen.give(&mut command));
    for frame in 1..=3 {
        let file = folder.path().join(format!("a-{frame:06}.png"));
        let size = image::image_dimensions(&file).expect("a picture");
        assert_eq!(size, (64, 48), "frame {frame}");
    }
}

/// Frames of the reports of a launch of `gears`, two frames, and of a program of another name, three.
fn frames_of(options: &[&str], name: &str) -> Vec<u64> {
    library();
    let folder = tempdir().expect("a folder");
    let other = folder.path().join(name);
    std::fs::copy(demo("gears"), &other).expect("a copy");
    let mut command = manyview();
    command.args(["run", "--views", "3", "--report"]);
    command.arg(folder.path().join("report.json")).args(options);
    command.args(["--", "sh", "-c", r#""$0" --frames 2; "$1" --frames 3"#]);
    command.arg(demo("gears")).arg(&other);
    succeed(screen().give(&mut command));
    let mut frames: Vec<u64> = reports(folder.path(), "").into_values().collect();
    frames.sort_unstable();
    frames
}

#[test]
fn only_the_chosen_programs_of_a_launch_have_the_layer() {
    assert_eq!(frames_of(&[], "quake"), [2, 3]);
    assert_eq!(frames_of(&["--only", "quake"], "quake"), [3]);
    assert_eq!(frames_of(&["--except", "setup,quake"], "quake"), [2]);
    assert_eq!(frames_of(&[], "zenity"), [2], "a dialogue is left bare");
    assert_eq!(frames_of(&["--only", "gears,zenity"], "zenity"), [2, 3]);
    assert_eq!(frames_of(&["--only", "nothing"], "quake"), [0; 0]);
}

#[test]
fn a_dialogue_that_the_user_starts_has_the_layer() {
    library();
    let folder = tempdir().expect("a folder");
    let [program, report] = ["zenity", "report.json"].map(|name| folder.path().join(name));
    std::fs::copy(demo("gears"), &program).expect("a copy");
    let mut command = manyview();
    command
        .args(["run", "--views", "3", "--report"])
        .arg(&report);
    command.arg("--").arg(&program).args(["--frames", "2"]);
    succeed(screen().give(&mut command));
    assert_eq!(reports(folder.path(), "")["report.json"], 2);
}

/// A program of a launch whose environment a script has cleared.
#[test]
fn a_program_that_has_lost_the_layer_is_named() {
    library();
    let mut command = manyview();
    command.args(["run", "--views", "3", "--", "sh", "-c"]);
    command.arg("env -u LD_PRELOAD timeout 6 \"$0\" --frames 1000000 --size 32x32");
    command.arg(demo("gears"));
    let output = screen().give(&mut command).output().expect("it starts");
    let told = String::from_utf8_lossy(&output.stderr);
    let line = "draws by OpenGL without the layer: LD_PRELOAD was taken from its environment";
    assert_eq!(told.matches(line).count(), 1, "{told}");
    assert!(told.starts_with("manyview: gears (process "), "{told}");
}
