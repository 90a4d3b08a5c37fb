//! Variants of the program's own shaders, and the uniforms of its programs that the layer follows.

use super::blocks::BlockReader;
use super::camera_search::CameraSearch;
use super::unprojections::Unprojections;
use crate::draw::{Drawn, NoVariant, Variant};
use crate::gl::{Gl, Held, ProgramName};
use crate::plan::decide::Linked as Linking;
use crate::plan::{Pose, camera};
use crate::state::{Matrices, Samplers, SideEffects, block_change, link_change, uniform_change};
use std::collections::HashMap;
use std::sync::Arc;

/// The programs that were drawn with, by name.
#[derive(Debug, Default)]
pub(super) struct OwnVariants {
    known: HashMap<ProgramName, ProgramRecord>,
    /// Programs that were deleted while in use. Such a program has to live until the program uses another one, so the layer deletes it only
    /// then: the layer itself uses others before.
    pending_deletion: Vec<ProgramName>,
}

/// What a variant is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VariantUse {
    /// One view, in whatever framebuffer.
    Views,
    /// One view in its layer, if there is a variant that chooses it; else as [`VariantUse::Views`].
    Layers,
    /// All views in their layers.
    Instances,
    /// The reference image of an occlusion camera.
    Rays,
    /// Points for all views at once, to the samples of a panel.
    Points,
    /// Points for all views at once, to their layers.
    PointLayers,
    /// None: positions are written to a buffer.
    Written,
}

/// A variant in use.
#[derive(Clone, Debug)]
pub(super) struct Entered {
    pub(super) variant: Arc<Variant>,
    /// It chooses layers.
    pub(super) layers: bool,
}

/// A variant, or why there is none; none before it is wanted.
type Made = Option<Result<Arc<Variant>, String>>;

/// Record of one program: its variants, and its uniforms that the layer follows.
#[derive(Debug)]
pub(super) struct ProgramRecord {
    /// The link of the program that the record belongs to.
    link: u64,
    /// [`link_change`] when this was last known to be the program's last link.
    checked: u64,
    how: Result<Drawn, NoVariant>,
    /// The variants that choose layers, for one view and for all: none until one is wanted, `Some(None)` where there cannot be one.
    layered: [Option<Option<Arc<Variant>>>; 2],
    /// The variants of [`VariantUse::Rays`], [`VariantUse::Points`], [`VariantUse::PointLayers`] and [`VariantUse::Written`], or why there is none, once one has been wanted.
    optional: [Made; 4],
    matrices: Matrices,
    samplers: Samplers,
    effects: SideEffects,
    /// [`uniform_change`] when the samplers were last read, and their texture units with the targets.
    units: (u64, Vec<(u32, u32)>),
    /// Before its matrices that unproject: [`uniform_change`] and [`block_change`] as in [`CameraSearch`], and the aspect ratio that they were
    /// found for.
    unprojections: ([u64; 2], f64, Arc<Unprojections>),
    camera: CameraSearch,
    /// By [`VariantUse`]: [`uniform_change`] when uniforms were last copied to the variant, and what that returned.
    followed: [(u64, u64); 7],
}

impl ProgramRecord {
    /// Record of the link of this number: how the program is drawn, its matrices and its samplers. `checked` is [`link_change`] before they
    /// were read.
    pub(super) fn new(
        (link, checked): (u64, u64),
        how: Result<Drawn, NoVariant>,
        matrices: Matrices,
        samplers: Samplers,
        effects: SideEffects,
    ) -> Self {
        ProgramRecord {
            link,
            checked,
            how,
            matrices,
            samplers,
            effects,
            units: (0, Vec::new()),
            unprojections: ([0; 2], 0.0, Arc::default()),
            camera: CameraSearch::default(),
            followed: [(0, 0); 7],
            layered: [None, None],
            optional: [None, None, None, None],
        }
    }

    /// Names of its variants.
    fn variants(&self) -> impl Iterator<Item = ProgramName> {
        let whole = match &self.how {
            Ok(Drawn::ByVariant(variant)) => Some(variant),
            _ => None,
        };
        let layered = self.layered.iter().flatten().flatten();
        let optional = self.optional.iter().flatten().flatten();
        whole
            .into_iter()
            .chain(layered)
            .chain(optional)
            .map(|variant| variant.name())
    }
}

impl OwnVariants {
    /// Puts a variant of a program in use, with the values of the program's uniforms. None where the program has no such variant.
    pub(super) fn enter(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        with: VariantUse,
    ) -> Option<Entered> {
        let known = self.known.get_mut(&program)?;
        let [alone, layer, instances, rays, points, point_layers, writes] = &mut known.followed;
        let [by_layer, by_instances] = known.layered.each_ref().map(|t| t.as_ref()?.as_ref());
        let [distorting, points_variant, layered_points, writing] = known
            .optional
            .each_ref()
            .map(|made| made.as_ref()?.as_ref().ok());
        let (variant, followed, layers) = match (with, by_layer, by_instances, &known.how) {
            (VariantUse::Rays, ..) => (distorting?, rays, false),
            (VariantUse::Points, ..) => (points_variant?, points, false),
            (VariantUse::PointLayers, ..) => (layered_points?, point_layers, true),
            (VariantUse::Written, ..) => (writing?, writes, false),
            (VariantUse::Instances, _, Some(variant), _) => (variant, instances, true),
            (VariantUse::Layers, Some(variant), _, _) => (variant, layer, true),
            (VariantUse::Layers | VariantUse::Views, _, _, Ok(Drawn::ByVariant(variant))) => {
                (variant, alone, false)
            }
            _ => return None,
        };
        gl.use_program(variant.name());
        let change = uniform_change();
        if std::mem::replace(&mut followed.0, change) != change {
            followed.1 = variant.copy_uniforms(gl, program, followed.1);
        }
        let variant = variant.clone();
        Some(Entered { variant, layers })
    }

    /// Notes that a program in use was deleted: it has to live until the program uses another one.
    pub(super) fn defer_deletion(&mut self, program: ProgramName) {
        if !self.is_pending_deletion(program) {
            Held::Shader.count(1);
            self.pending_deletion.push(program);
        }
    }

    /// Whether any program waits to be deleted.
    pub(super) fn has_pending_deletions(&self) -> bool {
        !self.pending_deletion.is_empty()
    }

    /// Whether a program waits to be deleted.
    pub(super) fn is_pending_deletion(&self, program: ProgramName) -> bool {
        self.pending_deletion.contains(&program)
    }

    /// Takes the programs that wait to be deleted, but not the one in use.
    pub(super) fn take_pending(&mut self, used: ProgramName) -> Vec<ProgramName> {
        let all = std::mem::take(&mut self.pending_deletion).into_iter();
        let (kept, gone) = all.partition(|&program| program == used);
        self.pending_deletion = kept;
        gone
    }

    /// Deletes the variants of a program that is gone.
    pub(super) fn forget(&mut self, gl: &Gl, program: ProgramName) {
        if let Some(known) = self.known.remove(&program) {
            known
                .variants()
                .for_each(|variant| gl.delete_program(variant));
        }
    }

    /// Keeps the record of a program's last link in the place of an older one, and deletes the variants of that.
    pub(super) fn put(&mut self, gl: &Gl, program: ProgramName, record: ProgramRecord) {
        self.forget(gl, program);
        self.known.insert(program, record);
    }

    /// Whether the record of a program is of its last link, whose number `link` gives.
    pub(super) fn is_current(&mut self, program: ProgramName, link: impl FnOnce() -> u64) -> bool {
        let checked = link_change();
        let Some(known) = self.known.get_mut(&program) else {
            return false;
        };
        if known.checked == checked {
            return true;
        }
        let same = known.link == link();
        if same {
            known.checked = checked;
        }
        same
    }

    /// Whether the variants of a program that choose layers are linked: the one of one view, and the one of all. None for a program without a
    /// record.
    pub(super) fn layered(&self, program: ProgramName) -> Option<[Linking; 2]> {
        let linked = |made: &Option<Option<Arc<Variant>>>| match made {
            None => Linking::Untried,
            Some(None) => Linking::Refused,
            Some(Some(_)) => Linking::Yes,
        };
        let known = self.known.get(&program)?;
        Some(known.layered.each_ref().map(linked))
    }

    /// Keeps the variant that chooses layers, of one view or of `all`; none where there cannot be one.
    pub(super) fn put_layered(
        &mut self,
        program: ProgramName,
        all: bool,
        variant: Option<Arc<Variant>>,
    ) {
        let known = self.known.get_mut(&program);
        if let Some(slot) = known.and_then(|known| known.layered.get_mut(usize::from(all))) {
            *slot = Some(variant);
        }
    }

    /// The variant for a use that not all programs have one for, or why there is none; none before it is first wanted.
    pub(super) fn made(
        &self,
        program: ProgramName,
        with: VariantUse,
    ) -> Option<Result<Arc<Variant>, String>> {
        let [rays, points, layers, written] = &self.known.get(&program)?.optional;
        match with {
            VariantUse::Points => points.clone(),
            VariantUse::PointLayers => layers.clone(),
            VariantUse::Written => written.clone(),
            _ => rays.clone(),
        }
    }

    /// Keeps what [`OwnVariants::made`] then returns.
    pub(super) fn put_made(
        &mut self,
        program: ProgramName,
        with: VariantUse,
        made: Result<Arc<Variant>, String>,
    ) {
        if let Some(known) = self.known.get_mut(&program) {
            let [rays, points, layers, written] = &mut known.optional;
            match with {
                VariantUse::Points => *points = Some(made),
                VariantUse::PointLayers => *layers = Some(made),
                VariantUse::Written => *written = Some(made),
                _ => *rays = Some(made),
            }
        }
    }

    /// The search for a program's camera; none for a program without a record.
    pub(super) fn search(&self, program: ProgramName) -> Option<&CameraSearch> {
        self.known.get(&program).map(|known| &known.camera)
    }

    /// The same, to be changed.
    pub(super) fn search_mut(&mut self, program: ProgramName) -> Option<&mut CameraSearch> {
        self.known.get_mut(&program).map(|known| &mut known.camera)
    }

    /// Whether a program's vertices lie at the far end of the depths.
    pub(super) fn is_at_far_end(&self, program: ProgramName) -> bool {
        let known = self.known.get(&program);
        known.is_some_and(|known| match &known.how {
            Ok(Drawn::ByVariant(variant)) => variant.is_at_far_end(),
            _ => false,
        })
    }

    /// Whether all that a program draws now is turned about the eye and not moved (see [`camera::turns_about_eye`]).
    pub(super) fn turns_about_eye(
        &self,
        gl: &Gl,
        program: ProgramName,
        blocks: &mut BlockReader,
    ) -> bool {
        let Some(known) = self.known.get(&program) else {
            return false;
        };
        let in_block = &mut |place| blocks.matrix(program, place);
        let values = known.matrices.values(gl, program, in_block);
        let matrix = known.camera.present();
        matrix.is_some_and(|matrix| camera::turns_about_eye(&matrix, &values))
    }

    /// Where a program puts what it draws (see [`camera::pose`]).
    pub(super) fn pose(
        &self,
        gl: &Gl,
        program: ProgramName,
        blocks: &mut BlockReader,
    ) -> Option<Pose> {
        let known = self.known.get(&program)?;
        let matrix = known.camera.present()?;
        let in_block = &mut |place| blocks.matrix(program, place);
        let values = known.matrices.values(gl, program, in_block);
        camera::pose(&matrix, &values)
    }

    /// The matrix of a program's camera, as the program has it and as a pure projection (see [`camera::equivalent`]); both are column-major.
    pub(super) fn projections(&self, program: ProgramName) -> Option<[[f32; 16]; 2]> {
        self.known.get(&program)?.camera.projections()
    }

    /// The matrices by which a program computes positions from places on the screen. `aspect` is width over height of the picture.
    pub(super) fn unprojections(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        aspect: f64,
        blocks: &mut BlockReader,
    ) -> Arc<Unprojections> {
        let Some(known) = self.known.get_mut(&program) else {
            return Arc::default();
        };
        let places = known.matrices.read_in_blocks();
        let change = match places {
            [] => [uniform_change(), 0],
            _ => [uniform_change(), block_change()],
        };
        let (seen, before, found) = &mut known.unprojections;
        let same = (*seen, *before) == (change, aspect);
        if same && (places.is_empty() || !blocks.are_live(program, places)) {
            return found.clone();
        }
        let mut uniforms = known.matrices.uniforms(gl, program);
        uniforms.retain(|(_, m)| camera::unprojects(m, aspect));
        let values = places
            .iter()
            .filter_map(|&place| Some((place, blocks.matrix(program, place)?)));
        let in_blocks = values.filter(|(_, m)| camera::unprojects(m, aspect));
        let new = Unprojections {
            in_blocks: in_blocks.collect(),
            uniforms,
        };
        let locations = |all: &Unprojections| -> Vec<i32> {
            all.uniforms.iter().map(|(location, _)| *location).collect()
        };
        if locations(&new) != locations(found) {
            // Variants have values of the layer's own in matrices that are no longer of these.
            known.followed = [(0, 0); 7];
        }
        (*seen, *before) = (change, aspect);
        if new != **found {
            *found = Arc::new(new);
        }
        found.clone()
    }

    /// The texture units that a program samples, counted from 0, with the targets.
    pub(super) fn units(&mut self, gl: &Gl, program: ProgramName) -> Vec<(u32, u32)> {
        let Some(known) = self.known.get_mut(&program) else {
            return Vec::new();
        };
        let change = uniform_change();
        if known.units.0 != change {
            known.units = (change, known.samplers.units(gl, program));
        }
        known.units.1.clone()
    }

    /// The image units that a program loads and stores, counted from 0.
    pub(super) fn image_units(&self, gl: &Gl, program: ProgramName) -> Vec<u32> {
        let known = self.known.get(&program);
        known.map_or_else(Vec::new, |known| known.samplers.image_units(gl, program))
    }

    /// Where a program writes to memory; none for a program without a record.
    pub(super) fn effects(&self, program: ProgramName) -> Option<&SideEffects> {
        self.known.get(&program).map(|known| &known.effects)
    }

    /// The projection of the camera of a program with a variant, column-major: `Some(None)` where no camera is found, `None` for a program
    /// without a variant. `blocks` reads those in uniform blocks.
    #[allow(clippy::option_option, reason = "a variant, and a camera")]
    pub(super) fn camera(
        &mut self,
        gl: &Gl,
        program: ProgramName,
        aspect: f64,
        blocks: &mut BlockReader,
    ) -> Option<Option<[f32; 16]>> {
        let Some(ProgramRecord {
            how: Ok(Drawn::ByVariant(_)),
            matrices,
            camera,
            ..
        }) = self.known.get_mut(&program)
        else {
            return None;
        };
        camera.look(gl, program, matrices, aspect, blocks);
        Some(camera.projections().map(|[_, projection]| projection))
    }

    /// The names of all variants, and of the programs that wait to be deleted.
    pub(super) fn names(&self) -> impl Iterator<Item = ProgramName> {
        let pending_deletion = self.pending_deletion.iter().copied();
        pending_deletion.chain(self.known.values().flat_map(ProgramRecord::variants))
    }
}
