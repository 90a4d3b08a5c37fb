//! Draws that a view does not see at all: their bounds are tested against the sides of its frustum.

/// The smallest axis-aligned box around positions, in their own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    low: [f32; 3],
    high: [f32; 3],
}

/// Distance from a side in clip space, relative to the size of the coordinates. A point closer than this counts as inside, because the
/// driver rounds differently.
const MARGIN: f32 = 1e-4;

impl Bounds {
    /// The bounds of no position.
    pub const EMPTY: Bounds = Bounds {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    /// Extends the box to a position.
    #[inline]
    pub fn add(&mut self, position: [f32; 3]) {
        for ((low, high), p) in self.low.iter_mut().zip(&mut self.high).zip(position) {
            // Not min and max: they would drop a NaN, which has to stay.
            if p < *low || p.is_nan() {
                *low = p;
            }
            if p > *high || p.is_nan() {
                *high = p;
            }
        }
    }

    /// Whether the box lies wholly beyond one side of the frustum: left, right, bottom or top. No triangle between its positions then
    /// covers a pixel. `rows` are rows 0, 1 and 3 of the projection times the modelview matrix; they give x, y and w of clip space.
    pub fn outside(&self, rows: &[[f32; 4]; 3]) -> bool {
        let corners = (0..8u8).map(|corner| {
            let at = |axis: usize| {
                let side = if corner >> axis & 1 == 0 {
                    self.low
                } else {
                    self.high
                };
                side.get(axis).copied().unwrap_or(f32::NAN)
            };
            let vertex = [at(0), at(1), at(2), 1.0];
            rows.map(|row| {
                let terms = row.iter().zip(vertex).map(|(a, b)| a * b);
                // The sum, and the sum of the magnitudes of its terms.
                terms.fold((0.0f32, 0.0f32), |(sum, size), t| (sum + t, size + t.abs()))
            })
        });
        let mut beyond = [true; 4];
        for [x, y, w] in corners {
            // A NaN is beyond no side.
            let past = |(v, size): (f32, f32), sign: f32| w.0 + sign * v < -MARGIN * (w.1 + size);
            let sides = [past(x, 1.0), past(x, -1.0), past(y, 1.0), past(y, -1.0)];
            for (beyond, past) in beyond.iter_mut().zip(sides) {
                *beyond &= past;
            }
        }
        beyond.contains(&true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// glFrustum(-1, 1, -1, 1, 1, 10): x, y, w.
    const ROWS: [[f32; 4]; 3] = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
    ];

    fn outside(positions: &[[f32; 3]]) -> bool {
        let mut bounds = Bounds::EMPTY;
        positions.iter().for_each(|&p| bounds.add(p));
        bounds.outside(&ROWS)
    }

    #[test]
    fn only_what_is_beyond_one_side_as_a_whole_is_outside() {
        assert!(outside(&[[3.0, 0.0, -2.0], [9.0, 1.0, -2.5]]));
        assert!(outside(&[[0.0, -3.0, -2.0], [0.0, -4.0, -2.5]]));
        assert!(
            outside(&[[0.0, 0.0, 2.0], [0.1, 0.1, 3.0]]),
            "behind the eye"
        );
        assert!(!outside(&[[3.0, 0.0, -2.0], [1.0, 1.0, -2.5]]));
        assert!(
            !outside(&[[-3.0, 0.0, -2.0], [3.0, 0.0, -2.0]]),
            "a side each"
        );
        assert!(
            !outside(&[[2.0, 0.0, -2.0], [3.0, 0.0, -2.0]]),
            "on the side"
        );
        assert!(
            !outside(&[[0.0, 0.0, -2.0], [3.0, 0.0, 2.0]]),
            "past the eye"
        );
    }

    #[test]
    fn what_is_no_number_is_inside() {
        assert!(!outside(&[[3.0, 0.0, -2.0], [f32::NAN, 0.0, -2.0]]));
        assert!(!outside(&[
            [f32::INFINITY, 0.0, -2.0],
            [f32::INFINITY, 0.0, -2.0]
        ]));
        assert!(!outside(&[]));
    }
}
