//! Hooks on the fake driver, which records calls: which calls reach it, in which order, and which queries they make. The program must
//! read the same state as without the layer.

#[path = "../../tests/support/share.rs"]
mod share;

use crate::context::{self, guarded};
use crate::drawable::{Drawable, Pair};
use crate::entry::*;
use crate::provider::Provider;
use crate::switch;
use core::cell::Cell;
use core::ptr::null_mut;
use manyview_core::config::Config;
use manyview_core::gl::fake::{Arg, Call, Fake, Snapshot};
use manyview_core::gl::{NAMES, Ptr, Real, consts as c};
use std::collections::BTreeMap;

thread_local! {
    static DRIVER: Cell<Option<&'static Real>> = const { Cell::new(None) };
}

/// The functions of the fake driver of this thread's test.
pub(crate) fn driver() -> Option<&'static Real> {
    DRIVER.get()
}

/// The moment at which a fault interrupts a hook's own work.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Stage {
    Before,
    After,
}

thread_local! {
    static FAULT: Cell<Option<Stage>> = const { Cell::new(None) };
}

/// Panics once if a test has asked for a fault at this stage.
pub(crate) fn strike(stage: Stage) {
    if FAULT.get() == Some(stage) {
        FAULT.set(None);
        panic!("a fault of the test");
    }
}

const VIEWS: usize = 4;
const SIZE: (u32, u32) = (64, 48);

/// A program with one context, whose calls go through the exported functions.
struct Program {
    fake: Fake,
}

impl Program {
    fn new() -> Program {
        let fake = Fake::new().extensions(["GL_ARB_shader_viewport_layer_array"]);
        Program::on(fake)
    }

    fn on(fake: Fake) -> Program {
        let options = [("MANYVIEW_VIEWS", "4"), ("MANYVIEW_STRATEGY", "replay")];
        let config = Config::from_env(|variable| {
            let found = options.iter().find(|(name, _)| *name == variable);
            found.map(|(_, value)| (*value).to_owned())
        });
        switch::configure(config.expect("options"));
        DRIVER.set(Some(fake.real()));
        let drawables = Some(Pair::of(Drawable::Memory(SIZE.0, SIZE.1)));
        context::made_current(Provider::Gl, handle(), drawables);
        assert!(context::enter(|_, _| ()).is_some(), "a layer");
        let program = Program { fake };
        program.look();
        program.fake.forget();
        program
    }

    /// Sets a perspective projection and the depth test.
    fn look(&self) {
        // SAFETY: constants, and matrices of 16 values.
        unsafe {
            glMatrixMode(c::PROJECTION);
            let mut matrix = [0.0f32; 16];
            (matrix[0], matrix[5]) = (1.0, 1.0);
            (matrix[10], matrix[11], matrix[14]) = (-1.02, -1.0, -2.02);
            glLoadMatrixf(matrix.as_mut_ptr().cast());
            glMatrixMode(c::MODELVIEW);
            glEnable(c::DEPTH_TEST);
        }
    }

    fn integer(&self, name: u32) -> i32 {
        let mut value = -1i32;
        // SAFETY: one integer.
        unsafe { glGetIntegerv(name, (&raw mut value).cast()) };
        value
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        context::destroyed(Provider::Gl, handle());
        context::made_current(Provider::Gl, null_mut(), None);
        switch::turn_on();
        FAULT.set(None);
        DRIVER.set(None);
    }
}

/// The handle of this thread's context.
fn handle() -> Ptr {
    thread_local! { static PLACE: u8 = const { 0 } };
    PLACE.with(|place| (&raw const *place).cast_mut().cast())
}

fn draw() {
    // SAFETY: three vertices without arrays.
    unsafe { glDrawArrays(c::TRIANGLES, 0, 3) };
}

/// The end of a frame of a program without windows.
fn frame() {
    // SAFETY: no arguments.
    unsafe { glFinish() };
}

#[test]
fn a_draw_is_sent_once_for_each_view_and_asks_nothing() {
    let program = Program::new();
    draw();
    let before = program.fake.state();
    program.fake.forget();
    draw();
    assert_eq!(program.fake.count("glDrawArrays"), VIEWS);
    assert!(
        program.fake.asked().is_empty(),
        "{:?}",
        program.fake.asked()
    );
    program.fake.assert_restored(&before);
    let places: Vec<f64> = program
        .fake
        .draws()
        .iter()
        .map(|drawn| drawn.state.value(c::VIEWPORT)[0])
        .collect();
    assert_eq!(places, [64.0, 128.0, 192.0, 0.0]);
}

#[test]
fn state_reaches_the_layer_before_the_driver_draws() {
    let program = Program::new();
    draw();
    program.fake.forget();
    // SAFETY: a rectangle.
    unsafe { glViewport(8, 4, 32, 16) };
    draw();
    let sent = program.fake.calls();
    assert_eq!(sent[0].name, "glViewport", "{sent:?}");
    let drawn = program.fake.draws();
    let boxes: Vec<_> = drawn.iter().map(|d| d.state.value(c::VIEWPORT)).collect();
    assert_eq!(boxes[3], [8.0, 4.0, 32.0, 16.0]);
    assert_eq!(boxes[0], [72.0, 4.0, 32.0, 16.0]);
}

#[test]
fn what_the_layer_made_is_hidden() {
    let program = Program::new();
    draw();
    frame();
    draw();
    assert_eq!(program.integer(c::DRAW_FRAMEBUFFER_BINDING), 0);
    assert_ne!(program.fake.value(c::DRAW_FRAMEBUFFER_BINDING), [0.0]);
    let atlas = program.fake.value(c::DRAW_FRAMEBUFFER_BINDING)[0] as u32;
    // SAFETY: names.
    unsafe {
        assert_eq!(glIsFramebuffer(atlas), 0);
        let textures = (1..200).filter(|&name| glIsTexture(name) != 0).count();
        assert_eq!(textures, 0);
        assert_eq!(glGetError(), c::NO_ERROR);
    }
}

#[test]
fn immediate_mode_is_recorded_and_sent_at_its_end() {
    let program = Program::new();
    draw();
    program.fake.forget();
    // SAFETY: values.
    unsafe {
        glBegin(c::TRIANGLES);
        for x in [0.0, 1.0, 2.0] {
            glVertex3f(x, 0.0, -5.0);
        }
        assert_eq!(program.fake.count("glVertex*"), 0, "not before glEnd");
        glEnd();
    }
    let sent = program.fake.count("glVertex3f");
    assert_eq!(sent, 3 * VIEWS);
    // The driver also gets the program's own glBegin and glEnd, which are empty.
    assert_eq!(program.fake.count("glBegin"), 1 + VIEWS);
    assert_eq!(program.fake.count("glEnd"), 1 + VIEWS);
}

#[test]
fn a_list_is_compiled_once_and_called_for_each_view() {
    let program = Program::new();
    draw();
    program.fake.forget();
    // SAFETY: names and values.
    unsafe {
        glNewList(7, 0x1300);
        draw();
        glEndList();
        assert_eq!(program.fake.count("glDrawArrays"), 1, "GL_COMPILE");
        program.fake.forget();
        glCallList(7);
    }
    assert_eq!(program.fake.count("glCallList"), VIEWS);
}

#[test]
fn calls_of_the_layer_and_of_the_driver_pass() {
    let program = Program::new();
    draw();
    program.fake.forget();
    guarded(draw);
    assert_eq!(program.fake.count("gl*"), 1);
}

#[test]
fn a_thread_without_a_context_reaches_the_driver_alone() {
    let program = Program::new();
    context::made_current(Provider::Gl, null_mut(), None);
    program.fake.forget();
    draw();
    // SAFETY: a rectangle.
    unsafe { glViewport(0, 0, 5, 5) };
    assert_eq!(program.fake.count("gl*"), 2);
}

/// Random numbers by xorshift, so that a seed gives the same calls everywhere.
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) as u32 % limit
    }
}

/// Random calls by a seed. Every push has its pop.
fn calls(seed: u64) {
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    const CAPABILITIES: [u32; 5] = [
        c::DEPTH_TEST,
        c::SCISSOR_TEST,
        c::BLEND,
        c::TEXTURE_2D,
        c::LIGHTING,
    ];
    for _ in 0..60 {
        let n = dice.below(60) as i32;
        // SAFETY: constants, values, and vertices without arrays.
        unsafe {
            match dice.below(12) {
                0 => glEnable(CAPABILITIES[dice.below(5) as usize]),
                1 => glDisable(CAPABILITIES[dice.below(5) as usize]),
                2 => glViewport(n, n / 2, 20 + n, 30),
                3 => glScissor(n, n / 3, 10 + n, 40),
                4 => {
                    glMatrixMode([c::MODELVIEW, c::PROJECTION][dice.below(2) as usize]);
                    glPushMatrix();
                    glTranslatef(n as f32, 0.0, -1.0);
                    draw();
                    glPopMatrix();
                }
                5 => glBindTexture(c::TEXTURE_2D, 300 + n as u32),
                6 => glColor4f(n as f32 / 60.0, 0.5, 0.25, 1.0),
                7 => {
                    glPushAttrib(c::ALL_ATTRIB_BITS);
                    glViewport(1, 2, 3, 4);
                    draw();
                    glPopAttrib();
                }
                8 => {
                    glBegin(c::TRIANGLES);
                    glColor4f(0.0, 1.0, n as f32 / 60.0, 1.0);
                    (0..3).for_each(|x| glVertex3f(x as f32, n as f32, -2.0));
                    glEnd();
                }
                9 => glClear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT),
                10 => glDepthFunc([c::LEQUAL, c::ALWAYS][dice.below(2) as usize]),
                _ => draw(),
            }
        }
    }
}

/// Differences of the state, without framebuffer bindings: under the layer, the atlas is bound in place of framebuffer 0.
fn differences(alone: &Snapshot, hooked: &Snapshot) -> Vec<String> {
    let all = alone.differences(hooked).into_iter();
    all.filter(|line| !line.contains("FRAMEBUFFER_BINDING"))
        .collect()
}

#[test]
fn random_calls_leave_the_state_that_they_leave_without_the_layer() {
    let after = |calls: &dyn Fn()| {
        let program = Program::new();
        calls();
        (program.fake.state(), program.fake.draws().len())
    };
    for seed in 0..60 {
        let (hooked, drawn) = after(&|| calls(seed));
        let (alone, once) = after(&|| guarded(|| calls(seed)));
        assert_eq!(differences(&alone, &hooked), [""; 0], "seed {seed}");
        assert!(
            drawn > 2 * once,
            "seed {seed}: {drawn} draws in place of {once}"
        );
    }
}

/// Whether a command can be called with zeros: not those of window systems, which take handles, nor questions, which the fake driver answers
/// only for values that exist.
fn takes_zeros(name: &str) -> bool {
    let others = ["glX", "egl", "OSMesa", "glGet", "glIs"];
    !others.iter().any(|other| name.starts_with(other))
}

/// How often a call with nothing but zeros reaches the driver, by the name that the driver has for it: those of the program, but for what
/// [`CALLS_OF_OURS`] names.
fn reached(calls: &[Call]) -> BTreeMap<&'static str, usize> {
    let zero = |arg: &Arg| match arg {
        Arg::Int(n) => *n == 0,
        Arg::Float(x) => *x == 0.0,
        Arg::Ptr(p) => *p == 0,
        _ => false,
    };
    let mut all = BTreeMap::new();
    for call in calls.iter().filter(|call| call.args.iter().all(zero)) {
        *all.entry(call.name).or_default() += 1;
    }
    let question = |name: &str| name.starts_with("glGet") || name.starts_with("glIs");
    all.retain(|name, _| !question(name) && !CALLS_OF_OURS.contains(name));
    all
}

/// Commands that the layer calls with zeros or without arguments.
const CALLS_OF_OURS: [&str; 12] = [
    "glBindVertexArray",
    "glDrawBuffer",
    "glDrawBuffers",
    "glReadBuffer",
    "glScissor",
    "glViewport",
    "glUseProgram",
    "glEndList",
    "glPushMatrix",
    "glPopMatrix",
    "glPopAttrib",
    "glFlush",
];

/// The calls of a hook with zeros that reach the driver.
fn called(call: unsafe fn(), fault: Option<Stage>) -> BTreeMap<&'static str, usize> {
    let program = drawing();
    program.fake.forget();
    strikes(call, fault);
    reached(&program.fake.calls())
}

/// A program that has drawn.
fn drawing() -> Program {
    let program = Program::new();
    draw();
    program
}

/// Makes a call of the program's. Whether the fault has struck.
fn strikes(call: unsafe fn(), fault: Option<Stage>) -> bool {
    FAULT.set(fault);
    // SAFETY: the fake driver reads nothing through its arguments.
    unsafe { call() };
    fault.is_some() && FAULT.take().is_none()
}

#[test]
fn a_fault_in_any_hook_makes_the_programs_call_once() {
    let mut struck = 0;
    let mut wrong = Vec::new();
    // One program for all hooks that no fault strikes, because a new one takes time.
    let mut untouched = None;
    let nth = share::every(8);
    for (slot, call) in WITH_ZEROS.iter().enumerate().step_by(nth) {
        let name = NAMES[slot].to_str().expect("ASCII");
        let Some(call) = call.filter(|_| takes_zeros(name)) else {
            continue;
        };
        untouched.get_or_insert_with(drawing);
        if !strikes(call, Some(Stage::Before)) {
            continue;
        }
        struck += 1;
        untouched = None;
        let before = called(call, Some(Stage::Before));
        if before.values().any(|&times| times != 1) {
            wrong.push(format!("{name}: {before:?} after a fault before the work"));
        }
        // What the layer has sent for the views is not sent once more.
        let after = called(call, Some(Stage::After));
        if after.values().all(|&times| times <= 1) {
            continue;
        }
        let whole = called(call, None);
        let most = |name: &str| whole.get(name).copied().unwrap_or(0).max(1);
        if after.iter().any(|(name, &times)| times > most(name)) {
            wrong.push(format!(
                "{name}: {after:?} for {whole:?} after a fault behind the work"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(struck * nth > 100, "only {struck} hooks were interrupted");
}
