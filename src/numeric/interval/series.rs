//! Power series of entire functions, with a proved bound of truncation and rounding.

use super::Interval;

/// `c_0 + c_1 x + c_2 x^2 + ...` with reciprocals of factorials as coefficients: all positive for `abs(x) <= 0.36`, or alternating
/// for `0 <= x <= 1.44`.
///
/// The first two, which decide how wide the sum is, are intervals. The rest, the tail, is summed in floating point.
pub(super) struct Series<const N: usize> {
    pub(super) head: [Interval; 2],
    tail: [f64; N],
}

/// The tail's error over its first term. In the stated ranges each term is below a tenth of its predecessor: rounding the
/// coefficients and Horner's rule cost less than `2^-50`, and truncation after at least seven terms less than `2^-47.5`.
const TAIL_ERROR: f64 = 1.0 / 140_737_488_355_328.0; // 2^-47

impl<const N: usize> Series<N> {
    /// With `sign/n!, sign^2/(n + step)!, sign^3/(n + 2 step)!, ...`; the last factorial is a double if at most 22!.
    pub(super) const fn of_factorials(n: usize, step: usize, sign: f64) -> Self {
        let mut series = Self { head: [Interval::ZERO; 2], tail: [0.0; N] };
        let (mut factorial, mut next, mut signed) = (1.0, 1, sign);
        let mut i = 0;
        while i < N + 2 {
            while next <= n + i * step {
                factorial *= next as f64;
                next += 1;
            }
            if i < 2 {
                let Interval { lo, hi } = Interval::reciprocal(factorial);
                series.head[i] = if signed < 0.0 { Interval { lo: -hi, hi: -lo } } else { Interval { lo, hi } };
            } else {
                series.tail[i - 2] = signed / factorial;
            }
            signed *= sign;
            i += 1;
        }
        series
    }

    /// The sum for every element of `x`.
    #[inline]
    pub(super) fn at(&self, x: Interval) -> Interval {
        let [first, second] = self.head;
        first + x * (second + x * self.tail_at(x))
    }

    /// The tail's sum over `x^2`.
    #[inline]
    pub(super) fn tail_at(&self, x: Interval) -> Interval {
        let sum = self.tail.iter().rev().fold(0.0, |sum, &coefficient| coefficient + x.hi * sum);
        // By the mean value theorem: the slope is below the first coefficient.
        let radius = self.tail[0].abs() * (TAIL_ERROR + x.width());
        Interval::point(sum) + Interval::symmetric(radius)
    }
}
