//! The keyboard of a Wayland compositor.
//!
//! A compositor sends keys to the client that has the focus, and to all its keyboards. So one more keyboard of the program's own connection gets what the program gets. Its events
//! go to a queue of ours; whoever reads the connection, the program or the driver at the swap, fills that. Nothing here waits.

use super::{Event, Fault};
use crate::loaded::{function, functions};
use core::ffi::{CStr, c_char, c_int};
use manyview_core::config::Modifiers;
use manyview_core::gl::Ptr;
use std::collections::HashSet;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Opcodes of requests (wayland.xml).
const GET_REGISTRY: u32 = 1;
const BIND: u32 = 0;
const GET_KEYBOARD: u32 = 1;
const RELEASE: u32 = 0;
/// The version of a keyboard from which on it can be released.
const RELEASES: u32 = 3;
/// The highest version of a seat whose events are all known here.
const SEAT: u32 = 5;
const HAS_KEYBOARD: u32 = 2;
/// XKB_KEYMAP_FORMAT_TEXT_V1, and that of the protocol, which is the same.
const TEXT: u32 = 1;
/// Bits of modifiers in the order that all keymaps have: Shift, Control, Alt (Mod1) and Super (Mod4).
const MODIFIERS: [u32; 4] = [1 << 0, 1 << 2, 1 << 3, 1 << 6];
/// Keycodes of xkb are those of the kernel and 8.
const OFFSET: u32 = 8;

type Construct = unsafe extern "C" fn(Ptr, u32, Ptr, ...) -> Ptr;
type ConstructVersioned = unsafe extern "C" fn(Ptr, u32, Ptr, u32, ...) -> Ptr;

functions!(Client, c"libwayland-client.so.0", {
    create_queue = c"wl_display_create_queue": unsafe extern "C" fn(Ptr) -> Ptr,
    wrap = c"wl_proxy_create_wrapper": unsafe extern "C" fn(Ptr) -> Ptr,
    unwrap = c"wl_proxy_wrapper_destroy": unsafe extern "C" fn(Ptr),
    set_queue = c"wl_proxy_set_queue": unsafe extern "C" fn(Ptr, Ptr),
    construct = c"wl_proxy_marshal_constructor": Construct,
    construct_versioned = c"wl_proxy_marshal_constructor_versioned": ConstructVersioned,
    marshal = c"wl_proxy_marshal": unsafe extern "C" fn(Ptr, u32, ...),
    version = c"wl_proxy_get_version": unsafe extern "C" fn(Ptr) -> u32,
    destroy = c"wl_proxy_destroy": unsafe extern "C" fn(Ptr),
    listen = c"wl_proxy_add_listener": unsafe extern "C" fn(Ptr, Ptr, Ptr) -> c_int,
    dispatch = c"wl_display_dispatch_queue_pending": unsafe extern "C" fn(Ptr, Ptr) -> c_int,
    flush = c"wl_display_flush": unsafe extern "C" fn(Ptr) -> c_int,
});

functions!(Xkb, c"libxkbcommon.so.0", {
    context = c"xkb_context_new": unsafe extern "C" fn(c_int) -> Ptr,
    forget = c"xkb_context_unref": unsafe extern "C" fn(Ptr),
    keymap = c"xkb_keymap_new_from_string": unsafe extern "C" fn(Ptr, Ptr, c_int, c_int) -> Ptr,
    release = c"xkb_keymap_unref": unsafe extern "C" fn(Ptr),
    symbols = c"xkb_keymap_key_get_syms_by_level": unsafe extern "C" fn(Ptr, u32, u32, u32, *mut *const u32) -> c_int,
});

/// An additional keyboard of the program's connection.
pub(super) struct Keyboard {
    /// As a number, because another thread may show the next frame.
    display: usize,
    queue: usize,
    /// Listeners have its address, so it stays where it is, and as long as the process: the program may close its connection at any time.
    seen: &'static Seen,
}

/// What listeners have seen. They run inside [`Keyboard::events`] alone, under the lock of the keys.
struct Seen {
    client: &'static Client,
    xkb: &'static Xkb,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    /// Addresses: of the seat that was bound.
    seat: usize,
    /// The keyboard of the seat, while it has one: it may be plugged in and out.
    keyboard: usize,
    /// Of the keymap, as xkb has it.
    keymap: usize,
    focused: bool,
    /// Keys that are down, to be let go when the focus is lost.
    down: HashSet<u32>,
    /// The modifiers that are held, as bits.
    held: u32,
    /// Keys, whether they were pressed, and the modifiers that were held.
    events: Vec<(u32, bool, u32)>,
}

/// The address of an interface.
fn interface(name: &CStr) -> Result<Ptr, Fault> {
    let found = function(c"libwayland-client.so.0", name);
    found.ok_or_else(|| "libwayland-client has no keyboards".into())
}

impl Keyboard {
    /// Asks for a keyboard. Its first events come later.
    ///
    /// # Safety
    /// A wl_display that the program uses.
    pub(super) unsafe fn open(display: Ptr) -> Result<Self, Fault> {
        let client = Client::get().ok_or("libwayland-client is not loaded")?;
        // SAFETY: a string. Programs with keys have loaded it, and so do the others now; it stays.
        unsafe { libc::dlopen(c"libxkbcommon.so.0".as_ptr(), libc::RTLD_LAZY) };
        let xkb = Xkb::get().ok_or("libxkbcommon, which knows keyboards, is not there")?;
        let registry_interface = interface(c"wl_registry_interface")?;
        let seen: &'static Seen = Box::leak(Box::new(Seen {
            client,
            xkb,
            state: Mutex::default(),
        }));
        let none: Ptr = core::ptr::null_mut();
        // SAFETY: requests with the arguments of the protocol; listeners and what they get live as long as the process.
        unsafe {
            let queue = (client.create_queue)(display);
            let wrapper = (client.wrap)(display);
            if queue.is_null() || wrapper.is_null() {
                return Err("the connection to the compositor takes no queue".into());
            }
            (client.set_queue)(wrapper, queue);
            let registry = (client.construct)(wrapper, GET_REGISTRY, registry_interface, none);
            (client.unwrap)(wrapper);
            if registry.is_null() {
                return Err("the connection to the compositor is broken".into());
            }
            let data = core::ptr::from_ref(seen).cast_mut().cast();
            (client.listen)(
                registry,
                core::ptr::from_ref(&REGISTRY).cast_mut().cast(),
                data,
            );
            (client.flush)(display);
            Ok(Keyboard {
                display: display as usize,
                queue: queue as usize,
                seen,
            })
        }
    }

    /// The keys that were let go since the last frame, and those that were pressed while the program had the focus.
    ///
    /// # Safety
    /// A wl_display that the program uses.
    pub(super) unsafe fn events(&mut self, display: Ptr) -> Vec<Event> {
        if display as usize != self.display {
            // The program has opened another connection, and may have closed this one.
            return Vec::new();
        }
        // SAFETY: the queue is of this display, which is open (contract). Listeners take the lock, which is free.
        unsafe {
            (self.seen.client.dispatch)(display, self.queue as Ptr);
            (self.seen.client.flush)(display);
        }
        let mut state = self.seen.lock();
        let events = std::mem::take(&mut state.events);
        let mut found = Vec::new();
        for (code, pressed, held) in events {
            if !pressed {
                found.push(Event::Released(code));
                continue;
            }
            let [shift, control, alt, logo] = MODIFIERS.map(|bit| held & bit != 0);
            found.push(Event::Pressed {
                code,
                keysym: self.seen.keysym(&state, code),
                modifiers: Modifiers {
                    control,
                    alt,
                    shift,
                    logo,
                },
                repeats: false,
            });
        }
        found
    }
}

impl State {
    /// The program has lost the keyboard. Nobody tells when keys that are down are let go.
    fn leave(&mut self) {
        (self.focused, self.held) = (false, 0);
        let released = self.down.drain().map(|code| (code, false, 0));
        self.events.extend(released);
    }
}

impl Seen {
    fn lock(&self) -> MutexGuard<'_, State> {
        let locked = self.state.lock();
        locked.unwrap_or_else(PoisonError::into_inner)
    }

    /// The keysym of a key without modifiers; 0 where there is none.
    fn keysym(&self, state: &State, code: u32) -> u32 {
        if state.keymap == 0 {
            return 0;
        }
        let mut symbols: *const u32 = core::ptr::null();
        // SAFETY: our keymap. The symbols belong to it, and are as many as it says.
        unsafe {
            let count =
                (self.xkb.symbols)(state.keymap as Ptr, code + OFFSET, 0, 0, &raw mut symbols);
            match count > 0 && !symbols.is_null() {
                true => *symbols,
                false => 0,
            }
        }
    }

    /// Reads the text of a keymap.
    fn read_keymap(&self, fd: c_int, size: usize) -> Ptr {
        let none = core::ptr::null_mut();
        // SAFETY: the compositor's file of this size, which is only read; xkb copies the text, which ends in NUL.
        unsafe {
            let text = libc::mmap(none, size, libc::PROT_READ, libc::MAP_PRIVATE, fd, 0);
            if text == libc::MAP_FAILED {
                return none;
            }
            let context = (self.xkb.context)(0);
            let keymap = match context.is_null() {
                true => none,
                false => (self.xkb.keymap)(context, text, TEXT as c_int, 0),
            };
            if !context.is_null() {
                // The keymap keeps what it needs of it.
                (self.xkb.forget)(context);
            }
            libc::munmap(text, size);
            keymap
        }
    }
}

/// What a listener was given as data.
///
/// # Safety
/// The `data` of one of our listeners.
unsafe fn seen(data: Ptr) -> &'static Seen {
    // SAFETY: forwarded; it is never freed.
    unsafe { &*data.cast::<Seen>() }
}

/// wl_registry_listener
#[repr(C)]
struct RegistryListener {
    global: unsafe extern "C" fn(Ptr, Ptr, u32, *const c_char, u32),
    global_remove: unsafe extern "C" fn(Ptr, Ptr, u32),
}

static REGISTRY: RegistryListener = RegistryListener {
    global: appeared,
    global_remove: ignored_number,
};

/// wl_seat_listener
#[repr(C)]
struct SeatListener {
    capabilities: unsafe extern "C" fn(Ptr, Ptr, u32),
    name: unsafe extern "C" fn(Ptr, Ptr, *const c_char),
}

static SEATS: SeatListener = SeatListener {
    capabilities: capable,
    name: ignored_name,
};

/// wl_keyboard_listener
#[repr(C)]
struct KeyboardListener {
    keymap: unsafe extern "C" fn(Ptr, Ptr, u32, c_int, u32),
    enter: unsafe extern "C" fn(Ptr, Ptr, u32, Ptr, *const Keys),
    leave: unsafe extern "C" fn(Ptr, Ptr, u32, Ptr),
    key: unsafe extern "C" fn(Ptr, Ptr, u32, u32, u32, u32),
    modifiers: unsafe extern "C" fn(Ptr, Ptr, u32, u32, u32, u32, u32),
    repeat_info: unsafe extern "C" fn(Ptr, Ptr, c_int, c_int),
}

static KEYBOARDS: KeyboardListener = KeyboardListener {
    keymap: mapped,
    enter: entered,
    leave: left,
    key: changed,
    modifiers: modified,
    repeat_info: ignored_rate,
};

/// wl_array
#[repr(C)]
struct Keys {
    size: usize,
    allocated: usize,
    data: *const u32,
}

unsafe extern "C" fn appeared(
    data: Ptr,
    registry: Ptr,
    name: u32,
    kind: *const c_char,
    version: u32,
) {
    // SAFETY: as libwayland calls a listener of ours; requests with the arguments of the protocol.
    unsafe {
        let seen = seen(data);
        let mut state = seen.lock();
        let ours = CStr::from_ptr(kind) == c"wl_seat" && state.seat == 0;
        let (true, Ok(seat)) = (ours, interface(c"wl_seat_interface")) else {
            return;
        };
        let version = version.min(SEAT);
        let none: Ptr = core::ptr::null_mut();
        let bind = seen.client.construct_versioned;
        let bound = bind(registry, BIND, seat, version, name, kind, version, none);
        state.seat = bound as usize;
        (seen.client.listen)(bound, core::ptr::from_ref(&SEATS).cast_mut().cast(), data);
    }
}

unsafe extern "C" fn capable(data: Ptr, seat: Ptr, capabilities: u32) {
    // SAFETY: as above.
    unsafe {
        let seen = seen(data);
        let mut state = seen.lock();
        let has = capabilities & HAS_KEYBOARD != 0;
        if !has && state.keyboard != 0 {
            let keyboard = std::mem::take(&mut state.keyboard) as Ptr;
            if (seen.client.version)(keyboard) >= RELEASES {
                (seen.client.marshal)(keyboard, RELEASE);
            }
            (seen.client.destroy)(keyboard);
            state.leave();
        }
        let new = has && state.keyboard == 0;
        let (true, Ok(kind)) = (new, interface(c"wl_keyboard_interface")) else {
            return;
        };
        let none: Ptr = core::ptr::null_mut();
        let keyboard = (seen.client.construct)(seat, GET_KEYBOARD, kind, none);
        state.keyboard = keyboard as usize;
        let listener = core::ptr::from_ref(&KEYBOARDS).cast_mut().cast();
        (seen.client.listen)(keyboard, listener, data);
    }
}

unsafe extern "C" fn mapped(data: Ptr, _: Ptr, format: u32, fd: c_int, size: u32) {
    // SAFETY: as above; the descriptor is ours, and closed once. The old keymap is used by nobody else.
    unsafe {
        let seen = seen(data);
        let mut state = seen.lock();
        if format == TEXT {
            let new = seen.read_keymap(fd, size as usize);
            let old = std::mem::replace(&mut state.keymap, new as usize);
            if old != 0 {
                (seen.xkb.release)(old as Ptr);
            }
        }
        libc::close(fd);
    }
}

unsafe extern "C" fn entered(data: Ptr, _: Ptr, _: u32, _: Ptr, keys: *const Keys) {
    // SAFETY: as above; an array of keys that are down.
    unsafe {
        let mut state = seen(data).lock();
        state.focused = true;
        state.down.clear();
        if let Some(keys) = keys.as_ref()
            && !keys.data.is_null()
        {
            let count = keys.size / size_of::<u32>();
            let down = core::slice::from_raw_parts(keys.data, count);
            state.down.extend(down);
        }
    }
}

unsafe extern "C" fn left(data: Ptr, _: Ptr, _: u32, _: Ptr) {
    // SAFETY: as above.
    unsafe { seen(data) }.lock().leave();
}

unsafe extern "C" fn changed(data: Ptr, _: Ptr, _: u32, _: u32, key: u32, pressed: u32) {
    // SAFETY: as above.
    let mut state = unsafe { seen(data) }.lock();
    if state.focused {
        let (held, pressed) = (state.held, pressed == 1);
        match pressed {
            true => state.down.insert(key),
            false => state.down.remove(&key),
        };
        state.events.push((key, pressed, held));
    }
}

unsafe extern "C" fn modified(data: Ptr, _: Ptr, _: u32, held: u32, once: u32, _: u32, _: u32) {
    // SAFETY: as above.
    unsafe { seen(data) }.lock().held = held | once;
}

unsafe extern "C" fn ignored_number(_: Ptr, _: Ptr, _: u32) {}
unsafe extern "C" fn ignored_name(_: Ptr, _: Ptr, _: *const c_char) {}
unsafe extern "C" fn ignored_rate(_: Ptr, _: Ptr, _: c_int, _: c_int) {}
