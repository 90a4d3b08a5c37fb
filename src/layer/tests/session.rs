//! The session: the strategy in force, the display, and the place of the window.

use super::super::session::Session;
use super::super::{OnScreen, Support};
use super::bench::{MESA, config};
use crate::config::{Config, Live, Strategy};
use crate::display::{Lens, Placement};
use crate::gl::fake::Fake;
use std::sync::Arc;

/// Makes a driver.
type Driver = fn() -> Fake;

fn session(fake: &Fake, config: &'static Config) -> Session {
    let gl = fake.gl();
    let support = Support::ask(&gl).expect("a context for several views");
    Session::new(&gl, config, support, Arc::default(), Some("room"))
}

fn with(options: &[(&str, &str)]) -> Session {
    session(&Fake::new().extensions(MESA), config(options))
}

#[test]
fn the_strategy_in_force_is_the_one_that_is_asked_for() {
    for (name, strategy) in [
        ("replay", Strategy::Replay),
        ("instanced", Strategy::Instanced),
        ("geometry", Strategy::Geometry),
        ("depth-image", Strategy::DepthImage),
        ("occlusion", Strategy::Occlusion),
        ("hybrid", Strategy::Hybrid),
    ] {
        let mut session = with(&[("VIEWS", "4"), ("STRATEGY", name)]);
        assert!(session.auto.is_none(), "{name}");
        assert_eq!((session.strategy, session.chosen()), (strategy, strategy));
        // A proof replays for a while.
        session.strategy = Strategy::Replay;
        assert_eq!(session.chosen(), strategy);
    }
}

#[test]
fn auto_puts_another_strategy_in_force() {
    // Pictures have to be the same in each run, so this one is replayed.
    let capture = [
        ("VIEWS", "4"),
        ("STRATEGY", "auto"),
        ("CAPTURE_OUT", "/nowhere/picture.png"),
    ];
    let session = with(&capture);
    assert!(session.auto.is_some());
    assert_eq!(session.strategy, Strategy::Replay);
    assert_eq!(session.chosen(), Strategy::Replay);
    let alone = with(&[("VIEWS", "1"), ("STRATEGY", "auto")]);
    assert!(alone.auto.is_none(), "there is nothing to choose");
}

#[test]
fn only_layers_keep_the_depths_of_replay() {
    let layers = || Fake::new().extensions(MESA);
    let cases: [(Driver, &str, Option<&str>, bool); 6] = [
        (layers, "replay", None, true),
        (layers, "instanced", None, true),
        (layers, "instanced", Some("distances"), false),
        (Fake::new, "instanced", None, false),
        (Fake::new, "replay", None, true),
        (layers, "geometry", None, false),
    ];
    for (fake, strategy, clip, same) in cases {
        let mut options = vec![("VIEWS", "4"), ("STRATEGY", strategy)];
        options.extend(clip.map(|clip| ("CLIP", clip)));
        let session = session(&fake(), config(&options));
        assert_eq!(session.same_depths(), same, "{strategy}, {clip:?}");
    }
}

#[test]
fn the_display_has_the_numbers_in_force() {
    let mut session = with(&[("VIEWS", "8"), ("DISPLAY", "slanted8")]);
    let before = session.config.display.lens().expect("a lens sheet");
    assert_eq!(session.display().lens(), Some(before));
    let other = Lens {
        offset: before.slant,
        ..before
    };
    assert_ne!(other, before);
    let live = session.live;
    session.adopt(Live {
        lens: Some(other),
        ..live
    });
    assert_eq!(session.live.lens, Some(other));
    assert_eq!(session.display().lens(), Some(other));
    assert_eq!(session.config.display.lens(), Some(before));
    session.adopt(live);
    assert_eq!(session.display().lens(), Some(before));
}

#[test]
fn a_window_is_the_screen_until_its_place_is_known() {
    let mut session = with(&[("VIEWS", "2")]);
    assert_eq!(session.placement((64, 48)), Placement::full_screen(64, 48));
    session.moved(Some(OnScreen {
        screen: (1920, 1080),
        at: (-3, 7),
    }));
    let placed = Placement {
        screen_width: 1920,
        screen_height: 1080,
        x: -3,
        y: 7,
        width: 64,
        height: 48,
    };
    assert_eq!(session.placement((64, 48)), placed);
    session.moved(None);
    assert_eq!(session.placement((64, 48)), Placement::full_screen(64, 48));
}
