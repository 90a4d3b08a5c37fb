//! Synthesises views from depth images on the GPU: the backward warp, pixel by pixel, whose result [`super::warp`] defines.
//!
//! A ray of another camera is a straight line over the disparities of a row (see `shaders/disparity.wgsl`), and it sees the first surface that it
//! meets. The greatest and least disparities of blocks of a row let it skip samples that it cannot meet. A ray that ends in a hole seeks hidden
//! samples in the reference image of an occlusion camera, where there is one (see `shaders/reference.wgsl`). The distortion map of that camera is
//! computed here as well; [`super::RowDistortionMap`] defines it.

use crate::atlas::{Atlas, DistortionTarget, PyramidTarget, PyramidTextures, Tiles};
use crate::config::DisocclusionSource;
use crate::gl::{Gl, ProgramName, VertexArrayName, consts as c};
use crate::interleave::shader::{
    BLOCK_BOUNDS_UNIT, DEPTH_UNIT, MaskUniforms, Pass, RAY_RANGE_UNIT, STEPS_UNITS, Synthesis,
    Uniforms, VIEWS_UNIT,
};
use crate::interleave::{Disparities, Layout, Places, Program, bind_reference};
use crate::state::Neutral;
use crate::view::ViewIndex;

/// The passes of one context.
#[derive(Debug)]
pub struct Passes {
    vertex_array: VertexArrayName,
    block_bounds: Program,
    row_maxima: Program,
    ray_range: Program,
    /// Synthesises a view from the own view alone, or from several drawn views.
    view: Program,
    reference: Option<Reference>,
}

/// The passes of an occlusion camera.
#[derive(Debug)]
struct Reference {
    steps: Program,
    splats: Program,
    map: Program,
    view: Program,
}

impl Passes {
    /// For a context whose shading language has this version × 100; `source` is that of disocclusions. The error is the text of naga or of the
    /// driver.
    pub fn new(gl: &Gl, glsl: u32, source: DisocclusionSource) -> Result<Passes, String> {
        let program = |pass| Program::new(gl, glsl, Pass::Synthesis(pass));
        let camera = || {
            Ok::<_, String>(Reference {
                steps: program(Synthesis::Steps)?,
                splats: program(Synthesis::Splats)?,
                map: program(Synthesis::DistortionMap)?,
                view: program(Synthesis::View(DisocclusionSource::Reference))?,
            })
        };
        let reference = source == DisocclusionSource::Reference;
        let plain = match source {
            DisocclusionSource::Nothing | DisocclusionSource::Reference => {
                DisocclusionSource::Nothing
            }
            DisocclusionSource::Views => DisocclusionSource::Views,
        };
        Ok(Passes {
            block_bounds: program(Synthesis::BlockBounds)?,
            row_maxima: program(Synthesis::RowMaxima)?,
            ray_range: program(Synthesis::RayRange)?,
            view: program(Synthesis::View(plain))?,
            reference: reference.then(camera).transpose()?,
            vertex_array: gl.gen_vertex_array(),
        })
    }

    /// Whether the passes of an occlusion camera are among them.
    pub fn distorts(&self) -> bool {
        self.reference.is_some()
    }

    /// The GL names of all programs.
    pub fn programs(&self) -> impl Iterator<Item = ProgramName> {
        let reference = self
            .reference
            .iter()
            .flat_map(|b| [&b.steps, &b.splats, &b.map, &b.view]);
        [
            &self.block_bounds,
            &self.row_maxima,
            &self.ray_range,
            &self.view,
        ]
        .into_iter()
        .chain(reference)
        .map(Program::name)
    }

    /// Computes the disparity pyramids of the views in these textures: of the own view, or of all that are drawn. The state must be that of
    /// [`crate::state::Neutral`]; the bindings of framebuffers change.
    pub fn measure(
        &self,
        gl: &Gl,
        _: &Neutral,
        atlas: &mut Atlas,
        disparities: &Disparities,
        textures: &PyramidTextures,
    ) {
        for (unit, texture) in [
            (VIEWS_UNIT, textures.colour),
            (DEPTH_UNIT, textures.depth),
            (BLOCK_BOUNDS_UNIT, textures.block_bounds),
            (RAY_RANGE_UNIT, textures.row_maxima),
        ] {
            gl.active_texture(c::TEXTURE0 + unit);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        let height = atlas.tiles.height as i32;
        let own = atlas.tiles.own();
        for layer in 0..disparities.sources.map_or(1, |sources| sources.count()) {
            let view = disparities
                .sources
                .map_or(own, |sources| sources.view(layer));
            let (row, left) = match textures.copied {
                true => (layer, 0),
                false => atlas.tiles.place(view),
            };
            let places = Places::One([left, row, layer]);
            let disparities = Disparities {
                places,
                ..*disparities
            };
            let words = uniforms(&atlas.tiles, atlas.flipped, disparities).words();
            for (program, target) in [
                (&self.block_bounds, PyramidTarget::BlockBounds),
                (&self.row_maxima, PyramidTarget::RowMaxima),
                (&self.ray_range, PyramidTarget::RayRange),
            ] {
                let width = atlas.enter_pyramid(gl, target, layer);
                gl.viewport(0, 0, width, height);
                program.bind(gl, &words);
                gl.draw_triangle(self.vertex_array);
            }
        }
        gl.active_texture(c::TEXTURE0 + RAY_RANGE_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, textures.ray_range);
    }

    /// Computes the distortion map for the next frame from the own view, which has been measured. False without an occlusion camera.
    pub fn map_distortion(
        &self,
        gl: &Gl,
        _: &Neutral,
        atlas: &mut Atlas,
        disparities: &Disparities,
    ) -> bool {
        let (Some(reference), Some(textures)) = (&self.reference, atlas.reference()) else {
            return false;
        };
        let words = uniforms(&atlas.tiles, atlas.flipped, *disparities).words();
        for (unit, texture) in STEPS_UNITS.into_iter().zip(textures.steps) {
            gl.active_texture(c::TEXTURE0 + unit);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        let height = atlas.tiles.height as i32;
        for (program, target) in [
            (&reference.steps, DistortionTarget::Steps),
            (&reference.splats, DistortionTarget::Splats),
            (&reference.map, DistortionTarget::Map),
        ] {
            let width = atlas.enter_distortion(gl, target);
            gl.viewport(0, 0, width, height);
            program.bind(gl, &words);
            gl.draw_triangle(self.vertex_array);
        }
        true
    }

    /// Synthesises the views that are shown but not drawn from the textures of those that are drawn, which have been measured. Writes colours, and
    /// depths for later draws. The depth test must pass and write everything; the bindings of framebuffers change.
    pub fn views(
        &self,
        gl: &Gl,
        _: &Neutral,
        atlas: &mut Atlas,
        disparities: &Disparities,
        textures: &PyramidTextures,
    ) {
        let (tiles, own) = (atlas.tiles, atlas.tiles.own());
        bind_reference(gl, textures.reference);
        let reference = self
            .reference
            .as_ref()
            .filter(|_| textures.reference.is_some());
        let program = reference.map_or(&self.view, |reference| &reference.view);
        let drawn = |view: ViewIndex| match &disparities.sources {
            Some(sources) => sources.has(view),
            None => view == own,
        };
        let places = match textures.copied {
            true => Places::Copies,
            false => Places::Tiles,
        };
        for view in tiles.order().filter(|&view| !drawn(view)) {
            let left = atlas.enter(gl, view);
            gl.viewport(left, 0, tiles.width as i32, tiles.height as i32);
            let disparities = Disparities {
                aim: (view.0, left as u32),
                places,
                ..*disparities
            };
            let words = uniforms(&tiles, atlas.flipped, disparities).words();
            program.bind(gl, &words);
            gl.draw_triangle(self.vertex_array);
        }
    }
}

fn uniforms(tiles: &Tiles, top_down: bool, disparities: Disparities) -> Uniforms {
    Uniforms {
        tiles: *tiles,
        rows_top_down: top_down,
        picture: [tiles.width, tiles.height],
        layout: Layout::View(0),
        linear: false,
        mask: MaskUniforms::default(),
        matrices: Default::default(),
        depth: [0.0; 2],
        disparities,
    }
}
