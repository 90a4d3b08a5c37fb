//! Keys for the layer while the program has the keyboard. They are watched, never taken.

mod wayland;
mod x11;

use crate::drawable::Shown;
use crate::live::{self, free};
use crate::switch::{config, say};
use manyview_core::config::{Action, Binding, Camera, Modifiers, program};
use manyview_core::control::{Answer, keys};
use manyview_core::layer::{Layer, Pictured, Wanted};
use std::error::Error;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::{SystemTime, UNIX_EPOCH};

const CONTROL: [u32; 2] = [0xffe3, 0xffe4];
const ALT: [u32; 2] = [0xffe9, 0xffea];
const SHIFT: [u32; 2] = [0xffe1, 0xffe2];
const LOGO: [u32; 2] = [0xffeb, 0xffec];

type Fault = Box<dyn Error + Send + Sync>;

enum State {
    Unopened,
    Open(Box<Keys>),
    Closed,
}

struct Keys {
    keyboard: Keyboard,
    /// The process that opened the keyboard. After fork, a child has our memory and our descriptors, and must not use them.
    pid: u32,
    wanted: Option<Wanted>,
    /// A picture is being taken.
    waits: bool,
    /// The key whose action ends when it is let go, and the end.
    held: Option<(u32, Release)>,
}

enum Keyboard {
    X(Box<x11::Keyboard>),
    Wayland(wayland::Keyboard),
}

/// A key that was pressed while the program had the keyboard, or was let go. `code` is the same for both.
enum Event {
    Pressed {
        code: u32,
        /// Without Shift.
        keysym: u32,
        modifiers: Modifiers,
        /// It was down already.
        repeats: bool,
    },
    Released(u32),
}

/// What letting go of a key does.
#[derive(Clone, Copy)]
enum Release {
    Toggle,
    Cameras(Camera),
}

static STATE: Mutex<State> = Mutex::new(State::Unopened);

fn wanted() -> bool {
    config().is_some_and(|config| config.keys)
}

/// Those among the keysyms of keys that are down.
fn modifiers(down: impl Iterator<Item = u32>) -> Modifiers {
    let mut held = Modifiers::default();
    for keysym in down {
        held.control |= CONTROL.contains(&keysym);
        held.alt |= ALT.contains(&keysym);
        held.shift |= SHIFT.contains(&keysym);
        held.logo |= LOGO.contains(&keysym);
    }
    held
}

/// Before a frame is shown: gives the layer the picture that a key asked for.
pub(crate) fn before(layer: &mut Layer) {
    if !wanted() {
        return;
    }
    if let Some(mut state) = free(&STATE)
        && let State::Open(keys) = &mut *state
        && keys.pid == std::process::id()
        && !layer.awaits_picture()
        && let Some(wanted) = keys.wanted.take()
    {
        layer.picture(wanted);
        keys.waits = true;
    }
}

/// After a frame was shown: handles keys, so that changes apply to the whole next frame. `shown` is where the frame was shown.
pub(crate) fn after(layer: &mut Layer, shown: impl FnOnce() -> Option<Shown>) {
    if !wanted() {
        return;
    }
    let Some(mut state) = free(&STATE) else {
        return;
    };
    let outcome = match &mut *state {
        State::Closed => return,
        State::Unopened => match shown() {
            None => Err("the program shows no window of X11 or Wayland".into()),
            Some(shown) => Keys::open(shown).map(|keys| *state = State::Open(Box::new(keys))),
        },
        State::Open(keys) if keys.pid != std::process::id() => return,
        State::Open(keys) => keys.handle(layer, shown()),
    };
    if let Err(fault) = outcome {
        let sentence = format!("keys are off: {fault}; use `manyview ctl` with --control instead");
        say(&sentence);
        layer.note(sentence);
        *state = State::Closed;
    }
}

impl Keys {
    fn open(shown: Shown) -> Result<Self, Fault> {
        let keyboard = match shown {
            Shown::X(display, window) => {
                let mut keyboard = x11::Keyboard::open(&display)?;
                keyboard.remember_window(window);
                Keyboard::X(Box::new(keyboard))
            }
            Shown::Wayland(display) => {
                // SAFETY: the program has just shown a frame at this display.
                let keyboard = unsafe { wayland::Keyboard::open(display) }?;
                Keyboard::Wayland(keyboard)
            }
        };
        Ok(Keys {
            keyboard,
            pid: std::process::id(),
            wanted: None,
            waits: false,
            held: None,
        })
    }

    /// Handles the keys since the last frame.
    fn handle(&mut self, layer: &mut Layer, shown: Option<Shown>) -> Result<(), Fault> {
        if self.waits {
            match layer.pictured() {
                Some(Pictured::Later(wanted)) => self.wanted = Some(wanted),
                Some(Pictured::Done(Ok(
                    Answer::Captured { path, .. } | Answer::Explained { path, .. },
                ))) => {
                    say(&format!("wrote {}", path.display()));
                }
                Some(Pictured::Done(Err(error))) => say(&error.to_string()),
                Some(Pictured::Done(Ok(_))) | None => {}
            }
            self.waits = false;
        }
        let bindings = config().map(|config| &config.bindings);
        let binding = |keysym, modifiers| bindings?.find(keysym, modifiers);
        let bound = |keysym, modifiers| binding(keysym, modifiers).is_some();
        let events = match (&mut self.keyboard, shown) {
            (Keyboard::X(keyboard), shown) => {
                if let Some(Shown::X(_, window)) = shown {
                    keyboard.remember_window(window);
                }
                keyboard.events(&bound)?
            }
            // SAFETY: the program has just shown a frame at this display.
            (Keyboard::Wayland(keyboard), Some(Shown::Wayland(display))) => unsafe {
                keyboard.events(display)
            },
            (Keyboard::Wayland(_), _) => Vec::new(),
        };
        for event in events {
            match event {
                Event::Released(code) => self.release(code, layer),
                Event::Pressed {
                    code,
                    keysym,
                    modifiers,
                    repeats,
                } => {
                    if let Some(binding) = binding(keysym, modifiers)
                        && !(repeats && is_once(binding.action))
                    {
                        self.press(code, binding, layer);
                    }
                }
            }
        }
        Ok(())
    }

    fn press(&mut self, code: u32, binding: Binding, layer: &mut Layer) {
        let (before, profile) = (layer.live(), Arc::clone(layer.profile()));
        if binding.hold {
            let release = match binding.action {
                Action::Toggle => Release::Toggle,
                _ => Release::Cameras(layer.camera_ahead()),
            };
            // One at a time.
            if self.held.is_some() {
                return;
            }
            self.held = Some((code, release));
        }
        match layer.press(binding.action, picture) {
            Ok(Ok(Answer::Profile { path, .. })) => say(&format!("wrote {}", path.display())),
            Ok(Ok(_)) => {}
            Ok(Err(wanted)) => self.wanted = Some(wanted),
            Err(error) => say(&error.to_string()),
        }
        live::changed(layer, before);
        live::profile_changed(layer, &profile);
    }

    /// Ends what a key does while it is held.
    fn release(&mut self, code: u32, layer: &mut Layer) {
        let Some((_, release)) = self.held.take_if(|(held, _)| *held == code) else {
            return;
        };
        let before = layer.live();
        match release {
            // It cannot be refused.
            Release::Toggle => drop(layer.press(Action::Toggle, picture)),
            Release::Cameras(camera) => layer.move_to(camera),
        }
        live::changed(layer, before);
    }
}

/// Whether a key that repeats itself does this once.
fn is_once(action: Action) -> bool {
    !matches!(
        action,
        Action::Spread(_) | Action::Focus(_) | Action::HudDepth(_)
    )
}

/// The path of the picture of a frame, in the program's working directory.
fn picture(frame: u64) -> PathBuf {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let program = program::this_program().unwrap_or_default();
    let name = keys::picture_name(&program, now.unwrap_or_default().as_secs(), frame);
    std::env::current_dir().unwrap_or_default().join(name)
}
