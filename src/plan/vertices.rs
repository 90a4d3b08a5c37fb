//! The distances of a scene that writes no depths, from the vertices that are seen.

use super::depths::Distances;

/// So many vertices of a frame are looked at. Small scenes have fewer, and those of large ones write depths.
const MOST: usize = 4096;

/// Vertices of a frame that are within the view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vertices {
    /// 1/w of each.
    inverse: Vec<f64>,
}

impl Vertices {
    /// Whether more are of interest.
    pub fn looks(&self) -> bool {
        self.inverse.len() < MOST
    }

    /// Adds a vertex, unless it is outside of the view. `rows` are rows 0, 1 and 3 of the matrix to clip space; they give x, y and w.
    pub fn add(&mut self, rows: &[[f32; 4]; 3], [x, y, z]: [f32; 3]) {
        let at = |row: &[f32; 4]| row[0] * x + row[1] * y + row[2] * z + row[3];
        let [x, y, w] = [0, 1, 2].map(|row: usize| rows.get(row).map_or(f32::NAN, at));
        // What is no number is not within.
        if self.looks() && w > 0.0 && x.abs() <= w && y.abs() <= w {
            self.inverse.push(1.0 / f64::from(w));
        }
    }

    /// The distances of all, and begins anew; none where there are no vertices.
    pub fn take(&mut self, sky: bool) -> Option<Distances> {
        let mut scene = std::mem::take(&mut self.inverse);
        scene.sort_unstable_by(f64::total_cmp);
        let found = Distances {
            scene,
            sky,
            ..Distances::default()
        };
        (!found.scene.is_empty()).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_in_the_view_are_as_far_as_they_are() {
        // glFrustum(-1, 1, -1, 1, 1, 10): x, y, w.
        let rows = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, 0.0],
        ];
        let mut vertices = Vertices::default();
        let outside = [
            [3.0, 0.0, -2.0],
            [0.0, -3.0, -2.0],
            [0.0, 0.0, 2.0],
            [f32::NAN, 0.0, -2.0],
            [0.0, 0.0, f32::NAN],
        ];
        for position in outside {
            vertices.add(&rows, position);
        }
        assert_eq!(vertices.take(true), None);
        for position in [[1.0, -1.0, -2.0], [0.0, 0.0, -8.0], [3.0, 0.0, -4.0]] {
            vertices.add(&rows, position);
        }
        let found = vertices.take(true).expect("distances");
        assert_eq!(found.scene(), Some([0.125, 0.25, 0.5]));
        assert!(found.sky && found.foreground.is_empty());
        assert_eq!(vertices.take(false), None, "they were taken");
        (0..2 * MOST).for_each(|_| vertices.add(&rows, [0.0, 0.0, -8.0]));
        assert!(!vertices.looks() && vertices.inverse.len() == MOST);
    }
}
