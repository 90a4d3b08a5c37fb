//! The samples of a program's frame with their depths, in a file between the layer, which writes it, and the command, which reads it.
//!
//! The geometry of a program is not known, but its samples with depths are: those that its own camera sees, and those of the reference image, which reach
//! behind occluders. The file is a line that names the format, a line of JSON ([`Head`]), and the planes: colours and depths of the own view, colours, depths and
//! by how many pixels each sample is moved of the reference image. Depths and pixels are 32-bit floats with the lowest byte first; rows from the top.

use serde::{Deserialize, Serialize};

/// The first line.
pub(super) const MAGIC: &str = "manyview samples 1";

/// Stands before the reason why there are no samples.
pub(super) const NOTHING: &str = "nothing: ";

/// The description of the planes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Head {
    /// Pixels.
    pub size: [u32; 2],
    /// Viewport of the scene as in glViewport: left and lower edge, width and height.
    pub viewport: [i32; 4],
    /// Slope and offset of 1/w over the depth.
    pub line: [f64; 2],
    /// The part of the depth range in front of everything else, such as a weapon in the hand.
    pub before: Option<Before>,
    /// The depth of pixels that no draw has covered.
    pub clear: f32,
    /// Clip-space w of zero parallax.
    pub focal: f64,
}

/// A part of the depth range with distances of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Before {
    /// As in [`Head`].
    pub line: [f64; 2],
    /// Depths from the nearest one to this one.
    pub to: f64,
}

/// Red, green and blue by pixel, and depths.
pub type Picture = (Vec<u8>, Vec<f32>);

/// The samples of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// The description of the rest.
    pub head: Head,
    /// The program's own view.
    pub own: Picture,
    /// The reference image.
    pub reference: Picture,
    /// Pixels to the right by which each of its samples was moved.
    pub moved: Vec<f32>,
}

impl Samples {
    /// The contents of the file.
    pub fn bytes(&self) -> Vec<u8> {
        let head = serde_json::to_string(&self.head).unwrap_or_default();
        let mut bytes = format!("{MAGIC}\n{head}\n").into_bytes();
        let floats = |bytes: &mut Vec<u8>, floats: &[f32]| {
            bytes.extend(floats.iter().flat_map(|v| v.to_le_bytes()));
        };
        for (colours, depths) in [&self.own, &self.reference] {
            bytes.extend(colours);
            floats(&mut bytes, depths);
        }
        floats(&mut bytes, &self.moved);
        bytes
    }

    /// The contents of the file for a frame without samples.
    pub fn nothing(why: &str) -> Vec<u8> {
        format!("{MAGIC}\n{NOTHING}{why}\n").into_bytes()
    }
}
