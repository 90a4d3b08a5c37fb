//! Where the on-screen display lies in the picture of an output.
#![forbid(unsafe_code)]

use crate::config::Output;
use crate::interleave::Layout;

/// The place of one view in a picture, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Left and top.
    pub at: [u32; 2],
    /// Width and height.
    pub size: [u32; 2],
    /// Width and height that the screen stretches it to.
    pub seen: [u32; 2],
}

/// The places of all views in a picture of this size (pixels) of so many views. `layout`: that of the output, if it is one of whole views.
#[must_use]
pub fn cells(output: Output, layout: Option<Layout>, views: u32, size: [u32; 2]) -> Vec<Cell> {
    let whole = Cell {
        at: [0, 0],
        size,
        seen: size,
    };
    if output == Output::Rgbd {
        // The depth on the right has no text.
        let size = [size[0] / 2, size[1]];
        return vec![Cell {
            size,
            seen: size,
            ..whole
        }];
    }
    let Some(layout) = layout else {
        return vec![whole];
    };
    let (columns, rows) = layout.grid(views);
    let edge =
        |side: u32, at: u32, of: u32| (u64::from(side) * u64::from(at) / u64::from(of)) as u32;
    let half = matches!(
        output,
        Output::SideBySide { half: true } | Output::TopBottom { half: true }
    );
    let mut all = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            if layout.view_at(column, row, views).is_none() {
                continue;
            }
            let at = [edge(size[0], column, columns), edge(size[1], row, rows)];
            let end = [
                edge(size[0], column + 1, columns),
                edge(size[1], row + 1, rows),
            ];
            let own = [end[0] - at[0], end[1] - at[1]];
            all.push(Cell {
                at,
                size: own,
                seen: if half { size } else { own },
            });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Anaglyph;
    use crate::config::{Glasses, Mixture};

    const SIZE: [u32; 2] = [640, 480];

    #[test]
    fn pictures_for_one_panel_have_it_once() {
        let anaglyph = Output::Anaglyph(Anaglyph {
            glasses: Glasses::RedCyan,
            mixture: Mixture::Dubois,
        });
        for output in [Output::Panel, anaglyph] {
            let found = cells(output, None, 8, SIZE);
            assert_eq!((found.len(), found[0].size), (1, SIZE));
        }
        let left = cells(Output::Rgbd, None, 1, SIZE);
        assert_eq!((left.len(), left[0].size), (1, [320, 480]));
    }

    #[test]
    fn each_view_has_it() {
        let quilt = Layout::Quilt {
            columns: 3,
            rows: 2,
        };
        let found = cells(Output::Quilt, Some(quilt), 5, SIZE);
        // The last cell, top right, is black.
        let places: Vec<_> = found.iter().map(|cell| cell.at).collect();
        assert_eq!(places, [[0, 0], [213, 0], [0, 240], [213, 240], [426, 240]]);
        assert_eq!((found[4].size, found[4].seen), ([214, 240], [214, 240]));
    }

    #[test]
    fn squeezed_views_are_stretched_again() {
        let output = Output::SideBySide { half: true };
        let layout = Layout::SideBySide { half: true };
        let found = cells(output, Some(layout), 2, SIZE);
        assert_eq!((found[1].at, found[1].size), ([320, 0], [320, 480]));
        assert_eq!(found[1].seen, SIZE);
    }
}
