//! Dithering, stacks, views of an eye, and comparison.

use super::*;
use crate::interleave::reference::linear;
use std::fs;

#[test]
fn along_any_axis_the_share_of_lit_voxels_is_the_light() {
    let screen = RotatingScreen::POPESCU;
    let lines: [fn(u32) -> [u32; 3]; 3] =
        [|i| [i, 400, 200], |i| [7, i + 100, 200], |i| [7, 400, i]];
    for colour in [[0, 60, 128], [188, 220, 255]] {
        for line in lines {
            let cells: Vec<_> = (0..256).map(line).collect();
            let lit = of_cells(&screen, &cells, colour).dithered();
            for (channel, stored) in (0..).zip(colour) {
                let on = lit.half_planes().iter().flatten();
                let on = on.filter(|lit| lit.channels >> channel & 1 == 1).count();
                let wanted = 256.0 * linear(f32::from(stored) / 255.0);
                assert!(
                    (on as f32 - wanted).abs() <= 0.5,
                    "{on} for {wanted} of {colour:?}"
                );
            }
        }
    }
}

#[test]
fn a_surface_keeps_its_mean_colour() {
    let screen = RotatingScreen::POPESCU;
    let colour = [200, 120, 60];
    let corner = |x: f32, y: f32| Vertex {
        at: [x, y, 2.0 + 0.4 * x + 0.3 * y],
        colour,
    };
    let wall = [
        [corner(-2.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0)],
        [corner(-2.0, -2.0), corner(2.0, 2.0), corner(-2.0, 2.0)],
    ];
    let volume = Volume::of_triangles(&screen, &wall).unwrap();
    let lit = volume.dithered();
    for (channel, stored) in (0..).zip(colour) {
        let on = lit.half_planes().iter().flatten();
        let on = on.filter(|lit| lit.channels >> channel & 1 == 1).count();
        let share = on as f32 / volume.len() as f32;
        let wanted = linear(f32::from(stored) / 255.0);
        assert!((share - wanted).abs() < 0.01, "{share} instead of {wanted}");
    }
}

#[test]
fn a_dark_scene_is_shown_as_bright_as_the_display_can_be() {
    let screen = RotatingScreen::POPESCU;
    let cells = |count: u32| -> Vec<_> { (0..count).map(|i| [7, i / 100, 1 + i % 100]).collect() };
    let grey = |volume: &Volume| volume.half_planes[7][0].colour;
    // A single colour: its red becomes white, and its green, which has half of that light, half as bright.
    let mut dark = of_cells(&screen, &cells(1000), [100, 72, 0]);
    let (bright, gain) = dark.clone().exposed();
    assert_eq!(grey(&bright), [255, 189, 0]);
    assert!((gain - 1.0 / linear(100.0 / 255.0)).abs() < 1e-3, "{gain}");
    // Fifty of a thousand may be brighter, and 51 may not; black ones are none of them.
    for (count, white) in [(50, 255), (51, 100)] {
        for voxel in &mut dark.half_planes[7][1000 - count..] {
            voxel.colour = [255; 3];
        }
        let (bright, _) = dark.clone().exposed();
        assert_eq!(grey(&bright)[0], white, "{count}");
        dark.half_planes[7].extend(cells(5000)[1000..].iter().map(|cell| Voxel {
            at: cell[1] * screen.columns() + cell[2],
            colour: [0; 3],
        }));
        let (bright, _) = dark.clone().exposed();
        assert_eq!(grey(&bright)[0], white, "{count} and black ones");
        dark.half_planes[7].truncate(1000);
    }
    // The darkest colour counts as well, also where some voxels are white.
    let mut darkest = of_cells(&screen, &cells(1000), [1; 3]);
    assert_eq!(grey(&darkest.clone().exposed().0), [255; 3]);
    for voxel in &mut darkest.half_planes[7][950..] {
        voxel.colour = [255; 3];
    }
    assert_eq!(grey(&darkest.exposed().0), [255; 3]);
    // Bright voxels stay the same, as do empty volumes and black ones.
    let black = of_cells(&screen, &cells(1), [0; 3]);
    assert_eq!(black.clone().exposed(), (black, 1.0));
    let light = of_cells(&screen, &cells(1000), [255, 60, 1]);
    assert_eq!(light.clone().exposed(), (light, 1.0));
    let nothing = of_cells(&screen, &[], GREY);
    assert_eq!(nothing.clone().exposed(), (nothing, 1.0));
}

/// Every fifth voxel of a ball, in a colour that is dithered.
fn ball(screen: &RotatingScreen) -> Slices {
    let mut cells = Vec::new();
    for half_plane in 0..screen.half_planes() {
        for row in 0..screen.pixels {
            for column in (half_plane + row) % 5..screen.columns() {
                let up = f64::from(row) - f64::from(screen.columns());
                if (column + row) % 5 == 0 && up.hypot(f64::from(column)) < 40.0 {
                    cells.push([half_plane, row, column]);
                }
            }
        }
    }
    of_cells(screen, &cells, [200, 120, 60]).dithered()
}

#[test]
fn a_stack_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path().join("stack");
    let slices = ball(&SMALL);
    slices.write(&stack).unwrap();
    assert_eq!(Slices::read(&stack).unwrap(), slices);
    let first = image::open(stack.join("slice-000.png"))
        .unwrap()
        .into_rgb8();
    assert_eq!(first, slices.picture(0));
    assert!(first.as_raw().contains(&255));
    assert_eq!(fs::read_dir(&stack).unwrap().count(), 41);
    // Another stack with fewer slices, of which the second half are the others turned over, replaces this one.
    let full = RotatingScreen {
        slices: 10,
        turn: Turn::Full,
        ..SMALL
    };
    let slices = ball(&full);
    slices.write(&stack).unwrap();
    assert_eq!(Slices::read(&stack).unwrap(), slices);
    assert_eq!(fs::read_dir(&stack).unwrap().count(), 11);
    let turned = image::imageops::flip_horizontal(&slices.picture(2));
    assert_eq!(slices.picture(7), turned);
}

#[test]
fn what_is_no_stack_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let slices = ball(&SMALL);
    let refused = |part: &str| {
        let message = slices.write(folder.path()).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
        assert!(
            message.contains("; name a folder that is empty"),
            "{message}"
        );
        assert!(!message.contains('\n'));
    };
    let slice = folder.path().join("slice-000.png");
    fs::write(&slice, "mine").unwrap();
    refused("it is no stack (display.toml");
    fs::remove_file(&slice).unwrap();
    let notes = folder.path().join("notes.txt");
    fs::write(&notes, "mine").unwrap();
    refused("it holds notes.txt, which is no part of a stack");
    fs::remove_file(&notes).unwrap();
    slices.write(folder.path()).unwrap();
    fs::write(&notes, "mine").unwrap();
    refused("it holds notes.txt");
    assert_eq!(
        Slices::read(folder.path()).unwrap(),
        slices,
        "left as it was"
    );
    let missing = folder.path().join("none/stack");
    assert!(slices.write(&missing).is_err());
    assert!(slices.write(&notes).is_err());
}

#[test]
fn what_is_wrong_with_a_stack_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let stack = folder.path();
    let refused = |part: &str| {
        let message = Slices::read(stack).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
        assert!(
            message.contains("; name a folder that slices were written to"),
            "{message}"
        );
        assert!(!message.contains('\n'), "{message}");
    };
    refused("display.toml: No such file");
    let screen = RotatingScreen {
        slices: 4,
        turn: Turn::Full,
        ..SMALL
    };
    let slices = ball(&screen);
    slices.write(stack).unwrap();
    let one = stack.join("slice-003.png");
    let spoil = |picture: &image::RgbImage| picture.save(&one).unwrap();
    let mut picture = slices.picture(3);
    picture.put_pixel(64, 64, image::Rgb([255, 254, 0]));
    spoil(&picture);
    refused("slice-003.png has a channel of 254");
    spoil(&image::RgbImage::new(64, 128));
    refused("slice-003.png is 64 x 128, display.toml says 128 x 128");
    spoil(&image::RgbImage::new(128, 128));
    refused("slice-003.png is not the picture of half a turn before");
    fs::remove_file(&one).unwrap();
    refused("slice-003.png: No such file");
    let display = stack.join("display.toml");
    let text = fs::read_to_string(&display).unwrap();
    fs::write(&display, text.replace("pixels = 128", "pixels = 127")).unwrap();
    refused("the display's pixels is 127; give an even number");
    fs::write(&display, text.replace("full", "third")).unwrap();
    refused("display.toml: unknown variant `third`");
}

fn sight(eye: [f64; 3]) -> Sight {
    let size = [400, 300];
    let sphere = false;
    Sight { eye, size, sphere }
}

/// The centroid of the light in a picture, as x and y from the picture's middle.
fn middle(picture: &image::RgbImage) -> [f64; 2] {
    let (mut sum, mut weights) = ([0.0; 2], 0.0);
    for (x, y, pixel) in picture.enumerate_pixels() {
        let weight = f64::from(linear(f32::from(pixel.0[0]) / 255.0));
        sum[0] += weight * (f64::from(x) + 0.5 - f64::from(picture.width()) / 2.0);
        sum[1] += weight * (f64::from(y) + 0.5 - f64::from(picture.height()) / 2.0);
        weights += weight;
    }
    sum.map(|sum| sum / weights)
}

#[test]
fn a_voxel_is_seen_in_perspective() {
    let screen = RotatingScreen::POPESCU;
    // Straight towards the viewer, and above the middle.
    let cell = [99, 284, 299];
    let at = 284 * screen.columns() + 299;
    let point = screen.centre(99, at);
    assert!(
        point[0].abs() < 1e-9 && point[1] > 1.29 && point[2] > 3.89,
        "{point:?}"
    );
    let slices = of_cells(&screen, &[cell], [255; 3]).dithered();
    for eye in [
        [0.0, 0.0, 50.0],
        [-4.0, 0.0, 50.0],
        [50.0, 0.0, 0.0],
        [0.0, 50.0, 0.0],
        [3.0, -8.0, -30.0],
    ] {
        // The pinhole by its definition: divided by the distance along the axis, from the plane in which tangents of the sphere are
        // measured.
        let length = |v: [f64; 3]| v.iter().map(|part| part * part).sum::<f64>().sqrt();
        let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let far = length(eye);
        let forward = eye.map(|part| -part / far);
        let level = eye[0].hypot(eye[2]);
        let right = match level > 0.0 {
            true => [eye[2] / level, 0.0, -eye[0] / level],
            false => [1.0, 0.0, 0.0],
        };
        let up = match level > 0.0 {
            true => {
                let tilt = -eye[1] / far;
                [eye[0] / level * tilt, level / far, eye[2] / level * tilt]
            }
            false => [0.0, 0.0, -1.0],
        };
        let towards = [0, 1, 2].map(|i| point[i] - eye[i]);
        let depth = dot(towards, forward);
        let scale = 0.96 * 150.0 * (far * far - 25.0_f64).sqrt() / 5.0;
        let wanted = [
            scale * dot(towards, right) / depth,
            -scale * dot(towards, up) / depth,
        ];
        let seen = middle(&sight(eye).see(&slices).unwrap());
        for (seen, wanted) in seen.into_iter().zip(wanted) {
            assert!(
                (seen - wanted).abs() < 0.3,
                "{eye:?}: {seen} instead of {wanted}"
            );
        }
    }
}

#[test]
fn light_is_added_and_nothing_hidden() {
    let screen = RotatingScreen::POPESCU;
    let light = |cells: &[[u32; 3]]| {
        let slices = of_cells(&screen, cells, [255; 3]).dithered();
        let seen = sight([0.0, 0.0, 50.0]).see(&slices).unwrap();
        let values = seen
            .pixels()
            .map(|pixel| linear(f32::from(pixel.0[1]) / 255.0));
        (values.clone().fold(0.0, f32::max), values.sum::<f32>())
    };
    // A line towards the viewer through the middle falls on one pixel; another voxel is the reference.
    let beside = [0, 300, 200];
    let (white, one) = light(&[beside, [99, 384, 100]]);
    assert!(white > 0.99, "the brightest is white");
    let (_, more) = light(&[beside, [99, 384, 100], [99, 384, 101], [297, 384, 100]]);
    // With an exposure for three voxels in one pixel, the single one is a third as bright.
    assert!((one / more / 1.5 - 1.0).abs() < 0.3, "{one} and {more}");
    assert_eq!(light(&[]).1, 0.0, "nothing is black");
}

#[test]
fn the_sphere_fits_into_the_picture() {
    let empty = of_cells(&SMALL, &[], GREY).dithered();
    for eye in [[0.0, 0.0, 50.0], [0.0, 6.0, 0.0], [-4.0, 4.0, 8.0]] {
        let seen = Sight {
            sphere: true,
            ..sight(eye)
        }
        .see(&empty)
        .unwrap();
        let rows = seen
            .enumerate_pixels()
            .filter(|(_, _, pixel)| pixel.0[0] > 0);
        let (least, most) = rows.fold((300, 0), |(least, most), (_, y, _)| {
            (least.min(y), most.max(y))
        });
        assert!(least >= 5 && most <= 294, "{least} to {most}");
    }
    let whole = Sight {
        sphere: true,
        ..sight([0.0, 0.0, 50.0])
    };
    let lit = whole.see(&empty).unwrap();
    assert!(
        lit.get_pixel(200, 7).0[0] > 0 || lit.get_pixel(200, 6).0[0] > 0,
        "up to its top"
    );
}

#[test]
fn an_eye_in_the_display_is_refused() {
    let slices = of_cells(&SMALL, &[], GREY).dithered();
    for eye in [
        [0.0; 3],
        [0.0, 0.0, 5.1],
        [f64::NAN, 0.0, 50.0],
        [f64::INFINITY, 0.0, 0.0],
    ] {
        let message = sight(eye).see(&slices).unwrap_err().to_string();
        assert!(
            message.contains("give a place at least 5.25 in"),
            "{message}"
        );
    }
    let flat = Sight {
        size: [0, 5],
        ..sight([0.0, 0.0, 50.0])
    };
    assert!(flat.see(&slices).is_err());
}

#[test]
fn differences_are_counted_by_voxels() {
    let plate = |row: u32, colour: u8| {
        let cells =
            (30..50).flat_map(|half_plane| (20..30).map(move |column| [half_plane, row, column]));
        of_cells(&SMALL, &cells.collect::<Vec<_>>(), [colour; 3])
    };
    let own = plate(60, 100);
    let between =
        |other: &Volume, eyes: &[[f64; 3]]| Difference::between(&own, other, eyes).unwrap();
    let same = Difference {
        seen: 200,
        drawn: 200,
        ..Difference::default()
    };
    assert_eq!(between(&own, &[]), same);
    let lighter = between(&plate(60, 110), &[]);
    assert_eq!(
        lighter,
        Difference {
            colour: 10.0,
            ..same
        }
    );
    let beside = between(&plate(61, 100), &[]);
    let off = Difference {
        missing: 200,
        extra: 200,
        ..same
    };
    assert_eq!(beside, off);
    let away = between(&plate(62, 100), &[]);
    let apart = Difference {
        lost: 200,
        wrong: 200,
        ..off
    };
    assert_eq!(away, apart);
    // Neighbours across sectors, also across the first one.
    let turned = |half_plane| of_cells(&SMALL, &[[half_plane, 60, 20]], GREY);
    for (from, to, lost) in [(30, 31, 0), (0, 79, 0), (79, 0, 0), (30, 32, 1), (1, 79, 1)] {
        let off = Difference::between(&turned(from), &turned(to), &[]).unwrap();
        assert_eq!(
            [off.missing, off.lost, off.wrong],
            [1, lost, lost],
            "{from} to {to}"
        );
    }
    // Seen from above, a plate hides a smaller one under it.
    let smaller =
        (33..47).flat_map(|half_plane| (23..27).map(move |column| [half_plane, 90, column]));
    let both: Vec<_> = cells(&own).into_iter().chain(smaller).collect();
    let both = of_cells(&SMALL, &both, GREY);
    let hidden = Difference::between(&both, &own, &[[0.0, 50.0, 0.0]]).unwrap();
    assert_eq!([hidden.seen, hidden.missing], [200, 0], "{hidden:?}");
    let seen = Difference::between(&both, &own, &[[0.0, -50.0, 0.0], [0.0, 50.0, 0.0]]).unwrap();
    assert_eq!(
        [seen.seen, seen.missing, seen.lost],
        [256, 56, 56],
        "{seen:?}"
    );
}
