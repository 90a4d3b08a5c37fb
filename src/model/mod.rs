//! Scenes made by equations, of the sizes of those in papers: surfaces in inches, all in the sphere of a volumetric display.
//!
//! Pure and the same every time. x to the right, y upwards, z towards the viewer, the origin in the middle of the display.
#![forbid(unsafe_code)]

mod furniture;
mod noise;
mod project;
mod statue;
mod surface;
mod temple;
#[cfg(test)]
mod tests;

pub use project::{project, unproject};
pub use surface::{Corner, Solid, Surface};

/// Radius of the display, in inches; every scene lies within it.
pub const RADIUS: f32 = 5.0;

/// A scene.
#[derive(Debug)]
pub struct Model {
    /// In tables and file names.
    pub name: &'static str,
    /// The surfaces of the scene.
    pub about: &'static str,
    /// Makes its surfaces.
    pub surfaces: fn() -> Vec<Surface>,
}

/// All scenes.
pub const MODELS: &[Model] = &[
    Model {
        name: "knot",
        about: "one closed surface of 0.32 million triangles, a bumpy tube that runs before itself",
        surfaces: statue::knot,
    },
    Model {
        name: "statues",
        about: "four statues of 4.6 million triangles together, arms before their robes",
        surfaces: statue::four,
    },
    Model {
        name: "coils",
        about: "a statue of 10.25 million triangles within thin coils and tusks",
        surfaces: statue::coils,
    },
    Model {
        name: "bars",
        about: "upright bars that float in front of a checkered wall",
        surfaces: furniture::bars,
    },
    Model {
        name: "portal",
        about: "an auditorium behind a square window",
        surfaces: furniture::portal,
    },
    Model {
        name: "crowd",
        about: "150 small balls, rings and boxes before each other",
        surfaces: furniture::crowd,
    },
    Model {
        name: "temple",
        about: "a bronze within columns, below beams; kept apart, nothing was chosen on it",
        surfaces: temple::temple,
    },
];

/// All triangles of some surfaces.
pub fn triangles(surfaces: &[Surface]) -> impl Iterator<Item = Solid> {
    surfaces.iter().flat_map(Surface::triangles)
}
