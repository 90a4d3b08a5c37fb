//! Random displays and cameras.

use super::camera::{PIXEL, Sheet, Shot};
use super::random::Random;
use manyview::calibrate::Setup;

/// Panel of the tests, pixels.
pub(crate) const PANEL: (u32, u32) = (960, 540);
const PHOTO: (u32, u32) = (1200, 800);

/// A display, its owner's knowledge of it, and three photos.
pub(crate) struct Scene {
    pub(crate) sheet: Sheet,
    pub(crate) setup: Setup,
    pub(crate) shots: Vec<Shot>,
    /// Focal length from EXIF, as for 35 mm film.
    pub(crate) equivalent: Option<f64>,
}

impl Scene {
    /// A display with its photos: the first from the front, the second from one side, the third from the other.
    pub(crate) fn random(random: &mut Random) -> Self {
        let upright = random.unit() < 0.1;
        let pitch = random.between(4.5, 14.0);
        let slant = random.between(0.1, 0.8) * if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let views = if random.unit() < 0.7 {
            5 + random.below(8)
        } else {
            13 + random.below(16)
        };
        let sheet = Sheet {
            size: PANEL,
            views: views as u32,
            pitch,
            slant: if upright { 0.0 } else { slant },
            offset: random.between(0.0, pitch),
            cone: random.between(25.0, 50.0),
            colours: [0.0; 3],
            bias: [0.0; 9],
        };
        let nominal = sheet.pitch * random.between(0.992, 1.008);
        let tilt = sheet.slant + random.between(-0.01, 0.01);
        let mut setup = Setup::new(PANEL.0, PANEL.1, sheet.views, nominal, tilt);
        // The phase of the sheet itself is compared.
        setup.viewer = Some(f64::INFINITY);
        let side = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let focal = f64::from(PHOTO.0) * random.between(0.72, 1.15);
        let k1 = random.between(-0.02, 0.02);
        let axis = [random.between(-4.0, 4.0), random.between(-4.0, 4.0)];
        let white = random.between(0.55, 0.9);
        let crosstalk = random.between(0.0, 0.25);
        let shots = [0.0, side, -side].map(|side| {
            let degrees = if side == 0.0 {
                random.between(-3.0, 3.0)
            } else {
                side * random.between(8.0, 16.0)
            };
            let part = random.between(0.65, 0.85);
            let distance = focal * f64::from(PANEL.0) * PIXEL / (part * f64::from(PHOTO.0));
            let up = random.between(-8.0, 8.0f64).to_radians();
            let aside = degrees.to_radians();
            Shot {
                size: PHOTO,
                eye: [
                    distance * aside.sin() * up.cos(),
                    distance * up.sin(),
                    distance * aside.cos() * up.cos(),
                ],
                aim: [
                    random.between(-0.03, 0.03),
                    random.between(-0.03, 0.03),
                    random.between(-0.06, 0.06),
                ],
                focal,
                axis,
                k1,
                vignette: random.between(0.0, 0.4),
                blur: random.between(0.4, 1.8),
                white: [0, 1, 2].map(|_| white * random.between(0.75, 1.2)),
                crosstalk,
                lamp: None,
                wall: random.between(0.02, 0.3),
            }
        });
        let diagonal = f64::from(PHOTO.0).hypot(f64::from(PHOTO.1));
        let equivalent = (focal / diagonal * 43.267 * random.between(0.98, 1.02)).round();
        Self {
            sheet,
            setup,
            shots: shots.into(),
            equivalent: (random.unit() < 0.75).then_some(equivalent),
        }
    }
}
