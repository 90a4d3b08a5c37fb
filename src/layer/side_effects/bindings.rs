//! What the program has bound for shaders to write to, as far as it is known.

use crate::gl::{BindingPoint, BoundRange, BufferName, Gl, ImageUnit, TextureName, consts as c};
use rustc_hash::{FxHashMap, FxHashSet};

/// Buffers and images that are bound for shaders to write to, and the buffers of other views.
#[derive(Debug, Default)]
pub(in crate::layer) struct WriteBindings {
    /// All binding points that the program has used; none where the driver has to be asked what is bound there.
    pub(super) points: FxHashMap<BindingPoint, Option<BoundRange>>,
    /// Buffers that the driver has bound before.
    pub(super) confirmed: FxHashSet<BufferName>,
    /// Targets at which a command may have bound a buffer that the driver has refused.
    pub(super) doubtful: FxHashSet<u32>,
    /// The bytes of buffers, and [`store_change`] when the driver was asked.
    pub(super) sizes: FxHashMap<BufferName, (u64, usize)>,
    /// Buffers of the layer with their bytes, one for each binding point of a draw.
    pub(super) scratch: Vec<(BufferName, usize)>,
    /// What is bound to image units, as far as the driver was asked.
    pub(super) images: FxHashMap<u32, Option<ImageUnit>>,
    /// Textures that cannot differ between the views.
    pub(super) refused: FxHashSet<TextureName>,
}

impl WriteBindings {
    /// The program binds a range of a buffer. What the driver may refuse is asked about when it is needed.
    pub(in crate::layer) fn binds(&mut self, point: BindingPoint, range: BoundRange) {
        let points = match point.target {
            c::SHADER_STORAGE_BUFFER => 8,
            _ => 1,
        };
        let taken = range.buffer.is_zero() || self.confirmed.contains(&range.buffer);
        let fits = range.start.is_multiple_of(256) && range.size != Some(0);
        let sure = taken && fits && point.index < points;
        self.points.insert(point, sure.then_some(range));
        if !sure {
            self.doubtful.insert(point.target);
        }
    }

    /// The program binds a buffer at a target alone.
    pub(in crate::layer) fn binds_alone(&mut self, target: u32) {
        self.doubtful.remove(&target);
    }

    /// Buffers are deleted, which unbinds them.
    pub(in crate::layer) fn deleted(&mut self, names: &[BufferName]) {
        for name in names {
            self.confirmed.remove(name);
            self.sizes.remove(name);
        }
        for range in self.points.values_mut() {
            *range = range.filter(|range| !names.contains(&range.buffer));
        }
    }

    /// Textures are deleted, which unbinds them.
    pub(in crate::layer) fn deleted_textures(&mut self, names: &[TextureName]) {
        self.images
            .retain(|_, image| image.is_none_or(|image| !names.contains(&image.texture)));
        self.refused.retain(|name| !names.contains(name));
    }

    /// Whether anything is known of image units.
    pub(in crate::layer) fn has_images(&self) -> bool {
        !self.images.is_empty()
    }

    pub(super) fn range(&mut self, gl: &Gl, point: BindingPoint) -> BoundRange {
        let known = self.points.entry(point).or_default();
        let range = *known.get_or_insert_with(|| gl.bound_range(point));
        self.confirmed.insert(range.buffer);
        range
    }

    /// What is bound to an image unit; none for nothing.
    pub(in crate::layer) fn image(&mut self, gl: &Gl, unit: u32) -> Option<ImageUnit> {
        let known = self.images.entry(unit);
        *known.or_insert_with(|| gl.image_unit(unit))
    }

    /// Takes the buffers of the layer, to delete them.
    pub(in crate::layer) fn take_buffers(&mut self) -> Vec<BufferName> {
        let all = std::mem::take(&mut self.scratch).into_iter();
        all.map(|(buffer, _)| buffer).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gl::fake::Fake;

    const POINT: BindingPoint = BindingPoint {
        target: c::SHADER_STORAGE_BUFFER,
        index: 3,
    };

    /// What a driver may refuse is asked about, once.
    #[test]
    fn bindings_are_known_once_the_driver_has_taken_the_buffer() {
        let (fake, mut memory) = (Fake::new(), WriteBindings::default());
        let gl = fake.gl();
        let asked = |memory: &mut WriteBindings| {
            fake.forget();
            memory.range(&gl, POINT);
            fake.count("glGet*") > 0
        };
        memory.binds(POINT, BoundRange::whole(BufferName(7)));
        assert!(asked(&mut memory), "the driver may have no buffer 7");
        assert!(!asked(&mut memory));
        memory.confirmed.insert(BufferName(7));
        memory.binds(POINT, BoundRange::part(BufferName(7), 512, 64));
        assert!(!asked(&mut memory));
        for refused in [
            BoundRange::part(BufferName(7), 4, 64),
            BoundRange::part(BufferName(7), 0, 0),
            BoundRange::whole(BufferName(8)),
        ] {
            memory.binds(POINT, refused);
            assert!(asked(&mut memory), "{refused:?}");
        }
        memory.binds(POINT, BoundRange::whole(BufferName(7)));
        memory.deleted(&[BufferName(7)]);
        assert!(asked(&mut memory), "it is unbound");
        memory.binds(POINT, BoundRange::whole(BufferName(0)));
        assert!(!asked(&mut memory));
    }
}
