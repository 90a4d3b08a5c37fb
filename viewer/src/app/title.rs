//! The title of the window.

use crate::load::Loading;
use std::ffi::OsStr;
use std::time::{Duration, Instant};

/// It is made again so often.
const EVERY: Duration = Duration::from_millis(500);

/// What is in it, and when it was told.
pub(super) struct Title {
    name: String,
    told: Option<Instant>,
}

impl Title {
    pub(super) fn new(name: &OsStr) -> Self {
        Self {
            name: name.to_string_lossy().into_owned(),
            told: None,
        }
    }

    /// A new one, where it is time for that.
    pub(super) fn next(&mut self, loading: &Loading) -> Option<String> {
        let now = Instant::now();
        let is_due = self.told.is_none_or(|told| now - told > EVERY);
        is_due.then(|| {
            self.told = Some(now);
            self.text(loading)
        })
    }

    pub(super) fn text(&self, loading: &Loading) -> String {
        let count = loading.tree().map_or(0, |tree| tree.count());
        let mut text = format!("{} - {} points", self.name, grouped(count));
        let skipped = loading.progress.skipped();
        if skipped > 0 {
            text += &format!(", {} left out", grouped(skipped));
        }
        match loading.progress.share() {
            Some(share) if !loading.progress.is_done() => {
                text += &format!(", {:.0} % read", share * 100.0);
            }
            _ => {}
        }
        text
    }
}

/// A number with a mark before each three digits.
pub(super) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn numbers_are_grouped() {
        assert_eq!(
            [0, 999, 1000, 1_234_567].map(grouped),
            ["0", "999", "1,000", "1,234,567"]
        );
    }
}
