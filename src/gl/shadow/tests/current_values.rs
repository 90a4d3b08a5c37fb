//! Current values: colour, normal, texture coordinates and so on.

use super::*;
use crate::gl::{Ends, Recording, slot};

const COLOR: Key = Key::Value(c::CURRENT_COLOR);
const NORMAL: Key = Key::Value(c::CURRENT_NORMAL);
const FOG: Key = Key::Value(c::CURRENT_FOG_COORD);

fn coordinates(unit: u32) -> Key {
    Key::Unit(c::CURRENT_TEXTURE_COORDS, unit)
}

fn floats(values: [f32; 4]) -> Option<[u32; 4]> {
    Some(values.map(f32::to_bits))
}

#[test]
fn they_are_those_of_the_last_call() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let real = fake.real();
    let [two, three, four] = [&[0.5f64; 2] as &[f64], &[0.5; 3], &[0.5; 4]];
    let [half, quarter] = [0.5, 0.25];
    current(&shadow, || {
        // SAFETY: arrays of as many values as the commands read.
        unsafe {
            real.glColor3f(0.5, 0.25, 1.0);
            assert_eq!(known(&shadow, COLOR), floats([0.5, 0.25, 1.0, 1.0]));
            real.glColor4dv(four.as_ptr() as _);
            assert_eq!(known(&shadow, COLOR), floats([0.5; 4]));
            real.glColor3s(1, 2, 3);
            assert_eq!(known(&shadow, COLOR), None, "drivers convert it");
            real.glNormal3dv(three.as_ptr() as _);
            assert_eq!(known(&shadow, NORMAL), floats([0.5, 0.5, 0.5, 0.0]));
            real.glNormal3b(1, 2, 3);
            assert_eq!(known(&shadow, NORMAL), None);
            real.glTexCoord2i(7, -3);
            assert_eq!(
                known(&shadow, coordinates(0)),
                floats([7.0, -3.0, 0.0, 1.0])
            );
            real.glMultiTexCoord2dv(c::TEXTURE0 + 3, two.as_ptr() as _);
            assert_eq!(
                known(&shadow, coordinates(3)),
                floats([half, half, 0.0, 1.0])
            );
            real.glMultiTexCoord2f(c::TEXTURE0 + 40, half, quarter);
            for unit in [0, 3] {
                assert_eq!(
                    known(&shadow, coordinates(unit)),
                    None,
                    "some unit takes it"
                );
            }
            real.glFogCoordd(0.25);
            assert_eq!(known(&shadow, FOG), floats([quarter, 0.0, 0.0, 0.0]));
            real.glColor3f(half, half, half);
            real.glEvalPoint1(0);
            for key in [COLOR, FOG] {
                assert_eq!(known(&shadow, key), None, "an evaluator may set it");
            }
        }
    });
}

/// Binds a vertex array object of which the driver has told that it is bound.
fn other_array_object(fake: &Fake) {
    let gl = fake.gl();
    gl.bind_vertex_array(gl.gen_vertex_array());
    assert_ne!(gl.get_integer(c::VERTEX_ARRAY_BINDING), 0);
}

/// An element sets the values of the arrays that are on.
#[test]
fn an_array_element_makes_unknown_what_its_arrays_set() {
    type Enable = fn(&Fake);
    // SAFETY: of each: no pointers that are read.
    let cases: [(Enable, [bool; 4]); 9] = [
        (|_| (), [true; 4]),
        (
            |fake| unsafe { fake.real().glEnableClientState(c::COLOR_ARRAY) },
            [false, true, true, true],
        ),
        (
            |fake| unsafe {
                fake.real().glEnableClientState(c::TEXTURE_COORD_ARRAY);
                // It may be on again after a glPopClientAttrib.
                fake.real().glDisableClientState(c::TEXTURE_COORD_ARRAY);
            },
            [true, true, false, true],
        ),
        (
            |fake| unsafe {
                fake.real().glClientActiveTexture(c::TEXTURE0 + 1);
                fake.real().glEnableClientState(c::TEXTURE_COORD_ARRAY);
            },
            [true, true, false, false],
        ),
        (
            |fake| unsafe {
                const C4F_N3F_V3F: u32 = 0x2A26;
                let none = core::ptr::null_mut();
                fake.real().glInterleavedArrays(C4F_N3F_V3F, 0, none);
            },
            [false, false, false, true],
        ),
        (
            |fake| unsafe { fake.real().glEnableVertexAttribArray(3) },
            [false; 4],
        ),
        // Mesa 22.3 takes the arrays as capabilities.
        (
            |fake| unsafe { fake.real().glEnable(c::NORMAL_ARRAY) },
            [false; 4],
        ),
        (other_array_object, [false; 4]),
        (
            |fake| {
                other_array_object(fake);
                // SAFETY: no pointers.
                unsafe { fake.real().glEnableClientState(c::COLOR_ARRAY) };
                fake.gl()
                    .bind_vertex_array(crate::gl::VertexArrayName::ZERO);
            },
            [true; 4],
        ),
    ];
    for (case, (enable, keeps)) in cases.into_iter().enumerate() {
        let fake = Fake::new().window(64, 32);
        let shadow = shadow(&fake);
        current(&shadow, || {
            let gl = fake.gl();
            gl.bind_vertex_array(crate::gl::VertexArrayName::ZERO);
            enable(&fake);
            gl.color_4f(0.5, 0.5, 0.5, 1.0);
            gl.normal_3f(0.0, 1.0, 0.0);
            gl.multi_tex_coord_4f(c::TEXTURE0, 0.5, 0.5, 0.0, 1.0);
            gl.multi_tex_coord_4f(c::TEXTURE0 + 1, 0.5, 0.5, 0.0, 1.0);
            // SAFETY: the fake driver reads no arrays.
            unsafe { fake.real().glArrayElement(0) };
            let keys = [COLOR, NORMAL, coordinates(0), coordinates(1)];
            let known = keys.map(|key| known(&shadow, key).is_some());
            assert_eq!(known, keeps, "case {case}");
        });
    }
}

/// glPopAttrib makes those unknown that were changed. Setting one to itself is no change.
#[test]
fn those_that_were_changed_are_unknown_after_a_pop() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        gl.fog_coordf(0.5);
        gl.normal_3f(0.0, 0.0, 1.0);
        gl.push_attrib(c::CURRENT_BIT);
        gl.fog_coordf(0.5);
        gl.normal_3f(0.0, 1.0, 0.0);
        gl.pop_attrib();
        assert_eq!(known(&shadow, FOG), floats([0.5, 0.0, 0.0, 0.0]));
        assert_eq!(known(&shadow, NORMAL), None);
    });
}

/// Of a recording, the last call of each value counts.
#[test]
fn they_are_those_of_a_recording() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let gl = fake.gl();
    let color = |recording: &mut Recording, red: f32| {
        recording.call(slot::glColor3f, |rec| {
            [red, 0.0, 0.5].into_iter().for_each(|v| rec.f32(v));
        });
    };
    let mut recording = Recording::default();
    color(&mut recording, 0.1);
    for unit in [0, 2] {
        recording.call(slot::glMultiTexCoord2f, |rec| {
            rec.u32(c::TEXTURE0 + unit);
            rec.f32(0.25);
            rec.f32(unit as f32);
        });
    }
    recording.call(slot::glVertex2f, |rec| {
        [0.0; 2].into_iter().for_each(|v| rec.f32(v));
    });
    color(&mut recording, 0.9);
    current(&shadow, || {
        gl.normal_3f(0.0, 0.0, 1.0);
        gl.replay(c::POINTS, &recording, Ends::default());
        assert_eq!(known(&shadow, COLOR), floats([0.9, 0.0, 0.5, 1.0]));
        assert_eq!(known(&shadow, NORMAL), floats([0.0, 0.0, 1.0, 0.0]));
        for unit in [0, 2] {
            let there = [0.25, unit as f32, 0.0, 1.0];
            assert_eq!(known(&shadow, coordinates(unit)), floats(there));
        }
        assert_eq!(known(&shadow, coordinates(1)), None);
        recording.call(slot::glEvalPoint1, |rec| rec.i32(0));
        gl.replay(c::POINTS, &recording, Ends::default());
        for key in [COLOR, NORMAL, coordinates(2)] {
            assert_eq!(known(&shadow, key), None, "an evaluator may set it");
        }
    });
}

/// What a list sets, only the driver knows afterwards. Arrays become vertices in it.
#[test]
fn a_list_makes_unknown_what_it_sets() {
    type Fill = fn(&Fake);
    let fills: [(Fill, bool, bool); 3] = [
        (
            |fake| {
                let gl = fake.gl();
                gl.begin(c::TRIANGLES);
                gl.color_4f(1.0, 0.0, 0.0, 1.0);
                gl.end();
                gl.begin(c::TRIANGLES);
                gl.color_4f(1.0, 0.0, 0.0, 1.0);
                gl.end();
            },
            false,
            true,
        ),
        (
            |fake| {
                // SAFETY: the fake driver reads no arrays.
                unsafe {
                    fake.real().glEnableClientState(c::COLOR_ARRAY);
                    fake.real().glDrawArrays(c::POINTS, 0, 1);
                }
            },
            false,
            true,
        ),
        (|fake| fake.gl().viewport(0, 0, 8, 8), true, true),
    ];
    for (fill, keeps_color, keeps_normal) in fills {
        let fake = Fake::new().window(64, 32);
        let shadow = shadow(&fake);
        let gl = fake.gl();
        let list = crate::gl::ListName(7);
        current(&shadow, || {
            gl.bind_vertex_array(crate::gl::VertexArrayName::ZERO);
            gl.normal_3f(0.0, 1.0, 0.0);
            gl.color_4f(0.5, 0.5, 0.5, 1.0);
            let questions = asked(&fake, |gl| {
                gl.new_list(list, c::COMPILE);
                fill(&fake);
                gl.end_list();
            });
            assert_eq!(questions, 0, "no primitive is open");
            assert!(known(&shadow, COLOR).is_some() && known(&shadow, NORMAL).is_some());
            gl.call_list(list);
            assert_eq!(known(&shadow, COLOR).is_some(), keeps_color);
            assert_eq!(known(&shadow, NORMAL).is_some(), keeps_normal);
        });
    }
}

/// The driver refuses the end of a list between its glBegin and its glEnd, also those of lists that it calls, if they are executed.
#[test]
fn the_end_of_a_list_is_asked_about_within_a_primitive() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let [opens, calls] = [7, 8].map(crate::gl::ListName);
    current(&shadow, || {
        let questions = asked(&fake, |gl| {
            gl.new_list(opens, c::COMPILE);
            gl.begin(c::TRIANGLES);
            gl.end_list();
        });
        assert_eq!(questions, 1);
        for (mode, expected) in [(c::COMPILE, 0), (c::COMPILE_AND_EXECUTE, 1)] {
            let questions = asked(&fake, |gl| {
                gl.new_list(calls, mode);
                gl.call_list(opens);
                gl.end_list();
            });
            assert_eq!(questions, expected);
        }
    });
}

/// Bytes are believed once the driver has converted them as expected often enough.
#[test]
fn bytes_are_asked_about_until_they_are_proven() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let real = fake.real();
    // SAFETY: no pointers.
    let set = |bytes: [u8; 3]| unsafe { real.glColor3ub(bytes[0], bytes[1], bytes[2]) };
    let answer = |value: Option<[u32; 4]>| {
        let value = value.expect("a value");
        shadow.shadow.borrow_mut().answered(COLOR, value);
    };
    let of = |bytes: [u8; 3]| {
        let [r, g, b] = bytes.map(|byte| f32::from(byte) / 255.0);
        floats([r, g, b, 1.0])
    };
    current(&shadow, || {
        // What any conversion gives proves nothing.
        for _ in 0..50 {
            set([0, 255, 0]);
            answer(of([0, 255, 0]));
        }
        for at in 0..32 {
            set([at, 7, 9]);
            assert_eq!(known(&shadow, COLOR), None, "{at}");
            answer(of([at, 7, 9]));
        }
        set([99, 7, 9]);
        assert_eq!(known(&shadow, COLOR), of([99, 7, 9]));
    });
}

/// Also a wrong answer begins the proof anew.
#[test]
fn bytes_that_a_driver_converts_otherwise_are_never_believed() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        for at in 0..80 {
            // SAFETY: no pointers.
            unsafe { fake.real().glColor3ub(at, 7, 9) };
            assert_eq!(known(&shadow, COLOR), None);
            let value = floats([f32::from(at) * (1.0 / 255.5), 0.0, 0.0, 1.0]);
            shadow
                .shadow
                .borrow_mut()
                .answered(COLOR, value.expect("a value"));
        }
    });
}
