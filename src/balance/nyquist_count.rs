//! The generalised Nyquist count: roots of a loop with a constant gain in the right half plane, dead time included.

use nalgebra::Complex;

use super::nyquist::SampledRange;
use crate::plant::{TransferFunction, horner};

/// Largest change of the argument over a step, rad.
const TURN: f64 = 0.4;
/// Share of `N G` in `1 + N G` beyond which its argument no longer counts, and below which a dead time turns it by less than a step.
const SMALL: f64 = 0.02;
const SLIGHT: f64 = 0.2;

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
    let size = plant.poles().ok()?.iter().map(|pole| pole.norm()).fold(beyond, f64::max);
    // The frequency, the function and the share of its second term.
    let value = |omega: f64| {
        let s = Complex::new(beyond, omega);
        let [early, late] = [plant.denominator(), plant.numerator()].map(|one| horner(one, s));
        let late = late * (-s * plant.delay_s()).exp() * gain;
        (omega, (early + late) / (s + size).powu(order as u32), late.norm() / early.norm())
    };
    let highest = (10..200).map(|doublings| size * 2.0_f64.powi(doublings)).find(|&omega| value(omega).2 < SMALL)?;
    // Points a whole turn of the dead time apart do not show it.
    let close = |a: &(f64, Complex<f64>, f64), b: &(f64, Complex<f64>, f64)| {
        (b.1 / a.1).arg().abs() <= TURN && ((b.0 - a.0) * plant.delay_s() <= 1.0 || a.2.max(b.2) < SLIGHT)
    };
    let line = SampledRange { quantity: "frequency", range: 1e-4 * beyond..=highest };
    let points = line.sample(|omega| Some(value(omega)), close).ok()?;
    let ends = [value(0.0).1, Complex::new(plant.denominator()[0], 0.0)];
    let values = points.iter().filter_map(|(_, value)| Some(value.as_ref()?.1)).chain([ends[1]]);
    let (turned, _) = values.fold((0.0, ends[0]), |(turned, last), value| {
        let turn = (value / last).arg();
        (if turn.abs() <= 2.0 * TURN { turned + turn } else { f64::NAN }, value)
    });
    // The second half of the line turns by the same angle, and roots to its right make it turn clockwise.
    let count = -turned / core::f64::consts::PI;
    ((count - count.round()).abs() < 0.1 && count > -0.1).then(|| count.round() as usize)
}
