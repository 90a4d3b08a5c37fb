//! Names of the layer's own textures and buffers.

use crate::gl::{Gl, TextureName, consts as c};
use std::collections::BTreeSet;

/// Gives out names that the program does not use.
///
/// At first they come from glGenTextures. Old programs however number their textures themselves instead of calling
/// glGenTextures, and sooner or later bind a number that is ours (seen with MangoHud). Our textures then move to high
/// names ([`Names::hide`]; docs/decisions/0014-names-of-our-objects.md). High names are not used from the start: on Mesa glGenTextures continues
/// above the highest name in use, and a program that calls it may use its names as small indices.
#[derive(Debug, Default)]
pub struct Names {
    next: Option<TextureName>,
    promised: BTreeSet<TextureName>,
}

/// The first high name: "MV" in the upper half.
const FIRST: TextureName = TextureName(0x4D56_0000);

impl Names {
    /// Gives out high names from now on.
    pub fn hide(&mut self) {
        self.next = Some(FIRST);
    }

    /// Whether high names are given out.
    pub fn hidden(&self) -> bool {
        self.next.is_some()
    }

    /// Excludes a name that a display list of the program will bind; the texture may not exist yet.
    pub fn promise(&mut self, name: TextureName) {
        self.promised.insert(name);
    }

    /// A new name of a texture. The caller binds it at once, because a high name counts as used only then.
    pub fn texture(&mut self, gl: &Gl) -> TextureName {
        let Some(next) = &mut self.next else {
            let mut name = gl.gen_texture();
            // Rejected names are deleted only after another one is found, or glGenTextures would return them again.
            let mut promised = Vec::new();
            while self.promised.contains(&name) {
                promised.push(name);
                name = gl.gen_texture();
            }
            promised.into_iter().for_each(|n| gl.delete_texture(n));
            return name;
        };
        // Contexts that share objects share the names, but each has its own counter.
        while gl.is_texture(*next) != 0 {
            next.0 += 1;
        }
        let name = *next;
        next.0 += 1;
        gl.use_texture(name);
        name
    }

    /// The texture targets whose bindings [`super::Atlas::new`] uses, with the names of the bindings.
    pub const TARGETS: [(u32, u32); 2] = [
        (c::TEXTURE_2D_ARRAY, c::TEXTURE_BINDING_2D_ARRAY),
        (
            c::TEXTURE_2D_MULTISAMPLE_ARRAY,
            c::TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY,
        ),
    ];
}
