//! What buffers hold.

use super::limits::BUFFERS;
use super::memory::{address, bytes, put_bytes};
use super::{Call, Driver};

impl Driver {
    /// The buffer that is bound at a target.
    fn bound_buffer(&self, target: u32) -> u32 {
        let binding = BUFFERS.iter().find(|known| known.0 == target);
        binding.map_or(0, |&(_, binding)| {
            self.state.int(self.state.scope(binding), binding)
        })
    }

    /// glBufferData and what else reads or writes buffers; none for others.
    pub(super) fn stores(&mut self, call: &Call) -> Option<i64> {
        let bound = self.bound_buffer(call.int(0) as u32);
        let place_of = |at: usize| address(call.args.get(at));
        let start = call.int(1).max(0) as usize;
        let length = call.int(2).max(0) as usize;
        match call.name {
            "glBufferData" => {
                let mut data = bytes(place_of(2), start);
                data.resize(start, 0);
                self.buffers.insert(bound, data);
            }
            "glBufferSubData" | "glGetBufferSubData" | "glMapBufferRange" => {
                let buffer = self.buffers.entry(bound).or_default();
                if buffer.len() < start + length {
                    buffer.resize(start + length, 0);
                }
                let range = buffer.get_mut(start..start + length)?;
                match call.name {
                    "glBufferSubData" => range.copy_from_slice(&bytes(place_of(3), length)),
                    "glGetBufferSubData" => put_bytes(place_of(3), range),
                    _ => return Some(range.as_mut_ptr() as i64),
                }
            }
            "glMapBuffer" => {
                let buffer = self.buffers.entry(bound).or_default();
                return Some(buffer.as_mut_ptr() as i64);
            }
            "glUnmapBuffer" => return Some(1),
            _ => return None,
        }
        Some(0)
    }
}
