use super::*;

const LIMITS: Limits = Limits {
    budget: 0.005,
    orthoscopic: 0.05,
    lens: (1.5, 1.0),
};

fn scene(near: f64, far: f64) -> Seen {
    Seen {
        scene: Some([1.0 / far, 1.0 / near]),
        ..Seen::default()
    }
}

/// Cameras that jump to the first scene.
fn ready(kept: Option<Kept>) -> Comfort {
    Comfort {
        waits: 0,
        ..Comfort::new(kept)
    }
}

fn disparity((separation, convergence): (f64, f64), w: f64) -> f64 {
    separation * (1.0 - convergence / w)
}

#[test]
fn near_and_far_have_their_parts_of_the_budget() {
    for (near, far) in [(1.0, 10.0), (4.0, 5000.0), (0.1, f64::INFINITY)] {
        let cameras = ready(None).track(&scene(near, far), &LIMITS);
        let cameras = cameras.expect("cameras");
        let (front, back) = (disparity(cameras, near), disparity(cameras, far));
        assert!((front + BEFORE * LIMITS.budget).abs() < 1e-12);
        assert!((back - BEHIND * LIMITS.budget).abs() < 1e-12);
    }
}

#[test]
fn a_flat_scene_is_not_made_deeper_than_it_is() {
    let separation = |orthoscopic| {
        let limits = Limits {
            orthoscopic,
            ..LIMITS
        };
        let cameras = ready(None).track(&scene(9.99, 10.01), &limits);
        cameras.map(|c| c.0)
    };
    assert_eq!(separation(0.012), Some(0.012));
    assert_eq!(separation(0.05), Some(MOST * LIMITS.budget));
}

#[test]
fn nothing_leaves_the_budget_when_something_comes_near() {
    let mut comfort = ready(None);
    comfort.track(&scene(5.0, 100.0), &LIMITS);
    for step in 0..100 {
        let near = 5.0 - 0.049 * f64::from(step);
        let seen = scene(near, 100.0);
        let cameras = comfort.track(&seen, &LIMITS).expect("cameras");
        let [behind, before] = seen.reach(cameras.1).map(|r| cameras.0 * r / LIMITS.budget);
        assert!(behind <= LIMIT_BEHIND + 1e-9 && before <= LIMIT_BEFORE + 1e-9);
        // The scene keeps its depth.
        assert!(
            step < 90 || cameras.0 > 0.7 * LIMITS.budget,
            "{step}: {cameras:?}"
        );
    }
    let weapon = Seen {
        others: Some([0.5, 9.0]),
        ..scene(5.0, 100.0)
    };
    let cameras = ready(None).track(&weapon, &LIMITS).expect("cameras");
    assert!(cameras.0 * 8.0 <= LIMITS.budget);
}

#[test]
fn what_comes_near_is_met_before_it_is_there() {
    // A wall of gltron, 8 frames a second.
    let walls = [8.2, 8.07, 6.26, 4.08, 2.09];
    let mut comfort = ready(None);
    for (now, next) in walls.into_iter().zip(&walls[1..]) {
        let cameras = comfort.track(&scene(now, 100.0), &LIMITS).expect("cameras");
        let nearest = disparity(cameras, *next);
        assert!(nearest > -LIMITS.budget, "{now}: {nearest}");
    }
    // From 9 to 8 and on to 7.
    assert!((coming(1.0 / 9.0, 1.0 / 8.0) - 1.0 / 7.0).abs() < 1e-12);
    assert_eq!(coming(1.0 / 9.0, 1.0 / 4.0), 1.0 / 2.0, "half its distance");
    assert_eq!(coming(1.0 / 8.0, 1.0 / 9.0), 1.0 / 9.0, "it goes away");
    comfort.track(&Seen::default(), &LIMITS);
    assert_eq!(comfort.near, None, "nothing was seen that could come");
}

#[test]
fn cameras_wait_for_two_frames_with_about_the_same_scene() {
    // Minetest while its world is loaded: the hand, clouds alone, and then the grass.
    let mut comfort = Comfort::new(None);
    let loading = [54.0, 2200.0, 34.0].map(|near| comfort.track(&scene(near, 9e3), &LIMITS));
    assert_eq!(loading, [None; 3]);
    let found = comfort.track(&scene(34.0, 9e3), &LIMITS);
    assert_eq!(found, ready(None).track(&scene(34.0, 9e3), &LIMITS));

    // Two windows in turn are never alike.
    let mut comfort = Comfort::new(None);
    let frames = (0..PATIENCE).map(|frame| {
        let near = if frame % 2 == 0 { 1.0 } else { 100.0 };
        comfort.track(&scene(near, 9e3), &LIMITS).is_some()
    });
    let found: Vec<_> = frames.collect();
    assert_eq!(found.iter().position(|&found| found), Some(7));

    // What counted as the nearest of the scene turns out to be a hand: the cameras leave it for the scene once that stays.
    let mut comfort = ready(None);
    comfort.track(&scene(34.0, 9e3), &LIMITS);
    comfort.see_foreground([0.03, 0.05]);
    let clouds = comfort
        .track(&scene(2200.0, 9e3), &LIMITS)
        .expect("cameras");
    assert!(disparity(clouds, 34.0) > -LIMITS.budget, "{clouds:?}");
    let grass = comfort.track(&scene(100.0, 9e3), &LIMITS);
    assert_ne!(grass, ready(None).track(&scene(100.0, 9e3), &LIMITS));
    let grass = comfort.track(&scene(100.0, 9e3), &LIMITS);
    assert_eq!(grass, ready(None).track(&scene(100.0, 9e3), &LIMITS));
}

#[test]
fn a_sky_that_appears_is_in_the_budget_before_the_cameras_are() {
    let mut comfort = ready(None);
    let before = comfort.track(&scene(5.0, 8.0), &LIMITS).expect("cameras");
    assert!(before.0 > LIMITS.budget);
    assert!(before.0 * comfort.farthest(before, LIMITS.budget) <= LIMITS.budget);
    let sky = Seen {
        sky: true,
        ..scene(5.0, 8.0)
    };
    let mut now = before;
    for _ in 0..100 {
        now = comfort.track(&sky, &LIMITS).expect("cameras");
    }
    assert_eq!(comfort.farthest(now, LIMITS.budget), 1.0);
    assert!(now.0 < LIMIT_BEHIND * LIMITS.budget);
}

#[test]
fn a_scene_that_trembles_does_not_move_the_cameras() {
    let mut comfort = ready(None);
    let first = comfort.track(&scene(5.0, 100.0), &LIMITS);
    for step in 0..200 {
        let near = 5.0 + 0.3 * (f64::from(step) * 0.7).sin();
        assert_eq!(comfort.track(&scene(near, 100.0), &LIMITS), first);
    }
}

#[test]
fn another_scene_is_reached_in_small_steps() {
    let mut comfort = ready(None);
    let mut before = comfort.track(&scene(1.0, 10.0), &LIMITS).expect("cameras");
    let goal = ready(None).track(&scene(10.0, 1000.0), &LIMITS);
    for _ in 0..400 {
        let now = comfort
            .track(&scene(10.0, 1000.0), &LIMITS)
            .expect("cameras");
        assert!((now.1 / before.1).ln().abs() < 0.08, "{before:?} {now:?}");
        before = now;
    }
    let goal = goal.expect("cameras");
    assert!((before.0 / goal.0).ln().abs() < SLACK && (before.1 / goal.1).ln().abs() < 0.02);
}

/// A weapon at a tenth of the scene's distance leaves the scene its budget, and stands before it. So does an arm that is farther than
/// the grass it covers.
#[test]
fn a_foreground_stands_between_the_scene_and_its_part_of_the_budget() {
    let hands = [
        [1.0, 5.0],
        [0.01, 5.0],
        [0.5, 0.6],
        [4.9, 5.0],
        [0.1, 0.21],
        [0.2, 0.24],
        [0.2, 0.3],
    ];
    for hand in hands {
        let mut comfort = ready(None);
        let scene = comfort.track(&scene(4.0, 100.0), &LIMITS).expect("cameras");
        let own = comfort.foreground(0.25, hand, LIMITS.budget);
        let near = disparity(scene, 4.0);
        let end = -FOREGROUND * LIMITS.budget;
        let by_scene = hand.map(|inverse| disparity(scene, 1.0 / inverse));
        if by_scene[1] >= end && by_scene[0] <= near {
            assert_eq!(own, None);
            continue;
        }
        let [far, nearest] = hand.map(|inverse| disparity(own.expect("cameras"), 1.0 / inverse));
        assert!(
            nearest >= end - 1e-12 && nearest < far && far <= near + 1e-12,
            "{hand:?}: {nearest} {far} {near}"
        );
        assert!(far - nearest <= by_scene[0] - by_scene[1] + 1e-12);
        if by_scene[1] < end {
            assert!((nearest - end).abs() < 1e-12, "{hand:?}: all of its part");
        }
        // What trembles moves nothing.
        let trembling = hand.map(|inverse| 1.05 * inverse);
        assert_eq!(comfort.foreground(0.25, trembling, LIMITS.budget), own);
    }
    let mut comfort = ready(Some(Kept::Separation(0.1)));
    comfort.track(&scene(4.0, 100.0), &LIMITS);
    assert_eq!(comfort.foreground(0.25, [1.0, 5.0], LIMITS.budget), None);
}

/// A foreground does not jump where the scene comes nearer than it, and where it leaves the budget.
#[test]
fn a_foreground_moves_as_the_scene_does() {
    let at = |near: f64, hand: [f64; 2]| {
        let mut comfort = ready(None);
        let scene = comfort.track(&scene(4.0, 100.0), &LIMITS).expect("cameras");
        let own = comfort.foreground(near, hand, LIMITS.budget);
        let shown = hand.map(|inverse| disparity(own.unwrap_or(scene), 1.0 / inverse));
        (shown.map(|d| d / LIMITS.budget), own.is_some(), scene)
    };
    let close = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs().max((b - d).abs()) < 1e-3;
    for hand in [[0.05, 0.06], [0.2, 0.24], [0.2, 0.4]] {
        let [before, after] = [0.9999, 1.0001].map(|part| at(hand[0] * part, hand));
        assert!(after.1, "{hand:?}");
        assert!(close(before.0, after.0), "{hand:?}: {before:?} {after:?}");
    }
    let (_, _, (separation, convergence)) = at(0.1, [0.1, 0.1]);
    let end = (1.0 + FOREGROUND * LIMITS.budget / separation) / convergence;
    for far in [0.05, 0.3] {
        let [before, after] = [0.9999, 1.0001].map(|part| at(0.01, [far, end * part]));
        assert!(!before.1 && after.1, "{far}");
        assert!(close(before.0, after.0), "{far}: {before:?} {after:?}");
    }
}

#[test]
fn what_the_user_sets_stays() {
    let seen = scene(2.0, 50.0);
    let at = |kept| ready(Some(kept)).track(&seen, &LIMITS).expect("cameras");
    assert_eq!(at(Kept::Separation(0.7)).0, 0.7);
    assert_eq!(at(Kept::Convergence(3.0)).1, 3.0);
    assert_eq!(at(Kept::FocalDepth(3.0)).1, 3.0);
    let (separation, convergence) = at(Kept::EyeSpacing(0.2));
    assert!((separation * convergence - 1.5 * 0.2).abs() < 1e-12);
    let (separation, convergence) = at(Kept::Convergence(3.0));
    let [near, far] = [2.0, 50.0].map(|w| disparity((separation, convergence), w) / LIMITS.budget);
    assert!((near + BEFORE).abs() < 1e-12 || (far - BEHIND).abs() < 1e-12);
    assert!(near >= -BEFORE - 1e-12 && far <= BEHIND + 1e-12);
}

#[test]
fn cameras_that_were_nothing_are_left_at_once() {
    let mut comfort = ready(None);
    let nothing = Limits {
        orthoscopic: 0.0,
        ..LIMITS
    };
    for _ in 0..3 {
        let cameras = comfort.track(&scene(2.0, 50.0), &nothing);
        assert_eq!(cameras.map(|c| c.0), Some(0.0));
    }
    let cameras = comfort.track(&scene(2.0, 50.0), &LIMITS);
    assert_eq!(cameras, ready(None).track(&scene(2.0, 50.0), &LIMITS));
}

#[test]
fn without_a_scene_nothing_changes() {
    let mut comfort = ready(None);
    assert_eq!(comfort.track(&Seen::default(), &LIMITS), None);
    let cameras = comfort.track(&scene(2.0, 50.0), &LIMITS);
    assert_eq!(comfort.track(&Seen::default(), &LIMITS), cameras);
}

#[test]
fn a_scene_without_depths_lies_between_the_planes_of_its_projection() {
    let seen = Seen::by_planes([1.0, 1000.0]);
    let [far, near] = seen.scene.expect("a scene");
    assert_eq!(far, 0.0, "something may be infinitely far");
    assert!((near - (1.0 + BEFORE / BEHIND) / 10.0).abs() < 1e-12);
    let cameras = ready(None).track(&seen, &LIMITS);
    assert!((cameras.expect("cameras").1 - 10.0).abs() < 1e-9);
}
