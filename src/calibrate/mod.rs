//! Measures a panel's lens sheet from hand-held photos of a pattern that the panel shows; pure, without GL.
//!
//! # The fringes in a photo
//!
//! The sheet lies a gap `g` above the pixels, in effective air. A ray from the eye `E`, at distance `Z`, to the point `p`
//! of the pixels crosses the sheet at `q = p + (E − p)·g·c(θ)/Z`, where `c` is 1 for a gap of air and follows Snell's law in glass (`sheet.rs`). The lens there shows, over its whole width, the pixels that
//! lie under it in the direction of the ray. With `ψ` the phase of the pattern and `Φ` that of the lenses, as
//! [`crate::display::Slanted`] counts it (a lens begins where it is whole, so its axis is at one half), the fringes seen
//! have the phase
//!
//! ```text
//! D(p) = ψ(p) − Φ(q) + 1/2        in turns
//! ```
//!
//! Both gratings are finer than the camera resolves; `D` is not, because `ψ` is the nominal lens plus a coarse carrier.
//! Every error of the nominal lens is magnified into the frequency and phase of the fringes, so they are measured
//! in the frequency domain (as Hwang et al. 2016 do) and the place of the panel in the photo matters little.
//!
//! # The unknowns that photos determine
//!
//! `Φ(q)` is a plane: `1/pitch` along the row, `slant/pitch` down, and `offset/pitch`. With `u` the distance over the
//! lenses, a photo gives three numbers: the two slopes, each times `1 − g/Z`, and the constant plus `g·u(E)/(Z·pitch)`.
//!
//! - The slant is the ratio of the slopes: one photo from anywhere gives it.
//! - The pitch of one photo is known times `1 − g/Z`, so as well as `g/Z` is. A photo from where the viewers will be gives
//!   the pitch for viewers there (`viewer`) without knowing `g`.
//! - The offset of one photo is known as well as the direction of the camera, over the cone, and `g` are. Straight from
//!   the front the gap does not matter, only the direction.
//! - Photos from two directions give `g`: the constants differ by `g` times the difference of the directions. The
//!   result is known up to a whole turn: the cone must be known well enough to leave one candidate, and a second one that fits as well is reported.
//!
//! The camera's direction and distance come from the frame in the photo: four sides fix the homography, and it the pose up
//! to the focal length, which EXIF gives, or the shared fit of all photos at a tilt. All unknowns (optics, poses, sheet,
//! gap) are solved together with priors for the values that are known beforehand, so that the covariance has the uncertainty.
//! Distances, in here, are panel pixels: nothing but a distance given in mm needs the panel's size in mm.
//!
//! The carrier turns an error of place into one of phase, a hundredth of a turn for each pixel down. A hand that is not steady while the sensor is read moves rows
//! by a pixel or so, which without a term of its own pulls the focal length by per cents, and with it the gap and the pitch. So each photo has a movement
//! over its rows among its unknowns (`camera.rs`); edges and fringes fix it together. A stabiliser moves the lens, so each photo has an optical axis of its own
//! as well; before a panel that is seen from the front nothing tells it from a step aside, and it limits how well the focal length and the offset are known.
//!
//! # Where pitch and slant are not known
//!
//! The pattern is made for a nominal lens that is right to 1 %. Where no data sheet has it, another pattern comes first: many gratings, of whose
//! beats one photo tells pitch and slant (`rough`).
//!
//! # Limits
//!
//! A sheet whose views run from right to left looks the same with the cone turned inside out; the sheet here is one whose
//! gap is positive. Colour offsets are seen through the camera's own colour filters, which make them smaller.
#![forbid(unsafe_code)]

mod bench;
mod by_eye;
mod camera;
mod certainty;
mod choice;
mod complex;
mod edges;
mod error;
mod find;
mod fit;
mod frame;
mod fringes;
mod least_squares;
mod levels;
mod locate;
mod mask;
mod pattern;
mod photo;
mod picture;
mod rough;
mod setup;
mod sheet;
mod shown;
mod sighting;
mod solve;
pub mod units;
mod written;

pub use by_eye::{Action, ByEye, KEYS, action};
pub use certainty::PhaseError;
pub use choice::{MOST, choose};
pub use error::CalibrateError;
pub use fit::{Camera, Fit, Residuals, fit};
pub(crate) use least_squares::{minimise, soft};
pub use mask::Mask;
pub use photo::Photo;
pub(crate) use photo::{linear, upright};
pub use rough::{Beats, Rough, rough, rough_pattern};
pub use setup::{Guess, Setup};
pub use sighting::Sighting;

/// The picture to show on the whole panel; row 0 on top.
pub fn pattern(setup: &Setup) -> Result<image::RgbImage, CalibrateError> {
    setup.check()?;
    Ok(pattern::picture(setup))
}
