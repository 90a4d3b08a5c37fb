//! E57: all scans of a file, each where its pose puts it.

use super::cloud::{Cloud, GIVEN, Part, Point, Up};
use super::error::{Place, ReadError};
use e57::{CartesianCoordinate, E57Reader};
use glam::DVec3;
use std::path::{Path, PathBuf};

pub(super) fn open(path: &Path) -> Result<Cloud, ReadError> {
    let wrong = |error: &dyn std::fmt::Display| ReadError::new(path, Place::Header, error);
    let reader = E57Reader::from_file(path).map_err(|error| wrong(&error))?;
    let scans = reader.pointclouds();
    if scans.is_empty() {
        return Err(wrong(&"there is no scan in it"));
    }
    let points = scans
        .iter()
        .try_fold(0_u64, |sum, scan| sum.checked_add(scan.records));
    Ok(Cloud {
        points,
        up: Up::Z,
        parts: vec![Box::new(E57 {
            path: path.to_owned(),
        })],
    })
}

struct E57 {
    path: PathBuf,
}

impl Part for E57 {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let wrong = |point: u64, error: &dyn std::fmt::Display| {
            ReadError::new(&self.path, Place::Point(point + 1), error)
        };
        let mut reader = E57Reader::from_file(&self.path).map_err(|error| wrong(0, &error))?;
        let (mut number, mut points) = (0, Vec::new());
        for scan in reader.pointclouds() {
            let read = reader.pointcloud_simple(&scan);
            for point in read.map_err(|error| wrong(number, &error))? {
                let point = point.map_err(|error| wrong(number, &error))?;
                number += 1;
                let CartesianCoordinate::Valid { x, y, z } = point.cartesian else {
                    // The scanner saw nothing in this direction.
                    continue;
                };
                let mut own = Point::at(DVec3::new(x, y, z));
                let shade = |value: f32| (value * 255.0).round() as u8;
                let colour = point
                    .color
                    .map(|colour| [colour.red, colour.green, colour.blue]);
                let grey = point.intensity.map(|intensity| [intensity; 3]);
                own.colour = colour.or(grey).map(|colour| colour.map(shade));
                points.push(own);
                if points.len() >= GIVEN && !give(&mut points) {
                    return Ok(());
                }
            }
        }
        give(&mut points);
        Ok(())
    }
}
