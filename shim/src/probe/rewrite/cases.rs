//! Files with shaders: single shaders, whose stage follows from name or text, or tests of piglit, which hold programs.

use crate::egl::Kind;
use manyview_core::rewrite::{Stage, facts};
use std::fs;
use std::path::Path;

/// The shaders of one file.
pub(super) struct Case {
    pub(super) file: String,
    /// The context that the shaders are for.
    pub(super) kind: Kind,
    pub(super) shaders: Vec<(Stage, Vec<u8>)>,
    /// The shaders are all those of one program.
    pub(super) program: bool,
    /// The text does not tell OpenGL from OpenGL ES.
    pub(super) open: bool,
}

/// The shaders of a file. None if their stage is unknown.
pub(super) fn read(file: &str) -> Result<Option<Case>, String> {
    let bytes = fs::read(file).map_err(|error| format!("{file}: {error}"))?;
    if file.ends_with(".shader_test") {
        return Ok(piglit(file, &bytes));
    }
    let Some(stage) = stage(file, &bytes) else {
        return Ok(None);
    };
    let version = facts(&bytes, false).map(|facts| facts.version);
    let versioned = contains(&bytes, b"#version");
    let kind = match version {
        Ok(version) if version.es => Kind::Es,
        Ok(version) if version.number >= 140 && !contains(&bytes, b"compatibility") => Kind::Core,
        _ => Kind::Compatibility,
    };
    Ok(Some(Case {
        file: file.to_owned(),
        kind,
        shaders: vec![(stage, bytes)],
        program: false,
        open: !versioned,
    }))
}

fn contains(text: &[u8], word: &[u8]) -> bool {
    text.windows(word.len()).any(|part| part == word)
}

/// The stage of a shader, by the ending of the file, or else (as for `.glsl` and `.txt`) by words of the name and of the text.
fn stage(file: &str, text: &[u8]) -> Option<Stage> {
    let path = Path::new(file);
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    let name = path.file_stem()?.to_str()?.to_ascii_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
    Some(match ending.as_str() {
        "vert" | "vs" | "vsh" | "vp" => Stage::Vertex,
        "frag" | "fs" | "fsh" | "fp" => Stage::Fragment,
        "geom" | "gs" => Stage::Geometry,
        "tesc" => Stage::TessControl,
        "tese" => Stage::TessEvaluation,
        "comp" => Stage::Compute,
        _ if contains(text, b"EmitVertex") => Stage::Geometry,
        _ if has(&["vert", "_vs", "_vp"]) => Stage::Vertex,
        _ if has(&["frag", "_fs", "_fp", "_ps"]) => Stage::Fragment,
        _ if contains(text, b"gl_Position") => Stage::Vertex,
        _ if contains(text, b"gl_FragColor") || contains(text, b"texture") => Stage::Fragment,
        _ => return None,
    })
}

/// Reads a test of piglit. Its sections are headed by names in brackets: `[require]`, one for each shader, and the test itself. A shader without
/// `#version` gets that of `[require]`.
fn piglit(file: &str, bytes: &[u8]) -> Option<Case> {
    let mut case = Case {
        file: file.to_owned(),
        kind: Kind::Compatibility,
        shaders: Vec::new(),
        program: true,
        open: false,
    };
    let (mut version, mut section) = (String::from("110"), String::new());
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        let words = String::from_utf8_lossy(line);
        let words = words.trim();
        if let Some(name) = words
            .strip_prefix('[')
            .and_then(|rest| rest.strip_suffix(']'))
        {
            section = name.to_owned();
            let stage = match name {
                "vertex shader" => Stage::Vertex,
                "tessellation control shader" => Stage::TessControl,
                "tessellation evaluation shader" => Stage::TessEvaluation,
                "geometry shader" => Stage::Geometry,
                "fragment shader" => Stage::Fragment,
                "compute shader" => Stage::Compute,
                "vertex shader passthrough" => {
                    case.shaders.push((Stage::Vertex, PASSTHROUGH.to_vec()));
                    section.clear();
                    continue;
                }
                // Assembly programs, shaders in other files, and SPIR-V are not handled.
                _ => {
                    case.program &= !["program", "file", "spirv"]
                        .iter()
                        .any(|word| name.contains(word));
                    section = section.replace("shader", "");
                    continue;
                }
            };
            case.shaders.push((stage, Vec::new()));
        } else if section == "require" {
            require(words, &mut version, &mut case);
        } else if section.ends_with(" shader")
            && let Some((_, text)) = case.shaders.last_mut()
        {
            text.extend_from_slice(line);
        }
    }
    for (_, text) in &mut case.shaders {
        if !contains(text, b"#version ") {
            text.splice(0..0, format!("#version {version}\n").into_bytes());
        }
    }
    (!case.shaders.is_empty()).then_some(case)
}

/// piglit's own passthrough shader.
const PASSTHROUGH: &[u8] =
    b"#version 110\nattribute vec4 piglit_vertex;\nvoid main() { gl_Position = piglit_vertex; }\n";

fn require(line: &str, version: &mut String, case: &mut Case) {
    let mut words = line.split_whitespace();
    let last = || line.split_whitespace().next_back().unwrap_or_default();
    let number = || last().replace('.', "");
    match (words.next(), words.next()) {
        (Some("GLSL"), Some("ES")) => {
            let number = number();
            let es = if number == "100" { "" } else { " es" };
            *version = format!("{number}{es}");
            case.kind = Kind::Es;
        }
        (Some("GL"), Some("ES")) => case.kind = Kind::Es,
        (Some("GL"), Some("COMPAT" | "CORE")) if line.contains("COMPAT") => {
            case.kind = Kind::Compatibility;
            case.open = true;
        }
        (Some("GL"), Some(">=")) if last() >= "3.1" && !case.open => case.kind = Kind::Core,
        (Some("GLSL"), Some(">=")) => {
            *version = number();
            if version.as_str() >= "140" && !case.open {
                case.kind = Kind::Core;
            }
        }
        (Some("SSO"), _) => case.program = false,
        _ => {}
    }
}
