//! The layer's own calls into the driver: thin, without pointers for the caller.

use super::consts as c;
use super::held::Held;
use super::immediate::{Ends, Recording};
use super::object_names::{
    Argument, BufferName, FramebufferName, ListName, ProgramName, QueryName, RenderbufferName,
    ShaderName, TextureName, VertexArrayName,
};
use super::real::{Ptr, Real};
use super::shadow;
use core::ffi::CStr;

/// The name of a display list that does not exist: glGenLists gives lower names first.
pub(super) const NO_LIST: u32 = u32::MAX - 1;

/// The driver of the context that is current on this thread, asked for its version once. Every method is the GL command of its name.
/// More than 25 methods: one for each command.
#[derive(Clone, Copy, Debug)]
pub struct Gl {
    pub(super) real: &'static Real,
    version: (u32, u32),
    es: bool,
    // The context is current on one thread only.
    _not_send: core::marker::PhantomData<*const ()>,
}

macro_rules! plain {
    ($($name:ident = $gl:ident($($a:ident: $t:ty),*) $(-> $r:ty)?;)*) => {
        /// Commands without pointers.
        #[allow(missing_docs, clippy::too_many_arguments, reason = "each is the GL command of its name")]
        impl Gl {
            $(
                #[inline]
                pub fn $name(&self, $($a: $t),*) $(-> $r)? {
                    // SAFETY: a context of this provider is current (contract of `Gl::new`).
                    // SAFETY: the command takes no pointers and reads none that were given before; wrong values raise a GL error.
                    unsafe { self.real.$gl($($a.raw()),*) }
                }
            )*
        }
    };
}

plain! {
    begin = glBegin(mode: u32);
    end = glEnd();
    matrix_mode = glMatrixMode(mode: u32);
    viewport = glViewport(x: i32, y: i32, w: i32, h: i32);
    viewport_indexed_f = glViewportIndexedf(index: u32, x: f32, y: f32, w: f32, h: f32);
    tex_envf = glTexEnvf(target: u32, name: u32, value: f32);
    line_width = glLineWidth(width: f32);
    point_size = glPointSize(size: f32);
    polygon_offset = glPolygonOffset(factor: f32, units: f32);
    polygon_offset_clamp = glPolygonOffsetClamp(factor: f32, units: f32, clamp: f32);
    scissor = glScissor(x: i32, y: i32, w: i32, h: i32);
    scissor_indexed = glScissorIndexed(index: u32, x: i32, y: i32, w: i32, h: i32);
    enable = glEnable(cap: u32);
    disable = glDisable(cap: u32);
    enablei = glEnablei(cap: u32, index: u32);
    disablei = glDisablei(cap: u32, index: u32);
    color_4f = glColor4f(r: f32, g: f32, b: f32, a: f32);
    normal_3f = glNormal3f(x: f32, y: f32, z: f32);
    multi_tex_coord_4f = glMultiTexCoord4f(unit: u32, s: f32, t: f32, r: f32, q: f32);
    secondary_color_3f = glSecondaryColor3f(r: f32, g: f32, b: f32);
    fog_coordf = glFogCoordf(f: f32);
    edge_flag = glEdgeFlag(flag: u8);
    push_matrix = glPushMatrix();
    pop_matrix = glPopMatrix();
    push_attrib = glPushAttrib(mask: u32);
    pop_attrib = glPopAttrib();
    new_list = glNewList(list: ListName, mode: u32);
    end_list = glEndList();
    begin_query = glBeginQuery(target: u32, query: QueryName);
    end_query = glEndQuery(target: u32);
    pause_transform_feedback = glPauseTransformFeedback();
    resume_transform_feedback = glResumeTransformFeedback();
    begin_conditional_render = glBeginConditionalRender(query: QueryName, mode: u32);
    end_conditional_render = glEndConditionalRender();
    call_list = glCallList(list: ListName);
    get_error = glGetError() -> u32;
    clear = glClear(mask: u32);
    flush = glFlush();
    finish = glFinish();
    bind_framebuffer = glBindFramebuffer(target: u32, name: FramebufferName);
    draw_buffer = glDrawBuffer(buffer: u32);
    read_buffer = glReadBuffer(buffer: u32);
    framebuffer_texture = glFramebufferTexture(target: u32, attachment: u32, texture: TextureName, level: i32);
    framebuffer_renderbuffer = glFramebufferRenderbuffer(target: u32, attachment: u32, kind: u32, name: RenderbufferName);
    framebuffer_texture_layer = glFramebufferTextureLayer(target: u32, attachment: u32, texture: TextureName, level: i32, layer: i32);
    check_framebuffer_status = glCheckFramebufferStatus(target: u32) -> u32;
    blit_framebuffer = glBlitFramebuffer(sx0: i32, sy0: i32, sx1: i32, sy1: i32, dx0: i32, dy0: i32, dx1: i32, dy1: i32, mask: u32, filter: u32);
    bind_texture = glBindTexture(target: u32, name: TextureName);
    active_texture = glActiveTexture(unit: u32);
    tex_parameteri = glTexParameteri(target: u32, name: u32, value: i32);
    bind_sampler = glBindSampler(unit: u32, sampler: u32);
    is_texture = glIsTexture(name: TextureName) -> u8;
    is_framebuffer = glIsFramebuffer(name: FramebufferName) -> u8;
    is_program = glIsProgram(name: ProgramName) -> u8;
    compile_shader = glCompileShader(shader: ShaderName);
    attach_shader = glAttachShader(program: ProgramName, shader: ShaderName);
    link_program = glLinkProgram(program: ProgramName);
    bind_program_pipeline = glBindProgramPipeline(pipeline: u32);
    uniform_1i = glUniform1i(location: i32, v: i32);
    uniform_1f = glUniform1f(location: i32, v: f32);
    uniform_1ui = glUniform1ui(location: i32, v: u32);
    uniform_2ui = glUniform2ui(location: i32, x: u32, y: u32);
    bind_buffer = glBindBuffer(target: u32, name: BufferName);
    bind_vertex_array = glBindVertexArray(name: VertexArrayName);
    pixel_storei = glPixelStorei(name: u32, value: i32);
    color_maski = glColorMaski(index: u32, r: u8, g: u8, b: u8, a: u8);
    color_mask = glColorMask(r: u8, g: u8, b: u8, a: u8);
    provoking_vertex = glProvokingVertex(convention: u32);
    patch_parameteri = glPatchParameteri(name: u32, value: i32);
    polygon_mode = glPolygonMode(face: u32, mode: u32);
    window_pos_2i = glWindowPos2i(x: i32, y: i32);
}

/// Commands that take or give memory.
impl Gl {
    /// # Safety
    /// A context of this provider is current on this thread for as long as the value is used.
    pub unsafe fn new(real: &'static Real) -> Self {
        let mut gl = Gl {
            real,
            version: (0, 0),
            es: false,
            _not_send: core::marker::PhantomData,
        };
        let text = gl.get_string(c::VERSION);
        let number = text.trim_start_matches("OpenGL ES ");
        let mut parts = number.split(['.', ' ']).map(|p| p.parse().unwrap_or(0));
        gl.version = (parts.next().unwrap_or(0), parts.next().unwrap_or(0));
        gl.es = text.starts_with("OpenGL ES");
        gl
    }

    /// Empties the queue of errors, oldest first. At most 16: a lost context answers errors for ever.
    #[must_use]
    pub fn take_errors(&self) -> Vec<u32> {
        let errors = (0..16).map(|_| self.get_error());
        errors.take_while(|&e| e != c::NO_ERROR).collect()
    }

    /// Empties the queue of errors, and returns how many there were, as [`Gl::take_errors`] does.
    pub fn drop_errors(&self) -> usize {
        self.take_errors().len()
    }

    /// The table behind, for hooks that pass on the program's own arguments.
    pub fn real(&self) -> &'static Real {
        self.real
    }

    /// Switches the scissor test of index 0, which cuts clears and copies. That of other viewports stays as the program has set it.
    pub fn switch_scissor_test(&self, on: bool) {
        match (shadow::are_capabilities_indexed(), on) {
            (true, true) => self.enablei(c::SCISSOR_TEST, 0),
            (true, false) => self.disablei(c::SCISSOR_TEST, 0),
            (false, true) => self.enable(c::SCISSOR_TEST),
            (false, false) => self.disable(c::SCISSOR_TEST),
        }
    }

    /// glDepthFunc
    pub fn depth_func(&self, func: u32) {
        // SAFETY: a context is current.
        unsafe { self.real.glDepthFunc(func) }
    }

    /// glDepthMask
    pub fn depth_mask(&self, mask: u8) {
        // SAFETY: a context is current.
        unsafe { self.real.glDepthMask(mask) }
    }

    /// glGetString, empty when there is none.
    pub fn get_string(&self, name: u32) -> String {
        // SAFETY: a context is current; the driver's string is static.
        text(unsafe { self.real.glGetString(name) })
    }

    /// Whether Mesa's llvmpipe draws.
    pub fn is_llvmpipe(&self) -> bool {
        self.get_string(super::consts::RENDERER)
            .contains("llvmpipe")
    }

    /// glViewportIndexedf of the first viewport: x, y, width, height in fractions of pixels.
    pub fn viewport_f(&self, [x, y, width, height]: [f32; 4]) {
        self.viewport_indexed_f(0, x, y, width, height);
    }

    /// glMaterialfv; 4 values, of which GL_SHININESS uses one.
    pub fn material(&self, face: u32, name: u32, v: &[f32; 4]) {
        // SAFETY: 4 elements, the most that any name reads.
        unsafe { self.real.glMaterialfv(face, name, v.as_ptr() as Ptr) }
    }

    /// Whether the context is of OpenGL ES.
    pub fn is_es(&self) -> bool {
        self.es
    }

    /// Whether the context is at least of this version of OpenGL, or of that of OpenGL ES; none where OpenGL ES has it in no version.
    pub fn since(&self, desktop: (u32, u32), es: Option<(u32, u32)>) -> bool {
        let least = if self.is_es() { es } else { Some(desktop) };
        least.is_some_and(|least| self.version() >= least)
    }

    /// Major and minor version of the context, of OpenGL or of OpenGL ES: for what both have since the same version, else
    /// [`Gl::since`].
    pub fn version(&self) -> (u32, u32) {
        self.version
    }

    /// glLoadMatrixf; column-major.
    pub fn load_matrix(&self, m: &[f32; 16]) {
        // SAFETY: 16 floats.
        unsafe { self.real.glLoadMatrixf(m.as_ptr() as Ptr) }
    }

    /// Whether GL_FRAMEBUFFER_SRGB is a switch. Where OpenGL ES has none, what is drawn to sRGB is always converted.
    pub fn switches_srgb(&self) -> bool {
        !self.is_es() || self.has_extension("GL_EXT_sRGB_write_control")
    }

    /// glIsEnabled of GL_FRAMEBUFFER_SRGB.
    pub fn is_srgb_enabled(&self) -> bool {
        !self.switches_srgb() || self.is_enabled(super::consts::FRAMEBUFFER_SRGB)
    }

    /// glEnable or glDisable of GL_FRAMEBUFFER_SRGB, where that is a switch.
    pub fn enable_srgb(&self, on: bool) {
        match on {
            _ if !self.switches_srgb() => {}
            true => self.enable(super::consts::FRAMEBUFFER_SRGB),
            false => self.disable(super::consts::FRAMEBUFFER_SRGB),
        }
    }

    /// glGetQueryiv of GL_CURRENT_QUERY.
    pub fn current_query(&self, target: u32) -> QueryName {
        let mut v = 0i32;
        // SAFETY: room for one value.
        unsafe {
            self.real
                .glGetQueryiv(target, super::consts::CURRENT_QUERY, (&raw mut v).cast())
        };
        QueryName(v as u32)
    }

    /// glGetQueryObjectuiv
    pub fn query_object(&self, query: QueryName, name: u32) -> u32 {
        let mut v = 0u32;
        // SAFETY: room for one value.
        unsafe {
            self.real
                .glGetQueryObjectuiv(query.0, name, (&raw mut v).cast())
        };
        v
    }

    /// glIsList
    pub fn is_list(&self, list: ListName) -> bool {
        // SAFETY: a context is current.
        unsafe { self.real.glIsList(list.0) != 0 }
    }

    /// glDeleteLists of one list.
    pub fn delete_list(&self, list: ListName) {
        self.delete_lists(list, 1);
    }

    /// glDeleteLists
    pub fn delete_lists(&self, first: ListName, count: u32) {
        // SAFETY: a context is current.
        unsafe { self.real.glDeleteLists(first.0, count as i32) };
    }

    /// glBlitFramebuffer with its arguments in order, moved to the right by pixels in the source and in the destination.
    pub fn blit(&self, arguments: &[u32; 10], from: i32, to: i32) {
        let [a, b, c, d, e, f, g, h, mask, filter] = *arguments;
        let at = |x: u32, by: i32| (x as i32).wrapping_add(by);
        // SAFETY: a context is current.
        unsafe {
            self.real.glBlitFramebuffer(
                at(a, from),
                b as i32,
                at(c, from),
                d as i32,
                at(e, to),
                f as i32,
                at(g, to),
                h as i32,
                mask,
                filter,
            )
        };
    }

    /// glBitmap without a picture: moves the raster position by (dx, dy) window pixels.
    pub fn move_raster(&self, dx: f32, dy: f32) {
        // SAFETY: no data is read for a picture of size 0.
        unsafe {
            self.real
                .glBitmap(0, 0, 0.0, 0.0, dx, dy, core::ptr::null_mut())
        }
    }

    /// glDrawBuffers
    pub fn draw_buffers(&self, buffers: &[u32]) {
        // SAFETY: length and pointer of one slice.
        unsafe {
            self.real
                .glDrawBuffers(buffers.len() as i32, buffers.as_ptr() as Ptr)
        }
    }

    /// glDeleteShader
    pub fn delete_shader(&self, shader: ShaderName) {
        // SAFETY: a context is current.
        unsafe { self.real.glDeleteShader(shader.0) };
        Held::Shader.count(-1);
    }

    /// Source of a shader, compiled; the log on failure.
    pub fn compile(&self, kind: u32, source: impl AsRef<[u8]>) -> Result<ShaderName, String> {
        // SAFETY: a context is current.
        let shader = ShaderName(unsafe { self.real.glCreateShader(kind) });
        Held::Shader.count(1);
        let source = source.as_ref();
        let p = source.as_ptr();
        let len = source.len() as i32;
        // SAFETY: one string of the given length.
        unsafe {
            self.real
                .glShaderSource(shader.0, 1, (&raw const p) as Ptr, (&raw const len) as Ptr)
        };
        self.compile_shader(shader);
        let mut ok = 0i32;
        let mut log = vec![0u8; 4096];
        let mut got = 0i32;
        // SAFETY: one integer; a buffer of the length given.
        unsafe {
            self.real.glGetShaderiv(
                shader.0,
                super::consts::COMPILE_STATUS,
                (&raw mut ok).cast(),
            );
            self.real.glGetShaderInfoLog(
                shader.0,
                log.len() as i32,
                (&raw mut got).cast(),
                log.as_mut_ptr().cast(),
            );
        }
        if ok != 0 {
            return Ok(shader);
        }
        self.delete_shader(shader);
        log.truncate(got.max(0) as usize);
        Err(String::from_utf8_lossy(&log).into_owned())
    }

    /// A program of compiled shaders, linked; the log on failure. The shaders are released either way.
    pub fn link(&self, shaders: &[ShaderName]) -> Result<ProgramName, String> {
        self.link_with(shaders, |_| ())
    }

    /// The same; `before` is called with the program before it is linked.
    pub(super) fn link_with(
        &self,
        shaders: &[ShaderName],
        before: impl FnOnce(ProgramName),
    ) -> Result<ProgramName, String> {
        // SAFETY: a context is current.
        let program = ProgramName(unsafe { self.real.glCreateProgram() });
        Held::Shader.count(1);
        for &s in shaders {
            self.attach_shader(program, s);
        }
        before(program);
        self.link_program(program);
        for &s in shaders {
            self.delete_shader(s);
        }
        let mut ok = 0i32;
        let mut log = vec![0u8; 4096];
        let mut got = 0i32;
        // SAFETY: one integer; a buffer of the length given.
        unsafe {
            self.real
                .glGetProgramiv(program.0, super::consts::LINK_STATUS, (&raw mut ok).cast());
            self.real.glGetProgramInfoLog(
                program.0,
                log.len() as i32,
                (&raw mut got).cast(),
                log.as_mut_ptr().cast(),
            );
        }
        if ok != 0 {
            return Ok(program);
        }
        self.delete_program(program);
        log.truncate(got.max(0) as usize);
        Err(String::from_utf8_lossy(&log).into_owned())
    }

    /// glDeleteProgram
    pub fn delete_program(&self, program: ProgramName) {
        // SAFETY: a context is current.
        unsafe { self.real.glDeleteProgram(program.0) };
        Held::Shader.count(-1);
    }

    /// glGetUniformLocation
    pub fn uniform_location(&self, program: ProgramName, name: &CStr) -> i32 {
        // SAFETY: a string that ends in NUL.
        unsafe {
            self.real
                .glGetUniformLocation(program.0, name.as_ptr() as Ptr)
        }
    }

    /// glUniform4fv
    pub fn uniform_4fv(&self, location: i32, v: &[[f32; 4]]) {
        // SAFETY: that many vectors.
        unsafe {
            self.real
                .glUniform4fv(location, v.len() as i32, v.as_ptr() as Ptr)
        }
    }

    /// The framebuffer that is bound is drawn to upside down (GL_MESA_framebuffer_flip_y).
    pub fn flip_framebuffer(&self, target: u32) {
        let name = super::consts::FRAMEBUFFER_FLIP_Y_MESA;
        // SAFETY: a context is current.
        unsafe {
            if self.is_es() {
                self.real.glFramebufferParameteriMESA(target, name, 1);
            } else {
                self.real.glFramebufferParameteri(target, name, 1);
            }
        }
    }

    /// glDeleteFramebuffers of one name.
    pub fn delete_framebuffer(&self, name: FramebufferName) {
        // SAFETY: one name.
        unsafe { self.real.glDeleteFramebuffers(1, (&raw const name) as Ptr) };
        Held::Framebuffer.count(-1);
    }

    /// glGetFramebufferAttachmentParameteriv of the draw framebuffer.
    pub fn attachment_parameter(&self, attachment: u32, name: u32) -> i32 {
        self.attachment_parameter_of(super::consts::DRAW_FRAMEBUFFER, attachment, name)
    }

    /// glGetFramebufferAttachmentParameteriv
    pub(super) fn attachment_parameter_of(&self, target: u32, attachment: u32, name: u32) -> i32 {
        let mut v = 0i32;
        // SAFETY: one integer.
        unsafe {
            self.real.glGetFramebufferAttachmentParameteriv(
                target,
                attachment,
                name,
                (&raw mut v).cast(),
            )
        };
        v
    }

    /// Sets a current value to itself, without a question where the shadow knows it.
    pub fn touch_current(&self) {
        let [coordinate] = self.get_floats(super::consts::CURRENT_FOG_COORD);
        self.fog_coordf(coordinate);
    }

    /// Lets the driver write current values that it holds back: calls a display list that does not exist, which does nothing else. Mesa 22.3
    /// loses what it holds back at a glPushAttrib, and a later glPopAttrib of the program's does not restore it.
    pub fn flush_current(&self) {
        let list = NO_LIST;
        // SAFETY: the signature is that of the command, which takes any name.
        unsafe { unnoted!(self.real, super::slot::glCallList, list: u32) };
    }

    /// Sends recorded immediate mode between a glBegin and a glEnd, or lists that have them.
    pub fn replay(&self, mode: u32, recording: &Recording, ends: Ends) {
        match ends.opener {
            ListName::ZERO => self.begin(mode),
            list => self.call_list(list),
        }
        // SAFETY: between glBegin and glEnd of the context it was recorded in (the caller keeps one per context).
        unsafe { recording.replay(self.real) };
        match ends.closer {
            ListName::ZERO => self.end(),
            list => self.call_list(list),
        }
    }
}

pub(super) fn text(p: Ptr) -> String {
    if p.is_null() {
        return String::new();
    }
    // SAFETY: the driver's strings end in NUL and live as long as the context.
    unsafe { CStr::from_ptr(p as *const core::ffi::c_char) }
        .to_string_lossy()
        .into_owned()
}
