//! What is kept of the state is what a driver has: random calls against a driver that answers as the specification says.

mod color_material;
mod current_values;
mod own_names;
mod rectangles;

use super::key::{Key, bits};
use super::*;
use crate::gl::fake::{Fake, Scope};
use crate::gl::{Gl, ProgramName, TextureName};

/// Numbers that look random and are the same for the same seed (xorshift, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

/// A shadow of a new context of a fake driver.
fn shadow(fake: &Fake) -> ContextShadow {
    let shadow = ContextShadow::new(fake.real(), Shared::default());
    let mut inner = shadow.shadow.borrow_mut();
    for (name, value) in [
        (c::MAX_ATTRIB_STACK_DEPTH, 16),
        (c::MAX_CLIENT_ATTRIB_STACK_DEPTH, 16),
        (c::MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32),
        (c::MAX_TEXTURE_UNITS, 8),
        (c::MAX_MODELVIEW_STACK_DEPTH, 32),
    ] {
        inner.constants.insert(name, [value, 0, 0, 0]);
    }
    inner.attribs.base = Some(0);
    inner.client.base = Some(0);
    inner.put(Key::Value(c::ACTIVE_TEXTURE), Some([c::TEXTURE0, 0, 0, 0]));
    drop(inner);
    shadow
}

/// Runs `work` while the shadow is that of the current context.
fn current<R>(shadow: &ContextShadow, work: impl FnOnce() -> R) -> R {
    // SAFETY: it lives until the next line but one.
    unsafe { shadow.make_current() };
    let done = work();
    no_shadow();
    done
}

fn known(shadow: &ContextShadow, key: Key) -> Option<[u32; 4]> {
    shadow.shadow.borrow().values.known(key)
}

/// How often the driver was asked.
fn asked(fake: &Fake, work: impl FnOnce(&Gl)) -> usize {
    let gl = fake.gl();
    fake.forget();
    work(&gl);
    fake.count("glGet*") + fake.count("glIs*")
}

#[test]
fn a_value_is_asked_for_once() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let questions = asked(&fake, |gl| {
            assert_eq!(gl.get_integers(c::VIEWPORT), [0, 0, 64, 32]);
            assert_eq!(gl.get_integers(c::VIEWPORT), [0, 0, 64, 32]);
        });
        assert_eq!(questions, 1);
        let questions = asked(&fake, |gl| {
            gl.viewport(1, 2, 3, 4);
            assert_eq!(gl.get_integers(c::VIEWPORT), [1, 2, 3, 4]);
            gl.enable(c::BLEND);
            assert!(gl.is_enabled(c::BLEND) && gl.is_enabledi(c::BLEND, 0));
            gl.disablei(c::BLEND, 3);
            assert!(gl.is_enabled(c::BLEND) && !gl.is_enabledi(c::BLEND, 3));
        });
        assert_eq!(questions, 0);
    });
    // Without a shadow, each question reaches the driver.
    let twice = asked(&fake, |gl| {
        gl.get_integer(c::DEPTH_FUNC);
        gl.get_integer(c::DEPTH_FUNC);
    });
    assert_eq!(twice, 2);
}

#[test]
fn calls_that_a_driver_may_refuse_are_asked_about() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        gl.get_integer(c::DEPTH_FUNC);
        gl.depth_func(1);
        assert_eq!(known(&shadow, Key::Value(c::DEPTH_FUNC)), None);
        // The size is beyond what some drivers draw.
        gl.viewport(0, 0, 100_000, 1);
        assert_eq!(known(&shadow, Key::Value(c::VIEWPORT)), None);
        // A name is known once the driver has bound it.
        let bound = Key::Unit(c::TEXTURE_BINDING_2D, 0);
        gl.bind_texture(c::TEXTURE_2D, TextureName(7));
        assert_eq!(known(&shadow, bound), None);
        shadow.shadow.borrow_mut().answered(bound, [7, 0, 0, 0]);
        gl.bind_texture(c::TEXTURE_2D, TextureName(0));
        gl.bind_texture(c::TEXTURE_2D, TextureName(7));
        assert_eq!(known(&shadow, bound), Some([7, 0, 0, 0]));
        gl.use_texture(TextureName(7));
        gl.delete_texture(TextureName(7));
        assert_eq!(known(&shadow, bound), None);
        gl.bind_texture(c::TEXTURE_2D, TextureName(7));
        assert_eq!(known(&shadow, bound), None, "it may be of another kind now");
    });
}

#[test]
fn between_begin_and_end_the_driver_is_the_judge() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        gl.enable(c::BLEND);
        gl.begin(c::POINTS);
        gl.disable(c::BLEND);
        gl.end();
        assert_eq!(known(&shadow, Key::Cap(c::BLEND)), None);
        gl.disable(c::BLEND);
        assert_eq!(known(&shadow, Key::Cap(c::BLEND)), Some([0; 4]));
    });
}

#[test]
fn a_list_changes_the_state_when_it_is_called() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let blends = || known(&shadow, Key::Cap(c::BLEND)).map(|[on, ..]| on);
    current(&shadow, || {
        let gl = fake.gl();
        gl.disable(c::BLEND);
        gl.new_list(crate::gl::ListName(5), c::COMPILE);
        gl.enable(c::BLEND);
        gl.end_list();
        assert_eq!(blends(), Some(0));
        gl.call_list(crate::gl::ListName(5));
        assert_eq!(blends(), Some(1));
        gl.delete_list(crate::gl::ListName(5));
        gl.disable(c::BLEND);
        gl.call_list(crate::gl::ListName(5));
        assert_eq!(blends(), None, "whatever it does");
    });
}

/// Mesa 22.3 compiles glColorMaski and does not execute it.
#[test]
fn a_colour_mask_by_index_in_an_executed_list_is_not_known() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let mask = Key::Value(c::COLOR_WRITEMASK);
    current(&shadow, || {
        let (gl, list) = (fake.gl(), crate::gl::ListName(7));
        // SAFETY: no pointers.
        let set = |mask: u8| unsafe { fake.real().glColorMaski(0, mask, mask, mask, mask) };
        set(1);
        assert!(known(&shadow, mask).is_some());
        gl.new_list(list, c::COMPILE_AND_EXECUTE);
        set(0);
        gl.end_list();
        assert_eq!(known(&shadow, mask), None);
        set(1);
        gl.call_list(list);
        assert_eq!(known(&shadow, mask), Some([0; 4]));
    });
}

/// The driver has made all calls of a list before it can be asked for the depth of a stack: the pushes of the list may have been refused.
#[test]
fn what_a_list_pushes_on_a_stack_of_unknown_depth_is_not_known() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let [attributes, matrices] = [5, 6].map(crate::gl::ListName);
    let blends = || known(&shadow, Key::Cap(c::BLEND)).map(|[on, ..]| on);
    current(&shadow, || {
        let gl = fake.gl();
        gl.new_list(attributes, c::COMPILE);
        gl.push_attrib(c::COLOR_BUFFER_BIT);
        gl.enable(c::BLEND);
        gl.pop_attrib();
        gl.end_list();
        gl.new_list(matrices, c::COMPILE);
        // SAFETY: no pointers.
        unsafe { fake.real().glPushMatrix() };
        gl.load_matrix(&[2.0; 16]);
        // SAFETY: no pointers.
        unsafe { fake.real().glPopMatrix() };
        gl.end_list();
        // A full stack has one less after the refused push and the pop.
        fake.put(Scope::Context, c::ATTRIB_STACK_DEPTH, &[15.0]);
        fake.put(Scope::Context, c::MODELVIEW_STACK_DEPTH, &[31.0]);
        shadow.shadow.borrow_mut().attribs.forget();
        gl.disable(c::BLEND);
        gl.call_list(attributes);
        assert_eq!(blends(), None, "the pop restores what was pushed before");
        gl.matrix_mode(c::MODELVIEW);
        gl.load_matrix(&[1.0; 16]);
        gl.get_matrix(c::MODELVIEW_MATRIX);
        gl.call_list(matrices);
        assert_eq!(asked(&fake, |gl| _ = gl.get_matrix(c::MODELVIEW_MATRIX)), 1);
        // From now on the depths are known.
        gl.disable(c::BLEND);
        let questions = asked(&fake, |gl| {
            gl.call_list(attributes);
            gl.call_list(matrices);
            gl.get_matrix(c::MODELVIEW_MATRIX);
        });
        assert_eq!((questions, blends()), (0, Some(0)));
    });
}

/// Calls that nobody has followed may have set state by an index, and arrays of fixed function.
#[test]
fn what_was_changed_unseen_is_not_known() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let colour = Key::Value(c::CURRENT_COLOR);
    current(&shadow, || {
        let gl = fake.gl();
        assert!(!are_capabilities_indexed());
        shadow.changed();
        gl.bind_vertex_array(crate::gl::VertexArrayName::ZERO);
        assert!(are_capabilities_indexed());
        gl.color_4f(0.5, 0.5, 0.5, 1.0);
        assert!(known(&shadow, colour).is_some());
        // SAFETY: the fake driver reads no arrays.
        unsafe { fake.real().glArrayElement(0) };
        assert_eq!(known(&shadow, colour), None);
    });
}

/// Calls between the glBegin and the glEnd of a list are refused when the list is called, as others are; those that only set materials are not
/// kept as a primitive.
#[test]
fn a_list_may_have_primitives() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let list = crate::gl::ListName;
    let known_on = |cap| known(&shadow, Key::Cap(cap)).map(|[on, ..]| on);
    current(&shadow, || {
        let gl = fake.gl();
        gl.disable(c::BLEND);
        gl.disable(c::DEPTH_TEST);
        gl.disable(c::COLOR_MATERIAL);
        gl.new_list(list(5), c::COMPILE);
        gl.begin(c::POINTS);
        gl.enable(c::BLEND);
        gl.end();
        gl.enable(c::DEPTH_TEST);
        gl.end_list();
        assert_eq!([c::BLEND, c::DEPTH_TEST].map(known_on), [Some(0); 2]);
        gl.call_list(list(5));
        assert_eq!(
            [c::BLEND, c::DEPTH_TEST].map(known_on),
            [None, Some(1)],
            "the driver has refused the first, or not"
        );
        // A list that leaves a primitive open, and one that ends it.
        gl.new_list(list(6), c::COMPILE);
        gl.begin(c::POINTS);
        gl.end_list();
        gl.new_list(list(7), c::COMPILE_AND_EXECUTE);
        gl.end();
        gl.end_list();
        gl.call_list(list(6));
        gl.disable(c::DEPTH_TEST);
        assert_eq!(known_on(c::DEPTH_TEST), None);
        gl.call_list(list(7));
        gl.disable(c::DEPTH_TEST);
        assert_eq!(known_on(c::DEPTH_TEST), Some(0));
        // A material for each of many primitives.
        let ambient = || {
            let ambient = known(&shadow, Key::Material(c::FRONT, c::AMBIENT));
            ambient.map(|[red, ..]| f32::from_bits(red))
        };
        gl.new_list(list(8), c::COMPILE);
        for shade in 0..10_000 {
            gl.begin(c::POINTS);
            let value = [shade as f32, 0.0, 0.0, 1.0];
            // SAFETY: four values.
            unsafe {
                gl.real()
                    .glMaterialfv(c::FRONT, c::AMBIENT, value.as_ptr() as _)
            };
            gl.end();
        }
        gl.end_list();
        gl.call_list(list(8));
        assert_eq!(known_on(c::DEPTH_TEST), Some(0), "the list is kept");
        assert_eq!(ambient(), Some(9999.0));
        // Mesa 22.3 loses a material before an evaluator.
        gl.new_list(list(9), c::COMPILE);
        gl.begin(c::POINTS);
        gl.material(c::FRONT, c::AMBIENT, &[0.5; 4]);
        // SAFETY: no pointers.
        unsafe { gl.real().glEvalPoint1(0) };
        gl.end();
        gl.end_list();
        gl.call_list(list(9));
        assert_eq!(ambient(), None);
        // Also one in a list that is called after it.
        gl.new_list(list(10), c::COMPILE);
        gl.material(c::FRONT, c::AMBIENT, &[0.5; 4]);
        gl.end_list();
        gl.call_list(list(10));
        assert_eq!(ambient(), Some(0.5));
        gl.new_list(list(11), c::COMPILE);
        gl.material(c::FRONT, c::AMBIENT, &[0.25; 4]);
        gl.call_list(list(9));
        gl.end_list();
        gl.new_list(list(9), c::COMPILE);
        gl.end_list();
        gl.call_list(list(11));
        assert_eq!(ambient(), None);
    });
}

#[test]
fn attributes_belong_to_the_vertex_array_object() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let divided = |fake: &Fake| {
        let mut answer = false;
        let questions = asked(fake, |gl| answer = gl.has_divisors());
        (answer, questions > 0)
    };
    let bind = |array| {
        fake.gl()
            .bind_vertex_array(crate::gl::VertexArrayName(array));
        let key = Key::Value(c::VERTEX_ARRAY_BINDING);
        shadow.shadow.borrow_mut().answered(key, [array, 0, 0, 0]);
    };
    let real = fake.real();
    current(&shadow, || {
        shadow
            .shadow
            .borrow_mut()
            .constants
            .insert(c::MAX_VERTEX_ATTRIBS, [16, 0, 0, 0]);
        bind(1);
        assert_eq!(divided(&fake), (false, true));
        assert_eq!(divided(&fake), (false, false));
        // SAFETY: no pointers.
        unsafe { real.glVertexAttribDivisor(2, 1) };
        divided(&fake);
        // SAFETY: no pointers.
        unsafe { real.glEnableVertexAttribArray(3) };
        assert_eq!(divided(&fake), (false, false), "another one is on");
        // SAFETY: no pointers.
        unsafe { real.glVertexAttribDivisor(3, 1) };
        assert_eq!(divided(&fake), (true, false));
        // SAFETY: no pointers.
        unsafe { real.glVertexAttribDivisor(99, 1) };
        assert_eq!(divided(&fake), (true, false), "the driver has refused");
        bind(2);
        assert!(divided(&fake).1, "nothing is known of another one");
        bind(1);
        assert_eq!(divided(&fake), (true, false));
        // SAFETY: no pointers.
        unsafe { real.glDisableVertexAttribArray(3) };
        assert_eq!(divided(&fake), (false, false));
        // SAFETY: no pointers.
        unsafe { real.glVertexBindingDivisor(3, 1) };
        divided(&fake);
        assert!(divided(&fake).1, "only the driver knows from now on");
    });
}

/// The driver forgets subroutines when another program is used; those of a call that it has refused, or only compiled, were never chosen.
#[test]
fn subroutines_are_those_that_the_driver_has_taken() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let choose = |indices: &[u32]| {
        let (count, all) = (indices.len() as i32, indices.as_ptr() as _);
        // SAFETY: so many indices.
        unsafe {
            fake.real()
                .glUniformSubroutinesuiv(c::FRAGMENT_SHADER, count, all)
        };
    };
    let chosen = || {
        let chosen = subroutines_of(3);
        chosen
            .into_iter()
            .map(|(_, indices)| indices)
            .collect::<Vec<_>>()
    };
    current(&shadow, || {
        let gl = fake.gl();
        gl.use_program(ProgramName(3));
        let mut inner = shadow.shadow.borrow_mut();
        inner.answered(Key::Value(c::CURRENT_PROGRAM), [3, 0, 0, 0]);
        inner.subroutines.has(3, c::FRAGMENT_SHADER, [2, 4]);
        drop(inner);
        choose(&[1, 3]);
        assert_eq!(chosen(), [[1, 3]]);
        choose(&[1, 4]);
        choose(&[1]);
        gl.new_list(crate::gl::ListName(5), c::COMPILE);
        choose(&[0, 0]);
        gl.end_list();
        assert_eq!(chosen(), [[1, 3]]);
        fake.forget();
        gl.use_program(ProgramName(3));
        assert_eq!(fake.count("glUniformSubroutinesuiv"), 1);
        gl.use_program(ProgramName(4));
        assert_eq!(
            fake.count("glUniformSubroutinesuiv"),
            1,
            "not of another program"
        );
        forget_subroutines();
        assert!(chosen().is_empty());
    });
}

#[test]
fn another_context_may_have_changed_it() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || fake.gl().enable(c::BLEND));
    shadow.changed();
    assert_eq!(
        current(&shadow, || asked(&fake, |gl| _ = gl.is_enabled(c::BLEND))),
        1
    );
}

/// Values that glPushAttrib saves with different bits, one that it does not save, and one of which drivers do not agree.
const VALUES: [(Key, u32, u32); 6] = [
    (
        Key::Cap(c::DEPTH_TEST),
        c::DEPTH_BUFFER_BIT | bits::ENABLE,
        0,
    ),
    (Key::Value(c::DEPTH_FUNC), c::DEPTH_BUFFER_BIT, 0),
    (Key::Value(c::SCISSOR_BOX), bits::SCISSOR, 0),
    (Key::Unit(c::TEXTURE_BINDING_2D, 3), c::TEXTURE_BIT, 0),
    (Key::Value(c::CURRENT_PROGRAM), 0, 0),
    (Key::Cap(c::MULTISAMPLE), 0, u32::MAX),
];

/// The model saves all values at each push. What is kept is either what the model has, or unknown; and unknown only where the model says so.
#[test]
fn random_pushes_and_pops_are_those_of_a_model() {
    let fake = Fake::new().window(64, 32);
    let mut random = Random(0x5eed);
    for _ in 0..300 {
        let shadow = shadow(&fake);
        let mut s = shadow.shadow.borrow_mut();
        let mut model: [Option<u32>; 6] = [None; 6];
        let mut stack: Vec<(u32, [Option<u32>; 6])> = Vec::new();
        for _ in 0..60 {
            match random.below(5) {
                0 if stack.len() < 12 => {
                    let mask = [
                        c::DEPTH_BUFFER_BIT,
                        bits::SCISSOR,
                        c::TEXTURE_BIT,
                        bits::ENABLE,
                        u32::MAX,
                    ][random.below(5) as usize];
                    s.change(Change::PushAttrib(mask));
                    stack.push((mask, model));
                }
                1 => {
                    if let Some((mask, saved)) = stack.pop() {
                        s.change(Change::PopAttrib);
                        for (at, (_, sure, maybe)) in VALUES.iter().enumerate() {
                            if mask & sure != 0 {
                                model[at] = saved[at];
                            } else if mask & maybe != 0 && saved[at] != model[at] {
                                model[at] = None;
                            }
                        }
                    }
                }
                _ => {
                    let at = random.below(6) as usize;
                    let value = (random.below(8) > 0).then(|| random.below(4) as u32);
                    s.change(Change::Put(VALUES[at].0, value.map(|v| [v, 0, 0, 0])));
                    model[at] = value;
                }
            }
            for (at, (key, _, maybe)) in VALUES.iter().enumerate() {
                let kept = s.values.known(*key);
                let kept = kept.map(|[value, ..]| value);
                // Of those, a value that was set again to what it was counts as changed.
                let unsure = *maybe != 0 && kept.is_none();
                assert!(
                    kept == model[at] || unsure,
                    "{key:?}: {kept:?}, not {:?}",
                    model[at]
                );
                if unsure {
                    model[at] = None;
                }
            }
        }
    }
}

#[test]
fn uniforms_are_those_that_were_set() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        let program = ProgramName(3);
        gl.use_program(program);
        let used = Key::Value(c::CURRENT_PROGRAM);
        shadow.shadow.borrow_mut().answered(used, [3, 0, 0, 0]);
        // An array of two matrices, and a number behind it.
        gl.keep_uniform(program, 4, 0x8B5C, 2);
        gl.keep_uniform(program, 5, 0x8B5C, 1);
        gl.keep_uniform(program, 6, c::FLOAT, 1);
        let value = |at| shadow.shadow.borrow().uniforms.value(3, at);
        let matrix: [f32; 16] = std::array::from_fn(|i| i as f32);
        let before = gl.uniform_changes(program);
        gl.set_uniform_matrix(4, &matrix);
        assert_eq!(value(4), Some(matrix.map(f32::to_bits)));
        assert!(
            gl.is_uniform_unchanged(program, 6, before)
                && !gl.is_uniform_unchanged(program, 4, before)
        );
        // More elements than there are: those behind the array are left alone.
        let three = [[1.0f32; 16], [2.0; 16], [3.0; 16]].concat();
        // SAFETY: as many values as it says.
        unsafe { gl.real().glUniformMatrix4fv(4, 3, 0, three.as_ptr() as _) };
        assert_eq!(value(5), Some([2.0f32.to_bits(); 16]));
        assert_eq!(value(6), None);
        gl.uniform_1f(6, 0.5);
        assert_eq!(value(6).map(|v| v[0]), Some(0.5f32.to_bits()));
        // The driver refuses a number of another type.
        gl.uniform_1i(6, 1);
        assert_eq!(value(6), None);
        // SAFETY: one matrix.
        unsafe { gl.real().glUniformMatrix4fv(4, 1, 1, matrix.as_ptr() as _) };
        let transposed: [u32; 16] = std::array::from_fn(|i| ((i % 4 * 4 + i / 4) as f32).to_bits());
        assert_eq!(value(4), Some(transposed));
    });
    // A context without a shadow may have set any.
    fake.gl().uniform_1f(6, 0.25);
    assert_eq!(shadow.shadow.borrow().uniforms.value(3, 4), None);
}

#[test]
fn matrices_are_asked_for_until_they_are_proven() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        gl.matrix_mode(c::PROJECTION);
        let mut questions = Vec::new();
        for at in 0..40 {
            let matrix = [at as f32; 16];
            questions.push(asked(&fake, |gl| {
                gl.load_matrix(&matrix);
                assert_eq!(gl.get_matrix(c::PROJECTION_MATRIX), matrix);
            }));
        }
        assert_eq!(questions[0], 1);
        assert_eq!(questions[39], 0);
    });
}
