//! One context under the layer, [`Layer`]: it puts the stages together. The hooks call nothing else.
#![forbid(unsafe_code)]

mod accumulate;
mod auto;
mod blits;
mod blocks;
mod camera_search;
mod cameras;
mod canvas;
mod capture;
mod clip_form;
mod comfort;
mod compute;
mod control;
mod copies;
mod cuts;
mod diagnostics;
mod dissolve;
mod draw;
mod executed;
mod explain;
mod eyes;
mod feedback;
mod fit;
mod follow;
mod frame;
mod framebuffer;
mod frames;
mod image_sums;
mod immediate;
mod lists;
mod mono;
mod neutral;
mod occlusion;
mod orphans;
mod orthographic;
mod osd;
mod own_variants;
mod panel;
mod passes;
mod points;
mod programs;
mod prove;
mod quad_buffer;
mod queries;
mod reading;
mod reads;
mod recordings;
mod rules;
mod sampling;
mod session;
mod share_group;
mod side_effects;
pub mod support;
mod surfaces;
mod synthesis;
mod targets;
#[cfg(test)]
mod tests;
mod tracked;
mod unprojections;
mod variants;

pub use blocks::BufferRef;
pub use canvas::CurrentDrawable;
pub use control::{Pictured, Wanted};
pub use draw::Primitives;
pub use feedback::FeedbackCommand;
pub use frames::Frames;
pub use lists::is_scaled;
use panel::Panel;
pub use panel::{PanelFrame, PanelPicture, Takes};
pub use queries::{Answer, ResultPlace};
pub use reading::DrawableId;
pub use tracked::Primitive;

use crate::atlas::{Atlas, Names};
use crate::config::{Config, Optimisation, program};
use crate::draw::{Driver, Programs};
use crate::gl::shadow::{are_textures_taken, is_own_texture};
use crate::gl::{BufferName, FramebufferName, Gl, TextureName, consts as c};
use crate::interleave::Interleaver;
use crate::plan::Rig;
use crate::plan::decide::Known;
use crate::report::{Proof, Report};
use crate::state::{BACK, State, Window};
use blocks::Blocks;
use cameras::Cameras;
use canvas::Canvases;
use diagnostics::Diagnostics;
use fit::make_atlas;
use frame::Frame;
use recordings::Recordings;
use session::Session;
pub use share_group::Member;
use side_effects::WriteBindings;
use std::sync::Arc;
use support::Support;
use targets::Targets;
use variants::Variants;

/// Why a context cannot be shown in several views; it then runs as if the layer were not there.
#[derive(Debug, thiserror::Error)]
pub enum LayerError {
    /// The context is older than framebuffer objects.
    #[error(
        "OpenGL {0}.{1} has no framebuffer objects or array textures; OpenGL 3.0 is the least manyview can draw several views with"
    )]
    Version(u32, u32),
    /// OpenGL ES without array textures, and without shaders for the output.
    #[error(
        "OpenGL ES {0}.{1} has no array textures; OpenGL ES 3.0 is the least manyview can draw several views with"
    )]
    Es(u32, u32),
    /// On OpenGL ES the passes of the output cannot be used, and there is no other way to draw the picture.
    #[error("the passes that make the picture cannot be used: {0}")]
    Passes(String),
}

/// One context and its drawables. More than 12 fields: the owners of its subjects. More than 25 methods: one for each kind of command that a hook
/// reports, and the steps that need several of the owners below. Each subject has a file of its own.
#[derive(Debug)]
pub struct Layer {
    session: Session,
    /// The state of the context as the program believes it to be.
    state: State,
    targets: Targets,
    variants: Variants,
    synthesis: synthesis::Synthesis,
    lists: Recordings,
    cameras: Cameras,
    known: Known,
    frame: Frame,
    canvases: Canvases,
    blocks: Blocks,
    write_bindings: WriteBindings,
    queries: queries::Queries,
    points: points::MultiViewPoints,
    diagnostics: Diagnostics,
}

/// Position of a window on its screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnScreen {
    /// Width and height of the screen, in pixels.
    pub screen: (u32, u32),
    /// Left and top edge of the window's picture on it, in pixels from its top left corner.
    pub at: (i32, i32),
}

impl Layer {
    /// Takes over a context that was just made current for the first time, with framebuffer 0 bound. Fails on a context that cannot be shown
    /// in several views.
    pub fn new(
        gl: &Gl,
        config: &'static Config,
        drawable: CurrentDrawable,
        group: Arc<Member>,
    ) -> Result<Box<Layer>, LayerError> {
        let support = Support::ask(gl)?;
        // First, because the driver's compiler of shaders needs much of the stack, and the program may have a small one.
        let errors = gl.take_errors();
        let pass = targets::interleaving(gl, config, &support);
        let layer = Self::made(gl, config, drawable, group, support, pass, errors);
        if layer.is_err() {
            // The program must not see the errors of the attempt.
            gl.drop_errors();
        }
        layer
    }

    /// In a frame of its own, as it takes more of the stack than the rest of a hook. `errors`: of the program, from before the pass was made.
    #[inline(never)]
    fn made(
        gl: &Gl,
        config: &'static Config,
        drawable: CurrentDrawable,
        group: Arc<Member>,
        support: Support,
        pass: (Names, Interleaver),
        errors: Vec<u32>,
    ) -> Result<Box<Layer>, LayerError> {
        let (width, height) = drawable.size;
        let mut report = Report::default();
        (0..gl.drop_errors()).for_each(|_| report.error());
        let window = Window::ask(gl, width, height, support.compatibility);
        let mut state = State::ask(gl, window, support.compatibility);
        state.keep(errors);
        report.proof = config.prove.map(|_| Proof::default());
        support
            .notes(gl.is_es())
            .into_iter()
            .for_each(|n| report.note(n));
        let driver = Driver::ask(gl);
        let programs = Programs::new(
            crate::draw::limits(gl, support.glsl),
            driver,
            config.clip.unwrap_or_default(),
            config.disabled.has(Optimisation::Uniforms),
        );
        let program = program::this_program();
        let (synthesis, note) = synthesis::Synthesis::new(gl, config, support.glsl);
        note.into_iter().for_each(|note| report.note(note));
        let session = Session::new(gl, config, support, group, program.as_deref());
        orphans::delete_orphans(gl, &session.group);
        let (targets, told) = Targets::new(gl, pass, &session, &state, &mut report)?;
        let camera = session.live.camera;
        let rig = Rig::new(config.views, camera, config.profile.focal_depth);
        // The program may have a small stack.
        let mut layer = Box::new(Layer {
            cameras: Cameras::new(config, &session.live, program.as_deref()),
            session,
            state,
            targets,
            variants: Variants::new(programs, driver),
            synthesis,
            lists: Recordings::default(),
            known: Known::new(rig),
            frame: Frame::default(),
            canvases: Canvases::new(drawable.id),
            blocks: Blocks::default(),
            write_bindings: WriteBindings::default(),
            queries: queries::Queries::default(),
            points: points::MultiViewPoints::default(),
            diagnostics: Diagnostics::new(report),
        });
        told.into_iter().for_each(|told| layer.announce(told));
        layer.drain_own_errors(gl);
        layer.bind_draw(gl, true, true);
        Ok(layer)
    }

    /// Whether the picture depends on where the window lies. If so, [`Layer::moved`] has to be called before each frame is shown.
    pub fn follows_window(&self) -> bool {
        self.session.panel.size.is_none()
            && matches!(
                self.output(),
                crate::config::Output::Panel | crate::config::Output::Interlaced(_)
            )
    }

    /// Sets the position of the window; none where the window system does not report it.
    pub fn moved(&mut self, on_screen: Option<OnScreen>) {
        self.session.moved(on_screen);
    }

    /// The atlas that the program draws to, and the second one of a proof, if there is one.
    fn atlases(&self) -> impl Iterator<Item = &Atlas> {
        std::iter::once(&self.targets.atlas).chain(self.diagnostics.proving.atlas())
    }

    /// Whether a texture is one of this layer's.
    fn owns_texture(&self, name: TextureName) -> bool {
        let proving = self.diagnostics.proving.atlas();
        !name.is_zero()
            && (self.targets.owns_texture(name)
                || self
                    .points
                    .samples()
                    .is_some_and(|samples| samples.textures().contains(&name))
                || self.canvases.owns_texture(name)
                || proving.is_some_and(|atlas| atlas.owns(name)))
    }

    /// Whether a texture is one of ours, or one of another context that shares objects with this one.
    pub fn hides_texture(&self, name: TextureName) -> bool {
        match self.session.group.has_others() {
            // One of ours may be the program's by now (`yield_taken_names`).
            true => is_own_texture(name),
            false => self.owns_texture(name),
        }
    }

    /// Another context of the share group has found that the program uses texture names that are ours: our textures move to other names.
    pub(super) fn yield_taken_names(&mut self, gl: &Gl) {
        if are_textures_taken() {
            self.yield_names(gl);
        }
    }

    /// Whether a framebuffer object is one of ours.
    pub fn owns_framebuffer(&self, name: FramebufferName) -> bool {
        let proving = self.diagnostics.proving.atlas();
        !name.is_zero()
            && (self.targets.owns_framebuffer(name)
                || self
                    .points
                    .samples()
                    .is_some_and(|samples| samples.framebuffers().contains(&name))
                || self.canvases.owns_framebuffer(name)
                || proving.is_some_and(|atlas| atlas.framebuffers().any(|own| own == name)))
    }

    /// The program binds a texture at a target, now or in a list.
    pub fn binds_at(&mut self, target: u32, name: TextureName) {
        self.targets.offscreen.binds_texture(target, name);
    }

    /// The program is about to bind a texture, or to compile the binding into a list.
    pub fn binds_texture(&mut self, gl: &Gl, name: TextureName) {
        if self.hides_texture(name) {
            self.take_texture(gl, name);
        } else if !name.is_zero() {
            self.targets.names.promise(name);
        }
    }

    /// The program uses a texture name that it has not generated and that is ours: our textures move to other names.
    fn yield_names(&mut self, gl: &Gl) {
        if !self.targets.names.hidden() && self.numbers_textures(gl) {
            self.outside_list(gl, |layer| layer.move_names(gl));
        }
    }

    /// Whether the program may number its textures itself: core profiles accept only names that glGenTextures has returned.
    fn numbers_textures(&self, gl: &Gl) -> bool {
        self.state.has.compatibility || gl.is_es()
    }

    /// The program takes a name that is ours: binds it, or deletes it, though it has not generated it.
    fn take_texture(&mut self, gl: &Gl, name: TextureName) {
        if !self.owns_texture(name) && self.numbers_textures(gl) {
            gl.free_texture(name);
        }
        self.yield_names(gl);
    }

    fn move_names(&mut self, gl: &Gl) {
        self.targets.names.hide();
        self.drop_proof(gl);
        self.targets.offscreen.clear(gl);
        let mut moved = true;
        self.in_each_canvas(|layer| {
            moved &= layer.remake(gl);
            if layer.targets.accumulated.buffer.is_some() {
                layer.rename_accumulation(gl);
            }
        });
        let note = if moved {
            "the program numbers its textures itself; ours moved out of its way"
        } else {
            "the program's texture names clash with ours"
        };
        self.diagnostics.report.note(note.into());
        self.targets.interleaver.rename(gl, &mut self.targets.names);
        // The next frame makes it anew.
        if let Some(panel) = self.targets.panel.take() {
            panel.delete(gl);
        }
        if let Some(osd) = self.targets.osd.take() {
            osd.delete(gl);
        }
        self.flush_points(gl);
        if let Some(samples) = self.points.take() {
            samples.delete(gl);
        }
    }

    fn rename_accumulation(&mut self, gl: &Gl) {
        self.in_neutral(gl, |layer, neutral| {
            let names = &mut layer.targets.names;
            if let Some(buffer) = &mut layer.targets.accumulated.buffer {
                buffer.rename(gl, neutral, names);
            }
        });
    }

    /// The program enables GL_FRAMEBUFFER_SRGB. Until then the atlas is not sRGB, because drivers decode what is copied out of an sRGB
    /// texture, but not what is copied out of an sRGB window.
    pub fn enable_srgb(&mut self, gl: &Gl) {
        if let Some(list) = &mut self.state.list {
            list.enables_srgb = true;
            return;
        }
        let window = &mut self.state.window;
        if window.srgb_capable && !window.srgb {
            window.srgb = true;
            if self.targets.atlas.is_plain() {
                return;
            }
            self.drop_proof(gl);
            if !self.remake(gl) {
                self.state.window.srgb = false;
                self.diagnostics
                    .report
                    .note("the driver makes no sRGB framebuffer: colours are not converted".into());
            }
        }
    }

    /// Replaces the atlas by a new one with the same contents, on the grid that is needed now. False where the driver makes none; the old one
    /// then stays.
    fn remake(&mut self, gl: &Gl) -> bool {
        if self.is_plain() {
            return true;
        }
        self.flush_points(gl);
        self.state.refresh(gl);
        self.leave_mono(gl);
        let grid = self.grid();
        let (names, window) = (&mut self.targets.names, &self.state.window);
        let Ok(mut atlas) = make_atlas(gl, names, &self.session, window, grid) else {
            return false;
        };
        with_raw_copies(gl, || {
            self.reading(gl, BACK, |layer| {
                if atlas.tiles.lies_like(&layer.targets.atlas.tiles) {
                    return atlas.copy(gl, &layer.targets.atlas);
                }
                let (names, window) = (&mut layer.targets.names, &layer.state.window);
                keep_bindings(gl, || {
                    atlas.copy_spread(gl, &mut layer.targets.atlas, names, window)
                });
            });
            if self.targets.atlas.has_front() {
                let (names, window) = (&mut self.targets.names, &self.state.window);
                keep_bindings(gl, || atlas.make_front(gl, names, window, false));
                atlas.copy_front(gl, &self.targets.atlas);
            }
        });
        std::mem::replace(&mut self.targets.atlas, atlas).delete(gl);
        self.apply_buffers(gl);
        let f = &self.state.framebuffers;
        for (target, name) in [(c::DRAW_FRAMEBUFFER, f.draw), (c::READ_FRAMEBUFFER, f.read)] {
            gl.bind_framebuffer(target, name);
        }
        self.bind_draw(gl, true, true);
        true
    }

    /// Counts the GL names that the layer has made and deleted on this thread since the last call. It has to be called before another context
    /// is made current, so that all of them are this context's.
    pub fn count_names(&mut self) {
        let lists = self.session.group.lists().held();
        self.diagnostics.count_names(lists);
    }

    /// Adds a sentence for the user to the report.
    pub fn note(&mut self, sentence: String) {
        self.diagnostics.report.note(sentence);
    }

    /// Size of the window in pixels.
    pub fn size(&self) -> (u32, u32) {
        (self.state.window.width, self.state.window.height)
    }

    /// Takes the errors of the layer's own calls out of the driver's queue, and counts them in the report.
    fn drain_own_errors(&mut self, gl: &Gl) {
        for _ in 0..gl.drop_errors() {
            self.diagnostics.report.error();
        }
    }
}

/// Runs a copy without scissor test and sRGB conversion, so that bits stay as they are.
fn with_raw_copies<R>(gl: &Gl, copy: impl FnOnce() -> R) -> R {
    let (cut, srgb) = (gl.is_enabled(c::SCISSOR_TEST), gl.is_srgb_enabled());
    gl.switch_scissor_test(false);
    gl.enable_srgb(false);
    let copied = copy();
    if cut {
        gl.switch_scissor_test(true);
    }
    if srgb {
        gl.enable_srgb(true);
    }
    copied
}

/// Runs `make` with no pixel unpack buffer bound, and then restores the bindings of textures and framebuffers that making an atlas changes.
fn keep_bindings<R>(gl: &Gl, make: impl FnOnce() -> R) -> R {
    // OpenGL ES has multisample arrays from 3.2 on; desktop OpenGL before 3.2 may have them by an extension.
    let sampled = gl.since((3, 2), Some((3, 2))) || gl.has_extension("GL_ARB_texture_multisample");
    let there = |(target, _): &(u32, u32)| sampled || *target == c::TEXTURE_2D_ARRAY;
    let saved: Vec<(u32, TextureName)> = Names::TARGETS
        .into_iter()
        .filter(there)
        .map(|(target, binding)| (target, TextureName(gl.get_integer(binding) as u32)))
        .collect();
    let unpack = BufferName(gl.get_integer(c::PIXEL_UNPACK_BUFFER_BINDING) as u32);
    if !unpack.is_zero() {
        gl.bind_buffer(c::PIXEL_UNPACK_BUFFER, BufferName::ZERO);
    }
    let read = FramebufferName(gl.get_integer(c::READ_FRAMEBUFFER_BINDING) as u32);
    let draw = FramebufferName(gl.get_integer(c::DRAW_FRAMEBUFFER_BINDING) as u32);
    let made = make();
    gl.bind_framebuffer(c::READ_FRAMEBUFFER, read);
    gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, draw);
    for (target, name) in saved {
        gl.bind_texture(target, name);
    }
    if !unpack.is_zero() {
        gl.bind_buffer(c::PIXEL_UNPACK_BUFFER, unpack);
    }
    made
}
