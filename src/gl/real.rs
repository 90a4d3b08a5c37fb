//! The table of real functions of one provider.

use super::table::{COUNT, NAMES};
use core::ffi::{CStr, c_void};
use core::sync::atomic::{AtomicPtr, Ordering::Relaxed};

/// Any pointer that crosses the C ABI; what it points to is the command's own affair.
pub type Ptr = *mut c_void;

/// The real functions of one provider (libGL and libEGL through glvnd, or libOSMesa), found on first use.
pub struct Real {
    slots: [AtomicPtr<c_void>; COUNT],
    loader: fn(&CStr) -> Option<Ptr>,
}

impl core::fmt::Debug for Real {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Real").finish_non_exhaustive()
    }
}

/// Stands for "looked for and not there" in a slot.
const MISSING: Ptr = usize::MAX as Ptr;

impl Real {
    /// A table whose functions `loader` finds. It returns null if the provider has none of that name, and nothing if the library that would
    /// have it is not loaded yet.
    pub const fn new(loader: fn(&CStr) -> Option<Ptr>) -> Self {
        Real {
            slots: [const { AtomicPtr::new(core::ptr::null_mut()) }; COUNT],
            loader,
        }
    }

    /// The function in a slot of the table, if the provider has it.
    #[inline]
    pub fn get(&self, slot: usize) -> Option<Ptr> {
        let p = self.slots[slot].load(Relaxed);
        if !p.is_null() && p != MISSING {
            Some(p)
        } else {
            self.find(slot)
        }
    }

    #[cold]
    fn find(&self, slot: usize) -> Option<Ptr> {
        if self.slots[slot].load(Relaxed) == MISSING {
            return None;
        }
        let p = (self.loader)(NAMES[slot])?;
        self.slots[slot].store(if p.is_null() { MISSING } else { p }, Relaxed);
        (!p.is_null()).then_some(p)
    }
}

/// Makes a call of which the shadow is not told.
macro_rules! unnoted {
    ($real:expr, $slot:expr, $($a:ident: $t:ty),*) => {
        if let Some(p) = $real.get($slot) {
            core::mem::transmute::<Ptr, unsafe extern "C-unwind" fn($($t),*)>(p)($($a),*);
        }
    };
}

macro_rules! real_functions {
    ($($name:ident($($a:ident: $t:ty),*) $(-> $r:ty = $zero:expr)? $(, $how:ident $note:ident($($n:ident),*))?;)*) => {
        /// The driver's own functions. A command that the provider lacks does nothing and answers zero.
        impl Real {
            $(
                /// # Safety
                /// What the command of that name asks of its arguments and of the current context.
                #[inline]
                #[allow(
                    non_snake_case,
                    clippy::too_many_arguments,
                    reason = "the API's own name and signature"
                )]
                pub unsafe fn $name(&self, $($a: $t),*) $(-> $r)? {
                    let Some(p) = self.get(slot::$name) else { return $($zero)? };
                    // SAFETY: the provider's symbol of this name has this signature (Khronos registry).
                    let answer = unsafe { core::mem::transmute::<Ptr, unsafe extern "C-unwind" fn($($t),*) $(-> $r)?>(p)($($a),*) };
                    // SAFETY: the arguments of the command.
                    $(super::shadow::$how(|s| unsafe { s.$note($($n),*) });)?
                    answer
                }
            )*
        }

        #[cfg(any(test, feature = "fake-driver"))]
        record_functions! { $($name($($a: $t),*) $(-> $r = $zero)?;)* }
    };
}
