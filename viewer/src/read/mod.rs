//! Reads the points of a file, in an order in which the first of them are already spread over the whole cloud where the format allows it.
//!
//! A format is known by how a file begins, whatever its name is. Each has one file here, which makes a [`Cloud`].

mod blocks;
mod caught;
mod cloud;
mod e57;
mod error;
mod gaussians;
mod las;
mod pcd;
mod ply;
#[cfg(test)]
mod tests;
mod text;

pub use cloud::{Cloud, Part, Point, Up};
pub use error::{Place, ReadError};
pub use gaussians::gaussians;

use caught::{Caught, catch};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// So many bytes tell the format.
const SIGNATURE: u64 = 512;

/// Opens a file, to be read by so many threads.
///
/// # Errors
/// It cannot be read, its header is not right, or it is shorter than its header says.
pub fn open(path: &Path, threads: usize) -> Result<Cloud, ReadError> {
    let no = |error: std::io::Error| ReadError::new(path, Place::Start, error);
    let mut file = File::open(path).map_err(no)?;
    let mut start = Vec::new();
    let head = file.by_ref().take(SIGNATURE);
    { head }.read_to_end(&mut start).map_err(no)?;
    let mut cloud = catch(
        path,
        || Place::Header,
        || known(path, &start, threads.max(1)),
    )?;
    let caught = |part| -> Box<dyn Part> {
        let path = path.to_owned();
        Box::new(Caught { path, part })
    };
    cloud.parts = cloud.parts.into_iter().map(caught).collect();
    Ok(cloud)
}

/// Opens a file of the format that its start tells.
fn known(path: &Path, start: &[u8], threads: usize) -> Result<Cloud, ReadError> {
    if start.starts_with(b"ply") {
        ply::open(path, threads)
    } else if start.starts_with(b"LASF") {
        las::open(path, threads)
    } else if start.starts_with(b"ASTM-E57") {
        e57::open(path)
    } else if start.starts_with(b"# .PCD") || start.starts_with(b"VERSION") {
        pcd::open(path)
    } else if start.contains(&0) {
        let what = "it is neither PLY, LAS, LAZ, E57, PCD nor text with three numbers in a line";
        Err(ReadError::new(path, Place::Start, what))
    } else {
        text::open(path)
    }
}
