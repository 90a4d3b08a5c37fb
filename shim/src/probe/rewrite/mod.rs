//! Gives real shaders to the driver, unchanged and rewritten.

mod cases;
mod driver;

use crate::egl::{self, Kind};
use cases::Case;
use driver::{Driver, Interface, Shader};
use manyview_core::rewrite::{
    Amplifier, Names, Options, Rewritten, Stage, Target, Uniform, VertexLayer, rewrite,
};
use serde_json::{Value, json};
use std::process::ExitCode;
use std::time::Instant;

/// Number of views of the ways that draw all views at once.
const VIEWS: u32 = 8;
const WAYS: [(&str, Amplifier, Target); 3] = [
    ("replay", Amplifier::Replay, Target::Whole),
    (
        "layers",
        Amplifier::Instanced,
        Target::Layer(VertexLayer::ArbShaderViewportLayerArray),
    ),
    ("tiles", Amplifier::Instanced, Target::Tiles),
];

/// Prints a line for each shader, and one for each program and way. The arguments name the files; with `-` the lines of stdin do.
pub(crate) fn run() -> ExitCode {
    let mut files: Vec<_> = std::env::args().skip(2).collect();
    if files.iter().any(|file| file == "-") {
        files = std::io::stdin().lines().map_while(Result::ok).collect();
    }
    if files.is_empty() {
        eprintln!("usage: manyview-probe rewrite FILE… | -");
        return ExitCode::from(2);
    }
    match every(&files) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn every(files: &[String]) -> Result<(), String> {
    let mut cases = Vec::new();
    for file in files {
        match cases::read(file)? {
            Some(case) => cases.push(case),
            None => println!("{}", json!({ "file": file, "unknown": true })),
        }
    }
    // A shader that does not tell is taken for OpenGL ES if desktop OpenGL does not compile it.
    for kind in [Kind::Core, Kind::Compatibility, Kind::Es] {
        if !cases.iter().any(|case| case.kind == kind) {
            continue;
        }
        egl::make(kind)?;
        let driver = Driver::load()?;
        for case in &mut cases {
            if case.kind != kind {
                continue;
            }
            if case.open && !case.program && kind == Kind::Compatibility {
                let compiles =
                    |(stage, text): &(Stage, Vec<u8>)| driver.compile(*stage, text).is_ok();
                if !case.shaders.iter().all(compiles) {
                    case.kind = Kind::Es;
                    continue;
                }
            }
            check(&driver, case);
        }
    }
    Ok(())
}

/// The outcome of one shader in one way.
enum Outcome<'a> {
    Refused(String),
    /// The shader needs no change.
    Same,
    Compiled(Shader, Rewritten<'a>),
    Failed(String),
}

impl Outcome<'_> {
    fn word(&self) -> &'static str {
        match self {
            Outcome::Refused(_) => "refused",
            Outcome::Same => "same",
            Outcome::Compiled(..) => "compiled",
            Outcome::Failed(_) => "failed",
        }
    }
}

fn check(driver: &Driver, case: &Case) {
    let before: Vec<_> = case
        .shaders
        .iter()
        .map(|(stage, text)| driver.compile(*stage, text))
        .collect();
    let mut ways: Vec<Vec<Outcome>> = Vec::new();
    let mut lines: Vec<Value> = Vec::new();
    for ((stage, _), before) in case.shaders.iter().zip(&before) {
        lines.push(json!({
            "file": case.file,
            "stage": format!("{stage:?}"),
            "before": before.is_ok(),
            "log": before.as_ref().err(),
        }));
    }
    for (way, amplifier, target) in WAYS {
        let options = Options {
            amplifier,
            target,
            views: if amplifier == Amplifier::Replay {
                1
            } else {
                VIEWS
            },
            es: case.kind == Kind::Es,
        };
        let mut outcomes = Vec::new();
        for ((stage, text), line) in case.shaders.iter().zip(&mut lines) {
            let outcome = attempt(driver, *stage, text, &options, line);
            let why = match &outcome {
                Outcome::Refused(why) | Outcome::Failed(why) => why.as_str(),
                _ => "",
            };
            if let Some(line) = line.as_object_mut() {
                line.insert(way.to_owned(), json!([outcome.word(), why]));
            }
            outcomes.push(outcome);
        }
        ways.push(outcomes);
    }
    for line in lines {
        println!("{line}");
    }
    if case.program
        && let Ok(before) = before
            .iter()
            .map(Result::as_ref)
            .collect::<Result<Vec<_>, _>>()
    {
        link(driver, case, &before, &ways);
    }
    for shader in before.into_iter().flatten() {
        driver.delete(shader);
    }
    for outcome in ways.into_iter().flatten() {
        if let Outcome::Compiled(shader, _) = outcome {
            driver.delete(shader);
        }
    }
}

fn attempt<'a>(
    driver: &Driver,
    stage: Stage,
    text: &'a [u8],
    options: &Options,
    line: &mut Value,
) -> Outcome<'a> {
    let begun = Instant::now();
    let rewritten = rewrite(text, stage, options);
    let taken = begun.elapsed();
    if let Some(line) = line.as_object_mut() {
        // The longest time of all ways counts.
        let longest = line
            .get("microseconds")
            .and_then(Value::as_f64)
            .unwrap_or(0.0);
        let taken = longest.max(taken.as_secs_f64() * 1e6);
        line.insert("microseconds".to_owned(), json!(taken));
        if let Ok(rewritten) = &rewritten {
            let version = rewritten.facts.version;
            line.insert("version".to_owned(), json!(version.number));
            line.insert("es".to_owned(), json!(version.es));
        }
    }
    match rewritten {
        Err(refusal) => Outcome::Refused(refusal.to_string()),
        Ok(rewritten) if matches!(rewritten.text, std::borrow::Cow::Borrowed(_)) => Outcome::Same,
        Ok(rewritten) => match driver.compile(stage, &rewritten.text) {
            Ok(shader) => Outcome::Compiled(shader, rewritten),
            Err(log) => Outcome::Failed(log),
        },
    }
}

/// Links the program unchanged, and with its last vertex-processing stage and its fragment shaders rewritten.
fn link(driver: &Driver, case: &Case, before: &[&Shader], ways: &[Vec<Outcome>]) {
    let has = |stage| case.shaders.iter().any(|&(other, _)| other == stage);
    let last = [Stage::Geometry, Stage::TessEvaluation, Stage::Vertex]
        .into_iter()
        .find(|&stage| has(stage));
    let plain = driver.link(before);
    let Ok(plain) = plain.map(|interface| own(interface, &[])) else {
        return;
    };
    for ((way, ..), outcomes) in WAYS.iter().zip(ways) {
        let mut shaders = Vec::new();
        let mut names = Vec::new();
        let mut refused = false;
        for (((stage, _), &before), outcome) in case.shaders.iter().zip(before).zip(outcomes) {
            let variant = Some(*stage) == last || *stage == Stage::Fragment;
            match outcome {
                Outcome::Compiled(shader, rewritten) if variant => {
                    shaders.push(shader);
                    names.push(&rewritten.names);
                }
                Outcome::Refused(_) | Outcome::Failed(_) if variant => refused = true,
                _ => shaders.push(before),
            }
        }
        if refused {
            continue;
        }
        let linked = driver.link(&shaders);
        let (ok, log) = match linked {
            Ok(interface) => {
                let after = own(interface, &names);
                let same = after == plain;
                (
                    same,
                    if same {
                        String::new()
                    } else {
                        format!("{plain:?} {after:?}")
                    },
                )
            }
            Err(log) => (false, log),
        };
        println!(
            "{}",
            json!({ "file": case.file, "linked": way, "same": ok, "log": log })
        );
    }
}

/// The program's own part of an interface, without our uniforms and without gl_InstanceID, which is listed like an attribute.
fn own(mut interface: Interface, names: &[&Names]) -> Interface {
    let uniforms: Vec<_> = names
        .iter()
        .flat_map(|names| Uniform::ALL.map(|uniform| names.uniform(uniform)))
        .collect();
    interface.uniforms.retain(|line| {
        let name = line.split([' ', '[']).next().unwrap_or_default();
        !uniforms.iter().any(|uniform| uniform == name)
    });
    interface
        .attributes
        .retain(|line| !line.starts_with("gl_InstanceID"));
    interface
}
