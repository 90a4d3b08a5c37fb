//! `auto`: the strategy by which this program, on this driver, is drawn fastest, found by drawing its own frames by each in turn.
//!
//! All strategies make the same pictures, so nobody sees it. Whole frames are timed: what a strategy cannot make is replayed, what
//! lies where costs more than one draw, and only the sum matters.

use crate::config::Strategy;

/// Frames before it begins: programs load while they show the first ones.
const WARM: u32 = 12;
/// Frames by one strategy before the next has its turn; the first of them, which makes an atlas and compiles shaders, is not counted.
const BLOCK: u32 = 4;
/// Turns of each.
const ROUNDS: usize = 4;
/// What another strategy's median has to be of replay's, which is exact and takes no shaders.
const BETTER: f32 = 0.92;
/// A scene that takes more or less than this many times as long as the one that was tried is another one ...
const OTHER: f32 = 2.0;
/// ... if it does so for as many frames.
const LASTING: u32 = 120;

/// How far it is.
#[derive(Clone, Debug, PartialEq)]
enum Stage {
    /// Frames to come.
    Warming(u32),
    /// Frames drawn so far, of all turns.
    Trying(u32),
    /// Known from before: milliseconds of the frames so far, to know the scene by.
    Known(Vec<f32>),
    /// Milliseconds of a frame then, and frames since it takes another time.
    Done(f32, u32),
}

/// One program's.
#[derive(Clone, Debug)]
pub struct Trial {
    candidates: Vec<Strategy>,
    /// Milliseconds, by candidate.
    times: Vec<Vec<f32>>,
    stage: Stage,
    chosen: Strategy,
}

impl Trial {
    /// Among strategies, the first of which is preferred; begins with `known`, the outcome of an earlier one, and is over then.
    pub fn new(candidates: Vec<Strategy>, known: Option<Strategy>) -> Trial {
        let first = candidates.first().copied().unwrap_or(Strategy::Replay);
        let known = known.filter(|known| candidates.contains(known));
        let stage = match known {
            None if candidates.len() > 1 => Stage::Warming(WARM),
            _ => Stage::Known(Vec::new()),
        };
        Trial {
            times: vec![Vec::new(); candidates.len()],
            candidates,
            stage,
            chosen: known.unwrap_or(first),
        }
    }

    /// By which the next frame is to be drawn.
    pub fn strategy(&self) -> Strategy {
        match self.stage {
            Stage::Trying(frame) => self.candidate(frame).1,
            _ => self.chosen,
        }
    }

    /// Whether the time of this frame counts, so that the driver has to finish it.
    pub fn measures(&self) -> bool {
        matches!(self.stage, Stage::Trying(_))
    }

    /// Milliseconds that a frame took from the one before; answers the strategy when it has been found.
    /// `made`: the strategy made a draw of it itself; what it only has replayed, in the layout that suits it and not replay, is no gain
    /// of its own.
    pub fn frame(&mut self, ms: f32, made: bool) -> Option<Strategy> {
        match &mut self.stage {
            Stage::Warming(0) => self.stage = Stage::Trying(0),
            Stage::Warming(left) => *left -= 1,
            Stage::Trying(frame) => {
                let frame = *frame;
                let (index, strategy) = self.candidate(frame);
                let own = made || strategy == Strategy::Replay;
                if frame % BLOCK > 0
                    && let Some(times) = self.times.get_mut(index)
                {
                    times.push(if own { ms } else { f32::MAX });
                }
                let frames = BLOCK * (ROUNDS * self.candidates.len()) as u32;
                if frame + 1 < frames {
                    self.stage = Stage::Trying(frame + 1);
                } else {
                    return Some(self.decide());
                }
            }
            Stage::Known(times) => {
                times.push(ms);
                if times.len() == 2 * WARM as usize {
                    self.stage = Stage::Done(median(&times[WARM as usize..]), 0);
                }
            }
            Stage::Done(then, since) => {
                let other = ms > *then * OTHER || ms < *then / OTHER;
                *since = if other { *since + 1 } else { 0 };
                if *since == LASTING && self.candidates.len() > 1 {
                    self.times.iter_mut().for_each(Vec::clear);
                    self.stage = Stage::Trying(0);
                }
            }
        }
        None
    }

    /// Whose turn a frame is.
    fn candidate(&self, frame: u32) -> (usize, Strategy) {
        let index = (frame / BLOCK) as usize % self.candidates.len().max(1);
        (
            index,
            self.candidates.get(index).copied().unwrap_or(self.chosen),
        )
    }

    fn decide(&mut self) -> Strategy {
        let medians: Vec<f32> = self.times.iter().map(|times| median(times)).collect();
        let first = medians.first().copied().unwrap_or(0.0);
        let best = (0..medians.len()).min_by(|&a, &b| medians[a].total_cmp(&medians[b]));
        let best = best.filter(|&best| medians[best] < first * BETTER);
        let best = best.unwrap_or(0);
        self.chosen = self.candidates.get(best).copied().unwrap_or(self.chosen);
        self.stage = Stage::Done(medians.get(best).copied().unwrap_or(0.0), 0);
        self.chosen
    }
}

fn median(times: &[f32]) -> f32 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f32::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Strategy; 3] = [Strategy::Replay, Strategy::Instanced, Strategy::Geometry];

    /// Draws frames that take `ms` by strategy, until one is found.
    fn find(trial: &mut Trial, mut ms: impl FnMut(Strategy, u32) -> f32) -> (Strategy, u32) {
        for frame in 0..1000 {
            let time = ms(trial.strategy(), frame);
            if let Some(found) = trial.frame(time, true) {
                assert_eq!(trial.strategy(), found);
                return (found, frame + 1);
            }
        }
        panic!("nothing was found");
    }

    #[test]
    fn the_fastest_is_found_in_a_second_of_frames() {
        for (times, best) in [
            ([8.0, 5.0, 20.0], Strategy::Instanced),
            ([8.0, 9.0, 4.0], Strategy::Geometry),
            ([8.0, 9.0, 20.0], Strategy::Replay),
            // Not worth it.
            ([8.0, 7.8, 20.0], Strategy::Replay),
        ] {
            let mut trial = Trial::new(ALL.to_vec(), None);
            let time = |strategy, frame: u32| {
                let index = ALL.iter().position(|&s| s == strategy).unwrap();
                // One frame of seven hangs, as on any machine.
                times[index] * if frame % 7 == 3 { 30.0 } else { 1.0 }
            };
            let (found, frames) = find(&mut trial, time);
            assert_eq!(found, best);
            assert!(frames <= 64, "{frames}");
        }
    }

    #[test]
    fn the_first_frame_of_a_turn_is_not_counted() {
        let mut trial = Trial::new(ALL.to_vec(), None);
        let (mut last, mut turn) = (None, 0);
        let (found, _) = find(&mut trial, move |strategy, _| {
            turn = if last.replace(strategy) == Some(strategy) {
                turn + 1
            } else {
                1
            };
            match strategy {
                // With the first ones half of all frames would be slow.
                Strategy::Instanced if turn <= 2 => 500.0,
                Strategy::Instanced => 1.0,
                _ => 2.0,
            }
        });
        assert_eq!(found, Strategy::Instanced);
    }

    #[test]
    fn what_is_only_replayed_is_not_taken() {
        for made in [true, false] {
            let mut trial = Trial::new(ALL.to_vec(), None);
            let found = (0..1000).find_map(|_| match trial.strategy() {
                Strategy::Instanced => trial.frame(1.0, made),
                _ => trial.frame(2.0, true),
            });
            let best = if made {
                Strategy::Instanced
            } else {
                Strategy::Replay
            };
            assert_eq!(found, Some(best));
        }
    }

    #[test]
    fn another_scene_is_tried_anew_and_a_short_one_is_not() {
        let mut trial = Trial::new(ALL.to_vec(), None);
        find(&mut trial, |_, _| 4.0);
        for frame in 0..1000 {
            // A hundred frames of a menu, then the game again.
            assert_eq!(
                trial.frame(if frame % 110 < 100 { 0.5 } else { 4.0 }, true),
                None
            );
            assert!(!trial.measures());
        }
        let (found, _) = find(&mut trial, |strategy, _| match strategy {
            Strategy::Instanced => 20.0,
            _ => 40.0,
        });
        assert_eq!(found, Strategy::Instanced);
    }

    #[test]
    fn what_is_known_is_taken_and_what_cannot_be_is_not() {
        let mut known = Trial::new(ALL.to_vec(), Some(Strategy::Geometry));
        assert_eq!(known.strategy(), Strategy::Geometry);
        // Loading takes longer, and is no scene.
        for frame in 0..1000 {
            assert_eq!(known.frame(if frame < 9 { 200.0 } else { 5.0 }, true), None);
            assert!(!known.measures());
        }
        let mut only = Trial::new(vec![Strategy::Replay], Some(Strategy::Geometry));
        assert_eq!(only.strategy(), Strategy::Replay);
        assert!((0..500).all(|_| only.frame(3.0, true).is_none() && !only.measures()));
    }
}
