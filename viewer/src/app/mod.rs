//! The program: its arguments, its window, its keys and mouse.

mod arguments;
mod content;
mod gaussians;
mod input;
mod points;
mod title;
mod viewpoint;
mod window;

pub use arguments::Arguments;

use crate::load::Loading;
use crate::quiet::quietly;
use crate::read::{self, Up};
use content::Content;
use gaussians::GaussianCloud;
use input::{Input, Wish};
use points::PointCloud;
use std::num::NonZero;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};
use window::Window;
use winit::application::ApplicationHandler;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::WindowId;

/// Why nothing is shown.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The file.
    #[error(transparent)]
    Read(#[from] read::ReadError),
    /// The window.
    #[error("there can be no window: {0}")]
    Window(String),
    /// What winit loads is not installed.
    #[error("there can be no window: {LIBRARIES}")]
    Libraries,
}

/// What it needs, and the packages of Debian.
const LIBRARIES: &str = "libX11, libX11-xcb, libXcursor, libXi or libxkbcommon-x11 is missing; install libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0";

/// After something has happened it draws as fast as it can for so long.
const ACTIVE: Duration = Duration::from_secs(1);
/// A still picture is drawn again so often: the display server, or what shows it, may have changed.
const STILL: Duration = Duration::from_millis(250);

/// Shows a file until its window is closed.
///
/// # Errors
/// The file cannot be read from its start, or there can be no window.
pub fn run(arguments: &Arguments) -> Result<(), AppError> {
    let content = content(arguments)?;
    let event_loop = event_loop()?;
    let now = Instant::now();
    let mut app = App {
        content,
        input: Input::default(),
        arguments,
        window: None,
        active: now + ACTIVE,
        drawn: now,
        error: None,
    };
    let ran = event_loop.run_app(&mut app);
    ran.map_err(|error| AppError::Window(error.to_string()))?;
    app.error
        .map_or(Ok(()), |error| Err(AppError::Window(error)))
}

/// Connects to the display server. Without a library that it needs, winit panics or names its own source.
fn event_loop() -> Result<EventLoop<()>, AppError> {
    match quietly(EventLoop::new) {
        Some(Ok(event_loop)) => Ok(event_loop),
        Some(Err(error)) if !error.to_string().contains("shared libraries") => {
            let text = error.to_string();
            let what = text.rsplit(": ").next().unwrap_or_default();
            Err(AppError::Window(what.to_owned()))
        }
        _ => Err(AppError::Libraries),
    }
}

/// What a file shows, by its kind.
fn content(arguments: &Arguments) -> Result<Box<dyn Content>, read::ReadError> {
    // A half in memory, a half in that of the graphics card.
    let memory = arguments.memory / 2;
    if let Some(gaussians) = read::gaussians(&arguments.file, memory)? {
        let up = arguments.up.unwrap_or(Up::MinusY);
        return Ok(Box::new(GaussianCloud::new(gaussians, up, arguments)));
    }
    let threads = available_parallelism().map_or(1, NonZero::get);
    let cloud = read::open(&arguments.file, threads)?;
    let up = arguments.up.unwrap_or(cloud.up);
    let loading = Loading::start(cloud, memory);
    Ok(Box::new(PointCloud::new(loading, up, arguments, threads)))
}

struct App<'a> {
    arguments: &'a Arguments,
    content: Box<dyn Content>,
    input: Input,
    window: Option<Window>,
    /// Draws as fast as it can until then.
    active: Instant,
    /// When the last frame was begun.
    drawn: Instant,
    error: Option<String>,
}

impl App<'_> {
    fn fail(&mut self, event_loop: &ActiveEventLoop, error: String) {
        self.error = Some(error);
        event_loop.exit();
    }

    fn handle(&mut self, event_loop: &ActiveEventLoop, wish: Wish) {
        self.active = Instant::now() + ACTIVE;
        match wish {
            Wish::Camera(change) => self.content.change(change),
            Wish::FullScreen => {
                if let Some(window) = &self.window {
                    window.toggle_full_screen();
                }
            }
            Wish::Quit => event_loop.exit(),
        }
    }

    fn draw(&mut self) -> Result<(), String> {
        let Some(window) = &mut self.window else {
            return Ok(());
        };
        let start = Instant::now();
        let title = self.content.draw(window, start - self.drawn)?;
        window.swap()?;
        self.content.took(start.elapsed());
        if let Some(title) = title {
            window.set_title(&title);
        }
        self.drawn = start;
        Ok(())
    }
}

impl ApplicationHandler for App<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window.is_some() {
            return;
        }
        let title = self.content.title();
        let made = Window::open(event_loop, &title, self.arguments.size);
        match made.and_then(|window| self.content.prepare(&window).map(|()| window)) {
            Ok(window) => {
                window.request_redraw();
                self.window = Some(window);
            }
            Err(error) => self.fail(event_loop, error),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let size = self.window.as_ref().map_or([1, 1], Window::size);
        let wish = match event {
            WindowEvent::CloseRequested => Some(Wish::Quit),
            WindowEvent::Resized(size) => {
                if let Some(window) = &mut self.window {
                    window.resize([size.width, size.height]);
                }
                self.active = Instant::now() + ACTIVE;
                None
            }
            WindowEvent::RedrawRequested => {
                if let Err(error) = self.draw() {
                    self.fail(event_loop, error);
                }
                None
            }
            WindowEvent::CursorMoved { position, .. } => self
                .input
                .moved([position.x as f32, position.y as f32], size[1]),
            WindowEvent::MouseInput { state, button, .. } => {
                self.input.button(button, state == ElementState::Pressed);
                None
            }
            WindowEvent::MouseWheel { delta, .. } => Some(Input::wheel(delta)),
            WindowEvent::KeyboardInput { event, .. } if event.state.is_pressed() => {
                Input::key(&event.logical_key)
            }
            _ => None,
        };
        if let Some(wish) = wish {
            self.handle(event_loop, wish);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        let busy = self.content.is_busy() || now < self.active;
        let next = self.drawn + STILL;
        if let (Some(window), true) = (&self.window, busy || now >= next) {
            window.request_redraw();
        }
        let wait = if busy {
            ControlFlow::Poll
        } else {
            ControlFlow::WaitUntil(next)
        };
        event_loop.set_control_flow(wait);
    }
}
