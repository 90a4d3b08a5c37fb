//! Draws: the program's own once more, with its arrays and indices, and the triangle of the layer's passes.

use super::indices::{Indices, Vertices};
use super::{BufferName, Gl, Ptr, VertexArrayName, consts as c};

impl Gl {
    /// A triangle without arrays, from a vertex array of the layer's, which stays bound: it enables none there.
    pub fn draw_triangle(&self, vertex_array: VertexArrayName) {
        self.draw_triangles(vertex_array, 1);
    }

    /// The same of several triangles.
    pub fn draw_triangles(&self, vertex_array: VertexArrayName, triangles: u32) {
        self.bind_vertex_array(vertex_array);
        let vertices = i32::try_from(triangles.saturating_mul(3)).unwrap_or(i32::MAX);
        // SAFETY: a context is current; without arrays no memory is read.
        unsafe { self.real.glDrawArrays(c::TRIANGLES, 0, vertices) }
    }

    /// glDrawArrays
    pub fn draw_arrays(&self, mode: u32, vertices: Vertices) {
        // SAFETY: the program has these vertices where its arrays are (contract of `Vertices::new`).
        unsafe { self.real.glDrawArrays(mode, vertices.first, vertices.count) }
    }

    /// glDrawArraysInstanced
    pub fn draw_arrays_instanced(&self, mode: u32, vertices: Vertices, instances: i32) {
        // SAFETY: as in `draw_arrays`; instances read the same ones.
        unsafe {
            self.real
                .glDrawArraysInstanced(mode, vertices.first, vertices.count, instances)
        }
    }

    /// glDrawElements
    pub fn draw_elements(&self, mode: u32, indices: Indices) {
        // SAFETY: the program passed this pointer for this count and type to its own draw (contract of `Indices::new`).
        unsafe {
            self.real
                .glDrawElements(mode, indices.count, indices.kind, indices.at)
        }
    }

    /// glDrawElementsInstanced
    pub fn draw_elements_instanced(&self, mode: u32, indices: Indices, instances: i32) {
        // SAFETY: as in `draw_elements`.
        unsafe {
            self.real.glDrawElementsInstanced(
                mode,
                indices.count,
                indices.kind,
                indices.at,
                instances,
            )
        }
    }

    /// Some of the vertices, by their places in the program's draw, in another order; places that it does not have are left out.
    pub fn draw_places(&self, mode: u32, vertices: Vertices, places: &[u32]) {
        let (first, count) = (vertices.first.max(0), vertices.count.max(0));
        let inside = places.iter().filter(|&&at| at < count.unsigned_abs());
        let list: Vec<u32> = inside.map(|at| at + first.unsigned_abs()).collect();
        // SAFETY: all are vertices of the program's draw.
        unsafe { self.draw_listed(mode, &list) }
    }

    /// As [`Gl::draw_places`], of a draw whose indices lie in the program's memory; nothing is drawn where they do not.
    pub fn draw_places_of_elements(&self, mode: u32, indices: Indices, places: &[u32]) {
        let Some(own) = self.own_indices(indices) else {
            return;
        };
        let own: Vec<u32> = own.collect();
        let list = places.iter().filter_map(|&at| own.get(at as usize));
        let list: Vec<u32> = list.copied().collect();
        // SAFETY: all are vertices of the program's draw.
        unsafe { self.draw_listed(mode, &list) }
    }

    /// glDrawElements with indices of the layer's, which lie in no buffer.
    ///
    /// # Safety
    /// The program has these vertices where its arrays are.
    unsafe fn draw_listed(&self, mode: u32, list: &[u32]) {
        let bound = BufferName(self.get_integer(c::ELEMENT_ARRAY_BUFFER_BINDING) as u32);
        self.bind_buffer(c::ELEMENT_ARRAY_BUFFER, BufferName::ZERO);
        let (count, kind) = (list.len() as i32, c::UNSIGNED_INT);
        // SAFETY: no element buffer is bound, so this is an address.
        // SAFETY: the driver has read as many indices as there are when it returns; the vertices are there (contract).
        unsafe {
            self.real
                .glDrawElements(mode, count, kind, list.as_ptr() as Ptr)
        };
        self.bind_buffer(c::ELEMENT_ARRAY_BUFFER, bound);
    }

    /// Whether the indices of the program's draw lie in its own memory.
    pub fn has_own_indices(&self, indices: Indices) -> bool {
        !indices.at.is_null() && self.get_integer(c::ELEMENT_ARRAY_BUFFER_BINDING) == 0
    }

    /// The indices, where they do: what is in a buffer has to be waited for.
    pub(super) fn own_indices(&self, indices: Indices) -> Option<impl Iterator<Item = u32>> {
        let Indices { count, kind, at } = indices;
        let known = [c::UNSIGNED_BYTE, c::UNSIGNED_SHORT, c::UNSIGNED_INT].contains(&kind);
        if !known || !self.has_own_indices(indices) {
            return None;
        }
        let read = move |i: u32| {
            let i = i as usize;
            // SAFETY: no element buffer is bound, so this is an address.
            // SAFETY: the program passed it for this count and type to its own draw (contract of `Indices::new`).
            // SAFETY: it may lie anywhere; it is read without regard to that.
            unsafe {
                match kind {
                    c::UNSIGNED_BYTE => u32::from(at.cast::<u8>().add(i).read_unaligned()),
                    c::UNSIGNED_SHORT => u32::from(at.cast::<u16>().add(i).read_unaligned()),
                    _ => at.cast::<u32>().add(i).read_unaligned(),
                }
            }
        };
        Some((0..count.max(0).unsigned_abs()).map(read))
    }
}
