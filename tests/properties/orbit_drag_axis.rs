//! Exact limit cycles of a drag axis: against integration, against 30-digit references, against one another.

use proptest::prelude::*;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::numeric::Gradient;
use selfosc::numeric::increasing_root;
use selfosc::orbit::{
    LimitCycle, OrbitError, limit_cycle, linear_amplitude_excess, linear_half_cycle, linear_half_width,
    quadratic_half_cycle, quadratic_period, quadratic_speeds,
};
use selfosc::plant::DragAxis;

use crate::difference::five_point;
use crate::{integration_oracle as oracle, tolerance};

/// A loop in plain numbers, to be built in any arithmetic.
#[derive(Clone, Copy, Debug)]
struct Loop {
    alpha: f64,
    linear_drag: f64,
    quadratic_drag: f64,
    disturbance: f64,
    offset: f64,
    level: f64,
    half_width: f64,
    delay_s: f64,
}

impl Loop {
    fn from_array(p: [f64; 8]) -> Self {
        let [alpha, linear_drag, quadratic_drag, disturbance, offset, level, half_width, delay_s] = p;
        Self { alpha, linear_drag, quadratic_drag, disturbance, offset, level, half_width, delay_s }
    }
    fn to_array(self) -> [f64; 8] {
        let Self { alpha, linear_drag, quadratic_drag, disturbance, offset, level, half_width, delay_s } = self;
        [alpha, linear_drag, quadratic_drag, disturbance, offset, level, half_width, delay_s]
    }
    fn axis(&self) -> DragAxis<f64> {
        build(self.to_array()).0
    }
    fn relay(&self) -> RelayHysteresis<f64> {
        build(self.to_array()).1
    }
    fn solve(&self) -> Result<LimitCycle<f64>, OrbitError> {
        limit_cycle(&self.axis(), &self.relay())
    }
}

fn build<T: selfosc::numeric::Real>(p: [T; 8]) -> (DragAxis<T>, RelayHysteresis<T>) {
    let [alpha, linear, quadratic, disturbance, offset, level, half_width, delay_s] = p;
    let axis = DragAxis::mixed(alpha, linear, quadratic).unwrap();
    let axis = axis.with_disturbance(disturbance).unwrap().with_delay_s(delay_s).unwrap();
    (axis, RelayHysteresis::new(level, half_width, offset).unwrap())
}

fn log_uniform(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Every kind of drag, with or without delay, and of any scale; the dimensionless hysteresis g in the range given.
fn loops(g: core::ops::Range<f64>) -> impl Strategy<Value = Loop> {
    let share = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0];
    let wait = prop_oneof![2 => Just(0.0), 1 => 0.0..0.5, 1 => 0.5..8.0];
    let scale = || log_uniform(1e-2, 1e2);
    (scale(), scale(), scale(), log_uniform(g.start, g.end), share, -0.8..0.8, wait).prop_map(
        |(alpha, level, half_width, g, share, mu, wait)| Loop {
            alpha,
            linear_drag: share * (g * level * alpha / half_width).sqrt(),
            quadratic_drag: (1.0 - share) * g * alpha / half_width,
            disturbance: mu * level,
            offset: 0.0,
            level,
            half_width,
            delay_s: wait * (alpha * half_width / level).sqrt(),
        },
    )
}

/// One number of a limit cycle.
type Feature = fn(&LimitCycle<f64>) -> f64;

/// The speed past the upper level a period after it was `speed` there, and its slope, by the motion's closed forms in dual numbers.
fn return_map(case: &Loop, speed: f64) -> (f64, f64) {
    let (axis, relay) = build(case.to_array().map(Gradient::<f64, 1>::constant));
    let force = axis.disturbance() + relay.offset();
    let ends = [(relay.level() + force, relay.level() - force), (relay.level() - force, relay.level() + force)];
    let next = ends.into_iter().fold(Gradient::new(speed, [1.0]), |speed, (ahead, back)| {
        let (drive, brake, next) = (axis.one_way(ahead), axis.one_way(-back), axis.one_way(back));
        // At zero delay the formula of the lag has no slope to offer.
        let late = if case.delay_s == 0.0 {
            (speed, Gradient::constant(0.0))
        } else {
            let lag = drive.advance(speed, axis.delay_s());
            (lag.speed, lag.distance)
        };
        let stop = brake.advance(late.0, brake.time_to_rest(late.0).unwrap()).distance;
        let way = late.1 + stop + Gradient::constant(2.0) * relay.half_width();
        let time = next.time_to_distance(Gradient::constant(0.0), way).unwrap();
        next.advance(Gradient::constant(0.0), time).speed
    });
    (next.value(), next.slopes()[0])
}

/// Rounding on the way to a fixed point, magnified by its slope.
fn magnified(cycle: &LimitCycle<f64>) -> f64 {
    tolerance::REFERENCE / (1.0 - cycle.multiplier)
}

#[track_caller]
fn assert_close(what: &str, value: f64, expected: f64, scale: f64, tolerance: f64) {
    let error = ((value - expected) / scale).abs();
    assert!(error <= tolerance, "{what}: {value:e}, expected {expected:e}, off by {error:e} > {tolerance:e}");
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 100, ..crate::sampling::config(400) })]

    #[test]
    fn agrees_with_integration(case in loops(1e-3..1e2)) {
        let exact = case.solve().unwrap();
        let seen = oracle::limit_cycle(&case.axis(), &case.relay());
        let (size, period, speed) = (exact.amplitude, exact.period_s, exact.upper_switch.velocity);
        for (what, value, expected, scale) in [
            ("amplitude", exact.amplitude, (seen.maximum - seen.minimum) / 2.0, size),
            ("bias", exact.bias, f64::midpoint(seen.maximum, seen.minimum), size),
            ("maximum", exact.maximum, seen.maximum, size),
            ("minimum", exact.minimum, seen.minimum, size),
            ("period", exact.period_s, seen.period_s(), period),
            ("time positive", exact.time_positive_s, seen.time_positive_s, exact.time_positive_s),
            ("time negative", exact.time_negative_s, seen.time_negative_s, exact.time_negative_s),
            ("upper position", exact.upper_switch.position, seen.upper_position, size),
            ("upper velocity", exact.upper_switch.velocity, seen.upper_velocity, speed),
            ("lower position", exact.lower_switch.position, seen.lower_position, size),
            ("lower velocity", exact.lower_switch.velocity, seen.lower_velocity, speed),
        ] {
            assert_close(what, value, expected, scale, tolerance::AXIS_INTEGRATION);
        }
    }

    #[test]
    fn half_cycles_outlast_the_delay(case in loops(1e-6..1e4)) {
        let cycle = case.solve().unwrap();
        prop_assert!(cycle.time_positive_s > case.delay_s && cycle.time_negative_s > case.delay_s);
        prop_assert!(cycle.multiplier >= 0.0 && cycle.multiplier < 1.0);
        prop_assert!(cycle.maximum >= cycle.upper_switch.position && cycle.upper_switch.position >= case.half_width);
        prop_assert!(cycle.minimum <= cycle.lower_switch.position && cycle.lower_switch.position <= -case.half_width);
    }

    #[test]
    fn multiplier_is_the_slope_of_the_return_map(case in loops(1e-3..1e2)) {
        let cycle = case.solve().unwrap();
        let mut speed = cycle.upper_switch.velocity;
        for _ in 0..50 {
            let (next, slope) = return_map(&case, speed);
            speed = (speed - (next - speed) / (slope - 1.0)).max(0.1 * speed);
        }
        let (next, slope) = return_map(&case, speed);
        assert_close("fixed point", next, speed, speed, magnified(&cycle));
        assert_close("multiplier", slope, cycle.multiplier, 1.0, tolerance::AXIS_INTEGRATION);
        if case.delay_s == 0.0 {
            assert_close("speed", speed, cycle.upper_switch.velocity, speed, tolerance::AXIS_INTEGRATION);
        }
    }

    #[test]
    fn dual_numbers_carry_every_sensitivity(case in loops(1e-2..1e1), which in 0_usize..8) {
        let parameters = case.to_array();
        let scale = [case.alpha, case.linear_drag, case.quadratic_drag, case.level, case.level, case.level,
            case.half_width, case.delay_s][which];
        if scale == 0.0 {
            return Ok(());
        }
        let mut dual = parameters.map(Gradient::<f64, 1>::constant);
        dual[which] = Gradient::new(parameters[which], [1.0]);
        let (axis, relay) = build(dual);
        let sensitive = limit_cycle(&axis, &relay).unwrap();
        let shifted = |step: f64| {
            let mut p = parameters;
            p[which] += step;
            Loop::from_array(p).solve().unwrap()
        };
        let (size, period) = (sensitive.amplitude.value(), sensitive.period_s.value());
        let values: [(_, _, Feature); 4] = [
            (sensitive.amplitude, size, |cycle| cycle.amplitude),
            (sensitive.bias, size, |cycle| cycle.bias),
            (sensitive.period_s, period, |cycle| cycle.period_s),
            (sensitive.time_positive_s, period, |cycle| cycle.time_positive_s),
        ];
        for (value, unit, of) in values {
            let difference = five_point(1e-3 * scale, tolerance::DIFFERENCE * unit / scale, |h| of(&shifted(h)));
            prop_assume!(difference.is_some());
            assert_close("derivative", value.slopes()[0], difference.unwrap(), unit / scale, tolerance::DIFFERENCE);
        }
    }

    #[test]
    fn relay_offset_acts_as_a_disturbance(case in loops(1e-3..1e2)) {
        let offset = Loop { disturbance: 0.0, offset: case.disturbance, ..case };
        prop_assert_eq!(case.solve().unwrap(), offset.solve().unwrap());
    }

    #[test]
    fn mirrored_disturbance_mirrors_the_cycle(case in loops(1e-6..1e4)) {
        let (cycle, mirror) =
            (case.solve().unwrap(), Loop { disturbance: -case.disturbance, ..case }.solve().unwrap());
        let size = cycle.amplitude;
        assert_close("amplitude", mirror.amplitude, size, size, magnified(&cycle));
        assert_close("bias", mirror.bias, -cycle.bias, size, magnified(&cycle));
        assert_close("time", mirror.time_negative_s, cycle.time_positive_s, cycle.period_s, magnified(&cycle));
    }

    #[test]
    fn linear_drag_makes_the_delta_formula_exact(case in loops(1e-3..1e2)) {
        let case = Loop { linear_drag: case.linear_drag.max(1e-3), quadratic_drag: 0.0, ..case };
        let cycle = case.solve().unwrap();
        let delta = -case.level * (cycle.time_positive_s - cycle.time_negative_s) / cycle.period_s;
        assert_close("delta", delta, case.disturbance, case.level, tolerance::AXIS_INTEGRATION);
    }

    #[test]
    fn single_precision_is_close(case in loops(1e-3..1e2)) {
        let single = case.to_array().map(|p| p as f32);
        let double = Loop::from_array(single.map(f64::from)).solve().unwrap();
        let (axis, relay) = build(single);
        let cycle = limit_cycle(&axis, &relay).unwrap();
        let size = double.amplitude;
        assert_close("amplitude", f64::from(cycle.amplitude), size, size, tolerance::SINGLE);
        assert_close("bias", f64::from(cycle.bias), double.bias, size, tolerance::SINGLE);
        assert_close("period", f64::from(cycle.period_s), double.period_s, double.period_s, tolerance::SINGLE);
        assert_close("multiplier", f64::from(cycle.multiplier), double.multiplier, 1.0, tolerance::SINGLE);
    }

    #[test]
    fn quadratic_closed_form(g in log_uniform(1e-6, 1e4), mu in -0.95..0.95) {
        let (alpha, level, half_width) = (0.7, 1.3, 0.4);
        let beta = g * alpha / half_width;
        let case = Loop::from_array([alpha, 0.0, beta, mu * level, 0.0, level, half_width, 0.0]);
        let cycle = case.solve().unwrap();
        let close = |what, value, expected, scale| assert_close(what, value, expected, scale, magnified(&cycle));
        let gap = -(-4.0 * g).exp_m1();
        let [upper, lower] = quadratic_speeds(gap, mu);
        let k = (level / beta).sqrt();
        close("upper", cycle.upper_switch.velocity, k * upper.sqrt(), k * upper.sqrt());
        close("lower", -cycle.lower_switch.velocity, k * lower.sqrt(), k * lower.sqrt());
        let excursion = |y: f64, ratio: f64| alpha / (2.0 * beta) * (y / ratio).ln_1p();
        let (above, below) = (excursion(upper, 1.0 - mu), excursion(lower, 1.0 + mu));
        let size = cycle.amplitude;
        close("maximum", cycle.maximum, half_width + above, size);
        close("minimum", cycle.minimum, -(half_width + below), size);
        let next = quadratic_half_cycle(upper, gap, 1.0 - mu);
        close("half cycle", next, lower, lower);
        let symmetric = Loop { disturbance: 0.0, ..case }.solve().unwrap().period_s;
        let period = 2.0 * alpha / (beta * level).sqrt() * quadratic_period(g);
        close("period", symmetric, period, period);
    }

    #[test]
    fn linear_closed_form(g in log_uniform(1e-6, 1e4), mu in -0.8..0.8) {
        let (alpha, level, half_width) = (0.7, 1.3, 0.4);
        let beta = (g * level * alpha / half_width).sqrt();
        let case = Loop::from_array([alpha, beta, 0.0, 0.0, 0.0, level, half_width, 0.0]);
        let cycle = case.solve().unwrap();
        let z = increasing_root(|z: f64| (linear_half_width(z) - g, z.tanh().powi(2)), 0.0, g + 2.0, g + g.cbrt())
            .unwrap();
        assert_close("period", cycle.period_s, 4.0 * alpha * z / beta, cycle.period_s, magnified(&cycle));
        let amplitude = half_width + level * alpha / (beta * beta) * linear_amplitude_excess(z);
        assert_close("amplitude", cycle.amplitude, amplitude, amplitude, magnified(&cycle));
        let biased = Loop { disturbance: mu * level, ..case }.solve().unwrap();
        let unit = beta / level;
        let (up, down) = (unit * biased.upper_switch.velocity, -unit * biased.lower_switch.velocity);
        for (speed, next, ratio) in [(up, down, 1.0 - mu), (down, up, 1.0 + mu)] {
            // A speed near the terminal one leaves few digits of their difference.
            let left = 1.0 - next / ratio;
            if left > 1e-3 {
                assert_close("half cycle", linear_half_cycle(speed, next, g, ratio), 0.0, 1.0 / left, magnified(&biased));
            }
        }
    }
}

/// From g = 1e-6 to 1e4, all kinds of drag, disturbance and delay: no digits cancel.
#[test]
fn agrees_with_thirty_digits() {
    let table = include_str!("../../fixtures/orbit_drag_axis.csv");
    let mut cases = 0;
    for line in table.lines().skip(2) {
        let numbers: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        let (parameters, expected) = numbers.split_at(8);
        let case = Loop::from_array(parameters.try_into().unwrap());
        let cycle = case.solve().unwrap();
        let values = [
            cycle.amplitude,
            cycle.bias,
            cycle.period_s,
            cycle.time_positive_s,
            cycle.time_negative_s,
            cycle.upper_switch.position,
            cycle.upper_switch.velocity,
            -cycle.lower_switch.position,
            -cycle.lower_switch.velocity,
            cycle.multiplier,
        ];
        for (column, (value, expected)) in values.iter().zip(expected).enumerate() {
            let scale = match column {
                1 => cycle.amplitude,
                9 => 1.0,
                _ => *expected,
            };
            assert_close(&format!("{case:?}, column {column}"), *value, *expected, scale, magnified(&cycle));
        }
        cases += 1;
    }
    assert_eq!(cases, 150);
}

const PLAIN: Loop = Loop {
    alpha: 1.0,
    linear_drag: 0.3,
    quadratic_drag: 0.2,
    disturbance: 0.0,
    offset: 0.0,
    level: 1.0,
    half_width: 0.2,
    delay_s: 0.0,
};

#[test]
fn no_limit_cycle_is_an_answer() {
    for (disturbance, offset) in [(1.0, 0.0), (-1.0, 0.0), (0.6, 0.4), (-0.5, -0.7), (3.0, 0.0)] {
        let case = Loop { disturbance, offset, ..PLAIN };
        assert_eq!(case.solve(), Err(OrbitError::Drift { disturbance, offset, level: 1.0 }));
    }
    assert!(Loop { disturbance: 1.5, offset: -1.0, ..PLAIN }.solve().is_ok());
    let free = Loop { linear_drag: 0.0, quadratic_drag: 0.0, ..PLAIN };
    assert_eq!(free.solve(), Err(OrbitError::NoDrag));
    let sharp = Loop { half_width: 0.0, ..PLAIN };
    assert_eq!(sharp.solve(), Err(OrbitError::NoHysteresis));
    assert!(Loop { delay_s: 1e-3, ..sharp }.solve().is_ok());
    let weak = Loop { linear_drag: 1e-60, quadratic_drag: 0.0, ..PLAIN };
    assert!(matches!(weak.solve(), Err(OrbitError::Unresolved { .. })), "{:?}", weak.solve());
}

/// Parameters over the whole range of the arithmetic: an answer or a reason, never NaN.
#[test]
fn extremes_are_answered() {
    let sizes = [f64::MIN_POSITIVE, 1e-200, 1e-30, 1.0, 1e30, 1e200, f64::MAX];
    for alpha in sizes {
        for drag in sizes {
            for half_width in sizes {
                for delay_s in [0.0, 1e-200, 1.0, 1e200] {
                    for (linear_drag, quadratic_drag) in [(drag, 0.0), (0.0, drag), (drag, drag)] {
                        let case = Loop { alpha, linear_drag, quadratic_drag, half_width, delay_s, ..PLAIN };
                        if let Ok(cycle) = case.solve() {
                            let numbers = [cycle.amplitude, cycle.bias, cycle.period_s, cycle.multiplier];
                            assert!(numbers.iter().all(|n| n.is_finite()), "{case:?} {cycle:?}");
                        }
                    }
                }
            }
        }
    }
}

/// A delay many times the period without delay: the cycle found is the one that the loop reaches from rest.
#[test]
fn long_delays() {
    for delay_s in [2.0, 20.0, 200.0] {
        let case = Loop { delay_s, disturbance: 0.3, ..PLAIN };
        let seen = oracle::limit_cycle(&case.axis(), &case.relay());
        let exact = case.solve().unwrap();
        assert_close("period", exact.period_s, seen.period_s(), seen.period_s(), tolerance::AXIS_INTEGRATION);
        assert_close("maximum", exact.maximum, seen.maximum, seen.maximum, tolerance::AXIS_INTEGRATION);
    }
}
