//! Images and framebuffers of the views, on the fake driver.

use super::fill::fill;
use super::image::TARGETS;
use super::*;
use crate::atlas::Surface;
use crate::gl::fake::{Fake, Scope};
use crate::gl::{Gl, RenderbufferName};

const KINDS: [&str; 3] = ["Textures", "Framebuffers", "Renderbuffers"];

/// A context in which the program has a framebuffer with a texture of 32 x 16 texels and a renderbuffer for depths.
struct Stage {
    fake: Fake,
    gl: Gl,
    offscreen: Offscreen,
    names: Names,
    framebuffer: FramebufferName,
    texture: TextureName,
    renderbuffer: RenderbufferName,
}

impl Stage {
    fn new(fake: Fake) -> Stage {
        let gl = fake.gl();
        let (framebuffer, texture, renderbuffer) = fake.framebuffer(32, 16);
        fake.program(|gl| {
            gl.bind_texture(c::TEXTURE_2D, texture);
            gl.tex_parameteri(c::TEXTURE_2D, c::TEXTURE_MIN_FILTER, c::LINEAR as i32);
            gl.bind_framebuffer(c::FRAMEBUFFER, framebuffer);
        });
        Stage {
            offscreen: Offscreen::new(&gl, 4, true, SharedImages::default()),
            names: Names::default(),
            gl,
            fake,
            framebuffer,
            texture,
            renderbuffer,
        }
    }

    fn split(&mut self) -> bool {
        self.offscreen
            .split(&self.gl, &mut self.names, self.framebuffer)
    }

    fn rebind(&self) {
        self.gl.bind_framebuffer(c::FRAMEBUFFER, self.framebuffer);
    }
}

/// A context in which layers of an array can be textures of their own, and two in which they cannot.
const CONTEXTS: [fn() -> Fake; 3] = [
    Fake::new,
    || Fake::new().version(3, 2),
    || Fake::new().es(3, 2),
];

#[test]
fn looking_at_a_framebuffer_changes_nothing_and_is_done_once() {
    let mut stage = Stage::new(Fake::new());
    let before = stage.fake.state();
    let gl = stage.gl;
    stage.fake.forget();
    let target = stage.offscreen.target(&gl, stage.framebuffer);
    let points: Vec<u32> = target.attachments.iter().map(|a| a.point).collect();
    assert_eq!(points, [c::COLOR_ATTACHMENT0, c::DEPTH_ATTACHMENT]);
    stage.fake.assert_restored(&before);
    let framebuffer = stage.framebuffer;
    stage
        .fake
        .assert_asks_nothing(|| stage.offscreen.number(&gl, framebuffer));
    assert!(!stage.offscreen.is_made(&gl, framebuffer));
    stage.offscreen.attachments_changed();
    stage.fake.forget();
    stage.offscreen.target(&gl, framebuffer);
    assert!(!stage.fake.asked().is_empty(), "something has changed");
}

#[test]
fn each_view_gets_a_framebuffer_and_all_names_are_given_back() {
    for context in CONTEXTS {
        let mut stage = Stage::new(context());
        let version = stage.gl.get_string(c::VERSION);
        let (before, held) = (stage.fake.state(), stage.fake.alive(KINDS));
        assert!(stage.split(), "{version}");
        stage.rebind();
        let differences = before.differences(&stage.fake.state());
        assert_eq!(differences, [""; 0], "{version}");
        let (gl, framebuffer) = (stage.gl, stage.framebuffer);
        let mut views: Vec<FramebufferName> = (0..4)
            .map(|view| stage.offscreen.view(&gl, framebuffer, ViewIndex(view)))
            .collect();
        let target = stage
            .offscreen
            .take(framebuffer, ViewSet::ALL)
            .expect("made");
        let arrays = target.layered().is_some();
        assert_eq!(arrays, version.starts_with("4.5"), "{version}");
        // Without arrays, the framebuffer of the own view is the program's.
        assert_eq!(views[1] == framebuffer, !arrays);
        stage.offscreen.put(target);
        views.sort_unstable();
        views.dedup();
        assert_eq!(views.len(), 4);
        assert!(
            views
                .iter()
                .all(|&name| name == framebuffer || stage.offscreen.owns_framebuffer(name))
        );
        assert_eq!(stage.offscreen.views(stage.texture).len(), 4);
        stage.offscreen.clear(&gl);
        stage.rebind();
        assert_eq!(stage.fake.alive(KINDS), held, "{version}");
        let differences = before.differences(&stage.fake.state());
        assert_eq!(differences, [""; 0], "{version}");
    }
}

#[test]
fn layers_lie_in_the_slots_of_the_views() {
    let mut stage = Stage::new(Fake::new());
    assert!(stage.split());
    let (gl, framebuffer) = (stage.gl, stage.framebuffer);
    let tiles = stage.offscreen.tiles;
    for view in 0..4 {
        let name = stage.offscreen.view(&gl, framebuffer, ViewIndex(view));
        let state = stage.fake.state();
        for point in [c::COLOR_ATTACHMENT0, c::DEPTH_ATTACHMENT] {
            let at = state.get(Scope::Framebuffer(name), point);
            assert_eq!(
                at[3],
                f64::from(tiles.slot(ViewIndex(view))),
                "layer of view {view}"
            );
        }
    }
}

#[test]
fn what_a_framebuffer_holds_is_copied_to_each_view() {
    let mut stage = Stage::new(Fake::new());
    stage.fake.forget();
    stage.split();
    // Colours and depths of four views.
    assert_eq!(stage.fake.count("glCopyImageSubData"), 8);
    stage.offscreen.write_back(&stage.gl);
    assert_eq!(
        stage.fake.count("glCopyImageSubData"),
        8,
        "nothing was drawn"
    );
    let target = stage
        .offscreen
        .take(stage.framebuffer, ViewSet::ALL)
        .expect("made");
    stage.offscreen.drawn_to(&target);
    stage.offscreen.put(target);
    let before = stage.fake.state();
    stage.fake.forget();
    stage.offscreen.write_back(&stage.gl);
    assert_eq!(
        stage.fake.count("glCopyImageSubData"),
        2,
        "back to the program's own"
    );
    let to: Vec<u32> = stage
        .fake
        .calls()
        .iter()
        .filter(|call| call.name == "glCopyImageSubData")
        .map(|call| call.int(6) as u32)
        .collect();
    assert!(to.contains(&stage.texture.0) && to.contains(&stage.renderbuffer.0));
    stage.fake.assert_restored(&before);
    stage.fake.forget();
    stage.offscreen.write_back(&stage.gl);
    assert_eq!(stage.fake.count("gl*"), 0, "once");
}

#[test]
fn a_refused_framebuffer_is_not_tried_again() {
    let mut stage = Stage::new(Fake::new());
    stage.fake.set_framebuffer_status(0x8CDD);
    let framebuffers = stage.fake.alive(["Framebuffers"]);
    assert!(!stage.split());
    assert!(stage.offscreen.is_refused(&stage.gl, stage.framebuffer));
    assert_eq!(stage.fake.alive(["Framebuffers"]), framebuffers);
}

#[test]
fn a_views_texture_is_bound_for_its_draw() {
    let mut stage = Stage::new(Fake::new());
    stage.split();
    stage.rebind();
    let (gl, texture) = (stage.gl, stage.texture);
    stage.fake.program(|gl| {
        gl.active_texture(c::TEXTURE0 + 5);
        gl.bind_texture(c::TEXTURE_2D, texture);
        gl.active_texture(c::TEXTURE0 + 2);
    });
    let before = stage.fake.state();
    let bound = stage
        .offscreen
        .bound_among(&gl, [(3, c::TEXTURE_2D), (5, c::TEXTURE_2D)].into_iter());
    assert_eq!(bound.len(), 1);
    stage.fake.assert_restored(&before);
    assert_eq!(stage.offscreen.bound(&gl).len(), 2, "unit 0 has it as well");
    let views = stage.offscreen.views(texture);
    for (view, &name) in (0..).zip(&views) {
        stage.offscreen.bind(&gl, &bound, ViewIndex(view));
        let state = stage.fake.state();
        let bound = state.int(Scope::Unit(5), c::TEXTURE_BINDING_2D);
        assert_eq!(bound, name.0);
        let filter = state.int(Scope::Texture(name), c::TEXTURE_MIN_FILTER);
        assert_eq!(filter, c::LINEAR, "it looks like the program's");
    }
    stage.offscreen.unbind(&gl, &bound);
    stage.fake.assert_restored(&before);
    // Parameters are read again only after they have changed.
    stage.fake.forget();
    stage.offscreen.bind(&gl, &bound, ViewIndex(3));
    assert_eq!(stage.fake.count("glTexParameter*"), 0);
    // The same value again is no change, nor is a parameter of another texture.
    let filter = |value: u32| Some((c::TEXTURE_MIN_FILTER, value as f32));
    let nearest = filter(c::NEAREST);
    stage.offscreen.parameter(Some(texture), filter(c::LINEAR));
    stage.offscreen.parameter(Some(TextureName(999)), nearest);
    stage.offscreen.bind(&gl, &bound, ViewIndex(3));
    assert_eq!(stage.fake.count("glTexParameter*"), 0);
    for (of, set) in [
        (Some(texture), nearest),
        (Some(texture), None),
        (None, None),
    ] {
        stage.fake.forget();
        stage.offscreen.parameter(of, set);
        for view in [2, 3] {
            stage.offscreen.bind(&gl, &bound, ViewIndex(view));
        }
        let asked = stage.fake.count("glGetTexParameter*");
        assert!(asked > 0, "{set:?}");
        stage.offscreen.bind(&gl, &bound, ViewIndex(1));
        assert_eq!(
            stage.fake.count("glGetTexParameter*"),
            asked,
            "asked once for all views"
        );
    }
    stage.offscreen.unbind(&gl, &bound);
    stage.fake.assert_restored(&before);
}

#[test]
fn nothing_is_asked_where_all_views_see_the_same() {
    let stage = Stage::new(Fake::new());
    let gl = stage.gl;
    stage.fake.forget();
    assert!(
        stage
            .offscreen
            .bound_among(&gl, [(0, c::TEXTURE_2D)].into_iter())
            .is_empty()
    );
    stage.offscreen.bind(&gl, &[], ViewIndex(2));
    stage.offscreen.unbind(&gl, &[]);
    assert_eq!(stage.fake.count("gl*"), 0);
}

#[test]
fn a_target_draws_to_its_views_or_to_all_layers() {
    let mut stage = Stage::new(Fake::new());
    stage.split();
    let gl = stage.gl;
    let mut target = stage
        .offscreen
        .take(stage.framebuffer, ViewSet::ALL)
        .expect("made");
    assert!(
        stage
            .offscreen
            .take(stage.framebuffer, ViewSet::ALL)
            .is_none(),
        "taken"
    );
    for view in 0..4 {
        assert_eq!(target.enter(&gl, ViewIndex(view)), 0);
        let bound = stage.fake.value(c::DRAW_FRAMEBUFFER_BINDING);
        assert_eq!(bound, [f64::from(target.view(ViewIndex(view)).0)]);
    }
    target.take_layers(true);
    stage.fake.forget();
    target.enter(&gl, ViewIndex(0));
    assert_eq!(
        stage.fake.count("gl*"),
        0,
        "the caller has bound all of them"
    );
    assert!(!target.is_depth_only() && !target.is_cube());
}

#[test]
fn an_image_is_copied_by_framebuffers_where_there_is_no_other_way() {
    for target in TARGETS {
        if crate::gl::is_multisampled(target) {
            continue;
        }
        let fake = Fake::new().version(3, 2);
        let gl = fake.gl();
        let [from, to] = fake.program(|gl| {
            [(), ()].map(|()| {
                let name = gl.gen_texture();
                gl.bind_texture(target, name);
                name
            })
        });
        gl.bind_texture(c::TEXTURE_2D, TextureName::ZERO);
        let like = {
            let name = gl.gen_texture();
            gl.bind_texture(c::TEXTURE_2D, name);
            gl.tex_image_rgba8_empty(c::TEXTURE_2D, 8, 4);
            gl.tex_level(c::TEXTURE_2D, 0).expect("a level")
        };
        gl.enable(c::SCISSOR_TEST);
        let (before, held) = (fake.state(), fake.alive(KINDS));
        fake.forget();
        fill(
            &gl,
            target,
            (Object::Texture(from), Object::Texture(to)),
            0,
            &like,
        );
        let copies = if target == c::TEXTURE_CUBE_MAP { 6 } else { 1 };
        let drawn = fake.draws();
        assert_eq!(drawn.len(), copies, "0x{target:04X}");
        assert!(drawn.iter().all(|d| !d.state.is_enabled(c::SCISSOR_TEST)));
        assert_eq!(fake.alive(KINDS), held);
        // The caller binds its framebuffers again.
        fake.assert_restored(&before);
    }
}

#[test]
fn forgotten_objects_take_their_images_along() {
    let mut stage = Stage::new(Fake::new());
    let held = stage.fake.alive(KINDS);
    stage.split();
    stage.rebind();
    let (gl, framebuffer) = (stage.gl, stage.framebuffer);
    assert!(stage.offscreen.is_split(&gl, framebuffer));
    let objects = [
        Object::Texture(stage.texture),
        Object::Renderbuffer(stage.renderbuffer),
    ];
    stage.offscreen.forget(&gl, objects);
    assert!(stage.offscreen.is_empty());
    stage.offscreen.forget_targets(&gl, &[framebuffer]);
    assert_eq!(stage.fake.alive(KINDS), held);
}
