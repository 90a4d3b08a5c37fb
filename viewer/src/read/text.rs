//! Text with a point in each line (XYZ, PTS, ASC, CSV): three coordinates, which red, green and blue may follow, or an intensity and these.

use super::cloud::{Cloud, GIVEN, Part, Point, Up};
use super::error::{Place, ReadError};
use glam::DVec3;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

/// More than any point needs: a file without ends of lines is not read as one.
const LONGEST_LINE: usize = 4096;

pub(super) fn open(path: &Path) -> Result<Cloud, ReadError> {
    let no = |error| ReadError::new(path, Place::Start, error);
    let mut part = Text {
        path: path.to_owned(),
        lines: BufReader::new(File::open(path).map_err(no)?),
        line: 0,
        first: None,
    };
    // The first point tells whether it is such a file at all.
    part.first = part.next()?;
    if part.first.is_none() {
        let what = "there is no line with three numbers";
        return Err(ReadError::new(path, Place::Line(part.line), what));
    }
    Ok(Cloud {
        points: None,
        up: Up::Z,
        parts: vec![Box::new(part)],
    })
}

struct Text {
    path: PathBuf,
    lines: BufReader<File>,
    /// The last one that was read.
    line: u64,
    first: Option<Point>,
}

impl Text {
    /// The next point; none at the end.
    fn next(&mut self) -> Result<Option<Point>, ReadError> {
        let mut text = Vec::new();
        loop {
            text.clear();
            self.line += 1;
            let at = Place::Line(self.line);
            let wrong = |what: &dyn std::fmt::Display| ReadError::new(&self.path, at, what);
            let mut limited = std::io::Read::take(&mut self.lines, LONGEST_LINE as u64);
            let read = limited.read_until(b'\n', &mut text);
            if read.map_err(|error| wrong(&error))? == 0 {
                return Ok(None);
            }
            if text.len() == LONGEST_LINE {
                return Err(wrong(&"the line is too long for a point"));
            }
            let text = String::from_utf8_lossy(&text);
            let text = text.trim();
            let is_comment = text.starts_with(['#', '/', ';', '%']);
            let words: Vec<&str> = words(text).collect();
            let numbers: Result<Vec<f64>, _> = words.iter().map(|word| word.parse()).collect();
            match numbers {
                _ if text.is_empty() || is_comment => {}
                // The names of the columns.
                Err(_) if self.line == 1 => {}
                // PTS files begin with the number of their points.
                Ok(numbers) if numbers.len() == 1 => {}
                Ok(numbers) if numbers.len() >= 3 => return Ok(Some(point(&numbers))),
                Ok(numbers) => {
                    let what = format!("{} numbers are no place; three are", numbers.len());
                    return Err(wrong(&what));
                }
                Err(_) => {
                    let bad = words.iter().find(|word| word.parse::<f64>().is_err());
                    let what = format!("\"{}\" is no number", bad.unwrap_or(&""));
                    return Err(wrong(&what));
                }
            }
        }
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let apart = |c: char| c.is_whitespace() || c == ',' || c == ';';
    text.split(apart).filter(|word| !word.is_empty())
}

fn point(numbers: &[f64]) -> Point {
    let mut point = Point::at(DVec3::new(numbers[0], numbers[1], numbers[2]));
    let rest = &numbers[3..];
    // Three more are a colour; of four, the first is an intensity.
    let colour = match rest.len() {
        0..3 => None,
        3 | 6.. => rest.get(..3),
        _ => rest.get(1..4),
    };
    let whole = |value: &f64| (0.0..=255.0).contains(value) && value.fract() == 0.0;
    match colour {
        Some(colour) if colour.iter().all(whole) => {
            point.colour = Some([colour[0], colour[1], colour[2]].map(|value| value as u8));
        }
        // Fractions about zero: a normal.
        Some(normal) if rest.len() != 4 => {
            point.normal = Some(DVec3::new(normal[0], normal[1], normal[2]).as_vec3());
        }
        _ => {}
    }
    if let (None, Some(normal)) = (point.normal, rest.get(3..6)) {
        point.normal = Some(DVec3::new(normal[0], normal[1], normal[2]).as_vec3());
    }
    point
}

impl Part for Text {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let mut points: Vec<Point> = self.first.take().into_iter().collect();
        loop {
            let next = self.next();
            let is_last = !matches!(next, Ok(Some(_)));
            if let Ok(Some(point)) = next {
                points.push(point);
            }
            if (is_last || points.len() >= GIVEN) && !give(&mut points) {
                return Ok(());
            }
            match next {
                Ok(Some(_)) => {}
                Ok(None) => return Ok(()),
                Err(error) => return Err(error),
            }
        }
    }
}
