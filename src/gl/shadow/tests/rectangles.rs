//! Viewports and scissor rectangles by their index.

use super::*;

fn viewport(index: u32) -> Key {
    Key::At(c::VIEWPORT, index)
}

fn bits(values: [f32; 4]) -> Option<[u32; 4]> {
    Some(values.map(f32::to_bits))
}

#[test]
fn they_are_those_that_were_set() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    let real = fake.real();
    current(&shadow, || {
        let gl = fake.gl();
        gl.viewport(0, 0, 64, 32);
        assert_eq!(known(&shadow, viewport(2)), None, "nobody asks by an index");
        gl.viewport_indexed_f(2, 0.5, 0.25, 8.0, 4.0);
        assert_eq!(known(&shadow, viewport(2)), bits([0.5, 0.25, 8.0, 4.0]));
        assert_eq!(known(&shadow, viewport(1)), None, "it was set before");
        let of_all = Key::Value(c::VIEWPORT);
        assert!(known(&shadow, of_all).is_some(), "it is that of index 0");
        gl.viewport_indexed_f(0, 0.5, 0.0, 8.0, 4.0);
        assert_eq!(known(&shadow, of_all), None, "drivers round it");
        gl.viewport(1, 2, 30, 20);
        for index in 0..16 {
            assert_eq!(
                known(&shadow, viewport(index)),
                bits([1.0, 2.0, 30.0, 20.0])
            );
        }
        gl.viewport(0, 0, 1 << 20, 8);
        assert_eq!(known(&shadow, viewport(5)), None, "the driver may cut it");
        let two = [[1.0f32, 1.0, 2.0, 2.0], [3.0, 3.0, 4.0, -1.0]].concat();
        // SAFETY: two viewports.
        unsafe { real.glViewportArrayv(6, 2, two.as_ptr() as _) };
        for index in [6, 7] {
            assert_eq!(
                known(&shadow, viewport(index)),
                None,
                "the driver refuses both"
            );
        }
        // SAFETY: one viewport.
        unsafe { real.glViewportArrayv(6, 1, two.as_ptr() as _) };
        assert_eq!(known(&shadow, viewport(6)), bits([1.0, 1.0, 2.0, 2.0]));
        gl.viewport(1, 2, 30, 20);
        let four = [[1.0f32, 1.0, 2.0, 2.0]; 4].concat();
        // SAFETY: four viewports.
        unsafe { real.glViewportArrayv(14, 4, four.as_ptr() as _) };
        assert_eq!(known(&shadow, viewport(14)), None, "some have no index");
        gl.scissor_indexed(3, -1, 2, 3, 4);
        let scissor = Key::At(c::SCISSOR_BOX, 3);
        assert_eq!(known(&shadow, scissor), Some([u32::MAX, 2, 3, 4]));
        gl.scissor(5, 6, 7, 8);
        assert_eq!(known(&shadow, scissor), Some([5, 6, 7, 8]));
    });
}

#[test]
fn a_depth_range_by_its_index_makes_that_of_all_unknown() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        // SAFETY: no pointers.
        unsafe { fake.real().glDepthRange(0.25, 0.5) };
        assert!(known(&shadow, Key::Value(c::DEPTH_RANGE)).is_some());
        // SAFETY: no pointers.
        unsafe { fake.real().glDepthRangeIndexed(0, 0.0, 1.0) };
        assert_eq!(known(&shadow, Key::Value(c::DEPTH_RANGE)), None);
    });
}

#[test]
fn they_are_asked_for_once() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        fake.gl().viewport_indexed_f(2, 0.5, 0.25, 8.0, 4.0);
        let ask = |gl: &Gl| {
            for index in 0..4 {
                gl.get_floats_indexed(c::VIEWPORT, index);
                gl.get_integers_indexed::<4>(c::SCISSOR_BOX, index);
            }
        };
        assert_eq!(asked(&fake, ask), 7);
        assert_eq!(asked(&fake, ask), 0);
        // A list that sets them all.
        let list = crate::gl::ListName(7);
        let gl = fake.gl();
        gl.new_list(list, c::COMPILE);
        gl.viewport(1, 2, 3, 4);
        gl.end_list();
        gl.call_list(list);
        assert_eq!(known(&shadow, viewport(2)), bits([1.0, 2.0, 3.0, 4.0]));
    });
}

/// What glPopAttrib restores was not kept by its index when it was pushed.
#[test]
fn they_are_not_known_after_a_pop_of_what_was_pushed_before() {
    let fake = Fake::new().window(64, 32);
    let shadow = shadow(&fake);
    current(&shadow, || {
        let gl = fake.gl();
        for _ in 0..2 {
            gl.push_attrib(c::ALL_ATTRIB_BITS);
            gl.viewport(1, 2, 3, 4);
            gl.enable(c::BLEND);
        }
        // SAFETY: no pointers.
        unsafe { fake.real().glViewportIndexedf(1, 5.0, 6.0, 7.0, 8.0) };
        gl.enablei(c::BLEND, 1);
        let blends = Key::CapAt(c::BLEND, 0);
        for changed in [false, true] {
            gl.get_floats_indexed(c::VIEWPORT, 0);
            gl.is_enabledi(c::BLEND, 0);
            assert!(known(&shadow, viewport(0)).is_some() && known(&shadow, blends).is_some());
            if changed {
                gl.disablei(c::BLEND, 0);
                gl.viewport_indexed_f(0, 0.5, 0.5, 2.0, 2.0);
            }
            gl.pop_attrib();
            assert_eq!(
                [known(&shadow, viewport(0)), known(&shadow, blends)],
                [None; 2],
                "changed before the pop: {changed}"
            );
        }
    });
}
