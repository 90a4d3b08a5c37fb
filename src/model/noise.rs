//! Numbers that look random and are the same every time.

/// Of three whole numbers, evenly from 0 to 1.
pub(super) fn hash([x, y, z]: [i32; 3]) -> f32 {
    let mut bits = (x as u32).wrapping_mul(0x8da6_b343)
        ^ (y as u32).wrapping_mul(0xd816_3841)
        ^ (z as u32).wrapping_mul(0xcb1a_b31f);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    bits ^= bits >> 15;
    (bits >> 8) as f32 / (1 << 24) as f32
}

/// Smooth hills, −1 to 1, one unit apart.
fn hills(at: [f32; 3]) -> f32 {
    let whole = at.map(|v| v.floor() as i32);
    let part = [0, 1, 2].map(|i| at[i] - whole[i] as f32);
    let [u, v, w] = part.map(|t| t * t * (3.0 - 2.0 * t));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let corner = |dx, dy, dz| hash([whole[0] + dx, whole[1] + dy, whole[2] + dz]);
    let row = |dy, dz| mix(corner(0, dy, dz), corner(1, dy, dz), u);
    let layer = |dz| mix(row(0, dz), row(1, dz), v);
    2.0 * mix(layer(0), layer(1), w) - 1.0
}

/// Hills with smaller ones on them, so many sizes, each half as wide and as high as the one before.
pub(super) fn bumps(at: [f32; 3], sizes: u32) -> f32 {
    let mut sum = 0.0;
    let mut scale = 1.0;
    for size in 0..sizes {
        // Not all on the same lattice.
        let shift = size as f32 * 17.3;
        sum += hills(at.map(|v| v * scale + shift)) / scale;
        scale *= 2.0;
    }
    sum
}
