//! Everything that our drawing at the end of a frame changes, saved before and put back after.

use crate::gl::{Gl, consts as c};

/// Capabilities that would spoil a copy of colours; off while we draw.
const CAPABILITIES: &[(u32, Needs)] = &[
    (c::ALPHA_TEST, Needs::Compatibility),
    (c::COLOR_LOGIC_OP, Needs::Any),
    (c::CULL_FACE, Needs::Any),
    (c::DEPTH_TEST, Needs::Any),
    (c::DITHER, Needs::Any),
    (c::POLYGON_STIPPLE, Needs::Compatibility),
    (c::POLYGON_SMOOTH, Needs::Any),
    (c::SCISSOR_TEST, Needs::Any),
    (c::STENCIL_TEST, Needs::Any),
    (c::SAMPLE_ALPHA_TO_COVERAGE, Needs::Any),
    (c::SAMPLE_ALPHA_TO_ONE, Needs::Any),
    (c::SAMPLE_COVERAGE, Needs::Any),
    (c::SAMPLE_MASK, Needs::Version(3, 2)),
    (c::RASTERIZER_DISCARD, Needs::Version(3, 0)),
    (c::FRAMEBUFFER_SRGB, Needs::Version(3, 0)),
];

/// Values of glPixelStore that a read or an upload of ours depends on, with what we set.
const PIXELS: &[(u32, i32)] = &[
    (c::PACK_ALIGNMENT, 1),
    (c::PACK_ROW_LENGTH, 0),
    (c::PACK_SKIP_ROWS, 0),
    (c::PACK_SKIP_PIXELS, 0),
    (c::PACK_SWAP_BYTES, 0),
    (c::UNPACK_ALIGNMENT, 1),
    (c::UNPACK_ROW_LENGTH, 0),
    (c::UNPACK_SKIP_ROWS, 0),
    (c::UNPACK_SKIP_PIXELS, 0),
    (c::UNPACK_SWAP_BYTES, 0),
    (c::UNPACK_IMAGE_HEIGHT, 0),
    (c::UNPACK_SKIP_IMAGES, 0),
];

/// Texture units that passes sample from.
const UNITS: u32 = 3;

#[derive(Clone, Copy)]
enum Needs {
    Any,
    Compatibility,
    Version(u32, u32),
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
    pixels: Vec<(u32, i32)>,
    pack: u32,
    unpack: u32,
    modern: bool,
}

impl Saved {
    /// Saves and neutralises.
    pub fn take(gl: &Gl, compatibility: bool) -> Saved {
        let version = gl.version();
        let has = |n: Needs| match n {
            Needs::Any => true,
            Needs::Compatibility => compatibility,
            Needs::Version(a, b) => version >= (a, b),
        };
        let modern = version >= (3, 1);
        let name = |n| gl.get_integer(n) as u32;
        let planes = gl.get_integer(c::MAX_CLIP_DISTANCES).max(0) as u32;
        let enabled: Vec<u32> = CAPABILITIES
            .iter()
            .filter(|k| has(k.1))
            .map(|k| k.0)
            .chain((0..planes).map(|i| c::CLIP_DISTANCE0 + i))
            .filter(|&k| gl.is_enabled(k))
            .collect();
        enabled.iter().for_each(|&e| gl.disable(e));
        let indexed = version >= (3, 0);
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
        let pixels: Vec<(u32, i32)> = PIXELS
            .iter()
            .map(|&(p, _)| (p, gl.get_integer(p)))
            .filter(|k| !PIXELS.contains(k))
            .collect();
        for &(p, _) in &pixels {
            if let Some(&(_, ours)) = PIXELS.iter().find(|k| k.0 == p) {
                gl.pixel_storei(p, ours);
            }
        }
        let (pack, unpack) = if version >= (2, 1) {
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
        // A core context answers one mode, a compatibility context one per face.
        let [front, back] = gl.get_integers::<2>(c::POLYGON_MODE).map(|m| m as u32);
        let polygon_mode = [front, if compatibility { back } else { front }];
        if polygon_mode != [c::FILL; 2] {
            gl.polygon_mode(c::FRONT_AND_BACK, c::FILL);
        }
        let samplers = version >= (3, 3);
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
                name(c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY),
                sampler,
            ]);
            if sampler != 0 {
                gl.bind_sampler(unit, 0);
            }
        }
        let pipeline = if version >= (4, 1) {
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
            gl.bind_texture(c::TEXTURE_2D_MULTISAMPLE_ARRAY, t[2]);
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
