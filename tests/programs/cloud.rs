//! The point cloud that tools for points are given: a coloured torus.

use crate::support::scratch;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

const POINTS: u32 = 100_000;

/// Path of the files, without their endings: `.ply` and `.pcd`.
pub(crate) fn stem() -> PathBuf {
    std::path::absolute(scratch("programs").join("cloud")).expect("a path")
}

/// Writes the files.
pub(crate) fn write() {
    let mut ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {POINTS}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n\
         property uchar green\nproperty uchar blue\nend_header\n"
    );
    let mut pcd = format!(
        "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH {POINTS}\nHEIGHT 1\n\
         VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {POINTS}\nDATA ascii\n"
    );
    for number in 0..POINTS {
        let ([x, y, z], [r, g, b]) = point(number);
        let _ = writeln!(ply, "{x:.5} {y:.5} {z:.5} {r} {g} {b}");
        let colour = u32::from_be_bytes([0, r, g, b]);
        let _ = writeln!(pcd, "{x:.5} {y:.5} {z:.5} {colour}");
    }
    let stem = stem();
    fs::write(stem.with_extension("ply"), ply).expect("written");
    fs::write(stem.with_extension("pcd"), pcd).expect("written");
}

/// Place and colour. Multiples of the powers of the plastic number's reciprocal fill a square evenly.
fn point(number: u32) -> ([f64; 3], [u8; 3]) {
    let [u, v] =
        [0.754_877_666_2, 0.569_840_291_0].map(|part| f64::from(number) * part % 1.0 * TAU);
    let from_axis = 1.0 + 0.4 * v.cos();
    let place = [from_axis * u.cos(), from_axis * u.sin(), 0.4 * v.sin()];
    let colour = [(3.0 * u).cos(), (2.0 * v).cos(), u.sin()];
    (place, colour.map(|part| (128.0 + 127.0 * part) as u8))
}
