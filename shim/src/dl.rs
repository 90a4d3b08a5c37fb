//! dlsym, for programs that load GL at run time (SDL, GLFW, Qt). dlopen is left alone: a wrapper around it would change where the
//! dynamic linker searches (VirtualGL issue 266).

use crate::deep;
use crate::exports::export;
use crate::provider;
use crate::switch;
use core::ffi::{CStr, c_char, c_void};
use manyview_core::gl::Ptr;

/// Chooses the function that answers a dlsym call: the one behind ours, [`answer`] or [`nothing`]. This runs at any time in any thread,
/// for every name, and so early that memory may not be available: nothing is allocated before a library of GL is loaded. The first call
/// after that reads the options.
unsafe extern "C" fn choose(handle: *mut c_void, name: *const c_char) -> *const c_void {
    let next = provider::next_dlsym().map_or(core::ptr::null(), |f| f as *const c_void);
    if name.is_null() || next.is_null() {
        return next;
    }
    let behind = handle == libc::RTLD_NEXT;
    if !behind {
        deep::rebind_new_libraries();
    }
    // SAFETY: dlsym's contract: a string that ends in NUL.
    let text = unsafe { CStr::from_ptr(name) };
    let name = text.to_bytes();
    let ours = matches!(
        name,
        [b'g', b'l', ..] | [b'e', b'g', b'l', ..] | [b'O', b'S', b'M', ..]
    ) && export(name).is_some();
    match (ours, behind) {
        (true, false) => answer as *const c_void,
        // The program is first in load order, so for it RTLD_NEXT finds us. eglretrace asks in this way whether it has GLX.
        (true, true) if only_ours(text) => nothing as *const c_void,
        _ => next,
    }
}

/// Whether only this library has a name.
fn only_ours(name: &CStr) -> bool {
    // The check that opens libraries comes last, because other wrappers ask for names when they are opened.
    provider::own(provider::symbol(libc::RTLD_DEFAULT, name))
        && provider::symbol(libc::RTLD_NEXT, name).is_null()
        && !provider::has(name.to_bytes())
}

/// Answers dlsym for a name that only this library has: not found.
unsafe extern "C" fn nothing(_: *mut c_void, _: *const c_char) -> *mut c_void {
    core::ptr::null_mut()
}

/// Answers dlsym for a name that we export.
unsafe extern "C" fn answer(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    // SAFETY: `choose` has looked at the name.
    let name = unsafe { CStr::from_ptr(name) };
    let mut real = provider::symbol(handle, name);
    let Some((slot, ours)) = export(name.to_bytes()) else {
        return real;
    };
    let first = provider::own(real);
    if first {
        // The name was found only because we are preloaded. A program without GL, or without EGL beside GLX, must not conclude that it
        // has it. Without us it would get the next symbol; but a plugin also asks in the scope of its own libraries, which only the linker
        // knows.
        real = provider::symbol(libc::RTLD_NEXT, name);
        if real.is_null() && provider::has(name.to_bytes()) {
            return ours;
        }
    }
    if real.is_null() {
        return real;
    }
    // Where ours is the first, the next may be a hook of another preloaded library.
    let known = match provider::provider_of(real) {
        None => first && !provider::is_named_as_gl(real),
        Some(_) => true,
    };
    if known && switch::hooked(slot) {
        ours
    } else {
        real
    }
}

/// The exported dlsym. It makes a tail jump, with the program's return address in place, because glibc resolves RTLD_NEXT,
/// RTLD_DEFAULT and $ORIGIN by the address of the caller.
#[cfg(target_arch = "x86_64")]
#[unsafe(naked)]
#[unsafe(no_mangle)]
unsafe extern "C" fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    core::arch::naked_asm!(
        "push rdi",
        "push rsi",
        "sub rsp, 8",
        "call {choose}",
        "add rsp, 8",
        "pop rsi",
        "pop rdi",
        "jmp rax",
        choose = sym choose,
    )
}

/// The same for 32-bit x86, whose calling convention has the arguments on the stack.
#[cfg(target_arch = "x86")]
#[unsafe(naked)]
#[unsafe(no_mangle)]
unsafe extern "C" fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    core::arch::naked_asm!(
        "sub esp, 4",
        "push dword ptr [esp + 12]",
        "push dword ptr [esp + 12]",
        "call {choose}",
        "add esp, 12",
        "jmp eax",
        choose = sym choose,
    )
}

/// The exported dlsym for architectures without a tail jump yet. For RTLD_NEXT, glibc then takes us for the caller.
#[cfg(not(any(target_arch = "x86_64", target_arch = "x86")))]
#[unsafe(no_mangle)]
unsafe extern "C" fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    // SAFETY: the program's own arguments.
    let f = unsafe { choose(handle, name) };
    if f.is_null() {
        return core::ptr::null_mut();
    }
    // SAFETY: `choose` gives functions of this signature.
    unsafe {
        core::mem::transmute::<
            *const c_void,
            unsafe extern "C" fn(*mut c_void, *const c_char) -> *mut c_void,
        >(f)(handle, name)
    }
}

/// The address that a GetProcAddress function returns for a name; `real` is the address that the driver's own function returned.
///
/// # Safety
/// `name` is null or a string that ends in NUL.
pub(crate) unsafe fn proc_address(name: *const c_char, real: Ptr) -> Ptr {
    if name.is_null() || real.is_null() {
        return real;
    }
    // SAFETY: the caller's string.
    match export(unsafe { CStr::from_ptr(name) }.to_bytes()) {
        Some((slot, ours)) if switch::hooked(slot) => ours,
        _ => real,
    }
}
