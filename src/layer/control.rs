//! What the running program is asked and told: the values in force, and pictures of the next frame.

use super::Layer;
use crate::config::{Camera, Capture, CaptureWhat, Live, OptionId, Output};
use crate::control::{Answer, ControlError, LAYER, Order, VIEWS};
use crate::gl::Gl;
use crate::interleave::Source;
use serde_json::{Map, Value};

/// A picture that is asked for.
#[derive(Debug)]
pub(super) enum Picture {
    None,
    /// Of the next frame that is shown.
    Wanted(Capture),
    Done(Result<Answer, ControlError>),
}

/// What has become of a picture.
#[derive(Debug)]
pub enum Pictured {
    /// It is written, or it cannot be.
    Done(Result<Answer, ControlError>),
    /// The frame was not shown as a picture: it is to be asked of the next one.
    Later(Capture),
}

impl Layer {
    /// The values in force.
    pub fn live(&self) -> Live {
        self.live
    }

    /// Other values from the next draw on; to be called between frames, so that none is drawn with both.
    pub fn adopt(&mut self, live: Live) {
        self.live = live;
        self.rig.change(live.camera, live.flat);
        self.classifier.change_hud_depth(live.hud_depth);
    }

    /// What the window shows.
    pub(super) fn output(&self) -> Output {
        if self.live.flat {
            Output::View(self.atlas.tiles.own())
        } else {
            self.live.output
        }
    }

    /// Does what is asked, or changes nothing. A picture is not taken here: `Ok(Err(..))` is the one to be given to
    /// [`Layer::picture`] before the next frame is shown.
    pub fn control(&mut self, order: Order) -> Result<Result<Answer, Capture>, ControlError> {
        match order {
            Order::Set(changes) => {
                let live = self.live.with(self.config, &changes, self.rig.latched())?;
                let chosen = live.output != self.live.output;
                if chosen && live.output == Output::Quad && !self.state.window.stereo {
                    return Err(ControlError::NoStereo);
                }
                self.adopt(live);
                Ok(Ok(Answer::Values(self.values())))
            }
            Order::Get(None) => Ok(Ok(Answer::Values(self.values()))),
            Order::Get(Some(name)) => match self.values().remove_entry(&name) {
                Some(entry) => Ok(Ok(Answer::Values(Map::from_iter([entry])))),
                None => Err(self.not_in_force(name)),
            },
            Order::Capture(path, what) => Ok(Err(Capture {
                out: path,
                first: 0,
                last: 0,
                what: CaptureWhat::asked(&what, self.config.views)?,
            })),
            Order::Toggle => {
                self.adopt(Live {
                    flat: !self.live.flat,
                    ..self.live
                });
                Ok(Ok(Answer::Layer(!self.live.flat)))
            }
        }
    }

    fn values(&self) -> Map<String, Value> {
        let mut values = Map::new();
        let mut put = |id: OptionId, value: Value| {
            if let Some(name) = id.spec().key {
                values.insert(name.to_owned(), value);
            }
        };
        put(OptionId::Output, self.live.output.to_string().into());
        put(OptionId::HudDepth, self.live.hud_depth.into());
        let cameras = self.live.cameras(self.rig.latched());
        for (id, value) in cameras.into_iter().flatten() {
            put(id, value.into());
        }
        values.insert(VIEWS.to_owned(), self.config.views.into());
        values.insert(LAYER.to_owned(), (!self.live.flat).into());
        values
    }

    /// Only the cameras' values are not always there.
    fn not_in_force(&self, name: String) -> ControlError {
        ControlError::NotInForce {
            name,
            reason: match self.live.camera {
                Camera::Auto if self.rig.latched().is_none() => {
                    "the program has drawn nothing in perspective yet, so the cameras are not chosen"
                }
                Camera::Eye { .. } => {
                    "the cameras are placed by eye-spacing and focal-depth; ask for those"
                }
                Camera::Auto | Camera::Clip { .. } => {
                    "the cameras are placed by separation and convergence; ask for those"
                }
            },
        }
    }

    /// Asks for a picture of the next frame that is shown.
    pub fn picture(&mut self, wanted: Capture) {
        self.picture = Picture::Wanted(wanted);
    }

    /// What has become of the picture that was asked for, once.
    pub fn pictured(&mut self) -> Option<Pictured> {
        match std::mem::replace(&mut self.picture, Picture::None) {
            Picture::None => None,
            Picture::Wanted(wanted) => Some(Pictured::Later(wanted)),
            Picture::Done(outcome) => Some(Pictured::Done(outcome)),
        }
    }

    /// Writes the picture that was asked for, if one was.
    pub(super) fn take_picture(&mut self, gl: &Gl, source: &Source, frame: u64) {
        if let Picture::Wanted(wanted) = &self.picture {
            let wanted = Capture {
                first: frame,
                last: frame,
                ..wanted.clone()
            };
            let written = self.write(gl, source, &wanted, frame);
            self.picture = Picture::Done(match written {
                Ok(path) => Ok(Answer::Captured { path, frame }),
                Err(reason) => Err(ControlError::Picture(reason)),
            });
        }
    }
}
