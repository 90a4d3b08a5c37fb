//! Configurations: named sets of the layer's options. A new switch of the layer is one more row.

use crate::config::{OptionId, Origin, Settings};

/// Options of the layer under one name.
#[derive(Debug, PartialEq)]
pub struct Configuration {
    /// The name for `--strategy`.
    pub name: &'static str,
    /// The options that it sets.
    pub options: &'static [(OptionId, &'static str)],
    /// A sentence for `--list`.
    pub about: &'static str,
}

/// The configuration that every picture is compared with: the most exact one.
pub const EXACT: Configuration = Configuration {
    name: "exact",
    options: &[
        (OptionId::Strategy, "replay"),
        (OptionId::Atlas, "layers"),
        (OptionId::ViewScale, "1"),
    ],
    about: "every draw again for each view, each view at the origin of its own layer",
};

/// The configuration that chooses one of the others.
pub const AUTO: &str = "auto";

/// The configurations of `manyview bench` without `--strategy`.
pub const DEFAULT_CONFIGURATIONS: &[&str] = &["replay", "instanced", "geometry"];

const LAYERS: (OptionId, &str) = (OptionId::Atlas, "layers");
const REPLAY: (OptionId, &str) = (OptionId::Strategy, "replay");
const INSTANCED: (OptionId, &str) = (OptionId::Strategy, "instanced");
const HYBRID: (OptionId, &str) = (OptionId::Strategy, "hybrid");
const GEOMETRY: (OptionId, &str) = (OptionId::Strategy, "geometry");

const DISTANCES: (OptionId, &str) = (OptionId::Clip, "distances");
const DISCARD: (OptionId, &str) = (OptionId::Clip, "discard");
const BOTH: (OptionId, &str) = (OptionId::Clip, "both");
const CUT: (OptionId, &str) = (OptionId::Clip, "cut");

const fn row(
    name: &'static str,
    options: &'static [(OptionId, &'static str)],
    about: &'static str,
) -> Configuration {
    Configuration {
        name,
        options,
        about,
    }
}

/// All configurations.
pub const CONFIGURATIONS: &[Configuration] = &[
    row(
        AUTO,
        &[(OptionId::Strategy, "auto")],
        "what the layer takes by itself",
    ),
    row("replay", &[REPLAY], "every draw again for each view"),
    row(
        "instanced",
        &[INSTANCED],
        "one draw with an instance per view",
    ),
    row(
        "geometry",
        &[GEOMETRY],
        "one draw, a geometry shader makes the views",
    ),
    row(
        "splats",
        &[(OptionId::Strategy, "splats")],
        "points once for all views, the rest by replay",
    ),
    row(
        "depth-image",
        &[(OptionId::Strategy, "depth-image")],
        "the scene once, the other views by its depths",
    ),
    row(
        "occlusion",
        &[(OptionId::Strategy, "occlusion")],
        "the same, and what is hidden from an occlusion camera's reference image",
    ),
    row(
        "hybrid-2",
        &[HYBRID, (OptionId::TrueViews, "2")],
        "the scene in two views, the others by the depths of those beside them",
    ),
    row(
        "hybrid-3",
        &[HYBRID, (OptionId::TrueViews, "3")],
        "the same with three",
    ),
    row(
        "hybrid-4",
        &[HYBRID, (OptionId::TrueViews, "4")],
        "the same with four",
    ),
    row(
        "replay-layers",
        &[REPLAY, LAYERS],
        "replay, the views in layers of the atlas",
    ),
    row(
        "replay-auto-depth",
        &[REPLAY, (OptionId::AutoDepth, "1")],
        "replay, the cameras follow the depths of each frame; they stand still in all other configurations",
    ),
    row(
        "instanced-layers",
        &[INSTANCED, LAYERS],
        "instanced, the views in layers of the atlas",
    ),
    row(
        "geometry-layers",
        &[GEOMETRY, LAYERS],
        "geometry, the views in layers of the atlas, so without clip distances",
    ),
    row(
        "instanced-distances",
        &[INSTANCED, DISTANCES],
        "instanced, the views beside each other, cut by clip distances",
    ),
    row(
        "geometry-distances",
        &[GEOMETRY, DISTANCES],
        "geometry, the views beside each other, cut by clip distances",
    ),
    row(
        "instanced-discard",
        &[INSTANCED, DISCARD],
        "instanced, the views beside each other, fragments outside discarded",
    ),
    row(
        "geometry-discard",
        &[GEOMETRY, DISCARD],
        "geometry, the views beside each other, fragments outside discarded",
    ),
    row(
        "geometry-both",
        &[GEOMETRY, BOTH],
        "the same, primitives that are outside as a whole left out by the geometry shader",
    ),
    row(
        "geometry-cut",
        &[GEOMETRY, CUT],
        "geometry, the views beside each other, triangles cut by the geometry shader",
    ),
];

/// A configuration at one size of its views.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The named options.
    pub configuration: &'static Configuration,
    /// As given to `--view-scale`.
    pub view_scale: String,
    /// As given to `--display`; none for the layer's own.
    pub display: Option<String>,
    /// The name of a [`crate::config::Optimisation`] that is turned off.
    pub disabled: Option<&'static str>,
}

impl Variant {
    /// The name in tables and charts.
    #[must_use]
    pub fn name(&self) -> String {
        let mut name = self.configuration.name.to_owned();
        if self.view_scale != "1" {
            name = format!("{name} at {}", self.view_scale);
        }
        if let Some(disabled) = self.disabled {
            name = format!("{name} without {disabled}");
        }
        name
    }

    /// The layer's options for `views` views, as if they stood on the command line.
    #[must_use]
    pub fn settings(&self, views: &str) -> Settings {
        let mut settings = Settings::default();
        settings.set(OptionId::ViewScale, &self.view_scale, Origin::CommandLine);
        // Pictures are compared, so the cameras stand still.
        settings.set(OptionId::AutoDepth, "0", Origin::Default);
        if let Some(display) = &self.display {
            settings.set(OptionId::Display, display, Origin::CommandLine);
        }
        for (id, value) in self.configuration.options {
            settings.set(*id, *value, Origin::CommandLine);
        }
        if let Some(disabled) = self.disabled {
            settings.set(OptionId::Disable, disabled, Origin::CommandLine);
        }
        settings.set(OptionId::Views, views, Origin::CommandLine);
        settings
    }
}
