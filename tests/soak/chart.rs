//! Memory over time as an SVG.

use crate::judge::Sample;
use std::fmt::Write;

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 60.0;
const BELOW: f64 = 40.0;

/// The picture: a line for each program, with its name.
pub(crate) fn svg(title: &str, lines: &[(&str, &str, &[Sample])]) -> String {
    let all = || lines.iter().flat_map(|(_, _, samples)| samples.iter());
    let end = all().map(|s| s.hours).fold(1e-9, f64::max);
    let top = all().map(|s| s.memory).fold(1.0, f64::max) * 1.1;
    let x = |hours: f64| LEFT + hours / end * (WIDTH - LEFT - 20.0);
    let y = |memory: f64| HEIGHT - BELOW - memory / top * (HEIGHT - BELOW - 40.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"{LEFT}\" y=\"20\">{title}</text>\n"
    );
    for step in 0..=4 {
        let part = f64::from(step) / 4.0;
        let (memory, minutes) = (top * part, end * part * 60.0);
        let _ = write!(
            text,
            "<path d=\"M{LEFT} {0:.1}H{1:.1}\" stroke=\"#ddd\"/><text x=\"5\" y=\"{0:.1}\">{memory:.0} MiB</text>\n\
             <text x=\"{2:.1}\" y=\"{3}\">{minutes:.0} min</text>\n",
            y(memory),
            x(end),
            x(end * part) - 20.0,
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
