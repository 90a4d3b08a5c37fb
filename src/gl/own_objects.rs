//! Names of the layer's own buffers, framebuffers, renderbuffers, queries and vertex arrays.
//!
//! Programs may number such objects themselves instead of asking for names, and begin with 1 (OpenGL 4.6 compatibility profile; not vertex
//! arrays). So each of ours is the last of many names, and the others are given back.

use super::{
    BufferName, FramebufferName, Gl, Held, Ptr, QueryName, RenderbufferName, VertexArrayName,
};

/// More objects than programs number themselves.
const MANY: usize = 1024;

/// The last of many names, of which `give_back` gets the others.
fn last_of_many(generate: impl FnOnce(i32, Ptr), give_back: impl FnOnce(i32, Ptr)) -> u32 {
    let mut names = [0u32; MANY];
    generate(MANY as i32, names.as_mut_ptr().cast());
    give_back(MANY as i32 - 1, names.as_mut_ptr().cast());
    names[MANY - 1]
}

macro_rules! apart {
    ($($name:ident = $generate:ident, $delete:ident, $held:ident, $kind:ident;)*) => { $(
        /// One new name.
        pub fn $name(&self) -> $kind {
            let real = self.real;
            let name = last_of_many(
                // SAFETY: a context is current, and there is room for so many names.
                |count, names| unsafe { real.$generate(count, names) },
                // SAFETY: so many names.
                |count, names| unsafe { real.$delete(count, names) },
            );
            Held::$held.count(1);
            $kind(name)
        }
    )* };
}

impl Gl {
    apart! {
        gen_buffer = glGenBuffers, glDeleteBuffers, Buffer, BufferName;
        gen_framebuffer = glGenFramebuffers, glDeleteFramebuffers, Framebuffer, FramebufferName;
        gen_renderbuffer = glGenRenderbuffers, glDeleteRenderbuffers, Framebuffer, RenderbufferName;
        gen_query = glGenQueries, glDeleteQueries, Query, QueryName;
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
