//! Programs with shaders of their own: they are drawn with a program variant, which shifts the vertices of each view.

use super::Layer;
use crate::config::Strategy;
use crate::draw::{Drawn, NoVariant, Variant, VariantKind, drawn};
use crate::gl::{Gl, Held, ImageUnit, ProgramName, consts as c};
use crate::plan::camera;
use crate::plan::decide::{Linked as Linking, Shaders, VariantFacts};
use crate::state::{
    Linked, Matrices, Samplers, Shaders as ProgramTexts, link_change, texts, uniform_change,
};
use std::collections::HashMap;
use std::sync::Arc;

/// The programs that were drawn with, by name.
#[derive(Debug, Default)]
pub(super) struct OwnVariants {
    known: HashMap<ProgramName, ProgramRecord>,
    /// Programs that were deleted while in use. Such a program has to live until the program uses another one, so the layer deletes it only
    /// then: the layer itself uses others before.
    doomed: Vec<ProgramName>,
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
}

/// A variant in use.
#[derive(Clone, Debug)]
pub(super) struct Entered {
    pub(super) variant: Arc<Variant>,
    /// It chooses layers.
    pub(super) layers: bool,
}

/// The camera of a program.
#[derive(Clone, Copy, Debug)]
struct Camera {
    /// Index of its matrix among those of the program; `matrix` is the value, column-major.
    at: usize,
    matrix: [f32; 16],
    /// See [`camera::equivalent`].
    projection: [f32; 16],
}

/// State of the search for a program's camera.
#[derive(Debug)]
struct CameraSearch {
    /// The last camera that was found among its matrices.
    found: Option<Camera>,
    /// None of its matrices has a perspective now.
    lost: bool,
    /// [`uniform_change`] at the last search.
    seen: u64,
}

/// Record of one program: its variants, and its uniforms that the layer follows.
#[derive(Debug)]
struct ProgramRecord {
    /// The link of the program that the record belongs to.
    link: u64,
    /// [`link_change`] when this was last known to be the program's last link.
    checked: u64,
    how: Result<Drawn, NoVariant>,
    /// The variants that choose layers, for one view and for all: none until one is wanted, `Some(None)` where there cannot be one.
    layered: [Option<Option<Arc<Variant>>>; 2],
    /// The variant that distorts rays, once it has been wanted.
    distorting: Option<Result<Arc<Variant>, NoVariant>>,
    matrices: Matrices,
    samplers: Samplers,
    /// [`uniform_change`] when the samplers were last read, and their texture units with the targets.
    units: (u64, Vec<(u32, u32)>),
    /// Its matrices that unproject depths, with their locations. Before them: [`uniform_change`] and the aspect ratio that they were found
    /// for.
    unprojections: (u64, f64, Vec<(i32, [f32; 16])>),
    camera: CameraSearch,
    /// [`uniform_change`] when uniforms were last copied to its variants, by [`VariantUse`].
    followed: [u64; 4],
}

impl ProgramRecord {
    /// Names of its variants.
    fn variants(&self) -> impl Iterator<Item = ProgramName> {
        let whole = match &self.how {
            Ok(Drawn::ByVariant(variant)) => Some(variant),
            _ => None,
        };
        let layered = self.layered.iter().flatten().flatten();
        let distorting = self.distorting.iter().flatten();
        whole
            .into_iter()
            .chain(layered)
            .chain(distorting)
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
        let [alone, layer, instances, rays] = &mut known.followed;
        let [by_layer, by_instances] = known.layered.each_ref().map(|t| t.as_ref()?.as_ref());
        let distorting = known
            .distorting
            .as_ref()
            .and_then(|distorting| distorting.as_ref().ok());
        let (variant, followed, layers) = match (with, by_layer, by_instances, &known.how) {
            (VariantUse::Rays, ..) => (distorting?, rays, false),
            (VariantUse::Instances, _, Some(variant), _) => (variant, instances, true),
            (VariantUse::Layers, Some(variant), _, _) => (variant, layer, true),
            (VariantUse::Layers | VariantUse::Views, _, _, Ok(Drawn::ByVariant(variant))) => {
                (variant, alone, false)
            }
            _ => return None,
        };
        gl.use_program(variant.name());
        let change = uniform_change();
        if std::mem::replace(followed, change) != change {
            variant.copy_uniforms(gl, program);
        }
        let variant = variant.clone();
        Some(Entered { variant, layers })
    }

    /// The names of all variants, and of the programs that wait to be deleted.
    pub(super) fn names(&self) -> impl Iterator<Item = ProgramName> {
        let doomed = self.doomed.iter().copied();
        doomed.chain(self.known.values().flat_map(ProgramRecord::variants))
    }
}

impl Layer {
    /// After glLinkProgram.
    pub fn linked(&mut self, gl: &Gl, program: ProgramName) {
        if let Some(texts) = texts(gl, program) {
            self.shaders(|shaders| shaders.linked(program, texts));
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
    pub fn dooms(&mut self, gl: &Gl, program: ProgramName) -> bool {
        let used =
            !program.is_zero() && ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32) == program;
        if used && !self.is_doomed(program) {
            Held::Shader.count(1);
            self.variants.own.doomed.push(program);
        }
        used
    }

    /// Whether any program waits to be deleted.
    pub fn has_doomed(&self) -> bool {
        !self.variants.own.doomed.is_empty()
    }

    /// Whether a program waits to be deleted.
    pub fn is_doomed(&self, program: ProgramName) -> bool {
        self.variants.own.doomed.contains(&program)
    }

    /// After glUseProgram: deletes the programs that have waited for it.
    pub fn delete_doomed(&mut self, gl: &Gl) {
        let used = ProgramName(gl.get_integer(c::CURRENT_PROGRAM) as u32);
        let (kept, gone): (Vec<ProgramName>, Vec<ProgramName>) = self
            .variants
            .own
            .doomed
            .iter()
            .partition(|&&program| program == used);
        self.variants.own.doomed = kept;
        for program in gone {
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
        if let Some(known) = self.variants.own.known.remove(&program) {
            known
                .variants()
                .for_each(|variant| gl.delete_program(variant));
        }
    }

    fn shaders<R>(&self, ask: impl FnOnce(&mut ProgramTexts) -> R) -> R {
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
        let divides = instances && self.variants.divides && gl.has_divisors();
        let Some(known) = self.variants.own.known.get(&program) else {
            return Shaders::Unlinked(program);
        };
        let linked = |made: &Option<Option<Arc<Variant>>>| match made {
            None => Linking::Untried,
            Some(None) => Linking::Refused,
            Some(Some(_)) => Linking::Yes,
        };
        let [to_layer, to_layers] = known.layered.each_ref().map(linked);
        Shaders::Variant(VariantFacts {
            program,
            camera,
            lost: known.camera.lost,
            to_layer,
            to_layers,
            divides,
        })
    }

    /// Whether a program has a variant that chooses the layer of one view.
    pub(super) fn chooses_layers(&self, program: ProgramName) -> bool {
        let known = self.variants.own.known.get(&program);
        known.is_some_and(|known| matches!(known.layered[0], Some(Some(_))))
    }

    /// Some attribute is about to advance by instances.
    pub fn divides(&mut self) {
        self.variants.divides = true;
    }

    /// The projection of the camera of a program with a variant, column-major: `Some(None)` where no camera is found, `None` for a program
    /// without a variant.
    #[allow(clippy::option_option, reason = "a variant, and a camera")]
    pub(super) fn camera_of(&mut self, gl: &Gl, program: ProgramName) -> Option<Option<[f32; 16]>> {
        let aspect = self.aspect();
        let Some(ProgramRecord {
            how: Ok(Drawn::ByVariant(_)),
            matrices,
            camera:
                CameraSearch {
                    found: camera,
                    lost,
                    seen,
                },
            ..
        }) = self.variants.own.known.get_mut(&program)
        else {
            return None;
        };
        let change = uniform_change();
        let changed = std::mem::replace(seen, change) != change;
        // The camera mostly is in the same matrix as before, and has only moved.
        let mut search = camera.is_none();
        if let (true, Some(found)) = (changed, camera.as_mut())
            && let Some(matrix) = matrices.value(gl, program, found.at)
        {
            match camera::equivalent(&matrix) {
                Some(projection) => {
                    (found.matrix, found.projection, *lost) = (matrix, projection, false);
                }
                None => search = true,
            }
        }
        // Uniform buffers are read until a camera is found. A mapped one cannot be read, and raises an error, which is taken out below.
        let reads = camera.is_none() && matrices.has_blocks();
        if search && (changed || reads) {
            if reads {
                self.state.keep_errors(gl);
            }
            let values = matrices.values(gl, program, reads);
            let found = camera::among(&values, aspect).and_then(|(at, projection)| {
                let matrix = *values.get(at)?;
                Some(Camera {
                    at,
                    matrix,
                    projection,
                })
            });
            *lost = found.is_none();
            *camera = found.or(*camera);
        }
        let camera = camera.map(|camera| camera.projection);
        if reads {
            self.drain_own_errors(gl);
        }
        Some(camera)
    }

    /// The matrix that projects the scene that is being drawn, as the program has it and as a pure projection (see [`camera::equivalent`]);
    /// both are column-major.
    pub(super) fn projections(&self) -> [[f32; 16]; 2] {
        let known = self.variants.own.known.get(&self.state.in_use.program);
        let camera = known.and_then(|known| known.camera.found);
        let fixed = || [self.state.matrices.projection; 2];
        camera.map_or_else(fixed, |camera| [camera.matrix, camera.projection])
    }

    /// The matrices by which a program computes positions from depths, with their uniform locations.
    pub(super) fn unprojections_of(
        &mut self,
        gl: &Gl,
        program: ProgramName,
    ) -> Vec<(i32, [f32; 16])> {
        let (change, aspect) = (uniform_change(), self.aspect());
        let Some(known) = self.variants.own.known.get_mut(&program) else {
            return Vec::new();
        };
        if (known.unprojections.0, known.unprojections.1) != (change, aspect) {
            let mut all = known.matrices.uniforms(gl, program);
            all.retain(|(_, m)| camera::unprojects(m, aspect));
            known.unprojections = (change, aspect, all);
        }
        known.unprojections.2.clone()
    }

    /// The texture units that a program samples, counted from 0, with the targets.
    pub(super) fn units_of(&mut self, gl: &Gl, program: ProgramName) -> Vec<(u32, u32)> {
        self.know(gl, program);
        let Some(known) = self.variants.own.known.get_mut(&program) else {
            return Vec::new();
        };
        let change = uniform_change();
        if known.units.0 != change {
            known.units = (change, known.samplers.units(gl, program));
        }
        known.units.1.clone()
    }

    /// What is bound to the image units that a program loads and stores.
    pub(super) fn images_of(&mut self, gl: &Gl, program: ProgramName) -> Vec<ImageUnit> {
        self.know(gl, program);
        let known = self.variants.own.known.get(&program);
        let units = known.map_or_else(Vec::new, |known| known.samplers.image_units(gl, program));
        units
            .into_iter()
            .filter_map(|unit| gl.image_unit(unit))
            .collect()
    }

    /// The number of a program, counted as they are linked, and the hash of its shaders' sources; 0 where they are not known.
    pub(super) fn told_of(&self, program: ProgramName) -> (u32, u64) {
        let linked = self.linked_from(program);
        linked.map_or((0, 0), |linked| (linked.link as u32, linked.sum))
    }

    /// The sources that a program was linked from.
    pub(super) fn linked_from(&self, program: ProgramName) -> Option<Linked> {
        self.shaders(|shaders| shaders.of(program))
    }

    /// The sources with this hash, if a program was linked from them.
    pub(super) fn linked_as(&self, sum: u64) -> Option<Linked> {
        self.shaders(|shaders| shaders.with(sum))
    }

    /// Whether the record of a program is of its last link.
    fn is_known(&mut self, program: ProgramName) -> bool {
        let checked = link_change();
        let Some(known) = self.variants.own.known.get_mut(&program) else {
            return false;
        };
        if known.checked == checked {
            return true;
        }
        let linked = self.session.group.lists().shaders.of(program);
        let same = known.link == linked.map_or(0, |linked| linked.link);
        if same {
            known.checked = checked;
        }
        same
    }

    /// Makes the record of a program, with its variant for one view, once for each of its links.
    pub(super) fn know(&mut self, gl: &Gl, program: ProgramName) {
        if self.is_known(program) {
            return;
        }
        let checked = link_change();
        let linked = self.session.group.lists().shaders.of(program);
        let link = linked.as_ref().map_or(0, |linked| linked.link);
        self.state.keep_errors(gl);
        let how = match &linked {
            Some(linked) => drawn(gl, program, &linked.texts, VariantKind::Alone),
            None => Err(NoVariant::NoText),
        };
        let matrices = Matrices::of(gl, program);
        let samplers = Samplers::of(gl, program);
        self.drain_own_errors(gl);
        match &how {
            Ok(Drawn::ByVariant(_)) => {
                self.variants.programs.compiled += 1;
                self.diagnostics
                    .report
                    .shaders(self.variants.programs.compiled);
            }
            Ok(Drawn::ByMatrix) | Err(NoVariant::Computes) => {}
            Err(reason) => self.diagnostics.report.note(format!(
                "what program {program} draws is the same in all views: {reason}"
            )),
        }
        let new = ProgramRecord {
            link,
            checked,
            how,
            matrices,
            samplers,
            units: (0, Vec::new()),
            unprojections: (0, 0.0, Vec::new()),
            camera: CameraSearch {
                found: None,
                lost: true,
                seen: 0,
            },
            followed: [0; 4],
            layered: [None, None],
            distorting: None,
        };
        if let Some(old) = self.variants.own.known.insert(program, new) {
            old.variants()
                .for_each(|variant| gl.delete_program(variant));
        }
    }

    /// Makes the variant that distorts rays, once for each link. The error says why there is none.
    pub(super) fn link_distorting(&mut self, gl: &Gl, program: ProgramName) -> Result<(), String> {
        let told = |made: &Result<Arc<Variant>, NoVariant>| match made {
            Ok(_) => Ok(()),
            Err(reason) => Err(reason.to_string()),
        };
        let known = self.variants.own.known.get(&program);
        if let Some(made) = known.and_then(|known| known.distorting.as_ref()) {
            return told(made);
        }
        let linked = self.linked_from(program);
        self.state.keep_errors(gl);
        let made = match linked {
            Some(linked) => drawn(gl, program, &linked.texts, VariantKind::DistortedRays),
            None => Err(NoVariant::NoText),
        };
        self.drain_own_errors(gl);
        let variant = made.and_then(|made| match made {
            Drawn::ByVariant(variant) => Ok(variant),
            Drawn::ByMatrix => Err(NoVariant::NoVertex),
        });
        let answer = told(&variant);
        if answer.is_ok() {
            self.variants.programs.compiled += 1;
            self.diagnostics
                .report
                .shaders(self.variants.programs.compiled);
        }
        if let Some(known) = self.variants.own.known.get_mut(&program) {
            known.distorting = Some(variant);
        }
        answer
    }

    /// Makes the variant that chooses layers, for one view or for all, once for each link. False where the driver cannot have one.
    pub(super) fn know_layers(&mut self, gl: &Gl, program: ProgramName, all: bool) -> bool {
        let at = usize::from(all);
        let known = self.variants.own.known.get(&program);
        match known.and_then(|known| known.layered.get(at)) {
            Some(None) => {}
            Some(Some(made)) => return made.is_some(),
            None => return false,
        }
        let linked = self.linked_from(program);
        let way = self.session.support.vertex_layer.map(|by| match all {
            true => VariantKind::Instances(by, self.session.config.views),
            false => VariantKind::Layer(by),
        });
        self.state.keep_errors(gl);
        let made = match (linked, way) {
            (Some(linked), Some(way)) => drawn(gl, program, &linked.texts, way).ok(),
            _ => None,
        };
        self.drain_own_errors(gl);
        let variant = match made {
            Some(Drawn::ByVariant(variant)) => Some(variant),
            _ => None,
        };
        let there = variant.is_some();
        if there {
            self.variants.programs.compiled += 1;
            self.diagnostics
                .report
                .shaders(self.variants.programs.compiled);
        }
        let known = self.variants.own.known.get_mut(&program);
        if let Some(slot) = known.and_then(|known| known.layered.get_mut(at)) {
            *slot = Some(variant);
        }
        there
    }
}
