//! `manyview doctor` tells what a program would find, from contexts that it really creates.

use crate::support;
use crate::support::{Screen, library, manyview, target_folder};
use serde_json::Value;
use std::process::Command;

fn doctor(arguments: &[&str], variables: &[(&str, &str)]) -> (Option<i32>, String, String) {
    library();
    let probe = target_folder().join("manyview-probe");
    assert!(
        probe.is_file(),
        "{} is missing: run `make build` first",
        probe.display()
    );
    let screen: Screen = support::screen();
    let mut command: Command = manyview();
    command.arg("doctor").args(arguments);
    command.envs(variables.iter().copied());
    let output = screen
        .give(&mut command)
        .output()
        .expect("the command starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// The probe of one API.
fn probe<'a>(findings: &'a Value, api: &str) -> &'a Value {
    let probes = findings["probes"].as_array().expect("probes");
    probes
        .iter()
        .find(|probe| probe["api"] == api)
        .expect("every API is tried")
}

#[test]
fn every_api_has_a_context_with_the_layer_in_it() {
    // The caller's own settings do not change the answer.
    let (status, stdout, stderr) = doctor(&["--json"], &[("MANYVIEW_VIEWS", "1")]);
    assert_eq!(status, Some(0), "{stderr}");
    let findings: Value = serde_json::from_str(&stdout).expect("JSON");
    for api in ["glx", "egl", "osmesa"] {
        let probe = probe(&findings, api);
        assert_eq!(probe["error"], Value::Null, "{probe}");
        assert_eq!(probe["hooked"], true, "{probe}");
        assert_eq!(probe["strategies"][0], "replay", "{probe}");
        assert!(probe["version"].is_string() && probe["renderer"].is_string());
    }
}

#[test]
fn an_old_driver_is_said_to_replay() {
    let (status, stdout, _) = doctor(&[], &[("MESA_GL_VERSION_OVERRIDE", "2.1")]);
    assert_eq!(status, Some(0));
    assert!(stdout.contains("OpenGL 2.1"), "{stdout}");
    assert!(stdout.contains("strategies: replay\n"), "{stdout}");
    assert!(stdout.contains("need GLSL 1.50"), "{stdout}");
}

#[test]
fn a_driver_without_framebuffer_objects_is_status_3() {
    let old = [
        ("MESA_GL_VERSION_OVERRIDE", "2.1"),
        (
            "MESA_EXTENSION_OVERRIDE",
            "-GL_ARB_framebuffer_object -GL_EXT_texture_array",
        ),
    ];
    let (status, stdout, stderr) = doctor(&[], &old);
    assert_eq!(status, Some(3), "{stdout}");
    assert!(stdout.contains("strategies: none"), "{stdout}");
    assert_eq!(stderr.lines().count(), 1, "{stderr}");
}

#[test]
fn a_layer_that_is_switched_off_is_said_to_be() {
    let (status, stdout, _) = doctor(&[], &[("MANYVIEW_DISABLE", "1")]);
    assert_eq!(status, Some(0));
    assert!(stdout.contains("MANYVIEW_DISABLE is set"), "{stdout}");
}
