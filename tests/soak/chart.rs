//! An SVG of memory over time.

use crate::soak::judge::Sample;
use std::fmt::Write;

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 24.0;
const BELOW: f64 = 40.0;

/// About five round numbers from 0 to `most`.
fn ticks(most: f64) -> impl Iterator<Item = f64> {
    let rough = most / 5.0;
    let power = 10f64.powf(rough.log10().floor());
    let known = [1.0, 2.0, 5.0, 10.0].map(|n| n * power);
    let step = known.into_iter().find(|&s| s >= rough).unwrap_or(rough);
    (0..=(most / step) as u32).map(move |n| f64::from(n) * step)
}

/// The picture: a line for each program, with its name.
pub(crate) fn svg(title: &str, lines: &[(&str, &str, &[Sample])]) -> String {
    let all = || lines.iter().flat_map(|(_, _, samples)| samples.iter());
    let end = all().map(|s| s.hours).fold(1e-9, f64::max);
    let top = all().map(|s| s.memory).fold(1.0, f64::max) * 1.1;
    let x = |hours: f64| LEFT + hours / end * (WIDTH - LEFT - RIGHT);
    let y = |memory: f64| HEIGHT - BELOW - memory / top * (HEIGHT - BELOW - 40.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{LEFT}\" y=\"20\">{title}</text>\n"
    );
    for memory in ticks(top) {
        let _ = writeln!(
            text,
            "<path d=\"M{LEFT} {0:.1}H{1:.1}\" stroke=\"#ddd\"/>\
             <text x=\"{2}\" y=\"{3:.1}\" text-anchor=\"end\">{memory} MiB</text>",
            y(memory),
            x(end),
            LEFT - 6.0,
            y(memory) + 4.0,
        );
    }
    for minutes in ticks(end * 60.0) {
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{minutes} min</text>",
            x(minutes / 60.0),
            HEIGHT - 20.0,
        );
    }
    for (at, (name, colour, samples)) in lines.iter().enumerate() {
        let points: Vec<_> = samples
            .iter()
            .map(|s| format!("{:.1},{:.1}", x(s.hours), y(s.memory)))
            .collect();
        let _ = write!(
            text,
            "<polyline fill=\"none\" stroke=\"{colour}\" points=\"{}\"/>\n<text x=\"{}\" y=\"36\" fill=\"{colour}\">{name}</text>\n",
            points.join(" "),
            LEFT + 120.0 * at as f64,
        );
    }
    text.push_str("</svg>\n");
    text
}
