//! The program: its arguments, its window, its keys and mouse.

mod arguments;
mod frames;
mod input;
mod title;
mod viewpoint;
mod window;

pub use arguments::Arguments;

use crate::load::Loading;
use crate::read;
use frames::Frames;
use input::{Input, Wish};
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
}

/// After something has happened it draws as fast as it can for so long.
const ACTIVE: Duration = Duration::from_secs(1);
/// A still picture is drawn again so often: the display server, or what shows it, may have changed.
const STILL: Duration = Duration::from_millis(250);

/// Shows a file until its window is closed.
///
/// # Errors
/// The file cannot be read from its start, or there can be no window.
pub fn run(arguments: &Arguments) -> Result<(), AppError> {
    let threads = available_parallelism().map_or(1, NonZero::get);
    let cloud = read::open(&arguments.file, threads)?;
    let up = arguments.up.unwrap_or(cloud.up);
    // A half in memory, a half in that of the graphics card.
    let memory = arguments.memory / 2;
    let loading = Loading::start(cloud, memory);
    let no = |error: winit::error::EventLoopError| AppError::Window(error.to_string());
    let event_loop = EventLoop::new().map_err(no)?;
    let now = Instant::now();
    let mut app = App {
        frames: Frames::new(loading, up, arguments, threads),
        input: Input::default(),
        arguments,
        window: None,
        active: now + ACTIVE,
        drawn: now,
        error: None,
    };
    event_loop.run_app(&mut app).map_err(no)?;
    app.error
        .map_or(Ok(()), |error| Err(AppError::Window(error)))
}

struct App<'a> {
    arguments: &'a Arguments,
    frames: Frames,
    input: Input,
    window: Option<Window>,
    /// Draws as fast as it can until then.
    active: Instant,
    /// When the last frame was drawn.
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
            Wish::Camera(change) => self.frames.change(change),
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
        let title = self.frames.draw(window)?;
        window.swap()?;
        self.frames.took(start.elapsed());
        if let Some(title) = title {
            window.set_title(&title);
        }
        self.drawn = Instant::now();
        Ok(())
    }
}

impl ApplicationHandler for App<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.window.is_some() {
            return;
        }
        let title = self.frames.title();
        let made = Window::open(event_loop, &title, self.arguments.size);
        match made.and_then(|window| self.frames.prepare(&window).map(|()| window)) {
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
        let busy = self.frames.is_busy() || now < self.active;
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
