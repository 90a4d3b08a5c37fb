//! How pixels lie in memory while the layer reads or uploads them: rows without gaps, in the layer's memory and not in a buffer.

use super::{BufferName, Gl, consts as c};

/// The version of OpenGL ES from which on it knows a value; None where it never does.
type Since = Option<(u32, u32)>;

/// Values of glPixelStore that a read or an upload of the layer's depends on, with what it sets, and since which OpenGL ES they are
/// known. OpenGL knows all.
const STORE: &[(u32, i32, Since)] = &[
    (c::PACK_ALIGNMENT, 1, Some((1, 0))),
    (c::PACK_ROW_LENGTH, 0, Some((3, 0))),
    (c::PACK_SKIP_ROWS, 0, Some((3, 0))),
    (c::PACK_SKIP_PIXELS, 0, Some((3, 0))),
    (c::PACK_SWAP_BYTES, 0, None),
    (c::UNPACK_ALIGNMENT, 1, Some((1, 0))),
    (c::UNPACK_ROW_LENGTH, 0, Some((3, 0))),
    (c::UNPACK_SKIP_ROWS, 0, Some((3, 0))),
    (c::UNPACK_SKIP_PIXELS, 0, Some((3, 0))),
    (c::UNPACK_SWAP_BYTES, 0, None),
    (c::UNPACK_IMAGE_HEIGHT, 0, Some((3, 0))),
    (c::UNPACK_SKIP_IMAGES, 0, Some((3, 0))),
];

/// Proof that pixels lie without gaps in the layer's memory, and the program's values for as long as they do. Commands that read or write
/// pixels ask for it: with other values the driver would go past the end of what they are given.
#[derive(Debug)]
#[must_use = "the program's values come back by `leave`"]
pub struct PixelStore {
    program: Vec<(u32, i32)>,
    pack: BufferName,
    unpack: BufferName,
}

impl PixelStore {
    /// Saves the program's values and sets the layer's.
    pub fn enter(gl: &Gl) -> Self {
        let has = |since: Since| gl.since((1, 0), since);
        let mut program = Vec::new();
        for &(name, ours, _) in STORE.iter().filter(|k| has(k.2)) {
            let value = gl.get_integer(name);
            if value != ours {
                program.push((name, value));
                gl.pixel_storei(name, ours);
            }
        }
        let buffers = gl.since((2, 1), Some((3, 0)));
        let unbound = |binding, target| match buffers {
            true => {
                let bound = BufferName(gl.get_integer(binding) as u32);
                if !bound.is_zero() {
                    gl.bind_buffer(target, BufferName::ZERO);
                }
                bound
            }
            false => BufferName::ZERO,
        };
        PixelStore {
            program,
            pack: unbound(c::PIXEL_PACK_BUFFER_BINDING, c::PIXEL_PACK_BUFFER),
            unpack: unbound(c::PIXEL_UNPACK_BUFFER_BINDING, c::PIXEL_UNPACK_BUFFER),
        }
    }

    /// Puts the program's values back.
    pub fn leave(self, gl: &Gl) {
        let values = self.program.iter();
        values.for_each(|&(name, value)| gl.pixel_storei(name, value));
        if !self.pack.is_zero() {
            gl.bind_buffer(c::PIXEL_PACK_BUFFER, self.pack);
        }
        if !self.unpack.is_zero() {
            gl.bind_buffer(c::PIXEL_UNPACK_BUFFER, self.unpack);
        }
    }
}
