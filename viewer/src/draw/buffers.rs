//! The points of nodes in the memory of the graphics card.

use crate::octree::Id;
use crate::prepare::Ready;
use crate::vertex::Vertex;
use glow::HasContext;
use std::collections::HashMap;
use std::mem::offset_of;

#[derive(Debug)]
struct Buffer {
    array: glow::VertexArray,
    buffer: glow::Buffer,
    points: u32,
    version: u32,
    radius: Option<f32>,
    /// The frame that has drawn it last.
    used: u64,
}

impl Buffer {
    fn bytes(&self) -> u64 {
        u64::from(self.points) * size_of::<Vertex>() as u64
    }
}

/// Buffers of nodes, of which those that were not drawn for the longest time go first.
#[derive(Debug)]
pub struct Buffers {
    nodes: HashMap<Id, Buffer>,
    bytes: u64,
    /// At most so many.
    memory: u64,
    frame: u64,
}

impl Buffers {
    /// At most so many bytes.
    #[must_use]
    pub fn new(memory: u64) -> Self {
        Self {
            nodes: HashMap::new(),
            bytes: 0,
            memory,
            frame: 0,
        }
    }

    /// The version of a node that is here.
    #[must_use]
    pub fn version(&self, id: Id) -> Option<u32> {
        self.nodes.get(&id).map(|buffer| buffer.version)
    }

    /// The radius that points of nodes above a node have in it at most, where it is known.
    #[must_use]
    pub fn radius(&self, id: Id) -> Option<f32> {
        self.nodes.get(&id)?.radius
    }

    /// So many points fit.
    #[must_use]
    pub fn room(&self) -> u64 {
        self.memory / size_of::<Vertex>() as u64
    }

    /// Copies a node to the context that is current.
    ///
    /// # Errors
    /// The driver has no memory.
    pub fn set(&mut self, gl: &glow::Context, ready: &Ready) -> Result<(), String> {
        self.remove(gl, ready.id);
        // SAFETY: the context is current on this thread; the attributes are those of a vertex, and lie in the buffer that is bound.
        let buffer = unsafe {
            let (array, buffer) = (gl.create_vertex_array()?, gl.create_buffer()?);
            gl.bind_vertex_array(Some(array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let bytes = bytemuck::cast_slice(&ready.points);
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW);
            let fields = [
                (3, glow::FLOAT, offset_of!(Vertex, place)),
                (4, glow::UNSIGNED_BYTE, offset_of!(Vertex, colour)),
                (4, glow::BYTE, offset_of!(Vertex, normal)),
                (1, glow::FLOAT, offset_of!(Vertex, radius)),
            ];
            for (at, (count, kind, offset)) in fields.into_iter().enumerate() {
                gl.enable_vertex_attrib_array(at as u32);
                let stride = size_of::<Vertex>() as i32;
                let share = kind != glow::FLOAT;
                gl.vertex_attrib_pointer_f32(at as u32, count, kind, share, stride, offset as i32);
            }
            gl.bind_vertex_array(None);
            Buffer {
                array,
                buffer,
                points: ready.points.len() as u32,
                version: ready.version,
                radius: ready.radius,
                used: self.frame,
            }
        };
        self.bytes += buffer.bytes();
        self.nodes.insert(ready.id, buffer);
        Ok(())
    }

    /// A frame draws these nodes. Others are deleted where there are too many.
    pub fn begin(&mut self, gl: &glow::Context, drawn: impl Iterator<Item = Id>) {
        self.frame += 1;
        for id in drawn {
            if let Some(buffer) = self.nodes.get_mut(&id) {
                buffer.used = self.frame;
            }
        }
        if self.bytes <= self.memory {
            return;
        }
        let mut oldest: Vec<_> = self
            .nodes
            .iter()
            .map(|(id, buffer)| (buffer.used, *id))
            .collect();
        oldest.sort_unstable();
        for (used, id) in oldest {
            if self.bytes <= self.memory || used == self.frame {
                break;
            }
            self.remove(gl, id);
        }
    }

    /// Draws a node's points with the program that is bound.
    ///
    /// # Safety
    /// The context is current on this thread.
    pub(super) unsafe fn draw(&self, gl: &glow::Context, id: Id) {
        if let Some(buffer) = self.nodes.get(&id) {
            // SAFETY: forwarded; the buffer has so many vertices.
            unsafe {
                gl.bind_vertex_array(Some(buffer.array));
                gl.draw_arrays(glow::POINTS, 0, buffer.points as i32);
            }
        }
    }

    fn remove(&mut self, gl: &glow::Context, id: Id) {
        if let Some(buffer) = self.nodes.remove(&id) {
            self.bytes -= buffer.bytes();
            // SAFETY: the context is current on this thread, and has made both.
            unsafe {
                gl.delete_vertex_array(buffer.array);
                gl.delete_buffer(buffer.buffer);
            }
        }
    }
}
