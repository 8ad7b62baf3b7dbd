//! Exact limit cycles of a drag axis, and the parameters that the first-harmonic method reads off them.

use super::algebra::{exactly, number};
use super::family::cycle;
use super::orbit_proofs::proved;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::balance::HarmonicBalance;
use crate::describing::ClosedForm;
use crate::identify::iso::{Oscillation, Parameters, disturbance_from_times};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::Real;
use crate::orbit::{self, LimitCycle, limit_cycle, theorem};
use crate::plant::{DragAxis, PlantError, TransferFunction};
use crate::proof::polynomial::Rational;

/// A drag law with a single coefficient.
struct SingleDrag {
    law: fn(alpha: f64, drag: f64) -> Result<DragAxis<f64>, PlantError>,
    /// The number `g` that everything depends on, over the half-width.
    group: fn(alpha: f64, drag: f64, level: f64) -> f64,
    drag_of: fn(&Parameters<f64>) -> f64,
}

/// Force proportional to speed: `g = x_a beta^2/(C alpha)`.
const LINEAR: SingleDrag = SingleDrag {
    law: DragAxis::linear,
    group: |alpha, drag, level| drag * drag / (level * alpha),
    drag_of: |parameters| parameters.beta,
};

/// Force proportional to speed squared: `g = x_a beta/alpha`.
const QUADRATIC: SingleDrag = SingleDrag {
    law: DragAxis::quadratic,
    group: |alpha, drag, _| drag / alpha,
    drag_of: |parameters| parameters.beta_quadratic,
};

const EVERY_AXIS: ClaimPart = ClaimPart::named("every-axis");

/// An axis with its relay.
struct SingleDragLoop {
    alpha: f64,
    drag: f64,
    level: f64,
    half_width: f64,
    axis: DragAxis<f64>,
    relay: RelayHysteresis<f64>,
}

impl SingleDragLoop {
    /// From its four numbers; `None` for a value out of range.
    fn new(family: &SingleDrag, alpha: f64, drag: f64, level: f64, half_width: f64) -> Option<Self> {
        let axis = (family.law)(alpha, drag).ok()?;
        let relay = RelayHysteresis::new(level, half_width, 0.0).ok()?;
        Some(Self { alpha, drag, level, half_width, axis, relay })
    }

    /// Any scale, and `g` anywhere in six decades.
    fn draw(draw: &mut Draw, family: &SingleDrag) -> Option<Self> {
        let (alpha, drag) = (draw.log_uniform("alpha", 1e-2, 1e2), draw.log_uniform("drag", 1e-2, 1e2));
        let (level, g) = (draw.log_uniform("level", 1e-2, 1e2), draw.log_uniform("g", 1e-4, 1e2));
        let half_width = draw.note("half_width", g / (family.group)(alpha, drag, level));
        Self::new(family, alpha, drag, level, half_width)
    }
}

claim! {
    ORBIT_QUADRATIC = "orbit-quadratic" Theorem
    "Quadratic drag: one limit cycle for every alpha, beta, C, x_a > 0, reached from every start";
    corrected closed_form_orbit(|l| quadratic_orbit(l, 4.0), &QUADRATIC) and attracts(&QUADRATIC)
        backed by proved(&theorem::QUADRATIC, const { &[EVERY_AXIS] });
    // E = exp(-2 g) in place of exp(-4 g): the energy of a whole swing taken for half of it.
    false closed_form_orbit(|l| quadratic_orbit(l, 2.0), &QUADRATIC);
    needs "drag-positive" no_cycle(0.0, 0.2);
    needs "half-width-positive" no_cycle(1.0, 0.0);
    theorem &theorem::QUADRATIC;
}

/// Amplitude and period from `E = exp(-swing g)`.
fn quadratic_orbit(l: &SingleDragLoop, swing: f64) -> (f64, f64) {
    let (g, reach) = (l.drag * l.half_width / l.alpha, l.alpha / (2.0 * l.drag));
    let speed = orbit::quadratic_speeds(-libm::expm1(-swing * g), 0.0)[0];
    let period_s = 2.0 * l.alpha / (l.drag * l.level).sqrt() * orbit::quadratic_period(swing / 4.0 * g);
    (l.half_width + reach * libm::log1p(speed), period_s)
}

claim! {
    ORBIT_LINEAR = "orbit-linear" Theorem
    "Linear drag: one limit cycle for every alpha, beta, C, x_a > 0, reached from every start";
    corrected closed_form_orbit(|l| linear_orbit(l, 4.0), &LINEAR) and attracts(&LINEAR)
        backed by proved(&theorem::LINEAR, const { &[EVERY_AXIS] });
    // z = beta T/(2 alpha).
    false closed_form_orbit(|l| linear_orbit(l, 2.0), &LINEAR);
    needs "drag-positive" no_cycle(0.0, 0.2);
    needs "half-width-positive" no_cycle(1.0, 0.0);
    theorem &theorem::LINEAR;
}

/// Amplitude and period from `z - tanh z = g`, solved by bisection in z.
fn linear_orbit(l: &SingleDragLoop, quarter: f64) -> (f64, f64) {
    let g = l.half_width * l.drag * l.drag / (l.level * l.alpha);
    let (mut low, mut high) = (0.0, g + 1.0 + libm::cbrt(3.0 * g));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if orbit::linear_half_width(middle) < g { low = middle } else { high = middle }
    }
    let reach = l.level * l.alpha / (l.drag * l.drag);
    (l.half_width + reach * orbit::linear_amplitude_excess(low), quarter * low * l.alpha / l.drag)
}

/// The general path through Newton's method gives the closed form of the symmetric case.
fn closed_form_orbit(draw: &mut Draw, orbit: fn(&SingleDragLoop) -> (f64, f64), family: &SingleDrag) -> Option<Case> {
    let case = SingleDragLoop::draw(draw, family)?;
    let Ok(cycle) = limit_cycle(&case.axis, &case.relay) else { return Some(Case::truth(false)) };
    let (amplitude, period_s) = orbit(&case);
    let equations = [
        ("amplitude", cycle.amplitude, amplitude, amplitude),
        ("period_s", cycle.period_s, period_s, period_s),
        ("bias", cycle.bias, 0.0, amplitude),
    ];
    Some(draw.equations(equations, tolerance::CANCELLING))
}

/// From any speed the return map moves towards the cycle's and never past it, with a slope in (0, 1) at the cycle.
fn attracts(draw: &mut Draw, family: &SingleDrag) -> Option<Case> {
    let case = SingleDragLoop::draw(draw, family)?;
    let Ok(cycle) = limit_cycle(&case.axis, &case.relay) else { return Some(Case::truth(false)) };
    let fixed = cycle.upper_switch.velocity;
    let start = fixed * draw.log_uniform("start_over_fixed", 1e-3, 1e3);
    if (start / fixed - 1.0).abs() < 1e-4 {
        return None;
    }
    let Some(next) = a_period_on(&case.axis, &case.relay, start) else { return Some(Case::truth(false)) };
    // The distance after a period over the distance before.
    let left = draw.note("left", (next - fixed) / (start - fixed));
    let contracts = (0.0..1.0).contains(&cycle.multiplier);
    // Where drag is weak and the start is far off the share is 1 within rounding.
    Some(Case::truth(contracts && left > -tolerance::CANCELLING && left < 1.0 + tolerance::CANCELLING))
}

/// The speed at the upper switching a period after a switching there at `speed`: two half cycles without disturbance and delay.
fn a_period_on(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>, speed: f64) -> Option<f64> {
    let (brake, drive) = (axis.one_way(-relay.level()), axis.one_way(relay.level()));
    (0..2).try_fold(speed, |speed, _| {
        let stop = brake.advance(speed, brake.time_to_rest(speed)?).distance;
        let time_s = drive.time_to_distance(0.0, stop + 2.0 * relay.half_width())?;
        Some(drive.advance(0.0, time_s).speed)
    })
}

/// Without drag there is no limit cycle, nor without hysteresis and delay.
fn no_cycle(draw: &mut Draw, drag: f64, half_width: f64) -> Option<Case> {
    let level = draw.uniform("level", 0.1, 1.0);
    let (drag, half_width) = (draw.note("drag", drag), draw.note("half_width", half_width));
    Some(Case::truth(cycle(1.0, [drag, 0.0], 0.0, 0.0, [level, half_width]).is_some()))
}

/// A loop with a disturbance, and its orbit.
fn disturbed(draw: &mut Draw, linear: bool, quadratic: bool) -> Option<(f64, f64, LimitCycle<f64>)> {
    let coefficient = |draw: &mut Draw, name, on: bool| if on { draw.log_uniform(name, 0.1, 10.0) } else { 0.0 };
    let drag = [coefficient(draw, "linear_drag", linear), coefficient(draw, "quadratic_drag", quadratic)];
    let level = draw.uniform("level", 0.5, 2.0);
    let share = draw.uniform("disturbance_over_level", 0.1, 0.8);
    let (half_width, delay_s) = (draw.log_uniform("half_width", 0.05, 2.0), draw.uniform("delay_s", 0.0, 0.5));
    Some((level, share * level, cycle(1.0, drag, share * level, delay_s, [level, half_width])?))
}

fn delta(draw: &mut Draw, linear: bool, quadratic: bool, sign: f64) -> Option<Case> {
    let Some((level, delta, cycle)) = disturbed(draw, linear, quadratic) else { return Some(Case::truth(false)) };
    let found = sign * disturbance_from_times(level, cycle.time_positive_s, cycle.time_negative_s);
    Some(draw.equal(("delta_found", found), delta, level, tolerance::CANCELLING))
}

claim! {
    DELTA_FROM_TIMES = "delta-from-times" Theorem
    "delta = -C (t_plus - t_minus)/T is exact for any waveform and delay when drag is linear";
    printed Refuted delta(true, true, 1.0);
    corrected delta(true, false, 1.0);
    // T_H taken for the time at command +C.
    false delta(true, false, -1.0);
    needs "linear-drag" delta(false, true, 1.0);
    exactly mean_force on "whole" at &[[1.0, 2.0, 0.3]];
}

claim! {
    METHOD_BIAS = "method-bias" Theorem
    "On symmetric orbits without delay the relative error of the method depends on one number g, whatever the parameters";
    corrected depends_on_g_alone(&LINEAR, &LINEAR, 0.0) and depends_on_g_alone(&QUADRATIC, &QUADRATIC, 0.0);
    // The number `g` of the wrong drag law.
    false depends_on_g_alone(&LINEAR, &SingleDrag { group: QUADRATIC.group, ..LINEAR }, 0.0);
    needs "no-disturbance" depends_on_g_alone(&LINEAR, &LINEAR, 0.5);
    proof prove_method_bias;
}

/// Relative errors (alpha, drag) of the method on the exact orbit of a loop, with a disturbance as a share of the level.
fn method_errors(case: &SingleDragLoop, family: &SingleDrag, disturbance: f64) -> Option<[f64; 2]> {
    let cycle = limit_cycle(&case.axis.with_disturbance(disturbance * case.level).ok()?, &case.relay).ok()?;
    let read = Oscillation {
        relay_level: case.level,
        switch_level: case.half_width,
        amplitude: cycle.amplitude,
        bias: cycle.bias,
        period_s: cycle.period_s,
        delay_s: 0.0,
    };
    let found = read.identify().ok()?;
    Some([found.alpha / case.alpha - 1.0, (family.drag_of)(&found) / case.drag - 1.0])
}

/// The method's errors on a random loop, disturbed, equal those on the loop of unit parameters whose half-width is `g`
/// as `assumed` has it.
fn depends_on_g_alone(draw: &mut Draw, family: &SingleDrag, assumed: &SingleDrag, disturbance: f64) -> Option<Case> {
    let case = SingleDragLoop::draw(draw, family)?;
    let g = case.half_width * (assumed.group)(case.alpha, case.drag, case.level);
    let unit = SingleDragLoop::new(family, 1.0, 1.0, 1.0, g);
    let share = draw.uniform("disturbance_over_level", 0.5, 1.0) * disturbance;
    let errors = method_errors(&case, family, share).zip(unit.and_then(|unit| method_errors(&unit, family, 0.0)));
    let Some((drawn, unit)) = errors else { return Some(Case::truth(false)) };
    let errors = [("alpha_error", drawn[0], unit[0], 1.0), ("drag_error", drawn[1], unit[1], 1.0)];
    Some(draw.equations(errors, tolerance::CANCELLING))
}

claim! {
    BALANCE_CONVERGES = "balance-converges" Theorem
    "With more harmonics the balance of an integrating plant under a relay comes ever closer to the exact orbit";
    cases |all| all.div_ceil(200);
    corrected balance_error([1, 5, 15], 0.2);
    // Closer by a factor of a thousand for each fivefold of harmonics.
    false balance_error([1, 5, 15], 1e-3);
    not_proved "the balance with many harmonics comes from a search, not from a formula";
}

/// Relative errors of the period with ever more harmonics: each at most `factor` times its predecessor.
fn balance_error(draw: &mut Draw, orders: [usize; 3], factor: f64) -> Option<Case> {
    let (lag_s, half_width) = (draw.log_uniform("lag_s", 0.3, 3.0), draw.uniform("half_width", 0.05, 0.5));
    let [first, some, many] = balance_errors(lag_s, half_width, orders)?;
    for (name, error) in [("first", first), ("some", some), ("many", many)] {
        draw.note(name, error);
    }
    Some(Case::margin(1.0 - some / (factor * first)).and(Case::margin(1.0 - many / (factor * some))))
}

/// Of `1/(s (lag s + 1))` under a unit relay.
fn balance_errors(lag_s: f64, half_width: f64, orders: [usize; 3]) -> Option<[f64; 3]> {
    let plant = TransferFunction::new(&[1.0], &[lag_s, 1.0, 0.0]).ok()?;
    let relay = RelayHysteresis::new(1.0, half_width, 0.0).ok()?;
    let exact = orbit::orbits(&plant, &relay.into(), Some(0.01..=1000.0)).ok()?.orbits.first()?.period_s.midpoint();
    let balance = HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep)).ok()?;
    let first = *balance.intersections().ok()?.first()?;
    let error = |order| {
        let found = balance.with_harmonics(&relay, &first, order).ok()?;
        Some((core::f64::consts::TAU / found.omega_rad_s / exact - 1.0).abs())
    };
    let [a, b, c] = orders.map(error);
    Some([a?, b?, c?])
}

/// Times at which command and disturbance have mean zero give the disturbance.
fn mean_force([level, positive_s, delta]: [Rational; 3], factor: Rational) -> Option<[Rational; 2]> {
    let negative_s = positive_s * (level + delta) / (level - delta);
    let impulse = level * (positive_s - negative_s) + delta * (positive_s + negative_s);
    Some([impulse, factor * disturbance_from_times(level, positive_s, negative_s) - delta])
}

/// The method's parameters from an orbit, over the true parameters.
fn relative(
    family: fn(&Parameters<Rational>) -> Rational,
    [level, half_width, amplitude, period_s]: [Rational; 4],
    [alpha, drag]: [Rational; 2],
) -> Option<[Rational; 2]> {
    let zero = number(0.0);
    let read =
        Oscillation { relay_level: level, switch_level: half_width, amplitude, bias: zero, period_s, delay_s: zero };
    let found = read.identify().ok()?;
    Some([found.alpha / alpha, family(&found) / drag])
}

/// Linear drag: the closed form of the orbit, through the method. `z - tanh z` and `tanh z - ln(1 + tanh z)` are given with z.
fn linear_relative([alpha, drag, level, z, width, excess]: [Rational; 6]) -> Option<[Rational; 2]> {
    let reach = level * alpha / drag.square();
    let period_s = number(4.0) * z * alpha / drag;
    relative(|found| found.beta, [level, reach * width, reach * (width + excess), period_s], [alpha, drag])
}

/// Quadratic drag; drag and level by their roots. Logarithm and angles of the closed form are given with g.
fn quadratic_relative([alpha, drag_root, level_root, g, excess, angles]: [Rational; 6]) -> Option<[Rational; 2]> {
    let (drag, level, two) = (drag_root.square(), level_root.square(), number(2.0));
    let half_width = g * alpha / drag;
    let amplitude = half_width + alpha / (two * drag) * excess;
    let period_s = two * alpha / (drag_root * level_root) * angles;
    relative(|found| found.beta_quadratic, [level, half_width, amplitude, period_s], [alpha, drag])
}

/// For all inertias, drags and levels the method errs as for unit values.
fn prove_method_bias(distortion: Distortion) -> Verdict {
    // The switchings lie in the middle half of the sweep and beyond.
    const POINTS: [[f64; 6]; 2] = [[2.0, 0.75, 3.0, 0.25, 0.25, 0.5], [2.0, 0.75, 3.0, 0.75, 0.75, 0.25]];
    let of = |relative: fn([Rational; 6]) -> Option<[Rational; 2]>| {
        exactly(ClaimPart::WHOLE, distortion, &POINTS, |at: [Rational; 6], factor: Rational| {
            let one = number(1.0);
            let [.., first, second, third] = at;
            let unit = relative([one, one, one, first, second, third])?;
            let [alpha, drag] = relative(at)?;
            Some([factor * alpha - unit[0], factor * drag - unit[1]])
        })
    };
    of(linear_relative).and(|| of(quadratic_relative))
}
