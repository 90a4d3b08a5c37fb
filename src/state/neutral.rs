//! The neutral state, in which the layer's own passes draw. Entering it saves the program's state, and leaving it restores that.
//!
//! Every pass of the layer takes a [`Neutral`] as an argument, so that none can run in the program's state.

use super::Rectangles;
use crate::gl::{Gl, PixelStore, ProgramName, TextureName, VertexArrayName, consts as c};

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

/// OpenGL 3.2, and no version of OpenGL ES.
const DESKTOP_3_2: Needs = Needs::Version((3, 2), (u32::MAX, 0));

/// Texture units that passes sample from.
const UNITS: u32 = 9;

#[derive(Clone, Copy, PartialEq)]
enum Needs {
    Any,
    Compatibility,
    /// Not OpenGL ES.
    Desktop,
    /// The context has GL_FRAMEBUFFER_SRGB.
    Srgb,
    /// At least this version of OpenGL, or of OpenGL ES.
    Version((u32, u32), (u32, u32)),
}

/// Proof that the state is neutral, with the saved state of the program. No capability, blending, mask, pixel store, sampler or
/// buffer of the program's affects a draw, a copy or a read. Framebuffer bindings are the caller's.
#[derive(Debug)]
#[must_use = "the program's state comes back by `leave`"]
pub struct Neutral {
    enabled: Vec<u32>,
    colours: Colours,
    viewports: Viewports,
    polygon_mode: [u32; 2],
    pixels: PixelStore,
    /// `None` in a context without vertex arrays and array textures.
    objects: Option<Objects>,
}

/// What the viewport of a pass replaces.
#[derive(Debug)]
enum Viewports {
    /// One viewport, which is that of all indices.
    One([i32; 4]),
    /// By index, with scissor tests, which are switched by index as well.
    Several(Rectangles),
}

/// The properties of the context that decide which state is saved.
struct Context<'g> {
    gl: &'g Gl,
    compatibility: bool,
    srgb: bool,
}

impl Context<'_> {
    fn since(&self, desktop: (u32, u32), of_es: (u32, u32)) -> bool {
        self.gl.since(desktop, Some(of_es))
    }

    fn has(&self, needs: Needs) -> bool {
        match needs {
            Needs::Any => true,
            Needs::Compatibility => self.compatibility,
            Needs::Desktop => !self.gl.is_es(),
            Needs::Srgb => self.gl.version() >= (3, 0) && self.srgb,
            Needs::Version(desktop, of_es) => self.since(desktop, of_es),
        }
    }
}

impl Neutral {
    /// Saves the program's state and sets the neutral one; `compatibility`: the context has fixed function;
    /// `several`: the program has set viewports or scissor rectangles by their index.
    pub fn enter(gl: &Gl, compatibility: bool, several: bool) -> Neutral {
        let viewports = match several {
            true => Viewports::Several(Rectangles::ask(gl, true)),
            false => Viewports::One(gl.get_integers(c::VIEWPORT)),
        };
        let context = Context {
            gl,
            compatibility,
            srgb: gl.switches_srgb(),
        };
        let enabled = disable_all(gl, &context);
        let colours = Colours::enter(gl, &context);
        let pixels = PixelStore::enter(gl);
        // A core context returns one mode, a compatibility context one per face, and OpenGL ES has none.
        let [front, back] = match gl.is_es() {
            true => [c::FILL; 2],
            false => gl.get_integers(c::POLYGON_MODE).map(|m| m as u32),
        };
        let polygon_mode = [front, if compatibility { back } else { front }];
        if polygon_mode != [c::FILL; 2] {
            gl.polygon_mode(c::FRONT_AND_BACK, c::FILL);
        }
        let objects = context
            .since((3, 0), (3, 0))
            .then(|| Objects::enter(gl, &context));
        Neutral {
            enabled,
            colours,
            viewports,
            polygon_mode,
            pixels,
            objects,
        }
    }

    /// How pixels lie in memory, for commands that read and write them.
    pub fn pixels(&self) -> &PixelStore {
        &self.pixels
    }

    /// Restores the program's state. Framebuffer bindings are the caller's.
    pub fn leave(self, gl: &Gl) {
        self.enabled.iter().for_each(|&e| gl.enable(e));
        match self.viewports {
            Viewports::One([x, y, w, h]) => gl.viewport(x, y, w, h),
            Viewports::Several(rectangles) => rectangles.put(gl),
        }
        self.colours.leave(gl);
        let [front, back] = self.polygon_mode;
        if front != back {
            gl.polygon_mode(c::FRONT, front);
            gl.polygon_mode(c::BACK, back);
        } else if front != c::FILL {
            gl.polygon_mode(c::FRONT_AND_BACK, front);
        }
        self.pixels.leave(gl);
        if let Some(objects) = self.objects {
            objects.leave(gl);
        }
    }
}

/// Disables the capabilities that would spoil a copy of colours; returns those that were on.
fn disable_all(gl: &Gl, context: &Context) -> Vec<u32> {
    let planes = match gl.is_es() && !gl.has_extension("GL_EXT_clip_cull_distance") {
        true => 0,
        false => gl.get_integer(c::MAX_CLIP_DISTANCES).max(0) as u32,
    };
    let known = CAPABILITIES.iter().filter(|k| context.has(k.1));
    let all = known
        .map(|k| k.0)
        .chain((0..planes).map(|i| c::CLIP_DISTANCE0 + i));
    let enabled: Vec<u32> = all.filter(|&k| gl.is_enabled(k)).collect();
    enabled.iter().for_each(|&e| gl.disable(e));
    enabled
}

/// Blending and colour mask of the first draw buffer.
#[derive(Debug)]
struct Colours {
    blend: bool,
    /// Each draw buffer has its own.
    indexed: bool,
    mask: [i32; 4],
}

impl Colours {
    fn enter(gl: &Gl, context: &Context) -> Self {
        let indexed = context.since((3, 0), (3, 2));
        let blend = match indexed {
            true => gl.is_enabledi(c::BLEND, 0),
            false => gl.is_enabled(c::BLEND),
        };
        if blend && indexed {
            gl.disablei(c::BLEND, 0)
        } else if blend {
            gl.disable(c::BLEND)
        }
        let mask = match indexed {
            true => gl.get_integers_indexed(c::COLOR_WRITEMASK, 0),
            false => gl.get_integers(c::COLOR_WRITEMASK),
        };
        match indexed {
            true => gl.color_maski(0, 1, 1, 1, 1),
            false => gl.color_mask(1, 1, 1, 1),
        }
        Colours {
            blend,
            indexed,
            mask,
        }
    }

    fn leave(&self, gl: &Gl) {
        if self.blend && self.indexed {
            gl.enablei(c::BLEND, 0)
        } else if self.blend {
            gl.enable(c::BLEND)
        }
        let [r, g, b, a] = self.mask.map(|v| u8::from(v != 0));
        match self.indexed {
            true => gl.color_maski(0, r, g, b, a),
            false => gl.color_mask(r, g, b, a),
        }
    }
}

/// The program, the program pipeline, the vertex array, and the bindings of the texture units from which passes sample.
#[derive(Debug)]
struct Objects {
    program: ProgramName,
    pipeline: u32,
    vertex_array: VertexArrayName,
    active: u32,
    /// By unit: 2D, 2D array and 2D multisample array texture, and sampler.
    textures: Vec<([TextureName; 3], u32)>,
    samplers: bool,
    sampled_arrays: bool,
}

impl Objects {
    fn enter(gl: &Gl, context: &Context) -> Self {
        let name = |n| gl.get_integer(n) as u32;
        let samplers = context.since((3, 3), (3, 0));
        let sampled_arrays = context.since((3, 2), (3, 2));
        let active = name(c::ACTIVE_TEXTURE);
        let mut textures = Vec::new();
        for unit in 0..UNITS {
            gl.active_texture(c::TEXTURE0 + unit);
            let sampler = match samplers {
                true => name(c::SAMPLER_BINDING),
                false => 0,
            };
            let texture = |binding| TextureName(name(binding));
            let bound = [
                texture(c::TEXTURE_BINDING_2D),
                texture(c::TEXTURE_BINDING_2D_ARRAY),
                match sampled_arrays {
                    true => texture(c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY),
                    false => TextureName::ZERO,
                },
            ];
            textures.push((bound, sampler));
            if sampler != 0 {
                gl.bind_sampler(unit, 0);
            }
        }
        let pipeline = match context.since((4, 1), (3, 1)) {
            true => name(c::PROGRAM_PIPELINE_BINDING),
            false => 0,
        };
        Objects {
            program: ProgramName(name(c::CURRENT_PROGRAM)),
            pipeline,
            vertex_array: VertexArrayName(name(c::VERTEX_ARRAY_BINDING)),
            active,
            textures,
            samplers,
            sampled_arrays,
        }
    }

    fn leave(&self, gl: &Gl) {
        for (unit, (t, sampler)) in self.textures.iter().enumerate() {
            gl.active_texture(c::TEXTURE0 + unit as u32);
            gl.bind_texture(c::TEXTURE_2D, t[0]);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, t[1]);
            if self.sampled_arrays {
                gl.bind_texture(c::TEXTURE_2D_MULTISAMPLE_ARRAY, t[2]);
            }
            if self.samplers && *sampler != 0 {
                gl.bind_sampler(unit as u32, *sampler);
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

#[cfg(test)]
mod tests;
