//! Names of the layer's own textures and buffers.

use crate::gl::{Gl, Held, consts as c};
use std::collections::BTreeSet;

/// Gives out names that the program does not come upon.
///
/// At first they are generated ones, as everybody's. Old programs however number their textures themselves instead of asking
/// glGenTextures, and sooner or later bind a number that is ours (seen with MangoHud, notes/interposition.md section 2); our
/// textures then move to high names ([`Names::hide`]). Not from the start: on Mesa glGenTextures goes on above the highest name
/// in use, and a program that does ask may use its names as small indices.
#[derive(Debug, Default)]
pub struct Names {
    next: Option<u32>,
    promised: BTreeSet<u32>,
}

/// "MV" in the upper half.
const FIRST: u32 = 0x4D56_0000;

impl Names {
    /// From now on high names are given out.
    pub fn hide(&mut self) {
        self.next = Some(FIRST);
    }

    /// Whether high names are given out.
    pub fn hidden(&self) -> bool {
        self.next.is_some()
    }

    /// A display list of the program will bind this texture, which may not be there yet.
    pub fn promise(&mut self, name: u32) {
        self.promised.insert(name);
    }

    /// A texture, to be bound at once: only then is a high name taken.
    pub fn texture(&mut self, gl: &Gl) -> u32 {
        let Some(next) = &mut self.next else {
            let mut name = gl.gen_texture();
            // Given back when another one has been found, or it would be found again.
            let mut promised = Vec::new();
            while self.promised.contains(&name) {
                promised.push(name);
                name = gl.gen_texture();
            }
            promised.into_iter().for_each(|n| gl.delete_texture(n));
            return name;
        };
        // Contexts that share objects share the names, and each has its own atlas.
        while gl.is_texture(*next) != 0 {
            *next += 1;
        }
        let name = *next;
        *next += 1;
        Held::Texture.count(1);
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
