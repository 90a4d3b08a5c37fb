//! Views of a depth image by the driver: what [`super::warp`] says, pixel by pixel backwards.
//!
//! A ray of the other camera is a straight line over the heights of a row (see `shaders/field.wgsl`), so what it sees is the first sample that it
//! meets. How high and how low blocks of a row are leads it over what it cannot meet, and
//! straight to what is a plane. What is hidden it seeks in the reference image of an occlusion camera, where there is one (see
//! `shaders/bent.wgsl`); that camera's map is made here as well, and has to be what [`super::Bending`] says.

use crate::atlas::{Atlas, BendTarget, FieldTarget, FieldTextures, Tiles};
use crate::config::{Behind, Filter};
use crate::gl::{Gl, consts as c};
use crate::interleave::shader::{
    DEPTH_UNIT, PEAKS_UNIT, Pass, RANGE_UNIT, STEPS_UNITS, Synthesis, Uniforms, VIEWS_UNIT,
};
use crate::interleave::{Heights, Layout, Places, Program, bind_bent};

/// The passes of one context.
#[derive(Debug)]
pub struct Passes {
    vertex_array: u32,
    peaks: Program,
    tops: Program,
    range: Program,
    /// Where nothing else is known of what is hidden, or several views are drawn.
    view: Program,
    bent: Option<Bent>,
}

/// Those of an occlusion camera.
#[derive(Debug)]
struct Bent {
    steps: Program,
    splats: Program,
    map: Program,
    view: Program,
}

impl Passes {
    /// For a context whose shading language has this version × 100; `behind`: what is to be known of what is hidden. The error is naga's or
    /// the driver's.
    pub fn new(gl: &Gl, glsl: u32, behind: Behind) -> Result<Passes, String> {
        let program = |pass| Program::new(gl, glsl, Pass::Synthesis(pass));
        let camera = || {
            Ok::<_, String>(Bent {
                steps: program(Synthesis::Steps)?,
                splats: program(Synthesis::Splats)?,
                map: program(Synthesis::Bends)?,
                view: program(Synthesis::View(Behind::Reference))?,
            })
        };
        let bent = behind == Behind::Reference;
        let plain = match behind {
            Behind::Nothing | Behind::Reference => Behind::Nothing,
            Behind::Views => Behind::Views,
        };
        Ok(Passes {
            peaks: program(Synthesis::Peaks)?,
            tops: program(Synthesis::Tops)?,
            range: program(Synthesis::Range)?,
            view: program(Synthesis::View(plain))?,
            bent: bent.then(camera).transpose()?,
            vertex_array: gl.gen_vertex_array(),
        })
    }

    /// Whether an occlusion camera is among them.
    pub fn bends(&self) -> bool {
        self.bent.is_some()
    }

    /// The names of its programs.
    pub fn programs(&self) -> impl Iterator<Item = u32> {
        let bent = self
            .bent
            .iter()
            .flat_map(|b| [&b.steps, &b.splats, &b.map, &b.view]);
        [&self.peaks, &self.tops, &self.range, &self.view]
            .into_iter()
            .chain(bent)
            .map(Program::name)
    }

    /// Learns how high the views are whose textures these are, the own one or all that are drawn. State must be as
    /// `present::Saved::take` leaves it; changes the framebuffers that are bound.
    pub fn measure(&self, gl: &Gl, atlas: &mut Atlas, heights: &Heights, textures: &FieldTextures) {
        for (unit, texture) in [
            (VIEWS_UNIT, textures.colour),
            (DEPTH_UNIT, textures.depth),
            (PEAKS_UNIT, textures.peaks),
            (RANGE_UNIT, textures.tops),
        ] {
            gl.active_texture(c::TEXTURE0 + unit);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        gl.bind_vertex_array(self.vertex_array);
        let height = atlas.tiles.height as i32;
        let own = atlas.tiles.own();
        for layer in 0..heights.sources.map_or(1, |sources| sources.count()) {
            let view = heights.sources.map_or(own, |sources| sources.view(layer));
            let (row, left) = match textures.copied {
                true => (layer, 0),
                false => atlas.tiles.place(view),
            };
            let places = Places::One([left, row, layer]);
            let heights = Heights { places, ..*heights };
            let words = uniforms(&atlas.tiles, atlas.flipped, heights).words();
            for (program, target) in [
                (&self.peaks, FieldTarget::Peaks),
                (&self.tops, FieldTarget::Tops),
                (&self.range, FieldTarget::Range),
            ] {
                let width = atlas.enter_field(gl, target, layer);
                gl.viewport(0, 0, width, height);
                program.bind(gl, &words);
                gl.draw_arrays(c::TRIANGLES, 0, 3);
            }
        }
        gl.active_texture(c::TEXTURE0 + RANGE_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, textures.range);
    }

    /// Makes the distortion map of the own view, which has been measured, for the next frame; false where there is none.
    pub fn bend(&self, gl: &Gl, atlas: &mut Atlas, heights: &Heights) -> bool {
        let (Some(bent), Some(textures)) = (&self.bent, atlas.bent()) else {
            return false;
        };
        let words = uniforms(&atlas.tiles, atlas.flipped, *heights).words();
        for (unit, texture) in STEPS_UNITS.into_iter().zip(textures.steps) {
            gl.active_texture(c::TEXTURE0 + unit);
            gl.bind_texture(c::TEXTURE_2D_ARRAY, texture);
        }
        let height = atlas.tiles.height as i32;
        for (program, target) in [
            (&bent.steps, BendTarget::Steps),
            (&bent.splats, BendTarget::Splats),
            (&bent.map, BendTarget::Map),
        ] {
            let width = atlas.enter_bends(gl, target);
            gl.viewport(0, 0, width, height);
            program.bind(gl, &words);
            gl.draw_arrays(c::TRIANGLES, 0, 3);
        }
        true
    }

    /// Makes the views that are shown, and not drawn, of copies of those that are, which have been measured: colours, and depths for what is drawn
    /// after them. The depth test must pass and write everything; changes the framebuffers that are bound.
    pub fn views(&self, gl: &Gl, atlas: &mut Atlas, heights: &Heights, textures: &FieldTextures) {
        let (tiles, own) = (atlas.tiles, atlas.tiles.own());
        bind_bent(gl, textures.bent);
        let bent = self.bent.as_ref().filter(|_| textures.bent.is_some());
        let program = bent.map_or(&self.view, |bent| &bent.view);
        let drawn = |view: u32| match &heights.sources {
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
            let heights = Heights {
                aim: (view, left as u32),
                places,
                ..*heights
            };
            let words = uniforms(&tiles, atlas.flipped, heights).words();
            program.bind(gl, &words);
            gl.draw_arrays(c::TRIANGLES, 0, 3);
        }
    }
}

fn uniforms(tiles: &Tiles, top_down: bool, heights: Heights) -> Uniforms {
    let tile = [tiles.width, tiles.height];
    Uniforms {
        tile,
        stride: tiles.stride,
        picture: tile,
        columns: tiles.columns,
        views: tiles.views,
        layout: Layout::View(0),
        rows_top_down: top_down,
        linear: false,
        filter: Filter::Nearest,
        period: [1; 2],
        column_bits: 0,
        black: 0,
        matrices: Default::default(),
        depth: [0.0; 2],
        grid: tiles.grid,
        heights,
    }
}
