//! A driver that draws nothing: it records what is called and keeps as much of the state of OpenGL as the layer saves, puts back and
//! asks for. Unit tests of whatever calls OpenGL run on it, without a context.
//!
//! A [`Fake`] is the driver of its thread until it is dropped, so tests in other threads have their own. [`Fake::gl`] gives the calls of
//! the layer, [`Fake::program`] marks those of the program, whose objects are then watched as well. What the layer asks and the fake
//! driver does not know makes the test fail: an answer that was made up would hide a mistake.

#[macro_use]
mod call;
mod answers;
mod buffers;
mod commands;
mod limits;
mod memory;
mod model;
mod objects;
mod random;
mod shaders;
#[cfg(test)]
mod tests;

pub use call::{Arg, Call};
pub use model::{Scope, Snapshot};

pub(in crate::gl) use call::{Answer, Recorded};

use super::real::{Ptr, Real};
use super::table::NAMES;
use super::{
    Attachment, FramebufferName, Gl, Object, ProgramName, RenderbufferName, TextureName,
    consts as c,
};
use objects::Objects;
use shaders::Shaders;
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap, VecDeque};
use std::ffi::{CStr, CString};

thread_local! {
    static DRIVER: RefCell<Option<Driver>> = const { RefCell::new(None) };
}

/// The functions that record, one for each command of the table.
pub(in crate::gl) struct Recorders;

/// A command that makes pixels, with all state as it was then.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The command.
    pub call: Call,
    /// The state that it was called in.
    pub state: Snapshot,
}

/// The state of the driver of a thread. More than 12 fields: one for each kind of state. More than 25 methods: one for each family of commands.
#[derive(Debug)]
struct Driver {
    version: CString,
    glsl: CString,
    renderer: CString,
    extensions: Vec<CString>,
    extension_list: CString,
    missing: Vec<&'static str>,
    state: Snapshot,
    objects: Objects,
    shaders: Shaders,
    buffers: HashMap<u32, Vec<u8>>,
    /// Below the tops of the stacks of matrices, by matrix mode.
    matrices: HashMap<u32, Vec<Vec<f64>>>,
    attributes: Vec<(u32, BTreeMap<model::Key, Vec<f64>>)>,
    errors: VecDeque<u32>,
    framebuffer_status: u32,
    calls: Vec<Call>,
    draws: Vec<Drawn>,
    unknown: Vec<String>,
    by_program: bool,
}

/// The driver of this thread, for as long as the value lives. More than 25 methods: what tests set up and ask.
#[derive(Debug)]
pub struct Fake {
    real: &'static Real,
    // The driver belongs to the thread.
    _not_send: core::marker::PhantomData<*const ()>,
}

/// Records a command of the driver of this thread and answers it; 0 where the thread has none.
pub(in crate::gl) fn record(slot: usize, args: &[Arg]) -> i64 {
    DRIVER.with_borrow_mut(|driver| {
        let Some(driver) = driver else { return 0 };
        let name = NAMES.get(slot).and_then(|name| name.to_str().ok());
        let call = Call {
            name: name.unwrap_or_default(),
            args: args.to_vec(),
            program: driver.by_program,
        };
        driver.execute(call)
    })
}

fn load(name: &CStr) -> Ptr {
    let missing = DRIVER.with_borrow(|driver| {
        let missing = driver.iter().flat_map(|driver| &driver.missing);
        missing.into_iter().any(|m| m.as_bytes() == name.to_bytes())
    });
    let slot = NAMES.iter().position(|known| *known == name);
    match slot {
        Some(slot) if !missing => Recorders::address(slot),
        _ => core::ptr::null_mut(),
    }
}

fn text(text: &str) -> CString {
    CString::new(text).unwrap_or_default()
}

impl Default for Fake {
    fn default() -> Self {
        Self::new()
    }
}

impl Fake {
    /// OpenGL 4.5 with fixed function and a window of 64 x 48 pixels with 8 bits a channel, depth and stencil.
    pub fn new() -> Fake {
        let driver = Driver {
            version: CString::default(),
            glsl: CString::default(),
            renderer: text("fake"),
            extensions: Vec::new(),
            extension_list: CString::default(),
            missing: Vec::new(),
            state: Snapshot::default(),
            objects: Objects::default(),
            shaders: Shaders::default(),
            buffers: HashMap::new(),
            matrices: HashMap::new(),
            attributes: Vec::new(),
            errors: VecDeque::new(),
            framebuffer_status: c::FRAMEBUFFER_COMPLETE,
            calls: Vec::new(),
            draws: Vec::new(),
            unknown: Vec::new(),
            by_program: false,
        };
        DRIVER.set(Some(driver));
        let fake = Fake {
            // A table for each test is small, and `Gl` wants one that lives for ever.
            real: Box::leak(Box::new(Real::new(|name| Some(load(name))))),
            _not_send: core::marker::PhantomData,
        };
        fake.version(4, 5).window(64, 48)
    }

    /// Of this version of OpenGL.
    pub fn version(self, major: u32, minor: u32) -> Fake {
        let glsl = match (major, minor) {
            (3, 3..) | (4.., _) => format!("{major}.{minor}0"),
            (3, minor) => format!("1.{}0", minor + 3),
            _ => "1.20".to_owned(),
        };
        self.with(|driver| {
            driver.version = text(&format!("{major}.{minor} fake"));
            driver.glsl = text(&glsl);
        });
        self
    }

    /// Of this version of OpenGL ES.
    pub fn es(self, major: u32, minor: u32) -> Fake {
        self.with(|driver| {
            driver.version = text(&format!("OpenGL ES {major}.{minor} fake"));
            driver.glsl = text(&format!("OpenGL ES GLSL ES {major}.{minor}0"));
        });
        self.limit(c::CONTEXT_PROFILE_MASK, &[0.0])
    }

    /// By another driver, as GL_RENDERER tells.
    pub fn renderer(self, name: &str) -> Fake {
        self.with(|driver| driver.renderer = text(name));
        self
    }

    /// Without fixed function.
    pub fn core(self) -> Fake {
        self.limit(c::CONTEXT_PROFILE_MASK, &[1.0])
    }

    /// With these extensions, and no others.
    pub fn extensions<'a>(self, names: impl IntoIterator<Item = &'a str>) -> Fake {
        let names: Vec<&str> = names.into_iter().collect();
        self.with(|driver| {
            driver.extension_list = text(&names.join(" "));
            driver.extensions = names.iter().map(|name| text(name)).collect();
        });
        self
    }

    /// Without a command; only before it is called for the first time.
    pub fn without(self, command: &'static str) -> Fake {
        self.with(|driver| driver.missing.push(command));
        self
    }

    /// With another answer of glGet, such as a limit or what the window has.
    pub fn limit(self, name: u32, values: &[f64]) -> Fake {
        self.with(|driver| driver.set(name, values));
        self
    }

    /// With a window of this size in pixels, to which viewports and scissors are set.
    pub fn window(self, width: u32, height: u32) -> Fake {
        let whole = [0.0, 0.0, width.into(), height.into()];
        self.limit(c::VIEWPORT, &whole)
            .limit(c::SCISSOR_BOX, &whole)
    }

    /// The layer's own calls.
    pub fn gl(&self) -> Gl {
        let before = self.with(|driver| std::mem::replace(&mut driver.by_program, true));
        // SAFETY: the functions of the table are those of this driver, which is this thread's and needs no context.
        let gl = unsafe { Gl::new(self.real) };
        self.with(|driver| driver.by_program = before);
        gl
    }

    /// Its functions, for whoever is the layer's way to the driver.
    pub fn real(&self) -> &'static Real {
        self.real
    }

    /// Calls of the program: what they make is the program's, and they are not among the calls of the layer.
    pub fn program<R>(&self, calls: impl FnOnce(&Gl) -> R) -> R {
        let before = self.with(|driver| std::mem::replace(&mut driver.by_program, true));
        let result = calls(&self.gl());
        self.with(|driver| driver.by_program = before);
        result
    }

    /// A framebuffer of the program's with a texture and a renderbuffer for depths, of this size. Nothing stays bound.
    pub fn framebuffer(
        &self,
        width: i32,
        height: i32,
    ) -> (FramebufferName, TextureName, RenderbufferName) {
        self.program(|gl| {
            let (name, texture) = (gl.gen_framebuffer(), gl.gen_texture());
            gl.bind_texture(c::TEXTURE_2D, texture);
            gl.tex_image_rgba8_empty(c::TEXTURE_2D, width, height);
            gl.bind_texture(c::TEXTURE_2D, TextureName::ZERO);
            let depths = gl.renderbuffer([c::DEPTH_COMPONENT24 as i32, width, height, 0]);
            gl.bind_renderbuffer(RenderbufferName::ZERO);
            gl.bind_framebuffer(c::FRAMEBUFFER, name);
            gl.framebuffer_texture(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, texture, 0);
            let point = Attachment {
                point: c::DEPTH_ATTACHMENT,
                object: Object::Renderbuffer(depths),
                level: 0,
                face: 0,
                layer: 0,
                layered: false,
            };
            gl.attach_like(&point, point.object, c::RENDERBUFFER);
            gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
            (name, texture, depths)
        })
    }

    /// Sets a value for which the layer has no command of its own, such as one of a light.
    pub fn put(&self, scope: Scope, name: u32, values: &[f64]) {
        self.with(|driver| driver.put(scope, name, values));
    }

    /// The next glGetError answers this.
    pub fn raise(&self, error: u32) {
        self.with(|driver| driver.errors.push_back(error));
    }

    /// glCheckFramebufferStatus answers this.
    pub fn set_framebuffer_status(&self, status: u32) {
        self.with(|driver| driver.framebuffer_status = status);
    }

    /// Shaders whose text has these words do not compile.
    pub fn refuse_shaders(&self, words: &str) {
        self.with(|driver| driver.shaders.refused = Some(words.to_owned()));
    }

    /// The state as it is.
    pub fn state(&self) -> Snapshot {
        self.with(|driver| driver.snapshot())
    }

    /// A value of the state: see [`Snapshot::value`].
    pub fn value(&self, name: u32) -> Vec<f64> {
        self.with(|driver| driver.state.value(name))
    }

    /// The values of a uniform of a program, by its name; empty where it has no place or has not been set.
    pub fn uniform(&self, program: ProgramName, name: &str) -> Vec<f64> {
        self.with(|driver| {
            let location = driver.shaders.location(program.0, name);
            let key = (Scope::Program(program), location as u32);
            driver.state.values.get(&key).cloned().unwrap_or_default()
        })
    }

    /// How many objects there are of each of these kinds, called as in glGen*, such as `Textures`.
    pub fn alive<const K: usize>(&self, kinds: [&str; K]) -> [usize; K] {
        self.with(|driver| kinds.map(|kind| driver.alive(kind)))
    }

    /// All calls since the last [`Fake::forget`], those of the program left out.
    pub fn calls(&self) -> Vec<Call> {
        let own = |call: &&Call| !call.program;
        self.with(|driver| driver.calls.iter().filter(own).cloned().collect())
    }

    /// The same as lines, for `assert_eq!`: those that a pattern fits, `*` at its end standing for anything.
    pub fn lines(&self, pattern: &str) -> Vec<String> {
        let calls = self.calls().into_iter();
        let fitting = calls.filter(|call| fits(pattern, call.name));
        fitting.map(|call| call.to_string()).collect()
    }

    /// How many calls fit a pattern, as in [`Fake::lines`].
    pub fn count(&self, pattern: &str) -> usize {
        self.lines(pattern).len()
    }

    /// The layer's questions, with how often each was asked; the most frequent first.
    pub fn asked(&self) -> Vec<(String, usize)> {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for call in self.calls().iter().filter(|call| call.asks()) {
            let about = match call.args.first() {
                Some(Arg::Int(name)) => model::name_of(*name as u32),
                _ => String::new(),
            };
            *counts.entry(format!("{} {about}", call.name)).or_default() += 1;
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        counts
    }

    /// What has been drawn, cleared or blitted since the last [`Fake::forget`], by whomever.
    pub fn draws(&self) -> Vec<Drawn> {
        self.with(|driver| driver.draws.clone())
    }

    /// Forgets all calls, and keeps the state.
    pub fn forget(&self) {
        self.with(|driver| {
            driver.calls.clear();
            driver.draws.clear();
        });
    }

    fn with<R>(&self, f: impl FnOnce(&mut Driver) -> R) -> R {
        DRIVER.with_borrow_mut(|driver| f(driver.as_mut().expect("the fake driver of this thread")))
    }

    /// Fails where some state is not as it was before.
    #[track_caller]
    pub fn assert_restored(&self, before: &Snapshot) {
        assert_state_restored(before, &self.state());
    }

    /// Fails where something asks the driver for state.
    #[track_caller]
    pub fn assert_asks_nothing<R>(&self, something: impl FnOnce() -> R) -> R {
        self.forget();
        let result = something();
        assert!(self.asked().is_empty(), "asked: {:#?}", self.asked());
        result
    }
}

impl Drop for Fake {
    fn drop(&mut self) {
        let driver = DRIVER.take();
        let unknown = driver.map(|driver| driver.unknown).unwrap_or_default();
        if !std::thread::panicking() {
            assert!(
                unknown.is_empty(),
                "the fake driver does not know: {unknown:#?}"
            );
        }
    }
}

/// Fails where some state of the context, or of an object of the program's, is not as it was before.
#[track_caller]
pub fn assert_state_restored(before: &Snapshot, after: &Snapshot) {
    let differences = before.differences(after);
    assert!(
        differences.is_empty(),
        "not put back: {}",
        differences.join("; ")
    );
}

fn fits(pattern: &str, name: &str) -> bool {
    match pattern.strip_suffix('*') {
        Some(start) => name.starts_with(start),
        None => name == pattern,
    }
}
