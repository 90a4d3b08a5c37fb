//! Windows of a Wayland compositor.
//!
//! A picture has as many pixels as its monitor, whatever the scale of the desk: the compositor is told the size that the window has on the desk
//! apart from that (viewporter), and then shows each pixel as it is.
#![forbid(unsafe_code)]

mod buffers;
mod outputs;
mod surface;

use super::surface::Surface;
use super::{Monitor, WindowError, monitor};
use outputs::Output;
use surface::PanelSurface;
use wayland_client::globals::{GlobalList, GlobalListContents, registry_queue_init};
use wayland_client::protocol::wl_registry::{self, WlRegistry};
use wayland_client::{Connection, Dispatch, EventQueue, QueueHandle};

/// A connection to a compositor, whose monitors are known.
pub(super) struct Compositor {
    connection: Connection,
    globals: GlobalList,
    queue: EventQueue<State>,
    state: State,
}

/// What the compositor has said.
#[derive(Default)]
struct State {
    outputs: Vec<Output>,
    window: surface::WindowState,
}

impl Compositor {
    /// Connects to the compositor of `WAYLAND_DISPLAY`. None where there is none.
    pub(super) fn find() -> Option<Result<Self, WindowError>> {
        std::env::var_os("WAYLAND_DISPLAY").filter(|name| !name.is_empty())?;
        let connection = Connection::connect_to_env().ok()?;
        Some(Self::ask(connection))
    }

    fn ask(connection: Connection) -> Result<Self, WindowError> {
        let (globals, mut queue) = registry_queue_init::<State>(&connection).map_err(failed)?;
        let mut state = State {
            outputs: outputs::ask(&globals, &queue.handle()),
            ..State::default()
        };
        queue.roundtrip(&mut state).map_err(failed)?;
        Ok(Self {
            connection,
            globals,
            queue,
            state,
        })
    }

    /// Its monitors.
    pub(super) fn monitors(&self) -> Vec<Monitor> {
        self.state.outputs.iter().map(Output::monitor).collect()
    }

    /// Opens a window over a monitor; see [`super::open`].
    pub(super) fn open(
        self,
        title: &str,
        wanted: Option<&str>,
        panel: Option<(u32, u32)>,
    ) -> Result<Box<dyn Surface>, WindowError> {
        let monitor = monitor::choose(self.monitors(), ("--panel", wanted), panel)?;
        Ok(Box::new(PanelSurface::open(self, title, monitor)?))
    }
}

fn failed(error: impl std::fmt::Display) -> WindowError {
    WindowError::Compositor(error.to_string())
}

impl Dispatch<WlRegistry, GlobalListContents> for State {
    fn event(
        _: &mut Self,
        _: &WlRegistry,
        _: wl_registry::Event,
        _: &GlobalListContents,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        // The list keeps itself. A monitor that comes later is not looked for.
    }
}
