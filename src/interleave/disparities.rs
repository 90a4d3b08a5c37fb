//! What the depths of a picture are, for views that are synthesised from it; `shaders/disparity.wgsl` says how.
#![forbid(unsafe_code)]

use super::Sources;

/// Disparities of the samples of a picture, in pixels by which they stand before what is infinitely far for a camera one place further:
/// `height = scale·depth + offset`, where the baseline of a camera is how many places it stands to the side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Disparities {
    /// The same for what is nearer than a depth: scale and offset, that depth, and 1 where nearer is larger, −1 where it is smaller; 0 for none.
    pub before: [f32; 4],
    /// For a unit of depth.
    pub scale: f32,
    /// At depth 0.
    pub offset: f32,
    /// What infinitely far moves by; what has this height has zero parallax.
    pub far: f32,
    /// What nothing was drawn on.
    pub cleared: Cleared,
    /// Baseline of view 0, and from each view to the next; of the view that the picture is of, it is 0.
    pub baselines: [f32; 2],
    /// What is added to depths of views that are drawn on, so that they are farther, in units of the depth buffer.
    pub margin: f32,
    /// The view that is made, and the left edge of its tile in pixels.
    pub aim: (u32, u32),
    /// The views that are drawn; none where it is the own one alone.
    pub sources: Option<Sources>,
    /// Where what is looked at lies.
    pub places: Places,
    /// Holes are marked instead of filled.
    pub marked: bool,
    /// Of an occlusion camera: the pixels that it reaches behind at most.
    pub reach: f32,
}

/// What nothing was drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cleared {
    /// Its depth.
    pub depth: f32,
    /// It is infinitely far; else it is behind everything, and the same in all views.
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
    /// While one of them is measured: its left edge and its layer, and which it is.
    One([u32; 3]),
}

/// Lower than everything; as `shaders/disparity.wgsl` has it.
const NOTHING: f32 = -1.0e6;

impl Disparities {
    /// The longest baseline of a view of the picture that is looked at.
    fn longest(&self, views: u32) -> f32 {
        let [first, step] = self.baselines;
        match (&self.sources, self.places) {
            (Some(sources), Places::One([.., i])) => sources.farthest(i, views) as f32 * step.abs(),
            _ => first
                .abs()
                .max((first + (views.max(1) - 1) as f32 * step).abs()),
        }
    }

    /// `field`, `baseline`, `aim`, `occlusion` and those of the sources of `shaders/common.wgsl`.
    pub(super) fn rows(&self, views: u32) -> [[f32; 4]; 7] {
        let [first, step] = self.baselines;
        let clear = if self.cleared.sky { 0.0 } else { NOTHING };
        let (view, left) = self.aim;
        let [left_edge, layer, field] = match self.places {
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
            [self.reach, left_edge, layer, field],
            low,
            high,
            self.before,
        ]
    }
}
