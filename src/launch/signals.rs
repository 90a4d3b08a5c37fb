//! The signals that ask the launcher to stop, and whether it has to pass them on.
#![forbid(unsafe_code)]

use super::error::LaunchError;
use rustix::process::getpgrp;
use rustix::termios::tcgetpgrp;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::fs::File;

/// Catches SIGINT, SIGTERM and SIGHUP from here on, except those that are already ignored (`nohup`).
///
/// In the programs that we start, a caught signal has its default action again, and an ignored one stays ignored.
pub(super) fn catch() -> Result<Signals, LaunchError> {
    let ignored = ignored_mask();
    let wanted = [SIGINT, SIGTERM, SIGHUP]
        .into_iter()
        .filter(|signal| ignored & (1 << (signal - 1)) == 0);
    Signals::new(wanted).map_err(|source| LaunchError::System {
        doing: "catching signals",
        source,
    })
}

/// True if the terminal has sent `signal` to the program as well, which shares our process group.
pub(super) fn from_keyboard(signal: i32) -> bool {
    let foreground = || tcgetpgrp(File::open("/dev/tty").ok()?).ok();
    signal == SIGINT && foreground() == Some(getpgrp())
}

fn ignored_mask() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    line.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
        .unwrap_or(0)
}
