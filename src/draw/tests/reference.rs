//! Draws in the reference image of an occlusion camera.

use super::super::{Driver, Rays, ReplayHazard, draw_to_reference};
use super::Stage;
use super::amplified::Drawing;
use super::variant;
use crate::atlas::{Grid, Names};
use crate::config::AtlasLayout::SideBySide;
use crate::config::Clip;
use crate::draw::Drawing as Surfaces;
use crate::gl::fake::{Fake, Scope};
use crate::gl::{ProgramName, Vertices, consts as c};
use crate::plan::Reason;

const UNIT: u32 = super::super::programs::DISTORTION_UNIT;

fn stage() -> Stage {
    // llvmpipe has a limit of tessellated vertices, which some of the draws reach.
    let fake = Fake::new().renderer("llvmpipe (LLVM 15.0.6, 256 bits)");
    let mut stage = Stage::on(fake, SideBySide, Grid::FULL);
    let (gl, window) = (stage.gl, stage.state.window);
    assert!(
        stage
            .atlas
            .make_reference(&gl, &mut Names::default(), &window)
    );
    gl.bind_framebuffer(c::FRAMEBUFFER, stage.atlas.framebuffer());
    stage
}

fn rays(stage: &Stage) -> Rays {
    Rays {
        map: stage.atlas.reference().expect("made").map,
        disparities: [2.0, 0.5],
    }
}

/// Repeats a draw of so many vertices in the reference image. Returns the primitive modes in which it is sent.
fn repeated(
    drawing: &mut Drawing,
    rays: &Rays,
    mode: u32,
    vertices: u64,
) -> (Result<(), Reason>, Vec<u32>) {
    let Drawing {
        stage,
        programs,
        fixed,
    } = drawing;
    let surfaces = Surfaces {
        mode: Some(mode),
        vertices,
        counted: true,
        cuts: true,
        material: false,
    };
    let (gl, shear) = (stage.gl, stage.shear());
    let mut modes = Vec::new();
    let drawn = programs.draw_to_reference(
        &gl,
        &mut stage.atlas,
        &stage.state,
        &stage.rig,
        shear,
        fixed,
        &surfaces,
        ReplayHazard::None,
        rays,
        &mut |mode| {
            modes.push(mode);
            gl.draw_arrays(mode, Vertices::without_arrays(0, 30));
        },
    );
    (drawn, modes)
}

#[test]
fn surfaces_are_drawn_once_as_patches_and_leave_no_trace() {
    let mut drawn_at_all = 0;
    for seed in 0..40 {
        let mut stage = stage();
        stage.atlas.flipped = seed % 2 == 1;
        // So many triangles that each is small: they are not tessellated.
        let many = seed % 4 == 3;
        stage.fake.scramble(seed, true);
        stage.program(|gl| gl.use_program(ProgramName::ZERO));
        let rays = rays(&stage);
        let mut drawing = Drawing::new(stage, Clip::Distances, false);
        // The random state must not draw polygons as outlines or points.
        drawing.fixed.polygon_mode = [c::FILL; 2];
        let (gl, before) = (drawing.stage.gl, drawing.stage.fake.state());
        let vertices = if many { 30_000 } else { 30 };
        let (drawn, modes) = repeated(&mut drawing, &rays, c::TRIANGLES, vertices);
        let stage = &drawing.stage;
        let differences = before.differences(&stage.fake.state());
        assert_eq!(differences, [""; 0], "seed {seed}, {drawn:?}");
        if drawn.is_err() {
            continue;
        }
        drawn_at_all += 1;
        assert_eq!(modes, [if many { c::TRIANGLES } else { c::PATCHES }]);
        let state = &stage.fake.draws()[0].state;
        let image = stage.atlas.reference_framebuffer().expect("made");
        assert_eq!(
            state.int(Scope::Context, c::DRAW_FRAMEBUFFER_BINDING),
            image.0
        );
        let program = ProgramName(state.value(c::CURRENT_PROGRAM)[0] as u32);
        let uniform = |name| stage.fake.uniform(program, name);
        if !many {
            assert_eq!(state.value(c::PATCH_VERTICES), [3.0]);
            let level = Driver::ask(&gl).level(10);
            assert_ne!(level, Driver::ask(&gl).level(90));
            assert_eq!(uniform("mv_levels"), [f64::from(level)]);
        }
        assert_eq!(uniform("mv_distortion_map"), [f64::from(UNIT)]);
        let [x, y, width, height] = stage.state.rectangles.viewport.map(|n| n as f32);
        let (middle, up) = (y + height / 2.0, height / 2.0);
        let rows = match stage.atlas.flipped {
            true => [-up, 48.0 - middle],
            false => [up, middle],
        };
        let window = [width / 2.0, rows[0], x + width / 2.0, rows[1]];
        assert_eq!(uniform("mv_window"), window.map(f64::from));
        let kept_apart = if many { 1.0 } else { 0.0 };
        let disparity = [2.0, 0.5, 2.0 / width, kept_apart];
        assert_eq!(uniform("mv_disparity"), disparity.map(f64::from));
        let map = state.int(Scope::Unit(UNIT), c::TEXTURE_BINDING_2D_ARRAY);
        assert_eq!(map, rays.map.0);
    }
    assert!(drawn_at_all > 10, "{drawn_at_all}");
}

#[test]
fn a_variant_draws_with_the_map_in_a_unit_that_it_has_no_use_for() {
    let mut stage = stage();
    let program = variant::program(&mut stage);
    let variant = variant::variant(&stage, program, super::super::VariantKind::DistortedRays);
    let rays = rays(&stage);
    for (units, free) in [(&[0][..], UNIT), (&[UNIT, UNIT - 1], UNIT - 2)] {
        let before = stage.fake.state();
        stage.fake.forget();
        let (gl, shear) = (stage.gl, stage.shear());
        gl.use_program(variant.name());
        let (state, rig) = (&stage.state, &stage.rig);
        let (by, hazard) = ((&*variant, units), ReplayHazard::None);
        draw_to_reference(
            &gl,
            &mut stage.atlas,
            state,
            rig,
            shear,
            by,
            30,
            hazard,
            &rays,
            &mut || {
                gl.draw_arrays(c::TRIANGLES, Vertices::without_arrays(0, 30));
            },
        );
        gl.use_program(program);
        stage.fake.assert_restored(&before);
        let drawn = stage.fake.draws();
        assert_eq!(drawn.len(), 1);
        let map = drawn[0]
            .state
            .int(Scope::Unit(free), c::TEXTURE_BINDING_2D_ARRAY);
        assert_eq!(map, rays.map.0);
    }
}

/// Flat shading colours a triangle of a strip by one corner, which depends on its place in the strip.
#[test]
fn a_strip_is_cut_unless_its_triangles_have_one_colour_each() {
    for (flat, mode, sent) in [
        (false, c::TRIANGLE_STRIP, c::PATCHES),
        (true, c::TRIANGLE_STRIP, c::TRIANGLE_STRIP),
        (true, c::TRIANGLES, c::PATCHES),
    ] {
        let stage = stage();
        if flat {
            stage
                .fake
                .put(Scope::Context, c::SHADE_MODEL, &[f64::from(c::FLAT)]);
        }
        let rays = rays(&stage);
        let mut drawing = Drawing::new(stage, Clip::Distances, false);
        let (drawn, modes) = repeated(&mut drawing, &rays, mode, 30);
        assert_eq!((drawn.is_ok(), modes), (true, vec![sent]), "flat: {flat}");
    }
}
