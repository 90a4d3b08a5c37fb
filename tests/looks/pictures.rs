//! The pictures of a game, as a person looks at them.

use crate::looks::launch::{Launched, VIEWS};
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{FilterType, replace, resize};
use image::{ExtendedColorType, RgbImage};
use manyview::config::{Anaglyph, Glasses, Mixture};
use manyview::interleave::reference::anaglyph;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};
use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// The views of the strip.
const STRIP: [u32; 3] = [0, VIEWS / 2, VIEWS - 1];
/// Width of one view of the strip, of the anaglyph and of the chart, pixels.
const WIDTH: u32 = 320;
const LARGE: u32 = 480;
/// Of 100.
const QUALITY: u8 = 85;

/// Width and height of a view that is made so wide. Small ones stay as they are.
fn scaled(view: &RgbImage, width: u32) -> (u32, u32) {
    let width = width.min(view.width());
    (width, view.height() * width / view.width())
}

fn save(picture: &RgbImage, file: &Path) -> Result<(), Box<dyn Error>> {
    let out = BufWriter::new(File::create(file)?);
    let (width, height) = picture.dimensions();
    JpegEncoder::new_with_quality(out, QUALITY).encode(
        picture.as_raw(),
        width,
        height,
        ExtendedColorType::Rgb8,
    )?;
    Ok(())
}

/// Writes `NAME.jpg`, `NAME-anaglyph.jpg` and `NAME.svg` to the folder.
pub(crate) fn write(name: &str, launched: &Launched, folder: &Path) -> Result<(), Box<dyn Error>> {
    let views = &launched.views;
    let (width, height) = scaled(&views[0], WIDTH);
    let mut strip = RgbImage::new(3 * width, height);
    for (at, view) in STRIP.into_iter().enumerate() {
        let small = resize(&views[view as usize], width, height, FilterType::Triangle);
        replace(&mut strip, &small, i64::from(width) * at as i64, 0);
    }
    save(&strip, &folder.join(format!("{name}.jpg")))?;
    let eyes = [&views[0], &views[VIEWS as usize - 1]].map(RgbImage::clone);
    let glasses = Anaglyph {
        glasses: Glasses::RedCyan,
        mixture: Mixture::Dubois,
    };
    let both = anaglyph(&eyes, glasses, scaled(&views[0], LARGE))?;
    save(&both, &folder.join(format!("{name}-anaglyph.jpg")))?;
    chart(
        launched,
        scaled(&views[0], LARGE),
        &folder.join(format!("{name}.svg")),
    )
}

/// Disparities over the last frames: the scene from its nearest to its farthest point as a band, the median as a line, the budget as lines.
fn chart(launched: &Launched, size: (u32, u32), file: &Path) -> Result<(), Box<dyn Error>> {
    let about = &launched.report["disparity"];
    let frames: Vec<(f64, [f64; 3])> =
        serde_json::from_value::<Vec<serde_json::Value>>(about["last_frames"].clone())
            .unwrap_or_default()
            .iter()
            .filter_map(|frame| {
                Some((
                    frame["frame"].as_f64()?,
                    serde_json::from_value(frame["px"].clone()).ok()?,
                ))
            })
            .collect();
    let budget = about["budget_px"].as_f64().unwrap_or(1.0);
    let (first, last) = match frames.as_slice() {
        [first, .., last] => (first.0, last.0),
        _ => (0.0, 1.0),
    };
    let ends = frames.iter().flat_map(|(_, px)| [px[0].abs(), px[2].abs()]);
    let most = 1.1 * ends.fold(budget, f64::max);
    register_font(
        "sans-serif",
        FontStyle::Normal,
        epaint_default_fonts::UBUNTU_LIGHT,
    )
    .map_err(|_| "the font cannot be read")?;
    let mut text = String::new();
    let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
    area.fill(&WHITE)?;
    let mut plane = ChartBuilder::on(&area)
        .margin(8)
        .x_label_area_size(32)
        .y_label_area_size(44)
        .build_cartesian_2d(first..last, -most..most)?;
    plane
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("frame")
        .y_desc("pixels between neighbouring views")
        .x_label_formatter(&|frame| format!("{frame:.0}"))
        .draw()?;
    let far = frames.iter().map(|(frame, px)| (*frame, px[2]));
    let near = frames.iter().rev().map(|(frame, px)| (*frame, px[0]));
    let band: Vec<_> = far.chain(near).collect();
    plane.draw_series([Polygon::new(band, RGBColor(86, 180, 233).mix(0.5))])?;
    let middle = frames.iter().map(|(frame, px)| (*frame, px[1]));
    plane.draw_series(LineSeries::new(middle, RGBColor(0, 114, 178)))?;
    for limit in [-budget, budget] {
        let line = [(first, limit), (last, limit)];
        plane.draw_series(LineSeries::new(line, RGBColor(213, 94, 0)))?;
    }
    area.present()?;
    drop((plane, area));
    std::fs::write(file, text)?;
    Ok(())
}
