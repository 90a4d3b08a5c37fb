//! Cameras: the raster position, and what follows from the options.

use super::super::cameras::Cameras;
use super::bench::{Bench, PERSPECTIVE, config};
use crate::config::{Camera, Live, Projection};
use crate::gl::consts as c;
use crate::plan::Rig;
use crate::state::Touch;

fn cameras(options: &[(&str, &str)]) -> Cameras {
    let config = config(options);
    Cameras::new(config, &Live::new(config), Some("room"))
}

#[test]
fn the_raster_position_moves_with_the_view_where_it_is_a_point_of_the_scene() {
    let mut cameras = cameras(&[("VIEWS", "4")]);
    let placed = |cameras: &Cameras| (cameras.raster(), cameras.raster_placed());
    assert_eq!(placed(&cameras), (None, Projection::None));
    let camera = Camera::Clip {
        separation: 0.25,
        convergence: 2.0,
    };
    let shift = Rig::new(4, camera, None).shear(&PERSPECTIVE);
    assert!(shift.is_some());
    cameras.place_raster(shift, Projection::Perspective);
    assert_eq!(placed(&cameras), (shift, Projection::Perspective));
    cameras.place_raster(None, Projection::Orthographic);
    assert_eq!(placed(&cameras), (None, Projection::Orthographic));
    cameras.place_raster(shift, Projection::Perspective);
    cameras.place_raster_in_window();
    assert_eq!(placed(&cameras), (None, Projection::None));
}

#[test]
fn the_commands_of_the_program_place_it() {
    let mut bench = Bench::new(&[("VIEWS", "4"), ("STRATEGY", "replay")]);
    let gl = bench.gl;
    bench.look();
    // The first scene places the cameras.
    bench.frame();
    bench.layer.placed_raster(&gl);
    let cameras = &bench.layer.cameras;
    assert_eq!(cameras.raster(), bench.layer.known.rig.shear(&PERSPECTIVE));
    assert!(cameras.raster().is_some());
    assert_eq!(cameras.raster_placed(), Projection::Perspective);
    bench.layer.placed_in_window();
    assert_eq!(bench.layer.cameras.raster(), None);
    assert_eq!(bench.layer.cameras.raster_placed(), Projection::None);
    // A flat projection gives it no shift.
    bench.set(Touch::MODE, |gl| gl.matrix_mode(c::PROJECTION));
    let mut flat = [0.0; 16];
    [flat[0], flat[5], flat[10], flat[15]] = [0.5, 0.5, -1.0, 1.0];
    bench.set(Touch::PROJECTION, |gl| gl.load_matrix(&flat));
    bench.layer.placed_raster(&gl);
    assert_eq!(bench.layer.cameras.raster(), None);
    assert_eq!(
        bench.layer.cameras.raster_placed(),
        Projection::Orthographic
    );
}

#[test]
fn depths_are_measured_where_they_place_the_cameras_or_are_reported() {
    let cases: [(&[(&str, &str)], bool); 5] = [
        (&[("VIEWS", "4")], false),
        (&[("VIEWS", "4"), ("AUTO_DEPTH", "1")], true),
        (&[("VIEWS", "4"), ("AUTO_DEPTH", "")], true),
        (&[("VIEWS", "1"), ("AUTO_DEPTH", "1")], false),
        (&[("VIEWS", "4"), ("REPORT", "/nowhere/report.json")], true),
    ];
    for (options, measured) in cases {
        assert_eq!(cameras(options).comfort.looks(), measured, "{options:?}");
    }
}
