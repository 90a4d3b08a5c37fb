//! Real shaders, of programs and of piglit, are rewritten; a shader that the driver compiles before the rewrite compiles after it, with the
//! same interface.
//!
//! `make shaders` unpacks the programs. Their shaders are files of their own, or strings in the executable.

use crate::support::target_folder;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Shaders of programs, as files and strings, that the driver has to compile unchanged.
const LEAST: usize = 200;
/// Median time of one rewrite.
const LONGEST_MICROSECONDS: f64 = 5000.0;
/// Shaders per call of the probe: few enough to find one that crashes a driver.
const AT_ONCE: usize = 2000;
const WAYS: [&str; 3] = ["replay", "layers", "tiles"];
const ENDINGS: [&str; 13] = [
    "shader_test",
    "vert",
    "frag",
    "geom",
    "tesc",
    "tese",
    "glsl",
    "vs",
    "fs",
    "gs",
    "vsh",
    "fsh",
    "comp",
];
/// Mesa takes for ever to link it, also unchanged: piglit checks that other drivers are faster.
const ENDLESS: &str = "inline-explosion";

/// The prefix of OpenArena's renderer to its shaders.
const OPENARENA: &str = "#version 150\n#define attribute in\n#define texture2D texture\n#define textureCubeLod textureLod\n\
     #define shadow2D texture\n#define M_PI 3.14159265358979323846\n#define MAX_SHADER_DEFORM_PARMS 7\n";

/// All files below a folder, by name.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => folders.push(entry.path()),
                Ok(kind) if kind.is_file() => found.push(entry.path()),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

fn is_shader(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    let name = path.to_string_lossy();
    ending.is_some_and(|ending| ENDINGS.contains(&ending)) && !name.contains(ENDLESS)
}

/// Shaders between zero bytes of an executable, each with a file extension for its stage.
fn strings(path: &Path) -> Vec<(&'static str, String)> {
    let mut bytes = Vec::new();
    let mut file = fs::File::open(path).expect("a file");
    let mut magic = [0; 4];
    if file.read_exact(&mut magic).is_err() || magic != *b"\x7fELF" {
        return Vec::new();
    }
    file.read_to_end(&mut bytes).expect("a file");
    let texts = bytes
        .split(|&byte| byte == 0)
        .filter_map(|part| std::str::from_utf8(part).ok());
    let texts = texts.filter(|text| text.contains("void main") && text.contains("gl_"));
    let renderer = path.to_string_lossy().contains("renderer_opengl2");
    let all = texts.map(|text| {
        let stage = match text {
            _ if text.contains("EmitVertex") => "geom",
            _ if text.contains("gl_Position") => "vert",
            _ => "frag",
        };
        match stage {
            // Both stages in one text, as in goxel.
            _ if text.contains("#ifdef VERTEX_SHADER") => vec![
                ("vert", format!("#define VERTEX_SHADER\n{text}")),
                ("frag", format!("#define FRAGMENT_SHADER\n{text}")),
            ],
            "vert" if renderer => {
                let varying = "#define varying out\n";
                vec![(stage, format!("{OPENARENA}{varying}{text}"))]
            }
            _ if renderer => {
                let varying =
                    "#define varying in\nout vec4 out_Color;\n#define gl_FragColor out_Color\n";
                vec![(stage, format!("{OPENARENA}{varying}{text}"))]
            }
            _ => vec![(stage, text.to_owned())],
        }
    });
    all.flatten().collect()
}

/// Shaders of programs, each distinct text once.
fn of_programs(unpacked: &Path, written: &Path) -> Vec<PathBuf> {
    let mut seen = BTreeMap::new();
    fs::create_dir_all(written).expect("a folder");
    for path in files(unpacked) {
        if is_shader(&path) {
            seen.entry(fs::read(&path).expect("a file")).or_insert(path);
            continue;
        }
        for (stage, text) in strings(&path) {
            let name = path.file_name().expect("a name").to_string_lossy();
            let name = format!("{name}-{}.{stage}", seen.len());
            seen.entry(text.into_bytes())
                .or_insert_with(|| written.join(name));
        }
    }
    for (text, path) in &seen {
        if path.starts_with(written) {
            fs::write(path, text).expect("a file");
        }
    }
    seen.into_values().collect()
}

/// The probe's answers about files.
fn probed(files: &[PathBuf]) -> Vec<Value> {
    let mut lines = Vec::new();
    for files in files.chunks(AT_ONCE) {
        let mut probe = Command::new(target_folder().join("manyview-probe"));
        let mut probe = probe
            .args(["rewrite", "-"])
            .env("LIBGL_ALWAYS_SOFTWARE", "1")
            // Mesa does not check a text again that is in its cache, even if a context of the other API put it there.
            .env("MESA_SHADER_CACHE_DISABLE", "true")
            .env("MESA_GLSL_CACHE_DISABLE", "true")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("manyview-probe: run `make build` first");
        let names: String = files
            .iter()
            .map(|path| format!("{}\n", path.display()))
            .collect();
        let mut stdin = probe.stdin.take().expect("a pipe");
        // The probe reads all names before it answers.
        stdin.write_all(names.as_bytes()).expect("names");
        drop(stdin);
        let output = probe.wait_with_output().expect("an end");
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(
            output.status.success(),
            "{}: after {:?}",
            output.status,
            text.lines().last()
        );
        lines.extend(
            text.lines()
                .map(|line| serde_json::from_str::<Value>(line).expect("JSON")),
        );
    }
    lines
}

/// Counts of outcomes, and the failures.
#[derive(Default)]
struct Sum {
    compiled: usize,
    counts: BTreeMap<String, usize>,
    microseconds: Vec<f64>,
    wrong: Vec<String>,
}

impl Sum {
    fn of(lines: &[Value]) -> Self {
        let mut sum = Self::default();
        for line in lines {
            let file = line["file"].as_str().expect("a file");
            if let Some(way) = line["linked"].as_str() {
                sum.judge(file, way, line["same"] == true, &line["log"]);
                *sum.counts.entry(format!("linked, {way}")).or_default() += 1;
            } else if line["before"] == true {
                sum.compiled += 1;
                sum.microseconds.extend(line["microseconds"].as_f64());
                for way in WAYS {
                    let (word, why) = (&line[way][0], &line[way][1]);
                    let word = word.as_str().expect("a word");
                    sum.judge(file, way, word != "failed", why);
                    let mut what = format!("{way}, {word}");
                    if word == "refused" {
                        what = format!("{what}: {}", why.as_str().expect("a reason"));
                    }
                    *sum.counts.entry(what).or_default() += 1;
                }
            }
        }
        sum.microseconds.sort_by(f64::total_cmp);
        sum
    }

    fn judge(&mut self, file: &str, way: &str, right: bool, log: &Value) {
        if !right {
            self.wrong.push(format!("{file}, {way}: {log}"));
        }
    }

    fn median(&self) -> f64 {
        self.microseconds
            .get(self.microseconds.len() / 2)
            .copied()
            .unwrap_or(0.0)
    }

    fn print(&self, what: &str) {
        println!(
            "{what}: {} compile as they are; a rewrite takes {:.1} µs (median)",
            self.compiled,
            self.median()
        );
        for (what, count) in &self.counts {
            println!("{count:7} {what}");
        }
    }
}

/// Lines that the rewrite adds do not change the line number in a compiler message.
#[test]
fn messages_name_the_program_s_lines() {
    let folder = tempfile::tempdir().expect("a folder");
    let vertex = "void main() {\n    gl_Position = vec4(0.0);\n    mistake();\n}\n";
    let fragment = "precision mediump float;\nvoid main() {\n    gl_FragColor = gl_FragCoord;\n    mistake();\n}\n";
    let every = [
        ("plain.vert", String::from(vertex)),
        ("numbered.vert", format!("#version 120\n{vertex}")),
        ("core.vert", format!("#version 330\n\n{vertex}")),
        ("moved.vert", format!("#version 150\n#line 40\n{vertex}")),
        ("es.frag", format!("#version 100\n{fragment}")),
        (
            "condition.frag",
            format!("#version 120\n#line 70\n#if 1\n{}#endif\n", &fragment[25..]),
        ),
        (
            "condition_core.frag",
            format!(
                "#version 330 compatibility\n#line 70\n#if 1\n{}#endif\n",
                &fragment[25..]
            ),
        ),
    ];
    let paths: Vec<_> = every
        .iter()
        .map(|(name, text)| {
            let path = folder.path().join(name);
            fs::write(&path, text).expect("a file");
            path
        })
        .collect();
    let lines = probed(&paths);
    assert_eq!(lines.len(), every.len());
    let reported = |log: &Value| {
        let log = log.as_str().expect("a log");
        let line = log
            .split(" error: no function")
            .next()
            .and_then(|before| before.rsplit("0:").next());
        let line = line
            .and_then(|place| place.split('(').next())
            .and_then(|line| line.parse::<u32>().ok());
        line.unwrap_or_else(|| panic!("{log}"))
    };
    for line in lines {
        let before = reported(&line["log"]);
        for way in WAYS.iter().filter(|way| line[**way][0] == "failed") {
            assert_eq!(reported(&line[*way][1]), before, "{line}");
        }
        assert_eq!(line["replay"][0], "failed", "{line}");
    }
}

#[test]
#[ignore = "ten minutes"]
fn full_shaders_of_programs_and_piglit_compile_as_before() {
    let target = target_folder().parent().expect("a folder");
    let unpacked = target.join("shaders/packages");
    let mut programs = of_programs(&unpacked, &target.join("shaders/strings"));
    programs.extend(
        files(Path::new("/usr/share/glmark2/shaders"))
            .into_iter()
            .filter(|path| is_shader(path)),
    );
    let folders = fs::read_dir("/usr/lib").into_iter().flatten().flatten();
    let piglit: Vec<_> = folders
        .flat_map(|folder| files(&folder.path().join("piglit")))
        .filter(|path| is_shader(path))
        .collect();
    let mut wrong = Vec::new();
    for (what, files, least) in [("programs", programs, LEAST), ("piglit", piglit, 0)] {
        let sum = Sum::of(&probed(&files));
        sum.print(what);
        assert!(
            sum.compiled >= least,
            "{} shaders of programs: run `make shaders`",
            sum.compiled
        );
        assert!(sum.median() < LONGEST_MICROSECONDS);
        wrong.extend(sum.wrong);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
