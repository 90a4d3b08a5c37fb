//! Targets: what a driver has to have for them, the names that are theirs, and the grid that they give up.

use super::super::LayerError;
use super::super::Support;
use super::super::session::Session;
use super::super::targets::{Targets, interleaving};
use super::bench::{Bench, MESA, config};
use crate::gl::fake::Fake;
use crate::gl::{FramebufferName, TextureName, consts as c};
use crate::plan::Unrepresentable;
use crate::plan::decide::Detail;
use crate::report::Report;
use crate::state::{State, Window};
use std::sync::Arc;

/// GL_FRAMEBUFFER_UNSUPPORTED.
const UNSUPPORTED: u32 = 0x8CDD;

/// The targets on a driver, and the notes of the report.
fn targets(
    fake: &Fake,
    options: &[(&str, &str)],
) -> (Result<Targets, LayerError>, Vec<serde_json::Value>) {
    let (gl, mut report) = (fake.gl(), Report::default());
    let support = Support::ask(&gl).expect("a context for several views");
    let pass = interleaving(&gl, config(options), &support);
    let window = Window::ask(&gl, 64, 48, support.compatibility);
    let state = State::ask(&gl, window, support.compatibility);
    let session = Session::new(&gl, config(options), support, Arc::default(), None);
    let targets = Targets::new(&gl, pass, &session, &state, &mut report);
    let targets = targets.map(|(targets, told)| {
        told.into_iter().for_each(|told| report.note(told));
        targets
    });
    let report: serde_json::Value = serde_json::from_str(&report.json()).expect("JSON");
    let notes = report["notes"].as_array().expect("notes").clone();
    (targets, notes)
}

const FOUR: [(&str, &str); 2] = [("VIEWS", "4"), ("STRATEGY", "replay")];

#[test]
fn all_is_there_on_a_whole_driver() {
    let fake = Fake::new().extensions(MESA);
    let (targets, notes) = targets(&fake, &FOUR);
    let targets = targets.expect("targets");
    assert_eq!(notes, [""; 0]);
    assert!(targets.interleaver.on_gpu() && targets.offscreen.is_empty());
    let tiles = &targets.atlas.tiles;
    assert_eq!((tiles.views, tiles.width, tiles.height), (4, 64, 48));
    assert!(!targets.stuck && !targets.undrawn);
    assert_eq!(targets.detail, Detail::SampleAligned);
}

#[test]
fn without_passes_the_picture_is_made_by_the_cpu_but_not_on_es() {
    let fake = Fake::new().extensions(MESA);
    fake.refuse_shaders("void");
    let (made, notes) = targets(&fake, &FOUR);
    assert!(!made.expect("targets").interleaver.on_gpu());
    assert_eq!(notes.len(), 1, "{notes:?}");
    drop(fake);
    let fake = Fake::new().es(3, 2);
    fake.refuse_shaders("void");
    let (made, notes) = targets(&fake, &FOUR);
    assert!(matches!(made, Err(LayerError::Passes(_))), "{made:?}");
    assert_eq!(notes, [""; 0]);
}

#[test]
fn without_framebuffers_the_window_is_shown_as_it_is() {
    let fake = Fake::new().extensions(MESA);
    fake.set_framebuffer_status(UNSUPPORTED);
    let (made, notes) = targets(&fake, &FOUR);
    assert!(made.expect("targets").atlas.is_plain());
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert_eq!(fake.alive(["Textures", "Framebuffers"])[1], 0);
}

#[test]
fn tiles_are_aligned_where_viewports_may_begin_between_pixels() {
    let fake = Fake::new().version(3, 3).extensions(MESA);
    let (made, _) = targets(&fake, &FOUR);
    assert_eq!(made.expect("targets").detail, Detail::Full);
    let fake = Fake::new().version(3, 3);
    let fake = fake.extensions(["GL_ARB_viewport_array"]);
    let (made, _) = targets(&fake, &FOUR);
    assert_eq!(made.expect("targets").detail, Detail::SampleAligned);
}

#[test]
fn views_that_are_not_scaled_are_named() {
    let scaled = [
        ("VIEWS", "4"),
        ("STRATEGY", "replay"),
        ("VIEW_SCALE", "0.5"),
    ];
    let es = || Fake::new().es(3, 2);
    let old = || Fake::new().version(3, 3).extensions(MESA);
    let drivers: [(&dyn Fn() -> Fake, _); 2] =
        [(&es, "shaders of its own"), (&old, "GL_ARB_viewport_array")];
    for (driver, cause) in drivers {
        let fake = driver();
        let (made, notes) = targets(&fake, &scaled);
        assert!(
            notes.len() == 1 && notes[0].to_string().contains(cause),
            "{notes:?}"
        );
        assert!(made.expect("targets").atlas.tiles.grid.is_full());
        let (_, notes) = targets(&fake, &FOUR);
        assert_eq!(notes, [""; 0]);
    }
}

#[test]
fn a_context_is_asked_only_for_bindings_that_it_has() {
    let fake = Fake::new().es(3, 0);
    let (made, _) = targets(&fake, &FOUR);
    made.expect("targets");
    let sampled = |(what, _): &(String, usize)| what.contains("MULTISAMPLE_ARRAY");
    let asked = fake.asked();
    assert!(!asked.iter().any(sampled), "{asked:?}");
}

#[test]
fn they_know_their_names() {
    let mut bench = Bench::new(&FOUR);
    let [texture, framebuffer] = bench.fake.program(|gl| {
        let texture = gl.gen_texture();
        gl.bind_texture(c::TEXTURE_2D, texture);
        [texture.0, gl.gen_framebuffer().0]
    });
    let (texture, framebuffer) = (TextureName(texture), FramebufferName(framebuffer));
    let targets = &bench.layer.targets;
    let ours: Vec<TextureName> = targets.atlas.textures().to_vec();
    assert!(!ours.is_empty() && ours.iter().all(|&name| targets.owns_texture(name)));
    let owned = |texture| targets.owns_texture(texture);
    assert!(targets.interleaver.textures().all(owned));
    assert!(!targets.owns_texture(texture) && !bench.layer.owns_texture(texture));
    let framebuffers: Vec<FramebufferName> = targets.atlas.framebuffers().collect();
    assert!(
        framebuffers
            .into_iter()
            .all(|name| targets.owns_framebuffer(name))
    );
    assert!(!targets.owns_framebuffer(framebuffer));
    // 0 is the window's, though a part that is not made has it for its name.
    assert!(!bench.layer.owns_texture(TextureName::ZERO));
    assert!(!bench.layer.owns_framebuffer(FramebufferName::ZERO));
    // A program that numbers its textures itself takes one of ours: they move out of its way.
    let gl = bench.gl;
    bench.layer.binds_texture(&gl, texture);
    assert!(!bench.layer.targets.names.hidden());
    bench.layer.binds_texture(&gl, ours[0]);
    assert!(bench.layer.targets.names.hidden());
    assert!(ours.iter().all(|&name| !bench.layer.owns_texture(name)));
}

#[test]
fn a_front_buffer_is_more_than_the_back_alone() {
    let mut bench = Bench::new(&FOUR);
    assert!(bench.layer.targets.back_alone());
    let (gl, window) = (bench.gl, bench.layer.state.window);
    let targets = &mut bench.layer.targets;
    targets
        .atlas
        .make_front(&gl, &mut targets.names, &window, false);
    assert!(!targets.back_alone());
}

#[test]
fn a_grid_is_given_up_for_good_unless_the_driver_makes_no_other_atlas() {
    let scaled = [
        ("VIEWS", "4"),
        ("STRATEGY", "replay"),
        ("VIEW_SCALE", "0.5"),
    ];
    for (status, stuck) in [(c::FRAMEBUFFER_COMPLETE, false), (UNSUPPORTED, true)] {
        let mut bench = Bench::new(&scaled);
        let gl = bench.gl;
        assert_eq!(bench.layer.targets.atlas.tiles.width, 32);
        bench.fake.set_framebuffer_status(status);
        bench.layer.hold_everything(&gl, Unrepresentable::Pixels);
        let targets = &bench.layer.targets;
        assert_eq!((targets.detail, targets.stuck), (Detail::Full, stuck));
        let width = if stuck { 32 } else { 64 };
        assert_eq!(targets.atlas.tiles.width, width);
    }
}
