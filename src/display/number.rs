//! Numbers of a panel description: exact where the text allows it.
#![forbid(unsafe_code)]

/// Largest denominator that is kept exactly. Nine decimals are more than any calibration gives.
const MODEST: i64 = 1_000_000_000;

/// A number as the user wrote it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// In lowest terms.
    Exact {
        /// Carries the sign.
        numerator: i64,
        /// At least 1.
        denominator: i64,
    },
    /// Everything that has no modest denominator.
    Float(f64),
}

impl Number {
    /// A whole number.
    pub const fn whole(value: i64) -> Self {
        Self::Exact {
            numerator: value,
            denominator: 1,
        }
    }

    /// `numerator / denominator` in lowest terms; None when the denominator is 0 or too large.
    pub fn ratio(numerator: i64, denominator: i64) -> Option<Self> {
        let divisor = gcd(numerator.checked_abs()?, denominator.checked_abs()?);
        let (n, d) = (
            numerator.checked_div(divisor)?,
            denominator.checked_div(divisor)?,
        );
        let (n, d) = if d < 0 {
            (n.checked_neg()?, d.checked_neg()?)
        } else {
            (n, d)
        };
        (1..=MODEST).contains(&d).then_some(Self::Exact {
            numerator: n,
            denominator: d,
        })
    }

    /// Reads `a/b` of whole numbers or a decimal number. None when it is neither, or not finite.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        if let Some((a, b)) = text.split_once('/') {
            let (a, b) = (a.trim().parse().ok()?, b.trim().parse().ok()?);
            if b == 0 {
                return None;
            }
            return Some(Self::ratio(a, b).unwrap_or(Self::Float(a as f64 / b as f64)));
        }
        let float: f64 = text.parse().ok().filter(|f: &f64| f.is_finite())?;
        Some(decimal(text).unwrap_or(Self::Float(float)))
    }

    /// The decimal number that is written shortest among those that round to `value`: 5.333 is 5333/1000, as written.
    pub fn from_f64(value: f64) -> Option<Self> {
        Self::parse(&format!("{value}"))
    }

    /// Numerator and denominator. A float is rounded to a multiple of 2^-60, far below what anyone can measure; its size must be
    /// at most 2^40.
    fn fraction(self) -> (i128, i128) {
        match self {
            Self::Exact {
                numerator,
                denominator,
            } => (numerator.into(), denominator.into()),
            Self::Float(value) => {
                let numerator = (value * (1u64 << 60) as f64).round() as i128;
                let shift = numerator.trailing_zeros().min(60);
                (numerator >> shift, 1 << (60 - shift))
            }
        }
    }

    /// The decimal number that it is, in the shortest digits; none for another fraction.
    pub fn decimal(self) -> Option<f64> {
        let value = self.to_f64();
        (Self::from_f64(value) == Some(self)).then_some(value)
    }

    /// The nearest f64.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Exact {
                numerator,
                denominator,
            } => numerator as f64 / denominator as f64,
            Self::Float(value) => value,
        }
    }
}

/// Plain decimals such as `-12.75`, without exponent.
fn decimal(text: &str) -> Option<Number> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let fraction = fraction.trim_end_matches('0');
    let denominator = 10i64.checked_pow(fraction.len().try_into().ok()?)?;
    // The digits together keep the sign of "-0.5", which the whole part alone would lose.
    Number::ratio(format!("{whole}{fraction}").parse().ok()?, denominator)
}

/// Numbers as multiples of one unit, and more of them in the same unit: how many of it are 1, and how many each number is. Denominators without a common one of a
/// modest size come from fractions nobody has measured; then all numbers are rounded to a multiple of 2^-60.
pub(super) fn in_units<const N: usize>(
    numbers: [Number; N],
    more: &[Number],
) -> (i128, [i128; N], Vec<i128>) {
    let all = numbers.iter().chain(more).copied().map(Number::fraction);
    let common = common_denominator(&all.collect::<Vec<_>>());
    let unit = common.unwrap_or(1 << 60);
    let whole = |number: Number| {
        let (n, d) = match common {
            Some(_) => number.fraction(),
            None => Number::Float(number.to_f64()).fraction(),
        };
        n * (unit / d)
    };
    (
        unit,
        numbers.map(whole),
        more.iter().copied().map(whole).collect(),
    )
}

/// Whether [`in_units`] rounds nothing.
pub(super) fn are_exact<const N: usize>(numbers: [Number; N]) -> bool {
    numbers.iter().all(|n| matches!(n, Number::Exact { .. }))
        && common_denominator(&numbers.map(Number::fraction)).is_some()
}

/// The least unit that all denominators divide; None when it has more than 2^73 parts.
fn common_denominator(fractions: &[(i128, i128)]) -> Option<i128> {
    let unit = fractions
        .iter()
        .try_fold(1i128, |unit, &(_, denominator)| {
            unit.checked_mul(denominator / gcd(unit, denominator))
        })?;
    (unit <= 1 << 73).then_some(unit)
}

/// Greatest common divisor; of 0 and 0 it is 0.
fn gcd<T: Copy + PartialEq + Default + std::ops::Rem<Output = T>>(mut a: T, mut b: T) -> T {
    while b != T::default() {
        (a, b) = (b, a % b);
    }
    a
}
