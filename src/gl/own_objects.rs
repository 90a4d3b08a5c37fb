//! Names of the layer's own buffers, framebuffers, renderbuffers, queries and vertex arrays.
//!
//! Programs may number buffers, framebuffers, renderbuffers and queries themselves instead of asking for names, and begin with 1 (OpenGL 4.6
//! compatibility profile; framebuffers and renderbuffers by glBindFramebufferEXT and glBindRenderbufferEXT alone). So ours are the last of many
//! names, and the others are given back. Vertex arrays have no such names.

use super::{
    BufferName, FramebufferName, Gl, Held, Ptr, QueryName, RenderbufferName, VertexArrayName,
};

/// More objects than programs number themselves.
const MANY: usize = 1024;
/// Queries that are made together: a query that counts many draws is continued by one for each.
const QUERIES: usize = 64;

/// The last `count` of many names, of which `give_back` gets the others.
fn last_of_many(
    count: usize,
    generate: impl FnOnce(i32, Ptr),
    give_back: impl FnOnce(i32, Ptr),
) -> Vec<u32> {
    // Not on the stack, of which threads may have little.
    let mut names = vec![0u32; MANY];
    generate(MANY as i32, names.as_mut_ptr().cast());
    let kept = names.split_off(MANY - count);
    give_back(names.len() as i32, names.as_mut_ptr().cast());
    kept
}

macro_rules! apart {
    ($($name:ident = $generate:ident, $delete:ident, $held:ident, $kind:ident;)*) => { $(
        /// New names.
        fn $name<const COUNT: usize>(&self) -> [$kind; COUNT] {
            let real = self.real;
            let names = last_of_many(
                COUNT,
                // SAFETY: a context is current, and there is room for so many names.
                |count, names| unsafe { real.$generate(count, names) },
                // SAFETY: so many names.
                |count, names| unsafe { real.$delete(count, names) },
            );
            Held::$held.count(COUNT as i64);
            core::array::from_fn(|at| $kind(names[at]))
        }
    )* };
}

impl Gl {
    apart! {
        buffers = glGenBuffers, glDeleteBuffers, Buffer, BufferName;
        framebuffers = glGenFramebuffers, glDeleteFramebuffers, Framebuffer, FramebufferName;
        renderbuffers = glGenRenderbuffers, glDeleteRenderbuffers, Framebuffer, RenderbufferName;
        queries = glGenQueries, glDeleteQueries, Query, QueryName;
    }

    /// One new name.
    pub fn gen_buffer(&self) -> BufferName {
        let [name] = self.buffers();
        name
    }

    /// One new name.
    pub fn gen_framebuffer(&self) -> FramebufferName {
        let [name] = self.framebuffers();
        name
    }

    /// One new name.
    pub fn gen_renderbuffer(&self) -> RenderbufferName {
        let [name] = self.renderbuffers();
        name
    }

    /// New names.
    pub fn gen_queries(&self) -> [QueryName; QUERIES] {
        self.queries()
    }

    /// One new name.
    pub fn gen_vertex_array(&self) -> VertexArrayName {
        let mut name = VertexArrayName::ZERO;
        // SAFETY: a context is current; room for one name.
        unsafe { self.real.glGenVertexArrays(1, (&raw mut name).cast()) };
        Held::VertexArray.count(1);
        name
    }
}
