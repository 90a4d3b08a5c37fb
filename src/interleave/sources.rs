//! The views that are drawn while others are synthesised from them.
#![forbid(unsafe_code)]

use crate::view::ViewIndex;

/// The drawn views, from left to right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sources {
    views: [ViewIndex; Sources::MOST as usize],
    count: u32,
}

impl Sources {
    /// The greatest number of drawn views, for which `shaders/between.wgsl` has room.
    pub const MOST: u32 = 8;

    /// Chooses `count` of `views`, at least 1 and at most [`Sources::MOST`]: the own one, and each time the view that is farthest from all
    /// chosen ones, the rightmost where several are. The views of a smaller count are therefore among those of a larger one.
    #[must_use]
    pub fn spread(own: ViewIndex, views: u32, count: u32) -> Sources {
        let count = count.clamp(1, views.min(Self::MOST));
        let mut chosen = vec![own];
        while (chosen.len() as u32) < count {
            let away = |view: ViewIndex| chosen.iter().map(|c| c.0.abs_diff(view.0)).min();
            let next = ViewIndex::all(views).max_by_key(|&view| away(view));
            chosen.extend(next);
        }
        chosen.sort_unstable();
        let mut views = [ViewIndex(0); Self::MOST as usize];
        for (place, view) in views.iter_mut().zip(&chosen) {
            *place = *view;
        }
        Sources { views, count }
    }

    /// From left to right.
    pub fn iter(&self) -> impl Iterator<Item = ViewIndex> + use<> {
        self.views.into_iter().take(self.count as usize)
    }

    /// Whether a view is among them.
    #[must_use]
    pub fn has(&self, view: ViewIndex) -> bool {
        self.iter().any(|source| source == view)
    }

    /// The number of drawn views.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Indices of the two sources of a view: the nearest one, or the left of two equally near ones; and the nearest one on the other side of the
    /// view, or where there is none, the next one beyond the first.
    #[must_use]
    pub fn pair(&self, view: ViewIndex) -> [u32; 2] {
        let right = self.iter().filter(|&source| source <= view).count() as u32;
        let last = self.count - 1;
        if right == 0 {
            return [0, last.min(1)];
        }
        if right > last {
            return [last, last.saturating_sub(1)];
        }
        let away = |i: u32| self.view(i).0.abs_diff(view.0);
        match away(right) < away(right - 1) {
            true => [right, right - 1],
            false => [right - 1, right],
        }
    }

    /// A drawn view by its index from the left.
    #[must_use]
    pub fn view(&self, i: u32) -> ViewIndex {
        self.views.get(i as usize).copied().unwrap_or(ViewIndex(0))
    }

    /// The distance, in views, from a source to the farthest of `views` that is synthesised from it; 0 where there is none.
    #[must_use]
    pub fn farthest(&self, i: u32, views: u32) -> u32 {
        let synthesised = ViewIndex::all(views).filter(|&view| !self.has(view));
        let needed = synthesised.filter(|&view| self.pair(view).contains(&i));
        let away = needed.map(|view| self.view(i).0.abs_diff(view.0));
        away.max().unwrap_or(0)
    }

    /// `sources_low` and `sources_high` of `shaders/common.wgsl`.
    pub(super) fn rows(&self) -> [[f32; 4]; 2] {
        const NO_VIEW: f32 = 1.0e9;
        let mut rows = [[NO_VIEW; 4]; 2];
        for (place, view) in rows.as_flattened_mut().iter_mut().zip(self.iter()) {
            *place = view.0 as f32;
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_spread_and_fewer_are_among_more() {
        let of = |count| {
            Sources::spread(ViewIndex(3), 8, count)
                .iter()
                .map(|view| view.0)
                .collect::<Vec<_>>()
        };
        assert_eq!(of(0), [3]);
        assert_eq!(of(1), [3]);
        assert_eq!(of(2), [3, 7]);
        assert_eq!(of(3), [0, 3, 7]);
        assert_eq!(of(4), [0, 3, 5, 7]);
        assert_eq!(of(9), [0, 1, 2, 3, 4, 5, 6, 7]);
        for count in 1..8 {
            assert!(of(count).iter().all(|view| of(count + 1).contains(view)));
        }
        assert_eq!(
            Sources::spread(ViewIndex(23), 48, 99).count(),
            Sources::MOST
        );
    }

    #[test]
    fn a_view_is_synthesised_from_those_beside_it() {
        let sources = Sources::spread(ViewIndex(3), 8, 3);
        let pairs: Vec<_> = ViewIndex::all(8).map(|view| sources.pair(view)).collect();
        let expected = [
            [0, 1],
            [0, 1],
            [1, 0],
            [1, 2],
            [1, 2],
            [1, 2],
            [2, 1],
            [2, 1],
        ];
        assert_eq!(pairs, expected);
        let two = Sources::spread(ViewIndex(3), 8, 2);
        assert_eq!(two.pair(ViewIndex(0)), [0, 1], "no other lies to the left");
        assert_eq!(
            Sources::spread(ViewIndex(3), 8, 1).pair(ViewIndex(5)),
            [0, 0]
        );
        assert_eq!([0, 1].map(|i| two.farthest(i, 8)), [3, 7]);
    }
}
