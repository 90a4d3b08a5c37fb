//! Splats that overlap, blended to one surface: an image for each group of splats that do not overlap, and then their mean (`shaders/deferred.wgsl`,
//! `shaders/compose.wgsl`; Hübner et al., Figures 12 and 13).
#![forbid(unsafe_code)]

use super::{Cloud, Renderer, bind, mask_texture};
use crate::display::Mask;
use crate::gl::{FramebufferName, Gl, PixelStore, RenderbufferName, TextureName, consts as c};
use crate::interleave::Picture;
use crate::interleave::shader::{Group, MASK_UNIT, Points, VIEWS_UNIT};
use crate::splat::groups::Groups;
use crate::splat::{Eyes, Screen, Splat};
use std::ops::Range;

/// Splats in the order of their groups.
#[derive(Clone, Debug)]
pub struct Grouped {
    /// All splats.
    pub splats: Vec<Splat>,
    /// Those of each group.
    pub ranges: Vec<Range<u32>>,
}

impl Grouped {
    /// Partitions splats.
    #[must_use]
    pub fn new(splats: &[Splat]) -> Self {
        let groups = Groups::new(splats);
        let mut sorted: Vec<_> = groups.of.iter().zip(splats).collect();
        sorted.sort_by_key(|(group, _)| **group);
        let end = |group| sorted.partition_point(|(of, _)| **of < group) as u32;
        Self {
            ranges: (0..groups.count)
                .map(|group| end(group)..end(group + 1))
                .collect(),
            splats: sorted.iter().map(|(_, splat)| **splat).collect(),
        }
    }
}

/// An image for each group, and the picture that is made of them.
#[derive(Debug)]
pub struct GroupTarget {
    group: Group,
    screen: Screen,
    images: TextureName,
    framebuffers: Vec<FramebufferName>,
    depths: RenderbufferName,
    mask: TextureName,
    picture: Picture,
}

impl GroupTarget {
    /// For a screen, with what its subpixels show, and so many groups. Changes the bindings.
    #[must_use]
    pub fn new(
        gl: &Gl,
        store: &PixelStore,
        (group, screen): (Group, Screen),
        mask: &Mask,
        groups: usize,
    ) -> Self {
        let (width, height) = screen.size;
        let wide = match group {
            Group::Subpixels => 3 * width,
            _ => width,
        };
        let images = gl.gen_texture();
        gl.bind_texture(c::TEXTURE_2D_ARRAY, images);
        for name in [c::TEXTURE_MIN_FILTER, c::TEXTURE_MAG_FILTER] {
            gl.tex_parameteri(c::TEXTURE_2D_ARRAY, name, c::NEAREST as i32);
        }
        let [w, h, k] = [wide, height, groups as u32].map(|side| side as i32);
        gl.tex_layers_rgba32f(w, h, k);
        let depths = gl.renderbuffer([c::DEPTH_COMPONENT32F as i32, w, h, 0]);
        let framebuffer = |layer| {
            let name = gl.gen_framebuffer();
            gl.bind_framebuffer(c::FRAMEBUFFER, name);
            gl.framebuffer_texture_layer(c::FRAMEBUFFER, c::COLOR_ATTACHMENT0, images, 0, layer);
            let (point, kind) = (c::DEPTH_ATTACHMENT, c::RENDERBUFFER);
            gl.framebuffer_renderbuffer(c::FRAMEBUFFER, point, kind, depths);
            name
        };
        Self {
            group,
            screen,
            images,
            framebuffers: (0..k).map(framebuffer).collect(),
            depths,
            mask: mask_texture(gl, store, mask),
            picture: Picture::new(gl, gl.gen_texture(), screen.size),
        }
    }

    /// Gives the memory back.
    pub fn delete(self, gl: &Gl) {
        gl.delete_texture(self.mask);
        gl.delete_texture(self.images);
        gl.delete_renderbuffer(self.depths);
        for framebuffer in self.framebuffers {
            gl.delete_framebuffer(framebuffer);
        }
        self.picture.delete(gl);
    }
}

impl Renderer {
    /// Draws splats as one surface: what is at most `behind` (ε, in units of camera space) behind the nearest splat is blended with it. `view`: the one that is
    /// drawn, where the target holds one alone. Leaves the framebuffer of the picture bound.
    pub fn blend(
        &self,
        gl: &Gl,
        (cloud, ranges): (&Cloud, &[Range<u32>]),
        (target, view): (&GroupTarget, u32),
        eyes: &Eyes,
        behind: f64,
    ) {
        let (width, height) = (target.screen.size.0 as i32, target.screen.size.1 as i32);
        let wide = match target.group {
            Group::Subpixels => 3 * width,
            _ => width,
        };
        gl.viewport(0, 0, wide, height);
        gl.enable(c::DEPTH_TEST);
        bind(gl, VIEWS_UNIT, cloud.texture);
        bind(gl, MASK_UNIT, target.mask);
        let points = Points::Group(target.group);
        for (framebuffer, range) in target.framebuffers.iter().zip(ranges) {
            gl.bind_framebuffer(c::FRAMEBUFFER, *framebuffer);
            gl.clear(c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
            self.send(gl, (points, &target.screen), eyes, view, range.clone());
        }
        gl.disable(c::DEPTH_TEST);
        gl.bind_framebuffer(c::FRAMEBUFFER, target.picture.framebuffer);
        gl.viewport(0, 0, width, height);
        gl.active_texture(c::TEXTURE0 + VIEWS_UNIT);
        gl.bind_texture(c::TEXTURE_2D_ARRAY, target.images);
        // As in `shaders/compose.wgsl`.
        let kind = match target.group {
            Group::Subpixels => 0,
            Group::View => 1,
            Group::Rays | Group::Parameters => 2,
        };
        let [near, behind] = [eyes.near, behind].map(|depth| (depth as f32).to_bits());
        let groups = target.framebuffers.len() as u32;
        self.compose
            .bind(gl, &[groups, kind, 0, 0, near, behind, 0, 0]);
        gl.draw_triangle(self.vertices);
    }
}
