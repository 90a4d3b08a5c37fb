//! Where the picture of a program's window lies on a panel that has another size.

use super::Placement;

/// How the picture of a window is fitted to a panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// The whole picture, with black beside it where the panel has another aspect.
    #[default]
    Contain,
    /// The whole panel, with the sides of the picture cut off where it has another aspect.
    Cover,
    /// The whole picture on the whole panel, distorted where the aspects differ.
    Stretch,
}

impl Fit {
    /// The place of the picture of a window on a panel; both sizes are width and height in pixels, at least 1. The picture is in the middle. It
    /// hangs over the panel's sides where it is cut off.
    #[must_use]
    pub fn place(self, window: (u32, u32), panel: (u32, u32)) -> Placement {
        let whole = Placement::full_screen(panel.0, panel.1);
        let shares = [
            f64::from(panel.0) / f64::from(window.0),
            f64::from(panel.1) / f64::from(window.1),
        ];
        let share = match self {
            Self::Stretch => return whole,
            Self::Contain => shares[0].min(shares[1]),
            Self::Cover => shares[0].max(shares[1]),
        };
        let side = |side: u32| ((f64::from(side) * share).round() as u32).max(1);
        let (width, height) = (side(window.0), side(window.1));
        let middle = |panel: u32, side: u32| (panel as i32 - side as i32).div_euclid(2);
        Placement {
            x: middle(panel.0, width),
            y: middle(panel.1, height),
            width,
            height,
            ..whole
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Left, top, width and height.
    fn at(fit: Fit, window: (u32, u32), panel: (u32, u32)) -> [i64; 4] {
        let place = fit.place(window, panel);
        assert_eq!((place.screen_width, place.screen_height), panel);
        [
            i64::from(place.x),
            i64::from(place.y),
            i64::from(place.width),
            i64::from(place.height),
        ]
    }

    #[test]
    fn a_picture_of_the_panels_aspect_is_the_whole_panel() {
        for fit in [Fit::Contain, Fit::Cover, Fit::Stretch] {
            assert_eq!(at(fit, (640, 360), (3840, 2160)), [0, 0, 3840, 2160]);
            assert_eq!(at(fit, (3840, 2160), (320, 180)), [0, 0, 320, 180]);
        }
    }

    #[test]
    fn a_landscape_on_a_portrait_panel_has_bars_or_is_cut_off() {
        let (window, panel) = ((800, 600), (1536, 2048));
        assert_eq!(at(Fit::Contain, window, panel), [0, 448, 1536, 1152]);
        assert_eq!(at(Fit::Cover, window, panel), [-598, 0, 2731, 2048]);
        assert_eq!(at(Fit::Stretch, window, panel), [0, 0, 1536, 2048]);
    }

    #[test]
    fn the_picture_is_never_larger_or_smaller_than_its_fit_allows() {
        for window in [(1, 1), (3, 1000), (799, 601), (4096, 17)] {
            for panel in [(320, 240), (2161, 3840), (7, 5)] {
                let [x, y, width, height] = at(Fit::Contain, window, panel);
                assert!(x >= 0 && y >= 0);
                assert!(width <= i64::from(panel.0) && height <= i64::from(panel.1));
                assert!(width == i64::from(panel.0) || height == i64::from(panel.1));
                let [x, y, width, height] = at(Fit::Cover, window, panel);
                assert!(x <= 0 && y <= 0);
                assert!(x + width >= i64::from(panel.0) && y + height >= i64::from(panel.1));
            }
        }
    }
}
