//! Splits strips, fans and polygons into separate triangles and quads: tessellation takes only those, as patches.

use crate::gl::consts as c;

/// Indices into the vertices of a draw of `count` vertices that make the same surfaces as patches: of four vertices for quad strips, else of
/// three. Order and winding of the surfaces stay the same. None for modes that are no surfaces, or that are separate triangles or quads
/// already.
pub(super) fn corners(mode: u32, count: u32) -> Option<Vec<u32>> {
    let triangles = 0..count.saturating_sub(2);
    Some(match mode {
        // Every second triangle of a strip has the opposite winding.
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
