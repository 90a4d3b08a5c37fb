//! Pieces of surfaces on their way into voxels.
//!
//! Each thread collects its pieces by half plane, and then each half plane is put together by one thread: no locks, and the voxels that
//! are worked on fit into a cache. The result does not depend on the number of threads.

use super::display::{Cells, Place};
use super::{RotatingScreen, Volume, Voxel};
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bits of a channel's sum, and pieces that fit; further ones are left out.
const SUM: u32 = 18;
const MOST: u64 = (1 << (64 - 3 * SUM)) - 1;

/// Room for pieces of a half plane, to begin with.
const FIRST: usize = 256;

/// Red, green and blue in the low three bytes.
pub(super) fn packed([r, g, b]: [u8; 3]) -> u32 {
    u32::from_le_bytes([r, g, b, 0])
}

/// The pieces that one thread has made.
pub(super) struct Fragments {
    pub(super) cells: Cells,
    /// By half plane: the voxel in the high half, the colour in the low one.
    pieces: Vec<Vec<u64>>,
}

impl Fragments {
    pub(super) fn new(cells: Cells) -> Fragments {
        Fragments {
            cells,
            pieces: (0..cells.half_planes)
                .map(|_| Vec::with_capacity(FIRST))
                .collect(),
        }
    }

    /// A piece of a surface at a place, if that is within the sphere.
    #[inline(always)]
    pub(super) fn put(&mut self, place: Place, colour: u32) {
        if self.cells.inside(place) {
            let (half_plane, at) = self.cells.voxel(place);
            if let Some(pieces) = self.pieces.get_mut(half_plane as usize) {
                pieces.push(u64::from(at) << 32 | u64::from(colour));
            }
        }
    }
}

/// How many threads there are to work with.
pub(super) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Runs a function on consecutive parts of `items`, one for each thread, and puts what they have made into voxels.
pub(super) fn collect<T: Sync>(
    screen: &RotatingScreen,
    items: &[T],
    part: impl Fn(&[T], &mut Fragments) + Sync,
) -> Volume {
    let cells = Cells::of(screen);
    let each = items.len().div_ceil(threads()).max(1);
    let parts: Vec<Fragments> = std::thread::scope(|scope| {
        let started: Vec<_> = items
            .chunks(each)
            .map(|items| {
                let part = &part;
                scope.spawn(move || {
                    let mut fragments = Fragments::new(cells);
                    part(items, &mut fragments);
                    fragments
                })
            })
            .collect();
        let done = started.into_iter().map(|thread| thread.join());
        done.map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    Volume {
        screen: *screen,
        half_planes: by_number(cells.half_planes, || {
            let mut sums = Sums::new(cells.columns * cells.rows);
            let parts = &parts;
            move |half_plane: u32| {
                for part in parts {
                    for &piece in part.pieces.get(half_plane as usize).into_iter().flatten() {
                        sums.add((piece >> 32) as u32, piece as u32);
                    }
                }
                sums.taken()
            }
        }),
    }
}

/// What a function makes of the numbers below `end`, in order, each thread with a function of its own.
pub(super) fn by_number<T: Send, F: FnMut(u32) -> T>(
    end: u32,
    with: impl Fn() -> F + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let mut done: Vec<(u32, T)> = std::thread::scope(|scope| {
        let started: Vec<_> = (0..threads())
            .map(|_| {
                scope.spawn(|| {
                    let mut make = with();
                    let mut done = Vec::new();
                    loop {
                        let number = next.fetch_add(1, Ordering::Relaxed) as u32;
                        if number >= end {
                            return done;
                        }
                        done.push((number, make(number)));
                    }
                })
            })
            .collect();
        let done = started.into_iter().map(|thread| thread.join());
        done.flat_map(|part| part.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    done.sort_unstable_by_key(|&(number, _)| number);
    done.into_iter().map(|(_, made)| made).collect()
}

/// The sums of one half plane.
struct Sums {
    /// Number of pieces, then the sums of blue, green and red, from the highest bit down; valid where `set` says so.
    sums: Vec<u64>,
    /// A bit for each voxel.
    set: Vec<u64>,
    /// A bit for each element of `set` that is not 0.
    some: Vec<u64>,
    count: usize,
}

impl Sums {
    fn new(voxels: u32) -> Sums {
        let words = voxels.div_ceil(64) as usize;
        Sums {
            sums: vec![0; voxels as usize],
            set: vec![0; words],
            some: vec![0; words.div_ceil(64)],
            count: 0,
        }
    }

    #[inline(always)]
    fn add(&mut self, at: u32, colour: u32) {
        let channel = |index: u32| u64::from(colour >> (8 * index) & 0xff) << (SUM * index);
        let piece = channel(0) | channel(1) | channel(2) | 1 << (3 * SUM);
        let (word, bit) = (at as usize / 64, 1 << (at % 64));
        let (Some(set), Some(sum)) = (self.set.get_mut(word), self.sums.get_mut(at as usize))
        else {
            return;
        };
        if *set & bit == 0 {
            *set |= bit;
            *sum = piece;
            self.count += 1;
            if let Some(some) = self.some.get_mut(word / 64) {
                *some |= 1 << (word % 64);
            }
        } else if *sum >> (3 * SUM) < MOST {
            *sum += piece;
        }
    }

    /// The voxels in order, with the means of their pieces; nothing is left.
    fn taken(&mut self) -> Vec<Voxel> {
        let mut voxels = Vec::with_capacity(self.count);
        self.count = 0;
        for (group, some) in self.some.iter_mut().enumerate() {
            for word in bits(std::mem::take(some)) {
                let word = 64 * group + word;
                let Some(set) = self.set.get_mut(word) else {
                    continue;
                };
                for bit in bits(std::mem::take(set)) {
                    let at = 64 * word + bit;
                    let Some(&sum) = self.sums.get(at) else {
                        continue;
                    };
                    let count = (sum >> (3 * SUM)) as u32;
                    let mean = |index: u32| {
                        let sum = (sum >> (SUM * index)) as u32 & ((1 << SUM) - 1);
                        match count {
                            1 => sum as u8,
                            _ => ((sum + count / 2) / count) as u8,
                        }
                    };
                    voxels.push(Voxel {
                        at: at as u32,
                        colour: [mean(0), mean(1), mean(2)],
                    });
                }
            }
        }
        voxels
    }
}

/// The places of the bits that are set, from the lowest.
fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (bit < 64).then_some(bit as usize)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_voxel_has_the_mean_of_its_pieces() {
        let mut sums = Sums::new(1000);
        sums.add(999, packed([10, 20, 255]));
        sums.add(999, packed([20, 20, 0]));
        sums.add(3, packed([1, 2, 3]));
        for _ in 0..5000 {
            sums.add(64, packed([255, 255, 254]));
        }
        let voxel = |at, colour| Voxel { at, colour };
        let wanted = [
            voxel(3, [1, 2, 3]),
            voxel(64, [255, 255, 254]),
            voxel(999, [15, 20, 128]),
        ];
        assert_eq!(sums.taken(), wanted);
        assert_eq!(sums.taken(), []);
    }
}
