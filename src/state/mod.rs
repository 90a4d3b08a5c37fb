//! The state of a context as the program sees it. Only state that a plan reads is kept, and it is read from the driver only
//! after a command has touched it.
#![forbid(unsafe_code)]

mod classification;
mod effect;
mod eyes;
mod framebuffer;
mod lists;
mod neutral;
mod rectangles;
mod shaders;
mod side_effects;
mod texture_writes;
mod uniform_buffers;

pub use classification::ClassificationState;
pub use effect::{Effect, Immediate};
pub use eyes::{are_eyes_given, give_eyes};
pub(crate) use framebuffer::is_front;
pub use framebuffer::{BACK, Buffers, FRONT, Framebuffers, Window};
pub use lists::{Body, Command, Compiling, Lists, Orphans, Run, Segment, Start};
pub use neutral::Neutral;
pub use rectangles::{Indexed, Rectangles};
pub use shaders::{
    Linked, Matrices, Samplers, ShaderSource, Shaders, link_change, sources, uniform_change,
    uniform_changes,
};
pub use texture_writes::{TextureAt, TextureWrite};

pub use side_effects::SideEffects;
pub use uniform_buffers::{
    Found, UniformBuffers, binding_change, binding_changes, block_change, block_changes,
    store_change, store_changes,
};

use crate::gl::{Gl, ProgramName, consts as c};

/// Groups of driver state that a command may have changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Touch(u32);

impl Touch {
    /// The current matrix; which group that is depends on the matrix mode.
    pub const MATRIX: Touch = Touch(1);
    /// Any matrix, by a call that names the matrix itself (direct state access).
    pub const DSA_MATRIX: Touch = Touch(2 | 8 | 1 << 11);
    /// The projection matrix.
    pub const PROJECTION: Touch = Touch(2);
    /// Viewport, scissor rectangle and scissor test.
    pub const RECTS: Touch = Touch(4);
    /// State that the vertex stage of fixed function reads.
    pub const FIXED: Touch = Touch(8);
    /// The matrix mode.
    pub const MODE: Touch = Touch(16);
    /// The program and the program pipeline.
    pub const OBJECTS: Touch = Touch(32);
    /// Draw buffers, by what restores or executes many commands.
    pub const BUFFERS: Touch = Touch(1 << 16);
    /// The material.
    pub const MATERIAL: Touch = Touch(64);
    /// Depth test and depth mask.
    pub const DEPTH: Touch = Touch(1 << 9);
    /// The 2D texture of the active unit.
    pub const TEXTURE: Touch = Touch(1 << 10);
    /// The bindings of all texture units; stale whenever [`Touch::TEXTURE`] is.
    pub const UNITS: Touch = Touch(1 << 13);
    /// The modelview matrix.
    pub const MODELVIEW: Touch = Touch(1 << 11);
    /// The depth range.
    pub const RANGE: Touch = Touch(1 << 12);
    /// The raster position, by glRasterPos.
    pub const RASTER: Touch = Touch(128);
    /// The raster position, by glWindowPos.
    pub const WINDOW_POS: Touch = Touch(256);
    /// Blending, stencil test and polygon stipple.
    pub const COVER: Touch = Touch(1 << 14);
    /// Viewports, scissor rectangles and scissor tests by index: they differ from now on. [`Touch::RECTS`] goes with it.
    pub const VIEWPORTS: Touch = Touch(1 << 15);
    /// Parameters of textures, by what restores or executes many commands.
    pub const PARAMETERS: Touch = Touch(1 << 17);
    /// Everything.
    pub const ALL: Touch = Touch(0xffff_fffe & !(1 << 15));
    /// Nothing.
    pub const NONE: Touch = Touch(0);

    /// Whether any group of `other` is in `self`.
    pub fn has(self, other: Touch) -> bool {
        self.0 & other.0 != 0
    }

    /// Without the groups of `other`.
    pub fn without(self, other: Touch) -> Touch {
        Touch(self.0 & !other.0)
    }
}

impl core::ops::BitOr for Touch {
    type Output = Touch;
    fn bitor(self, other: Touch) -> Touch {
        Touch(self.0 | other.0)
    }
}

/// Whether the program is between glBegin and glEnd, and where its calls go there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begin {
    /// Not between them.
    Outside,
    /// Between them, and the calls are recorded. The driver is between them too, but gets none of these calls.
    Recorded(u32),
    /// Between them, and the calls go to the driver.
    Direct,
}

/// The matrices of fixed function that every plan reads, column-major.
#[derive(Debug)]
pub struct FixedMatrices {
    /// glMatrixMode.
    pub mode: u32,
    /// GL_PROJECTION_MATRIX.
    pub projection: [f32; 16],
}

/// Modes that decide whether primitives make a picture.
#[derive(Debug)]
pub struct Primitives {
    /// GL_RENDER, GL_SELECT or GL_FEEDBACK.
    pub render_mode: u32,
    /// Between glBeginTransformFeedback and its end, in a context that cannot pause feedback.
    pub transform_feedback: bool,
}

/// The program objects in use.
#[derive(Debug, Default)]
pub struct InUse {
    /// glUseProgram.
    pub program: ProgramName,
    /// glBindProgramPipeline, which counts where no program is in use.
    pub pipeline: u32,
}

/// Features of the context.
#[derive(Debug, Default)]
pub struct Capabilities {
    /// The fixed-function pipeline.
    pub compatibility: bool,
    /// Program pipelines.
    pub pipelines: bool,
    /// glClipControl.
    pub clip_control: bool,
    /// glPolygonOffsetClamp.
    pub offset_clamp: bool,
}

/// One context as the program sees it.
#[derive(Debug)]
pub struct State {
    /// Groups that must be read again before use.
    pub touched: Touch,
    /// Features of the context.
    pub has: Capabilities,
    /// Matrices of fixed function.
    pub matrices: FixedMatrices,
    /// Viewport and scissor.
    pub rectangles: Rectangles,
    /// Further state by which draws are classified; read only if a rule needs it.
    pub classification: ClassificationState,
    /// Bound framebuffers, draw and read buffers.
    pub framebuffers: Framebuffers,
    /// The drawable behind framebuffer 0.
    pub window: Window,
    /// The list that is being compiled.
    pub list: Option<Compiling>,
    /// Immediate mode.
    pub begin: Begin,
    /// Modes that decide whether primitives make a picture.
    pub primitives: Primitives,
    /// The program objects in use.
    pub in_use: InUse,
    /// Errors of the program that were taken out of the driver's queue before the layer's own calls, oldest first.
    pub errors: std::collections::VecDeque<u32>,
}

impl State {
    /// The state of a context that was just made current with framebuffer 0 bound.
    pub fn new(window: Window, compatibility: bool) -> Self {
        State {
            touched: Touch::ALL,
            has: Capabilities {
                compatibility,
                ..Capabilities::default()
            },
            matrices: FixedMatrices {
                mode: c::MODELVIEW,
                projection: glam::Mat4::IDENTITY.to_cols_array(),
            },
            rectangles: Rectangles::default(),
            classification: ClassificationState::default(),
            framebuffers: Framebuffers::new(&window),
            window,
            list: None,
            begin: Begin::Outside,
            primitives: Primitives {
                render_mode: c::RENDER,
                transform_feedback: false,
            },
            in_use: InUse::default(),
            errors: std::collections::VecDeque::new(),
        }
    }

    /// As [`State::new`], with the features of the context as the driver reports them, and with the program's errors kept.
    pub fn ask(gl: &Gl, window: Window, compatibility: bool) -> Self {
        let mut state = State::new(window, compatibility);
        let any = |names: &[&str]| names.iter().any(|name| gl.has_extension(name));
        state.has.clip_control =
            gl.since((4, 5), None) || any(&["GL_ARB_clip_control", "GL_EXT_clip_control"]);
        state.has.offset_clamp = gl.since((4, 6), None) || any(&["GL_ARB_polygon_offset_clamp"]);
        state.has.pipelines =
            gl.since((4, 1), Some((3, 1))) || any(&["GL_ARB_separate_shader_objects"]);
        state.keep_errors(gl);
        state
    }

    /// Notes that state groups change. `MATRIX` becomes the group that the matrix mode selects.
    #[inline]
    pub fn touch(&mut self, groups: Touch) {
        let mut groups = groups;
        if groups.has(Touch::MATRIX) {
            groups = groups.without(Touch::MATRIX)
                | match self.matrices.mode {
                    _ if self.touched.has(Touch::MODE) => Touch::DSA_MATRIX,
                    c::PROJECTION => Touch::PROJECTION,
                    c::MODELVIEW => Touch::MODELVIEW,
                    _ => Touch::FIXED,
                };
        }
        if groups.has(Touch::TEXTURE) {
            groups = groups | Touch::UNITS;
        }
        self.touched = self.touched | groups;
    }

    /// Reads again the state that a plan needs and a command has touched, except the fixed-function state (see `draw`).
    pub fn refresh(&mut self, gl: &Gl) {
        let touched = self.touched;
        if touched.has(Touch::RECTS) {
            let several = touched.has(Touch::VIEWPORTS) || self.rectangles.are_several();
            self.rectangles = Rectangles::ask(gl, several);
        }
        if touched.has(Touch::PROJECTION) && self.has.compatibility {
            self.matrices.projection = gl.get_matrix(c::PROJECTION_MATRIX);
        }
        if touched.has(Touch::MODE) && self.has.compatibility {
            self.matrices.mode = gl.get_integer(c::MATRIX_MODE) as u32;
        }
        if touched.has(Touch::OBJECTS) {
            self.in_use.program = ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32);
            if self.has.pipelines {
                self.in_use.pipeline = gl.get_integer(c::PROGRAM_PIPELINE_BINDING) as u32;
            }
        }
        if touched.has(Touch::BUFFERS) {
            self.framebuffers.reread(gl);
        }
        let matrices = Touch::PROJECTION | Touch::MODE;
        let objects = Touch::OBJECTS | Touch::BUFFERS;
        self.touched = touched.without(Touch::RECTS | Touch::VIEWPORTS | matrices | objects);
    }

    /// Takes the program's errors out of the driver's queue, before the layer's own calls, which may raise errors. While errors are kept
    /// that the program has not yet asked for, further ones are dropped: the driver, too, would keep only the first. Returns whether
    /// there were any.
    pub fn keep_errors(&mut self, gl: &Gl) -> bool {
        let errors = gl.take_errors();
        let any = !errors.is_empty();
        self.keep(errors);
        any
    }

    /// Keeps errors of the program that were taken out of the driver's queue elsewhere, as [`State::keep_errors`] does.
    pub fn keep(&mut self, errors: Vec<u32>) {
        if self.errors.is_empty() {
            self.errors.extend(errors);
        }
    }

    /// Whether a draw now makes a picture in framebuffer 0: not in a display list, selection, feedback or a framebuffer object.
    pub fn draws_to_window(&self) -> bool {
        self.framebuffers.draw.is_zero() && self.makes_pictures()
    }

    /// Whether a draw now makes a picture, in any framebuffer.
    pub fn makes_pictures(&self) -> bool {
        self.list.is_none()
            && self.primitives.render_mode == c::RENDER
            && !self.primitives.transform_feedback
    }
}
