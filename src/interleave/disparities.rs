//! The disparities of a depth image, for the views that are synthesised from it by `shaders/disparity.wgsl`.
#![forbid(unsafe_code)]

use super::Sources;

/// Parameters of the synthesis. The disparity of a sample is the number of pixels by which it moves, relative to an infinitely far point, for a
/// camera one place to the side: `disparity = scale·depth + offset`. Baselines are in places of the camera.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disparities {
    /// Other disparities for what is nearer than a depth: scale, offset, that depth, and 1 where nearer depths are larger, −1 where they are smaller;
    /// 0 for none.
    pub before: [f32; 4],
    /// Disparity per unit of the depth buffer.
    pub scale: f32,
    /// Disparity at depth 0.
    pub offset: f32,
    /// Disparity of zero parallax, which is also the motion of an infinitely far point.
    pub far: f32,
    /// Pixels on which nothing was drawn.
    pub cleared: Cleared,
    /// Baseline of view 0, and the step from each view to the next. The view of the picture itself has the baseline 0.
    pub baselines: [f32; 2],
    /// Added to the depths of synthesised views, in units of the depth buffer, so that later draws over the same surface pass the depth test.
    pub margin: f32,
    /// The view to synthesise, and the left edge of its tile in pixels.
    pub aim: (u32, u32),
    /// The drawn views. None where only the own view is drawn.
    pub sources: Option<Sources>,
    /// Where the pictures lie that are read.
    pub places: Places,
    /// Holes are marked instead of filled.
    pub marked: bool,
    /// The most pixels that an occlusion camera reaches behind an occluder.
    pub reach: f32,
}

/// Pixels on which nothing was drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cleared {
    /// Their depth.
    pub depth: f32,
    /// They are infinitely far; else they are behind everything, and the same in all views.
    pub sky: bool,
}

/// Where the pictures lie that views are synthesised from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Places {
    /// In their tiles.
    #[default]
    Tiles,
    /// In copies, one to a layer.
    Copies,
    /// The one picture whose pyramid is built: its left edge, its layer, and its index among the pictures.
    One([u32; 3]),
}

/// A disparity below everything, as in `shaders/disparity.wgsl`.
const NOTHING: f32 = -1.0e6;

impl Disparities {
    /// The longest baseline of any view that is synthesised from the picture.
    fn longest(&self, views: u32) -> f32 {
        let [first, step] = self.baselines;
        match (&self.sources, self.places) {
            (Some(sources), Places::One([.., i])) => sources.farthest(i, views) as f32 * step.abs(),
            _ => first
                .abs()
                .max((first + (views.max(1) - 1) as f32 * step).abs()),
        }
    }

    /// `disparity`, `baseline`, `aim`, `occlusion`, `sources_low`, `sources_high` and `before` of `shaders/common.wgsl`.
    pub(super) fn rows(&self, views: u32) -> [[f32; 4]; 7] {
        let [first, step] = self.baselines;
        let clear = if self.cleared.sky { 0.0 } else { NOTHING };
        let (view, left) = self.aim;
        let [left_edge, layer, index] = match self.places {
            Places::Tiles => [0; 3],
            Places::Copies => [1, 0, 0],
            Places::One(place) => place,
        }
        .map(|n| n as f32);
        let [low, high] = self.sources.map_or([[0.0; 4]; 2], |sources| sources.rows());
        let marked = f32::from(u8::from(self.marked));
        [
            [self.scale, self.offset, self.far, self.cleared.depth],
            [first, step, clear, self.margin],
            [view as f32, left as f32, marked, self.longest(views)],
            [self.reach, left_edge, layer, index],
            low,
            high,
            self.before,
        ]
    }
}
