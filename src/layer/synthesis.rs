//! `--strategy depth-image`: the scene goes to the program's own view alone, and the others are synthesised from it and its depths. `hybrid`: it
//! goes to some views, and the others are synthesised from those beside them.
//!
//! From a clear of the depths on, opaque draws in perspective by one projection go to these views only. Before anything else (the HUD, glass,
//! another clear, a copy of the frame) the other views are synthesised into their tiles, with their depths, and all that follows is drawn in
//! each view. Where nothing else follows, the panel's picture is synthesised straight from the views that are drawn.

mod samples;
mod surface;

use super::occlusion::{REACH, ReferenceImage};
use super::{Layer, keep_bindings};
use crate::atlas::{PyramidTextures, ViewSet};
use crate::config::{CaptureWhat, Config, DisocclusionSource, Filter, Output, TrueViews};
use crate::gl::{Gl, ProgramName, consts as c};
use crate::interleave::{Cleared, Disparities, Places, Sources};
use crate::plan::Governor;
use crate::plan::decide::Scene;
use crate::plan::reason::Hindrance;
use crate::state::{BACK, Neutral};
use crate::synthesis::Passes;
use crate::view::ViewIndex;
use crate::volume::Samples;
use surface::Surfaces;

/// Steps of the depth buffer by which the depths of synthesised views lie behind the computed ones.
const MARGIN: f64 = 4.0;

/// State of the synthesis of views.
#[derive(Debug, Default)]
pub(super) struct Synthesis {
    /// The passes of the synthesis; none where the strategy has none, or the driver cannot run them.
    pub(super) passes: Option<Passes>,
    /// The views that the scene is drawn in; none where it is the own one alone.
    sources: Option<Sources>,
    /// How many views a scene is drawn in.
    number: Number,
    /// How many views were drawn in this frame, where others were synthesised from them.
    drew: Option<u32>,
    pub(super) reference: ReferenceImage,
    surfaces: Surfaces,
    /// The disparity pyramid, while the panel's picture is synthesised straight from the views that are drawn.
    pyramid: Option<(PyramidTextures, Disparities)>,
    /// Samples of this frame's scene, where they are to be written.
    samples: Option<Samples>,
}

/// How many views are drawn.
#[derive(Debug, Default)]
enum Number {
    /// The own view alone.
    #[default]
    One,
    /// Always this many, from which the others are synthesised.
    Fixed(u32),
    /// As many as the wanted frame rate allows.
    Governed(Governor),
}

impl Number {
    fn of(config: &Config) -> Number {
        match (config.synthesis(), config.true_views) {
            // Others cannot be synthesised from more, so all views are drawn.
            (Some(DisocclusionSource::Views), TrueViews::Fixed(count)) if count > Sources::MOST => {
                Number::Fixed(config.views)
            }
            (Some(DisocclusionSource::Views), TrueViews::Fixed(count)) => Number::Fixed(count),
            (Some(DisocclusionSource::Views), TrueViews::Rate(rate)) => {
                Number::Governed(Governor::new(rate, config.views, Sources::MOST))
            }
            _ => Number::One,
        }
    }

    /// Number of views that are drawn; none where it is the own one alone.
    fn views(&self) -> Option<u32> {
        match self {
            Number::One => None,
            Number::Fixed(count) => Some(*count),
            Number::Governed(governor) => Some(governor.level()),
        }
    }
}

impl Synthesis {
    /// Makes the passes where the user has asked for synthesis. The note says what prevents it.
    pub(super) fn new(gl: &Gl, config: &Config, glsl: u32) -> (Synthesis, Option<String>) {
        let passes = config
            .synthesis()
            .map(|source| Passes::new(gl, glsl, source))
            .transpose();
        let (passes, note) = match passes {
            Ok(passes) => (passes, None),
            Err(e) => (None, Some(format!("all views are drawn: {e}"))),
        };
        let synthesis = Synthesis {
            passes,
            number: Number::of(config),
            ..Synthesis::default()
        };
        (synthesis, note)
    }

    /// The names of its programs.
    pub(super) fn programs(&self) -> impl Iterator<Item = ProgramName> {
        self.passes.iter().flat_map(Passes::programs)
    }

    /// A scene begins: chooses the views that it is drawn in.
    pub(super) fn begin(&mut self, own: ViewIndex, views: u32) {
        self.surfaces.forget();
        let count = self.number();
        self.sources = count.map(|count| Sources::spread(own, views, count));
    }

    /// The views that the scene is drawn in, beside the own one, which is always drawn.
    pub(super) fn drawn(&self) -> ViewSet {
        let sources = self.sources.iter();
        sources.flat_map(|sources| sources.iter()).collect()
    }

    /// The views of a frame are synthesised from these; none where that is the own one alone.
    pub(super) fn draws(&mut self, sources: Option<Sources>) {
        self.drew = sources.map(|sources| sources.count());
    }

    /// Number of views that a scene is drawn in, as sources of the others; none where it is the own one alone.
    pub(super) fn number(&self) -> Option<u32> {
        self.passes.as_ref().and_then(|_| self.number.views())
    }

    /// Number of views that the next scene is drawn in, where it follows the time that frames take.
    pub(super) fn governed(&self) -> Option<u32> {
        match &self.number {
            Number::Governed(governor) => Some(governor.level()),
            Number::One | Number::Fixed(_) => None,
        }
    }

    /// Number of views that a scene may be drawn in at most, for `views` in all: the layers of the disparity pyramid.
    pub(super) fn most(&self, views: u32) -> u32 {
        match &self.number {
            Number::One => 1,
            Number::Fixed(count) => (*count).min(Sources::MOST),
            Number::Governed(_) => Sources::MOST.min(views),
        }
    }

    /// A frame of `views` in all took so many milliseconds, which may change the number of views that the next scene is drawn in. Returns how
    /// many views the frame drew; none where scenes are drawn in the own view alone.
    pub(super) fn timed(&mut self, ms: f32, views: u32) -> Option<u32> {
        let number = self.number()?;
        let drawn = self.drew.take();
        // A frame without synthesis, such as a menu, does not tell what drawn views cost.
        if (drawn.is_some() || number == views)
            && let Number::Governed(governor) = &mut self.number
        {
            governor.frame(ms);
        }
        Some(drawn.unwrap_or(views))
    }

    /// The disparity pyramid from which the panel's picture is synthesised straight; none where all views are there.
    pub(super) fn straight(&self) -> Option<(PyramidTextures, Disparities)> {
        self.pyramid
    }
}

impl Layer {
    /// Number of views that are drawn where none is synthesised.
    fn needed(&self) -> u32 {
        let (wanted, own) = (self.wanted_views(), self.targets.atlas.tiles.own());
        let needed = ViewIndex::all(self.session.config.views)
            .filter(|&view| view == own || wanted.has(view));
        needed.count() as u32
    }

    /// Why atlas, output or settings do not allow that views are synthesised; none where they do.
    pub(super) fn hindrance(&self) -> Option<Hindrance> {
        let drawn = self.synthesis.number();
        let unwanted = self.session.config.prove.is_some()
            || self.session.live.flat
            || drawn.is_some_and(|n| n >= self.needed());
        let grid = self.targets.atlas.tiles.grid;
        let hindrances = [
            (unwanted, Hindrance::Unwanted),
            (!grid.is_full(), Hindrance::Scaled),
            (self.targets.atlas.depth.is_zero(), Hindrance::NoDepths),
            (!self.targets.back_alone(), Hindrance::Buffers),
        ];
        let first = hindrances.into_iter().find(|(hinders, _)| *hinders);
        first.map(|(_, hindrance)| hindrance)
    }

    /// Ends the scene that only some views have: synthesises the others into their tiles. From now on all of them are drawn.
    pub(super) fn synthesise_views(&mut self, gl: &Gl) {
        let Some(scene) = self.known.scene.take() else {
            return;
        };
        self.known.synthesised = true;
        self.targets.atlas.tiles.shown = self.shown();
        self.in_neutral(gl, |layer, neutral| {
            layer.synthesise(gl, &scene, neutral);
        });
    }

    /// Synthesises the views of a scene, or copies the own one where the scene has no disparities. Changes the framebuffers that are bound.
    fn synthesise(&mut self, gl: &Gl, scene: &Scene, neutral: &Neutral) {
        self.reading(gl, BACK, |layer| match layer.disparities(scene) {
            Some(disparities) if layer.has_pyramid(gl) => {
                layer.synthesise_from(gl, scene, &disparities, neutral);
            }
            _ => layer.targets.atlas.share_own(gl),
        });
    }

    /// Synthesises the views of a scene from those that are drawn. Changes the framebuffers that are bound.
    fn synthesise_from(
        &mut self,
        gl: &Gl,
        scene: &Scene,
        disparities: &Disparities,
        neutral: &Neutral,
    ) {
        self.resolve_sources(gl);
        if let Some(mapping) = &scene.mapping {
            self.take_samples(gl, neutral, scene, mapping);
        }
        let (sources, own) = (self.synthesis.sources, self.targets.atlas.tiles.own());
        match sources {
            Some(sources) => self.targets.atlas.copy_to_pyramid(gl, sources.iter()),
            None => self.targets.atlas.copy_to_pyramid(gl, [own].into_iter()),
        }
        let Some(textures) = self.measure(gl, disparities, true, neutral) else {
            return self.targets.atlas.share_own(gl);
        };
        let Some(passes) = &self.synthesis.passes else {
            return;
        };
        let (mask, func) = (
            gl.get_integer(c::DEPTH_WRITEMASK) as u8,
            gl.get_integer(c::DEPTH_FUNC) as u32,
        );
        gl.enable(c::DEPTH_TEST);
        gl.depth_mask(1);
        gl.depth_func(c::ALWAYS);
        let srgb = self.state.window.srgb;
        if srgb {
            gl.enable_srgb(true);
        }
        passes.views(gl, neutral, &mut self.targets.atlas, disparities, &textures);
        self.diagnostics.report.synthesised(false);
        if srgb {
            gl.enable_srgb(false);
        }
        gl.depth_func(func);
        gl.depth_mask(mask);
        gl.disable(c::DEPTH_TEST);
    }

    /// Makes the textures of the disparity pyramid where they are not there; false where there can be none.
    fn has_pyramid(&mut self, gl: &Gl) -> bool {
        if self.synthesis.passes.is_none() || self.targets.atlas.pyramid(false).is_some() {
            return self.synthesis.passes.is_some();
        }
        self.state.keep_errors(gl);
        let (names, window) = (&mut self.targets.names, &self.state.window);
        let layers = self.synthesis.most(self.session.config.views);
        let made = keep_bindings(gl, || {
            self.targets.atlas.make_pyramid(gl, names, window, layers)
        });
        // Dropped whatever has failed: the program must not see them.
        let errors = gl.drop_errors();
        let made = made && errors == 0;
        if !made {
            self.synthesis.passes = None;
            self.diagnostics.report.note(
                "all views are drawn: the driver makes no textures of floats that it draws to"
                    .into(),
            );
        }
        made
    }

    /// Resolves only the views that others are synthesised from, colours and depths.
    fn resolve_sources(&mut self, gl: &Gl) {
        let sources = self.synthesis.sources;
        let views = match sources {
            Some(sources) => sources.iter().collect(),
            None => self.targets.atlas.tiles.own_alone(),
        };
        let both = c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT;
        self.targets.atlas.resolve(gl, &views, both);
    }

    /// Measures the views that are drawn, or their copies, for the synthesis of the others, and makes the distortion map for the next frame.
    fn measure(
        &mut self,
        gl: &Gl,
        disparities: &Disparities,
        copied: bool,
        neutral: &Neutral,
    ) -> Option<PyramidTextures> {
        self.synthesis.draws(disparities.sources);
        let mut textures = self.targets.atlas.pyramid(copied)?;
        let passes = self.synthesis.passes.as_ref()?;
        passes.measure(gl, neutral, &mut self.targets.atlas, disparities, &textures);
        self.map_distortion(gl, neutral, disparities);
        textures.reference = self
            .targets
            .atlas
            .reference()
            .filter(|_| self.synthesis.reference.is_on());
        Some(textures)
    }

    fn disparities(&self, scene: &Scene) -> Option<Disparities> {
        let far = scene.motion()?;
        let [scale, offset] = scene.line();
        let tiles = &self.targets.atlas.tiles;
        let own = self.known.rig.position(tiles.own());
        let baselines =
            [self.known.rig.position(ViewIndex(0)) - own, 1.0].map(|place| place * far.signum());
        let step = 0.5f64.powi(self.state.window.bits[4].min(24) as i32);
        let before = scene.before.zip(scene.mapping);
        let before = before.map(|((before, to), mapping)| {
            let [scale, offset] = before.line(&mapping);
            let side = if before.ramp.nearer_is_larger() {
                1.0
            } else {
                -1.0
            };
            [scale, offset, to, side].map(|v| v as f32)
        });
        // A sky alone has the depth of what is cleared.
        let nearer = match scene.mapping {
            Some(_) => -scale.signum(),
            None => 0.0,
        };
        Some(Disparities {
            before: before.unwrap_or_default(),
            scale: scale as f32,
            offset: offset as f32,
            far: far.abs() as f32,
            cleared: Cleared {
                depth: scene.clear,
                sky: scene.sky,
            },
            baselines: baselines.map(|baseline| baseline as f32),
            margin: (nearer * MARGIN * step) as f32,
            aim: (0, 0),
            sources: self.synthesis.sources,
            places: Places::Tiles,
            marked: self.session.config.marks_holes,
            reach: REACH,
        })
    }

    /// At the end of a frame: has the panel's picture synthesised straight from the views that are drawn, where that is possible, or else
    /// synthesises the missing views. Changes the framebuffers that are bound.
    pub(super) fn end_scene(&mut self, gl: &Gl, neutral: &Neutral) {
        let Some(scene) = self.known.scene else {
            return;
        };
        let captured = self
            .session
            .config
            .capture
            .as_ref()
            .map(|capture| capture.what);
        let straight = self.output() == Output::Panel
            && self.window_output().is_none()
            && self.session.config.filter == Filter::Nearest
            && captured.is_none_or(|what| what == CaptureWhat::Output)
            && !self.targets.undrawn;
        match self.disparities(&scene) {
            Some(disparities) if straight && self.has_pyramid(gl) => {
                self.resolve_sources(gl);
                if let Some(textures) = self.measure(gl, &disparities, false, neutral) {
                    self.synthesis.pyramid = Some((textures, disparities));
                    self.diagnostics.report.synthesised(true);
                }
            }
            _ => self.synthesise_views(gl),
        }
    }

    /// After the picture of [`Layer::end_scene`]. A scene that other views never got goes on until it is cleared.
    pub(super) fn leave_scene(&mut self) {
        let straight = self.synthesis.pyramid.take().is_some();
        self.known.scene = self.known.scene.filter(|_| straight);
        if let Some(scene) = &mut self.known.scene {
            scene.shown = true;
        }
        self.known.synthesised = false;
    }

    /// Forgets the scene and the reference image, because the tiles are new.
    pub(super) fn forget_scene(&mut self) {
        self.known.scene = None;
        self.synthesis.reference = ReferenceImage::default();
    }
}
