//! Slanted sheets as files, and the numbers that are fitted by eye.

use super::*;
use proptest::option;

fn numbers() -> impl Strategy<Value = Number> {
    prop_oneof![
        (-90_000i64..90_000, 1i64..2000).prop_map(|(n, d)| ratio(n, d)),
        (-1e4..1e4f64).prop_map(|value| Number::from_f64(value).unwrap()),
    ]
}

fn sheets() -> impl Strategy<Value = Slanted> {
    let bias = (2usize..5, 2usize..5, -10.0..10.0f64).prop_map(|(columns, rows, scale)| {
        let values = (0..columns * rows).map(|i| Number::from_f64(scale / (i + 1) as f64).unwrap());
        Bias::new(columns, rows, values.collect()).unwrap()
    });
    (
        [numbers(), numbers(), numbers(), numbers(), numbers()],
        (1i64..90_000, 1i64..2000),
        option::of(bias),
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(
            |([slant, offset, r, g, b], (n, d), bias, bgr, inverted)| Slanted {
                pitch: ratio(n, d),
                slant,
                offset,
                colours: [r, g, b],
                bias,
                order: if bgr {
                    SubpixelOrder::Bgr
                } else {
                    SubpixelOrder::Rgb
                },
                inverted,
            },
        )
}

proptest! {
    #![proptest_config(seeded(200))]

    #[test]
    fn a_sheet_that_is_written_is_read_again(
        sheet in sheets(), views in 1u32..300, quarter in 0i64..4, name in "[^\\p{Cc}]{1,20}",
        screen in option::of((1u32..9000, 1u32..9000)), dpi in option::of(1.0..900.0f64),
        cone in option::of(1.0..170.0f64), budgets in (option::of(0.01..1000.0f64), option::of(0.001..100.0f64)),
        spacing in option::of(prop::sample::select(Spacing::ALL.to_vec())), quilt in option::of((1u32..99, 1u32..99)),
    ) {
        let mut before = Display::new(name, views, Kind::Slanted(sheet));
        before.rotation = Rotation::from_degrees(90 * quarter).unwrap();
        let (budget_px, budget_mm) = (budgets.0, budgets.1.filter(|_| dpi.is_some()));
        before.facts = Facts { screen, dpi, cone, spacing, quilt, budget_px, budget_mm };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.toml");
        fs::write(&path, before.to_toml().unwrap()).unwrap();
        prop_assert_eq!(Display::load(path.to_str().unwrap()).unwrap(), before);
    }
}

#[test]
fn a_file_says_numbers_as_people_write_them() {
    let mut display = Display::named("slanted8").unwrap();
    let lens = display.lens().unwrap();
    let lens = lens.with(LensPart::Pitch, "5.34").unwrap();
    display.set_lens(lens.with(LensPart::Offset, "-1").unwrap());
    let text = display.to_toml().unwrap();
    for line in [
        "pitch = 5.34",
        "slant = \"2/3\"",
        "offset = -1.0",
        "order = \"rgb\"",
    ] {
        assert!(
            text.lines().any(|written| written == line),
            "{line}: {text}"
        );
    }
    assert_eq!(Display::default().to_toml(), None);
    assert_eq!(Display::default().lens(), None);
}

#[test]
fn numbers_that_a_sheet_cannot_have_are_refused() {
    let lens = Display::named("slanted8").unwrap().lens().unwrap();
    let all = [
        (LensPart::Pitch, "0"),
        (LensPart::Pitch, "-3"),
        (LensPart::Pitch, "1000001"),
        (LensPart::Slant, "steep"),
        (LensPart::Offset, "nan"),
        (LensPart::Offset, "1/0"),
    ]
    .map(|(part, text)| lens.with(part, text).unwrap_err().to_string());
    insta::assert_snapshot!(all.join("\n"));
}
