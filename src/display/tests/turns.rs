//! The phases of the lenses against the masks.

use super::*;

fn device(text: &str) -> Display {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("device.json");
    fs::write(&path, text).unwrap();
    Display::load(path.to_str().unwrap()).unwrap()
}

fn calibration(flips: &str) -> String {
    format!(
        r#"{{"serial":"LKG-E00001","pitch":{{"value":80.77}},"slope":{{"value":-6.64}},"center":{{"value":0.565}},
        "viewCone":{{"value":54.0}},"DPI":{{"value":491.0}},"screenW":{{"value":1440.0}},"screenH":{{"value":2560.0}}{flips}}}"#
    )
}

/// Panels, numbers of views, and whether lenses are known.
fn panels() -> Vec<(Display, u32)> {
    let sheet = |sheet| Display::new("sheet", 8, Kind::Slanted(sheet));
    let plain = slanted(ratio(837, 100), ratio(-7, 10), ratio(13, 10));
    let integer = |horizontal, subpixel, vertical| {
        Kind::Integer(Integer {
            horizontal,
            subpixel,
            vertical,
            offset: 3,
            modulus: 35,
            table: Vec::new(),
            order: SubpixelOrder::Rgb,
        })
    };
    let leia = Leia {
        p_over_du: ratio(3, 1),
        p_over_dv: ratio(1, 1),
        colour_slant: ratio(0, 1),
        colour_inversion: false,
        offset: ratio(1, 2),
    };
    let all_flips =
        r#","flipImageX":{"value":1.0},"flipSubp":{"value":1.0},"invView":{"value":1.0}"#;
    vec![
        (Display::named("lenticular-8").unwrap(), 8),
        (Display::named("huebner8").unwrap(), 8),
        (Display::named("slanted8").unwrap(), 8),
        (Display::named("rows").unwrap(), 2),
        (Display::named("columns").unwrap(), 2),
        (Display::named("checkerboard").unwrap(), 2),
        (sheet(plain.clone()), 8),
        (sheet(plain.clone()), 5),
        (
            sheet(Slanted {
                inverted: true,
                order: SubpixelOrder::Bgr,
                ..plain
            }),
            9,
        ),
        (Display::new("whole", 7, integer(5, 0, 10)), 7),
        (Display::new("steps", 7, integer(12, 4, -3)), 7),
        (Display::new("leia", 8, Kind::Leia(leia)), 8),
        (device(&calibration("")), 45),
        (device(&calibration(all_flips)), 45),
        (device(&calibration(r#","flipImageY":{"value":1.0}"#)), 45),
    ]
}

#[test]
fn every_subpixel_shows_the_view_whose_line_is_next_to_it() {
    // A window somewhere on a screen; panels that bring their own screen are 1440 x 2560.
    let placement = Placement {
        screen_width: 1440,
        screen_height: 2560,
        x: 37,
        y: 55,
        width: 211,
        height: 101,
    };
    for (display, views) in panels() {
        let mask = display.mask(&placement, views).unwrap();
        let turns = display.lens_phase(&placement, views).unwrap();
        let n = f64::from(views);
        let mut farthest = 0f64;
        for (row, pixels) in (0..).zip(mask.rows()) {
            for (x, pixel) in (0..).zip(pixels) {
                let middle = turns.start + f64::from(x) * turns.right + f64::from(row) * turns.down;
                for (colour, &view) in (-1..=1).zip(pixel) {
                    // A colour to the side of the middle may be on the other side, by its order.
                    let off = [1.0, -1.0].map(|side| {
                        let phase = middle + side * f64::from(colour) * turns.colour.abs();
                        let off = phase - (f64::from(view) + turns.within) / n;
                        (off - off.round()).abs() * n
                    });
                    farthest = farthest.max(off[0].min(off[1]));
                }
            }
        }
        assert!(farthest <= 0.5 + 1e-6, "{}: {farthest} views", display.name);
    }
}

#[test]
fn panels_without_one_function_have_no_lenses() {
    let placement = Placement::full_screen(64, 64);
    let turned = Display {
        rotation: Rotation::Quarter,
        ..Display::default()
    };
    let pattern = Pattern::new(&["LRLRbLRb"], true).unwrap();
    let hand = Display::new("hand", 2, Kind::Pattern(pattern));
    let cells = r#","CellPatternMode":{"value":0},"subpixelCells":[{"ROffsetX":0,"ROffsetY":0,"GOffsetX":0.3,"GOffsetY":0,"BOffsetX":0.6,"BOffsetY":0}]"#;
    for display in [turned, hand, device(&calibration(cells))] {
        assert_eq!(display.lens_phase(&placement, 2), None, "{}", display.name);
    }
}
