//! Commands that are made at once, also while a display list is compiled: bindings and deletions of objects, display lists themselves, how pixels
//! lie in memory; and those of which drivers do not agree.
#![allow(non_snake_case, reason = "each is the GL command of its name")]

use super::Shadow;
use super::change::Change;
use super::key::{Key, bits, is_buffer, is_pixel_store};
use super::values::one;
use crate::gl::bindings::{buffer_binding, is_texture_binding};
use crate::gl::consts as c;
use crate::gl::real::Ptr;

impl Shadow {
    /// The command changes matrices that it names.
    pub(in crate::gl) unsafe fn matrices(&mut self) {
        self.change(Change::ForgetMatrices);
    }

    /// The command changes state in a way that is not followed.
    pub(in crate::gl) unsafe fn anything(&mut self) {
        self.change_now_or_later(Change::ForgetAll);
    }

    /// The command sets values that glPushClientAttrib saves to those of a new context.
    pub(in crate::gl) unsafe fn glClientAttribDefaultEXT(&mut self, _mask: u32) {
        self.forget_client();
    }

    pub(in crate::gl) unsafe fn glPushClientAttribDefaultEXT(&mut self, mask: u32) {
        // SAFETY: no pointers.
        unsafe { self.glPushClientAttrib(mask) };
        self.forget_client();
    }

    fn forget_client(&mut self) {
        let keys = self.values.iter().map(|(key, _)| key);
        let of_client: Vec<Key> = keys.filter(|key| key.is_of_client()).collect();
        of_client.into_iter().for_each(|key| self.put(key, None));
    }

    pub(in crate::gl) unsafe fn glNewList(&mut self, list: u32, mode: u32) {
        let known = [c::COMPILE, c::COMPILE_AND_EXECUTE].contains(&mode);
        if self.compiling.is_none() && known && list != 0 && !self.inside {
            self.begin_list(list, mode == c::COMPILE_AND_EXECUTE);
        }
    }

    pub(in crate::gl) unsafe fn glEndList(&mut self) {
        self.end_list();
    }

    pub(in crate::gl) unsafe fn glDeleteLists(&mut self, list: u32, range: i32) {
        self.lists.deleted(list, u32::try_from(range).unwrap_or(0));
    }

    pub(in crate::gl) unsafe fn glPixelStorei(&mut self, pname: u32, param: i32) {
        let swap = [
            c::PACK_SWAP_BYTES,
            c::UNPACK_SWAP_BYTES,
            c::PACK_LSB_FIRST,
            c::UNPACK_LSB_FIRST,
        ];
        let value = match pname {
            _ if !is_pixel_store(pname) => return,
            c::PACK_ALIGNMENT | c::UNPACK_ALIGNMENT => {
                one(param as u32).filter(|_| [1, 2, 4, 8].contains(&param))
            }
            _ if swap.contains(&pname) => one((param != 0).into()),
            _ => one(param as u32).filter(|_| param >= 0),
        };
        self.change_now(&Change::Put(Key::Value(pname), value));
    }

    pub(in crate::gl) unsafe fn glPixelStoref(&mut self, pname: u32, _param: f32) {
        if is_pixel_store(pname) {
            self.change_now(&Change::Put(Key::Value(pname), None));
        }
    }

    pub(in crate::gl) unsafe fn glPushClientAttrib(&mut self, mask: u32) {
        let mut bits = 0;
        if mask & 1 != 0 {
            bits |= bits::CLIENT_PIXELS;
        }
        if mask & 2 != 0 {
            bits |= bits::CLIENT_ARRAYS;
        }
        if self.client.base.is_none() {
            // The driver has pushed already.
            let depth = self.integer(c::CLIENT_ATTRIB_STACK_DEPTH) as usize;
            self.client.base = Some(depth.saturating_sub(1 + self.client.len()));
        }
        let below = self.client.base.unwrap_or_default();
        let most = self.constant(c::MAX_CLIENT_ATTRIB_STACK_DEPTH) as usize;
        if below + self.client.len() < most {
            self.client.push(bits, None);
        }
    }

    pub(in crate::gl) unsafe fn glPopClientAttrib(&mut self) {
        match self.client.pop() {
            Some(pushed) => self.restore(pushed),
            None => self.forget_client(),
        }
    }

    pub(in crate::gl) unsafe fn glBindBuffer(&mut self, target: u32, buffer: u32) {
        if let Some(binding) = buffer_binding(target).filter(|&binding| is_buffer(binding)) {
            self.change_now(&Change::Bind(Key::Value(binding), buffer));
        }
    }

    pub(in crate::gl) unsafe fn glBindVertexArray(&mut self, array: u32) {
        self.change_now(&Change::Bind(Key::Value(c::VERTEX_ARRAY_BINDING), array));
    }

    pub(in crate::gl) unsafe fn glBindProgramPipeline(&mut self, pipeline: u32) {
        self.change_now_or_later(Change::Bind(
            Key::Value(c::PROGRAM_PIPELINE_BINDING),
            pipeline,
        ));
    }

    pub(in crate::gl) unsafe fn glBindSampler(&mut self, unit: u32, sampler: u32) {
        self.change_now_or_later(Change::Bind(Key::Unit(c::SAMPLER_BINDING, unit), sampler));
    }

    pub(in crate::gl) unsafe fn glLinkProgram(&mut self, program: u32) {
        self.subroutines.relinked(program);
        self.uniforms.relinked(program);
        self.deleted(&[program], |binding| binding == c::CURRENT_PROGRAM);
    }

    pub(in crate::gl) unsafe fn glProgramBinary(
        &mut self,
        program: u32,
        _format: u32,
        _binary: Ptr,
        _length: i32,
    ) {
        // SAFETY: no pointers.
        unsafe { self.glLinkProgram(program) };
    }

    pub(in crate::gl) unsafe fn glDeleteProgram(&mut self, program: u32) {
        self.uniforms.relinked(program);
        self.deleted(&[program], |binding| binding == c::CURRENT_PROGRAM);
    }

    /// # Safety
    /// The array has so many names.
    unsafe fn delete(&mut self, count: i32, names: Ptr, of: impl Fn(u32) -> bool) {
        let count = usize::try_from(count).unwrap_or(0);
        if !names.is_null() {
            // SAFETY: forwarded.
            let names = unsafe { std::slice::from_raw_parts(names.cast::<u32>(), count) };
            self.deleted(names, of);
        }
    }

    pub(in crate::gl) unsafe fn glDeleteTextures(&mut self, n: i32, textures: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.delete(n, textures, is_texture_binding) };
    }

    pub(in crate::gl) unsafe fn glDeleteSamplers(&mut self, n: i32, samplers: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.delete(n, samplers, |binding| binding == c::SAMPLER_BINDING) };
    }

    pub(in crate::gl) unsafe fn glDeleteBuffers(&mut self, n: i32, buffers: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.delete(n, buffers, is_buffer) };
    }

    pub(in crate::gl) unsafe fn glDeleteVertexArrays(&mut self, n: i32, arrays: Ptr) {
        // SAFETY: forwarded.
        unsafe { self.delete(n, arrays, |binding| binding == c::VERTEX_ARRAY_BINDING) };
        // Others may get their names.
        self.forget_attributes();
    }

    pub(in crate::gl) unsafe fn glDeleteProgramPipelines(&mut self, n: i32, pipelines: Ptr) {
        // SAFETY: forwarded.
        unsafe {
            self.delete(n, pipelines, |binding| {
                binding == c::PROGRAM_PIPELINE_BINDING
            })
        };
    }

    pub(in crate::gl) unsafe fn glBeginTransformFeedback(&mut self, _mode: u32) {
        self.feedback = true;
    }

    pub(in crate::gl) unsafe fn glEndTransformFeedback(&mut self) {
        self.feedback = false;
        self.change_now(&Change::Put(Key::Value(c::CURRENT_PROGRAM), None));
        self.change_now(&Change::Put(Key::Value(c::PROGRAM_PIPELINE_BINDING), None));
    }
}
