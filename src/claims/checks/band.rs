//! A held input: the forms that the code chooses from are all the difference of two ramps.

use super::algebra::{exactly, number};
use super::{ClaimPart, Distortion, Verdict};
use crate::describing::{ClosedForm, DescribingFunction, ramp_by_angle};
use crate::nonlinearity::{Kernel, Sinusoid};
use crate::numeric::Real;
use crate::proof::polynomial::Rational;

const COVERED: ClaimPart = ClaimPart::named("as-coded");

/// Of one kernel.
fn of(kernel: Kernel<Rational>, sweep: &Sinusoid<Rational>) -> Option<DescribingFunction<Rational>> {
    kernel.describing_function(sweep).ok()
}

fn band([origin, lower, upper]: [Rational; 3], sweep: &Sinusoid<Rational>) -> Option<DescribingFunction<Rational>> {
    of(Kernel::Band { origin, lower, upper, slope: number(1.0) }, sweep)
}

/// Places of both ends, over the amplitude, by the form that the code takes: near the maximum, near the minimum, or wide. In each
/// the ends are beyond the sweep, in the middle half of it, or between.
const ENDS: [[f64; 2]; 18] = [
    [0.6, 0.9],
    [0.6, 1.5],
    [1.2, 1.5],
    [-0.9, -0.6],
    [-1.5, -0.6],
    [-1.5, -1.2],
    [-0.75, 0.75],
    [-0.25, 0.9],
    [-0.9, 0.25],
    [-1.5, 0.25],
    [-0.25, 1.5],
    [0.25, 1.5],
    [-1.5, -0.25],
    [-1.5, 0.75],
    [-0.75, 1.5],
    [-1.5, 1.5],
    [-0.45, 0.8],
    [-0.8, 0.45],
];

/// The forms but that from the middle, through the code's own ramps.
pub fn by_ramps(distortion: Distortion) -> Verdict {
    let points = ENDS.map(|[lower, upper]| [0.3 + 2.0 * lower, 0.3 + 2.0 * upper, 0.3, 2.0, 0.7]);
    exactly(COVERED, distortion, &points, |[lower, upper, bias, amplitude, origin]: [Rational; 5], factor: Rational| {
        let sweep = Sinusoid::new(bias, amplitude).ok()?;
        let found = band([origin, lower, upper], &sweep)?;
        let one = number(1.0);
        let ramps = of(Kernel::constant(lower - origin), &sweep)?
            + of(Kernel::ramp_above(lower, one), &sweep)?
            + of(Kernel::ramp_above(upper, -one), &sweep)?;
        Some([found.f0 - factor * ramps.f0, found.p - factor * ramps.p, found.q])
    })
}

/// Where an end lies on a sweep of amplitude 1/2: above its minimum by the square of a sine, or beyond a turning point.
#[derive(Clone, Copy)]
enum BandEnd {
    At { sine: Rational, cosine: Rational },
    Below { by: Rational },
    Above { by: Rational },
}

impl BandEnd {
    fn at(sine: Rational) -> Self {
        Self::At { sine, cosine: (number(1.0) - sine.square()).sqrt() }
    }
    /// Sine and cosine of half the angle from the minimum.
    fn half_angle(self) -> [Rational; 2] {
        match self {
            Self::At { sine, cosine } => [sine, cosine],
            Self::Below { .. } => [number(0.0), number(1.0)],
            Self::Above { .. } => [number(1.0), number(0.0)],
        }
    }
    /// In input units.
    fn place(self, bias: Rational) -> Rational {
        let minimum = bias - number(0.5);
        match self {
            Self::At { sine, .. } => minimum + sine.square(),
            Self::Below { by } => minimum - by,
            Self::Above { by } => bias + number(0.5) + by,
        }
    }
}

/// The form from the middle. With `s = sin(psi)` an end lies at `s^2` above the minimum, and its angle from the maximum is
/// `pi - 2 psi`. The code forms the tangents of the difference of both psi and of their sum less a quarter turn; by these two
/// angles the ramps are compared with it.
fn from_the_middle(bias: Rational, [lower, upper]: [BandEnd; 2], factor: Rational) -> Option<[Rational; 5]> {
    let sweep = Sinusoid::new(bias, number(0.5)).ok()?;
    let ([low, low_cosine], [high, high_cosine]) = (lower.half_angle(), upper.half_angle());
    let cosines = low * low_cosine + high * high_cosine;
    let (rise, middle) = (high.square() - low.square(), high.square() + low.square() - number(1.0));
    let (of_difference, of_sum) = (rise / cosines, middle / cosines);
    let tangents = [
        of_difference * (low_cosine * high_cosine + low * high) - (high * low_cosine - low * high_cosine),
        of_sum * (low * high_cosine + high * low_cosine) + (low_cosine * high_cosine - low * high),
    ];
    let (difference, sum) = (of_difference.atan(), of_sum.atan());
    let from_middle = number(0.5) * Rational::pi() - sum;
    let (at_lower, at_upper) = (lower.place(bias), upper.place(bias));
    let origin = number(0.25);
    let found = band([origin, at_lower, at_upper], &sweep)?;
    let ramps = of(Kernel::constant(at_lower - origin), &sweep)?
        + ramp_by_angle(at_lower, from_middle + difference, &sweep)
        + ramp_by_angle(at_upper, from_middle - difference, &sweep) * number(-1.0);
    Some([found.f0 - factor * ramps.f0, found.p - factor * ramps.p, found.q, tangents[0], tangents[1]])
}

/// The form from the middle where both ends are on the sweep, and where an end is beyond it.
pub fn by_tangents(distortion: Distortion) -> Verdict {
    let on_sweep = |[first, second, bias]: [Rational; 3], factor: Rational| {
        from_the_middle(bias, [BandEnd::at(first), BandEnd::at(second)], factor)
    };
    let below = |[by, second, bias]: [Rational; 3], factor: Rational| {
        from_the_middle(bias, [BandEnd::Below { by }, BandEnd::at(second)], factor)
    };
    let above = |[first, by, bias]: [Rational; 3], factor: Rational| {
        from_the_middle(bias, [BandEnd::at(first), BandEnd::Above { by }], factor)
    };
    exactly(COVERED, distortion, &[[0.6, 0.8, 0.3]], on_sweep)
        .and(|| exactly(COVERED, distortion, &[[0.1, 0.6, 0.3]], below))
        .and(|| exactly(COVERED, distortion, &[[0.8, 0.1, 0.3]], above))
}

/// Every form, for all ends.
pub(super) fn as_coded(distortion: Distortion) -> Verdict {
    by_ramps(distortion).and(|| by_tangents(distortion))
}
