//! Drivers other than the newest version of Mesa's llvmpipe: older versions of OpenGL and of its shading language, and other drivers of Mesa's.
//!
//! The layer's own passes are compiled in every version, and make the same pictures in an old one. `make test-drivers` runs the main tests on each
//! of the drivers as well, and writes docs/drivers.md.

mod pictures;
mod table;

use crate::support;
use manyview::interleave::shader::{GlslVersion, Pass, Stage, translate};
use pictures::{Shown, shown};
use std::process::Command;

/// A driver, by the variables that choose it.
struct Driver {
    /// As in the table.
    name: &'static str,
    variables: &'static [(&'static str, &'static str)],
    /// The version of the shading language, × 100, at least.
    glsl: u32,
    /// Whether it is llvmpipe, and makes the same pictures to the bit in each version.
    llvmpipe: bool,
    /// How failures begin that docs/drivers.md explains.
    known: &'static [&'static str],
}

/// llvmpipe in the version of the other tests.
const NEWEST: Driver = Driver {
    name: "llvmpipe",
    variables: &[],
    glsl: 450,
    llvmpipe: true,
    known: &[],
};

/// The same without framebuffers that are upside down as windows are. A context of an older version has none, and rounds pictures otherwise.
const UPRIGHT: Driver = Driver {
    name: "llvmpipe, upright",
    variables: &[("MESA_EXTENSION_OVERRIDE", "-GL_MESA_framebuffer_flip_y")],
    glsl: 450,
    llvmpipe: true,
    known: &[],
};

/// llvmpipe in a version of OpenGL and of the shading language.
macro_rules! version {
    ($name:literal, $gl:literal, $glsl:literal) => {
        Driver {
            name: $name,
            variables: &[
                ("MESA_GL_VERSION_OVERRIDE", $gl),
                ("MESA_GLSL_VERSION_OVERRIDE", stringify!($glsl)),
            ],
            glsl: $glsl,
            llvmpipe: true,
            known: &[],
        }
    };
}

/// The oldest version that has all passes.
const OLD: Driver = version!("llvmpipe as 3.0", "3.0", 130);

const DRIVERS: [Driver; 10] = [
    NEWEST,
    version!("llvmpipe as 4.6", "4.6COMPAT", 460),
    version!("llvmpipe as 4.3", "4.3COMPAT", 430),
    version!("llvmpipe as 4.2", "4.2COMPAT", 420),
    version!("llvmpipe as 3.3", "3.3COMPAT", 330),
    version!("llvmpipe as 3.1", "3.1COMPAT", 140),
    OLD,
    version!("llvmpipe as 2.1", "2.1", 120),
    Driver {
        name: "softpipe",
        variables: &[
            ("GALLIUM_DRIVER", "softpipe"),
            ("LIBGL_ALWAYS_SOFTWARE", "1"),
        ],
        glsl: 330,
        llvmpipe: false,
        known: &["replay", "instanced", "geometry", "outputs: depth_beside"],
    },
    Driver {
        name: "zink on lavapipe",
        variables: &[
            ("MESA_LOADER_DRIVER_OVERRIDE", "zink"),
            ("LIBGL_ALWAYS_SOFTWARE", "1"),
        ],
        glsl: 330,
        llvmpipe: false,
        known: &[],
    },
];

/// By the reference compiler of Khronos, which a lenient driver is not.
#[test]
fn every_pass_is_valid_in_every_version() {
    if !support::has("glslangValidator") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let mut names = Vec::new();
    for version in GlslVersion::SUPPORTED {
        let fragments = Pass::all().map(|pass| (pass, Stage::Fragment, "frag"));
        // All passes have the same vertex shader.
        for (pass, stage, ending) in fragments.chain([(Pass::Layout, Stage::Vertex, "vert")]) {
            let text = translate(pass, stage, version).expect("GLSL").source;
            let name = format!("{pass:?} {version}.{ending}");
            std::fs::write(folder.path().join(&name), text).expect("written");
            names.push(name);
        }
    }
    let mut validator = Command::new("glslangValidator");
    let output = validator.args(&names).current_dir(folder.path()).output();
    let output = output.expect("glslangValidator");
    let text = String::from_utf8_lossy(&output.stdout);
    let errors: Vec<&str> = text.lines().filter(|l| l.contains("ERROR")).collect();
    assert!(output.status.success(), "{}", errors.join("\n"));
}

#[test]
fn every_pass_links_in_every_version_of_the_driver() {
    support::library();
    let mut probe = support::bare(support::target_folder().join("manyview-probe"));
    let (_, stdout, stderr) = support::run(probe.arg("passes"));
    let lines: Vec<serde_json::Value> = stdout
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    let versions: Vec<&str> = lines.iter().filter_map(|l| l["glsl"].as_str()).collect();
    for needed in [
        "GLSL 130",
        "GLSL 330",
        "GLSL 430",
        "GLSL ES 300",
        "GLSL ES 320",
    ] {
        assert!(
            versions.contains(&needed),
            "{needed}: {versions:?} {stderr}"
        );
    }
    for line in &lines {
        assert_eq!(line["failed"], serde_json::json!([]), "{}", line["glsl"]);
        assert_eq!(line["linked"], Pass::all().count(), "{}", line["glsl"]);
    }
}

/// The panel's picture, straight from the views, with fewer pixels in each, and synthesised; another output; to the bit those of the newest
/// version.
#[test]
fn an_old_version_makes_the_same_pictures() {
    for name in ["panel", "view scale", "anaglyph", "depth-image", "hybrid"] {
        let [newest, old] = [UPRIGHT, OLD].map(|driver| shown(name, &driver));
        for shown in [&newest, &old] {
            assert_eq!(shown.refusal, None, "{name}");
        }
        assert_eq!(newest.differs(&old), 0, "{name}");
    }
}

/// Without passes for its shading language the CPU interleaves, and all views are drawn.
#[test]
fn a_version_without_passes_says_so() {
    let [newest, older] = [UPRIGHT, version!("", "2.1", 120)].map(|d| shown("panel", &d));
    assert_eq!(newest.differs(&older), 0, "the CPU makes the same picture");
    let refused = |shown: Shown| shown.refusal.unwrap_or_default();
    let reason = "GLSL 120 is too old";
    assert!(refused(older).contains(reason));
    let older = shown("depth-image", &version!("", "2.1", 120));
    assert!(refused(older).contains(reason));
}

/// Runs the main tests on all drivers.
#[test]
#[ignore = "half an hour, for make test-drivers"]
fn drivers_are_as_good_as_the_newest() {
    table::write(&DRIVERS);
}
