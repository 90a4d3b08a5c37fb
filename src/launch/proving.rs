//! Running a program until the layer has proved enough of its frames.
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
    /// The program, checked.
    pub launch: &'a Launch,
    /// Where it draws.
    pub screen: &'a Screen,
    /// Where the layer says how far it is.
    pub status: &'a Path,
    /// It is ended when so many frames are proved, or found not to be provable.
    pub frames: u64,
    /// It is ended after this time.
    pub limit: Duration,
}

impl ProveJob<'_> {
    /// Answers what the layer wants the user to know.
    pub fn run(&self, stop: &mut Stop) -> Result<Vec<String>, LaunchError> {
        let mut command = self.launch.command();
        self.screen.give(&mut command);
        command
            // Nothing waits for the monitor (Mesa's name for it, and NVIDIA's).
            .env("vblank_mode", "0")
            .env("__GL_SYNC_TO_VBLANK", "0")
            // Ours is for the table.
            .stdout(Stdio::null());
        let mut program = Program::start(self.launch, command)?;
        let limit = Instant::now() + self.limit;
        loop {
            // Asked before the file is read: what the program wrote before its end counts.
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

/// Frames that were proved or cannot be.
fn seen(status: &Status) -> u64 {
    let proof = status.proof.clone();
    let proof = proof.and_then(|proof| serde_json::from_value::<Summary>(proof).ok());
    proof.map_or(0, |proof| {
        proof.frames + proof.skipped.values().sum::<u64>()
    })
}
