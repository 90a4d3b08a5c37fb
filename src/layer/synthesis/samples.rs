//! `--what samples`: the samples that slices for a volumetric display are made from (see [`crate::volume::Samples`]).
//!
//! They are taken where the views are synthesised, before anything flat is drawn over them.

use super::super::Layer;
use super::super::frame::tile;
use crate::config::CaptureWhat;
use crate::gl::{Gl, consts as c};
use crate::plan::decide::{DisparityMapping, Scene};
use crate::present::capture::read_rgb;
use crate::state::Neutral;
use crate::volume::{Before, Head, Samples};

impl Layer {
    /// Whether the samples of this frame are to be written.
    fn wants_samples(&self) -> bool {
        let frame = self.diagnostics.report.frames() + 1;
        self.session.config.capture.as_ref().is_some_and(|wanted| {
            wanted.what == CaptureWhat::Samples && (wanted.first..=wanted.last).contains(&frame)
        })
    }

    /// Takes the samples of this frame, if they are wanted and there is a reference image. The state is neutral; changes the read
    /// framebuffer.
    pub(super) fn take_samples(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        scene: &Scene,
        mapping: &DisparityMapping,
    ) {
        self.synthesis.samples = None;
        let reference = self.targets.atlas.reference_framebuffer();
        let (Some(reference), true) = (
            reference.filter(|_| self.synthesis.reference.is_on()),
            self.wants_samples(),
        ) else {
            return;
        };
        let tiles = &self.targets.atlas.tiles;
        let [width, height] = [tiles.width, tiles.height];
        let depths = |x: i32| -> Vec<f32> {
            let depth = |d: &u32| (f64::from(*d) / f64::from(u32::MAX)) as f32;
            upright(
                &gl.read_depth32(neutral.pixels(), x, 0, width, height),
                width,
                depth,
            )
        };
        let own = tile(gl, neutral, &self.targets.atlas, tiles.own()).into_raw();
        let (_, x) = self.targets.atlas.readable(tiles.own());
        let own = (own, depths(x));
        gl.bind_framebuffer(c::READ_FRAMEBUFFER, reference);
        let reference = (
            read_rgb(gl, neutral, 0, 0, width, height).into_raw(),
            depths(0),
        );
        gl.read_buffer(c::COLOR_ATTACHMENT0 + 1);
        let moved = upright(
            &gl.read_red(neutral.pixels(), 0, 0, width, height),
            width,
            |m| *m,
        );
        gl.read_buffer(c::COLOR_ATTACHMENT0);
        let before = scene.before.map(|(mapping, to)| Before {
            line: mapping.ramp.line(),
            to,
        });
        self.synthesis.samples = Some(Samples {
            head: Head {
                size: [width, height],
                viewport: mapping.viewport,
                line: mapping.ramp.line(),
                before,
                clear: scene.clear,
                focal: mapping.shear.conv,
            },
            own,
            reference,
            moved,
        });
    }

    /// The samples of this frame, as the bytes of their file.
    pub(in crate::layer) fn samples(&mut self) -> Vec<u8> {
        match self.synthesis.samples.take() {
            Some(samples) => samples.bytes(),
            None => Samples::nothing(
                "no scene of this frame was drawn in perspective, with depths and by an occlusion camera; give another frame, from 4 on, and see --report for why",
            ),
        }
    }
}

/// Converts values, and turns rows from the bottom into rows from the top.
fn upright<T, U>(rows: &[T], width: u32, value: impl Fn(&T) -> U) -> Vec<U> {
    let rows = rows.rchunks_exact(width.max(1) as usize);
    rows.flatten().map(value).collect()
}
