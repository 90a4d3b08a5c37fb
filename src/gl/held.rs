//! How many names of objects the layer holds: what its own calls have made, less what they have deleted.
#![forbid(unsafe_code)]

use core::cell::Cell;
use serde::Serialize;

/// A kind of object that the layer makes.
#[derive(Clone, Copy, Debug)]
pub enum Held {
    /// A texture.
    Texture,
    /// A framebuffer object or a renderbuffer.
    Framebuffer,
    /// A query object.
    Query,
    /// A vertex array object.
    VertexArray,
    /// A buffer object.
    Buffer,
    /// A shader that is not yet part of a program, or the program.
    Shader,
}

/// Numbers of names, made less deleted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "as in `Held`")]
pub struct Count {
    pub textures: i64,
    pub framebuffers: i64,
    pub queries: i64,
    pub vertex_arrays: i64,
    pub buffers: i64,
    pub shaders: i64,
}

thread_local! {
    // Of the context that is current on the thread. No destructor: threads may call GL while they are torn down.
    static SINCE: Cell<Count> = const {
        Cell::new(Count { textures: 0, framebuffers: 0, queries: 0, vertex_arrays: 0, buffers: 0, shaders: 0 })
    };
}

impl Held {
    /// A name has been made, or deleted by -1.
    pub fn count(self, by: i64) {
        let mut count = SINCE.get();
        *match self {
            Held::Texture => &mut count.textures,
            Held::Framebuffer => &mut count.framebuffers,
            Held::Query => &mut count.queries,
            Held::VertexArray => &mut count.vertex_arrays,
            Held::Buffer => &mut count.buffers,
            Held::Shader => &mut count.shaders,
        } += by;
        SINCE.set(count);
    }
}

impl Count {
    /// Adds what this thread has made since the last time. To be asked before another context is made current.
    pub fn catch_up(&mut self) {
        let since = SINCE.take();
        self.textures += since.textures;
        self.framebuffers += since.framebuffers;
        self.queries += since.queries;
        self.vertex_arrays += since.vertex_arrays;
        self.buffers += since.buffers;
        self.shaders += since.shaders;
    }
}
