//! What is bound while a draw is sent for a view.

use crate::gl::{BindingPoint, BoundRange, BufferName, Gl, ImageUnit, TextureName, consts as c};
use crate::view::ViewIndex;

/// A buffer that a draw of another view writes to in the place of the program's, or reads a uniform block from.
#[derive(Debug)]
pub(super) struct Redirected {
    pub(super) point: BindingPoint,
    /// The program's.
    pub(super) range: BoundRange,
    pub(super) bytes: usize,
    /// The layer's; 0 where there is no memory for one.
    pub(super) scratch: BufferName,
    /// What differs between the views.
    pub(super) matrices: Vec<ViewMatrix>,
}

/// A matrix in a uniform block that each view has of its own.
#[derive(Clone, Debug)]
pub(in crate::layer) struct ViewMatrix {
    /// Bytes from the beginning of the block.
    pub(in crate::layer) offset: usize,
    /// Of each view, as it lies in the buffer; none where it is the program's.
    pub(in crate::layer) views: Vec<Option<[f32; 16]>>,
}

impl Redirected {
    /// Whether a view has the program's own buffer.
    fn is_plain_in(&self, view: ViewIndex, own: ViewIndex) -> bool {
        let plain = |m: &ViewMatrix| m.of(view).is_none();
        (view == own || self.point.target == c::UNIFORM_BUFFER) && self.matrices.iter().all(plain)
    }
}

impl ViewMatrix {
    fn of(&self, view: ViewIndex) -> Option<&[f32; 16]> {
        self.views.get(view.0 as usize)?.as_ref()
    }
}

/// Where the draw of each view writes to.
#[derive(Debug, Default)]
pub(in crate::layer) struct Redirection {
    pub(super) buffers: Vec<Redirected>,
    /// Images that are stored to or differ, with the texture of each view; without any where they cannot differ.
    pub(super) images: Vec<(ImageUnit, Vec<TextureName>)>,
    /// Bindings of the program that are used to copy, by target.
    pub(super) bound: Vec<(u32, BufferName)>,
    /// Others than the program's are bound.
    pub(super) away: bool,
}

impl Redirection {
    /// Before a draw of a view: binds what it writes to.
    pub(in crate::layer) fn enter(&mut self, gl: &Gl, view: ViewIndex, own: ViewIndex) {
        if self.buffers.is_empty() && self.images.is_empty() {
            return;
        }
        if self.buffers.iter().all(|b| b.is_plain_in(view, own)) {
            self.put_buffers(gl);
        } else {
            self.bind_scratch(gl, view, own);
        }
        for (image, views) in &self.images {
            let texture = views.get(view.0 as usize).copied();
            let without = match view == own {
                true => image.texture,
                false => TextureName::ZERO,
            };
            gl.bind_image(image, texture.unwrap_or(without));
        }
    }

    /// After the draw of all views: binds what the program has bound.
    pub(in crate::layer) fn leave(mut self, gl: &Gl) {
        self.put_buffers(gl);
        for (image, _) in &self.images {
            gl.bind_image(image, image.texture);
        }
    }

    fn bind_scratch(&mut self, gl: &Gl, view: ViewIndex, own: ViewIndex) {
        self.away = true;
        let written = |buffer: &Redirected| buffer.point.target != c::UNIFORM_BUFFER;
        if self.buffers.iter().any(written) {
            gl.finish_writes_to_buffers();
        }
        for buffer in &self.buffers {
            if buffer.is_plain_in(view, own) {
                gl.bind_range(buffer.point, &buffer.range);
                continue;
            }
            let range = match buffer.scratch {
                BufferName::ZERO if written(buffer) => BoundRange::whole(BufferName::ZERO),
                BufferName::ZERO => buffer.range,
                scratch => BoundRange::part(scratch, 0, buffer.bytes),
            };
            if !buffer.scratch.is_zero() {
                gl.bind_buffer(c::COPY_READ_BUFFER, buffer.range.buffer);
                gl.bind_buffer(c::COPY_WRITE_BUFFER, buffer.scratch);
                gl.copy_buffer(buffer.range.start, 0, buffer.bytes);
                for matrix in &buffer.matrices {
                    let fits = matrix.offset + size_of::<[f32; 16]>() <= buffer.bytes;
                    if let Some(m) = matrix.of(view).filter(|_| fits) {
                        let bytes: &[u8] = bytemuck::cast_slice(m);
                        gl.buffer_sub_data(c::COPY_WRITE_BUFFER, matrix.offset, bytes);
                    }
                }
            }
            gl.bind_range(buffer.point, &range);
        }
    }

    fn put_buffers(&mut self, gl: &Gl) {
        if !std::mem::take(&mut self.away) {
            return;
        }
        for buffer in &self.buffers {
            gl.bind_range(buffer.point, &buffer.range);
        }
        for &(target, buffer) in &self.bound {
            gl.bind_buffer(target, buffer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::fake::Fake;

    const POINT: BindingPoint = BindingPoint {
        target: c::SHADER_STORAGE_BUFFER,
        index: 3,
    };

    #[test]
    fn other_views_write_to_copies() {
        let fake = Fake::new();
        let gl = fake.gl();
        let mut redirection = Redirection {
            buffers: vec![Redirected {
                point: POINT,
                range: BoundRange::part(BufferName(7), 256, 64),
                bytes: 64,
                scratch: BufferName(9),
                matrices: Vec::new(),
            }],
            bound: vec![(c::COPY_READ_BUFFER, BufferName(5))],
            ..Redirection::default()
        };
        let (own, other) = (ViewIndex(1), ViewIndex(0));
        fake.forget();
        redirection.enter(&gl, other, own);
        let names: Vec<_> = fake.calls().iter().map(|call| call.name).collect();
        assert_eq!(
            names,
            [
                "glMemoryBarrier",
                "glBindBuffer",
                "glBindBuffer",
                "glCopyBufferSubData",
                "glBindBufferRange"
            ]
        );
        assert_eq!(
            fake.lines("glBindBufferRange"),
            ["glBindBufferRange(37074, 3, 9, 0, 64)"]
        );
        fake.forget();
        redirection.enter(&gl, own, own);
        let lines = fake.lines("gl*");
        assert_eq!(
            lines,
            [
                "glBindBufferRange(37074, 3, 7, 256, 64)",
                "glBindBuffer(36662, 5)"
            ]
        );
        fake.forget();
        redirection.leave(&gl);
        assert_eq!(fake.count("gl*"), 0, "the own view was the last");
    }

    #[test]
    fn views_have_matrices_of_their_own_in_copies_of_blocks() {
        let fake = Fake::new();
        let gl = fake.gl();
        let point = BindingPoint {
            target: c::UNIFORM_BUFFER,
            index: 2,
        };
        let mut redirection = Redirection {
            buffers: vec![Redirected {
                point,
                range: BoundRange::part(BufferName(7), 256, 208),
                bytes: 208,
                scratch: BufferName(9),
                matrices: vec![ViewMatrix {
                    offset: 144,
                    views: vec![Some([2.0; 16]), None, Some([3.0; 16])],
                }],
            }],
            ..Redirection::default()
        };
        let own = ViewIndex(1);
        for view in [0, 2] {
            fake.forget();
            redirection.enter(&gl, ViewIndex(view), own);
            assert_eq!(fake.count("glMemoryBarrier"), 0, "shaders only read it");
            assert_eq!(fake.count("glBufferSubData"), 1);
            let bound = fake.lines("glBindBufferRange");
            assert_eq!(bound, ["glBindBufferRange(35345, 2, 9, 0, 208)"]);
        }
        fake.forget();
        redirection.enter(&gl, own, own);
        let lines = fake.lines("gl*");
        assert_eq!(lines, ["glBindBufferRange(35345, 2, 7, 256, 208)"]);
    }
}
