//! The passes on the fake driver: their inputs, and objects that are made only once.

use super::*;
use crate::atlas::{Atlas, Grid, Limits};
use crate::config::AtlasLayout::{self, Layers, SideBySide};
use crate::gl::FramebufferName;
use crate::gl::fake::{Drawn, Fake, Scope};
use crate::state::Window;

/// A window with four views and a panel over the whole screen.
struct Stage {
    fake: Fake,
    gl: Gl,
    config: Config,
    atlas: Atlas,
    interleaver: Interleaver,
    neutral: Neutral,
    tiles_read: u32,
}

impl Stage {
    fn new(fake: Fake, glsl: u32, layout: AtlasLayout) -> Stage {
        let options = |name: &str| (name == "MANYVIEW_VIEWS").then(|| "4".to_owned());
        let config = Config::from_env(options).expect("options");
        let (gl, names) = (fake.gl(), &mut Names::default());
        let limits = Limits {
            side: 4096,
            layers: 64,
        };
        let tiles = Tiles::new(4, [64, 48], Grid::FULL, layout, limits).expect("fits");
        let window = Window::ask(&gl, 64, 48, true);
        let atlas = Atlas::new(&gl, names, &window, tiles, true).expect("an atlas");
        let interleaver = Interleaver::new(&gl, names, glsl, false, None);
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        let fixed = !gl.is_es() && gl.get_integer(c::CONTEXT_PROFILE_MASK) == 2;
        let neutral = Neutral::enter(&gl, fixed, false);
        fake.forget();
        Stage {
            fake,
            gl,
            config,
            atlas,
            interleaver,
            neutral,
            tiles_read: 0,
        }
    }

    fn draw(&mut self, output: Output, srgb: bool) -> Vec<Drawn> {
        self.fake.forget();
        let source = Source {
            tiles: self.atlas.tiles,
            texture: self.atlas.color,
            top_down: true,
            depth: None,
            pyramid: None,
            srgb,
        };
        let panel = PanelPlacement {
            display: &self.config.display,
            placement: Placement::full_screen(64, 48),
        };
        let mut tile = |_| {
            self.tiles_read += 1;
            RgbImage::new(64, 48)
        };
        let drawn = self.interleaver.draw(
            &self.gl,
            &self.neutral,
            &self.config,
            &source,
            &mut tile,
            output,
            &panel,
        );
        drawn.expect("a picture");
        self.fake.draws()
    }
}

const OUTPUTS: [Output; 4] = [
    Output::Panel,
    Output::Quilt,
    Output::SideBySide { half: false },
    Output::View(2),
];

#[test]
fn a_picture_is_one_triangle_over_the_window() {
    for layout in [SideBySide, Layers] {
        for output in OUTPUTS {
            let mut stage = Stage::new(Fake::new(), 450, layout);
            let drawn = stage.draw(output, false);
            assert_eq!(stage.fake.lines("glDraw*"), ["glDrawArrays(4, 0, 3)"]);
            let state = &drawn[0].state;
            assert_eq!(state.value(c::DRAW_FRAMEBUFFER_BINDING), [0.0]);
            assert_eq!(state.value(c::VIEWPORT), [0.0, 0.0, 64.0, 48.0]);
            let unit = Scope::Unit(VIEWS_UNIT);
            assert_eq!(
                state.int(unit, c::TEXTURE_BINDING_2D_ARRAY),
                stage.atlas.color.0
            );
            let mask = TextureName(state.int(Scope::Unit(MASK_UNIT), c::TEXTURE_BINDING_2D));
            let wanted = if output == Output::Panel {
                stage.interleaver.textures().next().unwrap_or_default()
            } else {
                TextureName::ZERO
            };
            assert_eq!(mask, wanted, "{output:?}");
            let program = ProgramName(state.int(Scope::Context, c::CURRENT_PROGRAM));
            assert!(stage.interleaver.programs().any(|known| known == program));
            assert_eq!(stage.tiles_read, 0, "nothing is read back");
        }
    }
}

#[test]
fn the_mask_is_uploaded_once_and_nothing_is_asked() {
    let mut stage = Stage::new(Fake::new(), 450, SideBySide);
    stage.draw(Output::Panel, false);
    assert_eq!(stage.fake.count("glTexImage2D"), 1);
    stage.draw(Output::Panel, false);
    assert_eq!(stage.fake.count("glTexImage2D"), 0);
    assert!(stage.fake.asked().is_empty(), "{:?}", stage.fake.asked());
    stage.draw(Output::Quilt, false);
    stage.draw(Output::Panel, false);
    assert_eq!(
        stage.fake.count("glTexImage2D"),
        0,
        "a picture without a mask keeps it"
    );
    stage.interleaver.rename(&stage.gl, &mut Names::default());
    stage.draw(Output::Panel, false);
    assert_eq!(stage.fake.count("glTexImage2D"), 1, "another texture");
}

#[test]
fn srgb_is_on_for_the_picture_alone() {
    let mut stage = Stage::new(Fake::new(), 450, SideBySide);
    let drawn = stage.draw(Output::View(0), true);
    assert!(drawn[0].state.is_enabled(c::FRAMEBUFFER_SRGB));
    assert!(!stage.fake.state().is_enabled(c::FRAMEBUFFER_SRGB));
    let drawn = stage.draw(Output::View(0), false);
    assert!(!drawn[0].state.is_enabled(c::FRAMEBUFFER_SRGB));
}

#[test]
fn making_the_passes_leaves_no_trace() {
    for seed in 0..20 {
        let fake = Fake::new();
        fake.scramble(seed, true);
        let (gl, before) = (fake.gl(), fake.state());
        let interleaver = Interleaver::new(
            &gl,
            &mut Names::default(),
            450,
            false,
            Some(DisocclusionSource::Nothing),
        );
        assert_eq!(interleaver.note(), None);
        fake.assert_restored(&before);
    }
}

#[test]
fn a_driver_that_refuses_the_passes_leaves_them_to_the_cpu() {
    let fake = Fake::new();
    fake.refuse_shaders("void");
    let before = fake.alive(["Programs", "VertexArrays"]);
    let mut stage = Stage::new(fake, 450, SideBySide);
    let note = stage.interleaver.note().unwrap_or_default();
    assert!(note.contains("by the CPU: refused"), "{note}");
    assert_eq!(stage.fake.alive(["Programs", "VertexArrays"]), before);
    stage.draw(Output::Panel, false);
    assert_eq!(stage.tiles_read, 4);
    assert_eq!(stage.fake.count("glDrawPixels"), 1);
    assert_eq!(stage.fake.value(c::ATTRIB_STACK_DEPTH), [0.0]);
}
