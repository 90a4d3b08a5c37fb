//! The camera of a program that has no matrix for it, by the clip-space positions of its vertices.
//!
//! The shift of a view, `x_i = x + sep_i·(w − conv)` (see [`super::parallax`]), needs no matrix, only w. What the cameras are placed by is the depths, and in perspective
//! the depth in normalised device coordinates is `z/w = α + β/w`. So two vertices tell the mapping between depths and distances; more of them tell whether there is one.

/// The angle of view from the bottom to the top, which positions do not tell: 60 degrees. It matters only to a user who gives the spacing of the eyes.
const TANGENT: f64 = 0.577_350_269_189_625_8;
/// The largest distance has to be so many times the least: in less, what is measured is rounding.
const LEAST_RANGE: f64 = 1.01;
/// The least range of depths that is told apart from rounding, in normalised device coordinates.
const LEAST_DEPTHS: f64 = 1e-5;
/// How far depths may be off the line, as a part of their range, as a root mean square.
const OFF: f64 = 0.01;
/// Vertices that are measured, at the least.
const FEWEST: usize = 3;

/// A projection (column-major) under which depths and w are those of these positions in clip space: `[x, y, z, w]`. `aspect` is width over height of the picture. None where w does
/// not vary, or where the depths do not follow it as in perspective.
pub fn camera(positions: &[[f32; 4]], aspect: f64) -> Option<[f32; 16]> {
    // A w of 1 is that of what has no place in the scene.
    let before = |p: &&[f32; 4]| p.iter().all(|v| v.is_finite()) && p[3] > 0.0 && p[3] != 1.0;
    // Inverse distances and depths.
    let points: Vec<[f64; 2]> = positions
        .iter()
        .filter(before)
        .map(|&[_, _, z, w]| [1.0 / f64::from(w), f64::from(z) / f64::from(w)])
        .collect();
    let range = |axis: usize| {
        let values = points.iter().map(|p| p[axis]);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| {
            [low.min(v), high.max(v)]
        })
    };
    let ([far, near], [low, high]) = (range(0), range(1));
    if points.len() < FEWEST || near < LEAST_RANGE * far || high - low < LEAST_DEPTHS {
        return None;
    }
    let count = points.len() as f64;
    let mean = [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / count);
    let [mut across, mut along] = [0.0; 2];
    for [inverse, depth] in &points {
        across += (inverse - mean[0]).powi(2);
        along += (inverse - mean[0]) * (depth - mean[1]);
    }
    let slope = along / across;
    let offset = mean[1] - slope * mean[0];
    let squares = points
        .iter()
        .map(|[inverse, depth]| (depth - offset - slope * inverse).powi(2));
    let off = (squares.sum::<f64>() / count).sqrt();
    if off.is_nan() || off > OFF * (high - low) {
        return None;
    }
    let up = 1.0 / TANGENT;
    let mut p = [0.0f32; 16];
    // z = α·w + β where w = −z of the eye.
    for (at, value) in [
        (0, up / aspect),
        (5, up),
        (10, -offset),
        (11, -1.0),
        (14, slope),
    ] {
        p[at] = value as f32;
    }
    Some(p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat4, Vec4};

    /// Positions that a projection gives to points of a room before the eye, some of them behind it.
    fn positions(p: &Mat4) -> Vec<[f32; 4]> {
        // Parts of an irrational step are spread evenly.
        let part = |i: u16, step: f32| (f32::from(i) * step).fract();
        let point = |i: u16| {
            let [x, y] = [0.618_034, 0.414_213_57].map(|step| 40.0 * part(i, step) - 20.0);
            Vec4::new(x, y, 63.0 * part(i, 0.732_050_8) - 60.0, 1.0)
        };
        (0..300).map(|i| (*p * point(i)).to_array()).collect()
    }

    #[test]
    fn the_mapping_of_every_perspective_is_found() {
        use glam::camera::rh::proj::{directx, opengl};
        let all = [
            opengl::perspective(0.9, 1.5, 0.5, 200.0),
            opengl::perspective(0.9, 1.5, 0.01, 10_000.0),
            directx::perspective(0.9, 1.5, 0.5, 200.0),
            directx::perspective_infinite_reverse(0.9, 1.5, 0.1),
            // Sheared, as the eye of a stereo pair.
            Mat4::from_translation(glam::Vec3::new(0.3, 0.0, 0.0))
                * opengl::perspective(0.9, 1.5, 0.5, 200.0),
        ];
        for p in &all {
            let found = camera(&positions(p), 1.5).expect("a camera");
            let own = p.to_cols_array();
            // The same depths: rows 2 and 3.
            for at in [10, 14] {
                let off = (found[at] - own[at]).abs();
                assert!(off <= 2e-3 * own[14].abs().max(1e-4), "{found:?} {own:?}");
            }
            assert_eq!(
                [found[3], found[7], found[11], found[15]],
                [0.0, 0.0, -1.0, 0.0]
            );
            assert!((found[5] / found[0] - 1.5).abs() < 1e-5);
        }
    }

    #[test]
    fn what_has_no_perspective_has_no_camera() {
        let flat = glam::camera::rh::proj::opengl::orthographic(-9.0, 9.0, -6.0, 6.0, 1.0, 90.0);
        assert_eq!(camera(&positions(&flat), 1.5), None, "w is 1");
        let screen: Vec<[f32; 4]> = (0..40u8)
            .map(|i| {
                let w = 1.0 + f32::from(i);
                [0.0, 0.0, 0.25 * w, w]
            })
            .collect();
        assert_eq!(
            camera(&screen, 1.5),
            None,
            "one depth: textures in perspective on a sign"
        );
        let logarithmic: Vec<[f32; 4]> = (1..400u16)
            .map(|i| {
                let w = f32::from(i);
                [0.0, 0.0, (w.ln() / 3.0 - 1.0) * w, w]
            })
            .collect();
        assert_eq!(
            camera(&logarithmic, 1.5),
            None,
            "depths by the logarithm of w"
        );
        assert_eq!(camera(&[[f32::NAN; 4]; 9], 1.5), None);
        assert_eq!(
            camera(&[[0.0, 0.0, 0.0, -1.0]; 9], 1.5),
            None,
            "all behind the eye"
        );
        assert_eq!(camera(&[], 1.5), None);
    }
}
