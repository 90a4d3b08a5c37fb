//! Programs of 64 and of 32 bits under one `manyview`: `make test-both`, which installs i386 packages. (The layer in 32-bit programs: `make test-32`.)

use crate::support::{manyview, rgb, run, screen, succeed, target_folder};
use manyview::metric::{Comparison, Gate};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::tempdir;

/// A demo program of each class.
fn demos(name: &str) -> [PathBuf; 2] {
    ["demos", "demos-32"].map(|folder| {
        let path = target_folder().with_file_name(folder).join(name);
        assert!(path.is_file(), "{}: run `make test-both`", path.display());
        path
    })
}

fn report(path: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(path).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
#[ignore = "i386 packages: make test-both"]
fn both_one_launch_serves_programs_of_both_classes() {
    let folder = tempdir().expect("a folder");
    let path = folder.path().join("report.json");
    let [wide, narrow] = demos("teapot");
    let mut command = manyview();
    command.args(["run", "--views", "3", "--report"]).arg(&path);
    let script = r#""$0" --frames 2 || exit 1; "$1" --frames 3; echo; echo "$LD_PRELOAD""#;
    command
        .args(["--", "sh", "-c", script])
        .args([wide, narrow]);
    let (code, told, stderr) = run(screen().give(&mut command));
    assert_eq!((code, &*stderr), (0, ""));
    assert!(told.ends_with("/by-class/$LIB/libmanyview.so\n"), "{told}");
    let mut frames = Vec::new();
    for entry in std::fs::read_dir(folder.path()).expect("a folder") {
        let report = report(&entry.expect("an entry").path());
        assert_eq!(report["gl_errors"], 0);
        frames.push((
            report["frames"].as_u64(),
            report["classes"]["scene"].as_u64() > Some(0),
        ));
    }
    frames.sort_unstable();
    assert_eq!(frames, [(Some(2), true), (Some(3), true)]);
}

#[test]
#[ignore = "i386 packages: make test-both"]
fn both_classes_give_the_same_pictures() {
    let folder = tempdir().expect("a folder");
    for name in ["teapot", "shade", "room"] {
        let pictures = demos(name).map(|demo| {
            let out = folder.path().join("views.png");
            let mut command = manyview();
            command.args([
                "capture", "--views", "3", "--what", "atlas", "--frame", "3", "--out",
            ]);
            command
                .arg(&out)
                .arg("--")
                .arg(&demo)
                .args(["--size", "200x150", "--check"]);
            succeed(screen().give(&mut command));
            rgb(&out)
        });
        let [wide, narrow] = pictures;
        let compared = Comparison::new(&wide, &narrow, None).expect("one size");
        assert!(
            Gate::DESIGN.check(&compared).is_ok(),
            "{name}: {compared:?}"
        );
    }
}

#[test]
#[ignore = "i386 packages: make test-both"]
fn both_proof_bench_and_doctor_take_programs_of_32_bits() {
    let [_, narrow] = demos("teapot");
    let told = |arguments: &[&str], more: &[&str]| {
        let mut command: Command = manyview();
        command.args(arguments).arg("--").arg(&narrow).args(more);
        let (code, stdout, stderr) = run(screen().give(&mut command));
        assert_eq!(code, 0, "{arguments:?}: {stderr}");
        stdout + &stderr
    };
    let proof = told(
        &[
            "run",
            "--views",
            "3",
            "--strategy",
            "geometry",
            "--prove",
            "2",
        ],
        &["--frames", "8"],
    );
    assert!(proof.contains("geometry"), "{proof}");
    let bench = told(
        &[
            "bench",
            "--views",
            "3",
            "--frames",
            "10",
            "--strategy",
            "replay",
        ],
        &[],
    );
    assert!(bench.contains("replay"), "{bench}");
    let findings = told(&["doctor"], &[]);
    for part in ["32 bits", "i386-linux-gnu", "strategies: replay"] {
        assert!(findings.contains(part), "{part}: {findings}");
    }
}
