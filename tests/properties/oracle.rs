//! Enclosures of exact values by arbitrary-precision arithmetic with directed rounding.

use std::fmt;

use dashu_float::FBig;
use dashu_float::round::{Round, mode};

/// Working precision in bits: 48 decimal digits.
const PRECISION: usize = 160;

pub(crate) type Down = FBig<mode::Down>;
pub(crate) type Up = FBig<mode::Up>;

/// The exact value lies between the two.
#[derive(Clone)]
pub(crate) struct Bracket {
    pub(crate) below: Down,
    pub(crate) above: Up,
}

/// The double `x` (finite), exactly.
pub(crate) fn at<R: Round>(x: f64) -> FBig<R> {
    FBig::try_from(x).expect("a finite number").with_precision(PRECISION).value()
}

impl Bracket {
    /// Whether the exact value surely lies between the doubles `lo` and `hi`, which may be infinite.
    pub(crate) fn lies_within(&self, (lo, hi): (f64, f64)) -> bool {
        (lo == f64::NEG_INFINITY || lo.is_finite() && at::<mode::Down>(lo) <= self.below)
            && (hi == f64::INFINITY || hi.is_finite() && at::<mode::Up>(hi) >= self.above)
    }
}

impl fmt::Debug for Bracket {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} .. {}", self.below.to_decimal().value(), self.above.to_decimal().value())
    }
}

/// The same expression with both roundings, each argument a double: exact while every operation but one is exact or the
/// roundings add up in one direction. Needs `at`, `Bracket`, `Down` and `Up` in scope.
macro_rules! bracket {
    ($($x:ident),+: $value:expr) => {
        Bracket { below: { $(let $x: Down = at($x);)+ $value }, above: { $(let $x: Up = at($x);)+ $value } }
    };
}
pub(crate) use bracket;
