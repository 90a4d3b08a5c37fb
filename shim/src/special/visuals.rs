//! The choice of visuals under GLX: where the output needs a left and a right buffer, the driver is asked for a stereo window. Where the program asks for one and the driver has none, the
//! program gets another one, of which it is told that it has both.

use crate::context::guarded;
use crate::provider::Provider;
use crate::switch::{self, Mode};
use manyview_core::config::Output;
use manyview_core::gl::Ptr;
use manyview_core::present::Attributes;
use manyview_core::state::{are_eyes_given, give_eyes};

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
    ($name:ident($($count:ident)?), $kind:expr) => {
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
                give_eyes();
            }
            found
        }
    };
}

choose!(glXChooseVisual(), Attributes::Visual);
choose!(glXChooseFBConfig(count), Attributes::Config);
choose!(glXChooseFBConfigSGIX(count), Attributes::Config);

/// GLX_STEREO
const STEREO: i32 = 6;

/// A hook that tells of a window that it has a left and a right buffer, once the program was given these.
macro_rules! tell {
    ($name:ident($of:ident)) => {
        pub(crate) unsafe fn $name(dpy: Ptr, $of: Ptr, name: i32, value: Ptr) -> i32 {
            // SAFETY: the program's own call.
            let answer = guarded(|| unsafe { Provider::Gl.real().$name(dpy, $of, name, value) });
            if answer == 0 && name == STEREO && are_eyes_given() && !value.is_null() {
                // SAFETY: the driver has written one integer there.
                unsafe { value.cast::<i32>().write(1) };
            }
            answer
        }
    };
}

tell!(glXGetConfig(visual));
tell!(glXGetFBConfigAttrib(config));
