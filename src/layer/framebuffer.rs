//! The program's framebuffer 0: how it is bound, drawn to, read from and queried.

use super::reading::Reading;
use super::{Layer, keep_bindings, with_raw_copies};
use crate::atlas::Atlas;
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::plan::Unrepresentable;
use crate::state::{BACK, Command, FRONT, Segment, Touch};
use crate::view::ViewIndex;

/// The buffers of framebuffer 0 that one glPushAttrib has saved.
#[derive(Debug)]
pub(super) struct Pushed {
    /// GL_ATTRIB_STACK_DEPTH after the glPushAttrib.
    depth: i32,
    /// Its bits.
    mask: u32,
    /// How often parameters of split textures had changed then.
    parameter_changes: u64,
    draw_buffers: Option<Vec<u32>>,
    read_buffer: Option<u32>,
}

/// What a glPopAttrib may change, where the bits of its glPushAttrib are known or not.
fn touched_by_pop(mask: Option<u32>) -> Touch {
    let mask = mask.unwrap_or(c::ALL_ATTRIB_BITS);
    let parts = [
        (c::COLOR_BUFFER_BIT, Touch::BUFFERS),
        (c::TEXTURE_BIT, Touch::PARAMETERS),
    ];
    let left_alone = parts.into_iter().filter(|(bit, _)| mask & bit == 0);
    left_alone.fold(Touch::ALL, |all, (_, touch)| all.without(touch))
}

impl Layer {
    /// glPushAttrib: the driver saves the draw and read buffers of the atlas, and the layer saves the names that the program has given for
    /// them.
    pub fn push_attrib(&mut self, gl: &Gl, mask: u32, push: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::PushAttrib(mask), Touch::NONE);
            if !self.executes() {
                return push();
            }
        }
        let before = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        push();
        let depth = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        if depth > before {
            self.pushed_attribs(depth, mask);
        }
    }

    fn pushed_attribs(&mut self, depth: i32, mask: u32) {
        let f = &self.state.framebuffers;
        // Display lists push and pop without our seeing it, so levels from this depth on are no longer on the stack.
        self.targets.pushed.retain(|p| p.depth < depth);
        self.targets.pushed.push(Pushed {
            depth,
            mask,
            parameter_changes: self.targets.offscreen.parameter_changes(),
            draw_buffers: (mask & c::COLOR_BUFFER_BIT != 0 && f.draw.is_zero())
                .then(|| f.draw_buffers.clone()),
            read_buffer: (mask & c::PIXEL_MODE_BIT != 0 && f.read.is_zero())
                .then_some(f.read_buffer),
        });
    }

    /// glPopAttrib.
    pub fn pop_attrib(&mut self, gl: &Gl, pop: &mut dyn FnMut()) {
        if self.compiles() {
            let mask = self.state.list.as_ref().and_then(|list| list.pushed());
            // What was pushed before the run is known when that is executed.
            let touch = mask.map_or(Touch::NONE, |mask| touched_by_pop(Some(mask)));
            self.compile(gl, Command::PopAttrib, touch);
            if !self.executes() {
                return pop();
            }
        }
        let depth = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        let pushed = self.pushed_at(depth);
        let mut touched = touched_by_pop(pushed.map(|p| p.mask));
        let changes = self.targets.offscreen.parameter_changes();
        if pushed.is_some_and(|p| p.parameter_changes == changes) {
            touched = touched.without(Touch::PARAMETERS);
        }
        self.state.touch(touched);
        pop();
        self.popped_attribs(gl, depth);
    }

    fn pushed_at(&self, depth: i32) -> Option<&Pushed> {
        self.targets.pushed.iter().find(|p| p.depth == depth)
    }

    /// The state groups that a run of a list touches, with those of what it pops from before it.
    pub(super) fn touched_by_run(&self, gl: &Gl, run: &Segment) -> Touch {
        if run.pops == 0 {
            return run.touch;
        }
        let top = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        let levels = (0..run.pops as i32).map(|below| self.pushed_at(top - below));
        let masks = levels.map(|pushed| pushed.map(|p| p.mask));
        masks.fold(run.touch, |touch, mask| touch | touched_by_pop(mask))
    }

    /// After a run of a list that has popped and pushed attributes; `depth` is the depth of the stack before the run.
    pub(super) fn attribs_after_run(&mut self, gl: &Gl, depth: i32, run: &Segment) {
        let floor = (depth - run.pops as i32).max(0);
        for depth in (floor + 1..=depth).rev() {
            self.popped_attribs(gl, depth);
        }
        let now = gl.get_integer(c::ATTRIB_STACK_DEPTH);
        for (depth, mask) in (floor + 1..=now).zip(&run.pushes) {
            self.pushed_attribs(depth, *mask);
        }
    }

    fn popped_attribs(&mut self, gl: &Gl, depth: i32) {
        let saved = self.targets.pushed.iter().position(|p| p.depth == depth);
        let Some(saved) = saved.map(|at| self.targets.pushed.swap_remove(at)) else {
            return;
        };
        let f = &mut self.state.framebuffers;
        let before = (f.draw_buffers.clone(), f.read_buffer);
        if let (Some(b), FramebufferName::ZERO) = (saved.draw_buffers, f.draw) {
            f.draw_buffers = b;
        }
        if let (Some(b), FramebufferName::ZERO) = (saved.read_buffer, f.read) {
            f.read_buffer = b;
        }
        if before != (f.draw_buffers.clone(), f.read_buffer) {
            self.outside_list(gl, |layer| layer.apply_buffers(gl));
        }
    }

    /// glBindFramebuffer. `bind` makes the call for a target and a name.
    pub fn bind_framebuffer(
        &mut self,
        target: u32,
        name: FramebufferName,
        bind: &mut dyn FnMut(u32, FramebufferName),
    ) {
        let (draw, read) = match target {
            c::FRAMEBUFFER => (true, true),
            c::DRAW_FRAMEBUFFER => (true, false),
            c::READ_FRAMEBUFFER => (false, true),
            _ => return bind(target, name),
        };
        let drawn = self.targets.atlas.framebuffer();
        match (name, target) {
            (FramebufferName::ZERO, c::READ_FRAMEBUFFER) => bind(target, self.read_name()),
            (FramebufferName::ZERO, _) => bind(target, drawn),
            _ => bind(target, name),
        }
        if name.is_zero() && target == c::FRAMEBUFFER && self.read_name() != drawn {
            bind(c::READ_FRAMEBUFFER, self.read_name());
        }
        if draw {
            self.targets.atlas.forget_row();
            self.state.framebuffers.draw = name;
            // One of the two framebuffers may have a depth buffer, and the other none.
            self.state.touch(Touch::DEPTH);
        }
        if read {
            self.state.framebuffers.read = name;
        }
    }

    /// After glDeleteFramebuffers, which binds framebuffer 0 in the place of one that was bound.
    pub fn deleted_framebuffers(&mut self, gl: &Gl, names: &[FramebufferName]) {
        let f = &mut self.state.framebuffers;
        let (draw, read) = (
            !f.draw.is_zero() && names.contains(&f.draw),
            !f.read.is_zero() && names.contains(&f.read),
        );
        if draw {
            f.draw = FramebufferName::ZERO;
        }
        if read {
            f.read = FramebufferName::ZERO;
        }
        self.targets.offscreen.forget_targets(gl, names);
        self.bind_draw(gl, draw, read);
    }

    /// Binds the atlas where the program has framebuffer 0 bound.
    pub(super) fn bind_draw(&mut self, gl: &Gl, draw: bool, read: bool) {
        let f = &self.state.framebuffers;
        if draw && f.draw.is_zero() {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, self.targets.atlas.framebuffer());
            self.targets.atlas.forget_row();
        }
        if read && f.read.is_zero() {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, self.read_name());
        }
    }

    /// The framebuffer that is bound for reading where the program has framebuffer 0 bound.
    fn read_name(&self) -> FramebufferName {
        match self.canvases.reading() {
            Reading::True => FramebufferName::ZERO,
            Reading::Drawn => self.targets.atlas.framebuffer(),
            Reading::Parked(_) => self
                .canvases
                .read()
                .map_or(FramebufferName::ZERO, Atlas::framebuffer),
        }
    }

    /// Runs a call with the true framebuffer 0 bound where the program has framebuffer 0 bound at `target`.
    pub fn with_true_zero(&mut self, gl: &Gl, target: u32, call: &mut dyn FnMut()) {
        let f = &self.state.framebuffers;
        let draw = [c::FRAMEBUFFER, c::DRAW_FRAMEBUFFER].contains(&target) && f.draw.is_zero();
        let read = target == c::READ_FRAMEBUFFER && f.read.is_zero();
        if draw {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, FramebufferName::ZERO);
        }
        if read {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
        }
        call();
        self.bind_draw(gl, draw, read);
    }

    /// glDrawBuffer, or glDrawBuffers (`several`), for framebuffer 0. `None` where framebuffer 0 refuses a name: the caller then makes the
    /// call with the true framebuffer 0 bound, and the driver raises its error.
    pub fn draw_buffers(&mut self, gl: &Gl, buffers: &[u32], several: bool) -> Option<()> {
        // Names of more than one buffer, which glDrawBuffers does not take.
        let many = [c::FRONT, c::LEFT, c::RIGHT, c::FRONT_AND_BACK];
        let f = &mut self.state.framebuffers;
        let refused = |b: &u32| f.images(*b).is_none() || (several && many.contains(b));
        let image = |b: &u32| f.images(*b).and_then(<[u32]>::first).copied();
        let twice = |(i, b): (usize, &u32)| {
            image(b).is_some() && buffers[..i].iter().any(|other| image(other) == image(b))
        };
        // OpenGL ES takes one name for framebuffer 0.
        if f.names_one() && buffers.len() != 1 {
            return None;
        }
        if buffers.iter().any(refused) || buffers.iter().enumerate().any(twice) {
            return None;
        }
        f.draw_to(buffers);
        self.apply_buffers(gl);
        Some(())
    }

    /// glDrawBuffer or glDrawBuffers with a name that the layer does not know: the driver decides. OSMesa takes the names of a back buffer
    /// for its only buffer too.
    pub fn other_draw_buffers(
        &mut self,
        gl: &Gl,
        target: u32,
        buffers: &[u32],
        call: &mut dyn FnMut(),
    ) {
        let mut taken = false;
        let (default, es) = (self.state.window.buffers.default_draw, gl.is_es());
        self.with_true_zero(gl, target, &mut || {
            call();
            let is = |(i, b): (u32, &u32)| gl.get_integer(c::DRAW_BUFFER0 + i) as u32 == *b;
            taken = !es && !buffers.is_empty() && (0..).zip(buffers).all(is);
            if taken && buffers != [default] {
                gl.draw_buffer(default);
            }
        });
        if taken && target != 0 {
            self.state.framebuffers.draw_buffers = buffers.to_vec();
            self.apply_buffers(gl);
        }
    }

    /// glReadBuffer for framebuffer 0 with a name that the layer does not know: the driver decides. Mesa takes GL_FRONT_AND_BACK in contexts with fixed function.
    pub fn other_read_buffer(&mut self, gl: &Gl, buffer: u32, call: &mut dyn FnMut()) {
        let (default, read) = (
            self.state.window.buffers.default_draw,
            self.state.framebuffers.read,
        );
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
        call();
        let taken = gl.get_integer(c::READ_BUFFER) as u32 == buffer;
        if taken && buffer != default {
            gl.read_buffer(default);
        }
        match read {
            FramebufferName::ZERO => self.bind_draw(gl, false, true),
            read => gl.bind_framebuffer(c::READ_FRAMEBUFFER, read),
        }
        if taken {
            self.state.framebuffers.read_buffer = buffer;
            self.apply_buffers(gl);
        }
    }

    /// glReadBuffer for framebuffer 0; `None` as for [`Layer::draw_buffers`].
    pub fn read_buffer(&mut self, gl: &Gl, buffer: u32) -> Option<()> {
        let f = &mut self.state.framebuffers;
        f.images(buffer).filter(|_| buffer != c::FRONT_AND_BACK)?;
        f.read_buffer = buffer;
        self.apply_buffers(gl);
        Some(())
    }

    /// Runs `read`, which reads `image` of the atlas, whatever read buffer the program has chosen. Changes the read framebuffer.
    pub(super) fn reading<R>(
        &mut self,
        gl: &Gl,
        image: u32,
        read: impl FnOnce(&mut Self) -> R,
    ) -> R {
        if self.state.framebuffers.read_image() == image {
            return read(self);
        }
        self.read_from(gl, image);
        let r = read(self);
        self.read_from(gl, self.state.framebuffers.read_image());
        r
    }

    fn read_from(&self, gl: &Gl, image: u32) {
        if self.is_plain() {
            return;
        }
        for target in self.atlases().flat_map(Atlas::targets) {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, target);
            gl.read_buffer(image);
        }
    }

    /// Sets the program's draw and read buffers of framebuffer 0 in each framebuffer object of the atlas.
    pub(super) fn apply_buffers(&mut self, gl: &Gl) {
        if self.is_plain() && self.canvases.is_aside() {
            // The draw buffers are those of another drawable.
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
            gl.read_buffer(self.state.framebuffers.read_buffer);
            return self.rebind(gl);
        }
        if self.is_plain() {
            return self.apply_plain_buffers(gl);
        }
        if self.state.framebuffers.uses_front()
            && !self.targets.atlas.has_front()
            && self.targets.atlas.tiles.grid.is_full()
        {
            self.leave_mono(gl);
            self.state.keep_errors(gl);
            let (names, window) = (&mut self.targets.names, &self.state.window);
            let swapped = self.diagnostics.report.frames() > 0;
            let make = || self.targets.atlas.make_front(gl, names, window, swapped);
            if !with_raw_copies(gl, || keep_bindings(gl, make)) {
                return self.become_plain(gl);
            }
        }
        let f = &self.state.framebuffers;
        if f.uses_front() && !self.targets.atlas.tiles.grid.is_full() {
            self.state.keep_errors(gl);
            // Both call `apply_buffers` again, for the new atlas.
            self.hold_everything(gl, Unrepresentable::FrontBuffer);
            if self.targets.stuck {
                self.become_plain(gl);
            }
            return;
        }
        let f = &self.state.framebuffers;
        let (draw, read) = (f.draw_images(), f.read_image());
        let (bound_draw, bound_read) = (
            FramebufferName(gl.get_integer(c::DRAW_FRAMEBUFFER_BINDING) as u32),
            FramebufferName(gl.get_integer(c::READ_FRAMEBUFFER_BINDING) as u32),
        );
        for target in self.atlases().flat_map(Atlas::targets) {
            gl.bind_framebuffer(c::FRAMEBUFFER, target);
            gl.draw_buffers(&draw);
            gl.read_buffer(read);
        }
        self.apply_read_buffer(gl, read);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, bound_draw);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, bound_read);
    }

    /// Sets the program's read buffer in the drawable that is read from, where that is another one than is drawn to. `image` is that of the
    /// atlas. Binds framebuffers for reading.
    fn apply_read_buffer(&self, gl: &Gl, image: u32) {
        let read = self.canvases.read().filter(|read| !read.is_plain());
        match (self.canvases.reading(), read) {
            (Reading::Drawn, _) => {}
            (_, Some(read)) => {
                let image = match image {
                    FRONT if !read.has_front() => BACK,
                    image => image,
                };
                for target in read.targets() {
                    gl.bind_framebuffer(c::READ_FRAMEBUFFER, target);
                    gl.read_buffer(image);
                }
            }
            (_, None) => {
                gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
                gl.read_buffer(self.state.framebuffers.read_buffer);
            }
        }
    }

    /// Sets the program's draw and read buffers of framebuffer 0 in the true one.
    pub(super) fn apply_plain_buffers(&mut self, gl: &Gl) {
        let f = &self.state.framebuffers;
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        match f.draw_buffers.as_slice() {
            // The plain call takes names that stand for two buffers, the other one does not.
            [one] if !gl.is_es() => gl.draw_buffer(*one),
            several => gl.draw_buffers(several),
        }
        gl.read_buffer(f.read_buffer);
        self.apply_read_buffer(gl, f.read_image());
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, f.draw);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, f.read);
        self.bind_draw(gl, true, true);
    }

    /// Runs `f` with other framebuffers bound, for commands that take theirs by name.
    pub fn with_bound<R>(
        &mut self,
        gl: &Gl,
        draw: FramebufferName,
        read: Option<FramebufferName>,
        f: impl FnOnce(&mut Self) -> R,
    ) -> R {
        let old = (self.state.framebuffers.draw, self.state.framebuffers.read);
        let mut bind = |t, n| gl.bind_framebuffer(t, n);
        self.bind_framebuffer(c::DRAW_FRAMEBUFFER, draw, &mut bind);
        if let Some(read) = read {
            self.bind_framebuffer(c::READ_FRAMEBUFFER, read, &mut bind);
        }
        let r = f(self);
        self.bind_framebuffer(c::DRAW_FRAMEBUFFER, old.0, &mut bind);
        if read.is_some() {
            self.bind_framebuffer(c::READ_FRAMEBUFFER, old.1, &mut bind);
        }
        r
    }

    /// Whether the first draw buffer of framebuffer 0, which is bound, names two buffers of the atlas.
    pub fn draws_to_two_buffers(&self) -> bool {
        let f = &self.state.framebuffers;
        f.draw.is_zero()
            && f.draw_buffers.len() == 1
            && f.draw_images().len() > 1
            && !self.is_plain()
    }

    /// Whether framebuffer 0 is bound for drawing.
    pub fn draws_to_zero(&self) -> bool {
        self.state.framebuffers.draw.is_zero()
    }

    /// Whether framebuffer 0 is bound for reading.
    pub fn reads_from_zero(&self) -> bool {
        self.state.framebuffers.read.is_zero()
    }

    /// The answer of glGet for state that the layer stands in for: framebuffer bindings, framebuffer 0, the list that is compiled, formats of
    /// program binaries. None for all other names.
    pub fn answer(&self, name: u32) -> Option<i64> {
        let f = &self.state.framebuffers;
        let zero = f.draw.is_zero();
        let es = self.state.window.buffers.es;
        match (name, &self.state.list) {
            (c::LIST_INDEX, Some(list)) => return Some(list.list.0.into()),
            (c::LIST_MODE, Some(list)) => return Some(list.mode.into()),
            // No variant can be made from a program binary. Without a format for binaries programs come with their sources.
            (c::NUM_PROGRAM_BINARY_FORMATS, _) if self.refuses_binaries() => return Some(0),
            _ => {}
        }
        // The drawable that is read may have an atlas where the one that is drawn to has none.
        let reads = self.reads_views() || !self.is_plain();
        match name {
            c::READ_FRAMEBUFFER_BINDING if reads => Some(f.read.0.into()),
            c::READ_BUFFER if reads && f.read.is_zero() => self.buffer_of_zero(name),
            _ if self.is_plain() => None,
            c::STEREO if self.state.window.buffers.eyes => Some(1),
            c::DRAW_FRAMEBUFFER_BINDING => Some(f.draw.0.into()),
            c::DRAW_BUFFER if zero && !es => self.buffer_of_zero(name),
            c::DRAW_BUFFER0..=c::DRAW_BUFFER15 if zero => self.buffer_of_zero(name),
            c::ACCUM_RED_BITS..=c::ACCUM_ALPHA_BITS if zero && !es => {
                let at = (name - c::ACCUM_RED_BITS) as usize;
                let bits = self.state.window.accumulation.get(at);
                bits.map(|&bits| bits.into())
            }
            c::DOUBLEBUFFER if zero && !es => {
                Some(self.state.window.buffers.double_buffered.into())
            }
            _ => None,
        }
    }

    /// A draw or read buffer of framebuffer 0, whatever is bound. None for other names, and where framebuffer 0 is the true one.
    pub fn answer_of_zero(&self, name: u32) -> Option<i64> {
        self.buffer_of_zero(name).filter(|_| !self.is_plain())
    }

    fn buffer_of_zero(&self, name: u32) -> Option<i64> {
        let f = &self.state.framebuffers;
        let drawn = |i: usize| f.draw_buffers.get(i).copied().unwrap_or(c::NONE);
        let buffer = match name {
            c::READ_BUFFER => f.read_buffer,
            c::DRAW_BUFFER => drawn(0),
            c::DRAW_BUFFER0..=c::DRAW_BUFFER15 => drawn((name - c::DRAW_BUFFER0) as usize),
            _ => return None,
        };
        Some(buffer.into())
    }

    /// Runs a call with viewport and scissor set for a view's tile, where tiles lie beside each other or have other samples than the window's
    /// pixels. `x` is the left edge of the tile in pixels.
    pub(super) fn scissored(&self, gl: &Gl, view: ViewIndex, x: i32, call: &mut dyn FnMut()) {
        if self.targets.atlas.tiles.columns == 1 && self.targets.atlas.tiles.grid.is_full() {
            return call();
        }
        crate::draw::set_tile_viewport(gl, &self.state, &self.targets.atlas.tiles, view, x);
        call();
        self.state.rectangles.put(gl);
    }

    pub(super) fn tile_size(&self) -> [i32; 2] {
        [
            self.targets.atlas.tiles.width as i32,
            self.targets.atlas.tiles.height as i32,
        ]
    }

    /// The atlas, for tests of what it holds.
    pub fn atlas(&self) -> &Atlas {
        &self.targets.atlas
    }
}
