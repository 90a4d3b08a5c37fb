//! Shaders of points for all views at once.

use super::*;

const VERTEX: &str = "#version 330 core\nin vec3 place;\nout vec4 shade;\nvoid main() { shade = vec4(1.0); gl_Position = vec4(place, 1.0); }\n";

fn made(vertex: &str, fragment: &str, compatibility: bool) -> String {
    made_for(PointsTo::Samples, vertex, fragment, compatibility)
}

fn made_for(to: PointsTo, vertex: &str, fragment: &str, compatibility: bool) -> String {
    match points(vertex.as_bytes(), fragment.as_bytes(), to, compatibility) {
        Ok(made) => format!(
            "// geometry\n{}\n// fragment\n{}",
            made.geometry,
            String::from_utf8_lossy(&made.fragment)
        ),
        Err(refusal) => format!("// refused: {refusal}\n"),
    }
}

#[test]
fn disks_of_a_viewer() {
    let fragment = "#version 330 core\n\
                    flat in vec4 shade; in highp float far, near;\n\
                    layout(pixel_center_integer) in;\n";
    assert!(made(VERTEX, &(fragment.to_owned() + "void main() { }\n"), false).contains("refused"));
    let fragment = "#version 330 core\n\
                    // Where it is.\n\
                    flat in vec4 shade; in highp float far, near;\n\
                    out vec4 colour;\n\
                    void main() {\n\
                    \x20   if (dot(gl_PointCoord, gl_PointCoord) > 1.0) discard;\n\
                    \x20   colour = gl_FrontFacing ? shade * near : vec4(gl_FragCoord.xy, far, shade.r);\n\
                    }\n";
    insta::assert_snapshot!(made(VERTEX, fragment, false));
}

#[test]
fn colours_and_coordinates_of_fixed_function() {
    let vertex =
        "#version 120\nvarying vec3 n;\nvoid main() { n = gl_Normal; gl_Position = gl_Vertex; }\n";
    let fragment = "#version 120\n\
                    uniform sampler2D image;\n\
                    varying vec3 n;\n\
                    void main() { gl_FragColor = gl_Color * vec4(n, 1.0) + texture2D(image, gl_TexCoord[1].st) + gl_FogFragCoord; }\n";
    insta::assert_snapshot!(made(vertex, fragment, true));
}

#[test]
fn refusals() {
    let with = |text: &str| format!("#version 430\n{text}\nvoid main() {{ }}\n");
    let plain = with("");
    let mut all = String::new();
    for (vertex, fragment) in [
        (
            with("out gl_PerVertex { vec4 gl_Position; };"),
            plain.clone(),
        ),
        (
            with("void f() { gl_ClipDistance[0] = 1.0; }"),
            plain.clone(),
        ),
        (with("vec4 f() { return ftransform(); }"), plain.clone()),
        (with("int mv_clip;"), plain.clone()),
        (plain.clone(), with("in Block { vec4 a; } b;")),
        (plain.clone(), with("in vec4 a[2];")),
        (plain.clone(), with("in Struct a;")),
        (
            plain.clone(),
            with("in float far; struct S { float far; }; float f(S s) { return s.far + far; }"),
        ),
        (plain.clone(), with("#ifdef A\nin vec4 a;\n#endif")),
        (
            plain.clone(),
            with("float f() { return dFdx(gl_FragCoord.x); }"),
        ),
        (
            plain.clone(),
            with("uniform sampler2D s; vec4 f() { return texture(s, gl_PointCoord); }"),
        ),
        (plain.clone(), with("int f() { return gl_PrimitiveID; }")),
        (plain.clone(), with("layout(early_fragment_tests) in;")),
        (plain.clone(), "#version 430\nvoid f() { }\n".to_owned()),
        (
            plain.clone(),
            "#version 300 es\nvoid main() { }\n".to_owned(),
        ),
        (
            "#version 120\nvoid main() { }\n".to_owned(),
            "#version 120\nvoid main() { gl_FragColor = gl_TexCoord[i]; }\n".to_owned(),
        ),
    ] {
        all += &made(&vertex, &fragment, true);
    }
    insta::assert_snapshot!(all);
    // A texture at a place that all of a point has.
    let sampled = with("uniform sampler2D s; in vec2 at; vec4 f() { return texture(s, at); }");
    assert!(!made(&plain, &sampled, true).contains("refused"));
}

#[test]
fn points_in_layers() {
    let vertex = "#version 330 core\nin vec3 place;\nflat out vec4 shade;\nout float far;\n\
                  void main() { shade = vec4(1.0); far = 1.0; gl_PointSize = 2.0; gl_Position = vec4(place, 1.0); }\n";
    let fragment = "#version 330 core\n\
                    flat in vec4 shade; in float far;\n\
                    out vec4 colour;\n\
                    void main() { colour = shade * far + float(gl_PrimitiveID) * gl_PointCoord.x; }\n";
    insta::assert_snapshot!(made_for(PointsTo::Layers(16), vertex, fragment, false));
    let layer = "#version 430\nvoid main() { int a = gl_Layer; }\n";
    assert!(made_for(PointsTo::Layers(16), vertex, layer, false).contains("refused"));
}

#[test]
fn points_as_surfaces() {
    let vertex = "#version 150\nin vec3 place;\nflat out vec4 shade;\n\
                  void main() { shade = vec4(1.0); gl_Position = vec4(place, 1.0); }\n";
    let fragment = "#version 150\nflat in vec4 shade;\nout vec4 colour;\n\
                    void main() { colour = shade; }\n";
    insta::assert_snapshot!(made_for(PointsTo::Surfaces(16), vertex, fragment, false));
    let round = fragment.replace("= shade", "= shade * gl_PointCoord.x");
    assert!(made_for(PointsTo::Surfaces(16), vertex, &round, false).contains("refused"));
}
