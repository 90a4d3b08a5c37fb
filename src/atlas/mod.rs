//! The atlas, to which the program's framebuffer 0 is redirected: an array texture with a tile per view and a framebuffer per layer.
#![forbid(unsafe_code)]

mod depths;
mod front;
mod grid;
mod layers;
mod names;
mod osd;
mod panel;
mod plain;
mod pyramid;
mod reference;
mod samples;
mod single;
mod spread;
mod surface;
#[cfg(test)]
mod tests;
mod tiles;
mod view_set;

use crate::view::ViewIndex;
use depths::Depths;
pub use depths::{DepthPicture, inside, small_size};
use front::Front;
pub use grid::Grid;
pub use names::Names;
pub use osd::OsdImage;
pub use panel::{PanelFormat, PanelImage, PanelPlace};
use pyramid::Pyramid;
pub use pyramid::{PyramidTarget, PyramidTextures};
use reference::Reference;
pub use reference::{DistortionTarget, ReferenceSurface, ReferenceTextures};
pub use samples::Samples;
use single::Single;
pub use surface::Surface;
pub use tiles::{Limits, Tiles, TilesError};
pub use view_set::ViewSet;

use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::Window;

/// Tiles, textures and framebuffers of one context. More than 12 fields: one for each kind of image, made when it is first wanted.
/// More than 25 methods: the operations on each kind, in a file for each.
#[derive(Debug)]
pub struct Atlas {
    /// The places of the views.
    pub tiles: Tiles,
    /// Texture rows run from the top down, as in the driver's windows (GL_MESA_framebuffer_flip_y).
    pub flipped: bool,
    /// The colour texture that is sampled: that of the tiles, or with multisampling the one that they are resolved to.
    pub color: TextureName,
    /// The depth texture that is sampled, resolved as [`Atlas::resolve`] does; 0 where the window has no depth.
    pub depth: TextureName,
    /// Memory of the views in bytes, with all samples and the textures that they are resolved to.
    pub bytes: u64,
    textures: Vec<TextureName>,
    rows: Vec<FramebufferName>,
    layered: Option<FramebufferName>,
    resolve: Option<Vec<FramebufferName>>,
    front: Option<Front>,
    /// Copies of single tiles: one to read from, and one that a scaled blit is drawn to.
    singles: Vec<Single>,
    depths: Option<Depths>,
    pyramid: Option<Pyramid>,
    reference: Option<Reference>,
    bound_row: u32,
}

/// Why the driver cannot make an atlas.
#[derive(Debug, thiserror::Error)]
pub enum AtlasError {
    /// The tiles do not fit.
    #[error(transparent)]
    Tiles(#[from] TilesError),
    /// A framebuffer is not complete.
    #[error(
        "the driver makes no framebuffer for {views} views of {width} x {height} pixels with {samples} samples (status 0x{status:04X}); \
         it may lack the memory: ask for fewer views or make the window smaller"
    )]
    Incomplete {
        /// N.
        views: u32,
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
        /// 0 for none.
        samples: u32,
        /// glCheckFramebufferStatus.
        status: u32,
    },
}

/// Internal format, format and type of a colour texture with the bits of the window.
fn color_format(w: &Window) -> (u32, u32, u32) {
    let [r, _, _, a, _, _] = w.bits;
    match (r, a) {
        _ if w.float => (c::RGBA16F, c::RGBA, c::FLOAT),
        (9..=10, _) => (c::RGB10_A2, c::RGBA, c::UNSIGNED_INT_2_10_10_10_REV),
        (11.., _) if w.buffers.es => (c::RGBA16F, c::RGBA, c::FLOAT),
        (11.., _) => (c::RGBA16, c::RGBA, c::UNSIGNED_SHORT),
        (5, 0) => (c::RGB565, c::RGB, c::UNSIGNED_BYTE),
        (5, 1) => (c::RGB5_A1, c::RGBA, c::UNSIGNED_BYTE),
        (4, _) => (c::RGBA4, c::RGBA, c::UNSIGNED_BYTE),
        // In a window without alpha, reads and blending get a destination alpha of 1, so the texture has none either. OpenGL ES cannot draw
        // to GL_SRGB8.
        (_, 0) if w.srgb && w.buffers.es => (c::SRGB8_ALPHA8, c::RGBA, c::UNSIGNED_BYTE),
        (_, 0) if w.srgb => (c::SRGB8, c::RGB, c::UNSIGNED_BYTE),
        (_, 0) => (c::RGB8, c::RGB, c::UNSIGNED_BYTE),
        _ if w.srgb => (c::SRGB8_ALPHA8, c::RGBA, c::UNSIGNED_BYTE),
        _ => (c::RGBA8, c::RGBA, c::UNSIGNED_BYTE),
    }
}

/// Internal format, format, type and attachment point of depth and stencil.
fn depth_format(w: &Window) -> Option<(u32, u32, u32, u32)> {
    let [_, _, _, _, depth, stencil] = w.bits;
    match (depth, stencil) {
        (0, 0) => None,
        (_, 1..) => Some((
            c::DEPTH24_STENCIL8,
            c::DEPTH_STENCIL,
            c::UNSIGNED_INT_24_8,
            c::DEPTH_STENCIL_ATTACHMENT,
        )),
        (1..=16, 0) => Some((
            c::DEPTH_COMPONENT16,
            c::DEPTH_COMPONENT,
            c::UNSIGNED_SHORT,
            c::DEPTH_ATTACHMENT,
        )),
        (25.., 0) if w.buffers.es => Some((
            c::DEPTH_COMPONENT32F,
            c::DEPTH_COMPONENT,
            c::FLOAT,
            c::DEPTH_ATTACHMENT,
        )),
        (25.., 0) => Some((
            c::DEPTH_COMPONENT32,
            c::DEPTH_COMPONENT,
            c::UNSIGNED_INT,
            c::DEPTH_ATTACHMENT,
        )),
        _ => Some((
            c::DEPTH_COMPONENT24,
            c::DEPTH_COMPONENT,
            c::UNSIGNED_INT,
            c::DEPTH_ATTACHMENT,
        )),
    }
}

/// Bytes of a texel in an internal format of [`color_format`] or [`depth_format`]; drivers pad three bytes to four.
fn texel_bytes(format: u32) -> u64 {
    match format {
        c::RGBA16 | c::RGBA16F => 8,
        c::RGB565 | c::RGB5_A1 | c::RGBA4 | c::DEPTH_COMPONENT16 => 2,
        _ => 4,
    }
}

/// A width in texels, within the driver's limit, at which the same column of neighbouring rows does not compete for a few cache lines.
fn padded(gl: &Gl, width: u32) -> u32 {
    let wider = width + 16;
    let most = gl.get_integer(c::MAX_TEXTURE_SIZE).max(0).unsigned_abs();
    if width.is_multiple_of(1024) && wider <= most {
        wider
    } else {
        width
    }
}

/// Gives a texture its storage: width, height in texels and layers, single-sampled. Changes the binding of array textures.
fn store(gl: &Gl, name: TextureName, format: (u32, u32, u32), [width, height, layers]: [i32; 3]) {
    gl.bind_texture(c::TEXTURE_2D_ARRAY, name);
    gl.tex_storage_3d(format.0, width, height, layers, format.1, format.2);
    fetched(gl);
    gl.bind_texture(c::TEXTURE_2D_ARRAY, TextureName::ZERO);
}

/// Sets the bound array texture to one level without filtering.
fn fetched(gl: &Gl) {
    for (p, v) in [
        (c::TEXTURE_MIN_FILTER, c::NEAREST),
        (c::TEXTURE_MAG_FILTER, c::NEAREST),
        (c::TEXTURE_MAX_LEVEL, 0),
    ] {
        gl.tex_parameteri(c::TEXTURE_2D_ARRAY, p, v as i32);
    }
}

impl Atlas {
    /// Makes the atlas for a window; `flip` sets [`Atlas::flipped`]. The caller saves and restores bindings (textures, framebuffers, unpack
    /// buffer).
    ///
    /// # Errors
    /// [`AtlasError::Incomplete`]; nothing is left behind.
    pub fn new(
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        tiles: Tiles,
        flip: bool,
    ) -> Result<Atlas, AtlasError> {
        let samples = window.samples;
        let (width, height, layers) = (
            padded(gl, tiles.texture_width()) as i32,
            tiles.height as i32,
            tiles.rows as i32,
        );
        let texels: u64 = [width, height, layers]
            .map(|n| n.max(0) as u64)
            .iter()
            .product();
        let (mut textures, mut bytes) = (Vec::new(), 0);
        let mut texture = |format: (u32, u32, u32), samples: u32| {
            let name = names.texture(gl);
            textures.push(name);
            bytes += texels * texel_bytes(format.0) * u64::from(samples.max(1));
            if samples > 0 {
                gl.bind_texture(c::TEXTURE_2D_MULTISAMPLE_ARRAY, name);
                gl.tex_image_3d_multisample(
                    samples as i32,
                    format.0,
                    [width, height, layers],
                    true,
                );
                gl.bind_texture(c::TEXTURE_2D_MULTISAMPLE_ARRAY, TextureName::ZERO);
            } else {
                store(gl, name, format, [width, height, layers]);
            }
            name
        };
        let color = texture(color_format(window), samples);
        let depth = depth_format(window).map(|f| (texture((f.0, f.1, f.2), samples), f));
        let (sampled, resolve_depth) = match samples {
            0 => (color, None),
            _ => (
                texture(color_format(window), 0),
                depth.map(|(_, f)| (texture((f.0, f.1, f.2), 0), f)),
            ),
        };
        let framebuffer =
            |layer: Option<u32>,
             color: TextureName,
             depth: Option<(TextureName, (u32, u32, u32, u32))>| {
                let name = gl.gen_framebuffer();
                gl.bind_framebuffer(c::FRAMEBUFFER, name);
                let attach = |point, texture| match layer {
                    Some(l) => {
                        gl.framebuffer_texture_layer(c::FRAMEBUFFER, point, texture, 0, l as i32)
                    }
                    None => gl.framebuffer_texture(c::FRAMEBUFFER, point, texture, 0),
                };
                attach(c::COLOR_ATTACHMENT0, color);
                if let Some((t, f)) = depth {
                    attach(f.3, t);
                }
                if flip {
                    gl.flip_framebuffer(c::FRAMEBUFFER);
                }
                name
            };
        let rows: Vec<FramebufferName> = (0..tiles.rows)
            .map(|l| framebuffer(Some(l), color, depth))
            .collect();
        let status = gl.check_framebuffer_status(c::FRAMEBUFFER);
        let resolve = (samples > 0).then(|| {
            (0..tiles.rows)
                .map(|l| framebuffer(Some(l), sampled, resolve_depth))
                .collect()
        });
        let layered = (tiles.rows > 1 && gl.since((3, 2), Some((3, 2))))
            .then(|| framebuffer(None, color, depth));
        let atlas = Atlas {
            tiles,
            flipped: flip,
            color: sampled,
            depth: resolve_depth
                .or(depth)
                .map_or(TextureName::ZERO, |(name, _)| name),
            bytes,
            textures,
            rows,
            layered,
            resolve,
            ..Atlas::plain(window, tiles.views)
        };
        // A driver without memory may give no names.
        let mut framebuffers = atlas.framebuffers();
        let named = !atlas.textures.contains(&TextureName::ZERO)
            && framebuffers.all(|name| !name.is_zero());
        drop(framebuffers);
        if status != c::FRAMEBUFFER_COMPLETE || !named {
            atlas.delete(gl);
            return Err(AtlasError::Incomplete {
                views: tiles.views,
                width: tiles.width,
                height: tiles.height,
                samples,
                status,
            });
        }
        Ok(atlas)
    }

    /// Deletes all objects; only while its context is current.
    pub fn delete(mut self, gl: &Gl) {
        if self.is_plain() {
            return;
        }
        self.framebuffers().for_each(|f| gl.delete_framebuffer(f));
        self.textures.iter().for_each(|&t| gl.delete_texture(t));
        let (buffer, fence) = self.give_buffer();
        buffer.into_iter().for_each(|b| gl.delete_buffer(b));
        fence.into_iter().for_each(|f| gl.delete_fence(f));
    }

    /// All framebuffer objects; each has a texture at the first colour attachment.
    pub fn framebuffers(&self) -> impl Iterator<Item = FramebufferName> {
        let resolve = self.resolve.iter().flatten().copied();
        let singles = self.singles.iter().map(Single::framebuffer);
        let depths = self.depths.iter().filter_map(Depths::framebuffer);
        let pyramid = self.pyramid.iter().flat_map(Pyramid::framebuffers);
        let reference = self.reference.iter().flat_map(Reference::framebuffers);
        let views = self.targets().chain(resolve);
        views
            .chain(singles)
            .chain(depths)
            .chain(pyramid)
            .chain(reference)
    }

    /// Whether a texture is the atlas's own.
    pub fn owns(&self, texture: TextureName) -> bool {
        self.textures.contains(&texture)
    }

    /// The names of its textures.
    pub fn textures(&self) -> &[TextureName] {
        &self.textures
    }

    /// Copies the program's own view to all other views that are drawn. The back buffer must be the read buffer, the scissor test off. Changes the framebuffer bindings.
    pub fn share_own(&self, gl: &Gl) {
        let (w, h) = (self.tiles.width as i32, self.tiles.height as i32);
        let own = self.tiles.own();
        let (from, from_x) = self.target(own);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        for view in self.tiles.order().filter(|&view| view != own) {
            let (to, x) = self.target(view);
            if to == from && gl.is_es() {
                self.copy_beside(gl, (from_x, x), [w, h]);
                continue;
            }
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            let all = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT;
            gl.blit_framebuffer(from_x, 0, from_x + w, h, x, 0, x + w, h, all, c::NEAREST);
        }
    }

    /// Copies the true framebuffer 0, of this size in pixels, to the program's own view. The back buffer must be the draw buffer. Changes
    /// the framebuffer bindings; the scissor test must be off. The driver raises errors where a format differs.
    pub fn import(&self, gl: &Gl, [width, height]: [u32; 2]) {
        let (to, x) = self.target(self.tiles.own());
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
        let [w, h] = [width, height].map(|n| n as i32);
        for mask in [
            c::COLOR_BUFFER_BIT,
            c::DEPTH_BUFFER_BIT,
            c::STENCIL_BUFFER_BIT,
        ] {
            gl.blit_framebuffer(0, 0, w, h, x, 0, x + w, h, mask, c::NEAREST);
        }
    }

    /// Copies the program's own view, stretched to the window's size, to the true framebuffer 0. The back buffer must be the read buffer.
    /// Changes the framebuffer bindings; the scissor test must be off. The driver raises errors where a format differs.
    pub fn export(&self, gl: &Gl) {
        let own = self.tiles.own();
        if !self.tiles.grid.is_full() {
            return self.spread(gl, own, FramebufferName::ZERO);
        }
        let (from, x) = self.target(own);
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, FramebufferName::ZERO);
        let [w, h] = [self.tiles.width, self.tiles.height].map(|n| n as i32);
        // Each alone, so that a format that differs keeps no other buffer from being copied.
        for mask in [
            c::COLOR_BUFFER_BIT,
            c::DEPTH_BUFFER_BIT,
            c::STENCIL_BUFFER_BIT,
        ] {
            gl.blit_framebuffer(x, 0, x + w, h, 0, 0, w, h, mask, c::NEAREST);
        }
    }

    /// Copies a tile of the first layer to another tile of that layer: OpenGL ES does not blit within one framebuffer.
    fn copy_beside(&self, gl: &Gl, (from, to): (i32, i32), size: [i32; 2]) {
        let target = match self.resolve {
            Some(_) => c::TEXTURE_2D_MULTISAMPLE_ARRAY,
            None => c::TEXTURE_2D_ARRAY,
        };
        let drawn = 1 + usize::from(!self.depth.is_zero());
        for &texture in self.textures.iter().take(drawn) {
            gl.copy_inside((texture, target), (from, to), size);
        }
    }

    /// Copies the contents of `other`, of the same size and format; its back buffer must be the read buffer. Changes the
    /// framebuffer bindings; the scissor test must be off.
    pub fn copy(&self, gl: &Gl, other: &Atlas) {
        let (w, h) = (self.tiles.texture_width() as i32, self.tiles.height as i32);
        for (&from, &to) in other.rows.iter().zip(&self.rows) {
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            gl.blit_framebuffer(
                0,
                0,
                w,
                h,
                0,
                0,
                w,
                h,
                c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT | c::STENCIL_BUFFER_BIT,
                c::NEAREST,
            );
        }
    }

    /// The framebuffer that replaces the program's 0: the layer of its own view.
    pub fn framebuffer(&self) -> FramebufferName {
        self.rows.first().copied().unwrap_or_default()
    }

    /// Every framebuffer whose attachments are the tiles.
    pub fn targets(&self) -> impl Iterator<Item = FramebufferName> + '_ {
        self.rows.iter().chain(&self.layered).copied()
    }

    /// The layered framebuffer, where there is more than one layer and the driver has it.
    pub fn layered(&self) -> Option<FramebufferName> {
        self.layered
    }

    /// Binds the layer of a view for drawing and returns the x offset of its tile in pixels.
    pub fn enter(&mut self, gl: &Gl, view: ViewIndex) -> i32 {
        let (row, x) = self.tiles.place(view);
        self.bind_row(gl, row);
        x as i32
    }

    /// Binds a layer for drawing.
    pub fn bind_row(&mut self, gl: &Gl, row: u32) {
        if row != self.bound_row
            && let Some(&f) = self.rows.get(row as usize)
        {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, f);
            self.bound_row = row;
        }
    }

    /// Takes note that the caller has bound the framebuffer of the first layer itself.
    pub fn forget_row(&mut self) {
        self.bound_row = 0;
    }

    /// The framebuffer that a view is drawn to, and the x offset of its tile in pixels.
    pub fn target(&self, view: ViewIndex) -> (FramebufferName, i32) {
        let (row, x) = self.tiles.place(view);
        (
            self.rows.get(row as usize).copied().unwrap_or_default(),
            x as i32,
        )
    }

    /// Binds the layered framebuffer for drawing, where there is one.
    pub fn bind_layered(&mut self, gl: &Gl) {
        if let Some(f) = self.layered {
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, f);
            self.bound_row = u32::MAX;
        }
    }

    /// Whether the tiles are multisampled.
    pub fn multisampled(&self) -> bool {
        self.resolve.is_some()
    }

    /// The single-sampled framebuffer to read a view's pixels from, and the x offset of its tile in pixels.
    pub fn readable(&self, view: ViewIndex) -> (FramebufferName, i32) {
        let (row, x) = self.tiles.place(view);
        let f = self
            .resolve
            .as_ref()
            .unwrap_or(&self.rows)
            .get(row as usize)
            .copied();
        (f.unwrap_or_default(), x as i32)
    }

    /// Makes the target of [`Atlas::take_single`], and with `staged` also that of [`Atlas::stage`], where they do not exist yet. The caller
    /// saves and restores bindings as for [`Atlas::new`]. False where the driver makes none.
    pub fn make_singles(
        &mut self,
        gl: &Gl,
        names: &mut Names,
        window: &Window,
        staged: bool,
    ) -> bool {
        while !self.has_singles(staged) {
            let size = [window.width as i32, window.height as i32];
            let single = Single::new(gl, names, window, size, self.flipped, &mut self.textures);
            let status = gl.check_framebuffer_status(c::FRAMEBUFFER);
            self.singles.push(single);
            if status != c::FRAMEBUFFER_COMPLETE {
                return false;
            }
        }
        true
    }

    /// The framebuffer of [`Atlas::take_single`].
    pub fn single(&self) -> Option<FramebufferName> {
        self.singles.first().map(Single::framebuffer)
    }

    /// Whether [`Atlas::make_singles`] has nothing to do.
    pub fn has_singles(&self, staged: bool) -> bool {
        self.singles.len() > usize::from(staged)
    }

    /// Copies a view's tile to a single-sampled framebuffer that holds nothing else, and binds that for reading, with the read buffer `read`.
    /// Changes the draw framebuffer too; the scissor test must be off.
    pub fn take_single(&mut self, gl: &Gl, view: ViewIndex, read: u32) {
        let (from, x) = self.target(view);
        if let Some(single) = self.singles.first() {
            if self.tiles.grid.is_full() {
                single.take(gl, from, x);
            } else {
                self.spread(gl, view, single.framebuffer());
            }
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, single.framebuffer());
            gl.read_buffer(read);
            // The draw framebuffer is no layer now.
            self.bound_row = u32::MAX;
        }
    }

    /// Copies a view's tile to another such framebuffer, binds that for drawing and returns its name; [`Atlas::unstage`] copies it back.
    /// `image` is the buffer that is copied, `read` the read buffer to restore. Changes the read framebuffer too; the scissor test must be off.
    pub fn stage(&mut self, gl: &Gl, view: ViewIndex, image: u32, read: u32) -> FramebufferName {
        let (from, x) = self.target(view);
        let Some(single) = self.singles.get(1) else {
            return from;
        };
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
        gl.read_buffer(image);
        single.take(gl, from, x);
        gl.read_buffer(read);
        self.bound_row = u32::MAX;
        single.framebuffer()
    }

    /// Copies back the tile of [`Atlas::stage`]. Changes the framebuffer bindings; the scissor test must be off.
    pub fn unstage(&mut self, gl: &Gl, view: ViewIndex) {
        let (to, x) = self.target(view);
        if let Some(single) = self.singles.get(1) {
            single.give(gl, to, x);
        }
    }

    /// Resolves the samples of some views; `mask`: the buffers, as bits of glClear. Changes the framebuffer bindings; the scissor test must be
    /// off.
    pub fn resolve(&self, gl: &Gl, views: &ViewSet, mask: u32) {
        let Some(resolve) = &self.resolve else { return };
        let t = &self.tiles;
        let blit = |row: usize, left: u32, width: u32| {
            let (Some(&from), Some(&to)) = (self.rows.get(row), resolve.get(row)) else {
                return;
            };
            gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
            gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, to);
            let [x0, x1, h] = [left, left + width, t.height].map(|n| n as i32);
            gl.blit_framebuffer(x0, 0, x1, h, x0, 0, x1, h, mask, c::NEAREST);
        };
        if ViewIndex::all(t.views).all(|view| views.has(view)) {
            (0..self.rows.len()).for_each(|row| blit(row, 0, t.texture_width()));
            return;
        }
        for view in ViewIndex::all(t.views).filter(|&view| views.has(view)) {
            let (row, left) = t.place(view);
            blit(row as usize, left, t.width);
        }
    }
}
