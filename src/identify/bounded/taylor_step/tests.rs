//! Steps against motions in closed form, each with a false variant that is caught.

use super::super::sensitivities::Variable;
use super::super::vector_field::TERMS;
use super::*;
use crate::numeric::runge_kutta;
use crate::numeric::{Real, Sizes};

const U: f64 = 1.0;

/// An axis with quadratic drag: force over inertia and drag over inertia.
fn field(gain: Interval, quadratic: Interval) -> VectorField {
    let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
    for (term, value) in
        [(FieldTerm::Gain, gain), (FieldTerm::Quadratic, quadratic), (FieldTerm::Disturbance, Interval::ZERO)]
    {
        (terms[term as usize], active[term as usize]) = (value, true);
    }
    VectorField { terms, active, middle_speed: 0.0 }
}

/// Position and velocity after a time from rest at zero and velocity v: hyperbolic tangent and the logarithm of its cosine.
fn motion([gain, quadratic, v]: [f64; 3], t: f64) -> [f64; 2] {
    let (terminal, rate) = ((gain * U / quadratic).sqrt(), (gain * U * quadratic).sqrt());
    let phase = (v / terminal).atanh();
    let now = rate * t + phase;
    [terminal / rate * (now.cosh() / phase.cosh()).ln(), terminal * now.tanh()]
}

fn about(value: f64, share: f64) -> Interval {
    Interval::point(value).inflate(share * value)
}

fn state(v: Interval) -> StateBox {
    [Interval::ZERO, v, Interval::point(U)]
}

/// Room for roundings of the closed form.
fn holds(range: Interval, value: f64) -> bool {
    range.inflate(1e-14).contains(value)
}

const CENTRE: [f64; 3] = [0.8, 0.5, 0.6];
const H_S: f64 = 0.4;

/// A step of a point, the centre.
fn step() -> Box<FlowStep> {
    let [gain, quadratic, v] = CENTRE.map(Interval::point);
    let field = field(gain, quadratic);
    let start = StatePair { over: state(v), at: state(v) };
    let fields = Fields { over: field, at: field };
    fields.taylor(&start, Interval::point(U), Interval::point(H_S), &[]).expect("a step")
}

fn point_after(step: &FlowStep, t: f64) -> StateBox {
    step.at(Interval::point(t)).at.expect("the point's own")
}

#[test]
fn the_closed_form_and_its_slope_are_within_a_step_and_without_the_remainder_they_are_not() {
    let whole = step();
    let mut short = whole.clone();
    for path in [&mut short.state, &mut short.by_start] {
        path.iter_mut().for_each(|series| series[DEGREE] = Balls::ZERO);
    }
    let [gain, quadratic, v] = CENTRE;
    // By the initial velocity: 1 - w^2 of the hyperbolic tangent over that at the start.
    let left = |v: f64| 1.0 - v * v * quadratic / (gain * U);
    let found = |step: &FlowStep, t: f64| {
        let slope = step.at(Interval::point(t)).by_start[VELOCITY][VELOCITY].interval_at(0);
        let [position, velocity, _] = point_after(step, t);
        [position, velocity, slope]
    };
    let mut missed = [0; 3];
    for part in 1..=20 {
        let t = H_S * f64::from(part) / 20.0;
        let [position, velocity] = motion(CENTRE, t);
        for (k, exact) in [position, velocity, left(velocity) / left(v)].into_iter().enumerate() {
            assert!(holds(found(&whole, t)[k], exact), "{exact} outside {:?} after {t}", found(&whole, t));
            missed[k] += usize::from(!holds(found(&short, t)[k], exact));
        }
    }
    assert!(missed[0] + missed[1] > 5 && missed[2] > 5, "without the remainder {missed:?} of 20 were missed");
}

#[test]
fn the_remainder_of_a_column_is_no_smaller_than_linear_drag_needs() {
    let (mut equation, rate) = (field(Interval::ONE, Interval::ZERO), 2.0);
    equation.active[FieldTerm::Quadratic as usize] = false;
    equation.terms[FieldTerm::Linear as usize] = Interval::point(rate);
    let start = StatePair { over: state(Interval::ZERO), at: state(Interval::ZERO) };
    let h_s = 0.98 * MOST_LENGTH / rate;
    let fields = Fields { over: equation, at: equation };
    let step = fields.taylor(&start, Interval::point(U), Interval::point(h_s), &[]).expect("a step");
    let [position, velocity, force] = step.at(Interval::point(h_s)).by_start[VELOCITY];
    let left = (-rate * h_s).exp();
    assert!(holds(velocity.interval_at(0), left), "{left} outside {:?}", velocity.interval_at(0));
    assert!(holds(position.interval_at(0), (1.0 - left) / rate));
    assert!(force.interval_at(0).magnitude() < 1e-290);
    assert!(velocity.interval_at(0).width() > 1e-9 && velocity.interval_at(0).width() < 1e-6);
    // Without a lag the force stays as well known as it was.
    let known = point_after(&step, h_s)[FORCE];
    assert_eq!(known, start.at[FORCE]);
}

#[test]
fn a_point_may_be_outside_of_the_box_and_without_the_error_bound_the_box_is_missed() {
    let [gain, quadratic, v] = CENTRE;
    // The box has more drag.
    let drag = about(1.5 * quadratic, 0.01);
    let fields = Fields {
        over: field(Interval::point(gain), drag),
        at: field(Interval::point(gain), Interval::point(quadratic)),
    };
    let short_s = 0.2;
    let blocks = Block::of(&[Variable::FieldTerm(FieldTerm::Quadratic)], &[drag - Interval::point(quadratic)]);
    let start = StatePair { over: state(Interval::point(v)), at: state(Interval::point(v)) };
    let step = fields.taylor(&start, Interval::point(U), Interval::point(short_s), &blocks).expect("a step");
    let mut certain = step.clone();
    certain.error = None;
    let reached = |step: &FlowStep, drag: f64, component: usize| {
        let arrival = step.at(Interval::point(short_s));
        let off = Interval::point(drag) - Interval::point(quadratic);
        arrival.at.expect("the point's own")[component] + arrival.by_forcing[0][component].interval_at(0) * off
    };
    for end in [drag.lower(), drag.upper()] {
        for (component, value) in motion([gain, end, v], short_s).into_iter().enumerate() {
            assert!(holds(reached(&step, end, component), value));
            assert!(!holds(reached(&certain, end, component), value));
        }
    }
}

/// Against motions by another method, and the mean value form is not many times as wide as the deviation.
#[test]
fn motions_of_a_box_are_within_the_mean_value_form_and_with_middle_slopes_they_are_not() {
    let centre = [0.9, 0.08, 0.5, 0.4, 0.2, 0.6, 3.0];
    let (share, h_s, from) = (0.04, 0.1, [0.3, 0.7, -0.4]);
    let of = |share: f64| VectorField {
        terms: centre.map(|value| about(value, share)),
        active: [true; TERMS],
        middle_speed: 0.0,
    };
    let fields = Fields { over: of(share), at: of(0.0) };
    let at = from.map(Interval::point);
    let over = from.map(|value| Interval::point(value).inflate(share * value.abs()));
    let blocks = Block::of(
        &FieldTerm::ALL.map(Variable::FieldTerm),
        &centre.map(|value| about(value, share) - Interval::point(value)),
    );
    let step =
        fields.taylor(&StatePair { over, at }, Interval::point(U), Interval::point(h_s), &blocks).expect("a step");
    let motion = |terms: [f64; TERMS], start: [f64; 3], t: f64| {
        let [gain, disturbance, linear, quadratic, cubic, stiffness, lag] = terms;
        let rate = |[x, v, f]: [f64; 3]| {
            let drag = linear * v + quadratic * v * v.abs() + cubic * v * v * v;
            [v, gain * f + disturbance - drag - stiffness * x, lag * (U - f)]
        };
        (0..200).fold(start, |state, _| runge_kutta(state, t / 200.0, rate))
    };
    let (mut outside, mut widest) = (0, 0.0f64);
    for (t, corner) in [0.5 * h_s, h_s].into_iter().flat_map(|t| (0..256u32).map(move |corner| (t, corner))) {
        let arrival = step.at(Interval::point(t));
        let (point, by_start) = (arrival.at.expect("the point's own"), arrival.carry(&units()));
        let side = |bit: usize| 1.0 + 0.999 * share * if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let values: [f64; TERMS] = core::array::from_fn(|k| centre[k] * side(k));
        let start = from.map(|value| value * side(TERMS));
        for (component, value) in motion(values, start, t).into_iter().enumerate() {
            let by_terms = (0..TERMS).map(|k| {
                let slope = arrival.by_forcing[k / Balls::COUNT][component].interval_at(k % Balls::COUNT);
                (slope, values[k], centre[k])
            });
            let by_start = (0..3).map(|k| (by_start[component].interval_at(k), start[k], from[k]));
            let (mut form, mut middle) = (point[component], point[component]);
            for (slope, own, centre) in by_terms.chain(by_start) {
                let off = Interval::point(own) - Interval::point(centre);
                form += slope * off;
                middle += Interval::point(slope.midpoint()) * off;
            }
            assert!(arrival.over[component].inflate(1e-12).contains(value));
            assert!(form.inflate(1e-12).contains(value), "corner {corner}, {component}: {value} outside {form:?}");
            outside += usize::from(!middle.inflate(1e-12).contains(value));
            widest = widest.max(form.width() / (value - point[component].midpoint()).abs().max(1e-3));
        }
    }
    assert!(outside > 400, "with middle slopes {outside} of 1536 were missed");
    assert!(widest < 1.0, "the form is {widest} of the deviation wide");
}

/// Whether what is enclosed holds an exponential that starts between 1 and 1.1, at the end of a step and in its middle.
fn holds_exponential(within: &StateBox, rate: f64, h: f64) -> bool {
    [0.0, 0.5 * h, h].iter().all(|t| [1.0, 1.1].iter().all(|start| within[VELOCITY].contains(start * (rate * t).exp())))
}

#[test]
fn a_long_step_of_what_is_damped_is_enclosed_and_what_grows_is_not_by_its_first_rate_alone() {
    let v = Interval::new(1.0, 1.1).expect("an interval");
    let start = [Interval::ZERO, v, Interval::ZERO];
    let linear = |rate: f64| {
        move |component: usize, state: &StateBox| match component {
            POSITION => state[VELOCITY],
            VELOCITY => Interval::point(rate) * state[VELOCITY],
            _ => Interval::ZERO,
        }
    };
    // Three times as long as the damping's own time.
    let damped = enclose(&start, Interval::point(3.0), linear(-1.0)).expect("an enclosure");
    assert!(holds_exponential(&damped, -1.0, 3.0), "{damped:?}");
    assert_eq!(damped[VELOCITY].upper(), 1.1);
    let way = 1.1 * (1.0 - (-3.0f64).exp());
    assert!(damped[POSITION].contains(way) && damped[POSITION].upper() <= 3.3 * (1.0 + 1e-12));
    let grows = enclose(&start, Interval::point(0.4), linear(1.0)).expect("an enclosure");
    assert!(holds_exponential(&grows, 1.0, 0.4), "{grows:?}");
    let by_first = v + Interval::point(0.4) * v;
    assert!(!holds_exponential(&[Interval::ZERO, v.hull(by_first), Interval::ZERO], 1.0, 0.4));
    assert!(enclose(&start, Interval::point(3.0), linear(1.0)).is_none());
}

#[test]
fn what_is_damped_is_no_larger_than_at_first_and_what_grows_is_at_least_the_exponential() {
    let h = 0.6;
    let start = [Balls::ZERO, Balls::splat(Interval::ONE), Balls::splat(Interval::ONE)];
    for (damping, lag_rate) in [(-2.0, 3.0), (-0.1, 0.0), (0.5, -0.4)] {
        let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
        // No gain: the force moves nothing.
        for (term, value) in [(FieldTerm::Gain, 0.0), (FieldTerm::LagRate, lag_rate)] {
            (terms[term as usize], active[term as usize]) = (Interval::point(value), true);
        }
        let equations = Equation::of(&VectorField { terms, active, middle_speed: 0.0 });
        let rates = Interval::new(damping - 3.0, damping).expect("an interval");
        let sizes = equations.gronwall(rates, [Sizes::ZERO; 2], &start, Interval::point(h)).expect("bounds");
        for (component, rate) in [(VELOCITY, damping), (FORCE, -lag_rate)] {
            let (size, most) = (sizes[component].interval().upper(), libm::exp(rate * h).max(1.0));
            assert!(size >= most, "{rate}: {size} for {most}");
            assert!(rate > 0.0 || size < 1.0 + 1e-12, "{rate}: {size} grew");
        }
    }
}
