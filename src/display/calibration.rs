//! The calibration JSON of a Looking Glass, as the device has it: each number is `{"value": x}`, or x itself.
#![forbid(unsafe_code)]

use super::builtin::facts_of;
use super::fields::in_a_line;
use super::{CellPattern, Display, DisplayError, Facts, Kind, LookingGlass};
use serde_json::Value;

const REMEDY: &str = "give the calibration as the device has it";
/// Views of a device whose serial number is not known: those of the first models.
const VIEWS: u32 = 45;

pub(super) fn read(file: &str, name: String, text: &str) -> Result<Display, DisplayError> {
    let json: Value = serde_json::from_str(text).map_err(|e| DisplayError::Json {
        file: file.into(),
        line: e.line(),
        message: e.to_string(),
    })?;
    let device = Reader { file, json }.device()?;
    let known = facts_of(&device.serial, (device.width, device.height));
    let quilt = known.and_then(|facts| facts.quilt);
    let facts = Facts {
        screen: Some((device.width, device.height)),
        dpi: Some(device.dpi),
        cone: Some(device.view_cone),
        quilt,
        ..Facts::default()
    };
    let views = quilt.map_or(VIEWS, |(columns, rows)| columns * rows);
    Ok(Display {
        facts,
        ..Display::new(name, views, Kind::LookingGlass(device))
    })
}

struct Reader<'a> {
    file: &'a str,
    json: Value,
}

impl Reader<'_> {
    fn device(&self) -> Result<LookingGlass, DisplayError> {
        let side = |field| self.number(field, (16.0, 16_384.0)).map(|side| side as u32);
        let device = LookingGlass {
            serial: self.serial()?,
            pitch: self.number("pitch", (1e-3, 1e4))?,
            slope: self.number("slope", (-1e6, 1e6))?,
            center: self.number("center", (-1e6, 1e6))?,
            view_cone: self.number_or("viewCone", (0.1, 170.0), 40.0)?,
            vertical_angle: self.number_or("verticalAngle", (-90.0, 90.0), 0.0)?,
            dpi: self.number("DPI", (1.0, 1e4))?,
            width: side("screenW")?,
            height: side("screenH")?,
            inverted: self.flag("invView")?,
            flip_x: self.flag("flipImageX")?,
            flip_y: self.flag("flipImageY")?,
            flip_subpixels: self.flag("flipSubp")?,
            fringe: match self.get("fringe") {
                Some(_) => Some(self.number("fringe", (-1e6, 1e6))?),
                None => None,
            },
            cells: self.cells()?,
            cell_pattern: self.cell_pattern()?,
        };
        let found = |field| self.get(field).unwrap_or(&Value::Null);
        if device.slope.abs() < 0.05 {
            return Err(self.wrong("slope", "at least 0.05 in size", found("slope")));
        }
        if device.lenses() > 3.0 * f64::from(device.width) {
            return Err(self.wrong("pitch", "a lens of at least one subpixel", found("pitch")));
        }
        let cells = device.cells.len();
        if cells > 0 && cells < device.cell_pattern.cells() {
            let expected = format!("a mode that {cells} subpixelCells are enough for");
            return Err(self.wrong("CellPatternMode", &expected, found("CellPatternMode")));
        }
        Ok(device)
    }

    /// The value of a field, unwrapped.
    fn get(&self, field: &str) -> Option<&Value> {
        let value = self.json.get(field)?;
        Some(value.get("value").unwrap_or(value)).filter(|value| !value.is_null())
    }

    fn wrong(&self, field: &'static str, expected: &str, found: &Value) -> DisplayError {
        DisplayError::Field {
            file: self.file.into(),
            field,
            expected: expected.into(),
            found: in_a_line(found.to_string()),
            remedy: REMEDY,
        }
    }

    fn number(&self, field: &'static str, (least, most): (f64, f64)) -> Result<f64, DisplayError> {
        let Some(value) = self.get(field) else {
            return Err(DisplayError::Missing {
                file: self.file.into(),
                field,
                remedy: REMEDY,
            });
        };
        match value.as_f64() {
            Some(number) if (least..=most).contains(&number) => Ok(number),
            _ => Err(self.wrong(field, &format!("a number from {least} to {most}"), value)),
        }
    }

    fn number_or(
        &self,
        field: &'static str,
        range: (f64, f64),
        default: f64,
    ) -> Result<f64, DisplayError> {
        match self.get(field) {
            Some(_) => self.number(field, range),
            None => Ok(default),
        }
    }

    /// Devices write flags as 0 and 1.
    fn flag(&self, field: &'static str) -> Result<bool, DisplayError> {
        match self.get(field) {
            None => Ok(false),
            Some(Value::Bool(flag)) => Ok(*flag),
            Some(value) => match value.as_f64() {
                Some(number) => Ok(number != 0.0),
                None => Err(self.wrong(field, "0 or 1", value)),
            },
        }
    }

    fn serial(&self) -> Result<String, DisplayError> {
        match self.get("serial") {
            None => Ok(String::new()),
            Some(Value::String(serial)) => Ok(serial.clone()),
            Some(value) => Err(self.wrong("serial", "a text", value)),
        }
    }

    fn cells(&self) -> Result<Vec<[[f64; 2]; 3]>, DisplayError> {
        const EXPECTED: &str = "at most 4 cells with ROffsetX, ROffsetY, GOffsetX, GOffsetY, \
                                BOffsetX and BOffsetY from -100 to 100";
        let Some(value) = self.get("subpixelCells") else {
            return Ok(Vec::new());
        };
        let offset = |cell: &Value, key: &str| {
            let value = cell.get(key)?;
            let number = value.get("value").unwrap_or(value).as_f64()?;
            (number.abs() <= 100.0).then_some(number)
        };
        let colour = |cell: &Value, x: &str, y: &str| Some([offset(cell, x)?, offset(cell, y)?]);
        let cell = |cell: &Value| {
            Some([
                colour(cell, "ROffsetX", "ROffsetY")?,
                colour(cell, "GOffsetX", "GOffsetY")?,
                colour(cell, "BOffsetX", "BOffsetY")?,
            ])
        };
        let cells = value.as_array().filter(|cells| cells.len() <= 4);
        cells
            .and_then(|cells| cells.iter().map(cell).collect())
            .ok_or_else(|| self.wrong("subpixelCells", EXPECTED, value))
    }

    fn cell_pattern(&self) -> Result<CellPattern, DisplayError> {
        let Some(value) = self.get("CellPatternMode") else {
            return Ok(CellPattern::One);
        };
        // Devices write whole numbers with a point.
        let mode = value
            .as_f64()
            .filter(|mode| mode.fract() == 0.0 && *mode >= 0.0);
        mode.and_then(|mode| CellPattern::ALL.get(mode as usize).copied())
            .ok_or_else(|| self.wrong("CellPatternMode", "0, 1, 2, 3 or 4", value))
    }
}
