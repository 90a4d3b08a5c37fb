//! An optical simulator of a glasses-free 3D panel that a phone photographs.
//!
//! It is an oracle for tests of a calibration. It knows nothing of the code under test: it traces rays and takes pictures.
//!
//! Panel space: the origin is the centre of the panel in the plane of its pixels, x points right and y up as a viewer sees them,
//! z towards the viewer. The unit is the millimetre. Pixel coordinates are continuous: column 0 is the left edge of the first
//! pixel, row 0 is the top edge of the first pixel, rows count downwards. Angles are in radians unless a name says degrees.
//! Colours are numbered 0 red, 1 green, 2 blue. Light is linear: 1 is the mean of a white panel.

pub mod camera;
pub mod compare;
pub mod displays;
pub mod exif;
pub mod eye;
pub mod light;
pub mod panel;
pub mod random;
pub mod scenario;
pub mod scene;
pub mod sensor;
pub mod sheet;
pub mod vector;

use displays::Display;
use image::RgbImage;
use image::imageops::FilterType;
use scene::{Room, Scene};
use sensor::Sensor;

/// What becomes of a photo after the camera has developed it.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// Quality of the JPEG file, 1 to 100.
    pub quality: u8,
    /// The 35 mm focal length that the file claims, in mm. None writes no EXIF data.
    pub claimed_focal: Option<f64>,
    /// Longer side in px that the picture is scaled down to before it is encoded.
    pub longest: Option<u32>,
}

/// One photo: where the camera is, the room, the sensor and the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    pub camera: camera::Camera,
    pub room: Room,
    pub sensor: Sensor,
    pub file: File,
}

/// The picture that the camera takes of a display whose pixels hold `shown`, scaled as the file asks.
///
/// `shown` is what the pixels really hold: apply [`panel::Showing`] first. Parts of the panel without a picture are black.
pub fn photograph(display: &Display, shown: &RgbImage, shot: &Shot) -> RgbImage {
    let scene = Scene::new(display, shown, &shot.room);
    let picture = sensor::expose(&scene, &shot.camera, &shot.sensor);
    let (width, height) = picture.dimensions();
    match shot.file.longest {
        Some(longest) if longest < width.max(height) => {
            let side = |length: u32| {
                (f64::from(length) * f64::from(longest) / f64::from(width.max(height))).round()
                    as u32
            };
            image::imageops::resize(
                &picture,
                side(width).max(1),
                side(height).max(1),
                FilterType::Triangle,
            )
        }
        _ => picture,
    }
}

/// The same as a JPEG file with the EXIF data that the shot asks for.
pub fn photograph_jpeg(
    display: &Display,
    shown: &RgbImage,
    shot: &Shot,
) -> image::ImageResult<Vec<u8>> {
    exif::jpeg(
        &photograph(display, shown, shot),
        shot.file.quality,
        shot.file.claimed_focal,
    )
}

#[cfg(test)]
mod tests {
    use super::scenario::{First, Taking, scenario};
    use super::*;

    fn small_photo(name: &str) -> Vec<u8> {
        let display = displays::small();
        let taking = Taking {
            photos: 1,
            first: First::Anywhere,
            size: [504, 378],
            seed: 3,
        };
        let scenario = scenario(name, &display, taking).expect("a listed name");
        let picture = RgbImage::from_fn(640, 400, |x, y| {
            image::Rgb([(x % 256) as u8, (y % 256) as u8, 128])
        });
        let shown = scenario.showing.apply(&scenario.display.panel, &picture);
        photograph_jpeg(&scenario.display, &shown, &scenario.shots[0])
            .expect("an encoder that writes to memory")
    }

    /// Every situation gives a picture, the same bytes each time, and no two give the same.
    #[test]
    fn photos_are_equal_byte_for_byte() {
        let mut files: Vec<Vec<u8>> = scenario::ALL
            .iter()
            .map(|(name, _)| small_photo(name))
            .collect();
        for ((name, _), file) in scenario::ALL.iter().zip(&files) {
            assert_eq!(*file, small_photo(name), "{name}");
        }
        files.sort();
        files.dedup();
        assert_eq!(files.len(), scenario::ALL.len());
    }

    /// A camera sees what an eye at its place sees: white over the panel where one view is white, and black from half a cone away.
    #[test]
    fn a_camera_sees_one_view() {
        let display = displays::small();
        let truth = eye::Truth::new(&display);
        let shown = truth.picture(|view| if (view - 4.0).abs() < 1.5 { 255 } else { 0 });
        let mut shot = scenario(
            "ordinary",
            &display,
            Taking {
                photos: 1,
                first: First::Anywhere,
                size: [1008, 756],
                seed: 3,
            },
        )
        .expect("a listed name")
        .shots
        .remove(0);
        let mut mean = |x: f64| {
            shot.camera.position = [x, 0.0, truth.eye[2]];
            shot.camera.aim([0.0; 3]);
            shot.camera.focal = 1008.0 * display.distance / 260.0;
            let photo = photograph(&display, &shown, &shot);
            let place = |at: [f64; 2]| {
                shot.camera
                    .project([at[0], at[1], 0.0])
                    .expect("in front of the camera")
            };
            let block = |at: [f64; 2]| {
                let [u, v] = place(at);
                let codes = (0..400).map(|i| {
                    photo
                        .get_pixel(u as u32 + i % 20 - 10, v as u32 + i / 20 - 10)
                        .0
                });
                codes
                    .map(|p| p.map(f64::from).iter().sum::<f64>() / 3.0)
                    .sum::<f64>()
                    / 400.0
            };
            [
                [-70.0, 40.0],
                [70.0, 40.0],
                [-70.0, -40.0],
                [70.0, -40.0],
                [0.0, 0.0],
            ]
            .map(block)
        };
        let white = mean(0.0);
        let black = mean(display.distance * (display.cone / 2.0).tan());
        assert!(
            white.iter().all(|v| *v > 120.0) && black.iter().all(|v| *v < 60.0),
            "{white:?} {black:?}"
        );
    }
}
