//! Results as text.

use super::outcome::{Bench, Row};
use super::statistics::Spread;
use std::fmt::Write;

/// The table of all rows, the limits, and the notes to single rows.
#[must_use]
pub fn text(bench: &Bench) -> String {
    let papers = bench.rows.iter().any(|row| row.paper.is_some());
    let gpu = bench.rows.iter().any(|row| row.gpu_ms.is_some());
    let mut lines = vec![head(gpu, papers)];
    lines.extend(bench.rows.iter().map(|row| cells(row, gpu, papers)));
    let mut text = format!(
        "{}\nOpenGL {}\n{} rounds; medians with quartiles; times: over the bare program's own frame; {}\n\n",
        bench.renderer, bench.version, bench.rounds, bench.clock
    );
    text.push_str(&columns(&lines));
    // Writing to a String cannot fail.
    if !bench.limits.is_empty() {
        let _ = writeln!(text, "\nbare, on this machine:");
        for limit in &bench.limits {
            let _ = writeln!(
                text,
                "  {} {}x{}: {} {}",
                limit.scene,
                limit.width,
                limit.height,
                significant(limit.rate),
                limit.unit
            );
        }
    }
    text.push_str(&optimisations(&bench.rows));
    for row in &bench.rows {
        for (reason, count) in &row.fallbacks {
            let _ = writeln!(
                text,
                "* {}, {} views, {}: {count} draws by replay: {reason}",
                row.scene, row.views, row.configuration
            );
        }
        for note in &row.notes {
            let _ = writeln!(
                text,
                "* {}, {} views, {}: {note}",
                row.scene, row.views, row.configuration
            );
        }
    }
    text
}

/// The gain in time and the change of the picture by each disabled optimisation.
fn optimisations(rows: &[Row]) -> String {
    let mut text = String::new();
    for row in rows {
        let Some(with) = rows.iter().find(|with| row.is_without(with)) else {
            continue;
        };
        if text.is_empty() {
            text.push_str("\noptimisations:\n");
        }
        let psnr = |row: &Row| match row.picture.psnr {
            Some(psnr) => format!("{psnr:.1} dB"),
            None => "exact".to_owned(),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {}, {} views, {}: {} times as long; the picture {}, with it {}",
            row.scene,
            row.views,
            row.configuration,
            significant(row.ms.median / with.ms.median),
            psnr(row),
            psnr(with)
        );
    }
    text
}

fn head(gpu: bool, papers: bool) -> Vec<String> {
    let mut head = vec![
        "scene",
        "size",
        "views",
        "configuration",
        "ms",
        "quartiles",
        "times",
        "quartiles",
        "cpu ms",
    ];
    if gpu {
        head.push("gpu ms");
    }
    head.extend(["PSNR", "SSIM", "worst", "wrong %", "tiles MiB"]);
    if papers {
        head.extend(["paper's times", "over replay", "paper's over passes"]);
    }
    head.into_iter().map(str::to_owned).collect()
}

fn cells(row: &Row, gpu: bool, papers: bool) -> Vec<String> {
    let quartiles =
        |spread: &Spread| format!("{}-{}", significant(spread.low), significant(spread.high));
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
    let star = if row.fallbacks.is_empty() && row.notes.is_empty() {
        ""
    } else {
        "*"
    };
    let mut cells = vec![
        row.scene.to_owned(),
        format!("{}x{}", row.width, row.height),
        row.views.to_string(),
        format!("{}{star}", row.configuration),
        significant(row.ms.median),
        quartiles(&row.ms),
        format!("{:.2}", row.times.median),
        format!("{:.2}-{:.2}", row.times.low, row.times.high),
        significant(row.cpu_ms),
    ];
    if gpu {
        cells.push(
            row.gpu_ms
                .map_or_else(String::new, |gpu| significant(gpu.median)),
        );
    }
    let picture = &row.picture;
    cells.push(
        picture
            .psnr
            .map_or_else(|| "exact".to_owned(), |psnr| format!("{psnr:.1}")),
    );
    cells.push(format!("{:.4}", picture.ssim));
    cells.push(picture.worst.to_string());
    cells.push(format!("{:.3}", picture.wrong_subpixels_percent));
    cells.push(row.view_bytes.map_or_else(
        || "?".to_owned(),
        |bytes| format!("{:.1}", bytes as f64 / f64::from(1 << 20)),
    ));
    if papers {
        let paper = row.paper.as_ref();
        cells.push(number(paper.and_then(|paper| paper.times)));
        cells.push(number(paper.and_then(|paper| paper.our_speedup)));
        cells.push(match paper {
            Some(paper) if !paper.words.is_empty() => paper.words.to_owned(),
            paper => number(paper.and_then(|paper| paper.speedup)),
        });
    }
    cells
}

/// Three significant digits, at most three decimals.
fn significant(value: f64) -> String {
    let digits = match value.abs() {
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 1.0 => 2,
        _ => 3,
    };
    format!("{value:.digits$}")
}

/// Aligned columns: words to the left, numbers to the right.
#[must_use]
pub fn columns(lines: &[Vec<String>]) -> String {
    let count = lines.iter().map(Vec::len).max().unwrap_or(0);
    let column = |at: usize| lines.iter().filter_map(move |line| line.get(at));
    let is_number = |cell: &String| {
        cell.starts_with(|c: char| c.is_ascii_digit())
            || ["", "exact", "?"].contains(&cell.as_str())
    };
    let shape: Vec<_> = (0..count)
        .map(|at| {
            let width = column(at)
                .map(|cell| cell.chars().count())
                .max()
                .unwrap_or(0);
            (width, column(at).skip(1).all(is_number))
        })
        .collect();
    let mut text = String::new();
    for line in lines {
        let mut out = String::new();
        for (cell, &(width, right)) in line.iter().zip(&shape) {
            let _ = if right {
                write!(out, "{cell:>width$}  ")
            } else {
                write!(out, "{cell:<width$}  ")
            };
        }
        let _ = writeln!(text, "{}", out.trim_end());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_left_and_numbers_right() {
        let line = |a: &str, b: &str| vec![a.to_owned(), b.to_owned()];
        let text = columns(&[
            line("scene", "ms"),
            line("fill", "10.5"),
            line("a", "exact"),
        ]);
        assert_eq!(text, "scene     ms\nfill    10.5\na      exact\n");
    }

    #[test]
    fn three_digits_count() {
        assert_eq!(significant(1234.5), "1234");
        assert_eq!(significant(12.345), "12.3");
        assert_eq!(significant(0.0123), "0.012");
    }
}
