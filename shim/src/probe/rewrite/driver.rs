//! Compiles and links shaders in the current context. Signatures: GL/glcorearb.h.

use crate::egl;
use core::ffi::{c_char, c_int, c_uint};
use manyview_core::rewrite::Stage;

const COMPILE_STATUS: c_uint = 0x8B81;
const LINK_STATUS: c_uint = 0x8B82;
const INFO_LOG_LENGTH: c_uint = 0x8B84;
const ACTIVE_UNIFORMS: c_uint = 0x8B86;
const ACTIVE_ATTRIBUTES: c_uint = 0x8B89;

type Create = unsafe extern "C" fn(c_uint) -> c_uint;
type Source = unsafe extern "C" fn(c_uint, c_int, *const *const c_char, *const c_int);
type One = unsafe extern "C" fn(c_uint);
type Two = unsafe extern "C" fn(c_uint, c_uint);
type Get = unsafe extern "C" fn(c_uint, c_uint, *mut c_int);
type GetLog = unsafe extern "C" fn(c_uint, c_int, *mut c_int, *mut c_char);
type CreateProgram = unsafe extern "C" fn() -> c_uint;
type GetActive =
    unsafe extern "C" fn(c_uint, c_uint, c_int, *mut c_int, *mut c_int, *mut c_uint, *mut c_char);

/// Functions of the driver. More than 12 fields: one for each function.
pub(super) struct Driver {
    create_shader: Create,
    shader_source: Source,
    compile_shader: One,
    get_shader: Get,
    shader_log: GetLog,
    delete_shader: One,
    create_program: CreateProgram,
    attach: Two,
    link: One,
    get_program: Get,
    program_log: GetLog,
    delete_program: One,
    active_attribute: GetActive,
    active_uniform: GetActive,
}

/// A function of the driver, by the lookup of `egl` and not from one library.
macro_rules! loaded {
    ($name:literal, $type:ty) => {{
        let pointer = egl::find($name);
        if pointer.is_null() {
            return Err(format!("the driver has no {}", $name.to_string_lossy()));
        }
        // SAFETY: not null, and the function of this name has this signature (the header above).
        unsafe { core::mem::transmute::<manyview_core::gl::Ptr, $type>(pointer) }
    }};
}

/// A shader object.
pub(super) struct Shader(c_uint);

/// The active attributes and uniforms of a linked program, sorted: name, type and size of each.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Interface {
    pub(super) attributes: Vec<String>,
    pub(super) uniforms: Vec<String>,
}

fn kind(stage: Stage) -> c_uint {
    match stage {
        Stage::Vertex => 0x8B31,
        Stage::TessControl => 0x8E88,
        Stage::TessEvaluation => 0x8E87,
        Stage::Geometry => 0x8DD9,
        Stage::Fragment => 0x8B30,
        Stage::Compute => 0x91B9,
    }
}

impl Driver {
    /// The functions of the current context.
    pub(super) fn load() -> Result<Self, String> {
        Ok(Self {
            create_shader: loaded!(c"glCreateShader", Create),
            shader_source: loaded!(c"glShaderSource", Source),
            compile_shader: loaded!(c"glCompileShader", One),
            get_shader: loaded!(c"glGetShaderiv", Get),
            shader_log: loaded!(c"glGetShaderInfoLog", GetLog),
            delete_shader: loaded!(c"glDeleteShader", One),
            create_program: loaded!(c"glCreateProgram", CreateProgram),
            attach: loaded!(c"glAttachShader", Two),
            link: loaded!(c"glLinkProgram", One),
            get_program: loaded!(c"glGetProgramiv", Get),
            program_log: loaded!(c"glGetProgramInfoLog", GetLog),
            delete_program: loaded!(c"glDeleteProgram", One),
            active_attribute: loaded!(c"glGetActiveAttrib", GetActive),
            active_uniform: loaded!(c"glGetActiveUniform", GetActive),
        })
    }

    /// Compiles a shader. The error is the driver's log.
    pub(super) fn compile(&self, stage: Stage, text: &[u8]) -> Result<Shader, String> {
        let length = c_int::try_from(text.len()).map_err(|_| "too long".to_owned())?;
        let start = text.as_ptr().cast();
        // SAFETY: the context is current.
        let shader = unsafe { (self.create_shader)(kind(stage)) };
        // SAFETY: one string and its length; the driver copies it.
        unsafe { (self.shader_source)(shader, 1, &raw const start, &raw const length) };
        // SAFETY: no pointers.
        unsafe { (self.compile_shader)(shader) };
        if number(self.get_shader, shader, COMPILE_STATUS) != 0 {
            return Ok(Shader(shader));
        }
        let log = log(self.get_shader, self.shader_log, shader);
        self.delete(Shader(shader));
        Err(log)
    }

    pub(super) fn delete(&self, shader: Shader) {
        // SAFETY: no pointers.
        unsafe { (self.delete_shader)(shader.0) };
    }

    /// Links shaders to a program and returns its interface. The error is the driver's log.
    pub(super) fn link(&self, shaders: &[&Shader]) -> Result<Interface, String> {
        // SAFETY: the context is current.
        let program = unsafe { (self.create_program)() };
        for shader in shaders {
            // SAFETY: no pointers.
            unsafe { (self.attach)(program, shader.0) };
        }
        // SAFETY: no pointers.
        unsafe { (self.link)(program) };
        let result = if number(self.get_program, program, LINK_STATUS) == 0 {
            Err(log(self.get_program, self.program_log, program))
        } else {
            Ok(Interface {
                attributes: self.active(self.active_attribute, program, ACTIVE_ATTRIBUTES),
                uniforms: self.active(self.active_uniform, program, ACTIVE_UNIFORMS),
            })
        };
        // SAFETY: no pointers.
        unsafe { (self.delete_program)(program) };
        result
    }

    fn active(&self, get: GetActive, program: c_uint, count: c_uint) -> Vec<String> {
        let count = c_uint::try_from(number(self.get_program, program, count)).unwrap_or(0);
        let mut all: Vec<_> = (0..count)
            .map(|index| {
                let mut name = [0_u8; 512];
                let (mut length, mut size, mut kind) = (0, 0, 0);
                // SAFETY: an active index; room for 512 bytes and for one value each.
                unsafe {
                    get(
                        program,
                        index,
                        512,
                        &raw mut length,
                        &raw mut size,
                        &raw mut kind,
                        name.as_mut_ptr().cast(),
                    );
                }
                let name = text(&name, length);
                format!("{name} {kind:#x} {size}")
            })
            .collect();
        all.sort();
        all
    }
}

fn number(get: Get, object: c_uint, what: c_uint) -> c_int {
    let mut value = 0;
    // SAFETY: room for one number.
    unsafe { get(object, what, &raw mut value) };
    value
}

fn log(get: Get, get_log: GetLog, object: c_uint) -> String {
    let room = number(get, object, INFO_LOG_LENGTH).clamp(0, 1 << 20);
    let mut bytes = vec![0_u8; usize::try_from(room).unwrap_or(0) + 1];
    let mut length = 0;
    // SAFETY: room for as many bytes as are named, and for one number.
    unsafe { get_log(object, room + 1, &raw mut length, bytes.as_mut_ptr().cast()) };
    text(&bytes, length)
}

fn text(bytes: &[u8], length: c_int) -> String {
    let length = usize::try_from(length).unwrap_or(0);
    String::from_utf8_lossy(bytes.get(..length).unwrap_or_default()).into_owned()
}
