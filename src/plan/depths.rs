//! From the depths of a depth buffer back to distances, as 1/w of clip space.
//!
//! A disparity is sep·(1 − conv/w) (see [`super::parallax`]), which is linear in 1/w. The depth of a perspective projection is linear in
//! 1/w as well. So disparity is linear in depth, in whichever direction depths grow and wherever the far plane lies.

use crate::config::Viewport;

/// One sample in so many is ignored at the far end, and as many at the near end.
pub const OUTLIERS: usize = 200;

/// How many depth mappings are told apart in one picture.
const MOST: usize = 8;

/// The line from window depths to 1/w, for one projection and one depth range: `1/w = slope·depth + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// glDepthRange, the smaller value first.
    range: [f64; 2],
    slope: f64,
    offset: f64,
}

impl Ramp {
    /// For a projection (column-major) and a depth range; `zero_to_one`: normalised depths begin at 0 (glClipControl).
    /// `None` where depth is not linear in 1/w: without perspective, or with an oblique near plane.
    pub fn of(p: &[f32; 16], range: [f32; 2], zero_to_one: bool) -> Option<Ramp> {
        let row = |r: usize| {
            let [x, y, z] = [p[r], p[r + 4], p[r + 8]].map(f64::from);
            (glam::DVec3::new(x, y, z), f64::from(p[r + 12]))
        };
        let ((z, z_constant), (w, w_constant)) = (row(2), row(3));
        // z_ndc = a + b/w, where row 2 is a times row 3 plus a constant.
        let a = z.dot(w) / w.length_squared();
        let b = z_constant - a * w_constant;
        let [near, far] = range.map(f64::from);
        let depth = if zero_to_one { 1.0 } else { 2.0 } / (far - near);
        let ramp = Ramp {
            range: [near.min(far), near.max(far)],
            slope: depth / b,
            offset: (-near * depth - if zero_to_one { 0.0 } else { 1.0 } - a) / b,
        };
        let oblique = (z - a * w).length() > 1e-4 * z.length();
        let found = ramp.slope.is_finite() && ramp.offset.is_finite() && ramp.slope != 0.0;
        (found && !oblique).then_some(ramp)
    }

    /// For an orthographic scene, in a depth range. In place of 1/w it has the part of the way from the far plane to the near one.
    /// `reversed`: nearer points have larger depths.
    pub fn orthographic(range: [f32; 2], reversed: bool) -> Option<Ramp> {
        let [low, high] = [range[0].min(range[1]), range[0].max(range[1])].map(f64::from);
        let part = 1.0 / (high - low);
        let (slope, offset) = match reversed {
            true => (part, -low * part),
            false => (-part, high * part),
        };
        part.is_finite().then_some(Ramp {
            range: [low, high],
            slope,
            offset,
        })
    }

    /// Slope and offset of 1/w over the window depth.
    pub fn line(&self) -> [f64; 2] {
        [self.slope, self.offset]
    }

    /// Whether nearer points have larger depths.
    pub fn nearer_is_larger(&self) -> bool {
        self.slope > 0.0
    }

    /// Whether both turn depths into the same distances, but for rounding.
    pub fn is_like(&self, other: &Ramp) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * b.abs();
        self.range == other.range
            && near(self.slope, other.slope)
            && near(self.offset, other.offset)
    }

    /// The depth that separates `part` from this ramp. `part` is the same projection in a narrower depth range that begins at the nearest
    /// depth, for objects before everything else, such as a weapon in the hand; `self` has almost nothing there. None where `part` is not
    /// such a part.
    pub fn nearer_part(&self, part: &Ramp) -> Option<f64> {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-6;
        let [from, to] = match self.nearer_is_larger() {
            true => [part.range[1], part.range[0]],
            false => [part.range[0], part.range[1]],
        };
        let nearest = match self.nearer_is_larger() {
            true => self.range[1],
            false => self.range[0],
        };
        // `part` ends at least at half of the nearest 1/w, which is twice the distance of the near plane.
        let most = self.inverse(to) >= 0.5 * self.inverse(nearest);
        let same = near(part.inverse(from), self.inverse(nearest));
        (near(from, nearest) && same && most).then_some(to)
    }

    fn holds(&self, depth: f64) -> bool {
        (self.range[0]..=self.range[1]).contains(&depth)
    }

    /// 1/w at a window depth; 0, infinitely far, at the least.
    fn inverse(&self, depth: f64) -> f64 {
        (self.slope * depth + self.offset).max(0.0)
    }
}

/// A projection and depth range that a scene is drawn with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthMapping {
    ramp: Ramp,
    /// Its projection.
    pub projection: [f32; 16],
    /// The distance of zero parallax that a profile gives to its draws, in eye-space units.
    pub focal: Option<f64>,
    /// Its draws come before everything else, such as the weapon in a player's hand.
    pub foreground: bool,
    draws: u32,
}

impl DepthMapping {
    /// How many draws used it.
    pub fn draws(&self) -> u32 {
        self.draws
    }
}

/// The depth mappings of a picture so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DepthMappings {
    mappings: Vec<DepthMapping>,
    /// A sky has been drawn: pixels without a depth are infinitely far.
    pub sky: bool,
}

impl DepthMappings {
    /// Counts a draw of the scene, unless its viewport is a picture in the picture.
    /// `focal` and `foreground` as in [`DepthMapping`].
    pub fn drawn(
        &mut self,
        ramp: Ramp,
        p: &[f32; 16],
        (focal, foreground): (Option<f64>, bool),
        viewport: Viewport,
    ) {
        if viewport == Viewport::Inset {
            return;
        }
        // A camera that is multiplied into the projection leaves rounding errors.
        let same = |w: &&mut DepthMapping| {
            w.ramp.is_like(&ramp) && w.focal == focal && w.foreground == foreground
        };
        if let Some(mapping) = self.mappings.iter_mut().rev().find(same) {
            mapping.draws = mapping.draws.saturating_add(1);
        } else if self.mappings.len() < MOST {
            self.mappings.push(DepthMapping {
                ramp,
                projection: *p,
                focal,
                foreground,
                draws: 1,
            });
        }
    }

    /// The depths are cleared; a sky stays visible.
    pub fn clear(&mut self) {
        self.mappings.clear();
    }

    /// Whether there is anything to measure.
    pub fn is_empty(&self) -> bool {
        self.mappings.is_empty()
    }

    /// The mapping of most draws of the scene, among those without a zero parallax of their own.
    pub fn most(&self) -> Option<&DepthMapping> {
        self.mappings
            .iter()
            .filter(|w| w.focal.is_none() && !w.foreground)
            .max_by_key(|w| w.draws)
    }

    /// The mapping that a depth was drawn with: of those whose range contains it the narrowest, because a weapon in the hand has a narrow range
    /// inside the scene's.
    fn mapping(&self, depth: f64) -> Option<&DepthMapping> {
        let width = |w: &DepthMapping| w.ramp.range[1] - w.ramp.range[0];
        let within = self.mappings.iter().filter(|w| w.ramp.holds(depth));
        within.min_by(|a, b| {
            width(a)
                .total_cmp(&width(b))
                .then_with(|| b.draws.cmp(&a.draws))
        })
    }

    /// The distances in a picture of window depths; `clear` is the depth of pixels on which nothing was drawn.
    pub fn distances(&self, depths: &[f32], clear: f32) -> Distances {
        let mut found = Distances::default();
        for &depth in depths {
            // Depths of 24 bits come back with an error of one step.
            if (depth - clear).abs() < 1e-7 {
                found.sky |= self.sky;
            } else if let Some(mapping) = self.mapping(depth.into()) {
                let inverse = mapping.ramp.inverse(depth.into());
                match mapping.focal {
                    None if mapping.foreground => found.foreground.push(inverse),
                    None => found.scene.push(inverse),
                    Some(focal) => found.others.push((inverse, focal)),
                }
            }
        }
        found.scene.sort_unstable_by(f64::total_cmp);
        found.foreground.sort_unstable_by(f64::total_cmp);
        found
    }
}

/// Distances of a picture's samples, as 1/w.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Distances {
    /// 1/w of the scene, from far to near.
    pub scene: Vec<f64>,
    /// 1/w of what is drawn before everything else, from far to near.
    pub foreground: Vec<f64>,
    /// 1/w of samples with a zero parallax of their own, and the distance of that, in eye-space units.
    pub others: Vec<(f64, f64)>,
    /// A sky is visible.
    pub sky: bool,
}

impl Distances {
    /// Adds the distances of another picture of the same frame.
    pub fn join(&mut self, other: Distances) {
        self.scene.extend(other.scene);
        self.scene.sort_unstable_by(f64::total_cmp);
        self.foreground.extend(other.foreground);
        self.foreground.sort_unstable_by(f64::total_cmp);
        self.others.extend(other.others);
        self.sky |= other.sky;
    }

    /// 1/w of the farthest, the median and the nearest sample of the scene. One sample in 200 is ignored at either end, so that a passing
    /// spark moves no cameras.
    pub fn scene(&self) -> Option<[f64; 3]> {
        range(&self.scene)
    }

    /// The same of what is drawn before everything else.
    pub fn foreground(&self) -> Option<[f64; 3]> {
        range(&self.foreground)
    }
}

/// Of sorted samples, the least, the median and the largest without outliers.
fn range(samples: &[f64]) -> Option<[f64; 3]> {
    let (count, outliers) = (samples.len(), samples.len() / OUTLIERS);
    let at = |index: usize| samples.get(index).copied();
    Some([
        at(outliers)?,
        at(count / 2)?,
        at(count.checked_sub(outliers + 1)?)?,
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat4, Vec4};

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-4 * b.abs().max(1e-3)
    }

    /// A perspective projection of a camera that looks along −z (`w` = −1) or z, with the normalised depths of its near and far plane.
    fn perspective(w: f32, [near, far]: [f32; 2], [at_near, at_far]: [f32; 2]) -> Mat4 {
        let b = (at_near - at_far) / (1.0 / near - 1.0 / far);
        let a = at_near - b / near;
        Mat4::from_cols_array(&[
            1.4,
            0.0,
            0.0,
            0.0,
            0.0,
            1.8,
            0.0,
            0.0,
            0.1,
            0.0,
            a * w,
            w,
            0.0,
            0.0,
            b,
            0.0,
        ])
    }

    const GL: [f32; 2] = [-1.0, 1.0];
    const PLANES: [f32; 2] = [0.5, 90.0];

    /// Window depth of a point, and its 1/w.
    fn depth(p: Mat4, at: Vec4, range: [f32; 2], zero_to_one: bool) -> (f32, f64) {
        let clip = p * at;
        let ndc = clip.z / clip.w;
        let unit = if zero_to_one { ndc } else { ndc * 0.5 + 0.5 };
        (
            range[0] + (range[1] - range[0]) * unit,
            1.0 / f64::from(clip.w),
        )
    }

    #[test]
    fn distances_come_back_from_every_kind_of_depth() {
        let camera = Mat4::from_rotation_y(0.4) * Mat4::from_rotation_x(-0.3);
        let plain = perspective(-1.0, PLANES, GL);
        let reversed = perspective(-1.0, [0.5, f32::INFINITY], [1.0, 0.0]);
        let cases = [
            (plain, [0.0, 1.0], false),
            (plain, [0.0, 0.3], false),
            (plain, [1.0, 0.0], false),
            (plain * camera, [0.0, 1.0], false),
            (perspective(-1.0, PLANES, [0.0, 1.0]), [0.0, 1.0], true),
            (reversed, [0.0, 1.0], true),
            (reversed * camera, [0.0, 1.0], true),
            (perspective(1.0, PLANES, [0.0, 1.0]), [0.25, 0.75], true),
        ];
        for (p, range, zero_to_one) in cases {
            let ramp = Ramp::of(&p.to_cols_array(), range, zero_to_one).expect("a ramp");
            let turned = (p == reversed || p == reversed * camera) != (range == [1.0, 0.0]);
            assert_eq!(ramp.nearer_is_larger(), turned);
            for z in [-1.0_f32, -3.0, -20.0, 1.0, 3.0, 20.0] {
                let at = Vec4::new(0.3, -0.2, z, 1.0);
                let (depth, inverse) = depth(p, at, range, zero_to_one);
                if inverse > 0.0 && (0.0..=1.0).contains(&depth) {
                    assert!(
                        near(ramp.inverse(depth.into()), inverse),
                        "{p} {z}: {} {inverse}",
                        ramp.inverse(depth.into())
                    );
                }
            }
        }
    }

    #[test]
    fn what_has_no_distance_has_no_ramp() {
        let whole = [0.0, 1.0];
        let flat = Mat4::from_scale(glam::Vec3::new(2.0 / 64.0, 2.0 / 48.0, -1.0));
        assert_eq!(Ramp::of(&flat.to_cols_array(), whole, false), None);
        let mut oblique = perspective(-1.0, PLANES, GL);
        oblique.x_axis.z = 0.7;
        assert_eq!(Ramp::of(&oblique.to_cols_array(), whole, false), None);
        let plain = perspective(-1.0, PLANES, GL).to_cols_array();
        assert_eq!(Ramp::of(&plain, [0.5, 0.5], false), None);
    }

    #[test]
    fn outliers_do_not_count() {
        let mut scene = vec![0.1; 1000];
        scene[..5].fill(0.0);
        scene[995..].fill(3.0);
        let distances = |scene: &[f64]| Distances {
            scene: scene.to_vec(),
            ..Distances::default()
        };
        assert_eq!(distances(&scene).scene(), Some([0.1; 3]));
        scene[994] = 3.0;
        assert_eq!(distances(&scene).scene(), Some([0.1, 0.1, 3.0]));
        assert_eq!(distances(&[0.5]).scene(), Some([0.5; 3]));
        assert_eq!(distances(&[]).scene(), None);
    }

    #[test]
    fn a_weapon_keeps_its_range_and_the_background_its_distance() {
        let scene = perspective(-1.0, [1.0, 100.0], GL);
        let p = scene.to_cols_array();
        let whole = Ramp::of(&p, [0.0, 1.0], false).expect("a ramp");
        let narrow = Ramp::of(&p, [0.0, 0.3], false).expect("a ramp");
        let mut mappings = DepthMappings::default();
        for _ in 0..5 {
            mappings.drawn(whole, &p, (None, false), Viewport::Main);
        }
        mappings.drawn(narrow, &p, (Some(2.0), false), Viewport::Main);
        mappings.drawn(narrow, &p, (None, false), Viewport::Inset);
        let at = |z: f32, range| depth(scene, Vec4::new(0.0, 0.0, z, 1.0), range, false).0;
        let depths = [
            at(-50.0, [0.0, 1.0]),
            at(-10.0, [0.0, 1.0]),
            1.0,
            at(-2.5, [0.0, 0.3]),
        ];
        let found = mappings.distances(&depths, 1.0);
        let [far, middle, nearest] = found.scene().expect("a scene");
        assert!(near(far, 0.02) && near(nearest, 0.1) && middle == nearest);
        assert!(matches!(found.others[..], [(inverse, 2.0)] if near(inverse, 0.4)));
        assert!(!found.sky);
        mappings.sky = true;
        assert!(mappings.distances(&depths, 1.0).sky);
    }
}
