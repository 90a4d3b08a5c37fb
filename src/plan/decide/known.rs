//! The knowledge from earlier commands. Each decision reads it and leaves it updated.

use super::backdrop::Backdrop;
use super::foreground::Foreground;
use super::mono::Mono;
use super::orthographic::OrthographicWatch;
use super::scene::Scene;
use crate::config::Strategy;
use crate::gl::FramebufferName;
use crate::plan::Rig;
use crate::plan::reason::Hindrance;

/// The knowledge from the commands so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The cameras of the views.
    pub rig: Rig,
    /// The program draws passes whose depths have to be equal (GL_EQUAL), so all its draws are replayed.
    pub replays_all: bool,
    /// The projection of the last program that had a camera, for programs that have none.
    pub camera: Option<[f32; 16]>,
    /// A of the camera that the window is drawn with, which tells it from the camera of a light source.
    pub lens: Option<f64>,
    /// The frame so far.
    pub frame: Frame,
    /// The measurement of this frame's depths.
    pub depths: DepthWatch,
    /// The scene that is drawn to some views only, while the others are to be synthesised.
    pub scene: Option<Scene>,
    /// The views of this frame are synthesised already: further draws go to every view.
    pub synthesised: bool,
    /// The contents that all views have in common.
    pub mono: Mono,
}

/// The frame so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// The number of draws, without clears.
    pub draws: u32,
    /// The number of clears of the depths.
    pub clears: u32,
    /// The number of draws until the last of these clears.
    pub draws_before_clear: u32,
    /// Something in perspective has written depth since the frame began or was last cleared.
    pub wrote_depth: bool,
    /// Why no view is synthesised of a scene that would be drawn now to the window.
    pub hindrance: Hindrance,
    /// Whether nearer points have larger depths, by the first draw of the scene.
    pub nearer_is_larger: Option<bool>,
    /// What is drawn around the eye before the depths are cleared for the scene.
    pub backdrop: Backdrop,
    /// What is drawn before everything else.
    pub foreground: Foreground,
    /// The orthographic scene, in a program without perspective.
    pub orthographic: OrthographicWatch,
}

impl Frame {
    /// The number of draws since the depths were last cleared, or since the frame began.
    pub fn draws_since_clear(&self) -> u32 {
        self.draws - self.draws_before_clear
    }

    /// The knowledge that the frame after this one begins with.
    #[must_use]
    pub fn next(&self) -> Frame {
        Frame {
            backdrop: self.backdrop.next(),
            foreground: self.foreground.next(),
            orthographic: self.orthographic.next(),
            ..Frame::default()
        }
    }
}

/// Which depths of the frame are to be captured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DepthWatch {
    /// Something of the frame has been drawn.
    pub begun: bool,
    /// The scene has been drawn since the last capture.
    pub pending: bool,
    /// A flat draw has written depths since the scene.
    pub overwritten: bool,
    /// The framebuffer that the scene's depths are in: 0 for the window.
    pub framebuffer: FramebufferName,
    /// The part of it that the scene was drawn to: left, bottom, right, top in pixels. What lies beside it may have any depths, as under a
    /// status bar that is drawn once.
    pub area: [i32; 4],
    /// The last projection of the frame's scene, column-major.
    pub projection: Option<[f32; 16]>,
}

impl Known {
    /// Before the first command.
    pub fn new(rig: Rig) -> Self {
        Known {
            rig,
            replays_all: false,
            camera: None,
            lens: None,
            frame: Frame::default(),
            depths: DepthWatch::default(),
            scene: None,
            synthesised: false,
            mono: Mono::default(),
        }
    }
}

/// Settings by the user and limits of the driver: the same for all commands of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The strategy that the user asked for, or that `auto` has found.
    pub strategy: Strategy,
    /// The driver has instancing, clip distances and shaders in compatibility contexts.
    pub instanced: bool,
    /// It has geometry shaders, too.
    pub geometry: bool,
    /// Amplified draws have exactly the depths of replayed ones, so the two can be mixed even under GL_EQUAL.
    pub same_depths: bool,
    /// N.
    pub views: u32,
    /// The picture shows depths, so the direction in which they grow has to be known.
    pub shows_depth: bool,
    /// The cameras or the report use measured depths.
    pub measures_depths: bool,
    /// Views are synthesised where possible.
    pub synthesises: bool,
}
