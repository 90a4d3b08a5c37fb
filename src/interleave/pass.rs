//! The passes of `shaders/*.wgsl`.
#![forbid(unsafe_code)]

use crate::config::DisocclusionSource;

/// A pass, by its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// The panel's picture, through the mask: views of any size, filtered or not.
    Interleave,
    /// The same picture from views of the picture's size.
    Texels(Texels),
    /// The same picture from views with fewer texels, aligned with the panel's samples or evenly spread.
    SampleAligned(SampleAligned),
    /// Quilt, side by side or a single view.
    Layout,
    /// A single view of the picture's size.
    Whole,
    /// The first and the last view for coloured glasses.
    Anaglyph,
    /// The own view beside its depth.
    Rgbd,
    /// The pixels of all panels of a wall.
    Wall,
    /// A copy of a 2D texture, with which the cost of the others is compared.
    Copy,
    /// A step of the accumulation buffer.
    Accumulate(Step),
    /// Synthesis of views from depth images.
    Synthesis(Synthesis),
    /// Splats, drawn once for all views.
    Points(Points),
    /// The picture of a panel from its subpixels.
    Subpixels,
    /// The picture from the images of groups of splats.
    Compose,
    /// The samples of the views that a panel shows.
    Samples(Samples),
}

/// A step from the tiles to the samples and back; see `shaders/samples.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Samples {
    /// The views of the samples, from the mask.
    Views,
    /// The samples, from the tiles.
    Gather,
    /// A tile, from the samples.
    Scatter,
}

impl Samples {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Views, Self::Gather, Self::Scatter];
}

/// What the fragments of splats are; see `shaders/points.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Points {
    /// The subpixels of a panel, in a picture of three times the width.
    Subpixels,
    /// The pixels of a panel whose pixels each show one view.
    Pixels,
    /// The pixels of one view.
    View,
    /// An image of a group of splats that do not overlap.
    Group(Group),
}

/// What such an image holds, and how its splats are met; see `shaders/deferred.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Group {
    /// The subpixels of a panel.
    Subpixels,
    /// The pixels of one view.
    View,
    /// What three views see of each pixel, by rays.
    Rays,
    /// The same by parameters that are interpolated.
    Parameters,
}

/// Cases of mask and atlas; see `shaders/texels.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Texels {
    /// Any mask and any atlas.
    Subpixels,
    /// All views lie in one layer.
    SubpixelsOfOneLayer,
    /// Each pixel shows one view.
    Pixels,
}

/// Where the panel's pixels lie among the texels of their view; see `shaders/sample_aligned.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleAligned {
    /// On the centres of texels, and each pixel shows one view.
    Pixels,
    /// Between texels.
    Texels,
}

/// A pass of the synthesis from depth images; see `shaders/disparity.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Synthesis {
    /// The greatest and the least disparity of each block of a row.
    BlockBounds,
    /// The greatest disparity of each row.
    RowMaxima,
    /// The greatest and the least disparity that the rays of each block can meet.
    RayRange,
    /// The depth discontinuities of each block.
    Steps,
    /// Which blocks are near depth discontinuities.
    Splats,
    /// The distortion map of an occlusion camera.
    DistortionMap,
    /// One view with depths, with this source of disocclusions.
    View(DisocclusionSource),
    /// The panel's picture, through a mask of views.
    Panel {
        /// Red, green and blue of each pixel show the same view.
        whole: bool,
        /// The source of disocclusions.
        source: DisocclusionSource,
    },
}

/// An operation on the accumulation buffer, texel by texel; see `shaders/accumulate.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Step {
    /// Becomes four values.
    Fill,
    /// Copies it unchanged.
    Copy,
    /// Becomes the colour.
    Load,
    /// Adds the colour.
    Accumulate,
    /// Multiplies by a value.
    Multiply,
    /// Adds a value.
    Add,
    /// The colour becomes the accumulated value.
    Return,
}

impl Pass {
    /// All passes that assemble a picture from views, but that of walls.
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

    /// All passes.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::OUTPUTS
            .into_iter()
            .chain([Self::Wall, Self::Copy, Self::Subpixels, Self::Compose])
            .chain(Step::ALL.map(Self::Accumulate))
            .chain(Synthesis::ALL.map(Self::Synthesis))
            .chain(Points::ALL.map(Self::Points))
            .chain(Samples::ALL.map(Self::Samples))
    }
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

    pub(super) const fn panel(whole: bool, source: DisocclusionSource) -> Self {
        Self::Panel { whole, source }
    }
}

impl Points {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Subpixels,
        Self::Pixels,
        Self::View,
        Self::Group(Group::Subpixels),
        Self::Group(Group::View),
        Self::Group(Group::Rays),
        Self::Group(Group::Parameters),
    ];
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
