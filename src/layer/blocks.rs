//! Uniform blocks of the program's shaders: the buffers that are bound to them, and the matrices that are in those.

use super::side_effects::{ViewBlock, ViewMatrix};
use super::unprojections::Unprojections;
use super::{Layer, Member};
use crate::gl::{
    BindingPoint, BlockPlace, BoundRange, BufferName, Gl, Mapping, ProgramName, consts as c,
};
use crate::plan::{Shear, camera};
use crate::state::{Found, State, UniformBuffers, binding_change, block_changes, link_change};
use crate::view::ViewIndex;
use rustc_hash::FxHashMap;
use std::sync::MutexGuard;

/// How a command names a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BufferRef {
    /// It is bound at this target.
    Bound(u32),
    /// By its name.
    Named(BufferName),
}

/// Bindings of buffers in a context. A new context has none, so those that are not here are 0.
#[derive(Debug, Default)]
pub(super) struct Blocks {
    /// By target, but for GL_ELEMENT_ARRAY_BUFFER.
    bound: FxHashMap<u32, BufferName>,
    /// What is bound at binding points of uniform blocks. The driver is asked once for those that were bound unseen.
    points: FxHashMap<u32, BoundRange>,
    /// The binding points of a program's blocks, and the state of links and bindings when the driver was asked for them.
    programs: FxHashMap<ProgramName, ([u64; 2], Vec<u32>)>,
    /// The report says that cameras are read back.
    told: bool,
}

/// Reads the matrices of uniform blocks.
pub(super) struct BlockReader<'a> {
    pub(super) gl: &'a Gl,
    pub(super) blocks: &'a mut Blocks,
    pub(super) group: &'a Member,
    pub(super) state: &'a mut State,
    /// The driver had to be asked for a matrix that shaders had written.
    pub(super) reads_back: bool,
}

impl Blocks {
    /// The buffer that is bound at a target.
    pub(super) fn bound_at(&self, target: u32) -> BufferName {
        self.bound.get(&target).copied().unwrap_or_default()
    }

    /// The driver has told what is bound at a target.
    pub(super) fn set_bound(&mut self, target: u32, buffer: BufferName) {
        self.bound.insert(target, buffer);
    }

    /// The binding point of a uniform's block, and what is bound there.
    fn place(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        place: BlockPlace,
    ) -> Option<(u32, BoundRange)> {
        let now = [link_change(), binding_change()];
        let known = self.programs.entry(program).or_default();
        if known.0 != now {
            *known = (now, gl.block_bindings(program));
        }
        let point = *known.1.get(place.block as usize)?;
        let range = self.range(gl, point);
        (!range.buffer.is_zero()).then_some((point, range))
    }

    /// What is bound at a binding point.
    fn range(&mut self, gl: &Gl, point: u32) -> BoundRange {
        let asked = || gl.uniform_binding(point);
        *self.points.entry(point).or_insert_with(asked)
    }

    /// All binding points that are known, with what is bound there.
    pub(super) fn bindings(&self) -> impl Iterator<Item = (BindingPoint, &BoundRange)> {
        self.points.iter().map(|(&index, range)| {
            let target = c::UNIFORM_BUFFER;
            (BindingPoint { target, index }, range)
        })
    }
}

impl BlockReader<'_> {
    /// Whether a matrix of these may change without a call of the program's.
    pub(super) fn are_live(&mut self, program: ProgramName, places: &[BlockPlace]) -> bool {
        places.iter().any(|&place| {
            let found = self.blocks.place(self.gl, program, place);
            found.is_some_and(|(_, range)| self.group.uniform_buffers().is_live(range.buffer))
        })
    }

    /// The current value of a matrix, column-major. None where it cannot be told now.
    pub(super) fn matrix(&mut self, program: ProgramName, place: BlockPlace) -> Option<[f32; 16]> {
        let (_, range) = self.blocks.place(self.gl, program, place)?;
        let (buffer, at) = (range.buffer, range.start + place.offset);
        let found = {
            let mut buffers = self.group.uniform_buffers();
            buffers.follow(buffer);
            buffers.matrix(buffer, at)
        };
        let numbers = match found {
            Found::Matrix(numbers) => numbers,
            Found::Mapped => return None,
            Found::Unknown => self.ask(buffer, at)?,
        };
        Some(place.laid_out(numbers))
    }

    fn ask(&mut self, buffer: BufferName, at: usize) -> Option<[f32; 16]> {
        self.state.keep_errors(self.gl);
        let numbers = self.gl.buffer_matrix(buffer, at);
        let failed = self.gl.drop_errors() > 0;
        let mut buffers = self.group.uniform_buffers();
        self.reads_back |= buffers.is_written_by_shaders(buffer);
        if failed {
            return None;
        }
        buffers.read(buffer, at, &numbers);
        Some(numbers)
    }
}

impl Layer {
    /// The uniform blocks of the program in use that each view has of its own, for the matrices that unproject.
    pub(super) fn view_blocks(
        &mut self,
        gl: &Gl,
        shear: Option<Shear>,
        unprojections: &Unprojections,
    ) -> Vec<ViewBlock> {
        let (program, rig) = (self.state.in_use.program, self.known.rig);
        let views = self.session.config.views;
        let Some(shear) = shear else {
            return Vec::new();
        };
        let mut found: Vec<ViewBlock> = Vec::new();
        for &(place, matrix) in &unprojections.in_blocks {
            let Some((index, range)) = self.blocks.place(gl, program, place) else {
                continue;
            };
            let of_view = |view| match rig.position(ViewIndex(view)) {
                0.0 => None,
                at => Some(place.laid_out(camera::unprojection(&matrix, &shear, at))),
            };
            let matrix = ViewMatrix {
                offset: place.offset,
                views: (0..views).map(of_view).collect(),
            };
            let target = c::UNIFORM_BUFFER;
            let point = BindingPoint { target, index };
            match found.iter_mut().find(|block| block.point == point) {
                Some(block) => block.matrices.push(matrix),
                None => found.push(ViewBlock {
                    point,
                    range,
                    matrices: vec![matrix],
                }),
            }
        }
        found
    }

    /// The contents of uniform buffers that are followed.
    pub(super) fn buffers(&self) -> MutexGuard<'_, UniformBuffers> {
        self.session.group.uniform_buffers()
    }

    /// glBindBuffer.
    pub fn binds_buffer(&mut self, target: u32, buffer: BufferName) {
        // The binding belongs to the vertex array object, which is not followed.
        if target == c::ELEMENT_ARRAY_BUFFER {
            return;
        }
        let before = self.blocks.bound.insert(target, buffer).unwrap_or_default();
        self.write_bindings.binds_alone(target);
        match target {
            c::UNIFORM_BUFFER => self.buffers().follow(buffer),
            // Pixels and results of queries are written while a buffer is bound there.
            c::PIXEL_PACK_BUFFER | c::QUERY_BUFFER => {
                let mut buffers = self.buffers();
                buffers.forget_all(before);
                buffers.forget_all(buffer);
            }
            _ => {}
        }
    }

    /// glBindBufferBase, glBindBufferRange and their kin. With `generic` the buffer is bound at the target as well.
    pub fn binds_buffer_at(&mut self, target: u32, index: u32, range: BoundRange, generic: bool) {
        let buffer = range.buffer;
        if generic {
            self.blocks.bound.insert(target, buffer);
        }
        match target {
            c::UNIFORM_BUFFER => {
                self.buffers().follow(buffer);
                self.blocks.points.insert(index, range);
                block_changes();
            }
            c::SHADER_STORAGE_BUFFER | c::ATOMIC_COUNTER_BUFFER | c::TRANSFORM_FEEDBACK_BUFFER => {
                self.buffers().bound_to_be_written(buffer);
                if target != c::TRANSFORM_FEEDBACK_BUFFER {
                    self.write_bindings
                        .binds(BindingPoint { target, index }, range);
                }
            }
            _ => {}
        }
    }

    /// Runs `change` on the contents of a buffer, if they are followed.
    pub fn change_buffer(
        &mut self,
        which: BufferRef,
        change: impl FnOnce(&mut UniformBuffers, BufferName),
    ) {
        let name = self.buffer_name(which);
        let mut buffers = self.buffers();
        if buffers.follows(name) {
            change(&mut buffers, name);
        }
    }

    /// The program has mapped bytes of a buffer, from `at` on. `mapping` makes the record of so many bytes.
    pub fn maps_buffer(
        &mut self,
        which: BufferRef,
        at: usize,
        length: Option<usize>,
        mapping: impl FnOnce(usize) -> Mapping,
    ) {
        let name = self.buffer_name(which);
        let mut buffers = self.buffers();
        match length.or_else(|| buffers.size(name)) {
            Some(length) => buffers.mapped(name, at, mapping(length)),
            None => buffers.forget_all(name),
        }
    }

    /// Whether the program has a buffer of the group mapped, as far as that is followed.
    pub fn has_mappings(&self) -> bool {
        self.buffers().has_mappings()
    }

    /// The name of a buffer.
    pub fn buffer_name(&self, which: BufferRef) -> BufferName {
        match which {
            BufferRef::Named(name) => name,
            BufferRef::Bound(target) => self.blocks.bound_at(target),
        }
    }

    /// glDeleteBuffers, before the driver deletes them. It unbinds them.
    pub fn deletes_buffers(&mut self, names: &[BufferName]) {
        for &name in names {
            self.buffers().deleted(name);
        }
        self.blocks.bound.retain(|_, bound| !names.contains(bound));
        self.blocks
            .points
            .retain(|_, bound| !names.contains(&bound.buffer));
        self.write_bindings.deleted(names);
        block_changes();
    }

    /// Shaders may have written to buffers.
    pub fn shaders_wrote(&mut self) {
        self.buffers().shaders_wrote();
    }

    /// The report says once that a camera is read back.
    pub(super) fn tell_of_cameras_read_back(&mut self) {
        if !std::mem::replace(&mut self.blocks.told, true) {
            self.note("shaders write the program's camera, so it is read back from the driver, which waits".into());
        }
    }
}
