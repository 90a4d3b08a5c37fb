//! The panel's own window, which the launcher has opened. Pictures go to it once per frame, on the thread that shows the frame. Nothing here waits, but
//! for the greeting of the window.
//!
//! The descriptors live in the program's table; see [`crate::socket`].

use crate::live::free;
use crate::socket::{self, Checked};
use crate::switch::{config, say_once};
use manyview_core::control::panel::{Frame, Hello, SLOTS, Sent, slot_bytes};
use manyview_core::layer::{Layer, PanelFrame, PanelPicture};
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read};
use std::os::unix::fs::FileExt;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;

/// How long the window's greeting may take.
const GREETING: Duration = Duration::from_secs(2);

enum State {
    Unopened,
    Open(Link),
    /// The window is gone, or was never there.
    Closed,
}

struct Link {
    stream: Checked<UnixStream>,
    file: Checked<File>,
    size: (u32, u32),
    free: [bool; SLOTS as usize],
    /// The window knows that a newer picture is to come.
    behind: bool,
    /// The process that opened the link. After fork, a child has our memory and our descriptors.
    pid: u32,
}

static STATE: Mutex<State> = Mutex::new(State::Unopened);

/// Before a frame is shown: has the layer draw for the panel's window, if that takes a picture now.
pub(crate) fn before(layer: &mut Layer) {
    let Some(panel) = config().and_then(|config| config.panel.as_ref()) else {
        return;
    };
    let Some(mut state) = free(&STATE) else {
        return;
    };
    if let State::Unopened = *state {
        let opened = panel.socket.as_deref().map(Link::open);
        *state = match opened {
            Some(Ok(link)) => State::Open(link),
            Some(Err(error)) => closed(&format!(
                "the panel's window cannot be reached ({error}); the picture is shown in the program's window"
            )),
            None => closed(
                "the panel's window is opened by manyview run, which did not start this program; the picture is shown in the program's window",
            ),
        };
    }
    let taken = match &mut *state {
        State::Open(link) if link.pid == std::process::id() => match link.listen() {
            Ok(()) => Some((link.size, !link.free.contains(&true))),
            Err(_) => {
                *state = closed(
                    "the panel's window is closed; the picture is shown in the program's window",
                );
                None
            }
        },
        _ => None,
    };
    let (size, full) = taken.unzip();
    layer.set_panel(size, full.unwrap_or(false));
}

/// After a frame was shown: gives its picture to the panel's window.
pub(crate) fn after(layer: &mut Layer) {
    let Some(frame) = layer.take_panel_frame() else {
        return;
    };
    if let Some(mut state) = free(&STATE)
        && let State::Open(link) = &mut *state
        && link.pid == std::process::id()
        && link.send(&frame).is_err()
    {
        *state =
            closed("the panel's window is closed; the picture is shown in the program's window");
    }
    if let Some(picture) = frame.picture {
        layer.recycle_panel_picture(picture);
    }
}

fn closed(why: &str) -> State {
    say_once(why);
    State::Closed
}

impl Link {
    fn open(path: &Path) -> io::Result<Link> {
        let stream = UnixStream::connect(path)?;
        stream.set_read_timeout(Some(GREETING))?;
        let mut line = String::new();
        BufReader::new(&stream).take(4096).read_line(&mut line)?;
        let other = || io::Error::other("it is of another version");
        let hello = Hello::of(line.trim_end_matches('\n')).ok_or_else(other)?;
        stream.set_nonblocking(true)?;
        let file = OpenOptions::new().write(true).open(&hello.file)?;
        Ok(Link {
            stream: Checked::new(stream)?,
            file: Checked::new(file)?,
            size: hello.size,
            free: [true; SLOTS as usize],
            behind: false,
            pid: std::process::id(),
        })
    }

    /// Learns which slots are free again.
    fn listen(&mut self) -> io::Result<()> {
        let mut freed = [0; 64];
        loop {
            let Some(mut stream) = self.stream.get() else {
                return Err(io::ErrorKind::NotConnected.into());
            };
            match stream.read(&mut freed) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                Ok(count) => {
                    for &slot in freed.iter().take(count) {
                        if let Some(free) = self.free.get_mut(usize::from(slot)) {
                            *free = true;
                        }
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Ok(()),
                Err(error) => return Err(error),
            }
        }
    }

    /// Tells the window what a frame has for it.
    fn send(&mut self, frame: &PanelFrame) -> io::Result<()> {
        let written = frame.picture.as_ref().map(|picture| self.write(picture));
        let written = written.transpose()?;
        let picture = written.flatten();
        let left_out = frame.picture.is_some() && picture.is_none();
        let sent = Sent {
            picture,
            is_behind: frame.is_behind || left_out,
        };
        if picture.is_none() && sent.is_behind == self.behind {
            return Ok(());
        }
        let gone = || io::Error::from(io::ErrorKind::NotConnected);
        let stream = self.stream.get().ok_or_else(gone)?;
        match socket::send(stream, &sent.bytes()) {
            Ok(Sent::BYTES) => {
                self.behind = sent.is_behind;
                if let Some(frame) = picture {
                    self.free[usize::from(frame.slot)] = false;
                }
                Ok(())
            }
            Ok(_) => Err(gone()),
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => Ok(()),
            Err(error) => Err(error),
        }
    }

    /// Writes a picture to a slot. None where no slot is free: the window is behind, and this picture is left out.
    fn write(&mut self, picture: &PanelPicture) -> io::Result<Option<Frame>> {
        let Some(slot) = self.free.iter().position(|free| *free) else {
            return Ok(None);
        };
        let gone = || io::Error::from(io::ErrorKind::NotConnected);
        let file = self.file.get().ok_or_else(gone)?;
        let mut at = slot as u64 * slot_bytes(self.size);
        for row in picture.rows() {
            file.write_all_at(row, at)?;
            at += row.len() as u64;
        }
        Ok(Some(Frame {
            slot: slot as u8,
            at: picture.place.at.map(|v| v as u16),
            size: picture.place.size.map(|v| v as u16),
        }))
    }
}
