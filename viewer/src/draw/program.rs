//! The program of the points.

use super::frame::Frame;
use crate::camera::Camera;
use glam::Vec4;
use glow::HasContext;

#[derive(Debug)]
pub(super) struct Program {
    program: glow::Program,
    view: Option<glow::UniformLocation>,
    projection: Option<glow::UniformLocation>,
    pixels: Option<glow::UniformLocation>,
    scale: Option<glow::UniformLocation>,
    cube: Option<glow::UniformLocation>,
    node: Option<glow::UniformLocation>,
}

impl Program {
    pub(super) fn new(gl: &glow::Context) -> Result<Self, String> {
        let program = link(
            gl,
            include_str!("../../shaders/points.vert"),
            include_str!("../../shaders/points.frag"),
        )?;
        // SAFETY: the context is current on this thread.
        unsafe {
            let at = |name| gl.get_uniform_location(program, name);
            Ok(Self {
                program,
                view: at("view"),
                projection: at("projection"),
                pixels: at("pixels"),
                scale: at("scale"),
                cube: at("cube"),
                node: at("node"),
            })
        }
    }

    /// # Safety
    /// The context is current on this thread.
    pub(super) unsafe fn bind(&self, gl: &glow::Context, camera: &Camera, frame: Frame) {
        let look = camera.look(frame.size);
        let matrices = [
            (&self.view, camera.view()),
            (&self.projection, camera.projection(frame.size)),
        ];
        // SAFETY: forwarded.
        unsafe {
            gl.use_program(Some(self.program));
            for (place, matrix) in matrices {
                gl.uniform_matrix_4_f32_slice(place.as_ref(), false, &matrix.to_cols_array());
            }
            gl.uniform_1_f32(self.pixels.as_ref(), look.pixels);
            gl.uniform_1_f32(self.scale.as_ref(), frame.scale);
        }
    }

    /// # Safety
    /// As [`Program::bind`], which was called.
    pub(super) unsafe fn set_node(&self, gl: &glow::Context, number: u32, cube: Vec4) {
        // SAFETY: forwarded.
        unsafe {
            gl.uniform_1_u32(self.node.as_ref(), number);
            gl.uniform_4_f32_slice(self.cube.as_ref(), &cube.to_array());
        }
    }
}

/// Makes a program of two stages, which is deleted with the context that is current.
pub(super) fn link(
    gl: &glow::Context,
    vertex: &str,
    fragment: &str,
) -> Result<glow::Program, String> {
    let stages = [
        (glow::VERTEX_SHADER, vertex),
        (glow::FRAGMENT_SHADER, fragment),
    ];
    // SAFETY: the context is current on this thread.
    unsafe {
        let program = gl.create_program()?;
        for (stage, text) in stages {
            let shader = gl.create_shader(stage)?;
            gl.shader_source(shader, text);
            gl.compile_shader(shader);
            if !gl.get_shader_compile_status(shader) {
                return Err(gl.get_shader_info_log(shader));
            }
            gl.attach_shader(program, shader);
            gl.delete_shader(shader);
        }
        gl.link_program(program);
        if !gl.get_program_link_status(program) {
            return Err(gl.get_program_info_log(program));
        }
        Ok(program)
    }
}
