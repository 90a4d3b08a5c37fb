//! What the depths of a picture are, for views that are made of it; `shaders/field.wgsl` says how.
#![forbid(unsafe_code)]

/// Heights of the samples of a picture, in pixels by which they stand before what is infinitely far for a camera one place further:
/// `height = scale·depth + offset`, where the lever of a camera is how many places it stands to the side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Heights {
    /// For a unit of depth.
    pub scale: f32,
    /// At depth 0.
    pub offset: f32,
    /// What infinitely far moves by; what has this height has zero parallax.
    pub far: f32,
    /// The depth of what nothing was drawn on.
    pub clear: f32,
    /// That is infinitely far; else it is behind everything, and the same in all views.
    pub sky: bool,
    /// Lever of view 0, and from each view to the next; of the view that the picture is of, it is 0.
    pub levers: [f32; 2],
    /// What is added to depths of views that are drawn on, so that they are farther, in units of the depth buffer.
    pub margin: f32,
    /// The view that is made, and the left edge of its tile in pixels.
    pub aim: (u32, u32),
    /// Holes are marked instead of filled.
    pub marked: bool,
    /// Of an occlusion camera: the pixels that it reaches behind at most.
    pub reach: f32,
}

/// Lower than everything; as `shaders/field.wgsl` has it.
const NOTHING: f32 = -1.0e6;

impl Heights {
    /// The lever of a view.
    fn lever(&self, view: u32) -> f32 {
        self.levers[0] + view as f32 * self.levers[1]
    }

    /// `field`, `lever`, `aim` and `bend` of `shaders/common.wgsl`.
    pub(super) fn rows(&self, views: u32) -> [[f32; 4]; 4] {
        let [first, step] = self.levers;
        let clear = if self.sky { 0.0 } else { NOTHING };
        let (view, left) = self.aim;
        let ends = [0, views.max(1) - 1].map(|view| self.lever(view).abs());
        let marked = f32::from(u8::from(self.marked));
        [
            [self.scale, self.offset, self.far, self.clear],
            [first, step, clear, self.margin],
            [self.lever(view), left as f32, marked, ends[0].max(ends[1])],
            [self.reach, 0.0, 0.0, 0.0],
        ]
    }
}
