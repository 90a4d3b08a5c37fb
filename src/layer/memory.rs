//! Side effects of draws happen once: shaders that write to buffers, images or counters do so for the program's own view.
//!
//! A draw of another view has copies of the buffers in the place of those that it writes to, which begin with the same contents and are
//! forgotten after it, and textures of its own in the place of images, which it keeps, as those that it draws to.

use super::{Layer, keep_bindings};
use crate::gl::{
    BindingPoint, BoundRange, BufferName, Gl, ImageUnit, Object, ProgramName, TextureName,
    consts as c,
};
use crate::state::{SideEffects, store_change};
use crate::view::ViewIndex;
use rustc_hash::{FxHashMap, FxHashSet};
use std::sync::Arc;

/// Image units that a program pipeline may use: OpenGL has at least so many.
const PIPELINE_UNITS: u32 = 8;

/// Buffers and images that are bound for shaders to write to, and the buffers of other views.
#[derive(Debug, Default)]
pub(super) struct Memory {
    /// All binding points that the program has used; none where the driver has to be asked what is bound there.
    points: FxHashMap<BindingPoint, Option<BoundRange>>,
    /// Buffers that the driver has bound before.
    confirmed: FxHashSet<BufferName>,
    /// The bytes of buffers, and [`store_change`] when the driver was asked.
    sizes: FxHashMap<BufferName, (u64, usize)>,
    /// Buffers of the layer with their bytes, one for each binding point of a draw.
    scratch: Vec<(BufferName, usize)>,
    /// What is bound to image units, as far as the driver was asked.
    images: FxHashMap<u32, Option<ImageUnit>>,
    /// Textures that cannot differ between the views.
    refused: FxHashSet<TextureName>,
}

/// A buffer that a draw of another view writes to in the place of the program's.
#[derive(Debug)]
struct Redirected {
    point: BindingPoint,
    /// The program's.
    range: BoundRange,
    bytes: usize,
    /// The layer's; 0 where there is no memory for one.
    scratch: BufferName,
}

/// Where the draw of each view writes to.
#[derive(Debug, Default)]
pub(super) struct Redirection {
    buffers: Vec<Redirected>,
    /// Images that are stored to or differ, with the texture of each view; without any where they cannot differ.
    images: Vec<(ImageUnit, Vec<TextureName>)>,
    /// Bindings of the program that are used to copy, by target.
    bound: Vec<(u32, BufferName)>,
    /// Others than the program's are bound.
    away: bool,
}

impl Memory {
    /// The program binds a range of a buffer. What the driver may refuse is asked about when it is needed.
    pub(super) fn binds(&mut self, point: BindingPoint, range: BoundRange) {
        let points = match point.target {
            c::SHADER_STORAGE_BUFFER => 8,
            _ => 1,
        };
        let taken = range.buffer.is_zero() || self.confirmed.contains(&range.buffer);
        let fits = range.start.is_multiple_of(256) && range.size != Some(0);
        let sure = taken && fits && point.index < points;
        self.points.insert(point, sure.then_some(range));
    }

    /// Buffers are deleted, which unbinds them.
    pub(super) fn deleted(&mut self, names: &[BufferName]) {
        for name in names {
            self.confirmed.remove(name);
            self.sizes.remove(name);
        }
        for range in self.points.values_mut() {
            *range = range.filter(|range| !names.contains(&range.buffer));
        }
    }

    /// Textures are bound to image units, or deleted.
    pub(super) fn forget_images(&mut self) {
        self.images.clear();
        self.refused.clear();
    }

    fn range(&mut self, gl: &Gl, point: BindingPoint) -> BoundRange {
        let known = self.points.entry(point).or_default();
        let range = *known.get_or_insert_with(|| gl.bound_range(point));
        self.confirmed.insert(range.buffer);
        range
    }

    /// What is bound to an image unit; none for nothing.
    pub(super) fn image(&mut self, gl: &Gl, unit: u32) -> Option<ImageUnit> {
        let known = self.images.entry(unit);
        *known.or_insert_with(|| gl.image_unit(unit))
    }

    /// Takes the buffers of the layer, to delete them.
    pub(super) fn take_buffers(&mut self) -> Vec<BufferName> {
        let all = std::mem::take(&mut self.scratch).into_iter();
        all.map(|(buffer, _)| buffer).collect()
    }
}

impl Redirection {
    /// Before a draw of a view: binds what it writes to.
    pub(super) fn enter(&mut self, gl: &Gl, view: ViewIndex, own: ViewIndex) {
        if self.buffers.is_empty() && self.images.is_empty() {
            return;
        }
        match view == own {
            true => self.put_buffers(gl),
            false => self.bind_scratch(gl),
        }
        for (image, views) in &self.images {
            let texture = views.get(view.0 as usize).copied();
            let without = match view == own {
                true => image.texture,
                false => TextureName::ZERO,
            };
            gl.bind_image(image, texture.unwrap_or(without));
        }
    }

    /// After the draw of all views: binds what the program has bound.
    pub(super) fn leave(mut self, gl: &Gl) {
        self.put_buffers(gl);
        for (image, _) in &self.images {
            gl.bind_image(image, image.texture);
        }
    }

    fn bind_scratch(&mut self, gl: &Gl) {
        if self.buffers.is_empty() {
            return;
        }
        self.away = true;
        gl.finish_writes_to_buffers();
        for buffer in &self.buffers {
            let whole = BoundRange {
                buffer: buffer.scratch,
                start: 0,
                size: (!buffer.scratch.is_zero()).then_some(buffer.bytes),
            };
            if !buffer.scratch.is_zero() {
                gl.bind_buffer(c::COPY_READ_BUFFER, buffer.range.buffer);
                gl.bind_buffer(c::COPY_WRITE_BUFFER, buffer.scratch);
                gl.copy_buffer(buffer.range.start, buffer.bytes);
            }
            gl.bind_range(buffer.point, &whole);
        }
    }

    fn put_buffers(&mut self, gl: &Gl) {
        if !std::mem::take(&mut self.away) {
            return;
        }
        for buffer in &self.buffers {
            gl.bind_range(buffer.point, &buffer.range);
        }
        for &(target, buffer) in &self.bound {
            gl.bind_buffer(target, buffer);
        }
    }
}

impl Layer {
    /// Where the shaders that are in use write to; none where that is nowhere.
    fn side_effects(&self) -> Option<Arc<SideEffects>> {
        let in_use = &self.state.in_use;
        let effects = match (in_use.program, in_use.pipeline) {
            (ProgramName::ZERO, 0) => return None,
            // Nothing is known of a program pipeline.
            (ProgramName::ZERO, _) => Some(Arc::new(SideEffects::anything())),
            (program, _) => self.variants.own.effects(program),
        };
        effects.filter(|effects| !effects.is_empty())
    }

    /// Textures are about to be bound to image units.
    pub fn images_change(&mut self) {
        self.memory.forget_images();
    }

    /// Whether the shaders that are in use may write to memory.
    pub(super) fn writes_memory(&self) -> bool {
        self.side_effects().is_some()
    }

    /// What a draw may load from and store to by image units. Where it stores, each view has a texture of its own from now on, if it can.
    pub(super) fn image_units(&mut self, gl: &Gl) -> Arc<[ImageUnit]> {
        let program = self.state.in_use.program;
        let pipeline = program.is_zero() && self.state.in_use.pipeline != 0;
        let units = match pipeline && gl.has_images() {
            true => (0..PIPELINE_UNITS).collect(),
            false => self.variants.own.image_units(gl, program),
        };
        let units = units.into_iter();
        let images = units.filter_map(|unit| self.memory.image(gl, unit));
        let images: Arc<[ImageUnit]> = images.collect();
        let stores = !images.is_empty() && self.side_effects().is_some_and(|e| e.images);
        for image in images.iter().filter(|image| stores && image.is_written()) {
            self.split_image(gl, image.texture);
        }
        images
    }

    /// Gives each view a texture of its own.
    pub(super) fn split_image(&mut self, gl: &Gl, name: TextureName) {
        let split = self.targets.offscreen.has(Object::Texture(name));
        if split || self.memory.refused.contains(&name) {
            return;
        }
        self.state.keep_errors(gl);
        let (offscreen, names) = (&mut self.targets.offscreen, &mut self.targets.names);
        let made = keep_bindings(gl, || offscreen.split_named(gl, names, name));
        self.drain_own_errors(gl);
        if !made {
            self.memory.refused.insert(name);
        }
    }

    /// Where the draw of each view writes to.
    pub(super) fn redirect(&mut self, gl: &Gl, units: &[ImageUnit]) -> Redirection {
        let effects = self.side_effects();
        if effects.is_none() && units.is_empty() {
            return Redirection::default();
        }
        let effects = effects.unwrap_or_default();
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
            true => self.memory.points.keys().copied().collect(),
            false => effects.points(gl, self.state.in_use.program),
        };
        let ranges = points.into_iter().map(|p| (p, self.memory.range(gl, p)));
        let ranges = ranges.filter(|(_, range)| !range.buffer.is_zero());
        let ranges: Vec<(BindingPoint, BoundRange)> = ranges.collect();
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
            });
        }
        // The size of a buffer and the store of another one may have been asked for by these.
        redirection.away = true;
        redirection
    }

    /// What the program has bound at the targets that a redirection uses.
    fn copy_bindings(
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
            let sure = known.is_zero() || self.memory.confirmed.contains(&known);
            if sure {
                return (target, known);
            }
            let binding = crate::gl::buffer_binding(target).unwrap_or(target);
            let buffer = BufferName(gl.get_integer(binding) as u32);
            self.memory.confirmed.insert(buffer);
            (target, buffer)
        });
        bound.collect()
    }

    /// The bytes of a range, up to the end of its buffer.
    fn bytes_of(&mut self, gl: &Gl, range: &BoundRange) -> usize {
        let now = store_change();
        let known = self.memory.sizes.get(&range.buffer);
        let whole = match known {
            Some(&(then, size)) if then == now => size,
            _ => {
                gl.bind_buffer(c::COPY_READ_BUFFER, range.buffer);
                let size = gl.buffer_size(c::COPY_READ_BUFFER);
                self.memory.sizes.insert(range.buffer, (now, size));
                size
            }
        };
        let left = whole.saturating_sub(range.start);
        range.size.map_or(left, |size| size.min(left))
    }

    /// A buffer of the layer with room for so many bytes; 0 where there is no memory for it.
    fn scratch(&mut self, gl: &Gl, at: usize, bytes: usize) -> BufferName {
        if bytes == 0 {
            return BufferName::ZERO;
        }
        let all = &mut self.memory.scratch;
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
