//! How far apart neighbouring views may show one point.
#![forbid(unsafe_code)]

use super::{Display, Facts};

/// Millimetres of an inch.
pub const MM_PER_INCH: f64 = 25.4;
/// Of two eyes that look at one picture, before and behind the panel: a part of its width. Players and converters give two
/// percent to the whole depth of a scene.
const TWO_EYES: f64 = 0.01;
/// From eye to eye over the distance of the panel: 63 mm at 600 mm.
const EYES: f64 = 63.0 / 600.0;
/// Angle over which lens sheets show their views when nobody says, degrees; that of the Looking Glass family.
const CONE: f64 = 40.0;

/// Between neighbouring views, in pixels of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Largest disparity, before or behind the panel.
    pub px: f64,
    /// Millimetres per pixel, where they are known.
    pub mm_per_px: Option<f64>,
    /// From one camera to the next where eyes see the views, over the focal depth (see [`super::Cameras::neighbours`]).
    pub neighbours: f64,
}

impl Facts {
    /// Millimetres per pixel.
    #[must_use]
    pub fn mm_per_px(&self) -> Option<f64> {
        self.dpi.map(|dpi| MM_PER_INCH / dpi)
    }

    /// The budget of the description in pixels; the smaller one where it has two.
    fn budget(&self) -> Option<f64> {
        let mm = self.budget_mm.zip(self.mm_per_px());
        let mm = mm.map(|(mm, per_px)| mm / per_px);
        match (self.budget_px, mm) {
            (Some(px), Some(mm)) => Some(px.min(mm)),
            (px, mm) => px.or(mm),
        }
    }
}

impl Display {
    /// For N views in a picture of a width in pixels, of which the panel shows all.
    ///
    /// Where the description does not say it: a panel that spreads its pixels over N views has pixels of √(N/3) times the size
    /// in each, and what moves from view to view by more than one of these is seen twice (Zwicker et al. 2006, "Antialiasing for
    /// automultiscopic 3D displays").
    #[must_use]
    pub fn budget(&self, views: u32, width: u32) -> Budget {
        if views < 3 {
            return self.budget_of_eyes(2, width);
        }
        let cone = self.facts.cone.unwrap_or(CONE);
        let even = (f64::from(views) / 3.0).sqrt();
        Budget {
            px: self.facts.budget().unwrap_or(even),
            mm_per_px: self.facts.mm_per_px(),
            neighbours: self.spacing().cameras(views, cone).neighbours,
        }
    }

    /// For N views of which the eyes see the first and the last one.
    #[must_use]
    pub fn budget_of_eyes(&self, views: u32, width: u32) -> Budget {
        let steps = f64::from(views.max(2) - 1);
        let given = self.facts.budget().filter(|_| self.views == 2);
        Budget {
            px: given.unwrap_or(TWO_EYES * f64::from(width)) / steps,
            mm_per_px: self.facts.mm_per_px(),
            neighbours: EYES / steps,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_share_the_pixels() {
        let portrait = Display::named("looking-glass-portrait").unwrap();
        let budget = portrait.budget(48, 1536);
        assert!((budget.px - 4.0).abs() < 1e-9);
        assert!((budget.mm_per_px.unwrap() * 324.0 - MM_PER_INCH).abs() < 1e-9);
        assert_eq!(budget.neighbours, portrait.cameras().unwrap().neighbours);
    }

    #[test]
    fn eyes_share_the_width() {
        let display = Display::default();
        assert_eq!(display.budget(2, 1000).px, 10.0);
        assert_eq!(display.budget_of_eyes(5, 1000).px, 2.5);
    }

    #[test]
    fn the_smaller_of_two_budgets_holds() {
        let mut display = Display::default();
        display.facts.dpi = Some(254.0);
        display.facts.budget_mm = Some(0.3);
        assert!((display.budget(8, 1000).px - 3.0).abs() < 1e-9);
        display.facts.budget_px = Some(2.0);
        assert_eq!(display.budget(8, 1000).px, 2.0);
    }
}
