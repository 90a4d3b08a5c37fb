//! The atlas on the fake driver: the objects that it makes, binds and deletes.

use super::{Atlas, AtlasError, Grid, Limits, Names, ReferenceSurface, Surface, Tiles, ViewSet};
use crate::config::AtlasLayout::{self, Layers, SideBySide};
use crate::gl::fake::{Fake, Scope, Snapshot};
use crate::gl::{FramebufferName, Gl, TextureName, consts as c};
use crate::state::{BACK, FRONT, Neutral, Window};
use crate::view::ViewIndex;

const KINDS: [&str; 3] = ["Textures", "Framebuffers", "Buffers"];

fn window(gl: &Gl, samples: u32) -> Window {
    Window {
        samples,
        ..Window::ask(gl, 64, 48, true)
    }
}

fn tiles(layout: AtlasLayout, grid: Grid) -> Tiles {
    let limits = Limits {
        side: 4096,
        layers: 64,
    };
    Tiles::new(4, [64, 48], grid, layout, limits).expect("fits")
}

/// An atlas of four views.
fn atlas(gl: &Gl, layout: AtlasLayout, samples: u32) -> Atlas {
    let tiles = tiles(layout, Grid::FULL);
    Atlas::new(gl, &mut Names::default(), &window(gl, samples), tiles, true).expect("an atlas")
}

/// Texture and layer at an attachment point.
fn attached(state: &Snapshot, framebuffer: FramebufferName, point: u32) -> (TextureName, u32) {
    let values = state.get(Scope::Framebuffer(framebuffer), point);
    let value = |at: usize| values.get(at).copied().unwrap_or(0.0) as u32;
    (TextureName(value(1)), value(3))
}

#[test]
fn layers_have_a_framebuffer_each_and_one_for_all() {
    for (layout, rows) in [(SideBySide, 1), (Layers, 4)] {
        let fake = Fake::new();
        let gl = fake.gl();
        let atlas = atlas(&gl, layout, 0);
        let state = fake.state();
        for row in 0..rows {
            let view = atlas.tiles.view_in(row);
            let (framebuffer, _) = atlas.target(view);
            let color = attached(&state, framebuffer, c::COLOR_ATTACHMENT0);
            let depth = attached(&state, framebuffer, c::DEPTH_ATTACHMENT);
            assert_eq!((color, depth), ((atlas.color, row), (atlas.depth, row)));
        }
        assert_eq!(atlas.layered().is_some(), rows > 1);
        assert_eq!(
            atlas.targets().count(),
            rows as usize + usize::from(rows > 1)
        );
        assert_eq!(
            fake.count("glFramebufferParameteri"),
            atlas.targets().count()
        );
    }
}

#[test]
fn everything_is_given_back() {
    for (layout, samples) in [(SideBySide, 0), (SideBySide, 4), (Layers, 0), (Layers, 4)] {
        let fake = Fake::new();
        let (gl, names) = (fake.gl(), &mut Names::default());
        let before = fake.alive(KINDS);
        let mut atlas = atlas(&gl, layout, samples);
        let window = window(&gl, samples);
        atlas.make_singles(&gl, names, &window, true);
        atlas.make_depths(&gl, names, &window);
        atlas.make_pyramid(&gl, names, &window, 2);
        atlas.make_reference(&gl, names, &window);
        atlas.make_front(&gl, names, &window, false);
        let [textures, framebuffers, buffers] = fake.alive(KINDS);
        assert_eq!(textures, atlas.textures().len());
        assert_eq!((framebuffers, buffers), (atlas.framebuffers().count(), 1));
        atlas.delete(&gl);
        assert_eq!(fake.alive(KINDS), before, "{layout:?} {samples}");
    }
}

#[test]
fn a_framebuffer_that_is_refused_leaves_nothing() {
    let fake = Fake::new();
    fake.set_framebuffer_status(0x8CDD);
    let gl = fake.gl();
    let tiles = tiles(Layers, Grid::FULL);
    let refused = Atlas::new(&gl, &mut Names::default(), &window(&gl, 0), tiles, false);
    let error = refused.expect_err("no atlas");
    assert!(
        matches!(error, AtlasError::Incomplete { status: 0x8CDD, .. }),
        "{error}"
    );
    assert_eq!(fake.alive(KINDS), [0; 3]);
}

#[test]
fn a_layer_is_bound_when_another_one_is() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut atlas = atlas(&gl, Layers, 0);
    gl.bind_framebuffer(c::DRAW_FRAMEBUFFER, atlas.framebuffer());
    fake.forget();
    let own = atlas.tiles.own();
    assert_eq!(atlas.enter(&gl, own), 0);
    assert_eq!(fake.count("gl*"), 0, "it is bound already");
    atlas.enter(&gl, ViewIndex(3));
    atlas.enter(&gl, ViewIndex(3));
    let [other] = &fake.calls()[..] else {
        panic!("{:?}", fake.calls())
    };
    assert_eq!(other.int(1), i64::from(atlas.target(ViewIndex(3)).0.0));
    atlas.bind_layered(&gl);
    fake.forget();
    atlas.enter(&gl, ViewIndex(3));
    assert_eq!(fake.count("glBindFramebuffer"), 1, "after all layers");
    atlas.bind_row(&gl, 0);
    atlas.forget_row();
    fake.assert_asks_nothing(|| atlas.enter(&gl, own));
    assert_eq!(fake.count("gl*"), 0);
}

#[test]
fn the_reference_image_stands_for_the_own_view() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut atlas = atlas(&gl, SideBySide, 0);
    assert!(atlas.make_reference(&gl, &mut Names::default(), &window(&gl, 0)));
    let image = atlas.reference_framebuffer().expect("made");
    let mut surface = ReferenceSurface(&mut atlas);
    assert_eq!(surface.tiles().order().collect::<Vec<_>>(), [ViewIndex(1)]);
    surface.enter(&gl, ViewIndex(1));
    assert_eq!(
        fake.value(c::DRAW_FRAMEBUFFER_BINDING),
        [f64::from(image.0)]
    );
    let textures = atlas.reference().expect("made");
    let (moved, _) = attached(&fake.state(), image, c::COLOR_ATTACHMENT1);
    assert_eq!(moved, textures.image[2]);
}

/// The x range of each blit in the source and in the destination, and the framebuffers that are read and drawn to.
fn blits(fake: &Fake) -> Vec<([i64; 2], [i64; 2], [FramebufferName; 2])> {
    let blit = |drawn: crate::gl::fake::Drawn| {
        let bound = [c::READ_FRAMEBUFFER_BINDING, c::DRAW_FRAMEBUFFER_BINDING];
        let bound = bound.map(|name| FramebufferName(drawn.state.value(name)[0] as u32));
        let edges = |at: usize| [drawn.call.int(at), drawn.call.int(at + 2)];
        (edges(0), edges(4), bound)
    };
    fake.draws().into_iter().map(blit).collect()
}

#[test]
fn the_other_views_get_what_the_own_one_has() {
    let fake = Fake::new();
    let gl = fake.gl();
    let beside = atlas(&gl, SideBySide, 0);
    let row = beside.framebuffer();
    beside.share_own(&gl);
    let to = |x: i64| ([0, 64], [x, x + 64], [row; 2]);
    assert_eq!(blits(&fake), [to(64), to(128), to(192)]);
    fake.forget();
    let layers = atlas(&gl, Layers, 0);
    layers.share_own(&gl);
    let drawn: Vec<FramebufferName> = blits(&fake).iter().map(|blit| blit.2[1]).collect();
    assert_eq!(
        drawn,
        [0, 2, 3].map(|view| layers.target(ViewIndex(view)).0)
    );
    // OpenGL ES does not blit within one framebuffer.
    let fake = fake.es(3, 2);
    fake.forget();
    beside.share_own(&fake.gl());
    assert_eq!(
        (fake.count("glBlit*"), fake.count("glCopyImageSubData")),
        (0, 6)
    );
}

#[test]
fn samples_are_resolved_where_they_are_read() {
    let fake = Fake::new();
    let gl = fake.gl();
    let single = atlas(&gl, SideBySide, 0);
    single.resolve(&gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
    assert!(fake.draws().is_empty(), "nothing to resolve");
    assert_eq!(single.readable(ViewIndex(1)), (single.framebuffer(), 0));
    let many = atlas(&gl, SideBySide, 4);
    let (to, _) = many.readable(ViewIndex(1));
    let bound = [many.framebuffer(), to];
    many.resolve(&gl, &ViewSet::ALL, c::COLOR_BUFFER_BIT);
    assert_eq!(blits(&fake), [([0, 256], [0, 256], bound)]);
    fake.forget();
    many.resolve(
        &gl,
        &[ViewIndex(3)].into_iter().collect(),
        c::COLOR_BUFFER_BIT,
    );
    assert_eq!(blits(&fake), [([192, 256], [192, 256], bound)]);
}

#[test]
fn a_copy_of_a_tile_has_nothing_beside_it() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut atlas = atlas(&gl, SideBySide, 0);
    atlas.make_singles(&gl, &mut Names::default(), &window(&gl, 0), true);
    fake.forget();
    atlas.take_single(&gl, ViewIndex(2), BACK);
    let single = FramebufferName(fake.value(c::READ_FRAMEBUFFER_BINDING)[0] as u32);
    assert_eq!(
        blits(&fake),
        [([128, 192], [0, 64], [atlas.framebuffer(), single])]
    );
    fake.forget();
    let staged = atlas.stage(&gl, ViewIndex(2), BACK, BACK);
    assert_ne!(staged, single);
    atlas.unstage(&gl, ViewIndex(2));
    let tile = atlas.framebuffer();
    let there_and_back = [
        ([128, 192], [0, 64], [tile, staged]),
        ([0, 64], [128, 192], [staged, tile]),
    ];
    assert_eq!(blits(&fake), there_and_back);
    fake.forget();
    atlas.bind_row(&gl, 0);
    assert_eq!(fake.count("glBindFramebuffer"), 1, "no layer was bound");
}

#[test]
fn the_front_buffer_goes_when_nobody_asks_for_it() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut atlas = atlas(&gl, Layers, 0);
    assert!(!atlas.swapped(&gl, true), "there is none");
    let before = fake.alive(KINDS);
    atlas.make_front(&gl, &mut Names::default(), &window(&gl, 0), true);
    assert_eq!(blits(&fake).len(), 4, "with what the back buffer holds");
    let front = atlas.sampled(FRONT);
    assert_ne!(front, atlas.sampled(BACK));
    let point = |fake: &Fake| attached(&fake.state(), atlas.target(ViewIndex(0)).0, FRONT).0;
    assert_eq!(point(&fake), front);
    for _ in 0..30 {
        assert!(atlas.swapped(&gl, false) && atlas.has_front());
    }
    assert!(
        atlas.swapped(&gl, true) && atlas.has_front(),
        "somebody asks"
    );
    let last = (0..31).map(|_| atlas.swapped(&gl, false)).last();
    assert!(last == Some(true) && !atlas.has_front());
    assert_eq!(
        attached(&fake.state(), atlas.target(ViewIndex(0)).0, FRONT),
        (TextureName::ZERO, 0)
    );
    assert_eq!((fake.alive(KINDS), atlas.owns(front)), (before, false));
}

#[test]
fn an_atlas_of_another_grid_gets_what_the_old_one_holds() {
    let fake = Fake::new();
    let (gl, names) = (fake.gl(), &mut Names::default());
    let window = window(&gl, 0);
    let mut old = atlas(&gl, SideBySide, 0);
    let half = tiles(SideBySide, Grid::scaled([32, 24], [64, 48]));
    let mut new = Atlas::new(&gl, names, &window, half, true).expect("an atlas");
    fake.forget();
    new.copy_spread(&gl, &mut old, names, &window);
    let stretched = blits(&fake).into_iter().skip(1).step_by(2);
    let to: Vec<_> = stretched.map(|blit| (blit.0, blit.1)).collect();
    let view = |x: i64| ([0, 64], [x, x + 32]);
    assert_eq!(to, [view(32), view(64), view(96), view(0)]);
    fake.forget();
    old.copy_spread(&gl, &mut new, names, &window);
    assert!(!fake.draws().is_empty());
}

#[test]
fn depths_are_read_when_they_are_there() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut atlas = atlas(&gl, SideBySide, 0);
    atlas.make_depths(&gl, &mut Names::default(), &window(&gl, 0));
    let neutral = Neutral::enter(&gl, true, false);
    let taken = (0..4)
        .map(|_| atlas.take_depths(&gl, &neutral, [0; 4]))
        .collect::<Vec<_>>();
    neutral.leave(&gl);
    assert_eq!(taken, [true, true, true, false]);
    assert!(!atlas.depths_are_there(&gl), "not sent");
    atlas.send_depths(&gl);
    assert!(atlas.depths_are_there(&gl));
    let pictures = atlas.read_depths(&gl);
    assert_eq!(
        pictures
            .iter()
            .map(|picture| picture.depths.len())
            .collect::<Vec<_>>(),
        [64 * 48; 3]
    );
    assert_eq!(fake.value(c::PIXEL_PACK_BUFFER_BINDING), [0.0]);
    assert_eq!(
        (fake.count("glFenceSync"), fake.count("glDeleteSync")),
        (1, 1)
    );
    assert!(atlas.read_depths(&gl).is_empty());
}

#[test]
fn names_are_none_that_a_program_comes_upon() {
    let fake = Fake::new();
    let gl = fake.gl();
    let mut names = Names::default();
    names.promise(TextureName(2));
    let given = [names.texture(&gl), names.texture(&gl)];
    assert_eq!(
        given,
        [1, 3].map(TextureName),
        "the second is promised to a list"
    );
    assert!(gl.is_texture(TextureName(2)) == 0, "and given back");
    names.hide();
    let high = names.texture(&gl);
    assert_eq!((high, names.hidden()), (TextureName(0x4D56_0000), true));
    gl.bind_texture(c::TEXTURE_2D, TextureName(high.0 + 1));
    assert_eq!(
        names.texture(&gl),
        TextureName(high.0 + 2),
        "another context has taken one"
    );
}
