//! Orthographic scenes: which draws belong to one, and the shear of their views.

use super::*;
use crate::plan::decide::OrthographicWatch;
use crate::plan::{Along, Planes, Shear, Slant};
use glam::camera::rh::proj::opengl;

fn orthographic() -> [f32; 16] {
    opengl::orthographic(-4.0, 4.0, -3.0, 3.0, 1.0, 50.0).to_cols_array()
}

/// A draw of an orthographic scene that is seen from an oblique direction.
pub(super) fn oblique() -> Facts {
    let mut facts = scene();
    facts.traits.projection = Projection::Orthographic;
    facts.traits.slants = true;
    facts.classed.why = Why::Slanted;
    facts.projections.fixed = orthographic();
    facts.projections.matrix = orthographic();
    facts
}

/// A watch after frames of such draws.
fn watched(frames: &[&[Facts]]) -> OrthographicWatch {
    let mut frame = Frame::default();
    for draws in frames {
        draws
            .iter()
            .for_each(|facts| frame.orthographic.observe(facts));
        frame = frame.next();
    }
    frame.orthographic
}

fn planned(views: u32) -> Option<Shear> {
    let camera = Camera::Clip {
        separation: 0.03,
        convergence: 8.0,
    };
    let known = Known::new(Rig::new(views, camera, None));
    let decision = decide(&oblique(), &known, &settings(Strategy::Replay));
    decision.expect("a decision").plan.shear
}

#[test]
fn a_program_with_a_perspective_has_no_orthographic_scene() {
    assert!(OrthographicWatch::default().is_possible());
    assert!(watched(&[&[oblique()]]).is_possible());
    assert!(!watched(&[&[scene()]]).is_possible());
    // A menu between two levels.
    assert!(watched(&[&[scene()], &[]]).is_possible());
    let mut elsewhere = scene();
    elsewhere.traits.target = Target::Framebuffer(1);
    assert!(watched(&[&[elsewhere]]).is_possible(), "a shadow map");
}

#[test]
fn the_projection_of_an_oblique_draw_is_that_of_the_scene() {
    let p = orthographic();
    let is_known = |frames: &[&[Facts]]| watched(frames).is_of_scene(&p);
    assert!(is_known(&[&[oblique()]]));
    assert!(!is_known(&[&[oblique()], &[]]), "a frame ago");
    let mut front = oblique();
    front.classed.why = Why::Orthographic;
    assert!(!is_known(&[&[front]]));
    let mut other = oblique();
    other.projections.fixed[0] = 0.5;
    assert!(!is_known(&[&[other]]));
}

#[test]
fn views_are_sheared_along_z() {
    let shear = planned(5).expect("a shear");
    assert_eq!(shear.along, Along::Z);
    let planes = Planes::new(false, false);
    let slant = Slant::between_planes(0.03 / 0.75);
    assert!((shear.separation(1.0) * planes.extent() - slant.slope).abs() < 1e-12);
    assert!((shear.conv - planes.at(slant.zero)).abs() < 1e-12);
    // One view has nothing to be sheared by.
    assert_eq!(planned(1), None);
}

#[test]
fn a_rule_can_call_an_orthographic_draw_a_scene() {
    let mut facts = oblique();
    facts.classed.why = Why::Rule(0);
    assert!(facts.slants());
    facts.classed.why = Why::Perspective;
    assert!(!facts.slants());
    facts.classed.class = Class::Flat;
    facts.classed.why = Why::Rule(0);
    assert!(!facts.slants());
}
