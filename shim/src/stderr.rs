//! Lines on the program's stderr, which may be closed, full, a pipe that nobody reads, or by now a file of the program's.

use crate::signals::Quiet;
use std::sync::OnceLock;

/// Which file a descriptor is: its device, its number there, and the device that it stands for.
type File = (libc::dev_t, libc::ino_t, libc::dev_t);

/// What stderr was when the library was loaded. None: it was closed.
static FIRST: OnceLock<Option<File>> = OnceLock::new();

extern "C" fn remember() {
    FIRST.get_or_init(file);
}

// Runs before the program's own code, which may give the number of stderr to another file.
#[used]
#[unsafe(link_section = ".init_array")]
static REMEMBER: extern "C" fn() = remember;

/// Writes one line, or nothing where that would wait, fail, or reach something that is no stderr. The program gets no signal.
pub(crate) fn write(line: &str) {
    let now = file();
    if now.is_none() || now != *FIRST.get_or_init(file) || !takes_text() {
        return;
    }
    let _quiet = Quiet::new();
    // SAFETY: the bytes of `line`. If the program closes the descriptor meanwhile, the error has no effect.
    unsafe { libc::write(libc::STDERR_FILENO, line.as_ptr().cast(), line.len()) };
}

/// The file that has the number of stderr now. None for a closed one, and for a socket, which may be the program's connection to its X
/// server.
fn file() -> Option<File> {
    // SAFETY: all-zero is a valid stat.
    let mut status: libc::stat = unsafe { core::mem::zeroed() };
    // SAFETY: status is ours.
    let known = unsafe { libc::fstat(libc::STDERR_FILENO, &mut status) } == 0;
    let usable = known && status.st_mode & libc::S_IFMT != libc::S_IFSOCK;
    usable.then_some((status.st_dev, status.st_ino, status.st_rdev))
}

/// Whether a line can be written at once. A pipe that nobody reads may be full, and the program must not wait for its reader.
fn takes_text() -> bool {
    let mut asked = libc::pollfd {
        fd: libc::STDERR_FILENO,
        events: libc::POLLOUT,
        revents: 0,
    };
    // SAFETY: one structure, and no waiting.
    let ready = unsafe { libc::poll(&mut asked, 1, 0) };
    ready == 1 && asked.revents & libc::POLLOUT != 0
}
