//! Strips, fans and polygons as triangles and quads by themselves: tessellation takes no other.

use crate::gl::consts as c;

/// The vertices, by their place in a draw of so many, that make the same surfaces in the same order and with the same sides as patches of three,
/// or of four in the place of quads; none for what is no surface, or is patches as it is.
pub(super) fn corners(mode: u32, count: u32) -> Option<Vec<u32>> {
    let triangles = 0..count.saturating_sub(2);
    Some(match mode {
        // Every second one has its sides the other way round.
        c::TRIANGLE_STRIP => triangles
            .flat_map(|i| [i + i % 2, i + 1 - i % 2, i + 2])
            .collect(),
        c::TRIANGLE_FAN | c::POLYGON => triangles.flat_map(|i| [0, i + 1, i + 2]).collect(),
        c::QUAD_STRIP => (0..(count / 2).saturating_sub(1))
            .map(|i| 2 * i)
            .flat_map(|i| [i, i + 1, i + 3, i + 2])
            .collect(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_and_order_are_kept() {
        let every: [(u32, u32, &[u32]); 8] = [
            (c::TRIANGLE_STRIP, 5, &[0, 1, 2, 2, 1, 3, 2, 3, 4]),
            (c::TRIANGLE_STRIP, 2, &[]),
            (c::TRIANGLE_FAN, 5, &[0, 1, 2, 0, 2, 3, 0, 3, 4]),
            (c::POLYGON, 4, &[0, 1, 2, 0, 2, 3]),
            (c::POLYGON, 0, &[]),
            (c::QUAD_STRIP, 6, &[0, 1, 3, 2, 2, 3, 5, 4]),
            (c::QUAD_STRIP, 7, &[0, 1, 3, 2, 2, 3, 5, 4]),
            (c::QUAD_STRIP, 3, &[]),
        ];
        for (mode, count, expected) in every {
            let list = corners(mode, count);
            assert_eq!(list.as_deref(), Some(expected), "{mode:#x}, {count}");
        }
        assert_eq!(corners(c::TRIANGLES, 3), None);
        assert_eq!(corners(c::LINE_STRIP, 3), None);
    }
}
