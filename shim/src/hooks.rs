//! The functions that generated hooks call: one per class of command.

use crate::context::{self, enter};
use crate::instead::{instead, instead_at};
use manyview_core::gl::{Gl, Real, TextureName};
use manyview_core::layer::Layer;

pub(crate) use manyview_core::gl::Object;

pub(crate) use context::real;
use manyview_core::gl::consts::{
    BLEND, DEPTH_TEST, FRAMEBUFFER_SRGB, POLYGON_STIPPLE, SCISSOR_TEST, STENCIL_TEST, TEXTURE_2D,
};
use manyview_core::state::Run;
pub(crate) use manyview_core::state::{Command, TextureAt, Touch};

/// Classes of draws, as `commands.list` names them.
#[derive(Clone, Copy)]
#[allow(clippy::upper_case_acronyms, reason = "as in commands.list")]
pub(crate) enum Kind {
    CLEAR,
    ARRAYS,
}

/// Before a command that changes groups of state, now or when the display list that compiles it is called.
#[inline]
pub(crate) fn touch(groups: Touch) {
    if context::peek(|l| l.touch(groups)) == Some(false) {
        // State that the views depend on is set once, in a run of its own. Other state may stay in a run that draws.
        let per_fragment = Touch::DEPTH | Touch::RANGE | Touch::TEXTURE | Touch::COVER;
        let inside = Touch::FIXED | Touch::MATERIAL | per_fragment;
        let run = if groups.without(inside) == Touch::NONE {
            Run::Open
        } else {
            Run::State
        };
        compile(Command::Of(run), groups);
    }
}

/// Before any command that display lists compile: tells the layer if a list is open. Returns whether the layer was told.
pub(crate) fn compile(command: Command, groups: Touch) -> bool {
    context::peek(|l| l.compiles()) == Some(true)
        && enter(|gl, l| l.compile(gl, command, groups)).is_some()
}

/// Before a command that concerns the layer only inside a display list.
#[inline]
pub(crate) fn list_only() {
    compile(Command::Of(Run::Open), Touch::NONE);
}

/// Before a command that sets a uniform of the program's.
#[inline]
pub(crate) fn uniform() {
    list_only();
    manyview_core::state::uniform_changes();
}

/// Runs work of the layer that is needed only if the views have images of their own.
pub(crate) fn if_split(f: impl FnOnce(&Gl, &mut Layer)) {
    if context::peek(|l| l.has_copies()) == Some(true) {
        enter(f);
    }
}

/// Runs work of the layer for a write to a texture.
fn if_followed(f: impl FnOnce(&Gl, &mut Layer)) {
    if context::peek(|l| l.follows_textures()) == Some(true) {
        enter(f);
    }
}

/// Before a command that writes to a texture and that display lists compile.
#[inline]
pub(crate) fn texture(to: TextureAt) {
    if context::peek(|l| l.compiles() || l.follows_textures()) == Some(true) {
        enter(|gl, l| l.texture_written(gl, to));
    }
}

/// Before a command that writes to the texture bound at `target` and that no display list compiles.
#[inline]
pub(crate) fn texture_now(target: u32) {
    before_uncompiled();
    if_followed(|gl, l| l.bound_texture_written(gl, target));
}

/// Before a command that writes to a texture or renderbuffer, which it names.
#[inline]
pub(crate) fn named(object: Object) {
    before_uncompiled();
    if_followed(|gl, l| l.written(gl, object));
}

/// Before a command that reads or writes textures other than by drawing.
#[inline]
pub(crate) fn write_back() {
    before_uncompiled();
    if_split(|gl, l| l.write_back_textures(gl));
}

/// Before a command that binds textures to so many image units.
#[inline]
pub(crate) fn images(first: u32, count: i32) {
    write_back();
    context::peek(|l| l.images_change(first, count));
}

/// Before a command that makes an attribute advance per instance.
#[inline]
pub(crate) fn divide() {
    before_uncompiled();
    context::peek(|l| l.divides());
}

/// Before a command that sets a parameter of a texture; `set` is its name and value, if it is a single number.
#[inline]
pub(crate) fn texture_parameter(at: TextureAt, set: Option<(u32, f32)>) {
    compile(Command::Of(Run::Open), Touch::PARAMETERS);
    if_split(|gl, l| l.texture_parameter(gl, at, set));
}

/// Before a command that changes the attachments or the draw buffers of a framebuffer of the program's.
#[inline]
pub(crate) fn attached() {
    before_uncompiled();
    context::peek(|l| l.attachments_changed());
}

/// Before a command that gives the bound renderbuffer other storage.
pub(crate) fn storage() {
    before_uncompiled();
    if_split(|gl, l| l.storage_changed(gl));
}

/// A call that generates the mipmaps of the texture bound at `target`.
pub(crate) fn mipmap(target: u32, call: &mut dyn FnMut(&'static Real)) {
    list_only();
    call(real());
    if_split(|gl, l| l.mipmaps(gl, target, &mut || call(gl.real())));
}

/// A call that runs a compute shader.
pub(crate) fn compute(call: &mut dyn FnMut(&'static Real)) {
    before_uncompiled();
    instead(&mut || call(real()), |gl, l, call| l.compute(gl, call));
}

/// A copy from the read framebuffer to a texture, which the call gets by its name; `x` and `width` are the columns in pixels.
pub(crate) fn copy(
    to: TextureAt,
    x: i32,
    width: i32,
    call: &mut dyn FnMut(&'static Real, TextureName),
) {
    let name = match to {
        TextureAt::Named(texture) => texture,
        _ => TextureName::ZERO,
    };
    instead_at(name, &mut |name| call(real(), name), |gl, l, each| {
        l.copy_texture(gl, to, [x, width], each);
    });
}

/// The same for a command that names its texture and that no display list compiles.
pub(crate) fn copy_now(
    texture: TextureName,
    x: i32,
    width: i32,
    call: &mut dyn FnMut(&'static Real, TextureName),
) {
    before_uncompiled();
    instead_at(texture, &mut |name| call(real(), name), |gl, l, each| {
        l.copy_texture_now(gl, texture, [x, width], each);
    });
}

/// Before a command that no display list compiles: the commands before it have to be executed first.
#[inline]
pub(crate) fn before_uncompiled() {
    if context::peek(|l| l.executes()) == Some(true) {
        enter(|gl, l| l.catch_up(gl));
    }
}

/// Before a command on the current matrix or its stack.
#[inline]
pub(crate) fn matrix(command: Command) {
    let groups = match command {
        Command::PushMatrix => Touch::NONE,
        _ => Touch::MATRIX,
    };
    if context::peek(|l| l.touch(groups)) == Some(false) {
        compile(command, groups);
    }
}

/// Before a capability is enabled or disabled.
#[inline]
pub(crate) fn cap(cap: u32, on: bool) {
    if cap == FRAMEBUFFER_SRGB && on {
        enter(|gl, l| l.enable_srgb(gl));
    }
    touch(match cap {
        SCISSOR_TEST => Touch::RECTS,
        DEPTH_TEST => Touch::FIXED | Touch::DEPTH,
        TEXTURE_2D => Touch::FIXED | Touch::TEXTURE,
        BLEND | STENCIL_TEST | POLYGON_STIPPLE => Touch::FIXED | Touch::COVER,
        _ => Touch::FIXED,
    });
}

/// Before a capability of one index is enabled or disabled.
#[inline]
pub(crate) fn cap_indexed(index_cap: u32, on: bool) {
    match index_cap {
        SCISSOR_TEST => touch(Touch::RECTS | Touch::VIEWPORTS),
        _ => cap(index_cap, on),
    }
}

/// The space of a raster position.
#[derive(Clone, Copy)]
pub(crate) enum Place {
    /// glRasterPos.
    Scene,
    /// glWindowPos.
    Window,
}

/// A call that sets the raster position.
pub(crate) fn raster(place: Place, call: &mut dyn FnMut(&'static Real)) {
    let groups = match place {
        Place::Scene => Touch::RASTER,
        Place::Window => Touch::WINDOW_POS,
    };
    touch(groups);
    call(real());
    enter(|gl, l| match place {
        _ if l.compiles() && !l.executes() => {}
        Place::Scene => l.placed_raster(gl),
        Place::Window => l.placed_in_window(),
    });
}

/// A call that draws: the layer draws it in all views.
pub(crate) fn draw(kind: Kind, call: &mut dyn FnMut(&'static Real)) {
    use manyview_core::plan::Kind as Plan;
    let kind = match kind {
        Kind::CLEAR => Plan::Clear {
            depths: true,
            whole: 0,
        },
        Kind::ARRAYS => Plan::Other,
    };
    instead(&mut || call(real()), |gl, l, call| l.draw(gl, kind, call));
}

/// A call that reads from the read framebuffer; `x` and `width` are its columns in pixels.
pub(crate) fn read(x: i32, width: i32, call: &mut dyn FnMut(&'static Real)) {
    instead(&mut || call(real()), |gl, l, call| {
        l.read(gl, x, width, call);
    });
}

/// As [`read`], for a command that no display list compiles.
pub(crate) fn read_now(x: i32, width: i32, call: &mut dyn FnMut(&'static Real)) {
    instead(&mut || call(real()), |gl, l, call| {
        l.read_now(gl, x, width, call);
    });
}

/// A call that concerns the framebuffer bound at `target`. If that is the program's 0, the driver gets the true one.
pub(crate) fn hide<R>(target: u32, call: &mut dyn FnMut(&'static Real) -> R) -> R {
    before_uncompiled();
    let mut answer = None;
    instead(&mut || answer = Some(call(real())), |gl, l, call| {
        l.with_true_zero(gl, target, call);
    });
    answer.unwrap_or_else(|| call(real()))
}

/// As [`hide`], for a call that attaches something.
pub(crate) fn attach<R>(target: u32, call: &mut dyn FnMut(&'static Real) -> R) -> R {
    context::peek(|l| l.attachments_changed());
    hide(target, call)
}

/// Immediate mode.
pub(crate) mod imm {
    use crate::context;
    use manyview_core::gl::Recording;
    use manyview_core::state::{Command, Effect, Touch};

    /// Writes a call to the recording by `write` while calls are recorded. Returns whether it was recorded.
    #[inline]
    pub(crate) fn record(slot: usize, effect: Effect, write: impl FnOnce(&mut Recording)) -> bool {
        context::recording() && context::peek_inside(|l| l.record(slot, effect, write)).is_some()
    }

    /// Before a call of immediate mode that is not recorded: inside a display list, or outside glBegin and glEnd.
    #[inline]
    pub(crate) fn direct(effect: Effect) {
        let touch = if effect.has(Effect::MATERIAL) {
            Touch::MATERIAL
        } else {
            Touch::NONE
        };
        if context::peek(|l| l.touch(touch)) == Some(false) {
            super::compile(Command::Immediate(effect), touch);
        }
    }

    /// Whether glMaterial takes this face and parameter.
    pub(crate) fn is_material(face: u32, pname: u32) -> bool {
        let faces = [0x0404, 0x0405, 0x0408]; // GL_FRONT, GL_BACK, GL_FRONT_AND_BACK
        faces.contains(&face) && matches!(pname, 0x1600..=0x1603 | 0x1200..=0x1202)
    }

    /// Number of values of glMaterial*v.
    pub(crate) fn material_len(pname: u32) -> usize {
        match pname {
            0x1600 | 0x1200..=0x1202 | 0x1602 => 4, // GL_EMISSION, GL_AMBIENT … GL_SPECULAR, GL_AMBIENT_AND_DIFFUSE
            0x1603 => 3,                            // GL_COLOR_INDEXES
            _ => 1,                                 // GL_SHININESS
        }
    }
}
