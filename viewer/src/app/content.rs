//! What a window shows.

use super::input::Change;
use super::window::Window;
use std::time::Duration;

/// A cloud of one kind. The window's context is current wherever a window is given.
pub(super) trait Content {
    /// Makes what is needed in the window's context.
    fn prepare(&mut self, window: &Window) -> Result<(), String>;

    /// Whether the next frame will be another.
    fn is_busy(&self) -> bool;

    /// The user wants to see it otherwise.
    fn change(&mut self, change: Change);

    /// Draws a frame, so long after the last one. Returns the title of the window, where it is another.
    fn draw(&mut self, window: &Window, since: Duration) -> Result<Option<String>, String>;

    /// A frame has taken so long.
    fn took(&mut self, time: Duration);

    /// The title of the window.
    fn title(&self) -> String;
}
