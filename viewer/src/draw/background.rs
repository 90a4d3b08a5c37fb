//! The colour where nothing is drawn.

/// Red, green and blue.
pub const BACKGROUND: [f32; 3] = [0.02, 0.02, 0.03];
