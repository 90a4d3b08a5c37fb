//! Splits received bytes into whole lines, with a limit on the bytes that are kept.
#![forbid(unsafe_code)]

use super::ControlError;

/// The bytes received on a connection that are not yet a line.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    bytes: Vec<u8>,
}

impl Lines {
    /// The most bytes of a line.
    pub const MAX: usize = 4096;

    /// How many bytes may be added now.
    #[must_use]
    pub fn room(&self) -> usize {
        (Self::MAX + 1).saturating_sub(self.bytes.len())
    }

    /// Adds received bytes.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend_from_slice(bytes);
    }

    /// The next whole line. A line that is too long is a permanent error, since the beginning of the next one is not known.
    pub fn take(&mut self) -> Option<Result<String, ControlError>> {
        match self.bytes.iter().position(|&byte| byte == b'\n') {
            Some(end) => {
                let line = self.bytes.drain(..=end).take(end).collect::<Vec<_>>();
                // A line that is not UTF-8 is no valid request and is refused later.
                Some(Ok(String::from_utf8_lossy(&line).into_owned()))
            }
            None if self.bytes.len() > Self::MAX => Some(Err(ControlError::TooLong)),
            None => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_whole_however_they_are_cut() {
        let mut lines = Lines::default();
        let mut got = Vec::new();
        for part in ["ab", "c\nde", "", "f\n\ng"] {
            lines.push(part.as_bytes());
            while let Some(line) = lines.take() {
                got.push(line.unwrap());
            }
        }
        assert_eq!(got, ["abc", "def", ""]);
        assert_eq!(lines.room(), Lines::MAX);
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let mut lines = Lines::default();
        lines.push(&vec![b'x'; Lines::MAX]);
        assert_eq!(lines.take(), None);
        assert_eq!(lines.room(), 1);
        lines.push(b"\n");
        assert_eq!(lines.take().unwrap().unwrap().len(), Lines::MAX);
        lines.push(&vec![b'x'; Lines::MAX + 1]);
        assert_eq!(lines.take(), Some(Err(ControlError::TooLong)));
        assert_eq!(lines.room(), 0);
    }
}
