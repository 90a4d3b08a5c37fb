//! Where a view lies in a picture of whole views.
#![forbid(unsafe_code)]

use crate::config::{Config, Output};

/// A picture of whole views beside each other.
///
/// Cells are numbered from the bottom left, to the right, then upwards (a column of views: from the top); cells past the last view
/// are black.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One row, view 0 on the left.
    SideBySide {
        /// The picture has the size of one view.
        half: bool,
    },
    /// One column, view 0 on top.
    TopBottom {
        /// The picture has the size of one view.
        half: bool,
    },
    /// The Looking Glass order: view 0 bottom left, rows upwards.
    Quilt {
        /// At least 1.
        columns: u32,
        /// At least 1.
        rows: u32,
    },
    /// One view.
    View(u32),
}

impl Layout {
    /// The layout of an output of whole views. None for other outputs.
    pub fn of(config: &Config, output: Output) -> Option<Self> {
        match output {
            Output::SideBySide { half } => Some(Self::SideBySide { half }),
            Output::TopBottom { half } => Some(Self::TopBottom { half }),
            Output::Quilt => Some(Self::quilt(config.views, config.display.facts.quilt)),
            Output::View(view) => Some(Self::View(view)),
            // The view of the left eye; that of the right eye goes to another buffer of the window.
            Output::Quad => Some(Self::View(0)),
            Output::Panel | Output::Interlaced(_) | Output::Anaglyph(_) | Output::Rgbd => None,
        }
    }

    /// The quilt of N views that wastes no cell and is at most twice as wide as high, counted in cells, such as 4x2, 8x6
    /// and 9x5 for 8, 48 and 45 views; else the smallest near-square one that holds them. Where columns and rows are `known` and
    /// hold the views, they are taken.
    pub fn quilt(views: u32, known: Option<(u32, u32)>) -> Self {
        let views = views.max(1);
        if let Some((columns, rows)) = known.filter(|&(c, r)| c.saturating_mul(r) >= views) {
            return Self::Quilt { columns, rows };
        }
        let root = views.isqrt();
        let full = (1..=root)
            .rev()
            .find(|rows| views.is_multiple_of(*rows) && views / rows <= 2 * rows);
        let columns = match full {
            Some(rows) => views / rows,
            None if root * root == views => root,
            None => root + 1,
        };
        Self::Quilt {
            columns,
            rows: views.div_ceil(columns),
        }
    }

    /// Columns and rows of cells, each at least 1.
    pub fn grid(self, views: u32) -> (u32, u32) {
        match self {
            Self::SideBySide { .. } => (views.max(1), 1),
            Self::TopBottom { .. } => (1, views.max(1)),
            Self::Quilt { columns, rows } => (columns.max(1), rows.max(1)),
            Self::View(_) => (1, 1),
        }
    }

    /// The view in the bottom left cell.
    pub fn first(self) -> u32 {
        match self {
            Self::View(view) => view,
            Self::SideBySide { .. } | Self::TopBottom { .. } | Self::Quilt { .. } => 0,
        }
    }

    /// Whether the rows of cells are numbered from the top.
    pub fn from_top(self) -> bool {
        matches!(self, Self::TopBottom { .. })
    }

    /// Size of the picture in pixels where each tile keeps its own size, or all share the size of one.
    pub fn native_size(self, views: u32, tile: (u32, u32)) -> (u32, u32) {
        if let Self::SideBySide { half: true } | Self::TopBottom { half: true } = self {
            return tile;
        }
        let (columns, rows) = self.grid(views);
        (tile.0.saturating_mul(columns), tile.1.saturating_mul(rows))
    }

    /// The view in a cell, counted from the left and from the top; None where the cell is black.
    pub fn view_at(self, column: u32, row: u32, views: u32) -> Option<u32> {
        let (columns, rows) = self.grid(views);
        let upwards = rows.checked_sub(row)?.checked_sub(1)?;
        let row = if self.from_top() { row } else { upwards };
        let view = row
            .checked_mul(columns)?
            .checked_add(column)?
            .checked_add(self.first())?;
        (column < columns && view < views).then_some(view)
    }
}
