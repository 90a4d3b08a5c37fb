//! Current values, read and restored.

use super::super::Current;
use crate::gl::consts as c;
use crate::gl::fake::{Fake, Scope};
use crate::state::Effect;

/// A driver whose current values all differ from the initial ones.
fn driver() -> Fake {
    let fake = Fake::new().limit(c::MAX_TEXTURE_COORDS, &[3.0]);
    let quarter = [0.25, 0.5, 0.75, 1.0];
    for (name, values) in [
        (c::CURRENT_COLOR, &quarter[..]),
        (c::CURRENT_SECONDARY_COLOR, &quarter[..3]),
        (c::CURRENT_NORMAL, &[1.0, 0.0, 0.0]),
        (c::CURRENT_FOG_COORD, &[3.0]),
        (c::EDGE_FLAG, &[0.0]),
        (c::ACTIVE_TEXTURE, &[f64::from(c::TEXTURE0 + 1)]),
    ] {
        fake.put(Scope::Context, name, values);
    }
    for unit in 0..3 {
        let place = [f64::from(unit), 1.0, 2.0, 3.0];
        fake.put(Scope::Unit(unit), c::CURRENT_TEXTURE_COORDS, &place);
    }
    for (at, face) in [(1.0, c::FRONT), (2.0, c::BACK)] {
        for name in [c::AMBIENT, c::DIFFUSE, c::SPECULAR, c::EMISSION] {
            fake.put(Scope::Face(face), name, &[at; 4]);
        }
        fake.put(Scope::Face(face), c::SHININESS, &[at]);
    }
    fake
}

/// Effects of a program's calls, each with a call that has it.
const CHANGES: [(Effect, &str); 8] = [
    (Effect::COLOR, "glColor4f"),
    (Effect::NORMAL, "glNormal3f"),
    (Effect::SECONDARY, "glSecondaryColor3f"),
    (Effect::FOG, "glFogCoordf"),
    (Effect::EDGE, "glEdgeFlag"),
    (Effect::TEXCOORD, "glMultiTexCoord4f"),
    (Effect::MULTITEX, "glMultiTexCoord4f"),
    (Effect::MATERIAL, "glMaterialfv"),
];

/// The calls of a program that change everything.
fn disturb(fake: &Fake) {
    fake.program(|gl| {
        gl.color_4f(0.0, 0.0, 0.0, 0.0);
        gl.normal_3f(0.0, 1.0, 0.0);
        gl.secondary_color_3f(0.0, 0.0, 0.0);
        gl.fog_coordf(9.0);
        gl.edge_flag(1);
        for unit in 0..3 {
            gl.multi_tex_coord_4f(c::TEXTURE0 + unit, 9.0, 9.0, 9.0, 9.0);
        }
        for name in [
            c::AMBIENT,
            c::DIFFUSE,
            c::SPECULAR,
            c::EMISSION,
            c::SHININESS,
        ] {
            gl.material(c::FRONT_AND_BACK, name, &[9.0; 4]);
        }
    });
}

#[test]
fn everything_comes_back() {
    for kinds in [Effect::ALL, Effect::UNKNOWN] {
        let fake = driver();
        let (gl, before) = (fake.gl(), fake.state());
        let current = Current::take(&gl, kinds, false);
        fake.assert_restored(&before);
        disturb(&fake);
        assert!(!before.differences(&fake.state()).is_empty());
        current.put(&gl);
        fake.assert_restored(&before);
    }
}

#[test]
fn only_what_is_asked_for_is_taken() {
    for (kind, command) in CHANGES {
        let fake = driver();
        let gl = fake.gl();
        let current = Current::take(&gl, kind, false);
        fake.forget();
        current.put(&gl);
        let calls = fake.calls();
        assert!(calls.iter().all(|call| call.name == command), "{calls:?}");
        let expected = match kind {
            Effect::MULTITEX => 3,
            Effect::MATERIAL => 10,
            _ => 1,
        };
        assert_eq!(calls.len(), expected, "{command}");
    }
}

#[test]
fn a_material_that_follows_the_colour_takes_it_anew() {
    for (follows, popped, expected) in [(true, true, 2), (true, false, 0), (false, true, 0)] {
        let fake = driver();
        let gl = fake.gl();
        let on = [f64::from(u8::from(follows))];
        fake.put(Scope::Context, c::COLOR_MATERIAL, &on);
        let before = fake.state();
        let current = Current::take(&gl, Effect::COLOR, popped);
        fake.forget();
        current.put(&gl);
        assert_eq!(fake.count("glEnable") + fake.count("glDisable"), expected);
        fake.assert_restored(&before);
    }
}

#[test]
fn what_follows_the_colour_of_a_material_is_left_alone() {
    let both = c::AMBIENT_AND_DIFFUSE;
    for (face, parameter, popped, expected) in [
        (c::FRONT_AND_BACK, both, false, 6),
        (c::FRONT, both, false, 8),
        (c::BACK, c::SPECULAR, false, 9),
        // It may follow no more when it is restored.
        (c::FRONT_AND_BACK, both, true, 10),
    ] {
        let fake = driver();
        let gl = fake.gl();
        fake.put(Scope::Context, c::COLOR_MATERIAL, &[1.0]);
        fake.put(Scope::Context, c::COLOR_MATERIAL_FACE, &[f64::from(face)]);
        fake.put(
            Scope::Context,
            c::COLOR_MATERIAL_PARAMETER,
            &[f64::from(parameter)],
        );
        let current = Current::take(&gl, Effect::MATERIAL, popped);
        assert_eq!(fake.count("glGetMaterialfv"), expected);
        fake.forget();
        current.put(&gl);
        assert_eq!(fake.count("glMaterialfv"), expected);
    }
}
