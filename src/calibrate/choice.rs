//! Which of many photos are used: frames of a video differ little, and each photo more has a camera more to solve for.
#![forbid(unsafe_code)]

use super::Sighting;
use glam::DVec3;

/// Photos that are used at most.
pub const MOST: usize = 6;
/// Part of the middle contrast below which a photo counts as blurred.
const BLURRED: f64 = 0.6;

/// The photos to use, in their order: the first one, for the viewers sit there, and those that are taken from the most different directions
/// and distances. Blurred ones are left out.
#[must_use]
pub fn choose(sightings: &[Sighting]) -> Vec<usize> {
    let taken: Vec<Taken> = sightings.iter().map(Taken::new).collect();
    apart(&taken)
}

/// A photo, as far as it counts here.
struct Taken {
    place: DVec3,
    contrast: f64,
}

impl Taken {
    /// The place has the tangents of the direction from the middle of the panel, and the logarithm of the distance: a photo from twice as
    /// far away counts as much as one from 10 degrees aside.
    fn new(sighting: &Sighting) -> Self {
        const DISTANCE: f64 = 0.25;
        let eye = sighting.camera_place();
        let before = eye.z.max(f64::MIN_POSITIVE);
        Self {
            place: DVec3::new(eye.x / before, eye.y / before, DISTANCE * before.ln()),
            contrast: sighting.contrast(),
        }
    }
}

/// Each time that which is farthest from those that are chosen.
fn apart(taken: &[Taken]) -> Vec<usize> {
    if taken.len() <= MOST {
        return (0..taken.len()).collect();
    }
    let mut contrasts: Vec<f64> = taken.iter().map(|taken| taken.contrast).collect();
    contrasts.sort_by(f64::total_cmp);
    let least = BLURRED * contrasts[contrasts.len() / 2];
    let mut left: Vec<(usize, &Taken)> = taken.iter().enumerate().skip(1).collect();
    left.retain(|(_, taken)| taken.contrast >= least);
    let mut chosen: Vec<(usize, &Taken)> = taken.iter().enumerate().take(1).collect();
    while chosen.len() < MOST {
        let distance = |(_, taken): &(usize, &Taken)| {
            let others = chosen
                .iter()
                .map(|(_, other)| taken.place.distance(other.place));
            others.fold(f64::INFINITY, f64::min)
        };
        let farthest = left
            .iter()
            .max_by(|a, b| distance(a).total_cmp(&distance(b)))
            .copied();
        let Some(farthest) = farthest else { break };
        left.retain(|(index, _)| *index != farthest.0);
        chosen.push(farthest);
    }
    let mut chosen: Vec<usize> = chosen.into_iter().map(|(index, _)| index).collect();
    chosen.sort_unstable();
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(x: f64, contrast: f64) -> Taken {
        let place = DVec3::new(x, 0.0, 0.0);
        Taken { place, contrast }
    }

    #[test]
    fn frames_of_a_video_are_thinned_out() {
        // From the right to the left, the third one blurred, and the viewers' place in the middle first.
        let mut all = vec![taken(0.0, 0.5)];
        all.extend((0..41).map(|i| taken(0.2 - 0.01 * f64::from(i), 0.5)));
        all[1].contrast = 0.2;
        let chosen = apart(&all);
        assert_eq!(chosen.len(), MOST);
        assert_eq!(chosen[0], 0, "the viewers' place");
        assert!(!chosen.contains(&1), "a blurred one: {chosen:?}");
        assert!(chosen.contains(&2) && chosen.contains(&41), "{chosen:?}");
        let nearest = chosen.iter().flat_map(|&a| {
            let others = chosen.iter().filter(move |&&b| a != b);
            others.map(move |&b| (a, b))
        });
        let nearest = nearest.map(|(a, b)| all[a].place.distance(all[b].place));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!(nearest > 0.04, "{nearest} of {chosen:?}");
    }

    #[test]
    fn few_photos_are_all_used() {
        let all: Vec<Taken> = (0..MOST).map(|_| taken(0.0, 0.1)).collect();
        assert_eq!(apart(&all), [0, 1, 2, 3, 4, 5]);
        assert!(apart(&[]).is_empty());
    }
}
