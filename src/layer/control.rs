//! Requests to the running program: values in force, and pictures of the next frame.

use super::Layer;
use crate::config::{Action, Camera, Capture, CaptureWhat, FlatDepth, Live, OptionId, Output};
use crate::control::{Answer, ControlError, LAYER, Order, ProfileRequest, Ramp, VIEWS, keys};
use crate::display::LensPart;
use crate::gl::Gl;
use crate::interleave::Source;
use crate::state::Neutral;
use serde_json::{Map, Value};
use std::path::PathBuf;
use std::time::Instant;

/// What is asked for of the next frame that is shown.
#[derive(Clone, Debug, PartialEq)]
pub enum Wanted {
    /// A picture.
    Picture(Capture),
    /// An explanation.
    Explanation,
}

/// State of what is asked for of a frame.
#[derive(Debug)]
pub(super) enum Picture {
    None,
    /// Of the next frame that is shown.
    Wanted(Wanted),
    Done(Result<Answer, ControlError>),
}

impl Picture {
    /// Whether it was asked for and its outcome was not taken yet.
    pub(super) fn is_awaited(&self) -> bool {
        !matches!(self, Picture::None)
    }

    /// Takes the outcome, if a picture was asked for.
    pub(super) fn take(&mut self) -> Option<Pictured> {
        match std::mem::replace(self, Picture::None) {
            Picture::None => None,
            Picture::Wanted(wanted) => Some(Pictured::Later(wanted)),
            Picture::Done(outcome) => Some(Pictured::Done(outcome)),
        }
    }
}

/// Outcome of a picture or an explanation that was asked for.
#[derive(Debug)]
pub enum Pictured {
    /// It was written, or the error says why not.
    Done(Result<Answer, ControlError>),
    /// The frame was not shown, or lacked views: the picture has to be asked of the next one.
    Later(Wanted),
}

impl Layer {
    /// The values in force.
    pub fn live(&self) -> Live {
        self.session.live
    }

    /// Puts other values in force from the next draw on. It has to be called between frames, so that no frame is drawn with both.
    pub fn adopt(&mut self, live: Live) {
        if live.camera != self.session.live.camera {
            self.session.ramp = None;
        }
        self.put(live);
    }

    /// Goes on to the cameras of a preset that was selected. It has to be called between frames.
    pub fn advance(&mut self, now: Instant) {
        let Some(ramp) = self.session.ramp else {
            return;
        };
        let (camera, arrived) = ramp.at(now);
        self.put(Live {
            camera,
            ..self.session.live
        });
        if arrived {
            self.session.ramp = None;
        }
    }

    fn put(&mut self, live: Live) {
        if live.camera != self.session.live.camera {
            let focal = self.session.profile.focal_depth;
            self.cameras
                .comfort
                .change(self.session.config, live.camera, focal);
        }
        self.session.adopt(live);
        self.known.rig.change(live.camera, live.flat);
        self.cameras.classifier.change_hud_depth(live.hud_depth);
        self.cameras.follow(self.session.config.views);
    }

    /// The output in force; the own view alone while all cameras stand where the program's own does.
    pub(super) fn output(&self) -> Output {
        if self.session.live.flat {
            Output::View(self.targets.atlas.tiles.own().0)
        } else {
            self.session.live.output
        }
    }

    /// Carries out a request, or changes nothing and fails. A picture is not taken here: `Ok(Err(..))` has to be given to [`Layer::picture`]
    /// before the next frame is shown. It has to be called between frames.
    pub fn control(&mut self, order: Order) -> Result<Result<Answer, Wanted>, ControlError> {
        match order {
            Order::Set(changes) => {
                let live = self.session.live.with(
                    self.session.config,
                    &changes,
                    self.known.rig.latched(),
                )?;
                let chosen = live.output != self.session.live.output;
                if chosen && live.output == Output::Quad && !self.state.window.buffers.stereo {
                    return Err(ControlError::NoStereo);
                }
                self.adopt(live);
                self.show_values(&changes);
                Ok(Ok(Answer::Values(self.values())))
            }
            Order::Get(None) => Ok(Ok(Answer::Values(self.values()))),
            Order::Get(Some(name)) => match self.values().remove_entry(&name) {
                Some(entry) => Ok(Ok(Answer::Values(Map::from_iter([entry])))),
                None => Err(self.not_in_force(name)),
            },
            Order::Capture(path, what) => Ok(Err(Wanted::Picture(Capture {
                out: path,
                first: 0,
                last: 0,
                what: CaptureWhat::asked(&what, self.session.config.views)?,
            }))),
            Order::Explain(out) => {
                // From the first draw of the frame on.
                self.explain_next(out);
                Ok(Err(Wanted::Explanation))
            }
            Order::Profile(ProfileRequest::Reload) => self.reload_profile().map(Ok),
            Order::Profile(ProfileRequest::Save(path)) => self.save_profile(path).map(Ok),
            Order::Preset(number) => self.select(number).map(Ok),
            Order::Toggle => {
                self.adopt(Live {
                    flat: !self.session.live.flat,
                    ..self.session.live
                });
                let flat = self.session.live.flat;
                let text = if flat {
                    "the program's own view"
                } else {
                    "all views"
                };
                self.show_text(text.to_owned());
                Ok(Ok(Answer::Layer(!flat)))
            }
        }
    }

    /// Selects cameras of the user's, counted from 0.
    fn select(&mut self, number: usize) -> Result<Answer, ControlError> {
        let presets = &self.session.config.presets;
        let found = presets.cameras.get(number);
        let to = *found.ok_or(ControlError::Preset(number + 1))?;
        self.move_to(to);
        self.show_text(format!("preset {}", number + 1));
        Ok(Answer::Values(self.values()))
    }

    /// Begins the way to other cameras. It has to be called between frames.
    pub fn move_to(&mut self, camera: Camera) {
        let (chosen, takes) = (self.known.rig.latched(), self.session.config.presets.ramp);
        let now = Instant::now();
        self.session.ramp = Some(Ramp::new(self.session.live, chosen, camera, takes, now));
        self.advance(now);
    }

    /// The cameras in force, or those that they are on the way to.
    pub fn camera_ahead(&self) -> Camera {
        let ramp = self.session.ramp.as_ref();
        ramp.map_or(self.session.live.camera, Ramp::target)
    }

    /// Carries out the requests of a key, as [`Layer::control`] does. `picture` gives the path for the number of a frame.
    pub fn press(
        &mut self,
        action: Action,
        picture: impl FnOnce(u64) -> PathBuf,
    ) -> Result<Result<Answer, Wanted>, ControlError> {
        // The next one, counted from 1.
        let frame = self.diagnostics.report.frames() + 1;
        let presets = &self.session.config.presets.cameras;
        let chosen = self.known.rig.latched();
        let live = match action {
            Action::NextPreset => Live {
                camera: self.camera_ahead(),
                ..self.session.live
            },
            _ => self.session.live,
        };
        let orders = keys::orders(action, live, chosen, presets, || picture(frame));
        let outcome = orders
            .into_iter()
            .fold(None, |outcome, order| match outcome {
                Some(Ok(_)) => outcome,
                _ => Some(self.control(order)),
            });
        let outcome = outcome.unwrap_or_else(|| Ok(Ok(Answer::Values(self.values()))));
        if let Err(refused) = &outcome {
            self.show_text(refused.to_string());
        }
        outcome
    }

    fn values(&self) -> Map<String, Value> {
        let mut values = Map::new();
        let mut put = |id: OptionId, value: Value| {
            if let Some(name) = id.spec().key {
                values.insert(name.to_owned(), value);
            }
        };
        put(
            OptionId::Output,
            self.session.live.output.to_string().into(),
        );
        let hud = match self.session.live.hud_depth {
            FlatDepth::At(depth) => depth.into(),
            follows => follows.to_string().into(),
        };
        put(OptionId::HudDepth, hud);
        let measured = matches!(self.session.live.camera, Camera::Measured(_));
        put(OptionId::AutoDepth, u8::from(measured).into());
        let cameras = self.session.live.cameras(self.known.rig.latched());
        for (id, value) in cameras.into_iter().flatten() {
            put(id, value.into());
        }
        for (part, lens) in LensPart::ALL
            .into_iter()
            .zip(self.session.live.lens.into_iter().cycle())
        {
            let number = lens.get(part);
            let value = number
                .decimal()
                .map_or_else(|| number.to_string().into(), Value::from);
            values.insert(part.name().to_owned(), value);
        }
        values.insert(VIEWS.to_owned(), self.session.config.views.into());
        values.insert(LAYER.to_owned(), (!self.session.live.flat).into());
        values
    }

    /// The error for a value that is not in force: only values of the cameras and of a lens sheet may be missing.
    fn not_in_force(&self, name: String) -> ControlError {
        ControlError::NotInForce {
            reason: match self.session.live.camera {
                _ if LensPart::named(&name).is_some() => {
                    "the display is no slanted lens sheet; see `manyview displays show`"
                }
                Camera::Auto | Camera::Measured(_) if self.known.rig.latched().is_none() => {
                    "the program has drawn nothing in perspective yet, so the cameras are not chosen"
                }
                Camera::Eye { .. } => {
                    "the cameras are placed by eye-spacing and focal-depth; ask for those"
                }
                Camera::Auto | Camera::Measured(_) | Camera::Clip { .. } => {
                    "the cameras are placed by separation and convergence; ask for those"
                }
            },
            name,
        }
    }

    /// Asks for a picture of the next frame that is shown, or waits for its explanation.
    pub fn picture(&mut self, wanted: Wanted) {
        self.diagnostics.picture = Picture::Wanted(wanted);
    }

    /// Whether a picture was asked for whose outcome was not taken yet.
    pub fn awaits_picture(&self) -> bool {
        self.diagnostics.picture.is_awaited()
    }

    /// Takes the outcome of the picture that was asked for, if one was.
    pub fn pictured(&mut self) -> Option<Pictured> {
        self.diagnostics.picture.take()
    }

    /// Writes the picture that was asked for, if one was.
    pub(super) fn take_picture(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        source: (u32, &Source),
        frame: u64,
    ) {
        if let Picture::Wanted(Wanted::Picture(wanted)) = &self.diagnostics.picture {
            let wanted = Capture {
                first: frame,
                last: frame,
                ..wanted.clone()
            };
            if self.lacks(wanted.what) {
                return; // it is asked for again with the next frame
            }
            let written = self.write(gl, neutral, source, &wanted, frame);
            self.show_text(match &written {
                Ok(path) => format!("wrote {}", path.display()),
                Err(reason) => reason.clone(),
            });
            self.diagnostics.picture = Picture::Done(match written {
                Ok(path) => Ok(Answer::Captured { path, frame }),
                Err(reason) => Err(ControlError::Picture(reason)),
            });
        }
    }

    /// Tells what became of an explanation that was asked for: the path of the list, or why it is not written.
    pub(super) fn explained(&mut self, frame: u64, outcome: Result<PathBuf, String>) {
        if let Picture::Wanted(Wanted::Explanation) = &self.diagnostics.picture {
            self.diagnostics.picture = Picture::Done(match outcome {
                Ok(path) => Ok(Answer::Explained { path, frame }),
                Err(reason) => Err(ControlError::Picture(reason)),
            });
        }
    }
}
