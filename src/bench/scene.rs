//! The scenes: unmodified fixed-function programs of `examples/` with different bottlenecks.

/// One scene.
#[derive(Debug, PartialEq)]
pub struct Scene {
    /// The name for `--scene`.
    pub name: &'static str,
    /// The program's name in `examples/Makefile`.
    pub program: &'static str,
    /// Its arguments, except for the size.
    pub arguments: &'static [&'static str],
    /// What bounds the time of a frame.
    pub work: Work,
    /// A sentence for `--list`.
    pub about: &'static str,
}

/// The work in a frame of one view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Triangles, most of them smaller than a pixel's neighbourhood.
    Triangles(u32),
    /// Fragments per pixel of the picture.
    Overdraw(u32),
    /// Draw calls.
    Draws(u32),
    /// A bit of everything.
    Mixed,
}

impl Work {
    /// The rate in millions per second, and its unit, of a frame of this size in pixels that takes `ms` milliseconds.
    #[must_use]
    pub fn per_second(self, (width, height): (u32, u32), ms: f64) -> Option<(f64, &'static str)> {
        let (pieces, unit) = match self {
            Self::Triangles(triangles) => (f64::from(triangles), "million triangles/s"),
            Self::Overdraw(times) => (
                f64::from(times) * f64::from(width) * f64::from(height),
                "million fragments/s",
            ),
            Self::Draws(draws) => (f64::from(draws), "million draws/s"),
            Self::Mixed => return None,
        };
        Some((pieces / ms / 1e3, unit))
    }
}

/// The scenes of `manyview bench` without `--scene`: one for each kind of cost.
pub const DEFAULT_SCENES: &[&str] = &["mesh-100k", "draws-3000", "fill", "room"];

const fn mesh(
    name: &'static str,
    triangles: u32,
    arguments: &'static [&'static str],
    about: &'static str,
) -> Scene {
    Scene {
        name,
        program: "mesh",
        arguments,
        work: Work::Triangles(triangles),
        about,
    }
}

const fn fill(
    name: &'static str,
    arguments: &'static [&'static str],
    about: &'static str,
) -> Scene {
    Scene {
        name,
        program: "fill",
        arguments,
        work: Work::Overdraw(8),
        about,
    }
}

/// All scenes.
pub const SCENES: &[Scene] = &[
    mesh(
        "mesh-10k",
        10_000,
        &["--triangles", "10000", "--vbo"],
        "10,000 lit triangles in buffer objects",
    ),
    mesh(
        "mesh-100k",
        100_000,
        &["--triangles", "100000", "--vbo"],
        "100,000 in buffer objects",
    ),
    mesh(
        "mesh-100k-arrays",
        100_000,
        &["--triangles", "100000"],
        "100,000 in client arrays",
    ),
    mesh(
        "mesh-100k-list",
        100_000,
        &["--triangles", "100000", "--list"],
        "100,000 in a display list",
    ),
    mesh(
        "mesh-1k-immediate",
        1_000,
        &["--triangles", "1000", "--immediate"],
        "1,000 by glVertex",
    ),
    mesh(
        "mesh-5k-immediate",
        5_000,
        &["--triangles", "5000", "--immediate"],
        "5,000 by glVertex",
    ),
    mesh(
        "mesh-10k-immediate",
        10_000,
        &["--triangles", "10000", "--immediate"],
        "10,000 by glVertex",
    ),
    mesh(
        "mesh-40k-immediate",
        40_000,
        &["--triangles", "40000", "--immediate"],
        "40,000 by glVertex",
    ),
    mesh(
        "mesh-100k-immediate",
        100_000,
        &["--triangles", "100000", "--immediate"],
        "100,000 by glVertex",
    ),
    mesh(
        "mesh-800k",
        800_000,
        &["--triangles", "800000", "--vbo"],
        "800,000 in buffer objects",
    ),
    mesh(
        "mesh-800k-list",
        800_000,
        &["--triangles", "800000", "--list"],
        "800,000 in a display list",
    ),
    mesh(
        "mesh-4m",
        4_000_000,
        &["--triangles", "4000000", "--vbo"],
        "4,000,000 in buffer objects",
    ),
    Scene {
        name: "draws-3000",
        program: "arrays",
        arguments: &["--many", "3000"],
        work: Work::Draws(3000),
        about: "3,000 glDrawArrays of about ten triangles, a matrix before each",
    },
    fill(
        "fill",
        &["--overdraw", "8"],
        "8 blended surfaces over the whole picture",
    ),
    fill(
        "fill-textured",
        &["--overdraw", "8", "--textured"],
        "the same with a mipmapped texture",
    ),
    fill(
        "fill-opaque",
        &["--overdraw", "8", "--opaque"],
        "the same without blending or texture",
    ),
    Scene {
        name: "field",
        program: "field",
        arguments: &[],
        work: Work::Mixed,
        about: "things all around by glBegin/glEnd, few of them in the picture",
    },
    Scene {
        name: "menu",
        program: "menu",
        arguments: &["--flat"],
        work: Work::Mixed,
        about: "a menu without depth, the same in all views",
    },
    Scene {
        name: "room",
        program: "room",
        arguments: &[],
        work: Work::Mixed,
        about: "a lit and textured room by glBegin/glEnd, with a flat display",
    },
];
