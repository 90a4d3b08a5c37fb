//! A window with an OpenGL context, of X or Wayland.

use glutin::config::{Config, ConfigTemplateBuilder, GlConfig};
use glutin::context::{
    ContextApi, ContextAttributesBuilder, NotCurrentGlContext, PossiblyCurrentContext, Version,
};
use glutin::display::{GetGlDisplay, GlDisplay};
use glutin::surface::{GlSurface, Surface, SwapInterval, WindowSurface};
use glutin_winit::{DisplayBuilder, GlWindow};
use std::num::NonZero;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::raw_window_handle::HasWindowHandle;
use winit::window::Fullscreen;

const DEPTH_BITS: u8 = 24;
/// The oldest OpenGL that has what the shaders need.
const VERSION: Version = Version { major: 3, minor: 3 };

/// The window, whose context is current on the thread that has opened it.
pub(super) struct Window {
    // In the order in which they are dropped.
    gl: glow::Context,
    surface: Surface<WindowSurface>,
    context: PossiblyCurrentContext,
    window: winit::window::Window,
}

impl Window {
    pub(super) fn open(
        event_loop: &ActiveEventLoop,
        title: &str,
        [width, height]: [u32; 2],
    ) -> Result<Self, String> {
        let attributes = winit::window::Window::default_attributes()
            .with_title(title)
            .with_inner_size(PhysicalSize::new(width, height));
        let template = ConfigTemplateBuilder::new().with_depth_size(DEPTH_BITS);
        let builder = DisplayBuilder::new().with_window_attributes(Some(attributes));
        // One sample: points are discs already, and each view is drawn in full.
        let fewest =
            |all: Box<dyn Iterator<Item = Config> + '_>| all.min_by_key(GlConfig::num_samples);
        let first = |all: Box<dyn Iterator<Item = Config> + '_>| fewest(all).ok_or(());
        let made = builder.build(event_loop, template, |all| {
            #[allow(
                clippy::expect_used,
                reason = "the builder calls this with at least one"
            )]
            first(all).expect("a configuration")
        });
        let (window, config) = made.map_err(|error| error.to_string())?;
        let window = window.ok_or("the display server gives none")?;
        let no = |error: glutin::error::Error| error.to_string();
        let display = config.display();
        let handle = window.window_handle().map_err(|error| error.to_string())?;
        let attributes = ContextAttributesBuilder::new()
            .with_context_api(ContextApi::OpenGl(Some(VERSION)))
            .build(Some(handle.as_raw()));
        // SAFETY: the window lives as long as the context.
        let context = unsafe { display.create_context(&config, &attributes) };
        let context = context.map_err(|error| format!("OpenGL 3.3 is missing: {error}"))?;
        let attributes = window.build_surface_attributes(Default::default());
        let attributes = attributes.map_err(|error| error.to_string())?;
        // SAFETY: the window lives as long as the surface.
        let surface = unsafe { display.create_window_surface(&config, &attributes) };
        let surface = surface.map_err(no)?;
        let context = context.make_current(&surface).map_err(no)?;
        // A driver without it draws as fast as it can.
        let _ = surface.set_swap_interval(&context, SwapInterval::Wait(NonZero::<u32>::MIN));
        // SAFETY: the context is current on this thread.
        let gl = unsafe {
            glow::Context::from_loader_function_cstr(|name| display.get_proc_address(name))
        };
        Ok(Self {
            gl,
            surface,
            context,
            window,
        })
    }

    pub(super) fn gl(&self) -> &glow::Context {
        &self.gl
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [u32; 2] {
        let size = self.window.inner_size();
        [size.width.max(1), size.height.max(1)]
    }

    pub(super) fn resize(&mut self, size: [u32; 2]) {
        if let [Some(width), Some(height)] = size.map(NonZero::new) {
            self.surface.resize(&self.context, width, height);
        }
    }

    pub(super) fn swap(&self) -> Result<(), String> {
        let swapped = self.surface.swap_buffers(&self.context);
        swapped.map_err(|error| error.to_string())
    }

    pub(super) fn request_redraw(&self) {
        self.window.request_redraw();
    }

    pub(super) fn set_title(&self, title: &str) {
        self.window.set_title(title);
    }

    pub(super) fn toggle_full_screen(&self) {
        let next = match self.window.fullscreen() {
            Some(_) => None,
            None => Some(Fullscreen::Borderless(None)),
        };
        self.window.set_fullscreen(next);
    }
}
