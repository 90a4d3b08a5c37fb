//! From a cone of views to cameras.
//!
//! All cameras stand on a line before the panel, at the distance 1, and look at it squarely; camera i is seen from the middle of the
//! panel at an angle from straight ahead:
//!
//! ```text
//! angle_i = cone · ((i + 1/2) / N − 1/2)     centres: each view has an equal part of the cone, its camera in the middle (WebXR polyfill)
//! angle_i = cone · (i / (N − 1) − 1/2)       edges: the outer cameras at the ends of the cone (HoloPlayCore, VTK)
//! x_i     = tan(angle_i)
//! ```
#![forbid(unsafe_code)]

use super::{Display, Kind};

/// Where in the cone the cameras stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// Each in the middle of its part.
    Centres,
    /// The outer ones at the ends.
    Edges,
}

impl Spacing {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Centres, Self::Edges];

    /// Its word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centres => "centres",
            Self::Edges => "edges",
        }
    }

    /// Place of a camera in the cone, from −1/2 to 1/2.
    pub fn part(self, view: u32, views: u32) -> f64 {
        let (view, views) = (f64::from(view), f64::from(views.max(1)));
        match self {
            Self::Centres => (view + 0.5) / views - 0.5,
            // A single camera stands in the middle.
            Self::Edges if views < 2.0 => 0.0,
            Self::Edges => view / (views - 1.0) - 0.5,
        }
    }

    /// The cameras of N views over a cone in degrees.
    pub fn cameras(self, views: u32, cone: f64) -> Cameras {
        let outer = cone * self.part(views.max(1) - 1, views);
        let neighbours = match views {
            0 | 1 => 0.0,
            _ => 2.0 * outer.to_radians().tan() / f64::from(views - 1),
        };
        Cameras { outer, neighbours }
    }
}

/// Where the cameras stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cameras {
    /// Angle of the rightmost camera, degrees; the leftmost one has the same to the other side.
    pub outer: f64,
    /// From camera to camera, over their distance from the panel: eye spacing over focal depth. The layer's cameras are equally
    /// far from each other; so the outer ones stand where the rule wants them, and the others within a hair of it.
    pub neighbours: f64,
}

impl Display {
    /// Where the cameras stand: as described, else as the makers of Looking Glass panels have them for those, and for all others
    /// in the middle of its part.
    pub fn spacing(&self) -> Spacing {
        self.facts.spacing.unwrap_or(match self.kind {
            Kind::LookingGlass(_) | Kind::Uncalibrated => Spacing::Edges,
            _ => Spacing::Centres,
        })
    }

    /// The cameras, where the cone is known.
    pub fn cameras(&self) -> Option<Cameras> {
        let cone = self.facts.cone?;
        Some(self.spacing().cameras(self.views, cone))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_rules_as_published() {
        let angles = |rule: Spacing, views: u32| -> Vec<f64> {
            (0..views).map(|i| 40.0 * rule.part(i, views)).collect()
        };
        assert_eq!(angles(Spacing::Centres, 4), [-15.0, -5.0, 5.0, 15.0]);
        assert_eq!(angles(Spacing::Edges, 5), [-20.0, -10.0, 0.0, 10.0, 20.0]);
        for rule in [Spacing::Centres, Spacing::Edges] {
            assert_eq!(angles(rule, 1), [0.0]);
            let alone = rule.cameras(1, 40.0);
            assert_eq!((alone.outer, alone.neighbours), (0.0, 0.0));
        }
    }

    #[test]
    fn neighbours_are_counted_in_distances() {
        // 45 views over 40 degrees, by hand: tan 20° = 0.363970, tan 19.5556° = 0.355210.
        let edges = Spacing::Edges.cameras(45, 40.0);
        assert_eq!(edges.outer, 20.0);
        assert!((edges.neighbours - 2.0 * 0.363_970 / 44.0).abs() < 1e-7);
        let centres = Spacing::Centres.cameras(45, 40.0);
        assert!((centres.outer - 19.555_556).abs() < 1e-6);
        assert!((centres.neighbours - 2.0 * 0.355_210 / 44.0).abs() < 1e-7);
    }

    #[test]
    fn makers_rules_unless_the_description_says_otherwise() {
        let spacing = |name: &str| Display::named(name).unwrap().spacing();
        assert_eq!(spacing("looking-glass-go"), Spacing::Edges);
        assert_eq!(spacing("slanted8"), Spacing::Centres);
        let mut display = Display::named("looking-glass-go").unwrap();
        display.facts.spacing = Some(Spacing::Centres);
        assert_eq!(display.spacing(), Spacing::Centres);
    }
}
