//! Render targets: the atlas of framebuffer 0, the program's own framebuffers with one image per view, and the pass that shows them.

use super::fit::{Fitted, fit_first};
use super::session::Session;
use super::support::Support;
use super::{LayerError, accumulate, framebuffer};
use crate::atlas::{Atlas, Names, OsdImage, PanelImage};
use crate::config::{Config, ViewScale};
use crate::display::Kind;
use crate::gl::shadow::are_textures_taken;
use crate::gl::{FramebufferName, Gl, TextureName};
use crate::interleave::Interleaver;
use crate::offscreen::Offscreen;
use crate::plan::decide::Detail;
use crate::report::Report;
use crate::state::State;

/// The images of a context that differ between the views.
#[derive(Debug)]
pub(super) struct Targets {
    pub(super) atlas: Atlas,
    pub(super) names: Names,
    pub(super) offscreen: Offscreen,
    pub(super) accumulated: accumulate::Accumulated,
    /// The picture for the panel's own window, once one was drawn.
    pub(super) panel: Option<PanelImage>,
    /// The on-screen display, once it was shown.
    pub(super) osd: Option<OsdImage>,
    pub(super) interleaver: Interleaver,
    pub(super) detail: Detail,
    /// The driver has made no other atlas, so this one stays.
    pub(super) stuck: bool,
    /// A picture waits for views that were not drawn.
    pub(super) undrawn: bool,
    /// The buffers of framebuffer 0 that glPushAttrib has saved.
    pub(super) pushed: Vec<framebuffer::Pushed>,
}

/// The pass that shows the views, and the names that the layer's textures get.
pub(super) fn interleaving(gl: &Gl, config: &Config, support: &Support) -> (Names, Interleaver) {
    let mut names = Names::default();
    if are_textures_taken() {
        names.hide();
    }
    let interleaver = {
        let wall = matches!(config.display.kind, Kind::Wall(_));
        Interleaver::new(gl, &mut names, support.glsl, wall, config.synthesis())
    };
    (names, interleaver)
}

impl Targets {
    /// Makes the targets for a window of the state's size, with what [`interleaving`] has made. The report says what is missing. The sentence tells the user why
    /// the atlas is not the wanted one. Fails on OpenGL ES where there is no pass.
    pub(super) fn new(
        gl: &Gl,
        (mut names, interleaver): (Names, Interleaver),
        session: &Session,
        state: &State,
        report: &mut Report,
    ) -> Result<(Self, Option<String>), LayerError> {
        let (config, support) = (session.config, &session.support);
        match interleaver.note() {
            Some(note) if gl.is_es() => return Err(LayerError::Passes(note)),
            Some(note) => report.note(note),
            None => {}
        }
        if config.view_scale != ViewScale::Fixed(1.0) {
            let cause = match (gl.is_es(), support.viewports) {
                (true, _) => Some("the program has shaders of its own"),
                (false, false) => Some("the driver has no GL_ARB_viewport_array"),
                (false, true) => None,
            };
            let note =
                |cause| format!("views are drawn at the size of the window, because {cause}");
            cause.map(note).into_iter().for_each(|n| report.note(n));
        }
        let on_gpu = interleaver.on_gpu();
        let (detail, fitted) = fit_first(gl, &mut names, session, &state.window, on_gpu);
        let Fitted { atlas, told } = fitted;
        let images = session.group.shared_images();
        let targets = Targets {
            atlas,
            names,
            offscreen: Offscreen::new(gl, config.views, support.compatibility, images),
            accumulated: accumulate::Accumulated::default(),
            panel: None,
            osd: None,
            interleaver,
            detail,
            stuck: told.is_some(),
            undrawn: false,
            pushed: Vec::new(),
        };
        Ok((targets, told))
    }

    /// Whether a texture is one of these.
    pub(super) fn owns_texture(&self, name: TextureName) -> bool {
        let accumulation = self.accumulated.buffer.as_ref();
        self.atlas.owns(name)
            || self.interleaver.textures().any(|own| own == name)
            || self
                .panel
                .as_ref()
                .is_some_and(|panel| panel.texture() == name)
            || self.osd.as_ref().is_some_and(|osd| osd.texture() == name)
            || self.offscreen.owns_texture(name)
            || accumulation.is_some_and(|buffer| buffer.owns(name))
    }

    /// Whether a framebuffer object is one of these.
    pub(super) fn owns_framebuffer(&self, name: FramebufferName) -> bool {
        let accumulation = self.accumulated.buffer.as_ref();
        self.atlas.framebuffers().any(|own| own == name)
            || self.offscreen.owns_framebuffer(name)
            || self
                .panel
                .as_ref()
                .is_some_and(|panel| panel.framebuffer() == name)
            || self
                .osd
                .as_ref()
                .is_some_and(|osd| osd.framebuffer() == name)
            || accumulation.is_some_and(|buffer| buffer.framebuffer() == name)
    }

    /// Whether framebuffer 0 has its back buffer and depths alone: no front buffer, and no accumulation buffer.
    pub(super) fn back_alone(&self) -> bool {
        !self.atlas.has_front() && self.accumulated.buffer.is_none()
    }
}
