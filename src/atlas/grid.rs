//! The grid of a tile: which points of the window its texels show.

use crate::display::LensPhase;
use crate::view::ViewIndex;

/// The affine map from a point (X, Y) of the window to the tile of view i, both in pixels from the lower left corner:
/// `x = across · X + shear · Y + origin[0] + i · step[0]`, `y = up · Y + origin[1] + i · step[1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Columns of the tile per column of the window.
    pub across: f64,
    /// Columns of the tile by which each row of the window is shifted against the row below it.
    pub shear: f64,
    /// Rows of the tile per row of the window.
    pub up: f64,
    /// The window's lower left corner in the tile of view 0.
    pub origin: [f64; 2],
    /// Shift of that corner from view to view.
    pub step: [f64; 2],
    /// The panel shows the views only at the centres of texels, so no interpolation is needed.
    pub exact: bool,
}

/// Largest ratio of the parts of a tile outside and inside the window, which a shear causes.
const LARGEST_WASTE: f64 = 0.5;
/// Largest number of texels per pixel of the window at which such a grid is worth it.
const LARGEST_DENSITY: f64 = 0.9;

/// Rows of the tile per row of the window, where columns are interpolated anyway. Measured with 8 views of a slanted sheet at 1920x1080:
/// all rows take 5.1 times the time of a single view (scene `fill`; textured 4.6) at 43.3 dB (42.8); two thirds of them take 3.6 times
/// (3.1) at 43.8 dB (41.9). At 480x360 with the demo `teapot`, quality falls from 37.3 dB to 33.
const ROWS: f64 = 2.0 / 3.0;

impl Grid {
    /// Every tile has the window's own pixels.
    pub const FULL: Grid = Grid {
        across: 1.0,
        shear: 0.0,
        up: 1.0,
        origin: [0.0; 2],
        step: [0.0; 2],
        exact: false,
    };

    /// The grid of tiles of one size for a window of another size.
    pub fn scaled(tile: [u32; 2], window: [u32; 2]) -> Grid {
        let [across, up] =
            std::array::from_fn(|i| f64::from(tile[i]) / f64::from(window[i].max(1)));
        Grid {
            across,
            up,
            ..Grid::FULL
        }
    }

    /// The same tiles by the pixels of another picture of the same scene, both of these sizes: that of the grid, and the other one.
    pub fn resized(self, from: [u32; 2], to: [u32; 2]) -> Grid {
        let [x, y] = [0, 1].map(|i| f64::from(from[i].max(1)) / f64::from(to[i].max(1)));
        Grid {
            across: self.across * x,
            shear: self.shear * y,
            up: self.up * y,
            ..self
        }
    }

    /// A column of texels for each lens, the centres of which lie where the panel shows the view. `parts` is the number of parts into which a
    /// lens period is divided, N for a panel; `between` is the number of parts between neighbouring views, 1 for a panel. None where this
    /// saves too few texels, or too many of them lie outside the window.
    pub fn sample_aligned(
        phase: &LensPhase,
        window: [u32; 2],
        parts: f64,
        between: f64,
    ) -> Option<Grid> {
        let [width, height] = window.map(f64::from);
        // The lens phase counts rows from the top and is given at pixel centres; the grid counts from the lower left corner of the window.
        let corner = phase.start - 0.5 * phase.right + (height - 0.5) * phase.down;
        if phase.right == 0.0 {
            // The lenses run along the rows.
            let sign = if phase.down > 0.0 { -1.0 } else { 1.0 };
            let up = -sign * phase.down;
            let grid = Grid {
                up,
                origin: [0.0, sign * (corner - phase.within / parts) + 0.5],
                step: [0.0, -sign * between / parts],
                exact: phase.exact,
                ..Grid::FULL
            };
            return (up > 0.0 && up < LARGEST_DENSITY).then_some(grid);
        }
        let sign = phase.right.signum();
        let (across, shear) = (sign * phase.right, -sign * phase.down);
        // A lens with more views than subpixels does not need every row. Where columns are interpolated anyway, interpolation between rows is
        // no worse.
        let most = if phase.exact { 1.0 } else { ROWS };
        let up = (3.0 / (parts * across)).min(most);
        let grid = Grid {
            across,
            shear,
            up: (up * height).ceil() / height,
            origin: [sign * (corner - phase.within / parts) + 0.5, 0.0],
            step: [-sign * between / parts, 0.0],
            exact: phase.exact && up == 1.0,
        };
        let waste = (shear * height).abs() / (across * width);
        (across * grid.up < LARGEST_DENSITY && waste < LARGEST_WASTE).then_some(grid)
    }

    /// Whether tiles have the window's own pixels.
    pub fn is_full(&self) -> bool {
        *self == Grid::FULL
    }

    /// Whether the texels lie where the panel shows the views, and are not just fewer.
    pub fn is_sample_aligned(&self) -> bool {
        self.step != [0.0; 2]
    }

    /// The window's lower left corner in the tile of a view, in pixels.
    pub fn corner(&self, view: ViewIndex) -> [f64; 2] {
        [0, 1].map(|i| self.origin[i] + f64::from(view.0) * self.step[i])
    }

    /// The grid, moved by whole texels so that the window lies inside all tiles, and the width and height of the tiles.
    pub fn fit(mut self, window: [u32; 2], views: u32) -> (Grid, [u32; 2]) {
        if !self.is_sample_aligned() {
            let size = [self.across, self.up].map(f64::from);
            let size = [0, 1].map(|i| (size[i] * f64::from(window[i])).round() as u32);
            return (self, size);
        }
        let [width, height] = window.map(f64::from);
        let last = f64::from(views.max(1) - 1);
        let across = [0.0, self.across * width];
        let spans = [
            [
                across[0] + (self.shear * height).min(0.0),
                across[1] + (self.shear * height).max(0.0),
            ],
            [0.0, self.up * height],
        ];
        let size = [0, 1].map(|i| {
            let moved = [0.0, last * self.step[i]];
            let low = spans[i][0] + self.origin[i] + moved[0].min(moved[1]);
            let high = spans[i][1] + self.origin[i] + moved[0].max(moved[1]);
            self.origin[i] -= low.floor();
            (high - low.floor()).ceil() as u32
        });
        (self, size.map(|side| side.max(1)))
    }

    /// The viewport of the window in the tile of a view that begins at `offset`: x, y, width, height in pixels of the atlas. With a shear it is
    /// widened, and the projection needs [`Grid::slant`].
    pub fn viewport(&self, view: ViewIndex, offset: i32, viewport: [i32; 4]) -> [f32; 4] {
        let [x, y, width, height] = viewport.map(f64::from);
        let [corner_x, corner_y] = self.corner(view);
        let middle = self.across * (x + width / 2.0) + self.shear * (y + height / 2.0) + corner_x;
        let wide = self.across * width * (1.0 + self.slope(viewport).abs());
        [
            f64::from(offset) + middle - wide / 2.0,
            self.up * y + corner_y,
            wide,
            self.up * height,
        ]
        .map(|n| n as f32)
    }

    /// Horizontal shift of a viewport's top against its middle, in half widths of the viewport in the tile.
    fn slope(&self, [_, _, width, height]: [i32; 4]) -> f64 {
        self.shear * f64::from(height) / (self.across * f64::from(width.max(1)))
    }

    /// The projection (column-major) for [`Grid::viewport`]: `x' = (x + k·y) / (1 + |k|)` in clip space, where k is the slope.
    pub fn slant(&self, viewport: [i32; 4], p: &[f32; 16]) -> [f32; 16] {
        let k = self.slope(viewport);
        let mut slanted = *p;
        for column in 0..4 {
            let (x, y) = (f64::from(p[4 * column]), f64::from(p[4 * column + 1]));
            slanted[4 * column] = ((x + k * y) / (1.0 + k.abs())) as f32;
        }
        slanted
    }

    /// As [`Grid::slant`], but for use with the viewport of another view, `by`.
    pub fn slant_beside(
        &self,
        viewport: [i32; 4],
        p: &[f32; 16],
        view: ViewIndex,
        by: ViewIndex,
    ) -> [f32; 16] {
        let mut slanted = self.slant(viewport, p);
        let wide = self.across * f64::from(viewport[2]) * (1.0 + self.slope(viewport).abs());
        let aside = self.corner(view)[0] - self.corner(by)[0];
        for column in 0..4 {
            let moved = 2.0 * aside / wide * f64::from(p[4 * column + 3]);
            slanted[4 * column] = (f64::from(slanted[4 * column]) + moved) as f32;
        }
        slanted
    }

    /// The half-open range of texels of a view's tile whose centres lie in a range of the window's pixels, along x (axis 0, only
    /// without a shear) or y (axis 1).
    pub fn texels(&self, view: ViewIndex, axis: usize, from: i32, to: i32) -> [i32; 2] {
        let scale = [self.across, self.up][axis];
        let corner = self.corner(view)[axis];
        [from, to].map(|edge| (scale * f64::from(edge) + corner - 0.5).ceil() as i32)
    }

    /// Bias of the textures' level of detail, so that about the same level is sampled as in the window. Where texels are farther apart along
    /// one axis only, the full bias would select too fine a level for textures that are minified along the other. Measured with the demo
    /// `teapot` and 8 views, one column in 8: +0 gives 31.3 dB, -2 42.0, -2.5 44.4, -3 43.2.
    pub fn level_bias(&self) -> f64 {
        let [across, up] = [self.across, self.up].map(|density| -density.log2());
        let (more, less) = (across.max(up), across.min(up));
        -(more - ((more - less) / 2.0).min(0.5))
    }

    /// Distance between texels in pixels of the window: the geometric mean of both axes.
    pub fn spacing(&self) -> f64 {
        1.0 / (self.across * self.up).sqrt()
    }
}
