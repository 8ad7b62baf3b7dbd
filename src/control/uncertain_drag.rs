//! Slopes of a drag whose coefficients vary together.

use crate::numeric::{Interval, Real};

/// Drag whose coefficients vary together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncertainDrag {
    /// Linear, quadratic and cubic drag.
    pub coefficients: [f64; 3],
    /// Their covariance, in the same order.
    pub covariance: [[f64; 3]; 3],
}

/// Parts of the speeds, over each of which the slopes are enclosed: over one, `u^2` is too large by some thousandth of its terms.
const PARTS: u32 = 1024;

impl UncertainDrag {
    /// Every slope within twice its standard deviation, at speeds up to `top_speed` either way: `u^2 = J C J^T` with
    /// `J = (1, 2 |v|, 3 v^2)` (JCGM 100:2008, eq. 13; twice: 6.2).
    ///
    /// ```
    /// use selfosc::control::UncertainDrag;
    /// // A force of 1 to 0.04 at the speed 2, of whichever law.
    /// let drag = UncertainDrag { coefficients: [0.3, 0.1, 0.0], covariance: [[0.01, -0.005, 0.0], [-0.005, 0.0026, 0.0], [0.0; 3]] };
    /// let slopes = drag.slopes(1.0);
    /// assert!(slopes.contains(0.1) && slopes.contains(0.54) && !slopes.contains(0.6)); // the box reaches 0.9
    /// ```
    #[must_use]
    pub fn slopes(&self, top_speed: f64) -> Interval {
        let end = |k: u32| top_speed * (f64::from(k) / f64::from(PARTS));
        let over = |k: u32| self.slopes_over(Interval::new(end(k), end(k + 1)).unwrap_or(Interval::ENTIRE));
        (1..PARTS).fold(over(0), |slopes, k| slopes.hull(over(k)))
    }

    fn slopes_over(&self, speeds: Interval) -> Interval {
        let row = |i: usize| slope(self.covariance[i].map(Interval::point), speeds);
        let variance = slope([row(0), row(1), row(2)], speeds);
        let deviation = Interval::point(variance.upper().max(0.0)).sqrt();
        let reach = (Interval::from_f64(2.0) * deviation).upper();
        slope(self.coefficients.map(Interval::point), speeds) + Interval::symmetric(reach)
    }
}

/// `(1, 2 v, 3 v^2)` times three coefficients.
pub(super) fn slope([linear, quadratic, cubic]: [Interval; 3], speeds: Interval) -> Interval {
    linear + Interval::from_f64(2.0) * quadratic * speeds + Interval::from_f64(3.0) * cubic * speeds.square()
}
