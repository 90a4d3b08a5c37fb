//! The panel's window under X11. The server reads pictures from the file that programs write them to, where it can.
#![forbid(unsafe_code)]

use super::present::Presenter;
use super::{DEPTH, Window};
use crate::control::panel::PIXEL;
use crate::window::surface::{Picture, Seen, Surface};
use crate::window::{Monitor, WindowError};
use rustc_hash::FxHashMap;
use std::fs::File;
use std::os::fd::{AsFd, BorrowedFd};
use std::time::{Duration, Instant};
use x11rb::connection::Connection;
use x11rb::protocol::Event as XEvent;
use x11rb::protocol::shm::{ConnectionExt as _, Seg};
use x11rb::protocol::xproto::{ImageFormat, Pixmap, Visibility};
use x11rb::wrapper::ConnectionExt as _;

/// The shortest time between two times that the window puts itself above others.
const RAISE: Duration = Duration::from_secs(1);

pub(super) struct PanelSurface {
    window: Window,
    presenter: Presenter,
    /// Files of programs as the server knows them, without those that it cannot read.
    segments: FxHashMap<u32, Seg>,
    /// The number of the pixmap that holds what was taken.
    taken: Option<usize>,
    /// Another window covers it.
    covered: bool,
    /// When it was last put above others.
    raised: Option<Instant>,
}

impl PanelSurface {
    pub(super) fn new(window: Window) -> Result<Self, WindowError> {
        Ok(Self {
            presenter: Presenter::new(&window)?,
            window,
            segments: FxHashMap::default(),
            taken: None,
            covered: false,
            raised: None,
        })
    }
}

impl Surface for PanelSurface {
    fn monitor(&self) -> &Monitor {
        &self.window.monitor
    }

    fn connection(&self) -> BorrowedFd<'_> {
        self.window.connection.stream().as_fd()
    }

    fn handle_events(&mut self) -> Result<bool, WindowError> {
        while let Some(event) = self.window.connection.poll_for_event()? {
            match event {
                XEvent::VisibilityNotify(seen) => {
                    self.covered = seen.state != Visibility::UNOBSCURED;
                }
                XEvent::Expose(_) => self.presenter.show_again(&self.window)?,
                event if self.window.is_close(&event) => return Ok(true),
                event => self.presenter.handle(&event),
            }
        }
        self.uncover()?;
        Ok(false)
    }

    fn flush(&mut self) -> Result<(), WindowError> {
        Ok(self.window.connection.flush()?)
    }

    fn attach(&mut self, program: u32, file: &File) {
        if let Some(segment) = attach(&self.window, file) {
            self.segments.insert(program, segment);
        }
    }

    fn detach(&mut self, program: u32) -> Result<(), WindowError> {
        if let Some(segment) = self.segments.remove(&program) {
            self.window.connection.shm_detach(segment)?;
        }
        Ok(())
    }

    fn is_free(&self) -> bool {
        self.presenter.is_free()
    }

    fn take(&mut self, picture: Picture<'_>, seen: Seen) -> Result<(), WindowError> {
        let Some((number, pixmap)) = self.presenter.buffer(&self.window, seen.place)? else {
            return Ok(());
        };
        if !seen.is_empty() {
            self.put(picture, seen, pixmap)?;
        }
        // The server has read the picture when it answers.
        self.window.connection.sync()?;
        self.taken = Some(number);
        Ok(())
    }

    fn show(&mut self) -> Result<(), WindowError> {
        match self.taken.take() {
            Some(number) => self.presenter.show(&self.window, number),
            None => Ok(()),
        }
    }
}

impl PanelSurface {
    /// Comes back above a program that covers all monitors, as full screen programs without a window manager do; seldom, because another program may do the
    /// same.
    fn uncover(&mut self) -> Result<(), WindowError> {
        if self.covered && self.raised.is_none_or(|at| at.elapsed() >= RAISE) {
            self.window.raise()?;
            self.raised = Some(Instant::now());
        }
        Ok(())
    }

    /// Puts what is seen of a picture into a pixmap.
    fn put(&self, picture: Picture<'_>, seen: Seen, pixmap: Pixmap) -> Result<(), WindowError> {
        let ([x, y], [width, height]) = seen.place;
        if let Some(&segment) = self.segments.get(&picture.program) {
            self.window.connection.shm_put_image(
                pixmap,
                self.window.gc,
                picture.frame.size[0],
                picture.frame.size[1],
                seen.from[0],
                seen.from[1],
                width,
                height,
                x as i16,
                y as i16,
                DEPTH,
                ImageFormat::Z_PIXMAP.into(),
                false,
                segment,
                picture.offset as u32,
            )?;
            return Ok(());
        }
        let row = usize::from(width) * PIXEL;
        let mut pixels = vec![0; row * usize::from(height)];
        for (number, out) in (0..).zip(pixels.chunks_exact_mut(row)) {
            picture.read(seen, number, out)?;
        }
        self.window
            .put(pixmap, pixels, (width, height), (x as i16, y as i16))
    }
}

/// Lets the X server read a file. None where it cannot, as over a network.
fn attach(window: &Window, file: &File) -> Option<Seg> {
    let c = &window.connection;
    let known = c.shm_query_version().ok()?.reply().ok()?;
    if (known.major_version, known.minor_version) < (1, 2) || !window.is_bgrx() {
        return None;
    }
    let segment = c.generate_id().ok()?;
    let file = file.as_fd().try_clone_to_owned().ok()?;
    c.shm_attach_fd(segment, file, false).ok()?.check().ok()?;
    Some(segment)
}
