//! The keyboard of an X server. Only answers of the server are waited for, with a short limit.
//!
//! A connection of our own selects the raw key events of the root window, which the server sends in addition to all events of the program.
//! Only a key of ours leads to a query: whether a window of the program has the focus.

use super::{Event as KeyEvent, Fault, modifiers};
use crate::socket::{self, Checked};
use manyview_core::config::Modifiers;
use std::io;
use std::os::fd::{AsRawFd, FromRawFd};
use std::os::unix::net::UnixStream;
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

pub(super) struct Keyboard {
    connection: RustConnection<Wire>,
    root: Window,
    /// The first keysym of each keycode.
    keysyms: Vec<u32>,
    /// Whether each keycode is down.
    down: [bool; 256],
    windows: Vec<Window>,
}

impl Keyboard {
    /// Opens a connection to the server of this name.
    pub(super) fn open(display: &str) -> Result<Self, Fault> {
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
            keysyms: Vec::new(),
            down: [false; 256],
            windows: Vec::new(),
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

    /// The program shows this window.
    pub(super) fn remember_window(&mut self, window: Window) {
        if !self.windows.contains(&window) {
            if self.windows.len() >= WINDOWS {
                self.windows.remove(0);
            }
            self.windows.push(window);
        }
    }

    /// The keys that were let go since the last frame, and those that were pressed while a window of the program had the focus, of which `bound` asks whether they are
    /// ours.
    pub(super) fn events(
        &mut self,
        bound: &dyn Fn(u32, Modifiers) -> bool,
    ) -> Result<Vec<KeyEvent>, Fault> {
        let mut found = Vec::new();
        for _ in 0..EVENTS {
            match self.connection.poll_for_event()? {
                None => break,
                Some(Event::XinputRawKeyRelease(event)) => {
                    self.hold(event.detail, false);
                    found.push(KeyEvent::Released(event.detail));
                }
                Some(Event::XinputRawKeyPress(event)) => {
                    let repeats = self.hold(event.detail, true);
                    let keysym = self.keysyms.get(event.detail as usize).copied();
                    let modifiers = modifiers(self.down());
                    if let Some(keysym) = keysym
                        && bound(keysym, modifiers)
                        && self.focused()?
                    {
                        found.push(KeyEvent::Pressed {
                            code: event.detail,
                            keysym,
                            modifiers,
                            repeats,
                        });
                    }
                }
                Some(Event::MappingNotify(_)) => self.read_mapping()?,
                Some(_) => {}
            }
        }
        Ok(found)
    }

    /// Notes whether a key is down, and returns whether it was before.
    fn hold(&mut self, code: u32, down: bool) -> bool {
        let key = self.down.get_mut(code as usize);
        key.is_some_and(|key| std::mem::replace(key, down))
    }

    /// The keysyms of the keys that are down.
    fn down(&self) -> impl Iterator<Item = u32> {
        let keys = self.keysyms.iter().zip(self.down);
        keys.filter_map(|(keysym, down)| down.then_some(*keysym))
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
