//! The on-screen display, copied over the picture that goes to the screen.

use super::{Layer, keep_bindings};
use crate::atlas::OsdImage;
use crate::config::{Interlace, Knob, OsdPart, Output};
use crate::gl::{Gl, consts as c};
use crate::interleave::Layout;
use crate::osd::{Cell, Osd, cells, text_height, write};
use crate::state::Neutral;
use std::time::Instant;

/// The display of one context.
#[derive(Debug, Default)]
pub(super) struct Display {
    pub(super) osd: Osd,
    /// The text in the image, and its size in pixels.
    text: Option<(Text, Option<[u32; 2]>)>,
    /// The driver has refused it.
    refused: bool,
}

/// What [`write`] is given.
#[derive(Clone, Debug, PartialEq)]
struct Text {
    lines: Vec<String>,
    height: u32,
    most: [u32; 2],
    spread: f64,
}

impl Layer {
    /// Shows a value that the user has changed.
    pub(super) fn show_values(&mut self, changes: &[(Knob, String)]) {
        let now = Instant::now();
        for (knob, value) in changes {
            let name = match knob {
                Knob::Option(id) => id.spec().key.unwrap_or_default(),
                Knob::Lens(part) => part.name(),
            };
            let text = format!("{name} {value}");
            self.diagnostics.display.osd.value(name, text, now);
        }
    }

    /// Shows what was done, or why not.
    pub(super) fn show_text(&mut self, text: String) {
        let now = Instant::now();
        self.diagnostics.display.osd.value("", text, now);
    }

    /// Counts a frame that is shown.
    pub(super) fn count_for_osd(&mut self) {
        let drawn = self.synthesis.governed();
        let drawn = drawn.map(|drawn| (drawn, self.session.config.views));
        self.diagnostics.display.osd.frame(drawn, Instant::now());
    }

    /// Draws it over the picture of an output, of this size in pixels, in the framebuffer that is bound for drawing.
    pub(super) fn draw_osd(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        image: u32,
        (output, size): (Output, [u32; 2]),
    ) {
        let (parts, now) = (self.session.live.osd, Instant::now());
        let lines = self.diagnostics.display.osd.lines(parts, now);
        let cross = parts.has(OsdPart::Crosshair);
        if self.diagnostics.display.refused || (lines.is_empty() && !cross) {
            return;
        }
        let (config, views) = (self.session.config, self.session.config.views);
        let cells = cells(output, Layout::of(config, output), views, size);
        let Some(first) = cells.first() else {
            return;
        };
        self.state.keep_errors(gl);
        let spread = self.spread(output);
        let height = text_height(first.seen[1], spread);
        let margin = height / 2;
        let most = [
            first.seen[0].saturating_sub(2 * margin),
            first.seen[1].saturating_sub(margin),
        ];
        let text = Text {
            lines,
            height,
            most,
            spread,
        };
        let text = self.ready_text(gl, neutral, text);
        for buffer in self.buffers_of(output, image) {
            if let Some(buffer) = buffer {
                gl.draw_buffer(buffer);
            }
            if let Some(osd) = &self.targets.osd {
                gl.bind_framebuffer(c::READ_FRAMEBUFFER, osd.framebuffer());
                for cell in &cells {
                    if let Some([width, high]) = text {
                        let from = [0, 0, width as i32, high as i32];
                        blit(gl, cell, size[1], from, ([margin; 2], [width, high]));
                    }
                    if cross {
                        draw_cross(gl, osd, cell, size[1]);
                    }
                }
            }
            if buffer.is_some() {
                gl.draw_buffer(self.state.window.buffers.default_draw);
            }
        }
        if gl.drop_errors() > 0
            || self
                .targets
                .osd
                .as_ref()
                .is_some_and(|osd| !osd.is_complete())
        {
            self.diagnostics.display.refused = true;
            let why = "the driver copies no on-screen display over the picture, so there is none";
            self.diagnostics.announce(why.into());
        }
    }

    /// The buffers that the picture of an output is in; none for the one that is drawn to already.
    fn buffers_of(&mut self, output: Output, image: u32) -> Vec<Option<u32>> {
        match self.is_mono() {
            true => vec![None],
            false => {
                let pictures = self.pictures(output, image).into_iter();
                pictures.map(|(buffer, _)| buffer).collect()
            }
        }
    }

    /// Columns of pixels from one sample of a view to the next.
    fn spread(&self, output: Output) -> f64 {
        let views = self.session.config.views;
        let phase = match output {
            Output::Panel => self.session.display().lens_phase(&self.placement(), views),
            Output::Interlaced(Interlace::Columns | Interlace::Checkerboard) => return 2.0,
            _ => None,
        };
        let lens = phase.map(|phase| 1.0 / phase.right.abs());
        lens.filter(|lens| lens.is_finite()).unwrap_or(1.0).max(1.0)
    }

    /// Makes the image of the text, where another one is there. Returns the size of the text; none where there is none.
    fn ready_text(&mut self, gl: &Gl, neutral: &Neutral, text: Text) -> Option<[u32; 2]> {
        if let (Some((known, size)), true) =
            (&self.diagnostics.display.text, self.targets.osd.is_some())
            && *known == text
        {
            return *size;
        }
        let raster = write(&text.lines, text.height, text.most, text.spread);
        let size = raster.as_ref().map(|raster| raster.size);
        let needed = size.unwrap_or([1, 1]);
        let room = self.targets.osd.as_ref().map(OsdImage::room);
        if room.is_none_or(|room| room[0] < needed[0] || room[1] < needed[1]) {
            if let Some(old) = self.targets.osd.take() {
                old.delete(gl);
            }
            let room = [0, 1].map(|at| needed[at].next_power_of_two());
            let names = &mut self.targets.names;
            let made = keep_bindings(gl, || OsdImage::new(gl, neutral, names, room));
            self.targets.osd = Some(made);
        }
        if let (Some(osd), Some(raster)) = (&self.targets.osd, raster) {
            keep_bindings(gl, || osd.set(gl, neutral, raster.size, &raster.texels));
        }
        self.diagnostics.display.text = Some((text, size));
        size
    }
}

/// Copies a part of the display's image (left, bottom, right, top) to a place of the cell: left and top, width and height in pixels that the viewer sees.
/// `height`: that of the whole picture.
fn blit(gl: &Gl, cell: &Cell, height: u32, from: [i32; 4], (at, size): ([u32; 2], [u32; 2])) {
    let to = |axis: usize, seen: u32| {
        let (own, whole) = (
            u64::from(cell.size[axis]),
            u64::from(cell.seen[axis].max(1)),
        );
        cell.at[axis] as i32 + (u64::from(seen) * own / whole) as i32
    };
    let [left, right] = [to(0, at[0]), to(0, at[0] + size[0])];
    let [top, bottom] = [to(1, at[1]), to(1, at[1] + size[1])].map(|row| height as i32 - row);
    let [x0, y0, x1, y1] = from;
    // A swatch has neighbours of another colour.
    let swatch = x1 - x0 == 1;
    let same = [right - left, top - bottom] == [x1 - x0, y1 - y0];
    let filter = if same || swatch {
        c::NEAREST
    } else {
        c::LINEAR
    };
    let colour = c::COLOR_BUFFER_BIT;
    gl.blit_framebuffer(x0, y0, x1, y1, left, bottom, right, top, colour, filter);
}

/// A cross in the middle of a cell: four light bars with a dark edge, and nothing in the middle.
fn draw_cross(gl: &Gl, osd: &OsdImage, cell: &Cell, height: u32) {
    let [width, tall] = cell.seen;
    // Wide enough for both eyes of a screen that interlaces them, and for each view of a lens sheet.
    let thick = (tall / 200).max(2);
    let (arm, gap) = (thick * 6, thick * 2);
    let [x, y] = [width / 2, tall / 2];
    if x < gap + arm + thick || y < gap + arm + thick {
        return;
    }
    let across = |left: u32| ([left, y - thick / 2], [arm, thick]);
    let up = |top: u32| ([x - thick / 2, top], [thick, arm]);
    let arms = [
        across(x - gap - arm),
        across(x + gap),
        up(y - gap - arm),
        up(y + gap),
    ];
    for (edge, light) in [(thick.div_ceil(2), false), (0, true)] {
        for (at, size) in arms {
            let place = (at.map(|n| n - edge), size.map(|n| n + 2 * edge));
            blit(gl, cell, height, osd.swatch(light), place);
        }
    }
}
