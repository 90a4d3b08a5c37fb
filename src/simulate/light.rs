//! Stored colours and the light they stand for.
//!
//! From: IEC 61966-2-1 (sRGB), the transfer function.
#![forbid(unsafe_code)]

/// Tables, as every subpixel is looked up many times.
pub(super) struct Light {
    light: [f64; 256],
    /// The least light of the stored values from 1 on.
    least: [f64; 255],
}

impl Light {
    pub(super) fn new() -> Self {
        Self {
            light: std::array::from_fn(|stored| decoded(stored as f64)),
            least: std::array::from_fn(|stored| decoded(stored as f64 + 0.5)),
        }
    }

    /// Light, 0 to 1, of a stored value.
    pub(super) fn decoded(&self, stored: u8) -> f64 {
        self.light.get(usize::from(stored)).copied().unwrap_or(1.0)
    }

    /// The stored value that is nearest to some light.
    pub(super) fn encoded(&self, light: f64) -> u8 {
        self.least.partition_point(|&least| least <= light) as u8
    }
}

fn decoded(stored: f64) -> f64 {
    let c = stored / 255.0;
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}
