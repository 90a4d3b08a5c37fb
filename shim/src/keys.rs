//! Keys for the layer while the program has the keyboard. They are watched, never taken. Only answers of the X server are waited for, with a
//! short limit.
//!
//! A connection of our own selects the raw key events of the root window, which the server sends in addition to all events of the program.
//! Only a key of ours with Ctrl and Alt held leads to a query: whether a window of the program has the focus.

use crate::live::{self, free};
use crate::socket::{self, Checked};
use crate::switch::{config, say};
use manyview_core::config::program;
use manyview_core::control::{Answer, keys};
use manyview_core::layer::{Layer, Pictured, Wanted};
use std::error::Error;
use std::io;
use std::os::fd::{AsRawFd, FromRawFd};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{SystemTime, UNIX_EPOCH};
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xinput::{ConnectionExt as _, Device, EventMask, XIEventMask};
use x11rb::protocol::xproto::{ConnectionExt as _, Window};
use x11rb::reexports::x11rb_protocol::parse_display::{ConnectAddress, parse_display};
use x11rb::reexports::x11rb_protocol::xauth::get_auth;
use x11rb::rust_connection::{DefaultStream, PollMode, RustConnection, Stream};
use x11rb::utils::RawFdContainer;

/// How long to wait for the X server each time, in milliseconds. A server that takes longer hangs for the program as well.
const PATIENCE: i32 = 200;
/// The most windows of the program that are remembered.
const WINDOWS: usize = 16;
/// The most levels of nested windows that are searched.
const DEPTH: usize = 16;
/// The most events handled per frame; the rest wait for the next one.
const EVENTS: usize = 256;
const CONTROL: [u32; 2] = [0xffe3, 0xffe4];
const ALT: [u32; 2] = [0xffe9, 0xffea];

type Fault = Box<dyn Error + Send + Sync>;

enum State {
    Unopened,
    Open(Box<Keyboard>),
    Closed,
}

struct Keyboard {
    connection: RustConnection<Wire>,
    root: Window,
    /// The process that opened the connection. After fork, a child has our memory and our descriptors, and must not use them.
    pid: u32,
    /// The first keysym of each keycode.
    keysyms: Vec<u32>,
    /// Whether each keycode is down.
    down: [bool; 256],
    windows: Vec<Window>,
    wanted: Option<Wanted>,
    /// A picture is being taken.
    waits: bool,
}

static STATE: Mutex<State> = Mutex::new(State::Unopened);

fn wanted() -> bool {
    config().is_some_and(|config| config.keys)
}

/// Before a frame is shown: gives the layer the picture that a key asked for.
pub(crate) fn before(layer: &mut Layer) {
    if !wanted() {
        return;
    }
    if let Some(mut state) = free(&STATE)
        && let State::Open(keyboard) = &mut *state
        && keyboard.pid == std::process::id()
        && !layer.awaits_picture()
        && let Some(wanted) = keyboard.wanted.take()
    {
        layer.picture(wanted);
        keyboard.waits = true;
    }
}

/// After a frame was shown: handles keys, so that changes apply to the whole next frame. `window` returns the display's name and the window.
pub(crate) fn after(layer: &mut Layer, window: impl FnOnce() -> Option<(String, Window)>) {
    if !wanted() {
        return;
    }
    let Some(mut state) = free(&STATE) else {
        return;
    };
    let outcome = match &mut *state {
        State::Closed => return,
        State::Unopened => match window() {
            None => Err("the program shows no window by GLX".into()),
            Some((display, window)) => Keyboard::open(&display).map(|mut keyboard| {
                keyboard.remember_window(window);
                *state = State::Open(Box::new(keyboard));
            }),
        },
        State::Open(keyboard) if keyboard.pid != std::process::id() => return,
        State::Open(keyboard) => {
            if let Some((_, window)) = window() {
                keyboard.remember_window(window);
            }
            keyboard.handle_events(layer)
        }
    };
    if let Err(fault) = outcome {
        let sentence = format!("keys are off: {fault}; use `manyview ctl` with --control instead");
        say(&sentence);
        layer.note(sentence);
        *state = State::Closed;
    }
}

impl Keyboard {
    fn open(display: &str) -> Result<Self, Fault> {
        let parsed = parse_display(Some(display))?;
        let mut fault: Fault = "the X server is on another machine".into();
        for address in parsed.connect_instruction() {
            if !matches!(address, ConnectAddress::Socket(_)) {
                continue;
            }
            let (stream, (family, peer)) = match DefaultStream::connect(&address) {
                Ok(connected) => connected,
                Err(error) => {
                    fault = error.into();
                    continue;
                }
            };
            // Without an authorisation key the server may still accept us.
            let key = get_auth(family, &peer, parsed.display).ok().flatten();
            let (name, data) = key.unwrap_or_default();
            let screen = usize::from(parsed.screen);
            let wire = Wire::new(&stream)?;
            drop(stream);
            let connection =
                RustConnection::connect_to_stream_with_auth_info(wire, screen, name, data)?;
            return Self::watch(connection, screen);
        }
        Err(fault)
    }

    fn watch(connection: RustConnection<Wire>, screen: usize) -> Result<Self, Fault> {
        let root = connection
            .setup()
            .roots
            .get(screen)
            .map(|screen| screen.root);
        let root = root.ok_or("the X screen is gone")?;
        let version = connection.xinput_xi_query_version(2, 1)?.reply()?;
        if version.major_version < 2 {
            return Err("the X server has no XInput 2".into());
        }
        let mask = EventMask {
            deviceid: Device::ALL_MASTER.into(),
            mask: vec![XIEventMask::RAW_KEY_PRESS | XIEventMask::RAW_KEY_RELEASE],
        };
        connection.xinput_xi_select_events(root, &[mask])?.check()?;
        let mut keyboard = Keyboard {
            root,
            pid: std::process::id(),
            keysyms: Vec::new(),
            down: [false; 256],
            windows: Vec::new(),
            wanted: None,
            waits: false,
            connection,
        };
        keyboard.read_mapping()?;
        let held = keyboard.connection.query_keymap()?.reply()?.keys;
        for (code, down) in keyboard.down.iter_mut().enumerate() {
            *down = held
                .get(code / 8)
                .is_some_and(|byte| byte >> (code % 8) & 1 == 1);
        }
        Ok(keyboard)
    }

    /// Reads the keyboard mapping, at the start and after a change.
    fn read_mapping(&mut self) -> Result<(), Fault> {
        let setup = self.connection.setup();
        let first = setup.min_keycode;
        let count = setup.max_keycode.saturating_sub(first).saturating_add(1);
        let mapping = self
            .connection
            .get_keyboard_mapping(first, count)?
            .reply()?;
        let per_code = usize::from(mapping.keysyms_per_keycode).max(1);
        let known = mapping
            .keysyms
            .chunks(per_code)
            .filter_map(|all| all.first());
        self.keysyms = vec![0; first.into()];
        self.keysyms.extend(known);
        Ok(())
    }

    fn remember_window(&mut self, window: Window) {
        if !self.windows.contains(&window) {
            if self.windows.len() >= WINDOWS {
                self.windows.remove(0);
            }
            self.windows.push(window);
        }
    }

    /// Handles the keys that were pressed since the last frame.
    fn handle_events(&mut self, layer: &mut Layer) -> Result<(), Fault> {
        if self.waits {
            match layer.pictured() {
                Some(Pictured::Later(wanted)) => self.wanted = Some(wanted),
                Some(Pictured::Done(Ok(
                    Answer::Captured { path, .. } | Answer::Explained { path, .. },
                ))) => {
                    say(&format!("wrote {}", path.display()));
                }
                Some(Pictured::Done(Err(error))) => say(&error.to_string()),
                Some(Pictured::Done(Ok(_))) | None => {}
            }
            self.waits = false;
        }
        for _ in 0..EVENTS {
            match self.connection.poll_for_event()? {
                None => break,
                Some(Event::XinputRawKeyRelease(event)) => self.hold(event.detail, false),
                Some(Event::XinputRawKeyPress(event)) => {
                    self.hold(event.detail, true);
                    let keysym = self.keysyms.get(event.detail as usize).copied();
                    if let Some(key) = keysym.and_then(keys::Key::of)
                        && self.held(CONTROL)
                        && self.held(ALT)
                        && self.focused()?
                    {
                        self.press(key, layer);
                    }
                }
                Some(Event::MappingNotify(_)) => self.read_mapping()?,
                Some(_) => {}
            }
        }
        Ok(())
    }

    fn hold(&mut self, code: u32, down: bool) {
        if let Some(key) = self.down.get_mut(code as usize) {
            *key = down;
        }
    }

    /// Whether one of two keys is down.
    fn held(&self, wanted: [u32; 2]) -> bool {
        let mut keys = self.keysyms.iter().zip(self.down);
        keys.any(|(keysym, down)| down && wanted.contains(keysym))
    }

    /// Whether the keyboard focus is at the program: at one of its windows, or at one that encloses it or lies within it.
    fn focused(&self) -> Result<bool, Fault> {
        const NONE: Window = 0;
        const POINTER_ROOT: Window = 1;
        let mut focus = self.connection.get_input_focus()?.reply()?.focus;
        if focus == POINTER_ROOT || focus == self.root {
            focus = self.connection.query_pointer(self.root)?.reply()?.child;
        }
        if focus == NONE {
            return Ok(false);
        }
        let around = self.around(focus)?;
        for &window in &self.windows {
            if around.contains(&window) || self.around(window)?.contains(&focus) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// A window and its ancestors, without the root.
    fn around(&self, mut window: Window) -> Result<Vec<Window>, Fault> {
        let mut found = Vec::new();
        while window != self.root && window != 0 && found.len() < DEPTH {
            found.push(window);
            // A window that no longer exists has no parent.
            window = match self.connection.query_tree(window)?.reply() {
                Ok(tree) => tree.parent,
                Err(x11rb::errors::ReplyError::X11Error(_)) => 0,
                Err(error) => return Err(error.into()),
            };
        }
        Ok(found)
    }

    fn press(&mut self, key: keys::Key, layer: &mut Layer) {
        let before = layer.live();
        match layer.press(key, picture) {
            Ok(Ok(_)) => live::changed(layer, before),
            Ok(Err(wanted)) => self.wanted = Some(wanted),
            Err(error) => say(&error.to_string()),
        }
    }
}

/// The path of the picture of a frame, in the program's working directory.
fn picture(frame: u64) -> PathBuf {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let program = program::this_program().unwrap_or_default();
    let name = keys::picture_name(&program, now.unwrap_or_default().as_secs(), frame);
    std::env::current_dir().unwrap_or_default().join(name)
}

/// The connection to the X server. It raises no SIGPIPE, waits with a limit, and is not used once the program has closed its descriptor.
struct Wire(Checked<UnixStream>);

impl Wire {
    fn new(stream: &DefaultStream) -> io::Result<Self> {
        // The program may have closed stdin, stdout or stderr. A copy gets a number above those of the three.
        // SAFETY: a descriptor of ours; the new one belongs to nobody else.
        let copy = unsafe {
            let copy = libc::fcntl(stream.as_raw_fd(), libc::F_DUPFD_CLOEXEC, 3);
            if copy < 0 {
                return Err(io::Error::last_os_error());
            }
            UnixStream::from_raw_fd(copy)
        };
        copy.set_nonblocking(true)?;
        Ok(Wire(Checked::new(copy)?))
    }

    fn get(&self) -> io::Result<&UnixStream> {
        let closed = || io::Error::other("the program has closed the connection to the X server");
        self.0.get().ok_or_else(closed)
    }
}

impl Stream for Wire {
    fn poll(&self, mode: PollMode) -> io::Result<()> {
        let mut events = 0;
        if mode.readable() {
            events |= libc::POLLIN;
        }
        if mode.writable() {
            events |= libc::POLLOUT;
        }
        let mut wanted = libc::pollfd {
            fd: self.get()?.as_raw_fd(),
            events,
            revents: 0,
        };
        // SAFETY: one descriptor of ours.
        match unsafe { libc::poll(&raw mut wanted, 1, PATIENCE) } {
            0 => Err(io::ErrorKind::TimedOut.into()),
            1.. => Ok(()),
            _ => match io::Error::last_os_error() {
                // The caller tries again.
                error if error.kind() == io::ErrorKind::Interrupted => Ok(()),
                error => Err(error),
            },
        }
    }

    fn read(&self, buffer: &mut [u8], _: &mut Vec<RawFdContainer>) -> io::Result<usize> {
        io::Read::read(&mut self.get()?, buffer)
    }

    fn write(&self, bytes: &[u8], _: &mut Vec<RawFdContainer>) -> io::Result<usize> {
        socket::send(self.get()?, bytes)
    }
}
