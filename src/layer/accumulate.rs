//! glAccum and glClear: the accumulation buffer of framebuffer 0, which the atlas does not have.

use super::Layer;
use super::draw::Request;
use super::reading::Reading;
use crate::accumulation::{Accumulation, Operation, Region};
use crate::atlas::ViewSet;
use crate::gl::{Gl, TextureName, consts as c};
use crate::plan::Kind;
use crate::state::Neutral;
use crate::state::{Command, Run, Touch};

/// The bits of glClear.
const BUFFERS: u32 =
    c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT | c::ACCUM_BUFFER_BIT;

/// The accumulation buffer of a context.
#[derive(Debug, Default)]
pub(super) struct Accumulated {
    /// Made when it is first needed.
    pub(super) buffer: Option<Accumulation>,
    /// What it was cleared to before it was made.
    cleared: [f32; 4],
    failed: bool,
}

impl Layer {
    /// glClear; `call` is the program's own.
    pub fn clear(&mut self, gl: &Gl, mask: u32, call: &mut dyn FnMut()) {
        let accumulation = mask & c::ACCUM_BUFFER_BIT != 0 && mask & !BUFFERS == 0;
        if accumulation && self.compiles() {
            self.compile(gl, Command::Of(Run::ClearAll), Touch::NONE);
            call();
            return self.compiled_names(&[mask]);
        }
        let depths = mask & c::DEPTH_BUFFER_BIT != 0;
        self.draw(
            gl,
            Kind::Clear {
                depths,
                whole: mask,
            },
            call,
        );
        if accumulation && self.accumulates(gl) {
            let values = gl.get_floats(c::ACCUM_CLEAR_VALUE);
            self.accumulate(gl, Operation::Clear(values));
        }
    }

    /// glAccum; `call` is the program's own.
    pub fn accum(&mut self, gl: &Gl, op: u32, value: f32, call: &mut dyn FnMut()) {
        if self.compiles() {
            self.compile(gl, Command::Of(Run::Accum), Touch::NONE);
            call();
            return self.compiled_names(&[op, value.to_bits()]);
        }
        if !self.draws_to_zero() || self.is_plain() {
            return call();
        }
        let mask: [i32; 4] = gl.get_integers_indexed(c::COLOR_WRITEMASK, 0);
        let operation = Operation::of(op, value, mask.map(|m| m != 0))
            .filter(|_| self.state.window.accumulates() && self.reads_from_zero())
            // The driver refuses two drawables.
            .filter(|_| self.canvases.reading() == Reading::Drawn);
        let Some(operation) = operation else {
            // The driver raises the error.
            return self.with_true_zero(gl, c::DRAW_FRAMEBUFFER, call);
        };
        let f = &self.state.framebuffers;
        let nothing = match operation {
            Operation::Load(_) | Operation::Accumulate(_) => f.read_image() == c::NONE,
            Operation::Return(..) => f.draw_images().iter().all(|&i| i == c::NONE),
            _ => false,
        };
        if self.accumulates(gl) && !nothing {
            self.decide(gl, &Request::of(Kind::Accum));
            self.accumulate(gl, operation);
        }
    }

    /// Whether glAccum and glClear now reach the accumulation buffer of framebuffer 0.
    fn accumulates(&self, gl: &Gl) -> bool {
        self.state.window.accumulates()
            && !self.is_plain()
            && self.state.draws_to_window()
            && !gl.is_enabled(c::RASTERIZER_DISCARD)
    }

    fn accumulate(&mut self, gl: &Gl, operation: Operation) {
        self.state.refresh(gl);
        self.leave_mono(gl);
        if let (None, Operation::Clear(values)) = (&self.targets.accumulated.buffer, operation)
            && !self.state.rectangles.scissor_test
        {
            self.targets.accumulated.cleared = values;
            return;
        }
        self.in_neutral(gl, |layer, neutral| {
            layer.apply_accumulation(gl, operation, neutral);
        });
    }

    fn apply_accumulation(&mut self, gl: &Gl, operation: Operation, neutral: &Neutral) {
        if let Operation::Load(_) | Operation::Accumulate(_) = operation {
            self.targets
                .atlas
                .resolve(gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
        }
        let regions = self.regions();
        if self.targets.accumulated.buffer.is_none() && !self.targets.accumulated.failed {
            self.make_accumulation(gl, neutral);
        }
        if let Some(buffer) = &mut self.targets.accumulated.buffer {
            let (window, f) = (&self.state.window, &self.state.framebuffers);
            let from = self.targets.atlas.sampled(f.read_image());
            let images = f.draw_images().into_iter().filter(|&i| i != c::NONE);
            let to: Vec<TextureName> = images.map(|i| self.targets.atlas.drawn(i)).collect();
            buffer.apply(gl, neutral, operation, window, (from, &to), &regions);
        }
    }

    fn make_accumulation(&mut self, gl: &Gl, neutral: &Neutral) {
        self.state.keep_errors(gl);
        let made = Accumulation::new(
            gl,
            neutral,
            &mut self.targets.names,
            self.session.support.glsl,
            &self.targets.atlas,
        );
        let made = match (made, gl.drop_errors()) {
            (Ok(made), 1..) => {
                made.delete(gl);
                Err("the driver makes no image for it, perhaps for lack of memory".into())
            }
            (made, _) => made,
        };
        match made {
            Ok(mut made) => {
                let whole = self.rows();
                let clear = Operation::Clear(self.targets.accumulated.cleared);
                made.apply(
                    gl,
                    neutral,
                    clear,
                    &self.state.window,
                    (TextureName::ZERO, &[]),
                    &whole,
                );
                self.targets.accumulated.buffer = Some(made);
            }
            Err(e) => {
                self.targets.accumulated.failed = true;
                self.diagnostics
                    .report
                    .note(format!("glAccum has no effect: {e}"));
            }
        }
    }

    /// The regions of all layers of the atlas, each as a whole.
    fn rows(&self) -> Vec<Region> {
        let t = &self.targets.atlas.tiles;
        let rect = [0, 0, t.texture_width() as i32, t.height as i32];
        (0..t.rows).map(|row| Region { row, rect }).collect()
    }

    /// The regions that the scissor test leaves of the tiles.
    fn regions(&self) -> Vec<Region> {
        if !self.state.rectangles.scissor_test {
            return self.rows();
        }
        let tiles = self.targets.atlas.tiles;
        let size = self.tile_size();
        let cut = tiles.order().map(|view| {
            let (row, x) = tiles.place(view);
            let [x, y, w, h] = crate::draw::cut(&self.state, &tiles, view, x as i32);
            let y = if self.targets.atlas.flipped {
                size[1] - y - h
            } else {
                y
            };
            let rect = [x, y, w, h];
            Region { row, rect }
        });
        cut.filter(|r| r.rect[2] > 0 && r.rect[3] > 0).collect()
    }
}
