//! Splats that the GPU draws once for all views are those of the reference, subpixel by subpixel.

use crate::support::{succeed, target_folder};
use manyview::points::charts::Chart;
use serde_json::Value;
use std::process::Command;

/// A thousand random splats: at grazing angles, behind the viewer, at the near plane, larger than the screen.
#[test]
fn the_gpu_draws_the_splats_of_the_reference() {
    let mut probe = Command::new(target_folder().join("manyview-probe"));
    probe.arg("points").env("EGL_PLATFORM", "surfaceless");
    let output = succeed(&mut probe);
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let number = |name: &str| found[name].as_u64().expect("a number");
    assert_eq!(found["errors"], serde_json::json!([]), "{found}");
    assert_eq!(number("splats"), 1000, "{found}");
    assert!(number("refused") > 10, "{found}");
    assert!(20 * number("seen") > number("subpixels"), "{found}");
    assert!(500 * number("at_the_edge") < number("subpixels"), "{found}");
    assert_eq!(number("wrong"), 0, "{found}");
    let bound = number("together") / 5000;
    assert!(number("together_wrong") <= bound, "0.02 %: {found}");
    assert!(
        number("blended_wrong") <= number("blended") / 5000,
        "0.02 %: {found}"
    );
    assert!(number("blended") > 10_000, "{found}");
}

/// The subpixels of blended splats are those of a pass for each view. The paper's ways lose subpixels, because an image of theirs has one splat in each pixel for three views.
#[test]
fn blended_splats_are_those_of_a_pass_for_each_view() {
    let mut probe = Command::new(target_folder().join("manyview-probe"));
    probe
        .args(["points-chart", "20000", "128"])
        .env("EGL_PLATFORM", "surfaceless");
    let output = succeed(&mut probe);
    let chart: Chart = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(chart.subpixels.wrong <= 0.02, "{chart:?}");
    assert!(chart.subpixels.ssim > 0.999, "{chart:?}");
    for way in [&chart.vertex, &chart.fragment] {
        assert!((1.0..30.0).contains(&way.wrong), "{chart:?}");
    }
    // Both meet the same rays.
    let apart = (chart.vertex.wrong - chart.fragment.wrong).abs();
    assert!(apart < 0.1, "{chart:?}");
}
