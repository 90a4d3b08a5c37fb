//! `manyview bench --preset popescu-table1`: no program is started; models are drawn by the CPU reference.
#![forbid(unsafe_code)]

use super::super::error::CommandError;
use super::{Arguments, measure, unwritten, write_json};
use crate::cli::{Outcome as Ended, print, tell};
use image::{RgbImage, imageops};
use manyview::bench::disocclusion::{
    Experiment, Frame, Images, Outcome, Scene, View, sheet, text, viewpoints, write_csv,
};
use manyview::bench::{BenchError, Preset};
use manyview::model::{MODELS, Surface};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::SystemTime;

pub(super) fn run(arguments: &Arguments, preset: &'static Preset, size: (u32, u32)) -> Ended {
    let experiment = Experiment { size: size.into() };
    let models: Vec<_> = MODELS
        .iter()
        .filter(|model| preset.scenes.contains(&model.name))
        .collect();
    let places = viewpoints();
    let bar = measure::bar((models.len() * places.len()) as u64);
    let mut outcome = Outcome {
        date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        command: std::env::args().collect(),
        preset: preset.name,
        scenes: Vec::new(),
        views: Vec::new(),
    };
    let mut sheets = Vec::new();
    for model in models {
        bar.set_message(model.name);
        let scene = (model.surfaces)();
        let images = experiment.images(&scene);
        let views = views(model.name, &experiment, &scene, &images, &places, &|| {
            bar.inc(1)
        });
        let triangles = scene.iter().map(Surface::count).sum();
        let row = Scene::new(model.name, triangles, &experiment, &images, &views);
        outcome.scenes.push(row);
        if arguments.chart.is_some() {
            sheets.extend(sheet(&experiment, &scene, &images, &views));
        }
        outcome.views.extend(views);
    }
    bar.finish_and_clear();
    print(&format!(
        "{}: {}\n\n{}",
        preset.name,
        preset.about,
        text(&outcome)
    ))?;
    write(arguments, &outcome, &sheets)?;
    Ok(ExitCode::SUCCESS)
}

/// Refuses options that are for programs; returns the one size.
pub(super) fn check(
    arguments: &Arguments,
    preset: &'static Preset,
    sizes: Vec<(u32, u32)>,
) -> Result<(u32, u32), BenchError> {
    let given = [
        ("--display", arguments.display.is_some()),
        ("--frames", arguments.frames.is_some()),
        ("--api", arguments.api.is_some()),
    ];
    if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
        let preset = preset.name;
        return Err(BenchError::NoProgram { option, preset });
    }
    if let Some(file) = &arguments.chart
        && file.extension().is_none_or(|end| end != "png")
    {
        return Err(BenchError::SheetName(file.clone()));
    }
    match sizes[..] {
        [size] => Ok(size),
        _ => Err(BenchError::OneSize),
    }
}

/// All frames of a scene, one thread for each processor, in the order of the viewpoints.
fn views(
    name: &'static str,
    experiment: &Experiment,
    scene: &[Surface],
    images: &Images,
    places: &[[f64; 3]],
    done: &(dyn Fn() + Sync),
) -> Vec<View> {
    let next = AtomicUsize::new(0);
    let all = Mutex::new(Vec::new());
    let work = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(&place) = places.get(number) else {
                break;
            };
            let truth = experiment.draw(&experiment.camera(place), scene);
            let made = images.all.iter();
            let made = made.map(|image| experiment.seen(image, place));
            let aside = || experiment.draw_aside(&experiment.camera(place), scene);
            for (image, seen) in made.chain(std::iter::once_with(aside)).enumerate() {
                let frame = Frame::of(experiment, &truth, &seen);
                let view = frame.map(|frame| View::new(name, place, image, &frame));
                if let Ok(mut all) = all.lock() {
                    all.push((number, image, view));
                }
            }
            done();
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let mut all = all.into_inner().unwrap_or_default();
    all.sort_by_key(|(number, image, _)| (*number, *image));
    all.into_iter().filter_map(|(_, _, view)| view).collect()
}

fn write(
    arguments: &Arguments,
    outcome: &Outcome,
    sheets: &[RgbImage],
) -> Result<(), CommandError> {
    let wrote = |file: &Path| tell(&format_args!("wrote {}", file.display()));
    if let Some(file) = &arguments.json {
        write_json(outcome, file)?;
    }
    if let Some(file) = &arguments.csv {
        write_csv(&outcome.views, file)?;
        wrote(file);
    }
    if let Some(file) = &arguments.chart {
        let width = sheets.first().map_or(0, RgbImage::width);
        let height = sheets.iter().map(RgbImage::height).sum();
        let mut all = RgbImage::new(width, height);
        let mut top = 0;
        for sheet in sheets {
            imageops::replace(&mut all, sheet, 0, top);
            top += i64::from(sheet.height());
        }
        all.save(file).map_err(|error| unwritten(file, &error))?;
        wrote(file);
    }
    Ok(())
}
