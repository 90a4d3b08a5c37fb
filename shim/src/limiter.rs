//! Holds frames back for `--fps-cap`, on the thread that shows them.

use crate::drawable::Drawable;
use crate::drawables;
use crate::live::free;
use crate::switch::config;
use crate::uncancelled::Uncancelled;
use manyview_core::config::FrameCap;
use manyview_core::layer::DrawableId;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// When the next frame of each drawable is due.
static DUE: Mutex<Vec<(DrawableId, Instant)>> = Mutex::new(Vec::new());

/// Drawables that have shown nothing for so long are forgotten.
const FORGOTTEN: Duration = Duration::from_secs(2);

/// Before a frame of a drawable is shown.
pub(crate) fn before(drawable: Option<Drawable>) {
    hold(drawable, true);
}

/// After it was shown.
pub(crate) fn after(drawable: Option<Drawable>) {
    hold(drawable, false);
}

fn hold(drawable: Option<Drawable>, early: bool) {
    let cap = config().and_then(|config| config.fps_cap);
    let Some(cap) = cap.filter(|cap| cap.early == early) else {
        return;
    };
    let Some(drawable) = drawable.and_then(drawables::known) else {
        return;
    };
    // A wait is a cancellation point, and the swap of the program need not be one.
    let _uncancelled = Uncancelled::new();
    if let Some(wait) = turn(cap, drawable, Instant::now()) {
        std::thread::sleep(wait);
    }
}

/// How long a drawable has to wait for its next frame, which is then due one period later. A frame that is late does not hurry the next ones.
fn turn(cap: FrameCap, drawable: DrawableId, now: Instant) -> Option<Duration> {
    let mut all = free(&DUE)?;
    all.retain(|(_, due)| *due + FORGOTTEN > now);
    let known = all.iter_mut().find(|(known, _)| *known == drawable);
    let due = match known {
        Some((_, due)) => {
            let now_due = (*due).max(now);
            *due = now_due + cap.period;
            now_due
        }
        None => {
            all.push((drawable, now + cap.period));
            now
        }
    };
    Some(due.saturating_duration_since(now)).filter(|wait| !wait.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_a_period_apart_and_late_ones_are_not_made_up_for() {
        let period = Duration::from_millis(20);
        let cap = FrameCap {
            period,
            early: true,
        };
        let start = Instant::now();
        let at = |ms| turn(cap, DrawableId(7), start + Duration::from_millis(ms));
        let wait = |ms| Some(Duration::from_millis(ms));
        assert_eq!(at(0), None);
        assert_eq!(at(5), wait(15));
        // Shown at 20, so the next one is due at 40.
        assert_eq!(at(30), wait(10));
        // A late one: those after it are counted from it.
        assert_eq!(at(100), None);
        assert_eq!(at(101), wait(19));
    }
}
