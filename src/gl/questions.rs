//! Questions about the state of the context. The shadow answers what it knows, and the driver the rest.

use super::Gl;
use super::api::text;
use super::consts as c;
use super::shadow::{self, Form};

/// What glGet answers by a list whose length the driver chooses.
const LISTS: [u32; 3] = [
    c::COMPRESSED_TEXTURE_FORMATS,
    c::SHADER_BINARY_FORMATS,
    c::PROGRAM_BINARY_FORMATS,
];

impl Gl {
    /// glIsEnabled
    pub fn is_enabled(&self, cap: u32) -> bool {
        // SAFETY: a context is current.
        shadow::is_enabled(cap, || unsafe { self.real.glIsEnabled(cap) != 0 })
    }

    /// glIsEnabledi
    pub fn is_enabledi(&self, cap: u32, index: u32) -> bool {
        // SAFETY: a context is current.
        shadow::is_enabled_at(cap, index, || unsafe {
            self.real.glIsEnabledi(cap, index) != 0
        })
    }

    /// glGetIntegerv of up to 4 values; zeros for what is a list as long as the driver likes.
    pub fn get_integers<const K: usize>(&self, name: u32) -> [i32; K] {
        const { assert!(K <= 4) };
        if LISTS.contains(&name) {
            return [0; K];
        }
        let words = shadow::value(name, Form::Integers, || self.ask_integers(name));
        std::array::from_fn(|at| words[at] as i32)
    }

    fn ask_integers(&self, name: u32) -> [u32; 4] {
        let mut v = [0u32; 16];
        // SAFETY: room for 16 elements, the size of a matrix; no name has more but those that are left out before (OpenGL 4.6, tables
        // 23.2 to 23.81).
        unsafe { self.real.glGetIntegerv(name, v.as_mut_ptr().cast()) };
        [v[0], v[1], v[2], v[3]]
    }

    /// glGetIntegerv of a single value.
    pub fn get_integer(&self, name: u32) -> i32 {
        self.get_integers::<1>(name)[0]
    }

    /// glGetFloatv of up to 4 values.
    pub fn get_floats<const K: usize>(&self, name: u32) -> [f32; K] {
        const { assert!(K <= 4) };
        if LISTS.contains(&name) {
            return [0.0; K];
        }
        let words = shadow::value(name, Form::Floats, || {
            let v = self.ask_floats(name);
            [v[0], v[1], v[2], v[3]].map(f32::to_bits)
        });
        std::array::from_fn(|at| f32::from_bits(words[at]))
    }

    /// GL_CURRENT_TEXTURE_COORDS of a unit, counted from 0.
    pub fn get_coordinates(&self, unit: u32) -> [f32; 4] {
        let name = c::CURRENT_TEXTURE_COORDS;
        let words = shadow::coordinates(unit, || {
            let active = self.get_integer(c::ACTIVE_TEXTURE) as u32;
            self.active_texture(c::TEXTURE0 + unit);
            let v = self.ask_floats(name);
            self.active_texture(active);
            [v[0], v[1], v[2], v[3]].map(f32::to_bits)
        });
        words.map(f32::from_bits)
    }

    /// glGetFloatv of a matrix, column-major.
    pub fn get_matrix(&self, name: u32) -> [f32; 16] {
        shadow::matrix(name, || self.ask_floats(name))
    }

    fn ask_floats(&self, name: u32) -> [f32; 16] {
        let mut v = [0f32; 16];
        // SAFETY: as in `ask_integers`.
        unsafe { self.real.glGetFloatv(name, v.as_mut_ptr().cast()) };
        v
    }

    /// glGetBooleani_v through glGetIntegeri_v, up to 4 values.
    pub fn get_integers_indexed<const K: usize>(&self, name: u32, index: u32) -> [i32; K] {
        const { assert!(K <= 4) };
        let words = shadow::value_at(name, index, || {
            let mut v = [0u32; 4];
            // SAFETY: room for 4 elements.
            unsafe {
                self.real
                    .glGetIntegeri_v(name, index, v.as_mut_ptr().cast())
            };
            v
        });
        std::array::from_fn(|at| words[at] as i32)
    }

    /// glGetFloati_v, 4 values.
    pub fn get_floats_indexed(&self, name: u32, index: u32) -> [f32; 4] {
        let words = shadow::floats_at(name, index, || {
            let mut v = [0u32; 4];
            // SAFETY: room for 4 elements.
            unsafe { self.real.glGetFloati_v(name, index, v.as_mut_ptr().cast()) };
            v
        });
        words.map(f32::from_bits)
    }

    /// glGetLightfv, up to 4 values; of GL_POSITION, only w counts.
    pub fn get_light(&self, light: u32, name: u32) -> [f32; 4] {
        let words = shadow::light(light, name, || {
            let mut v = [0u32; 4];
            // SAFETY: room for 4 elements.
            unsafe { self.real.glGetLightfv(light, name, v.as_mut_ptr().cast()) };
            v
        });
        words.map(f32::from_bits)
    }

    /// Whether the context has an extension, by glGetStringi where there is GL 3, else by the one long string.
    pub fn has_extension(&self, extension: &str) -> bool {
        shadow::has_extension(extension, || self.ask_extension(extension))
    }

    fn ask_extension(&self, extension: &str) -> bool {
        let n = if self.version() >= (3, 0) {
            self.get_integer(super::consts::NUM_EXTENSIONS)
        } else {
            0
        };
        if n > 0 {
            return (0..n as u32).any(|i| {
                // SAFETY: a context is current; i is below the number of extensions.
                let name = unsafe { self.real.glGetStringi(super::consts::EXTENSIONS, i) };
                text(name) == extension
            });
        }
        self.get_string(super::consts::EXTENSIONS)
            .split(' ')
            .any(|e| e == extension)
    }

    /// Whether a parameter of the material follows the colour (GL_COLOR_MATERIAL), so that glMaterial does not set it (OpenGL 4.6 compatibility
    /// profile, 12.2.3).
    pub fn follows_colour(&self, face: u32, name: u32) -> bool {
        let setting = |name| self.get_integer(name) as u32;
        self.is_enabled(c::COLOR_MATERIAL)
            && shadow::drives(
                [c::COLOR_MATERIAL_FACE, c::COLOR_MATERIAL_PARAMETER].map(setting),
                face,
                name,
            )
    }

    /// glGetMaterialfv, up to 4 values.
    pub fn get_material(&self, face: u32, name: u32) -> [f32; 4] {
        let words = shadow::material(face, name, self.follows_colour(face, name), || {
            let mut v = [0u32; 4];
            // SAFETY: room for 4 elements.
            unsafe { self.real.glGetMaterialfv(face, name, v.as_mut_ptr().cast()) };
            v
        });
        words.map(f32::from_bits)
    }

    /// GL_TEXTURE_GEN_MODE of a coordinate, GL_S to GL_Q.
    pub fn get_tex_gen_mode(&self, coord: u32) -> u32 {
        shadow::tex_gen(coord, || {
            let mut v = [0u32; 4];
            let name = c::TEXTURE_GEN_MODE;
            // SAFETY: room for 4 elements.
            unsafe { self.real.glGetTexGeniv(coord, name, v.as_mut_ptr().cast()) };
            v
        })[0]
    }

    /// glGetTexEnviv of one value of GL_TEXTURE_ENV.
    pub fn get_tex_env(&self, name: u32) -> i32 {
        let words = shadow::tex_env(name, || {
            let mut v = [0u32; 4];
            // SAFETY: room for 4 elements.
            unsafe {
                self.real
                    .glGetTexEnviv(c::TEXTURE_ENV, name, v.as_mut_ptr().cast())
            };
            v
        });
        words[0] as i32
    }
}
