//! The synthesis: in how many views a scene is drawn, and in which.

use super::super::occlusion::ReferenceImage;
use super::super::synthesis::Synthesis;
use super::bench::config;
use crate::gl::fake::Fake;
use crate::interleave::Sources;
use crate::view::ViewIndex;

/// For these options, on a driver that can run the passes.
fn synthesis(options: &[(&str, &str)]) -> (Fake, Synthesis) {
    let fake = Fake::new();
    let (synthesis, note) = Synthesis::new(&fake.gl(), config(options), 450);
    assert_eq!(note, None);
    (fake, synthesis)
}

/// `hybrid` of 12 views, of which so many are drawn.
fn hybrid(drawn: &str) -> (Fake, Synthesis) {
    let options = [
        ("VIEWS", "12"),
        ("STRATEGY", "hybrid"),
        ("TRUE_VIEWS", drawn),
    ];
    synthesis(&options)
}

/// `hybrid` of 12 views at 50 frames per second.
fn governed() -> (Fake, Synthesis) {
    synthesis(&[("VIEWS", "12"), ("STRATEGY", "hybrid"), ("FPS", "50")])
}

fn drawn(synthesis: &Synthesis, views: u32) -> Vec<u32> {
    let drawn = synthesis.drawn();
    let views = ViewIndex::all(views).filter(|&view| drawn.has(view));
    views.map(|view| view.0).collect()
}

#[test]
fn exact_strategies_have_no_passes() {
    for strategy in ["replay", "instanced", "geometry"] {
        let (fake, synthesis) = synthesis(&[("VIEWS", "12"), ("STRATEGY", strategy)]);
        assert!(synthesis.passes.is_none() && synthesis.number().is_none());
        assert_eq!((synthesis.programs().count(), fake.calls().len()), (0, 0));
    }
    let (_fake, alone) = synthesis(&[("VIEWS", "1"), ("STRATEGY", "hybrid")]);
    assert!(alone.passes.is_none());
}

#[test]
fn the_number_of_views_follows_from_the_options() {
    for strategy in ["depth-image", "occlusion"] {
        let (_fake, synthesis) = synthesis(&[("VIEWS", "12"), ("STRATEGY", strategy)]);
        assert!(synthesis.passes.is_some() && synthesis.programs().count() > 0);
        assert_eq!((synthesis.number(), synthesis.most(12)), (None, 1));
    }
    let (_fake, fixed) = hybrid("3");
    assert_eq!((fixed.number(), fixed.most(12)), (Some(3), 3));
    let most = Sources::MOST;
    let (_fake, fixed) = hybrid(&most.to_string());
    assert_eq!((fixed.number(), fixed.most(12)), (Some(most), most));
    // Others cannot be synthesised from more, so all views are drawn.
    let (_fake, all) = hybrid(&(most + 1).to_string());
    assert_eq!((all.number(), all.most(12)), (Some(12), most));
    let (_fake, governed) = governed();
    assert_eq!((governed.number(), governed.most(12)), (Some(2), most));
    assert_eq!(governed.most(5), 5);
}

#[test]
fn a_driver_that_refuses_the_passes_draws_all_views() {
    let fake = Fake::new();
    fake.refuse_shaders("void");
    let held = fake.alive(["Programs"]);
    let options = [("VIEWS", "12"), ("STRATEGY", "hybrid"), ("TRUE_VIEWS", "3")];
    let (mut synthesis, note) = Synthesis::new(&fake.gl(), config(&options), 450);
    assert!(note.is_some() && synthesis.passes.is_none());
    assert_eq!(synthesis.number(), None);
    assert_eq!(synthesis.timed(10.0, 12), None);
    assert_eq!(fake.alive(["Programs"]), held);
}

#[test]
fn a_scene_is_drawn_in_views_far_from_each_other_and_in_the_own_one() {
    let (_fake, mut fixed) = hybrid("3");
    assert_eq!(drawn(&fixed, 12), [0; 0]);
    fixed.begin(ViewIndex(5), 12);
    assert_eq!(drawn(&fixed, 12), [0, 5, 11]);
    fixed.begin(ViewIndex(2), 4);
    assert_eq!(drawn(&fixed, 12).len(), 3);
    assert!(drawn(&fixed, 4).contains(&2));
    let (_fake, mut one) = synthesis(&[("VIEWS", "12"), ("STRATEGY", "depth-image")]);
    one.begin(ViewIndex(5), 12);
    assert_eq!(drawn(&one, 12), [0; 0], "beside the own one");
}

#[test]
fn a_frame_tells_how_many_views_it_drew_once() {
    let (_fake, mut fixed) = hybrid("3");
    let sources = Sources::spread(ViewIndex(5), 12, 3);
    fixed.draws(Some(sources));
    assert_eq!(fixed.timed(10.0, 12), Some(3));
    assert_eq!(fixed.timed(10.0, 12), Some(12), "none was synthesised");
    fixed.draws(Some(sources));
    fixed.draws(None);
    assert_eq!(fixed.timed(10.0, 12), Some(12));
}

#[test]
fn only_frames_with_synthesis_change_the_number_of_views() {
    let (_fake, mut menus) = governed();
    let (_other, mut scenes) = governed();
    for _ in 0..100 {
        assert_eq!(menus.timed(1.0, 12), Some(12));
        let count = scenes.number().expect("a number");
        scenes.draws(Some(Sources::spread(ViewIndex(5), 12, count)));
        // Twenty times as fast as is asked for, so there is time for more.
        scenes.timed(1.0, 12);
    }
    assert_eq!(menus.number(), Some(2));
    assert!(scenes.number() > Some(2), "{:?}", scenes.number());
}

#[test]
fn a_reference_image_needs_a_distortion_map() {
    let mut reference = ReferenceImage::default();
    assert!(!reference.begin(true) && !reference.is_on(), "no map yet");
    reference.set_mapped(true);
    assert!(!reference.begin(false) && !reference.is_on(), "no image");
    assert!(reference.begin(true) && reference.is_on());
    reference.set_mapped(false);
    assert!(reference.is_on(), "until the next scene");
    assert!(!reference.begin(true) && !reference.is_on());
}
