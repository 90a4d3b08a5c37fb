//! Which points of the window the texels of a tile show.

use crate::display::LensPhase;
use crate::view::ViewIndex;

/// From the window to the tile of view i, both in pixels from the lower left corner:
/// `x = across · X + shear · Y + origin + i · step`, and `y` likewise without a shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Columns of the tile for one pixel of a row.
    pub across: f64,
    /// Columns by which a row lies beside the one below it.
    pub shear: f64,
    /// Rows of the tile for one of the window.
    pub up: f64,
    /// Where the window's corner lies in the tile of view 0.
    pub origin: [f64; 2],
    /// How much further it lies for each further view.
    pub step: [f64; 2],
    /// The panel shows the views in the middles of texels and nowhere else.
    pub exact: bool,
}

/// The part of a tile outside the window that a shear may bring, over the part inside.
const LARGEST_WASTE: f64 = 0.5;
/// Fewer texels than this for a pixel of the window, or it is not worth it.
const LARGEST_DENSITY: f64 = 0.9;

/// Rows for one of the window where texels are looked up between columns anyway. Measured with 8 views of a slanted sheet at 1920x1080:
/// all rows take 5.1 times a single view's time (scene `fill`; textured 4.6) with 43.3 dB (42.8), two thirds of them 3.6 times (3.1)
/// with 43.8 dB (41.9); and at 480x360 with the demo `teapot` 37.3 dB become 33.
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

    /// Tiles of a size for a window of another.
    pub fn scaled(tile: [u32; 2], window: [u32; 2]) -> Grid {
        let [across, up] =
            std::array::from_fn(|i| f64::from(tile[i]) / f64::from(window[i].max(1)));
        Grid {
            across,
            up,
            ..Grid::FULL
        }
    }

    /// A column for each lens: the middle of a texel is where the panel shows the view. `parts` is what a turn is cut into, N for a
    /// panel; `between` how many of them lie between neighbouring views, 1 for a panel. None where that is more than the window has,
    /// or most of it outside.
    pub fn sample_aligned(
        phase: &LensPhase,
        window: [u32; 2],
        parts: f64,
        between: f64,
    ) -> Option<Grid> {
        let [width, height] = window.map(f64::from);
        // Rows are counted from the top there and from the bottom here; at the corner between pixels, not in the middle of one.
        let corner = phase.start - 0.5 * phase.right + (height - 0.5) * phase.down;
        if phase.right == 0.0 {
            // Lenses along the rows.
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
        // Where the lens has more views than subpixels not every row is needed; and where texels lie between those of the panel, what is
        // between rows of them is no worse.
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

    /// Whether the texels are those of the lenses, and not simply fewer.
    pub fn is_sample_aligned(&self) -> bool {
        self.step != [0.0; 2]
    }

    /// Where the window's corner lies in the tile of a view.
    pub fn corner(&self, view: ViewIndex) -> [f64; 2] {
        [0, 1].map(|i| self.origin[i] + f64::from(view.0) * self.step[i])
    }

    /// Moved by whole texels so that the window lies inside all tiles; their width and height.
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

    /// What a viewport of the window becomes in the tile of a view that begins at `offset`: x, y, width, height. Its projection has to
    /// be [`Grid::lean`]ed.
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

    /// Half widths of a viewport in the tile by which its top lies beside its middle.
    fn slope(&self, [_, _, width, height]: [i32; 4]) -> f64 {
        self.shear * f64::from(height) / (self.across * f64::from(width.max(1)))
    }

    /// A projection (column-major) for [`Grid::viewport`]: `x' = (x + k·y) / (1 + |k|)` in clip space.
    pub fn lean(&self, viewport: [i32; 4], p: &[f32; 16]) -> [f32; 16] {
        let k = self.slope(viewport);
        let mut leant = *p;
        for column in 0..4 {
            let (x, y) = (f64::from(p[4 * column]), f64::from(p[4 * column + 1]));
            leant[4 * column] = ((x + k * y) / (1.0 + k.abs())) as f32;
        }
        leant
    }

    /// As [`Grid::lean`], for the viewport of another view, `by`.
    pub fn lean_beside(
        &self,
        viewport: [i32; 4],
        p: &[f32; 16],
        view: ViewIndex,
        by: ViewIndex,
    ) -> [f32; 16] {
        let mut leant = self.lean(viewport, p);
        let wide = self.across * f64::from(viewport[2]) * (1.0 + self.slope(viewport).abs());
        let aside = self.corner(view)[0] - self.corner(by)[0];
        for column in 0..4 {
            let moved = 2.0 * aside / wide * f64::from(p[4 * column + 3]);
            leant[4 * column] = (f64::from(leant[4 * column]) + moved) as f32;
        }
        leant
    }

    /// The texels of a view's tile, from the first to before the last, whose middles lie in a range of the window's pixels, along x
    /// (without a shear) or y.
    pub fn texels(&self, view: ViewIndex, axis: usize, from: i32, to: i32) -> [i32; 2] {
        let scale = [self.across, self.up][axis];
        let corner = self.corner(view)[axis];
        [from, to].map(|edge| (scale * f64::from(edge) + corner - 0.5).ceil() as i32)
    }

    /// What is to be added to the level of detail of textures, so that the window sees about the level that it would have. Where texels
    /// are farther apart along one axis only, textures that are squeezed along the other would have too fine a level with all of
    /// it; measured with the demo `teapot` and 8 views, a column of 8: +0 gives 31.3 dB, -2 42.0, -2.5 44.4, -3 43.2.
    pub fn level_bias(&self) -> f64 {
        let [across, up] = [self.across, self.up].map(|density| -density.log2());
        let (more, less) = (across.max(up), across.min(up));
        -(more - ((more - less) / 2.0).min(0.5))
    }

    /// How many times as far apart as those of the window the texels are, in the mean of both directions.
    pub fn spacing(&self) -> f64 {
        1.0 / (self.across * self.up).sqrt()
    }
}
