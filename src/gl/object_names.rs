//! Names of GL objects, each kind a type of its own.

macro_rules! names {
    ($($(#[$about:meta])* $name:ident;)*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// Whether it is the name of no object.
            #[must_use]
            pub fn is_zero(self) -> bool {
                self.0 == 0
            }
        }
    )*};
}

names! {
    /// Name of a program object; 0 is fixed function.
    ProgramName;
    /// Of a framebuffer object; 0 is the window's.
    FramebufferName;
    /// Of a texture.
    TextureName;
}
