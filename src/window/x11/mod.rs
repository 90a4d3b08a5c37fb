//! A window of an X server that covers a monitor and shows a picture pixel by pixel, and reports the keys that are pressed in it.
//!
//! It uses plain X11 without a toolkit, because pixels have to reach the panel unchanged. The picture is the window's background, so the
//! server itself redraws parts that were covered.
#![forbid(unsafe_code)]

mod monitors;
mod present;
mod surface;
mod wake;

pub(super) use monitors::monitors;
pub use wake::wake;

use super::surface::Surface;
use super::{Monitor, WindowError, monitor};
use image::RgbImage;
use std::borrow::Cow;
use x11rb::connection::Connection;
use x11rb::image::{BitsPerPixel, Image, ImageOrder, PixelLayout, ScanlinePad};
use x11rb::protocol::Event as XEvent;
use x11rb::protocol::xproto::{
    AtomEnum, ChangeWindowAttributesAux, ConfigureWindowAux, ConnectionExt as _, CreateGCAux,
    CreateWindowAux, EventMask, Gcontext, GetKeyboardMappingReply, InputFocus, KeyButMask, Pixmap,
    PropMode, StackMode, Window as Id, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

x11rb::atom_manager! {
    /// Names of the protocols with window managers.
    Atoms: AtomsCookie {
        WM_PROTOCOLS,
        WM_DELETE_WINDOW,
        _NET_WM_STATE,
        _NET_WM_STATE_FULLSCREEN,
        _NET_WM_BYPASS_COMPOSITOR,
        _NET_SUPPORTING_WM_CHECK,
        _MOTIF_WM_HINTS,
        UTF8_STRING,
        _NET_WM_NAME,
        _NET_WM_USER_TIME,
    }
}

const DEPTH: u8 = 24;

/// An event of the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A key was pressed: its keysym without Shift, and whether Shift is held.
    Key(u32, bool),
    /// The window was closed.
    Close,
}

/// An open window.
#[derive(Debug)]
pub struct Window {
    connection: RustConnection,
    id: Id,
    gc: Gcontext,
    atoms: Atoms,
    layout: PixelLayout,
    /// The colour that is black.
    black: u32,
    monitor: Monitor,
    root: Id,
    keys: GetKeyboardMappingReply,
}

impl Window {
    /// Opens a black window over a monitor: the `wanted` one by name or number, else one of the panel's size, else the primary one.
    pub fn open(
        title: &str,
        wanted: Option<&str>,
        panel: Option<(u32, u32)>,
    ) -> Result<Self, WindowError> {
        let window = Self::make(title, ("--monitor", wanted), panel)?;
        window.connection.map_window(window.id)?;
        window.focus()?;
        Ok(window)
    }

    /// The same without the keyboard's focus, named by `--panel`.
    fn passive(
        title: &str,
        wanted: Option<&str>,
        panel: Option<(u32, u32)>,
    ) -> Result<Self, WindowError> {
        let window = Self::make(title, ("--panel", wanted), panel)?;
        let (c, id) = (&window.connection, window.id);
        // The flag says that the field for input is given: the window takes none.
        let mut hints = vec![0_u32; 9];
        hints[0] = 1;
        let kind = u32::from(AtomEnum::WM_HINTS);
        c.change_property32(PropMode::REPLACE, id, kind, AtomEnum::WM_HINTS, &hints)?;
        let (time, cardinal) = (window.atoms._NET_WM_USER_TIME, AtomEnum::CARDINAL);
        c.change_property32(PropMode::REPLACE, id, time, cardinal, &[0])?;
        c.map_window(id)?;
        c.flush()?;
        Ok(window)
    }

    /// Makes a window over a monitor, which is not on the screen yet.
    fn make(
        title: &str,
        wanted: (&'static str, Option<&str>),
        panel: Option<(u32, u32)>,
    ) -> Result<Self, WindowError> {
        let (connection, number) = RustConnection::connect(None)?;
        let screen = connection.setup().roots.get(number).cloned();
        let screen = screen.ok_or(WindowError::Colours)?;
        let visuals = screen
            .allowed_depths
            .iter()
            .flat_map(|depth| &depth.visuals);
        let visual = visuals.copied().find(|v| v.visual_id == screen.root_visual);
        let layout = visual.and_then(|visual| PixelLayout::from_visual_type(visual).ok());
        let layout = layout.filter(|layout| layout.depth() == DEPTH);
        let layout = layout
            .filter(|_| screen.root_depth == DEPTH)
            .ok_or(WindowError::Colours)?;
        let monitor = monitor::choose(monitors::all(&connection, &screen)?, wanted, panel)?;
        let atoms = Atoms::new(&connection)?.reply()?;
        let (id, gc) = (connection.generate_id()?, connection.generate_id()?);
        let (width, height) = monitor.size;
        connection.create_window(
            DEPTH,
            id,
            screen.root,
            monitor.at.0,
            monitor.at.1,
            width as u16,
            height as u16,
            0,
            WindowClass::INPUT_OUTPUT,
            screen.root_visual,
            &CreateWindowAux::new()
                .background_pixel(screen.black_pixel)
                .event_mask(
                    EventMask::KEY_PRESS
                        | EventMask::STRUCTURE_NOTIFY
                        | EventMask::EXPOSURE
                        | EventMask::VISIBILITY_CHANGE,
                ),
        )?;
        connection.create_gc(gc, id, &CreateGCAux::new())?;
        let window = Self {
            keys: mapping(&connection)?,
            connection,
            id,
            gc,
            atoms,
            layout,
            black: screen.black_pixel,
            monitor,
            root: screen.root,
        };
        window.introduce(title)?;
        Ok(window)
    }

    /// Asks the window manager for a window over the whole monitor, without decorations and without a compositor.
    fn introduce(&self, title: &str) -> Result<(), WindowError> {
        let (c, id, atoms) = (&self.connection, self.id, &self.atoms);
        let string = AtomEnum::STRING;
        c.change_property8(
            PropMode::REPLACE,
            id,
            AtomEnum::WM_NAME,
            string,
            title.as_bytes(),
        )?;
        let (name, utf8) = (atoms._NET_WM_NAME, atoms.UTF8_STRING);
        c.change_property8(PropMode::REPLACE, id, name, utf8, title.as_bytes())?;
        let lists = [
            (
                atoms.WM_PROTOCOLS,
                AtomEnum::ATOM.into(),
                vec![atoms.WM_DELETE_WINDOW],
            ),
            (
                atoms._NET_WM_STATE,
                AtomEnum::ATOM.into(),
                vec![atoms._NET_WM_STATE_FULLSCREEN],
            ),
            (
                atoms._NET_WM_BYPASS_COMPOSITOR,
                AtomEnum::CARDINAL.into(),
                vec![1],
            ),
            // The flag says that the decorations field is given, which asks for none.
            (
                atoms._MOTIF_WM_HINTS,
                atoms._MOTIF_WM_HINTS,
                vec![2, 0, 0, 0, 0],
            ),
            // USPosition: the user has placed the window, so the window manager does not move it.
            (
                AtomEnum::WM_NORMAL_HINTS.into(),
                AtomEnum::WM_SIZE_HINTS.into(),
                {
                    let mut hints = vec![0; 18];
                    hints[0] = 1;
                    hints
                },
            ),
        ];
        for (property, kind, values) in lists {
            c.change_property32(PropMode::REPLACE, id, property, kind, &values)?;
        }
        Ok(())
    }

    /// Takes the keyboard focus where there is no window manager to give it.
    fn focus(&self) -> Result<(), WindowError> {
        let (c, root) = (&self.connection, self.root);
        let check = self.atoms._NET_SUPPORTING_WM_CHECK;
        let managed = c.get_property(false, root, check, AtomEnum::WINDOW, 0, 1)?;
        if managed.reply()?.value_len == 0 {
            c.set_input_focus(InputFocus::PARENT, self.id, x11rb::CURRENT_TIME)?;
        }
        c.flush()?;
        Ok(())
    }

    /// The monitor that the window covers.
    pub fn monitor(&self) -> &Monitor {
        &self.monitor
    }

    /// Shows a picture at the top left corner of the monitor. The rest of the window is black; a larger picture is clipped.
    pub fn show(&mut self, picture: &RgbImage) -> Result<(), WindowError> {
        let (width, height) = self.monitor.size;
        let mut data = vec![0; width as usize * height as usize * 4];
        let rows = data.chunks_exact_mut(width as usize * 4);
        for (row, out) in picture.rows().zip(rows) {
            for (pixel, out) in row.zip(out.chunks_exact_mut(4)) {
                let [r, g, b] = pixel.0.map(|v| u16::from(v) * 0x101);
                out.copy_from_slice(&self.layout.encode((r, g, b)).to_le_bytes());
            }
        }
        let (c, id) = (&self.connection, self.id);
        let image = Image::new(
            width as u16,
            height as u16,
            ScanlinePad::Pad32,
            DEPTH,
            BitsPerPixel::B32,
            ImageOrder::LsbFirst,
            Cow::Owned(data),
        );
        // This fails on a screen whose pixels are not four bytes each.
        let image = image.map_err(|_| WindowError::Colours)?;
        let image = image.native(c.setup()).map_err(|_| WindowError::Colours)?;
        let pixmap = c.generate_id()?;
        c.create_pixmap(DEPTH, pixmap, id, width as u16, height as u16)?;
        image.put(c, pixmap, self.gc, 0, 0)?;
        let background = ChangeWindowAttributesAux::new().background_pixmap(pixmap);
        c.change_window_attributes(id, &background)?;
        c.clear_area(false, id, 0, 0, 0, 0)?;
        // The window keeps a reference of its own.
        c.free_pixmap(pixmap)?;
        c.sync()?;
        Ok(())
    }

    /// Puts it above the windows that cover it.
    fn raise(&self) -> Result<(), WindowError> {
        let above = ConfigureWindowAux::new().stack_mode(StackMode::ABOVE);
        self.connection.configure_window(self.id, &above)?;
        Ok(())
    }

    /// Whether the user or the server has closed the window.
    fn is_close(&self, event: &XEvent) -> bool {
        match event {
            XEvent::ClientMessage(message) => {
                message.data.as_data32()[0] == self.atoms.WM_DELETE_WINDOW
            }
            XEvent::DestroyNotify(_) => true,
            _ => false,
        }
    }

    /// Whether a pixel of the screen is blue, green, red and a byte without meaning.
    fn is_bgrx(&self) -> bool {
        let shown = [(0x1234, 0, 0), (0, 0x1234, 0), (0, 0, 0x1234)].map(|c| self.layout.encode(c));
        shown == [0x12 << 16, 0x12 << 8, 0x12]
    }

    /// Puts pixels of four bytes (blue, green, red, one without meaning) into a pixmap, at left and top.
    fn put(
        &self,
        pixmap: Pixmap,
        mut pixels: Vec<u8>,
        (width, height): (u16, u16),
        (x, y): (i16, i16),
    ) -> Result<(), WindowError> {
        for pixel in pixels.chunks_exact_mut(4) {
            let [b, g, r] = [pixel[0], pixel[1], pixel[2]].map(|v| u16::from(v) * 0x101);
            pixel.copy_from_slice(&self.layout.encode((r, g, b)).to_le_bytes());
        }
        let (c, pad) = (&self.connection, ScanlinePad::Pad32);
        let (bits, order) = (BitsPerPixel::B32, ImageOrder::LsbFirst);
        let image = Image::new(width, height, pad, DEPTH, bits, order, Cow::Owned(pixels));
        // This fails on a screen whose pixels are not four bytes each.
        let image = image.map_err(|_| WindowError::Colours)?;
        let image = image.native(c.setup()).map_err(|_| WindowError::Colours)?;
        image.put(c, pixmap, self.gc, x, y)?;
        Ok(())
    }

    /// Waits for the next event.
    pub fn wait(&mut self) -> Result<Event, WindowError> {
        loop {
            match self.connection.wait_for_event()? {
                XEvent::KeyPress(key) => {
                    let keys = &self.keys;
                    let first = self.connection.setup().min_keycode;
                    let at = usize::from(key.detail.saturating_sub(first))
                        * usize::from(keys.keysyms_per_keycode);
                    // The first keysym is the one without Shift.
                    if let Some(&keysym) = keys.keysyms.get(at) {
                        let shift = key.state.contains(KeyButMask::SHIFT);
                        return Ok(Event::Key(keysym, shift));
                    }
                }
                XEvent::MappingNotify(_) => self.keys = mapping(&self.connection)?,
                event if self.is_close(&event) => return Ok(Event::Close),
                _ => {}
            }
        }
    }
}

/// Opens the panel's window ([`Window::passive`]).
pub(super) fn panel(
    title: &str,
    wanted: Option<&str>,
    panel: Option<(u32, u32)>,
) -> Result<Box<dyn Surface>, WindowError> {
    let window = Window::passive(title, wanted, panel)?;
    Ok(Box::new(surface::PanelSurface::new(window)?))
}

fn mapping(connection: &RustConnection) -> Result<GetKeyboardMappingReply, WindowError> {
    let setup = connection.setup();
    let count = setup
        .max_keycode
        .saturating_sub(setup.min_keycode)
        .saturating_add(1);
    let reply = connection.get_keyboard_mapping(setup.min_keycode, count)?;
    Ok(reply.reply()?)
}
