//! What the end of a frame costs: the interleave pass over a plain copy of a picture of the same size, in one run.
#![forbid(unsafe_code)]

mod support;

use manyview::interleave::cost::Cost;
use std::process::Command;
use support::{library, target_folder};

/// Views of full size, and the ratio from which on the pass has become another one: with branches, 8 views took some 20. That is no aim.
/// The aims, 2.5 for 8 views and 6 for 45, are nearly met at 8 views by masks that repeat, and missed by the others (ARCHITECTURE.md);
/// other work on the cores adds a third, as it takes from the memory that 45 views have to be read from.
const LARGEST: [(u32, f64); 2] = [(8, 7.0), (45, 15.0)];

/// A size and a number of views as the probe takes them, none for all.
fn costs(arguments: &[&str]) -> Vec<Cost> {
    library();
    let mut probe = Command::new(target_folder().join("manyview-probe"));
    let output = support::succeed(probe.arg("interleave").args(arguments));
    print!("{}", String::from_utf8_lossy(&output.stderr));
    println!(
        "| size | views | panel | copy, ms | interleave, ms | ratio |\n|---|---|---|---|---|---|"
    );
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.lines()
        .map(|line| {
            let cost: Cost = serde_json::from_str(line).expect("a line of JSON");
            println!(
                "| {}x{} | {} | {} | {:.1} | {:.1} | {:.2} |",
                cost.width,
                cost.height,
                cost.views,
                cost.display,
                cost.copy,
                cost.interleave,
                cost.ratio
            );
            cost
        })
        .collect()
}

#[test]
fn cost_of_the_interleave_pass() {
    for (views, largest) in LARGEST {
        let measured = costs(&["1920x1080", &views.to_string()]);
        assert_eq!(measured.len(), 2, "two panels");
        for cost in measured {
            assert!(cost.ratio < largest, "{cost:?}");
        }
    }
}

/// Minutes, and gigabytes of memory.
#[test]
#[ignore = "takes minutes and gigabytes"]
fn cost_of_the_interleave_pass_at_every_size() {
    assert!(!costs(&[]).is_empty());
}
