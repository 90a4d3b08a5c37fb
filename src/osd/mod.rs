//! The on-screen display: lines of text and a cross over the picture that is shown. Pure, without GL.
//!
//! It lies at zero parallax: each view has it at the same place, so it stands on the panel and is as sharp as the panel is. It is drawn over the
//! picture that goes to the screen, never into the views, so that neither the program nor captures have it.
#![forbid(unsafe_code)]

mod place;
mod text;

pub use place::{Cell, cells};
pub use text::{Raster, text_height, write};

use crate::config::{OsdPart, OsdParts};
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// How long a value stays after it was changed.
const VALUE: Duration = Duration::from_secs(2);
/// How long a warning stays: long enough to read a sentence.
const WARNING: Duration = Duration::from_secs(8);
/// Over how long frames are counted.
const COUNTED: Duration = Duration::from_millis(500);
/// The most lines of either kind; older ones make room.
const LINES: usize = 4;

/// What is shown now.
#[derive(Debug, Default)]
pub struct Osd {
    /// What the value is of, and the line.
    values: VecDeque<Line>,
    warnings: VecDeque<Line>,
    /// Frames since the last count, and when that was.
    counted: Option<(Instant, u32)>,
    /// The last count, in frames per second, and the views that were drawn of how many.
    fps: Option<(f64, Option<(u32, u32)>)>,
}

#[derive(Debug)]
struct Line {
    name: String,
    text: String,
    until: Instant,
}

impl Osd {
    /// A value was changed, or something was done; a newer text of the same name takes its place.
    pub fn value(&mut self, name: &str, text: String, now: Instant) {
        put(&mut self.values, name, text, now + VALUE);
    }

    /// A sentence that the user is to see.
    pub fn warning(&mut self, text: String, now: Instant) {
        let name = text.clone();
        put(&mut self.warnings, &name, text, now + WARNING);
    }

    /// A frame is shown. `drawn`: views that were drawn, of how many, where that changes from frame to frame.
    pub fn frame(&mut self, drawn: Option<(u32, u32)>, now: Instant) {
        let (since, frames) = self.counted.get_or_insert((now, 0));
        let passed = now - *since;
        if passed >= COUNTED {
            self.fps = Some((f64::from(*frames) / passed.as_secs_f64(), drawn));
            (*since, *frames) = (now, 0);
        }
        *frames += 1;
    }

    /// The lines to be shown, the topmost first.
    pub fn lines(&mut self, parts: OsdParts, now: Instant) -> Vec<String> {
        let mut all = Vec::new();
        if let (true, Some((fps, drawn))) = (parts.has(OsdPart::Fps), self.fps) {
            let drawn = drawn.map(|(drawn, of)| format!("  K {drawn} of {of}"));
            all.push(format!("{fps:.1} fps{}", drawn.unwrap_or_default()));
        }
        for (part, lines) in [
            (OsdPart::Values, &mut self.values),
            (OsdPart::Warnings, &mut self.warnings),
        ] {
            lines.retain(|line| line.until > now);
            if parts.has(part) {
                all.extend(lines.iter().map(|line| line.text.clone()));
            }
        }
        all
    }
}

fn put(lines: &mut VecDeque<Line>, name: &str, text: String, until: Instant) {
    let name = name.to_owned();
    let line = Line { name, text, until };
    match lines.iter_mut().find(|known| known.name == line.name) {
        Some(known) => *known = line,
        None => lines.push_back(line),
    }
    while lines.len() > LINES {
        lines.pop_front();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_shown_for_a_moment_and_warnings_longer() {
        let (mut osd, start) = (Osd::default(), Instant::now());
        let parts = OsdParts::default();
        osd.value("separation", "separation 0.03".into(), start);
        osd.value("separation", "separation 0.033".into(), start);
        osd.warning("no stereo".into(), start);
        assert_eq!(osd.lines(parts, start), ["separation 0.033", "no stereo"]);
        let without = parts.with(OsdPart::Values, false);
        assert_eq!(osd.lines(without, start), ["no stereo"]);
        assert_eq!(osd.lines(parts, start + VALUE), ["no stereo"]);
        assert!(osd.lines(parts, start + WARNING).is_empty());
    }

    #[test]
    fn frames_are_counted() {
        let (mut osd, start) = (Osd::default(), Instant::now());
        let parts = OsdParts::NONE.with(OsdPart::Fps, true);
        assert!(osd.lines(parts, start).is_empty());
        for frame in 0..=30 {
            osd.frame(Some((3, 8)), start + Duration::from_millis(20) * frame);
        }
        assert_eq!(osd.lines(parts, start), ["50.0 fps  K 3 of 8"]);
    }

    #[test]
    fn old_lines_make_room() {
        let (mut osd, now) = (Osd::default(), Instant::now());
        for line in 0..6 {
            osd.warning(line.to_string(), now);
        }
        assert_eq!(osd.lines(OsdParts::default(), now), ["2", "3", "4", "5"]);
    }
}
