//! The monitors of a compositor.
#![forbid(unsafe_code)]

use super::State;
use crate::window::Monitor;
use wayland_client::globals::GlobalList;
use wayland_client::protocol::wl_output::{self, Mode, Transform, WlOutput};
use wayland_client::{Connection, Dispatch, Proxy, QueueHandle, WEnum, delegate_noop};
use wayland_protocols::xdg::xdg_output::zv1::client::zxdg_output_manager_v1::ZxdgOutputManagerV1;
use wayland_protocols::xdg::xdg_output::zv1::client::zxdg_output_v1::{self, ZxdgOutputV1};

/// The newest version that is understood.
const VERSION: u32 = 4;

/// What the compositor has said of a monitor.
pub(super) struct Output {
    pub(super) output: WlOutput,
    /// Its name: that of its connector where the compositor tells.
    pub(super) name: String,
    at: (i32, i32),
    /// Pixels before it is turned.
    mode: (u32, u32),
    /// It is turned by a quarter.
    turned: bool,
    /// Pixels on the monitor for one of the desk, in whole numbers.
    pub(super) scale: i32,
    /// Width and height on the desk, where the compositor tells.
    desk: Option<(u32, u32)>,
}

/// Asks for all monitors.
pub(super) fn ask(globals: &GlobalList, handle: &QueueHandle<State>) -> Vec<Output> {
    let known = globals.contents().clone_list();
    let known = known
        .iter()
        .filter(|global| global.interface == WlOutput::interface().name);
    // Its second version tells names, which older compositors tell nowhere else.
    let namer: Option<ZxdgOutputManagerV1> = globals.bind(handle, 1..=3, ()).ok();
    let all = known.enumerate().map(|(number, global)| {
        let version = global.version.min(VERSION);
        let output = globals
            .registry()
            .bind(global.name, version, handle, number);
        if let Some(namer) = &namer {
            namer.get_xdg_output(&output, handle, number);
        }
        Output::new(output, number)
    });
    all.collect()
}

impl Output {
    fn new(output: WlOutput, number: usize) -> Self {
        Self {
            output,
            name: format!("output-{number}"),
            at: (0, 0),
            mode: (0, 0),
            turned: false,
            scale: 1,
            desk: None,
        }
    }

    /// See [`Monitor::density`].
    fn density(&self) -> u32 {
        let (width, height) = self.mode;
        let across = if self.turned { height } else { width };
        let thousands = |(desk, _): (u32, u32)| (across * 1000 + desk / 2) / desk;
        let told = self.desk.filter(|(desk, _)| *desk > 0).map(thousands);
        told.unwrap_or_else(|| self.scale.max(1) as u32 * 1000)
    }

    pub(super) fn monitor(&self) -> Monitor {
        let (width, height) = self.mode;
        let small = |value: i32| value.clamp(i16::MIN.into(), i16::MAX.into()) as i16;
        Monitor {
            name: self.name.clone(),
            at: (small(self.at.0), small(self.at.1)),
            size: if self.turned {
                (height, width)
            } else {
                (width, height)
            },
            primary: false,
            density: self.density(),
            edid: Vec::new(),
        }
    }
}

impl Dispatch<WlOutput, usize> for State {
    fn event(
        state: &mut Self,
        _: &WlOutput,
        event: wl_output::Event,
        number: &usize,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        let Some(output) = state.outputs.get_mut(*number) else {
            return;
        };
        match event {
            wl_output::Event::Geometry {
                x, y, transform, ..
            } => {
                output.at = (x, y);
                output.turned = matches!(
                    transform,
                    WEnum::Value(
                        Transform::_90
                            | Transform::_270
                            | Transform::Flipped90
                            | Transform::Flipped270
                    )
                );
            }
            wl_output::Event::Mode {
                flags: WEnum::Value(flags),
                width,
                height,
                ..
            } if flags.contains(Mode::Current) => {
                output.mode = (width.max(0) as u32, height.max(0) as u32);
            }
            wl_output::Event::Scale { factor } => output.scale = factor,
            wl_output::Event::Name { name } => output.name = name,
            _ => {}
        }
    }
}

impl Dispatch<ZxdgOutputV1, usize> for State {
    fn event(
        state: &mut Self,
        _: &ZxdgOutputV1,
        event: zxdg_output_v1::Event,
        number: &usize,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
        let Some(output) = state.outputs.get_mut(*number) else {
            return;
        };
        match event {
            zxdg_output_v1::Event::Name { name } => output.name = name,
            zxdg_output_v1::Event::LogicalSize { width, height } => {
                output.desk = Some((width.max(0) as u32, height.max(0) as u32));
            }
            _ => {}
        }
    }
}

delegate_noop!(State: ZxdgOutputManagerV1);
