//! The cost of the interleave pass, compared with a plain copy of a picture of the same size. The two are timed alternately.
#![forbid(unsafe_code)]

use super::shader::{Pass, VIEWS_UNIT};
use super::{Interleaver, PanelPlacement, Picture, Program, Source};
use crate::atlas::{Atlas, Grid, Limits, Names, Tiles};
use crate::config::{Config, Output};
use crate::display::Placement;
use crate::gl::{Gl, consts as c};
use crate::state::{Buffers, Neutral, Window};
use crate::view::ViewIndex;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// One line of JSON of `manyview-probe interleave`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// N.
    pub views: u32,
    /// Name of the display.
    pub display: String,
    /// Median time of the copy, one fetch per pixel from a texture of the picture's size, in milliseconds.
    pub copy: f64,
    /// Median time of the panel's picture, in milliseconds.
    pub interleave: f64,
    /// Median of the time of a picture over the mean time of the copies before and after it.
    pub ratio: f64,
}

/// A case to measure.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// Number of views, display, and memory layout of the atlas.
    pub config: &'a Config,
    /// Pixels of the picture and of each view.
    pub size: (u32, u32),
    /// Number of measurements.
    pub rounds: usize,
}

/// Measures in a context that nobody else uses, whose shading language has this version × 100. The error says why that is not possible.
pub fn measure(gl: &Gl, glsl: u32, limits: Limits, case: &Case) -> Result<Cost, String> {
    let Case { config, size, .. } = *case;
    let (width, height) = size;
    let tiles = Tiles::new(
        config.views,
        [width, height],
        Grid::FULL,
        config.atlas,
        limits,
    );
    let tiles = tiles.map_err(|e| e.to_string())?;
    let mut names = Names::default();
    let mut picture =
        |tiles| Atlas::new(gl, &mut names, &window(size), tiles, false).map_err(|e| e.to_string());
    let one = Tiles {
        views: 1,
        columns: 1,
        rows: 1,
        ..tiles
    };
    let shown = picture(one)?;
    let atlas = picture(tiles)?;
    let source = Picture::new(gl, names.texture(gl), size);
    let mut interleaver = Interleaver::new(gl, &mut names, glsl, false, None);
    let copy = Program::new(gl, glsl, Pass::Copy)?;
    // Memory that was never written may not be backed by pages, and would cost nothing to read.
    let (w, h) = (width as i32, height as i32);
    gl.bind_framebuffer(c::READ_FRAMEBUFFER, shown.framebuffer());
    gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, source.framebuffer);
    gl.blit_framebuffer(0, 0, w, h, 0, 0, w, h, c::COLOR_BUFFER_BIT, c::NEAREST);
    for view in ViewIndex::all(tiles.views) {
        let (to, x) = atlas.target(view);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
        gl.blit_framebuffer(0, 0, w, h, x, 0, x + w, h, c::COLOR_BUFFER_BIT, c::NEAREST);
    }
    gl.bind_framebuffer(c::FRAMEBUFFER, shown.framebuffer());
    let views = Source {
        tiles,
        texture: atlas.color,
        top_down: false,
        depth: None,
        pyramid: None,
        srgb: false,
    };
    let panel = PanelPlacement {
        display: &config.display,
        placement: Placement::full_screen(width, height),
    };
    let milliseconds = |draw: &mut dyn FnMut() -> Result<(), String>| {
        gl.finish();
        let start = Instant::now();
        draw()?;
        gl.finish();
        Ok::<_, String>(start.elapsed().as_secs_f64() * 1000.0)
    };
    let neutral = Neutral::enter(gl, gl.has_extension("GL_ARB_compatibility"), false);
    let mut interleave = || {
        let none = &mut |_| Default::default();
        interleaver.draw(gl, &neutral, config, &views, none, Output::Panel, &panel)
    };
    // The first picture makes the mask and lets the driver compile.
    interleave()?;
    let vertex_array = gl.gen_vertex_array();
    let mut plain = || {
        gl.viewport(0, 0, w, h);
        gl.active_texture(c::TEXTURE0 + VIEWS_UNIT);
        gl.bind_texture(c::TEXTURE_2D, source.texture);
        copy.bind(gl, &[]);
        gl.draw_triangle(vertex_array);
        Ok(())
    };
    plain()?;
    let (mut copies, mut interleaved, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..case.rounds {
        let before = milliseconds(&mut plain)?;
        let interleave = milliseconds(&mut interleave)?;
        let after = milliseconds(&mut plain)?;
        copies.extend([before, after]);
        interleaved.push(interleave);
        ratios.push(2.0 * interleave / (before + after));
    }
    neutral.leave(gl);
    shown.delete(gl);
    atlas.delete(gl);
    source.delete(gl);
    match interleaver.note() {
        Some(note) => Err(note),
        None => Ok(Cost {
            width,
            height,
            views: config.views,
            display: config.display.name.clone(),
            copy: median(copies),
            interleave: median(interleaved),
            ratio: median(ratios),
        }),
    }
}

/// A window with 8 bits each of RGBA and no other buffers.
fn window((width, height): (u32, u32)) -> Window {
    Window {
        buffers: Buffers {
            es: false,
            double_buffered: true,
            stereo: false,
            eyes: false,
            names_back: true,
            default_draw: c::BACK,
            default_read: c::BACK,
        },
        width,
        height,
        bits: [8, 8, 8, 8, 0, 0],
        samples: 0,
        srgb_capable: false,
        srgb: false,
        float: false,
        accumulation: [0; 4],
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
