//! The macro that defines every exported function.

/// Defines one exported command. The symbol jumps through its slot of `ENTRY`. The slot starts with `first`, which replaces itself by the
/// driver's function or by `hook`, so that an inactive process pays one jump. Our own calls never take the address of an exported
/// name, because a program may define a variable of that name. Exceptions of the program (thrown by a callback that the driver calls)
/// and the cancellation of a thread unwind through all of them.
macro_rules! export {
    ($slot:literal, $name:ident, $first:ident, $hook:ident, $zeros:ident, ($($a:ident: $t:ty),*) -> $r:ty, $body:block) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C-unwind" fn $name($($a: $t),*) -> $r {
            // SAFETY: the slot always holds a function of this signature (`first`, `hook` or the driver's).
            // SAFETY: the program answers for its arguments.
            unsafe { core::mem::transmute::<*mut (), unsafe extern "C-unwind" fn($($t),*) -> $r>(ENTRY[$slot].load(Relaxed))($($a),*) }
        }
        unsafe extern "C-unwind" fn $first($($a: $t),*) -> $r {
            switch::resolve($slot, &ENTRY[$slot], HOOK[$slot].as_ref());
            // SAFETY: as above; the slot now holds something else than `first`.
            unsafe { core::mem::transmute::<*mut (), unsafe extern "C-unwind" fn($($t),*) -> $r>(ENTRY[$slot].load(Relaxed))($($a),*) }
        }
        unsafe extern "C-unwind" fn $hook($($a: $t),*) -> $r $body

        #[cfg(all(test, feature = "fake-driver"))]
        unsafe fn $zeros() {
            // SAFETY: zero is a value of every type of the API; the caller answers for the call.
            unsafe { $hook($(core::mem::zeroed::<$t>()),*) };
        }
    };
}
