//! The picture of Gaussians by the published equations, in double precision, pixel by pixel; slow.

use super::{BLUR, Gaussians, LEAST_ALPHA, MOST_ALPHA, harmonics};
use glam::{DMat3, DVec2, DVec3, Mat4, Vec3};

/// A camera: from the world to the camera, which looks along −z, and pixels that a length of one has at a distance of one.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Right-handed.
    pub view: Mat4,
    /// Where it is.
    pub eye: Vec3,
    /// The focal length in pixels.
    pub pixels: f64,
    /// By how much the picture is moved to the right, in pixels: a frustum that is sheared.
    pub shift: f64,
    /// Nearer than this nothing is drawn.
    pub near: f64,
}

/// A Gaussian in the picture (equation 5: Σ' = J W Σ Wᵀ Jᵀ).
struct Footprint {
    depth: f64,
    middle: DVec2,
    /// The inverse of Σ': xx, xy, yy.
    conic: [f64; 3],
    opacity: f64,
    colour: Vec3,
    /// Half of the sides of the box in which it is not too faint.
    reach: DVec2,
}

/// Red, green and blue of each pixel, rows from the top, over a colour.
#[must_use]
pub fn picture(
    gaussians: &Gaussians,
    camera: &Camera,
    [width, height]: [u32; 2],
    background: Vec3,
) -> Vec<[u8; 3]> {
    let size = DVec2::new(width.into(), height.into());
    let mut all: Vec<_> = (0..gaussians.all.len())
        .filter_map(|number| footprint(gaussians, number, camera, size))
        .collect();
    all.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    let mut colours = vec![DVec3::ZERO; width as usize * height as usize];
    let mut left = vec![1.0; colours.len()];
    // Front to back: Σ c·α·Π(1 − α) (equation 3).
    for one in &all {
        let low = (one.middle - one.reach).floor().max(DVec2::ZERO);
        let high = (one.middle + one.reach).ceil().min(size);
        for y in low.y as u32..high.y as u32 {
            for x in low.x as u32..high.x as u32 {
                let away = DVec2::new(x.into(), y.into()) + 0.5 - one.middle;
                let [xx, xy, yy] = one.conic;
                let power =
                    0.5 * (xx * away.x * away.x + yy * away.y * away.y) + xy * away.x * away.y;
                let alpha = (one.opacity * (-power).exp()).min(MOST_ALPHA.into());
                if alpha >= f64::from(LEAST_ALPHA) {
                    let at = ((height - 1 - y) * width + x) as usize;
                    colours[at] += one.colour.as_dvec3() * alpha * left[at];
                    left[at] *= 1.0 - alpha;
                }
            }
        }
    }
    let finish = |(colour, left): (&DVec3, &f64)| {
        let colour = *colour + background.as_dvec3() * *left;
        (colour.clamp(DVec3::ZERO, DVec3::ONE) * 255.0)
            .round()
            .to_array()
            .map(|value| value as u8)
    };
    colours.iter().zip(&left).map(finish).collect()
}

fn footprint(
    gaussians: &Gaussians,
    number: usize,
    camera: &Camera,
    size: DVec2,
) -> Option<Footprint> {
    let one = gaussians.all.get(number)?;
    let t = camera
        .view
        .as_dmat4()
        .transform_point3(one.place.as_dvec3());
    let depth = -t.z;
    if depth < camera.near {
        return None;
    }
    let focal = camera.pixels;
    // Far outside of the picture the linear approximation is too far off, so it is taken at its edge.
    let edge = 1.3 * size / 2.0 / focal;
    let slope = (t.truncate() / depth).clamp(-edge, edge);
    // Of x and y of the picture by x, y and z of the camera, which looks along −z.
    let jacobian = DMat3::from_cols(
        DVec3::new(focal / depth, 0.0, 0.0),
        DVec3::new(0.0, focal / depth, 0.0),
        DVec3::new(slope.x, slope.y, 0.0) * focal / depth,
    );
    let turn = jacobian * DMat3::from_mat4(camera.view.as_dmat4());
    let spread = turn * one.covariance().as_dmat3() * turn.transpose();
    let (xx, xy, yy) = (
        spread.x_axis.x + f64::from(BLUR),
        spread.x_axis.y,
        spread.y_axis.y + f64::from(BLUR),
    );
    let determinant = xx * yy - xy * xy;
    let opacity = f64::from(one.opacity);
    let faint = 2.0 * (opacity / f64::from(LEAST_ALPHA)).ln();
    if determinant <= 0.0 || faint <= 0.0 {
        return None;
    }
    let direction = (one.place - camera.eye).normalize_or_zero();
    Some(Footprint {
        depth,
        middle: size / 2.0 + t.truncate() / depth * focal + DVec2::new(camera.shift, 0.0),
        conic: [yy / determinant, -xy / determinant, xx / determinant],
        opacity,
        colour: harmonics::colour(gaussians.colour(number), direction),
        reach: DVec2::new(xx, yy)
            .max(DVec2::ZERO)
            .map(|variance| (faint * variance).sqrt())
            + 1.0,
    })
}

#[cfg(test)]
mod tests {
    use super::{Camera, picture};
    use crate::gaussian::{Gaussian, Gaussians, harmonics};
    use glam::{Mat4, Quat, Vec3};

    /// A ball in the middle has its colour there, and the background's at the edge; its width is that of its standard deviation.
    #[test]
    fn one_ball() {
        let gaussians = Gaussians {
            all: vec![Gaussian {
                place: Vec3::new(0.0, 0.0, -10.0),
                scale: Vec3::ONE,
                rotation: Quat::IDENTITY,
                opacity: 0.9,
            }],
            colours: vec![harmonics::constant(Vec3::X)],
            coefficients: 1,
            skipped: 0,
        };
        let camera = Camera {
            view: Mat4::IDENTITY,
            eye: Vec3::ZERO,
            pixels: 100.0,
            shift: 0.0,
            near: 0.1,
        };
        let seen = picture(&gaussians, &camera, [101, 101], Vec3::Z);
        let at = |x: usize, y: usize| seen[y * 101 + x];
        assert!([229, 230].contains(&at(50, 50)[0]));
        assert_eq!(at(0, 0), [0, 0, 255]);
        // Ten pixels are a standard deviation; the blur adds 0.3 to 100.
        let want = 0.9 * (-0.5_f64 * 100.0 / 100.3).exp() * 255.0;
        assert!((f64::from(at(60, 50)[0]) - want).abs() <= 1.0);
        assert_eq!(at(60, 50), at(50, 40));
    }
}
