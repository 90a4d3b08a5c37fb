//! Names of GL objects, a type for each kind of object.
#![forbid(unsafe_code)]

/// An argument of a GL command: a number, or the name of an object.
pub(super) trait Argument {
    /// As the driver takes it.
    type Raw;
    /// The argument as the driver takes it.
    fn raw(self) -> Self::Raw;
}

macro_rules! numbers {
    ($($number:ident)*) => {$(
        impl Argument for $number {
            type Raw = $number;
            #[inline]
            fn raw(self) -> $number {
                self
            }
        }
    )*};
}

numbers! { i32 u32 u8 f32 }

macro_rules! names {
    ($($(#[$about:meta])* $name:ident;)*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The name 0, which no object has.
            pub const ZERO: $name = $name(0);

            /// Whether it is the name of no object.
            #[must_use]
            pub fn is_zero(self) -> bool {
                self.0 == 0
            }
        }

        impl Argument for $name {
            type Raw = u32;
            #[inline]
            fn raw(self) -> u32 {
                self.0
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }
    )*};
}

names! {
    /// Name of a program object; 0 is fixed function.
    ProgramName;
    /// Name of a shader object.
    ShaderName;
    /// Name of a framebuffer object; 0 is the framebuffer of the window.
    FramebufferName;
    /// Name of a renderbuffer.
    RenderbufferName;
    /// Name of a texture; 0 is the default texture of a target.
    TextureName;
    /// Name of a buffer object; 0 is none.
    BufferName;
    /// Name of a vertex array object; 0 is the default one.
    VertexArrayName;
    /// Name of a query object.
    QueryName;
    /// Name of a display list.
    ListName;
}
