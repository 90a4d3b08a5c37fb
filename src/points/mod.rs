//! Splats drawn by the GPU, once for all views, straight into the pixels of a panel (`shaders/points.wgsl`; the mathematics are those of [`crate::splat`]).
#![forbid(unsafe_code)]

pub mod charts;
pub mod compare;
pub mod cost;
mod deferred;
pub mod neighbours;

pub use deferred::{GroupTarget, Grouped};

use crate::display::{GUARD, Mask};
use crate::gl::{Gl, PixelStore, RenderbufferName, TextureName, VertexArrayName, consts as c};
use crate::interleave::shader::{Group, MASK_UNIT, Pass, Points, VIEWS_UNIT};
use crate::interleave::{Picture, Program};
use crate::splat::{Eyes, Screen, Splat};
use std::ops::Range;

/// Splats in a row of their texture.
const ROW: u32 = 1024;
/// Texels of a splat.
const TEXELS: usize = 3;
/// Pixels by which a quad is larger than its disk, for what the GPU rounds.
const MARGIN: f32 = 0.01;

/// Splats in the memory of the GPU.
#[derive(Debug)]
pub struct Cloud {
    texture: TextureName,
    count: u32,
}

impl Cloud {
    /// Sends splats to the GPU. Changes the texture that is bound.
    #[must_use]
    pub fn new(gl: &Gl, store: &PixelStore, splats: &[Splat]) -> Self {
        let count = splats.len() as u32;
        let rows = count.div_ceil(ROW).max(1);
        let mut texels = Vec::with_capacity((rows * ROW) as usize * TEXELS);
        for splat in splats {
            let [p, n] = [splat.centre, splat.normal].map(|v| v.as_vec3());
            let [r, g, b] = splat.colour;
            texels.extend([
                [p.x, p.y, p.z, splat.radius as f32],
                [n.x, n.y, n.z, 0.0],
                [r, g, b, 1.0],
            ]);
        }
        texels.resize((rows * ROW) as usize * TEXELS, [0.0; 4]);
        let texture = data_texture(gl);
        let width = ROW as usize * TEXELS;
        gl.tex_image_rgba32f(store, width as i32, rows as i32, &texels);
        Self { texture, count }
    }

    /// Gives the memory back.
    pub fn delete(self, gl: &Gl) {
        gl.delete_texture(self.texture);
    }
}

/// A picture with depths that splats are drawn into.
#[derive(Debug)]
pub struct Target {
    points: Points,
    screen: Screen,
    image: Picture,
    depths: RenderbufferName,
    mask: TextureName,
    /// The picture of the panel, where that is made of subpixels.
    panel: Option<Picture>,
}

impl Target {
    /// For a screen, with what its subpixels show. Changes the bindings.
    #[must_use]
    pub fn new(
        gl: &Gl,
        store: &PixelStore,
        (points, screen): (Points, Screen),
        mask: &Mask,
    ) -> Self {
        let (width, height) = screen.size;
        let panel = (points == Points::Subpixels)
            .then(|| Picture::new(gl, gl.gen_texture(), (width, height)));
        let wide = if panel.is_some() { 3 * width } else { width };
        let image = Picture::new(gl, gl.gen_texture(), (wide, height));
        let format = [c::DEPTH_COMPONENT32F as i32, wide as i32, height as i32, 0];
        let depths = gl.renderbuffer(format);
        gl.framebuffer_renderbuffer(c::FRAMEBUFFER, c::DEPTH_ATTACHMENT, c::RENDERBUFFER, depths);
        let mask = mask_texture(gl, store, mask);
        Self {
            points,
            screen,
            image,
            depths,
            mask,
            panel,
        }
    }

    /// Gives the memory back.
    pub fn delete(self, gl: &Gl) {
        gl.delete_texture(self.mask);
        gl.delete_renderbuffer(self.depths);
        for picture in [Some(self.image), self.panel].into_iter().flatten() {
            picture.delete(gl);
        }
    }
}

/// The texture of a mask, which it leaves bound.
fn mask_texture(gl: &Gl, store: &PixelStore, mask: &Mask) -> TextureName {
    let texels: Vec<[u16; 4]> = mask
        .rows()
        .flat_map(|row| row.iter().map(|&[r, g, b]| [r, g, b, 0]))
        .collect();
    let texture = data_texture(gl);
    let (wide, high) = (mask.width() as i32, mask.height() as i32);
    gl.tex_image_rgba16ui(store, wide, high, &texels);
    texture
}

/// A 2D texture of numbers, which it leaves bound.
fn data_texture(gl: &Gl) -> TextureName {
    let texture = gl.gen_texture();
    gl.bind_texture(c::TEXTURE_2D, texture);
    for name in [c::TEXTURE_MIN_FILTER, c::TEXTURE_MAG_FILTER] {
        gl.tex_parameteri(c::TEXTURE_2D, name, c::NEAREST as i32);
    }
    texture
}

/// The programs that draw splats.
#[derive(Debug)]
pub struct Renderer {
    programs: Vec<(Points, Program)>,
    join_subpixels: Program,
    compose: Program,
    /// Without arrays.
    vertices: VertexArrayName,
}

impl Renderer {
    /// For a context whose shading language has this version × 100.
    ///
    /// # Errors
    /// The text of the driver, which refuses a program.
    pub fn new(gl: &Gl, glsl: u32) -> Result<Self, String> {
        let program =
            |points| Ok::<_, String>((points, Program::new(gl, glsl, Pass::Points(points))?));
        Ok(Self {
            programs: Points::ALL
                .map(program)
                .into_iter()
                .collect::<Result<_, _>>()?,
            join_subpixels: Program::new(gl, glsl, Pass::Subpixels)?,
            compose: Program::new(gl, glsl, Pass::Compose)?,
            vertices: gl.gen_vertex_array(),
        })
    }

    /// Draws splats as opaque disks over a black picture. `view`: the one that is drawn, where the target holds one alone. Leaves the framebuffer of the picture
    /// bound.
    pub fn draw(&self, gl: &Gl, cloud: &Cloud, (target, view): (&Target, u32), eyes: &Eyes) {
        let (width, height) = (target.screen.size.0 as i32, target.screen.size.1 as i32);
        let wide = if target.panel.is_some() {
            3 * width
        } else {
            width
        };
        gl.bind_framebuffer(c::FRAMEBUFFER, target.image.framebuffer);
        gl.viewport(0, 0, wide, height);
        gl.enable(c::DEPTH_TEST);
        gl.clear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
        bind(gl, VIEWS_UNIT, cloud.texture);
        bind(gl, MASK_UNIT, target.mask);
        self.send(
            gl,
            (target.points, &target.screen),
            eyes,
            view,
            0..cloud.count,
        );
        gl.disable(c::DEPTH_TEST);
        if let Some(panel) = &target.panel {
            gl.bind_framebuffer(c::FRAMEBUFFER, panel.framebuffer);
            gl.viewport(0, 0, width, height);
            bind(gl, VIEWS_UNIT, target.image.texture);
            self.join_subpixels.bind(gl, &[]);
            gl.draw_triangle(self.vertices);
        }
    }

    /// Draws some splats of the cloud that is bound.
    fn send(
        &self,
        gl: &Gl,
        (points, screen): (Points, &Screen),
        eyes: &Eyes,
        view: u32,
        splats: Range<u32>,
    ) {
        let mut all = self.programs.iter();
        if let Some((_, program)) = all.find(|(known, _)| *known == points) {
            program.bind(gl, &words((points, screen), eyes, view, splats.start));
            gl.draw_triangles(self.vertices, splats.end - splats.start);
        }
    }
}

fn bind(gl: &Gl, unit: u32, texture: TextureName) {
    gl.active_texture(c::TEXTURE0 + unit);
    gl.bind_texture(c::TEXTURE_2D, texture);
}

/// The words of `Uniforms` in `shaders/points.wgsl`. `first`: the first splat that is drawn.
fn words((points, screen): (Points, &Screen), eyes: &Eyes, view: u32, first: u32) -> [u32; 16] {
    let (width, height) = screen.size;
    let margin = match points {
        // The ray of a subpixel is that of its pixel, whose middle is up to a third aside.
        Points::Subpixels | Points::Group(Group::Subpixels) => 1.0 / 3.0 + MARGIN,
        _ => MARGIN,
    };
    let [spacing, focal, near, half] =
        [eyes.spacing, eyes.focal, eyes.near, screen.half].map(|value| (value as f32).to_bits());
    [
        width,
        height,
        // The mask is as large as the picture.
        width,
        height,
        ROW,
        GUARD.into(),
        eyes.views,
        view,
        spacing,
        focal,
        near,
        half,
        margin.to_bits(),
        MARGIN.to_bits(),
        0,
        (first as f32).to_bits(),
    ]
}
