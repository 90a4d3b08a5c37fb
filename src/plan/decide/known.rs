//! What is known of the scene from the commands before: it is decided with, and each decision leaves it anew.

use super::mono::Mono;
use super::scene::Scene;
use crate::config::Strategy;
use crate::plan::Rig;

/// The scene so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The cameras of the views.
    pub rig: Rig,
    /// The program has passes that have to meet in every pixel, and replayed draws would not meet the others.
    pub together: bool,
    /// The projection of the last program that had a camera, for those that have none.
    pub camera: Option<[f32; 16]>,
    /// A of the camera that the window is drawn with, for telling it from a lamp's.
    pub lens: Option<f64>,
    /// Of this frame.
    pub frame: Frame,
    /// The depths of this frame.
    pub depths: DepthWatch,
    /// What is drawn to some views only, while others are to be synthesised.
    pub scene: Option<Scene>,
    /// The views of this frame are synthesised: what follows is drawn in each.
    pub synthesised: bool,
    /// What the views have in common.
    pub mono: Mono,
}

/// What has happened in the frame so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Draws, without clears.
    pub draws: u32,
    /// Something in perspective has written depth since the frame began or was last cleared.
    pub deep: bool,
    /// Nearer things have larger depths, by the first draw of the scene.
    pub nearer_is_larger: Option<bool>,
}

/// Which depths of the frame are worth a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DepthWatch {
    /// Something of the frame has been drawn.
    pub begun: bool,
    /// The scene has been drawn since the last picture was taken.
    pub pending: bool,
    /// Something flat has written depths since the scene.
    pub spoilt: bool,
    /// The last projection of the frame's scene, column-major.
    pub projection: Option<[f32; 16]>,
}

impl Known {
    /// Nothing has been drawn.
    pub fn new(rig: Rig) -> Self {
        Known {
            rig,
            together: false,
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

/// What the user and the driver have settled: the same for all commands of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// What the user asked for, or `auto` has come to.
    pub strategy: Strategy,
    /// Instancing, clip distances and compatibility shaders are there.
    pub instanced: bool,
    /// Geometry shaders too.
    pub geometry: bool,
    /// Amplified draws have the very depths of replayed ones: such are drawn together with GL_EQUAL.
    pub same_depths: bool,
    /// N.
    pub views: u32,
    /// The picture shows depths, and which of them are near has to be known.
    pub shows_depth: bool,
    /// The cameras or the report go by the depths.
    pub measures_depths: bool,
    /// Views are synthesised where that can be.
    pub synthesises: bool,
}
