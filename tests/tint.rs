//! `--strategy tint`: colours tell the views.
#![forbid(unsafe_code)]

mod support;

use image::RgbImage;
use support::{Compiled, compiled, layered, own_screen, rgb, succeed};

#[test]
fn the_first_view_is_red_and_the_last_one_is_not() {
    let screen = own_screen();
    let program = compiled("moves", Compiled::Program, &["-lGL", "-lEGL", "-lX11"]);
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("frame.png");
    let view = |strategy: &str, what: &str| -> RgbImage {
        let options = [
            ("STRATEGY", strategy),
            ("VIEWS", "3"),
            ("CAPTURE_OUT", out.to_str().expect("UTF-8")),
            ("CAPTURE_FRAMES", "2"),
            ("CAPTURE_WHAT", what),
        ];
        succeed(screen.give(&mut layered(&program, &options)));
        rgb(&out)
    };
    for (what, kept) in [
        ("view:0", [true, false, false]),
        ("view:1", [true, true, true]),
        ("view:2", [false, true, true]),
    ] {
        let (tinted, plain) = (view("tint", what), view("replay", what));
        for (channel, kept) in kept.into_iter().enumerate() {
            let values = |picture: &RgbImage| -> Vec<u8> {
                picture.pixels().map(|pixel| pixel.0[channel]).collect()
            };
            let (tinted, plain) = (values(&tinted), values(&plain));
            let is_clear = |values: &[u8]| values.iter().all(|value| *value == values[0]);
            assert!(!is_clear(&plain));
            assert_eq!(tinted == plain, kept, "{what}, channel {channel}");
            assert_eq!(is_clear(&tinted), !kept, "{what}, channel {channel}");
        }
    }
}
