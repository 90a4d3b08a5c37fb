//! Work of the layer in place of a call of the program's.

use crate::context::{enter_unflushed, own_call, take_owed};
use manyview_core::gl::Gl;
use manyview_core::layer::Layer;

/// Runs `f` in place of the program's own call, which it gets. Where there is no layer to run it on, and where a fault ends it before the
/// program's own view has got the call, the call is made as it is.
pub(crate) fn instead(call: &mut dyn FnMut(), f: impl FnOnce(&Gl, &mut Layer, &mut dyn FnMut())) {
    instead_unflushed(call, |gl, l, call| {
        l.flush_points(gl);
        f(gl, l, call);
    });
}

/// As [`instead`] and [`enter_unflushed`].
pub(crate) fn instead_unflushed(
    call: &mut dyn FnMut(),
    f: impl FnOnce(&Gl, &mut Layer, &mut dyn FnMut()),
) {
    at_places((), &mut |()| call(), |gl, l, call| {
        f(gl, l, &mut || call(()))
    });
}

/// As [`instead`], for a call that is made at the place of each view; `as_it_is` is that of the program.
pub(crate) fn instead_at<P>(
    as_it_is: P,
    call: &mut dyn FnMut(P),
    f: impl FnOnce(&Gl, &mut Layer, &mut dyn FnMut(P)),
) {
    at_places(as_it_is, call, |gl, l, call| {
        l.flush_points(gl);
        f(gl, l, call);
    });
}

fn at_places<P>(
    as_it_is: P,
    call: &mut dyn FnMut(P),
    f: impl FnOnce(&Gl, &mut Layer, &mut dyn FnMut(P)),
) {
    let mut made = false;
    let done = enter_unflushed(|gl, l| {
        f(gl, l, &mut |place| {
            own_call(|| call(place));
            made = true;
        });
    });
    if done.is_none() && (take_owed() || !made) {
        call(as_it_is);
    }
}
