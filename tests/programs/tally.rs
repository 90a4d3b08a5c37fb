//! Comparisons of pictures, summed up in a cell.

use crate::programs::row::Cell;
use crate::support::scratch;
use image::RgbImage;
use manyview::metric::{Comparison, Gate, triptych};
use std::fs;
use std::path::Path;

/// An odd number of views, whose middle one is the program's own.
pub(crate) const ODD: u32 = 7;

/// Comparisons of one column.
#[derive(Default)]
pub(crate) struct Tally {
    pictures: u64,
    failed: u64,
    /// Largest fraction of pixels that differ, over all pictures.
    most: f64,
    first: Option<String>,
}

impl Tally {
    fn fail(&mut self, text: String) {
        self.failed += 1;
        self.first.get_or_insert(text);
    }

    pub(crate) fn missing(&mut self, name: &str) {
        self.pictures += 1;
        self.fail(format!("no picture {name}"));
    }

    /// Compares two pictures. The first failure is kept as a triptych in target/programs.
    pub(crate) fn compare(
        &mut self,
        expected: &RgbImage,
        actual: &RgbImage,
        gate: Gate,
        label: &str,
    ) {
        self.pictures += 1;
        let failure = match Comparison::new(expected, actual, None) {
            Err(error) => error.to_string(),
            Ok(comparison) => {
                self.most = self.most.max(comparison.differing_fraction());
                match gate.check(&comparison) {
                    Ok(()) => return,
                    Err(error) => error.to_string(),
                }
            }
        };
        if self.first.is_none() {
            let path = scratch("programs").join(format!("{label}.png"));
            triptych(expected, actual).save(path).expect("written");
        }
        self.fail(failure);
    }

    pub(crate) fn cell(self) -> Cell {
        let Self {
            pictures, failed, ..
        } = self;
        match self.first {
            Some(first) => Cell::bad(format!("{failed} of {pictures}: {first}")),
            None if self.most == 0.0 => Cell::good(format!("{pictures} equal")),
            None => Cell::good(format!("{pictures} within {:.4} %", 100.0 * self.most)),
        }
    }
}

pub(crate) fn cell(wrong: Vec<String>, good: &str) -> Cell {
    match wrong.is_empty() {
        true => Cell::good(good),
        false => Cell::bad(wrong.join("; ")),
    }
}

pub(crate) fn same_bytes(a: &Path, b: &Path) -> bool {
    fs::read(a).expect("a picture") == fs::read(b).expect("a picture")
}

/// One view of a picture that has all views in one row.
pub(crate) fn tile(all: &RgbImage, view: u32) -> RgbImage {
    let width = all.width() / ODD;
    image::imageops::crop_imm(all, view * width, 0, width, all.height()).to_image()
}
