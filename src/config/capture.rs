//! Which pictures are written, and their names.
#![forbid(unsafe_code)]

use crate::display::QuiltName;
use std::path::{Path, PathBuf};

/// Pictures to write while the program runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Capture {
    /// Target file; [`Capture::path_for`] gives the name for each frame.
    pub out: PathBuf,
    /// First frame, 1-based.
    pub first: u64,
    /// Last frame, inclusive.
    pub last: u64,
    /// The content of the pictures.
    pub what: CaptureWhat,
}

impl Capture {
    /// In a file's name: stands for the columns, rows and aspect of a quilt, see [`QuiltName`](crate::display::QuiltName); nothing for other pictures.
    pub const QUILT: &str = "%q";

    /// The file for one frame of a picture that is no quilt: `%d` becomes the frame; without it, several frames get `-000030`
    /// before the extension.
    ///
    /// The layer writes to a new file beside it first and renames, so a file with this name is whole.
    #[must_use]
    pub fn path_for(&self, frame: u64) -> PathBuf {
        self.path_with(frame, "")
    }

    /// As [`Capture::path_for`], with [`Capture::QUILT`] replaced.
    #[must_use]
    pub fn path_with(&self, frame: u64, quilt: &str) -> PathBuf {
        let quilt = if self.names_quilts() { quilt } else { "" };
        let [before, after] = self.name(frame);
        self.out.with_file_name(format!("{before}{quilt}{after}"))
    }

    /// Whether a file of the folder is the one for a frame, whatever a quilt's views are.
    #[must_use]
    pub fn is_for(&self, frame: u64, file: &str) -> bool {
        let [before, after] = self.name(frame);
        let between = file
            .strip_prefix(before.as_str())
            .and_then(|rest| rest.strip_suffix(after.as_str()));
        match between {
            Some("") => true,
            Some(quilt) => {
                let said = QuiltName::read(quilt).ok().flatten();
                self.names_quilts() && said.is_some_and(|said| said.to_string() == quilt)
            }
            None => false,
        }
    }

    /// Whether the name has [`Capture::QUILT`] in it.
    #[must_use]
    pub fn names_quilts(&self) -> bool {
        self.file_name().contains(Self::QUILT)
    }

    /// The same with [`Capture::QUILT`] in the name, unless the name has that or the columns and rows of a quilt already.
    #[must_use]
    pub fn completed(out: &Path) -> PathBuf {
        let name = file_name(out);
        if name.is_empty() || name.contains(Self::QUILT) || QuiltName::is_in(&name) {
            return out.to_owned();
        }
        let (stem, extension) = split_extension(&name);
        out.with_file_name(format!("{stem}{}{extension}", Self::QUILT))
    }

    /// The name for a frame, before and after the part about a quilt.
    fn name(&self, frame: u64) -> [String; 2] {
        let name = self.file_name();
        let [mut before, mut after] = match name.split_once(Self::QUILT) {
            Some((before, after)) => [before.to_owned(), after.to_owned()],
            None => {
                let (stem, extension) = split_extension(&name);
                [stem.to_owned(), extension.to_owned()]
            }
        };
        if before.contains("%d") || after.contains("%d") {
            [before, after] = [before, after].map(|part| part.replace("%d", &frame.to_string()));
        } else if self.first != self.last {
            before = format!("{before}-{frame:06}");
        }
        [before, after]
    }

    fn file_name(&self) -> String {
        file_name(&self.out)
    }
}

fn file_name(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy());
    name.unwrap_or_default().into_owned()
}

/// A name and its extension with the dot, as [`Path::extension`] has it.
fn split_extension(name: &str) -> (&str, &str) {
    let extension = Path::new(name).extension().map_or(0, |e| e.len() + 1);
    name.split_at_checked(name.len() - extension)
        .unwrap_or((name, ""))
}

/// What a captured picture holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaptureWhat {
    /// The picture given to the swap.
    Output,
    /// All tiles, views in order, left to right then top to bottom.
    Atlas,
    /// One tile at tile size.
    View(u32),
    /// The depth of the program's own view, 16-bit grey.
    Depth,
    /// The reference image of an occlusion camera, from which hidden samples are taken.
    Reference,
    /// No picture: the samples of the own view and of the reference image, see [`crate::volume::Samples`].
    Samples,
}
