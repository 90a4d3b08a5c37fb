//! The program's debug callback. It hears of the program's own calls, once and on the program's own stack, and of no call of the layer's.
//!
//! The driver gets a callback of ours. Where the driver calls it inside a hook's own work, the message of the program's call waits until the
//! hook has ended that work: the program may leave its callback by an exception, by longjmp or with its thread, and none of our
//! frames may be in the way. That is still before the command returns, as GL_DEBUG_OUTPUT_SYNCHRONOUS asks for.

use crate::caller::{Caller, caller};
use core::cell::Cell;
use core::ffi::{c_char, c_void};
use core::ptr::{null, null_mut};
use core::sync::atomic::{AtomicPtr, Ordering::Relaxed};
use manyview_core::gl::Ptr;
use std::ffi::CString;
use std::sync::{Mutex, PoisonError};

/// GLDEBUGPROC: source, type, id, severity, length, text, the program's data.
type Callback = unsafe extern "C-unwind" fn(u32, u32, u32, u32, i32, *const c_char, *const c_void);

/// The callback of one context. It is never freed, because the driver may call at any time, also from a thread of its own.
pub(crate) struct Receiver {
    function: AtomicPtr<c_void>,
    data: AtomicPtr<c_void>,
    waiting: Mutex<Vec<Message>>,
}

struct Message {
    words: [u32; 4],
    text: CString,
}

thread_local! {
    /// The receiver with messages that wait on this thread.
    static WAITING: Cell<*const Receiver> = const { Cell::new(null()) };
    /// The message that the program has got last. It is freed with the next one, since the program need not return from its callback.
    static TOLD: Cell<*mut Message> = const { Cell::new(null_mut()) };
}

impl Receiver {
    pub(crate) fn new() -> &'static Receiver {
        Box::leak(Box::new(Receiver {
            function: AtomicPtr::new(null_mut()),
            data: AtomicPtr::new(null_mut()),
            waiting: Mutex::new(Vec::new()),
        }))
    }

    /// Sets the program's function and data. Returns those that the driver gets in their place.
    pub(crate) fn set(&'static self, function: Ptr, data: Ptr) -> (Ptr, Ptr) {
        self.data.store(data, Relaxed);
        self.function.store(function, Relaxed);
        match function.is_null() {
            true => (function, data),
            false => (
                heard as *const () as Ptr,
                (&raw const *self).cast_mut().cast(),
            ),
        }
    }

    /// The program's function and data, as glGetPointerv returns them.
    pub(crate) fn get(&self) -> (Ptr, Ptr) {
        (self.function.load(Relaxed), self.data.load(Relaxed))
    }

    fn keep(&self, message: Message) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.push(message);
        WAITING.set(self);
    }

    fn take(&self) -> Option<Message> {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        (!waiting.is_empty()).then(|| waiting.remove(0))
    }

    /// # Safety
    /// `text` is a string that ends in NUL.
    unsafe fn tell(
        &self,
        [source, kind, id, severity]: [u32; 4],
        length: i32,
        text: *const c_char,
    ) {
        let (function, data) = self.get();
        if function.is_null() {
            return;
        }
        // SAFETY: the program has given it to glDebugMessageCallback.
        let function = unsafe { core::mem::transmute::<Ptr, Callback>(function) };
        // SAFETY: as the driver would call it.
        unsafe { function(source, kind, id, severity, length, text, data) };
    }
}

/// What the driver calls.
unsafe extern "C-unwind" fn heard(
    source: u32,
    kind: u32,
    id: u32,
    severity: u32,
    length: i32,
    text: *const c_char,
    receiver: *const c_void,
) {
    // SAFETY: `Receiver::set` has given the driver this pointer, and receivers are never freed.
    let receiver = unsafe { &*receiver.cast::<Receiver>() };
    let words = [source, kind, id, severity];
    match caller() {
        // SAFETY: the driver's string.
        Caller::Program => unsafe { receiver.tell(words, length, text) },
        Caller::Hook { own_call: true } => {
            // SAFETY: the driver's string.
            let text = unsafe { core::ffi::CStr::from_ptr(text) }.to_owned();
            receiver.keep(Message { words, text });
        }
        Caller::Hook { own_call: false } => {}
    }
}

/// Forgets the messages that wait on this thread. A draw is made for one view after the other, and the last one is the program's own.
pub(crate) fn forget() {
    let receiver = WAITING.replace(null());
    if !receiver.is_null() {
        // SAFETY: receivers are never freed.
        while unsafe { &*receiver }.take().is_some() {}
    }
}

/// Tells the program the messages that wait. Called where no frame below holds anything that has to be put back.
#[inline]
pub(crate) fn deliver() {
    if !WAITING.get().is_null() {
        deliver_all();
    }
}

#[cold]
fn deliver_all() {
    let receiver = WAITING.replace(null());
    // SAFETY: receivers are never freed.
    let receiver = unsafe { &*receiver };
    while let Some(message) = receiver.take() {
        let length = message.text.as_bytes().len() as i32;
        let (words, text) = (message.words, message.text.as_ptr());
        let before = TOLD.replace(Box::into_raw(Box::new(message)));
        if !before.is_null() {
            // SAFETY: from `Box::into_raw` above.
            drop(unsafe { Box::from_raw(before) });
        }
        // SAFETY: the text of the message that TOLD keeps; moving the message has not moved its text.
        unsafe { receiver.tell(words, length, text) };
    }
}
