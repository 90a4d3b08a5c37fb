//! Everything that our drawing at the end of a frame changes, saved before and put back after.

use crate::gl::{Gl, consts as c};

/// Capabilities that would spoil a copy of colours; off while we draw.
const CAPABILITIES: &[(u32, Needs)] = &[
    (c::ALPHA_TEST, Needs::Compatibility),
    (c::COLOR_LOGIC_OP, Needs::Desktop),
    (c::CULL_FACE, Needs::Any),
    (c::DEPTH_TEST, Needs::Any),
    (c::DEPTH_CLAMP, DESKTOP_3_2),
    (c::DITHER, Needs::Any),
    (c::POLYGON_STIPPLE, Needs::Compatibility),
    (c::POLYGON_SMOOTH, Needs::Desktop),
    (c::SCISSOR_TEST, Needs::Any),
    (c::STENCIL_TEST, Needs::Any),
    (c::SAMPLE_ALPHA_TO_COVERAGE, Needs::Any),
    (c::SAMPLE_ALPHA_TO_ONE, Needs::Desktop),
    (c::SAMPLE_COVERAGE, Needs::Any),
    (c::SAMPLE_MASK, Needs::Version((3, 2), (3, 1))),
    (c::RASTERIZER_DISCARD, Needs::Version((3, 0), (3, 0))),
    (c::FRAMEBUFFER_SRGB, Needs::Srgb),
];

/// Values of glPixelStore that a read or an upload of ours depends on, with what we set.
const PIXELS: &[(u32, i32, Needs)] = &[
    (c::PACK_ALIGNMENT, 1, Needs::Any),
    (c::PACK_ROW_LENGTH, 0, PIXELS_OF_ES),
    (c::PACK_SKIP_ROWS, 0, PIXELS_OF_ES),
    (c::PACK_SKIP_PIXELS, 0, PIXELS_OF_ES),
    (c::PACK_SWAP_BYTES, 0, Needs::Desktop),
    (c::UNPACK_ALIGNMENT, 1, Needs::Any),
    (c::UNPACK_ROW_LENGTH, 0, PIXELS_OF_ES),
    (c::UNPACK_SKIP_ROWS, 0, PIXELS_OF_ES),
    (c::UNPACK_SKIP_PIXELS, 0, PIXELS_OF_ES),
    (c::UNPACK_SWAP_BYTES, 0, Needs::Desktop),
    (c::UNPACK_IMAGE_HEIGHT, 0, PIXELS_OF_ES),
    (c::UNPACK_SKIP_IMAGES, 0, PIXELS_OF_ES),
];

/// And nothing of the kind in OpenGL ES.
const DESKTOP_3_2: Needs = Needs::Version((3, 2), (u32::MAX, 0));

const PIXELS_OF_ES: Needs = Needs::Version((1, 0), (3, 0));

/// Texture units that passes sample from.
const UNITS: u32 = 9;

#[derive(Clone, Copy, PartialEq)]
enum Needs {
    Any,
    Compatibility,
    /// Not OpenGL ES.
    Desktop,
    /// A switch for sRGB.
    Srgb,
    /// Of OpenGL, and of OpenGL ES.
    Version((u32, u32), (u32, u32)),
}

/// The program's state, taken by [`Saved::take`], which also sets what our drawing needs.
#[derive(Debug)]
pub struct Saved {
    enabled: Vec<u32>,
    blend: bool,
    indexed: bool,
    mask: [i32; 4],
    viewport: [i32; 4],
    polygon_mode: [u32; 2],
    program: u32,
    pipeline: u32,
    vertex_array: u32,
    active: u32,
    textures: Vec<[u32; 4]>,
    samplers: bool,
    sampled_arrays: bool,
    pixels: Vec<(u32, i32)>,
    pack: u32,
    unpack: u32,
    modern: bool,
}

impl Saved {
    /// Saves and neutralises.
    pub fn take(gl: &Gl, compatibility: bool) -> Saved {
        let (version, es) = (gl.version(), gl.is_es());
        let since = |desktop, of_es| version >= if es { of_es } else { desktop };
        let has = |n: Needs| match n {
            Needs::Any => true,
            Needs::Compatibility => compatibility,
            Needs::Desktop => !es,
            Needs::Srgb => version >= (3, 0) && gl.switches_srgb(),
            Needs::Version(desktop, of_es) => since(desktop, of_es),
        };
        let modern = since((3, 1), (3, 0));
        let name = |n| gl.get_integer(n) as u32;
        let planes = match es && !gl.has_extension("GL_EXT_clip_cull_distance") {
            true => 0,
            false => gl.get_integer(c::MAX_CLIP_DISTANCES).max(0) as u32,
        };
        let enabled: Vec<u32> = CAPABILITIES
            .iter()
            .filter(|k| has(k.1))
            .map(|k| k.0)
            .chain((0..planes).map(|i| c::CLIP_DISTANCE0 + i))
            .filter(|&k| gl.is_enabled(k))
            .collect();
        enabled.iter().for_each(|&e| gl.disable(e));
        let indexed = since((3, 0), (3, 2));
        let blend = if indexed {
            gl.is_enabledi(c::BLEND, 0) != 0
        } else {
            gl.is_enabled(c::BLEND)
        };
        if blend && indexed {
            gl.disablei(c::BLEND, 0)
        } else if blend {
            gl.disable(c::BLEND)
        }
        let mask = if indexed {
            gl.get_integers_indexed(c::COLOR_WRITEMASK, 0)
        } else {
            gl.get_integers(c::COLOR_WRITEMASK)
        };
        if indexed {
            gl.color_maski(0, 1, 1, 1, 1)
        } else {
            gl.color_mask(1, 1, 1, 1)
        }
        let mut pixels = Vec::new();
        for &(p, ours, _) in PIXELS.iter().filter(|k| has(k.2)) {
            let value = gl.get_integer(p);
            if value != ours {
                pixels.push((p, value));
                gl.pixel_storei(p, ours);
            }
        }
        let (pack, unpack) = if since((2, 1), (3, 0)) {
            (
                name(c::PIXEL_PACK_BUFFER_BINDING),
                name(c::PIXEL_UNPACK_BUFFER_BINDING),
            )
        } else {
            (0, 0)
        };
        if pack != 0 {
            gl.bind_buffer(c::PIXEL_PACK_BUFFER, 0);
        }
        if unpack != 0 {
            gl.bind_buffer(c::PIXEL_UNPACK_BUFFER, 0);
        }
        // A core context answers one mode, a compatibility context one per face, and OpenGL ES has none.
        let [front, back] = match es {
            true => [c::FILL; 2],
            false => gl.get_integers(c::POLYGON_MODE).map(|m| m as u32),
        };
        let polygon_mode = [front, if compatibility { back } else { front }];
        if polygon_mode != [c::FILL; 2] {
            gl.polygon_mode(c::FRONT_AND_BACK, c::FILL);
        }
        let samplers = since((3, 3), (3, 0));
        let sampled_arrays = since((3, 1), (3, 2));
        let active = name(c::ACTIVE_TEXTURE);
        let mut textures = Vec::new();
        for unit in 0..if modern { UNITS } else { 0 } {
            gl.active_texture(c::TEXTURE0 + unit);
            let sampler = if samplers {
                name(c::SAMPLER_BINDING)
            } else {
                0
            };
            textures.push([
                name(c::TEXTURE_BINDING_2D),
                name(c::TEXTURE_BINDING_2D_ARRAY),
                match sampled_arrays {
                    true => name(c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY),
                    false => 0,
                },
                sampler,
            ]);
            if sampler != 0 {
                gl.bind_sampler(unit, 0);
            }
        }
        let pipeline = if since((4, 1), (3, 1)) {
            name(c::PROGRAM_PIPELINE_BINDING)
        } else {
            0
        };
        Saved {
            enabled,
            blend,
            indexed,
            mask,
            viewport: gl.get_integers(c::VIEWPORT),
            polygon_mode,
            program: name(c::CURRENT_PROGRAM),
            pipeline,
            vertex_array: if modern {
                name(c::VERTEX_ARRAY_BINDING)
            } else {
                0
            },
            active,
            textures,
            samplers,
            sampled_arrays,
            pixels,
            pack,
            unpack,
            modern,
        }
    }

    /// Puts everything back. Framebuffer bindings are the caller's.
    pub fn restore(self, gl: &Gl) {
        let [x, y, w, h] = self.viewport;
        gl.viewport(x, y, w, h);
        self.enabled.iter().for_each(|&e| gl.enable(e));
        if self.blend && self.indexed {
            gl.enablei(c::BLEND, 0)
        } else if self.blend {
            gl.enable(c::BLEND)
        }
        let m = self.mask.map(|v| u8::from(v != 0));
        if self.indexed {
            gl.color_maski(0, m[0], m[1], m[2], m[3])
        } else {
            gl.color_mask(m[0], m[1], m[2], m[3])
        }
        let [front, back] = self.polygon_mode;
        if front != back {
            gl.polygon_mode(c::FRONT, front);
            gl.polygon_mode(c::BACK, back);
        } else if front != c::FILL {
            gl.polygon_mode(c::FRONT_AND_BACK, front);
        }
        self.pixels.iter().for_each(|&(p, v)| gl.pixel_storei(p, v));
        if self.pack != 0 {
            gl.bind_buffer(c::PIXEL_PACK_BUFFER, self.pack);
        }
        if self.unpack != 0 {
            gl.bind_buffer(c::PIXEL_UNPACK_BUFFER, self.unpack);
        }
        if !self.modern {
            return;
        }
        for (unit, t) in self.textures.iter().enumerate() {
            gl.active_texture(c::TEXTURE0 + unit as u32);
            gl.bind_texture(c::TEXTURE_2D, t[0]);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, t[1]);
            if self.sampled_arrays {
                gl.bind_texture(c::TEXTURE_2D_MULTISAMPLE_ARRAY, t[2]);
            }
            if self.samplers && t[3] != 0 {
                gl.bind_sampler(unit as u32, t[3]);
            }
        }
        gl.active_texture(self.active);
        gl.use_program(self.program);
        if self.pipeline != 0 {
            gl.bind_program_pipeline(self.pipeline);
        }
        gl.bind_vertex_array(self.vertex_array);
    }
}
