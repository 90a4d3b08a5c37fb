//! Whether memory grows: a line through the samples after the start, and its standard error.

/// Kinds of names in a sample, in the order of its numbers; as in the report.
pub(crate) const NAMES: [&str; 7] = [
    "textures",
    "framebuffers",
    "queries",
    "vertex_arrays",
    "buffers",
    "shaders",
    "lists",
];

/// One sample of one program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sample {
    /// Hours since the start.
    pub(crate) hours: f64,
    /// Resident memory in MiB.
    pub(crate) memory: f64,
    /// Open descriptors.
    pub(crate) descriptors: u64,
    /// Frames shown; 0 without the layer.
    pub(crate) frames: u64,
    /// GL names of the layer, as [`NAMES`].
    pub(crate) names: [u64; NAMES.len()],
}

/// Growth in MiB an hour and its standard error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Growth {
    pub(crate) rate: f64,
    pub(crate) error: f64,
}

/// Loading a level makes a saw-tooth over many samples, so neighbours are no independent measurements; the means of a dozen stretches
/// nearly are.
const STRETCHES: usize = 12;

/// Growth that the layer may add to that of the program itself, in MiB an hour. At 10 frames a second it is 116 bytes a frame: less than
/// the smallest allocation per draw would leak.
pub(crate) const TOLERANCE: f64 = 4.0;

/// Growth of fewer standard errors is no proof of growth.
const ERRORS: f64 = 3.0;

/// The samples after the first quarter: before that, levels, shaders and caches are loaded for the first time.
pub(crate) fn settled(samples: &[Sample]) -> &[Sample] {
    &samples[samples.len() / 4..]
}

/// The line of least squares through the means of the stretches.
pub(crate) fn growth(samples: &[Sample]) -> Growth {
    let length = samples.len().div_ceil(STRETCHES).max(1);
    let mean = |part: &[Sample], value: fn(&Sample) -> f64| {
        part.iter().map(value).sum::<f64>() / part.len() as f64
    };
    let points: Vec<(f64, f64)> = samples
        .chunks(length)
        .map(|part| (mean(part, |s| s.hours), mean(part, |s| s.memory)))
        .collect();
    let n = points.len() as f64;
    let x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let y = points.iter().map(|p| p.1).sum::<f64>() / n;
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    if points.len() < 3 || spread == 0.0 {
        return Growth {
            rate: 0.0,
            error: f64::INFINITY,
        };
    }
    let rate = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    let rest: f64 = points
        .iter()
        .map(|p| (p.1 - y - rate * (p.0 - x)).powi(2))
        .sum();
    Growth {
        rate,
        error: (rest / (n - 2.0) / spread).sqrt(),
    }
}

/// The failures, and a line with the measurements. `bare` is the program without the layer at the same time.
pub(crate) fn judge(bare: &[Sample], layer: &[Sample]) -> (Vec<String>, String) {
    let (bare, layer) = (settled(bare), settled(layer));
    let (without, with) = (growth(bare), growth(layer));
    let noise = ERRORS * without.error.hypot(with.error);
    let limit = without.rate.max(0.0) + TOLERANCE + noise;
    let mut wrong = Vec::new();
    if !noise.is_finite() {
        wrong.push("too few samples".to_owned());
    } else if with.rate > limit {
        wrong.push(format!(
            "memory grows by {:.1} MiB an hour, {limit:.1} are allowed",
            with.rate
        ));
    }
    let mut grows = |what: &str, value: &dyn Fn(&Sample) -> u64| {
        let third = layer.len() / 3;
        let first = median(layer[..third].iter().map(value));
        let last = median(layer[layer.len() - third..].iter().map(value));
        if last > first {
            wrong.push(format!("{what} grow from {first} to {last}"));
        }
        format!("{last} {what}")
    };
    let mut counts = vec![grows("descriptors", &|s| s.descriptors)];
    for (at, name) in NAMES.iter().enumerate() {
        counts.push(grows(name, &|s| s.names[at]));
    }
    let megabytes = |samples: &[Sample]| samples.last().map_or(0.0, |s| s.memory);
    let measured = format!(
        "memory {:.0} MiB, growth {:+.2} ± {:.2} MiB an hour (without the layer {:.0} MiB, {:+.2} ± {:.2}; allowed {limit:.2}); {}; {} frames",
        megabytes(layer),
        with.rate,
        with.error,
        megabytes(bare),
        without.rate,
        without.error,
        counts.join(", "),
        layer.last().map_or(0, |s| s.frames),
    );
    (wrong, measured)
}

fn median(values: impl Iterator<Item = u64>) -> u64 {
    let mut sorted: Vec<u64> = values.collect();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).copied().unwrap_or(0)
}

/// An hour and a half of a program that loads a level every five minutes and leaks `leak` MiB and `textures` textures an hour.
fn made_up(leak: f64, textures: f64) -> Vec<Sample> {
    (0..1080)
        .map(|at| {
            let hours = f64::from(at) / 720.0;
            let warm = 200.0 * (1.0 - (-hours * 20.0).exp());
            Sample {
                hours,
                memory: 100.0 + warm + 30.0 * (hours * 12.0).fract() + leak * hours,
                names: [5 + (textures * hours) as u64, 8, 0, 1, 0, 2, 0],
                ..Sample::default()
            }
        })
        .collect()
}

#[test]
fn levels_that_are_loaded_are_no_leak() {
    let (wrong, measured) = judge(&made_up(0.0, 0.0), &made_up(0.0, 0.0));
    assert!(wrong.is_empty(), "{wrong:?}: {measured}");
}

#[test]
fn a_leak_is_one_unless_the_program_has_it_too() {
    let leak = 30.0;
    let (wrong, measured) = judge(&made_up(0.0, 0.0), &made_up(leak, 0.0));
    assert!(wrong[0].starts_with("memory grows"), "{measured}");
    let (wrong, measured) = judge(&made_up(leak, 0.0), &made_up(leak, 0.0));
    assert!(wrong.is_empty(), "{measured}");
}

#[test]
fn one_texture_more_is_a_leak() {
    let (wrong, _) = judge(&made_up(0.0, 0.0), &made_up(0.0, 1.0));
    assert_eq!(wrong, ["textures grow from 5 to 6"]);
}

#[test]
fn a_run_of_no_length_is_no_success() {
    let (wrong, _) = judge(&made_up(0.0, 0.0)[..2], &made_up(0.0, 0.0)[..2]);
    assert_eq!(wrong, ["too few samples"]);
}
