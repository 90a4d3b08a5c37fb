//! What a window within the program would cost, against the copy that another process shows (decision 38).

use crate::support;
use crate::support::{Compiled, built, run, sized_screen};
use std::path::Path;

/// Of a frame, in ms, the middle of three turns.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
#[ignore = "it measures, for a minute: cargo test --release --test all panel_ways:: -- --ignored --nocapture"]
fn cost_of_the_ways_to_the_panel() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/panel_ways/ways.c");
    let program = built("ways", &[&source], Compiled::Program, &["-lGL", "-lX11"]);
    let screen = sized_screen((1984, 1080));
    let ways = ["none", "window", "paced", "copy"];
    println!("| a picture of 1920 x 1080 | frame, ms |\n|---|---|");
    let mut all = [const { Vec::new() }; 4];
    for _ in 0..3 {
        for (way, times) in ways.iter().zip(&mut all) {
            let mut command = support::bare(&program);
            command
                .args(["1920", "1080", "60", way])
                .env_remove("LP_NUM_THREADS");
            let (code, time, said) = run(screen.give(&mut command));
            assert_eq!(code, 0, "{said}");
            times.push(time.trim().parse::<f64>().expect("a number"));
        }
    }
    let all = all.map(median);
    for (way, time) in ways.iter().zip(all) {
        println!("| {way} | {time:.1} |");
    }
    assert!(
        all[3] < all[1],
        "the copy costs the program less than a window: {all:?}"
    );
}
