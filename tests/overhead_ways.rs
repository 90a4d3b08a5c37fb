//! What the layer costs under Wine and in a container, where it is switched off and where it draws one view, beside what it costs a program as it is. `make overhead-ways`.

use crate::support::{Screen, demo, library, own_screen, scratch, target_folder};
use manyview::bench::protocol::Times;
use std::io::{BufRead, BufReader, Lines, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Frames of a turn, turns that are measured, and turns before these, in which caches are made.
const FRAMES: u32 = 40;
const TURNS: usize = 101;
const FIRST: usize = 6;
/// The bounds: one view, and the layer switched off.
const BOUNDS: [f64; 2] = [1.05, 1.02];

/// A way to run a program for so many frames.
struct Way {
    name: &'static str,
    words: Vec<String>,
}

fn ways() -> Vec<Way> {
    let text = |path: &Path| path.to_str().expect("UTF-8").to_owned();
    let gears = text(&demo("gears"));
    let mut all = vec![Way {
        name: "as it is",
        words: vec![gears.clone()],
    }];
    let root = target_folder().with_file_name("launch").join("trixie");
    let mut bwrap = vec!["bwrap".to_owned()];
    let bind = |from: &Path, to: &str| ["--ro-bind".to_owned(), text(from), to.to_owned()];
    bwrap.extend(bind(&root.join("usr"), "/usr"));
    bwrap.extend(bind(&root.join("etc"), "/etc"));
    for name in ["bin", "lib", "lib64"] {
        bwrap.extend([
            "--symlink".to_owned(),
            format!("usr/{name}"),
            format!("/{name}"),
        ]);
    }
    let target = target_folder().parent().expect("a target folder");
    bwrap.extend(bind(target, &text(target)));
    bwrap.extend(["--proc", "/proc", "--dev", "/dev", "--tmpfs", "/tmp"].map(str::to_owned));
    bwrap.extend(bind(Path::new("/tmp/.X11-unix"), "/tmp/.X11-unix"));
    bwrap.push(gears);
    all.push(Way {
        name: "container",
        words: bwrap,
    });
    for (name, class) in [("Wine, 64 bits", "64"), ("Wine, 32 bits", "32")] {
        let program = target_folder().with_file_name("windows").join(class);
        all.push(Way {
            name,
            words: vec!["wine".to_owned(), text(&program.join("d3d9.exe"))],
        });
    }
    all
}

/// A program that is kept alive and draws on request.
struct Program {
    child: Child,
    requests: ChildStdin,
    answers: Lines<BufReader<ChildStdout>>,
}

impl Program {
    /// With these variables.
    fn new(way: &Way, screen: &Screen, variables: &[(&str, String)]) -> Self {
        let mut command = Command::new(&way.words[0]);
        command.args(&way.words[1..]).arg("--bench");
        let prefix = std::path::absolute(scratch("wine")).expect("a path");
        command
            .env("WINEPREFIX", prefix)
            .env("WINEDEBUG", "-all")
            .env("WINEDLLOVERRIDES", "mscoree=;mshtml=")
            .env("vblank_mode", "0")
            .envs(variables.iter().map(|(name, value)| (name, value)))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut child = screen.give(&mut command).spawn().expect("it starts");
        let (requests, answers) = (child.stdin.take(), child.stdout.take());
        Self {
            requests: requests.expect("a pipe"),
            answers: BufReader::new(answers.expect("a pipe")).lines(),
            child,
        }
    }

    /// Nanoseconds of a turn: one number, or as demos answer, `wall T1 ... TN cpu ...`, after lines with the name of the driver.
    fn turn(&mut self, name: &str) -> f64 {
        writeln!(self.requests, "{FRAMES}").expect(name);
        loop {
            let line = self.answers.next().expect(name).expect("text");
            let line = line.trim();
            if let Ok(all) = line.parse::<f64>() {
                return all;
            }
            if let Some(times) = Times::read(line, FRAMES) {
                return times.wall.iter().sum::<u64>() as f64;
            }
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
#[ignore = "Wine and a container: make overhead-ways"]
fn the_layer_costs_no_more_in_any_way() {
    library();
    let links = target_folder().join("by-class/$LIB/libmanyview.so");
    let preload = ("LD_PRELOAD", links.to_str().expect("UTF-8").to_owned());
    let one = [preload.clone(), ("MANYVIEW_VIEWS", "1".to_owned())];
    let off = [preload, ("MANYVIEW_DISABLE", "1".to_owned())];
    let screen = own_screen();
    let mut over = Vec::new();
    println!("{:<16}{:>10}{:>10}{:>10}", "", "ms", "one view", "off");
    for way in ways() {
        let mut programs =
            [&[][..], &one, &off].map(|variables| Program::new(&way, &screen, variables));
        let mut ratios = [Vec::new(), Vec::new()];
        let mut bare = Vec::new();
        for turn in 0..FIRST + TURNS {
            let mut times = [0.0; 3];
            // Each of them comes first, second and last as often.
            for program in 0..times.len() {
                let next = (turn + program) % times.len();
                times[next] = programs[next].turn(way.name);
            }
            if turn >= FIRST {
                bare.push(times[0]);
                ratios[0].push(times[1] / times[0]);
                ratios[1].push(times[2] / times[0]);
            }
        }
        let ratios = ratios.map(median);
        let ms = median(bare) * 1e-6 / f64::from(FRAMES);
        println!(
            "{:<16}{ms:>10.3}{:>10.3}{:>10.3}",
            way.name, ratios[0], ratios[1]
        );
        for (ratio, bound) in ratios.iter().zip(BOUNDS) {
            if *ratio > bound {
                over.push(format!("{}: {ratio:.3}, {bound} allowed", way.name));
            }
        }
    }
    assert!(over.is_empty(), "{}", over.join("\n"));
}
