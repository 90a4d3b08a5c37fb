//! The context that is current on each thread, and the guard that every hook passes.

use crate::caller::{Caller, Calls, Passing, caller};
use crate::drawable::{self, Drawable, Pair};
use crate::geometry::Seen;
use crate::messages::{self, Receiver};
use crate::provider::Provider;
use crate::record::{Context, Key, Work};
use crate::signals::{self, Quiet};
use crate::switch::{self, Mode, say, say_once, turn_off};
use crate::uncancelled::Uncancelled;
use crate::{control, deep, drawables, fault, keys, limiter, live, panel, registry, shares};
use core::cell::Cell;
use manyview_core::gl::shadow::no_shadow;
use manyview_core::gl::{Gl, Ptr, Real};
use manyview_core::layer::{CurrentDrawable, Frames, Layer};
use std::time::Instant;

/// The state of a thread. It has no destructor, because threads may call GL while they end.
struct Thread {
    context: Cell<*mut Context>,
    /// That of the context that is current, also of one without a record.
    key: Cell<Option<Key>>,
    inside: Cell<Inside>,
    /// See [`take_owed`].
    owed: Cell<bool>,
}

/// Whether a thread is between glBegin and glEnd. There the driver is between them as well, so that it refuses commands that are
/// not allowed; other hooks pass everything on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Inside {
    /// Not between glBegin and glEnd.
    Outside,
    /// Calls are recorded.
    Recorded,
    /// Calls go to the driver.
    Direct,
}

thread_local! {
    static THREAD: Thread = const {
        Thread { context: Cell::new(core::ptr::null_mut()), key: Cell::new(None), inside: Cell::new(Inside::Outside), owed: Cell::new(false) }
    };
}

/// The driver's functions for this thread: those of the provider that made its context current.
pub(crate) fn real() -> &'static Real {
    let provider = match current_key() {
        Some((provider, _)) => provider,
        None if Provider::Gl.loaded() => Provider::Gl,
        None => Provider::OsMesa,
    };
    provider.real()
}

/// The context that this thread has current, whether it has a layer or not.
pub(crate) fn current_key() -> Option<Key> {
    THREAD.with(|t| t.key.get())
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

/// Notes glBegin and glEnd.
pub(crate) fn set_inside(inside: Inside) {
    THREAD.with(|t| t.inside.set(inside));
}

/// Makes the program's own call, from inside a hook's work. It may be made once for each view, the last time for the program's own.
pub(crate) fn own_call<R>(call: impl FnOnce() -> R) -> R {
    let _calls = Calls::of_program(true);
    messages::forget();
    call()
}

/// Makes a call of the program's with all hooks passing calls on: the driver may call exported names in it.
pub(crate) fn guarded<R>(call: impl FnOnce() -> R) -> R {
    let passing = Passing::new();
    let made = own_call(call);
    drop(passing);
    tell_messages();
    made
}

/// Gives the program the messages of its call, once no hook is at work.
fn tell_messages() {
    if caller() == Caller::Program {
        messages::deliver();
    }
}

/// Runs work of ours with all hooks passing calls on. A panic turns the layer off for good and gives None. The thread is not cancelled
/// meanwhile: Rust code that catches panics cannot be cancelled.
pub(crate) fn sheltered<R>(work: impl FnOnce() -> R) -> Option<R> {
    let _passing = Passing::new();
    let _calls = Calls::of_program(false);
    let _whole = Uncancelled::new();
    let work = || {
        #[cfg(all(test, feature = "fake-driver"))]
        crate::tests::strike(crate::tests::Stage::Before);
        let done = work();
        #[cfg(all(test, feature = "fake-driver"))]
        crate::tests::strike(crate::tests::Stage::After);
        done
    };
    let done = fault::catch(work);
    if let Err(fault) = &done {
        set_inside(Inside::Outside);
        give_up(fault);
    }
    done.ok()
}

/// Runs `f` on the layer of the current context without the guard, for work that can neither panic nor call GL. None between glBegin
/// and glEnd, where a call has no effect but an error.
#[inline]
pub(crate) fn peek<R>(f: impl FnOnce(&mut Layer) -> R) -> Option<R> {
    if inside() == Inside::Outside {
        peek_inside(f)
    } else {
        None
    }
}

/// As [`peek`], but also between glBegin and glEnd.
#[inline]
pub(crate) fn peek_inside<R>(f: impl FnOnce(&mut Layer) -> R) -> Option<R> {
    if caller() != Caller::Program {
        return None;
    }
    current(|context| {
        let mut work = context.work.try_borrow_mut().ok()?;
        work.layer.as_deref_mut().map(f)
    })
    .flatten()
}

/// Runs `f` on the context that this thread has current. `f` must not release it.
#[inline]
fn current<R>(f: impl FnOnce(&Context) -> R) -> Option<R> {
    let context = THREAD.with(|t| t.context.get());
    if context.is_null() {
        return None;
    }
    // SAFETY: from `registry::take` on this thread, which frees it in `release` alone, and that is called where no hook is at work.
    Some(f(unsafe { &*context }))
}

/// The guard of every hook that does something: runs `f` on the driver and the layer of the current context. None if there is no
/// context, if the call comes from inside the layer or the driver or between glBegin and glEnd, or if the layer is off. A panic turns
/// the layer off for good.
pub(crate) fn enter<R>(f: impl FnOnce(&Gl, &mut Layer) -> R) -> Option<R> {
    enter_unflushed(|gl, l| {
        l.flush_points(gl);
        f(gl, l)
    })
}

/// As [`enter`], for commands after which more may be drawn to the samples of the panel.
pub(crate) fn enter_unflushed<R>(f: impl FnOnce(&Gl, &mut Layer) -> R) -> Option<R> {
    with_context(|gl, _, work| work.layer.as_mut().map(|l| f(gl, l))).flatten()
}

/// Whether the last fault of this thread came after a call was made for other views than the program's own. The next answer is no.
pub(crate) fn take_owed() -> bool {
    THREAD.with(|t| t.owed.replace(false))
}

fn with_context<R>(f: impl FnOnce(&Gl, &Context, &mut Work) -> R) -> Option<R> {
    if caller() != Caller::Program || inside() != Inside::Outside || switch::ending() {
        return None;
    }
    let done = current(|context| {
        if switch::off() {
            give_back(context, false);
            return None;
        }
        sheltered(|| {
            let mut work = context.work.try_borrow_mut().ok()?;
            let r = f(driver(context), context, &mut work);
            if !work.watched && work.layer.as_ref().is_some_and(|l| l.drawn()) {
                // What the program does at its end is known to atexit by now.
                work.watched = true;
                switch::watch_the_end();
            }
            Some(r)
        })
        .unwrap_or_else(|| {
            give_back(context, true);
            None
        })
    });
    tell_messages();
    done.flatten()
}

/// The receiver of the current context's debug messages. None without a context.
pub(crate) fn receiver() -> Option<&'static Receiver> {
    current(|context| *context.receiver.get_or_init(Receiver::new))
}

/// The driver's functions for a context that is current on this thread.
fn driver(context: &Context) -> &Gl {
    // SAFETY: the context is current on this thread while the hook runs, and only then is the value used.
    let gl = || unsafe { Gl::new(context.key.0.real()) };
    context.gl.get_or_init(gl)
}

/// The layer is off: gives the program its framebuffer 0 in a context that still draws to ours. `fault`: a hook was interrupted.
#[cold]
fn give_back(context: &Context, fault: bool) {
    let Ok(mut work) = context.work.try_borrow_mut() else {
        return;
    };
    if let Some(layer) = work.layer.take() {
        THREAD.with(|t| t.owed.set(fault && layer.owes_own_view()));
        sheltered(|| layer.dissolve(driver(context), fault));
    }
}

/// Turns the layer off for good and closes the control socket.
fn give_up(why: &str) {
    if turn_off(why) {
        control::close(control::State::Closed);
    }
}

/// Whether this thread already has a context current with these drawables, so that MakeCurrent changes nothing.
pub(crate) fn is_current(provider: Provider, handle: Ptr, drawables: Option<Pair>) -> bool {
    let is = |c: &Context| {
        c.key == (provider, handle) && c.drawables.get() == drawables && !registry::is_destroyed(c)
    };
    current(is) == Some(true)
}

/// Whether the current context draws to this drawable.
pub(crate) fn draws_to(drawable: Drawable) -> bool {
    current(|c| c.draws_to() == Some(drawable)) == Some(true)
}

/// After a successful MakeCurrent of the program: sets up the layer of the context, or resumes the one that it has. With a null handle
/// or without a drawable, the thread has nothing to draw to.
pub(crate) fn made_current(provider: Provider, handle: Ptr, drawables: Option<Pair>) {
    // The call comes from the driver or the layer, inside a call that has a hook of its own.
    if caller() != Caller::Program {
        return;
    }
    set_inside(Inside::Outside);
    sheltered(release);
    let key = (provider, handle);
    THREAD.with(|t| t.key.set((!handle.is_null()).then_some(key)));
    if handle.is_null() {
        return;
    }
    let Some(current_ones) = sheltered(|| take(key, drawables)).flatten() else {
        return;
    };
    current(|c| c.drawables.set(drawables));
    let outcome = with_context(|gl, c, work| {
        let [draw, _] = current_ones;
        let outcome = match (&mut work.layer, &mut work.frames) {
            (None, None) if work.refused || drawables.is_none() => Ok(()),
            (None, None) => attach(gl, c.key, work, current_ones),
            (Some(l), _) => {
                switch_to(gl, l, c.key, current_ones);
                Ok(())
            }
            (_, Some(f)) => {
                f.resize(draw.size.0, draw.size.1);
                Ok(())
            }
        };
        match &mut work.layer {
            Some(_) if outcome.is_err() => {
                let layer = work.layer.take();
                layer.into_iter().for_each(|l| l.dissolve(gl, false));
            }
            // Such a context shows no frames, at which it would get the values of the process.
            Some(l) if l.is_hidden() => live::adopt(l),
            _ => {}
        }
        work.refused |= outcome.is_err();
        outcome
    });
    if let Some(Err(e)) = outcome {
        say_once(&format!("{e}; this context is shown as it is"));
        sheltered(release);
    }
}

/// Says what the layer has to say at once.
fn announce(layer: &mut Layer) {
    layer
        .take_announced()
        .iter()
        .for_each(|said| say_once(said));
}

fn switch_to(gl: &Gl, layer: &mut Layer, key: Key, current: [CurrentDrawable; 2]) {
    let elsewhere = |id| drawables::drawn_elsewhere(id, key);
    layer.switch(gl, current, &elsewhere, &drawables::lives);
    announce(layer);
}

/// Makes a context that the driver has made current that of this thread. Returns its drawables, that to draw to first; None where the
/// context is left alone. Without a drawable, a context is left alone that never had one.
fn take(key: Key, drawables: Option<Pair>) -> Option<[CurrentDrawable; 2]> {
    if switch::off() && !registry::knows(key) {
        return None;
    }
    deep::rebind_new_libraries();
    let taken = take_record(key, drawables);
    if taken.is_none() {
        registry::note_unseen(key);
    }
    taken
}

/// Takes the record of a context for this thread. None where there is none to be had.
fn take_record(key: Key, drawables: Option<Pair>) -> Option<[CurrentDrawable; 2]> {
    let current = match drawables {
        Some(Pair { draw, read }) => {
            let current = |drawable| {
                let (id, size) = (drawables::id(drawable), drawable::first_size(drawable)?);
                Some(CurrentDrawable { id, size })
            };
            let drawn = current(draw)?;
            let read = if read == draw { None } else { current(read) };
            [drawn, read.unwrap_or(drawn)]
        }
        None if registry::knows(key) => [CurrentDrawable::NONE; 2],
        None => return None,
    };
    let Some(context) = registry::take(key, || {
        let shared = shares::member(key.0, key.1).kept();
        Context::new(key, drawables, shared)
    }) else {
        say("a context is current on two threads; the second one shows it as it is");
        return None;
    };
    THREAD.with(|t| t.context.set(context));
    // SAFETY: from `registry::take` on this thread, which has the record until `release`, and that takes the shadow away first.
    unsafe { (*context).shadow.make_current() };
    Some(current)
}

fn attach(gl: &Gl, key: Key, work: &mut Work, current: [CurrentDrawable; 2]) -> Result<(), String> {
    match (switch::mode(), switch::config()) {
        (Mode::Active, Some(config)) => {
            let member = shares::member(key.0, key.1);
            let layer = signals::held_off(|| Layer::new(gl, config, current[0], member));
            let layer = layer.map_err(|e| e.to_string())?;
            let layer = work.layer.insert(layer);
            announce(layer);
            switch_to(gl, layer, key, current);
        }
        (Mode::Observe, Some(config)) => {
            let (width, height) = current[0].size;
            work.frames = Some(Frames::new(config, width, height));
        }
        _ => {}
    }
    Ok(())
}

/// Releases the context of this thread. The record of a context that was destroyed while it was current is freed. Its GL objects end
/// with the context.
fn release() {
    let context = THREAD.with(|t| t.context.replace(core::ptr::null_mut()));
    no_shadow();
    if context.is_null() {
        return;
    }
    // SAFETY: from `take` on this thread, which has it until the next line.
    if let Ok(mut work) = unsafe { &*context }.work.try_borrow_mut()
        && let Some(layer) = &mut work.layer
    {
        layer.count_names();
    }
    // SAFETY: as above; no hook is at work on this thread, so there is no reference.
    forget(unsafe { registry::release(context) });
}

/// Frees the record of a destroyed context.
fn forget(context: Option<Box<Context>>) {
    if let Some(layer) = context.and_then(|c| c.work.into_inner().layer) {
        layer.leave();
    }
}

/// The program destroys a context. GL destroys it only when it is current on no thread. Until then the handle stays valid, and the thread
/// that has it current frees the record.
pub(crate) fn destroyed(provider: Provider, handle: Ptr) {
    sheltered(|| {
        let (unused, last) = registry::destroy((provider, handle));
        if last {
            control::close(control::State::Unopened);
        }
        forget(unused);
        shares::destroyed(provider, handle);
    });
}

/// The end of a frame on a drawable: shows the frame and makes the program's own call, `swap`.
pub(crate) fn frame<R>(drawable: Option<Drawable>, swap: impl FnOnce() -> R) -> R {
    write_back_shared();
    let ours = drawable.is_none_or(draws_to);
    if ours {
        with_context(|gl, c, work| {
            let _quiet = Quiet::new();
            if let Some(l) = &mut work.layer {
                control::before(l);
                keys::before(l);
                panel::before(l, c.draws_to());
                let kept = drawable.is_none() || !l.has_back_buffer();
                if let Some(draw) = c.draws_to() {
                    follow_window(l, draw, &mut work.seen);
                    if l.drawn() {
                        drawables::drawn_by(drawables::id(draw), kept.then_some(c.key));
                    }
                }
                l.show(gl, drawable.is_some());
                panel::after(l);
            }
            if let Some(f) = &mut work.frames {
                f.show(gl, drawable.is_none());
            }
        });
    }
    limiter::before(drawable);
    let r = guarded(swap);
    limiter::after(drawable);
    if ours {
        with_context(|_, c, work| {
            let _quiet = Quiet::new();
            if let Some(l) = &mut work.layer {
                l.count_frame();
                live::adopt(l);
                let before = l.live();
                l.advance(Instant::now());
                live::changed(l, before);
                // Keys come first, so that no client of the socket gets a picture that a key asked for.
                keys::after(l, || c.draws_to().and_then(drawable::shown));
                control::after(l);
            }
            if let Some(f) = &mut work.frames {
                f.count_frame();
            }
        });
        check_size();
    } else if let Some(id) = drawable.and_then(drawables::known) {
        with_context(|_, _, work| {
            drawables::drawn_by(id, None);
            if let Some(l) = &mut work.layer
                && l.shown_aside(id)
            {
                l.count_frame();
            }
        });
    }
    r
}

/// Tells the layer where the window and the pointer are, where its picture depends on that.
fn follow_window(layer: &mut Layer, drawable: Drawable, seen: &mut Option<Seen>) {
    if layer.follows_window() {
        layer.moved(drawable::place(drawable, layer.size(), seen));
    }
    if layer.wants_pointer()
        && let Some((x, y)) = drawable::pointer(drawable)
    {
        layer.point([x, layer.size().1 as i32 - 1 - y]);
    }
}

/// The program sets its viewport to a size. A size that it did not use before may be the new size of the window.
pub(crate) fn viewport_set(width: i32, height: i32) {
    let new = |context: &Context| {
        let mut work = context.work.try_borrow_mut().ok()?;
        Some(work.viewports.is_new((width, height)))
    };
    if current(new).flatten() == Some(true) {
        check_size();
    }
}

/// Follows the size of the drawable. Called at the swap and at a viewport of a new size, which are safe moments on the GL thread.
fn check_size() {
    with_context(|gl, c, work| {
        let (w, h) = drawable::size(c.draws_to()?)?;
        work.viewports.window_has((w, h));
        if let Some(f) = &mut work.frames {
            f.resize(w, h);
        }
        let l = work.layer.as_mut().filter(|l| l.can_resize())?;
        l.resize(gl, w, h);
        announce(l);
        Some(())
    });
}

/// Whether the current context draws to the program's memory (OSMesa).
pub(crate) fn draws_to_memory() -> bool {
    current(|c| matches!(c.draws_to(), Some(Drawable::Memory(..)))) == Some(true)
}

/// Writes back the program's textures if other contexts can read them.
pub(crate) fn write_back_shared() {
    if peek(|l| l.has_copies() && l.is_shared()) == Some(true) {
        enter(|gl, l| l.write_back_textures(gl));
    }
}

/// Whether something was drawn that no picture has shown.
pub(crate) fn is_drawn() -> bool {
    enter(|_, l| l.drawn()) == Some(true)
}

fn shows_on_flush() -> bool {
    let observed = with_context(|gl, _, work| {
        work.frames
            .as_ref()
            .is_some_and(|frames| frames.shows_on_flush(gl))
    });
    observed == Some(true) || enter(|_, l| l.shows_on_flush()) == Some(true)
}

/// Makes a call that flushes, which shows what was drawn to the front buffer, or to the only one.
pub(crate) fn show_flushed<R>(call: impl FnOnce() -> R) -> R {
    write_back_shared();
    show_where(shows_on_flush, call)
}

/// Makes a call, as the end of a frame where a window or pbuffer is drawn to and `shows` says that the call shows it.
fn show_where<R>(shows: fn() -> bool, call: impl FnOnce() -> R) -> R {
    match !draws_to_memory() && shows() {
        true => frame(None, call),
        false => guarded(call),
    }
}

/// The program is about to leave its context, which flushes, for `next` with other drawables. Anything that it has drawn to its memory
/// (OSMesa) since its last glFinish is a frame. Of a window's back buffer, the true framebuffer 0 gets the picture.
pub(crate) fn leave_context(next: Key, drawables: Option<Pair>) {
    write_back_shared();
    // With one view it is not known whether anything was drawn, and most programs have shown it by now.
    show_where(|| enter(|_, l| l.shows_on_flush()) == Some(true), || ());
    if !draws_to_memory() {
        leave_drawable(next, drawables);
    } else if is_drawn() {
        // SAFETY: the context is still current.
        frame(None, || unsafe { Provider::OsMesa.real().glFinish() });
    }
}

fn leave_drawable(next: Key, next_drawables: Option<Pair>) {
    with_context(|gl, c, work| {
        let _quiet = Quiet::new();
        let layer = work.layer.as_mut()?;
        let draw = c.draws_to()?;
        let id = drawables::id(draw);
        if layer.is_ahead() {
            drawables::drawn_by(id, Some(c.key));
        }
        let handed_over = next != c.key
            && next_drawables.is_some_and(|d| d.draw == draw || d.read == draw)
            && drawables::drawn_elsewhere(id, next);
        if layer.is_ahead() {
            follow_window(layer, draw, &mut work.seen);
        }
        layer.leave_drawable(gl, handed_over);
        Some(())
    });
}

/// Makes a call after which another thread may show what was drawn.
pub(crate) fn show_finished<R>(call: impl FnOnce() -> R) -> R {
    if !draws_to_memory() && registry::threads() > 1 {
        with_context(|gl, c, work| {
            let _quiet = Quiet::new();
            let layer = work.layer.as_mut().filter(|l| l.is_ahead())?;
            let draw = c.draws_to()?;
            drawables::drawn_by(drawables::id(draw), Some(c.key));
            follow_window(layer, draw, &mut work.seen);
            layer.picture_unfinished(gl, false);
            Some(())
        });
    }
    show_flushed(call)
}
