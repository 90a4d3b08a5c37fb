//! `manyview simulate` from its user's side.

use crate::support::{manyview, refused, run};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// A folder with the picture of a panel: 5 grey views, the darker the farther left.
fn panel_of_greys() -> tempfile::TempDir {
    let folder = tempdir().expect("a folder");
    let grey = |x: u32, _| image::Luma([50 * (x % 5) as u8]);
    let picture = image::GrayImage::from_fn(200, 40, grey);
    picture
        .save(folder.path().join("panel.png"))
        .expect("saved");
    folder
}

#[test]
fn an_eye_sees_its_view() {
    let folder = panel_of_greys();
    let simulate = |rest: &[&str]| {
        let arguments = ["simulate", "--display", "lenticular-5", "--in", "panel.png"];
        let (code, stdout, stderr) = run(manyview()
            .current_dir(&folder)
            .args(arguments)
            .args(["--out", "seen.png", "--crosstalk", "0"])
            .args(rest));
        assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
        assert_eq!(stderr, "manyview: wrote seen.png\n");
        let seen = image::open(folder.path().join("seen.png"));
        seen.expect("a picture").into_rgb8()
    };
    let seen = simulate(&["--eye", "0,0,600"]);
    assert_eq!(seen.dimensions(), (200, 40));
    assert_eq!(seen.get_pixel(100, 20).0, [100; 3], "view 2");
    // The zone is 2 · 600 mm · tan(cone / 2) wide.
    let seen = simulate(&["--eye", "-175,0,600mm"]);
    assert_eq!(seen.get_pixel(100, 20).0, [0; 3], "view 0");
    let seen = simulate(&["--eye", "-43,0,600", "--cone", "10", "--width", "300"]);
    assert_eq!(seen.get_pixel(100, 20).0, [0; 3], "view 0");
    let seen = simulate(&["--eye", "0,0,300", "--design", "600", "--dpi", "20"]);
    let greens = [60, 140].map(|x| seen.get_pixel(x, 20).0[1]);
    assert_eq!(greens, [150, 50], "views 3 and 1 at the ends of the panel");

    let seen = simulate(&["--eye", "0,0,600", "--strip", "5"]);
    assert_eq!(seen.dimensions(), (1000, 40));
    for view in 0..5 {
        let pixel = seen.get_pixel(200 * view + 100, 20).0;
        assert_eq!(pixel, [50 * view as u8; 3], "view {view}");
    }
}

#[test]
fn what_cannot_be_simulated_is_one_line_and_status_2() {
    let folder = panel_of_greys();
    let place = |name: &str| {
        let path = folder.path().join(name);
        path.to_str().expect("UTF-8").to_owned()
    };
    let (panel, out, mask) = (place("panel.png"), place("seen.png"), place("mask.png"));
    fs::write(place("text.png"), "no picture").expect("written");
    let (code, ..) = run(manyview().args(["mask", "--size", "9x9", "--out", &mask]));
    assert_eq!(code, 0);
    let with = |eye: &str, picture: &str, out: &str, rest: &[&str], part: &str| {
        let arguments = ["simulate", "--eye", eye, "--in", picture, "--out", out];
        refused(&[&arguments, rest].concat(), 2, part);
    };
    let options = |rest: &[&str], part: &str| with("0,0,600", &panel, &out, rest, part);
    for eye in ["", "left", "0,600", "0,0,nan", "0,0,0,600"] {
        with(eye, &panel, &out, &[], "such as -32,0,600");
    }
    with("0,0,0", &panel, &out, &[], "give a larger Z");
    with("0,0,-600", &panel, &out, &[], "-600 mm before the panel");
    with("0,0,600", &place("none.png"), &out, &[], "No such file");
    with(
        "0,0,600",
        &place("text.png"),
        &out,
        &[],
        "give an 8-bit PNG",
    );
    with("0,0,600", &mask, &out, &[], "16 bits per channel");
    with(
        "0,0,600",
        &panel,
        "no-such-folder/a.png",
        &[],
        "there is no folder",
    );
    options(&["--display", &mask], "says nothing of lenses");
    options(&["--display", "no-such-panel"], "--display: ");
    options(&["--views", "0"], "--views is '0'");
    options(
        &["--crosstalk", "1.5"],
        "--crosstalk is '1.5'; give a share",
    );
    options(&["--crosstalk", "-0.1"], "from 0 to 1");
    options(&["--cone", "180"], "1 to 170 degrees");
    options(&["--dpi", "0"], "pixels per inch");
    options(&["--width", "wide"], "the width in mm");
    options(
        &["--width", "500", "--dpi", "96"],
        "either --width or --dpi",
    );
    options(&["--design", "0"], "above 0 in mm");
    options(&["--design", "0.5"], "the distance of design is 0.5 mm");
    options(&["--strip", "0"], "1 to 256");
    options(&["--strip", "many"], "a whole number of eyes");
    assert!(!Path::new(&out).exists(), "nothing is written");
}
