//! A plain atlas: the true framebuffer 0 itself, for a window whose views cannot be had, and where there is no window. Only the program's own
//! view is drawn.

use super::{Atlas, Grid, Tiles};
use crate::gl::{FramebufferName, TextureName};
use crate::state::Window;

impl Atlas {
    /// The true framebuffer 0 as the only tile of an atlas of `views` views. It holds no object.
    pub fn plain(window: &Window, views: u32) -> Atlas {
        let size = [window.width, window.height].map(|side| side.max(1));
        Atlas {
            tiles: Tiles {
                views,
                window: size,
                grid: Grid::FULL,
                shown: [].into_iter().collect(),
                width: size[0],
                height: size[1],
                stride: size[0].next_multiple_of(32),
                columns: 1,
                rows: 1,
            },
            flipped: false,
            color: TextureName::ZERO,
            depth: TextureName::ZERO,
            bytes: 0,
            textures: Vec::new(),
            rows: vec![FramebufferName::ZERO],
            layered: None,
            resolve: None,
            front: None,
            singles: Vec::new(),
            depths: None,
            pyramid: None,
            reference: None,
            bound_row: 0,
        }
    }

    /// Whether it is [`Atlas::plain`].
    pub fn is_plain(&self) -> bool {
        self.textures.is_empty()
    }
}
