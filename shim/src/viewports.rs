//! Detects viewports that may mean a new size of the window. Only those lead to a query of the window system: a query at each viewport would wait
//! several times per frame in programs that draw shadow maps.

/// Number of sizes that are remembered. A program with more sizes causes more queries.
const KNOWN: usize = 16;

/// The sizes of viewports that were set since the last change of the window's size.
#[derive(Debug, Default)]
pub(crate) struct Viewports {
    window: (u32, u32),
    known: Vec<(i32, i32)>,
}

impl Viewports {
    /// Notes the size of a viewport. Returns whether no other one had it since the last change of the window's size.
    pub(crate) fn is_new(&mut self, size: (i32, i32)) -> bool {
        if self.known.contains(&size) {
            return false;
        }
        if self.known.len() == KNOWN {
            self.known.remove(0);
        }
        self.known.push(size);
        true
    }

    /// Notes the size of the window, each time it is queried. A new size makes all sizes of viewports new again.
    pub(crate) fn window_has(&mut self, size: (u32, u32)) {
        if self.window != size {
            self.window = size;
            self.known.clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_with_shadow_maps_asks_once() {
        let mut viewports = Viewports::default();
        viewports.window_has((800, 600));
        let frame = [(1024, 1024), (800, 600), (512, 512), (800, 600)];
        let asked = |v: &mut Viewports| frame.iter().filter(|&&size| v.is_new(size)).count();
        assert_eq!(asked(&mut viewports), 3);
        assert_eq!(asked(&mut viewports), 0);
    }

    #[test]
    fn a_window_that_gets_its_old_size_back_is_seen() {
        let mut viewports = Viewports::default();
        viewports.window_has((800, 600));
        assert!(viewports.is_new((800, 600)));
        assert!(viewports.is_new((400, 300)));
        viewports.window_has((400, 300));
        assert!(viewports.is_new((800, 600)));
        viewports.window_has((400, 300));
        assert!(!viewports.is_new((800, 600)));
    }

    #[test]
    fn the_oldest_size_is_forgotten() {
        let mut viewports = Viewports::default();
        assert!((0..=KNOWN as i32).all(|n| viewports.is_new((n, n))));
        assert!(viewports.is_new((0, 0)));
        assert!(!viewports.is_new((KNOWN as i32, KNOWN as i32)));
    }
}
