//! The generalised Nyquist count: roots of a loop with a constant gain in the right half plane, dead time included.

use nalgebra::Complex;

use crate::plant::{TransferFunction, horner};

/// Largest change of the argument over a step, rad, and steps into which a step is halved at most.
const TURN: f64 = 0.4;
const HALVINGS: u32 = 40;
/// Steps in all; a dead time of very many periods needs more.
const STEPS: usize = 200_000;
/// Share of `N G` in `1 + N G` beyond which its argument no longer counts.
const SMALL: f64 = 0.02;

/// The number of roots of `denominator + gain numerator exp(-s delay)` to the right of `Re s = beyond`, in rad/s.
///
/// By the argument along that line: the function has no poles, and over `(s + c)^n` it tends to a constant where `Re s` or
/// `Im s` is large. Plants with poles in the right half plane or on the axis need no case of their own. `None` where the
/// line passes a root too near, or the gain does not vanish at infinity.
pub(super) fn roots_beyond(plant: &TransferFunction, gain: f64, beyond: f64) -> Option<usize> {
    let order = plant.denominator().len() - 1;
    if plant.numerator().len() > order {
        return None;
    }
    let poles = plant.poles().ok()?;
    let size = poles.iter().map(|pole| pole.norm()).fold(beyond, f64::max);
    let value = |omega: f64| {
        let s = Complex::new(beyond, omega);
        let late = horner(plant.numerator(), s) * (-s * plant.delay_s()).exp() * gain;
        (horner(plant.denominator(), s) + late) / (s + size).powu(order as u32)
    };
    let far = |omega: f64| {
        let s = Complex::new(beyond, omega);
        omega > 1e3 * size
            && (horner(plant.numerator(), s) * gain).norm() < SMALL * horner(plant.denominator(), s).norm()
    };
    let highest = (0..200).map(|doublings| size * 2.0_f64.powi(doublings)).find(|&omega| far(omega))?;
    // Geometric nodes; where the argument turns fast they are halved.
    let lowest = 1e-4 * beyond;
    let ratio = 1.1_f64;
    let mut open = vec![(0.0, lowest, 0)];
    let mut node = lowest;
    while node < highest {
        open.push((node, ratio * node, 0));
        node *= ratio;
    }
    let (mut turned, mut steps) = (0.0, 0);
    while let Some((from, to, depth)) = open.pop() {
        steps += 1;
        let middle = 0.5 * (from + to);
        let [start, halfway, end] = [from, middle, to].map(value);
        let (first, second) = ((halfway / start).arg(), (end / halfway).arg());
        if !(first.is_finite() && second.is_finite()) || depth > HALVINGS || steps > STEPS {
            return None;
        }
        if first.abs() + second.abs() <= TURN {
            turned += first + second;
        } else {
            open.extend([(from, middle, depth + 1), (middle, to, depth + 1)]);
        }
    }
    turned += (Complex::new(plant.denominator()[0], 0.0) / value(node)).arg();
    // The second half of the line turns by the same angle, and roots to its right make it turn clockwise.
    let count = -turned / core::f64::consts::PI;
    ((count - count.round()).abs() < 0.1 && count > -0.1).then(|| count.round() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(num: &[f64], den: &[f64], delay_s: f64, gain: f64) -> Option<usize> {
        let plant = TransferFunction::new(num, den).unwrap().with_delay(delay_s).unwrap();
        roots_beyond(&plant, gain, 1e-4)
    }

    #[test]
    fn roots_are_counted_as_factors_say() {
        assert_eq!(count(&[1.0], &[1.0, -1.0], 0.0, 0.5), Some(1));
        assert_eq!(count(&[1.0], &[1.0, -1.0], 0.0, 1.5), Some(0));
        // s^3 + 2 s^2 + 2 s + k + 1: stable below k = 3.
        assert_eq!(count(&[1.0], &[1.0, 2.0, 2.0, 1.0], 0.0, 2.9), Some(0));
        assert_eq!(count(&[1.0], &[1.0, 2.0, 2.0, 1.0], 0.0, 3.1), Some(2));
        assert_eq!(count(&[1.0], &[1.0, 0.0, 0.0], 0.0, 1.0), Some(0), "on the axis is not beyond it");
        assert_eq!(count(&[1.0], &[1.0, -0.2, 1.0], 0.0, 1.0), Some(2));
    }

    #[test]
    fn a_dead_time_adds_pairs() {
        // exp(-s)/(s + 1): the k-th pair comes at w + atan w = (2 k - 1) pi - w, gain sqrt(1 + w^2).
        for (gain, roots) in [(2.0, 0), (2.4, 2), (7.0, 2), (8.1, 4), (100.0, 32)] {
            assert_eq!(count(&[1.0], &[1.0, 1.0], 1.0, gain), Some(roots), "gain {gain}");
        }
        // No gain stabilises exp(-1.2 s)/(s - 1).
        assert!((1..60).all(|gain| count(&[1.0], &[1.0, -1.0], 1.2, 0.1 * f64::from(gain)) > Some(0)));
    }
}
