//! Lines of a shader with their indentation.

/// `#version` of vertex, geometry and fragment shaders: the compatibility profile has clip distances, `gl_InstanceID`, gradients and flat
/// inputs from here on.
pub(super) const VERSION: u32 = 150;
/// `#version` of tessellation shaders.
pub(super) const TESSELLATION_VERSION: u32 = 400;

/// A shader under construction.
#[derive(Default)]
pub(super) struct Text {
    out: String,
    depth: usize,
}

impl Text {
    /// One line at the current depth; an empty one carries no spaces.
    pub(super) fn line(&mut self, line: impl AsRef<str>) {
        let line = line.as_ref();
        if !line.is_empty() {
            for _ in 0..self.depth {
                self.out.push_str("    ");
            }
            self.out.push_str(line);
        }
        self.out.push('\n');
    }

    /// Several lines at the current depth.
    pub(super) fn lines(&mut self, lines: &[&str]) {
        for line in lines {
            self.line(line);
        }
    }

    /// A line that opens a block, `{` on the same line.
    pub(super) fn open(&mut self, head: impl AsRef<str>) {
        self.line(head);
        self.depth += 1;
    }

    /// The line that closes the block opened last.
    pub(super) fn close(&mut self, tail: impl AsRef<str>) {
        self.depth = self.depth.saturating_sub(1);
        self.line(tail);
    }

    /// The finished text.
    pub(super) fn finish(self) -> String {
        self.out
    }
}
