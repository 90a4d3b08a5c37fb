//! Libraries that read formats may panic at files that nobody has foreseen: that is a fault of the file.

use super::cloud::{Part, Point};
use super::error::{Place, ReadError};
use crate::quiet::quietly;
use std::cell::Cell;
use std::path::{Path, PathBuf};

/// What a function returns, or the fault of a file in place of a panic.
pub(super) fn catch<T>(
    path: &Path,
    at: impl FnOnce() -> Place,
    read: impl FnOnce() -> Result<T, ReadError>,
) -> Result<T, ReadError> {
    let what = "what is there cannot be read";
    quietly(read).unwrap_or_else(|| Err(ReadError::new(path, at(), what)))
}

/// A part whose panics are faults.
pub(super) struct Caught {
    pub(super) path: PathBuf,
    pub(super) part: Box<dyn Part>,
}

impl Part for Caught {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let given = Cell::new(0);
        let at = || Place::Point(given.get() + 1);
        catch(&self.path, at, || {
            self.part.read(&mut |points| {
                given.set(given.get() + points.len() as u64);
                give(points)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Caught, Part, Place, Point, ReadError};
    use glam::DVec3;

    struct Panics;

    impl Part for Panics {
        fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
            give(&mut vec![Point::at(DVec3::ZERO); 3]);
            panic!("on purpose");
        }
    }

    #[test]
    fn a_panic_is_a_fault_after_what_was_read() {
        let mut part = Caught {
            path: "a.las".into(),
            part: Box::new(Panics),
        };
        let fault = part.read(&mut |_| true).expect_err("a fault");
        assert_eq!(fault.at, Place::Point(4));
    }
}
