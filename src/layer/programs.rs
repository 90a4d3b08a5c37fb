//! Programs with shaders of their own: they are drawn with a program variant, which shifts the vertices of each view.

use super::Layer;
use super::blocks::BlockReader;
use super::camera_search::CameraSearch;
use super::own_variants::{OwnVariants, ProgramRecord, VariantUse};
use super::unprojections::Unprojections;
use crate::config::Strategy;
use crate::draw::{
    Drawn, NoVariant, POINTS_AT_ONCE, Variant, VariantKind, drawn, point_variant, writing_variant,
};
use crate::gl::{Gl, ImageUnit, ProgramName, consts as c};
use crate::plan::Pose;
use crate::plan::decide::{Linked as Linking, Shaders, VariantFacts};
use crate::rewrite::{PointsTo, Stage};
use crate::state::{
    Linked, Matrices, Samplers, ShaderSource, Shaders as ProgramSources, SideEffects, link_change,
    sources,
};
use std::sync::Arc;

impl Layer {
    /// After glLinkProgram.
    pub fn linked(&mut self, gl: &Gl, program: ProgramName) {
        if let Some(sources) = sources(gl, program) {
            self.shaders(|shaders| shaders.linked(program, sources));
        }
    }

    /// Whether program binaries are refused, because no variant can be made from one. Programs then come with their sources.
    pub fn refuses_binaries(&self) -> bool {
        self.session.config.views > 1
    }

    /// A program has got its executable in another way than by glLinkProgram: forgets its sources.
    pub fn forget_program(&mut self, program: ProgramName) {
        self.shaders(|shaders| shaders.forget(program));
    }

    /// Whether glDeleteProgram has to wait because the program is in use, which is noted.
    pub fn defers_deletion(&mut self, gl: &Gl, program: ProgramName) -> bool {
        let used =
            !program.is_zero() && ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32) == program;
        if used {
            self.variants.own.defer_deletion(program);
        }
        used
    }

    /// Whether any program waits to be deleted.
    pub fn has_pending_deletions(&self) -> bool {
        self.variants.own.has_pending_deletions()
    }

    /// Whether a program waits to be deleted.
    pub fn is_pending_deletion(&self, program: ProgramName) -> bool {
        self.variants.own.is_pending_deletion(program)
    }

    /// After glUseProgram: deletes the programs that have waited for it.
    pub fn delete_pending(&mut self, gl: &Gl) {
        let used = ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32);
        for program in self.variants.own.take_pending(used) {
            gl.delete_program(program);
            self.deleted_program(gl, program);
        }
    }

    /// After glDeleteProgram: deletes the program's variants, if the program is gone.
    pub fn deleted_program(&mut self, gl: &Gl, program: ProgramName) {
        if gl.is_program(program) != 0 {
            return;
        }
        self.shaders(|shaders| shaders.forget(program));
        self.variants.own.forget(gl, program);
    }

    fn shaders<R>(&self, ask: impl FnOnce(&mut ProgramSources) -> R) -> R {
        let mut lists = self.session.group.lists();
        ask(&mut lists.shaders)
    }

    /// Facts of a program that is in use. They come from its variant for one view, whichever variant it is drawn with.
    pub(super) fn variant_facts(&mut self, gl: &Gl, program: ProgramName) -> Shaders {
        if !self.is_known(program) {
            return Shaders::Unlinked(program);
        }
        let Some(camera) = self.camera_of(gl, program) else {
            return Shaders::WithoutVariant(program);
        };
        // Asked only where all views may be drawn at once.
        let instances = self.session.strategy == Strategy::Instanced;
        let divides = instances && self.variants.divides() && gl.has_divisors();
        let Some([to_layer, to_layers]) = self.variants.own.layered(program) else {
            return Shaders::Unlinked(program);
        };
        let unmeasured = self.is_unmeasured(program);
        let search = self.variants.own.search(program);
        Shaders::Variant(VariantFacts {
            program,
            camera,
            lost: search.is_none_or(CameraSearch::is_lost),
            unmeasured,
            far_end: self.variants.own.is_at_far_end(program),
            to_layer,
            to_layers,
            divides,
            unprojects: false,
        })
    }

    /// Whether a program has a variant that chooses the layer of one view.
    pub(super) fn chooses_layers(&self, program: ProgramName) -> bool {
        let layered = self.variants.own.layered(program);
        layered.is_some_and(|[to_layer, _]| to_layer == Linking::Yes)
    }

    /// Some attribute is about to advance by instances.
    pub fn divides(&mut self) {
        self.variants.divide();
    }

    /// The projection of the camera of a program with a variant, column-major: `Some(None)` where no camera is found, `None` for a program
    /// without a variant.
    #[allow(clippy::option_option, reason = "a variant, and a camera")]
    pub(super) fn camera_of(&mut self, gl: &Gl, program: ProgramName) -> Option<Option<[f32; 16]>> {
        self.read_own(gl, |own, aspect, blocks| {
            own.camera(gl, program, aspect, blocks)
        })
    }

    /// Tells once of a program that no camera was found in its matrices.
    pub(super) fn tell_of_no_camera(&mut self, program: ProgramName) {
        if self.measures_w() && !self.is_measured_in_vain(program) {
            return;
        }
        let search = self.variants.own.search_mut(program);
        if !search.is_some_and(CameraSearch::is_first_telling) {
            return;
        }
        let which = self.told_name(program);
        self.diagnostics.report.note(format!(
            "no camera was found in the matrices of the shaders {which}: what they draw is the same in all views"
        ));
    }

    /// How a program is named to the user: by the hash and the first line of its vertex shader, where these are known.
    pub(super) fn told_name(&self, program: ProgramName) -> String {
        match self.linked_from(program) {
            Some(linked) => {
                let vertex = linked.sources.iter().find(|s| s.stage == Stage::Vertex);
                let line = vertex
                    .and_then(ShaderSource::first_line)
                    .unwrap_or_default();
                format!("{:016x} (`{line}`)", linked.hash)
            }
            None => program.0.to_string(),
        }
    }

    /// Whether all that a program with a variant draws now is turned about the eye and not moved, by its matrices.
    pub(super) fn turns_about_eye(&mut self, gl: &Gl, program: ProgramName) -> bool {
        self.read_own(gl, |own, _, blocks| {
            own.turns_about_eye(gl, program, blocks)
        })
    }

    /// Where a program with a variant puts what it draws, by its matrices.
    pub(super) fn pose_by_shader(&mut self, gl: &Gl, program: ProgramName) -> Option<Pose> {
        self.read_own(gl, |own, _, blocks| own.pose(gl, program, blocks))
    }

    /// Reads the uniforms of programs. `read` also gets the aspect of the picture, width over height.
    fn read_own<R>(
        &mut self,
        gl: &Gl,
        read: impl FnOnce(&mut OwnVariants, f64, &mut BlockReader) -> R,
    ) -> R {
        let aspect = self.aspect();
        let mut blocks = BlockReader {
            gl,
            blocks: &mut self.blocks,
            group: &self.session.group,
            state: &mut self.state,
            reads_back: false,
        };
        let found = read(&mut self.variants.own, aspect, &mut blocks);
        if blocks.reads_back {
            self.tell_of_cameras_read_back();
        }
        found
    }

    /// The matrix that projects the scene that is being drawn, as the program has it and as a pure projection (see [`camera::equivalent`]);
    /// both are column-major.
    pub(super) fn projections(&self) -> [[f32; 16]; 2] {
        let camera = self.variants.own.projections(self.state.in_use.program);
        camera.unwrap_or([self.state.matrices.projection; 2])
    }

    /// The matrices by which a program computes positions from places on the screen.
    pub(super) fn unprojections_of(&mut self, gl: &Gl, program: ProgramName) -> Arc<Unprojections> {
        self.read_own(gl, |own, aspect, blocks| {
            own.unprojections(gl, program, aspect, blocks)
        })
    }

    /// The texture units that a program samples, counted from 0, with the targets.
    pub(super) fn units_of(&mut self, gl: &Gl, program: ProgramName) -> Vec<(u32, u32)> {
        self.link_variant(gl, program);
        self.variants.own.units(gl, program)
    }

    /// What is bound to the image units that a program loads and stores.
    pub(super) fn images_of(&mut self, gl: &Gl, program: ProgramName) -> Vec<ImageUnit> {
        self.link_variant(gl, program);
        let units = self.variants.own.image_units(gl, program);
        let images = units.into_iter();
        images
            .filter_map(|unit| self.write_bindings.image(gl, unit))
            .collect()
    }

    /// The number of a program, counted as they are linked, and the hash of its shaders' sources; 0 where they are not known.
    pub(super) fn link_and_hash(&self, program: ProgramName) -> (u32, u64) {
        let linked = self.linked_from(program);
        linked.map_or((0, 0), |linked| (linked.link as u32, linked.hash))
    }

    /// The sources that a program was linked from.
    pub(super) fn linked_from(&self, program: ProgramName) -> Option<Linked> {
        self.shaders(|shaders| shaders.of(program))
    }

    /// The sources with this hash, if a program was linked from them.
    pub(super) fn linked_as(&self, hash: u64) -> Option<Linked> {
        self.shaders(|shaders| shaders.with_hash(hash))
    }

    /// Whether the record of a program is of its last link.
    fn is_known(&mut self, program: ProgramName) -> bool {
        self.variants.own.is_current(program, || {
            let linked = self.session.group.lists().shaders.of(program);
            linked.map_or(0, |linked| linked.link)
        })
    }

    /// Makes the record of a program, with its variant for one view, once for each of its links.
    pub(super) fn link_variant(&mut self, gl: &Gl, program: ProgramName) {
        if self.is_known(program) {
            return;
        }
        let checked = link_change();
        let linked = self.session.group.lists().shaders.of(program);
        let link = linked.as_ref().map_or(0, |linked| linked.link);
        self.state.keep_errors(gl);
        let how = match &linked {
            Some(linked) => drawn(gl, program, &linked.sources, VariantKind::Alone),
            None => Err(NoVariant::NoSource),
        };
        let sources = linked.as_ref().map(|linked| &*linked.sources);
        let matrices = Matrices::of(gl, program, sources.unwrap_or_default());
        let samplers = Samplers::of(gl, program);
        let effects = SideEffects::of(gl, program, sources);
        self.drain_own_errors(gl);
        match &how {
            Ok(Drawn::ByVariant(_)) => {
                let compiled = self.variants.count_compiled();
                self.diagnostics.report.shaders(compiled);
            }
            Ok(Drawn::ByMatrix) | Err(NoVariant::Computes) => {}
            Err(reason) => self.diagnostics.report.note(format!(
                "what program {program} draws is the same in all views: {reason}"
            )),
        }
        let new = ProgramRecord::new((link, checked), how, matrices, samplers, effects);
        self.variants.own.put(gl, program, new);
    }

    /// Makes the variant for a use that not all programs have one for, once for each link. The error says why there is none.
    pub(super) fn link_other(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        with: VariantUse,
    ) -> Result<Arc<Variant>, String> {
        if let Some(made) = self.variants.own.made(program, with) {
            return made;
        }
        let linked = self.linked_from(program).ok_or(NoVariant::NoSource);
        self.state.keep_errors(gl);
        let made = linked.and_then(|linked| match with {
            VariantUse::Points | VariantUse::PointLayers => {
                let to = match with {
                    VariantUse::Points => PointsTo::Samples,
                    _ if self.session.config.surfaces => PointsTo::Surfaces(POINTS_AT_ONCE),
                    _ => PointsTo::Layers(POINTS_AT_ONCE),
                };
                let compatibility = self.state.has.compatibility;
                point_variant(gl, program, &linked.sources, to, compatibility).map(Arc::new)
            }
            VariantUse::Written => {
                writing_variant(gl, program, &linked.sources, c"gl_Position").map(Arc::new)
            }
            _ => match drawn(gl, program, &linked.sources, VariantKind::DistortedRays)? {
                Drawn::ByVariant(variant) => Ok(variant),
                Drawn::ByMatrix => Err(NoVariant::NoVertex),
            },
        });
        self.drain_own_errors(gl);
        if made.is_ok() {
            let compiled = self.variants.count_compiled();
            self.diagnostics.report.shaders(compiled);
        }
        let made = made.map_err(|reason| reason.to_string());
        self.variants.own.put_made(program, with, made.clone());
        made
    }

    /// Makes the variant that chooses layers, for one view or for all, once for each link. False where the driver cannot have one.
    pub(super) fn link_layer_variant(&mut self, gl: &Gl, program: ProgramName, all: bool) -> bool {
        match self.variants.own.layered(program) {
            Some(linked) => match linked[usize::from(all)] {
                Linking::Untried => {}
                linked => return linked == Linking::Yes,
            },
            None => return false,
        }
        let linked = self.linked_from(program);
        let kind = self.session.support.vertex_layer.map(|by| match all {
            true => VariantKind::Instances(by, self.session.config.views),
            false => VariantKind::Layer(by),
        });
        self.state.keep_errors(gl);
        let made = match (linked, kind) {
            (Some(linked), Some(kind)) => drawn(gl, program, &linked.sources, kind).ok(),
            _ => None,
        };
        self.drain_own_errors(gl);
        let variant = match made {
            Some(Drawn::ByVariant(variant)) => Some(variant),
            _ => None,
        };
        let there = variant.is_some();
        if there {
            let compiled = self.variants.count_compiled();
            self.diagnostics.report.shaders(compiled);
        }
        self.variants.own.put_layered(program, all, variant);
        there
    }
}
