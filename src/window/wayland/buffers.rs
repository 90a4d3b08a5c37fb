//! Pictures in memory that the compositor reads as well.
#![forbid(unsafe_code)]

use super::{State, failed};
use crate::control::panel::PIXEL;
use crate::window::WindowError;
use crate::window::surface::{Picture, Place, Seen};
use rustix::fs::{MemfdFlags, memfd_create};
use std::fs::File;
use std::os::fd::AsFd;
use std::os::unix::fs::FileExt;
use wayland_client::protocol::wl_buffer::{self, WlBuffer};
use wayland_client::protocol::wl_shm::{Format, WlShm};
use wayland_client::protocol::wl_shm_pool::WlShmPool;
use wayland_client::{Connection, Dispatch, QueueHandle, delegate_noop};

/// One that is shown, one that is to be shown next, and one that is written.
pub(super) const BUFFERS: usize = 3;

/// Pictures of one size.
pub(super) struct Buffers {
    file: File,
    size: (u32, u32),
    buffers: Vec<Buffer>,
}

struct Buffer {
    buffer: WlBuffer,
    /// Where its picture is; it is black elsewhere.
    place: Place,
}

impl Buffers {
    /// Black pictures.
    pub(super) fn new(
        shm: &WlShm,
        size: (u32, u32),
        handle: &QueueHandle<State>,
    ) -> Result<Self, WindowError> {
        let bytes = bytes(size);
        let whole = bytes * BUFFERS as u64;
        // The protocol counts in signed numbers of 32 bits.
        let total = i32::try_from(whole).map_err(|_| failed("the monitor is too large"))?;
        let file = File::from(memfd_create("manyview-panel", MemfdFlags::CLOEXEC).map_err(failed)?);
        file.set_len(whole).map_err(failed)?;
        let pool = shm.create_pool(file.as_fd(), total, handle, ());
        let (width, height) = (size.0 as i32, size.1 as i32);
        let stride = width * PIXEL as i32;
        let buffers = (0..BUFFERS).map(|number| {
            let offset = (bytes * number as u64) as i32;
            let format = Format::Xrgb8888;
            Buffer {
                buffer: pool.create_buffer(offset, width, height, stride, format, handle, number),
                place: ([0; 2], [0; 2]),
            }
        });
        let buffers = buffers.collect();
        pool.destroy();
        Ok(Self {
            file,
            size,
            buffers,
        })
    }

    pub(super) fn get(&self, number: usize) -> Option<&WlBuffer> {
        self.buffers.get(number).map(|buffer| &buffer.buffer)
    }

    /// Writes what is seen of a picture into one that the compositor does not read.
    pub(super) fn write(
        &mut self,
        number: usize,
        picture: Picture<'_>,
        seen: Seen,
    ) -> Result<(), WindowError> {
        let start = bytes(self.size) * number as u64;
        let row = u64::from(self.size.0) * PIXEL as u64;
        let Some(buffer) = self.buffers.get_mut(number) else {
            return Ok(());
        };
        if buffer.place != seen.place {
            let black = vec![0; row as usize];
            for y in 0..u64::from(self.size.1) {
                self.file
                    .write_all_at(&black, start + y * row)
                    .map_err(failed)?;
            }
            buffer.place = seen.place;
        }
        let ([x, y], [width, height]) = seen.place;
        let mut pixels = vec![0; usize::from(width) * PIXEL];
        let first = start + u64::from(y) * row + u64::from(x) * PIXEL as u64;
        for number in 0..height {
            picture.read(seen, number, &mut pixels)?;
            let at = first + u64::from(number) * row;
            self.file.write_all_at(&pixels, at).map_err(failed)?;
        }
        Ok(())
    }
}

/// Bytes of a picture.
fn bytes((width, height): (u32, u32)) -> u64 {
    u64::from(width) * u64::from(height) * PIXEL as u64
}

impl Dispatch<WlBuffer, usize> for State {
    fn event(
        state: &mut Self,
        _: &WlBuffer,
        event: wl_buffer::Event,
        number: &usize,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        if let wl_buffer::Event::Release = event
            && let Some(busy) = state.window.busy.get_mut(*number)
        {
            *busy = false;
        }
    }
}

delegate_noop!(State: ignore WlShm);
delegate_noop!(State: WlShmPool);
