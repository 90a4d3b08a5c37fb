//! The first launch of a game, without any option, and what is kept of it.

use crate::looks::table::Game;
use crate::support::play::{mute, play, run};
use crate::support::{library, manyview, rgb, sized_screen};
use image::RgbImage;
use image::imageops::crop_imm;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// The number of views of the display that a first launch has.
pub(crate) const VIEWS: u32 = 8;
/// Files of a launch in its folder.
const REPORT: &str = "report.json";
const ATLAS: &str = "views.png";
/// How much longer than `at` a game may take to show a frame.
const PATIENCE: Duration = Duration::from_secs(150);

/// What is kept.
pub(crate) struct Launched {
    /// The leftmost view first.
    pub(crate) views: Vec<RgbImage>,
    /// The report of the run.
    pub(crate) report: Value,
    /// The frame of the views.
    pub(crate) frame: u64,
}

/// The user's own settings must not be found, and the layer is to do what it does for a new user.
fn new_user(command: &mut Command, home: &Path) {
    for variable in [
        "MANYVIEW_AUTO_DEPTH",
        "MANYVIEW_STRATEGY",
        "GALLIVM_PERF",
        "LP_NUM_THREADS",
    ] {
        command.env_remove(variable);
    }
    command.env("HOME", home).env("XDG_RUNTIME_DIR", home);
    // What a desktop has: the folder of Debian's games in the path, a name and a language.
    let path = std::env::var("PATH").unwrap_or_default();
    command.env("PATH", format!("{path}:/usr/games"));
    command.envs([
        ("USER", "player"),
        ("LOGNAME", "player"),
        ("LANG", "C.UTF-8"),
    ]);
    for variable in ["XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"] {
        command.env_remove(variable);
    }
}

/// Plays the game in a home of its own within `folder`; `strategy` is the only option.
pub(crate) fn launch(
    game: &Game,
    folder: &Path,
    strategy: Option<&str>,
) -> Result<Launched, String> {
    library();
    let home = folder.join("home");
    let _ = fs::remove_dir_all(&home);
    fs::create_dir_all(&home).expect("a folder");
    for (path, text) in &game.home {
        let path = home.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file of the game");
    }
    let (report, atlas) = (folder.join(REPORT), folder.join(ATLAS));
    for old in [&report, &atlas] {
        let _ = fs::remove_file(old);
    }
    let screen = sized_screen(game.screen);
    let mut command = manyview();
    // Neither changes what is drawn.
    command.args(["run", "--control", "--report"]).arg(&report);
    if let Some(strategy) = strategy {
        command.args(["--strategy", strategy]);
    }
    command.arg("--").args(&game.command);
    new_user(mute(screen.give(&mut command)), &home);
    let mut frame = None;
    let mut play = play(&game.input, &screen);
    let at = Duration::from_secs_f64(game.at);
    let ended = run(
        &mut command,
        at + PATIENCE,
        &folder.join("log"),
        true,
        |time| {
            play(time);
            if time >= at {
                frame = captured(&home, &atlas);
            }
            frame.is_none()
        },
    );
    if let Some(wrong) = ended.wrong {
        let last = ended.said.lines().last().unwrap_or_default();
        return Err(format!("{wrong}: {last}"));
    }
    kept(folder, frame.ok_or("no frame was shown")?)
}

/// What a launch has left in its folder. `frame`: that of the views, or the largest number for the last one of the report.
pub(crate) fn kept(folder: &Path, frame: u64) -> Result<Launched, String> {
    let text = fs::read_to_string(folder.join(REPORT)).map_err(|_| "no report")?;
    let atlas = folder.join(ATLAS);
    if !atlas.is_file() {
        return Err("no frame was shown".into());
    }
    let all = rgb(&atlas);
    let (width, height) = (all.width() / VIEWS, all.height());
    let view = |view| crop_imm(&all, view * width, 0, width, height).to_image();
    Ok(Launched {
        views: (0..VIEWS).map(view).collect(),
        report: serde_json::from_str(&text).expect("JSON"),
        frame,
    })
}

/// Asks the game for its views, and returns the frame that they are of, or the largest number where it took so long that the answer was not waited
/// for; `None` where there are none yet.
fn captured(home: &Path, atlas: &Path) -> Option<u64> {
    if atlas.is_file() {
        return Some(u64::MAX);
    }
    let mut command = manyview();
    new_user(&mut command, home);
    command
        .args(["ctl", "capture", "--what", "atlas"])
        .arg(atlas);
    let output = command.output().expect("manyview");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let frame = said.rsplit_once("(frame ")?.1;
    frame.trim().trim_end_matches(')').parse().ok()
}
