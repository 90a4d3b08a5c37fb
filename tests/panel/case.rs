//! Programs whose picture is in a window of the panel's own, and what has to be there.

use crate::support::{Compiled, compiled, manyview, rgb, scratch, succeed};
use image::{GenericImageView, RgbImage};
use manyview::config::panel::load;
use manyview::display::{Display, Fit};
use manyview::interleave::reference;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

pub(crate) const CAMERAS: [&str; 4] = ["--separation", "0.02", "--convergence", "8"];

/// Views are resampled to the panel's pixels: the driver's floats may round the other way than the CPU's integers.
pub(crate) const STEP: u8 = 1;

/// One way to show the program.
#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub(crate) display: &'static str,
    pub(crate) views: u32,
    /// Width and height of the program's surface, and how many times as wide it becomes.
    pub(crate) window: (u32, u32),
    pub(crate) grows: u32,
    pub(crate) panel: (u16, u16),
    pub(crate) fit: Fit,
}

pub(crate) const CASE: Case = Case {
    display: "huebner8",
    views: 8,
    window: (320, 240),
    grows: 1,
    panel: (800, 600),
    fit: Fit::Contain,
};

pub(crate) fn word(fit: Fit) -> &'static str {
    match fit {
        Fit::Contain => "contain",
        Fit::Cover => "cover",
        Fit::Stretch => "stretch",
    }
}

pub(crate) fn still() -> PathBuf {
    compiled("still", Compiled::Program, &["-lEGL", "-lGL"])
}

impl Case {
    /// The program's size in the end.
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.window.0 * self.grows, self.window.1)
    }

    /// The views, as the program's window would show them.
    fn views(&self) -> Vec<RgbImage> {
        let folder = tempfile::tempdir().expect("a folder");
        let out = folder.path().join("atlas.png");
        succeed(&mut self.capture(&["--what", "atlas"], &out));
        let (all, (width, height)) = (rgb(&out), self.size());
        let view = |i| all.view(i * width, 0, width, height).to_image();
        (0..self.views).map(view).collect()
    }

    /// What the panel has to show.
    pub(crate) fn expected(&self) -> RgbImage {
        let panel = (self.panel.0.into(), self.panel.1.into());
        let place = self.fit.place(self.size(), panel);
        let display: Display = load(&named(self.display)).expect("a display");
        let mask = display.mask(&place, self.views).expect("a mask");
        let picture = reference::interleave(&self.views(), &mask).expect("a picture");
        let mut whole = RgbImage::new(panel.0, panel.1);
        image::imageops::replace(&mut whole, &picture, place.x.into(), place.y.into());
        whole
    }

    /// Captures the third frame.
    pub(crate) fn capture(&self, more: &[&str], out: &Path) -> Command {
        let (width, height) = self.size();
        let mut command = manyview();
        command
            .args(["capture", "--frame", "3", "--views"])
            .arg(self.views.to_string())
            .args(["--display", &named(self.display)])
            .args(CAMERAS)
            .args(more)
            .arg("--out")
            .arg(out)
            .arg("--")
            .arg(still())
            .args([width.to_string(), height.to_string()]);
        command
    }

    /// Starts the program, with its panel's window on this monitor, once it knows its screen.
    pub(crate) fn command(&self, monitor: &str, more: &[&str]) -> Command {
        let (width, height) = self.window;
        let mut command = manyview();
        command
            .args([
                "run",
                "--panel",
                monitor,
                "--fit",
                word(self.fit),
                "--views",
            ])
            .arg(self.views.to_string())
            .args(["--display", &named(self.display)])
            .args(CAMERAS)
            .args(more)
            .arg("--")
            .arg(still())
            .args([width.to_string(), height.to_string()])
            .args((self.grows > 1).then(|| self.grows.to_string()))
            .stdin(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }
}

/// The largest difference of two pictures; they have the same size.
pub(crate) fn worst(a: &RgbImage, b: &RgbImage) -> u8 {
    assert_eq!(a.dimensions(), b.dimensions());
    let off = a.iter().zip(b.iter()).map(|(a, b)| a.abs_diff(*b));
    off.max().unwrap_or(0)
}

/// Ends the program by the end of its input, and returns what was said.
pub(crate) fn end(mut child: Child, what: &str) -> String {
    drop(child.stdin.take());
    let mut said = String::new();
    let errors = child.stderr.as_mut().expect("a pipe");
    errors.read_to_string(&mut said).expect("text");
    let status = child.wait().expect("it ends");
    assert!(status.success(), "{what}: {status}, {said}");
    said
}

/// Displays, by name or description, and how many views they show.
pub(crate) const DISPLAYS: [(&str, u32); 12] = [
    ("huebner8", 8),
    ("slanted8", 8),
    ("lenticular-5", 5),
    ("columns", 2),
    ("rows", 2),
    ("checkerboard", 2),
    (
        "kind = 'slanted'\nviews = 9\npitch = '16/3'\nslant = '-2/3'\norder = 'bgr'",
        9,
    ),
    (
        "kind = 'slanted'\nviews = 66\npitch = 15.7934\nslant = 2.6021\noffset = 3.1",
        66,
    ),
    (
        "kind = 'slanted'\nviews = 2\npitch = 6.00217\nslant = 1.0001\ninverted = true",
        2,
    ),
    (
        "kind = 'integer'\nviews = 3\nhorizontal = 3\nsubpixel = 1\nvertical = 2\noffset = 1\nmodulus = 8\ntable = [0, 'b', 1, 2]",
        3,
    ),
    (
        "kind = 'leia'\nviews = 12\np-over-du = 3\np-over-dv = 0.8\ncolour-slant = 0.1\noffset = 0.25",
        12,
    ),
    (
        "kind = 'pattern'\npattern = ['LRLRbLRb']\nsubpixels = true",
        2,
    ),
];

/// The name of a display, or the file of its description.
pub(crate) fn named(display: &str) -> String {
    let Some((kind, _)) = display.split_once('\n') else {
        return display.to_owned();
    };
    let names = DISPLAYS.iter().position(|(known, _)| *known == display);
    let folder = scratch("panel");
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join(format!("{}.toml", names.expect(kind)));
    std::fs::write(&file, display).expect("written");
    file.to_string_lossy().into_owned()
}
