//! Runs a program until the layer has proved enough of its frames.
#![forbid(unsafe_code)]

use super::capture::Program;
use super::error::LaunchError;
use super::program::Launch;
use super::screen::Screen;
use super::stepped::Stop;
use crate::config::Status;
use crate::report::Summary;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

const POLL: Duration = Duration::from_millis(20);

/// One program under one configuration, which asks for a proof.
#[derive(Debug)]
pub struct ProveJob<'a> {
    /// The checked program.
    pub launch: &'a Launch,
    /// The screen that it draws on.
    pub screen: &'a Screen,
    /// The file in which the layer reports its status.
    pub status: &'a Path,
    /// Number of frames, proved or found not to be provable, after which the program is ended.
    pub frames: u64,
    /// Time after which the program is ended.
    pub limit: Duration,
}

impl ProveJob<'_> {
    /// Runs the program and returns the layer's notes for the user.
    pub fn run(&self, stop: &mut Stop) -> Result<Vec<String>, LaunchError> {
        let mut command = self.launch.command()?;
        self.screen.give(&mut command);
        command
            // No swap waits for the monitor (the variables of Mesa and of NVIDIA).
            .env("vblank_mode", "0")
            .env("__GL_SYNC_TO_VBLANK", "0")
            // Our own stdout is for the table of results.
            .stdout(Stdio::null());
        let mut program = Program::start(self.launch, command)?;
        let limit = Instant::now() + self.limit;
        loop {
            // Checked before the file is read, so that a status which the layer wrote just before the end counts.
            let ended = program.ended();
            let status = Status::read(self.status).unwrap_or_default();
            let seen = seen(&status);
            if ended.is_some() || seen >= self.frames || Instant::now() > limit {
                let mut notes = status.notes;
                if seen == 0 {
                    let end = ended.map_or_else(
                        || format!("after {} s", self.limit.as_secs()),
                        |ended| ended.describe(),
                    );
                    notes.push(format!("it ended {end} before a frame was proved"));
                }
                return Ok(notes);
            }
            stop.check()?;
            std::thread::sleep(POLL);
        }
    }
}

/// Number of frames that were proved or cannot be proved.
fn seen(status: &Status) -> u64 {
    let proof = status.proof.clone();
    let proof = proof.and_then(|proof| serde_json::from_value::<Summary>(proof).ok());
    proof.map_or(0, |proof| {
        proof.frames + proof.skipped.values().sum::<u64>()
    })
}
