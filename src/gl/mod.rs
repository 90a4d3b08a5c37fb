//! The only unsafe code of the library: the table of real functions, recorded immediate mode, and [`Gl`], the calls that the
//! layer itself makes.

#[cfg(any(test, feature = "fake-driver"))]
#[macro_use]
pub mod fake;
#[macro_use]
mod real;
pub mod api;
mod bindings;
mod buffers;
pub mod consts;
mod draws;
mod framebuffers;
mod held;
mod images;
pub mod immediate;
mod indices;
mod list_names;
mod object_names;
mod own_objects;
mod own_textures;
mod per_view;
mod pixel_store;
mod pixels;
mod positions;
mod programs;
mod questions;
mod resources;
pub mod shadow;
#[allow(missing_docs, non_upper_case_globals, clippy::missing_safety_doc, reason = "generated; the names are the API's own")]
#[rustfmt::skip]
mod table;
mod textures;
mod uniforms;
mod written;

pub use api::Gl;
pub use bindings::{buffer_binding, texture_binding};
pub use buffers::{DepthKind, Fence, Mapping};
pub use framebuffers::{Attachment, Object, Storage};
pub use held::{Count, Held};
pub use images::ImageUnit;
pub use immediate::{Ends, Recording};
pub use indices::{Indices, Vertices};
pub use list_names::list_names;
pub use object_names::{
    BufferName, FramebufferName, ListName, ProgramName, QueryName, RenderbufferName, ShaderName,
    TextureName, VertexArrayName,
};
pub use pixel_store::PixelStore;
pub use programs::{Active, BlockPlace};
pub use real::{Ptr, Real};
pub use resources::{BindingPoint, BoundRange};
pub use table::{COUNT, NAMES, slot};
pub use textures::{Level, is_multisampled};
