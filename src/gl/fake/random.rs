//! A state as a program may leave it, chosen by a seed.

use super::Fake;
use crate::gl::{Gl, consts as c};

/// Numbers that look random and are the same for the same seed (xorshift, Marsaglia 2003).
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 32) as u32 % end
    }

    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len() as u32) as usize]
    }
}

/// What programs switch on and off, in contexts of every kind and in those with fixed function.
const SWITCHES: &[(u32, bool)] = &[
    (c::BLEND, false),
    (c::CULL_FACE, false),
    (c::DEPTH_TEST, false),
    (c::DITHER, false),
    (c::SCISSOR_TEST, false),
    (c::STENCIL_TEST, false),
    (c::SAMPLE_ALPHA_TO_COVERAGE, false),
    (c::SAMPLE_COVERAGE, false),
    (c::RASTERIZER_DISCARD, false),
    (c::POLYGON_OFFSET_FILL, false),
    (c::ALPHA_TEST, true),
    (c::COLOR_LOGIC_OP, true),
    (c::DEPTH_CLAMP, true),
    (c::POLYGON_STIPPLE, true),
    (c::POLYGON_SMOOTH, true),
    (c::LINE_SMOOTH, true),
    (c::FRAMEBUFFER_SRGB, true),
    (c::SAMPLE_ALPHA_TO_ONE, true),
    (c::SAMPLE_MASK, true),
    (c::LIGHTING, true),
    (c::FOG, true),
    (c::COLOR_MATERIAL, true),
    (c::CLIP_DISTANCE0, true),
    (c::CLIP_DISTANCE0 + 3, true),
];

impl Fake {
    /// The program leaves a state that nobody expects, but for the framebuffers that are bound. `compatibility`: in a context with fixed function, else what every context has.
    pub fn scramble(&self, seed: u64, compatibility: bool) {
        let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        self.program(|gl| {
            switch(gl, &mut dice, compatibility);
            bind(gl, &mut dice);
            if compatibility {
                gl.matrix_mode(dice.one(&[c::MODELVIEW, c::PROJECTION, c::TEXTURE]));
                gl.provoking_vertex(
                    dice.one(&[c::FIRST_VERTEX_CONVENTION, c::LAST_VERTEX_CONVENTION]),
                );
                // SAFETY: no pointers, and the driver is the fake one.
                unsafe { gl.real().glShadeModel(dice.one(&[c::FLAT, c::SMOOTH])) };
                gl.polygon_mode(c::FRONT, dice.one(&[c::FILL, c::LINE, c::POINT]));
                gl.polygon_mode(c::BACK, dice.one(&[c::FILL, c::LINE, c::POINT]));
            }
        });
    }
}

fn switch(gl: &Gl, dice: &mut Dice, compatibility: bool) {
    for &(capability, fixed) in SWITCHES {
        if compatibility || !fixed {
            match dice.below(2) {
                0 => gl.disable(capability),
                _ => gl.enable(capability),
            }
        }
    }
    let mut mask = || dice.below(2) as u8;
    gl.color_mask(mask(), mask(), mask(), mask());
    gl.depth_mask(mask());
    let mut side = || dice.below(100) as i32;
    gl.viewport(side() - 50, side() - 50, side(), side());
    gl.scissor(side() - 50, side() - 50, side(), side());
    gl.depth_func(dice.one(&[c::LEQUAL, c::GEQUAL, c::ALWAYS, c::EQUAL]));
    gl.line_width(1.0 + dice.below(4) as f32);
    gl.point_size(1.0 + dice.below(4) as f32);
    gl.polygon_offset(dice.below(3) as f32, dice.below(3) as f32);
    for name in [c::PACK_ALIGNMENT, c::UNPACK_ALIGNMENT] {
        gl.pixel_storei(name, dice.one(&[1, 2, 4, 8]));
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
    ] {
        gl.pixel_storei(name, dice.below(3) as i32);
    }
}

fn bind(gl: &Gl, dice: &mut Dice) {
    for unit in 0..12 {
        gl.active_texture(c::TEXTURE0 + unit);
        for target in [
            c::TEXTURE_2D,
            c::TEXTURE_2D_ARRAY,
            c::TEXTURE_2D_MULTISAMPLE_ARRAY,
            c::TEXTURE_CUBE_MAP,
        ] {
            if dice.below(3) == 0 {
                gl.bind_texture(target, gl.gen_texture());
            }
        }
        if dice.below(3) == 0 {
            gl.bind_sampler(unit, 1 + dice.below(5));
        }
    }
    gl.active_texture(c::TEXTURE0 + dice.below(12));
    for target in [
        c::PIXEL_PACK_BUFFER,
        c::PIXEL_UNPACK_BUFFER,
        c::ARRAY_BUFFER,
        c::COPY_READ_BUFFER,
    ] {
        if dice.below(2) == 0 {
            gl.bind_buffer(target, gl.gen_buffer());
        }
    }
    if dice.below(2) == 0 {
        gl.bind_vertex_array(gl.gen_vertex_array());
    }
    if dice.below(2) == 0 {
        let shader = gl.compile(c::VERTEX_SHADER, "void main() {}");
        let program = shader.and_then(|shader| gl.link(&[shader]));
        gl.use_program(program.unwrap_or_default());
    }
}
