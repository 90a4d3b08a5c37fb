//! Names for additions to a shader, which the program itself does not use.

use super::scan::Scan;
use crate::fixed::ray_distortion;
use std::collections::HashSet;

/// A uniform of the rewritten shaders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uniform {
    /// `vec4 mv_shift[VIEWS]`, per view: s, s · conv, the shift of a vertex without perspective, all in clip space; then 1 where corners of the
    /// screen stay, 2 in an orthographic scene, else 0.
    Shift,
    /// `vec4 mv_tile[VIEWS]`, per view: centre of its tile x and y in NDC of the atlas, layer.
    Tile,
    /// `vec4 mv_map`: width and height of the program's viewport over those of the atlas.
    Map,
    /// `vec4 mv_clip`: left and right of the visible part, in NDC of the program's viewport.
    Clip,
    /// `int mv_views`: views of this draw, at most as many as the arrays hold.
    Views,
    /// `vec4 mv_across`: window pixels per step to the right in the tile, x and y; the distance from one tile to the next in pixels.
    Across,
    /// `vec4 mv_up`: window pixels per step upwards in the tile, x and y; window position of the tile's origin, x and y.
    Up,
    /// `sampler2DArray mv_distortion_map`: the map of an occlusion camera; see [`crate::fixed::ray_distortion`].
    DistortionMap,
    /// `vec4 mv_window`: factors and offsets from NDC to pixels of the map.
    Window,
    /// `vec4 mv_disparity`: factor and offset from depth in NDC to disparity; a pixel in NDC; 1 if vertices that are not moved are left
    /// out.
    Disparity,
}

impl Uniform {
    /// All uniforms.
    pub const ALL: [Uniform; 10] = [
        Uniform::Shift,
        Uniform::Tile,
        Uniform::Map,
        Uniform::Clip,
        Uniform::Views,
        Uniform::Across,
        Uniform::Up,
        Uniform::DistortionMap,
        Uniform::Window,
        Uniform::Disparity,
    ];

    const fn word(self) -> &'static str {
        match self {
            Uniform::Shift => "shift",
            Uniform::Tile => "tile",
            Uniform::Map => "map",
            Uniform::Clip => "clip",
            Uniform::Views => "views",
            Uniform::Across => "across",
            Uniform::Up => "up",
            Uniform::DistortionMap => "distortion_map",
            Uniform::Window => "window",
            Uniform::Disparity => "disparity",
        }
    }
}

/// Names that are not uniforms.
const OTHERS: [&str; 33] = [
    "main",
    "EmitVertex",
    "view",
    "by",
    "position",
    "distorted",
    "distort_rays",
    "displacement",
    "displacement_output",
    "clip",
    "vertex",
    "square",
    "pass",
    "corner",
    "visible",
    "x",
    "centre",
    "span",
    "coord",
    "point_coord",
    "seen",
    "target",
    "rule",
    "rows_down",
    "coord_sign",
    "cloud",
    "points",
    "surface",
    "point_size",
    "in_disk",
    "v0",
    "v1",
    "v2",
];

/// The names in one shader: `mv_…`. If the program uses one of those, all have the next prefix with which it uses none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    prefix: String,
}

impl Default for Names {
    /// Those of a shader that has none of them.
    fn default() -> Self {
        Self {
            prefix: "mv_".to_owned(),
        }
    }
}

impl Names {
    pub(super) fn of(scan: &Scan) -> Self {
        let taken: HashSet<_> = (0..scan.tokens.len())
            .map(|at| scan.name(at))
            .filter(|name| name.starts_with(b"mv"))
            .collect();
        let ours = || {
            let uniforms = Uniform::ALL.into_iter().map(Uniform::word);
            uniforms.chain(OTHERS)
        };
        let Self { mut prefix } = Self::default();
        // Each prefix that is not free conflicts with another name of the source, so there are no more steps than names.
        for next in 1..=taken.len() {
            let free = ours().all(|word| !taken.contains(format!("{prefix}{word}").as_bytes()));
            if free {
                break;
            }
            prefix = format!("mv{next}_");
        }
        Self { prefix }
    }

    /// The name of a uniform. A shader that does not use it does not have it (location −1).
    pub fn uniform(&self, uniform: Uniform) -> String {
        self.other(uniform.word())
    }

    /// The name of the fragment output for the displacement of a sample, where it is no built-in output.
    pub fn displacement_output(&self) -> String {
        self.other("displacement_output")
    }

    /// The source of the vertex shader object that distorts rays, with these names.
    pub fn ray_distortion(&self) -> String {
        ray_distortion(&self.prefix)
    }

    /// What all of them begin with.
    pub fn prefix(&self) -> String {
        self.prefix.clone()
    }

    pub(super) fn other(&self, word: &str) -> String {
        format!("{}{word}", self.prefix)
    }
}
