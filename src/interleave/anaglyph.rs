//! Anaglyphs: two views mixed for coloured glasses.
//!
//! `anaglyph = L · left + R · right` with 3x3 matrices on linear light, clamped to 0 to 1.
//!
//! The least-squares matrices are those that E. Dubois published for LCD screens ("Conversion of a stereo pair to anaglyph with
//! the least-squares projection method", 2009, and its tables for the other glasses). Luminance has the weights of Rec. 709.
#![forbid(unsafe_code)]

use crate::config::{Anaglyph, Glasses, Mixture};

/// Rows are R, G and B of the anaglyph, columns are R, G and B of the view.
pub type Matrix = [[f32; 3]; 3];

/// Weights of linear light (Rec. 709).
const LUMINANCE: [f32; 3] = [0.2126, 0.7152, 0.0722];

impl Anaglyph {
    /// The matrices of the left and the right view.
    pub fn matrices(self) -> (Matrix, Matrix) {
        match self.mixture {
            Mixture::Dubois => dubois(self.glasses),
            Mixture::Grey => {
                let grey = [LUMINANCE; 3];
                self.glasses.split(grey, grey)
            }
            Mixture::HalfColour => {
                let grey = [LUMINANCE; 3];
                let colour = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                // The eye whose glass passes two colours sees colour, the other one sees grey.
                match self.glasses {
                    Glasses::AmberBlue => self.glasses.split(colour, grey),
                    Glasses::RedCyan | Glasses::GreenMagenta => self.glasses.split(grey, colour),
                }
            }
        }
    }
}

impl Glasses {
    /// Keeps the rows of each matrix that its own glass passes.
    fn split(self, left: Matrix, right: Matrix) -> (Matrix, Matrix) {
        let own = match self {
            Self::RedCyan => [true, false, false],
            Self::GreenMagenta => [false, true, false],
            Self::AmberBlue => [true, true, false],
        };
        let rows = |matrix: Matrix, wanted: bool| {
            let mut rows = matrix;
            for (row, own) in rows.iter_mut().zip(own) {
                if own != wanted {
                    *row = [0.0; 3];
                }
            }
            rows
        };
        (rows(left, true), rows(right, false))
    }
}

fn dubois(glasses: Glasses) -> (Matrix, Matrix) {
    match glasses {
        Glasses::RedCyan => (
            [
                [0.437, 0.449, 0.164],
                [-0.062, -0.062, -0.024],
                [-0.048, -0.050, -0.017],
            ],
            [
                [-0.011, -0.032, -0.007],
                [0.377, 0.761, 0.009],
                [-0.026, -0.093, 1.234],
            ],
        ),
        Glasses::GreenMagenta => (
            [
                [-0.062, -0.158, -0.039],
                [0.284, 0.668, 0.143],
                [-0.015, -0.027, 0.021],
            ],
            [
                [0.529, 0.705, 0.024],
                [-0.016, -0.015, -0.065],
                [0.009, 0.075, 0.937],
            ],
        ),
        Glasses::AmberBlue => (
            [
                [1.062, -0.205, 0.299],
                [-0.026, 0.908, 0.068],
                [-0.038, -0.173, 0.022],
            ],
            [
                [-0.016, -0.123, -0.017],
                [0.006, 0.062, -0.017],
                [0.094, 0.185, 0.911],
            ],
        ),
    }
}
