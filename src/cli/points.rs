//! `manyview points`
#![forbid(unsafe_code)]

use super::layer::LayerArguments;
use super::{Outcome, run};
use clap::Args;
use manyview::launch::library;
use std::ffi::OsString;

/// The program that shows point clouds.
const VIEWER: &str = "manyview-points";

#[derive(Args)]
#[command(after_help = VIEWERS_OPTIONS)]
pub(crate) struct Arguments {
    #[command(flatten)]
    layer: LayerArguments,
    /// The file (PLY, also of 3D Gaussian Splatting, LAS, LAZ, E57, PCD, or text with a point in each line), then options of the viewer
    #[arg(required = true, trailing_var_arg = true, value_name = "FILE")]
    file: Vec<OsString>,
}

const VIEWERS_OPTIONS: &str = "\
Options of the viewer, after FILE:
  --memory SIZE        Memory for points, a half of it that of the graphics card [default: 2G]
  --fps RATE           Frames a second: as many points are drawn as there is time for [default: 30]
  --up y|z|-y          The axis that points upwards [default: y for PLY, -y for Gaussians, else z]
  --turn DEGREES       Turn by so many degrees a second
  --size WIDTHxHEIGHT  Size of the window in pixels [default: 1280x720]

Mouse: drag with the left button to turn, with another to move, wheel to come closer.
Keys: arrows turn, Page Up and Page Down come closer and go away, + and - change the size
  of points, Home shows the whole, F11 fills the screen, Q or Escape ends.";

pub(crate) fn run(arguments: &Arguments) -> Outcome {
    let viewer = library::helper(VIEWER)?;
    let mut command = vec![viewer.into_os_string()];
    command.extend(arguments.file.iter().cloned());
    run::start(&arguments.layer, &command, false)
}
