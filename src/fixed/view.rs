//! The shift of a view and its place in the atlas, for the last stage before the rasteriser.
//!
//! Based on: Q. Luo et al., "GPU-based multi-view rendering" (the tile equation and the two clip distances), with the
//! shift in the form that is exact for every homogeneous vertex:
//! ```text
//! x' = row0(P_i · M) · vertex                            P_i: projection of the view, M: modelview
//! d0 = x' − left·w      d1 = right·w − x'               d ≥ 0 inside the tile
//! X  = x'·scale_x + centre_x·w      Y = y·scale_y + centre_y·w
//! ```
//! (x, y, w) is in clip space of the program's own viewport; (X, Y, w) in that of a viewport over the whole atlas. z and w
//! do not change.

use super::distortion;
use super::key::{FixedKey, Tiles};
use super::text::Text;
use super::{
    LIMITS, UNIFORM_CLIP, UNIFORM_FIRST, UNIFORM_MAP, UNIFORM_TILES, UNIFORM_VIEWS, VIEWS,
};
use crate::config::Clip;

/// Uniforms of the view.
pub(super) fn write_uniforms(text: &mut Text, key: &FixedKey) {
    if key.target.tiles == Tiles::DistortedRays {
        return text.line(distortion::UNIFORMS);
    }
    text.line(format!(
        "uniform vec4 {UNIFORM_VIEWS}[{VIEWS}]; // per view: row 0 of its projection times the modelview matrix"
    ));
    if key.target.tiles == Tiles::Layer {
        text.line(format!(
            "uniform vec4 {UNIFORM_TILES}[{VIEWS}]; // per view: -, -, layer, -"
        ));
    } else {
        let limits = if key.target.discards() {
            "left and right in window coordinates"
        } else {
            "-, -"
        };
        text.line(format!(
            "uniform vec4 {UNIFORM_TILES}[{VIEWS}]; // per view: centre of the tile x and y, {limits}"
        ));
        text.line(format!(
            "uniform vec4 {UNIFORM_MAP}; // scale of a tile x and y, -, -"
        ));
        if key.target.clip != Clip::Discard {
            text.line(format!(
                "uniform vec4 {UNIFORM_CLIP}; // left and right of the tile's inside, -, -"
            ));
        }
    }
    text.line(format!(
        "uniform int {UNIFORM_FIRST}; // first view of this draw"
    ));
}

/// The outputs of the view, as declarations.
pub(super) fn write_outputs(text: &mut Text, key: &FixedKey) {
    let distances = key.clip_distances();
    if distances != 0 {
        text.line(format!("out float gl_ClipDistance[{distances}];"));
    }
    if key.target.discards() {
        text.line(format!("flat out vec2 {LIMITS};"));
    }
    if key.target.tiles == Tiles::DistortedRays {
        text.line(format!("out vec2 {};", distortion::DISPLACEMENT));
    }
}

/// Writes `mv_place(view, p, vertex)`, which sets the position, the clip distances of the tile and the layer.
///
/// x is summed as the driver sums the rows of `ftransform()`. A view thus gets exactly the position that fixed function gives it
/// with the view's projection loaded (measured on llvmpipe 22.3: equal bits).
pub(super) fn write_position(text: &mut Text, key: &FixedKey) {
    if key.target.tiles == Tiles::DistortedRays {
        return distortion::write_position(text);
    }
    text.open("void mv_place(int view, vec4 p, vec4 vertex) {");
    text.line(format!("vec4 row = {UNIFORM_VIEWS}[view];"));
    text.line(format!("vec4 tile = {UNIFORM_TILES}[view];"));
    text.line("p.x = row.x * vertex.x + row.y * vertex.y + row.z * vertex.z + row.w * vertex.w;");
    match key.target.tiles {
        Tiles::Layer => text.line("gl_Layer = int(tile.z);"),
        Tiles::DistortedRays => {}
        Tiles::ClipLeftRight => {
            if key.target.discards() {
                text.line(format!("{LIMITS} = tile.zw;"));
            } else if !key.target.cuts() {
                text.line(format!(
                    "gl_ClipDistance[0] = p.x - {UNIFORM_CLIP}.x * p.w;"
                ));
                text.line(format!(
                    "gl_ClipDistance[1] = {UNIFORM_CLIP}.y * p.w - p.x;"
                ));
            }
            text.line(format!("p.xy = p.xy * {UNIFORM_MAP}.xy + tile.xy * p.w;"));
        }
    }
    text.line("gl_Position = p;");
    text.close("}");
}
