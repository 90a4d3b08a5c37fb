//! Recordings: the calls between glBegin and glEnd, and the display lists that hold one of those two.

use super::super::recordings::Recordings;
use crate::draw::ReplayHazard;
use crate::gl::{Ends, ListName, slot};
use crate::state::Effect;

/// Records a colour before each of two vertices.
fn coloured(recordings: &mut Recordings) {
    recordings.start();
    for _ in 0..2 {
        recordings.record(slot::glColor3f, Effect::COLOR, |_| {});
        recordings.record(slot::glVertex3f, Effect::VERTEX, |_| {});
    }
}

#[test]
fn a_recording_has_the_calls_since_its_start() {
    let mut recordings = Recordings::default();
    coloured(&mut recordings);
    assert_eq!(recordings.sets(), Effect::COLOR);
    assert_eq!(recordings.hazard(), ReplayHazard::None);
    assert!(recordings.is_whole() && !recordings.changes_material());
    let taken = recordings.take();
    assert_eq!(taken.calls(), 4);
    assert_eq!(recordings.take().calls(), 0);
    recordings.put(taken);
    recordings.start();
    assert_eq!(recordings.sets(), Effect::NONE);
    assert_eq!(recordings.take().calls(), 0);
}

#[test]
fn a_value_that_changes_after_a_vertex_has_to_be_put_back() {
    let mut recordings = Recordings::default();
    recordings.start();
    recordings.record(slot::glVertex3f, Effect::VERTEX, |_| {});
    recordings.record(slot::glNormal3f, Effect::NORMAL, |_| {});
    assert_eq!(recordings.hazard(), ReplayHazard::Current(Effect::NORMAL));
    recordings.record(slot::glMaterialfv, Effect::MATERIAL, |_| {});
    assert!(recordings.changes_material());
    assert!(recordings.sets().has(Effect::NORMAL | Effect::MATERIAL));
}

#[test]
fn lists_that_begin_or_end_it_may_change_anything() {
    let (opener, closer) = (ListName(3), ListName(4));
    let mut recordings = Recordings::default();
    coloured(&mut recordings);
    recordings.closed_by(closer);
    assert_eq!(
        recordings.ends(),
        Ends {
            opener: ListName::ZERO,
            closer
        }
    );
    assert!(!recordings.is_whole() && recordings.sets().has(Effect::UNKNOWN));
    assert_ne!(recordings.hazard(), ReplayHazard::None);
    recordings.start();
    assert!(recordings.is_whole() && recordings.sets() == Effect::NONE);
    recordings.opened_by(opener);
    recordings.closed_by(closer);
    assert_eq!(recordings.ends(), Ends { opener, closer });
    assert!(recordings.sets().has(Effect::UNKNOWN));
    // What a list sets may be the material.
    assert!(recordings.changes_material());
}
