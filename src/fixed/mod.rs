//! Generates GLSL from fixed-function state.
//!
//! The instanced and geometry strategies need a program where the application has none. Only the vertex stage has to be
//! replaced: a program without a fragment shader leaves the fixed fragment stage at work (OpenGL 4.6 compatibility,
//! chapter 15), so texture environments, fog blending, alpha test and the rest stay the driver's. The fragment stage is
//! replaced as well where the tiles need it: see [`generate_fragment`].
//!
//! ```text
//! FixedKey ── canonical ──► vertex ─┬─ lighting   section 12.2.1
//!  (key)                            ├─ texgen     sections 12.1.1, 12.1.3
//!                                   ├─ distortion the rays of an occlusion camera
//!                                   └─ view       shift, tile, clip distances, layer
//!                           geometry ── view      one primitive per view
//!                           tessellation ── distortion  small primitives for distorted rays
//!
//! FragmentKey ── canonical ──► fragment ── environment   sections 16.2 to 16.4
//! ```
//! Everything here is text: no GL call is made, and no state is kept. `tests/fixed_shaders.rs` draws a few hundred
//! random keys both ways and compares the pixels.
//!
//! The shaders read the program's state through the built-in uniforms of the compatibility profile. Their own uniforms
//! are those of the view, the same for every key:
//!
//! | uniform | holds |
//! |---|---|
//! | `vec4 mv_view[64]` | per view: row 0 of its projection times the modelview matrix; the other rows are the program's own |
//! | `vec4 mv_tile[64]` | per view: centre of its tile x and y in NDC of the atlas; its layer, or its sides where fragments are discarded |
//! | `vec4 mv_map` | width and height of the program's viewport over those of the atlas |
//! | `vec4 mv_clip` | left and right of the visible part, in NDC of the program's viewport: −1 and 1 if that is inside the tile; z, w unused |
//! | `int mv_first` | index in `mv_view` of the first view of this draw |
//! | `vec4 mv_grid` | tile pixels per window pixel, for texture gradients: x and y of a step in x, then of a step in y |
//! | `sampler2DArray mv_distortion_map`, `vec4 mv_window`, `vec4 mv_disparity` | map, pixels and disparities of an occlusion camera: `distortion` |
//! | `float mv_levels` | the highest level of tessellation |
//! | `mv_texture0` … `mv_texture7` | samplers; each has to hold the index of its texture unit |
//!
//! A uniform that a key does not need is absent (location −1).
#![forbid(unsafe_code)]

mod components;
mod distortion;
mod environment;
mod fragment;
mod fragment_key;
mod geometry;
mod key;
mod lighting;
mod limits;
mod patches;
mod points;
mod reason;
mod surface;
mod tessellation;
mod texgen;
mod text;
mod vertex;
mod view;

pub use crate::config::Clip;
pub use components::batch;
pub use distortion::{UNIFORM_DISPARITY, UNIFORM_DISTORTION_MAP, UNIFORM_WINDOW, ray_distortion};
pub use fragment::{generate_fragment, sampler};
pub use fragment_key::{
    Argument, BaseFormat, Combine, Combiner, Environment, FogMode, FragmentKey, FragmentUnit,
    Function, Operand, Source, TextureTarget,
};
pub use key::{
    Amplifier, ColorMaterial, Diagonal, Dialect, FixedKey, FogSource, LIGHTS, Light, Lighting,
    MaterialFace, MaterialMode, NormalScaling, PointSize, Primitive, Provoking, Target, TexGen,
    TextureUnit, Tiles, UNITS,
};
pub use limits::{Limits, VertexLayer};
pub use patches::Patches;
pub use points::{PointPlace, point_globals, point_quads, point_shift, point_test};
pub use reason::{Rasterised, Surroundings, Unsupported};
pub use surface::{SURFACE_BINDING, SURFACE_EXTENSION, surface_disk, surface_size};
pub use tessellation::{LEVELS, UNIFORM_LEVELS};

/// Number of views that `mv_view` holds. More views take further draws, with new contents of the array.
pub const VIEWS: u32 = 64;
/// `uniform vec4 mv_view[VIEWS]`
pub const UNIFORM_VIEWS: &str = "mv_view";
/// `uniform vec4 mv_tile[VIEWS]`
pub const UNIFORM_TILES: &str = "mv_tile";
/// `uniform vec4 mv_map`
pub const UNIFORM_MAP: &str = "mv_map";
/// `uniform vec4 mv_clip`
pub const UNIFORM_CLIP: &str = "mv_clip";
/// `uniform int mv_first`
pub const UNIFORM_FIRST: &str = "mv_first";

/// `uniform vec4 mv_grid`
pub const UNIFORM_GRID: &str = "mv_grid";
/// `flat vec2 mv_limits`, between the stages: left (inclusive) and right (exclusive) of the view in window coordinates.
const LIMITS: &str = "mv_limits";

/// Sources of a generated program, and the state that has to be set when it is bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shaders {
    /// The vertex shader.
    pub vertex: String,
    /// The geometry shader, if the amplifier is one.
    pub geometry: Option<String>,
    /// The tessellation control and evaluation shaders, if the amplifier is [`Amplifier::Tessellation`].
    pub tessellation: Option<[String; 2]>,
    /// State that the caller sets for the draw.
    pub patches: Patches,
}

/// Writes the program of a key. Equal canonical keys (and limits) give equal sources.
///
/// # Errors
/// If the driver cannot run the shaders; the draw then has to be replayed. [`Surroundings::allow`] has the reasons that do
/// not depend on the sources.
pub fn generate(key: &FixedKey, limits: &Limits) -> Result<Shaders, Unsupported> {
    let key = key.canonical();
    if key.driver_quirk() {
        return Err(Unsupported::DriverQuirk);
    }
    components::check(&key, limits)?;
    Ok(Shaders {
        vertex: vertex::write(&key, limits)?,
        geometry: if key.geometry() && !key.tessellates() {
            Some(geometry::write(&key, limits)?)
        } else {
            None
        },
        tessellation: key.tessellates().then(|| {
            [
                tessellation::write_control(&key),
                tessellation::write_evaluation(&key),
            ]
        }),
        patches: Patches::of(&key),
    })
}
