//! Whole pictures in a window, one for each refresh of its monitor: the X server changes from one to the next while the monitor draws nothing.
//!
//! Pictures are put into pixmaps of the server and given to the Present extension, which says when a pixmap is free again. A server without Present
//! gets the picture at once.
#![forbid(unsafe_code)]

use super::{DEPTH, Window};
use crate::window::WindowError;
use crate::window::surface::Place;
use x11rb::connection::{Connection, RequestConnection};
use x11rb::protocol::Event as XEvent;
use x11rb::protocol::present::{self, ConnectionExt as _, EventMask as PresentMask};
use x11rb::protocol::xproto::{ChangeGCAux, ConnectionExt as _, Pixmap, Rectangle};

/// One that is shown, one that is to be shown next, and one that is written.
const BUFFERS: usize = 3;

#[derive(Debug)]
struct Buffer {
    pixmap: Pixmap,
    /// The server still reads it.
    busy: bool,
    /// Where its picture is; it is black elsewhere.
    place: Option<Place>,
}

/// The pixmaps of a window.
#[derive(Debug)]
pub(super) struct Presenter {
    buffers: Vec<Buffer>,
    /// The one that was given last.
    last: Option<usize>,
    /// The server has Present.
    paced: bool,
    serial: u32,
}

impl Presenter {
    pub(super) fn new(window: &Window) -> Result<Self, WindowError> {
        let c = &window.connection;
        let paced = c
            .extension_information(present::X11_EXTENSION_NAME)?
            .is_some();
        if paced {
            c.present_query_version(1, 0)?.reply()?;
            c.present_select_input(c.generate_id()?, window.id, PresentMask::IDLE_NOTIFY)?;
        }
        let (width, height) = window.monitor.size;
        let mut buffers = Vec::new();
        for _ in 0..BUFFERS {
            let pixmap = c.generate_id()?;
            c.create_pixmap(DEPTH, pixmap, window.id, width as u16, height as u16)?;
            buffers.push(Buffer {
                pixmap,
                busy: false,
                place: None,
            });
        }
        Ok(Self {
            buffers,
            last: None,
            paced,
            serial: 0,
        })
    }

    /// Whether [`Presenter::buffer`] has a pixmap.
    pub(super) fn is_free(&self) -> bool {
        let mut all = self.buffers.iter().enumerate();
        all.any(|(at, buffer)| !buffer.busy && Some(at) != self.last)
    }

    /// A pixmap that a picture can be put into at this place; it is black elsewhere. None while the server reads all of them.
    pub(super) fn buffer(
        &mut self,
        window: &Window,
        place: Place,
    ) -> Result<Option<(usize, Pixmap)>, WindowError> {
        let last = self.last;
        let mut all = self.buffers.iter_mut().enumerate();
        // The last one stays as it is, for parts of the window that are uncovered.
        let Some((number, buffer)) = all.find(|(at, buffer)| !buffer.busy && Some(*at) != last)
        else {
            return Ok(None);
        };
        if buffer.place != Some(place) {
            let (c, (width, height)) = (&window.connection, window.monitor.size);
            let whole = Rectangle {
                x: 0,
                y: 0,
                width: width as u16,
                height: height as u16,
            };
            c.change_gc(window.gc, &ChangeGCAux::new().foreground(window.black))?;
            c.poly_fill_rectangle(buffer.pixmap, window.gc, &[whole])?;
            buffer.place = Some(place);
        }
        Ok(Some((number, buffer.pixmap)))
    }

    /// Shows a pixmap from the next refresh on.
    pub(super) fn show(&mut self, window: &Window, number: usize) -> Result<(), WindowError> {
        self.last = Some(number);
        if !self.paced {
            return self.show_again(window);
        }
        let buffer = &mut self.buffers[number];
        buffer.busy = true;
        self.serial = self.serial.wrapping_add(1);
        window.connection.present_pixmap(
            window.id,
            buffer.pixmap,
            self.serial,
            x11rb::NONE,
            x11rb::NONE,
            0,
            0,
            x11rb::NONE,
            x11rb::NONE,
            x11rb::NONE,
            present::Option::NONE.into(),
            0,
            0,
            0,
            &[],
        )?;
        Ok(())
    }

    /// Shows the last pixmap in all parts of the window.
    pub(super) fn show_again(&self, window: &Window) -> Result<(), WindowError> {
        let Some(buffer) = self.last.and_then(|number| self.buffers.get(number)) else {
            return Ok(());
        };
        let (width, height) = window.monitor.size;
        let c = &window.connection;
        let (width, height) = (width as u16, height as u16);
        c.copy_area(
            buffer.pixmap,
            window.id,
            window.gc,
            0,
            0,
            0,
            0,
            width,
            height,
        )?;
        Ok(())
    }

    /// Notes that a pixmap is free again.
    pub(super) fn handle(&mut self, event: &XEvent) {
        if let XEvent::PresentIdleNotify(idle) = event {
            let mut all = self.buffers.iter_mut();
            if let Some(buffer) = all.find(|buffer| buffer.pixmap == idle.pixmap) {
                buffer.busy = false;
            }
        }
    }
}
