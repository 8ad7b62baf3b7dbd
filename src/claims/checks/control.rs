//! The basis of controllers from an identified axis.

use super::algebra::{exactly, number};
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::control::{
    Body, Margins, OpenLoop, RelayTest, Structure, Tuning, UltimatePoint, critical_point, double_pole,
};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::Real;
use crate::orbit::orbits;
use crate::plant::{DragAxis, TransferFunction};
use crate::proof::polynomial::Rational;

/// A design for any axis whose drag it can bear.
fn design(draw: &mut Draw, delay_s: f64) -> Option<Tuning<f64>> {
    let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][draw.index("structure", 3)];
    let (alpha, bandwidth) = (draw.log_uniform("alpha", 1e-3, 1e3), draw.log_uniform("bandwidth_rad_s", 1e-2, 1e1));
    let w = bandwidth / structure.bandwidth_ratio();
    let drag = draw.uniform("drag_share", 0.0, 1.5) * alpha * w;
    let axis = DragAxis::linear(alpha, drag).ok()?.with_delay_s(draw.note("delay_s", delay_s / w)).ok()?;
    Tuning::new(&axis, structure, bandwidth).ok()
}

claim! {
    POLE_PLACEMENT = "pole-placement" Identity
    "the gains of a design give the closed loop the double pole and the slow pole that the bandwidth asks for";
    corrected poles(0.0, Tuning::double_pole_rad_s);
    // The bandwidth taken for the pole.
    false poles(0.0, Tuning::bandwidth_rad_s);
    needs "no-delay" poles(0.05, Tuning::double_pole_rad_s);
    proof prove_pole_placement;
}

/// The characteristic function `D(s) + N(s) exp(-s delay)` and its slope vanish at the double pole, it alone at the
/// slow pole.
fn poles(draw: &mut Draw, delay: f64, double_pole: fn(&Tuning<f64>) -> f64) -> Option<Case> {
    let tuning = design(draw, delay)?;
    let (axis, gains, w) = (tuning.axis(), tuning.gains(), double_pole(&tuning));
    let (alpha, drag, f) = (axis.alpha(), axis.linear_drag(), gains.filter_s());
    let (kp, ki, kd) = (gains.proportional(), gains.integral(), gains.derivative());
    // Over s^2: the size of the terms does not vanish with the slow pole.
    let terms = |s: f64| {
        let late = libm::exp(-s * axis.delay_s());
        let axis_terms = [alpha * f * s * s, (alpha + drag * f) * s, drag];
        let fed_back = [kd + kp * f, (kp + ki * f) / s, ki / (s * s)];
        (axis_terms.iter().sum::<f64>() + late * fed_back.iter().sum::<f64>(), fed_back[1].abs() + drag)
    };
    let mut vanishes = |name, s: f64| {
        let (value, size) = terms(s);
        draw.equal((name, value), 0.0, size, tolerance::CANCELLING)
    };
    let double = vanishes("double_pole", -w);
    // A double root keeps its sign on either side, and grows as the square.
    let near = |s: f64| terms(s).0 / terms(s).1;
    let (before, after) = (near(-w * (1.0 + 1e-4)), near(-w * (1.0 - 1e-4)));
    let double = double.and(Case::truth(before.abs().max(after.abs()) < 1e-6));
    let slow = match gains.structure() {
        Structure::Pd | Structure::Ipd => double,
        Structure::Pid => vanishes("slow_pole", -0.1 * w),
    };
    Some(double.and(slow))
}

claim! {
    DELAY_MARGIN = "delay-margin" Theorem
    "the least of phase above critical over frequency at the crossovers of gain is the delay that a stable loop bears";
    corrected delay_margin(|_, margins| margins.delay_s);
    // The phase margin over the frequency of the pole.
    false delay_margin(|tuning, margins| margins.phase_rad / tuning.double_pole_rad_s());
    not_proved "the poles of a loop with delay are counted in floats; an enclosure of the count is not there";
}

type DelayMargin = fn(&Tuning<f64>, &Margins<f64>) -> f64;

fn delay_margin(draw: &mut Draw, margin: DelayMargin) -> Option<Case> {
    let delay = draw.uniform("delay_share", 0.0, 0.2);
    let tuning = design(draw, delay)?;
    let (axis, gains, w) = (tuning.axis(), tuning.gains(), tuning.margins().crossover_rad_s);
    let more_s = draw.note("more_s", margin(&tuning, tuning.margins()));
    let with = |share: f64| {
        let late = axis.with_delay_s(axis.delay_s() + share * more_s).ok()?;
        OpenLoop::new(&late, gains, 0.0).ok()
    };
    let (less, critical, more) = (with(0.999)?, with(1.0)?, with(1.001)?);
    let (re, im) = critical.response(w);
    let on_axis = draw.equal(("distance_to_critical", libm::hypot(re + 1.0, im)), 0.0, 1.0, tolerance::CANCELLING);
    Some(on_axis.and(Case::truth(less.unstable_poles() == 0 && more.unstable_poles() == 2)))
}

claim! {
    RELAY_ULTIMATE = "relay-ultimate" Identity
    "for an integrator with dead time the relay oscillates with the ultimate period, and its describing function gives 8/pi^2 of the ultimate gain";
    cases |all| all.min(200);
    corrected relay_ultimate(SHARE, 0.0, 0.0, SLOWEST);
    // The describing function taken for exact.
    false relay_ultimate(1.0, 0.0, 0.0, SLOWEST);
    needs "no-hysteresis" relay_ultimate(SHARE, 0.1, 0.0, SLOWEST);
    needs "no-lag" relay_ultimate(SHARE, 0.0, 0.1, SLOWEST);
    needs "below-for-a-dead-time" relay_ultimate(SHARE, 0.0, 0.0, [0.7, 0.9]);
    exactly triangle on "whole" at &[[2.0, 0.5, 3.0]];
}

/// The gain that the describing function gives, over the ultimate gain.
const SHARE: f64 = 8.0 / (core::f64::consts::PI * core::f64::consts::PI);
/// Periods in dead times among which that of the slowest oscillation is.
const SLOWEST: [f64; 2] = [2.0, 10.0];

/// The exact oscillation of `gain exp(-s delay)/(s (lag s + 1))`, the slowest of these periods, against its critical point.
fn relay_ultimate(draw: &mut Draw, share: f64, hysteresis: f64, lag: f64, [least, most]: [f64; 2]) -> Option<Case> {
    let (gain, delay_s) = (draw.log_uniform("gain", 1e-2, 1e2), draw.log_uniform("delay_s", 1e-1, 1e1));
    let (level, lag_s) = (draw.log_uniform("level", 1e-2, 1e2), draw.note("lag_s", lag * delay_s));
    let half_width = draw.note("half_width", hysteresis * level * gain * delay_s);
    let found = || -> Option<(UltimatePoint<f64>, UltimatePoint<f64>)> {
        let denominator = if lag > 0.0 { vec![lag_s, 1.0, 0.0] } else { vec![1.0, 0.0] };
        let process = TransferFunction::new(&[gain], &denominator).ok()?.with_delay(delay_s).ok()?;
        let truth = critical_point(&process, 0.1 / delay_s..=10.0 / delay_s).ok()?;
        let relay = RelayHysteresis::new(level, half_width, 0.0).ok()?;
        let found = orbits(&process, &relay.into(), Some(least * delay_s..=most * delay_s)).ok()?;
        let slowest = found.orbits.first()?;
        let (amplitude, period_s) = (slowest.amplitude().midpoint(), slowest.period_s.midpoint());
        let test = RelayTest { level, half_width, amplitude, bias: 0.0, period_s };
        Some((test.ultimate().ok()?, truth))
    };
    let Some((found, truth)) = found() else { return Some(Case::truth(false)) };
    let period = draw.equal(("period_s", found.period_s()), truth.period_s(), truth.period_s(), tolerance::CANCELLING);
    let expected = share * truth.gain();
    Some(period.and(draw.equal(("ultimate_gain", found.gain()), expected, expected, tolerance::CANCELLING)))
}

/// The closed loop's characteristic polynomial and its slope vanish at the double pole, it alone at the slow pole;
/// where that is the double pole, its second derivative does.
fn prove_pole_placement(distortion: Distortion) -> Verdict {
    let of = |structure: Structure| {
        let functions = move |[alpha, drag, bandwidth]: [Rational; 3], factor: Rational| {
            let axis = DragAxis::linear(alpha, drag).ok()?;
            let gains = Body { alpha, slope: drag }.place(structure, bandwidth).ok()?;
            let (fed_back, own) = OpenLoop::new(&axis, &gains, number(0.0)).ok()?.polynomials();
            let lacking = own.len().checked_sub(fed_back.len())?;
            let term = |(place, own): (usize, &Rational)| match place.checked_sub(lacking) {
                Some(place) => *own + factor * fed_back[place],
                None => *own,
            };
            let closed: Vec<_> = own.iter().enumerate().map(term).collect();
            let w = double_pole(structure, bandwidth);
            let slow = number(structure.slow_pole()) * w;
            let slope = derivative(&closed);
            let third = match structure {
                Structure::Pd => number(0.0),
                Structure::Pid => value(&closed, -slow),
                Structure::Ipd => value(&derivative(&slope), -w),
            };
            Some([value(&closed, -w), value(&slope, -w), third])
        };
        exactly(ClaimPart::WHOLE, distortion, &[[2.0, 0.5, 3.0]], functions)
    };
    of(Structure::Pd).and(|| of(Structure::Pid)).and(|| of(Structure::Ipd))
}

/// A polynomial in descending powers, by Horner's rule.
fn value<T: Real>(polynomial: &[T], at: T) -> T {
    polynomial.iter().fold(T::zero(), |sum, &coefficient| sum * at + coefficient)
}

fn derivative<T: Real>(polynomial: &[T]) -> Vec<T> {
    let degree = polynomial.len().saturating_sub(1);
    let factors = (1..=degree).rev().map(|power| T::from_f64(power as f64));
    factors.zip(polynomial).map(|(power, &coefficient)| power * coefficient).collect()
}

/// The triangle of period four dead times through the code that reads an ultimate point off an oscillation.
fn triangle([gain, delay_s, level]: [Rational; 3], factor: Rational) -> Option<[Rational; 2]> {
    let (four, pi) = (number(4.0), Rational::pi());
    let zero = number(0.0);
    let test =
        RelayTest { level, half_width: zero, amplitude: gain * level * delay_s, bias: zero, period_s: four * delay_s };
    let found = test.ultimate().ok()?;
    let omega = pi / (number(2.0) * delay_s);
    let share = number(8.0) / pi.square();
    Some([found.gain() - factor * share * omega / gain, found.period_s() - number(2.0) * pi / omega])
}
