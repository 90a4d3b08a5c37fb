//! How many views are drawn when the others are synthesised: as many as the requested frame rate allows.
//!
//! Whole frames are timed, from swap to swap, so the number follows whatever the program, the driver and the machine do. It goes down as
//! soon as some frames take too long, and up only where one more view is expected to fit. A program that waits for the screen always
//! takes the same time, so nothing can be expected there: one more view is tried, less and less often if it fails.
#![forbid(unsafe_code)]

/// The fewest views. One view alone leaves too much of the others unknown: up to a twelfth of OpenArena's pictures, at 26 dB.
const FEWEST: u32 = 2;
/// Frames that are judged together, by their upper quartile: a rate is held only if most frames reach it, not half of them.
const WINDOW: usize = 16;
/// Frames after a change that are not counted yet.
const SETTLING: u32 = 2;
/// Parts of its time budget that a frame may take: for one window, and at most.
const OVER: [f32; 2] = [1.015, 1.25];
/// Part of its time budget that a frame with one more view may be expected to take.
const FITS: f32 = 0.95;
/// Part of the frame that one view is expected to take before the first change has measured it. A value too small costs one window that is
/// too slow; a value too large delays the first try.
const UNKNOWN: f32 = 0.25;
/// Frames between changes where one more view fits.
const HELD: u32 = 24;
/// Frames before one more view is tried although it is not expected to fit: the first time, and at most.
const TRIED: [u32; 2] = [240, 3840];

/// The number of drawn views of one program.
#[derive(Clone, Debug)]
pub struct Governor {
    /// Time of a frame at the requested rate, in milliseconds.
    budget: f32,
    /// Numbers of views, from few to all.
    levels: Vec<u32>,
    at: usize,
    window: Vec<f32>,
    /// The last window took more than a single window may.
    late: bool,
    settling: u32,
    /// Frames since the last change.
    held: u32,
    /// Frames before the next try.
    patience: u32,
    /// The last change was upwards, and no window was judged since.
    tried: bool,
    /// Milliseconds of the window before the last change, and the number of views then.
    before: Option<(f32, u32)>,
    /// Part of the whole frame that one view takes, where a change has measured it.
    share: Option<f32>,
}

impl Governor {
    /// For `rate` frames per second of `views` views. At most `most` of them are drawn, or all. Begins with the fewest.
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

    /// The number of views that the next frame draws.
    #[must_use]
    pub fn level(&self) -> u32 {
        self.levels.get(self.at).copied().unwrap_or(1)
    }

    /// Takes the milliseconds from the last frame's swap to this one's, and may change the number of views.
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
            // A number that was tried and did not fit is not tried again soon.
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
        // The last step goes from `most` to all views at once.
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

    /// Measures the share of one view from the last change.
    fn learn(&mut self, ms: f32) {
        let Some((before, level)) = self.before.take() else {
            return;
        };
        let views = self.level() as f32 - level as f32;
        let share = (ms - before) / views / ms.max(1e-3);
        // A scene that changed at the same time gives no usable share.
        if views != 0.0 && (0.01..1.0).contains(&share) {
            self.share = Some(share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drives it over frames that take `ms(level, frame, noise)`, with noise from 0.95 to 1.05; returns the levels.
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
        // Before a change, a view is expected to take a quarter of the frame, which is too much at 33 frames per second: it is tried later.
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
        // The number falls within a few frames, and rises as soon as more views fit.
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
