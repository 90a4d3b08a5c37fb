//! The values that can change while the program runs.
#![forbid(unsafe_code)]

use super::{
    Camera, CaptureWhat, Config, ConfigError, FlatDepth, OptionId, Origin, OsdParts, Output,
    Settings, cameras, parse,
};
use crate::display::{Lens, LensPart};

/// The values in force now; they begin as the options say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Live {
    /// The picture that is shown.
    pub output: Output,
    /// Spacing of the cameras and the depth of zero parallax.
    pub camera: Camera,
    /// Depth of flat draws without a rule.
    pub hud_depth: FlatDepth,
    /// The numbers of the panel's sheet; none where it has no slanted one.
    pub lens: Option<Lens>,
    /// Parts of the on-screen display.
    pub osd: OsdParts,
    /// All cameras are the program's own, and its own view is shown.
    pub flat: bool,
}

/// A value that can be set while the program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Knob {
    /// An option, one of [`Live::OPTIONS`].
    Option(OptionId),
    /// A number of the panel's lens sheet.
    Lens(LensPart),
}

impl Live {
    /// The options that can be set while the program runs.
    pub const OPTIONS: [OptionId; 8] = [
        OptionId::Output,
        OptionId::Osd,
        OptionId::Separation,
        OptionId::Convergence,
        OptionId::EyeSpacing,
        OptionId::FocalDepth,
        OptionId::AutoDepth,
        OptionId::HudDepth,
    ];

    /// The values that the program starts with.
    #[must_use]
    pub fn new(config: &Config) -> Self {
        Self {
            output: config.output,
            camera: config.camera,
            hud_depth: config
                .hud_depth
                .or(config.profile.hud_depth)
                .unwrap_or_default(),
            lens: config.display.lens(),
            osd: config.osd,
            flat: false,
        }
    }

    /// These values with some of them changed, all or none. `chosen` has the values that [`Camera::Auto`] and [`Camera::Measured`] stand for,
    /// once it is known: separation and convergence.
    pub fn with(
        self,
        config: &Config,
        changes: &[(Knob, String)],
        chosen: Option<(f64, f64)>,
    ) -> Result<Self, ConfigError> {
        let mut settings = Settings::default();
        let mut lens = self.lens;
        for (setting, value) in changes {
            match setting {
                Knob::Option(id) => settings.set(*id, value, Origin::Request),
                Knob::Lens(part) => lens = Some(self.sheet(lens, config, *part, value)?),
            }
        }
        let output = settings.get(OptionId::Output).is_some();
        let measured = settings.get(OptionId::AutoDepth).map(|s| s.value == "1");
        if measured != Some(true) {
            self.complete(&mut settings, chosen);
            // A half alone is refused, and the depths are not followed unless that is asked for.
            settings.set(OptionId::AutoDepth, "0", Origin::Request);
        }
        Ok(Self {
            output: if output {
                parse::output_of(&settings, &config.display, config.views)?
            } else {
                self.output
            },
            camera: match cameras::camera(&settings)? {
                Camera::Auto if measured.is_some() => self.as_they_stand(chosen),
                Camera::Auto => self.camera,
                placed => placed,
            },
            hud_depth: parse::hud_depth(&settings)?.unwrap_or(self.hud_depth),
            osd: parse::osd(&settings)?.unwrap_or(self.osd),
            lens,
            flat: self.flat,
        })
    }

    /// The present cameras, fixed: they no longer follow the depths.
    fn as_they_stand(self, chosen: Option<(f64, f64)>) -> Camera {
        match (self.camera, chosen) {
            (Camera::Measured(_), Some((separation, convergence))) => Camera::Clip {
                separation,
                convergence,
            },
            (Camera::Measured(_), None) => Camera::Auto,
            (placed, _) => placed,
        }
    }

    /// The sheet with another number.
    fn sheet(
        self,
        lens: Option<Lens>,
        config: &Config,
        part: LensPart,
        value: &str,
    ) -> Result<Lens, ConfigError> {
        let lens = lens.ok_or_else(|| ConfigError::NoSheet {
            part: part.name(),
            display: config.display.name.clone(),
        })?;
        lens.with(part, value).map_err(|error| ConfigError::Sheet {
            reason: error.to_string(),
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
            Camera::Auto | Camera::Measured(_) => chosen.map(clip),
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
    /// The content of a picture of a running program.
    pub fn asked(value: &str, views: u32) -> Result<Self, ConfigError> {
        let mut settings = Settings::default();
        settings.set(OptionId::CaptureWhat, value, Origin::Request);
        parse::capture_what(&settings, views)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Kept;

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
            .map(|(id, value)| (Knob::Option(*id), (*value).to_owned()))
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
    fn cameras_by_depth_are_let_go_where_they_stand() {
        let auto = config(&[]);
        let measured = changed(&auto, &[(OptionId::AutoDepth, "1")], None).unwrap();
        assert_eq!(measured.camera, Camera::Measured(None));
        let kept = [(OptionId::AutoDepth, "1"), (OptionId::Separation, "0.03")];
        let kept = changed(&auto, &kept, Some((0.1, 7.3))).unwrap();
        assert_eq!(kept.camera, Camera::Measured(Some(Kept::Separation(0.03))));
        let by_depth = config(&[(OptionId::AutoDepth, "1")]);
        let placed = |separation| Camera::Clip {
            separation,
            convergence: 7.3,
        };
        let off = [(OptionId::AutoDepth, "0")];
        let stays = changed(&by_depth, &off, Some((0.1, 7.3))).unwrap();
        assert_eq!(stays.camera, placed(0.1));
        assert_eq!(changed(&by_depth, &off, None).unwrap().camera, Camera::Auto);
        let wider = [(OptionId::Separation, "0.2")];
        let wider = changed(&by_depth, &wider, Some((0.1, 7.3))).unwrap();
        assert_eq!(wider.camera, placed(0.2));
        let both = [(OptionId::EyeSpacing, "0.2"), (OptionId::FocalDepth, "5")];
        let both = changed(&by_depth, &both, None).unwrap();
        assert!(matches!(both.camera, Camera::Eye { .. }));
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
                hud_depth: FlatDepth::At(-0.5),
                ..before
            }
        );
    }

    #[test]
    fn a_sheet_changes_and_nothing_else() {
        let config = config(&[(OptionId::Display, "slanted8")]);
        let before = Live::new(&config);
        let set =
            |part, text: &str| before.with(&config, &[(Knob::Lens(part), text.to_owned())], None);
        let after = set(LensPart::Pitch, "7.99").unwrap();
        let lens = before.lens.unwrap().with(LensPart::Pitch, "7.99").unwrap();
        assert_eq!(
            after,
            Live {
                lens: Some(lens),
                ..before
            }
        );
        let refused = set(LensPart::Pitch, "0").unwrap_err().to_string();
        assert!(refused.starts_with("pitch is '0'; give "), "{refused}");
        let plain = super::tests::config(&[]);
        let change = (Knob::Lens(LensPart::Offset), "1".to_owned());
        let refused = Live::new(&plain).with(&plain, &[change], None);
        assert_eq!(
            refused.unwrap_err().to_string(),
            "offset is a number of a slanted lens sheet, and display `huebner8` is none; \
             start the program with one of kind \"slanted\""
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
