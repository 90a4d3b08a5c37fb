//! Textures that the program copies from the frame, or from a framebuffer of which each view has its own: each view has its own copy, and is
//! drawn with it (see [`crate::offscreen`]).
//!
//! Motion blur, water, heat: the program copies what it has drawn into a texture and draws that over the scene again.

use super::reading::Reading;
use super::{Layer, keep_bindings};
use crate::gl::{
    FramebufferName, Gl, Object, RenderbufferName, TextureName, consts as c, texture_binding,
};
use crate::state::{Command, Run, TextureAt, TextureWrite, Touch};
use crate::view::ViewIndex;

impl Layer {
    /// glCopyTexImage* and glCopyTexSubImage*: copies from each view into its own texture. `call` gets the name of the texture, which matters
    /// to a command that names it. `x` and `width` are the columns in pixels.
    pub fn copy_texture(
        &mut self,
        gl: &Gl,
        to: TextureAt,
        [x, width]: [i32; 2],
        call: &mut dyn FnMut(TextureName),
    ) {
        if self.compiles() {
            let copied = Some([x, width]);
            self.compile_texture(gl, TextureWrite { to, copied });
            return call(match to {
                TextureAt::Named(texture) => texture,
                _ => TextureName::ZERO,
            });
        }
        match to {
            TextureAt::Unit(unit, target) => self.with_unit(gl, unit, |layer| {
                layer.copy_texture(gl, TextureAt::Bound(target), [x, width], call);
            }),
            TextureAt::Bound(target) => {
                let texture = self.bound_texture(gl, target);
                self.copy_from_views(gl, (Some(target), texture), [x, width], call);
            }
            TextureAt::Named(texture) => {
                self.copy_from_views(gl, (None, texture), [x, width], call);
            }
        }
    }

    /// As [`Layer::copy_texture`], for a command that no display list compiles and that names its texture.
    pub fn copy_texture_now(
        &mut self,
        gl: &Gl,
        texture: TextureName,
        columns: [i32; 2],
        call: &mut dyn FnMut(TextureName),
    ) {
        if self.within_listed_primitive() {
            self.written(gl, Object::Texture(texture));
            return call(texture);
        }
        self.outside_list(gl, |layer| {
            layer.copy_from_views(gl, (None, texture), columns, call);
        });
    }

    fn compile_texture(&mut self, gl: &Gl, write: TextureWrite) {
        self.compile(gl, Command::Of(Run::Texture(write)), Touch::NONE);
    }

    /// Executes a command of a display list that writes to a texture.
    pub(super) fn listed_texture(
        &mut self,
        gl: &Gl,
        TextureWrite { to, copied }: TextureWrite,
        call: &mut dyn FnMut(),
    ) {
        match (copied, to) {
            (Some([x, width]), TextureAt::Named(_)) => {
                // The list writes to the texture of that name alone.
                self.texture_written(gl, to);
                self.read(gl, x, width, call);
            }
            (Some(columns), to) => self.copy_texture(gl, to, columns, &mut |_| call()),
            (None, to) => {
                self.texture_written(gl, to);
                call();
            }
        }
    }

    /// Copies from each view to its own texture. `to`: the target of the active unit at which the texture is bound, or none for a command that
    /// names it; and the texture.
    fn copy_from_views(
        &mut self,
        gl: &Gl,
        to: (Option<u32>, TextureName),
        [x, width]: [i32; 2],
        call: &mut dyn FnMut(TextureName),
    ) {
        self.cameras.image_sums.forget(to.1);
        let from = self.state.framebuffers.read;
        if let (FramebufferName::ZERO, Reading::Parked(_)) = (from, self.canvases.reading()) {
            return self.in_read_canvas(gl, |layer| {
                layer.copy_from_views(gl, to, [x, width], call);
            });
        }
        let differs = match from {
            FramebufferName::ZERO => self.reads_views(),
            _ => self.targets.offscreen.is_split(gl, from),
        };
        let (target, texture) = to;
        let own_call = &mut || call(texture);
        // Nothing is copied, and there may be nothing to copy to.
        let split = self.targets.offscreen.has(Object::Texture(texture));
        let empty = width == 0 && !split;
        if !differs || texture.is_zero() || empty {
            return self.read(gl, x, width, own_call);
        }
        self.leave_mono(gl);
        if from.is_zero() && !self.make_singles(gl, false) {
            return self.read(gl, x, width, own_call);
        }
        let split = self.ensure_split(gl, target, texture);
        if split {
            // First, so that nobody has to ask whether the program's own call is wrong: it is as wrong here, and raises its error afterwards.
            self.state.keep_errors(gl);
            self.copy_other_views(gl, to, call);
        }
        self.read(gl, x, width, &mut || call(texture));
    }

    /// glCopyImageSubData from one texture to another: where each view has its own image of the first, it gets its own of the other. `call` makes the call between two textures.
    pub fn copy_image(
        &mut self,
        gl: &Gl,
        [from, to]: [TextureName; 2],
        call: &mut dyn FnMut([TextureName; 2]),
    ) {
        self.write_back_textures(gl);
        self.cameras.image_sums.forget(to);
        let views = self.targets.offscreen.views(from);
        let split = !views.is_empty() && self.ensure_split(gl, None, to);
        let copies = self.targets.offscreen.views(to);
        if !split || copies.len() != views.len() {
            self.written(gl, Object::Texture(to));
            return call([from, to]);
        }
        self.leave_mono(gl);
        self.state.keep_errors(gl);
        let own = self.targets.atlas.tiles.own();
        let shown = self.wanted_views();
        let all = ViewIndex::all(self.session.config.views);
        for (view, (source, copy)) in all.zip(views.into_iter().zip(copies)) {
            if copy != to && (view == own || shown.has(view)) {
                call([source, copy]);
            }
        }
        self.targets.offscreen.written(to);
        self.drain_own_errors(gl);
        call([from, to]);
    }

    /// Splits a texture, unless it is split already. False where that cannot be done.
    fn ensure_split(&mut self, gl: &Gl, target: Option<u32>, texture: TextureName) -> bool {
        if self.targets.offscreen.has(Object::Texture(texture)) {
            return true;
        }
        self.state.keep_errors(gl);
        let split = keep_bindings(gl, || {
            let (offscreen, names) = (&mut self.targets.offscreen, &mut self.targets.names);
            match target {
                Some(target) => offscreen.split_texture(gl, names, (target, texture)),
                None => offscreen.split_named(gl, names, texture),
            }
        });
        self.drain_own_errors(gl);
        split
    }

    /// Copies from each view into its own texture, before the program's own call.
    fn copy_other_views(
        &mut self,
        gl: &Gl,
        (target, texture): (Option<u32>, TextureName),
        call: &mut dyn FnMut(TextureName),
    ) {
        let from = self.state.framebuffers.read;
        self.state.refresh(gl);
        if !from.is_zero() {
            self.split(gl, from);
        }
        let own = self.targets.atlas.tiles.own();
        let shown = self.wanted_views();
        let views = ViewIndex::all(self.session.config.views);
        for (view, name) in views.zip(self.targets.offscreen.views(texture)) {
            if name != texture && (view == own || shown.has(view)) {
                match from {
                    FramebufferName::ZERO => self.take_single(gl, view),
                    from => {
                        let from = self.targets.offscreen.view(gl, from, view);
                        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
                    }
                }
                if let Some(target) = target {
                    gl.bind_texture(target, name);
                }
                call(name);
            }
        }
        if let Some(target) = target {
            gl.bind_texture(target, texture);
        }
        self.targets.offscreen.written(texture);
        self.drain_own_errors(gl);
        self.rebind(gl);
    }

    /// Runs `work` for a command on the textures of a unit, GL_TEXTURE0 and so on, which is the active one meanwhile.
    pub fn with_unit(&mut self, gl: &Gl, unit: u32, work: impl FnOnce(&mut Self)) {
        self.outside_list(gl, |layer| {
            let active = gl.get_integer(c::ACTIVE_TEXTURE) as u32;
            // The driver refuses others.
            let other = unit != active && unit.wrapping_sub(c::TEXTURE0) < 32;
            if other {
                gl.active_texture(unit);
            }
            work(layer);
            if other {
                gl.active_texture(active);
            }
        });
    }

    /// Whether what is read from framebuffer 0 may differ between the views.
    pub(super) fn reads_views(&self) -> bool {
        match self.canvases.reading() {
            Reading::Drawn => self.session.config.views > 1 && !self.is_plain(),
            Reading::Parked(_) => self.canvases.read().is_some_and(|read| !read.is_plain()),
            Reading::True => false,
        }
    }

    /// The texture that is bound at `target`; 0 where that is no target whose textures are copied per view.
    fn bound_texture(&self, gl: &Gl, target: u32) -> TextureName {
        TextureName(match target {
            c::TEXTURE_2D => gl.get_integer(c::TEXTURE_BINDING_2D) as u32,
            c::TEXTURE_RECTANGLE => gl.get_integer(c::TEXTURE_BINDING_RECTANGLE) as u32,
            c::TEXTURE_1D => gl.get_integer(c::TEXTURE_BINDING_1D) as u32,
            _ => 0,
        })
    }

    /// After glGenerateMipmap: makes the mipmaps of the other views' textures, too.
    pub fn mipmaps(&mut self, gl: &Gl, target: u32, call: &mut dyn FnMut()) {
        let Some(texture) = self.targets.offscreen.bound_at(gl, target) else {
            return;
        };
        self.mipmaps_of(gl, texture, &mut |name| {
            gl.bind_texture(target, name);
            call();
            gl.bind_texture(target, texture);
        });
    }

    /// The same for a command that names its texture.
    pub fn mipmaps_of(&mut self, gl: &Gl, texture: TextureName, call: &mut dyn FnMut(TextureName)) {
        if self.compiles() {
            return self.outside_list(gl, |layer| layer.mipmaps_of(gl, texture, call));
        }
        self.state.keep_errors(gl);
        for name in self.targets.offscreen.views(texture) {
            if name != texture {
                call(name);
            }
        }
        self.targets.offscreen.written(texture);
        self.drain_own_errors(gl);
    }

    /// Before a command that changes the image of a texture: all views see the same again. A display list does that where it is called.
    pub fn texture_written(&mut self, gl: &Gl, to: TextureAt) {
        if self.compiles() {
            let copied = None;
            return self.compile_texture(gl, TextureWrite { to, copied });
        }
        match to {
            TextureAt::Named(texture) => self.written(gl, Object::Texture(texture)),
            TextureAt::Unit(unit, target) => self.with_unit(gl, unit, |layer| {
                layer.texture_written(gl, TextureAt::Bound(target));
            }),
            TextureAt::Bound(target) => self.bound_texture_written(gl, target),
        }
    }

    /// As [`Layer::texture_written`], for a command on the texture that is bound, which no display list compiles.
    pub fn bound_texture_written(&mut self, gl: &Gl, target: u32) {
        let bound = match target {
            c::TEXTURE_2D => Some(self.bound_texture(gl, target)),
            target => self.targets.offscreen.bound_at(gl, target),
        };
        if let Some(texture) = bound {
            self.written(gl, Object::Texture(texture));
        }
    }

    /// The program changes the image of a texture or renderbuffer: all views see the same again.
    pub fn written(&mut self, gl: &Gl, object: Object) {
        if let Object::Texture(texture) = object {
            self.cameras.image_sums.forget(texture);
        }
        if self.targets.offscreen.has(object) {
            self.write_back_textures(gl);
            self.targets.offscreen.forget(gl, [object]);
        }
    }

    /// Writes the own view's images back to the program's textures, before those are read or written in another way than by drawing.
    pub fn write_back_textures(&mut self, gl: &Gl) {
        if self.compiles() {
            return self.outside_list(gl, |layer| layer.write_back_textures(gl));
        }
        self.state.keep_errors(gl);
        if self.write_bindings.has_images() {
            gl.finish_writes_to_textures();
        }
        self.targets.offscreen.write_back(gl);
        self.drain_own_errors(gl);
    }

    /// The renderbuffer that is bound gets another storage.
    pub fn storage_changed(&mut self, gl: &Gl) {
        let name = RenderbufferName(gl.get_integer(c::RENDERBUFFER_BINDING) as u32);
        self.written(gl, Object::Renderbuffer(name));
    }

    /// Before glDeleteTextures.
    pub fn deletes_textures(&mut self, gl: &Gl, textures: &[TextureName]) {
        for &name in textures {
            self.cameras.image_sums.forget(name);
            if self.hides_texture(name) {
                self.take_texture(gl, name);
            }
        }
        self.targets.offscreen.deleted_textures(gl, textures);
        self.write_bindings.deleted_textures(textures);
    }

    /// glDeleteRenderbuffers.
    pub fn deleted_renderbuffers(&mut self, gl: &Gl, names: &[RenderbufferName]) {
        let all = names.iter().map(|&name| Object::Renderbuffer(name));
        self.targets.offscreen.forget(gl, all);
    }

    /// Before a parameter of a texture is set; `set` is its name and value, if it is a single number.
    pub fn texture_parameter(&mut self, gl: &Gl, at: TextureAt, set: Option<(u32, f32)>) {
        let texture = match at {
            TextureAt::Named(texture) => Some(texture),
            TextureAt::Bound(target) => {
                texture_binding(target).map(|name| TextureName(gl.get_integer(name) as u32))
            }
            TextureAt::Unit(..) => None,
        };
        self.targets.offscreen.parameter(texture, set);
    }

    /// Takes note of parameters of textures that something has set which no hook sees one by one.
    pub(super) fn refresh_parameters(&mut self) {
        if self.state.touched.has(Touch::PARAMETERS) {
            self.state.touched = self.state.touched.without(Touch::PARAMETERS);
            self.targets.offscreen.parameter(None, None);
        }
    }

    /// The attachments or the draw buffers of some framebuffer have changed.
    pub fn attachments_changed(&mut self) {
        self.targets.offscreen.attachments_changed();
    }

    /// Whether other contexts share the objects of this one.
    pub fn is_shared(&self) -> bool {
        self.session.group.has_others()
    }

    /// Whether any image beside the window differs between the views.
    pub fn has_copies(&self) -> bool {
        !self.targets.offscreen.is_empty()
    }
}
