//! The scene of a program, by samples whose places are known.

use super::super::{Before, Head, Samples, Source};
use super::*;

/// 4x3 pixels, 1/w = depth. A wall at 1/4, before which two pixels of the second row are at 1/2. The reference image has the wall behind
/// the left one of them, moved by a pixel to the left, and lacks the pixel in the upper left corner.
fn shown() -> Samples {
    let wall = vec![0.25_f32; 12];
    let mut own = wall.clone();
    (own[5], own[6]) = (0.5, 0.5);
    let mut reference = own.clone();
    reference[0] = 1.0;
    reference[4] = 0.25;
    let mut moved = vec![0.0; 12];
    moved[4] = -1.0;
    let colours = |depths: &[f32]| depths.iter().flat_map(|d| [(d * 200.0) as u8; 3]).collect();
    Samples {
        head: Head {
            size: [4, 3],
            viewport: [0, 0, 4, 3],
            line: [1.0, 0.0],
            before: None,
            clear: 1.0,
            focal: 4.0,
        },
        own: (colours(&own), own),
        reference: (colours(&reference), reference),
        moved,
    }
}

/// The samples in the image, z in hundredths of an inch.
fn samples(shown: &Samples, source: Source, focal: bool) -> Vec<[i32; 3]> {
    let image = shown.image(&SMALL, source, focal).unwrap();
    let samples = image.samples().iter().flatten();
    let place = |sample: &Sample| sample.at.map(|v| (v * 100.0).round() as i32);
    samples.map(place).collect()
}

#[test]
fn a_file_comes_back_as_it_was() {
    let shown = shown();
    let bytes = shown.bytes();
    assert_eq!(Samples::read(&bytes).unwrap(), shown);
    for wrong in [&bytes[..bytes.len() - 1], &bytes[..20], &bytes[1..], b""] {
        let message = Samples::read(wrong).unwrap_err().to_string();
        assert!(message.contains("nothing to make slices of"), "{message}");
    }
    let message = Samples::read(&Samples::nothing("it rains; wait")).unwrap_err();
    assert!(message.to_string().ends_with("it rains; wait"), "{message}");
}

#[test]
fn hidden_samples_are_in_the_reference_image_where_they_would_be_seen() {
    let own = samples(&shown(), Source::Own, false);
    assert_eq!(own.len(), 12);
    assert!(own.iter().all(|at| [-250, 250].contains(&at[2])), "{own:?}");
    // As far out as its occluder, seen from the viewer: 52.5 over 47.5.
    let place = f64::from(own[5][0]) * 52.5 / 47.5;
    let behind = |all: &[[i32; 3]]| {
        let near = |at: &[i32; 3]| (f64::from(at[0]) - place).abs() < 2.0 && at[1..] == [0, -250];
        all.iter().any(near)
    };
    assert!(!behind(&own));
    let both = samples(&shown(), Source::Reference, false);
    assert!(behind(&both), "{both:?}");
    // The corner, and the samples that make room for the hidden one, come from the own view.
    assert!(both.contains(&own[0]), "{both:?}");
}

#[test]
fn an_image_over_another_one_is_not_joined_to_it() {
    let square = |z: f32| {
        let corner = |x: f32, y: f32| Sample {
            at: [x, y, z],
            colour: GREY,
            joined: Joined::Both,
        };
        let samples = [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0], [1.0, 0.0]];
        let samples = samples.map(|[x, y]| Some(corner(x, y)));
        ReferenceImage::new([2, 2], samples.to_vec()).unwrap()
    };
    let both = square(1.0).over(square(-1.0));
    assert_eq!(both.size(), [2, 4]);
    let wanted = [square(1.0).triangles(), square(-1.0).triangles()].concat();
    assert_eq!(both.triangles(), wanted);
}

#[test]
fn zero_parallax_stands_in_the_plane_of_the_axis() {
    let all = samples(&shown(), Source::Own, true);
    let depths: Vec<i32> = all.iter().map(|at| at[2]).collect();
    assert!(depths.contains(&0) && depths.contains(&250), "{depths:?}");
}

#[test]
fn what_stands_before_everything_has_distances_of_its_own() {
    let mut shown = shown();
    shown.head.before = Some(Before {
        line: [1.5, 0.0],
        to: 0.45,
    });
    shown.head.focal = 2.0;
    // From 1/2 to 3/4, the axis at 1/2: the wall at 1/4 is as far behind.
    let image = shown.image(&SMALL, Source::Own, true).unwrap();
    let z = |at: usize| image.samples()[at].unwrap().at[2];
    assert!(z(0) < -2.0 && z(5) > 2.0, "{} {}", z(0), z(5));
}

#[test]
fn a_picture_without_depths_is_refused() {
    let mut shown = shown();
    shown.own.1 = vec![1.0; 12];
    let message = shown.image(&SMALL, Source::Own, false).unwrap_err();
    assert!(
        message.to_string().contains("give another frame"),
        "{message}"
    );
}
