//! Which context is current on which thread, and the guard that every hook passes.

use crate::control;
use crate::deep;
use crate::geometry::{self, Seen};
use crate::keys;
use crate::live;
use crate::provider::Provider;
use crate::shares;
use crate::switch::{self, Mode, say, turn_off};
use crate::windows;
use core::cell::Cell;
use core::ffi::c_ulong;
use core::panic::AssertUnwindSafe;
use manyview_core::gl::{Gl, Ptr, Real};
use manyview_core::layer::{Frames, Layer, OnScreen};
use std::sync::{Mutex, PoisonError};

/// What a context draws to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Drawable {
    /// Display and GLX drawable.
    Glx(Ptr, c_ulong),
    /// Display and surface.
    Egl(Ptr, Ptr),
    /// The program's memory: width and height.
    Memory(u32, u32),
}

/// One context of the program, from its first MakeCurrent to its destruction.
pub(crate) struct Context {
    provider: Provider,
    handle: Ptr,
    drawable: Drawable,
    /// Where its window was, for outputs that follow it.
    seen: Option<Seen>,
    layer: Option<Layer>,
    /// With one view: only frames are counted and captured.
    frames: Option<Frames>,
    /// On some thread. This and `destroyed` are read and written under the registry's lock.
    current: bool,
    destroyed: bool,
}

struct Registry(Vec<*mut Context>);

// SAFETY: the pointers are to boxes that only the thread with that context current dereferences (a context is current in one
// thread at a time); the list itself is behind a mutex.
unsafe impl Send for Registry {}

static CONTEXTS: Mutex<Registry> = Mutex::new(Registry(Vec::new()));

/// Per thread. No destructor: threads may call GL while they are torn down.
struct Thread {
    context: Cell<*mut Context>,
    provider: Cell<Option<Provider>>,
    depth: Cell<u32>,
    inside: Cell<Inside>,
}

/// Where a thread is between glBegin and glEnd. The driver is there as well, so that it refuses what has no place there; hooks
/// pass everything on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Inside {
    /// Not between them.
    Outside,
    /// The calls are recorded.
    Recorded,
    /// The calls go to the driver.
    Direct,
}

thread_local! {
    static THREAD: Thread = const {
        Thread { context: Cell::new(core::ptr::null_mut()), provider: Cell::new(None), depth: Cell::new(0), inside: Cell::new(Inside::Outside) }
    };
}

/// The real functions for this thread: of whoever made its context current.
pub(crate) fn real() -> &'static Real {
    let provider = THREAD.with(|t| t.provider.get()).unwrap_or_else(|| {
        if Provider::Gl.loaded() {
            Provider::Gl
        } else {
            Provider::OsMesa
        }
    });
    provider.real()
}

/// Whether the calls of this thread are recorded (between glBegin and glEnd).
#[inline]
pub(crate) fn recording() -> bool {
    inside() == Inside::Recorded
}

/// Whether this thread is between glBegin and glEnd.
#[inline]
pub(crate) fn inside() -> Inside {
    THREAD.with(|t| t.inside.get())
}

/// At glBegin and glEnd.
pub(crate) fn set_inside(inside: Inside) {
    THREAD.with(|t| t.inside.set(inside));
}

/// Runs with hooks passed through: around real functions that may call exported names, and around our own work.
pub(crate) fn guarded<R>(f: impl FnOnce() -> R) -> R {
    THREAD.with(|t| t.depth.set(t.depth.get() + 1));
    let r = f();
    THREAD.with(|t| t.depth.set(t.depth.get().saturating_sub(1)));
    r
}

/// The layer of the current context, without a guard: for work that can neither panic nor call GL. None between glBegin and
/// glEnd, where a call has no effect but an error.
#[inline]
pub(crate) fn peek<R>(f: impl FnOnce(&mut Layer) -> R) -> Option<R> {
    if inside() == Inside::Outside {
        peek_inside(f)
    } else {
        None
    }
}

/// As [`peek`], between glBegin and glEnd as well.
#[inline]
pub(crate) fn peek_inside<R>(f: impl FnOnce(&mut Layer) -> R) -> Option<R> {
    THREAD.with(|t| {
        let context = t.context.get();
        if context.is_null() || t.depth.get() > 0 {
            return None;
        }
        // SAFETY: the context is current on this thread and no other, so nobody else has a reference; depth 0 says that no frame
        // below us has one either.
        unsafe { (*context).layer.as_mut() }.map(f)
    })
}

/// The guard of every hook that does something: the current context's layer and driver, unless there is none, the call comes from
/// inside the layer or the driver or between glBegin and glEnd, or the layer is off. A panic turns the layer off for good.
pub(crate) fn enter<R>(f: impl FnOnce(&Gl, &mut Layer) -> R) -> Option<R> {
    with_context(|gl, context| context.layer.as_mut().map(|l| f(gl, l))).flatten()
}

fn with_context<R>(f: impl FnOnce(&Gl, &mut Context) -> R) -> Option<R> {
    let (context, depth) = THREAD.with(|t| (t.context.get(), t.depth.get()));
    if context.is_null() || depth > 0 || inside() != Inside::Outside || switch::off() {
        return None;
    }
    // SAFETY: as in `peek`.
    let context = unsafe { &mut *context };
    // SAFETY: the context is current on this thread while the hook runs.
    let gl = unsafe { Gl::new(context.provider.real()) };
    let r = guarded(|| std::panic::catch_unwind(AssertUnwindSafe(|| f(&gl, context))));
    match r {
        Ok(r) => Some(r),
        Err(_) => {
            set_inside(Inside::Outside);
            turn_off("internal fault");
            let _ = std::panic::catch_unwind(AssertUnwindSafe(|| {
                if let Some(l) = &mut context.layer {
                    guarded(|| l.abandon(&gl));
                }
            }));
            THREAD.with(|t| t.context.set(core::ptr::null_mut()));
            None
        }
    }
}

/// The context that was current on this thread with a drawable; used to tell whether MakeCurrent changes anything.
pub(crate) fn is_current(provider: Provider, handle: Ptr, drawable: Drawable) -> bool {
    let context = THREAD.with(|t| t.context.get());
    if context.is_null() {
        return false;
    }
    // SAFETY: as in `peek`; only compared.
    let c = unsafe { &*context };
    c.provider == provider && c.handle == handle && c.drawable == drawable && !c.destroyed
}

/// Whether the current context draws to this drawable.
pub(crate) fn draws_to(drawable: Drawable) -> bool {
    let context = THREAD.with(|t| t.context.get());
    // SAFETY: as in `peek`; only compared.
    !context.is_null() && unsafe { (*context).drawable == drawable }
}

/// The name of the X display, and the window behind a drawable.
fn window(drawable: Drawable) -> Option<(String, u32)> {
    match drawable {
        Drawable::Glx(display, drawable) => {
            // SAFETY: the program has just shown a frame with this display on this thread.
            let name = unsafe { geometry::display_name(display) }?;
            let window = windows::behind(display, drawable);
            Some((name, u32::try_from(window).ok()?))
        }
        _ => None,
    }
}

fn size(drawable: Drawable) -> Option<(u32, u32)> {
    match drawable {
        // SAFETY: the program has just made this drawable current on this thread.
        Drawable::Glx(display, drawable) => unsafe { geometry::glx_size(display, drawable) },
        Drawable::Egl(display, surface) => {
            let ask = |name: i32| {
                let mut v = 0i32;
                // SAFETY: the program's display and surface; one integer.
                let ok = unsafe {
                    Provider::Gl
                        .real()
                        .eglQuerySurface(display, surface, name, (&raw mut v).cast())
                };
                (ok != 0 && v > 0).then_some(v as u32)
            };
            const EGL_WIDTH: i32 = 0x3057;
            const EGL_HEIGHT: i32 = 0x3056;
            Some((ask(EGL_WIDTH)?, ask(EGL_HEIGHT)?))
        }
        Drawable::Memory(w, h) => Some((w, h)),
    }
}

/// Where a window lies on its screen; `size` is that of its picture.
fn place(drawable: Drawable, size: (u32, u32), seen: &mut Option<Seen>) -> Option<OnScreen> {
    // SAFETY: the program shows this drawable on this thread.
    let (connection, window) = unsafe {
        match drawable {
            Drawable::Glx(display, drawable) => {
                let window = windows::behind(display, drawable);
                (geometry::connection(display)?, window as u32)
            }
            Drawable::Egl(display, surface) => windows::behind_surface(display, surface)?,
            // Memory lies nowhere.
            Drawable::Memory(..) => return None,
        }
    };
    // SAFETY: the window's own connection, which the program has open as long as it shows something in it.
    unsafe { geometry::place(connection, window, size, seen) }
}

/// After a successful MakeCurrent of the program: takes the context over, or takes up again what it had. A null handle or no
/// drawable means that the thread has nothing to draw to.
pub(crate) fn made_current(provider: Provider, handle: Ptr, drawable: Option<Drawable>) {
    set_inside(Inside::Outside);
    release();
    THREAD.with(|t| t.provider.set((!handle.is_null()).then_some(provider)));
    let (Some(drawable), false, false) = (drawable, handle.is_null(), switch::off()) else {
        return;
    };
    deep::look();
    let Some((width, height)) = guarded(|| size(drawable)) else {
        return;
    };
    let context = take(provider, handle, drawable);
    // SAFETY: the context has just become current on this thread and so on no other.
    let c = unsafe { &mut *context };
    let moved = c.drawable != drawable;
    c.drawable = drawable;
    THREAD.with(|t| t.context.set(context));
    let fresh = c.layer.is_none() && c.frames.is_none();
    let outcome = with_context(|gl, c| match (&mut c.layer, &mut c.frames) {
        (None, None) if fresh => attach(gl, c, width, height),
        (Some(l), _) if moved || l.size() != (width, height) => {
            l.resize(gl, width, height).map_err(|e| e.to_string())
        }
        (_, Some(f)) => {
            f.resize(width, height);
            Ok(())
        }
        _ => Ok(()),
    });
    // Nothing is shown of such a context, and so no frame brings it the values of the others.
    with_context(|_, c| {
        if let Some(l) = c.layer.as_mut().filter(|l| l.is_hidden()) {
            live::adopt(l);
        }
    });
    if let Some(Err(e)) = outcome {
        say(&format!("{e}; this context is shown as it is"));
        with_context(|gl, c| {
            if let Some(l) = &mut c.layer {
                l.abandon(gl);
            }
            c.layer = None;
        });
        release();
    }
}

fn attach(gl: &Gl, c: &mut Context, width: u32, height: u32) -> Result<(), String> {
    match (switch::mode(), switch::config()) {
        (Mode::Active, Some(config)) => {
            c.layer = Some(
                Layer::new(
                    gl,
                    config,
                    width,
                    height,
                    shares::group(c.provider, c.handle),
                )
                .map_err(|e| e.to_string())?,
            )
        }
        (Mode::Observe, Some(config)) => c.frames = Some(Frames::new(config, width, height)),
        _ => {}
    }
    Ok(())
}

/// The record of a context that has become current on this thread.
fn take(provider: Provider, handle: Ptr, drawable: Drawable) -> *mut Context {
    let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let known = registry.0.iter().copied().find(|&c| {
        // SAFETY: boxes in the list live until `release` or `destroyed` takes them out under this lock; these fields do not change
        // while another thread has the context current.
        let c = unsafe { &*c };
        c.provider == provider && c.handle == handle && !c.destroyed
    });
    let context = known.unwrap_or_else(|| {
        let c = Box::into_raw(Box::new(Context {
            provider,
            handle,
            drawable,
            seen: None,
            layer: None,
            frames: None,
            current: false,
            destroyed: false,
        }));
        registry.0.push(c);
        c
    });
    // SAFETY: a box of the list; this flag is only used under the lock, which is held.
    unsafe { (*context).current = true };
    context
}

/// This thread has no context of ours any more; frees the record of one that was destroyed while it was current. Its GL objects
/// go with the context.
fn release() {
    let context = THREAD.with(|t| t.context.replace(core::ptr::null_mut()));
    if context.is_null() {
        return;
    }
    // SAFETY: it was this thread's current context until now.
    if let Some(layer) = unsafe { (*context).layer.as_mut() } {
        layer.count_names();
    }
    let gone = {
        let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: the box lives, because it is current; these flags are only used under the lock, which is held.
        let gone = unsafe {
            (*context).current = false;
            (*context).destroyed
        };
        if gone {
            registry.0.retain(|&c| c != context);
        }
        gone
    };
    if gone {
        // SAFETY: out of the list now, current nowhere.
        unsafe { forget(context) };
    }
}

/// # Safety
/// Made by `take`, no longer in the list, current nowhere.
unsafe fn forget(context: *mut Context) {
    // SAFETY: made by Box::into_raw; nobody else has it (contract).
    let context = unsafe { Box::from_raw(context) };
    if let Some(layer) = context.layer {
        layer.leave();
    }
}

/// The program destroys a context. GL calls it only when it is current nowhere; until then the handle stays valid, and whoever has
/// it current frees the record.
pub(crate) fn destroyed(provider: Provider, handle: Ptr) {
    let (unused, last) = {
        let mut registry = CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: boxes of the list live; provider and handle do not change, the flags are only used under the lock.
        let found = registry.0.iter().position(|&c| unsafe {
            (*c).provider == provider && (*c).handle == handle && !(*c).destroyed
        });
        let unused = found.and_then(|at| {
            let context = registry.0.get(at).copied()?;
            // SAFETY: as above.
            let current = unsafe {
                (*context).destroyed = true;
                (*context).current
            };
            (!current).then(|| registry.0.swap_remove(at))
        });
        // SAFETY: as above.
        let last = registry.0.iter().all(|&c| unsafe { (*c).destroyed });
        (unused, last)
    };
    if last {
        control::close(control::State::Unopened);
    }
    if let Some(context) = unused {
        // SAFETY: out of the list now, current nowhere.
        unsafe { forget(context) };
    }
    shares::destroyed(provider, handle);
}

/// End of a frame on a drawable: shows it. `swap` is the program's own call.
pub(crate) fn frame<R>(drawable: Option<Drawable>, swap: impl FnOnce() -> R) -> R {
    write_back_shared();
    let ours = drawable.is_none_or(draws_to);
    if ours {
        with_context(|gl, c| {
            if let Some(l) = &mut c.layer {
                control::before(l);
                keys::before(l);
                if l.follows_window() {
                    l.moved(place(c.drawable, l.size(), &mut c.seen));
                }
                l.show(gl, drawable.is_some());
            }
            if let Some(f) = &mut c.frames {
                f.show(gl);
            }
        });
    }
    let r = guarded(swap);
    if ours {
        with_context(|_, c| {
            if let Some(l) = &mut c.layer {
                l.count_frame();
                live::adopt(l);
                // First: a picture that a key has asked for is no client's.
                keys::after(l, || window(c.drawable));
                control::after(l);
            }
            if let Some(f) = &mut c.frames {
                f.count_frame();
            }
        });
        check_size();
    }
    r
}

/// Follows the window's size: at the swap and when the program sets its viewport, which are safe moments on the GL thread.
pub(crate) fn check_size() {
    let failed = with_context(|gl, c| {
        let (w, h) = size(c.drawable)?;
        if let Some(f) = &mut c.frames {
            f.resize(w, h);
        }
        let l = c.layer.as_mut()?;
        if l.state.begin != manyview_core::state::Begin::Outside || l.state.list.is_some() {
            return None;
        }
        l.resize(gl, w, h).err().map(|e| e.to_string())
    });
    if let Some(Some(e)) = failed {
        turn_off(&e);
    }
}

/// Whether the current context draws to the program's memory (OSMesa).
pub(crate) fn draws_to_memory() -> bool {
    let context = THREAD.with(|t| t.context.get());
    // SAFETY: as in `peek`; only compared.
    !context.is_null() && unsafe { matches!((*context).drawable, Drawable::Memory(..)) }
}

/// Other contexts may look at what is drawn to the program's textures: they hold it now.
pub(crate) fn write_back_shared() {
    if peek(|l| l.has_copies() && l.is_shared()) == Some(true) {
        enter(|gl, l| l.write_back_textures(gl));
    }
}

/// The program leaves an OSMesa context: what it has drawn since its last glFinish is a frame.
pub(crate) fn finish_memory_frame() {
    write_back_shared();
    if draws_to_memory() && enter(|_, l| l.drawn()) == Some(true) {
        // SAFETY: the context is still current.
        frame(None, || unsafe { Provider::OsMesa.real().glFinish() });
    }
}
