//! Measures the cost of the interleave pass, at the sizes of panels.

use crate::egl;
use manyview_core::config::{Config, Settings};
use manyview_core::display::{Display, Kind, Number, Slanted};
use manyview_core::gl::Gl;
use manyview_core::interleave::cost::{Case, measure};
use manyview_core::layer::support::Support;
use std::process::ExitCode;

/// Pixels: 1080p, 4K, 8K.
const SIZES: [(u32, u32); 3] = [(1920, 1080), (3840, 2160), (7680, 4320)];
const VIEWS: [u32; 7] = [2, 4, 8, 16, 32, 45, 64];
const ROUNDS: usize = 9;

/// Prints a line for each size, number of views and panel. Cases that cannot be measured are named on stderr.
pub(crate) fn run() -> ExitCode {
    let mut words = std::env::args().skip(2);
    let size = words.next().map(|word| {
        let (width, height) = word.split_once('x')?;
        Some((width.parse().ok()?, height.parse().ok()?))
    });
    let views = words.next().map(|word| word.parse().ok());
    let (Some(sizes), Some(views)) = (
        size.map_or(Some(SIZES.to_vec()), |size| Some(vec![size?])),
        views.map_or(Some(VIEWS.to_vec()), |views| Some(vec![views?])),
    ) else {
        eprintln!("usage: manyview-probe interleave [WIDTHxHEIGHT [VIEWS]]");
        return ExitCode::from(2);
    };
    match every(&sizes, &views) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn every(sizes: &[(u32, u32)], views: &[u32]) -> Result<(), String> {
    let context = egl::context()?;
    // SAFETY: the context was just made current on this thread and stays so until the process ends.
    let gl = unsafe { Gl::new(context.real) };
    let support = Support::ask(&gl).map_err(|e| e.to_string())?;
    let mut config = Config::from_settings(&Settings::default()).map_err(|e| e.to_string())?;
    for &size in sizes {
        for &views in views {
            for display in panels() {
                config.views = views;
                config.display = display;
                let case = Case {
                    config: &config,
                    size,
                    rounds: ROUNDS,
                };
                match measure(&gl, support.glsl, support.limits, &case) {
                    Ok(cost) => {
                        println!(
                            "{}",
                            serde_json::to_string(&cost).map_err(|e| e.to_string())?
                        )
                    }
                    Err(e) => eprintln!("{}x{}, {views} views: {e}", size.0, size.1),
                }
            }
        }
    }
    Ok(())
}

/// A panel whose mask repeats after a few pixels, and a lens sheet with measured numbers, whose mask does not repeat.
fn panels() -> [Display; 2] {
    let measured = |text| Number::parse(text).unwrap_or(Number::whole(0));
    let sheet = Slanted {
        pitch: measured("18.6579"),
        slant: measured("-0.41"),
        ..Slanted::HUEBNER
    };
    [
        Display::default(),
        Display::new("slanted", 45, Kind::Slanted(sheet)),
    ]
}
