//! Several panels that show one picture: each has its place in the wall, its own mask, and a warp that takes its pixels to the wall.
//!
//! Spaces. *Wall*: mm, x to the right and y downwards. *Panel*: pixels of a panel from its left top corner, x to the right and y downwards. *Sheet*: one
//! picture that has the pixels of all panels beside each other, which is what is drawn and sent to their windows; a panel begins at a whole number
//! of cells, and the [`Node`]s of its corners of cells are its own.
//!
//! A pixel of a panel shows the place of the wall that the panel's warp gives, as GBMVR's projectors do (Luo et al., section 4): a homography, and a
//! mesh of offsets for what no homography describes. Its brightness is attenuated by a map (Majumder and Stevens).
#![forbid(unsafe_code)]

use super::{Bias, Display, FINE, Fit, GUARD, MAX_FINE_VIEWS, Mask, MaskError, Placement};

/// Width and height of a cell of the sheet, in pixels. Between the corners of a cell the warp is bilinear: that of a panel which is tilted by 30° at
/// three times its width is within 0.005 pixels.
pub const CELL: u32 = 16;

/// Three rows of three: takes (x, y, 1) to (x·w, y·w, w).
pub type Homography = [[f64; 3]; 3];

/// The panels of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    panels: Vec<WallPanel>,
    /// Width and height of the sheet in pixels, whole cells.
    sheet: (u32, u32),
    /// Left, top, right and bottom of all panels in the wall, mm.
    area: [f64; 4],
}

/// One panel of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct WallPanel {
    /// The monitor that it is, as `xrandr --listmonitors` names it.
    pub monitor: String,
    /// Its own mask.
    pub display: Display,
    /// Width and height in pixels.
    pub pixels: (u32, u32),
    /// From panel to wall.
    pub to_wall: Homography,
    /// Offsets in the wall after that, mm, to the right and down; over the panel.
    pub mesh: Option<[Bias; 2]>,
    /// The share of its light that it shows, 0 to 1, over the panel.
    pub light: Light,
    /// Pixels that stay black: from the left, the top, the right and the bottom.
    pub border: [u32; 4],
    /// Where it is in the sheet: left and top, whole cells.
    pub at: [u32; 2],
    /// How far its views are moved on, as a share of all: the viewers see the middle of the wall, and this panel from its side.
    pub shift: f64,
}

/// How much of its light a panel shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// The same everywhere.
    Even(f64),
    /// A map over the panel.
    Map(Bias),
}

/// What the corner of a cell of the sheet shows: the place in the picture of the program's window, 0 to 1 from its left and top, and the share of the light.
pub type Node = [f32; 3];

impl Wall {
    /// Puts panels beside each other in a sheet; their `at` and `shift` are set here. `viewer`: mm before the wall, where the panels' views meet. None
    /// without a panel, or if one is turned so that it has no area.
    #[must_use]
    pub fn new(mut panels: Vec<WallPanel>, viewer: Option<f64>) -> Option<Self> {
        let columns = (panels.len() as f64).sqrt().ceil() as usize;
        let (mut sheet, mut area) = ((0, 0), [f64::MAX, f64::MAX, f64::MIN, f64::MIN]);
        // The corners at the right and the bottom are nodes as well.
        let cells = |pixels: u32| (pixels.div_ceil(CELL) + 1) * CELL;
        let mut top = 0;
        for row in panels.chunks_mut(columns.max(1)) {
            let (mut left, mut high) = (0, 0);
            for panel in row {
                panel.at = [left, top];
                left += cells(panel.pixels.0);
                high = high.max(cells(panel.pixels.1));
                for [x, y] in panel.corners() {
                    area = [
                        area[0].min(x),
                        area[1].min(y),
                        area[2].max(x),
                        area[3].max(y),
                    ];
                }
            }
            sheet.0 = sheet.0.max(left);
            top += high;
        }
        sheet.1 = top;
        let middle = (area[0] + area[2]) / 2.0;
        for panel in &mut panels {
            panel.shift = viewer.map_or(0.0, |viewer| panel.aside(middle) / panel.zone(viewer));
        }
        let is_there = area[2] > area[0] && area[3] > area[1];
        is_there.then_some(Self {
            panels,
            sheet,
            area,
        })
    }

    /// The panels.
    #[must_use]
    pub fn panels(&self) -> &[WallPanel] {
        &self.panels
    }

    /// Width and height of the sheet in pixels.
    #[must_use]
    pub fn sheet(&self) -> (u32, u32) {
        self.sheet
    }

    /// Left, top, width and height of the picture of a window (width and height in pixels) in the wall, mm.
    #[must_use]
    pub fn picture(&self, window: (u32, u32), fit: Fit) -> [f64; 4] {
        /// Of a mm.
        const PARTS: f64 = 64.0;
        let [left, top, right, bottom] = self.area;
        let side = |length: f64| ((length * PARTS).round() as u32).max(1);
        let place = fit.place(window, (side(right - left), side(bottom - top)));
        let mm = |parts: f64| parts / PARTS;
        [
            left + mm(place.x.into()),
            top + mm(place.y.into()),
            mm(place.width.into()),
            mm(place.height.into()),
        ]
    }

    /// Pixels of the first panel over which the picture of a window is spread.
    #[must_use]
    pub fn picture_width(&self, window: (u32, u32), fit: Fit) -> u32 {
        let [_, _, width, _] = self.picture(window, fit);
        let Some(panel) = self.panels.first() else {
            return 0;
        };
        let [a, b, ..] = panel.corners();
        let across = (b[0] - a[0]).hypot(b[1] - a[1]);
        (width / across * f64::from(panel.pixels.0)).round() as u32
    }

    /// Columns and rows of nodes.
    #[must_use]
    pub fn node_count(&self) -> (u32, u32) {
        (self.sheet.0 / CELL, self.sheet.1 / CELL)
    }

    /// The nodes, rows from the top, for the picture of a window (width and height in pixels). Those of no panel have no light.
    #[must_use]
    pub fn nodes(&self, window: (u32, u32), fit: Fit) -> Vec<Node> {
        let (columns, rows) = self.node_count();
        let mut nodes = vec![[0.0; 3]; columns as usize * rows as usize];
        let [left, top, width, height] = self.picture(window, fit);
        for panel in &self.panels {
            let [first, upper] = panel.at.map(|at| at / CELL);
            for row in 0..=panel.pixels.1.div_ceil(CELL) {
                for column in 0..=panel.pixels.0.div_ceil(CELL) {
                    let place = [column, row].map(|cell| f64::from(cell * CELL));
                    let [x, y] = panel.in_wall(place);
                    let at = (upper + row) as usize * columns as usize + (first + column) as usize;
                    nodes[at] = [
                        ((x - left) / width) as f32,
                        ((y - top) / height) as f32,
                        panel.light_at(place) as f32,
                    ];
                }
            }
        }
        nodes
    }

    /// The masks of all panels in the sheet, and of their borders; what belongs to no panel is black.
    pub fn mask(&self, placement: &Placement, views: u32) -> Result<Mask, MaskError> {
        let mut masks = Vec::new();
        for panel in &self.panels {
            let whole = Placement::full_screen(panel.pixels.0, panel.pixels.1);
            masks.push(panel.mask(&whole, views)?);
        }
        Mask::by_rows(placement, |first, row, out| {
            for (x, out) in (first..).zip(out) {
                let found = self.panels.iter().zip(&masks).find_map(|(panel, mask)| {
                    let [px, py] = panel.pixel([x, row])?;
                    mask.at(px, py)
                });
                *out = found.unwrap_or([GUARD; 3]);
            }
        })
    }

    pub(super) fn check_views(&self, views: u32) -> Result<(), MaskError> {
        let mut panels = self.panels.iter();
        panels.try_for_each(|panel| panel.display.check_views(views))
    }
}

impl WallPanel {
    /// A place of the panel, in pixels, in the wall.
    #[must_use]
    pub fn in_wall(&self, place: [f64; 2]) -> [f64; 2] {
        let [x, y] = apply(&self.to_wall, place);
        match &self.mesh {
            Some([right, down]) => {
                let share = self.share(place);
                [x + right.at(share), y + down.at(share)]
            }
            None => [x, y],
        }
    }

    /// The panel's corners in the wall: left top, right top, right bottom, left bottom.
    #[must_use]
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let [width, height] = [self.pixels.0, self.pixels.1].map(f64::from);
        [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(|place| self.in_wall(place))
    }

    /// How far its middle is to the right of a place of the wall, mm.
    fn aside(&self, place: f64) -> f64 {
        let middle = self.corners().iter().map(|corner| corner[0]).sum::<f64>() / 4.0;
        middle - place
    }

    /// Width of the zone in which an eye at a distance sees all views once, mm; endless where its cone is not known.
    fn zone(&self, viewer: f64) -> f64 {
        let cone = self
            .display
            .facts
            .cone
            .map(|cone| (cone / 2.0).to_radians().tan());
        cone.map_or(f64::INFINITY, |tangent| 2.0 * viewer * tangent)
    }

    /// Its mask, with its views moved on.
    fn mask(&self, whole: &Placement, views: u32) -> Result<Mask, MaskError> {
        if self.shift == 0.0 {
            return self.display.mask(whole, views);
        }
        // Between the views where the panel has places there.
        let fine = match views <= MAX_FINE_VIEWS {
            true => u32::from(FINE),
            false => 1,
        };
        let mut mask = match fine {
            1 => self.display.mask(whole, views)?,
            _ => self.display.fine_mask(whole, views)?,
        };
        let all = i64::from(views * fine);
        let add = (self.shift * all as f64).round() as i64;
        mask.map(|step| ((i64::from(step) + add).rem_euclid(all) / i64::from(fine)) as u16);
        Ok(mask)
    }

    fn light_at(&self, place: [f64; 2]) -> f64 {
        match &self.light {
            Light::Even(share) => *share,
            Light::Map(map) => map.at(self.share(place)),
        }
    }

    /// A place as shares of the panel.
    fn share(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x / f64::from(self.pixels.0), y / f64::from(self.pixels.1)]
    }

    /// The pixel of the panel at a pixel of the sheet; none outside of the panel, and in its border.
    fn pixel(&self, [x, y]: [i64; 2]) -> Option<[u32; 2]> {
        let [left, top, right, bottom] = self.border;
        let inside = |at: i64, from: u32, side: u32, low: u32, high: u32| {
            let at = u32::try_from(at).ok()?.checked_sub(from)?;
            (at >= low && at.saturating_add(high) < side).then_some(at)
        };
        Some([
            inside(x, self.at[0], self.pixels.0, left, right)?,
            inside(y, self.at[1], self.pixels.1, top, bottom)?,
        ])
    }
}

/// Takes a place through a homography.
#[must_use]
pub fn apply(h: &Homography, [x, y]: [f64; 2]) -> [f64; 2] {
    let [a, b, w] = h.map(|row| row[0] * x + row[1] * y + row[2]);
    [a / w, b / w]
}

/// The homography of a panel that is `width` mm wide, whose left top corner is at `at` (mm) and that is turned clockwise about it by so many degrees. Its pixels
/// are square.
#[must_use]
pub fn placed(pixels: (u32, u32), at: [f64; 2], width: f64, turn: f64) -> Homography {
    let scale = width / f64::from(pixels.0);
    let (sine, cosine) = turn.to_radians().sin_cos();
    [
        [scale * cosine, -scale * sine, at[0]],
        [scale * sine, scale * cosine, at[1]],
        [0.0, 0.0, 1.0],
    ]
}
