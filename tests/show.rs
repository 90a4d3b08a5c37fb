//! `manyview calibrate show`: the pixels of its window, its keys, its file.

use crate::support::x::{SHIFT, User};
use crate::support::{Screen, manyview, own_screen, refused, rgb, run};
use image::{ImageReader, Rgb, RgbImage};
use manyview::calibrate::{Action, ByEye};
use manyview::display::{Display, Kind, LensPart, Number, Slanted};
use manyview::simulate::{Eye, Optics, Setup, see};
use std::io::{BufRead, BufReader, Lines};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const LIMIT: Duration = Duration::from_secs(60);
const UP: u32 = 0xff52;
const LEFT: u32 = 0xff51;
const PAGE_UP: u32 = 0xff55;
const ESCAPE: u32 = 0xff1b;

/// Size of Xvfb's only monitor.
const MONITOR: (u32, u32) = (1920, 1200);

/// A window that shows a pattern, and the user before it.
struct Shown {
    child: Child,
    lines: Lines<BufReader<ChildStdout>>,
    user: User,
    window: u32,
}

impl Shown {
    fn start(screen: &Screen, arguments: &[&str]) -> Self {
        let mut command = manyview();
        command
            .args(["calibrate", "show"])
            .args(arguments)
            .stdout(Stdio::piped());
        let mut child = screen.give(&mut command).spawn().expect("it starts");
        let user = User::at(screen.display());
        let limit = Instant::now() + LIMIT;
        let window = loop {
            if let Some(window) = user.window("manyview calibrate") {
                break window;
            }
            assert!(Instant::now() < limit, "a window");
            std::thread::sleep(Duration::from_millis(10));
        };
        let lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
        Shown {
            child,
            lines,
            user,
            window,
        }
    }

    /// The next line of its output; the picture is then on the screen.
    fn line(&mut self) -> String {
        self.lines.next().expect("a line").expect("text")
    }

    /// The pixels of the window; the rest of the monitor is black.
    #[track_caller]
    fn same(&self, expected: &RgbImage, what: &str) {
        let mut whole = RgbImage::new(MONITOR.0, MONITOR.1);
        image::imageops::replace(&mut whole, expected, 0, 0);
        let shown = self.user.picture(self.window);
        assert_eq!(shown.dimensions(), MONITOR, "{what}");
        let differ = shown.pixels().zip(whole.pixels()).filter(|(a, b)| a != b);
        assert_eq!(differ.count(), 0, "{what}: pixels that differ");
    }

    fn end(mut self, key: u32) {
        self.user.press(&[key]);
        assert_eq!(self.child.wait().expect("it ends").code(), Some(0));
    }
}

/// The picture of a mask file, with a colour for each view.
fn through(mask: &Path, colour: impl Fn(u16) -> [u8; 3]) -> RgbImage {
    let mask = ImageReader::open(mask)
        .expect("a mask")
        .decode()
        .expect("PNG")
        .into_rgb16();
    RgbImage::from_fn(mask.width(), mask.height(), |x, y| {
        let views = mask.get_pixel(x, y).0;
        Rgb([0, 1, 2].map(|c: usize| colour(views[c])[c]))
    })
}

fn white(wanted: u16) -> impl Fn(u16) -> [u8; 3] {
    move |view| if view == wanted { [255; 3] } else { [0; 3] }
}

/// A panel file with entries that have to be kept, and the folder of its masks.
struct Panel {
    folder: TempDir,
}

impl Panel {
    fn new() -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let text = "name = \"Mine\"\nkind = \"slanted\"\nviews = 7\npitch = 5.333\nslant = 0.25\noffset = 0.5\norder = \"bgr\"\n\
                    colour-offsets = [0, 0.125, 0.25]\nrotation = 180\nscreen = \"640x400\"\ndpi = 96\ncone = 30\nquilt = \"7x1\"\n\
                    [bias]\ncolumns = 2\nrows = 2\nvalues = [0, 0.25, 0, 0.25]\n";
        std::fs::write(folder.path().join("panel.toml"), text).expect("written");
        Panel { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        self.path(name).to_str().expect("UTF-8").to_owned()
    }

    /// The mask that the command writes for a panel file.
    fn mask(&self, file: &str) -> PathBuf {
        let out = self.path("mask.png");
        let mut command = manyview();
        command.args([
            "mask",
            "--display",
            &self.text(file),
            "--size",
            "640x400",
            "--out",
        ]);
        let (code, _, errors) = run(command.arg(&out));
        assert_eq!(code, 0, "{errors}");
        out
    }
}

#[test]
fn the_pattern_on_the_screen_is_the_one_of_the_file() {
    let screen = own_screen();
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("pattern.png");
    for (size, shown) in [(Some("640x400"), "640x400"), (None, "1920x1200")] {
        let sheet = ["--pitch", "8.7", "--slant=-0.66", "--views", "8"];
        let mut command = manyview();
        command
            .args(["calibrate", "pattern", "--size", shown, "--out"])
            .arg(&out)
            .args(sheet);
        assert_eq!(run(&mut command).0, 0);
        let size = size.map(|size| ["--size", size]);
        let arguments: Vec<_> = sheet
            .into_iter()
            .chain(size.into_iter().flatten())
            .collect();
        let window = Shown::start(&screen, &arguments);
        let expected = rgb(&out);
        let limit = Instant::now() + LIMIT;
        // The pattern does not change, so the command prints no line to wait for.
        while window
            .user
            .picture(window.window)
            .pixels()
            .all(|p| p.0 == [0; 3])
        {
            assert!(Instant::now() < limit, "a picture");
            std::thread::sleep(Duration::from_millis(20));
        }
        window.same(&expected, shown);
        window.end(u32::from(b'q'));
    }
}

#[test]
fn keys_change_the_sheet_and_the_picture_and_the_file_has_it() {
    let screen = own_screen();
    let panel = Panel::new();
    let (before, out) = (panel.text("panel.toml"), panel.text("out.toml"));
    let mut window = Shown::start(&screen, &["--display", &before, "--out", &out]);
    assert_eq!(
        window.line(),
        "pitch 5.333  slant 0.25  offset 0.5  inverted false  view 3 of 7 white"
    );
    window.same(&through(&panel.mask("panel.toml"), white(3)), "as it was");

    // Steps for 640x400: one press changes the pitch by 0.0148, the slant by 0.0133, the offset by 5.3.
    window.user.press(&[UP]);
    assert!(
        window
            .line()
            .starts_with("pitch 5.334  slant 0.25  offset 0.5 ")
    );
    window.user.press(&[SHIFT, UP]);
    assert!(
        window
            .line()
            .starts_with("pitch 5.344  slant 0.25  offset 0.5 ")
    );
    window.user.press(&[SHIFT, PAGE_UP]);
    assert!(
        window
            .line()
            .starts_with("pitch 5.344  slant 0.26  offset 0.5 ")
    );
    window.user.press(&[LEFT]);
    assert!(
        window
            .line()
            .starts_with("pitch 5.344  slant 0.26  offset -0.5 ")
    );
    window.user.press(&[u32::from(b's')]);
    assert!(window.line().starts_with("pitch 5.344 "));
    let mut expected = Display::load(&before).expect("a panel");
    let mut lens = expected.lens().expect("slanted");
    let number = |text| Number::parse(text).expect("a number");
    (lens.pitch, lens.slant, lens.offset) = (number("5.344"), number("0.26"), number("-0.5"));
    expected.set_lens(lens);
    assert_eq!(Display::load(&out).expect("a panel"), expected);
    window.same(&through(&panel.mask("out.toml"), white(3)), "nudged");

    window.user.press(&[u32::from(b'n')]);
    assert!(window.line().ends_with("view 4 of 7 white"));
    window.same(&through(&panel.mask("out.toml"), white(4)), "another view");
    window.user.press(&[u32::from(b'h')]);
    assert!(window.line().ends_with("left views red, right views blue"));
    let halves = |view: u16| match view {
        0..3 => [255, 0, 0],
        3 => [0; 3],
        _ => [0, 0, 255],
    };
    window.same(&through(&panel.mask("out.toml"), halves), "halves");
    window.user.press(&[u32::from(b'i')]);
    assert!(window.line().contains("inverted true"));
    // A key without a meaning prints nothing and changes nothing.
    window.user.press(&[u32::from(b'x')]);
    window.user.press(&[0xff0d]);
    assert!(window.line().contains("inverted true"));
    window.same(&through(&panel.mask("out.toml"), halves), "inverted");
    window.user.press(&[u32::from(b'w')]);
    assert!(window.line().ends_with("view 3 of 7 white"));
    window.end(ESCAPE);
}

#[test]
fn what_cannot_be_shown_is_refused_in_one_sentence() {
    let screen = own_screen();
    let panel = Panel::new();
    let (file, out) = (panel.text("panel.toml"), panel.text("out.toml"));
    let refused_there = |arguments: &[&str], part: &str| {
        let mut command = manyview();
        command.args(["calibrate", "show"]).args(arguments);
        let (code, stdout, errors) = run(screen.give(&mut command));
        assert_eq!((code, stdout.as_str()), (2, ""), "{errors}");
        assert!(
            errors.contains(part) && errors.lines().count() == 1,
            "{errors}"
        );
    };
    let sheet = ["--pitch", "8", "--views", "8"];
    let with = |more: &[&'static str]| [&sheet[..], more].concat();
    refused_there(&["--display", &file], "give --out FILE.toml, or --photos");
    refused_there(
        &["--display", "huebner8", "--out", &out],
        "no slanted lens sheet",
    );
    refused_there(&with(&["--size", "9x"]), "--size is '9x'");
    refused_there(
        &with(&["--size", "2560x1440"]),
        "and monitor screen has 1920x1200",
    );
    refused_there(&with(&["--monitor", "DP-7"]), "--monitor 'DP-7'");
    refused_there(&["--pitch", "1", "--views", "8"], "the pitch is 1");
    refused_there(
        &["--display", &file, "--out", "/no/folder/x.toml"],
        "cannot be written to",
    );
    let sheet = with(&[]);
    let nowhere = [&["calibrate", "show"][..], &sheet].concat();
    let mut command = manyview();
    command.args(&nowhere).env_remove("DISPLAY");
    let (code, _, errors) = run(&mut command);
    assert_eq!(code, 3, "{errors}");
    assert!(
        errors.contains("set DISPLAY") && errors.lines().count() == 1,
        "{errors}"
    );
    refused(
        &["calibrate", "show", "--display", &file, "--size", "0x3"],
        2,
        "--size is '0x3'",
    );
}

/// The symptoms that docs/calibration.md describes, by rays through a sheet whose description may be wrong.
#[test]
fn an_eye_sees_what_is_wrong() {
    const SIZE: (u32, u32) = (640, 400);
    const PITCH: f64 = 8.0;
    let sheet = Display::new("sheet", 7, Kind::Slanted(Slanted::HUEBNER));
    let optics = Optics::of(&sheet, 7).expect("lenses");
    let setup = Setup {
        pixel: 25.4 / 96.0,
        cone: 20.0,
        crosstalk: 0.0,
        design: None,
    };
    let described = |part: LensPart, off: f64| {
        let mut fit = ByEye::new(sheet.clone(), SIZE).expect("slanted");
        let value = sheet.lens().expect("slanted").get(part).to_f64() + off;
        fit.set(part, &value.to_string()).expect("a number");
        fit
    };
    let seen = |fit: &ByEye, x: f64| {
        let eye = Eye {
            x,
            y: 0.0,
            z: 600.0,
        };
        let shown = fit.picture().expect("a mask");
        see(&shown, &optics, &setup, eye, &|| ()).expect("seen")
    };
    // White stripes along a line; at their edges an eye sees a part of the colours.
    let stripes = |line: &mut dyn Iterator<Item = u8>| {
        let lit: Vec<_> = line.enumerate().filter(|(_, light)| *light > 100).collect();
        lit.windows(2)
            .filter(|pair| pair[1].0 - pair[0].0 > 20)
            .count()
            + lit.len().min(1)
    };
    let row = |seen: &RgbImage| stripes(&mut (0..SIZE.0).map(|x| seen.get_pixel(x, 200).0[1]));
    let column = |seen: &RgbImage| stripes(&mut (0..SIZE.1).map(|y| seen.get_pixel(320, y).0[1]));
    let share = |seen: &RgbImage, c: usize| {
        let lit = seen.pixels().filter(|pixel| pixel.0[c] > 100).count();
        lit as f64 / f64::from(SIZE.0 * SIZE.1)
    };

    let right = seen(&described(LensPart::Offset, 0.0), 0.0);
    assert!(share(&right, 1) > 0.99, "all white: {}", share(&right, 1));
    let moved = seen(&described(LensPart::Offset, PITCH / 2.0), 0.0);
    assert!(share(&moved, 1) < 0.01, "all black: {}", share(&moved, 1));
    let pitch = seen(
        &described(LensPart::Pitch, 6.0 * PITCH * PITCH / 1920.0),
        0.0,
    );
    assert!(
        (5..=7).contains(&row(&pitch)) && column(&pitch) <= 2,
        "{} upright and {} lying stripes of 6",
        row(&pitch),
        column(&pitch)
    );
    let slant = seen(&described(LensPart::Slant, 6.0 * PITCH / 400.0), 0.0);
    assert!(
        (5..=7).contains(&column(&slant)) && row(&slant) <= 1,
        "{} lying and {} upright stripes of 6",
        column(&slant),
        row(&slant)
    );
    let mut halves = described(LensPart::Offset, 0.0);
    halves.act(Action::Halves, false).expect("a picture");
    assert!(
        share(&seen(&halves, -32.0), 0) > 0.99,
        "the left eye sees red"
    );
    assert!(
        share(&seen(&halves, 32.0), 2) > 0.99,
        "the right eye sees blue"
    );
    halves.act(Action::Invert, false).expect("a picture");
    assert!(
        share(&seen(&halves, -32.0), 2) > 0.9,
        "the left eye sees blue"
    );
}
