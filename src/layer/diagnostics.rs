//! Diagnostics of the frames: the report, one frame explained, the proof against replay, pictures on request.

use super::{control, explain, prove};
use crate::gl::Count;
use crate::plan::Reason;
use crate::report::{Counts, Report};

/// Observers of the frames, which change nothing of what is drawn.
#[derive(Debug)]
pub(super) struct Diagnostics {
    /// Counts for `--report`.
    pub(super) report: Report,
    pub(super) explained: Option<explain::Explained>,
    pub(super) proving: prove::Proving,
    /// The picture that a request to the running program asks for.
    pub(super) picture: control::Picture,
    /// Fallbacks of this frame, by reason.
    pub(super) fallbacks: Counts<Reason>,
    /// GL names that the layer has made and deleted.
    pub(super) made: Count,
}

impl Diagnostics {
    pub(super) fn new(report: Report) -> Self {
        Diagnostics {
            report,
            explained: None,
            proving: prove::Proving::default(),
            picture: control::Picture::None,
            fallbacks: Counts::default(),
            made: Count::default(),
        }
    }
}
