//! PLY: the element `vertex`, text or binary. Where all its properties have one size, parts of it are read at the same time; where it has lists, in its order.

use super::blocks::Blocks;
use super::cloud::{Cloud, GIVEN, Part, Point, Up};
use super::error::{Place, ReadError};
use glam::{DVec3, Vec3};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{
    DefaultElement, ElementDef, Encoding, Header, Property, PropertyType, ScalarType,
};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

pub(super) const VERTEX: &str = "vertex";

/// What describes a file.
pub(super) struct Head {
    pub(super) header: Header,
    /// Bytes and lines of it.
    pub(super) start: u64,
    line: u64,
    /// Bytes of the file.
    length: u64,
}

impl Head {
    pub(super) fn read(path: &Path) -> Result<Self, ReadError> {
        let wrong = |error: &dyn std::fmt::Display| ReadError::new(path, Place::Header, error);
        let mut file = File::open(path).map_err(|error| wrong(&error))?;
        let length = file.metadata().map_err(|error| wrong(&error))?.len();
        let mut reader = Reader::new(BufReader::new(&mut file));
        let header = Parser::<DefaultElement>::new().read_header(&mut reader);
        let header = header.map_err(|error| {
            let text = error.to_string();
            match (error.line(), text.split_once(": ")) {
                (Some(line), Some((_, what))) => {
                    ReadError::new(path, Place::Line(line as u64), what)
                }
                _ => wrong(&text),
            }
        })?;
        let line = reader.line().saturating_sub(1) as u64;
        let start = reader.into_inner().stream_position();
        Ok(Self {
            header,
            start: start.map_err(|error| wrong(&error))?,
            line,
            length,
        })
    }

    /// Where the vertices of a binary file begin, and their stride; none where an element has lists.
    ///
    /// # Errors
    /// The file ends before the last of them.
    pub(super) fn vertices(
        &self,
        path: &Path,
        vertex: &ElementDef,
    ) -> Result<Option<(u64, u64)>, ReadError> {
        let elements = self.header.elements.iter();
        let before = elements.take_while(|(name, _)| *name != VERTEX);
        let before = before
            .map(|(_, element)| stride(element)?.checked_mul(element.count as u64))
            .try_fold(0_u64, |sum, bytes| sum.checked_add(bytes?));
        let (Some(before), Some(stride)) = (before, stride(vertex)) else {
            return Ok(None);
        };
        let start = self.start.saturating_add(before);
        let room = self.length.saturating_sub(start) / stride.max(1);
        if room < vertex.count as u64 {
            let count = vertex.count;
            let what = format!("the file ends before this point, and has {count} by its header");
            return Err(ReadError::new(path, Place::Point(room + 1), what));
        }
        Ok(Some((start, stride)))
    }
}

pub(super) fn open(path: &Path, threads: usize) -> Result<Cloud, ReadError> {
    let wrong = |error: &dyn std::fmt::Display| ReadError::new(path, Place::Header, error);
    let head = Head::read(path)?;
    let (header, start, line) = (&head.header, head.start, head.line);
    let Some(vertex) = header.elements.get(VERTEX) else {
        return Err(wrong(&"there is no element \"vertex\""));
    };
    let fields = Fields::new(vertex).map_err(|what| wrong(&what))?;
    let cloud = |parts| Cloud {
        points: Some(vertex.count as u64),
        up: Up::Y,
        parts,
    };
    if header.encoding == Encoding::Ascii {
        let elements = header.elements.iter();
        let before = elements.take_while(|(name, _)| *name != VERTEX);
        let before = before.map(|(_, element)| element.count as u64).sum();
        let text = Text {
            path: path.to_owned(),
            start,
            line,
            before,
            count: vertex.count as u64,
            fields,
        };
        return Ok(cloud(vec![Box::new(text)]));
    }
    let Some((start, stride)) = head.vertices(path, vertex)? else {
        let lists = Lists {
            path: path.to_owned(),
            start,
            header: header.clone(),
            fields,
        };
        return Ok(cloud(vec![Box::new(lists)]));
    };
    let blocks = Blocks::new(vertex.count as u64, GIVEN as u64);
    let part = || -> Box<dyn Part> {
        Box::new(Binary {
            path: path.to_owned(),
            start,
            stride,
            big: header.encoding == Encoding::BinaryBigEndian,
            blocks: blocks.clone(),
            fields: fields.clone(),
        })
    };
    Ok(cloud((0..threads).map(|_| part()).collect()))
}

fn size(kind: &ScalarType) -> u64 {
    match kind {
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    }
}

/// Bytes of an element; none where it has lists.
fn stride(element: &ElementDef) -> Option<u64> {
    let sizes = element
        .properties
        .iter()
        .map(|(_, property)| match &property.data_type {
            PropertyType::Scalar(kind) => Some(size(kind)),
            PropertyType::List(..) => None,
        });
    sizes.sum()
}

/// A property that is read: its column, the bytes before it (of an element without lists), its type.
#[derive(Clone, Debug)]
pub(super) struct Field {
    column: usize,
    pub(super) offset: u64,
    kind: ScalarType,
}

/// What is read of a vertex.
#[derive(Clone, Debug)]
struct Fields {
    place: [Field; 3],
    normal: Option<[Field; 3]>,
    colour: Option<[Field; 3]>,
    radius: Option<Field>,
    columns: usize,
}

/// The properties of an element that are numbers, by name.
pub(super) fn fields(vertex: &ElementDef) -> Vec<(&str, Field)> {
    let mut offset = 0;
    let mut known = Vec::new();
    for (column, (name, property)) in vertex.properties.iter().enumerate() {
        if let PropertyType::Scalar(kind) = &property.data_type {
            let kind = kind.clone();
            offset += size(&kind);
            let field = Field {
                column,
                offset: offset - size(&kind),
                kind,
            };
            known.push((name.as_str(), field));
        }
    }
    known
}

/// The property with a name.
pub(super) fn named(known: &[(&str, Field)], name: &str) -> Option<Field> {
    let mut all = known.iter();
    all.find(|(known, _)| *known == name)
        .map(|(_, field)| field.clone())
}

impl Fields {
    fn new(vertex: &ElementDef) -> Result<Self, String> {
        let known = fields(vertex);
        let one = |name: &str| named(&known, name);
        let three = |[a, b, c]: [&str; 3]| Some([one(a)?, one(b)?, one(c)?]);
        let place = three(["x", "y", "z"]);
        let colours = [
            ["red", "green", "blue"],
            ["diffuse_red", "diffuse_green", "diffuse_blue"],
            ["r", "g", "b"],
        ];
        Ok(Self {
            place: place.ok_or("a vertex has no x, y and z")?,
            normal: three(["nx", "ny", "nz"]),
            colour: colours.into_iter().find_map(three),
            radius: one("radius"),
            columns: vertex.properties.len(),
        })
    }

    /// A point by the values of its properties.
    fn point(&self, value: &dyn Fn(&Field) -> f64) -> Point {
        let three = |fields: &[Field; 3]| fields.each_ref().map(value);
        let shade = |field: &Field| {
            let value = value(field);
            let full = match field.kind {
                ScalarType::Float | ScalarType::Double => value * 255.0,
                ScalarType::Short | ScalarType::UShort => value / 257.0,
                _ => value,
            };
            full.round() as u8
        };
        Point {
            place: DVec3::from_array(three(&self.place)),
            normal: self.normal.as_ref().map(|normal| {
                let [x, y, z] = three(normal).map(|value| value as f32);
                Vec3::new(x, y, z)
            }),
            colour: self
                .colour
                .as_ref()
                .map(|colour| colour.each_ref().map(shade)),
            radius: self.radius.as_ref().map(|radius| value(radius) as f32),
        }
    }
}

/// Binary vertices of one size.
struct Binary {
    path: PathBuf,
    start: u64,
    stride: u64,
    big: bool,
    blocks: Blocks,
    fields: Fields,
}

impl Part for Binary {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let at = |point: u64, error| ReadError::new(&self.path, Place::Point(point + 1), error);
        let mut file = File::open(&self.path).map_err(|error| at(0, error))?;
        let (mut bytes, mut points) = (Vec::new(), Vec::new());
        while let Some(block) = self.blocks.take() {
            let start = SeekFrom::Start(self.start + block.start * self.stride);
            bytes.resize(((block.end - block.start) * self.stride) as usize, 0);
            let read = file.seek(start).and_then(|_| file.read_exact(&mut bytes));
            read.map_err(|error| at(block.start, error))?;
            for vertex in bytes.chunks_exact(self.stride as usize) {
                let value =
                    |field: &Field| scalar(&vertex[field.offset as usize..], field, self.big);
                points.push(self.fields.point(&value));
            }
            if !give(&mut points) {
                break;
            }
        }
        Ok(())
    }
}

pub(super) fn scalar(bytes: &[u8], field: &Field, big: bool) -> f64 {
    macro_rules! number {
        ($kind:ty) => {{
            let mut own = [0; size_of::<$kind>()];
            own.copy_from_slice(&bytes[..size_of::<$kind>()]);
            let value = if big {
                <$kind>::from_be_bytes(own)
            } else {
                <$kind>::from_le_bytes(own)
            };
            f64::from(value)
        }};
    }
    match field.kind {
        ScalarType::Char => number!(i8),
        ScalarType::UChar => number!(u8),
        ScalarType::Short => number!(i16),
        ScalarType::UShort => number!(u16),
        ScalarType::Int => number!(i32),
        ScalarType::UInt => number!(u32),
        ScalarType::Float => number!(f32),
        ScalarType::Double => number!(f64),
    }
}

/// Vertices in lines of text.
struct Text {
    path: PathBuf,
    start: u64,
    /// Lines of the header.
    line: u64,
    /// Lines before the vertices.
    before: u64,
    count: u64,
    fields: Fields,
}

impl Part for Text {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let wrong = |line: u64, what: &dyn std::fmt::Display| {
            ReadError::new(&self.path, Place::Line(self.line + line), what)
        };
        let mut file = File::open(&self.path).map_err(|error| wrong(0, &error))?;
        let start = file.seek(SeekFrom::Start(self.start));
        start.map_err(|error| wrong(0, &error))?;
        let mut lines = BufReader::new(file).lines();
        let (mut line, mut read, mut points) = (0, 0, Vec::new());
        while read < self.before + self.count {
            let text = lines.next().unwrap_or_else(|| {
                let what = format!("the file ends, and has {} points by its header", self.count);
                Err(std::io::Error::other(what))
            });
            line += 1;
            let text = text.map_err(|error| wrong(line, &error))?;
            if text.trim().is_empty() {
                continue;
            }
            read += 1;
            if read <= self.before {
                continue;
            }
            let mut numbers = Vec::with_capacity(self.fields.columns);
            for word in text.split_whitespace() {
                let number = word.parse::<f64>();
                numbers.push(number.map_err(|_| wrong(line, &format!("\"{word}\" is no number")))?);
            }
            let found = numbers.len();
            if found < self.fields.columns {
                let what = format!(
                    "{found} numbers, and {} properties by the header",
                    self.fields.columns
                );
                return Err(wrong(line, &what));
            }
            points.push(self.fields.point(&|field| numbers[field.column]));
            if points.len() >= GIVEN && !give(&mut points) {
                return Ok(());
            }
        }
        give(&mut points);
        Ok(())
    }
}

/// Binary vertices with lists, or after elements with such.
struct Lists {
    path: PathBuf,
    start: u64,
    header: Header,
    fields: Fields,
}

impl Part for Lists {
    fn read(&mut self, give: &mut dyn FnMut(&mut Vec<Point>) -> bool) -> Result<(), ReadError> {
        let wrong = |at, what: &dyn std::fmt::Display| ReadError::new(&self.path, at, what);
        let mut file = File::open(&self.path).map_err(|error| wrong(Place::Start, &error))?;
        let start = file.seek(SeekFrom::Start(self.start));
        start.map_err(|error| wrong(Place::Start, &error))?;
        let mut reader = BufReader::new(file);
        let parser = Parser::<DefaultElement>::new();
        let mut points = Vec::new();
        for (name, element) in &self.header.elements {
            for number in 0..element.count {
                let read = match self.header.encoding {
                    Encoding::BinaryBigEndian => {
                        parser.read_big_endian_element(&mut reader, element)
                    }
                    _ => parser.read_little_endian_element(&mut reader, element),
                };
                let at = match name.as_str() {
                    VERTEX => Place::Point(number as u64 + 1),
                    _ => Place::Header,
                };
                let values = read.map_err(|error| wrong(at, &error))?;
                if name != VERTEX {
                    continue;
                }
                let value = |field: &Field| {
                    let mut properties = element.properties.iter();
                    let name = properties.nth(field.column).map(|(name, _)| name);
                    let value = name.and_then(|name| values.get(name));
                    value.and_then(to_number).unwrap_or(f64::NAN)
                };
                points.push(self.fields.point(&value));
                if points.len() >= GIVEN && !give(&mut points) {
                    return Ok(());
                }
            }
            if name == VERTEX {
                break;
            }
        }
        give(&mut points);
        Ok(())
    }
}

fn to_number(value: &Property) -> Option<f64> {
    match value {
        Property::Double(value) => Some(*value),
        Property::Int(value) => Some(f64::from(*value)),
        Property::UInt(value) => Some(f64::from(*value)),
        small => small.to_f32_lossy().map(f64::from),
    }
}
