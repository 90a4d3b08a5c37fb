//! Where the explanation of one frame goes.
#![forbid(unsafe_code)]

use std::path::PathBuf;

/// One frame to explain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explain {
    /// A folder, or a file whose name is that of both files but for the extension.
    pub out: PathBuf,
    /// The frame, counted from 1.
    pub frame: u64,
}

impl Explain {
    /// The folder of the shaders that the frame was drawn with.
    #[must_use]
    pub fn shaders(&self) -> PathBuf {
        let [_, list] = self.files();
        list.with_extension("shaders")
    }

    /// The picture and the list.
    #[must_use]
    pub fn files(&self) -> [PathBuf; 2] {
        let stem = if self.out.is_dir() {
            self.out.join("explain.png")
        } else {
            self.out.clone()
        };
        ["png", "txt"].map(|extension| stem.with_extension(extension))
    }
}
