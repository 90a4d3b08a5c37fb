//! Observe: the state that a decision depends on, read where a command has touched it, as [`Facts`].

use super::super::Layer;
use super::{Images, Request};
use crate::config::{Output, Projection, Strategy, Viewport};
use crate::gl::{Gl, ImageUnit, Object, ProgramName, consts as c};
use crate::interleave::Sources;
use crate::plan::class::{Classed, Target, Traits};
use crate::plan::decide::{
    ClearFacts, Destination, GridFacts, Linked, Projections, Rects, Settings, Shaders,
    SynthesisFacts, is_over_candidate, needs,
};
use crate::plan::{Facts, Kind};
use crate::state::Touch;
use std::sync::Arc;

impl Layer {
    /// The user's settings and the driver's capabilities that a decision depends on.
    pub(super) fn settings(&self) -> Settings {
        let (support, plain) = (&self.session.support, self.is_plain());
        Settings {
            strategy: match plain {
                true => Strategy::Replay,
                false => self.session.strategy,
            },
            instanced: support.instanced(),
            geometry: support.geometry(),
            same_depths: self.session.same_depths(),
            views: self.session.config.views,
            shows_depth: self.output() == Output::Rgbd,
            measures_depths: self.cameras.comfort.looks() && !self.session.live.flat && !plain,
            synthesises: self.synthesis.passes.is_some() && !plain,
        }
    }

    /// The facts of one command and of the state that it finds. [`crate::state::State::refresh`] must have been called.
    pub(super) fn observe(&mut self, gl: &Gl, request: &Request) -> (Facts, Images) {
        let kind = request.kind;
        let whole = matches!(kind, Kind::Clear { .. } | Kind::Accum);
        let shaders = self.observe_shaders(gl, whole);
        let (target, lens) = self.target(gl, &shaders);
        let traits = self.traits(gl, kind, target, &shaders);
        let classed = self.cameras.classifier.class(&traits);
        let settings = self.settings();
        let groups = needs(kind, &classed, &shaders, &self.known, &settings);
        self.state.read_classification(gl, groups);
        let images = match whole || matches!(shaders, Shaders::Unlinked(_)) {
            true => Images::none(),
            false => self.observe_images(gl),
        };
        let reads_views = images.differ();
        let mut shaders = shaders;
        if let Shaders::Variant(variant) = &mut shaders {
            variant.unprojects = !images.unprojections.is_empty();
        }
        let mut facts = Facts {
            traits,
            classed,
            projections: self.observe_projections(lens, &traits),
            rects: self.observe_rects(),
            shaders,
            state: self.state.classification,
            destination: self.observe_destination(gl, &shaders),
            grid: self.observe_grid(gl, request),
            clear: ClearFacts::default(),
            synthesis: SynthesisFacts::default(),
            counted: self.queries.active(),
            reads_views,
        };
        if let Kind::Clear { whole, .. } = kind {
            facts.clear = self.observe_clear(gl, whole, &settings);
        }
        if settings.synthesises && facts.destination.is_window() {
            facts.synthesis = self.observe_synthesis(gl, request, &facts, &classed);
        }
        (facts, images)
    }

    fn observe_projections(&self, lens: Option<f64>, traits: &Traits) -> Projections {
        let [matrix, scene] = self.projections();
        let program = self.state.in_use.program;
        let slanted = traits.projection != Projection::Perspective && !program.is_zero();
        let oblique = slanted
            .then(|| self.variants.own.search(program)?.oblique())
            .flatten();
        let matrix = oblique.unwrap_or(matrix);
        Projections {
            fixed: self.state.matrices.projection,
            matrix,
            scene,
            lens,
            raster_moves: self.cameras.raster().is_some(),
        }
    }

    fn observe_rects(&self) -> Rects {
        let state = &self.state;
        Rects {
            viewport: state.rectangles.viewport,
            scissor: state
                .rectangles
                .scissor_test
                .then_some(state.rectangles.scissor),
            window: [state.window.width, state.window.height],
        }
    }

    /// The traits by which the draw is classified.
    fn traits(&mut self, gl: &Gl, kind: Kind, target: Target, shaders: &Shaders) -> Traits {
        let shown = target.is_shown();
        let clear = matches!(kind, Kind::Clear { .. } | Kind::Accum);
        let counts = !clear && self.state.list.is_none();
        let first = !self.known.frame.wrote_depth || clear && shown;
        let projection = match shaders {
            Shaders::Variant(variant) if shown && !clear && variant.lost => Projection::None,
            Shaders::Variant(_) if shown && !clear => Projection::Perspective,
            _ => self.state.projection_kind(),
        };
        let mut turns_by_shader = false;
        if shown {
            let classifier = &self.cameras.classifier;
            let backdrop = self.known.frame.backdrop.may_go_on();
            let needs = classifier.needs(kind, projection, first || backdrop);
            self.state.read_classification(gl, needs);
            let depth = self.state.classification.depth;
            if classifier.needs_modelview(projection, first, depth, backdrop) && !clear {
                match shaders {
                    Shaders::Variant(variant) => {
                        turns_by_shader = self.turns_about_eye(gl, variant.program);
                    }
                    _ => self.state.read_classification(gl, Touch::MODELVIEW),
                }
            }
        }
        let slants =
            shown && !clear && kind != Kind::Pixels && self.slants(gl, projection, shaders);
        let (program, shader) = match self.state.in_use.program {
            ProgramName::ZERO => (0, 0),
            program if self.cameras.classifier.needs_shader() => self.link_and_hash(program),
            _ => (0, 0),
        };
        let by_state = Traits::of(kind, &self.state);
        let image = match shown && !clear && self.cameras.classifier.needs_image() {
            true => self.image_sum(gl, by_state.texture),
            false => 0,
        };
        let foreground = &self.known.frame.foreground;
        Traits {
            centred: by_state.centred || turns_by_shader,
            // Such a program places its vertices by matrices of its own.
            turns: match shaders {
                Shaders::Variant(_) => turns_by_shader,
                _ => by_state.turns,
            },
            far_end: match shaders {
                Shaders::Variant(variant) => variant.far_end,
                _ => false,
            },
            slants,
            target,
            program,
            shader,
            image,
            draw: self.known.frame.draws + u32::from(counts),
            clear: self.known.frame.clears,
            after_clear: self.known.frame.draws_since_clear() + u32::from(counts),
            list: self.frame.list(),
            raster: self.cameras.raster_placed(),
            first,
            backdrop: self.known.frame.backdrop.stage(),
            foreground: shown
                && by_state.viewport == Viewport::Main
                && foreground.has(self.state.framebuffers.draw, by_state.range),
            projection,
            ..by_state
        }
    }

    fn observe_shaders(&mut self, gl: &Gl, whole: bool) -> Shaders {
        let program = self.state.in_use.program;
        if program.is_zero() {
            return match self.state.in_use.pipeline {
                0 => Shaders::Fixed,
                _ => Shaders::Pipeline,
            };
        }
        let window = self.state.framebuffers.draw.is_zero();
        let relevant = self.session.config.views > 1 && self.state.makes_pictures();
        if !relevant || whole && window {
            return Shaders::WithoutVariant(program);
        }
        self.variant_facts(gl, program)
    }

    /// The framebuffer that is drawn to. Whether the program's is split is asked only where there are several views.
    fn observe_destination(&mut self, gl: &Gl, shaders: &Shaders) -> Destination {
        let framebuffer = self.state.framebuffers.draw;
        let picture = self.state.makes_pictures();
        let own = !framebuffer.is_zero() && picture && self.session.config.views > 1;
        let offscreen = &mut self.targets.offscreen;
        let split = match own {
            true if offscreen.is_made(gl, framebuffer) => Linked::Yes,
            true if offscreen.is_refused(gl, framebuffer) => Linked::Refused,
            _ => Linked::Untried,
        };
        let variant = matches!(shaders, Shaders::Variant(_));
        let tiles = &self.targets.atlas.tiles;
        Destination {
            framebuffer,
            picture,
            differs: own && offscreen.is_split(gl, framebuffer),
            split,
            layered: variant
                && match own {
                    true => offscreen.target(gl, framebuffer).layered().is_some(),
                    false => {
                        tiles.columns == 1
                            && tiles.grid.is_full()
                            && self.targets.atlas.layered().is_some()
                    }
                },
            front: self.targets.atlas.has_front(),
            copies: !offscreen.is_empty(),
            eyes: self.state.framebuffers.has_eyes(),
        }
    }

    /// Facts of tiles with other samples than the window's pixels; none where the tiles have those, the draw goes elsewhere, or no other
    /// atlas can be made. Pixels cannot be drawn to such tiles at all, so for them another one is tried once more.
    fn observe_grid(&self, gl: &Gl, request: &Request) -> Option<GridFacts> {
        let grid = self.targets.atlas.tiles.grid;
        let stuck = self.targets.stuck && request.kind != Kind::Pixels;
        if grid.is_full() || stuck || !self.state.draws_to_window() {
            return None;
        }
        let fixed = self.state.in_use.program.is_zero() && self.state.in_use.pipeline == 0;
        let surfaces = fixed
            && !matches!(
                request.kind,
                Kind::Clear { .. } | Kind::Accum | Kind::Pixels
            );
        let stippled = surfaces && gl.is_enabled(c::POLYGON_STIPPLE);
        let aligned = grid.is_sample_aligned();
        let asks = surfaces && aligned && !stippled;
        Some(GridFacts {
            demand: request.demand,
            aligned,
            slanted: grid.shear != 0.0,
            stippled,
            outlined: asks && gl.get_integers::<2>(c::POLYGON_MODE) != [c::FILL as i32; 2],
        })
    }

    fn observe_clear(&self, gl: &Gl, whole: u32, settings: &Settings) -> ClearFacts {
        if !self.state.draws_to_window() {
            return ClearFacts::default();
        }
        let mut wanted = self.known.mono.may_share(whole);
        if settings.synthesises {
            wanted |= whole & (c::COLOR_BUFFER_BIT | c::DEPTH_BUFFER_BIT);
        }
        let mut writable = 0;
        if wanted & c::COLOR_BUFFER_BIT != 0 && gl.get_integers::<4>(c::COLOR_WRITEMASK) == [1; 4] {
            writable |= c::COLOR_BUFFER_BIT;
        }
        if wanted & c::DEPTH_BUFFER_BIT != 0 && gl.get_integer(c::DEPTH_WRITEMASK) != 0 {
            writable |= c::DEPTH_BUFFER_BIT;
        }
        if wanted & c::STENCIL_BUFFER_BIT != 0
            && gl.get_integer(c::STENCIL_WRITEMASK) & 0xFF == 0xFF
        {
            writable |= c::STENCIL_BUFFER_BIT;
        }
        ClearFacts {
            writable,
            unscissored: self.clears_all(),
            depth: match settings.synthesises {
                true => gl.get_floats::<1>(c::DEPTH_CLEAR_VALUE)[0],
                false => 1.0,
            },
        }
    }

    /// Whether the scissor test cuts nothing off the window.
    fn clears_all(&self) -> bool {
        let window = [self.state.window.width, self.state.window.height].map(i64::from);
        let [x, y, width, height] = self.state.rectangles.scissor.map(i64::from);
        !self.state.rectangles.scissor_test
            || (x <= 0 && y <= 0 && x + width >= window[0] && y + height >= window[1])
    }

    fn observe_synthesis(
        &mut self,
        gl: &Gl,
        request: &Request,
        facts: &Facts,
        classed: &Classed,
    ) -> SynthesisFacts {
        let clear = matches!(request.kind, Kind::Clear { .. });
        let begun = self.known.scene.is_some();
        let map = self.targets.atlas.reference().map(|r| r.map);
        let over = begun && !clear && is_over_candidate(facts);
        debug_assert_eq!(facts.classed, *classed);
        SynthesisFacts {
            hindrance: clear.then(|| self.hindrance()).flatten(),
            adds_views: clear && self.adds_views(),
            over_last: over && self.is_over_last(gl, request.primitives),
            reference: map.filter(|_| self.synthesis.reference.is_on() && request.surfaces),
            fixed_function: self.state.has.compatibility,
        }
    }

    /// Whether a scene that begins with this clear would be drawn to a view that was not drawn before.
    fn adds_views(&self) -> bool {
        let (own, views) = (self.targets.atlas.tiles.own(), self.session.config.views);
        let count = self.synthesis.number();
        let sources = count.map(|count| Sources::spread(own, views, count));
        let before = self.targets.atlas.tiles.shown;
        let mut drawn = sources.iter().flat_map(Sources::iter);
        drawn.any(|view| view != own && !before.has(view))
    }

    /// The images that a draw reads and that differ between the views.
    fn observe_images(&mut self, gl: &Gl) -> Images {
        if self.session.config.views < 2 || !self.state.makes_pictures() {
            return Images::none();
        }
        let units = self.image_units(gl);
        let bound = self.sampled(gl);
        // Places on the screen, with the depths of a view or those of a sky, have to be unprojected by the view's own camera.
        let unprojections = self.unprojections_of(gl, self.state.in_use.program);
        let offscreen = &self.targets.offscreen;
        let differs = |unit: &ImageUnit| offscreen.has(Object::Texture(unit.texture));
        Images {
            bound,
            unprojections,
            units_differ: units.iter().any(differs),
            units,
        }
    }
}

impl Images {
    fn none() -> Self {
        Images {
            bound: Arc::default(),
            unprojections: Arc::default(),
            units: Arc::default(),
            units_differ: false,
        }
    }
}
