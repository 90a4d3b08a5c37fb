//! The output passes in the program's context: on the GPU, or by the CPU reference where the context's GLSL is too old.

use super::shader::{DEPTH_UNIT, MASK_UNIT, Pass, Uniforms, VIEWS_UNIT};
use super::{Depth, Form, Layout, Program, reference, rgbd};
use crate::atlas::{Names, Tiles};
use crate::config::{Config, Filter, Output};
use crate::display::{Display, Lens, Mask, Placement};
use crate::gl::{Gl, consts as c};
use image::RgbImage;

/// The atlas as the passes see it.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Places of the views.
    pub tiles: Tiles,
    /// The array texture.
    pub texture: u32,
    /// Its rows run top down.
    pub top_down: bool,
    /// The array texture of their depths, 0 where the window has none, and what is in it of the own view; only where the output
    /// shows it.
    pub depth: Option<(u32, &'a Depth)>,
    /// Its colours are stored as sRGB, and so are the window's.
    pub srgb: bool,
}

/// The panel that is in force.
#[derive(Clone, Copy, Debug)]
pub struct Glass<'a> {
    /// Its description.
    pub display: &'a Display,
    /// Where the picture lies on it.
    pub placement: Placement,
}

/// What a mask depends on that can change.
type Of = (Output, Placement, Option<Lens>);

/// Programs and mask of one context.
#[derive(Debug)]
pub struct Interleaver {
    vertex_array: u32,
    panel: Option<Program>,
    layout: Option<Program>,
    anaglyph: Option<Program>,
    rgbd: Option<Program>,
    /// Of an output whose picture lay there.
    mask: Option<(Of, Mask)>,
    mask_texture: u32,
    mask_uploaded: Option<Of>,
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
            anaglyph: None,
            rgbd: None,
            mask: None,
            mask_texture: 0,
            mask_uploaded: None,
            cpu: None,
        };
        let program = |pass| Program::new(gl, glsl, pass);
        match [Pass::Interleave, Pass::Layout, Pass::Anaglyph, Pass::Rgbd].map(program) {
            [Ok(panel), Ok(layout), Ok(anaglyph), Ok(rgbd)] => {
                i.panel = Some(panel);
                i.layout = Some(layout);
                i.anaglyph = Some(anaglyph);
                i.rgbd = Some(rgbd);
                i.vertex_array = gl.gen_vertex_array();
                i.mask_texture = reserve(gl, names);
            }
            programs => i.cpu = programs.into_iter().find_map(Result::err),
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
        let programs = [&self.panel, &self.layout, &self.anaglyph, &self.rgbd];
        programs.into_iter().flatten().map(Program::name)
    }

    /// The mask's texture gets another name: its contents are made anew.
    pub fn rename(&mut self, gl: &Gl, names: &mut Names) {
        if self.mask_texture != 0 {
            gl.delete_texture(self.mask_texture);
            self.mask_texture = reserve(gl, names);
            self.mask_uploaded = None;
        }
    }

    /// Draws the picture of an output over the whole framebuffer that is bound, which lies on `glass`; `tile` reads one view for the
    /// CPU (and may change the read framebuffer). State must be as `present::Saved::take` leaves it.
    pub fn draw(
        &mut self,
        gl: &Gl,
        config: &Config,
        source: &Source,
        tile: &mut dyn FnMut(u32) -> RgbImage,
        output: Output,
        glass: &Glass,
    ) -> Result<(), String> {
        let placement = &glass.placement;
        let form = Form::of(config, glass.display, output);
        let of = (output, *placement, glass.display.lens());
        if self.mask.as_ref().is_none_or(|(known, _)| *known != of)
            && let Some(mask) = form.mask(placement, config.views)
        {
            self.mask = Some((of, mask.map_err(|e| e.to_string())?));
        }
        let program = match form {
            Form::Panel(..) | Form::Eyes(_) => &self.panel,
            Form::Layout(_) => &self.layout,
            Form::Anaglyph(_) => &self.anaglyph,
            Form::Rgbd => &self.rgbd,
        };
        let Some(program) = program else {
            let depth = source.depth.map(|(_, depth)| depth);
            return self.draw_by_cpu(gl, config, tile, depth, &form, placement);
        };
        let size = [placement.width, placement.height];
        gl.viewport(0, 0, size[0] as i32, size[1] as i32);
        gl.active_texture(c::TEXTURE0 + MASK_UNIT);
        if let Form::Panel(..) | Form::Eyes(_) = form {
            gl.bind_texture(c::TEXTURE_2D, self.mask_texture);
            if let Some((known, mask)) = &self.mask
                && self.mask_uploaded != Some(*known)
            {
                let texels: Vec<[u16; 4]> =
                    mask.data().iter().map(|&[r, g, b]| [r, g, b, 0]).collect();
                gl.tex_image_rgba16ui(mask.width() as i32, mask.height() as i32, &texels);
                for (p, v) in [
                    (c::TEXTURE_MIN_FILTER, c::NEAREST),
                    (c::TEXTURE_MAG_FILTER, c::NEAREST),
                    (c::TEXTURE_MAX_LEVEL, 0),
                ] {
                    gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
                }
                self.mask_uploaded = Some(*known);
            }
        }
        if let Some((texture, _)) = source.depth {
            gl.active_texture(c::TEXTURE0 + DEPTH_UNIT);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        gl.active_texture(c::TEXTURE0 + VIEWS_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, source.texture);
        let t = &source.tiles;
        let uniforms = Uniforms {
            tile: [t.width, t.height],
            stride: t.stride,
            picture: size,
            columns: t.columns,
            views: t.views,
            layout: match form {
                Form::Layout(layout) => layout,
                _ => Layout::View(0),
            },
            rows_top_down: source.top_down,
            eyes: matches!(form, Form::Eyes(_)),
            linear: source.srgb,
            filter: match form {
                Form::Panel(_, filter) => filter,
                _ => Filter::Nearest,
            },
            matrices: match form {
                Form::Anaglyph(anaglyph) => anaglyph.matrices(),
                _ => Default::default(),
            },
            grid: t.grid.follows_lenses().then_some(t.grid),
            depth: source.depth.map_or([0.0; 2], |(_, depth)| depth.ends),
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
        depth: Option<&Depth>,
        form: &Form,
        placement: &Placement,
    ) -> Result<(), String> {
        let tiles: Vec<RgbImage> = (0..config.views).map(tile).collect();
        let size = (placement.width, placement.height);
        let picture = match (form, &self.mask) {
            (Form::Layout(layout), _) => reference::arrange(&tiles, *layout, size),
            (Form::Anaglyph(anaglyph), _) => reference::anaglyph(&tiles, *anaglyph, size),
            (Form::Rgbd, _) => match (depth, tiles.get((tiles.len().max(1) - 1) / 2)) {
                (Some(depth), Some(own)) => rgbd(own, depth, size),
                _ => return Ok(()),
            },
            (Form::Panel(_, filter), Some((_, mask))) => reference::filtered(&tiles, mask, *filter),
            (Form::Eyes(_), Some((_, mask))) => {
                reference::interleave(&reference::eyes(tiles), mask)
            }
            (Form::Panel(..) | Form::Eyes(_), None) => return Ok(()),
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
