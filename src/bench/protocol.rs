//! The answers of a scene with `--bench`; examples/README.md describes it.

/// The driver that drew the frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Hello {
    /// GL_RENDERER
    pub renderer: String,
    /// GL_VERSION
    pub version: String,
}

impl Hello {
    /// The last line before the scene listens.
    pub const READY: &str = "ready";

    /// Takes one of the lines before [`Hello::READY`].
    pub fn hear(&mut self, line: &str) {
        match line.split_once(' ') {
            Some(("renderer", name)) => name.clone_into(&mut self.renderer),
            Some(("version", text)) => text.clone_into(&mut self.version),
            _ => {}
        }
    }
}

/// Times of consecutive frames, ns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Times {
    /// From before the drawing to after the swap and a glFinish.
    pub wall: Vec<u64>,
    /// Processor time of the drawing thread in between.
    pub cpu: Vec<u64>,
    /// Timer queries of a hardware driver; empty without.
    pub gpu: Vec<u64>,
}

impl Times {
    /// Reads an answer of so many frames.
    #[must_use]
    pub fn read(line: &str, frames: u32) -> Option<Self> {
        let mut times = Self::default();
        let mut list = None;
        for word in line.split_whitespace() {
            list = match (word, list) {
                ("wall", _) => Some(&mut times.wall),
                ("cpu", _) => Some(&mut times.cpu),
                ("gpu", _) => Some(&mut times.gpu),
                (number, Some(list)) => {
                    list.push(number.parse().ok()?);
                    Some(list)
                }
                (_, None) => return None,
            };
        }
        let frames = frames as usize;
        let whole = times.wall.len() == frames && times.cpu.len() == frames;
        (whole && (times.gpu.is_empty() || times.gpu.len() == frames)).then_some(times)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_lists_with_names() {
        let times = Times::read("wall 10 20 cpu 3 4", 2).unwrap();
        assert_eq!(
            (times.wall, times.cpu, times.gpu),
            (vec![10, 20], vec![3, 4], vec![])
        );
        let times = Times::read("wall 10 cpu 3 gpu 7", 1).unwrap();
        assert_eq!(times.gpu, [7]);
        for wrong in [
            "",
            "10 20",
            "wall 10 cpu",
            "wall 1 2 cpu 1 2",
            "wall x cpu 1",
            "wall 1 cpu 1 gpu 1 2",
        ] {
            assert_eq!(Times::read(wrong, 1), None, "{wrong}");
        }
    }

    #[test]
    fn the_driver_is_heard() {
        let mut hello = Hello::default();
        for line in ["renderer Some GPU (TM)", "version 4.5 Mesa", "more to come"] {
            hello.hear(line);
        }
        assert_eq!(
            (hello.renderer.as_str(), hello.version.as_str()),
            ("Some GPU (TM)", "4.5 Mesa")
        );
    }
}
