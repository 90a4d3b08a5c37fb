//! The panel's own window, which the launcher has opened. Pictures go to it once per frame, on the thread that shows the frame. Nothing here waits, but
//! for the greeting of the window.
//!
//! The descriptors live in the program's table; see [`crate::socket`].

use crate::drawable::Drawable;
use crate::drawables;
use crate::live::free;
use crate::socket::{self, Checked};
use crate::switch::{config, say_once};
use manyview_core::control::panel::{Frame, Hello, SLOTS, Sent, slot_bytes};
use manyview_core::layer::{DrawableId, Layer, PanelFrame, PanelPicture, Takes};
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read};
use std::os::unix::fs::FileExt;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long the window's greeting may take.
const GREETING: Duration = Duration::from_secs(2);
/// After so long without a frame, a window of the program leaves the panel to a smaller one.
const IDLE: Duration = Duration::from_secs(1);

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
    /// The drawable that the panel shows.
    shown: Option<Shown>,
    /// The process that opened the link. After fork, a child has our memory and our descriptors.
    pid: u32,
}

/// A drawable of the program that the panel shows.
#[derive(Clone, Copy)]
struct Shown {
    id: Option<DrawableId>,
    pixels: u64,
    /// When it has shown its last frame.
    at: Instant,
}

static STATE: Mutex<State> = Mutex::new(State::Unopened);

/// Before a frame of a drawable is shown: has the layer draw for the panel's window, if that takes a picture now.
pub(crate) fn before(layer: &mut Layer, drawable: Option<Drawable>) {
    let Some(panel) = config().and_then(|config| config.panel.as_ref()) else {
        return;
    };
    if panel.size.is_some() {
        // No window takes pictures.
        return layer.set_panel(panel.size, Takes::Never);
    }
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
            Ok(()) => {
                let (width, height) = layer.size();
                let frame = Shown {
                    id: drawable.map(drawables::id),
                    pixels: u64::from(width) * u64::from(height),
                    at: Instant::now(),
                };
                Some((link.size, link.takes(frame)))
            }
            Err(_) => {
                *state = closed(
                    "the panel's window is closed; the picture is shown in the program's window",
                );
                None
            }
        },
        _ => None,
    };
    let (size, takes) = taken.unzip();
    layer.set_panel(size, takes.unwrap_or_default());
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
        let stream = UnixStream::connect(path).or_else(|error| {
            // In a container, the launcher's folder may not be there, and another one is.
            let given = config().map_or(&[][..], |config| &config.sockets);
            let name = path.file_name().unwrap_or_default();
            let mut others = given
                .iter()
                .map(|folder| UnixStream::connect(folder.join(name)));
            others.find_map(Result::ok).ok_or(error)
        })?;
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
            shown: None,
            pid: std::process::id(),
        })
    }

    /// Whether the panel's window takes a frame: it shows the largest of the windows that are not idle.
    fn takes(&mut self, frame: Shown) -> Takes {
        if !frame.replaces(self.shown) {
            return Takes::Never;
        }
        self.shown = Some(frame);
        if self.free.contains(&true) {
            Takes::Now
        } else {
            Takes::Later
        }
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

impl Shown {
    /// Whether the panel shows this frame after those of another drawable, or of the same.
    fn replaces(&self, before: Option<Shown>) -> bool {
        before.is_none_or(|before| {
            before.id == self.id
                || before.pixels < self.pixels
                || self.at.duration_since(before.at) >= IDLE
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_window_that_is_not_idle_is_shown() {
        let start = Instant::now();
        let frame = |id, pixels, ms| Shown {
            id: Some(DrawableId(id)),
            pixels,
            at: start + Duration::from_millis(ms),
        };
        let large = frame(1, 640 * 480, 0);
        assert!(large.replaces(None));
        assert!(frame(1, 1, 10).replaces(Some(large)), "it has shrunk");
        assert!(frame(2, 640 * 481, 10).replaces(Some(large)));
        assert!(!frame(2, 640 * 480, 999).replaces(Some(large)));
        assert!(frame(2, 9, 1000).replaces(Some(large)));
    }
}
