//! The place of each view in the atlas.

use super::{Grid, ViewSet};
use crate::config::AtlasLayout;
use crate::view::ViewIndex;

/// Places of N tiles in an array texture: `columns` beside each other in each of `rows` layers. The layout side by side has one row
/// (several where a row would exceed the driver's limits); the layout in layers has one column.
///
/// View i lies in slot(i). The program's own (middle) view lies in slot 0, at the origin of layer 0, so that the pixels that the program
/// reads back are rasterised at the coordinates of its own window. View 0 takes the middle's slot; the others have the slot of their
/// number. Rows are layers rather than higher parts of one texture, because float rounding depends on the offset in y as well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tiles {
    /// N.
    pub views: u32,
    /// Width and height of the window, pixels.
    pub window: [u32; 2],
    /// Which points of the window the texels of a tile show.
    pub grid: Grid,
    /// The views that are drawn; the program's own is drawn in any case.
    pub shown: ViewSet,
    /// Width of a tile, pixels.
    pub width: u32,
    /// Height of a tile, pixels.
    pub height: u32,
    /// Pixels from tile to tile: the width rounded up to a multiple of 32, so that polygon stipple and dither keep their phase.
    pub stride: u32,
    /// Tiles in a row.
    pub columns: u32,
    /// Layers of the texture.
    pub rows: u32,
}

/// Why the views do not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TilesError {
    /// A tile is wider or higher than the driver's textures: width, height, limit in pixels.
    #[error("a window of {0} x {1} pixels is larger than the driver's textures ({2})")]
    Window(u32, u32, u32),
    /// The views need more layers than there are.
    #[error(
        "{views} views of {width} x {height} pixels need {rows} layers of the atlas and the driver has {layers}; ask for fewer views"
    )]
    Views {
        /// N.
        views: u32,
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// Layers that are needed.
        rows: u32,
        /// Layers that the driver has.
        layers: u32,
    },
}

/// The driver's limits, in pixels and layers.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The smaller of GL_MAX_TEXTURE_SIZE and GL_MAX_VIEWPORT_DIMS.
    pub side: u32,
    /// GL_MAX_ARRAY_TEXTURE_LAYERS.
    pub layers: u32,
}

impl Tiles {
    /// Places N tiles for a window, given by its width and height in pixels.
    ///
    /// # Errors
    /// The tiles exceed the driver's limits.
    pub fn new(
        views: u32,
        window: [u32; 2],
        grid: Grid,
        layout: AtlasLayout,
        limits: Limits,
    ) -> Result<Tiles, TilesError> {
        let window = window.map(|side| side.max(1));
        let (grid, [width, height]) = grid.fit(window, views);
        let stride = width.next_multiple_of(32);
        if width > limits.side || height > limits.side {
            return Err(TilesError::Window(width, height, limits.side));
        }
        let columns = match layout {
            AtlasLayout::SideBySide => (limits.side / stride).clamp(1, views),
            AtlasLayout::Layers => 1,
        };
        let rows = views.div_ceil(columns);
        if rows > limits.layers {
            return Err(TilesError::Views {
                views,
                width,
                height,
                rows,
                layers: limits.layers,
            });
        }
        Ok(Tiles {
            views,
            window,
            grid,
            shown: ViewSet::ALL,
            width,
            height,
            stride,
            columns,
            rows,
        })
    }

    /// The program's own view: (N−1)/2 rounded down, the middle one of an odd N.
    pub fn own(&self) -> ViewIndex {
        ViewIndex((self.views - 1) / 2)
    }

    /// The slot of a view.
    pub fn slot(&self, view: ViewIndex) -> u32 {
        match view {
            v if v == self.own() => 0,
            ViewIndex(0) => self.own().0,
            ViewIndex(v) => v,
        }
    }

    /// The view in a slot. Slots exchange two views, so the map is its own inverse.
    pub fn view_in(&self, slot: u32) -> ViewIndex {
        ViewIndex(self.slot(ViewIndex(slot)))
    }

    /// The layer of a view's tile, and its x offset in pixels.
    pub fn place(&self, view: ViewIndex) -> (u32, u32) {
        let slot = self.slot(view);
        (slot / self.columns, slot % self.columns * self.stride)
    }

    /// The program's own view alone.
    pub fn own_alone(&self) -> ViewSet {
        [self.own()].into_iter().collect()
    }

    /// Width of a layer in pixels: the last tile is not padded.
    pub fn texture_width(&self) -> u32 {
        (self.columns - 1) * self.stride + self.width
    }

    /// The views that are drawn, the program's own last, so that the state afterwards is that of its tile.
    pub fn order(&self) -> impl Iterator<Item = ViewIndex> + use<> {
        let tiles = *self;
        let others = (1..tiles.views).map(move |slot| tiles.view_in(slot));
        others
            .filter(move |&view| tiles.shown.has(view))
            .chain([tiles.own()])
    }

    /// Whether two atlases of one window have their texels at the same places.
    pub fn lies_like(&self, other: &Tiles) -> bool {
        (self.grid, self.columns, self.rows) == (other.grid, other.columns, other.rows)
    }

    /// Whether a layer contains a view that is drawn.
    pub fn draws_row(&self, row: u32) -> bool {
        let slots = row * self.columns..((row + 1) * self.columns).min(self.views);
        slots.into_iter().any(|slot| self.draws(self.view_in(slot)))
    }

    /// Whether a view is drawn.
    pub fn draws(&self, view: ViewIndex) -> bool {
        view == self.own() || self.shown.has(view)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BIG: Limits = Limits {
        side: 16384,
        layers: 2048,
    };

    #[test]
    fn the_own_view_lies_at_the_origin_and_every_view_somewhere_else() {
        for views in 1..40 {
            for (layout, side) in [
                (AtlasLayout::SideBySide, 16384),
                (AtlasLayout::SideBySide, 1500),
                (AtlasLayout::Layers, 16384),
            ] {
                let t = Tiles::new(
                    views,
                    [500, 300],
                    Grid::FULL,
                    layout,
                    Limits { side, layers: 2048 },
                )
                .expect("fits");
                assert_eq!(t.place(t.own()), (0, 0));
                let mut places: Vec<_> = ViewIndex::all(views).map(|v| t.place(v)).collect();
                places.sort_unstable();
                places.dedup();
                assert_eq!(places.len(), views as usize);
                assert!(places.iter().all(|&(row, x)| row < t.rows
                    && x + t.width <= t.texture_width()
                    && t.texture_width() <= side));
                assert!(ViewIndex::all(views).all(|v| t.view_in(t.slot(v)) == v));
                let order: Vec<_> = t.order().collect();
                assert_eq!(
                    (order.len(), order.last()),
                    (views as usize, Some(&t.own()))
                );
            }
        }
    }

    #[test]
    fn only_the_own_view_and_the_first_change_places() {
        for (views, slots) in [
            (1, vec![0]),
            (2, vec![0, 1]),
            (3, vec![1, 0, 2]),
            (5, vec![2, 1, 0, 3, 4]),
            (8, vec![3, 1, 2, 0, 4, 5, 6, 7]),
        ] {
            let t = Tiles::new(views, [8, 8], Grid::FULL, AtlasLayout::Layers, BIG).expect("fits");
            assert_eq!(
                ViewIndex::all(views).map(|v| t.slot(v)).collect::<Vec<_>>(),
                slots
            );
        }
    }

    #[test]
    fn what_nobody_sees_is_not_drawn_but_for_the_own_view() {
        let all = Tiles::new(8, [8, 8], Grid::FULL, AtlasLayout::Layers, BIG).expect("fits");
        let drawn = |views: &[u32]| {
            let shown = views.iter().copied().map(ViewIndex).collect();
            let mut drawn: Vec<u32> = Tiles { shown, ..all }.order().map(|v| v.0).collect();
            assert_eq!(drawn.last(), Some(&all.own().0));
            drawn.sort_unstable();
            drawn
        };
        assert_eq!(drawn(&[0, 7]), [0, 3, 7]);
        assert_eq!(drawn(&[3]), [3]);
        assert_eq!(drawn(&[]), [3]);
        assert_eq!(all.order().count(), 8);
    }

    #[test]
    fn what_does_not_fit_is_said() {
        assert!(Tiles::new(9, [20000, 10], Grid::FULL, AtlasLayout::SideBySide, BIG).is_err());
        let e = Tiles::new(
            200,
            [640, 480],
            Grid::FULL,
            AtlasLayout::Layers,
            Limits {
                side: 16384,
                layers: 64,
            },
        )
        .expect_err("too many");
        assert!(
            e.to_string().contains("200 views") && e.to_string().contains("64"),
            "{e}"
        );
    }
}
