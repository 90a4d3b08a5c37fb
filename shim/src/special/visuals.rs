//! The choice of visuals under GLX: where the output needs a left and a right buffer, the driver is asked for a stereo window. Where the program asks for one and the driver has none, the
//! program gets another one, of which it is told that it has both.

use crate::context::guarded;
use crate::provider::Provider;
use crate::switch::{self, Mode};
use core::ffi::c_ulong;
use manyview_core::config::Output;
use manyview_core::gl::Ptr;
use manyview_core::present::Attributes;
use manyview_core::state::{are_eyes_given, give_eyes};
use std::collections::BTreeSet;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The program's attributes with stereo added. None where the output needs no stereo, or the list cannot be extended.
///
/// # Safety
/// A list as GLX takes it, or null.
unsafe fn with_stereo(kind: Attributes, attribs: Ptr) -> Option<Vec<i32>> {
    let quad = switch::config().is_some_and(|config| config.output == Output::Quad);
    if !quad || switch::mode() != Mode::Active {
        return None;
    }
    if attribs.is_null() {
        // glXChooseFBConfig takes null for an empty list; with glXChooseVisual it is an error, which is left to the driver.
        return (kind == Attributes::Config)
            .then(|| kind.with_stereo([]))
            .flatten();
    }
    let list = attribs.cast::<i32>();
    // SAFETY: read one by one up to the end of the list, which it has (contract).
    kind.with_stereo((0..).map(|i| unsafe { list.add(i).read() }))
}

/// The program's attributes without the wish for stereo. None where it has no such wish, or the layer is not to help.
///
/// # Safety
/// A list as GLX takes it, or null.
unsafe fn without_stereo(kind: Attributes, attribs: Ptr) -> Option<Vec<i32>> {
    if attribs.is_null() || switch::mode() != Mode::Active {
        return None;
    }
    let several = switch::config().is_some_and(|config| config.views > 1);
    let list = attribs.cast::<i32>();
    // SAFETY: as above.
    several
        .then(|| kind.without_stereo((0..).map(|i| unsafe { list.add(i).read() })))
        .flatten()
}

/// A hook that asks the driver for a stereo window, and if there is none, for the window that the program wants.
macro_rules! choose {
    ($name:ident($($count:ident)?), $kind:expr, $note:ident) => {
        pub(crate) unsafe fn $name(dpy: Ptr, screen: i32, attribs: Ptr $(, $count: Ptr)?) -> Ptr {
            // SAFETY: the program's own call, with its own list or a longer one that ends as it should.
            let ask = |list: Ptr| guarded(|| unsafe { Provider::Gl.real().$name(dpy, screen, list $(, $count)?) });
            // SAFETY: the program's list.
            let stereo = unsafe { with_stereo($kind, attribs) };
            let found = stereo.map(|mut list| ask(list.as_mut_ptr().cast()));
            let found = found.filter(|found| !found.is_null()).unwrap_or_else(|| ask(attribs));
            if !found.is_null() {
                return found;
            }
            // SAFETY: the program's list.
            let Some(mut list) = (unsafe { without_stereo($kind, attribs) }) else {
                return found;
            };
            let found = ask(list.as_mut_ptr().cast());
            if !found.is_null() {
                let count: Ptr = core::ptr::null_mut();
                $(let count = { let _ = count; $count };)?
                // SAFETY: what the driver has returned for this call.
                unsafe { $note(dpy, found, count) };
                give_eyes();
            }
            found
        }
    };
}

choose!(glXChooseVisual(), Attributes::Visual, note_visual);
choose!(glXChooseFBConfig(count), Attributes::Config, note_configs);
choose!(
    glXChooseFBConfigSGIX(count),
    Attributes::Config,
    note_configs
);

/// GLX_STEREO
const STEREO: i32 = 6;
/// GLX_VISUAL_ID
const VISUAL_ID: i32 = 0x800B;

/// The visuals, by their IDs, and the configurations, by their addresses, that the program was given with eyes of the layer's.
static GIVEN: Mutex<BTreeSet<usize>> = Mutex::new(BTreeSet::new());

fn given() -> MutexGuard<'static, BTreeSet<usize>> {
    GIVEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The ID of a visual.
///
/// # Safety
/// An XVisualInfo.
unsafe fn id(visual: Ptr) -> usize {
    // SAFETY: its second field (Xutil.h).
    unsafe { visual.cast::<c_ulong>().add(1).read() as usize }
}

/// Notes a visual that is given.
///
/// # Safety
/// As [`id`].
unsafe fn note_visual(_: Ptr, visual: Ptr, _: Ptr) {
    // SAFETY: forwarded.
    given().insert(unsafe { id(visual) });
}

/// Notes configurations that are given, and their visuals.
///
/// # Safety
/// What glXChooseFBConfig returns, and the number of them.
unsafe fn note_configs(dpy: Ptr, configs: Ptr, count: Ptr) {
    // SAFETY: forwarded.
    let all = unsafe {
        let count = usize::try_from(*count.cast::<i32>()).unwrap_or(0);
        core::slice::from_raw_parts(configs.cast::<Ptr>(), count)
    };
    for &config in all {
        let mut visual = 0i32;
        // SAFETY: a configuration of this display; one integer.
        let answer = guarded(|| unsafe {
            let value = (&raw mut visual).cast();
            Provider::Gl
                .real()
                .glXGetFBConfigAttrib(dpy, config, VISUAL_ID, value)
        });
        let mut given = given();
        given.insert(config as usize);
        if answer == 0 && visual > 0 {
            given.insert(visual as usize);
        }
    }
}

/// A hook that tells of a window that it has a left and a right buffer, if it is one of those that were given with them.
macro_rules! tell {
    ($name:ident($of:ident), $known:expr) => {
        pub(crate) unsafe fn $name(dpy: Ptr, $of: Ptr, name: i32, value: Ptr) -> i32 {
            // SAFETY: the program's own call.
            let answer = guarded(|| unsafe { Provider::Gl.real().$name(dpy, $of, name, value) });
            let asked = answer == 0 && name == STEREO && !value.is_null() && are_eyes_given();
            // SAFETY: the driver has taken it for what it is.
            if asked && given().contains(&unsafe { $known($of) }) {
                // SAFETY: the driver has written one integer there.
                unsafe { value.cast::<i32>().write(1) };
            }
            answer
        }
    };
}

/// The address of a configuration. Nothing is read there.
unsafe fn address(config: Ptr) -> usize {
    config as usize
}

tell!(glXGetConfig(visual), id);
tell!(glXGetFBConfigAttrib(config), address);
