//! Phases in whole numbers.
//!
//! The phase of a subpixel, in turns (one turn is one lens), is affine along a row:
//! `phase(x, c) = (start + x · step + colour[x mod 2][c]) / turn`, all of them whole numbers of a unit that the kind of panel
//! chooses. For rational optics the boundaries between views fall exactly on subpixels, where floats flip up to half of the
//! views; and a phase kept modulo 1 in a float loses digits with every lens of a wide screen.
#![forbid(unsafe_code)]

use super::SubpixelOrder;

/// Largest turn: times a position of 32 bits or a view of 16 bits it has to stay inside 127 bits.
pub(super) const LARGEST_TURN: i128 = 1 << 94;

/// How views follow the phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    /// `⌊N · φ⌋`
    Up,
    /// `⌊N · (1 − φ)⌋`, and N − 1 where φ is 0.
    Down,
}

/// The constants that all rows of a panel share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    turn: i128,
    step: i128,
    direction: Direction,
}

/// One row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Phase at x = 0.
    pub(super) start: i128,
    /// Added for R, G and B, in even and in odd columns.
    pub(super) colours: [[i128; 3]; 2],
}

impl Lattice {
    /// None where the turn is not in 1 to 2^94 units.
    pub(super) fn new(turn: i128, step: i128, direction: Direction) -> Option<Self> {
        (1..=LARGEST_TURN).contains(&turn).then(|| Self {
            turn,
            step: step.rem_euclid(turn),
            direction,
        })
    }

    /// The views of a row from column `first` on.
    pub(super) fn fill(&self, first: i64, row: &Row, views: u32, out: &mut [[u16; 3]]) {
        self.fill_wide(self.starts(first, row), views, out);
    }

    /// As [`Lattice::fill`], with something added to the phases: `bias(i)` units for the i-th pixel of `out`.
    pub(super) fn fill_biased(
        &self,
        first: i64,
        row: &Row,
        views: u32,
        bias: impl Fn(usize) -> i128,
        out: &mut [[u16; 3]],
    ) {
        let starts = self.starts(first, row);
        for (i, out) in out.iter_mut().enumerate() {
            let at = starts[i % 2];
            let bias = bias(i);
            *out = at.map(|phase| {
                let phase = phase + i as i128 * self.step + bias;
                self.view(phase.rem_euclid(self.turn), views)
            });
        }
    }

    /// Phases of the first pixel, in 0 .. turn, if it were in `[this column's class, the other one]`.
    fn starts(&self, first: i64, row: &Row) -> [[i128; 3]; 2] {
        let start = row.start + i128::from(first) * self.step;
        let class = first.rem_euclid(2) as usize;
        [class, 1 - class]
            .map(|class| row.colours[class].map(|colour| (start + colour).rem_euclid(self.turn)))
    }

    /// Phases as 64-bit fractions of a turn; next to a boundary between views the exact phase decides.
    fn fill_wide(&self, starts: [[i128; 3]; 2], views: u32, out: &mut [[u16; 3]]) {
        let step = self.fraction(self.step);
        let fractions = starts.map(|class| class.map(|phase| self.fraction(phase)));
        // A fraction is below the true one by less than 2^-64, a step as well; 2^19 steps stay below 2^-44.
        let near = u64::from(views) << 20;
        for (i, out) in out.iter_mut().enumerate() {
            for (c, out) in out.iter_mut().enumerate() {
                let fraction = fractions[i % 2][c].wrapping_add(step.wrapping_mul(i as u64));
                let fraction = match self.direction {
                    Direction::Up => fraction,
                    Direction::Down => fraction.wrapping_neg(),
                };
                let wide = u128::from(fraction) * u128::from(views);
                let (view, rest) = ((wide >> 64) as u16, wide as u64);
                *out = if rest < near || rest > u64::MAX - near {
                    let phase = starts[i % 2][c] + i as i128 * self.step;
                    self.view(phase.rem_euclid(self.turn), views)
                } else {
                    view
                };
            }
        }
    }

    /// The view of a phase in 0 .. turn.
    fn view(&self, phase: i128, views: u32) -> u16 {
        let n = i128::from(views);
        match self.direction {
            Direction::Up => (n * phase / self.turn) as u16,
            Direction::Down => (n * (self.turn - phase) / self.turn).min(n - 1) as u16,
        }
    }

    /// ⌊2^64 · phase / turn⌋ of a phase in 0 .. turn.
    fn fraction(&self, phase: i128) -> u64 {
        let high = phase << 32;
        let low = (high % self.turn) << 32;
        (((high / self.turn) << 32) | (low / self.turn)) as u64
    }
}

/// From position in a pixel, left to right, to R, G and B.
pub(super) fn by_colour(order: SubpixelOrder, positions: [i128; 3]) -> [i128; 3] {
    let [a, b, c] = positions;
    match order {
        SubpixelOrder::Rgb => [a, b, c],
        SubpixelOrder::Bgr => [c, b, a],
    }
}
