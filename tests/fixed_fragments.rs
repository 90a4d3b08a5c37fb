//! Generated fragment stages against the driver's fixed-function one, pixel by pixel.
//!
//! `tests/fixed/ffcheck.c` draws each case both ways: this file writes the cases and the shaders, and judges the pictures.

use crate::fixed::check;
use crate::fixed::check::Difference;
use crate::fixed::fragments::{Fragments, case, discarding, floor};
use crate::support::share;
use manyview::fixed::{Limits, Unsupported, VertexLayer, generate, generate_fragment};
use std::path::{Path, PathBuf};

const CASES: usize = 400;

fn limits() -> Limits {
    Limits {
        gpu_shader5: true,
        vertex_layer: Some(VertexLayer::ArbShaderViewportLayerArray),
        ..Limits::default()
    }
}

fn write(directory: &Path, number: usize, case: &Fragments) {
    let shaders = generate(&case.vertex, &limits())
        .unwrap_or_else(|reason| panic!("case {number}: {reason}"));
    let patches = shaders.patches;
    let text = format!(
        "{}patch_color_sum={}\npatch_clip_distances={}\n",
        case.text,
        u8::from(patches.color_sum),
        patches.clip_distances
    );
    let put = |ending, text: &str| {
        std::fs::write(directory.join(format!("{number:04}.{ending}")), text)
            .expect("the folder can be written");
    };
    put("case", &text);
    put("vert", &shaders.vertex);
    if let Some(geometry) = &shaders.geometry {
        put("geom", geometry);
    }
    let fragment = generate_fragment(&case.key, &limits());
    put(
        "frag",
        &fragment.expect("the cases leave out what is refused"),
    );
}

/// The first `count` cases that the generator accepts: the others are drawn by the driver's own stage.
fn accepted(count: usize, make: fn(usize) -> Fragments) -> Vec<Fragments> {
    let cases = (0..).map(make);
    let defined = cases.filter(|case| match generate_fragment(&case.key, &limits()) {
        Ok(_) => true,
        Err(reason) => {
            assert_eq!(reason, Unsupported::TextureEnvironment);
            false
        }
    });
    defined.take(count).collect()
}

/// Draws cases both ways.
fn draw(cases: &[Fragments]) -> (Vec<Difference>, PathBuf) {
    let folder = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a folder");
    for (number, case) in cases.iter().enumerate() {
        write(folder.path(), number, case);
    }
    let (lines, errors) = check::run(folder.path(), cases.len());
    eprint!("{errors}");
    assert_eq!(lines.len(), cases.len(), "one line for each case");
    let found = lines.into_iter().map(|(_, found)| found).collect();
    (found, folder.keep())
}

/// Fails with the cases that do not pass; their files are kept then.
fn judge(found: &[Difference], folder: &Path, passes: impl Fn(usize, &Difference) -> bool) {
    let mut sum = Difference::default();
    found.iter().for_each(|&one| sum.add(one));
    let equal = found.iter().filter(|one| one.differ == 0).count();
    eprintln!("{equal} of {} cases are equal; {sum:?}", found.len());
    let bad: Vec<_> = found
        .iter()
        .enumerate()
        .filter(|(number, one)| !passes(*number, one))
        .map(|(number, one)| format!("{number:04} {one:?}"))
        .collect();
    assert!(
        bad.is_empty(),
        "{} of {} cases differ; files in {}\n{}",
        bad.len(),
        found.len(),
        folder.display(),
        bad.join("\n")
    );
    std::fs::remove_dir_all(folder).expect("our own folder");
}

#[test]
fn random_state_looks_like_the_fixed_stage() {
    let cases = accepted(CASES / share::every(4), case);
    let (found, folder) = draw(&cases);
    // Measured on llvmpipe 22.3.6: 382 of 400 are equal bit by bit. Fog is summed in another order than Mesa's, which multiplies its
    // factors out: one step, or two in two pixels. Lines take their gradients from the pixels beside them, where perspective is
    // extrapolated with a large rounding error: 12 pixels of lines are up to 30 steps off.
    let mut lines = Difference::default();
    for (case, &one) in cases.iter().zip(&found) {
        if case.text.contains("draw=GL_LINES") {
            lines.add(one);
        }
    }
    assert!(lines.over1 * 1_000 <= lines.covered, "{lines:?}");
    judge(&found, &folder, |number, one| {
        let line = cases[number].text.contains("draw=GL_LINES");
        let near = one.worst <= 2 && one.over1 * 10_000 <= one.pixels * 3;
        (near || line) && one.coverage == 0
    });
}

#[test]
fn gradients_of_the_windows_own_grid_are_the_drivers() {
    let mut cases = accepted(CASES / share::every(4), case);
    cases.iter_mut().for_each(|case| case.key.grid = true);
    cases.retain(|case| case.key.canonical().grid);
    let (found, folder) = draw(&cases);
    let mut sum = Difference::default();
    found.iter().for_each(|&one| sum.add(one));
    eprintln!("{:.1} dB", psnr(&sum));
    // Where a level of detail lies between two, llvmpipe's own gradients sometimes round to the other one.
    judge(&found, &folder, |_, one| {
        one.coverage == 0 && one.over8 * 10 <= one.covered
    });
    assert!(sum.over8 * 100 <= sum.covered, "{sum:?}");
}

#[test]
fn discarding_keeps_views_apart() {
    let (found, folder) = draw(&accepted(60, discarding));
    // Vertices in a tile round differently than in a window of their own: a pixel between two triangles may show either.
    judge(&found, &folder, |_, one| {
        one.over1 * 1_000 <= one.pixels && one.coverage * 10_000 <= one.pixels
    });
}

/// Floors that the test of the level of detail draws, for each filter and spacing.
const FLOORS: usize = 8;

/// Peak signal to noise ratio of red, green and blue in decibels, over the covered pixels.
fn psnr(found: &Difference) -> f64 {
    let mean = found.squares as f64 / (3 * found.covered) as f64;
    10.0 * (255.0 * 255.0 / mean).log10()
}

/// The sum of the differences of all floors with one spacing.
fn floors(spacing: u32, filter: &str, grid: bool) -> Difference {
    let mut cases: Vec<_> = (0..FLOORS)
        .map(|seed| floor(seed, spacing, filter))
        .collect();
    cases.iter_mut().for_each(|case| case.key.grid = grid);
    let (found, folder) = draw(&cases);
    std::fs::remove_dir_all(folder).expect("our own folder");
    let mut sum = Difference::default();
    found.into_iter().for_each(|one| sum.add(one));
    eprintln!(
        "{filter}, every {spacing}, gradients {grid}: {:.1} dB, {:.2} % differ, {:.2} % by more than 8",
        psnr(&sum),
        sum.differ as f64 * 100.0 / sum.covered as f64,
        sum.over8 as f64 * 100.0 / sum.covered as f64,
    );
    sum
}

/// Measured on llvmpipe 22.3.6: 59.5 dB for every eighth column, 49.2 for every second; without gradients 9.7 and 24.4.
#[test]
fn sparse_columns_have_the_windows_level_of_detail() {
    let trilinear = "GL_LINEAR_MIPMAP_LINEAR";
    for (spacing, least) in [(2, 48.0), (8, 58.0)] {
        let sum = floors(spacing, trilinear, true);
        assert!(sum.covered > 10_000, "a floor to look at");
        assert!(psnr(&sum) > least, "{spacing}: {:.1} dB", psnr(&sum));
        let without = psnr(&floors(spacing, trilinear, false));
        assert!(without < 30.0, "{spacing}: {without:.1} dB without");
    }
    // Levels are not blended: few pixels take another level, but those are far off.
    let sum = floors(8, "GL_LINEAR_MIPMAP_NEAREST", true);
    assert!(sum.over1 * 500 < sum.covered, "{sum:?}");
}
