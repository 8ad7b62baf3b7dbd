//! Closed-form motion of a drag axis: against an integrator, against itself, and in its limits.

use proptest::prelude::*;
use selfosc::numeric::Gradient;
use selfosc::numeric::Real;
use selfosc::plant::{DragAxis, PlantError, State};

use crate::difference::five_point;
use crate::{integration_oracle as oracle, tolerance};

/// A start and what acts on it, in plain numbers: linear and quadratic drag, force, position, velocity.
#[derive(Clone, Copy, Debug)]
struct Start([f64; 5]);

impl Start {
    fn build<T: Real>(numbers: [T; 5]) -> (DragAxis<T>, State<T>, T) {
        let [linear, quadratic, force, position, velocity] = numbers;
        let axis = DragAxis::mixed(T::from_f64(0.8), linear, quadratic).unwrap();
        let disturbance = T::from_f64(0.25);
        (axis.with_disturbance(disturbance).unwrap(), State { position, velocity }, force - disturbance)
    }
}

/// Drag from none over nearly none to strong, a force either way, and exact criticality.
fn starts() -> impl Strategy<Value = Start> {
    let drag = || {
        prop_oneof![1 => Just(0.0), 1 => -30.0..-1.0, 3 => -3.0..1.0]
            .prop_map(|e: f64| if e == 0.0 { 0.0 } else { 10f64.powf(e) })
    };
    let critical = prop_oneof![3 => Just(None), 1 => (-1e-3..1e-3).prop_map(Some), 1 => Just(Some(0.0))];
    (drag(), drag(), -2.0..2.0, -1.0..1.0, -3.0..3.0, critical).prop_map(
        |(linear, quadratic, force, x, v, critical)| {
            let force = match critical {
                // Discriminant zero, or nearly, for a braking force.
                Some(off) if linear > 0.1 && quadratic > 0.1 => {
                    -f64::signum(v) * linear * linear / (4.0 * 0.8 * quadratic) * 0.8 * (1.0 + off)
                }
                _ => force,
            };
            Start([linear, quadratic, force, x, v])
        },
    )
}

/// Position or velocity.
type Part = fn(State<f64>) -> f64;

/// Largest way and speed that a motion could have made.
fn scales(start: Start, duration: f64) -> (f64, f64) {
    let [_, _, force, x, v] = start.0;
    let speed = v.abs() + force.abs() / 0.8 * duration;
    (x.abs() + speed * duration, speed)
}

#[track_caller]
fn assert_same(value: State<f64>, expected: State<f64>, scales: (f64, f64)) {
    let way = (value.position - expected.position).abs() / scales.0;
    let speed = (value.velocity - expected.velocity).abs() / scales.1;
    assert!(way <= tolerance::MOTION && speed <= tolerance::MOTION, "{value:?} is not {expected:?}: {way:e} {speed:e}");
}

proptest! {
    #![proptest_config(ProptestConfig { max_shrink_iters: 200, ..crate::sampling::config(1000) })]

    #[test]
    fn agrees_with_integration(start in starts(), duration in 1e-3..20.0) {
        let (axis, state, input) = Start::build(start.0);
        let expected = oracle::integrate(&axis, state, input, duration);
        assert_same(axis.advance(state, input, duration), expected, scales(start, duration));
    }

    #[test]
    fn two_steps_are_one(start in starts(), first in 0.0..5.0, second in 0.0..5.0) {
        let (axis, state, input) = Start::build(start.0);
        let twice = axis.advance(axis.advance(state, input, first), input, second);
        assert_same(twice, axis.advance(state, input, first + second), scales(start, first + second));
    }

    #[test]
    fn rest_is_reached_when_predicted(start in starts()) {
        let (axis, state, input) = Start::build(start.0);
        let braking = (input + axis.disturbance()) * state.velocity < 0.0;
        let Some(rest) = axis.time_to_rest(state, input) else {
            prop_assert!(!braking);
            return Ok(());
        };
        prop_assert!(braking && rest >= 0.0);
        let end = axis.advance(state, input, rest);
        prop_assert!(end.velocity.abs() <= tolerance::MOTION * scales(start, rest).1, "{:?}", end);
    }

    #[test]
    fn levels_are_reached_when_predicted(start in starts(), level in -3.0_f64..3.0) {
        let (axis, state, input) = Start::build(start.0);
        let side = |time| (axis.advance(state, input, time).position - level).signum();
        let begin = (state.position - level).signum();
        let until = axis.time_to_position(state, input, level);
        if let Some(time) = until {
            let end = axis.advance(state, input, time);
            let error = (end.position - level).abs() / scales(start, time).0;
            prop_assert!(error <= tolerance::MOTION, "{time} {end:?} {error:e}");
        }
        // Not before, and where there is no time, not for long.
        let last = until.map_or(50.0, |time| time * (1.0 - 1e-9));
        for k in 0..50 {
            prop_assert_eq!(side(last * f64::from(k) / 50.0), begin);
        }
    }

    #[test]
    fn dual_numbers_carry_every_sensitivity(start in starts(), duration in 0.1..5.0, which in 0_usize..6) {
        let mut numbers = start.0;
        let step = 1e-3;
        // A difference needs room on both sides.
        numbers[0] += 3.0 * step;
        numbers[1] += 3.0 * step;
        let run = |shift: f64| {
            let (mut numbers, mut duration) = (numbers, duration);
            if which < 5 { numbers[which] += shift } else { duration += shift }
            let (axis, state, input) = Start::build(numbers);
            axis.advance(state, input, duration)
        };
        let mut dual = numbers.map(Gradient::<f64, 1>::constant);
        let mut time = Gradient::<f64, 1>::constant(duration);
        let varied = if which < 5 { &mut dual[which] } else { &mut time };
        *varied = Gradient::new(varied.value(), [1.0]);
        let (axis, state, input) = Start::build(dual);
        let end = axis.advance(state, input, time);
        let (way, speed) = scales(Start(numbers), duration + 1.0);
        let tolerance = tolerance::DIFFERENCE * (1.0 + duration);
        let values: [(_, _, Part); 2] =
            [(end.position.slopes()[0], way, |end| end.position), (end.velocity.slopes()[0], speed, |end| end.velocity)];
        for (value, scale, of) in values {
            let tolerance = tolerance * scale * (1.0 + scale);
            let difference = five_point(step, tolerance, |h| of(run(h)));
            prop_assume!(difference.is_some());
            let difference = difference.unwrap();
            prop_assert!((value - difference).abs() <= tolerance, "{} {}", value, difference);
        }
    }
}

#[test]
fn rest_without_force_stays() {
    let axis = DragAxis::mixed(1.0, 0.2, 0.3).unwrap();
    let rest = State { position: 0.4, velocity: 0.0 };
    assert_eq!(axis.advance(rest, 0.0, 7.0), rest);
    assert_eq!(axis.time_to_rest(rest, 0.0), None);
    assert_eq!(axis.time_to_position(rest, 0.0, 0.4), Some(0.0));
    assert_eq!(axis.time_to_position(rest, 0.0, 0.5), None);
}

#[test]
fn parameters_are_checked() {
    let named = |result: Result<DragAxis<f64>, PlantError>| match result {
        Err(PlantError::OutOfDomain(fault)) => fault.quantity,
        other => panic!("{other:?}"),
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(named(DragAxis::linear(bad, 1.0)), "alpha");
    }
    let good = DragAxis::mixed(1.0, 0.0, 0.0).unwrap();
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(named(DragAxis::linear(1.0, bad)), "linear_drag");
        assert_eq!(named(DragAxis::quadratic(1.0, bad)), "quadratic_drag");
        assert_eq!(named(good.with_delay_s(bad)), "delay_s");
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(named(good.with_disturbance(bad)), "disturbance");
    }
}
