//! The program's state around the layer's passes, on the fake driver.

use super::Neutral;
use crate::gl::fake::Fake;
use crate::gl::{Gl, ProgramName, TextureName, VertexArrayName, consts as c};

/// Contexts of every kind that the layer knows.
const CONTEXTS: [fn() -> Fake; 9] = [
    Fake::new,
    || Fake::new().version(4, 6),
    || Fake::new().version(3, 2),
    || Fake::new().version(3, 0),
    || Fake::new().core(),
    || Fake::new().core().version(3, 2),
    || Fake::new().es(3, 0),
    || Fake::new().es(3, 1),
    || {
        Fake::new()
            .es(3, 2)
            .extensions(["GL_EXT_clip_cull_distance", "GL_EXT_sRGB_write_control"])
    },
];

/// Changes of state that passes make and only [`Neutral`] undoes.
fn disturb(gl: &Gl) {
    gl.viewport(1, 2, 3, 4);
    for unit in 0..9 {
        gl.active_texture(c::TEXTURE0 + unit);
        gl.bind_texture(c::TEXTURE_2D, TextureName::ZERO);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, TextureName::ZERO);
    }
    gl.use_program(ProgramName::ZERO);
    gl.bind_vertex_array(VertexArrayName::ZERO);
    gl.color_mask(0, 0, 0, 0);
}

#[test]
fn a_state_that_nobody_expects_comes_back() {
    for context in CONTEXTS {
        for seed in 0..100 {
            let fake = context();
            let gl = fake.gl();
            let fixed = !gl.is_es() && gl.get_integer(c::CONTEXT_PROFILE_MASK) == 2;
            fake.scramble(seed, fixed);
            if fixed {
                // Only the mask and the blending of the first draw buffer are saved, because no pass has another.
                fake.program(|gl| gl.color_maski(0, 1, 0, 1, 0));
            }
            let before = fake.state();
            let neutral = Neutral::enter(&gl, fixed, false);
            gl.viewport(1, 2, 3, 4);
            neutral.leave(&gl);
            let version = gl.get_string(c::VERSION);
            let differences = before.differences(&fake.state());
            assert_eq!(differences, [""; 0], "{version}, seed {seed}");
        }
    }
}

#[test]
fn passes_may_change_what_is_saved() {
    for seed in 0..100 {
        let fake = Fake::new();
        fake.scramble(seed, true);
        // Of the colour masks, that of the first draw buffer is neutral.
        fake.program(|gl| gl.color_mask(0, 0, 0, 0));
        let (gl, before) = (fake.gl(), fake.state());
        let neutral = Neutral::enter(&gl, true, false);
        disturb(&gl);
        neutral.leave(&gl);
        let differences = before.differences(&fake.state());
        assert_eq!(differences, [""; 0], "seed {seed}");
    }
}

#[test]
fn passes_find_a_neutral_state() {
    let off = [
        c::ALPHA_TEST,
        c::BLEND,
        c::COLOR_LOGIC_OP,
        c::CULL_FACE,
        c::DEPTH_TEST,
        c::DEPTH_CLAMP,
        c::DITHER,
        c::POLYGON_STIPPLE,
        c::POLYGON_SMOOTH,
        c::SCISSOR_TEST,
        c::STENCIL_TEST,
        c::SAMPLE_ALPHA_TO_COVERAGE,
        c::SAMPLE_MASK,
        c::RASTERIZER_DISCARD,
        c::FRAMEBUFFER_SRGB,
        c::CLIP_DISTANCE0,
        c::CLIP_DISTANCE0 + 3,
    ];
    for seed in 0..50 {
        let fake = Fake::new();
        fake.scramble(seed, true);
        let gl = fake.gl();
        let neutral = Neutral::enter(&gl, true, false);
        let state = fake.state();
        let on: Vec<u32> = off
            .into_iter()
            .filter(|&name| state.is_enabled(name))
            .collect();
        assert!(on.is_empty(), "{on:04X?}, seed {seed}");
        assert_eq!(state.value(c::COLOR_WRITEMASK), [1.0; 4]);
        assert_eq!(state.value(c::POLYGON_MODE), [f64::from(c::FILL); 2]);
        for name in [c::PACK_ALIGNMENT, c::UNPACK_ALIGNMENT] {
            assert_eq!(state.value(name), [1.0]);
        }
        for name in [
            c::PACK_ROW_LENGTH,
            c::PACK_SKIP_ROWS,
            c::PACK_SKIP_PIXELS,
            c::UNPACK_ROW_LENGTH,
            c::UNPACK_SKIP_ROWS,
            c::UNPACK_SKIP_PIXELS,
            c::UNPACK_IMAGE_HEIGHT,
            c::UNPACK_SKIP_IMAGES,
            c::PIXEL_PACK_BUFFER_BINDING,
            c::PIXEL_UNPACK_BUFFER_BINDING,
        ] {
            assert_eq!(state.value(name), [0.0], "0x{name:04X}, seed {seed}");
        }
        neutral.leave(&gl);
    }
}

#[test]
fn a_context_is_asked_only_for_what_it_has() {
    let fake = Fake::new().es(3, 0);
    let gl = fake.gl();
    Neutral::enter(&gl, false, false).leave(&gl);
    let asked: Vec<String> = fake.asked().into_iter().map(|(what, _)| what).collect();
    for name in [
        "POLYGON_MODE",
        "LOGIC_OP",
        "PIPELINE",
        "MULTISAMPLE_ARRAY",
        "CLIP_DISTANCE",
        "SRGB",
    ] {
        assert!(
            !asked.iter().any(|what| what.contains(name)),
            "{name}: {asked:?}"
        );
    }
    assert_eq!(fake.count("glPolygonMode") + fake.count("glEnablei"), 0);
}
