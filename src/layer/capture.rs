//! Frames written to files.

use super::Layer;
use super::frame::tile;
use crate::config::{Capture, CaptureWhat, Output};
use crate::display::QuiltName;
use crate::gl::{FramebufferName, Gl, consts as c};
use crate::interleave::{Form, Layout, Source, reference, rgbd};
use crate::present::capture;
use crate::state::Neutral;
use crate::view::ViewIndex;
use std::path::{Path, PathBuf};

impl Layer {
    /// Writes the frame where an option or a request to the running program asks for it.
    pub(super) fn capture(&mut self, gl: &Gl, neutral: &Neutral, image: u32, source: &Source) {
        let frame = self.diagnostics.report.frames() + 1;
        if let Some(wanted) = &self.session.config.capture
            && (wanted.first..=wanted.last).contains(&frame)
        {
            self.diagnostics.write(self.session.config, frame);
            if let Err(e) = self.write(gl, neutral, (image, source), wanted, frame) {
                self.diagnostics
                    .report
                    .note(format!("capture of frame {frame}: {e}"));
            }
        }
        self.take_picture(gl, neutral, (image, source), frame);
    }

    /// Writes what is wanted of the frame and returns the file's path. Changes the framebuffers that are bound.
    pub(super) fn write(
        &mut self,
        gl: &Gl,
        neutral: &Neutral,
        (image, source): (u32, &Source),
        wanted: &Capture,
        frame: u64,
    ) -> Result<PathBuf, String> {
        let (width, height) = self.size();
        let form = Form::of(
            self.session.config,
            &self.session.config.display,
            self.output(),
        );
        let path = self.picture_path(form, wanted, frame);
        let last = self.session.config.views - 1;
        let all: Vec<u32> = (0..self.session.config.views).collect();
        let row = Layout::SideBySide { half: false };
        let written = match wanted.what {
            CaptureWhat::Output if self.output() == Output::Quad => {
                self.arranged(gl, neutral, &[0, last], row, &path)
            }
            CaptureWhat::Output => match form {
                Form::Layout(layout) => self.arranged(gl, neutral, &all, layout, &path),
                Form::Rgbd => {
                    let own = tile(gl, neutral, &self.targets.atlas, source.tiles.own());
                    let size = row.native_size(2, own.dimensions());
                    rgbd(&own, &self.own_depth(gl, neutral), size)
                        .map_err(|e| e.to_string())
                        .and_then(|i| capture::write(&i, &path))
                }
                _ => {
                    let panel = self.panel_picture(
                        gl,
                        image,
                        source.depth.map(|(_, depth)| depth),
                        neutral,
                    );
                    let picture = panel.unwrap_or_else(|| {
                        gl.bind_framebuffer(c::READ_FRAMEBUFFER, FramebufferName::ZERO);
                        capture::read_rgb(gl, neutral, 0, 0, width, height)
                    });
                    capture::write(&picture, &path)
                }
            },
            CaptureWhat::Atlas => self.arranged(gl, neutral, &all, row, &path),
            CaptureWhat::View(v) => {
                capture::write(&tile(gl, neutral, &self.targets.atlas, ViewIndex(v)), &path)
            }
            CaptureWhat::Reference => self
                .reference_image(gl, neutral)
                .and_then(|i| capture::write(&i, &path)),
            CaptureWhat::Samples => capture::write_bytes(&self.samples(), &path),
            CaptureWhat::Depth => {
                let own = self.targets.atlas.tiles.own_alone();
                self.targets.atlas.resolve(gl, &own, c::DEPTH_BUFFER_BIT);
                let t = &source.tiles;
                let (from, x) = self.targets.atlas.readable(t.own());
                gl.bind_framebuffer(c::READ_FRAMEBUFFER, from);
                capture::write(
                    &capture::read_depth(gl, neutral, x, 0, t.width, t.height),
                    &path,
                )
            }
        };
        gl.bind_framebuffer(c::FRAMEBUFFER, FramebufferName::ZERO);
        written.map(|()| path)
    }

    /// The file of a picture: that of this process, where an option asks for it.
    fn picture_path(&mut self, form: Form<'_>, wanted: &Capture, frame: u64) -> PathBuf {
        let path = match (wanted.what, form) {
            (CaptureWhat::Output, Form::Layout(Layout::Quilt { columns, rows })) => {
                let name = QuiltName::new((columns, rows), self.size());
                wanted.path_with(frame, &name.to_string())
            }
            _ => wanted.path_for(frame),
        };
        let config = self.session.config;
        if config.capture.as_ref() == Some(wanted) {
            let claims = &mut self.diagnostics.report.claims;
            return claims.path(config, &wanted.out, path);
        }
        // Who asks a running program for a picture means this process.
        path
    }

    /// Writes views in a layout, at the full size of their tiles, whatever the window's size.
    fn arranged(
        &self,
        gl: &Gl,
        neutral: &Neutral,
        views: &[u32],
        layout: Layout,
        path: &Path,
    ) -> Result<(), String> {
        let atlas = &self.targets.atlas;
        let tile_size = (atlas.tiles.width, atlas.tiles.height);
        let size = layout.native_size(views.len() as u32, tile_size);
        let views: Vec<_> = views
            .iter()
            .map(|&v| tile(gl, neutral, atlas, ViewIndex(v)))
            .collect();
        reference::arrange(&views, layout, size)
            .map_err(|e| e.to_string())
            .and_then(|i| capture::write(&i, path))
    }
}
