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

#[test]
fn the_material_keeps_the_colour_that_it_followed() {
    let bits = COLOUR.map(f32::to_bits);
    assert_eq!(kept(set_colour), Some(bits));
    let again = |gl: &Gl| {
        gl.material(c::BACK, c::DIFFUSE, &[0.0; 4]);
        set_colour(gl);
        gl.enable(c::COLOR_MATERIAL);
        gl.material(c::BACK, c::DIFFUSE, &[0.5; 4]);
    };
    assert_eq!(kept(again), Some(bits), "glMaterial sets nothing meanwhile");
}

#[test]
fn only_the_driver_knows_a_material_after_a_list() {
    let after = |gl: &Gl| {
        set_colour(gl);
        gl.call_list(ListName(9));
    };
    assert_eq!(kept(after), None);
}
