//! The class of draws, case by case.

use super::*;
use glam::{Mat4, Vec3};
use std::path::Path;

fn classifier(profile: &str) -> Classifier {
    let profile = Profile::parse(profile, Path::new("test.toml")).expect("a profile");
    Classifier::new(&profile, None, Some("room"), false)
}

fn facts() -> Traits {
    Traits {
        kind: Kind::Begin(7),
        target: Target::Window,
        draw: 5,
        clear: 1,
        after_clear: 4,
        list: None,
        raster: Projection::None,
        projection: Projection::Perspective,
        viewport: Viewport::Main,
        centred: true,
        depth_state: DepthState::On,
        range: DepthRange::Whole,
        texture: TextureName(3),
        image: 0,
        program: 0,
        shader: 0,
        turns: false,
        far_end: false,
        slants: false,
        first: true,
        backdrop: BackdropStage::None,
        foreground: false,
    }
}

fn class(classifier: &Classifier, facts: Traits) -> (Class, Why) {
    let classed = classifier.class(&facts);
    (classed.class, classed.why)
}

#[test]
fn the_state_tells_what_a_draw_is() {
    let c = classifier("");
    let sky = Traits {
        depth_state: DepthState::Off,
        turns: true,
        ..facts()
    };
    let cases = [
        (facts(), Class::Scene, Why::Perspective),
        (
            Traits {
                projection: Projection::Orthographic,
                ..facts()
            },
            Class::Flat,
            Why::Orthographic,
        ),
        (
            Traits {
                projection: Projection::None,
                ..facts()
            },
            Class::Flat,
            Why::NoProjection,
        ),
        (
            Traits {
                projection: Projection::Orthographic,
                slants: true,
                ..facts()
            },
            Class::Scene,
            Why::Slanted,
        ),
        (
            Traits {
                kind: Kind::Pixels,
                ..facts()
            },
            Class::Flat,
            Why::Raster,
        ),
        (
            Traits {
                kind: Kind::Pixels,
                raster: Projection::Perspective,
                projection: Projection::Orthographic,
                ..facts()
            },
            Class::Scene,
            Why::Raster,
        ),
        (
            Traits {
                kind: Kind::Clear {
                    depths: true,
                    whole: 0,
                },
                ..sky
            },
            Class::Flat,
            Why::Whole,
        ),
        (
            Traits {
                target: Target::Framebuffer(4),
                ..sky
            },
            Class::OffScreen,
            Why::Framebuffer(4),
        ),
        (
            Traits {
                target: Target::Nothing,
                ..sky
            },
            Class::OffScreen,
            Why::NoPicture,
        ),
        (sky, Class::Sky, Why::TurnsAboutEye),
        (
            Traits {
                range: DepthRange::Far,
                first: false,
                ..facts()
            },
            Class::Sky,
            Why::FarRange,
        ),
        (
            Traits {
                range: DepthRange::Far,
                projection: Projection::Orthographic,
                ..facts()
            },
            Class::Flat,
            Why::Orthographic,
        ),
        (
            Traits {
                range: DepthRange::Near,
                ..facts()
            },
            Class::Scene,
            Why::Perspective,
        ),
        (
            Traits {
                depth_state: DepthState::TestOnly,
                ..sky
            },
            Class::Sky,
            Why::TurnsAboutEye,
        ),
    ];
    for (facts, want, why) in cases {
        assert_eq!(class(&c, facts), (want, why), "{facts:?}");
    }
    let backdrop = Traits {
        depth_state: DepthState::On,
        first: false,
        turns: true,
        backdrop: BackdropStage::Begun,
        ..facts()
    };
    assert_eq!(class(&c, backdrop), (Class::Sky, Why::Backdrop));
    let moved = Traits {
        turns: false,
        ..backdrop
    };
    assert_eq!(class(&c, moved), (Class::Scene, Why::Perspective));
    let (mut begins, mut sun) = (backdrop, moved);
    begins.backdrop = BackdropStage::Expected;
    assert_eq!(class(&c, begins), (Class::Sky, Why::Backdrop));
    sun.depth_state = DepthState::Off;
    assert_eq!(class(&c, sun), (Class::Sky, Why::Backdrop));
    sun.backdrop = BackdropStage::Expected;
    assert_eq!(class(&c, sun), (Class::Scene, Why::Perspective));
    // By its shader alone.
    let far = Traits {
        depth_state: DepthState::On,
        far_end: true,
        first: false,
        ..facts()
    };
    assert_eq!(class(&c, far), (Class::Sky, Why::FarEnd));
    let flat = Traits {
        projection: Projection::None,
        ..far
    };
    assert_eq!(class(&c, flat), (Class::Flat, Why::NoProjection));
    // A draw that differs from a sky in one respect belongs to the scene.
    for near in [
        Traits {
            depth_state: DepthState::On,
            ..sky
        },
        Traits {
            turns: false,
            ..sky
        },
        Traits {
            centred: false,
            ..sky
        },
        Traits {
            first: false,
            ..sky
        },
    ] {
        assert_eq!(class(&c, near), (Class::Scene, Why::Perspective));
    }
}

#[test]
fn turning_is_neither_moving_nor_standing_still() {
    // Near plane 0.1, far plane 10,000.
    let mut p = [0.0; 16];
    [p[0], p[5], p[10], p[11], p[14]] = [1.4, 1.8, -1.00002, -1.0, -0.200002];
    let turns = |m: Mat4| turns(&m.to_cols_array(), &p);
    let turned = Mat4::from_rotation_y(0.3) * Mat4::from_scale(Vec3::splat(9.0));
    assert!(turns(turned));
    assert!(!turns(turned * Mat4::from_translation(Vec3::X)));
    assert!(!turns(Mat4::IDENTITY));
    // A camera far from the origin, and a sky that is moved to it.
    let eye = Vec3::new(-3431.7, 223.9, 2871.3);
    let turned_to = glam::DMat4::from_rotation_y(0.3);
    let view = turned_to * glam::DMat4::from_translation(-eye.as_dvec3());
    let sky = view.as_mat4() * Mat4::from_translation(eye);
    assert_ne!(sky.w_axis.truncate(), Vec3::ZERO);
    assert!(turns(sky));
    // Meant as they are: nothing has been rounded.
    assert!(!turns(Mat4::from_translation(sky.w_axis.truncate())));
    let scaled = Mat4::from_scale(Vec3::splat(2.0));
    assert!(turns(scaled));
    assert!(!turns(
        Mat4::from_translation(sky.w_axis.truncate()) * scaled
    ));
    // A thing at the near plane is seen to move.
    let hand = Mat4::from_translation(Vec3::new(0.0, 0.0, -0.1)) * turned;
    assert!(!turns(hand));
}

/// Each kind of draw of which a person may want another class, and what is proposed.
#[test]
fn a_sky_is_proposed_where_one_may_be_seen() {
    let around = Traits {
        turns: true,
        ..facts()
    };
    let before = Traits {
        depth_state: DepthState::Off,
        ..facts()
    };
    let later = Traits {
        first: false,
        ..before
    };
    for (facts, want) in [
        (around, "sky"),
        (before, "sky"),
        (later, "flat"),
        (facts(), "flat"),
    ] {
        let classed = classifier("").class(&facts);
        let line = facts.rule(&classed).expect("a rule");
        assert!(line.contains(&format!("class = \"{want}\"")), "{line}");
    }
}

#[test]
fn the_first_rule_whose_every_key_matches_decides() {
    let c = classifier(
        r#"
        hud-depth = 0.5
        rule = [
            { executable = "other", class = "off-screen" },
            { texture = [1, 3], projection = "orthographic", class = "flat", depth = -0.5 },
            { list = 9, class = "sky" },
            { draw = "8..", depth-state = "on", class = "flat" },
            { draw = 5, viewport = "inset", class = "flat", depth = 0 },
            { draw = 5, depth-range = "near", class = "scene", focal-depth = 2 },
            { draw = 5, class = "scene" },
        ]"#,
    );
    let why = |facts| c.class(&facts).why;
    assert_eq!(why(facts()), Why::Rule(7));
    assert_eq!(c.class(&facts()).focal, None);
    let near = Traits {
        range: DepthRange::Near,
        ..facts()
    };
    assert_eq!((why(near), c.class(&near).focal), (Why::Rule(6), Some(2.0)));
    let inset = Traits {
        viewport: Viewport::Inset,
        ..near
    };
    assert_eq!(why(inset), Why::Rule(5));
    let flat = Traits {
        projection: Projection::Orthographic,
        ..facts()
    };
    assert_eq!((why(flat), c.class(&flat).depth), (Why::Rule(2), -0.5));
    let other_texture = Traits {
        texture: TextureName(2),
        ..flat
    };
    assert_eq!(why(other_texture), Why::Rule(7));
    let list = Traits {
        list: Some(ListName(9)),
        ..facts()
    };
    assert_eq!(why(list), Why::Rule(3));
    let late = Traits {
        draw: 12,
        ..facts()
    };
    assert_eq!((why(late), c.class(&late).depth), (Why::Rule(4), 0.5));
    let late_flat = Traits { draw: 12, ..flat };
    assert_eq!(
        why(Traits {
            texture: TextureName::ZERO,
            ..late_flat
        }),
        Why::Rule(4)
    );
    let outside = Traits {
        depth_state: DepthState::Off,
        draw: 12,
        ..flat
    };
    let classed = c.class(&Traits {
        texture: TextureName::ZERO,
        ..outside
    });
    assert_eq!((classed.why, classed.depth), (Why::Orthographic, 0.5));
}

#[test]
fn rules_know_images_and_places_between_clears() {
    let c = classifier(
        r#"rule = [
            { image = "00000000000000ff", class = "sky" },
            { clear = 2, after-clear = "1..3", class = "flat" },
            { clear = 2, before-depth = true, class = "off-screen" },
        ]"#,
    );
    let why = |change: fn(&mut Traits)| {
        let mut facts = facts();
        change(&mut facts);
        c.class(&facts).why
    };
    assert_eq!(why(|f| f.image = 255), Why::Rule(1));
    assert_eq!(why(|f| f.image = 254), Why::Perspective);
    let after = |clear, after_clear, first| {
        let facts = Traits {
            clear,
            after_clear,
            first,
            ..facts()
        };
        c.class(&facts).why
    };
    assert_eq!(after(2, 3, true), Why::Rule(2));
    assert_eq!(after(2, 4, true), Why::Rule(3));
    assert_eq!(after(2, 4, false), Why::Perspective);
    assert_eq!(after(1, 3, true), Why::Perspective);
    assert!(c.needs_image() && !classifier("").needs_image());
    let groups = c.needs(Kind::Other, Projection::Orthographic, false);
    assert_eq!(groups, Touch::TEXTURE);
}

#[test]
fn what_is_the_same_in_every_run_is_proposed() {
    let line = |facts: Traits| {
        let classed = classifier("").class(&facts);
        facts.rule(&classed).expect("a rule")
    };
    let painted = Traits {
        image: 0xABC,
        ..facts()
    };
    let text = line(painted);
    assert!(
        text.starts_with("{ image = \"0000000000000abc\", projection"),
        "{text}"
    );
    let shaded = Traits {
        shader: 1,
        ..painted
    };
    assert!(!line(shaded).contains("image"), "its shaders tell it");
    let plain = Traits {
        texture: TextureName::ZERO,
        clear: 2,
        ..facts()
    };
    let text = line(plain);
    assert!(
        text.starts_with("{ clear = 2, after-clear = 4, projection"),
        "{text}"
    );
    let sky = Traits {
        depth_state: DepthState::TestOnly,
        ..plain
    };
    assert!(line(sky).contains("before-depth = true, class = \"sky\""));
}

#[test]
fn state_is_asked_for_only_where_it_may_decide() {
    let plain = classifier("");
    let needs = |c: &Classifier, p, first| c.needs(Kind::Other, p, first);
    assert_eq!(needs(&plain, Projection::Orthographic, true), Touch::NONE);
    assert_eq!(needs(&plain, Projection::Perspective, false), Touch::RANGE);
    assert_eq!(
        needs(&plain, Projection::Perspective, true),
        Touch::DEPTH | Touch::RANGE
    );
    let textures = classifier("rule = [{ texture = 1, class = \"flat\" }]");
    assert_eq!(
        needs(&textures, Projection::Orthographic, false),
        Touch::TEXTURE
    );
    assert_eq!(
        textures.needs(
            Kind::Clear {
                depths: true,
                whole: 0
            },
            Projection::Perspective,
            true
        ),
        Touch::NONE
    );
}

#[test]
fn a_suggested_rule_is_one_that_matches_and_changes_the_class() {
    let all = [
        facts(),
        Traits {
            texture: TextureName::ZERO,
            ..facts()
        },
        Traits {
            projection: Projection::Orthographic,
            depth_state: DepthState::Off,
            ..facts()
        },
        Traits {
            range: DepthRange::Far,
            viewport: Viewport::Inset,
            ..facts()
        },
        Traits {
            list: Some(ListName(7)),
            turns: true,
            depth_state: DepthState::TestOnly,
            ..facts()
        },
    ];
    for facts in all {
        let before = classifier("").class(&facts);
        let line = facts.rule(&before).expect("a rule");
        let after = classifier(&format!("rule = [\n{line}\n]")).class(&facts);
        assert_eq!(after.why, Why::Rule(1), "{line}");
        assert_ne!(
            (before.class, before.depth),
            (after.class, after.depth),
            "{line}"
        );
    }
}

#[test]
fn rules_know_shaders_and_passes() {
    let c = classifier(
        r#"rule = [
            { pass = 4, shader = "00000000000000ff", class = "sky" },
            { shader = "00000000000000ff", class = "flat" },
            { program = 9, class = "off-screen" },
            { pass = 5, class = "scene" },
            { pass = 0, class = "flat" },
        ]"#,
    );
    let why = |target, program, shader| {
        let facts = Traits {
            target,
            program,
            shader,
            ..facts()
        };
        class(&c, facts)
    };
    let rule = Why::Rule;
    assert_eq!(why(Target::Pass(4), 2, 255), (Class::Sky, rule(1)));
    assert_eq!(why(Target::Window, 2, 255), (Class::Flat, rule(2)));
    assert_eq!(why(Target::Pass(6), 9, 1), (Class::OffScreen, rule(3)));
    assert_eq!(why(Target::Window, 2, 1), (Class::Flat, rule(5)));
    assert_eq!(why(Target::Pass(6), 2, 1), (Class::Scene, Why::Perspective));
    // A framebuffer that does not end up in the window gets another class only by a rule that names it.
    assert_eq!(why(Target::Framebuffer(5), 2, 1), (Class::Scene, rule(4)));
    let other = why(Target::Framebuffer(6), 2, 255);
    assert_eq!(other, (Class::OffScreen, Why::Framebuffer(6)));
    let line = |target, shader| {
        let facts = Traits {
            target,
            shader,
            texture: TextureName::ZERO,
            ..facts()
        };
        facts.rule(&c.class(&facts)).expect("a rule")
    };
    let pass = line(Target::Pass(6), 0xABC);
    assert!(
        pass.starts_with(r#"{ pass = 6, shader = "0000000000000abc", projection"#),
        "{pass}"
    );
    assert!(line(Target::Window, 0).starts_with("{ draw = 5, "));
    assert!(line(Target::Pass(6), 0).starts_with("{ pass = 6, draw = 5, "));
    let wrong = Profile::parse(
        "rule = [{ shader = \"ff\", class = \"sky\" }]",
        Path::new("p.toml"),
    );
    let wrong = wrong.expect_err("too short").to_string();
    assert!(
        wrong.contains("shader is 'ff'; give the 16 hexadecimal digits"),
        "{wrong}"
    );
}

#[test]
fn the_depth_of_the_display_changes_what_no_rule_places() {
    let mut c = classifier("[[rule]]\ntexture = 9\nclass = \"flat\"\ndepth = 0.5\n");
    let flat = Traits {
        projection: Projection::Orthographic,
        ..facts()
    };
    let ruled = Traits {
        texture: TextureName(9),
        ..facts()
    };
    let position = Traits {
        kind: Kind::Pixels,
        raster: Projection::Orthographic,
        ..facts()
    };
    for depth in [0.0, 0.25, -0.5] {
        c.change_hud_depth(FlatDepth::At(depth));
        assert_eq!(c.class(&flat).depth, depth);
        assert_eq!(c.class(&position).depth, depth);
        assert_eq!(c.class(&ruled).depth, 0.5);
        assert_eq!(c.class(&facts()).depth, 0.0, "a scene has its own depths");
    }
}

#[test]
fn the_modelview_is_read_only_where_a_sky_is_possible() {
    let c = classifier("");
    let (perspective, orthographic) = (Projection::Perspective, Projection::Orthographic);
    for (projection, first, depth, backdrop, needed) in [
        (perspective, true, DepthState::Off, false, true),
        (perspective, true, DepthState::TestOnly, false, true),
        (perspective, true, DepthState::On, false, false),
        (perspective, true, DepthState::On, true, true),
        (perspective, false, DepthState::On, true, true),
        (perspective, false, DepthState::Off, false, false),
        (orthographic, true, DepthState::Off, true, false),
        (Projection::None, true, DepthState::Off, true, false),
    ] {
        let needs = c.needs_modelview(projection, first, depth, backdrop);
        assert_eq!(needs, needed, "{projection:?} {first} {depth:?} {backdrop}");
    }
}

#[test]
fn the_proposed_class_is_another_one() {
    let proposed = |facts: &Traits| {
        let rule = facts.rule(&classifier("").class(facts)).expect("a rule");
        let class = rule.split("class = \"").nth(1).expect("a class");
        class.split('"').next().unwrap_or_default().to_owned()
    };
    let flat = Traits {
        kind: Kind::Pixels,
        raster: Projection::Orthographic,
        ..facts()
    };
    // Pixels have no depths of their own, whatever the projection is.
    assert_eq!(proposed(&flat), "flat");
    assert_eq!(proposed(&facts()), "flat");
    // What a rule makes flat in perspective may be a part of the scene.
    let flat = classifier("[[rule]]\ntexture = 3\nclass = \"flat\"\n");
    let rule = facts().rule(&flat.class(&facts())).expect("a rule");
    assert!(rule.contains("class = \"scene\""), "{rule}");
}
