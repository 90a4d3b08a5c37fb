//! Comparisons of a program's views: with the program's own picture, between strategies, between views.

use crate::programs::judge::Bench;
use crate::programs::parallax;
use crate::programs::repeat::{Repeat, Repeated};
use crate::programs::row::Cell;
use crate::programs::tally::{ODD, Tally, same_bytes, tile};
use crate::support::rgb;
use manyview::metric::Gate;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// Number of pictures, spread evenly over the compared frames.
const PICTURES: u64 = 10;
/// Number of frames whose outer views are compared: the last of [`COMPARED`].
const OUTER: u64 = 5;
/// The place of the cell of `instanced` among those of the strategies.
const INSTANCED: usize = 3;
/// The folder of the views that outer views are compared with.
const LAYERS: &str = "7-layers";

impl Bench<'_> {
    /// The cells of the middle views by strategy, of the outer views, and of the parallax between them.
    pub(crate) fn pictures(&self) -> Vec<Cell> {
        let interval = (self.compared / PICTURES).max(1);
        let bare = Repeat {
            layer: None,
            interval,
        };
        let mut expected = self.repeat(&self.short, &bare, "pictures").pictures;
        // Frames that vary without the layer, such as an undefined first frame, are left out.
        let again = self.repeat(&self.short, &bare, "pictures-again").pictures;
        expected.retain(|name, path| again.get(name).is_some_and(|other| same_bytes(path, other)));
        if let Some(first) = again.keys().next() {
            expected.remove(first);
        }
        let mut cells = Vec::new();
        for strategy in self.strategies() {
            let run = self.seven(strategy, &[], interval, &format!("7-{strategy}"));
            let mut cell = self.middle(strategy, &expected, &run);
            let drawn = |report: Value| report["draws"][strategy].as_u64().unwrap_or(0) > 0;
            if strategy == "instanced" && !self.report("8-instanced").is_some_and(drawn) {
                // The result then repeats that of replay.
                cell.text.push_str(", none by instances");
            }
            cells.push(cell);
        }
        if !self.program.own_shaders() {
            cells.insert(INSTANCED, Cell::unasked());
        }
        if !self.program.points {
            cells.push(Cell::unasked());
        }
        // The other strategies draw into layers, where every view is at the origin, and float rounding depends on the place.
        self.seven("replay", &[("ATLAS", "layers".to_owned())], 0, LAYERS);
        cells.push(self.outer());
        cells.push(match self.program.parallax {
            true => parallax::cell(self.captured(LAYERS).values().map(|path| rgb(path))),
            false => Cell::unasked(),
        });
        cells
    }

    /// The first frames in 7 views: the middle view as the program reads it back, and all views of the last frames as captured.
    fn seven(
        &self,
        strategy: &str,
        more: &[(&'static str, String)],
        interval: u64,
        name: &str,
    ) -> Repeated {
        // The first frame may be from before the scene is loaded.
        let first = (self.compared + 1).saturating_sub(OUTER).max(2);
        let mut layer = vec![
            ("VIEWS", ODD.to_string()),
            ("STRATEGY", strategy.to_owned()),
            ("CAPTURE_OUT", self.path(&format!("{name}/all-%d.png"))),
            ("CAPTURE_FRAMES", format!("{first}..{}", self.compared)),
            ("CAPTURE_WHAT", "atlas".to_owned()),
        ];
        layer.extend_from_slice(more);
        let how = Repeat {
            layer: Some(layer),
            interval,
        };
        self.repeat(&self.short, &how, name)
    }

    fn middle(&self, strategy: &str, expected: &BTreeMap<String, PathBuf>, run: &Repeated) -> Cell {
        if let Some(status) = &run.ended.wrong {
            return Cell::bad(status.clone());
        }
        if expected.is_empty() {
            return Cell::bad("no frame is the same twice without the layer");
        }
        let gate = match strategy {
            "replay" => Gate::EQUAL,
            _ => Gate::DESIGN,
        };
        let mut tally = Tally::default();
        for (name, path) in expected {
            let Some(other) = run.pictures.get(name) else {
                tally.missing(name);
                continue;
            };
            let label = format!("{}-{strategy}", self.program.name);
            tally.compare(&rgb(path), &rgb(other), gate, &label);
        }
        let seen = |path: &PathBuf| {
            let picture = rgb(path);
            let first = *picture.get_pixel(0, 0);
            picture.pixels().any(|pixel| *pixel != first)
        };
        if !expected.values().any(seen) {
            return Cell::bad("nothing to be seen in these frames");
        }
        tally.cell()
    }

    /// Captures of all views.
    fn captured(&self, name: &str) -> BTreeMap<String, PathBuf> {
        let entries = fs::read_dir(self.folder.join(name)).expect("a folder");
        let entries = entries.flatten().map(|entry| {
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, entry.path())
        });
        entries.filter(|(name, _)| name.ends_with(".png")).collect()
    }

    /// Compares the outer views of the strategies that do not replay.
    fn outer(&self) -> Cell {
        let expected = self.captured(LAYERS);
        if expected.is_empty() {
            return Cell::bad("no pictures captured");
        }
        let mut tally = Tally::default();
        for strategy in self.strategies().skip_while(|&name| name != "geometry") {
            let actual = self.captured(&format!("7-{strategy}"));
            for (name, path) in &expected {
                let Some(other) = actual.get(name) else {
                    tally.missing(&format!("{name} of {strategy}"));
                    continue;
                };
                let (expected, actual) = (rgb(path), rgb(other));
                for view in [0, ODD - 1] {
                    let label = format!("{}-{strategy}-view{view}", self.program.name);
                    let (expected, actual) = (tile(&expected, view), tile(&actual, view));
                    tally.compare(&expected, &actual, Gate::DESIGN, &label);
                }
            }
        }
        tally.cell()
    }
}
