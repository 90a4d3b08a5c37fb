//! Draws Gaussians in their order, the farthest first.

use super::background::BACKGROUND;
use super::program::link;
use super::texture::texture;
use crate::camera::Camera;
use crate::gaussian::Gaussians;
use crate::gaussian::sort::Sorted;
use glow::HasContext;

/// Gaussians in a row of the textures, as in `shaders/gaussian.vert`.
const ROW: usize = 1024;
/// Texels of the shape of one.
const TEXELS: usize = 3;
const VERTEX: &str = include_str!("../../shaders/gaussian.vert");
const FRAGMENT: &str = include_str!("../../shaders/gaussian.frag");

/// What is drawn with.
#[derive(Debug)]
pub struct GaussianRenderer {
    program: glow::Program,
    array: glow::VertexArray,
    /// Numbers of Gaussians in their order.
    order: glow::Buffer,
    shapes: glow::Texture,
    colours: glow::Texture,
    /// How many are drawn.
    count: usize,
}

impl GaussianRenderer {
    /// Copies Gaussians to the context that is current.
    ///
    /// # Errors
    /// The text of the driver, which refuses the program, or there are more than its textures can hold.
    pub fn new(gl: &glow::Context, gaussians: &Gaussians) -> Result<Self, String> {
        let rows = gaussians.all.len().div_ceil(ROW).max(1);
        let mut texels = Vec::with_capacity(rows * ROW * TEXELS);
        for one in &gaussians.all {
            let c = one.covariance();
            texels.extend([
                one.place.extend(one.opacity).to_array(),
                [c.x_axis.x, c.x_axis.y, c.x_axis.z, c.y_axis.y],
                [c.y_axis.z, c.z_axis.z, 0.0, 0.0],
            ]);
        }
        texels.resize(rows * ROW * TEXELS, [0.0; 4]);
        let program = link(gl, VERTEX, FRAGMENT)?;
        // SAFETY: the context is current on this thread; the texels are as many as the texture has; the attribute lies in the buffer that is
        // bound. All are deleted with the context.
        unsafe {
            let most = gl.get_parameter_i32(glow::MAX_TEXTURE_SIZE) as usize;
            if rows > most || ROW * TEXELS > most {
                return Err(format!(
                    "the graphics card holds at most {} Gaussians",
                    most * ROW
                ));
            }
            let (array, order) = (gl.create_vertex_array()?, gl.create_buffer()?);
            gl.bind_vertex_array(Some(array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(order));
            gl.enable_vertex_attrib_array(0);
            gl.vertex_attrib_pointer_i32(0, 1, glow::UNSIGNED_INT, 4, 0);
            gl.vertex_attrib_divisor(0, 1);
            gl.bind_vertex_array(None);
            let shapes = texture(gl)?;
            set(gl, (ROW * TEXELS, rows), &texels);
            gl.use_program(Some(program));
            for (unit, name) in ["shapes", "colours"].into_iter().enumerate() {
                let place = gl.get_uniform_location(program, name);
                gl.uniform_1_i32(place.as_ref(), unit as i32);
            }
            Ok(Self {
                program,
                array,
                order,
                shapes,
                colours: texture(gl)?,
                count: 0,
            })
        }
    }

    /// Takes another order, and the colours that belong to it.
    pub fn set(&mut self, gl: &glow::Context, sorted: Sorted) {
        let Sorted { order, mut colours } = sorted;
        self.count = order.len();
        let rows = colours.len().div_ceil(ROW).max(1);
        colours.resize(rows * ROW, [0.0; 4]);
        // SAFETY: the context is current on this thread, and has made both; the texels are as many as the texture has.
        unsafe {
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.order));
            let bytes = bytemuck::cast_slice(&order);
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::DYNAMIC_DRAW);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.colours));
            set(gl, (ROW, rows), &colours);
        }
    }

    /// Draws over a dark picture of this width and height. `scale`: by how much Gaussians are larger.
    pub fn draw(&self, gl: &glow::Context, camera: &Camera, size: [u32; 2], scale: f32) {
        let [width, height] = size;
        let look = camera.look(size);
        let matrices = [
            ("view", camera.view()),
            ("projection", camera.projection(size)),
        ];
        let picture = [width as f32, height as f32, look.pixels, camera.near()];
        // SAFETY: the context is current on this thread; the buffer has as many numbers as are drawn.
        unsafe {
            gl.viewport(0, 0, width as i32, height as i32);
            let [r, g, b] = BACKGROUND;
            gl.clear_color(r, g, b, 1.0);
            gl.enable(glow::DEPTH_TEST);
            // Nothing is hidden by depths, which are there for whoever looks at them: the layer chooses its cameras by them.
            gl.depth_func(glow::ALWAYS);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.enable(glow::BLEND);
            gl.blend_func(glow::ONE, glow::ONE_MINUS_SRC_ALPHA);
            gl.use_program(Some(self.program));
            for (name, matrix) in matrices {
                let place = gl.get_uniform_location(self.program, name);
                gl.uniform_matrix_4_f32_slice(place.as_ref(), false, &matrix.to_cols_array());
            }
            let place = gl.get_uniform_location(self.program, "picture");
            gl.uniform_4_f32_slice(place.as_ref(), &picture);
            let place = gl.get_uniform_location(self.program, "scale");
            gl.uniform_1_f32(place.as_ref(), scale);
            for (unit, texture) in [(0, self.shapes), (1, self.colours)] {
                gl.active_texture(glow::TEXTURE0 + unit);
                gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            }
            gl.active_texture(glow::TEXTURE0);
            gl.bind_vertex_array(Some(self.array));
            gl.draw_arrays_instanced(glow::TRIANGLE_STRIP, 0, 4, self.count as i32);
            gl.bind_vertex_array(None);
        }
    }
}

/// Gives the texture that is bound its texels.
///
/// # Safety
/// The context is current on this thread.
unsafe fn set(gl: &glow::Context, (width, height): (usize, usize), texels: &[[f32; 4]]) {
    debug_assert_eq!(texels.len(), width * height);
    // SAFETY: forwarded; the texels are as many as the texture has.
    unsafe {
        gl.tex_image_2d(
            glow::TEXTURE_2D,
            0,
            glow::RGBA32F as i32,
            width as i32,
            height as i32,
            0,
            glow::RGBA,
            glow::FLOAT,
            glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(texels))),
        );
    }
}
