//! The reference image of an occlusion camera: colours and depths as in a tile, and the displacement of each sample. Also the textures of
//! the distortion map that its rays follow.

use super::{Atlas, Names, Single, Surface, Tiles, fetched};
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Window;
use crate::view::ViewIndex;

/// Samples of a row in one texel of the discontinuity textures.
const BLOCK: u32 = 16;

/// Samples of a row in one texel of the distortion map.
const CELL: i32 = 2;

/// The textures of a reference image and of its distortion map, array textures of one layer; see `shaders/reference.wgsl` and
/// `shaders/distortion.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReferenceTextures {
    /// Colours, depths and the displacement of samples, in pixels.
    pub image: [TextureName; 3],
    /// Bits for samples at depth discontinuities, and for samples inside a splat around one.
    pub steps: [TextureName; 2],
    /// The distortion map.
    pub map: TextureName,
}

/// The targets of the passes that make the distortion map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistortionTarget {
    /// Samples at depth discontinuities.
    Steps,
    /// Samples inside a splat around a discontinuity.
    Splats,
    /// [`ReferenceTextures::map`]
    Map,
}

/// The textures of the reference image and their framebuffers.
#[derive(Debug)]
pub(super) struct Reference {
    image: Single,
    moved: TextureName,
    /// Texture and framebuffer.
    steps: (TextureName, FramebufferName),
    splats: (TextureName, FramebufferName),
    map: (TextureName, FramebufferName),
}

impl Reference {
    pub(super) fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> + use<> {
        [
            self.image.framebuffer(),
            self.steps.1,
            self.splats.1,
            self.map.1,
        ]
        .into_iter()
    }
}

impl Atlas {
    /// Makes the reference image and its distortion map; false where the driver cannot draw to them. The caller saves and restores bindings as
    /// for [`Atlas::new`].
    pub fn make_reference(&mut self, gl: &Gl, names: &mut Names, window: &Window) -> bool {
        let size = [self.tiles.width, self.tiles.height].map(|side| side as i32);
        let (flip, textures) = (self.flipped, &mut self.textures);
        let image = Single::new(gl, names, window, size, flip, textures);
        let mut complete = true;
        let mut texture = |(internal, format): (u32, u32), width: i32| {
            let name = names.texture(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, name);
            gl.tex_storage_3d(internal, width, size[1], 1, format, c::FLOAT);
            fetched(gl);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, TextureName::ZERO);
            textures.push(name);
            name
        };
        let moved = texture((c::R16F, c::RED), size[0]);
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1) as i32;
        let steps = texture((c::RG32F, c::RG), blocks);
        let splats = texture((c::RG32F, c::RG), blocks);
        let map = texture((c::RGBA16F, c::RGBA), (size[0] + 1) / CELL);
        let attach = |point, name| {
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, name, 0, 0);
        };
        gl.bind_framebuffer(c::FRAMEBUFFER, image.framebuffer());
        attach(c::COLOR_ATTACHMENT0 + 1, moved);
        gl.draw_buffers(&[c::COLOR_ATTACHMENT0, c::COLOR_ATTACHMENT0 + 1]);
        complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
        let mut target = |name: TextureName| {
            let framebuffer = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
            attach(c::COLOR_ATTACHMENT0, name);
            if flip {
                gl.flip_framebuffer(c::FRAMEBUFFER);
            }
            complete &= gl.check_framebuffer_status(c::FRAMEBUFFER) == c::FRAMEBUFFER_COMPLETE;
            (name, framebuffer)
        };
        let steps = target(steps);
        let splats = target(splats);
        let map = target(map);
        self.reference = Some(Reference {
            image,
            moved,
            steps,
            splats,
            map,
        });
        complete
    }

    /// The textures of the reference image, where [`Atlas::make_reference`] has made it.
    pub fn reference(&self) -> Option<ReferenceTextures> {
        let reference = self.reference.as_ref()?;
        let [colour, depth] = reference.image.textures();
        Some(ReferenceTextures {
            image: [colour, depth, reference.moved],
            steps: [reference.steps.0, reference.splats.0],
            map: reference.map.0,
        })
    }

    /// Binds the target of a pass for drawing, and returns its width in texels.
    pub fn enter_distortion(&mut self, gl: &Gl, target: DistortionTarget) -> i32 {
        let Some(reference) = &self.reference else {
            return 0;
        };
        let blocks = self.tiles.width.div_ceil(BLOCK).max(1);
        let (framebuffer, width) = match target {
            DistortionTarget::Steps => (reference.steps.1, blocks),
            DistortionTarget::Splats => (reference.splats.1, blocks),
            DistortionTarget::Map => (reference.map.1, self.tiles.width.div_ceil(2)),
        };
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
        self.bound_row = u32::MAX;
        width as i32
    }

    /// The framebuffer of the reference image.
    pub fn reference_framebuffer(&self) -> Option<FramebufferName> {
        Some(self.reference.as_ref()?.image.framebuffer())
    }
}

/// The reference image as the surface of a draw: it takes the place of the program's own view and is the only one.
#[derive(Debug)]
pub struct ReferenceSurface<'a>(pub &'a mut Atlas);

impl Surface for ReferenceSurface<'_> {
    fn tiles(&self) -> Tiles {
        let tiles = self.0.tiles;
        Tiles {
            shown: [].into_iter().collect(),
            columns: 1,
            rows: tiles.views,
            ..tiles
        }
    }

    fn enter(&mut self, gl: &Gl, _: ViewIndex) -> i32 {
        self.bind_row(gl, 0);
        0
    }

    fn bind_row(&mut self, gl: &Gl, _: u32) {
        if let Some(framebuffer) = self.0.reference_framebuffer() {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, framebuffer);
            self.0.bound_row = u32::MAX;
        }
    }
}
