//! Windows with a left and a right buffer: changes a program's list of GLX attributes so that it asks for one.

/// GLX_STEREO
const STEREO: i32 = 6;
/// GLX_DOUBLEBUFFER
const DOUBLEBUFFER: i32 = 5;
/// GLX_SAMPLE_BUFFERS and GLX_SAMPLES
const SAMPLE_BUFFERS: i32 = 100_000;
const SAMPLES: i32 = 100_001;

/// The format of a list of GLX attributes. Both formats end with a 0 in the place of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attributes {
    /// glXChooseVisual: a boolean attribute is a name alone, the others have a value.
    Visual,
    /// glXChooseFBConfig: each has a value.
    Config,
}

impl Attributes {
    fn has_value(self, name: i32) -> bool {
        // GLX_USE_GL, GLX_RGBA, GLX_DOUBLEBUFFER, GLX_STEREO
        self == Self::Config || ![1, 4, 5, STEREO].contains(&name)
    }

    /// The attributes of a list, each with its value if it has one. `list` is not read beyond its end.
    fn of(self, list: impl IntoIterator<Item = i32>) -> impl Iterator<Item = (i32, Option<i32>)> {
        let mut list = list.into_iter().fuse();
        std::iter::from_fn(move || {
            let name = list.next().filter(|&name| name != 0)?;
            let value = if self.has_value(name) {
                list.next()
            } else {
                None
            };
            Some((name, value))
        })
    }

    /// The program's list without the wish for a stereo window; `None` if it has none, or wants a window without a back buffer or with several samples, for which there are no eyes. `list` is
    /// not read beyond its end.
    pub fn without_stereo(self, list: impl IntoIterator<Item = i32>) -> Option<Vec<i32>> {
        let mut changed = Vec::new();
        let [mut asked, mut double, mut sampled] = [false; 3];
        for (name, value) in self.of(list) {
            // Of two values GLX takes the last.
            match name {
                STEREO => {
                    asked = is_on(value);
                    continue;
                }
                DOUBLEBUFFER => double = is_on(value),
                SAMPLE_BUFFERS | SAMPLES => sampled |= value.is_some_and(|value| value > 0),
                _ => {}
            }
            changed.push(name);
            changed.extend(value);
        }
        changed.push(0);
        (asked && double && !sampled).then_some(changed)
    }

    /// The program's list, changed to ask for a stereo window as well; `None` if the program asks for one itself. `list` is not read
    /// beyond its end.
    pub fn with_stereo(self, list: impl IntoIterator<Item = i32>) -> Option<Vec<i32>> {
        let mut changed = Vec::new();
        let mut asked = false;
        for (name, value) in self.of(list) {
            if name == STEREO {
                // Of two values GLX takes the last.
                asked = is_on(value);
                continue;
            }
            changed.push(name);
            changed.extend(value);
        }
        changed.push(STEREO);
        if self.has_value(STEREO) {
            changed.push(1);
        }
        changed.push(0);
        (!asked).then_some(changed)
    }
}

/// A boolean attribute is true: a name alone, or the value 1.
fn is_on(value: Option<i32>) -> bool {
    value.is_none_or(|value| value == 1)
}

#[cfg(test)]
mod tests {
    use super::Attributes::{Config, Visual};
    use super::*;

    const USE_GL: i32 = 1;
    const BUFFER_SIZE: i32 = 2;
    const LEVEL: i32 = 3;
    const RGBA: i32 = 4;
    const RED_SIZE: i32 = 8;
    const DEPTH_SIZE: i32 = 12;
    const DRAWABLE_TYPE: i32 = 0x8010;
    const DONT_CARE: i32 = -1;

    /// The changed list; panics if `list` is read beyond its end, where a program has other memory.
    fn changed(kind: Attributes, list: &[i32]) -> Option<Vec<i32>> {
        let beyond = std::iter::from_fn(|| panic!("read past its end"));
        kind.with_stereo(list.iter().copied().chain(beyond))
    }

    #[test]
    fn the_wish_for_a_stereo_window_is_left_out() {
        let asked = [RGBA, STEREO, DOUBLEBUFFER, RED_SIZE, 8, 0, 99];
        let left = vec![RGBA, DOUBLEBUFFER, RED_SIZE, 8, 0];
        assert_eq!(Visual.without_stereo(asked), Some(left));
        assert_eq!(Visual.without_stereo([RGBA, RED_SIZE, STEREO, 0]), None);
        let asked = [DOUBLEBUFFER, 1, STEREO, 1, 0];
        assert_eq!(Config.without_stereo(asked), Some(vec![DOUBLEBUFFER, 1, 0]));
        assert_eq!(Config.without_stereo([STEREO, 0, DOUBLEBUFFER, 1, 0]), None);
        let sampled = [DOUBLEBUFFER, 1, STEREO, 1, SAMPLE_BUFFERS, 1, SAMPLES, 4, 0];
        assert_eq!(Config.without_stereo(sampled), None);
        assert_eq!(Visual.without_stereo([RGBA, STEREO, 0]), None, "one buffer");
    }

    #[test]
    fn an_empty_list_asks_for_stereo_alone() {
        assert_eq!(changed(Visual, &[0]), Some(vec![STEREO, 0]));
        assert_eq!(changed(Config, &[0]), Some(vec![STEREO, 1, 0]));
        // The program may give glXChooseFBConfig no list at all.
        assert_eq!(Config.with_stereo([]), Some(vec![STEREO, 1, 0]));
    }

    #[test]
    fn what_a_program_asks_for_stays() {
        assert_eq!(
            changed(
                Visual,
                &[RGBA, DEPTH_SIZE, 16, DOUBLEBUFFER, RED_SIZE, 8, 0]
            ),
            Some(vec![
                RGBA,
                DEPTH_SIZE,
                16,
                DOUBLEBUFFER,
                RED_SIZE,
                8,
                STEREO,
                0
            ])
        );
        assert_eq!(
            changed(
                Config,
                &[DOUBLEBUFFER, 1, DRAWABLE_TYPE, 1, DEPTH_SIZE, 16, 0]
            ),
            Some(vec![
                DOUBLEBUFFER,
                1,
                DRAWABLE_TYPE,
                1,
                DEPTH_SIZE,
                16,
                STEREO,
                1,
                0
            ])
        );
    }

    #[test]
    fn a_value_is_neither_an_end_nor_a_name() {
        // GLX_LEVEL 0 is not the end, a depth or a size of 6 bits is not GLX_STEREO.
        for list in [
            vec![USE_GL, LEVEL, 0, DEPTH_SIZE, STEREO, RGBA, 0],
            vec![BUFFER_SIZE, STEREO, 0],
        ] {
            let mut expected = list.clone();
            expected.insert(list.len() - 1, STEREO);
            assert_eq!(changed(Visual, &list), Some(expected));
        }
        let list = [DOUBLEBUFFER, 0, DEPTH_SIZE, STEREO, 0];
        assert_eq!(
            changed(Config, &list),
            Some(vec![DOUBLEBUFFER, 0, DEPTH_SIZE, STEREO, STEREO, 1, 0])
        );
    }

    #[test]
    fn a_program_that_asks_itself_gets_its_own_list() {
        assert_eq!(changed(Visual, &[RGBA, STEREO, DEPTH_SIZE, 1, 0]), None);
        assert_eq!(changed(Visual, &[STEREO, 0]), None);
        assert_eq!(changed(Config, &[STEREO, 1, DEPTH_SIZE, 1, 0]), None);
        assert_eq!(changed(Config, &[STEREO, 0, STEREO, 1, 0]), None);
    }

    #[test]
    fn a_program_that_wants_none_or_either_gets_stereo() {
        for value in [0, DONT_CARE] {
            assert_eq!(
                changed(Config, &[STEREO, value, DEPTH_SIZE, 1, 0]),
                Some(vec![DEPTH_SIZE, 1, STEREO, 1, 0])
            );
        }
        assert_eq!(
            changed(Config, &[STEREO, 1, STEREO, DONT_CARE, 0]),
            Some(vec![STEREO, 1, 0])
        );
    }
}
