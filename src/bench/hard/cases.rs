//! The table of the cases.

use super::{Bound, Case, Measure, Miss, Subject};
use crate::config::OptionId;

/// κ and ξ of most scenes.
const USUAL: [&str; 2] = ["0.3", "8"];

/// "At most 0.03 % of the pixels differ": the design's gate for strategies that are exact.
const GATE: Bound = both(Measure::Differing, 0.03);
const NOTHING_WRONG: Bound = both(Measure::Foreign, 0.0);
const IN_PLACE: Bound = both(Measure::Place, 0.01);
const NOTHING_MISSED: Bound = both(Measure::Missed, 0.0);

const fn both(measure: Measure, most: f64) -> Bound {
    Bound {
        measure,
        most,
        side_by_side: most,
    }
}

const fn scene(
    name: &'static str,
    about: &'static str,
    bounds: &'static [Bound],
    source: &'static str,
) -> Case {
    with(name, name, 3, USUAL, &[], (about, source), bounds)
}

const fn with(
    name: &'static str,
    scene: &'static str,
    views: u32,
    cameras: [&'static str; 2],
    options: &'static [(OptionId, &'static str)],
    (about, source): (&'static str, &'static str),
    bounds: &'static [Bound],
) -> Case {
    Case {
        name,
        about,
        subject: Subject::Scene {
            scene,
            views,
            cameras,
            options,
        },
        bounds,
        source,
    }
}

const fn not_yet(name: &'static str, about: &'static str, why: &'static str) -> Case {
    Case {
        name,
        about,
        subject: Subject::NotYet(why),
        bounds: &[],
        source: "",
    }
}

const EQUATION: &str = "the equation of the cameras; edges of 149 rows tell a place to 0.004 px";
const FLOAT_CUT: &str = "a model of cuts at x = w in 32-bit floats";
const GATE_SOURCE: &str = "the gate of the design";

/// All cases.
pub const CASES: &[Case] = &[
    scene(
        "depths",
        "markers at depths 4 to 1000",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "homogeneous",
        "vertices with w of 0.001 to 1000",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "extruded",
        "a shadow volume to vertices with w = 0, counted in the stencil buffer",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "sky",
        "what is infinitely far has the disparity of infinity, and nothing more",
        &[IN_PLACE],
        EQUATION,
    ),
    scene(
        "mirrored",
        "a camera that mirrors, back faces culled",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "left-handed",
        "a camera along +z, back faces culled",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "turned",
        "a camera that mirrors along +z, back faces culled",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "large-matrix",
        "a projection times 1024",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "small-matrix",
        "a projection over 1024",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "off-axis",
        "a frustum whose axis is 8 pictures beside it",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    scene(
        "camera",
        "the camera in the projection matrix",
        &[IN_PLACE, NOTHING_WRONG],
        EQUATION,
    ),
    with(
        "near-focus",
        "near-focus",
        3,
        ["0.0008", "0.02"],
        &[],
        ("a focal depth of twice the near plane's", EQUATION),
        &[IN_PLACE, NOTHING_WRONG],
    ),
    with(
        "many-views",
        "depths",
        63,
        ["0.01", "8"],
        &[],
        ("63 views", EQUATION),
        &[IN_PLACE],
    ),
    with(
        "apart",
        "apart",
        3,
        ["6", "8"],
        &[],
        (
            "cameras so far apart that views leave the scene",
            GATE_SOURCE,
        ),
        &[GATE, NOTHING_WRONG],
    ),
    scene(
        "far-from-origin",
        "a world at 1,000,000",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "behind-1e3",
        "triangles through the plane of the camera to 1,000 times as far behind it",
        &[both(Measure::Edge, 0.13), NOTHING_WRONG],
        FLOAT_CUT,
    ),
    scene(
        "behind-1e4",
        "to 10,000 times as far behind it",
        &[both(Measure::Edge, 1.4), NOTHING_WRONG],
        FLOAT_CUT,
    ),
    scene(
        "behind-1e6",
        "to 1,000,000 times as far behind it",
        &[both(Measure::Edge, 1.4), NOTHING_WRONG],
        FLOAT_CUT,
    ),
    scene(
        "wide",
        "wide and smooth points and lines on the sides of the views",
        &[NOTHING_WRONG],
        "points are clipped by their centres (OpenGL 2.1, 2.12): a wide one hangs over by half its size",
    ),
    scene(
        "clip-planes",
        "six clip planes of the program's own",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "decals",
        "decals in the plane of a wall by polygon offset",
        &[GATE, NOTHING_WRONG],
        "an offset is the same in every view",
    ),
    with(
        "decals-scaled",
        "offset-gauge",
        3,
        USUAL,
        &[(OptionId::ViewScale, "0.5")],
        (
            "the size of a polygon offset where pixels are twice as large",
            "slopes double with the pixels; 1 % after compensation",
        ),
        &[both(Measure::Area, 1.0)],
    ),
    scene(
        "reversed",
        "infinite projection, near depths largest",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "infinite",
        "infinite projection",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "zero-to-one",
        "glClipControl, depths from 1 to 0",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "depth-range",
        "glDepthRange turned round and in two parts",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "gaps",
        "bars before a wall, thin gaps, edges of the picture",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "layered",
        "lights that are added, depths cleared in the frame, a flat display",
        &[GATE, NOTHING_WRONG],
        GATE_SOURCE,
    ),
    scene(
        "equal-arrays",
        "two passes with GL_EQUAL, both from arrays",
        &[NOTHING_MISSED],
        "invariance (OpenGL 2.1, appendix A)",
    ),
    scene(
        "equal-immediate",
        "the second pass by glBegin",
        &[NOTHING_MISSED],
        "invariance (OpenGL 2.1, appendix A)",
    ),
    scene(
        "equal-list",
        "the second pass by a display list",
        &[NOTHING_MISSED],
        "invariance (OpenGL 2.1, appendix A)",
    ),
    scene(
        "equal-program",
        "the second pass by a shader with ftransform()",
        &[NOTHING_MISSED],
        "GLSL 1.20, 8.9: ftransform()",
    ),
    scene(
        "hud",
        "a flat display: bitmaps, triangles, lines",
        &[Bound {
            measure: Measure::Same,
            most: 0.0,
            side_by_side: 0.03,
        }],
        "a flat display is the same in all views",
    ),
    scene(
        "flat-first",
        "flat primitives, the first vertex provokes",
        &[both(Measure::Steps, 0.0), NOTHING_WRONG],
        "OpenGL 3.2, 2.19",
    ),
    scene(
        "flat-last",
        "flat primitives, the last vertex provokes",
        &[both(Measure::Steps, 0.0), NOTHING_WRONG],
        "OpenGL 3.2, 2.19",
    ),
    scene(
        "lighting",
        "two sides, separate specular colour, colour material, spot light, fog",
        &[both(Measure::Steps, 1.0)],
        "one rounding of a colour",
    ),
    scene(
        "normals",
        "normals under scales that differ by 30,000",
        &[both(Measure::Steps, 1.0)],
        "one rounding of a colour",
    ),
    scene(
        "slivers",
        "triangles smaller than pixels, slivers, edges that meet others' middles",
        &[GATE],
        GATE_SOURCE,
    ),
    scene(
        "texture",
        "texture coordinates of 100,000",
        &[GATE],
        GATE_SOURCE,
    ),
    with(
        "levels-scaled",
        "levels",
        3,
        USUAL,
        &[(OptionId::ViewScale, "0.5")],
        (
            "the level of detail where pixels are twice as large",
            "a compensated level",
        ),
        &[both(Measure::Level, 0.25)],
    ),
    with(
        "levels-lenses",
        "levels",
        8,
        ["0.05", "8"],
        &[
            (OptionId::ViewScale, "auto"),
            (OptionId::Display, "lenticular-8"),
        ],
        (
            "the level of detail where pixels are 8 times as wide",
            "a compensated level",
        ),
        &[both(Measure::Level, 0.25)],
    ),
    scene(
        "ids",
        "closed lines, restarts, ranges, base vertices, several draws, instances",
        &[both(Measure::Steps, 0.0), NOTHING_WRONG],
        "an id is right or wrong",
    ),
    scene(
        "instances",
        "gl_InstanceID, divisors and gl_PrimitiveID in a shader",
        &[both(Measure::Steps, 0.0), NOTHING_WRONG],
        "an id is right or wrong",
    ),
    scene(
        "answers",
        "occlusion queries, selection, feedback, pixels read",
        &[both(Measure::Answers, 0.0)],
        "the program is told what it would be told without the layer",
    ),
    Case {
        name: "mask-8k",
        about: "a slanted sheet with a rational slope on 7680x4320 pixels",
        subject: Subject::Mask,
        bounds: &[both(Measure::Mask, 0.0)],
        source: "phases in whole numbers",
    },
    not_yet(
        "fragcoord",
        "gl_FragCoord and dFdx in views with fewer pixels",
        "views with a program's own shaders have the size of the window",
    ),
    not_yet(
        "feedback-shaders",
        "transform feedback of a program's own shaders",
        "its draws are replayed, and a capture by one of them is not told from drawing",
    ),
];

/// The configurations whose shader moves the views side by side.
const CLIPPED: &[&str] = &[
    "instanced-distances",
    "geometry-distances",
    "instanced-discard",
    "geometry-discard",
    "geometry-both",
    "geometry-cut",
];

/// The cases that miss their bound, with the reason. A case that meets its bound again has to leave this list.
pub const MISSES: &[Miss] = &[
    Miss {
        case: "texture",
        strategies: CLIPPED,
        why: "a float leaves half a texel of such coordinates, so every other order of sums shows; the draw does not tell that it has them",
    },
    Miss {
        case: "lighting",
        strategies: &["instanced-discard", "geometry-discard", "geometry-both"],
        why: "a pixel of a silhouette: triangles over the side of a view are not cut there, so their edges are others",
    },
    Miss {
        case: "far-from-origin",
        strategies: &["geometry-cut"],
        why: "the corners at which triangles are cut are rounded once more, in coordinates that have few digits left",
    },
    Miss {
        case: "behind-1e6",
        strategies: &["geometry-cut"],
        why: "where w of two corners is a million times apart, a float leaves several pixels of where the side of a view cuts between them",
    },
    Miss {
        case: "levels-lenses",
        strategies: &[
            "replay",
            "replay-layers",
            "replay-auto-depth",
            "instanced-distances",
            "geometry-distances",
            "instanced-discard",
            "geometry-discard",
            "geometry-both",
            "geometry-cut",
        ],
        why: "replayed, and a level bias knows one axis only: what is squeezed along the other gets too fine a level",
    },
];
