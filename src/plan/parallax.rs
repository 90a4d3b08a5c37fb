//! The one equation: camera i is the program's camera moved along its x axis, with the frustum sheared so that the focal depth
//! keeps its place.
//!
//! Based on: Luo et al., "GPU-based multi-view rendering for spatial-multiplex autostereoscopic displays" (GBMVR), section III,
//! Δx = A·κ·(1 − z/ξ), written for homogeneous coordinates:
//! row0(P_i) = row0(P) + sep_i·row3(P) − sep_i·conv·(0,0,0,1), sep_i = A·e_i/ξ, conv = ξ, e_i = (i − (N−1)/2)·κ.

use super::orthographic::{Planes, Slant, row_length};
use super::{camera, comfort};
use crate::config::{Camera, FlatDepth, Kept};
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
    /// The cameras of an orthographic scene for [`Camera::Measured`], once its depths are measured.
    slant: Option<Slant>,
    /// Where a sky stands: 1 infinitely far, or the end of what the display can show.
    farthest: f64,
    /// All cameras stand where the program's own does.
    flat: bool,
}

/// What the shift of a view grows with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// The distance from the eye, which is clip-space w: in perspective.
    W,
    /// Clip-space z: in an orthographic scene (see [`super::orthographic`]).
    Z,
}

/// The shift of one draw's views in clip space: `x_i = x + sep_i·(w − conv·w_eye)`, `sep_i = a·e_i/focal`; in an orthographic scene
/// `x_i = x + sep_i·(z − conv·w)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// What it grows with.
    pub along: Along,
    /// A, per unit of row 3; in an orthographic scene of row 2.
    pub a: f64,
    /// κ.
    pub spacing: f64,
    /// ξ.
    pub focal: f64,
    /// Zero parallax, in units of clip-space w; in an orthographic scene z in normalised device coordinates.
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
            slant: None,
            farthest: FlatDepth::FARTHEST,
            flat: false,
        }
    }

    /// Sets other cameras; with `flat`, all of them stand where the program's own does.
    pub fn change(&mut self, camera: Camera, flat: bool) {
        if camera != self.camera {
            self.farthest = FlatDepth::FARTHEST;
            self.foreground = None;
            self.slant = None;
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

    /// Sets the focal depth of cameras that the user does not place.
    pub fn change_focal(&mut self, focal: Option<f64>) {
        if focal != self.focal {
            self.focal = focal;
            self.forget_measured();
        }
    }

    /// Lets go of the cameras that were measured: the next projection places them as the first one did.
    pub fn forget_measured(&mut self) {
        self.latched = None;
        self.foreground = None;
        self.farthest = FlatDepth::FARTHEST;
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
        comfort::Comfort::at_once(kept, &comfort::Seen::behind(near), &limits)
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
                along: Along::W,
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
                    along: Along::W,
                    a,
                    spacing,
                    focal: focal_depth,
                    conv: focal_depth * scale,
                })
            }
        }
    }

    /// Sets the cameras of an orthographic scene for [`Camera::Measured`], as [`super::Slanting`] finds them.
    pub fn set_slant(&mut self, slant: Slant) {
        self.slant = Some(slant);
    }

    /// The cameras of an orthographic scene, unless the user has placed them at distances: measured ones, or such that the far plane gets the
    /// separation of what is infinitely far.
    fn slant(&self) -> Option<Slant> {
        let step = |far: f64| Slant::between_planes(far / comfort::BEHIND);
        match self.camera {
            Camera::Measured(_) => self
                .slant
                .or_else(|| Some(Slant::between_planes(self.reach?.budget))),
            Camera::Auto => Some(step(self.auto_step())),
            Camera::Clip { separation, .. } => Some(step(separation)),
            Camera::Eye { .. } => None,
        }
    }

    /// The shift of an orthographic scene; `None` where all views are the same: one view, in perspective. `p` is its projection, alone or with the
    /// view and the model (column-major).
    pub fn orthographic(&self, p: &[f32; 16], planes: &Planes) -> Option<Shear> {
        if self.views < 2 || !flat(p) {
            return None;
        }
        if let Camera::Eye {
            spacing,
            focal_depth,
        } = self.camera
        {
            let [wide, deep] = [0, 2].map(|row| row_length(p, row));
            let deeper = deep * planes.extent().signum();
            // A matrix that turns may move things as well, so it does not tell how far away they are.
            let conv = match [p[2], p[6]] == [0.0; 2] {
                true => f64::from(p[14]) + deeper * focal_depth,
                false => planes.at(Slant::between_planes(1.0).zero),
            };
            return (deeper != 0.0).then(|| Shear {
                along: Along::Z,
                a: wide / deeper,
                spacing,
                focal: focal_depth,
                conv,
            });
        }
        let slant = self.slant()?;
        Some(Shear {
            along: Along::Z,
            conv: planes.at(slant.zero),
            ..Shear::in_clip_space(slant.slope / planes.extent(), 0.0)
        })
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
            along: Along::W,
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
            let at = |row: usize| f64::from(p[column * 4 + row]);
            let (grows, constant) = match self.along {
                Along::W => (at(3), if column == 3 { sep * self.conv } else { 0.0 }),
                Along::Z => (at(2), sep * self.conv * at(3)),
            };
            out[column * 4] = (at(0) + sep * grows - constant) as f32;
        }
        out
    }
}

#[cfg(test)]
mod tests;
