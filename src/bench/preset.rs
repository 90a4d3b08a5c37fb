//! Experiments of four papers, as closely as the scenes allow, and the results of the papers.
//!
//! Based on: J. Luo, K. Qin, Y. Zhou, M. Mao, R. Li, "GPU-based multi-view rendering for spatial-multiplex autostereoscopic displays"
//! (2010), tables 1 and 2; F. de Sorbier, V. Nozick, H. Saito, "GPU-based multi-view rendering" (2010), figures 7 to 9; V. Popescu, P.
//! Rosen, D. Aliaga, "3D display rendering acceleration using occlusion camera reference images" (2006), table 1 and section VIII; T. Hübner, Y. Zhang, R. Pajarola, "Multi-view point splatting" (2006), charts 1 to 3. The bars
//! and curves of the figures have no numbers, so only the statements of the text are given for them.

/// One experiment.
#[derive(Debug, PartialEq)]
pub struct Preset {
    /// For `--preset`.
    pub name: &'static str,
    /// The measurement of the paper, and the scenes that stand for it here.
    pub about: &'static str,
    /// Pixels of one view, which is the window.
    pub size: (u32, u32),
    /// Names of scenes; names of models if there are no configurations, and then no programs are measured.
    pub scenes: &'static [&'static str],
    /// Numbers of views.
    pub views: &'static [&'static str],
    /// Names of configurations.
    pub configurations: &'static [&'static str],
    /// The results.
    pub figures: &'static [Figure],
    /// Numbers of points and sides of the picture of clouds that are drawn as splats; then no programs are measured.
    pub splats: &'static [(u32, u32)],
}

/// The result of a paper for one scene, number of views and configuration.
#[derive(Debug, PartialEq)]
pub struct Figure {
    /// Name of the scene; empty for all of the preset.
    pub scene: &'static str,
    /// Number of views.
    pub views: &'static str,
    /// Name of the configuration.
    pub configuration: &'static str,
    /// Frame time over that of a single view.
    pub times: Option<f64>,
    /// Speed-up over the passes of the traditional method, which correspond to our replay.
    pub speedup: Option<f64>,
    /// The statement of the text where there are no numbers.
    pub words: &'static str,
}

impl Preset {
    /// Whether models are drawn, by [`super::disocclusion`], and not programs.
    #[must_use]
    pub fn draws_models(&self) -> bool {
        self.configurations.is_empty() && self.splats.is_empty()
    }

    /// The result of the paper for a row.
    #[must_use]
    pub fn figure(&self, scene: &str, views: u32, configuration: &str) -> Option<&'static Figure> {
        self.figures.iter().find(|figure| {
            (figure.scene.is_empty() || figure.scene == scene)
                && figure.views.parse() == Ok(views)
                && figure.configuration == configuration
        })
    }
}

/// Table 1 of Luo et al., frames per second: a single view, theirs, multi-pass.
const LUO_SINGLE: f64 = 137.6;

const fn luo(
    views: &'static str,
    configuration: &'static str,
    fps: f64,
    multi_pass: f64,
) -> Figure {
    Figure {
        scene: "mesh-800k",
        views,
        configuration,
        times: Some(LUO_SINGLE / fps),
        speedup: Some(fps / multi_pass),
        words: "",
    }
}

const fn quake(views: &'static str, fps: f64, annen: f64) -> Figure {
    Figure {
        scene: "room",
        views,
        configuration: "geometry",
        times: None,
        speedup: Some(fps / annen),
        words: "",
    }
}

const fn said(
    scene: &'static str,
    views: &'static str,
    configuration: &'static str,
    words: &'static str,
) -> Figure {
    Figure {
        scene,
        views,
        configuration,
        times: None,
        speedup: None,
        words,
    }
}

/// All presets.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "luo-table1",
        about: "a model of 0.79 million triangles on a GeForce 9600GT; here 0.8 million in buffer objects, because display lists are replayed",
        size: (512, 384),
        scenes: &["mesh-800k"],
        views: &["1", "2", "4", "8"],
        configurations: &["replay", "geometry"],
        figures: &[
            luo("1", "replay", 137.6, 137.6),
            luo("2", "replay", 68.6, 68.6),
            luo("4", "replay", 34.6, 34.6),
            luo("8", "replay", 17.2, 17.2),
            luo("1", "geometry", 137.6, 137.6),
            luo("2", "geometry", 115.2, 68.6),
            luo("4", "geometry", 47.5, 34.6),
            luo("8", "geometry", 20.1, 17.2),
        ],
        splats: &[],
    },
    Preset {
        name: "luo-table2",
        about: "Quake III on 7 PCs, a speed-up over Annen's multi-pass that is mostly the network's; here a lit room with a display, on one",
        size: (512, 384),
        scenes: &["room"],
        views: &["2", "4"],
        configurations: &["replay", "geometry"],
        figures: &[quake("2", 15.2, 5.2), quake("4", 12.6, 3.4)],
        splats: &[],
    },
    Preset {
        name: "desorbier-fig7",
        about: "models by glVertex on a GeForce GTX 285 at 1024x768; the bars have no numbers, so what the text says of the speed-up over passes",
        size: (1024, 768),
        scenes: &[
            "mesh-1k-immediate",
            "mesh-5k-immediate",
            "mesh-10k-immediate",
            "mesh-40k-immediate",
        ],
        views: &["2", "4"],
        configurations: &["replay", "geometry"],
        figures: &[
            said("mesh-1k-immediate", "2", "geometry", "slightly worse"),
            said("mesh-1k-immediate", "4", "geometry", "similar"),
            said("mesh-10k-immediate", "4", "geometry", "up to three times"),
            said("mesh-40k-immediate", "4", "geometry", "up to three times"),
            said("", "2", "geometry", "around twice"),
            said("", "4", "geometry", "around twice"),
        ],
        splats: &[],
    },
    Preset {
        name: "desorbier-fig8",
        about: "1 to 17 views of 10,000 triangles by glVertex; the curve has no numbers, so what the text says of it",
        size: (1024, 768),
        scenes: &["mesh-10k-immediate"],
        views: &["1", "2", "3", "4", "6", "9", "13", "17"],
        configurations: &["geometry"],
        figures: &[
            said("", "1", "geometry", "slower than 2 views"),
            said("", "2", "geometry", "as 3 and 4 views"),
            said("", "3", "geometry", "as 2 and 4 views"),
            said("", "4", "geometry", "as 2 and 3 views"),
            said("", "6", "geometry", "dropping"),
            said("", "9", "geometry", "dropping"),
            said("", "13", "geometry", "the drop ends"),
            said("", "17", "geometry", "as 13 views"),
        ],
        splats: &[],
    },
    Preset {
        name: "desorbier-fig9",
        about: "clipping in the geometry shader against both shaders. Only words in the text",
        size: (1024, 768),
        scenes: &["mesh-10k-immediate", "mesh-40k-immediate"],
        views: &["2", "4"],
        configurations: &["geometry-cut", "geometry-both"],
        figures: &[
            said(
                "mesh-10k-immediate",
                "2",
                "geometry-both",
                "both shaders better",
            ),
            said(
                "mesh-10k-immediate",
                "4",
                "geometry-both",
                "both shaders better, by more",
            ),
            said("mesh-40k-immediate", "2", "geometry-both", "similar"),
            said("mesh-40k-immediate", "4", "geometry-both", "similar"),
        ],
        splats: &[],
    },
    Preset {
        name: "popescu-table1",
        about: "samples missing in views of a depth image and of an occlusion camera's reference image; models of the paper's sizes, on the CPU",
        size: (720, 480),
        scenes: &[
            "knot", "statues", "coils", "bars", "portal", "crowd", "temple",
        ],
        views: &[],
        configurations: &[],
        figures: &[],
        splats: &[],
    },
    Preset {
        name: "huebner-chart1",
        about: "blended splats in 8 views, a scan of 303,000 points in windows of three sizes on a GeForce 7800 GTX; here a surface with as many. By fragments at least a third of the rate of one view, mostly more than half",
        size: (512, 512),
        scenes: &[],
        views: &[],
        configurations: &[],
        figures: &[],
        splats: &[(303_000, 256), (303_000, 512), (303_000, 1024)],
    },
    Preset {
        name: "huebner-chart2",
        about: "blended splats in 8 views, three scans in windows of 512 pixels; here surfaces with as many points. In the paper the ways of one pass lose less than one view does where there are more points",
        size: (512, 512),
        scenes: &[],
        views: &[],
        configurations: &[],
        figures: &[],
        splats: &[(137_000, 512), (303_000, 512), (1_100_000, 512)],
    },
    Preset {
        name: "huebner-chart3",
        about: "as chart 2, with rates in per cent of that of one view: by fragments almost 70 % for the largest scan",
        size: (512, 512),
        scenes: &[],
        views: &[],
        configurations: &[],
        figures: &[],
        splats: &[(137_000, 512), (303_000, 512), (1_100_000, 512)],
    },
];

#[cfg(test)]
mod tests {
    use super::super::{CONFIGURATIONS, SCENES};
    use super::*;
    use crate::model::MODELS;

    #[test]
    fn presets_name_what_there_is() {
        for preset in PRESETS {
            for scene in preset.scenes {
                let known = match preset.draws_models() {
                    true => MODELS.iter().any(|known| known.name == *scene),
                    false => SCENES.iter().any(|known| known.name == *scene),
                };
                assert!(known, "{scene}");
            }
            for name in preset.configurations {
                assert!(
                    CONFIGURATIONS.iter().any(|known| known.name == *name),
                    "{name}"
                );
            }
            for figure in preset.figures {
                assert!(preset.views.contains(&figure.views), "{figure:?}");
                assert!(
                    preset.configurations.contains(&figure.configuration),
                    "{figure:?}"
                );
                assert!(
                    figure.scene.is_empty() || preset.scenes.contains(&figure.scene),
                    "{figure:?}"
                );
            }
        }
    }

    #[test]
    fn ratios_are_those_of_the_tables() {
        let table = &PRESETS[0];
        let figure = table.figure("mesh-800k", 8, "geometry").unwrap();
        assert!((figure.times.unwrap() - 6.846).abs() < 1e-3);
        assert!((figure.speedup.unwrap() - 1.169).abs() < 1e-3);
        assert_eq!(table.figure("mesh-800k", 3, "geometry"), None);
    }
}
