//! What the passes of `shaders/*.wgsl` make.
#![forbid(unsafe_code)]

use crate::config::Behind;

/// What a pass makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// The panel's picture, through the mask: views of any size, filtered or not.
    Interleave,
    /// The same for views of the picture's size.
    Texels(Texels),
    /// The same for views that have fewer texels, lens by lens or evenly.
    Lenses(Lenses),
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

/// How far the texels are from where the panel shows their view; see `shaders/lenses.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lenses {
    /// Nowhere: each pixel shows one view.
    Pixels,
    /// Between texels.
    Texels,
}

/// What is made of a picture with depths; see `shaders/field.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Synthesis {
    /// The greatest and the least height of each block of a row.
    Peaks,
    /// The greatest of each row.
    Tops,
    /// The greatest and the least of all that the rays of a block can meet.
    Range,
    /// Where heights step down or up.
    Steps,
    /// Which blocks are near such steps.
    Splats,
    /// The distortion map of an occlusion camera.
    Bends,
    /// One view, with depths, and what is known of what is hidden.
    View(Behind),
    /// The panel's picture, through a mask of views; of one view for each pixel, where the mask is `whole`.
    Panel {
        /// Red, green and blue show the same view.
        whole: bool,
        /// As for a view.
        behind: Behind,
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
        Self::Lenses(Lenses::Pixels),
        Self::Lenses(Lenses::Texels),
        Self::Layout,
        Self::Whole,
        Self::Anaglyph,
        Self::Rgbd,
    ];
}

impl Synthesis {
    /// All of them.
    pub const ALL: [Self; 15] = [
        Self::Peaks,
        Self::Tops,
        Self::Range,
        Self::Steps,
        Self::Splats,
        Self::Bends,
        Self::View(Behind::Nothing),
        Self::View(Behind::Reference),
        Self::View(Behind::Views),
        Self::panel(false, Behind::Nothing),
        Self::panel(false, Behind::Reference),
        Self::panel(false, Behind::Views),
        Self::panel(true, Behind::Nothing),
        Self::panel(true, Behind::Reference),
        Self::panel(true, Behind::Views),
    ];

    pub(super) const fn panel(whole: bool, behind: Behind) -> Self {
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
