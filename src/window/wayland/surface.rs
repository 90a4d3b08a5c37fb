//! The panel's window under Wayland: a layer over the monitor where the compositor has such (`wlr-layer-shell`), which takes no keys, else a window that
//! is full screen there.
#![forbid(unsafe_code)]

use super::buffers::{BUFFERS, Buffers};
use super::{Compositor, State, failed};
use crate::window::surface::{Picture, Seen, Surface};
use crate::window::{Monitor, WindowError};
use std::fs::File;
use std::os::fd::{AsFd, BorrowedFd};
use wayland_client::backend::WaylandError;
use wayland_client::globals::GlobalList;
use wayland_client::protocol::wl_callback::{self, WlCallback};
use wayland_client::protocol::wl_compositor::WlCompositor;
use wayland_client::protocol::wl_output::WlOutput;
use wayland_client::protocol::wl_region::WlRegion;
use wayland_client::protocol::wl_surface::WlSurface;
use wayland_client::{Connection, Dispatch, EventQueue, QueueHandle, delegate_noop};
use wayland_protocols::wp::viewporter::client::wp_viewport::WpViewport;
use wayland_protocols::wp::viewporter::client::wp_viewporter::WpViewporter;
use wayland_protocols::xdg::shell::client::xdg_surface::{self, XdgSurface};
use wayland_protocols::xdg::shell::client::xdg_toplevel::{self, XdgToplevel};
use wayland_protocols::xdg::shell::client::xdg_wm_base::{self, XdgWmBase};
use wayland_protocols_wlr::layer_shell::v1::client::zwlr_layer_shell_v1::{
    Layer, ZwlrLayerShellV1,
};
use wayland_protocols_wlr::layer_shell::v1::client::zwlr_layer_surface_v1::{
    self as layer_surface, Anchor, KeyboardInteractivity, ZwlrLayerSurfaceV1,
};

/// What the compositor has said of the window.
#[derive(Default)]
pub(super) struct WindowState {
    /// Which pictures it reads.
    pub(super) busy: [bool; BUFFERS],
    /// The last picture is not on the monitor yet.
    drawing: bool,
    /// Width and height on the desk.
    size: Option<(i32, i32)>,
    /// The number of a change of size that is not answered.
    configured: Option<u32>,
    closed: bool,
}

/// What the window is to the compositor.
enum Role {
    Layer(ZwlrLayerSurfaceV1),
    Window(XdgSurface, XdgToplevel),
}

pub(super) struct PanelSurface {
    queue: EventQueue<State>,
    state: State,
    monitor: Monitor,
    surface: WlSurface,
    viewport: Option<WpViewport>,
    role: Role,
    buffers: Buffers,
    /// The number of the picture that was taken.
    taken: Option<usize>,
    /// Kept open with the queue.
    _connection: Connection,
}

impl PanelSurface {
    pub(super) fn open(
        compositor: Compositor,
        title: &str,
        monitor: Monitor,
    ) -> Result<Self, WindowError> {
        let Compositor {
            connection,
            globals,
            queue,
            state,
        } = compositor;
        let handle = queue.handle();
        let chosen = state
            .outputs
            .iter()
            .find(|output| output.name == monitor.name);
        let output = chosen.ok_or_else(|| failed("the monitor is gone"))?;
        let compositor: WlCompositor = globals.bind(&handle, 4..=4, ()).map_err(failed)?;
        let surface = compositor.create_surface(&handle, ());
        // Clicks go to what is below.
        let nothing = compositor.create_region(&handle, ());
        surface.set_input_region(Some(&nothing));
        nothing.destroy();
        let viewporter: Option<WpViewporter> = globals.bind(&handle, 1..=1, ()).ok();
        let viewport = viewporter.map(|all| all.get_viewport(&surface, &handle, ()));
        if viewport.is_none() {
            surface.set_buffer_scale(output.scale);
        }
        let role = Role::new(&globals, &handle, (&surface, &output.output), title)?;
        let shm = globals.bind(&handle, 1..=1, ()).map_err(failed)?;
        let buffers = Buffers::new(&shm, monitor.size, &handle)?;
        surface.commit();
        let mut window = Self {
            queue,
            state,
            monitor,
            surface,
            viewport,
            role,
            buffers,
            taken: None,
            _connection: connection,
        };
        while window.state.window.configured.is_none() && !window.state.window.closed {
            window
                .queue
                .blocking_dispatch(&mut window.state)
                .map_err(failed)?;
        }
        window.attach_buffer(0);
        window.acknowledge();
        window.flush()?;
        Ok(window)
    }

    fn attach_buffer(&mut self, number: usize) {
        self.surface.attach(self.buffers.get(number), 0, 0);
        self.surface.damage_buffer(0, 0, i32::MAX, i32::MAX);
        self.state.window.busy[number] = true;
    }

    /// Takes the size on the desk that the compositor has given the window.
    fn acknowledge(&mut self) {
        let Some(serial) = self.state.window.configured.take() else {
            return;
        };
        match &self.role {
            Role::Layer(layer) => layer.ack_configure(serial),
            Role::Window(surface, _) => surface.ack_configure(serial),
        }
        if let (Some(viewport), Some((width, height))) = (&self.viewport, self.state.window.size) {
            viewport.set_destination(width, height);
        }
        self.surface.commit();
    }

    /// A picture that the compositor does not read.
    fn free(&self) -> Option<usize> {
        self.state.window.busy.iter().position(|busy| !busy)
    }
}

impl Role {
    fn new(
        globals: &GlobalList,
        handle: &QueueHandle<State>,
        (surface, output): (&WlSurface, &WlOutput),
        title: &str,
    ) -> Result<Self, WindowError> {
        if let Ok(shell) = globals.bind::<ZwlrLayerShellV1, _, _>(handle, 1..=1, ()) {
            let (layer, output) = (Layer::Overlay, Some(output));
            let layer = shell.get_layer_surface(surface, output, layer, title.into(), handle, ());
            layer.set_anchor(Anchor::all());
            // Over the bars of the desk as well.
            layer.set_exclusive_zone(-1);
            layer.set_keyboard_interactivity(KeyboardInteractivity::None);
            return Ok(Self::Layer(layer));
        }
        let base: XdgWmBase = globals.bind(handle, 1..=1, ()).map_err(failed)?;
        let window = base.get_xdg_surface(surface, handle, ());
        let toplevel = window.get_toplevel(handle, ());
        toplevel.set_title(title.into());
        toplevel.set_app_id(title.into());
        toplevel.set_fullscreen(Some(output));
        Ok(Self::Window(window, toplevel))
    }
}

impl Drop for PanelSurface {
    fn drop(&mut self) {
        match &self.role {
            Role::Layer(layer) => layer.destroy(),
            Role::Window(surface, toplevel) => {
                toplevel.destroy();
                surface.destroy();
            }
        }
        // Without a connection nothing is left to close.
        let _ = self.queue.flush();
    }
}

impl Surface for PanelSurface {
    fn monitor(&self) -> &Monitor {
        &self.monitor
    }

    fn connection(&self) -> BorrowedFd<'_> {
        self.queue.as_fd()
    }

    fn handle_events(&mut self) -> Result<bool, WindowError> {
        if let Some(guard) = self.queue.prepare_read() {
            match guard.read() {
                Ok(_) => {}
                Err(WaylandError::Io(error)) if error.kind() == std::io::ErrorKind::WouldBlock => {}
                Err(error) => return Err(failed(error)),
            }
        }
        self.queue
            .dispatch_pending(&mut self.state)
            .map_err(failed)?;
        self.acknowledge();
        Ok(self.state.window.closed)
    }

    fn flush(&mut self) -> Result<(), WindowError> {
        match self.queue.flush() {
            // The rest goes with the next one.
            Err(WaylandError::Io(error)) if error.kind() == std::io::ErrorKind::WouldBlock => {
                Ok(())
            }
            sent => sent.map_err(failed),
        }
    }

    fn attach(&mut self, _: u32, _: &File) {
        // Pictures are copied: until the compositor has read one, its program goes on writing.
    }

    fn detach(&mut self, _: u32) -> Result<(), WindowError> {
        Ok(())
    }

    fn is_free(&self) -> bool {
        !self.state.window.drawing && self.free().is_some()
    }

    fn take(&mut self, picture: Picture<'_>, seen: Seen) -> Result<(), WindowError> {
        if let Some(number) = self.free() {
            self.buffers.write(number, picture, seen)?;
            self.taken = Some(number);
        }
        Ok(())
    }

    fn show(&mut self) -> Result<(), WindowError> {
        if let Some(number) = self.taken.take() {
            self.attach_buffer(number);
            self.surface.frame(&self.queue.handle(), ());
            self.state.window.drawing = true;
            self.surface.commit();
        }
        Ok(())
    }
}

impl Dispatch<WlCallback, ()> for State {
    fn event(
        state: &mut Self,
        _: &WlCallback,
        _: wl_callback::Event,
        (): &(),
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        state.window.drawing = false;
    }
}

impl Dispatch<XdgWmBase, ()> for State {
    fn event(
        _: &mut Self,
        base: &XdgWmBase,
        event: xdg_wm_base::Event,
        (): &(),
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        if let xdg_wm_base::Event::Ping { serial } = event {
            base.pong(serial);
        }
    }
}

impl Dispatch<XdgSurface, ()> for State {
    fn event(
        state: &mut Self,
        _: &XdgSurface,
        event: xdg_surface::Event,
        (): &(),
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        if let xdg_surface::Event::Configure { serial } = event {
            state.window.configured = Some(serial);
        }
    }
}

impl Dispatch<XdgToplevel, ()> for State {
    fn event(
        state: &mut Self,
        _: &XdgToplevel,
        event: xdg_toplevel::Event,
        (): &(),
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        match event {
            xdg_toplevel::Event::Configure { width, height, .. } => {
                state.window.resize(width, height);
            }
            xdg_toplevel::Event::Close => state.window.closed = true,
            _ => {}
        }
    }
}

impl Dispatch<ZwlrLayerSurfaceV1, ()> for State {
    fn event(
        state: &mut Self,
        _: &ZwlrLayerSurfaceV1,
        event: layer_surface::Event,
        (): &(),
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        match event {
            layer_surface::Event::Configure {
                serial,
                width,
                height,
            } => {
                state.window.resize(width as i32, height as i32);
                state.window.configured = Some(serial);
            }
            layer_surface::Event::Closed => state.window.closed = true,
            _ => {}
        }
    }
}

impl WindowState {
    /// Without a size the window keeps that of its picture.
    fn resize(&mut self, width: i32, height: i32) {
        self.size = (width > 0 && height > 0).then_some((width, height));
    }
}

delegate_noop!(State: WlCompositor);
delegate_noop!(State: WlRegion);
delegate_noop!(State: ignore WlSurface);
delegate_noop!(State: WpViewporter);
delegate_noop!(State: WpViewport);
delegate_noop!(State: ZwlrLayerShellV1);
