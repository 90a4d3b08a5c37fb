//! Vectors in panel space and refraction in vector form.

/// A point in mm or a direction: x right, y up, z towards the viewer.
pub type V3 = [f64; 3];

pub fn add(a: V3, b: V3) -> V3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub fn sub(a: V3, b: V3) -> V3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn scale(a: V3, by: f64) -> V3 {
    [a[0] * by, a[1] * by, a[2] * by]
}

pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: V3, b: V3) -> V3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub fn unit(a: V3) -> V3 {
    scale(a, 1.0 / dot(a, a).sqrt())
}

/// The direction behind a face between two media of the indices `from` and `to`.
///
/// `direction` and `normal` are unit vectors. The normal may point to either side. None means total reflection.
pub fn refract(direction: V3, normal: V3, from: f64, to: f64) -> Option<V3> {
    let facing = dot(direction, normal);
    let (normal, cosine) = if facing > 0.0 {
        (scale(normal, -1.0), facing)
    } else {
        (normal, -facing)
    };
    let ratio = from / to;
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (square >= 0.0).then(|| {
        add(
            scale(direction, ratio),
            scale(normal, ratio * cosine - square.sqrt()),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 30 degrees in air: sin 30 = 0.5, so the sine in glass of 1.5 is 0.5 / 1.5 = 1/3 and the cosine sqrt(1 - 1/9) = 0.942809.
    #[test]
    fn thirty_degrees_into_glass_and_back() {
        let normal = [0.0, 0.0, 1.0];
        let air = [0.5, 0.0, -(0.75f64.sqrt())];
        let glass = refract(air, normal, 1.0, 1.5).expect("air into glass");
        assert!((glass[0] - 1.0 / 3.0).abs() < 1e-12);
        assert!((glass[2] + 0.942_809_041_582_063_4).abs() < 1e-12);
        let out = refract(glass, normal, 1.5, 1.0).expect("below the critical angle");
        assert!((0..3).all(|i| (out[i] - air[i]).abs() < 1e-12));
    }

    /// The critical angle of 1.5 is asin(1/1.5) = 41.8 degrees: 45 degrees do not leave the glass.
    #[test]
    fn total_reflection() {
        assert_eq!(
            refract(unit([1.0, 0.0, -1.0]), [0.0, 0.0, 1.0], 1.5, 1.0),
            None
        );
    }
}
