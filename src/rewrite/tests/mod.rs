//! Rewritten shaders, refusals, and line numbers.
#![forbid(unsafe_code)]

use super::*;
use std::fs;
use std::path::{Path, PathBuf};

mod malformed;
mod points;

const REPLAY: Options = Options {
    amplifier: Amplifier::Replay,
    target: Target::Whole,
    views: 1,
    es: false,
};
const LAYERS: Options = Options {
    amplifier: Amplifier::Instanced,
    target: Target::Layer(VertexLayer::ArbShaderViewportLayerArray),
    views: 8,
    es: false,
};
const TILES: Options = Options {
    target: Target::Tiles,
    ..LAYERS
};
const DISTORTED: Options = Options {
    target: Target::DistortedRays,
    ..REPLAY
};
const ES: Options = Options { es: true, ..REPLAY };

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src/rewrite/tests/shaders")
}

fn stage(file: &str) -> Stage {
    match file.rsplit('.').next() {
        Some("vert") => Stage::Vertex,
        Some("tese") => Stage::TessEvaluation,
        Some("geom") => Stage::Geometry,
        Some("frag") => Stage::Fragment,
        other => panic!("{other:?} is no stage"),
    }
}

/// The result for a program's source, as it is kept in a snapshot.
fn shown(source: &[u8], stage: Stage, options: &Options) -> String {
    match rewrite(source, stage, options) {
        Ok(rewritten) => {
            let text = String::from_utf8_lossy(&rewritten.text).replace('\r', "␍");
            let first = rewritten.first_distance;
            let first = first.map_or(String::new(), |first| format!("// distance {first}\n"));
            let same = matches!(rewritten.text, Cow::Borrowed(_));
            format!("{first}{}{text}", if same { "// as it was\n" } else { "" })
        }
        Err(refusal) => format!("// refused: {refusal}\n"),
    }
}

#[test]
fn real_shaders() {
    let every: [(&str, &[(&str, Options)]); 19] = [
        ("light-110.vert", &[("replay", REPLAY), ("layers", LAYERS)]),
        ("sized-150.vert", &[("layers", LAYERS), ("tiles", TILES)]),
        (
            "toon-120.vert",
            &[
                ("replay", REPLAY),
                ("layers", LAYERS),
                ("distorted", DISTORTED),
            ],
        ),
        ("water-130.vert", &[("replay", REPLAY), ("tiles", TILES)]),
        ("wave-150.vert", &[("layers", LAYERS)]),
        ("crowd-330.vert", &[("layers", LAYERS), ("tiles", TILES)]),
        ("parts-420.vert", &[("layers", LAYERS), ("tiles", TILES)]),
        ("cut-420.vert", &[("tiles", TILES)]),
        ("terrain-410.tese", &[("replay", REPLAY)]),
        ("fur-150.geom", &[("replay", REPLAY)]),
        ("streams-400.geom", &[("replay", REPLAY)]),
        ("edges-150.frag", &[("replay", REPLAY)]),
        (
            "haze-110.frag",
            &[("replay", REPLAY), ("distorted", DISTORTED)],
        ),
        (
            "help-110.frag",
            &[("replay", REPLAY), ("distorted", DISTORTED)],
        ),
        (
            "shared-330.frag",
            &[("replay", REPLAY), ("distorted", DISTORTED)],
        ),
        ("web-100.vert", &[("es", ES)]),
        ("web-100.frag", &[("es", ES)]),
        ("phone-300.vert", &[("es", ES)]),
        ("phone-300.frag", &[("es", ES)]),
    ];
    for (file, ways) in every {
        let source = fs::read(folder().join(file)).unwrap();
        for (way, options) in ways {
            let shown = shown(&source, stage(file), options);
            insta::assert_snapshot!(format!("{file}-{way}"), shown);
        }
    }
}

#[test]
fn odd_layouts() {
    let every: [(&str, &str); 15] = [
        ("no arguments in words", "void main(void) { }\n"),
        ("in a macro", "#define ENTRY void main()\nENTRY { }\n"),
        ("in a macro of a name", "#define GO main\nvoid GO() { }\n"),
        (
            "line ends of DOS",
            "#version 120\r\nvoid main()\r\n{\r\n}\r\n",
        ),
        (
            "joined lines",
            "#define ENTRY \\\n void ma\\\nin \\\n ()\nENTRY { }\n",
        ),
        (
            "two, one of which counts",
            "#ifdef A\nvoid main() { }\n#else\nvoid main() { gl_Position = vec4(1.); }\n#endif\n",
        ),
        ("no end of the line", "void main() { }"),
        ("comment at the end", "void main() { } // main"),
        ("backslash at the end", "void main() { } // main \\"),
        ("joined at the end", "void main() { } // main \\\n"),
        ("open comment", "void main() { } /* main"),
        (
            "comments",
            "void /* main */ main // main\n() { /* // */ } // */ main\n",
        ),
        ("counted zeros", "void main() { }\0\0"),
        ("a helper", "vec4 moved(vec4 p) { return p; }\n"),
        ("not UTF-8", "void main() { } // \u{e9}\n"),
    ];
    let mut all = String::new();
    for (what, source) in every {
        // One byte of Latin-1 in the place of the two.
        let bytes: Vec<u8> = source.chars().map(|c| c as u8).collect();
        let source = if source.is_ascii() {
            source.as_bytes()
        } else {
            &bytes
        };
        all += &format!("--- {what}\n{}\n", shown(source, Stage::Vertex, &REPLAY));
    }
    insta::assert_snapshot!(all);
}

#[test]
fn refusals_are_sentences() {
    let main = "void main() { }\n";
    let with = |text: &str| format!("#version 430\n{text}\n{main}");
    let every: [(Stage, Options, String); 23] = [
        (Stage::Vertex, REPLAY, "void main() { }\0 int a;".to_owned()),
        (Stage::Vertex, REPLAY, with("#include \"common.glsl\"")),
        (Stage::Vertex, REPLAY, with("#define JOIN(a, b) a##b")),
        (Stage::Vertex, REPLAY, with("#define w 3")),
        (Stage::Vertex, REPLAY, with("#define main other")),
        (Stage::Vertex, REPLAY, with("uniform U { int main; } u; int a = u.main;")),
        (Stage::Vertex, REPLAY, with("out gl_PerVertex { float gl_PointSize; };")),
        (Stage::Vertex, LAYERS, format!("#version 300 es\n{main}")),
        (Stage::Vertex, TILES, main.to_owned()),
        (Stage::Vertex, LAYERS, with("void f() { gl_Layer = 1; }")),
        (Stage::Vertex, TILES, with("void f() { gl_ClipVertex = vec4(1.0); }")),
        (Stage::Vertex, TILES, with("void f() { for (int i = 0; i < 2; i++) gl_ClipDistance[i] = 1.; }")),
        (Stage::Vertex, TILES, with("out float gl_ClipDistance[N];")),
        (Stage::Vertex, TILES, with("out float gl_ClipDistance[7];")),
        (Stage::TessEvaluation, LAYERS, main.to_owned()),
        (Stage::Geometry, LAYERS, main.to_owned()),
        (Stage::Geometry, Options { target: Target::Tiles, ..REPLAY }, main.to_owned()),
        (Stage::Geometry, REPLAY, with("void f() { EmitStreamVertex(1); }")),
        (Stage::Fragment, TILES, with("float f() { return gl_ClipDistance[0]; }")),
        (Stage::Fragment, DISTORTED, with("void f() { gl_FragData[1] = vec4(1.); }")),
        (Stage::Fragment, DISTORTED, with("layout(early_fragment_tests) in;")),
        (Stage::Fragment, DISTORTED, format!("#version 300 es\n{main}")),
        (
            Stage::Fragment,
            REPLAY,
            "#ifdef A\nfloat a = gl_FragCoord.x;\n#endif\n#ifdef B\n#extension all : warn\n#endif\n".to_owned(),
        ),
    ];
    let mut all = String::new();
    for (stage, options, source) in every {
        let refusal = rewrite(source.as_bytes(), stage, &options).expect_err(&source);
        all += &format!("{refusal}\n");
    }
    insta::assert_snapshot!(all);
}

#[test]
fn what_a_text_uses() {
    let of = |file: &str| facts(&fs::read(folder().join(file)).unwrap(), false).unwrap();
    assert!(of("light-110.vert").projection && of("wave-150.vert").projection);
    assert!(!of("toon-120.vert").projection && of("toon-120.vert").instance);
    assert!(of("edges-150.frag").upper_left && of("edges-150.frag").frag_coord);
    assert!(of("edges-150.frag").whole_centre && !of("help-110.frag").whole_centre);
    assert!(!of("help-110.frag").main);
    assert_eq!(
        of("web-100.vert").version,
        Version {
            number: 110,
            es: false
        }
    );
    assert_eq!(
        of("phone-300.vert").version,
        Version {
            number: 300,
            es: true
        }
    );
    let names = |file: &str| -> Vec<String> {
        let matrices = of(file).matrices.into_iter();
        let named = |m: Matrix| {
            m.block
                .map_or(m.name.clone(), |block| format!("{block}.{}", m.name))
        };
        matrices.map(named).collect()
    };
    assert_eq!(names("toon-120.vert"), ["view", "projection"]);
    assert_eq!(
        names("crowd-330.vert"),
        [
            "Camera.view",
            "Camera.projection",
            "Camera.previous",
            "Bones.bones"
        ]
    );
}

#[test]
fn names_of_the_program_are_left_alone() {
    let names = |text: &str| {
        rewrite(text.as_bytes(), Stage::Vertex, &REPLAY)
            .unwrap()
            .names
    };
    assert_eq!(names("mat4 mv_matrix;").uniform(Uniform::Shift), "mv_shift");
    assert_eq!(names("int mv_main;").uniform(Uniform::Shift), "mv1_shift");
    assert_eq!(
        names("int mv_by, mv1_up, mv2_view;").uniform(Uniform::Up),
        "mv3_up"
    );
}
