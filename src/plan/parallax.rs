//! The one equation: camera i is the program's camera moved along its x axis, with the frustum sheared so that the focal depth
//! keeps its place.
//!
//! Based on: Luo et al., "GPU-based multi-view rendering for spatial-multiplex autostereoscopic displays" (GBMVR), section III,
//! Δx = A·κ·(1 − z/ξ), written for homogeneous coordinates:
//! row0(P_i) = row0(P) + sep_i·row3(P) − sep_i·conv·(0,0,0,1), sep_i = A·e_i/ξ, conv = ξ, e_i = (i − (N−1)/2)·κ.

use super::{camera, comfort};
use crate::config::profile::FARTHEST;
use crate::config::{Camera, Kept};
use crate::view::ViewIndex;

/// The cameras of all views.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// N.
    pub views: u32,
    camera: Camera,
    /// The focal depth for [`Camera::Auto`] and for the first cameras of [`Camera::Measured`], where it is known for the program.
    focal: Option<f64>,
    latched: Option<(f64, f64)>,
    /// Separation and convergence of what is drawn before everything else, where they differ from those of the scene.
    foreground: Option<(f64, f64)>,
    /// What the display can show, once it is known.
    reach: Option<comfort::Reach>,
    /// A per unit of row 3, of the last perspective projection that was drawn with.
    a: Option<f64>,
    /// Where a sky stands: 1 infinitely far, or the end of what the display can show.
    farthest: f64,
    /// All cameras stand where the program's own does.
    flat: bool,
}

/// The shift of one draw's views in clip space: `x_i = x + sep_i·(w − conv·w_eye)`, `sep_i = a·e_i/focal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// A, per unit of row 3.
    pub a: f64,
    /// κ.
    pub spacing: f64,
    /// ξ.
    pub focal: f64,
    /// Zero parallax, in units of clip-space w.
    pub conv: f64,
}

/// Disparity at infinity between the outermost views that [`Camera::Auto`] gives, in units of normalised device coordinates:
/// 8 views of a 640 px window then differ by 1.8 px from neighbour to neighbour, about the limit of aliasing between views.
const AUTO_TOTAL_SEPARATION: f64 = 0.04;

impl Rig {
    /// The cameras for N views. `focal` is the focal depth of cameras that the user does not place, where it is known for the program.
    pub fn new(views: u32, camera: Camera, focal: Option<f64>) -> Self {
        Rig {
            views,
            camera,
            focal,
            latched: None,
            foreground: None,
            reach: None,
            a: None,
            farthest: FARTHEST,
            flat: false,
        }
    }

    /// Sets other cameras; with `flat`, all of them stand where the program's own does.
    pub fn change(&mut self, camera: Camera, flat: bool) {
        if camera != self.camera {
            self.farthest = FARTHEST;
            self.foreground = None;
        }
        (self.camera, self.flat) = (camera, flat);
    }

    /// Tells what the display can show: before the cameras of [`Camera::Measured`] are found, they stand so that nothing leaves it.
    pub fn set_reach(&mut self, reach: comfort::Reach) {
        self.reach = Some(reach);
    }

    /// Sets separation and convergence for [`Camera::Measured`], as [`super::Comfort`] finds them. `farthest` is where a sky stands, as for
    /// [`Rig::at_depth`]; `foreground` has the cameras of what is drawn before everything else, where they differ.
    pub fn set_measured(
        &mut self,
        cameras: (f64, f64),
        farthest: f64,
        foreground: Option<(f64, f64)>,
    ) {
        self.latched = Some(cameras);
        self.farthest = farthest;
        self.foreground = foreground;
    }

    /// The shift of a sky.
    pub fn sky(&self, p: &[f32; 16]) -> Option<Shear> {
        self.at_depth(p, self.farthest)
    }

    /// Position of a view in units of the spacing: −(N−1)/2 … (N−1)/2; 0 is the program's own camera.
    pub fn position(&self, view: ViewIndex) -> f64 {
        if self.flat {
            return 0.0;
        }
        f64::from(view.0) - (f64::from(self.views) - 1.0) / 2.0
    }

    /// Takes note of a perspective projection that the program draws its scene with. With [`Camera::Auto`], the first one fixes the focal
    /// depth, where none is given: the geometric mean of its near and far distance, the far one at most 1000 near distances away. With
    /// [`Camera::Measured`], the first one places the cameras until depths are measured: all from its near plane on is within the budget.
    pub fn latch(&mut self, p: &[f32; 16]) {
        if flat(p) {
            return;
        }
        if let Camera::Eye { .. } = self.camera {
            self.a = Some(lens(p).0);
        }
        if self.latched.is_some() {
            return;
        }
        let kept = match self.camera {
            Camera::Auto => None,
            Camera::Measured(kept) => Some(kept),
            _ => return,
        };
        let (_, scale) = lens(p);
        // A camera may stand in the projection; a projection alone is left as it is, to the bit.
        let pure = [p[3], p[7], p[15]] == [0.0; 3];
        let ([near, far], unit) = match camera::equivalent(p).filter(|_| !pure) {
            Some(equivalent) => (planes(&equivalent), 1.0),
            None => (planes(p), scale),
        };
        if !near.is_finite() || near <= 0.0 {
            return;
        }
        if let Some(kept) = kept {
            let focal = self.focal.map(Kept::FocalDepth);
            self.latched = self.within_reach(p, near * unit, kept.or(focal));
        } else {
            let between = || (near * far).sqrt() * unit;
            let convergence = self.focal.map_or_else(between, |focal| focal * scale);
            self.latched = Some((self.auto_step(), convergence));
        }
    }

    /// The cameras that keep everything from the near plane on, in units of clip-space w, within the budget.
    fn within_reach(&self, p: &[f32; 16], near: f64, kept: Option<Kept>) -> Option<(f64, f64)> {
        let limits = self.reach?.limits(lens(p));
        comfort::Comfort::new(kept).track(&comfort::Seen::behind(near), &limits)
    }

    /// Separation of neighbouring views with [`Camera::Auto`].
    fn auto_step(&self) -> f64 {
        AUTO_TOTAL_SEPARATION / f64::from(self.views.max(2) - 1)
    }

    /// Separation of neighbouring views in clip space, and convergence in units of clip-space w, once they are known.
    pub fn latched(&self) -> Option<(f64, f64)> {
        self.latched
    }

    /// The shift of a draw that stands at one depth, whatever its projection: `x_i = x + sep_i·depth·w`. Depth 0 is on the panel, 1 is
    /// infinitely far. `None` where all views are the same, and as long as A is not known from a perspective projection.
    pub fn at_depth(&self, p: &[f32; 16], depth: f64) -> Option<Shear> {
        if self.views < 2 || depth == 0.0 {
            return None;
        }
        let far = match self.camera {
            Camera::Clip { separation, .. } => Shear::in_clip_space(separation, 0.0),
            Camera::Auto => Shear::in_clip_space(self.auto_step(), 0.0),
            Camera::Measured(_) => Shear::in_clip_space(self.latched?.0, 0.0),
            Camera::Eye { .. } if !flat(p) => self.shear(p)?,
            Camera::Eye {
                spacing,
                focal_depth,
            } => Shear {
                a: self.a?,
                spacing,
                focal: focal_depth,
                conv: 0.0,
            },
        };
        Some(Shear {
            spacing: far.spacing * depth,
            conv: 0.0,
            ..far
        })
    }

    /// The shift for a projection (column-major); `None` where all views are the same: one view, orthographic, no projection.
    pub fn shear(&self, p: &[f32; 16]) -> Option<Shear> {
        if self.views < 2 || flat(p) {
            return None;
        }
        match self.camera {
            Camera::Clip {
                separation,
                convergence,
            } => Some(Shear::in_clip_space(separation, convergence)),
            Camera::Auto | Camera::Measured(_) => self
                .latched
                .map(|(separation, conv)| Shear::in_clip_space(separation, conv)),
            Camera::Eye {
                spacing,
                focal_depth,
            } => {
                let (a, scale) = lens(p);
                Some(Shear {
                    a,
                    spacing,
                    focal: focal_depth,
                    conv: focal_depth * scale,
                })
            }
        }
    }

    /// The shift of what is drawn before everything else, such as the weapon in a player's hand.
    pub fn foreground(&self, p: &[f32; 16]) -> Option<Shear> {
        let shear = self.shear(p)?;
        Some(match (self.camera, self.foreground) {
            (Camera::Measured(_), Some((separation, convergence))) => {
                Shear::in_clip_space(separation, convergence)
            }
            _ => shear,
        })
    }

    /// The shift for a draw that has zero parallax at a depth of its own and the common separation at infinity. It looks ξ/`focal`
    /// times as far away and as large as it is.
    pub fn shear_about(&self, p: &[f32; 16], focal: f64) -> Option<Shear> {
        let (_, scale) = lens(p);
        Some(Shear {
            conv: focal * scale,
            ..self.shear(p)?
        })
    }
}

/// Whether row 3 of a projection is (0, 0, 0, k): no perspective, so nothing has a depth to shift by.
pub fn flat(p: &[f32; 16]) -> bool {
    p[3] == 0.0 && p[7] == 0.0 && p[11] == 0.0
}

/// A = P[0][0] = 2·Zn/(r − l), and the length of row 3 (1 for glFrustum), which is the clip-space w per unit of depth.
///
/// A projection that includes the camera's rotation has A spread over row 0. A is the part of row 0 at a right angle to the viewing
/// direction (row 3).
fn focal_length(p: &[f32; 16]) -> (f64, f64) {
    if p[3] == 0.0 && p[7] == 0.0 {
        return (f64::from(p[0]), f64::from(p[11]).abs());
    }
    let row0 = glam::DVec3::new(p[0].into(), p[4].into(), p[8].into());
    let row3 = glam::DVec3::new(p[3].into(), p[7].into(), p[11].into());
    (row0.reject_from(row3).length(), row3.length())
}

/// Distances of the near and the far plane of a perspective projection, in eye-space units; the far one at most 1000 near
/// distances away.
pub fn planes(p: &[f32; 16]) -> [f64; 2] {
    let [a, b, c, d] = [p[10], p[14], p[11], p[15]].map(f64::from);
    // Depth 0 and 1 of the clip range: z = ∓w along the axis, with z = a·z_e + b and w = c·z_e + d.
    let at = |sign: f64| ((sign * d - b) / (a - sign * c)).abs();
    let (z1, z2) = (at(-1.0), at(1.0));
    let (near, far) = if z1 < z2 { (z1, z2) } else { (z2, z1) };
    [near, far.min(1000.0 * near)]
}

/// A per unit of row 3 of a perspective projection, and the length of row 3.
pub fn lens(p: &[f32; 16]) -> (f64, f64) {
    let (a, scale) = focal_length(p);
    (a / scale, scale)
}

impl Shear {
    /// From a shift that is given in clip space.
    fn in_clip_space(separation: f64, convergence: f64) -> Shear {
        Shear {
            a: 1.0,
            spacing: separation,
            focal: 1.0,
            conv: convergence,
        }
    }

    /// sep of one view, which stands at `place` (see [`Rig::position`]). In the order of the equation: with round numbers another
    /// order ends on the other side of a tie when P_i is rounded to single precision.
    pub fn separation(&self, place: f64) -> f64 {
        self.a * (place * self.spacing) / self.focal
    }

    /// P_i, rounded once from double precision. The program's own camera (place 0) gets P itself.
    pub fn projection(&self, p: &[f32; 16], place: f64) -> [f32; 16] {
        let sep = self.separation(place);
        let mut out = *p;
        if sep == 0.0 {
            return out;
        }
        for column in 0..4 {
            let (x, w) = (f64::from(p[column * 4]), f64::from(p[column * 4 + 3]));
            let constant = if column == 3 { sep * self.conv } else { 0.0 };
            out[column * 4] = (x + sep * w - constant) as f32;
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat4, Vec3, Vec4};

    /// glFrustum.
    fn frustum(l: f32, r: f32, b: f32, t: f32, n: f32, f: f32) -> Mat4 {
        Mat4::from_cols_array(&[
            2.0 * n / (r - l),
            0.0,
            0.0,
            0.0,
            0.0,
            2.0 * n / (t - b),
            0.0,
            0.0,
            (r + l) / (r - l),
            (t + b) / (t - b),
            -(f + n) / (f - n),
            -1.0,
            0.0,
            0.0,
            -2.0 * f * n / (f - n),
            0.0,
        ])
    }

    fn rig() -> Rig {
        Rig::new(
            5,
            Camera::Eye {
                spacing: 0.3,
                focal_depth: 8.0,
            },
            None,
        )
    }

    #[test]
    fn a_view_is_the_camera_moved_along_x_with_the_focal_plane_kept() {
        let p = frustum(-1.2, 0.8, -0.7, 0.9, 1.0, 60.0);
        let shear = rig()
            .shear(&p.to_cols_array())
            .expect("a perspective projection");
        let e = 0.6;
        let pi = Mat4::from_cols_array(&shear.projection(&p.to_cols_array(), 2.0));
        for point in [Vec3::new(1.0, 2.0, -3.0), Vec3::new(-2.0, 0.5, -30.0)] {
            let moved = p * (point - Vec3::new(e, 0.0, 0.0)).extend(1.0);
            let got = pi * point.extend(1.0);
            let depth = -point.z;
            // The off-axis shear puts back what the move took at the focal depth: A·e/ξ in units of w.
            let want = moved.x + p.x_axis.x * e / 8.0 * depth;
            assert!(
                (got.x - want).abs() < 1e-5
                    && got.y == moved.y
                    && got.z == moved.z
                    && got.w == moved.w
            );
        }
        let focal = Vec4::new(0.4, 0.3, -8.0, 1.0);
        assert!(
            ((pi * focal).x - (p * focal).x).abs() < 1e-6,
            "depth ξ keeps its place"
        );
    }

    #[test]
    fn a_projection_of_another_scale_has_its_focal_depth_in_its_own_units_of_w() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 64.0);
        let latched = |scale: f32| {
            let mut rig = Rig::new(5, Camera::Auto, None);
            rig.latch(&(p * scale).to_cols_array());
            rig.latched().expect("a perspective projection")
        };
        let ((separation, once), (same, three_times)) = (latched(1.0), latched(3.0));
        assert!((once - 8.0).abs() < 1e-4, "{once}");
        assert!((three_times - 3.0 * once).abs() < 1e-3, "{three_times}");
        assert_eq!(separation, same);
    }

    #[test]
    fn a_camera_in_the_projection_does_not_move_the_focal_depth() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 0.1, 200.0);
        let latched = |p: Mat4| {
            let mut rig = Rig::new(5, Camera::Auto, None);
            rig.latch(&p.to_cols_array());
            rig.latched().expect("a perspective projection").1
        };
        let alone = latched(p);
        let turned =
            Mat4::from_rotation_y(1.2) * Mat4::from_translation(Vec3::new(-10.0, -0.5, -8.5));
        for view in [
            turned,
            Mat4::from_rotation_y(1.5 * std::f32::consts::PI),
            Mat4::from_scale(Vec3::splat(3.0)),
        ] {
            let moved = latched(p * view);
            assert!((moved - alone).abs() < 0.01 * alone, "{moved}, {alone}");
        }
    }

    #[test]
    fn the_leftmost_view_shows_near_things_further_right() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 60.0).to_cols_array();
        let shear = rig().shear(&p).expect("a shear");
        let near = Vec4::new(0.0, 0.0, -2.0, 1.0);
        let left =
            Mat4::from_cols_array(&shear.projection(&p, rig().position(ViewIndex(0)))) * near;
        let right =
            Mat4::from_cols_array(&shear.projection(&p, rig().position(ViewIndex(4)))) * near;
        assert!(left.x / left.w > right.x / right.w);
    }

    #[test]
    fn a_camera_inside_the_projection_matrix_gives_the_same_views() {
        let p = frustum(-1.0, 1.0, -0.7, 0.7, 1.0, 60.0);
        let camera = Mat4::from_rotation_y(0.7)
            * Mat4::from_rotation_x(-0.3)
            * Mat4::from_translation(Vec3::new(1.0, 2.0, -3.0));
        let plain = rig().shear(&p.to_cols_array()).expect("a shear");
        let both = rig().shear(&(p * camera).to_cols_array()).expect("a shear");
        assert!(
            (plain.separation(1.0) - both.separation(1.0)).abs() < 1e-6
                && (plain.conv - both.conv).abs() < 1e-5,
            "{plain:?} {both:?}"
        );
    }

    #[test]
    fn flat_draws_and_the_own_camera_are_left_alone() {
        let ortho = (Mat4::from_translation(Vec3::new(-1.0, -1.0, 0.0))
            * Mat4::from_scale(Vec3::new(2.0 / 640.0, 2.0 / 480.0, -1.0)))
        .to_cols_array();
        assert_eq!(rig().shear(&ortho), None);
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 60.0).to_cols_array();
        assert_eq!(rig().shear(&p).expect("a shear").projection(&p, 0.0), p);
    }

    #[test]
    fn cameras_that_change_are_those_of_a_rig_that_began_so() {
        let p = frustum(-1.2, 0.8, -0.7, 0.9, 1.0, 60.0).to_cols_array();
        let mut changed = Rig::new(5, Camera::Auto, None);
        changed.latch(&p);
        let eye = Camera::Eye {
            spacing: 0.3,
            focal_depth: 8.0,
        };
        changed.change(eye, false);
        assert_eq!(changed.shear(&p), rig().shear(&p));
        assert_eq!(changed.position(ViewIndex(4)), 2.0);
        changed.change(eye, true);
        let shear = changed.shear(&p).expect("a shear");
        for view in 0..5 {
            assert_eq!(shear.projection(&p, changed.position(ViewIndex(view))), p);
        }
    }

    #[test]
    fn a_flat_draw_moves_by_a_fraction_of_what_infinity_does() {
        let p = frustum(-1.2, 0.8, -0.7, 0.9, 1.0, 60.0).to_cols_array();
        let ortho = Mat4::from_scale(Vec3::new(0.01, 0.02, -1.0)).to_cols_array();
        let mut rig = rig();
        assert_eq!(rig.at_depth(&ortho, 0.5), None, "A is not known yet");
        rig.latch(&p);
        assert_eq!(rig.at_depth(&ortho, 0.0), None);
        let place = 2.0;
        let shift = |shear: Option<Shear>, p: &[f32; 16], point: Vec4| {
            let before = Mat4::from_cols_array(p) * point;
            let pi = shear.expect("a shift").projection(p, place);
            let after = Mat4::from_cols_array(&pi) * point;
            assert_eq!((before.y, before.z, before.w), (after.y, after.z, after.w));
            (after.x - before.x) / after.w
        };
        // A direction (w = 0) is infinitely far.
        let far = shift(rig.shear(&p), &p, Vec4::new(0.1, 0.2, -1.0, 0.0));
        let near = Vec4::new(0.1, 0.2, -3.0, 1.0);
        for (p, depth) in [(&ortho, 0.5), (&ortho, -1.0), (&p, 0.5), (&p, 1.0)] {
            let got = shift(rig.at_depth(p, depth), p, near);
            assert!(
                (got - far * depth as f32).abs() < 1e-6,
                "{got} {far} {depth}"
            );
        }
    }

    #[test]
    fn auto_takes_the_geometric_mean_of_near_and_far() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 5.0, 60.0).to_cols_array();
        let mut rig = Rig::new(8, Camera::Auto, None);
        assert_eq!(rig.shear(&p), None);
        rig.latch(&p);
        let shear = rig.shear(&p).expect("latched");
        assert!((shear.conv - 300f64.sqrt()).abs() < 1e-3, "{shear:?}");
        let mut told = Rig::new(8, Camera::Auto, Some(12.0));
        told.latch(&p);
        let about = told.shear(&p).expect("latched");
        assert_eq!((about.conv, about.spacing), (12.0, shear.spacing));
    }

    /// Before depths are measured, nothing that a projection can show leaves the budget.
    #[test]
    fn the_first_cameras_are_within_the_budget_from_the_near_plane_on() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 2.0, 60.0);
        let turned = p * Mat4::from_rotation_y(0.7) * Mat4::from_translation(Vec3::ONE);
        let budget = 0.005;
        let kept = [
            None,
            Some(Kept::Convergence(7.0)),
            Some(Kept::FocalDepth(7.0)),
            Some(Kept::Convergence(0.5)),
        ];
        for (p, kept) in [p, turned].iter().flat_map(|p| kept.map(|kept| (p, kept))) {
            let p = p.to_cols_array();
            let mut rig = Rig::new(5, Camera::Measured(kept), None);
            rig.latch(&p);
            assert_eq!(rig.latched(), None, "the display is not known");
            rig.set_reach(comfort::Reach {
                budget,
                neighbours: 0.03,
            });
            rig.latch(&p);
            let (separation, convergence) = rig.latched().expect("cameras");
            assert!(separation > 0.0);
            for w in [2.0, 3.0, 60.0, f64::INFINITY] {
                let disparity = separation * (1.0 - convergence / w);
                assert!(disparity.abs() <= budget, "{kept:?}: {disparity} at {w}");
            }
            // A projection that comes later changes nothing within the frame.
            let before = rig.latched();
            rig.latch(&frustum(-1.0, 1.0, -1.0, 1.0, 0.1, 60.0).to_cols_array());
            assert_eq!(rig.latched(), before);
        }
    }

    #[test]
    fn a_draw_about_another_depth_looks_as_if_it_were_larger_and_farther() {
        let p = frustum(-1.2, 0.8, -0.7, 0.9, 1.0, 60.0).to_cols_array();
        let clip = Camera::Clip {
            separation: 0.03,
            convergence: 8.0,
        };
        for rig in [rig(), Rig::new(5, clip, None)] {
            let at = |shear: Option<Shear>, point: Vec4| {
                let pi = shear.expect("a shear").projection(&p, 2.0);
                let at = Mat4::from_cols_array(&pi) * point;
                at.x / at.w
            };
            for point in [Vec3::new(0.3, -0.2, -2.0), Vec3::new(-0.4, 0.1, -1.2)] {
                let near = at(rig.shear_about(&p, 2.0), point.extend(1.0));
                let far = at(rig.shear(&p), (point * 4.0).extend(1.0));
                assert!((near - far).abs() < 1e-5, "{near} {far}");
            }
        }
    }

    #[test]
    fn measured_cameras_place_scene_and_sky() {
        let p = frustum(-1.0, 1.0, -1.0, 1.0, 1.0, 60.0).to_cols_array();
        let mut rig = Rig::new(2, Camera::Measured(None), None);
        assert_eq!(rig.latched(), None);
        assert_eq!(rig.at_depth(&p, 1.0), None, "nothing is known yet");
        rig.set_measured((0.02, 5.0), 0.5, None);
        assert_eq!(rig.latched(), Some((0.02, 5.0)));
        let shear = rig.shear(&p).expect("a scene");
        assert!(shear.separation(1.0) > 0.0);
        let [sky, far] = [rig.sky(&p), rig.at_depth(&p, 1.0)].map(|shear| {
            let shear = shear.expect("two views are enough");
            shear.separation(1.0)
        });
        assert!((sky - 0.5 * far).abs() < 1e-12, "{sky} {far}");
        let one = Rig::new(1, Camera::Measured(None), None);
        assert_eq!(one.at_depth(&p, 1.0), None);
    }
}
