//! LAS and LAZ.

use super::blocks::Blocks;
use super::cloud::{Cloud, Part, Point, Up};
use super::error::{Place, ReadError};
use glam::DVec3;
use las::{PointData, Reader};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Points of a chunk of LAZ, after which it can be read from any other: what most programs write.
const BLOCK: u64 = 50_000;
/// Bytes of a compressed point; the largest format has 67, and programs add some of their own.
const LONGEST: u64 = 2000;

pub(super) fn open(path: &Path, threads: usize) -> Result<Cloud, ReadError> {
    let wrong = |error: &dyn std::fmt::Display| ReadError::new(path, Place::Header, error);
    let bytes = check_places(path).map_err(|error| wrong(&error))?;
    let mut reader = Reader::from_path(path).map_err(|error| wrong(&error))?;
    let points = reader.header().number_of_points();
    let format = reader.header().point_format();
    let (record, is_compressed) = (u64::from(format.len()), format.is_compressed);
    if is_compressed && record > LONGEST {
        return Err(wrong(&format!(
            "a point of {record} bytes is more than a point can have"
        )));
    }
    let room = bytes / record.max(1);
    if !is_compressed && room < points {
        let what = format!("the file ends before this point, and has {points} by its header");
        return Err(ReadError::new(path, Place::Point(room + 1), what));
    }
    // Many files hold colours of 8 bits in the 16 that the format has. The first points tell.
    let first = reader.read_points(BLOCK.min(points));
    let first = first.map_err(|error| ReadError::new(path, Place::Point(1), error))?;
    let colours = first.rgb().into_iter().flatten();
    let shade = colours.map(|(r, g, b)| r.max(g).max(b)).max();
    let bright = first.intensity().max().unwrap_or(0);
    let scale = Scale {
        colour: shade
            .filter(|&most| most > 0)
            .map(|most| if most > 255 { 257 } else { 1 }),
        intensity: bright.max(1),
    };
    let blocks = Blocks::new(points, BLOCK);
    let part = || -> Box<dyn Part> {
        Box::new(Las {
            path: path.to_owned(),
            blocks: blocks.clone(),
            scale,
        })
    };
    Ok(Cloud {
        points: Some(points),
        up: Up::Z,
        parts: (0..threads).map(|_| part()).collect(),
    })
}

/// Refuses points that begin behind the end of the file, and a table of the chunks of LAZ that is larger than the file: the library would ask for as much memory.
/// Returns the bytes from the first point to the end.
fn check_places(path: &Path) -> io::Result<u64> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut start = [0; FORMAT + 1];
    if length < start.len() as u64 {
        return Ok(0);
    }
    file.read_exact(&mut start)?;
    let mut word = [0; 4];
    word.copy_from_slice(&start[POINTS..POINTS + 4]);
    let points = u64::from(u32::from_le_bytes(word));
    if points > length {
        return Err(io::Error::other(
            "the points are behind the end of the file",
        ));
    }
    let bytes = length - points;
    if start[FORMAT] & COMPRESSED == 0 {
        return Ok(bytes);
    }
    let mut place = [0; 8];
    file.seek(SeekFrom::Start(points))?;
    file.read_exact(&mut place)?;
    let mut table = u64::from_le_bytes(place);
    if table == u64::MAX {
        // A writer that could not go back has put it at the end.
        file.seek(SeekFrom::End(-8))?;
        file.read_exact(&mut place)?;
        table = u64::from_le_bytes(place);
    }
    let mut head = [0; 8];
    if table > length {
        return Err(io::Error::other(
            "the table of chunks is behind the end of the file",
        ));
    }
    file.seek(SeekFrom::Start(table))?;
    file.read_exact(&mut head)?;
    word.copy_from_slice(&head[4..]);
    let chunks = u64::from(u32::from_le_bytes(word));
    if chunks > length {
        return Err(io::Error::other(format!(
            "{chunks} chunks are more than the file can have"
        )));
    }
    Ok(bytes)
}

/// Where a file says where its points begin, and in which format they are (LAS 1.4, table 3).
const POINTS: usize = 96;
const FORMAT: usize = 104;
/// Of the format, for LAZ.
const COMPRESSED: u8 = 0x80;

#[derive(Clone, Copy)]
struct Scale {
    /// What a colour is divided by; none where there is no colour.
    colour: Option<u16>,
    /// What is white.
    intensity: u16,
}

struct Las {
    path: PathBuf,
    blocks: Blocks,
    scale: Scale,
}

impl Part for Las {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let wrong = |point: u64, error: &dyn std::fmt::Display| {
            ReadError::new(&self.path, Place::Point(point + 1), error)
        };
        let mut reader = Reader::from_path(&self.path).map_err(|error| wrong(0, &error))?;
        let mut points = Vec::new();
        while let Some(block) = self.blocks.take() {
            let seek = reader.seek(block.start);
            seek.map_err(|error| wrong(block.start, &error))?;
            let data = reader.read_points(block.end - block.start);
            let data = data.map_err(|error| wrong(block.start, &error))?;
            if (data.len() as u64) < block.end - block.start {
                let end = block.start + data.len() as u64;
                return Err(wrong(end, &"the file ends before this point"));
            }
            convert(&data, self.scale, &mut points);
            if !give(&mut points) {
                break;
            }
        }
        Ok(())
    }
}

fn convert(data: &PointData, scale: Scale, points: &mut Vec<Point>) {
    let places = data.x().zip(data.y()).zip(data.z());
    let start = points.len();
    points.extend(places.map(|((x, y), z)| Point::at(DVec3::new(x, y, z))));
    let points = &mut points[start..];
    match (scale.colour, data.rgb()) {
        (Some(divisor), Some(colours)) => {
            for (point, (r, g, b)) in points.iter_mut().zip(colours) {
                point.colour = Some([r, g, b].map(|value| (value / divisor).min(255) as u8));
            }
        }
        _ => {
            for (point, value) in points.iter_mut().zip(data.intensity()) {
                let share = f32::from(value) / f32::from(scale.intensity);
                // The eye sees a share of the light more brightly than it is.
                let grey = (share.min(1.0).sqrt() * 255.0) as u8;
                point.colour = (scale.intensity > 1).then_some([grey; 3]);
            }
        }
    }
}
