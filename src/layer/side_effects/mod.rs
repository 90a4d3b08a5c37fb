//! Side effects of draws happen once: shaders that write to buffers, images or counters do so for the program's own view.
//!
//! A draw of another view has copies of the buffers in the place of those that it writes to, which begin with the same contents and are
//! forgotten after it, and textures of its own in the place of images, which it keeps, as those that it draws to.

mod bindings;
mod redirection;

pub(super) use bindings::WriteBindings;
pub(super) use redirection::{Redirection, ViewMatrix};

use super::{Layer, keep_bindings};
use crate::gl::{
    BindingPoint, BoundRange, BufferName, Gl, ImageUnit, Object, ProgramName, TextureName,
    consts as c,
};
use crate::state::{SideEffects, store_change};
use redirection::Redirected;
use std::sync::Arc;

/// Image units that a program pipeline may use: OpenGL has at least so many.
const PIPELINE_UNITS: u32 = 8;

/// A uniform block that each view has of its own.
#[derive(Clone, Debug)]
pub(super) struct ViewBlock {
    pub(super) point: BindingPoint,
    /// The program's buffer there.
    pub(super) range: BoundRange,
    pub(super) matrices: Vec<ViewMatrix>,
}

impl Layer {
    /// Where the shaders that are in use write to; none where that is nowhere.
    fn side_effects(&self) -> Option<&SideEffects> {
        static ANYTHING: SideEffects = SideEffects::ANYTHING;
        let in_use = &self.state.in_use;
        let effects = match (in_use.program, in_use.pipeline) {
            (ProgramName::ZERO, 0) => return None,
            // Nothing is known of a program pipeline.
            (ProgramName::ZERO, _) => Some(&ANYTHING),
            (program, _) => self.variants.own.effects(program),
        };
        effects.filter(|effects| !effects.is_empty())
    }

    /// Textures are about to be bound to so many image units, counted from 0.
    pub fn images_change(&mut self, first: u32, count: i32) {
        let end = first.saturating_add(count.max(0) as u32);
        let images = &mut self.write_bindings.images;
        images.retain(|unit, _| !(first..end).contains(unit));
    }

    /// Whether the shaders that are in use may write to memory.
    pub(in crate::layer) fn writes_memory(&self) -> bool {
        self.side_effects().is_some()
    }

    /// Whether the shaders that are in use may store to images.
    pub(in crate::layer) fn stores_to_images(&self) -> bool {
        self.side_effects().is_some_and(|effects| effects.images)
    }

    /// What a draw may load from and store to by image units. Where it stores, each view has a texture of its own from now on, if it can.
    pub(in crate::layer) fn image_units(&mut self, gl: &Gl) -> Arc<[ImageUnit]> {
        let program = self.state.in_use.program;
        let stores = self.stores_to_images();
        if !stores && !self.has_copies() {
            return Arc::default();
        }
        let images: Arc<[ImageUnit]> = match program {
            ProgramName::ZERO if stores => self.pipeline_images(gl).into(),
            ProgramName::ZERO => return Arc::default(),
            program => self.images_of(gl, program).into(),
        };
        for image in images.iter().filter(|image| stores && image.is_written()) {
            self.split_image(gl, image.texture);
        }
        images
    }

    /// What a program pipeline may load from and store to.
    pub(in crate::layer) fn pipeline_images(&mut self, gl: &Gl) -> Vec<ImageUnit> {
        if !gl.has_images() {
            return Vec::new();
        }
        let units = 0..PIPELINE_UNITS;
        units
            .filter_map(|unit| self.write_bindings.image(gl, unit))
            .collect()
    }

    /// Gives each view a texture of its own.
    pub(in crate::layer) fn split_image(&mut self, gl: &Gl, name: TextureName) {
        let split = self.targets.offscreen.has(Object::Texture(name));
        if split || self.write_bindings.refused.contains(&name) {
            return;
        }
        self.state.keep_errors(gl);
        gl.finish_writes_to_textures();
        let (offscreen, names) = (&mut self.targets.offscreen, &mut self.targets.names);
        let made = keep_bindings(gl, || offscreen.split_named(gl, names, name));
        if gl.drop_errors() > 0 {
            // There is no memory for all views.
            offscreen.forget(gl, [Object::Texture(name)]);
        } else if made {
            return;
        }
        self.write_bindings.refused.insert(name);
    }

    /// Where the draw of each view writes to, and the uniform blocks that each has of its own.
    pub(in crate::layer) fn redirect(
        &mut self,
        gl: &Gl,
        units: &[ImageUnit],
        blocks: Vec<ViewBlock>,
    ) -> Redirection {
        let effects = self.side_effects();
        if effects.is_none() && units.is_empty() && blocks.is_empty() {
            return Redirection::default();
        }
        let effects = effects.cloned().unwrap_or_default();
        let offscreen = &mut self.targets.offscreen;
        let mut images = Vec::new();
        for image in units {
            let views = offscreen.views(image.texture);
            let stores = effects.images && image.is_written();
            if stores && !views.is_empty() {
                offscreen.written(image.texture);
            }
            if stores || !views.is_empty() {
                images.push((*image, views));
            }
        }
        let points = match effects.everything {
            true => self.write_bindings.points.keys().copied().collect(),
            false => effects.points(gl, self.state.in_use.program),
        };
        let ranges = points
            .into_iter()
            .map(|p| (p, self.write_bindings.range(gl, p)));
        let ranges = ranges.filter(|(_, range)| !range.buffer.is_zero());
        let mut ranges: Vec<(BindingPoint, BoundRange)> = ranges.collect();
        ranges.extend(blocks.iter().map(|block| (block.point, block.range)));
        let matrices = |point| {
            let block = blocks.iter().find(|block| block.point == point);
            block.map_or_else(Vec::new, |block| block.matrices.clone())
        };
        let mut redirection = Redirection {
            images,
            ..Redirection::default()
        };
        if ranges.is_empty() {
            return redirection;
        }
        redirection.bound = self.copy_bindings(gl, &ranges);
        for (at, &(point, range)) in ranges.iter().enumerate() {
            let bytes = self.bytes_of(gl, &range);
            let scratch = self.scratch(gl, at, bytes);
            redirection.buffers.push(Redirected {
                point,
                range,
                bytes,
                scratch,
                matrices: matrices(point),
            });
        }
        // The targets of copies have had other buffers, to ask for sizes and to make stores.
        redirection.away = true;
        redirection
    }

    /// A fault has interrupted a draw: binds what the program has bound. Raises errors on a context that lacks some of the targets.
    pub(in crate::layer) fn put_write_bindings(&mut self, gl: &Gl) {
        for image in self.write_bindings.images.values().flatten() {
            gl.bind_image(image, image.texture);
        }
        if self.write_bindings.scratch.is_empty() {
            return;
        }
        for (&point, range) in &self.write_bindings.points {
            range.iter().for_each(|range| gl.bind_range(point, range));
        }
        for (point, range) in self.blocks.bindings() {
            gl.bind_range(point, range);
        }
        for target in [
            c::COPY_READ_BUFFER,
            c::COPY_WRITE_BUFFER,
            c::UNIFORM_BUFFER,
            c::SHADER_STORAGE_BUFFER,
            c::ATOMIC_COUNTER_BUFFER,
        ] {
            gl.bind_buffer(target, self.blocks.bound_at(target));
        }
    }

    /// What the program has bound at the targets of copies between buffers, and at those of `ranges`.
    pub(in crate::layer) fn copy_bindings(
        &mut self,
        gl: &Gl,
        ranges: &[(BindingPoint, BoundRange)],
    ) -> Vec<(u32, BufferName)> {
        let mut targets = vec![c::COPY_READ_BUFFER, c::COPY_WRITE_BUFFER];
        targets.extend(ranges.iter().map(|(point, _)| point.target));
        targets.sort_unstable();
        targets.dedup();
        let bound = targets.into_iter().map(|target| {
            let known = self.blocks.bound_at(target);
            let sure = !self.write_bindings.doubtful.contains(&target)
                && (known.is_zero() || self.write_bindings.confirmed.contains(&known));
            if sure {
                return (target, known);
            }
            let binding = crate::gl::buffer_binding(target).unwrap_or(target);
            let buffer = BufferName(gl.get_integer(binding) as u32);
            self.write_bindings.confirmed.insert(buffer);
            self.write_bindings.doubtful.remove(&target);
            self.blocks.set_bound(target, buffer);
            (target, buffer)
        });
        bound.collect()
    }

    /// The bytes of a range, up to the end of its buffer.
    fn bytes_of(&mut self, gl: &Gl, range: &BoundRange) -> usize {
        if let Some(size) = self.buffers().size(range.buffer) {
            let left = size.saturating_sub(range.start);
            return range.size.map_or(left, |size| size.min(left));
        }
        let now = store_change();
        let known = self.write_bindings.sizes.get(&range.buffer);
        let whole = match known {
            Some(&(then, size)) if then == now => size,
            _ => {
                gl.bind_buffer(c::COPY_READ_BUFFER, range.buffer);
                let size = gl.buffer_size(c::COPY_READ_BUFFER);
                self.write_bindings.sizes.insert(range.buffer, (now, size));
                size
            }
        };
        let left = whole.saturating_sub(range.start);
        range.size.map_or(left, |size| size.min(left))
    }

    /// A buffer of the layer with room for so many bytes; 0 where there is no memory for it.
    pub(in crate::layer) fn scratch(&mut self, gl: &Gl, at: usize, bytes: usize) -> BufferName {
        if bytes == 0 {
            return BufferName::ZERO;
        }
        let all = &mut self.write_bindings.scratch;
        while all.len() <= at {
            all.push((gl.gen_buffer(), 0));
        }
        if all[at].1 < bytes {
            self.state.keep_errors(gl);
            gl.bind_buffer(c::COPY_WRITE_BUFFER, all[at].0);
            gl.buffer_data_for_shaders(c::COPY_WRITE_BUFFER, bytes);
            let refused = gl.drop_errors() > 0;
            all[at].1 = if refused { 0 } else { bytes };
            if refused {
                return BufferName::ZERO;
            }
        }
        all[at].0
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::bench::Bench;
    use super::*;

    /// A command that the driver may refuse is asked about once, not by each draw.
    #[test]
    fn what_is_bound_is_asked_once() {
        let mut bench = Bench::new(&[]);
        let point = BindingPoint {
            target: c::SHADER_STORAGE_BUFFER,
            index: 3,
        };
        let range = BoundRange::whole(BufferName(7));
        bench
            .layer
            .binds_buffer_at(point.target, point.index, range, true);
        let asked = |bench: &mut Bench| {
            bench.fake.forget();
            bench.layer.copy_bindings(&bench.gl, &[(point, range)]);
            bench.fake.count("glGet*")
        };
        assert_eq!([asked(&mut bench), asked(&mut bench)], [1, 0]);
        bench.layer.binds_buffer(c::COPY_READ_BUFFER, BufferName(8));
        assert_eq!([asked(&mut bench), asked(&mut bench)], [1, 0]);
    }
}
