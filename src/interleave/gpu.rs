//! The output passes in the program's context: on the GPU, or by the CPU reference where the context's GLSL is too old.

use super::shader::{MASK_UNIT, Pass, Uniforms, VIEWS_UNIT};
use super::{Layout, Program, reference};
use crate::atlas::{Names, Tiles};
use crate::config::{Config, Output};
use crate::display::{Mask, Placement};
use crate::gl::{Gl, consts as c};
use image::RgbImage;

/// The atlas as the passes see it.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    /// Places of the views.
    pub tiles: Tiles,
    /// The array texture.
    pub texture: u32,
    /// Its rows run top down.
    pub top_down: bool,
    /// Its colours are stored as sRGB, and so are the window's.
    pub srgb: bool,
}

/// Programs and mask of one context.
#[derive(Debug)]
pub struct Interleaver {
    vertex_array: u32,
    panel: Option<Program>,
    layout: Option<Program>,
    mask: Option<(u32, u32, Mask)>,
    mask_texture: u32,
    mask_uploaded: (u32, u32),
    cpu: Option<String>,
}

/// GL_SHADING_LANGUAGE_VERSION × 100; 0 where there is none.
pub fn glsl_version(gl: &Gl) -> u32 {
    let s = gl.get_string(c::SHADING_LANGUAGE_VERSION);
    let mut parts = s.split(['.', ' ']).map(|p| p.parse::<u32>().unwrap_or(0));
    parts.next().unwrap_or(0) * 100 + parts.next().unwrap_or(0)
}

/// A texture name that is taken from now on.
fn reserve(gl: &Gl, names: &mut Names) -> u32 {
    let name = names.texture(gl);
    let bound = gl.get_integer(c::TEXTURE_BINDING_2D) as u32;
    gl.bind_texture(c::TEXTURE_2D, name);
    gl.bind_texture(c::TEXTURE_2D, bound);
    name
}

impl Interleaver {
    /// Compiles the passes. Where that fails the CPU takes over and [`Interleaver::note`] says why.
    pub fn new(gl: &Gl, names: &mut Names, glsl: u32) -> Self {
        let mut i = Interleaver {
            vertex_array: 0,
            panel: None,
            layout: None,
            mask: None,
            mask_texture: 0,
            mask_uploaded: (0, 0),
            cpu: None,
        };
        let program = |pass| Program::new(gl, glsl, pass);
        match (program(Pass::Interleave), program(Pass::Layout)) {
            (Ok(panel), Ok(layout)) => {
                (i.panel, i.layout) = (Some(panel), Some(layout));
                i.vertex_array = gl.gen_vertex_array();
                i.mask_texture = reserve(gl, names);
            }
            (Err(e), _) | (_, Err(e)) => i.cpu = Some(e),
        }
        i
    }

    /// What the user should know about how pictures are made.
    pub fn note(&self) -> Option<String> {
        self.cpu
            .as_ref()
            .map(|e| format!("pictures are interleaved by the CPU: {e}"))
    }

    /// The name of the mask's texture, 0 for none.
    pub fn texture(&self) -> u32 {
        self.mask_texture
    }

    /// The names of its programs.
    pub fn programs(&self) -> impl Iterator<Item = u32> {
        self.panel.iter().chain(&self.layout).map(Program::name)
    }

    /// The mask's texture gets another name: its contents are made anew.
    pub fn rename(&mut self, gl: &Gl, names: &mut Names) {
        if self.mask_texture != 0 {
            gl.delete_texture(self.mask_texture);
            self.mask_texture = reserve(gl, names);
            self.mask_uploaded = (0, 0);
        }
    }

    /// Draws the picture of an output over the whole framebuffer that is bound, `size` pixels; `tile` reads one view for the CPU
    /// (and may change the read framebuffer). State must be as `present::Saved::take` leaves it.
    pub fn draw(
        &mut self,
        gl: &Gl,
        config: &Config,
        source: &Source,
        tile: &mut dyn FnMut(u32) -> RgbImage,
        output: Output,
        size: (u32, u32),
    ) -> Result<(), String> {
        let layout = Layout::of(output, config.views, config.display.facts.quilt);
        if layout.is_none() && self.mask.as_ref().is_none_or(|m| (m.0, m.1) != size) {
            let placement = Placement::full_screen(size.0, size.1);
            let mask = config
                .display
                .mask(&placement, config.views)
                .map_err(|e| e.to_string())?;
            self.mask = Some((size.0, size.1, mask));
        }
        let program = if layout.is_none() {
            &self.panel
        } else {
            &self.layout
        };
        let Some(program) = program else {
            return self.draw_by_cpu(gl, config, tile, layout, size);
        };
        gl.viewport(0, 0, size.0 as i32, size.1 as i32);
        gl.active_texture(c::TEXTURE0 + MASK_UNIT);
        if layout.is_none() {
            gl.bind_texture(c::TEXTURE_2D, self.mask_texture);
            if let (Some((w, h, mask)), true) = (&self.mask, self.mask_uploaded != size) {
                let texels: Vec<[u16; 4]> =
                    mask.data().iter().map(|&[r, g, b]| [r, g, b, 0]).collect();
                gl.tex_image_rgba16ui(*w as i32, *h as i32, &texels);
                for (p, v) in [
                    (c::TEXTURE_MIN_FILTER, c::NEAREST),
                    (c::TEXTURE_MAG_FILTER, c::NEAREST),
                    (c::TEXTURE_MAX_LEVEL, 0),
                ] {
                    gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
                }
                self.mask_uploaded = size;
            }
        }
        gl.active_texture(c::TEXTURE0 + VIEWS_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, source.texture);
        let t = &source.tiles;
        let uniforms = Uniforms {
            tile: [t.width, t.height],
            stride: t.stride,
            picture: [size.0, size.1],
            columns: t.columns,
            views: t.views,
            layout: layout.unwrap_or(Layout::SideBySide),
            rows_top_down: source.top_down,
        };
        program.bind(gl, &uniforms.words());
        gl.bind_vertex_array(self.vertex_array);
        // A view is decoded to linear light when it is fetched; written to an sRGB window it is encoded again.
        if source.srgb {
            gl.enable(c::FRAMEBUFFER_SRGB);
        }
        gl.draw_arrays(c::TRIANGLES, 0, 3);
        if source.srgb {
            gl.disable(c::FRAMEBUFFER_SRGB);
        }
        Ok(())
    }

    fn draw_by_cpu(
        &self,
        gl: &Gl,
        config: &Config,
        tile: &mut dyn FnMut(u32) -> RgbImage,
        layout: Option<Layout>,
        size: (u32, u32),
    ) -> Result<(), String> {
        let tiles: Vec<RgbImage> = (0..config.views).map(tile).collect();
        let picture = match (layout, &self.mask) {
            (Some(layout), _) => reference::arrange(&tiles, layout, size),
            (None, Some((_, _, mask))) => reference::interleave(&tiles, mask),
            (None, None) => return Ok(()),
        };
        let mut picture = picture.map_err(|e| e.to_string())?;
        image::imageops::flip_vertical_in_place(&mut picture);
        gl.push_attrib(c::ALL_ATTRIB_BITS);
        gl.disable(c::TEXTURE_2D);
        gl.disable(c::FOG);
        gl.window_pos_2i(0, 0);
        gl.draw_pixels_rgb(size.0 as i32, size.1 as i32, picture.as_raw());
        gl.pop_attrib();
        Ok(())
    }
}
