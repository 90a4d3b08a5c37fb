//! Pictures whose distance is known.
#![forbid(unsafe_code)]

use super::*;

const SKY: Rgb<u8> = Rgb([10, 20, 30]);

fn noise(width: u32, height: u32) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let bits = (x * 7919 + y * 104_729 + 13).wrapping_mul(2_654_435_761);
        Rgb([
            (bits >> 8) as u8 / 2 + 40,
            (bits >> 16) as u8 / 2 + 40,
            (bits >> 24) as u8 / 2 + 40,
        ])
    })
}

/// The picture with the first `count` pixels' green raised by `by`.
fn raised(picture: &RgbImage, count: usize, by: u8) -> RgbImage {
    let mut out = picture.clone();
    for pixel in out.pixels_mut().take(count) {
        pixel.0[1] += by;
    }
    out
}

fn compare(a: &RgbImage, b: &RgbImage) -> Comparison {
    Comparison::new(a, b, Some(SKY)).unwrap()
}

#[test]
fn equal_pictures_are_equal() {
    let got = compare(&noise(33, 21), &noise(33, 21));
    assert!(got.is_equal() && got.psnr == f64::INFINITY && (got.ssim - 1.0).abs() < 1e-12);
    assert_eq!(
        (got.pixels, got.worst, got.outliers, got.wrong_subpixels),
        (693, 0, 0, 0)
    );
    assert_eq!(Gate::EQUAL.check(&got), Ok(()));
}

#[test]
fn counts_and_psnr() {
    let a = RgbImage::from_pixel(10, 10, Rgb([100; 3]));
    let mut b = a.clone();
    b.put_pixel(0, 0, Rgb([101, 100, 98]));
    b.put_pixel(5, 5, Rgb([109, 100, 100]));
    b.put_pixel(9, 9, Rgb([100, 108, 100]));
    let got = compare(&a, &b);
    assert_eq!((got.differing, got.wrong_subpixels, got.worst), (3, 4, 9));
    assert_eq!(
        (got.over_one, got.over_eight, got.coverage, got.outliers),
        (3, 1, 0, 1)
    );
    // (1 + 4 + 81 + 64) / 300 = 1/2
    assert!((got.psnr - 10.0 * (65025.0f64 * 2.0).log10()).abs() < 1e-12);
    assert!((got.differing_fraction() - 0.03).abs() < 1e-12);
    assert!((got.wrong_subpixels_percent() - 4.0 / 3.0).abs() < 1e-12);
    assert_eq!(
        [0, 1, 7, 8, 9].map(|t| pixels_over(&a, &b, t)),
        [3, 3, 2, 1, 0]
    );
}

#[test]
fn coverage_counts_even_small_differences() {
    let sky = RgbImage::from_pixel(4, 4, SKY);
    let mut b = sky.clone();
    b.put_pixel(1, 1, Rgb([11, 20, 30]));
    b.put_pixel(2, 2, Rgb([200, 20, 30]));
    let got = compare(&sky, &b);
    assert_eq!((got.coverage, got.over_eight, got.outliers), (2, 1, 2));
    assert_eq!(compare(&b, &sky).coverage, 2);
    assert_eq!(Comparison::new(&sky, &b, None).unwrap().coverage, 0);
}

#[test]
fn ssim_of_flat_pictures_is_the_luminance_term() {
    let flat = |v| RgbImage::from_pixel(20, 13, Rgb([v; 3]));
    let (a, b) = (100.0, 150.0);
    let c1 = 6.5025;
    let expected = (2.0 * a * b + c1) / (a * a + b * b + c1);
    assert!((compare(&flat(100), &flat(150)).ssim - expected).abs() < 1e-9);
}

#[test]
fn ssim_of_one_window_by_hand() {
    // Luma alternates between 0 and 200, against 0 and 100: means 100 and 50, variances 10000 and 2500, covariance 5000.
    let stripes = |v: u8| RgbImage::from_fn(8, 8, |x, _| Rgb([if x % 2 == 0 { 0 } else { v }; 3]));
    let (c1, c2) = (6.5025, 58.5225);
    let expected = (10_000.0 + c1) * (10_000.0 + c2) / ((12_500.0 + c1) * (12_500.0 + c2));
    assert!((compare(&stripes(200), &stripes(100)).ssim - expected).abs() < 1e-9);
    // The last columns are measured although 4 does not divide 21.
    let mut edge = noise(21, 8);
    edge.put_pixel(20, 7, Rgb([255; 3]));
    assert!(compare(&noise(21, 8), &edge).ssim < 0.999_999);
    assert!(compare(&noise(64, 64), &raised(&noise(64, 64), 4096, 1)).ssim > 0.99);
}

#[test]
fn the_gate_is_inclusive() {
    // 0.03 % of 10,000 pixels are 3.
    let a = noise(100, 100);
    assert_eq!(Gate::DESIGN.check(&compare(&a, &raised(&a, 3, 8))), Ok(()));
    let error = Gate::DESIGN
        .check(&compare(&a, &raised(&a, 4, 1)))
        .unwrap_err();
    assert_eq!(
        error,
        GateError::Differing {
            found: 4,
            allowed: 3,
            pixels: 10_000,
            worst: 1
        }
    );
    // 2 pixels per 10^6 round up to 1.
    assert_eq!(Gate::DESIGN.check(&compare(&a, &raised(&a, 1, 9))), Ok(()));
    assert!(matches!(
        Gate::DESIGN.check(&compare(&a, &raised(&a, 2, 9))),
        Err(GateError::Outliers {
            found: 2,
            over_eight: 2,
            coverage: 0,
            allowed: 1,
            ..
        })
    ));
    assert_eq!(Gate::STRICT.check(&compare(&a, &raised(&a, 3, 1))), Ok(()));
    assert!(matches!(
        Gate::STRICT.check(&compare(&a, &raised(&a, 2, 2))),
        Err(GateError::OverOne {
            found: 2,
            allowed: 1,
            ..
        })
    ));
    let one = noise(3000, 500);
    assert_eq!(
        Gate::DESIGN.check(&compare(&one, &raised(&one, 3, 200 - 167))),
        Ok(())
    );
    assert!(
        Gate::DESIGN
            .check(&compare(&one, &raised(&one, 4, 33)))
            .is_err()
    );
    assert!(Gate::EQUAL.check(&compare(&a, &raised(&a, 1, 1))).is_err());
    // Small pictures have to be equal.
    let small = noise(50, 50);
    assert!(
        Gate::DESIGN
            .check(&compare(&small, &raised(&small, 1, 1)))
            .is_err()
    );
}

#[test]
fn coverage_is_gated() {
    let sky = RgbImage::from_pixel(100, 100, SKY);
    assert_eq!(
        Gate::DESIGN.check(&compare(&sky, &raised(&sky, 1, 1))),
        Ok(())
    );
    let error = Gate::DESIGN
        .check(&compare(&sky, &raised(&sky, 2, 1)))
        .unwrap_err();
    assert!(matches!(
        error,
        GateError::Outliers {
            coverage: 2,
            over_eight: 0,
            ..
        }
    ));
}

#[test]
fn triptychs_show_all_three() {
    let a = RgbImage::from_pixel(3, 2, Rgb([100; 3]));
    let mut b = a.clone();
    b.put_pixel(1, 0, Rgb([101, 100, 250]));
    let got = triptych(&a, &b);
    assert_eq!(got.dimensions(), (17, 2));
    let at = |x, y| got.get_pixel(x, y).0;
    assert_eq!(
        [at(1, 0), at(8, 0), at(15, 0)],
        [[100; 3], [80, 0, 255], [101, 100, 250]]
    );
    assert_eq!(
        [at(3, 1), at(7, 1), at(13, 1)],
        [[128; 3], [0; 3], [128; 3]]
    );
    let odd = triptych(&a, &RgbImage::new(4, 1));
    assert_eq!(odd.dimensions(), (20, 2));
    assert_eq!(odd.get_pixel(8, 1).0, [255, 0, 255]);
    assert_eq!(
        triptych(&RgbImage::new(0, 0), &RgbImage::new(0, 0)).height(),
        0
    );
}

#[test]
fn messages() {
    let a = noise(100, 100);
    let sky = RgbImage::from_pixel(100, 100, SKY);
    let gate = |gate: Gate, a: &RgbImage, count, by| {
        gate.check(&compare(a, &raised(a, count, by)))
            .unwrap_err()
            .to_string()
    };
    let said = [
        Comparison::new(&a, &noise(100, 99), None)
            .unwrap_err()
            .to_string(),
        Comparison::new(&noise(0, 0), &noise(0, 0), None)
            .unwrap_err()
            .to_string(),
        gate(Gate::DESIGN, &a, 4, 1),
        gate(Gate::STRICT, &a, 2, 2),
        gate(Gate::DESIGN, &sky, 2, 9),
    ];
    insta::assert_snapshot!(said.join("\n"));
}
