//! PCD of the Point Cloud Library.

use super::cloud::{Cloud, GIVEN, Part, Point, Up};
use super::error::{Place, ReadError};
use glam::{DVec3, Vec3};
use pcd_rs::{DynReader, Field};
use std::path::{Path, PathBuf};

pub(super) fn open(path: &Path) -> Result<Cloud, ReadError> {
    let wrong = |error: &dyn std::fmt::Display| ReadError::new(path, Place::Header, error);
    let reader = DynReader::open(path).map_err(|error| wrong(&error))?;
    let meta = reader.meta();
    let column = |name: &str| {
        let mut names = meta.field_defs.iter();
        names.position(|field| field.name == name)
    };
    let three = |[a, b, c]: [&str; 3]| Some([column(a)?, column(b)?, column(c)?]);
    let place = three(["x", "y", "z"]);
    let columns = Columns {
        place: place.ok_or_else(|| wrong(&"a point has no x, y and z"))?,
        normal: three(["normal_x", "normal_y", "normal_z"]),
        colour: column("rgb").or_else(|| column("rgba")),
    };
    Ok(Cloud {
        points: Some(meta.num_points),
        up: Up::Z,
        parts: vec![Box::new(Pcd {
            path: path.to_owned(),
            columns,
        })],
    })
}

#[derive(Clone, Copy)]
struct Columns {
    place: [usize; 3],
    normal: Option<[usize; 3]>,
    colour: Option<usize>,
}

struct Pcd {
    path: PathBuf,
    columns: Columns,
}

impl Part for Pcd {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let wrong = |point: usize, error: &dyn std::fmt::Display| {
            ReadError::new(&self.path, Place::Point(point as u64 + 1), error)
        };
        let reader = DynReader::open(&self.path).map_err(|error| wrong(0, &error))?;
        let mut points = Vec::new();
        for (number, record) in reader.enumerate() {
            let record = record.map_err(|error| wrong(number, &error))?;
            let at = |column: usize| record.0.get(column).and_then(number_of).unwrap_or(f64::NAN);
            let mut point = Point::at(DVec3::from_array(self.columns.place.map(at)));
            point.normal = self.columns.normal.map(|normal| {
                let [x, y, z] = normal.map(|column| at(column) as f32);
                Vec3::new(x, y, z)
            });
            let colour = self.columns.colour.and_then(|column| record.0.get(column));
            point.colour = colour.and_then(colour_of);
            points.push(point);
            if points.len() >= GIVEN && !give(&mut points) {
                return Ok(());
            }
        }
        give(&mut points);
        Ok(())
    }
}

fn number_of(field: &Field) -> Option<f64> {
    Some(match field {
        Field::I8(values) => f64::from(*values.first()?),
        Field::I16(values) => f64::from(*values.first()?),
        Field::I32(values) => f64::from(*values.first()?),
        Field::U8(values) => f64::from(*values.first()?),
        Field::U16(values) => f64::from(*values.first()?),
        Field::U32(values) => f64::from(*values.first()?),
        Field::F32(values) => f64::from(*values.first()?),
        Field::F64(values) => *values.first()?,
        _ => return None,
    })
}

/// The three lower bytes of a word, which is written as an integer or as the float with its bits.
fn colour_of(field: &Field) -> Option<[u8; 3]> {
    let word = match field {
        Field::F32(values) => values.first()?.to_bits(),
        Field::U32(values) => *values.first()?,
        Field::I32(values) => values.first()?.cast_unsigned(),
        _ => return None,
    };
    let [_, r, g, b] = word.to_be_bytes();
    Some([r, g, b])
}
