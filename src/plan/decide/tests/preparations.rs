//! Preparations before a command can be decided, each of which is asked for once.

use super::*;

fn prepared(facts: &Facts, known: &Known, settings: &Settings) -> Preparation {
    decide(facts, known, settings).expect_err("something to be prepared")
}

fn variant(program: u32) -> VariantFacts {
    VariantFacts {
        far_end: false,
        program: ProgramName(program),
        camera: Some(perspective()),
        lost: false,
        unmeasured: false,
        to_layer: Linked::Untried,
        to_layers: Linked::Untried,
        divides: false,
        unprojects: false,
    }
}

/// A draw by a program with a variant to a framebuffer of the program's that shows the scene.
fn in_a_pass() -> Facts {
    let mut facts = scene();
    facts.shaders = Shaders::Variant(variant(3));
    facts.traits.target = Target::Pass(1);
    facts.destination.framebuffer = FramebufferName(7);
    facts
}

#[test]
fn a_program_is_looked_at_before_its_first_draw() {
    let mut facts = scene();
    facts.shaders = Shaders::Unlinked(ProgramName(3));
    let asked = prepared(&facts, &known(), &settings(Strategy::Replay));
    assert_eq!(asked, Preparation::LinkVariant(ProgramName(3)));
    let one = Settings {
        views: 1,
        ..settings(Strategy::Replay)
    };
    let decision = decide(&facts, &known(), &one).expect("one view needs no variant");
    assert!(!decision.plan.variant);
}

#[test]
fn a_framebuffer_is_split_when_something_that_moves_is_drawn_there() {
    let mut facts = in_a_pass();
    let settings = settings(Strategy::Replay);
    let asked = prepared(&facts, &known(), &settings);
    assert_eq!(asked, Preparation::Split(FramebufferName(7)));
    facts.destination.split = Linked::Yes;
    let plan = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!((plan.method, plan.variant), (Method::Replay, true));
    facts.destination.split = Linked::Refused;
    let plan = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(plan.method, Method::Once, "the driver makes no other");
}

#[test]
fn a_framebuffer_that_nothing_moves_in_is_drawn_once() {
    let mut facts = in_a_pass();
    facts.classed = classed(Class::OffScreen);
    let plan = decided(&facts, &known(), Strategy::Replay).plan;
    assert_eq!(plan.method, Method::Once);
    // Clears do not make the framebuffer differ between views either.
    let mut facts = in_a_pass();
    facts.traits.kind = Kind::Clear {
        depths: true,
        whole: 0,
    };
    facts.classed = classed(Class::Flat);
    assert_eq!(
        decided(&facts, &known(), Strategy::Replay).plan.method,
        Method::Once
    );
    // In a framebuffer that differs, clears go to each view.
    facts.destination.differs = true;
    facts.destination.split = Linked::Yes;
    assert_eq!(
        decided(&facts, &known(), Strategy::Replay).plan.method,
        Method::Replay
    );
}

#[test]
fn what_reads_an_image_of_a_view_makes_its_framebuffer_differ() {
    let mut facts = in_a_pass();
    facts.classed = classed(Class::OffScreen);
    facts.reads_views = true;
    let asked = prepared(&facts, &known(), &settings(Strategy::Replay));
    assert_eq!(asked, Preparation::Split(FramebufferName(7)));
}

#[test]
fn layers_of_a_framebuffer_ask_for_a_variant_that_chooses_them() {
    let mut facts = in_a_pass();
    facts.destination.split = Linked::Yes;
    facts.destination.layered = true;
    let wanted = |all| Preparation::LinkLayers {
        program: ProgramName(3),
        all,
    };
    let asked = prepared(&facts, &known(), &settings(Strategy::Replay));
    assert_eq!(asked, wanted(false));
    let Shaders::Variant(ours) = &mut facts.shaders else {
        panic!("a variant")
    };
    ours.to_layer = Linked::Refused;
    decided(&facts, &known(), Strategy::Replay);
    let asked = prepared(&facts, &known(), &settings(Strategy::Instanced));
    assert_eq!(asked, wanted(true));
}

#[test]
fn the_depths_of_the_frame_before_are_measured_first() {
    let settings = Settings {
        measures_depths: true,
        ..settings(Strategy::Replay)
    };
    let asked = prepared(&scene(), &known(), &settings);
    assert_eq!(asked, Preparation::MeasureDepths);
    let mut begun = known();
    begun.depths.begun = true;
    decide(&scene(), &begun, &settings).expect("once a frame");
    // Nothing is measured where the picture does not end up in the window.
    assert_eq!(
        prepared(&in_a_pass(), &known(), &settings),
        Preparation::MeasureDepths
    );
    let mut facts = in_a_pass();
    facts.traits.target = Target::Framebuffer(1);
    facts.classed = classed(Class::OffScreen);
    decide(&facts, &known(), &settings).expect("depths elsewhere are not the window's");
}

#[test]
fn grids_retreat_from_what_they_cannot_hold() {
    let lens = GridFacts {
        demand: Demand::None,
        aligned: true,
        slanted: true,
        stippled: false,
        outlined: false,
    };
    let scaled = GridFacts {
        aligned: false,
        slanted: false,
        ..lens
    };
    let of = |grid: GridFacts, change: &dyn Fn(&mut Facts)| {
        let mut facts = scene();
        facts.grid = Some(grid);
        change(&mut facts);
        match decide(&facts, &known(), &settings(Strategy::Replay)) {
            Err(Preparation::ChangeGrid(detail, _)) => Some(detail),
            _ => None,
        }
    };
    let kind = |kind: Kind| move |facts: &mut Facts| facts.traits.kind = kind;
    let cleared = Kind::Clear {
        depths: true,
        whole: 0,
    };
    let part = |facts: &mut Facts| facts.rects.viewport = [0, 0, 320, 480];
    assert_eq!(of(lens, &|_| ()), None, "triangles over the whole window");
    for lines in [c::POINTS, c::LINES, c::LINE_LOOP, c::LINE_STRIP] {
        assert_eq!(of(lens, &kind(Kind::Begin(lines))), Some(Detail::Scaled));
        assert_eq!(of(scaled, &kind(Kind::Begin(lines))), None);
    }
    assert_eq!(of(lens, &kind(Kind::Arrays(c::TRIANGLES))), None);
    assert_eq!(of(lens, &part), Some(Detail::Scaled), "parts of the window");
    assert_eq!(of(scaled, &part), None);
    let whole = |facts: &mut Facts| facts.rects.scissor = Some([0, 0, 640, 480]);
    assert_eq!(of(lens, &whole), None);
    let cut = |facts: &mut Facts| facts.rects.scissor = Some([0, 0, 640, 479]);
    assert_eq!(of(lens, &cut), Some(Detail::Scaled));
    let clear_of_part = |facts: &mut Facts| {
        facts.traits.kind = cleared;
        facts.rects.scissor = Some([1, 0, 640, 480]);
    };
    assert_eq!(of(lens, &clear_of_part), Some(Detail::Scaled));
    assert_eq!(of(scaled, &clear_of_part), None);
    for grid in [lens, scaled] {
        assert_eq!(of(grid, &kind(Kind::Pixels)), Some(Detail::Full));
        assert_eq!(of(grid, &kind(Kind::Accum)), Some(Detail::Full));
        let program = |facts: &mut Facts| facts.shaders = Shaders::Pipeline;
        assert_eq!(of(grid, &program), Some(Detail::Full));
        let stippled = GridFacts {
            stippled: true,
            ..grid
        };
        assert_eq!(of(stippled, &|_| ()), Some(Detail::Full));
        // Outside the window the grid of the atlas does not matter.
        let elsewhere = |facts: &mut Facts| {
            *facts = Facts {
                grid: facts.grid,
                ..in_a_pass()
            };
            facts.traits.kind = Kind::Pixels;
        };
        assert_eq!(of(grid, &elsewhere), None);
    }
    let outlined = GridFacts {
        outlined: true,
        ..lens
    };
    assert_eq!(of(outlined, &|_| ()), Some(Detail::Scaled));
}

#[test]
fn demands_of_display_lists_are_met_where_they_are_not_already() {
    let everything = Demand::Everything(Unrepresentable::Copies);
    assert_eq!(
        retreat(everything, false, false),
        Some((Detail::Full, Unrepresentable::Copies))
    );
    assert_eq!(retreat(everything, true, false), None);
    let lines_or_points =
        |aligned| retreat(Demand::LinesOrPoints, false, aligned).map(|(detail, _)| detail);
    assert_eq!(lines_or_points(true), Some(Detail::Scaled));
    assert_eq!(lines_or_points(false), None);
    assert_eq!(retreat(Demand::None, false, true), None);
}

#[test]
fn a_demand_changes_the_grid_before_anything_is_drawn() {
    let of = |demand: Demand, aligned: bool| {
        let mut facts = scene();
        facts.grid = Some(GridFacts {
            demand,
            aligned,
            slanted: false,
            stippled: false,
            outlined: false,
        });
        decide(&facts, &known(), &settings(Strategy::Replay)).err()
    };
    let what = Unrepresentable::ForeignLists;
    let full = Preparation::ChangeGrid(Detail::Full, what);
    assert_eq!(of(Demand::Everything(what), true), Some(full));
    assert_eq!(of(Demand::Everything(what), false), Some(full));
    let lines = Preparation::ChangeGrid(Detail::Scaled, Unrepresentable::ListsOfLines);
    assert_eq!(of(Demand::LinesOrPoints, true), Some(lines));
    assert_eq!(of(Demand::LinesOrPoints, false), None);
}
