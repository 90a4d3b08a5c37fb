//! One frame explained: a picture in which each draw's class is a colour, and a list of the draws with the reasons.
//!
//! The program's own view is read before and after each draw of that frame, and the pixels that have changed belong to the draw. That is
//! slow, but it is one frame, it changes no state of the program's, and it works for every kind of draw and every strategy.

use super::Layer;
use crate::config::{Class, DepthRange, Explain, Word, replace};
use crate::gl::{Gl, consts as c};
use crate::plan::class::Target;
use crate::plan::{Classed, Kind, Traits};
use crate::present::capture;
use crate::rewrite::{self, Amplifier, Options, Stage};
use crate::state::Linked;
use image::{Rgb, RgbImage};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// After this time pixels are no longer attributed to draws; the list goes on.
const PATIENCE: Duration = Duration::from_secs(60);

/// Classes in the order of the legend, with colours that the colour-blind can tell apart (after Okabe and Ito, 2008).
const COLOURS: [(Class, [u8; 3]); 4] = [
    (Class::Flat, [230, 159, 0]),
    (Class::Sky, [86, 180, 233]),
    (Class::Scene, [0, 158, 115]),
    (Class::OffScreen, [204, 121, 167]),
];

/// The explanation of the frame so far.
#[derive(Debug)]
pub(super) struct Explained {
    /// The program's own view after the last draw.
    view: RgbImage,
    /// For each pixel the class of the draw that changed it last.
    owner: Vec<Option<Class>>,
    /// The draw that was made since `view` was read: its class, nothing for a clear.
    last: Option<Option<Class>>,
    draws: Vec<(Traits, Classed)>,
    began: Instant,
    complete: bool,
}

impl Layer {
    /// The request for an explanation, if it is of the frame that is being drawn. One to the running program goes first.
    pub(super) fn explains(&self) -> Option<Explain> {
        let frame = self.diagnostics.report.frames() + 1;
        if self.state.list.is_some() {
            return None;
        }
        if let Some(out) = self.diagnostics.asked.clone() {
            return Some(Explain { out, frame });
        }
        let options = self.session.config.explain.as_ref();
        options.filter(|explain| explain.frame == frame).cloned()
    }

    /// Has the next frame explained. It has to be called between frames.
    pub(super) fn explain_next(&mut self, out: PathBuf) {
        self.diagnostics.asked = Some(out);
        self.cameras.classifier.set_explains(true);
    }

    /// Before a draw: finds the pixels that the draw before it has changed.
    pub(super) fn explain_last(&mut self, gl: &Gl) {
        if self.explains().is_none() {
            return;
        }
        let Some(mut explained) = self.diagnostics.explained.take() else {
            let view = self.own_view(gl);
            let pixels = view.width() as usize * view.height() as usize;
            self.diagnostics.explained = Some(Explained {
                view,
                owner: vec![None; pixels],
                last: None,
                draws: Vec::new(),
                began: Instant::now(),
                complete: true,
            });
            return;
        };
        if explained.began.elapsed() > PATIENCE {
            explained.complete = false;
            explained.last = None;
        }
        if let Some(class) = explained.last.take() {
            explained.attribute(class, self.own_view(gl));
        }
        self.diagnostics.explained = Some(explained);
    }

    /// Adds a draw that is about to be made to the list.
    pub(super) fn explain_this(&mut self, facts: &Traits, classed: &Classed) {
        if let Some(explained) = &mut self.diagnostics.explained {
            let clear = matches!(facts.kind, Kind::Clear { .. } | Kind::Accum);
            if !clear {
                explained.draws.push((*facts, *classed));
            }
            if facts.target == Target::Window {
                explained.last = Some((!clear).then_some(classed.class));
            }
        }
    }

    /// Writes the shaders of the programs that the frame was drawn with to a folder beside the list.
    fn write_shaders(&mut self, explain: &Explain, explained: &Explained) {
        let hashes = explained.draws.iter().map(|(facts, _)| facts.shader);
        let hashes: BTreeSet<u64> = hashes.filter(|&hash| hash != 0).collect();
        let folder = self.claim(explain, explain.shaders());
        for hash in hashes {
            let Some(linked) = self.linked_as(hash) else {
                continue;
            };
            let made = std::fs::create_dir_all(&folder);
            let written = sources(&linked).into_iter().try_for_each(|(stage, text)| {
                let file = folder.join(format!("{hash:016x}.{stage}"));
                replace(&file, text.as_ref())
            });
            if let Err(e) = made.and(written) {
                let folder = folder.display();
                self.diagnostics
                    .report
                    .note(format!("shaders of the explained frame: {folder}: {e}"));
                return;
            }
        }
    }

    /// Where this process writes a file of the explanation. Only this process was asked for one while it ran.
    fn claim(&mut self, explain: &Explain, file: PathBuf) -> PathBuf {
        if self.diagnostics.asked.is_some() {
            return file;
        }
        let claims = &mut self.diagnostics.report.claims;
        claims.path(self.session.config, &explain.out, file)
    }

    /// At the end of the frame: writes the picture, the list and the shaders.
    pub(super) fn finish_explanation(&mut self, gl: &Gl) {
        let Some(explain) = self.explains() else {
            return;
        };
        self.explain_last(gl);
        let Some(explained) = self.diagnostics.explained.take() else {
            return;
        };
        let explain = &explain;
        self.write_shaders(explain, &explained);
        let [picture, list] = explain.files().map(|file| self.claim(explain, file));
        let written = capture::write(&explained.picture(), &picture)
            .and_then(|()| capture::write_bytes(explained.list(explain.frame).as_bytes(), &list));
        if self.diagnostics.asked.take().is_some() {
            let wanted = self.session.config.explain.is_some();
            self.cameras.classifier.set_explains(wanted);
            return self.explained(explain.frame, written.map(|()| list));
        }
        if let Err(e) = written {
            self.diagnostics
                .report
                .note(format!("explanation of frame {}: {e}", explain.frame));
        }
    }
}

/// The sources of a program's shaders, as the program has them and as the layer rewrites them for a view, with the endings of their files.
fn sources(linked: &Linked) -> Vec<(&'static str, Vec<u8>)> {
    let options = Options {
        amplifier: Amplifier::Replay,
        target: rewrite::Target::Whole,
        views: 1,
        es: false,
    };
    let mut all = Vec::new();
    for shader in linked.sources.iter() {
        let [own, of_view] = match shader.stage {
            Stage::Vertex => ["vert", "view.vert"],
            Stage::TessControl => ["tesc", "view.tesc"],
            Stage::TessEvaluation => ["tese", "view.tese"],
            Stage::Geometry => ["geom", "view.geom"],
            Stage::Fragment => ["frag", "view.frag"],
            Stage::Compute => ["comp", "view.comp"],
        };
        let view = match rewrite::rewrite(&shader.source, shader.stage, &options) {
            Ok(new) => new.text.into_owned(),
            Err(why) => format!("// {why}\n").into_bytes(),
        };
        all.extend([(own, shader.source.clone()), (of_view, view)]);
    }
    all
}

impl Explained {
    /// Gives the pixels that differ from the previous view to the class of the last draw.
    fn attribute(&mut self, class: Option<Class>, now: RgbImage) {
        if now.dimensions() != self.view.dimensions() {
            self.owner = vec![None; now.width() as usize * now.height() as usize];
        } else {
            let pixels = now.pixels().zip(self.view.pixels());
            for (owner, (after, before)) in self.owner.iter_mut().zip(pixels) {
                if after != before {
                    *owner = class;
                }
            }
        }
        self.view = now;
    }

    /// The view in grey, tinted by class, over a legend.
    fn picture(&self) -> RgbImage {
        let (width, height) = self.view.dimensions();
        let mut picture = RgbImage::new(width, height + LEGEND);
        for ((x, y, pixel), owner) in self.view.enumerate_pixels().zip(&self.owner) {
            let [r, g, b] = pixel.0.map(u32::from);
            let grey = (2 * r + 5 * g + b) / 8;
            let tinted = match owner {
                Some(class) => colour(*class).map(|k| ((5 * grey + 7 * u32::from(k)) / 12) as u8),
                None => [(grey / 2) as u8; 3],
            };
            picture.put_pixel(x, y, Rgb(tinted));
        }
        legend(&mut picture, height);
        picture
    }

    /// The list, with one line for each draw.
    fn list(&self, frame: u64) -> String {
        let mut counts = String::new();
        for (class, _) in COLOURS {
            let count = self.draws.iter().filter(|d| d.1.class == class).count();
            let _ = write!(counts, ", {count} {}", class.word());
        }
        let mut text = format!(
            "# Frame {frame}: {} draws{counts}.\n\
             # A rule at the end of a line, pasted into a profile between `rule = [` and `]`, changes what its draw is.\n",
            self.draws.len()
        );
        if !self.complete {
            let _ = writeln!(
                text,
                "# The picture is not complete: it was given up after {} s.",
                PATIENCE.as_secs()
            );
        }
        let _ = writeln!(
            text,
            "{:>5}  {:<22} {:<10} {:<59} {:<14} {:>7} {:<16} {:>7} {:>5} {:<14}  rule",
            "draw",
            "kind",
            "class",
            "reason",
            "target",
            "program",
            "shader",
            "texture",
            "list",
            "depth"
        );
        for (facts, classed) in &self.draws {
            let seen = facts.target.is_shown();
            let known = |text: String| if seen { text } else { "-".to_owned() };
            let shader = match facts.shader {
                0 => "-".to_owned(),
                hash => format!("{hash:016x}"),
            };
            let number = |n: Option<u32>| n.map_or("-".to_owned(), |n| n.to_string());
            let _ = writeln!(
                text,
                "{:>5}  {:<22} {:<10} {:<59} {:<14} {:>7} {:<16} {:>7} {:>5} {:<14}  {}",
                facts.draw,
                kind(facts.kind),
                classed.class.word(),
                classed.why.to_string(),
                target(facts.target),
                number(Some(facts.program).filter(|&p| p != 0)),
                shader,
                known(number(Some(facts.texture.0).filter(|&t| t != 0))),
                number(facts.list.map(|list| list.0)),
                known(depth(facts)),
                facts.rule(classed).unwrap_or_else(|| "-".to_owned()),
            );
        }
        text
    }
}

/// Where a draw goes, in words.
fn target(target: Target) -> String {
    match target {
        Target::Window => "window".to_owned(),
        Target::Pass(name) => format!("pass {name}"),
        Target::Framebuffer(name) => format!("framebuffer {name}"),
        Target::Nothing => "-".to_owned(),
    }
}

/// How a draw uses the depth buffer, and which part of the depth range, in words.
fn depth(facts: &Traits) -> String {
    let word = facts.depth_state.word();
    match facts.range {
        DepthRange::Whole => word.to_owned(),
        range => format!("{word} {}", range.word()),
    }
}

/// A draw's command and primitive, in words.
pub(super) fn kind(kind: Kind) -> String {
    let mode = |mode: u32| match mode {
        c::POINTS => "points",
        c::LINES => "lines",
        c::LINE_LOOP => "line loop",
        c::LINE_STRIP => "line strip",
        c::TRIANGLES => "triangles",
        c::TRIANGLE_STRIP => "triangle strip",
        c::TRIANGLE_FAN => "triangle fan",
        c::QUADS => "quads",
        c::QUAD_STRIP => "quad strip",
        c::POLYGON => "polygon",
        _ => "primitives",
    };
    match kind {
        Kind::Begin(m) => format!("glBegin {}", mode(m)),
        Kind::Arrays(m) => format!("array {}", mode(m)),
        Kind::Elements(m) => format!("indexed {}", mode(m)),
        Kind::Other => "other arrays, glRect".to_owned(),
        Kind::List => "display list".to_owned(),
        Kind::Pixels => "pixels".to_owned(),
        Kind::Clear { .. } => "clear".to_owned(),
        Kind::Accum => "accumulation".to_owned(),
    }
}

fn colour(class: Class) -> [u8; 3] {
    COLOURS
        .iter()
        .find(|(known, _)| *known == class)
        .map_or([255; 3], |(_, colour)| *colour)
}

/// Height of the legend in pixels; a letter is 3 by 5 dots of 2 pixels.
const LEGEND: u32 = 18;
const DOT: u32 = 2;

/// The letters of the legend: rows from the top, three bits each, the left dot the highest.
const LETTERS: [(char, [u8; 5]); 12] = [
    ('a', [2, 5, 7, 5, 5]),
    ('c', [3, 4, 4, 4, 3]),
    ('e', [7, 4, 6, 4, 7]),
    ('f', [7, 4, 6, 4, 4]),
    ('k', [5, 5, 6, 5, 5]),
    ('l', [4, 4, 4, 4, 7]),
    ('n', [6, 5, 5, 5, 5]),
    ('o', [2, 5, 5, 5, 2]),
    ('r', [6, 5, 6, 5, 5]),
    ('s', [3, 4, 2, 1, 6]),
    ('t', [7, 2, 2, 2, 2]),
    ('y', [5, 5, 2, 2, 2]),
];

/// Draws a swatch and a word for each class, from row `top` on; what does not fit is left out.
fn legend(picture: &mut RgbImage, top: u32) {
    let mut x = 4;
    for (class, colour) in COLOURS {
        fill(picture, [x, top + 4, 10, 10], colour);
        x += 14;
        for letter in class.word().chars() {
            let rows = LETTERS.iter().find(|(known, _)| *known == letter);
            // A hyphen has no letter of its own.
            let rows = rows.map_or([0, 0, 7, 0, 0], |(_, rows)| *rows);
            for (row, bits) in (0..).zip(rows) {
                for dot in (0..3).filter(|dot| bits >> (2 - dot) & 1 != 0) {
                    let at = [x + dot * DOT, top + 4 + row * DOT, DOT, DOT];
                    fill(picture, at, [255; 3]);
                }
            }
            x += 4 * DOT;
        }
        x += 10;
    }
}

/// Fills a rectangle (x, y, width, height), cut to the picture.
fn fill(picture: &mut RgbImage, [x, y, w, h]: [u32; 4], colour: [u8; 3]) {
    for y in y..(y + h).min(picture.height()) {
        for x in x..(x + w).min(picture.width()) {
            picture.put_pixel(x, y, Rgb(colour));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clear_takes_only_what_it_changes() {
        let view =
            |left: u8| RgbImage::from_fn(2, 1, |x, _| Rgb([if x == 0 { left } else { 9 }; 3]));
        let mut explained = Explained {
            view: view(5),
            owner: vec![Some(Class::Scene); 2],
            last: None,
            draws: Vec::new(),
            began: Instant::now(),
            complete: true,
        };
        // A clear of the depth alone changes no pixel.
        explained.attribute(None, view(5));
        assert_eq!(explained.owner, [Some(Class::Scene); 2]);
        explained.attribute(None, view(0));
        assert_eq!(explained.owner, [None, Some(Class::Scene)]);
    }
}
