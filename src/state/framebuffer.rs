//! Framebuffer 0 as the program sees it.

use super::eyes::are_eyes_given;
use crate::gl::{FramebufferName, Gl, consts as c};

/// Which buffers a drawable has, and their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Buffers {
    /// The context is of OpenGL ES, where the only buffer is called GL_BACK. A copy of [`Gl::is_es`], because the program's state answers
    /// without a driver.
    pub es: bool,
    /// There is a back buffer.
    pub double_buffered: bool,
    /// There is a left and a right buffer.
    pub stereo: bool,
    /// The program has a left and a right buffer of the layer's (see [`super::give_eyes`]).
    pub eyes: bool,
    /// Whether GL_BACK names a buffer. Where there is only a front buffer, Mesa allows the name for that.
    pub names_back: bool,
    /// The buffer that a new context draws to. GL_BACK for some drawables without a back buffer too (EGL pbuffers).
    pub default_draw: u32,
    /// The buffer that a new context reads from.
    pub default_read: u32,
}

/// The drawable behind framebuffer 0, as the driver describes the true one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Its buffers.
    pub buffers: Buffers,
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Bits of red, green, blue, alpha, depth, stencil.
    pub bits: [u32; 6],
    /// Samples per pixel, 0 for none.
    pub samples: u32,
    /// Can convert to sRGB when GL_FRAMEBUFFER_SRGB is enabled.
    pub srgb_capable: bool,
    /// The program has asked for that conversion.
    pub srgb: bool,
    /// Colours are floating point.
    pub float: bool,
    /// Bits of red, green, blue, alpha of the accumulation buffer, 0 for none.
    pub accumulation: [u32; 4],
}

const BITS: [u32; 6] = [
    c::RED_BITS,
    c::GREEN_BITS,
    c::BLUE_BITS,
    c::ALPHA_BITS,
    c::DEPTH_BITS,
    c::STENCIL_BITS,
];

/// Whether a draw buffer of a window is its front buffer, alone or with others.
pub(crate) fn is_front(buffer: u32) -> bool {
    [c::FRONT, c::FRONT_LEFT, c::LEFT, c::FRONT_AND_BACK].contains(&buffer)
}

/// The sizes that [`BITS`] names. A core profile has these of its attachments alone (OpenGL 3.2, E.2.2); Mesa's tells both.
fn attached_bits(gl: &Gl, color: u32) -> [u32; 6] {
    let size = |(attachment, name)| match gl
        .attachment_parameter(attachment, c::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE)
        as u32
    {
        // It would be an error to ask for more.
        c::NONE => 0,
        _ => gl.attachment_parameter(attachment, name).max(0) as u32,
    };
    let channel = |i| size((color, c::FRAMEBUFFER_ATTACHMENT_RED_SIZE + i));
    let [red, green, blue, alpha] = [0, 1, 2, 3].map(channel);
    let depth = size((c::DEPTH, c::FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE));
    let stencil = size((c::STENCIL, c::FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE));
    [red, green, blue, alpha, depth, stencil]
}

impl Window {
    /// Whether front and back buffer are two images. In a multisampled window they count as one, because the driver chooses which of
    /// them is resolved, and when.
    pub fn has_two_images(&self) -> bool {
        self.buffers.double_buffered && self.samples == 0 && !self.buffers.es
    }

    /// Chooses the buffer that a new context would read from, and with `draw` the one that it would draw to. The driver tells those of the
    /// first drawable of a context alone.
    pub fn choose_buffers(&mut self, draw: bool) {
        let buffers = &mut self.buffers;
        let chosen = match buffers.double_buffered || buffers.names_back {
            true => c::BACK,
            false => c::FRONT,
        };
        buffers.default_read = chosen;
        if draw {
            buffers.default_draw = chosen;
        }
    }

    /// Whether it has an accumulation buffer.
    pub fn accumulates(&self) -> bool {
        self.accumulation[0] > 0
    }

    /// Queries the driver for the true framebuffer 0, which must be bound for drawing. `width` and `height` are in pixels.
    pub fn ask(gl: &Gl, width: u32, height: u32, compatibility: bool) -> Window {
        let bit = |name| gl.get_integer(name).max(0) as u32;
        let es = gl.is_es();
        let double_buffered = es || gl.get_integer(c::DOUBLEBUFFER) != 0;
        let color = match (es, double_buffered) {
            (true, _) => c::BACK,
            (_, true) => c::BACK_LEFT,
            (_, false) => c::FRONT_LEFT,
        };
        let default_read = match es {
            true => c::BACK,
            false => gl.get_integer(c::READ_BUFFER) as u32,
        };
        let names_back = double_buffered || {
            // The context is new, so the error is not the program's.
            gl.read_buffer(c::BACK);
            let refused = gl.get_error() != c::NO_ERROR;
            gl.read_buffer(default_read);
            !refused
        };
        let modern = gl.version() >= (3, 0);
        let srgb_capable = modern
            && gl.attachment_parameter(color, c::FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) as u32
                == c::SRGB;
        let samples = bit(c::SAMPLES);
        let stereo = !es && gl.get_integer(c::STEREO) != 0;
        Window {
            buffers: Buffers {
                es,
                double_buffered,
                stereo,
                eyes: are_eyes_given() && !stereo && double_buffered && !es && samples == 0,
                names_back,
                default_draw: match es {
                    true => c::BACK,
                    false => gl.get_integer(c::DRAW_BUFFER) as u32,
                },
                default_read,
            },
            width,
            height,
            accumulation: match compatibility {
                true => [0, 1, 2, 3].map(|i| bit(c::ACCUM_RED_BITS + i)),
                false => [0; 4],
            },
            bits: match compatibility || es || !modern {
                true => BITS.map(bit),
                false => attached_bits(gl, color),
            },
            samples,
            srgb_capable,
            srgb: srgb_capable && gl.is_srgb_enabled(),
            float: modern
                && gl.attachment_parameter(color, c::FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) as u32
                    == c::FLOAT,
        }
    }
}

/// The attachment of the atlas that is the back buffer, or the only one.
pub const BACK: u32 = c::COLOR_ATTACHMENT0;
/// The attachment that is the front buffer, where that is another image; the right buffer where the program has one of the layer's.
pub const FRONT: u32 = c::COLOR_ATTACHMENT1;

/// Which framebuffers are bound and which buffers of framebuffer 0 are drawn to and read from, in the program's words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Framebuffers {
    /// GL_DRAW_FRAMEBUFFER_BINDING.
    pub draw: FramebufferName,
    /// GL_READ_FRAMEBUFFER_BINDING.
    pub read: FramebufferName,
    /// glDrawBuffers of framebuffer 0.
    pub draw_buffers: Vec<u32>,
    /// glReadBuffer of framebuffer 0.
    pub read_buffer: u32,
    buffers: Buffers,
    two: bool,
    /// Swaps for which the program counts as one that draws both eyes.
    eyes: u32,
}

/// A program that has drawn nothing for the right eye for so many swaps has left its stereo mode.
const EYES_IDLE: u32 = 60;

impl Framebuffers {
    /// The bindings and buffers of a new context.
    pub fn new(window: &Window) -> Self {
        Framebuffers {
            draw: FramebufferName::ZERO,
            read: FramebufferName::ZERO,
            draw_buffers: vec![window.buffers.default_draw],
            read_buffer: window.buffers.default_read,
            buffers: window.buffers,
            two: window.has_two_images(),
            eyes: 0,
        }
    }

    /// Framebuffer 0 is another window now. The names of buffers stay: they are the context's.
    pub fn belong_to(&mut self, window: &Window) {
        self.buffers = window.buffers;
        self.two = window.has_two_images();
    }

    /// The images behind a buffer name of framebuffer 0, as attachments of the atlas. `None` for a name that framebuffer 0 of this
    /// window does not have; the driver then has to decide.
    pub fn images(&self, buffer: u32) -> Option<&'static [u32]> {
        const BOTH: [u32; 2] = [FRONT, BACK];
        const EYES: [u32; 2] = [BACK, FRONT];
        let right = [c::BACK_RIGHT, c::FRONT_RIGHT, c::RIGHT].contains(&buffer);
        if self.has_eyes() || self.buffers.eyes && right {
            return match buffer {
                c::NONE => Some(&[]),
                c::BACK_LEFT | c::FRONT_LEFT | c::LEFT => Some(&EYES[..1]),
                c::BACK_RIGHT | c::FRONT_RIGHT | c::RIGHT => Some(&EYES[1..]),
                c::BACK | c::FRONT | c::FRONT_AND_BACK => Some(&EYES),
                _ => None,
            };
        }
        let (front, both) = match self.two {
            true => (&BOTH[..1], &BOTH[..]),
            false => (&BOTH[1..], &BOTH[1..]),
        };
        match buffer {
            c::NONE => Some(&[]),
            c::BACK if self.buffers.es => Some(&BOTH[1..]),
            _ if self.buffers.es => None,
            c::FRONT | c::FRONT_LEFT => Some(front),
            c::LEFT | c::FRONT_AND_BACK => Some(both),
            c::BACK | c::BACK_LEFT if self.buffers.names_back => Some(&BOTH[1..]),
            _ => None,
        }
    }

    /// Whether glDrawBuffers takes exactly one name for framebuffer 0.
    pub fn names_one(&self) -> bool {
        self.buffers.es
    }

    /// The images that are drawn to, as glDrawBuffers takes them.
    pub fn draw_images(&self) -> Vec<u32> {
        let images = |&b: &u32| match self.images(b) {
            Some([]) => &[c::NONE],
            Some(images) => images,
            None => &[BACK],
        };
        self.draw_buffers.iter().flat_map(images).copied().collect()
    }

    /// The image that is read from, or GL_NONE.
    pub fn read_image(&self) -> u32 {
        let images = self.images(self.read_buffer);
        images.map_or(BACK, |i| i.first().copied().unwrap_or(c::NONE))
    }

    /// Whether the program draws a picture for each eye, to buffers of the layer's. One that has asked for them and does not use them is drawn as any other.
    pub fn has_eyes(&self) -> bool {
        self.buffers.eyes && self.eyes > 0
    }

    /// The program has named these buffers to draw to.
    pub fn draw_to(&mut self, buffers: &[u32]) {
        let right = [c::BACK_RIGHT, c::FRONT_RIGHT, c::RIGHT];
        if buffers.iter().any(|buffer| right.contains(buffer)) {
            self.eyes = EYES_IDLE;
        }
        self.draw_buffers = buffers.to_vec();
    }

    /// Whether something was drawn for the right eye since the last frame was shown.
    pub fn drew_right(&self) -> bool {
        self.eyes == EYES_IDLE
    }

    /// A frame was shown.
    pub fn swapped(&mut self) {
        self.eyes = self.eyes.saturating_sub(1);
    }

    /// Whether the front buffer is drawn to or read from, and is another image than the back buffer.
    pub fn uses_front(&self) -> bool {
        self.read_image() == FRONT || self.draw_images().contains(&FRONT)
    }

    /// Whether the program draws to the front buffer, so that a flush must show it.
    pub fn draws_front(&self) -> bool {
        // What is drawn to the front of such a window is shown at the swap.
        !self.has_eyes() && self.draw_buffers.iter().any(|&b| is_front(b))
    }

    /// Reads the draw buffer again: glPopAttrib may have restored another one of the atlas.
    pub(super) fn reread(&mut self, gl: &Gl) {
        if !self.draw.is_zero() {
            return;
        }
        let none = gl.get_integer(c::DRAW_BUFFER0) as u32 == c::NONE;
        let was_none = self.draw_buffers.first().is_none_or(|&b| b == c::NONE);
        if none != was_none {
            self.draw_buffers = vec![if none {
                c::NONE
            } else {
                self.buffers.default_draw
            }];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::fake::Fake;

    /// A core profile has no other command for the sizes, and Mesa alone answers the others there.
    #[test]
    fn a_core_profile_tells_the_bits_of_its_attachments() {
        for (compatibility, asked) in [(true, 0), (false, 6)] {
            let fake = Fake::new();
            let window = Window::ask(&fake.gl(), 64, 48, compatibility);
            assert_eq!(window.bits, [8, 8, 8, 8, 24, 8]);
            let integers = fake.lines("glGetIntegerv");
            let names = BITS.map(|name| format!("({name},"));
            let of = |lines: &[String]| {
                let bits = lines
                    .iter()
                    .filter(|l| names.iter().any(|n| l.contains(n.as_str())));
                bits.count()
            };
            assert_eq!(of(&integers), 6 - asked, "{integers:?}");
        }
    }
}
