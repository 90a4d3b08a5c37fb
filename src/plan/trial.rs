//! `auto`: finds the fastest strategy for this program on this driver, by drawing its own frames with each strategy in turn.
//!
//! All strategies make the same pictures, so nobody sees the trial. Whole frames are timed, because only the sum matters: a strategy
//! replays the draws that it cannot make itself, and its layout of the atlas has a cost beyond the single draw.

use crate::config::Strategy;

/// Frames before the trial begins: programs still load while they show the first ones.
const WARM: u32 = 12;
/// Frames of one turn of a strategy. The first of them is not counted, since it makes an atlas and compiles shaders.
const BLOCK: u32 = 4;
/// Turns of each strategy.
const ROUNDS: usize = 4;
/// Part of replay's median time that another strategy's may take at most. Replay has the advantage because it is exact and needs no
/// shaders.
const BETTER: f32 = 0.92;
/// A frame belongs to another scene if it takes this many times as long as the frames of the trial, or as many times less ...
const OTHER: f32 = 2.0;
/// ... and the scene is tried anew if that lasts for as many frames.
const LASTING: u32 = 120;

/// How far the trial is.
#[derive(Clone, Debug, PartialEq)]
enum Stage {
    /// Frames before the trial begins.
    Warming(u32),
    /// Frames drawn so far, over all turns.
    Trying(u32),
    /// The strategy is known from an earlier run. Milliseconds of the frames so far, from which the typical time of the scene is taken.
    Known(Vec<f32>),
    /// Milliseconds of a frame at the end of the trial, and the number of frames in a row that took a very different time.
    Done(f32, u32),
}

/// The trial of one program.
#[derive(Clone, Debug)]
pub struct Trial {
    candidates: Vec<Strategy>,
    /// Milliseconds, by candidate.
    times: Vec<Vec<f32>>,
    stage: Stage,
    chosen: Strategy,
}

impl Trial {
    /// A trial of `candidates`, of which the first is preferred. With `known`, the outcome of an earlier trial, nothing is tried.
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

    /// The strategy that draws the next frame.
    pub fn strategy(&self) -> Strategy {
        match self.stage {
            Stage::Trying(frame) => self.candidate(frame).1,
            _ => self.chosen,
        }
    }

    /// Whether this frame is timed, so that the driver has to finish it first.
    pub fn measures(&self) -> bool {
        matches!(self.stage, Stage::Trying(_))
    }

    /// Takes the milliseconds from the last frame's swap to this one's; returns the strategy once it has been found.
    /// `made`: the strategy made at least one draw of the frame itself. A frame of replayed draws only is no gain of the strategy.
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

    /// The candidate whose turn a frame is, and its index.
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

    /// Draws frames that take `ms` milliseconds by strategy, until a strategy is found.
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
            // The gain is too small.
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
                // If the first frames counted, half of all frames would be slow.
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
        // Frames take longer while the program loads, which is no other scene.
        for frame in 0..1000 {
            assert_eq!(known.frame(if frame < 9 { 200.0 } else { 5.0 }, true), None);
            assert!(!known.measures());
        }
        let mut only = Trial::new(vec![Strategy::Replay], Some(Strategy::Geometry));
        assert_eq!(only.strategy(), Strategy::Replay);
        assert!((0..500).all(|_| only.frame(3.0, true).is_none() && !only.measures()));
    }
}
