//! The way from the present cameras to others: a jump of the depth hurts the eyes.
#![forbid(unsafe_code)]

use crate::config::{Camera, Live};
use std::time::Instant;

/// A way that has begun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// Separation and convergence at its beginning, and at its end.
    ends: Option<[(f64, f64); 2]>,
    to: Camera,
    begun: Instant,
    /// Seconds.
    takes: f64,
}

impl Ramp {
    /// From the cameras in force to others, in so many seconds. `chosen` as for [`Live::with`]. Where one of the two has no separation and convergence yet, it is a jump.
    #[must_use]
    pub fn new(
        live: Live,
        chosen: Option<(f64, f64)>,
        to: Camera,
        takes: f64,
        now: Instant,
    ) -> Self {
        let clip = |camera| match camera {
            Camera::Clip {
                separation,
                convergence,
            } => Some((separation, convergence)),
            _ => None,
        };
        let now_at = match live.camera {
            Camera::Auto | Camera::Measured(_) => chosen,
            camera => clip(camera),
        };
        Ramp {
            ends: now_at.zip(clip(to)).map(|(from, to)| [from, to]),
            to,
            begun: now,
            takes,
        }
    }

    /// Where it leads.
    #[must_use]
    pub fn target(&self) -> Camera {
        self.to
    }

    /// The cameras at a time, and whether they have arrived.
    #[must_use]
    pub fn at(&self, now: Instant) -> (Camera, bool) {
        let part = now.duration_since(self.begun).as_secs_f64() / self.takes;
        let Some([from, to]) = self.ends.filter(|_| part < 1.0) else {
            return (self.to, true);
        };
        // Slow at both ends.
        let part = part * part * (3.0 - 2.0 * part);
        let separation = from.0 + part * (to.0 - from.0);
        // What is as far behind the one as before the other lies between them.
        let convergence = from.1 * (to.1 / from.1).powf(part);
        let camera = Camera::Clip {
            separation,
            convergence,
        };
        (camera, false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Settings};
    use std::time::Duration;

    fn clip(separation: f64, convergence: f64) -> Camera {
        Camera::Clip {
            separation,
            convergence,
        }
    }

    #[test]
    fn cameras_go_from_one_end_to_the_other_and_never_beyond() {
        let mut live = Live::new(&Config::from_settings(&Settings::default()).unwrap());
        live.camera = clip(0.01, 4.0);
        let now = Instant::now();
        let ramp = Ramp::new(live, None, clip(0.03, 16.0), 2.0, now);
        let at = |seconds: f64| ramp.at(now + Duration::from_secs_f64(seconds));
        assert_eq!(at(0.0), (clip(0.01, 4.0), false));
        let (
            Camera::Clip {
                separation,
                convergence,
            },
            false,
        ) = at(1.0)
        else {
            panic!("half of the way");
        };
        assert!((separation - 0.02).abs() < 1e-12 && (convergence - 8.0).abs() < 1e-9);
        let mut last = 0.0;
        for step in 0..20 {
            let (Camera::Clip { separation, .. }, false) = at(f64::from(step) * 0.1) else {
                panic!("on the way");
            };
            assert!(separation >= last && separation <= 0.03);
            last = separation;
        }
        assert_eq!(at(2.0), (clip(0.03, 16.0), true));
        assert_eq!(at(9.0), (clip(0.03, 16.0), true));
    }

    #[test]
    fn without_a_beginning_or_a_time_it_is_a_jump() {
        let live = Live::new(&Config::from_settings(&Settings::default()).unwrap());
        let now = Instant::now();
        let to = clip(0.03, 16.0);
        assert_eq!(Ramp::new(live, None, to, 2.0, now).at(now), (to, true));
        assert_eq!(
            Ramp::new(live, Some((0.1, 2.0)), to, 0.0, now).at(now),
            (to, true)
        );
        let measured = Camera::Measured(None);
        let ramp = Ramp::new(live, Some((0.1, 2.0)), measured, 2.0, now);
        assert_eq!(ramp.at(now), (measured, true));
    }
}
