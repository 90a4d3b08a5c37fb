//! The panel's own window: covers a monitor and shows the pictures that the layer in a program sends ([`crate::control::panel`]).
//!
//! It belongs to the launcher, so the program never sees its connection to the display server, and neither waits for the other.
#![forbid(unsafe_code)]

use super::surface::{Picture, Seen, Surface};
use super::{WindowError, open, wake};
use crate::control::panel::{Frame, Hello, SLOTS, Sent, slot_bytes};
use crate::control::{ControlError, place};
use crate::display::Wall;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::net::sockopt::socket_peercred;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::PathBuf;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

const TITLE: &str = "manyview";
/// Permissions of the files.
const MODE: u32 = 0o600;
/// So long after its last frame a program is woken whose newest picture is not here.
const IDLE: Duration = Duration::from_millis(100);
/// So many pictures a program has to send before it is woken again: one that draws a few frames for each time that it is woken would never rest.
const FRAMES_AWAKE: u32 = 8;

/// The open window, which shows pictures until it is dropped.
#[derive(Debug)]
pub struct PanelServer {
    sockets: Vec<PathBuf>,
    /// Its end ends the thread.
    stop: Option<UnixStream>,
    thread: Option<JoinHandle<()>>,
}

impl PanelServer {
    /// Opens a black window over the monitor that the user has named, or over the one that has the panel's size, and the socket to which the
    /// layer connects. `panel`: width and height of the display in pixels, where they are known.
    ///
    /// # Errors
    /// There is no X server, no such monitor, or no place for the socket.
    pub fn open(wanted: Option<&str>, panel: Option<(u32, u32)>) -> Result<Self, WindowError> {
        let surface = open(TITLE, wanted, panel)?;
        let size = surface.monitor().size;
        let at = [0, 0];
        Self::serve(vec![Part { surface, at, size }], size)
    }

    /// Opens a window over the monitor of each panel of a wall.
    ///
    /// # Errors
    /// As [`PanelServer::open`].
    pub fn open_wall(wall: &Wall) -> Result<Self, WindowError> {
        let mut parts = Vec::new();
        for panel in wall.panels() {
            let surface = open(TITLE, Some(&panel.monitor), None)?;
            surface.monitor().check(panel.pixels)?;
            parts.push(Part {
                surface,
                at: panel.at,
                size: panel.pixels,
            });
        }
        Self::serve(parts, wall.sheet())
    }

    fn serve(parts: Vec<Part>, size: (u32, u32)) -> Result<Self, WindowError> {
        let no = |error: &dyn std::fmt::Display| WindowError::Socket(error.to_string());
        let mut doors = vec![Door::open(folder()).map_err(|error| no(&error))?];
        // For programs in containers; where it cannot be, these are not shown.
        let home = std::env::var_os("HOME");
        let shared = place::shared_folder(home.as_deref());
        doors.extend(shared.and_then(|folder| Door::open(folder).ok()));
        let (stop, stopped) = UnixStream::pair().map_err(|error| no(&error))?;
        let sockets = doors.iter().map(Door::socket).collect();
        let served = Served {
            parts,
            doors,
            size,
            stopped,
            clients: Vec::new(),
            count: 0,
            waiting: None,
        };
        // Its failure is the end of the window, of which the layer tells.
        let thread = std::thread::spawn(move || drop(served.run()));
        Ok(Self {
            sockets,
            stop: Some(stop),
            thread: Some(thread),
        })
    }

    /// The socket to which the layer connects, of the window that this process opens.
    #[must_use]
    pub fn place() -> PathBuf {
        folder().join(name())
    }
}

impl Drop for PanelServer {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // A panic there has been told already.
            let _ = thread.join();
        }
        for socket in &self.sockets {
            let _ = std::fs::remove_file(socket);
        }
    }
}

/// A folder with a socket to which the layer connects.
struct Door {
    folder: PathBuf,
    listener: UnixListener,
}

impl Door {
    fn open(folder: PathBuf) -> Result<Self, ControlError> {
        let user = rustix::process::geteuid().as_raw();
        let _ = folder.parent().map(std::fs::create_dir_all);
        place::prepare(&folder, user)?;
        let path = folder.join(name());
        let failed = |error: io::Error| ControlError::Socket {
            path: path.clone(),
            reason: error.kind().to_string(),
        };
        let _ = std::fs::remove_file(&path);
        let listener = UnixListener::bind(&path).map_err(failed)?;
        place::close_to_others(&path).map_err(failed)?;
        Ok(Self { folder, listener })
    }

    fn socket(&self) -> PathBuf {
        self.folder.join(name())
    }
}

/// The name of the sockets of this process.
fn name() -> String {
    format!("panel-{}.sock", std::process::id())
}

fn folder() -> PathBuf {
    let user = rustix::process::geteuid().as_raw();
    place::folder(std::env::var_os(place::RUNTIME).as_deref(), user)
}

/// What the thread works with.
struct Served {
    parts: Vec<Part>,
    /// Width and height of the picture in pixels.
    size: (u32, u32),
    /// One outside, and one that containers share.
    doors: Vec<Door>,
    stopped: UnixStream,
    clients: Vec<Client>,
    /// Programs that have connected.
    count: u32,
    /// The newest picture, until a pixmap is free for it, and the number of the program that it is of.
    waiting: Option<(u32, Frame)>,
}

/// A window, and the part of the picture that it shows.
struct Part {
    surface: Box<dyn Surface>,
    /// Left and top in the picture, and width and height, in pixels.
    at: [u32; 2],
    size: (u32, u32),
}

/// A program whose pictures are shown.
struct Client {
    number: u32,
    stream: UnixStream,
    file: File,
    path: PathBuf,
    /// Bytes of a message that are not complete.
    pending: Vec<u8>,
    /// Its process, if the system tells.
    process: Option<u32>,
    /// Since when its newest picture is not here.
    behind: Option<Instant>,
    /// Pictures that it has sent since it was woken.
    frames: u32,
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

impl Served {
    /// Shows pictures until it is stopped, or the window is closed.
    fn run(mut self) -> Result<(), WindowError> {
        loop {
            if self.handle_events()? {
                return Ok(());
            }
            self.show()?;
            self.wake_idle();
            for part in &mut self.parts {
                part.surface.flush()?;
            }
            let ready = self
                .wait()
                .map_err(|e| WindowError::Socket(e.to_string()))?;
            if ready.stopped {
                return Ok(());
            }
            for door in ready.doors {
                if let Ok((stream, _)) = self.doors[door].listener.accept() {
                    // A program that is gone already is none.
                    let _ = self.welcome(stream, door);
                }
            }
            for number in ready.clients {
                if !self.receive(number)? {
                    self.dismiss(number)?;
                }
            }
        }
    }

    /// Handles the events of the windows. Returns whether one was closed.
    fn handle_events(&mut self) -> Result<bool, WindowError> {
        for part in &mut self.parts {
            if part.surface.handle_events()? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Waits until something can be read.
    fn wait(&self) -> io::Result<Ready> {
        let input = PollFlags::IN;
        let mut all = vec![PollFd::new(&self.stopped, input)];
        let doors = self.doors.iter();
        all.extend(doors.map(|door| PollFd::new(&door.listener, input)));
        let clients = self.clients.iter();
        all.extend(clients.map(|client| PollFd::new(&client.stream, input)));
        let windows = self.parts.iter().map(|part| part.surface.connection());
        all.extend(windows.map(|server| PollFd::from_borrowed_fd(server, input)));
        let timeout = self
            .clients
            .iter()
            .any(Client::may_be_woken)
            .then_some(Timespec {
                tv_sec: 0,
                tv_nsec: IDLE.subsec_nanos().into(),
            });
        match poll(&mut all, timeout.as_ref()) {
            Ok(_) | Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
        let ready = |fd: &PollFd<'_>| !fd.revents().is_empty();
        let (doors, others) = all[1..].split_at(self.doors.len());
        let clients = self.clients.iter().zip(others);
        Ok(Ready {
            stopped: ready(&all[0]),
            doors: (0..doors.len()).filter(|&at| ready(&doors[at])).collect(),
            clients: clients
                .filter(|(_, fd)| ready(fd))
                .map(|(client, _)| client.number)
                .collect(),
        })
    }

    /// Greets a program and makes the file of its pictures.
    fn welcome(&mut self, mut stream: UnixStream, door: usize) -> io::Result<()> {
        self.count += 1;
        let name = format!("panel-{}-{}.pictures", std::process::id(), self.count);
        let path = self.doors[door].folder.join(name);
        let _ = std::fs::remove_file(&path);
        let mut options = OpenOptions::new();
        let file = options
            .read(true)
            .write(true)
            .create_new(true)
            .mode(MODE)
            .open(&path)?;
        let size = self.size;
        let hello = Hello {
            size,
            file: path.clone(),
        };
        let client = Client {
            number: self.count,
            stream: stream.try_clone()?,
            pending: Vec::new(),
            process: peer(&stream),
            behind: None,
            frames: FRAMES_AWAKE,
            path,
            file,
        };
        client.file.set_len(slot_bytes(size) * u64::from(SLOTS))?;
        for part in &mut self.parts {
            part.surface.attach(client.number, &client.file);
        }
        stream.write_all(hello.line().as_bytes())?;
        stream.set_nonblocking(true)?;
        self.clients.push(client);
        Ok(())
    }

    /// Receives frames of a program, and shows the last one. Returns false where it has ended.
    fn receive(&mut self, number: u32) -> Result<bool, WindowError> {
        let size = self.size;
        let Some(client) = self
            .clients
            .iter_mut()
            .find(|client| client.number == number)
        else {
            return Ok(false);
        };
        let mut bytes = [0; 64 * Sent::BYTES];
        let open = match client.stream.read(&mut bytes) {
            Ok(0) => false,
            Ok(count) => {
                client.pending.extend(&bytes[..count]);
                true
            }
            Err(error) => error.kind() == io::ErrorKind::WouldBlock,
        };
        let whole = client.pending.len() / Sent::BYTES * Sent::BYTES;
        let all: Vec<u8> = client.pending.drain(..whole).collect();
        let mut passed = Vec::new();
        for bytes in all.as_chunks::<{ Sent::BYTES }>().0 {
            // The program has opened the file, so nothing of it has to be left where this process is killed.
            let _ = std::fs::remove_file(&client.path);
            let sent = Sent::of(*bytes, size);
            client.behind = sent.is_behind.then(Instant::now);
            let Some(frame) = sent.picture else {
                continue;
            };
            client.frames = client.frames.saturating_add(1);
            passed.extend(self.waiting.replace((number, frame)));
        }
        for (number, frame) in passed {
            if let Some(client) = self.clients.iter().find(|client| client.number == number) {
                free(client, frame.slot);
            }
        }
        Ok(open)
    }

    /// A program has ended.
    fn dismiss(&mut self, number: u32) -> Result<(), WindowError> {
        self.clients.retain(|client| client.number != number);
        for part in &mut self.parts {
            part.surface.detach(number)?;
        }
        Ok(())
    }

    /// Shows the picture that waits, if each window takes one now.
    fn show(&mut self) -> Result<(), WindowError> {
        let Some((number, frame)) = self.waiting else {
            return Ok(());
        };
        if !self.parts.iter().all(|part| part.surface.is_free()) {
            return Ok(());
        }
        self.waiting = None;
        let Some(client) = self.clients.iter().find(|client| client.number == number) else {
            return Ok(());
        };
        let picture = Picture {
            program: number,
            file: &client.file,
            offset: slot_bytes(self.size) * u64::from(frame.slot),
            frame,
        };
        for part in &mut self.parts {
            let seen = Seen::of(frame, part.at, part.size);
            part.surface.take(picture, seen)?;
        }
        free(client, frame.slot);
        for part in &mut self.parts {
            part.surface.show()?;
        }
        Ok(())
    }

    /// Wakes programs that have shown no frame for a while and whose newest picture is not here.
    fn wake_idle(&mut self) {
        for client in self
            .clients
            .iter_mut()
            .filter(|client| client.may_be_woken())
        {
            if client.behind.is_some_and(|since| since.elapsed() >= IDLE)
                && let Some(process) = client.process
            {
                client.frames = 0;
                // Where it cannot be woken, its picture comes with its next frame.
                wake(process);
            }
        }
    }
}

impl Client {
    /// Its newest picture is not here, and it was not woken for it.
    fn may_be_woken(&self) -> bool {
        self.behind.is_some() && self.frames >= FRAMES_AWAKE
    }
}

/// The process at the other end.
fn peer(stream: &UnixStream) -> Option<u32> {
    let credentials = socket_peercred(stream).ok()?;
    Some(credentials.pid.as_raw_nonzero().get().unsigned_abs())
}

/// What can be read.
struct Ready {
    stopped: bool,
    /// Their numbers.
    doors: Vec<usize>,
    clients: Vec<u32>,
}

/// Tells a program that a slot is free.
fn free(client: &Client, slot: u8) {
    // A program that does not read has no use for the slot.
    let _ = (&client.stream).write(&[slot]);
}
