//! Keys for a running program, and the requests that each stands for.
#![forbid(unsafe_code)]

use super::{OUTPUT, Order, ProfileRequest};
use crate::config::{Action, Camera, FlatDepth, Knob, Live, OptionId};
use std::path::PathBuf;

/// Factor of one press for the numbers of the cameras.
const FACTOR: f64 = 1.1;
/// Step of one press for the depth of flat draws.
const STEP: f64 = 0.05;
/// The outputs that [`Key::Output`] cycles through.
const OUTPUTS: [&str; 4] = ["panel", "quilt", "sbs", "anaglyph:red-cyan"];

/// The requests that an action stands for with these current values. They are alternatives: the first one that is not refused counts.
/// `chosen` is as for [`Live::with`]; `presets` has the cameras to choose from; `picture` gives the path of a picture.
#[must_use]
pub fn orders(
    action: Action,
    live: Live,
    chosen: Option<(f64, f64)>,
    presets: &[Camera],
    picture: impl FnOnce() -> PathBuf,
) -> Vec<Order> {
    let set = |id, value: String| Order::Set(vec![(Knob::Option(id), value)]);
    let camera = |at: usize, more: bool| {
        // Until the cameras are chosen there is no number to change. A request for it is refused with the reason.
        let unknown = match (live.camera, at) {
            (Camera::Eye { .. }, 0) => OptionId::EyeSpacing,
            (Camera::Eye { .. }, _) => OptionId::FocalDepth,
            (_, 0) => OptionId::Separation,
            _ => OptionId::Convergence,
        };
        match live.cameras(chosen).and_then(|pair| pair.get(at).copied()) {
            Some((id, value)) => {
                let value = if more { value * FACTOR } else { value / FACTOR };
                set(id, rounded(value))
            }
            None => Order::Get(unknown.spec().key.map(str::to_owned)),
        }
    };
    match action {
        Action::Toggle => vec![Order::Toggle],
        Action::Spread(more) => vec![camera(0, more)],
        Action::Focus(more) => vec![camera(1, more)],
        Action::HudDepth(farther) => {
            let step = if farther { STEP } else { -STEP };
            // From what follows the scene, the way begins on the panel.
            let from = match live.hud_depth {
                FlatDepth::At(depth) => depth,
                FlatDepth::Crosshair | FlatDepth::Cursor => 0.0,
            };
            vec![set(OptionId::HudDepth, rounded(from + step))]
        }
        Action::Output => {
            let now = live.output.to_string();
            let at = OUTPUTS.iter().position(|known| *known == now);
            let next = at.map_or(0, |at| at + 1);
            let others = OUTPUTS.iter().cycle().skip(next).take(OUTPUTS.len());
            others
                .map(|word| set(OptionId::Output, (*word).to_owned()))
                .collect()
        }
        Action::Save => vec![Order::Profile(ProfileRequest::Save(None))],
        Action::Preset(number) => vec![Order::Preset(number)],
        Action::NextPreset => {
            let now = presets.iter().position(|camera| *camera == live.camera);
            // Without any, the refusal says so.
            let next = now.map_or(0, |at| (at + 1) % presets.len().max(1));
            vec![Order::Preset(next)]
        }
        Action::Capture => vec![Order::Capture(picture(), OUTPUT.to_owned())],
        Action::Explain => {
            let picture = picture();
            let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
            vec![Order::Explain(
                picture.with_file_name(format!("{stem}-explained.png")),
            )]
        }
    }
}

/// The number with six digits, so that a press up and a press down cancel out.
fn rounded(value: f64) -> String {
    // The text was just written from a number, so it always parses.
    format!("{value:.5e}").parse().unwrap_or(value).to_string()
}

/// The file name of a picture: program, date and time in UTC, and frame. `seconds` counts from 1970.
#[must_use]
pub fn picture_name(program: &str, seconds: u64, frame: u64) -> String {
    let (days, second) = (seconds / 86400, seconds % 86400);
    let (year, month, day) = date(days);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{program}-{year:04}{month:02}{day:02}-{hour:02}{minute:02}{second:02}-{frame:06}.png")
}

/// Year, month and day of a day that is counted from 1970-01-01 as 0.
fn date(mut day: u64) -> (u64, u64, u64) {
    let of = |year: u64, years| year.is_multiple_of(years);
    let leap = |year| of(year, 4) && (!of(year, 100) || of(year, 400));
    let mut year = 1970;
    while day >= 365 + u64::from(leap(year)) {
        day -= 365 + u64::from(leap(year));
        year += 1;
    }
    let mut month = 1;
    for days in [
        31,
        28 + u64::from(leap(year)),
        31,
        30,
        31,
        30,
        31,
        31,
        30,
        31,
        30,
        31,
    ] {
        if day < days {
            break;
        }
        day -= days;
        month += 1;
    }
    (year, month, day + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Settings};

    fn live() -> Live {
        Live::new(&Config::from_settings(&Settings::default()).unwrap())
    }

    fn words(action: Action, live: Live, chosen: Option<(f64, f64)>) -> Vec<(OptionId, String)> {
        let orders = orders(action, live, chosen, &[], PathBuf::new);
        let sets = orders.into_iter().map(|order| match order {
            Order::Set(mut values) => match values.remove(0) {
                (Knob::Option(id), value) => (id, value),
                other => panic!("{other:?}"),
            },
            other => panic!("{other:?}"),
        });
        sets.collect()
    }

    #[test]
    fn up_and_down_meet_again() {
        let mut live = live();
        let chosen = Some((0.03, 8.0));
        let (id, value) = words(Action::Spread(true), live, chosen).remove(0);
        assert_eq!((id, &*value), (OptionId::Separation, "0.033"));
        let (id, value) = words(Action::Focus(false), live, chosen).remove(0);
        assert_eq!((id, &*value), (OptionId::Convergence, "7.27273"));
        live.camera = Camera::Eye {
            spacing: 0.033,
            focal_depth: 5.0,
        };
        let (id, value) = words(Action::Spread(false), live, chosen).remove(0);
        assert_eq!((id, &*value), (OptionId::EyeSpacing, "0.03"));
        live.hud_depth = FlatDepth::At(0.05);
        let (_, value) = words(Action::HudDepth(false), live, None).remove(0);
        assert_eq!(value, "0");
    }

    #[test]
    fn outputs_go_round() {
        let mut live = live();
        let outputs = |live| {
            words(Action::Output, live, None)
                .into_iter()
                .map(|(_, word)| word)
        };
        let next: Vec<_> = outputs(live).collect();
        assert_eq!(next, ["quilt", "sbs", "anaglyph:red-cyan", "panel"]);
        live.output = crate::config::Output::View(3);
        assert_eq!(outputs(live).next().as_deref(), Some("panel"));
    }

    #[test]
    fn cameras_that_are_not_chosen_are_asked_for() {
        let orders = orders(Action::Focus(true), live(), None, &[], PathBuf::new);
        assert_eq!(orders, [Order::Get(Some("convergence".to_owned()))]);
    }

    #[test]
    fn pictures_have_the_program_the_time_and_the_frame() {
        assert_eq!(
            picture_name("gears", 0, 1),
            "gears-19700101-000000-000001.png"
        );
        // date -u -d @1709251199
        assert_eq!(
            picture_name("x", 1_709_251_199, 30),
            "x-20240229-235959-000030.png"
        );
        assert_eq!(
            picture_name("x", 1_735_689_600, 7),
            "x-20250101-000000-000007.png"
        );
    }
}
