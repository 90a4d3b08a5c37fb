//! Display lists: text, lists within lists, and what they push and pop.

use super::{ATLASES, alike, plain, program, under};
use crate::support::{own_screen, succeed};
use std::process::Command;

/// Checks that text of an X font is what it is without the layer, as it is read back and in the window, whichever view that shows.
#[track_caller]
fn written(mode: &str) {
    let (program, screen) = (program("text"), own_screen());
    let run = |mut command: Command| {
        let output = succeed(screen.give(&mut command));
        String::from_utf8(output.stdout).expect("text")
    };
    let expected = run(plain(&program, &[mode]));
    assert!(!expected.contains(": 0 pixels"), "{expected}");
    for atlas in ATLASES {
        for view in ["view:0", "view:1", "view:2"] {
            let options = [("VIEWS", "3"), ("ATLAS", atlas), ("OUTPUT", view)];
            let told = run(under(&program, &[mode], &options));
            assert_eq!(told, expected, "{mode}, {atlas}, {view}");
        }
    }
}

#[test]
fn text_of_an_x_font_is_in_every_view() {
    for mode in ["generated", "alone"] {
        written(mode);
    }
}

#[test]
fn text_of_an_x_font_under_names_of_the_program_is_in_every_view() {
    written("numbered");
}

#[test]
fn text_of_an_x_font_takes_the_place_of_other_lists() {
    for mode in ["again", "deleted"] {
        written(mode);
    }
}

#[test]
fn text_of_an_x_font_is_called_by_other_lists() {
    for mode in ["nested", "executed"] {
        written(mode);
    }
}

#[test]
fn text_is_called_within_as_many_lists_as_the_driver_follows() {
    alike("nested", &[], 4);
}

#[test]
fn lists_pop_what_they_have_pushed_before_another_list() {
    for mode in [&[] as &[&str], &["now"]] {
        for frame in 1..=4 {
            alike("popped", mode, frame);
        }
    }
}
