//! The output passes in the program's context: on the GPU, or by the CPU reference where a pass does not compile.

use super::shader::{
    BLOCK_BOUNDS_UNIT, DEPTH_UNIT, MASK_UNIT, MaskUniforms, Pass, RAY_RANGE_UNIT, REFERENCE_UNITS,
    SampleAligned, Synthesis, Texels, Uniforms, VIEWS_UNIT, WARP_UNIT,
};
use super::sheet::{self, Sheet};
use super::{Depth, Disparities, Form, Layout, Program, reference, rgbd};
use crate::atlas::{Names, PyramidTextures, ReferenceTextures, Tiles, ViewSet};
use crate::config::{Config, DisocclusionSource, Filter, Output};
use crate::display::{Display, Fit, GUARD, Lens, Mask, Placement, Wall};
use crate::gl::{Gl, PixelStore, ProgramName, TextureName, VertexArrayName, consts as c};
use crate::state::Neutral;
use crate::view::ViewIndex;
use image::RgbImage;

/// The atlas as the passes see it.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Places of the views.
    pub tiles: Tiles,
    /// The array texture.
    pub texture: TextureName,
    /// Row 0 of the texture is the top row.
    pub top_down: bool,
    /// The array texture of the depths, 0 where the window has none, and the depths of the own view; only where the output shows
    /// them.
    pub depth: Option<(TextureName, &'a Depth)>,
    /// Only where the panel's picture is synthesised straight from the drawn views: their disparity pyramids and disparities.
    pub pyramid: Option<(PyramidTextures, Disparities)>,
    /// Colours of the atlas are stored as sRGB, and so are the window's.
    pub srgb: bool,
}

/// The current panel, and the place of the picture on it.
#[derive(Clone, Copy, Debug)]
pub struct PanelPlacement<'a> {
    /// Its description.
    pub display: &'a Display,
    /// Where the picture lies on it.
    pub placement: Placement,
}

/// The variable inputs of a mask.
type Of = (Output, Placement, Option<Lens>);

/// Programs and mask of one context.
#[derive(Debug)]
pub struct Interleaver {
    vertex_array: VertexArrayName,
    /// Empty where the CPU computes pictures.
    programs: Vec<(Pass, Program)>,
    /// The last mask, and the inputs that it was made for.
    mask: Option<(Of, Mask)>,
    /// The views in the mask.
    shown: ViewSet,
    /// The mask has no black subpixels.
    lit: bool,
    mask_texture: TextureName,
    uploaded: Option<Uploaded>,
    /// The nodes of a wall; 0 where the display is none.
    warp_texture: TextureName,
    /// Which window and fit its nodes are for.
    warped: Option<([u32; 2], Fit)>,
    cpu: Option<String>,
    /// The program's, from before the mask was uploaded.
    errors: Vec<u32>,
    refused: bool,
}

/// The contents of the mask's texture.
#[derive(Clone, Copy, Debug)]
struct Uploaded {
    of: Of,
    /// The tiles, if the texture holds tile addresses instead of views.
    places: Option<Tiles>,
    period: [u32; 2],
    whole: bool,
    black: u32,
}

/// GL_SHADING_LANGUAGE_VERSION × 100, also of OpenGL ES; 0 where there is none.
pub fn glsl_version(gl: &Gl) -> u32 {
    let s = gl.get_string(c::SHADING_LANGUAGE_VERSION);
    let s = s.trim_start_matches("OpenGL ES GLSL ES ");
    let mut parts = s.split(['.', ' ']).map(|p| p.parse::<u32>().unwrap_or(0));
    parts.next().unwrap_or(0) * 100 + parts.next().unwrap_or(0)
}

/// Bits that hold the column of a tile.
fn column_bits(tiles: &Tiles) -> u32 {
    u32::BITS - (tiles.columns.max(1) - 1).leading_zeros()
}

/// Layer and column of a view's tile in one number, for the passes of texels; black where there is no such view.
fn tile_address(tiles: &Tiles, view: u32) -> u32 {
    if view >= tiles.views {
        return u32::from(GUARD);
    }
    let slot = tiles.slot(ViewIndex(view));
    (slot / tiles.columns) << column_bits(tiles) | (slot % tiles.columns)
}

/// Binds the textures of a reference image.
pub fn bind_reference(gl: &Gl, textures: Option<ReferenceTextures>) {
    let all = textures.map(|reference| [reference.map].into_iter().chain(reference.image));
    for (texture, unit) in all.into_iter().flatten().zip(REFERENCE_UNITS) {
        gl.active_texture(c::TEXTURE0 + unit);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
    }
}

/// A texture name that is reserved by binding it once.
fn reserve(gl: &Gl, names: &mut Names) -> TextureName {
    let name = names.texture(gl);
    let bound = TextureName(gl.get_integer(c::TEXTURE_BINDING_2D) as u32);
    gl.bind_texture(c::TEXTURE_2D, name);
    gl.bind_texture(c::TEXTURE_2D, bound);
    name
}

impl Interleaver {
    /// Compiles the output passes, with `wall` that of walls, and with `synthesis` those that synthesise a panel's picture with this source of disocclusions. Where one fails,
    /// the CPU takes over and [`Interleaver::note`] says why.
    pub fn new(
        gl: &Gl,
        names: &mut Names,
        glsl: u32,
        wall: bool,
        synthesis: Option<DisocclusionSource>,
    ) -> Self {
        let mut i = Interleaver {
            vertex_array: VertexArrayName::ZERO,
            programs: Vec::new(),
            mask: None,
            shown: ViewSet::ALL,
            lit: false,
            mask_texture: TextureName::ZERO,
            uploaded: None,
            warp_texture: TextureName::ZERO,
            warped: None,
            cpu: None,
            errors: Vec::new(),
            refused: false,
        };
        let panels = Synthesis::ALL.into_iter().filter(|pass| match pass {
            // The first frame has no reference image, so it needs the pass without one.
            Synthesis::Panel { source, .. } => {
                synthesis == Some(*source)
                    || (synthesis, *source)
                        == (
                            Some(DisocclusionSource::Reference),
                            DisocclusionSource::Nothing,
                        )
            }
            _ => false,
        });
        let panels = panels.map(Pass::Synthesis);
        let walls = wall.then_some(Pass::Wall);
        for pass in Pass::OUTPUTS.into_iter().chain(walls).chain(panels) {
            match Program::new(gl, glsl, pass) {
                Ok(program) => i.programs.push((pass, program)),
                Err(e) => {
                    i.programs
                        .drain(..)
                        .for_each(|(_, p)| gl.delete_program(p.name()));
                    i.cpu = Some(e);
                    return i;
                }
            }
        }
        i.vertex_array = gl.gen_vertex_array();
        i.mask_texture = reserve(gl, names);
        if wall {
            i.warp_texture = reserve(gl, names);
        }
        i
    }

    /// Whether shaders compute the pictures, and not the CPU.
    pub fn on_gpu(&self) -> bool {
        self.cpu.is_none()
    }

    /// A note for the user where the CPU computes the pictures.
    pub fn note(&self) -> Option<String> {
        self.cpu
            .as_ref()
            .map(|e| format!("pictures are interleaved by the CPU: {e}"))
    }

    /// The vertex array of passes, which has no attributes.
    pub fn vertex_array(&self) -> VertexArrayName {
        self.vertex_array
    }

    /// Takes the errors that were found before the mask was uploaded: they are the program's, oldest first.
    pub fn take_errors(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.errors)
    }

    /// Whether the driver has refused the mask of the last picture, which is wrong then. The next one uploads it again.
    pub fn is_mask_refused(&self) -> bool {
        self.refused
    }

    /// The views that some subpixel of the last picture through a mask showed.
    pub fn shown(&self) -> ViewSet {
        self.shown
    }

    /// Whether no subpixel of an output is black. False until a picture of that output was made.
    pub fn lit(&self, output: Output) -> bool {
        let known = self
            .mask
            .as_ref()
            .is_some_and(|((of, ..), _)| *of == output);
        known && self.lit
    }

    /// The GL names of its textures.
    pub fn textures(&self) -> impl Iterator<Item = TextureName> {
        let all = [self.mask_texture, self.warp_texture].into_iter();
        all.filter(|name| !name.is_zero())
    }

    /// The GL names of all programs.
    pub fn programs(&self) -> impl Iterator<Item = ProgramName> {
        self.programs.iter().map(|(_, program)| program.name())
    }

    /// Gives the mask's texture another name, whose contents are then uploaded anew.
    pub fn rename(&mut self, gl: &Gl, names: &mut Names) {
        if !self.mask_texture.is_zero() {
            gl.delete_texture(self.mask_texture);
            self.mask_texture = reserve(gl, names);
            self.uploaded = None;
        }
        if !self.warp_texture.is_zero() {
            gl.delete_texture(self.warp_texture);
            self.warp_texture = reserve(gl, names);
            self.warped = None;
        }
    }

    /// Draws the picture of an output over the whole of the bound framebuffer, whose place is given by `panel`. `tile` reads back one
    /// view for the CPU, and may change the read framebuffer. The error says why there is no picture.
    #[allow(
        clippy::too_many_arguments,
        reason = "the parts of one picture; a struct of them would be built for this call alone"
    )]
    pub fn draw(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        config: &Config,
        source: &Source,
        tile: &mut dyn FnMut(ViewIndex) -> RgbImage,
        output: Output,
        panel: &PanelPlacement,
    ) -> Result<(), String> {
        let placement = &panel.placement;
        let form = Form::of(config, panel.display, output);
        let of = (output, *placement, panel.display.lens());
        self.know(of, &form, config)?;
        let size = [placement.width, placement.height];
        self.refused = false;
        let pass = self.pass(gl, neutral.pixels(), of, &form, source, size);
        let Some((_, program)) = self.programs.iter().find(|(known, _)| *known == pass) else {
            let tiles: Vec<RgbImage> = ViewIndex::all(config.views).map(tile).collect();
            if let Some(picture) = self.picture_by_cpu(tiles, source, &form, placement)? {
                draw_picture(gl, neutral, picture);
            }
            return Ok(());
        };
        gl.viewport(0, 0, size[0] as i32, size[1] as i32);
        if let Some((texture, _)) = source.depth {
            gl.active_texture(c::TEXTURE0 + DEPTH_UNIT);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        if let Some((textures, _)) = source.pyramid {
            for (unit, texture) in [
                (DEPTH_UNIT, textures.depth),
                (RAY_RANGE_UNIT, textures.ray_range),
                (BLOCK_BOUNDS_UNIT, textures.block_bounds),
            ] {
                gl.active_texture(c::TEXTURE0 + unit);
                gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
            }
            bind_reference(gl, textures.reference);
        }
        gl.active_texture(c::TEXTURE0 + VIEWS_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, source.texture);
        let tiles = source.tiles;
        let uniforms = Uniforms {
            tiles,
            rows_top_down: source.top_down,
            picture: size,
            layout: match form {
                Form::Layout(layout) => layout,
                _ => Layout::View(0),
            },
            linear: source.srgb,
            mask: MaskUniforms {
                filter: match form {
                    Form::Panel(_, filter) => filter,
                    _ => Filter::Nearest,
                },
                period: self.uploaded.map_or([1; 2], |known| known.period),
                column_bits: column_bits(&tiles),
                black: self.uploaded.map_or(0, |known| known.black),
            },
            matrices: match form {
                Form::Anaglyph(anaglyph) => anaglyph.matrices(),
                _ => Default::default(),
            },
            depth: source.depth.map_or([0.0; 2], |(_, depth)| depth.ends),
            disparities: source
                .pyramid
                .map_or(Disparities::default(), |(_, disparities)| disparities),
        };
        program.bind(gl, &uniforms.words());
        // A view is decoded to linear light when it is fetched, and encoded again when it is written to an sRGB window.
        if source.srgb {
            gl.enable_srgb(true);
        }
        gl.draw_triangle(self.vertex_array);
        if source.srgb {
            gl.enable_srgb(false);
        }
        Ok(())
    }

    /// Computes the mask of a picture, where it is not that of the last one.
    fn know(&mut self, of: Of, form: &Form, config: &Config) -> Result<(), String> {
        if self.mask.as_ref().is_none_or(|(known, _)| *known != of)
            && let Some(mask) = form.mask(&of.1, config.views)
        {
            let mask = mask.map_err(|e| e.to_string())?;
            let shown = mask.views_shown().into_iter();
            self.shown = shown.map(|view| ViewIndex(view.into())).collect();
            self.lit = !mask.data().as_flattened().contains(&GUARD);
            self.mask = Some((of, mask));
        }
        Ok(())
    }

    /// Binds the mask of a panel's picture, which then holds views: the columns and rows after which it repeats, and whether all subpixels of a pixel show the same view.
    /// None where there is no such mask, or the CPU makes the pictures.
    pub fn bind_views(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        config: &Config,
        panel: &PanelPlacement,
    ) -> Option<([u32; 2], bool)> {
        let form = Form::of(config, panel.display, Output::Panel);
        let of = (Output::Panel, panel.placement, panel.display.lens());
        if !matches!(form, Form::Panel(_, Filter::Nearest)) {
            return None;
        }
        self.know(of, &form, config).ok()?;
        let known = self.upload(gl, neutral.pixels(), of, None, None)?;
        (!self.refused).then_some((known.period, known.whole))
    }

    /// The pass of a picture. Binds the mask where the pass needs it.
    fn pass(
        &mut self,
        gl: &Gl,
        pixels: &PixelStore,
        of: Of,
        form: &Form,
        source: &Source,
        size: [u32; 2],
    ) -> Pass {
        let tiles = &source.tiles;
        if let Some((textures, disparities)) = source.pyramid
            && let Some(Uploaded { whole, .. }) = self.upload(gl, pixels, of, None, None)
        {
            let source = textures.disocclusion_source(disparities.sources.is_some());
            return Pass::Synthesis(Synthesis::Panel { whole, source });
        }
        let texels = tiles.grid.is_full() && [tiles.width, tiles.height] == size;
        if let Form::Wall(wall, fit) = form {
            self.upload(gl, pixels, of, None, None);
            self.upload_warp(gl, pixels, wall, (tiles.window, *fit));
            return Pass::Wall;
        }
        let filter = match form {
            Form::Layout(Layout::View(_)) if texels => return Pass::Whole,
            Form::Layout(_) => return Pass::Layout,
            Form::Anaglyph(_) => return Pass::Anaglyph,
            Form::Rgbd => return Pass::Rgbd,
            Form::Panel(_, filter) => *filter,
            Form::Wall(..) | Form::Interlaced(_) => Filter::Nearest,
        };
        let same_size = [tiles.width, tiles.height] == size;
        let lenses = filter == Filter::Nearest && !(tiles.grid.is_full() && same_size);
        let fits = tiles.rows << column_bits(tiles) < u32::from(GUARD);
        let places = (texels && filter == Filter::Nearest && fits).then_some(*tiles);
        let eyes = matches!(form, Form::Interlaced(_));
        let Some(known) = self.upload(gl, pixels, of, places, eyes.then_some(tiles.views)) else {
            return Pass::Interleave;
        };
        match places {
            None if lenses && tiles.grid.exact && known.whole => {
                Pass::SampleAligned(SampleAligned::Pixels)
            }
            None if lenses => Pass::SampleAligned(SampleAligned::Texels),
            None => Pass::Interleave,
            Some(_) if known.whole => Pass::Texels(Texels::Pixels),
            Some(tiles) if tiles.rows == 1 => Pass::Texels(Texels::SubpixelsOfOneLayer),
            Some(_) => Pass::Texels(Texels::Subpixels),
        }
    }

    /// Binds the mask, and uploads it where the texture holds another one. The texture holds views, or tile addresses with `places`. A mask
    /// of two eyes, with `eyes` the number of views, has the last view in place of view 1. None where there is no texture or no mask.
    fn upload(
        &mut self,
        gl: &Gl,
        pixels: &PixelStore,
        of: Of,
        places: Option<Tiles>,
        eyes: Option<u32>,
    ) -> Option<Uploaded> {
        if self.mask_texture.is_zero() {
            return None;
        }
        gl.active_texture(c::TEXTURE0 + MASK_UNIT);
        gl.bind_texture(c::TEXTURE_2D, self.mask_texture);
        if let Some(known) = self.uploaded
            && (known.of, known.places) == (of, places)
        {
            return Some(known);
        }
        let (_, mask) = self.mask.as_ref()?;
        let sheet = Sheet::new(mask, |view| {
            let view = match eyes {
                Some(views) if view == 1 => views - 1,
                _ => u32::from(view),
            };
            places.map_or(view, |tiles| tile_address(&tiles, view)) as u16
        });
        let [columns, rows] = sheet.period.map(|n| n as i32);
        self.errors.extend(gl.take_errors());
        match &sheet.texels {
            sheet::Texels::Bytes(texels) => gl.tex_image_rgba8ui(pixels, columns, rows, texels),
            sheet::Texels::Words(texels) => gl.tex_image_rgba16ui(pixels, columns, rows, texels),
        }
        for (p, v) in [
            (c::TEXTURE_MIN_FILTER, c::NEAREST),
            (c::TEXTURE_MAG_FILTER, c::NEAREST),
            (c::TEXTURE_MAX_LEVEL, 0),
        ] {
            gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
        }
        self.refused = gl.drop_errors() > 0;
        let uploaded = Uploaded {
            of,
            places,
            period: sheet.period,
            whole: sheet.whole,
            black: u32::from(sheet.black),
        };
        self.uploaded = (!self.refused).then_some(uploaded);
        Some(uploaded)
    }

    /// Binds the nodes of a wall for the picture of a window, and uploads them where the texture holds others.
    fn upload_warp(&mut self, gl: &Gl, pixels: &PixelStore, wall: &Wall, of: ([u32; 2], Fit)) {
        gl.active_texture(c::TEXTURE0 + WARP_UNIT);
        gl.bind_texture(c::TEXTURE_2D, self.warp_texture);
        if self.warped == Some(of) {
            return;
        }
        let (columns, rows) = wall.node_count();
        let nodes = wall.nodes(of.0.into(), of.1);
        let texels: Vec<[f32; 4]> = nodes
            .iter()
            .map(|[u, v, light]| [*u, *v, *light, 0.0])
            .collect();
        self.errors.extend(gl.take_errors());
        gl.tex_image_rgba32f(pixels, columns as i32, rows as i32, &texels);
        for (p, v) in [
            (c::TEXTURE_MIN_FILTER, c::NEAREST),
            (c::TEXTURE_MAG_FILTER, c::NEAREST),
            (c::TEXTURE_MAX_LEVEL, 0),
        ] {
            gl.tex_parameteri(c::TEXTURE_2D, p, v as i32);
        }
        self.refused |= gl.drop_errors() > 0;
        self.warped = (!self.refused).then_some(of);
    }

    /// The picture of an output, computed by the CPU. None where the depth of RGBD, or the mask, is missing.
    fn picture_by_cpu(
        &self,
        tiles: Vec<RgbImage>,
        source: &Source,
        form: &Form,
        placement: &Placement,
    ) -> Result<Option<RgbImage>, String> {
        let depth = source.depth.map(|(_, depth)| depth);
        let size = (placement.width, placement.height);
        let picture = match (form, &self.mask) {
            (Form::Layout(layout), _) => reference::arrange(&tiles, *layout, size),
            (Form::Anaglyph(anaglyph), _) => reference::anaglyph(&tiles, *anaglyph, size),
            (Form::Rgbd, _) => match (depth, tiles.get((tiles.len().max(1) - 1) / 2)) {
                (Some(depth), Some(own)) => rgbd(own, depth, size),
                _ => return Ok(None),
            },
            (Form::Panel(_, filter), Some((_, mask))) => reference::filtered(&tiles, mask, *filter),
            (Form::Wall(wall, fit), Some((_, mask))) => {
                let nodes = wall.nodes(source.tiles.window.into(), *fit);
                super::wall::wall(&tiles, mask, &nodes, wall.node_count().0)
            }
            (Form::Interlaced(_), Some((_, mask))) => {
                reference::interleave(&reference::eyes(tiles), mask)
            }
            (Form::Panel(..) | Form::Wall(..) | Form::Interlaced(_), None) => return Ok(None),
        };
        picture.map(Some).map_err(|e| e.to_string())
    }
}

/// Draws a picture into the window with the fixed-function pipeline.
fn draw_picture(gl: &Gl, neutral: &Neutral, mut picture: RgbImage) {
    image::imageops::flip_vertical_in_place(&mut picture);
    let [width, height] = [picture.width(), picture.height()].map(|n| n as i32);
    gl.push_attrib(c::ALL_ATTRIB_BITS);
    gl.disable(c::TEXTURE_2D);
    gl.disable(c::FOG);
    gl.window_pos_2i(0, 0);
    gl.draw_pixels_rgb(neutral.pixels(), width, height, picture.as_raw());
    gl.pop_attrib();
}

#[cfg(test)]
mod tests;
