//! Who calls the driver on this thread: the program itself, or one of our hooks.

use core::cell::Cell;

thread_local! {
    /// Hooks at work on this thread, one inside the other. It has no destructor, because threads may call GL while they end.
    static DEPTH: Cell<u32> = const { Cell::new(0) };
    /// Whether the hook makes the program's own call.
    static OWN_CALL: Cell<bool> = const { Cell::new(false) };
}

/// While it lives, all hooks of this thread pass calls on. It ends with its scope, also where an exception of the program or the
/// cancellation of the thread unwinds through that.
pub(crate) struct Passing(());

impl Passing {
    pub(crate) fn new() -> Self {
        DEPTH.set(DEPTH.get() + 1);
        Passing(())
    }
}

impl Drop for Passing {
    fn drop(&mut self) {
        DEPTH.set(DEPTH.get().saturating_sub(1));
    }
}

/// Who has made the call that the driver is at work on.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Caller {
    /// The program, with no hook at work.
    Program,
    /// A hook. `own_call`: it makes the program's own call, for the last time so far.
    Hook { own_call: bool },
}

/// Who has made the call of this thread that the driver is at work on.
pub(crate) fn caller() -> Caller {
    match DEPTH.get() {
        0 => Caller::Program,
        _ => Caller::Hook {
            own_call: OWN_CALL.get(),
        },
    }
}

/// While it lives, calls of this thread are the program's own, or the layer's.
pub(crate) struct Calls {
    before: bool,
}

impl Calls {
    pub(crate) fn of_program(own: bool) -> Self {
        Calls {
            before: OWN_CALL.replace(own),
        }
    }
}

impl Drop for Calls {
    fn drop(&mut self) {
        OWN_CALL.set(self.before);
    }
}
