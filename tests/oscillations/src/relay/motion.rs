//! Motion of a linear plant under a constant input, by the Taylor series of its exact solution.
//!
//! State: `z, z', ..., z^(n-1)` with `den(D) z = u` and `y = num(D) z` (controller form). All derivatives of z follow from
//! `z^(k+n) = -sum a_i z^(k+i)` for k >= 1, exactly. On a step h with `rho h <= 1` and `rho = 2 max |a_(n-i)|^(1/i)` (Fujiwara)
//! `|z^(k)| <= rho^k D` for all k, so the remainder is at most `e D/(p + 1)!`: below the rounding.

use crate::linear::dot;
use crate::plant::Plant;
use crate::scalar::Scalar;

/// Equations of motion in one arithmetic.
#[derive(Clone, Debug)]
pub struct Motion<S> {
    /// `a_0 ... a_(n-1)` of the monic denominator.
    denominator: Vec<S>,
    /// `b_0 ... b_(n-1)`, ascending.
    pub(crate) numerator: Vec<S>,
    /// Longest step in s.
    step: S,
    /// 1/k.
    reciprocals: Vec<S>,
}

/// Derivatives of z at the beginning of a step.
#[derive(Clone, Debug)]
pub struct Derivatives<S> {
    /// `z, z', z'', ...`
    z: Vec<S>,
    order: usize,
}

impl<S> Derivatives<S> {
    /// State of the plant at the beginning of the step.
    #[must_use]
    pub fn state(&self) -> &[S] {
        &self.z[..self.order]
    }
}

impl<S: Scalar> Motion<S> {
    /// The plant's equations; the plant has been checked.
    #[must_use]
    pub fn new(plant: &Plant) -> Self {
        let leading = S::from_f64(plant.den[0]);
        let ascending = |coefficients: &[f64]| -> Vec<S> {
            coefficients.iter().rev().map(|&value| S::from_f64(value) / leading).collect()
        };
        let mut denominator = ascending(&plant.den);
        denominator.pop();
        let mut numerator = ascending(&plant.num);
        numerator.resize(denominator.len(), S::ZERO);
        let rho = fujiwara(&denominator);
        // Without poles off the origin the series ends by itself: any step will do.
        let step = if rho > 0.0 { 1.0 / rho } else { plant.delay.max(1.0) };
        let reciprocals = (0..=S::ORDER).map(|k| S::ONE / S::from_count(k.max(1))).collect();
        Self { denominator, numerator, step: S::from_f64(step), reciprocals }
    }

    /// Order n of the plant.
    #[must_use]
    pub fn order(&self) -> usize {
        self.denominator.len()
    }

    /// Longest step in s.
    #[must_use]
    pub fn step(&self) -> S {
        self.step
    }

    /// Slowest rate other than zero that a pole can have, in 1/s; `None` where all poles are at the origin.
    #[must_use]
    pub fn slowest_rate(&self) -> Option<f64> {
        let first = self.denominator.iter().position(|&a| a != S::ZERO)?;
        // Poles of the reversed polynomial are the reciprocals.
        let mut reversed: Vec<S> = self.denominator[first + 1..].to_vec();
        reversed.push(S::ONE);
        reversed.iter_mut().for_each(|a| *a = *a / self.denominator[first]);
        reversed.reverse();
        Some(1.0 / fujiwara(&reversed))
    }

    /// Static gain `num(0)/den(0)`; `None` with a pole at the origin.
    #[must_use]
    pub fn static_gain(&self) -> Option<f64> {
        (self.denominator[0] != S::ZERO).then(|| (self.numerator[0] / self.denominator[0]).to_f64())
    }

    /// Derivatives of z under a constant input.
    #[must_use]
    pub fn derivatives(&self, state: &[S], input: S) -> Derivatives<S> {
        let n = self.order();
        let mut z = Vec::with_capacity(n + S::ORDER);
        z.extend_from_slice(state);
        for k in 0..S::ORDER {
            let forced = if k == 0 { input } else { S::ZERO };
            z.push(forced - dot(&self.denominator, &z[k..k + n]));
        }
        Derivatives { z, order: n }
    }

    /// State after t, at most one step.
    #[must_use]
    pub fn state(&self, derivatives: &Derivatives<S>, t: S) -> Vec<S> {
        let powers = self.powers(t);
        (0..self.order()).map(|i| dot(&derivatives.z[i..], &powers)).collect()
    }

    /// Output of a state.
    #[must_use]
    pub fn output(&self, state: &[S]) -> S {
        dot(&self.numerator, state)
    }

    /// Coefficients of the output as a polynomial in t/h on a step h.
    #[must_use]
    pub fn output_series(&self, derivatives: &Derivatives<S>, h: S) -> Vec<S> {
        let powers = self.powers(h);
        derivatives.z.windows(self.order()).zip(powers).map(|(z, power)| dot(&self.numerator, z) * power).collect()
    }

    /// Moves a state over any time under a constant input.
    pub fn advance(&self, state: &mut Vec<S>, input: S, mut duration: S) {
        while duration > S::ZERO {
            let h = if duration < self.step { duration } else { self.step };
            *state = self.state(&self.derivatives(state, input), h);
            duration = duration - h;
        }
    }

    /// `t^k/k!` for k up to the order.
    fn powers(&self, t: S) -> Vec<S> {
        let mut powers = Vec::with_capacity(S::ORDER + 1);
        powers.push(S::ONE);
        for k in 1..=S::ORDER {
            powers.push(powers[k - 1] * t * self.reciprocals[k]);
        }
        powers
    }
}

/// Bound `2 max |a_(n-i)|^(1/i)` of the roots of the monic polynomial with coefficients `a_0 ... a_(n-1)`.
fn fujiwara<S: Scalar>(ascending: &[S]) -> f64 {
    let root = |(i, a): (usize, &S)| a.to_f64().abs().powf(1.0 / (i + 1) as f64);
    2.0 * ascending.iter().rev().enumerate().map(root).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use f256::f256;

    use super::*;

    #[test]
    fn repeated_unstable_and_zero_poles_move_as_their_closed_forms_to_65_digits() {
        // (s + 2)/(s (s + 1)^2) at rest, input 1: y = 2 t - 3 + (3 + t) e^-t.
        let motion = Motion::<f256>::new(&Plant::new(&[1.0, 2.0], &[1.0, 2.0, 1.0, 0.0], 0.0));
        let t = f256::from(7.3);
        let mut state = vec![f256::ZERO; 3];
        motion.advance(&mut state, f256::ONE, t);
        let exact = t * f256::from(2.0) - f256::from(3.0) + (t + f256::from(3.0)) * (-t).exp();
        assert!((motion.output(&state) - exact).to_f64().abs() < 1e-65);
        // 1/(s - 1): y = e^t - 1.
        let motion = Motion::<f256>::new(&Plant::new(&[1.0], &[1.0, -1.0], 0.0));
        let mut state = vec![f256::ZERO];
        motion.advance(&mut state, f256::ONE, t);
        assert!(((motion.output(&state) + f256::ONE) / t.exp() - f256::ONE).to_f64().abs() < 1e-65);
        assert_eq!(motion.static_gain(), Some(-1.0));
    }

    #[test]
    fn the_slowest_rate_bounds_the_poles_from_below() {
        let plant = Plant::new(&[1.0], &crate::plant::multiply(&[1.0, 0.1, 0.0], &[1.0, 5.0]), 0.0);
        let rate = Motion::<f64>::new(&plant).slowest_rate().unwrap();
        assert!(rate <= 0.1 && rate > 0.02, "{rate}");
        assert_eq!(Motion::<f64>::new(&Plant::new(&[1.0], &[1.0, 0.0, 0.0], 0.0)).slowest_rate(), None);
    }
}
