//! The matrix stacks of fixed function, computed as the driver computes them.
//!
//! Replay loads the program's own projection again, so a number that is off by one bit would change pixels. Each kind of operation is proven
//! first: as long as it is not, the driver is asked as well. A driver that computes another number is asked each time.

use super::super::consts as c;
use rustc_hash::FxHashMap;

/// Equal answers after which a kind of operation counts as proven.
const PROOFS: u8 = 32;

/// Stack of a matrix mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    Modelview,
    Projection,
    Texture,
}

/// An operation on the matrix at the top of a stack. Matrices are column-major.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Identity,
    Load([f32; 16]),
    Multiply([f32; 16]),
    Translate([f32; 3]),
    Scale([f32; 3]),
    /// Degrees, and the axis.
    Rotate([f32; 4]),
    /// Left, right, bottom, top, near, far.
    Frustum([f32; 6]),
    /// The same.
    Ortho([f32; 6]),
}

impl Operation {
    fn bit(&self) -> u8 {
        match self {
            Operation::Identity => 1,
            Operation::Load(_) => 2,
            Operation::Multiply(_) => 4,
            Operation::Translate(_) => 8,
            Operation::Scale(_) => 16,
            Operation::Rotate(_) => 32,
            Operation::Frustum(_) => 64,
            Operation::Ortho(_) => 128,
        }
    }
}

/// The matrix at the top of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Top {
    pub(super) numbers: [f32; 16],
    /// The kinds of operations that have computed it, and have not been proven.
    unproven: u8,
    /// All that have computed it since the driver was asked.
    kinds: u8,
}

impl Top {
    pub(super) fn is_proven(&self) -> bool {
        self.unproven == 0
    }
}

#[derive(Clone, Debug)]
struct Levels {
    /// From the lowest known one to the top; at least one.
    known: Vec<Option<Top>>,
    /// Levels below those; none where that is not known.
    below: Option<u32>,
}

impl Default for Levels {
    fn default() -> Self {
        Levels {
            known: vec![None],
            below: None,
        }
    }
}

/// All stacks, and which one operations go to.
#[derive(Debug, Default)]
pub(super) struct Matrices {
    mode: Option<u32>,
    modelview: Levels,
    projection: Levels,
    texture: FxHashMap<u32, Levels>,
    proofs: [u8; 8],
    /// Kinds of operations that this driver computes in another way.
    different: u8,
}

/// The stack whose matrix glGet has under a name.
pub(super) fn stack_of(name: u32) -> Option<Mode> {
    match name {
        c::MODELVIEW_MATRIX => Some(Mode::Modelview),
        c::PROJECTION_MATRIX => Some(Mode::Projection),
        c::TEXTURE_MATRIX => Some(Mode::Texture),
        _ => None,
    }
}

/// The stack whose depth glGet has under a name.
pub(super) fn stack_of_depth(name: u32) -> Option<Mode> {
    match name {
        c::MODELVIEW_STACK_DEPTH => Some(Mode::Modelview),
        c::PROJECTION_STACK_DEPTH => Some(Mode::Projection),
        c::TEXTURE_STACK_DEPTH => Some(Mode::Texture),
        _ => None,
    }
}

impl Mode {
    /// The names of the limit and of the present depth of its stack.
    pub(super) fn depths(self) -> (u32, u32) {
        match self {
            Mode::Modelview => (c::MAX_MODELVIEW_STACK_DEPTH, c::MODELVIEW_STACK_DEPTH),
            Mode::Projection => (c::MAX_PROJECTION_STACK_DEPTH, c::PROJECTION_STACK_DEPTH),
            Mode::Texture => (c::MAX_TEXTURE_STACK_DEPTH, c::TEXTURE_STACK_DEPTH),
        }
    }
}

impl Matrices {
    pub(super) fn mode(&self) -> Option<u32> {
        self.mode
    }

    pub(super) fn mode_is(&mut self, mode: u32) {
        self.mode = Some(mode);
    }

    pub(super) fn mode_is_unknown(&mut self) {
        self.mode = None;
    }

    /// The stack that operations go to; None where it is not known or another one.
    pub(super) fn current(&self) -> Option<Mode> {
        match self.mode? {
            c::MODELVIEW => Some(Mode::Modelview),
            c::PROJECTION => Some(Mode::Projection),
            c::TEXTURE => Some(Mode::Texture),
            _ => None,
        }
    }

    fn levels(&mut self, mode: Mode, unit: Option<u32>) -> Option<&mut Levels> {
        match mode {
            Mode::Modelview => Some(&mut self.modelview),
            Mode::Projection => Some(&mut self.projection),
            Mode::Texture => Some(self.texture.entry(unit?).or_default()),
        }
    }

    pub(super) fn top(&mut self, mode: Mode, unit: Option<u32>) -> Option<Top> {
        let levels = self.levels(mode, unit)?;
        levels.known.last().copied().flatten()
    }

    /// The driver has answered with the matrix at the top of a stack.
    pub(super) fn is(&mut self, mode: Mode, unit: Option<u32>, numbers: &[f32; 16]) {
        if let Some(top) = self.top(mode, unit) {
            let equal = top.numbers.map(f32::to_bits) == numbers.map(f32::to_bits);
            for (kind, proofs) in self.proofs.iter_mut().enumerate() {
                let bit = 1 << kind;
                match equal {
                    true if top.kinds & bit != 0 => *proofs = proofs.saturating_add(1).min(PROOFS),
                    false if top.unproven & bit != 0 => self.different |= bit,
                    _ => {}
                }
            }
        }
        let answered = Top {
            numbers: *numbers,
            unproven: 0,
            kinds: 0,
        };
        if let Some(top) = self.levels(mode, unit).and_then(|l| l.known.last_mut()) {
            *top = Some(answered);
        }
    }

    pub(super) fn depth(&mut self, mode: Mode, unit: Option<u32>) -> Option<u32> {
        let levels = self.levels(mode, unit)?;
        Some(levels.below? + levels.known.len() as u32)
    }

    pub(super) fn depth_is(&mut self, mode: Mode, unit: Option<u32>, depth: u32) {
        if let Some(levels) = self.levels(mode, unit) {
            levels.below = Some(depth.saturating_sub(levels.known.len() as u32));
        }
    }

    /// glPushMatrix, on a stack that is not full.
    pub(super) fn push(&mut self, mode: Mode, unit: Option<u32>) {
        let top = self.top(mode, unit);
        if let Some(levels) = self.levels(mode, unit) {
            levels.known.push(top);
        }
    }

    /// glPopMatrix.
    pub(super) fn pop(&mut self, mode: Mode, unit: Option<u32>) {
        let Some(levels) = self.levels(mode, unit) else {
            return self.forget_stacks();
        };
        if levels.known.len() > 1 {
            levels.known.pop();
        } else if levels.below != Some(0) {
            *levels = Levels {
                known: vec![None],
                below: levels.below.map(|below| below - 1),
            };
        }
    }

    /// All stacks may have changed.
    pub(super) fn forget_stacks(&mut self) {
        self.modelview = Levels::default();
        self.projection = Levels::default();
        self.texture.clear();
    }

    /// An operation on the matrix at the top of a stack.
    pub(super) fn operate(&mut self, mode: Mode, unit: Option<u32>, operation: &Operation) {
        let bit = operation.bit();
        let proven = self
            .proofs
            .get(bit.trailing_zeros() as usize)
            .is_some_and(|&proofs| proofs >= PROOFS);
        let different = self.different & bit != 0;
        let Some(top) = self
            .levels(mode, unit)
            .and_then(|levels| levels.known.last_mut())
        else {
            return self.texture.clear();
        };
        let own = if proven && !different { 0 } else { bit };
        let after = |numbers, before: u8, kinds: u8| {
            Some(Top {
                numbers,
                unproven: before | own,
                kinds: kinds | bit,
            })
        };
        *top = match (operation, *top) {
            _ if different => None,
            (Operation::Identity, _) => after(glam::Mat4::IDENTITY.to_cols_array(), 0, 0),
            (Operation::Load(numbers), _) => after(*numbers, 0, 0),
            (_, None) => None,
            (operation, Some(now)) => {
                after(changed(&now.numbers, operation), now.unproven, now.kinds)
            }
        };
    }
}

/// The product of two matrices, summed in single precision from the left.
fn product(a: &[f32; 16], b: &[f32; 16]) -> [f32; 16] {
    std::array::from_fn(|at| {
        let (row, column) = (at % 4, at / 4 * 4);
        let term = |k: usize| a[k * 4 + row] * b[column + k];
        term(0) + term(1) + term(2) + term(3)
    })
}

/// A matrix after an operation, by the order of sums that the drivers of Mesa have.
fn changed(m: &[f32; 16], operation: &Operation) -> [f32; 16] {
    match *operation {
        Operation::Identity => glam::Mat4::IDENTITY.to_cols_array(),
        Operation::Load(numbers) => numbers,
        Operation::Multiply(ref by) => product(m, by),
        Operation::Translate([x, y, z]) => {
            let mut moved = *m;
            for row in 0..4 {
                moved[12 + row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row];
            }
            moved
        }
        Operation::Scale(by) => std::array::from_fn(|at| match by.get(at / 4) {
            Some(factor) => m[at] * factor,
            None => m[at],
        }),
        Operation::Rotate([degrees, x, y, z]) => match rotation(degrees, [x, y, z]) {
            Some(turn) => product(m, &turn),
            None => *m,
        },
        Operation::Frustum([left, right, bottom, top, near, far]) => {
            let mut p = [0.0; 16];
            p[0] = (2.0 * near) / (right - left);
            p[5] = (2.0 * near) / (top - bottom);
            p[8] = (right + left) / (right - left);
            p[9] = (top + bottom) / (top - bottom);
            p[10] = -(far + near) / (far - near);
            p[11] = -1.0;
            p[14] = -(2.0 * far * near) / (far - near);
            product(m, &p)
        }
        Operation::Ortho([left, right, bottom, top, near, far]) => {
            let mut p = [0.0; 16];
            p[0] = 2.0 / (right - left);
            p[5] = 2.0 / (top - bottom);
            p[10] = -2.0 / (far - near);
            p[12] = -(right + left) / (right - left);
            p[13] = -(top + bottom) / (top - bottom);
            p[14] = -(far + near) / (far - near);
            p[15] = 1.0;
            product(m, &p)
        }
    }
}

/// The matrix of a rotation (OpenGL 4.6 compatibility, equation 12.3); None about an axis without length. About an axis of the coordinate
/// system, only sine and cosine count.
fn rotation(degrees: f32, axis: [f32; 3]) -> Option<[f32; 16]> {
    let angle = (f64::from(degrees) * std::f64::consts::PI / 180.0) as f32;
    let (sine, cosine) = (angle.sin(), angle.cos());
    let mut m = glam::Mat4::IDENTITY.to_cols_array();
    let mut plane = |first: usize, second: usize, along: f32| {
        let sine = if along < 0.0 { -sine } else { sine };
        m[first * 4 + first] = cosine;
        m[second * 4 + second] = cosine;
        m[first * 4 + second] = sine;
        m[second * 4 + first] = -sine;
    };
    let [x, y, z] = axis;
    match [x != 0.0, y != 0.0, z != 0.0] {
        [true, false, false] => plane(1, 2, x),
        [false, true, false] => plane(2, 0, y),
        [false, false, true] => plane(0, 1, z),
        _ => {
            let length = (x * x + y * y + z * z).sqrt();
            if length <= 1e-4 {
                return None;
            }
            let [x, y, z] = axis.map(|part| part / length);
            let rest = 1.0 - cosine;
            let (xs, ys, zs) = (x * sine, y * sine, z * sine);
            m[0] = rest * (x * x) + cosine;
            m[1] = rest * (x * y) + zs;
            m[2] = rest * (z * x) - ys;
            m[4] = rest * (x * y) - zs;
            m[5] = rest * (y * y) + cosine;
            m[6] = rest * (y * z) + xs;
            m[8] = rest * (z * x) + ys;
            m[9] = rest * (y * z) - xs;
            m[10] = rest * (z * z) + cosine;
        }
    }
    Some(m)
}
