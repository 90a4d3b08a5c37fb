//! The arguments.

use crate::read::Up;
use clap::Parser;
use std::path::PathBuf;

/// Frames a second, unless the user says how many.
pub(super) const FPS: f64 = 30.0;
/// Fewer bytes hold no cloud.
const LEAST_MEMORY: u64 = 64 << 20;

/// Shows a point cloud: PLY, also of 3D Gaussian Splatting, LAS, LAZ, E57, PCD, or text with a point in each line.
#[derive(Debug, Parser)]
#[command(name = "manyview-points", after_help = KEYS)]
pub struct Arguments {
    /// The file
    pub file: PathBuf,
    /// Memory for points, a half of it that of the graphics card: bytes, or a number with M or G
    #[arg(long, value_name = "SIZE", default_value = "2G", value_parser = memory)]
    pub memory: u64,
    /// Frames a second: as many points are drawn as there is time for [default: 30]
    #[arg(long, value_name = "RATE", value_parser = rate)]
    pub fps: Option<f64>,
    /// The axis that points upwards [default: y for PLY, -y for Gaussians, else z]
    #[arg(long, allow_hyphen_values = true)]
    pub up: Option<Up>,
    /// Turn by so many degrees a second
    #[arg(long, value_name = "DEGREES", default_value = "0", allow_negative_numbers = true, value_parser = degrees)]
    pub turn: f32,
    /// Size of the window in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = size)]
    pub size: [u32; 2],
}

const KEYS: &str = "\
Mouse: drag with the left button to turn, with another to move, wheel to come closer.
Keys: arrows turn, Page Up and Page Down come closer and go away, + and - change the size
  of points, Home shows the whole, F11 fills the screen, Q or Escape ends.";

fn memory(text: &str) -> Result<u64, String> {
    let (number, unit) = match text.trim_end_matches(['B', 'b']) {
        text if text.ends_with(['G', 'g']) => (&text[..text.len() - 1], 1 << 30),
        text if text.ends_with(['M', 'm']) => (&text[..text.len() - 1], 1 << 20),
        text => (text, 1),
    };
    let bytes = number.parse::<f64>().map(|number| number * f64::from(unit));
    match bytes {
        Ok(bytes) if bytes >= LEAST_MEMORY as f64 && bytes.is_finite() => Ok(bytes as u64),
        Ok(_) => Err("it is less than 64M".to_owned()),
        Err(_) => Err("give a number with M or G, as in 2G".to_owned()),
    }
}

fn rate(text: &str) -> Result<f64, String> {
    let rate = text
        .parse()
        .ok()
        .filter(|rate| (1.0..=1000.0).contains(rate));
    rate.ok_or_else(|| "give a number from 1 to 1000".to_owned())
}

fn degrees(text: &str) -> Result<f32, String> {
    let degrees = text.parse().ok().filter(|turn: &f32| turn.abs() <= 3600.0);
    degrees.ok_or_else(|| "give a number from -3600 to 3600".to_owned())
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| {
        text.parse()
            .ok()
            .filter(|side| (16..=16_384).contains(side))
    };
    let sides = text
        .split_once('x')
        .and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| "give width and height from 16 to 16384, as in 1280x720".to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Arguments, memory};
    use clap::{CommandFactory, Parser};

    #[test]
    fn clap_finds_no_contradiction() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_of_memory() {
        assert_eq!(memory("2G"), Ok(2 << 30));
        assert_eq!(memory("1.5GB"), Ok(3 << 29));
        assert_eq!(memory("256m"), Ok(256 << 20));
        assert_eq!(memory("134217728"), Ok(1 << 27));
        for bad in ["", "G", "1", "-4G", "infG", "12K"] {
            assert!(memory(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bad_values_are_refused() {
        for bad in [
            ["--fps", "0"],
            ["--size", "10x10"],
            ["--turn", "NaN"],
            ["--up", "x"],
        ] {
            let parsed = Arguments::try_parse_from(["manyview-points", "a.ply", bad[0], bad[1]]);
            assert!(parsed.is_err(), "{bad:?}");
        }
    }
}
