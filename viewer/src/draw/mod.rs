//! Draws the nodes of a tree. All calls of OpenGL are here.

mod background;
mod buffers;
mod frame;
mod gaussians;
mod program;
mod texture;

pub use background::BACKGROUND;
pub use buffers::Buffers;
pub use frame::Frame;
pub use gaussians::GaussianRenderer;

use crate::camera::Camera;
use crate::octree::{Chosen, Id};
use glow::HasContext;
use program::Program;
use texture::texture;

/// Nodes in a row of the texture that lists them, as in `shaders/points.vert`.
const ROW: usize = 1024;
/// More nodes have no number in that texture.
const MOST: usize = 1 << 16;
/// Height of the bar that shows progress, as a share of the picture's.
const BAR: u32 = 120;

/// What is drawn with.
#[derive(Debug)]
pub struct Renderer {
    program: Program,
    /// The list of drawn nodes.
    nodes: glow::Texture,
}

impl Renderer {
    /// Makes programs and textures in the context that is current.
    ///
    /// # Errors
    /// The text of the driver, which refuses a program.
    pub fn new(gl: &glow::Context) -> Result<Self, String> {
        let program = Program::new(gl)?;
        // SAFETY: the context is current on this thread; the texture is deleted with the context.
        unsafe {
            let nodes = texture(gl)?;
            gl.enable(glow::PROGRAM_POINT_SIZE);
            Ok(Self { program, nodes })
        }
    }

    /// Draws nodes over a dark picture.
    pub fn draw(
        &self,
        gl: &glow::Context,
        buffers: &Buffers,
        chosen: &[Chosen],
        camera: &Camera,
        frame: Frame,
    ) {
        let [width, height] = frame.size.map(|side| side as i32);
        // SAFETY: the context is current on this thread; the texture's texels outlive the call that copies them; the buffers hold as many
        // vertices as are drawn.
        unsafe {
            gl.viewport(0, 0, width, height);
            let [r, g, b] = BACKGROUND;
            gl.clear_color(r, g, b, 1.0);
            gl.enable(glow::DEPTH_TEST);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.bind_texture(glow::TEXTURE_2D, Some(self.nodes));
            let chosen = &chosen[..chosen.len().min(MOST)];
            let texels = texels(buffers, chosen);
            let rows = (texels.len() / (2 * ROW)) as i32;
            gl.tex_image_2d(
                glow::TEXTURE_2D,
                0,
                glow::RG32UI as i32,
                ROW as i32,
                rows,
                0,
                glow::RG_INTEGER,
                glow::UNSIGNED_INT,
                glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(&texels))),
            );
            self.program.bind(gl, camera, frame);
            for (number, chosen) in chosen.iter().enumerate() {
                self.program.set_node(gl, number as u32, chosen.cube);
                buffers.draw(gl, chosen.id);
            }
            gl.bind_vertex_array(None);
            if let Some(share) = frame.progress {
                let high = (height / BAR as i32).max(2);
                gl.enable(glow::SCISSOR_TEST);
                gl.scissor(0, 0, (width as f32 * share) as i32, high);
                gl.clear_color(0.3, 0.6, 0.9, 1.0);
                gl.clear(glow::COLOR_BUFFER_BIT);
                gl.disable(glow::SCISSOR_TEST);
            }
        }
    }
}

/// The list of drawn nodes, in whole rows.
fn texels(buffers: &Buffers, chosen: &[Chosen]) -> Vec<u32> {
    let radii = radii(chosen, &|id| buffers.radius(id));
    let mut texels = Vec::with_capacity(2 * chosen.len() + 2 * ROW);
    for (chosen, radius) in chosen.iter().zip(radii) {
        let octants = u32::from(chosen.mask) | u32::from(chosen.below) << 8;
        texels.extend([octants | chosen.first << 16, radius.to_bits()]);
    }
    let rows = chosen.len().div_ceil(ROW).max(1);
    texels.resize(rows * 2 * ROW, 0);
    texels
}

/// The radius in each drawn node. Where a node does not know its own, its surface is as dense as the densest below the node above it.
fn radii(chosen: &[Chosen], known: &dyn Fn(Id) -> Option<f32>) -> Vec<f32> {
    let known = chosen.iter().map(|chosen| known(chosen.id));
    let mut radii: Vec<f32> = known
        .map(|radius| radius.unwrap_or(f32::INFINITY))
        .collect();
    let below = |chosen: &Chosen| {
        let first = chosen.first as usize;
        first..first + chosen.mask.count_ones() as usize
    };
    let mut least = radii.clone();
    for (at, chosen) in chosen.iter().enumerate().rev() {
        let below = least.get(below(chosen)).unwrap_or_default();
        least[at] = below.iter().copied().fold(least[at], f32::min);
    }
    for (at, chosen) in chosen.iter().enumerate() {
        for radius in radii.get_mut(below(chosen)).unwrap_or_default() {
            if radius.is_infinite() {
                *radius = least[at];
            }
        }
    }
    radii
}

#[cfg(test)]
mod tests {
    use super::{Chosen, radii};
    use glam::Vec4;

    #[test]
    fn a_node_with_few_points_is_as_dense_as_those_beside_it() {
        let node = |id, mask, first| Chosen {
            id,
            mask,
            below: mask,
            first,
            cube: Vec4::ONE,
        };
        // The root, two below it, of which the second has two.
        let chosen = [
            node(5, 0b11, 1),
            node(6, 0, 3),
            node(7, 0b1001, 3),
            node(8, 0, 5),
            node(9, 0, 5),
        ];
        let known = |id| [Some(8.0), None, Some(4.0), Some(2.0), None][id as usize - 5];
        assert_eq!(radii(&chosen, &known), [8.0, 2.0, 4.0, 2.0, 2.0]);
        assert_eq!(radii(&chosen[..1], &|_| None), [f32::INFINITY]);
    }
}
