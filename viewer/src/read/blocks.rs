//! The order in which the blocks of a file are read.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Blocks of the points of a file, shared by those who read it. The first blocks are spread over the whole file: their numbers are those of a counter with
/// its bits reversed (van der Corput 1935).
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    points: u64,
    block: u64,
    next: Arc<AtomicU64>,
}

impl Blocks {
    pub(super) fn new(points: u64, block: u64) -> Self {
        Self {
            points,
            block,
            next: Arc::default(),
        }
    }

    /// The numbers of the points of a block that nobody has, counted from 0.
    pub(super) fn take(&self) -> Option<Range<u64>> {
        let blocks = self.points.div_ceil(self.block);
        let all = blocks.next_power_of_two();
        loop {
            let turn = self.next.fetch_add(1, Ordering::Relaxed);
            if turn >= all {
                return None;
            }
            let number = if all == 1 {
                0
            } else {
                turn.reverse_bits() >> (64 - all.trailing_zeros())
            };
            if number < blocks {
                let first = number * self.block;
                return Some(first..(first + self.block).min(self.points));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Blocks;

    #[test]
    fn every_point_is_in_one_block() {
        for points in [0, 1, 7, 8, 9, 1000, 1025] {
            let blocks = Blocks::new(points, 8);
            let mut seen: Vec<_> = std::iter::from_fn(|| blocks.take()).flatten().collect();
            assert_eq!(seen.first().copied(), (points > 0).then_some(0));
            seen.sort_unstable();
            assert_eq!(seen, (0..points).collect::<Vec<_>>());
        }
    }

    #[test]
    fn first_blocks_are_spread() {
        let blocks = Blocks::new(64, 8);
        let starts: Vec<_> = std::iter::from_fn(|| blocks.take())
            .map(|block| block.start / 8)
            .collect();
        assert_eq!(starts, [0, 4, 2, 6, 1, 5, 3, 7]);
    }
}
