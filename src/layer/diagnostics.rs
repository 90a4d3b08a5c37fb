//! Diagnostics of the frames: the report, one frame explained, the proof against replay, pictures on request.

use super::{control, explain, osd, prove};
use crate::config::Config;
use crate::gl::Count;
use crate::plan::Reason;
use crate::report::{Counts, Report};
use std::time::Instant;

/// Observers of the frames, which change nothing of what is drawn.
#[derive(Debug)]
pub(super) struct Diagnostics {
    /// Counts for `--report`.
    pub(super) report: Report,
    pub(super) explained: Option<explain::Explained>,
    pub(super) proving: prove::Proving,
    /// Where a request to the running program wants the explanation of the next frame.
    pub(super) asked: Option<std::path::PathBuf>,
    /// The picture that a request to the running program asks for.
    pub(super) picture: control::Picture,
    /// Fallbacks of this frame, by reason.
    fallbacks: Counts<Reason>,
    /// GL names that the layer has made and deleted.
    made: Count,
    /// Sentences that the user is to see at once.
    pub(super) announced: Vec<String>,
    /// The on-screen display.
    pub(super) display: osd::Display,
}

impl Diagnostics {
    pub(super) fn new(report: Report) -> Self {
        Diagnostics {
            report,
            explained: None,
            proving: prove::Proving::default(),
            asked: None,
            picture: control::Picture::None,
            fallbacks: Counts::default(),
            made: Count::default(),
            announced: Vec::new(),
            display: osd::Display::default(),
        }
    }

    /// A draw of this frame is not made by the requested strategy.
    pub(super) fn fallback(&mut self, reason: Reason) {
        self.fallbacks.add(reason);
    }

    /// Adds a sentence to the report, which the user is also to see at once.
    pub(super) fn announce(&mut self, sentence: String) {
        self.report.note(sentence.clone());
        self.display.osd.warning(sentence.clone(), Instant::now());
        self.announced.push(sentence);
    }

    /// Within frame `frame`: writes the report and the status, with the fallbacks so far. The launcher may end the program before the frame
    /// is counted.
    pub(super) fn write(&mut self, config: &Config, frame: u64) {
        self.report_fallbacks();
        self.report.write(config, frame);
    }

    /// Gives the fallbacks of the frame to the report.
    pub(super) fn report_fallbacks(&mut self) {
        for (reason, count) in self.fallbacks.take() {
            self.report.fallbacks(&reason, count);
        }
    }

    /// Gives the report the number of GL names that the layer has made and deleted on this thread, and that of the display lists of ours that
    /// the share group holds.
    pub(super) fn count_names(&mut self, lists: u32) {
        self.made.catch_up();
        self.report.names(self.made, lists);
    }
}
