//! The values that can change while the program runs.
#![forbid(unsafe_code)]

use super::{Camera, CaptureWhat, Config, ConfigError, OptionId, Origin, Output, Settings, parse};

/// What is in force now; it begins as the options say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Live {
    /// What is given to the swap.
    pub output: Output,
    /// Spacing of the cameras and the depth of zero parallax.
    pub camera: Camera,
    /// Where flat draws stand that no rule places.
    pub hud_depth: f64,
    /// All cameras are the program's own, and its own view is shown.
    pub flat: bool,
}

impl Live {
    /// The options that can be set while the program runs.
    pub const OPTIONS: [OptionId; 6] = [
        OptionId::Output,
        OptionId::Separation,
        OptionId::Convergence,
        OptionId::EyeSpacing,
        OptionId::FocalDepth,
        OptionId::HudDepth,
    ];

    /// What the program starts with.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        Self {
            output: config.output,
            camera: config.camera,
            hud_depth: config.hud_depth.or(config.profile.hud_depth).unwrap_or(0.0),
            flat: false,
        }
    }

    /// These values with some of them changed, all or none. `chosen` is what [`Camera::Auto`] stands for, once it is known:
    /// separation and convergence.
    pub fn with(
        self,
        config: &Config,
        changes: &[(OptionId, String)],
        chosen: Option<(f64, f64)>,
    ) -> Result<Self, ConfigError> {
        let mut settings = Settings::default();
        for (id, value) in changes {
            settings.set(*id, value, Origin::Request);
        }
        let changed = |id| changes.iter().any(|(given, _)| *given == id);
        if changes.iter().any(|(id, _)| id.places_cameras()) {
            self.complete(&mut settings, chosen);
        }
        Ok(Self {
            output: if changed(OptionId::Output) {
                parse::output_of(&settings, &config.display, config.views)?
            } else {
                self.output
            },
            camera: match parse::camera(&settings)? {
                Camera::Auto => self.camera,
                placed => placed,
            },
            hud_depth: parse::hud_depth(&settings)?.unwrap_or(self.hud_depth),
            flat: self.flat,
        })
    }

    /// Of a pair of which one half is given, the other one stays as it is.
    fn complete(self, settings: &mut Settings, chosen: Option<(f64, f64)>) {
        for (id, value) in self.cameras(chosen).into_iter().flatten() {
            let partner = match id {
                OptionId::Separation => OptionId::Convergence,
                OptionId::Convergence => OptionId::Separation,
                OptionId::EyeSpacing => OptionId::FocalDepth,
                _ => OptionId::EyeSpacing,
            };
            if settings.get(id).is_none() && settings.get(partner).is_some() {
                settings.set(id, value.to_string(), Origin::Request);
            }
        }
    }

    /// The pair of options that places the cameras; `chosen` as for [`Live::with`].
    #[must_use]
    pub fn cameras(self, chosen: Option<(f64, f64)>) -> Option<[(OptionId, f64); 2]> {
        let clip = |(separation, convergence)| {
            [
                (OptionId::Separation, separation),
                (OptionId::Convergence, convergence),
            ]
        };
        match self.camera {
            Camera::Auto => chosen.map(clip),
            Camera::Clip {
                separation,
                convergence,
            } => Some(clip((separation, convergence))),
            Camera::Eye {
                spacing,
                focal_depth,
            } => Some([
                (OptionId::EyeSpacing, spacing),
                (OptionId::FocalDepth, focal_depth),
            ]),
        }
    }
}

impl CaptureWhat {
    /// What a picture of a running program is to hold.
    pub fn asked(value: &str, views: u32) -> Result<Self, ConfigError> {
        let mut settings = Settings::default();
        settings.set(OptionId::CaptureWhat, value, Origin::Request);
        parse::capture_what(&settings, views)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn config(pairs: &[(OptionId, &str)]) -> Config {
        let mut settings = Settings::default();
        for (id, value) in pairs {
            settings.set(*id, *value, Origin::CommandLine);
        }
        Config::from_settings(&settings).unwrap()
    }

    fn changed(
        config: &Config,
        changes: &[(OptionId, &str)],
        chosen: Option<(f64, f64)>,
    ) -> Result<Live, String> {
        let changes: Vec<_> = changes
            .iter()
            .map(|(id, value)| (*id, (*value).to_owned()))
            .collect();
        let live = Live::new(config).with(config, &changes, chosen);
        live.map_err(|error| error.to_string())
    }

    #[test]
    fn one_half_of_a_pair_leaves_the_other_as_it_is() {
        let clip = config(&[
            (OptionId::Separation, "0.01"),
            (OptionId::Convergence, "8.1"),
        ]);
        let placed = |separation, convergence| Camera::Clip {
            separation,
            convergence,
        };
        let wider = changed(&clip, &[(OptionId::Separation, "0.03")], None).unwrap();
        assert_eq!(wider.camera, placed(0.03, 8.1));
        let auto = config(&[]);
        let wider = changed(&auto, &[(OptionId::Separation, "0.03")], Some((0.1, 7.3))).unwrap();
        assert_eq!(wider.camera, placed(0.03, 7.3));
        let eye = changed(
            &clip,
            &[(OptionId::EyeSpacing, "0.2"), (OptionId::FocalDepth, "5")],
            None,
        );
        assert_eq!(
            eye.unwrap().camera,
            Camera::Eye {
                spacing: 0.2,
                focal_depth: 5.0
            }
        );
    }

    #[test]
    fn what_is_not_named_stays() {
        let config = config(&[
            (OptionId::Views, "5"),
            (OptionId::HudDepth, "0.25"),
            (OptionId::EyeSpacing, "0.2"),
            (OptionId::FocalDepth, "5"),
            (OptionId::Output, "quilt"),
        ]);
        let before = Live::new(&config);
        let after = changed(&config, &[(OptionId::Output, "view:4")], None).unwrap();
        assert_eq!(
            after,
            Live {
                output: Output::View(4),
                ..before
            }
        );
        let after = changed(&config, &[(OptionId::HudDepth, "-0.5")], None).unwrap();
        assert_eq!(
            after,
            Live {
                hud_depth: -0.5,
                ..before
            }
        );
    }

    #[test]
    fn every_refusal_is_one_sentence() {
        let five = config(&[(OptionId::Views, "5"), (OptionId::Output, "quilt")]);
        let glass = config(&[(OptionId::Display, "looking-glass-portrait")]);
        let all = [
            changed(&five, &[(OptionId::Separation, "wide")], Some((0.1, 7.0))),
            changed(&five, &[(OptionId::Separation, "0.1")], None),
            changed(&five, &[(OptionId::FocalDepth, "3")], Some((0.1, 7.0))),
            changed(
                &five,
                &[(OptionId::FocalDepth, "-3"), (OptionId::EyeSpacing, "0.1")],
                None,
            ),
            changed(
                &five,
                &[(OptionId::FocalDepth, "3"), (OptionId::Separation, "0.1")],
                None,
            ),
            changed(&five, &[(OptionId::HudDepth, "2")], None),
            changed(&five, &[(OptionId::Output, "view:5")], None),
            changed(&glass, &[(OptionId::Output, "panel")], None),
            changed(&five, &[(OptionId::Output, "cinema")], None),
            CaptureWhat::asked("view:5", 5)
                .map(|_| Live::new(&five))
                .map_err(|error| error.to_string()),
        ]
        .map(Result::unwrap_err);
        assert!(all.iter().all(|message| !message.contains('\n')));
        insta::assert_snapshot!(all.join("\n"));
    }

    #[test]
    fn outputs_are_said_as_they_are_written() {
        for word in [
            "panel",
            "quilt",
            "sbs",
            "half-sbs",
            "tb",
            "half-tb",
            "rows",
            "columns",
            "checker",
            "quad",
            "rgbd",
            "anaglyph:red-cyan",
            "anaglyph:green-magenta-half",
            "anaglyph:amber-blue-grey",
            "view:2",
        ] {
            let config = config(&[(OptionId::Views, "3"), (OptionId::Output, word)]);
            assert_eq!(config.output.to_string(), word);
        }
    }
}
