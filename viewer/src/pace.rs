//! How many points a frame may have.

use std::time::Duration;

/// Fewer are never drawn, so that there is always a picture.
const LEAST: f64 = 20_000.0;
/// More are never drawn: as many as all pixels of a large screen.
const MOST: f64 = 20_000_000.0;

/// Of the wanted time: frames differ.
const SHARE: f64 = 0.9;

/// Follows the time that frames take.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// That a frame should take, in seconds.
    wanted: f64,
    points: f64,
}

impl Pace {
    /// For so many frames a second.
    #[must_use]
    pub fn new(rate: f64) -> Self {
        Self {
            wanted: 1.0 / rate,
            points: 500_000.0,
        }
    }

    /// How many points the next frame may have.
    #[must_use]
    pub fn budget(&self) -> u64 {
        self.points as u64
    }

    /// A frame took so long, from its beginning to the end of its swap. `limited`: it left nodes out because of the budget.
    pub fn frame(&mut self, took: Duration, limited: bool) {
        let load = took.as_secs_f64() / (self.wanted * SHARE);
        if load > 1.0 {
            // A frame that was too long is told at once, one slow frame among many does little.
            self.points *= (1.0 / load).max(0.7);
        } else if limited && load < 0.8 {
            self.points *= (0.9 / load.max(0.1)).min(1.1);
        }
        self.points = self.points.clamp(LEAST, MOST);
    }
}

#[cfg(test)]
mod tests {
    use super::Pace;
    use std::time::Duration;

    #[test]
    fn frames_come_to_the_wanted_time() {
        for points_a_second in [2e6, 5e7] {
            let mut pace = Pace::new(30.0);
            let took = |pace: &Pace| 0.002 + pace.budget() as f64 / points_a_second;
            for _ in 0..200 {
                let took = took(&pace);
                pace.frame(Duration::from_secs_f64(took), true);
            }
            let took = took(&pace) * 30.0;
            assert!((0.6..=0.95).contains(&took), "{took}");
        }
    }

    #[test]
    fn a_whole_cloud_needs_no_more() {
        let mut pace = Pace::new(30.0);
        let before = pace.budget();
        pace.frame(Duration::from_millis(1), false);
        assert_eq!(pace.budget(), before);
    }
}
