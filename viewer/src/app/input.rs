//! What keys and the mouse do.

use glam::Vec2;
use winit::event::{MouseButton, MouseScrollDelta};
use winit::keyboard::{Key, NamedKey};

/// What the user wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wish {
    Camera(Change),
    FullScreen,
    Quit,
}

/// A change of what is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// By a way in heights of the picture.
    Turn(Vec2),
    Shift(Vec2),
    /// By a factor.
    Approach(f32),
    /// The size of points, by a factor.
    Size(f32),
    /// As at the start.
    Whole,
}

/// A key turns by this part of the picture's height.
const STEP: f32 = 0.05;
/// A step of the wheel, or a key, comes closer by this factor.
const CLOSER: f32 = 1.15;
/// Pixels that a smooth wheel has for a step.
const WHEEL: f64 = 40.0;

/// The state of the mouse.
#[derive(Debug, Default)]
pub(super) struct Input {
    at: Option<[f32; 2]>,
    /// Left, and any other button.
    pressed: [bool; 2],
}

impl Input {
    pub(super) fn moved(&mut self, to: [f32; 2], height: u32) -> Option<Wish> {
        let from = self.at.replace(to)?;
        let way = (Vec2::from(to) - Vec2::from(from)) / height.max(1) as f32;
        match self.pressed {
            [true, _] => Some(Wish::Camera(Change::Turn(way))),
            [false, true] => Some(Wish::Camera(Change::Shift(way))),
            _ => None,
        }
    }

    pub(super) fn button(&mut self, button: MouseButton, is_pressed: bool) {
        self.pressed[usize::from(button != MouseButton::Left)] = is_pressed;
    }

    pub(super) fn wheel(delta: MouseScrollDelta) -> Wish {
        let steps = match delta {
            MouseScrollDelta::LineDelta(_, lines) => lines,
            MouseScrollDelta::PixelDelta(pixels) => (pixels.y / WHEEL) as f32,
        };
        Wish::Camera(Change::Approach(CLOSER.powf(steps)))
    }

    pub(super) fn key(key: &Key) -> Option<Wish> {
        let turn = |x, y| Change::Turn(Vec2::new(x, y) * STEP);
        let change = match key.as_ref() {
            Key::Named(NamedKey::ArrowLeft) => turn(-1.0, 0.0),
            Key::Named(NamedKey::ArrowRight) => turn(1.0, 0.0),
            Key::Named(NamedKey::ArrowUp) => turn(0.0, -1.0),
            Key::Named(NamedKey::ArrowDown) => turn(0.0, 1.0),
            Key::Named(NamedKey::PageUp) => Change::Approach(CLOSER),
            Key::Named(NamedKey::PageDown) => Change::Approach(1.0 / CLOSER),
            Key::Named(NamedKey::Home) => Change::Whole,
            Key::Character("+" | "=") => Change::Size(CLOSER),
            Key::Character("-") => Change::Size(1.0 / CLOSER),
            Key::Named(NamedKey::F11) => return Some(Wish::FullScreen),
            Key::Named(NamedKey::Escape) | Key::Character("q" | "Q") => return Some(Wish::Quit),
            _ => return None,
        };
        Some(Wish::Camera(change))
    }
}

#[cfg(test)]
mod tests {
    use super::{Change, Input, Wish};
    use glam::Vec2;
    use winit::event::MouseButton;

    #[test]
    fn a_drag_turns_and_another_button_moves() {
        let mut input = Input::default();
        assert_eq!(input.moved([10.0, 10.0], 100), None);
        assert_eq!(input.moved([20.0, 10.0], 100), None);
        input.button(MouseButton::Left, true);
        let turned = Wish::Camera(Change::Turn(Vec2::new(0.1, 0.05)));
        assert_eq!(input.moved([30.0, 15.0], 100), Some(turned));
        input.button(MouseButton::Left, false);
        input.button(MouseButton::Middle, true);
        let moved = Wish::Camera(Change::Shift(Vec2::new(-0.1, 0.0)));
        assert_eq!(input.moved([20.0, 15.0], 100), Some(moved));
    }
}
