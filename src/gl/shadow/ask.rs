//! Questions: what is known is answered; else the driver is asked, and its answer is kept.

use super::key::{self, Form, Kept, Key};
use super::uniforms::BlockKind;
use super::{Shadow, matrices, with};
use crate::gl::consts as c;

/// Keeps a uniform, or an element of an array that has `left` elements from there on.
pub(in crate::gl) fn keep_uniform(program: u32, location: i32, kind: u32, left: u32) {
    with(|s| s.uniforms.keep(program, location, kind, left));
}

/// The value of a uniform: what is known, or what `ask` answers. Up to 16 numbers by their bits.
pub(in crate::gl) fn uniform(
    program: u32,
    location: i32,
    ask: impl Fn() -> [u32; 16],
) -> [u32; 16] {
    let uniforms = with(|s| s.uniforms.clone());
    let known = uniforms.as_ref().and_then(|u| u.value(program, location));
    if let Some(known) = known {
        if cfg!(feature = "check-shadow") {
            check(&("uniform", program, location), known, ask());
        }
        return known;
    }
    let value = ask();
    uniforms.inspect(|u| u.answered(program, location, value));
    value
}

/// A number that grows with changes of a program's uniforms.
pub(in crate::gl) fn uniform_changes(program: u32) -> u64 {
    with(|s| s.uniforms.changes(program)).unwrap_or(0)
}

/// Whether a uniform is known not to have changed since [`uniform_changes`] was this number.
pub(in crate::gl) fn is_uniform_unchanged(program: u32, location: i32, since: u64) -> bool {
    with(|s| s.uniforms.is_unchanged(program, location, since)) == Some(true)
}

/// The binding points of a program's uniform blocks: what is known, or what `ask` answers.
pub(in crate::gl) fn block_bindings(program: u32, ask: impl Fn() -> Vec<u32>) -> Vec<u32> {
    blocks(program, BlockKind::Uniform, ask)
}

/// The binding points of a program's storage blocks: what is known, or what `ask` answers.
pub(in crate::gl) fn storage_bindings(program: u32, ask: impl Fn() -> Vec<u32>) -> Vec<u32> {
    blocks(program, BlockKind::Storage, ask)
}

fn blocks(program: u32, kind: BlockKind, ask: impl Fn() -> Vec<u32>) -> Vec<u32> {
    let uniforms = with(|s| s.uniforms.clone());
    if let Some(known) = uniforms.as_ref().and_then(|u| u.blocks(program, kind)) {
        if cfg!(feature = "check-shadow") {
            assert_eq!(
                known,
                ask(),
                "bindings of blocks of program {program}, {kind:?}"
            );
        }
        return known;
    }
    let bindings = ask();
    uniforms.inspect(|u| u.blocks_are(program, kind, bindings.clone()));
    bindings
}

/// The value that glGet has for a name, in a form: what is known, or what `ask` answers.
pub(in crate::gl) fn value(name: u32, form: Form, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    if name == c::MATRIX_MODE && form == Form::Integers {
        return asked(
            &"matrix mode",
            |s| s.matrices.mode().map(|mode| [mode, 0, 0, 0]),
            ask,
            |s, v| {
                s.matrices.mode_is(v[0]);
            },
        );
    }
    if name == c::LIST_INDEX && form == Form::Integers {
        let list = |s: &mut Shadow| s.compiling.as_ref().map_or(0, |list| list.list);
        return asked(
            &"list that is compiled",
            |s| Some([list(s), 0, 0, 0]),
            ask,
            |_, _| (),
        );
    }
    if name == c::ATTRIB_STACK_DEPTH && form == Form::Integers {
        return asked(
            &"depth of the attribute stack",
            |s| s.attrib_depth().map(|depth| [depth as u32, 0, 0, 0]),
            ask,
            |_, _| (),
        );
    }
    if let (Some(stack), Form::Integers) = (matrices::stack_of_depth(name), form) {
        return asked(
            &stack,
            |s| s.matrices.depth(stack, s.unit()).map(|d| [d, 0, 0, 0]),
            ask,
            |s, v| {
                let unit = s.unit();
                s.matrices.depth_is(stack, unit, v[0]);
            },
        );
    }
    let ask = || {
        let mut answer = ask();
        answer[key::kept_of(name)..].fill(0);
        answer
    };
    // Drivers execute the vertices of a list that is compiled later.
    let compiling = || with(|s| s.compiling.is_some()) == Some(true);
    match key::kept(name) {
        Some(_) if key::is_current(name) && compiling() => ask(),
        Some((Kept::Constant, kept)) if kept == form => asked(
            &name,
            |s| s.constants.get(&name).copied(),
            ask,
            |s, v| {
                s.constants.insert(name, v);
            },
        ),
        Some((Kept::Value, kept)) if kept == form => by_key(|_| Some(Key::Value(name)), ask),
        Some((Kept::Unit, kept)) if kept == form => by_key(
            |s| {
                s.active_unit();
                s.unit().map(|unit| Key::Unit(name, unit))
            },
            ask,
        ),
        _ => ask(),
    }
}

/// GL_CURRENT_TEXTURE_COORDS of a unit, counted from 0.
pub(in crate::gl) fn coordinates(unit: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let key = Key::Unit(c::CURRENT_TEXTURE_COORDS, unit);
    // Drivers execute the vertices of a list that is compiled later.
    by_key(|s| s.compiling.is_none().then_some(key), ask)
}

/// A matrix of glGet: what is known, or what `ask` answers.
pub(in crate::gl) fn matrix(name: u32, ask: impl Fn() -> [f32; 16]) -> [f32; 16] {
    let Some(stack) = matrices::stack_of(name) else {
        return ask();
    };
    let known = with(|s| {
        s.active_unit();
        s.matrices.top(stack, s.unit())
    });
    let sure = known.flatten().filter(|top| top.is_proven());
    if let Some(top) = sure {
        if cfg!(feature = "check-shadow") {
            check(
                &stack,
                top.numbers.map(f32::to_bits),
                ask().map(f32::to_bits),
            );
        }
        return top.numbers;
    }
    let numbers = ask();
    with(|s| {
        let unit = s.unit();
        s.matrices.is(stack, unit, &numbers);
    });
    numbers
}

/// Whether a capability is on: what is known, or what `ask` answers.
pub(in crate::gl) fn is_enabled(cap: u32, ask: impl Fn() -> bool) -> bool {
    let key = |s: &mut Shadow| match key::is_of_unit(cap) {
        true => {
            s.active_unit();
            s.unit().map(|unit| Key::UnitCap(cap, unit))
        }
        false => Some(Key::Cap(cap)),
    };
    by_key(key, || [ask().into(), 0, 0, 0])[0] != 0
}

/// Whether the program has set some capability by its index.
pub(in crate::gl) fn are_capabilities_indexed() -> bool {
    with(|s| s.indexed) == Some(true)
}

/// Whether a capability is on for an index.
pub(in crate::gl) fn is_enabled_at(cap: u32, index: u32, ask: impl Fn() -> bool) -> bool {
    let kept = key::is_indexed(cap);
    // Only the driver knows of what was set before anything was kept.
    let key = |s: &mut Shadow| match s.indexed {
        true => kept.then_some(Key::CapAt(cap, index)),
        false => s
            .values
            .get(Key::Cap(cap))
            .map(|_| Key::Cap(cap))
            .filter(|_| kept && index == 0),
    };
    by_key(key, || [ask().into(), 0, 0, 0])[0] != 0
}

/// The value that glGet has for a name and an index, as integers.
pub(in crate::gl) fn value_at(name: u32, index: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let kept = |s: &mut Shadow| {
        name == c::COLOR_WRITEMASK || name == c::SCISSOR_BOX && s.rectangles_by_index
    };
    by_key(|s| kept(s).then_some(Key::At(name, index)), ask)
}

/// The same as floats.
pub(in crate::gl) fn floats_at(name: u32, index: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let kept = |s: &mut Shadow| name == c::VIEWPORT && s.rectangles_by_index;
    by_key(|s| kept(s).then_some(Key::At(name, index)), ask)
}

/// glGetLight, of whose GL_POSITION only w counts.
pub(in crate::gl) fn light(light: u32, name: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    by_key(
        |_| Some(Key::Light(light, name)),
        || match (name, ask()) {
            (c::POSITION, [.., w]) => [0, 0, 0, w],
            (_, all) => all,
        },
    )
}

/// glGetMaterial. Only the driver knows it while the material follows the colour, and while a list is compiled: drivers execute vertices of that
/// later.
pub(in crate::gl) fn material(
    face: u32,
    name: u32,
    follows: bool,
    ask: impl Fn() -> [u32; 4],
) -> [u32; 4] {
    let key = Key::Material(face, name);
    by_key(|s| (!follows && s.compiling.is_none()).then_some(key), ask)
}

/// What glGetVertexAttrib answers to a name, a bit for each generic attribute of the vertex array object that is bound.
pub(in crate::gl) fn attributes(name: u32, array: u32, ask: impl Fn() -> u32) -> u32 {
    let key = Key::Attributes(name, array);
    by_key(|s| (!s.binding_points).then_some(key), || [ask(), 0, 0, 0])[0]
}

/// glGetTexEnv of GL_TEXTURE_ENV, as integers.
pub(in crate::gl) fn tex_env(name: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let of_unit = |s: &mut Shadow| {
        s.active_unit();
        s.unit().map(|unit| Key::TexEnv(name, unit))
    };
    by_key(of_unit, ask)
}

/// GL_TEXTURE_GEN_MODE of a coordinate.
pub(in crate::gl) fn tex_gen(coord: u32, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let of_unit = |s: &mut Shadow| {
        s.active_unit();
        s.unit().map(|unit| Key::TexGen(coord, unit))
    };
    by_key(of_unit, ask)
}

/// What is known under a key, or what `ask` answers, which is kept; without a key, only the latter.
fn by_key(key: impl FnOnce(&mut Shadow) -> Option<Key>, ask: impl Fn() -> [u32; 4]) -> [u32; 4] {
    let key = with(key).flatten();
    asked(
        &key,
        |s| s.values.known(key?),
        ask,
        |s, value| {
            if let Some(key) = key {
                s.answered(key, value);
            }
        },
    )
}

fn asked(
    what: &dyn core::fmt::Debug,
    known: impl FnOnce(&mut Shadow) -> Option<[u32; 4]>,
    ask: impl Fn() -> [u32; 4],
    keep: impl FnOnce(&mut Shadow, [u32; 4]),
) -> [u32; 4] {
    if let Some(known) = with(known).flatten() {
        if cfg!(feature = "check-shadow") {
            check(what, known, ask());
        }
        return known;
    }
    let value = ask();
    with(|s| keep(s, value));
    value
}

/// A value that is known has to be the driver's.
#[cold]
fn check<const K: usize>(what: &dyn core::fmt::Debug, known: [u32; K], driver: [u32; K]) {
    assert_eq!(
        known, driver,
        "{what:?}: what is kept of the state is not what the driver has"
    );
}

/// Whether the context has an extension.
pub(in crate::gl) fn has_extension(extension: &str, ask: impl Fn() -> bool) -> bool {
    if let Some(has) = with(|s| s.extensions.get(extension).copied()).flatten() {
        return has;
    }
    let has = ask();
    with(|s| s.extensions.insert(extension.to_owned(), has));
    has
}
