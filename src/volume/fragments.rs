//! Pieces of surfaces on their way into voxels.
//!
//! Each thread collects its pieces by half plane, and then each half plane is put together by one thread: no locks, and the voxels that
//! are worked on fit into a cache. The result does not depend on the number of threads, nor on the order of their work.

use super::display::{Cells, Place};
use super::{RotatingScreen, Volume, Voxel};
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bits of a channel's sum, and pieces that fit.
const SUM: u32 = 18;
const MOST: u64 = (1 << (64 - 3 * SUM)) - 1;

/// Pieces of a half plane that are stored in one block.
const CHUNK: usize = 1024;

/// Parts of the work per thread; a thread that has finished its own takes those of another.
const PARTS: usize = 16;

/// Red, green and blue in the low three bytes.
pub(super) fn packed([r, g, b]: [u8; 3]) -> u32 {
    u32::from_le_bytes([r, g, b, 0])
}

/// The pieces that one thread has made.
pub(super) struct Fragments {
    pub(super) cells: Cells,
    /// By half plane: the voxel in the high half, the colour in the low one.
    pieces: Vec<Vec<u64>>,
    /// Full blocks by half plane, so that pieces are never moved.
    full: Vec<Vec<Vec<u64>>>,
}

impl Fragments {
    pub(super) fn new(cells: Cells) -> Fragments {
        Fragments {
            cells,
            pieces: (0..cells.half_planes)
                .map(|_| Vec::with_capacity(CHUNK))
                .collect(),
            full: vec![Vec::new(); cells.half_planes as usize],
        }
    }

    /// Adds a piece of a surface at a place, if that is within the sphere.
    #[inline(always)]
    pub(super) fn put(&mut self, place: Place, colour: u32) {
        if self.cells.inside(place) {
            self.push(self.cells.voxel(place), colour);
        }
    }

    /// Adds the first `count` of some pieces.
    #[inline(always)]
    pub(super) fn put_all<const N: usize>(
        &mut self,
        places: &[Place; N],
        colours: &[u32; N],
        count: usize,
    ) {
        let cells = self.cells;
        let mut voxels = [(0, 0); N];
        let mut inside = [false; N];
        for ((voxel, inside), &place) in voxels.iter_mut().zip(&mut inside).zip(places) {
            (*voxel, *inside) = (cells.voxel(place), cells.inside(place));
        }
        let pieces = voxels.iter().zip(&inside).zip(colours).take(count);
        for ((&voxel, _), &colour) in pieces.filter(|((_, inside), _)| **inside) {
            self.push(voxel, colour);
        }
    }

    #[inline(always)]
    fn push(&mut self, (half_plane, at): (u32, u32), colour: u32) {
        if let Some(pieces) = self.pieces.get_mut(half_plane as usize) {
            if pieces.len() == pieces.capacity() {
                renew(pieces, self.full.get_mut(half_plane as usize));
            }
            pieces.push(u64::from(at) << 32 | u64::from(colour));
        }
    }

    /// The pieces of a half plane.
    fn of(&self, half_plane: u32) -> impl Iterator<Item = &[u64]> {
        let full = self.full.get(half_plane as usize).into_iter().flatten();
        full.chain(self.pieces.get(half_plane as usize))
            .map(Vec::as_slice)
    }
}

/// Moves a full block to the others.
#[cold]
fn renew(pieces: &mut Vec<u64>, full: Option<&mut Vec<Vec<u64>>>) {
    if let Some(full) = full {
        full.push(std::mem::replace(pieces, Vec::with_capacity(CHUNK)));
    }
}

/// Number of threads to work with.
pub(super) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Runs a function on consecutive parts of `items` and collects its pieces in voxels.
pub(super) fn collect<T: Sync>(
    screen: &RotatingScreen,
    items: &[T],
    part: impl Fn(&[T], &mut Fragments) + Sync,
) -> Volume {
    let cells = Cells::of(screen);
    let each = items.len().div_ceil(PARTS * threads()).max(1);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut fragments = Fragments::new(cells);
        loop {
            let first = next.fetch_add(each, Ordering::Relaxed);
            let rest = items.get(first..).unwrap_or_default();
            if rest.is_empty() {
                return fragments;
            }
            part(rest.get(..each).unwrap_or(rest), &mut fragments);
        }
    };
    let parts: Vec<Fragments> = std::thread::scope(|scope| {
        let started: Vec<_> = (0..threads()).map(|_| scope.spawn(work)).collect();
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
                    for pieces in part.of(half_plane) {
                        for &piece in pieces {
                            sums.add((piece >> 32) as u32, piece as u32);
                        }
                    }
                }
                sums.taken()
            }
        }),
    }
}

/// The results of a function for the numbers below `end`, in order. Each thread gets a function of its own.
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
    /// Sums that were full, with their voxels.
    full: Vec<(usize, u64)>,
}

impl Sums {
    fn new(voxels: u32) -> Sums {
        let words = voxels.div_ceil(64) as usize;
        Sums {
            sums: vec![0; voxels as usize],
            set: vec![0; words],
            some: vec![0; words.div_ceil(64)],
            count: 0,
            full: Vec::new(),
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
        // Whether a piece is the first of its voxel is unpredictable, so there is no branch.
        let had = u64::from(*set & bit != 0);
        let before = *sum & had.wrapping_neg();
        // A full sum overflows and is moved below.
        *sum = before.wrapping_add(piece);
        *set |= bit;
        self.count += 1 - had as usize;
        if let Some(some) = self.some.get_mut(word / 64) {
            *some |= 1 << (word % 64);
        }
        if before >> (3 * SUM) == MOST {
            self.full.push((at as usize, before));
            *sum = piece;
        }
    }

    /// The voxels in order, with the mean colours of their pieces. Resets the sums.
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
                    let colour = match self.full.is_empty() {
                        true => mean(parts(sum)),
                        false => mean(whole(&self.full, at, sum)),
                    };
                    let at = at as u32;
                    voxels.push(Voxel { at, colour });
                }
            }
        }
        self.full.clear();
        voxels
    }
}

/// The parts of a voxel's sum, including sums that were full.
#[cold]
fn whole(full: &[(usize, u64)], at: usize, sum: u64) -> [u32; 4] {
    let mut whole = parts(sum);
    for &(_, full) in full.iter().filter(|full| full.0 == at) {
        for (whole, part) in whole.iter_mut().zip(parts(full)) {
            *whole += part;
        }
    }
    whole
}

/// The factor that divides a sum by `count`, shifted by 36 bits.
const fn part_of_one(count: u32) -> u64 {
    (1 << 36) / count as u64 + 1
}

/// Factors for all counts that fit into a sum: without them each voxel would cost a division.
static PARTS_OF_ONE: [u64; MOST as usize + 1] = {
    let mut parts = [0; MOST as usize + 1];
    let mut count = 1;
    while count < parts.len() {
        parts[count] = part_of_one(count as u32);
        count += 1;
    }
    parts
};

/// The sums of red, green and blue, and the number of pieces.
#[inline(always)]
fn parts(sum: u64) -> [u32; 4] {
    let channel = |index: u32| (sum >> (SUM * index)) as u32 & ((1 << SUM) - 1);
    [
        channel(0),
        channel(1),
        channel(2),
        (sum >> (3 * SUM)) as u32,
    ]
}

#[inline(always)]
fn mean([red, green, blue, count]: [u32; 4]) -> [u8; 3] {
    // Exact while the sum times the count is below 2^36: for 16,000 pieces.
    let part = match PARTS_OF_ONE.get(count as usize) {
        Some(&part) => part,
        None => part_of_one(count),
    };
    [red, green, blue].map(|sum| ((u64::from(sum + count / 2) * part) >> 36) as u8)
}

/// The indices of the set bits, from the lowest.
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
        for piece in 0..5000 {
            sums.add(65, packed([if piece < 2500 { 10 } else { 20 }, 0, 254]));
        }
        let voxel = |at, colour| Voxel { at, colour };
        let wanted = [
            voxel(3, [1, 2, 3]),
            voxel(64, [255, 255, 254]),
            voxel(65, [15, 0, 254]),
            voxel(999, [15, 20, 128]),
        ];
        assert_eq!(sums.taken(), wanted);
        assert_eq!(sums.taken(), []);
    }
}
