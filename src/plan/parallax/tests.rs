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
            (got.x - want).abs() < 1e-5 && got.y == moved.y && got.z == moved.z && got.w == moved.w
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
    let turned = Mat4::from_rotation_y(1.2) * Mat4::from_translation(Vec3::new(-10.0, -0.5, -8.5));
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
    let left = Mat4::from_cols_array(&shear.projection(&p, rig().position(ViewIndex(0)))) * near;
    let right = Mat4::from_cols_array(&shear.projection(&p, rig().position(ViewIndex(4)))) * near;
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
