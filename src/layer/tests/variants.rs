//! Variants of the program's own shaders: when they are linked, put in use, and deleted.

use super::super::camera_search::CameraSearch;
use super::super::own_variants::{OwnVariants, VariantUse};
use super::bench::{Bench, PERSPECTIVE};
use crate::gl::{Gl, ProgramName, consts as c};
use crate::plan::decide::{Linked, Shaders};
use crate::state::uniform_changes;

const VERTEX: &str = "#version 150\nuniform mat4 camera;\nuniform vec4 lamp;\nin vec4 at;\nvoid main() { gl_Position = camera * at + lamp; }\n";
const FRAGMENT: &str = "#version 150\nuniform sampler2D map;\nout vec4 colour;\nvoid main() { colour = texture(map, vec2(0.5)); }\n";

const FOUR: [(&str, &str); 2] = [("VIEWS", "4"), ("STRATEGY", "instanced")];

/// The matrix of a flat picture.
const FLAT: [f32; 16] = [
    0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0,
];

/// A program of its own shaders, linked and in use.
pub(in crate::layer) fn program(bench: &mut Bench) -> ProgramName {
    let gl = bench.gl;
    let program = bench.fake.program(|gl| {
        let shaders = [(c::VERTEX_SHADER, VERTEX), (c::FRAGMENT_SHADER, FRAGMENT)];
        let shaders = shaders.map(|(kind, text)| gl.compile(kind, text).expect("compiles"));
        let program = gl.link(&shaders).expect("links");
        gl.use_program(program);
        gl.set_uniform_matrix(0, &PERSPECTIVE);
        program
    });
    bench.layer.linked(&gl, program);
    bench.fake.forget();
    program
}

/// The variant that is entered, if there is one, and whether it chooses layers.
fn enter(bench: &mut Bench, program: ProgramName, with: VariantUse) -> Option<(ProgramName, bool)> {
    let gl = bench.gl;
    let entered = bench.layer.variants.own.enter(&gl, program, with)?;
    let name = entered.variant.name();
    assert_eq!(bench.fake.value(c::CURRENT_PROGRAM), [f64::from(name.0)]);
    Some((name, entered.layers))
}

fn names(own: &OwnVariants) -> Vec<ProgramName> {
    let mut names: Vec<_> = own.names().collect();
    names.sort_unstable_by_key(|name| name.0);
    names
}

const USES: [VariantUse; 4] = [
    VariantUse::Views,
    VariantUse::Layers,
    VariantUse::Instances,
    VariantUse::Rays,
];

#[test]
fn a_program_that_is_not_known_has_no_variant() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    for with in USES {
        assert_eq!(enter(&mut bench, program, with), None, "{with:?}");
    }
    assert_eq!(bench.layer.camera_of(&gl, program), None);
    let own = &mut bench.layer.variants.own;
    assert!(own.layered(program).is_none() && own.projections(program).is_none());
    assert!(
        own.made(program, VariantUse::Rays).is_none()
            && own.search(program).is_none_or(CameraSearch::is_lost)
    );
    assert!(!own.is_current(program, || 0));
    assert_eq!(own.units(&gl, program), []);
    own.forget(&gl, program);
    assert_eq!(bench.fake.calls(), []);
    assert!(!bench.layer.link_layer_variant(&gl, program, true));
    let facts = bench.layer.variant_facts(&gl, program);
    assert_eq!(facts, Shaders::Unlinked(program));
}

#[test]
fn each_use_has_the_variant_that_was_linked_for_it() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    let (alone, layers) = enter(&mut bench, program, VariantUse::Views).expect("a variant");
    assert!(!layers && alone != program);
    // Without one that chooses a layer, the one of a view serves.
    let by_layer = enter(&mut bench, program, VariantUse::Layers);
    assert_eq!(by_layer, Some((alone, false)));
    for with in [VariantUse::Instances, VariantUse::Rays] {
        assert_eq!(enter(&mut bench, program, with), None, "{with:?}");
    }
    let untried = [Linked::Untried; 2];
    assert_eq!(bench.layer.variants.own.layered(program), Some(untried));
    assert!(bench.layer.link_layer_variant(&gl, program, true));
    assert!(!bench.layer.chooses_layers(program));
    assert!(bench.layer.link_layer_variant(&gl, program, false));
    assert!(bench.layer.chooses_layers(program));
    let linked = [Linked::Yes; 2];
    assert_eq!(bench.layer.variants.own.layered(program), Some(linked));
    let (all, layers) = enter(&mut bench, program, VariantUse::Instances).expect("a variant");
    assert!(layers && all != alone);
    let (one, layers) = enter(&mut bench, program, VariantUse::Layers).expect("a variant");
    assert!(layers && one != alone && one != all);
    let mut three = [alone, one, all];
    three.sort_unstable_by_key(|name| name.0);
    assert_eq!(names(&bench.layer.variants.own), three);
    // Nothing is linked twice.
    bench.fake.forget();
    bench.layer.link_variant(&gl, program);
    bench.layer.link_layer_variant(&gl, program, true);
    assert_eq!(bench.fake.count("glLinkProgram"), 0);
}

#[test]
fn a_variant_that_the_driver_refuses_is_tried_once() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    bench.fake.refuse_shaders("gl_Layer");
    bench.fake.forget();
    assert!(!bench.layer.link_layer_variant(&gl, program, true));
    let once = bench.fake.count("glCompileShader");
    assert!(once > 0 && !bench.layer.link_layer_variant(&gl, program, true));
    assert_eq!(bench.fake.count("glCompileShader"), once);
    let layered = [Linked::Untried, Linked::Refused];
    assert_eq!(bench.layer.variants.own.layered(program), Some(layered));
    assert_eq!(enter(&mut bench, program, VariantUse::Instances), None);
    assert_eq!(names(&bench.layer.variants.own).len(), 1);
}

#[test]
fn uniforms_follow_the_program_when_they_change() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    let (alone, _) = enter(&mut bench, program, VariantUse::Views).expect("a variant");
    let matrix = |bench: &Bench| bench.fake.uniform(alone, "camera");
    assert_eq!(matrix(&bench), PERSPECTIVE.map(f64::from));
    bench.fake.forget();
    enter(&mut bench, program, VariantUse::Views);
    assert_eq!(bench.fake.asked(), [], "no uniform has changed");
    bench.fake.program(|gl| {
        gl.use_program(program);
        gl.set_uniform_matrix(0, &FLAT);
    });
    uniform_changes();
    enter(&mut bench, program, VariantUse::Views);
    assert_eq!(matrix(&bench), FLAT.map(f64::from));
}

#[test]
fn the_last_camera_stays_when_no_matrix_has_a_perspective() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    let own = |bench: &Bench| {
        let own = &bench.layer.variants.own;
        (
            own.search(program).is_none_or(CameraSearch::is_lost),
            own.projections(program),
        )
    };
    assert!(own(&bench).0, "not found yet");
    let found = bench.layer.camera_of(&gl, program).expect("a variant");
    let (lost, projections) = own(&bench);
    assert!(found.is_some() && !lost);
    let projections = projections.expect("a camera");
    assert_eq!((projections[0], Some(projections[1])), (PERSPECTIVE, found));
    bench.fake.program(|gl| gl.set_uniform_matrix(0, &FLAT));
    uniform_changes();
    assert_eq!(bench.layer.camera_of(&gl, program), Some(found));
    assert_eq!(own(&bench), (true, Some(projections)));
}

#[test]
fn another_link_has_variants_of_its_own() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    bench.layer.link_layer_variant(&gl, program, true);
    let first = names(&bench.layer.variants.own);
    let same = |bench: &Bench| bench.layer.link_and_hash(program);
    let (link, hash) = same(&bench);
    let own = &mut bench.layer.variants.own;
    assert!(own.is_current(program, || u64::from(link)));
    bench.layer.linked(&gl, program);
    assert_eq!(same(&bench), (link + 1, hash));
    let own = &mut bench.layer.variants.own;
    assert!(!own.is_current(program, || u64::from(link) + 1));
    bench.layer.link_variant(&gl, program);
    let second = names(&bench.layer.variants.own);
    assert_eq!((first.len(), second.len()), (2, 1));
    assert!(first.iter().all(|&name| gl.is_program(name) == 0));
    assert!(gl.is_program(second[0]) != 0);
    assert_eq!(enter(&mut bench, program, VariantUse::Instances), None);
}

#[test]
fn a_program_in_use_is_deleted_when_another_one_is_used() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    let variants = names(&bench.layer.variants.own);
    assert!(!bench.layer.has_pending_deletions());
    assert!(bench.layer.defers_deletion(&gl, program));
    assert!(bench.layer.defers_deletion(&gl, program), "once more");
    assert!(!bench.layer.defers_deletion(&gl, ProgramName::ZERO));
    assert!(!bench.layer.defers_deletion(&gl, ProgramName(99)));
    assert!(bench.layer.has_pending_deletions() && bench.layer.is_pending_deletion(program));
    assert!(!bench.layer.is_pending_deletion(variants[0]));
    let own = &mut bench.layer.variants.own;
    let waiting = own.names().filter(|&name| name == program).count();
    assert_eq!(waiting, 1);
    bench.layer.delete_pending(&gl);
    assert!(bench.layer.is_pending_deletion(program), "still in use");
    assert!(gl.is_program(program) != 0);
    bench.fake.program(|gl| gl.use_program(ProgramName::ZERO));
    bench.layer.delete_pending(&gl);
    assert!(!bench.layer.has_pending_deletions());
    let all = [program, variants[0]];
    assert_eq!(all.map(|name| gl.is_program(name)), [0, 0]);
    assert_eq!(names(&bench.layer.variants.own), []);
}

#[test]
fn a_program_that_is_gone_takes_its_variants_with_it() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    bench.layer.link_variant(&gl, program);
    bench
        .fake
        .program(|gl: &Gl| gl.use_program(ProgramName::ZERO));
    bench.layer.deleted_program(&gl, program);
    assert_eq!(names(&bench.layer.variants.own).len(), 1, "it is there");
    bench.fake.program(|gl| gl.delete_program(program));
    bench.layer.deleted_program(&gl, program);
    assert_eq!(names(&bench.layer.variants.own), []);
    assert_eq!(bench.layer.link_and_hash(program), (0, 0));
}

#[test]
fn sampled_textures_are_found_again_when_their_key_or_a_unit_changes() {
    let mut bench = Bench::new(&FOUR);
    let variants = &mut bench.layer.variants;
    let key = (ProgramName(3), 1, 1);
    let mut known = |key, stale| variants.sampled(key, stale).is_some();
    assert!(!known(key, false), "the first draw");
    assert!(known(key, false));
    assert!(!known(key, true), "another texture is bound");
    assert!(known(key, false));
    for other in [
        (ProgramName(4), 1, 1),
        (ProgramName(4), 2, 1),
        (ProgramName(4), 2, 2),
    ] {
        assert!(!known(other, false), "{other:?}");
        assert!(known(other, false));
    }
}

#[test]
fn variants_are_counted_and_so_are_instances() {
    let mut bench = Bench::new(&FOUR);
    let (program, gl) = (program(&mut bench), bench.gl);
    let before = bench.layer.variants.programs.compiled;
    bench.layer.link_variant(&gl, program);
    bench.layer.link_layer_variant(&gl, program, false);
    assert_eq!(bench.layer.variants.programs.compiled, before + 2);
    assert!(!bench.layer.variants.divides());
    bench.layer.divides();
    assert!(bench.layer.variants.divides());
}
