//! Diagnostics: fallbacks and names for the report, and the picture that is asked for.

use super::super::control::{Picture, Pictured, Wanted};
use super::super::diagnostics::Diagnostics;
use super::bench::Bench;
use crate::config::{Capture, CaptureWhat};
use crate::control::{Answer, ControlError};
use crate::gl::Held;
use crate::plan::Reason;
use crate::plan::reason::{Missing, Replayed};
use crate::report::Report;
use serde_json::{Value, json};

fn told(diagnostics: &Diagnostics, member: &str) -> Value {
    let mut report: Value = serde_json::from_str(&diagnostics.report.json()).expect("JSON");
    report[member].take()
}

#[test]
fn fallbacks_are_counted_by_reason_and_reported_once() {
    let mut diagnostics = Diagnostics::new(Report::default());
    let [lists, compile, missing] = [
        Reason::Replayed(Replayed::Lists),
        Reason::Compile,
        Reason::Driver(Missing::Instancing),
    ];
    for reason in [&lists, &compile, &lists, &lists] {
        diagnostics.fallback(reason.clone());
    }
    assert_eq!(told(&diagnostics, "fallbacks"), json!({}), "not yet");
    diagnostics.report_fallbacks();
    let counts = json!({lists.to_string(): 3, compile.to_string(): 1});
    assert_eq!(told(&diagnostics, "fallbacks"), counts);
    diagnostics.report_fallbacks();
    assert_eq!(told(&diagnostics, "fallbacks"), counts);
    diagnostics.fallback(lists.clone());
    diagnostics.fallback(missing.clone());
    diagnostics.report_fallbacks();
    let counts = json!({lists.to_string(): 4, compile.to_string(): 1, missing.to_string(): 1});
    assert_eq!(told(&diagnostics, "fallbacks"), counts);
}

#[test]
fn a_frame_gives_its_fallbacks_to_the_report() {
    let mut bench = Bench::new(&[("VIEWS", "2"), ("STRATEGY", "replay")]);
    let fallbacks = |bench: &Bench| told(&bench.layer.diagnostics, "fallbacks");
    bench.layer.diagnostics.fallback(Reason::Program);
    assert_eq!(fallbacks(&bench), json!({}));
    bench.frame();
    assert_eq!(fallbacks(&bench), json!({Reason::Program.to_string(): 1}));
}

/// The launcher ends the program as soon as it has the picture.
#[test]
fn the_report_of_a_captured_frame_has_its_fallbacks() {
    let folder = tempfile::tempdir().expect("a folder");
    let [report, out] = ["report.json", "frame.png"].map(|name| folder.path().join(name));
    let [report_text, out] = [&report, &out].map(|path| path.display().to_string());
    let mut bench = Bench::new(&[
        ("VIEWS", "2"),
        ("STRATEGY", "replay"),
        ("REPORT", &report_text),
        ("CAPTURE_OUT", &out),
        ("CAPTURE_FRAMES", "1"),
    ]);
    bench.layer.diagnostics.fallback(Reason::Program);
    bench.layer.show(&bench.gl, true);
    let text = std::fs::read_to_string(&report).expect("a report");
    let mut report: Value = serde_json::from_str(&text).expect("JSON");
    let counts = json!({Reason::Program.to_string(): 1});
    assert_eq!(report["fallbacks"].take(), counts);
    bench.layer.count_frame();
    assert_eq!(
        told(&bench.layer.diagnostics, "fallbacks"),
        counts,
        "counted once"
    );
}

#[test]
fn the_report_has_the_names_that_are_made_and_not_deleted() {
    let mut diagnostics = Diagnostics::new(Report::default());
    // What other contexts of this thread have made is theirs.
    diagnostics.count_names(0);
    let before = told(&diagnostics, "names");
    Held::Texture.count(3);
    Held::Texture.count(-1);
    Held::Query.count(1);
    diagnostics.count_names(5);
    let after = told(&diagnostics, "names");
    let more = |kind: &str| {
        after[kind]
            .as_i64()
            .zip(before[kind].as_i64())
            .map(|(a, b)| a - b)
    };
    assert_eq!(more("textures"), Some(2));
    assert_eq!(more("queries"), Some(1));
    assert_eq!(more("buffers"), Some(0));
    assert_eq!(after["lists"], 5);
}

#[test]
fn the_outcome_of_a_picture_is_taken_once() {
    let wanted = Wanted::Picture(Capture {
        out: "/nowhere/picture.png".into(),
        first: 0,
        last: 0,
        what: CaptureWhat::Output,
    });
    let mut picture = Picture::None;
    assert!(!picture.is_awaited() && picture.take().is_none());
    picture = Picture::Wanted(wanted.clone());
    assert!(picture.is_awaited());
    // No frame was shown, so it has to be asked for again.
    assert!(matches!(picture.take(), Some(Pictured::Later(later)) if later == wanted));
    assert!(!picture.is_awaited() && picture.take().is_none());
    let outcomes = [
        Ok(Answer::Layer(true)),
        Err(ControlError::Picture("refused".into())),
    ];
    for outcome in outcomes {
        let good = outcome.is_ok();
        picture = Picture::Done(outcome);
        assert!(picture.is_awaited());
        assert!(matches!(picture.take(), Some(Pictured::Done(taken)) if taken.is_ok() == good));
        assert!(!picture.is_awaited());
    }
}

/// As if there were no end of them.
#[test]
fn errors_of_a_lost_context_are_dropped_and_counted_for_a_while_only() {
    const LOST: u32 = 0x0507;
    let mut bench = Bench::new(&[("VIEWS", "4"), ("STRATEGY", "replay")]);
    let (gl, before) = (bench.gl, told(&bench.layer.diagnostics, "gl_errors"));
    assert_eq!((before, gl.drop_errors()), (json!(0), 0));
    (0..40).for_each(|_| bench.fake.raise(LOST));
    assert_eq!(gl.drop_errors(), 16);
    bench.layer.drain_own_errors(&gl);
    assert_eq!(told(&bench.layer.diagnostics, "gl_errors"), json!(16));
    assert_eq!(gl.drop_errors(), 8);
}
