//! dlsym, for programs that load GL at run time (SDL, GLFW, Qt). dlopen is left alone: a wrapper around it changes where the
//! dynamic linker looks (VirtualGL issue 266).

use crate::deep;
use crate::exports::export;
use crate::provider;
use crate::switch;
use core::ffi::{CStr, c_char, c_void};
use manyview_core::gl::Ptr;

/// Which function is to answer a dlsym call: the one behind ours, or [`answer`]. This runs at any time in any thread, for every name, and
/// so early that there may be no memory to be had: nothing is allocated before a library of GL is loaded. The first call after that reads
/// the options.
unsafe extern "C" fn choose(handle: *mut c_void, name: *const c_char) -> *const c_void {
    let next = provider::next_dlsym().map_or(core::ptr::null(), |f| f as *const c_void);
    if name.is_null() || next.is_null() {
        return next;
    }
    let behind = handle == libc::RTLD_NEXT;
    if !behind {
        deep::look();
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
        // Before everything else stands the program itself, to which we are the next: eglretrace asks so whether it has GLX.
        (true, true) if only_ours(text) => nothing as *const c_void,
        _ => next,
    }
}

/// Whether nobody has a name but this library.
fn only_ours(name: &CStr) -> bool {
    // What opens libraries comes last: other wrappers ask for names when they are opened.
    provider::own(provider::symbol(libc::RTLD_DEFAULT, name))
        && provider::symbol(libc::RTLD_NEXT, name).is_null()
        && !provider::has(name.to_bytes())
}

/// dlsym for a name that nobody else has.
unsafe extern "C" fn nothing(_: *mut c_void, _: *const c_char) -> *mut c_void {
    core::ptr::null_mut()
}

/// dlsym for a name that we export.
unsafe extern "C" fn answer(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    // SAFETY: `choose` has looked at the name.
    let name = unsafe { CStr::from_ptr(name) };
    let mut real = provider::symbol(handle, name);
    let Some((slot, ours)) = export(name.to_bytes()) else {
        return real;
    };
    if provider::own(real) {
        // Found because we are preloaded: the program must not think that it has GL, or EGL beside GLX, when it has none. What comes after
        // us is what it would get; but a plugin asks in the scope of its own libraries as well, which only the linker knows.
        real = provider::symbol(libc::RTLD_NEXT, name);
        if real.is_null() && provider::has(name.to_bytes()) {
            return ours;
        }
    }
    if real.is_null() {
        return real;
    }
    if provider::provider_of(real).is_some() && switch::hooked(slot) {
        ours
    } else {
        real
    }
}

/// The exported dlsym. It jumps on with the program's return address in place, because glibc looks up RTLD_NEXT,
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

/// The same for the calling convention of 32-bit programs, which has the arguments on the stack.
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

/// The exported dlsym where no tail jump is written yet: RTLD_NEXT is then ours to answer.
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

/// What a GetProcAddress function hands out for a name, given what the driver handed out.
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
