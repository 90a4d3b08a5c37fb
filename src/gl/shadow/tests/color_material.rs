//! The material while it follows the colour.

use super::*;
use crate::gl::ListName;

const COLOUR: [f32; 4] = [0.25, 0.5, 0.75, 1.0];

/// What is kept of a material after GL_COLOR_MATERIAL was on for a while.
fn kept(meanwhile: impl FnOnce(&Gl)) -> Option<[u32; 4]> {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        gl.disable(c::COLOR_MATERIAL);
        gl.enable(c::COLOR_MATERIAL);
        meanwhile(&gl);
        gl.disable(c::COLOR_MATERIAL);
    });
    known(&shadow, Key::Material(c::BACK, c::DIFFUSE))
}

fn set_colour(gl: &Gl) {
    let [r, g, b, a] = COLOUR;
    gl.color_4f(r, g, b, a);
}

fn set_material(gl: &Gl) {
    gl.material(c::BACK, c::DIFFUSE, &[0.5; 4]);
}

#[test]
fn the_material_keeps_the_colour_that_it_followed() {
    let bits = COLOUR.map(f32::to_bits);
    assert_eq!(kept(set_colour), Some(bits));
    let again = |gl: &Gl| {
        set_material(gl);
        set_colour(gl);
        gl.enable(c::COLOR_MATERIAL);
        set_material(gl);
    };
    assert_eq!(kept(again), Some(bits), "glMaterial sets nothing meanwhile");
}

#[test]
fn only_the_driver_knows_a_material_after_a_list() {
    let list = ListName(9);
    for sets in [set_colour, set_material] {
        for executes in [false, true] {
            let after = |gl: &Gl| {
                set_colour(gl);
                gl.new_list(
                    list,
                    [c::COMPILE, c::COMPILE_AND_EXECUTE][usize::from(executes)],
                );
                sets(gl);
                gl.end_list();
                if !executes {
                    gl.call_list(list);
                }
            };
            assert_eq!(kept(after), None, "executes: {executes}");
        }
    }
}

/// A list that is executed while it is compiled sets what follows the colour, and nothing else of the material, unless it calls glMaterial or
/// pops what follows. In a new context GL_AMBIENT_AND_DIFFUSE of both faces follows.
#[test]
fn an_executed_list_sets_what_follows() {
    type Commands = fn(&Gl);
    let cases: [(Commands, [bool; 2]); 5] = [
        (|gl| gl.viewport(0, 0, 8, 8), [true, true]),
        (set_colour, [true, false]),
        (set_material, [false, false]),
        (
            |gl| {
                gl.push_attrib(c::CURRENT_BIT);
                set_colour(gl);
                gl.pop_attrib();
            },
            [true, false],
        ),
        (
            |gl| {
                gl.push_attrib(c::LIGHTING_BIT);
                gl.pop_attrib();
            },
            [false, false],
        ),
    ];
    for (case, (commands, keeps)) in cases.into_iter().enumerate() {
        let fake = Fake::new().window(64, 32);
        let shadow = shadow(&fake);
        current(&shadow, || {
            let gl = fake.gl();
            gl.disable(c::COLOR_MATERIAL);
            for name in [c::SPECULAR, c::DIFFUSE] {
                gl.material(c::BACK, name, &[0.5; 4]);
            }
            gl.new_list(ListName(9), c::COMPILE_AND_EXECUTE);
            commands(&gl);
            gl.end_list();
        });
        let after =
            [c::SPECULAR, c::DIFFUSE].map(|name| known(&shadow, Key::Material(c::BACK, name)));
        assert_eq!(after.map(|value| value.is_some()), keeps, "case {case}");
    }
}

/// glColorMaterial makes other parameters follow.
fn follow(fake: &Fake, parameter: u32) {
    // SAFETY: no pointers.
    unsafe { fake.real().glColorMaterial(c::FRONT_AND_BACK, parameter) };
}

#[test]
fn what_follows_is_not_known_while_it_does() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let value = |name| known(&shadow, Key::Material(c::BACK, name)).map(|v| v.map(f32::from_bits));
    current(&shadow, || {
        let gl = fake.gl();
        gl.disable(c::COLOR_MATERIAL);
        gl.material(c::BACK, c::DIFFUSE, &[0.5; 4]);
        gl.material(c::BACK, c::SPECULAR, &[0.5; 4]);
        follow(&fake, c::DIFFUSE);
        assert_eq!(value(c::DIFFUSE), Some([0.5; 4]), "nothing follows yet");
        gl.enable(c::COLOR_MATERIAL);
        gl.material(c::BACK, c::DIFFUSE, &[0.25; 4]);
        assert_eq!(value(c::DIFFUSE), None, "glMaterial has no effect");
        assert_eq!(value(c::SPECULAR), Some([0.5; 4]));
        follow(&fake, c::SPECULAR);
        assert_eq!([c::DIFFUSE, c::SPECULAR].map(value), [None; 2]);
        gl.material(c::BACK, c::DIFFUSE, &[0.25; 4]);
        assert_eq!(value(c::DIFFUSE), Some([0.25; 4]), "it follows no more");
    });
}
