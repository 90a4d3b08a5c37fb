//! The accumulation buffer, which framebuffer objects do not have: one for each view, created when it is first needed.
//!
//! The arithmetic is Mesa's, measured with Mesa 22.3: 16-bit integers, of which 32767 stands for 1. Fractions are cut off, overflows
//! wrap, and colours are rounded to the nearest step. OpenGL requires no more than the range from -1 to 1.
#![forbid(unsafe_code)]

mod srgb;
#[cfg(test)]
mod tests;

use crate::atlas::{Atlas, Names};
use crate::gl::{
    FramebufferName, Gl, Object, PixelStore, ProgramName, TextureName, VertexArrayName, consts as c,
};
use crate::interleave::Program;
use crate::interleave::shader::{Pass, Step};
use crate::state::Neutral;
use crate::state::Window;

/// The stored value of 1.
const ONE: f32 = 32767.0;

/// An operation on the accumulation buffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    /// glClear with these values.
    Clear([f32; 4]),
    /// GL_LOAD.
    Load(f32),
    /// GL_ACCUM.
    Accumulate(f32),
    /// GL_MULT.
    Multiply(f32),
    /// GL_ADD.
    Add(f32),
    /// GL_RETURN, to the channels of the colour mask.
    Return(f32, [bool; 4]),
}

impl Operation {
    /// The operation of glAccum; `None` if `op` is none. `mask` is the colour mask.
    pub fn of(op: u32, value: f32, mask: [bool; 4]) -> Option<Operation> {
        match op {
            c::LOAD => Some(Operation::Load(value)),
            c::ACCUM => Some(Operation::Accumulate(value)),
            c::MULT => Some(Operation::Multiply(value)),
            c::ADD => Some(Operation::Add(value)),
            c::RETURN => Some(Operation::Return(value, mask)),
            _ => None,
        }
    }

    /// The pass, and the values that it works with.
    fn step(self) -> (Step, [f32; 4]) {
        match self {
            Operation::Clear(values) => (Step::Fill, values.map(clear_value)),
            Operation::Load(v) => (Step::Load, [v * ONE; 4]),
            Operation::Accumulate(v) => (Step::Accumulate, [v * ONE; 4]),
            Operation::Multiply(v) => (Step::Multiply, [v; 4]),
            Operation::Add(v) => (Step::Add, [short(v * ONE); 4]),
            Operation::Return(v, _) => (Step::Return, [v / ONE; 4]),
        }
    }
}

/// Converts to a 32-bit integer and cuts that to 16 bits, as a CPU does it; 0 for a number that does not fit 32 bits.
fn short(v: f32) -> f32 {
    let whole = if v.abs() < 2_147_483_648.0 {
        v as i32
    } else {
        0
    };
    f32::from(whole as i16)
}

/// The stored value of a component of GL_ACCUM_CLEAR_VALUE.
fn clear_value(v: f32) -> f32 {
    let steps = (65535.0 * v) as i32;
    f32::from(((steps - 1) / 2) as i16)
}

/// A rectangle in a layer of the atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// Layer of the atlas.
    pub row: u32,
    /// x, y, width and height in texels, in the order of the texture's rows.
    pub rect: [i32; 4],
}

/// The accumulation buffers of all views of a context.
#[derive(Debug)]
pub struct Accumulation {
    programs: [Program; Step::ALL.len()],
    vertex_array: VertexArrayName,
    /// The framebuffer object of the passes. Each pass attaches the texture to which it draws, and detaches it again.
    framebuffer: FramebufferName,
    /// The accumulated values, laid out as the atlas: a tile for each view.
    values: TextureName,
    /// One layer, with a copy of the values that a pass reads while it draws over them.
    before: TextureName,
    size: [u32; 3],
    /// Tables of sRGB colours: to accumulate, and to return.
    tables: [Table; 2],
}

/// A table of `shaders/accumulate.wgsl`, and the bits of the factor for which it was made.
#[derive(Debug, Default)]
struct Table {
    texture: TextureName,
    value: Option<u32>,
}

impl Table {
    /// Binds the table; fills it first if it was made for another factor.
    fn bind(
        &mut self,
        gl: &Gl,
        pixels: &PixelStore,
        value: f32,
        make: impl FnOnce() -> (i32, Vec<i16>),
    ) {
        gl.bind_texture(c::TEXTURE_2D, self.texture);
        if self.value != Some(value.to_bits()) {
            let (height, data) = make();
            gl.tex_image_r16i(pixels, 256, height, &data);
            self.value = Some(value.to_bits());
        }
    }
}

/// For each stored colour, the value that is accumulated.
fn taken(factor: f32) -> (i32, Vec<i16>) {
    let value = |stored| short(srgb::decoded(stored) * factor) as i16;
    (1, (0..=255).map(value).collect())
}

/// For each accumulated value, the colour that is stored.
fn stored(factor: f32) -> (i32, Vec<i16>) {
    let colour = |v: i16| i16::from(srgb::encoded(f32::from(v) * factor));
    (256, (i16::MIN..=i16::MAX).map(colour).collect())
}

impl Accumulation {
    /// Creates the buffers for an atlas, all zero.
    ///
    /// # Errors
    /// If a program of the passes does not compile.
    pub fn new(
        gl: &Gl,
        _: &Neutral,
        names: &mut Names,
        glsl: u32,
        atlas: &Atlas,
    ) -> Result<Self, String> {
        let program = |step| Program::new(gl, glsl, Pass::Accumulate(step));
        let [fill, copy, load, accumulate, multiply, add, give_back] = Step::ALL.map(program);
        let tiles = atlas.tiles;
        let mut new = Accumulation {
            programs: [
                fill?,
                copy?,
                load?,
                accumulate?,
                multiply?,
                add?,
                give_back?,
            ],
            vertex_array: gl.gen_vertex_array(),
            framebuffer: gl.gen_framebuffer(),
            values: TextureName::ZERO,
            before: TextureName::ZERO,
            size: [tiles.texture_width(), tiles.height, tiles.rows],
            tables: Default::default(),
        };
        new.make_textures(gl, names);
        Ok(new)
    }

    fn make_textures(&mut self, gl: &Gl, names: &mut Names) {
        let [width, height, rows] = self.size.map(|s| s as i32);
        let mut texture = |target| {
            let name = names.texture(gl);
            gl.bind_texture(target, name);
            for (p, v) in [
                (c::TEXTURE_MIN_FILTER, c::NEAREST),
                (c::TEXTURE_MAG_FILTER, c::NEAREST),
                (c::TEXTURE_MAX_LEVEL, 0),
            ] {
                gl.tex_parameteri(target, p, v as i32);
            }
            name
        };
        self.tables = [(), ()].map(|()| Table {
            texture: texture(c::TEXTURE_2D),
            value: None,
        });
        let mut tiles = |layers: i32| {
            let name = texture(c::TEXTURE_2D_ARRAY);
            let (format, kind) = (c::RGBA_INTEGER, c::SHORT);
            gl.tex_storage_3d(c::RGBA16I, width, height, layers, format, kind);
            name
        };
        self.values = tiles(rows);
        self.before = tiles(1);
    }

    /// Whether a texture is one of these.
    pub fn owns(&self, texture: TextureName) -> bool {
        self.textures().contains(&texture)
    }

    /// Its textures.
    pub fn textures(&self) -> [TextureName; 4] {
        let [a, b] = &self.tables;
        [self.values, self.before, a.texture, b.texture]
    }

    /// Its framebuffer object, with a texture at the first colour attachment.
    pub fn framebuffer(&self) -> FramebufferName {
        self.framebuffer
    }

    /// The names of its programs.
    pub fn programs(&self) -> impl Iterator<Item = ProgramName> {
        self.programs.iter().map(Program::name)
    }

    /// Moves the contents to textures with other names. May leave the framebuffer object of the passes bound for drawing.
    pub fn rename(&mut self, gl: &Gl, _: &Neutral, names: &mut Names) {
        let old = self.textures();
        self.make_textures(gl, names);
        let [width, height, rows] = self.size;
        // In selection or feedback mode, a pass would draw nothing and report to the program instead; a copy works there.
        if gl.since((4, 3), None) {
            let size = self.size.map(|s| s as i32);
            let [from, to] = [old[0], self.values].map(Object::Texture);
            gl.copy_image(c::TEXTURE_2D_ARRAY, 0, from, to, size);
        } else {
            for row in 0..rows {
                let rect = [0, 0, width as i32, height as i32];
                self.copy(gl, (old[0], row), (self.values, row), rect);
            }
        }
        old.into_iter().for_each(|t| gl.delete_texture(t));
    }

    /// Deletes textures and framebuffer; the context has to be current.
    pub fn delete(self, gl: &Gl) {
        gl.delete_framebuffer(self.framebuffer);
        let textures = self.textures();
        textures.into_iter().for_each(|t| gl.delete_texture(t));
        // The programs are few, and stay with the context as those of other passes do.
    }

    /// Applies an operation to some regions. Colours are read from the layers of the texture `from`, which must be resolved, and returned
    /// to the same layers of the textures `to`; all have the size of the atlas. Leaves the framebuffer object of the passes bound for
    /// drawing.
    pub fn apply(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        operation: Operation,
        window: &Window,
        (from, to): (TextureName, &[TextureName]),
        regions: &[Region],
    ) {
        let (step, values) = operation.step();
        if window.srgb_capable {
            self.bind_table(gl, neutral.pixels(), step, values[0]);
        }
        let changes = matches!(step, Step::Accumulate | Step::Multiply | Step::Add);
        gl.active_texture(c::TEXTURE0);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, from);
        if let Operation::Return(_, mask) = operation {
            let [r, g, b, a] = mask.map(u8::from);
            gl.color_maski(0, r, g, b, a);
        }
        for &Region { row, rect } in regions {
            let mut before = (self.values, row);
            if changes {
                // The copy is not a blit, because llvmpipe 22.3 may then copy the contents from before the last pass.
                before = (self.before, 0);
                self.copy(gl, (self.values, row), before, rect);
            }
            let targets = match step {
                Step::Return => to,
                _ => &[self.values],
            };
            let words = words(window, values, row, before.1);
            for &target in targets {
                self.pass(gl, step, before.0, (target, row), rect, &words);
            }
        }
    }

    fn copy(&self, gl: &Gl, from: (TextureName, u32), to: (TextureName, u32), rect: [i32; 4]) {
        let mut words = [0; 16];
        words[BEFORE] = from.1;
        self.pass(gl, Step::Copy, from.0, to, rect, &words);
    }

    /// One pass: from a texture to a layer of a texture.
    fn pass(
        &self,
        gl: &Gl,
        step: Step,
        from: TextureName,
        to: (TextureName, u32),
        [x, y, w, h]: [i32; 4],
        words: &[u32; 16],
    ) {
        let program = Step::ALL.iter().zip(&self.programs);
        let Some((_, program)) = program.into_iter().find(|p| *p.0 == step) else {
            return;
        };
        let attach = |texture, layer| {
            let (target, point) = (c::DRAW_FRAMEBUFFER, c::COLOR_ATTACHMENT0);
            gl.framebuffer_texture_layer(target, point, texture, 0, layer);
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.framebuffer);
        attach(to.0, to.1 as i32);
        gl.viewport(x, y, w, h);
        gl.active_texture(c::TEXTURE0 + 1);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, from);
        program.bind(gl, words);
        gl.draw_triangle(self.vertex_array);
        // Detached, because a texture that is deleted while this framebuffer is not bound would stay attached.
        attach(TextureName::ZERO, 0);
    }

    fn bind_table(&mut self, gl: &Gl, pixels: &PixelStore, step: Step, factor: f32) {
        let [load, give_back] = &mut self.tables;
        gl.active_texture(c::TEXTURE0 + 2);
        match step {
            Step::Load | Step::Accumulate => load.bind(gl, pixels, factor, || taken(factor)),
            Step::Return => give_back.bind(gl, pixels, factor, || stored(factor)),
            Step::Fill | Step::Copy | Step::Multiply | Step::Add => {}
        }
    }
}

/// Index of the word with the layer of the accumulated values.
const BEFORE: usize = 13;

/// The uniforms, as `shaders/accumulate.wgsl` declares them.
fn words(window: &Window, values: [f32; 4], layer: u32, before: u32) -> [u32; 16] {
    let [r, g, b, a, _, _] = window.bits;
    let steps = [r, g, b, a].map(|bits| match bits {
        _ if window.float => 0.0,
        bits => ((1u64 << bits.min(24)) - 1) as f32,
    });
    let unit = steps.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
    let mut words = [0; 16];
    let floats = [steps, unit, values];
    for (word, float) in words.iter_mut().zip(floats.iter().flatten()) {
        *word = float.to_bits();
    }
    words[12] = layer;
    words[BEFORE] = before;
    words[14] = match window.srgb_capable {
        true => 1 + u32::from(window.srgb),
        false => 0,
    };
    words
}
