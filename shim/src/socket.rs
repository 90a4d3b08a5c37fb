//! Our sockets in the program's table of descriptors. The program may close descriptors that it has not opened. So each socket is checked
//! before it is used, and left alone once its descriptor is something else.

use std::mem::ManuallyDrop;
use std::os::fd::AsRawFd;

/// A socket of ours, which is used only while its descriptor still belongs to it.
pub(crate) struct Checked<T: AsRawFd> {
    socket: ManuallyDrop<T>,
    identity: (libc::dev_t, libc::ino_t),
}

impl<T: AsRawFd> Checked<T> {
    pub(crate) fn new(socket: T) -> std::io::Result<Self> {
        let identity = identity(&socket).ok_or_else(std::io::Error::last_os_error)?;
        Ok(Checked {
            socket: ManuallyDrop::new(socket),
            identity,
        })
    }

    pub(crate) fn get(&self) -> Option<&T> {
        (identity(&*self.socket) == Some(self.identity)).then_some(&*self.socket)
    }
}

impl<T: AsRawFd> Drop for Checked<T> {
    fn drop(&mut self) {
        if self.get().is_some() {
            // SAFETY: dropped once, here; the descriptor is still the socket's.
            unsafe { ManuallyDrop::drop(&mut self.socket) };
        }
    }
}

/// Device and inode of the file behind a descriptor.
fn identity(socket: &impl AsRawFd) -> Option<(libc::dev_t, libc::ino_t)> {
    // SAFETY: all-zero is a valid stat.
    let mut status: libc::stat = unsafe { core::mem::zeroed() };
    // SAFETY: status is ours; the descriptor may be anything.
    let known = unsafe { libc::fstat(socket.as_raw_fd(), &mut status) } == 0;
    known.then_some((status.st_dev, status.st_ino))
}

/// Sends as many bytes as the socket takes now, and returns their number. It raises no SIGPIPE, for which the program may have a handler of its
/// own, or none.
pub(crate) fn send(socket: &impl AsRawFd, bytes: &[u8]) -> std::io::Result<usize> {
    // SAFETY: our socket and our bytes.
    let sent = unsafe {
        libc::send(
            socket.as_raw_fd(),
            bytes.as_ptr().cast(),
            bytes.len(),
            libc::MSG_NOSIGNAL | libc::MSG_DONTWAIT,
        )
    };
    usize::try_from(sent).map_err(|_| std::io::Error::last_os_error())
}
