//! Makes point clouds of any size, for measurements: `cloud knot|land POINTS FILE.ply|las|laz`, or Gaussians: `cloud gaussians COUNT FILE.ply`. The same arguments
//! make the same file.

use glam::{DVec3, Vec3};
use manyview_points::random::Random;
use std::f64::consts::TAU;
use std::fs::File;
use std::io::{BufWriter, Write};

type Failure = Box<dyn std::error::Error>;

/// A point of a tube about a trefoil knot, about 6 wide.
fn knot(random: &mut Random, _: f64) -> (DVec3, [u8; 3]) {
    let (along, around) = (random.unit() * TAU, random.unit() * TAU);
    let middle = |t: f64| {
        let r = (3.0 * t).cos() + 2.0;
        DVec3::new(r * (2.0 * t).cos(), r * (2.0 * t).sin(), -(3.0 * t).sin())
    };
    let ahead = (middle(along + 1e-4) - middle(along)).normalize();
    let u = ahead.cross(DVec3::new(0.3, 0.5, 0.8)).normalize();
    let place = middle(along) + 0.4 * (u * around.cos() + ahead.cross(u) * around.sin());
    let shade = |angle: f64| (127.0 + 127.0 * angle.cos()) as u8;
    (
        place,
        [shade(along), shade(along + 2.1), shade(5.0 * around)],
    )
}

/// A point of hills, 1 km wide, as an aeroplane scans them: in stripes.
fn land(random: &mut Random, share: f64) -> (DVec3, [u8; 3]) {
    let stripes = 40.0;
    let stripe = (share * stripes).floor();
    let x = (stripe + random.unit()) / stripes;
    let y = share * stripes - stripe;
    let wave = |fx: f64, fy: f64| (x * fx * TAU).sin() * (y * fy * TAU + fx).cos();
    let height =
        60.0 * wave(1.0, 1.3) + 20.0 * wave(3.7, 2.9) + 4.0 * wave(17.0, 13.0) + wave(61.0, 71.0);
    // Trees on some of it.
    let tree = if wave(5.0, 7.0) > 0.3 {
        random.unit() * 12.0
    } else {
        0.0
    };
    let green = (90.0 + height * 0.8 + tree * 4.0).clamp(30.0, 255.0) as u8;
    let colour = [
        (120.0 + height).clamp(20.0, 230.0) as u8,
        green,
        if tree > 0.0 { 40 } else { 90 },
    ];
    (
        DVec3::new(
            500_000.0 + x * 1000.0,
            5_200_000.0 + y * 1000.0,
            400.0 + height + tree,
        ),
        colour,
    )
}

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [shape, count, file] = words.as_slice() else {
        return Err("usage: cloud knot|land|gaussians POINTS FILE.ply|las|laz".into());
    };
    let point = match shape.as_str() {
        "knot" | "gaussians" => knot,
        "land" => land,
        _ => return Err("the shape is knot, land or gaussians".into()),
    };
    let count: u64 = count.parse()?;
    let mut random = Random::new(1);
    let mut points = (0..count).map(|n| point(&mut random, n as f64 / count as f64));
    if shape == "gaussians" {
        write_gaussians(file, count, &mut points)
    } else if file.ends_with(".ply") {
        write_ply(file, count, &mut points)
    } else {
        write_las(file, &mut points)
    }
}

fn write_ply(
    file: &str,
    count: u64,
    points: &mut dyn Iterator<Item = (DVec3, [u8; 3])>,
) -> Result<(), Failure> {
    let mut out = BufWriter::new(File::create(file)?);
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    )?;
    for (place, colour) in points {
        let place: Vec3 = place.as_vec3();
        for value in place.to_array() {
            out.write_all(&value.to_le_bytes())?;
        }
        out.write_all(&colour)?;
    }
    Ok(out.flush()?)
}

/// Flat Gaussians about as large as the way to the next one, in colours of degree 3, as 3D Gaussian Splatting writes them.
fn write_gaussians(
    file: &str,
    count: u64,
    points: &mut dyn Iterator<Item = (DVec3, [u8; 3])>,
) -> Result<(), Failure> {
    let mut out = BufWriter::new(File::create(file)?);
    let mut names: Vec<String> = ["x", "y", "z"].map(str::to_owned).to_vec();
    let mut add =
        |name: &str, numbers: u32| names.extend((0..numbers).map(|n| format!("{name}{n}")));
    add("f_dc_", 3);
    add("f_rest_", 45);
    add("scale_", 3);
    add("rot_", 4);
    names.push("opacity".to_owned());
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\n"
    )?;
    for name in names {
        writeln!(out, "property float {name}")?;
    }
    writeln!(out, "end_header")?;
    let mut random = Random::new(2);
    // The tube has an area of about 50.
    let size = (50.0 / count as f64).sqrt().ln() as f32;
    for (place, colour) in points {
        let mut values = place.as_vec3().to_array().to_vec();
        let shade = Vec3::from_array(colour.map(|value| f32::from(value) / 255.0));
        values.extend(((shade - 0.5) / 0.282_094_8).to_array());
        values.extend((0..45).map(|_| (random.unit() as f32 - 0.5) * 0.1));
        values.extend([size, size, size - 1.5]);
        values.extend((0..4).map(|_| random.unit() as f32 - 0.5));
        values.push(2.0);
        for value in values {
            out.write_all(&value.to_le_bytes())?;
        }
    }
    Ok(out.flush()?)
}

fn write_las(
    file: &str,
    points: &mut dyn Iterator<Item = (DVec3, [u8; 3])>,
) -> Result<(), Failure> {
    let mut builder = las::Builder::from((1, 2));
    builder.point_format = las::point::Format::new(2)?;
    builder.point_format.is_compressed = file.ends_with(".laz");
    // So that places of both shapes fit into 32 bits.
    let mut points = points.peekable();
    let near = points
        .peek()
        .map_or(DVec3::ZERO, |(place, _)| place.round());
    let axis = |offset| las::Transform {
        scale: 0.001,
        offset,
    };
    builder.transforms = las::Vector {
        x: axis(near.x),
        y: axis(near.y),
        z: axis(near.z),
    };
    let mut writer = las::Writer::from_path(file, builder.into_header()?)?;
    for (place, colour) in points {
        let [r, g, b] = colour.map(|value| u16::from(value) * 257);
        writer.write_point(las::Point {
            x: place.x,
            y: place.y,
            z: place.z,
            color: Some(las::Color::new(r, g, b)),
            ..Default::default()
        })?;
    }
    Ok(writer.close()?)
}
