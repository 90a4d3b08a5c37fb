//! Holds off signals: those that a write may raise, while the layer writes to stderr or to files, and all while a layer is set up.

use core::ptr::null_mut;

/// The pipe has no reader; the terminal belongs to another group of processes; the file has reached the limit of the process.
const RAISED: [libc::c_int; 3] = [libc::SIGPIPE, libc::SIGTTOU, libc::SIGXFSZ];

/// While it lives, this thread gets none of these signals. Those that came meanwhile are taken away, unless they were pending before.
pub(crate) struct Quiet {
    /// The thread's own mask of signals.
    before: libc::sigset_t,
    /// Signals that were pending already, which are the program's.
    pending: [bool; RAISED.len()],
}

impl Quiet {
    pub(crate) fn new() -> Self {
        let mut before = set(&[]);
        // SAFETY: two sets of ours.
        unsafe { libc::pthread_sigmask(libc::SIG_BLOCK, &set(&RAISED), &mut before) };
        Quiet {
            before,
            pending: pending(),
        }
    }
}

impl Drop for Quiet {
    fn drop(&mut self) {
        let at_once = libc::timespec {
            tv_sec: 0,
            tv_nsec: 0,
        };
        let now = pending();
        for (i, signal) in RAISED.into_iter().enumerate() {
            if now[i] && !self.pending[i] {
                // SAFETY: a set and a time of ours.
                unsafe { libc::sigtimedwait(&set(&[signal]), null_mut(), &at_once) };
            }
        }
        // SAFETY: the mask from before.
        unsafe { libc::pthread_sigmask(libc::SIG_SETMASK, &self.before, null_mut()) };
    }
}

/// Runs `work` while this thread gets no signal, nor any thread that it starts meanwhile: handlers of the program know only its own threads.
pub(crate) fn held_off<R>(work: impl FnOnce() -> R) -> R {
    /// Gives the thread its own mask back, after a panic too.
    struct Before(libc::sigset_t);
    impl Drop for Before {
        fn drop(&mut self) {
            // SAFETY: the mask from before.
            unsafe { libc::pthread_sigmask(libc::SIG_SETMASK, &self.0, null_mut()) };
        }
    }
    let (mut all, mut before) = (set(&[]), Before(set(&[])));
    // SAFETY: sets of ours.
    unsafe {
        libc::sigfillset(&mut all);
        libc::pthread_sigmask(libc::SIG_SETMASK, &all, &mut before.0);
    }
    work()
}

fn set(signals: &[libc::c_int]) -> libc::sigset_t {
    // SAFETY: all-zero is a set; sigemptyset makes it an empty one.
    let mut set: libc::sigset_t = unsafe { core::mem::zeroed() };
    // SAFETY: a set of ours.
    unsafe { libc::sigemptyset(&mut set) };
    for &signal in signals {
        // SAFETY: a set of ours.
        unsafe { libc::sigaddset(&mut set, signal) };
    }
    set
}

fn pending() -> [bool; RAISED.len()] {
    let mut all = set(&[]);
    // SAFETY: a set of ours.
    unsafe { libc::sigpending(&mut all) };
    // SAFETY: a set of ours.
    RAISED.map(|signal| unsafe { libc::sigismember(&all, signal) } == 1)
}
