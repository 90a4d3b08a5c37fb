//! What the passes of `shaders/*.wgsl` make.
#![forbid(unsafe_code)]

use crate::config::DisocclusionSource;

/// What a pass makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// The panel's picture, through the mask: views of any size, filtered or not.
    Interleave,
    /// The same for views of the picture's size.
    Texels(Texels),
    /// The same for views that have fewer texels, aligned with the panel's samples or evenly spread.
    SampleAligned(SampleAligned),
    /// Quilt, side by side or a single view.
    Layout,
    /// A single view of the picture's size.
    Whole,
    /// Two views for coloured glasses.
    Anaglyph,
    /// The own view beside its depth.
    Rgbd,
    /// A copy of a texture of two dimensions, which the others are measured by.
    Copy,
    /// A step of the accumulation buffer.
    Accumulate(Step),
    /// Views of a picture with depths.
    Synthesis(Synthesis),
}

/// What the mask and the atlas are like; see `shaders/texels.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Texels {
    /// Any.
    Subpixels,
    /// All views lie in one layer.
    SubpixelsOfOneLayer,
    /// Each pixel shows one view.
    Pixels,
}

/// How far the texels are from where the panel shows their view; see `shaders/sample_aligned.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleAligned {
    /// Nowhere: each pixel shows one view.
    Pixels,
    /// Between texels.
    Texels,
}

/// What is made of a picture with depths; see `shaders/disparity.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Synthesis {
    /// The greatest and the least height of each block of a row.
    BlockBounds,
    /// The greatest of each row.
    RowMaxima,
    /// The greatest and the least of all that the rays of a block can meet.
    RayRange,
    /// Where disparities step down or up.
    Steps,
    /// Which blocks are near such steps.
    Splats,
    /// The distortion map of an occlusion camera.
    DistortionMap,
    /// One view, with depths, and what is known of what is hidden.
    View(DisocclusionSource),
    /// The panel's picture, through a mask of views; of one view for each pixel, where the mask is `whole`.
    Panel {
        /// Red, green and blue show the same view.
        whole: bool,
        /// As for a view.
        behind: DisocclusionSource,
    },
}

/// What is done to the accumulation buffer, texel by texel; see `shaders/accumulate.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// Four values.
    Fill,
    /// As it is.
    Copy,
    /// The colour.
    Load,
    /// The colour is added.
    Accumulate,
    /// Multiplied by a value.
    Multiply,
    /// A value is added.
    Add,
    /// The colour becomes what was accumulated.
    Return,
}

impl Pass {
    /// All that make a picture of views.
    pub const OUTPUTS: [Self; 10] = [
        Self::Interleave,
        Self::Texels(Texels::Subpixels),
        Self::Texels(Texels::SubpixelsOfOneLayer),
        Self::Texels(Texels::Pixels),
        Self::SampleAligned(SampleAligned::Pixels),
        Self::SampleAligned(SampleAligned::Texels),
        Self::Layout,
        Self::Whole,
        Self::Anaglyph,
        Self::Rgbd,
    ];
}

impl Synthesis {
    /// All of them.
    pub const ALL: [Self; 15] = [
        Self::BlockBounds,
        Self::RowMaxima,
        Self::RayRange,
        Self::Steps,
        Self::Splats,
        Self::DistortionMap,
        Self::View(DisocclusionSource::Nothing),
        Self::View(DisocclusionSource::Reference),
        Self::View(DisocclusionSource::Views),
        Self::panel(false, DisocclusionSource::Nothing),
        Self::panel(false, DisocclusionSource::Reference),
        Self::panel(false, DisocclusionSource::Views),
        Self::panel(true, DisocclusionSource::Nothing),
        Self::panel(true, DisocclusionSource::Reference),
        Self::panel(true, DisocclusionSource::Views),
    ];

    pub(super) const fn panel(whole: bool, behind: DisocclusionSource) -> Self {
        Self::Panel { whole, behind }
    }
}

impl Step {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Fill,
        Self::Copy,
        Self::Load,
        Self::Accumulate,
        Self::Multiply,
        Self::Add,
        Self::Return,
    ];
}
