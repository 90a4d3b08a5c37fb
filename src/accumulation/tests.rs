//! The arithmetic by itself, and the passes on the fake driver.

use super::*;
use crate::atlas::{Grid, Limits, Tiles};
use crate::config::AtlasLayout;
use crate::gl::fake::{Drawn, Fake, Scope};

#[test]
fn values_are_stored_as_mesa_stores_them() {
    let clear = [0.0, 1.0, 0.5, 0.25, 1e-5, -1.0, -0.5, -1e-5].map(clear_value);
    let expected = [0.0, 32767.0, 16383.0, 8191.0, 0.0, -32768.0, -16384.0, 0.0];
    assert_eq!(clear, expected);
    let add = |v: f32| Operation::Add(v).step().1[0];
    assert_eq!(add(0.5), 16383.0);
    assert_eq!(add(-0.5), -16383.0);
    assert_eq!(add(2.0), -2.0, "wrapped");
    assert_eq!(add(1e9), 0.0, "no 32-bit number");
    assert_eq!(add(f32::NAN), 0.0);
}

#[test]
fn an_operation_has_a_name() {
    let all = [true; 4];
    assert_eq!(
        Operation::of(c::MULT, 0.5, all),
        Some(Operation::Multiply(0.5))
    );
    assert_eq!(Operation::of(c::ADD + 1, 0.5, all), None);
}

const KINDS: [&str; 2] = ["Textures", "Framebuffers"];

/// Accumulation buffers of an atlas with a layer for each of two views.
struct Stage {
    fake: Fake,
    gl: Gl,
    window: Window,
    atlas: Atlas,
    neutral: Neutral,
    buffer: Accumulation,
}

impl Stage {
    fn new(srgb_capable: bool) -> Stage {
        let fake = Fake::new();
        let (gl, names) = (fake.gl(), &mut Names::default());
        let window = Window {
            srgb_capable,
            ..Window::ask(&gl, 64, 48, true)
        };
        let limits = Limits {
            side: 512,
            layers: 8,
        };
        let tiles = Tiles::new(2, [64, 48], Grid::FULL, AtlasLayout::Layers, limits);
        let atlas = Atlas::new(&gl, names, &window, tiles.expect("fits"), true).expect("an atlas");
        let neutral = Neutral::enter(&gl, true, false);
        let buffer = Accumulation::new(&gl, &neutral, names, 450, &atlas).expect("programs");
        fake.forget();
        Stage {
            fake,
            gl,
            window,
            atlas,
            neutral,
            buffer,
        }
    }

    fn apply(&mut self, operation: Operation) -> Vec<Drawn> {
        let rect = [8, 4, 32, 16];
        let regions = [Region { row: 0, rect }, Region { row: 1, rect }];
        self.fake.forget();
        let to = (self.atlas.color, &[self.atlas.color][..]);
        self.buffer.apply(
            &self.gl,
            &self.neutral,
            operation,
            &self.window,
            to,
            &regions,
        );
        self.fake.draws()
    }
}

#[test]
fn each_region_is_one_pass_and_what_changes_is_copied_before() {
    let cases = [
        (Operation::Clear([0.5; 4]), 2),
        (Operation::Load(0.5), 2),
        (Operation::Accumulate(0.5), 4),
        (Operation::Multiply(0.5), 4),
        (Operation::Add(0.5), 4),
        (Operation::Return(1.0, [true; 4]), 2),
    ];
    let mut stage = Stage::new(false);
    for (operation, passes) in cases {
        let drawn = stage.apply(operation);
        assert_eq!(drawn.len(), passes, "{operation:?}");
        let [values, before, ..] = stage.buffer.textures();
        let framebuffer = Scope::Framebuffer(stage.buffer.framebuffer());
        let attached = drawn.iter().map(|drawn| {
            assert_eq!(drawn.state.value(c::VIEWPORT), [8.0, 4.0, 32.0, 16.0]);
            let at = drawn.state.get(framebuffer, c::COLOR_ATTACHMENT0);
            (TextureName(at[1] as u32), at[3] as u32)
        });
        let expected = [0, 1].into_iter().flat_map(|row| match operation {
            Operation::Return(..) => vec![(stage.atlas.color, row)],
            _ if passes == 4 => vec![(before, 0), (values, row)],
            _ => vec![(values, row)],
        });
        assert_eq!(attached.collect::<Vec<_>>(), expected.collect::<Vec<_>>());
        let left = stage.fake.state().get(framebuffer, c::COLOR_ATTACHMENT0);
        assert_eq!(left[1], 0.0, "no texture stays attached");
    }
}

#[test]
fn what_is_returned_keeps_to_the_colour_mask() {
    let mut stage = Stage::new(false);
    let drawn = stage.apply(Operation::Return(1.0, [true, false, true, false]));
    let mask = drawn[0].state.value(c::COLOR_WRITEMASK);
    assert_eq!(mask, [1.0, 0.0, 1.0, 0.0]);
}

#[test]
fn nothing_is_asked_and_no_table_is_made_twice() {
    let mut stage = Stage::new(true);
    stage.apply(Operation::Accumulate(0.25));
    assert_eq!(stage.fake.count("glTexImage2D"), 1);
    stage.apply(Operation::Accumulate(0.25));
    assert_eq!(stage.fake.count("glTexImage2D"), 0);
    assert!(stage.fake.asked().is_empty(), "{:?}", stage.fake.asked());
    stage.apply(Operation::Accumulate(0.5));
    assert_eq!(stage.fake.count("glTexImage2D"), 1, "of another value");
}

#[test]
fn textures_get_other_names_and_are_given_back() {
    let mut stage = Stage::new(false);
    let before = stage.fake.alive(KINDS);
    let old = stage.buffer.textures();
    stage
        .buffer
        .rename(&stage.gl, &stage.neutral, &mut Names::default());
    assert!(old.iter().all(|&name| !stage.buffer.owns(name)));
    assert_eq!(stage.fake.alive(KINDS), before);
    let copied = stage.fake.lines("glCopyImageSubData");
    assert_eq!(copied.len(), 1, "what was accumulated goes along");
    stage.buffer.delete(&stage.gl);
    let [textures, framebuffers] = before;
    assert_eq!(stage.fake.alive(KINDS), [textures - 4, framebuffers - 1]);
}
