//! A limit to the program's frame rate.
#![forbid(unsafe_code)]

use super::error::ConfigError;
use super::options::OptionId;
use super::settings::Settings;
use std::time::Duration;

/// The most frames per second that a program shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameCap {
    /// From frame to frame.
    pub period: Duration,
    /// A frame waits before it is shown, which makes the times between frames equal. Otherwise the program waits afterwards, so that its next frame
    /// follows the newest input.
    pub early: bool,
}

const EARLY: &str = "early";
const LATE: &str = "late";

impl FrameCap {
    pub(super) fn from_settings(settings: &Settings) -> Result<Option<Self>, ConfigError> {
        let Some((field, value)) = settings.field(OptionId::FpsCap) else {
            return Ok(None);
        };
        let (rate, wait) = value.split_once(':').unwrap_or((value, LATE));
        match (rate.parse(), wait) {
            (Ok(rate), EARLY | LATE) if (1.0..=1000.0).contains(&rate) => Ok(Some(Self {
                period: Duration::from_secs_f64(1.0 / rate),
                early: wait == EARLY,
            })),
            _ => Err(ConfigError::FpsCap {
                field,
                value: value.to_owned(),
            }),
        }
    }
}
