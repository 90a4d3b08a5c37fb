use super::{Place, Point, ReadError, gaussians, open};
use crate::random::Random;
use glam::{DVec3, Quat, Vec3};
use std::io::Write;
use std::path::Path;
use tempfile::NamedTempFile;

fn file(bytes: &[u8]) -> NamedTempFile {
    let mut file = NamedTempFile::new().expect("a file");
    file.write_all(bytes).expect("written");
    file
}

/// All points, and the fault at the end.
fn read(path: &Path) -> (Vec<Point>, Option<ReadError>) {
    let mut all = Vec::new();
    let cloud = match open(path, 2) {
        Ok(cloud) => cloud,
        Err(error) => return (all, Some(error)),
    };
    for mut part in cloud.parts {
        let read = part.read(&mut |points| {
            all.append(points);
            true
        });
        if let Err(error) = read {
            return (all, Some(error));
        }
    }
    (all, None)
}

fn whole(bytes: &[u8]) -> Vec<Point> {
    let (points, fault) = read(file(bytes).path());
    assert!(fault.is_none(), "{fault:?}");
    points
}

fn fault(bytes: &[u8]) -> (Place, String) {
    let (_, fault) = read(file(bytes).path());
    let fault = fault.expect("a fault");
    (fault.at, fault.what)
}

const ASCII: &str = "ply\nformat ascii 1.0\nelement other 1\nproperty list uchar int a\nelement vertex 2\nproperty float x\nproperty double y\nproperty float z\n\
property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty float radius\nend_header\n";

#[test]
fn text_of_ply() {
    let points = whole(
        format!("{ASCII}2 7 8\n1 2 3 0 0 2 255 128 0 0.5\n4 5 6 1 0 0 1 2 3 0.25\n").as_bytes(),
    );
    let first = Point {
        place: DVec3::new(1.0, 2.0, 3.0),
        colour: Some([255, 128, 0]),
        normal: Some(Vec3::new(0.0, 0.0, 2.0)),
        radius: Some(0.5),
    };
    assert_eq!(points[0], first);
    assert_eq!(points[1].place, DVec3::new(4.0, 5.0, 6.0));
}

#[test]
fn faults_of_text_have_their_line() {
    let start = format!("{ASCII}2 7 8\n1 2 3 0 0 2 255 128 0 0.5\n");
    let lines = ASCII.lines().count() as u64;
    let (at, what) = fault(format!("{start}4 5 x 1 0 0 1 2 3 0.25\n").as_bytes());
    assert_eq!(
        (at, what.as_str()),
        (Place::Line(lines + 3), "\"x\" is no number")
    );
    let (at, what) = fault(format!("{start}4 5 6\n").as_bytes());
    assert_eq!(at, Place::Line(lines + 3), "{what}");
    let (at, what) = fault(start.as_bytes());
    assert_eq!(at, Place::Line(lines + 3), "{what}");
    assert!(what.contains("2 points"), "{what}");
}

/// Binary PLY with more vertices than a block has.
fn binary(big: bool, list: bool, count: u32) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let extra = if list {
        "property list uchar short extra\n"
    } else {
        "property short extra\n"
    };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex {count}\n{extra}property double x\nproperty float y\nproperty int z\n\
         property ushort red\nproperty ushort green\nproperty ushort blue\nend_header\n"
    )
    .into_bytes();
    for n in 0..count {
        if list {
            bytes.push(1);
        }
        macro_rules! put {
            ($value:expr) => {
                bytes.extend(if big {
                    $value.to_be_bytes()
                } else {
                    $value.to_le_bytes()
                })
            };
        }
        put!(-1_i16);
        put!(f64::from(n) + 0.1);
        put!(n as f32 * 2.0);
        put!(-(n as i32));
        for _ in 0..3 {
            put!(0x8080_u16);
        }
    }
    bytes
}

#[test]
fn binary_ply_in_both_orders_and_with_lists() {
    for (big, list) in [(false, false), (true, false), (false, true), (true, true)] {
        let mut points = whole(&binary(big, list, 40_000));
        points.sort_by(|a, b| a.place.x.total_cmp(&b.place.x));
        assert_eq!(points.len(), 40_000);
        for (n, point) in points.iter().enumerate() {
            let n = n as f64;
            let place = DVec3::new(n + 0.1, n * 2.0, -n);
            assert_eq!((point.place, point.colour), (place, Some([128; 3])));
        }
    }
}

#[test]
fn a_file_that_is_cut_off_is_refused_with_the_place() {
    let bytes = binary(false, false, 1000);
    let (at, what) = fault(&bytes[..bytes.len() - 1]);
    assert_eq!(at, Place::Point(1000), "{what}");
    let lists = binary(false, true, 1000);
    let (at, what) = fault(&lists[..lists.len() - 1]);
    assert_eq!(at, Place::Point(1000), "{what}");
    for cut in [3, 10, 60] {
        let (at, what) = fault(&bytes[..cut]);
        assert!(matches!(at, Place::Line(1..=6)), "{at}: {what}");
    }
}

#[test]
fn ply_without_places_is_refused() {
    let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n";
    assert_eq!(
        fault(text.as_bytes()),
        (Place::Header, "a vertex has no x, y and z".to_owned())
    );
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty float x\nend_header\n1\n";
    assert_eq!(fault(text.as_bytes()).0, Place::Header);
}

#[test]
fn lines_of_text() {
    let points =
        whole(b"x,y,z\n# comment\n1,2,3\n4 5 6 10 20 30\n7;8;9;100;1;2;3\n\n1 2 3 0.5 -0.5 0\n");
    let seen: Vec<_> = points
        .iter()
        .map(|p| (p.place.x, p.colour, p.normal))
        .collect();
    let normal = Some(Vec3::new(0.5, -0.5, 0.0));
    let want = [
        (1.0, None, None),
        (4.0, Some([10, 20, 30]), None),
        (7.0, Some([1, 2, 3]), None),
        (1.0, None, normal),
    ];
    assert_eq!(seen, want);
    assert_eq!(
        fault(b"1 2 3\n1 2\n"),
        (
            Place::Line(2),
            "2 numbers are no place; three are".to_owned()
        )
    );
    assert_eq!(
        fault(b"1 2 3\n1 2 three\n"),
        (Place::Line(2), "\"three\" is no number".to_owned())
    );
    assert_eq!(fault(b"# nothing\n").0, Place::Line(2));
    assert_eq!(fault(&[b'1'; 10_000]).0, Place::Line(1));
    assert_eq!(fault(b"\0\0\0").0, Place::Start);
}

fn las_bytes(compressed: bool, count: u32) -> Vec<u8> {
    let mut builder = las::Builder::from((1, 4));
    builder.point_format = las::point::Format::new(2).expect("a format");
    builder.point_format.is_compressed = compressed;
    let header = builder.into_header().expect("a header");
    let cursor = std::io::Cursor::new(Vec::new());
    let mut writer = las::Writer::new(cursor, header).expect("a writer");
    for n in 0..count {
        let point = las::Point {
            x: f64::from(n),
            y: 2.0,
            z: -3.0,
            color: Some(las::Color::new(0x1010, 0x2020, n as u16)),
            ..Default::default()
        };
        writer.write_point(point).expect("written");
    }
    writer.close().expect("closed");
    writer.into_inner().expect("bytes").into_inner()
}

#[test]
fn las_and_laz() {
    for compressed in [false, true] {
        let mut points = whole(&las_bytes(compressed, 120_000));
        points.sort_by(|a, b| a.place.x.total_cmp(&b.place.x));
        assert_eq!(points.len(), 120_000);
        for (n, point) in points.iter().enumerate() {
            assert_eq!(point.place, DVec3::new(n as f64, 2.0, -3.0));
            let [r, g, b] = point.colour.expect("a colour");
            assert_eq!((r, g, b), (16, 32, ((n as u16) / 257) as u8));
        }
    }
}

#[test]
fn las_that_is_cut_off_is_refused_with_the_place() {
    for compressed in [false, true] {
        let bytes = las_bytes(compressed, 120_000);
        let (at, what) = fault(&bytes[..bytes.len() * 3 / 4]);
        assert!(
            matches!(at, Place::Point(_) | Place::Header),
            "{at}: {what}"
        );
        assert_eq!(fault(&bytes[..100]).0, Place::Header);
    }
}

#[test]
fn pcd() {
    let header = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4\nTYPE F F F U F F F\nCOUNT 1 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\n\
                  VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
    let points =
        whole(format!("{header}DATA ascii\n1 2 3 1122867 0 1 0\n4 5 6 0 1 0 0\n").as_bytes());
    assert_eq!(points[0].place, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(points[0].colour, Some([0x11, 0x22, 0x33]));
    assert_eq!(points[0].normal, Some(Vec3::Y));
    assert_eq!(points[1].place, DVec3::new(4.0, 5.0, 6.0));
    let (at, what) =
        fault(format!("{header}DATA ascii\n1 2 3 1122867 0 1 0\n4 5 x 0 1 0 0\n").as_bytes());
    assert_eq!(at, Place::Point(2), "{what}");
    assert_eq!(fault(b"# .PCD v0.7\nFIELDS x\n").0, Place::Header);
}

fn e57_bytes() -> Vec<u8> {
    let file = NamedTempFile::new().expect("a file");
    let mut writer = e57::E57Writer::from_file(file.path(), "file").expect("a writer");
    let prototype = vec![
        e57::Record::CARTESIAN_X_F64,
        e57::Record::CARTESIAN_Y_F64,
        e57::Record::CARTESIAN_Z_F64,
        e57::Record::COLOR_RED_U8,
        e57::Record::COLOR_GREEN_U8,
        e57::Record::COLOR_BLUE_U8,
    ];
    let mut scan = writer.add_pointcloud("scan", prototype).expect("a scan");
    for n in 0..3000 {
        let values = [f64::from(n), 2.0, 3.0].map(e57::RecordValue::Double);
        let colour = [10, 200, 255].map(e57::RecordValue::Integer);
        let point = values.into_iter().chain(colour).collect();
        scan.add_point(point).expect("a point");
    }
    scan.finalize().expect("a scan");
    writer.finalize().expect("a file");
    std::fs::read(file.path()).expect("bytes")
}

/// A file with a few bytes changed, left out or doubled, most of them where formats have their headers.
fn spoil(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let mut spoilt = bytes.to_vec();
    for _ in 0..=random.below(4) {
        let end = match random.below(3) {
            0 => spoilt.len(),
            _ => spoilt.len().min(600),
        };
        let at = random.below(end);
        match random.below(8) {
            0 => spoilt.truncate(at),
            1 => drop(spoilt.drain(at..(at + random.below(40)).min(spoilt.len()))),
            2 => {
                let part = spoilt[at..(at + random.below(40)).min(spoilt.len())].to_vec();
                spoilt.splice(at..at, part);
            }
            3 => spoilt.splice(at..at, *b"9999999999").for_each(drop),
            4 | 5 if !spoilt.is_empty() => {
                spoilt[at] = [0, 255, 127, 128, b'-', b'9', b' '][random.below(7)]
            }
            _ if !spoilt.is_empty() => spoilt[at] ^= 1 << random.below(8),
            _ => {}
        }
    }
    spoilt
}

const GAUSSIAN: [&str; 14] = [
    "x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
    "rot_0", "rot_1", "rot_2", "rot_3",
];

fn gaussian_bytes(values: &[f32; 14], count: u32) -> Vec<u8> {
    let properties: String = GAUSSIAN
        .iter()
        .map(|name| format!("property float {name}\n"))
        .collect();
    let head = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {count}\n{properties}end_header\n"
    );
    let mut bytes = head.into_bytes();
    for value in values.repeat(count as usize) {
        bytes.extend(value.to_le_bytes());
    }
    bytes
}

#[test]
fn gaussians_have_exponents_and_a_logistic_opacity() {
    let values = [
        1.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.0, 0.0, 1.0, -1.0, 2.0, 0.0, 0.0, 0.0,
    ];
    let file = file(&gaussian_bytes(&values, 3));
    let read = gaussians(file.path(), 1 << 20)
        .expect("read")
        .expect("Gaussians");
    assert_eq!((read.all.len(), read.coefficients, read.skipped), (3, 1, 0));
    let one = read.all[1];
    assert_eq!((one.place, one.opacity), (Vec3::new(1.0, 2.0, 3.0), 0.5));
    let e = std::f32::consts::E;
    assert!((one.scale - Vec3::new(1.0, e, 1.0 / e)).length() < 1e-6);
    assert_eq!(
        (one.rotation, read.colour(1)),
        (Quat::IDENTITY, &[Vec3::new(0.1, 0.2, 0.3)][..])
    );
    let little = gaussians(file.path(), 100).expect_err("no memory").what;
    assert!(little.contains("--memory"), "{little}");
}

#[test]
fn gaussians_that_are_nowhere_are_left_out_and_other_files_are_none() {
    let mut values = [0.0; 14];
    let read = |bytes: &[u8]| gaussians(file(bytes).path(), 1 << 20);
    // Without a direction; then too faint; then with a place that is no number.
    for (at, value) in [(0, 0.0), (6, -9.0), (1, f32::NAN)] {
        values[at] = value;
        values[10] = if at == 0 { 0.0 } else { 1.0 };
        let all = read(&gaussian_bytes(&values, 2))
            .expect("read")
            .expect("Gaussians");
        assert_eq!((all.all.len(), all.skipped), (0, 2), "{at}");
    }
    assert!(read(&binary(false, false, 3)).expect("read").is_none());
    assert!(read(b"1 2 3").expect("read").is_none());
    let whole = gaussian_bytes(&values, 2);
    let cut = read(&whole[..whole.len() - 1]).expect_err("cut off");
    assert_eq!(cut.at, Place::Point(2));
}

/// How many files of each format are spoilt.
fn spoilt_files(count: u32) {
    let pcd = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ";
    let mut binary_pcd = format!("{pcd}binary\n").into_bytes();
    binary_pcd.extend([0x3f; 32]);
    let formats = [
        (
            "ply",
            format!("{ASCII}2 7 8\n1 2 3 0 0 2 255 128 0 0.5\n4 5 6 1 0 0 1 2 3 0.25\n")
                .into_bytes(),
        ),
        ("binary ply", binary(false, false, 50)),
        ("ply with lists", binary(true, true, 50)),
        (
            "text",
            b"1,2,3\n4 5 6 10 20 30\n7;8;9;100;1;2;3\n1 2 3 0.5 -0.5 0\n".to_vec(),
        ),
        ("las", las_bytes(false, 50)),
        ("laz", las_bytes(true, 50)),
        (
            "pcd",
            format!("{pcd}ascii\n1 2 3 4\n5 6 7 8\n").into_bytes(),
        ),
        ("binary pcd", binary_pcd),
        ("e57", e57_bytes()),
        ("gaussians", gaussian_bytes(&[0.5; 14], 30)),
    ];
    let mut random = Random::new(2026);
    for (name, bytes) in formats {
        let mut refused = 0;
        for _ in 0..count {
            let spoilt = spoil(&mut random, &bytes);
            let (_, fault) = read(file(&spoilt).path());
            let _ = gaussians(file(&spoilt).path(), 1 << 28);
            if let Some(fault) = fault {
                refused += 1;
                assert!(
                    !fault.what.is_empty() && !fault.what.contains('\n'),
                    "{name}: {fault}"
                );
            }
        }
        assert!(refused > count / 10, "{name}: {refused} of {count}");
    }
}

#[test]
fn spoilt_files_are_refused_or_read() {
    spoilt_files(300);
}

#[test]
#[ignore = "more than a minute: make test-long"]
fn many_spoilt_files_are_refused_or_read() {
    spoilt_files(100_000);
}

#[test]
fn e57() {
    let bytes = e57_bytes();
    let points = whole(&bytes);
    assert_eq!(points.len(), 3000);
    assert_eq!(points[7].place, DVec3::new(7.0, 2.0, 3.0));
    assert_eq!(points[7].colour, Some([10, 200, 255]));
    let (at, what) = fault(&bytes[..bytes.len() / 2]);
    assert_eq!(at, Place::Header, "{what}");
    // A byte in the middle of the points.
    let mut spoilt = bytes.clone();
    spoilt[30_000] ^= 0x55;
    let (at, what) = fault(&spoilt);
    assert!(matches!(at, Place::Point(_)), "{at}: {what}");
}
