//! PLY files of Gaussians, as 3D Gaussian Splatting writes them.

use super::caught::catch;
use super::error::{Place, ReadError};
use super::ply::{Field, Head, VERTEX, fields, named, scalar};
use crate::gaussian::{Gaussian, Gaussians, MOST_COEFFICIENTS};
use glam::{Quat, Vec3};
use ply_rs_bw::ply::Encoding;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// Reads a file of Gaussians. None where it is a file of another kind.
///
/// # Errors
/// It is not as its header says, it is text, or its Gaussians need more bytes of memory than there may be.
pub fn gaussians(path: &Path, memory: u64) -> Result<Option<Gaussians>, ReadError> {
    let mut start = [0; 3];
    let is_ply = File::open(path)
        .and_then(|mut file| file.read_exact(&mut start))
        .is_ok();
    if !is_ply || start != *b"ply" {
        return Ok(None);
    }
    catch(path, || Place::Header, || read(path, memory))
}

/// The columns of a Gaussian.
struct Columns {
    place: [Field; 3],
    scale: [Field; 3],
    rotation: [Field; 4],
    opacity: Field,
    /// Red, green and blue of each coefficient.
    colour: Vec<[Field; 3]>,
}

fn read(path: &Path, memory: u64) -> Result<Option<Gaussians>, ReadError> {
    let head = Head::read(path)?;
    let Some(vertex) = head.header.elements.get(VERTEX) else {
        return Ok(None);
    };
    let known = fields(vertex);
    let one = |name: &str| named(&known, name);
    let Some(columns) = columns(&one) else {
        return Ok(None);
    };
    let wrong = |what: &dyn std::fmt::Display| ReadError::new(path, Place::Header, what);
    let places = match head.header.encoding {
        Encoding::Ascii => None,
        _ => head.vertices(path, vertex)?,
    };
    let Some((start, stride)) = places else {
        return Err(wrong(
            &"Gaussians as text or with lists are not read; write them as binary PLY",
        ));
    };
    let coefficients = columns.colour.len();
    let bytes = size_of::<Gaussian>() + coefficients * size_of::<Vec3>();
    let needed = (bytes as u64).saturating_mul(vertex.count as u64);
    if needed > memory {
        let (needed, memory) = (needed >> 20, memory >> 20);
        let what = format!("its Gaussians need {needed} MiB, and a half of --memory is {memory}");
        return Err(wrong(&what));
    }
    let big = head.header.encoding == Encoding::BinaryBigEndian;
    let mut file = File::open(path).map_err(|error| wrong(&error))?;
    file.seek(SeekFrom::Start(start))
        .map_err(|error| wrong(&error))?;
    let mut reader = BufReader::new(file);
    let mut bytes = vec![0; stride as usize];
    let mut read = Gaussians {
        coefficients,
        ..Gaussians::default()
    };
    for number in 0..vertex.count as u64 {
        let at = Place::Point(number + 1);
        reader
            .read_exact(&mut bytes)
            .map_err(|error| ReadError::new(path, at, error))?;
        let value = |field: &Field| scalar(&bytes[field.offset as usize..], field, big) as f32;
        let gaussian = columns.gaussian(&value);
        if gaussian.is_seen() {
            read.all.push(gaussian);
            let colour = columns.colour.iter();
            read.colours
                .extend(colour.map(|rgb| Vec3::from_array(rgb.each_ref().map(&value))));
        } else {
            read.skipped += 1;
        }
    }
    Ok(Some(read))
}

fn columns(one: &dyn Fn(&str) -> Option<Field>) -> Option<Columns> {
    let three = |name: &str| {
        Some([
            one(&format!("{name}0"))?,
            one(&format!("{name}1"))?,
            one(&format!("{name}2"))?,
        ])
    };
    let mut colour = vec![three("f_dc_")?];
    // The rest is all of red, then all of green, then all of blue.
    let rest = (0..)
        .take_while(|n| one(&format!("f_rest_{n}")).is_some())
        .count();
    let each = rest / 3;
    let whole = [0, 3, 8, 15]
        .into_iter()
        .rev()
        .find(|whole| *whole <= each)?;
    for n in 0..whole.min(MOST_COEFFICIENTS - 1) {
        let of = |channel: usize| one(&format!("f_rest_{}", channel * each + n));
        colour.push([of(0)?, of(1)?, of(2)?]);
    }
    Some(Columns {
        place: [one("x")?, one("y")?, one("z")?],
        scale: three("scale_")?,
        rotation: [one("rot_0")?, one("rot_1")?, one("rot_2")?, one("rot_3")?],
        opacity: one("opacity")?,
        colour,
    })
}

impl Columns {
    fn gaussian(&self, value: &dyn Fn(&Field) -> f32) -> Gaussian {
        let three = |fields: &[Field; 3]| Vec3::from_array(fields.each_ref().map(value));
        let [w, x, y, z] = self.rotation.each_ref().map(value);
        Gaussian {
            place: three(&self.place),
            // The files have logarithms, and the opacity before the logistic function.
            scale: three(&self.scale).exp(),
            rotation: Quat::from_xyzw(x, y, z, w).normalize(),
            opacity: 1.0 / (1.0 + (-value(&self.opacity)).exp()),
        }
    }
}
