//! Random numbers that are the same in every run, for splats that nobody has chosen.
#![forbid(unsafe_code)]

/// The generator xorshift of 64 bits.
#[derive(Debug)]
pub(crate) struct Random(u64);

impl Random {
    /// `seed`: not zero.
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number from `low` up to `high`.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
