//! How many views are drawn when the others are made of them: as many as leave the rate that is asked for.
//!
//! Whole frames are timed, from swap to swap, so the number follows whatever the program, the driver and the machine do. It goes down as
//! soon as some frames take too long, and up only where one view more is expected to fit; where that cannot be told (a program that
//! waits for the screen always takes the same time), it is tried, and less and less often if it fails.
#![forbid(unsafe_code)]

/// Of one view alone, too much of the others is unknown: up to a twelfth of OpenArena's pictures, at 26 dB.
const FEWEST: u32 = 2;
/// Frames that are judged together, by the one that a quarter of them is slower than: a rate is held where most frames have it, not half of them.
const WINDOW: usize = 16;
/// Frames after a change that tell of nothing yet.
const SETTLING: u32 = 2;
/// What a frame may take of the time it has, for a while, and at all.
const OVER: [f32; 2] = [1.015, 1.25];
/// What it may be expected to take with one view more.
const FITS: f32 = 0.95;
/// Of the frame, what one view is expected to take before a change has told. Too little costs one window that is too slow, too much a try that comes late.
const UNKNOWN: f32 = 0.25;
/// Frames between changes where one view more fits.
const HELD: u32 = 24;
/// Frames before one more is tried although it is not expected to fit: the first time, and at most.
const TRIED: [u32; 2] = [240, 3840];

/// One program's.
#[derive(Clone, Debug)]
pub struct Governor {
    /// Milliseconds.
    budget: f32,
    /// Numbers of views, from few to all.
    levels: Vec<u32>,
    at: usize,
    window: Vec<f32>,
    /// The last window was over what is allowed for a while.
    late: bool,
    settling: u32,
    /// Frames since the last change.
    held: u32,
    /// Frames before the next try.
    patience: u32,
    /// It was raised last, and was not judged since.
    tried: bool,
    /// What the window before the last change took, and the number of views then.
    before: Option<(f32, u32)>,
    /// What one view takes, of the whole frame.
    share: Option<f32>,
}

impl Governor {
    /// For `rate` frames per second of `views` views; above `most` it is all of them. Begins with a few.
    #[must_use]
    pub fn new(rate: f64, views: u32, most: u32) -> Governor {
        let mut levels: Vec<u32> = (FEWEST.min(views)..=most.min(views)).collect();
        if most < views {
            levels.push(views);
        }
        Governor {
            budget: (1e3 / rate) as f32,
            at: 0,
            levels,
            window: Vec::with_capacity(WINDOW),
            late: false,
            settling: SETTLING,
            held: 0,
            patience: TRIED[0],
            tried: false,
            before: None,
            share: None,
        }
    }

    /// Views that the next frame draws.
    #[must_use]
    pub fn level(&self) -> u32 {
        self.levels.get(self.at).copied().unwrap_or(1)
    }

    /// A frame took so many milliseconds from the one before.
    pub fn frame(&mut self, ms: f32) {
        self.held = self.held.saturating_add(1);
        if self.settling > 0 {
            self.settling -= 1;
            return;
        }
        self.window.push(ms);
        if self.window.len() < WINDOW {
            return;
        }
        self.window.sort_by(f32::total_cmp);
        let slow = self.window.get(WINDOW * 3 / 4).copied().unwrap_or(ms);
        self.window.clear();
        self.learn(slow);
        let one = slow * self.share.unwrap_or(UNKNOWN);
        let [over, far_over] = OVER.map(|over| slow > over * self.budget);
        let late = std::mem::replace(&mut self.late, over);
        if over && !late && !far_over && !self.tried {
            return;
        }
        if over {
            self.late = false;
            // One that was tried and did not fit is not tried again soon.
            let too_many = match std::mem::take(&mut self.tried) {
                true => {
                    self.patience = (2 * self.patience).min(TRIED[1]);
                    1
                }
                false => ((slow - self.budget) / one).ceil().max(1.0) as u32,
            };
            let fit = self.level().saturating_sub(too_many);
            let below = self.levels.iter().take(self.at);
            let to = below.filter(|&&level| level <= fit).count();
            return self.go(to.saturating_sub(1), slow);
        }
        self.tried = false;
        // From eight views it is all at once.
        let next = self.levels.get(self.at + 1).copied();
        let more = next.map_or(0, |next| next - self.level()) as f32;
        let fits = slow + more * one <= self.budget * FITS;
        let due = self.held >= if fits { HELD } else { self.patience };
        if due && self.at + 1 < self.levels.len() {
            self.tried = true;
            self.go(self.at + 1, slow);
        }
    }

    fn go(&mut self, to: usize, ms: f32) {
        if to != self.at {
            self.before = Some((ms, self.level()));
            self.at = to;
            self.held = 0;
            self.settling = SETTLING;
        }
    }

    /// What one view takes, from the last change.
    fn learn(&mut self, ms: f32) {
        let Some((before, level)) = self.before.take() else {
            return;
        };
        let views = self.level() as f32 - level as f32;
        let share = (ms - before) / views / ms.max(1e-3);
        // A scene that changed at the same time tells of nothing.
        if views != 0.0 && (0.01..1.0).contains(&share) {
            self.share = Some(share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drives it over frames that take `ms(level, frame, noise)`, the noise from 0.95 to 1.05; answers the levels.
    fn walk(
        governor: &mut Governor,
        frames: std::ops::Range<u32>,
        ms: impl Fn(u32, u32, f32) -> f32,
    ) -> Vec<u32> {
        let mut seed = 7u32;
        frames
            .map(|frame| {
                let level = governor.level();
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let noise = 0.95 + 0.1 * (seed >> 8) as f32 / (1 << 24) as f32;
                governor.frame(ms(level, frame, noise));
                level
            })
            .collect()
    }

    fn changes(levels: &[u32]) -> usize {
        levels.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    #[test]
    fn it_comes_to_as_many_as_fit_and_stays_there() {
        // 20 ms, and 3 for each view: 6 leave 38 of 40.
        for (each, expected) in [(3.0, 6), (9.0, 2), (30.0, 2), (0.1, 8)] {
            let mut governor = Governor::new(25.0, 8, 8);
            let levels = walk(&mut governor, 0..3000, |level, _, noise| {
                noise * (20.0 + each * level as f32)
            });
            let late = &levels[1000..];
            let stays = late.iter().filter(|&&level| level == expected).count();
            assert!(stays * 20 >= late.len() * 19, "{each} ms: {late:?}");
            assert!(changes(&levels) <= 20, "{each} ms: {levels:?}");
        }
    }

    #[test]
    fn it_knows_what_a_view_takes_from_the_first_one_more() {
        // A third view may take a quarter of the frame, for all that is known, which is too much at 33 frames per second: it is tried in time.
        for (rate, soon, in_time) in [(33.0, 2, 4), (30.0, 5, 6)] {
            let mut governor = Governor::new(rate, 8, 8);
            let levels = walk(&mut governor, 0..450, |level, _, noise| {
                noise * (20.0 + 2.0 * level as f32)
            });
            assert_eq!([levels[200], levels[449]], [soon, in_time], "{levels:?}");
        }
    }

    #[test]
    fn one_slow_moment_changes_nothing() {
        let mut governor = Governor::new(25.0, 8, 8);
        let levels = walk(&mut governor, 0..3000, |level, frame, noise| {
            // Six frames are never a quarter of two windows.
            let slow = if frame % 32 < 6 { 1.12 } else { 1.0 };
            noise.sqrt() * slow * (20.0 + 3.0 * level as f32)
        });
        let late = &levels[1000..];
        let stays = late.iter().filter(|&&level| level == 6).count();
        assert!(stays * 20 >= late.len() * 19, "{late:?}");
    }

    #[test]
    fn it_follows_the_scene() {
        let mut governor = Governor::new(52.0, 8, 8);
        let ms = |level: u32, frame: u32, noise: f32| {
            let scene = if (1000..2000).contains(&frame) {
                2.3
            } else {
                1.0
            };
            noise * scene * (4.0 + 2.0 * level as f32)
        };
        let levels = walk(&mut governor, 0..3000, ms);
        assert_eq!([levels[999], levels[1999]], [7, 2]);
        // Fewer within a few frames, more as soon as they fit.
        assert_eq!(levels[1030], 2, "{:?}", &levels[1000..1060]);
        assert!(levels[2400] >= 6, "{:?}", &levels[2000..2500]);
    }

    #[test]
    fn a_program_that_waits_for_the_screen_gets_all_that_fit() {
        let mut governor = Governor::new(60.0, 8, 8);
        let screen: f32 = 1000.0 / 60.0;
        let levels = walk(&mut governor, 0..6000, |level, _, noise| {
            screen.max(noise * (4.0 + 2.3 * level as f32))
        });
        let late = &levels[3000..];
        assert!(late.iter().all(|level| [5, 6].contains(level)), "{late:?}");
        let fits = late.iter().filter(|&&level| level == 5).count();
        assert!(fits * 10 >= 9 * 3000, "{fits}");
    }

    #[test]
    fn above_the_most_it_is_all() {
        let governor = Governor::new(60.0, 48, 8);
        assert_eq!(governor.levels, [2, 3, 4, 5, 6, 7, 8, 48]);
        assert_eq!(Governor::new(60.0, 2, 8).level(), 2);
        let mut governor = Governor::new(60.0, 48, 8);
        let levels = walk(&mut governor, 0..6000, |level, _, noise| {
            noise * (2.0 + 0.5 * level as f32)
        });
        let late = levels[1000..].iter().filter(|&&level| level == 48).count();
        assert!(late * 20 <= 5000, "all 48 take 26 ms, {late} times");
        assert!(levels[1000..].iter().all(|&level| level >= 7));
    }
}
