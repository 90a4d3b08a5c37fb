//! The description of a wall: a `[[panel]]` for each of its panels.
#![forbid(unsafe_code)]

use super::fields::{Fields, bias, float};
use super::wall::{Homography, Light, Wall, WallPanel, placed};
use super::{Bias, Display, DisplayError, Kind};
use std::path::Path;
use toml::{Table, Value};

const VIEWER: &str =
    "give how far the viewers are before the wall in mm, for example viewer = 1500";
const CONE: &str = "give the angle over which its views are spread in its own description, for example cone = 40, or leave out viewer";
const PANELS: &str = "give a [[panel]] for each panel, with its monitor, its display and its place";
const MONITOR: &str = "give the name of its monitor, for example monitor = \"DP-1\"";
const DISPLAY: &str = "give its own description, for example display = \"left.toml\"";
const PIXELS: &str = "give its width and height, for example pixels = \"1920x1080\"";
const AT: &str = "give the place of its left top corner in the wall in mm, for example at = [0, 0]";
const WIDTH: &str = "give the width of its picture in mm, for example width = 597.5";
const TURN: &str = "give how far it is turned clockwise in degrees, for example turn = 0.5";
const HOMOGRAPHY: &str = "give three rows of three numbers, from its pixels to mm of the wall, as `manyview wall fit` writes them";
const MESH: &str = "give a grid from 2x2 to 64x64 of offsets in mm, for example mesh-x = { columns = 2, rows = 2, values = [0, 0.1, 0, 0.1] }";
const LIGHT: &str = "give the share of its light that it shows, from 0.05 to 1, or a grid of them, for example light = 0.97";
const BORDER: &str =
    "give the pixels that stay black: left, top, right, bottom, for example border = [4, 4, 4, 4]";

/// The fields of a panel.
const FIELDS: [&str; 11] = [
    "monitor",
    "display",
    "pixels",
    "at",
    "width",
    "turn",
    "homography",
    "mesh-x",
    "mesh-y",
    "light",
    "border",
];

/// The most panels, and pixels along a side of one.
const MOST: usize = 64;
const SIDE: u32 = 16_384;
/// Of the sheet: what a mask may have.
const MOST_SIDE: u32 = 32_768;
const MOST_PIXELS: u64 = 1 << 26;
/// Of light.
const DARKEST: f64 = 0.05;

/// Reads the panels of a wall; `path` is that of its description, for files beside it.
pub(super) fn wall(path: &Path, fields: &Fields) -> Result<Wall, DisplayError> {
    let value = fields.need("panel", PANELS)?;
    let tables = value.as_array().and_then(|all| {
        let all: Option<Vec<&Table>> = all.iter().map(Value::as_table).collect();
        all.filter(|all| (1..=MOST).contains(&all.len()))
    });
    let Some(tables) = tables else {
        return Err(fields.wrong("panel", format!("1 to {MOST} tables"), value, PANELS));
    };
    let mut panels = Vec::new();
    for (number, table) in (1..).zip(tables) {
        let file = format!("{}, panel {number}", fields.file);
        let fields = Fields::new(file, table.clone());
        panels.push(panel(path, &fields)?);
    }
    let viewer = fields.float("viewer", (50.0, 1e6), VIEWER)?;
    if viewer.is_some() {
        for (panel, number) in panels.iter().zip(1..) {
            if panel.display.facts.cone.is_none() {
                let file = format!("{}, panel {number}", fields.file);
                return Err(DisplayError::Missing {
                    file,
                    field: "cone",
                    remedy: CONE,
                });
            }
        }
    }
    let wall = Wall::new(panels, viewer);
    let wall = wall.ok_or_else(|| fields.wrong("panel", "panels with an area", value, PANELS))?;
    let (width, height) = wall.sheet();
    if width.max(height) > MOST_SIDE || u64::from(width) * u64::from(height) > MOST_PIXELS {
        let expected = "panels of at most 2^26 pixels in all";
        return Err(fields.wrong("panel", expected, value, PANELS));
    }
    Ok(wall)
}

fn panel(path: &Path, f: &Fields) -> Result<WallPanel, DisplayError> {
    f.only("wall", &[], &FIELDS, &[])?;
    let monitor = f.need("monitor", MONITOR)?;
    let monitor = f.text("monitor", monitor, "a text", MONITOR)?.to_owned();
    let value = f.need("display", DISPLAY)?;
    let name = f.text("display", value, "a display", DISPLAY)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let display = Display::load_for_wall(name, folder)?;
    if matches!(display.kind, Kind::Uncalibrated) {
        return Err(f.wrong("display", "a panel with a mask", value, DISPLAY));
    }
    let pixels = f.pair("pixels", SIDE, PIXELS)?.or(display.facts.screen);
    let pixels = pixels.ok_or_else(|| f.missing("pixels", PIXELS))?;
    let mesh = [grid(f, "mesh-x", MESH)?, grid(f, "mesh-y", MESH)?];
    let mesh = match mesh {
        [Some(right), Some(down)] => Some([right, down]),
        [None, None] => None,
        [Some(_), None] => return Err(f.missing("mesh-y", MESH)),
        [None, Some(_)] => return Err(f.missing("mesh-x", MESH)),
    };
    Ok(WallPanel {
        monitor,
        display,
        pixels,
        to_wall: place(f, pixels)?,
        mesh,
        light: light(f)?,
        border: border(f, pixels)?,
        at: [0, 0],
        shift: 0.0,
    })
}

/// Where the panel is: by a homography, or by its corner, width and turn.
fn place(f: &Fields, pixels: (u32, u32)) -> Result<Homography, DisplayError> {
    if let Some(value) = f.get("homography") {
        let row = |row: &Value| numbers::<3>(row);
        let rows = value.as_array().map(Vec::as_slice);
        let found = match rows {
            Some([a, b, c]) => row(a).zip(row(b)).zip(row(c)),
            _ => None,
        };
        let found = found.map(|((a, b), c)| [a, b, c]);
        // Its corners must lie before the viewer, and not in one place.
        let is_right = |h: &Homography| {
            let [width, height] = [pixels.0, pixels.1].map(f64::from);
            let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
            corners
                .iter()
                .all(|[x, y]| h[2][0] * x + h[2][1] * y + h[2][2] > 1e-9)
        };
        let expected = "three rows of three numbers that place all of the panel";
        let found = found.filter(is_right);
        return found.ok_or_else(|| f.wrong("homography", expected, value, HOMOGRAPHY));
    }
    let value = f.need("at", AT)?;
    let at = numbers::<2>(value);
    let at = at.ok_or_else(|| f.wrong("at", "two numbers", value, AT))?;
    let width = f.float("width", (1.0, 1e6), WIDTH)?;
    let width = width.ok_or_else(|| f.missing("width", WIDTH))?;
    let turn = f.float("turn", (-360.0, 360.0), TURN)?.unwrap_or(0.0);
    Ok(placed(pixels, at, width, turn))
}

fn light(f: &Fields) -> Result<Light, DisplayError> {
    let Some(value) = f.get("light") else {
        return Ok(Light::Even(1.0));
    };
    let fits = |share: f64| (DARKEST..=1.0).contains(&share);
    let light = match float(value) {
        Some(share) => Some(Light::Even(share)).filter(|_| fits(share)),
        None => bias(value)
            .filter(|map| map.range().into_iter().all(fits))
            .map(Light::Map),
    };
    light.ok_or_else(|| {
        f.wrong(
            "light",
            "a share of the light, or a grid of them",
            value,
            LIGHT,
        )
    })
}

fn border(f: &Fields, pixels: (u32, u32)) -> Result<[u32; 4], DisplayError> {
    let Some(value) = f.get("border") else {
        return Ok([0; 4]);
    };
    let whole = |value: &Value| u32::try_from(value.as_integer()?).ok();
    let sides = value.as_array().and_then(|sides| {
        let sides: Option<Vec<u32>> = sides.iter().map(whole).collect();
        <[u32; 4]>::try_from(sides?).ok()
    });
    let fits = |sides: &[u32; 4]| {
        let [left, top, right, bottom] = sides.map(u64::from);
        left + right < u64::from(pixels.0) && top + bottom < u64::from(pixels.1)
    };
    let expected = "four whole numbers that leave some of the panel";
    sides
        .filter(fits)
        .ok_or_else(|| f.wrong("border", expected, value, BORDER))
}

fn grid(
    f: &Fields,
    field: &'static str,
    remedy: &'static str,
) -> Result<Option<Bias>, DisplayError> {
    let Some(value) = f.get(field) else {
        return Ok(None);
    };
    let grid = bias(value).ok_or_else(|| f.wrong(field, "a grid of values", value, remedy))?;
    Ok(Some(grid))
}

fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> = value.as_array()?.iter().map(float).collect();
    <[f64; N]>::try_from(all?)
        .ok()
        .filter(|all| all.iter().all(|n| n.is_finite()))
}
