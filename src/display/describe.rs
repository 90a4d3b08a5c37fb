//! A panel in words and numbers, as `manyview displays show` prints it.
#![forbid(unsafe_code)]

use super::{Display, Kind, Number, Slanted, SubpixelOrder};

impl Display {
    /// Labels and values, in the order in which people read them.
    #[must_use]
    pub fn describe(&self) -> Vec<(&'static str, String)> {
        let mut lines = vec![
            ("name", self.name.clone()),
            ("views", self.views.to_string()),
            ("kind", self.kind.about().to_owned()),
        ];
        self.optics(&mut lines);
        if self.rotation.degrees() != 0 {
            lines.push((
                "rotation",
                format!("{}° clockwise", self.rotation.degrees()),
            ));
        }
        let facts = self.facts;
        if let Some((width, height)) = facts.screen {
            lines.push(("screen", format!("{width}x{height} pixels")));
            if let Some(dpi) = facts.dpi {
                let mm = |pixels: u32| f64::from(pixels) * 25.4 / dpi;
                let (width, height) = (mm(width), mm(height));
                lines.push(("size", format!("{width:.1} x {height:.1} mm")));
            }
            let samples = 3.0 * f64::from(width) * f64::from(height) / f64::from(self.views);
            lines.push(("subpixels per view", format!("{samples:.0}")));
        }
        if let Some(dpi) = facts.dpi {
            lines.push(("pixels per inch", dpi.to_string()));
        }
        if let Some(cone) = facts.cone {
            lines.push(("view cone", format!("{cone}°")));
        }
        if let Some((width, _)) = facts.screen {
            let budget = self.budget(self.views, width);
            let mm = budget.mm_per_px.map(|per_px| budget.px * per_px);
            let mm = mm.map_or(String::new(), |mm| format!(" = {mm:.3} mm"));
            lines.push((
                "disparity budget",
                format!("{:.2} pixels{mm} from view to view", budget.px),
            ));
        }
        if let Some(cameras) = self.cameras() {
            lines.push(("camera spacing", self.spacing().name().into()));
            lines.push((
                "outer cameras",
                format!("{:.4}° to either side", cameras.outer),
            ));
            let apart = cameras.neighbours;
            lines.push((
                "neighbouring cameras",
                format!("{apart:.6} of the focal depth apart"),
            ));
        }
        if let Some((columns, rows)) = facts.quilt {
            lines.push(("quilt", format!("{columns}x{rows}")));
        }
        lines
    }

    fn optics(&self, lines: &mut Vec<(&'static str, String)>) {
        match &self.kind {
            Kind::Huebner(order) => {
                lines.push(("lens pitch", "8 subpixels".into()));
                lines.push(("slant", "2/3 subpixels per row".into()));
                lines.push(("order", order.name().into()));
            }
            Kind::Slanted(lens) => self.sheet(lens, lines),
            Kind::LookingGlass(device) => {
                let lenses = device.lenses();
                let width = f64::from(device.width);
                lines.push(("serial", device.serial.clone()));
                lines.push(("pitch", format!("{} lenses per inch", device.pitch)));
                lines.push(("slope", device.slope.to_string()));
                lines.push(("center", device.center.to_string()));
                lines.push(("lenses over the width (P)", format!("{lenses:.6}")));
                lines.push(("tilt", format!("{:.9}", device.tilt())));
                lines.push(("subpixels per lens", format!("{:.4}", 3.0 * width / lenses)));
                lines.push(("subpixel cells", device.cells.len().to_string()));
                if let Some(fringe) = device.fringe {
                    lines.push(("fringe", fringe.to_string()));
                }
            }
            Kind::Integer(steps) => {
                lines.push((
                    "steps",
                    format!(
                        "{} per pixel, {} per subpixel, {} per row",
                        steps.horizontal, steps.subpixel, steps.vertical
                    ),
                ));
                lines.push(("modulus", steps.modulus.to_string()));
            }
            Kind::Leia(panel) => {
                lines.push(("views per pixel", panel.p_over_du.to_string()));
                lines.push(("views per row", panel.p_over_dv.to_string()));
            }
            Kind::MaskFile { path, mask } => {
                lines.push(("mask", path.display().to_string()));
                lines.push(("views shown", mask.views_shown().len().to_string()));
            }
            Kind::Wall(wall) => {
                for panel in wall.panels() {
                    let (width, height) = panel.pixels;
                    let [x, y] = panel.corners()[0];
                    let monitor = &panel.monitor;
                    let display = &panel.display.name;
                    lines.push((
                        "panel",
                        format!(
                            "{monitor}: {display}, {width}x{height} pixels, at {x:.1}, {y:.1} mm"
                        ),
                    ));
                }
            }
            Kind::Lenticular | Kind::Pattern(_) | Kind::Uncalibrated => {}
        }
    }

    fn sheet(&self, lens: &Slanted, lines: &mut Vec<(&'static str, String)>) {
        let pitch = lens.pitch.to_f64();
        // Three subpixels are as wide as a row is high.
        let angle = (lens.slant.to_f64() / 3.0).atan().to_degrees();
        lines.push(("lens pitch", format!("{} subpixels", lens.pitch)));
        lines.push(("slant", format!("{} subpixels per row", lens.slant)));
        lines.push(("lens angle", format!("{angle:.4}° from upright")));
        lines.push(("offset", format!("{} subpixels", lens.offset)));
        lines.push(("order", lens.order.name().into()));
        let (up, down) = ("ascend with the phase", "descend with the phase");
        let way = if lens.inverted { down } else { up };
        lines.push(("view order", way.into()));
        if let Some(dpi) = self.facts.dpi {
            lines.push(("lenses per inch", format!("{:.4}", 3.0 * dpi / pitch)));
        }
        let views = f64::from(self.views) / pitch;
        lines.push(("views per subpixel", format!("{views:.4}")));
        let exact = if lens.is_exact() {
            "exact"
        } else {
            "rounded to 2^-60"
        };
        lines.push(("numbers", exact.into()));
    }
}

impl Kind {
    /// One line for people.
    #[must_use]
    pub fn about(&self) -> &'static str {
        match self {
            Self::Lenticular => "upright lenses, a pixel per view",
            Self::Huebner(_) => "wavelength-selective filter",
            Self::Slanted(_) => "slanted lenses",
            Self::Integer(_) => "phases in whole steps",
            Self::LookingGlass(_) => "Looking Glass",
            Self::Leia(_) => "Leia-type",
            Self::Pattern(_) => "a pattern written by hand",
            Self::MaskFile { .. } => "mask file",
            Self::Wall(_) => "several panels that show one picture",
            Self::Uncalibrated => "Looking Glass without the calibration of a device: quilts only",
        }
    }
}

impl SubpixelOrder {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Rgb => "rgb",
            Self::Bgr => "bgr",
        }
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exact {
                numerator,
                denominator: 1,
            } => write!(f, "{numerator}"),
            Self::Exact {
                numerator,
                denominator,
            } => write!(f, "{numerator}/{denominator}"),
            Self::Float(value) => write!(f, "{value}"),
        }
    }
}
