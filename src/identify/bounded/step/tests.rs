use super::super::bend::Pairs;
use super::super::field::TERMS;
use super::super::mix::{By, Mix};
use super::super::series::ORDER;
use super::super::simulated::runge_kutta;
use super::*;
use crate::numeric::{Real, Sizes};

const FINE: Manner = Manner { length: 1.4, degree: Some(ORDER) };
const COARSE: Manner = Manner { degree: Some(6), ..FINE };
const CLOSED: Manner = Manner { degree: None, ..FINE };
const U: f64 = 1.0;

fn after(step: &Step, time: Interval) -> Arrival {
    step.at_all(&[time]).pop().expect("one")
}

/// An axis with quadratic drag: force over inertia and drag over inertia.
fn field(gain: Interval, quadratic: Interval) -> Field {
    let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
    for (term, value) in [(Term::Gain, gain), (Term::Quadratic, quadratic), (Term::Disturbance, Interval::ZERO)] {
        (terms[term as usize], active[term as usize]) = (value, true);
    }
    Field { terms, active, middle_speed: 0.0 }
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

fn state(v: Interval) -> Triple {
    [Interval::ZERO, v, Interval::point(U)]
}

/// Room for roundings of the closed form.
fn holds(range: Interval, value: f64) -> bool {
    range.inflate(1e-14).contains(value)
}

const CENTRE: [f64; 3] = [0.8, 0.5, 0.6];
const H_S: f64 = 0.4;

/// A step over a box about the centre, of this relative half-width, with slopes by gain, drag and the velocity at its start.
fn step(share: f64, manner: Manner) -> Box<Step> {
    let [gain, quadratic, v] = CENTRE;
    let fields = Fields {
        over: field(about(gain, share), about(quadratic, share)),
        at: field(Interval::point(gain), Interval::point(quadratic)),
    };
    let start = Pair { over: state(about(v, share)), at: state(Interval::point(v)) };
    let mixes = [By::Term(Term::Gain), By::Term(Term::Quadratic)].map(|by| Mix::of([(by, 1.0)]));
    let bundles = Bundle::of(&mixes, &[Interval::ZERO; 2]);
    let carried = Carried { bundles: &bundles, ..Carried::NOTHING };
    fields.smooth(&start, Interval::point(U), Interval::point(H_S), manner, &carried).expect("a step")
}

/// Without what is over the whole step.
fn cut(step: &mut Step, of: impl Fn(&mut Series) -> &mut Path) {
    let Form::Series(series) = &mut step.form else { panic!("a closed form") };
    let degree = series.degree;
    of(series).iter_mut().for_each(|series| series[degree] = Balls::ZERO);
}

#[test]
fn the_closed_form_is_within_a_step_and_without_the_remainder_it_is_not() {
    for manner in [FINE, COARSE] {
        let whole = step(0.0, manner);
        let mut short = whole.clone();
        cut(&mut short, |series| &mut series.state);
        let mut missed = 0;
        for part in 1..=20 {
            let t = H_S * f64::from(part) / 20.0;
            let at = after(&whole, Interval::point(t)).at.expect("the point's own");
            let short = after(&short, Interval::point(t)).at.expect("the point's own");
            for (component, value) in motion(CENTRE, t).into_iter().enumerate() {
                assert!(holds(at[component], value), "{value} outside {:?} after {t}", at[component]);
                missed += usize::from(!holds(short[component], value));
            }
        }
        assert!(missed > 5, "without the remainder {missed} of 40 were missed by {manner:?}");
    }
}

#[test]
fn the_slope_by_the_velocity_at_the_start_is_within_its_column_and_without_the_remainder_it_is_not() {
    for manner in [FINE, COARSE] {
        let whole = step(0.0, manner);
        let mut short = whole.clone();
        cut(&mut short, |series| &mut series.by_start);
        let slope = |step: &Step, t: f64| after(step, Interval::point(t)).by_start[VELOCITY][VELOCITY].interval_at(0);
        let mut missed = 0;
        for part in 1..=20 {
            let t = H_S * f64::from(part) / 20.0;
            // The derivative of the hyperbolic tangent, now and at the start.
            let [gain, quadratic, v] = CENTRE;
            let terminal = (gain * U / quadratic).sqrt();
            let left = |v: f64| 1.0 - (v / terminal) * (v / terminal);
            let exact = left(motion(CENTRE, t)[1]) / left(v);
            assert!(holds(slope(&whole, t), exact), "{exact} outside {:?} after {t}", slope(&whole, t));
            missed += usize::from(!holds(slope(&short, t), exact));
        }
        assert!(missed > 5, "without the remainder {missed} of 20 were missed by {manner:?}");
    }
}

#[test]
fn the_remainder_of_a_slope_is_no_smaller_than_what_linear_drag_leaves_out() {
    let (mut equation, rate) = (field(Interval::ONE, Interval::ZERO), 2.0);
    equation.active[Term::Quadratic as usize] = false;
    equation.terms[Term::Linear as usize] = Interval::point(rate);
    let start = Pair { over: state(Interval::ZERO), at: state(Interval::ZERO) };
    let h_s = 0.85 / rate;
    let fields = Fields { over: equation, at: equation };
    let step =
        fields.smooth(&start, Interval::point(U), Interval::point(h_s), FINE, &Carried::NOTHING).expect("a step");
    let [position, velocity, _] = after(&step, Interval::point(h_s)).by_start[VELOCITY];
    let left = (-rate * h_s).exp();
    assert!(holds(velocity.interval_at(0), left), "{left} outside {:?}", velocity.interval_at(0));
    assert!(holds(position.interval_at(0), (1.0 - left) / rate));
    // It is what counts here, and not much more than it need be.
    assert!(velocity.interval_at(0).width() > 1e-8 && velocity.interval_at(0).width() < 1e-5);
}

#[test]
fn motions_of_a_box_are_within_the_slopes_and_within_their_middles_they_are_not() {
    for manner in [FINE, CLOSED] {
        let missed = missed_by_middles(manner);
        assert!(missed > 20, "by the slopes' middles {missed} of 48 were missed by {manner:?}");
    }
}

/// How often corners of a box are missed by the middles of the slopes; by the slopes they are not.
fn missed_by_middles(manner: Manner) -> usize {
    let share = 0.05;
    let step = step(share, manner);
    let mut missed = 0;
    for part in [5, 10, 20] {
        let t = H_S * f64::from(part) / 20.0;
        let arrival = after(&step, Interval::point(t));
        let at = arrival.at.expect("the point's own");
        for corner in 0..8 {
            let sign = |bit: u32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let values: [f64; 3] = core::array::from_fn(|k| CENTRE[k] * (1.0 + 0.999 * share * sign(k as u32)));
            let start: [Balls; 3] = units();
            let by_start = arrival.carry(&start);
            for (component, value) in motion(values, t).into_iter().enumerate() {
                assert!(holds(arrival.over[component], value));
                let pushed = arrival.by_push[0][component];
                let slopes = [pushed.interval_at(0), pushed.interval_at(1), by_start[component].interval_at(VELOCITY)];
                let form = |slope: &dyn Fn(Interval) -> Interval| {
                    slopes.iter().zip(values.iter().zip(CENTRE)).fold(at[component], |sum, (own, (value, centre))| {
                        sum + slope(*own) * (Interval::point(*value) - Interval::point(centre))
                    })
                };
                assert!(holds(form(&|slope| slope), value), "{value} outside {:?}", form(&|slope| slope));
                missed += usize::from(!holds(form(&|slope| Interval::point(slope.midpoint())), value));
            }
        }
    }
    missed
}

#[test]
fn a_force_without_a_lag_stays_as_well_known_as_it_was() {
    let [gain, quadratic, v] = CENTRE;
    let equation = field(Interval::point(gain), Interval::point(quadratic));
    let at = [Interval::ZERO, Interval::point(v), about(U, 1e-3)];
    let (fields, start) = (Fields { over: equation, at: equation }, Pair { over: at, at });
    for manner in [FINE, CLOSED] {
        let step = fields.smooth(&start, Interval::point(U), Interval::point(H_S), manner, &Carried::NOTHING);
        let force = after(&step.expect("a step"), Interval::point(H_S)).at.expect("the point's own")[FORCE];
        assert!(start.at[FORCE].is_subset_of(force) && force.width() < 1.001 * start.at[FORCE].width(), "{force:?}");
    }
}

#[test]
fn a_point_may_be_outside_of_the_box_and_without_the_doubt_the_box_is_missed() {
    let [gain, quadratic, v] = CENTRE;
    // The box has more drag.
    let drag = about(1.5 * quadratic, 0.01);
    let fields = Fields {
        over: field(Interval::point(gain), drag),
        at: field(Interval::point(gain), Interval::point(quadratic)),
    };
    let short_s = 0.2;
    let start = [v, v].map(|v| state(Interval::point(v)));
    let mixes = [Mix::of([(By::Term(Term::Quadratic), 1.0)])];
    let bundles = Bundle::of(&mixes, &[drag - Interval::point(quadratic)]);
    let carried = Carried { bundles: &bundles, ..Carried::NOTHING };
    let start = Pair { over: start[0], at: start[1] };
    let step = fields.smooth(&start, Interval::point(U), Interval::point(short_s), FINE, &carried).expect("a step");
    let mut sure = step.clone();
    sure.doubt = None;
    let reached = |step: &Step, drag: f64, component: usize| {
        let arrival = after(step, Interval::point(short_s));
        let off = Interval::point(drag) - Interval::point(quadratic);
        arrival.at.expect("the point's own")[component] + arrival.by_push[0][component].interval_at(0) * off
    };
    for end in [drag.lower(), drag.upper()] {
        for (component, value) in motion([gain, end, v], short_s).into_iter().enumerate() {
            assert!(holds(reached(&step, end, component), value));
            assert!(!holds(reached(&sure, end, component), value));
        }
    }
}

/// The same step to the second order, by gain, drag and the velocity at its start; and what each can be off the centre.
fn bent_step(share: f64, h_s: f64, manner: Manner) -> (Box<Step>, Vec<Bundle>, Pairs) {
    let [gain, quadratic, v] = CENTRE;
    let fields = Fields {
        over: field(about(gain, share), about(quadratic, share)),
        at: field(Interval::point(gain), Interval::point(quadratic)),
    };
    let start = Pair { over: state(about(v, share)), at: state(Interval::point(v)) };
    let unknowns = [By::Term(Term::Gain), By::Term(Term::Quadratic), By::Start(VELOCITY)];
    let mixes = unknowns.map(|by| Mix::of([(by, 1.0)]));
    let deviations = CENTRE.map(|centre| about(centre, share) - Interval::point(centre));
    let (bundles, pairs) = (Bundle::of(&mixes, &deviations), Pairs::of(&mixes, &deviations));
    let columns: Vec<[Balls; 3]> = bundles.iter().map(|bundle| bundle.start).collect();
    let bends = vec![[Balls::ZERO; 3]; pairs.count()];
    let carried =
        Carried { bundles: &bundles, columns: &columns, pairs: Some(&pairs), bends: &bends, rest: [Interval::ZERO; 3] };
    let step = fields.smooth(&start, Interval::point(U), Interval::point(h_s), manner, &carried).expect("a step");
    assert!(step.bends());
    (step, bundles, pairs)
}

#[test]
fn the_second_derivative_by_the_velocity_at_the_start_is_within_what_bends() {
    for manner in [FINE, CLOSED] {
        second_by_velocity(manner);
    }
}

fn second_by_velocity(manner: Manner) {
    let short_s = 0.1;
    let (step, _, pairs) = bent_step(0.0, short_s, manner);
    let [gain, quadratic, v] = CENTRE;
    let square = gain * U / quadratic;
    for part in [5, 10, 20] {
        let t = short_s * f64::from(part) / 20.0;
        let arrival = after(&step, Interval::point(t));
        let bends = arrival.carry_bends(&vec![[Balls::ZERO; 3]; pairs.count()]);
        // Of the hyperbolic tangent, whose slope is 1 - w^2 over that at the start.
        let now = motion(CENTRE, t)[1];
        let left = |v: f64| 1.0 - v * v / square;
        let exact = 2.0 * left(now) * (v - now) / (square * left(v) * left(v));
        // The pair of the third unknown with itself is the sixth of all.
        let own = bends[1][VELOCITY].interval_at(1);
        assert!(holds(own, exact), "{exact} outside {own:?} after {t}");
        assert!(own.width() < 0.01 * exact.abs(), "{own:?} is {} wide", own.width());
    }
}

/// How often corners of a box are missed by the second order and its rest; without the first of them; without the second.
fn missed_by_bends(share: f64, manner: Manner) -> [usize; 3] {
    let short_s = 0.2;
    let (step, bundles, pairs) = bent_step(share, short_s, manner);
    let mut missed = [0; 3];
    for part in [5, 10, 20] {
        let t = short_s * f64::from(part) / 20.0;
        let arrival = after(&step, Interval::point(t));
        let at = arrival.at.expect("the point's own");
        let columns = arrival.carry_bundle(&bundles[0].start, 0);
        let bends = arrival.carry_bends(&vec![[Balls::ZERO; 3]; pairs.count()]);
        let rest = arrival.carry_rest(&[Interval::ZERO; 3]);
        for corner in 0..8 {
            let sign = |bit: u32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
            let values: [f64; 3] = core::array::from_fn(|k| CENTRE[k] * (1.0 + 0.999 * share * sign(k as u32)));
            let off: [Interval; 3] = core::array::from_fn(|k| Interval::point(values[k]) - Interval::point(CENTRE[k]));
            for (component, value) in motion(values, t).into_iter().enumerate() {
                let first = (0..3).fold(at[component], |sum, k| sum + columns[component].interval_at(k) * off[k]);
                let mut second = first;
                for (index, (i, j)) in [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)].into_iter().enumerate() {
                    let bend = bends[index / Balls::COUNT][component].interval_at(index % Balls::COUNT);
                    let product = if i == j { off[i].square() * Interval::point(0.5) } else { off[i] * off[j] };
                    second += bend * product;
                }
                let forms = [second + rest[component], first + rest[component], second];
                for (missed, form) in missed.iter_mut().zip(forms) {
                    *missed += usize::from(!holds(form, value));
                }
            }
        }
    }
    missed
}

#[test]
fn motions_of_a_box_are_within_the_second_order_and_its_rest_and_without_either_they_are_not() {
    for manner in [FINE, CLOSED] {
        let [whole, straight, _] = missed_by_bends(0.01, manner);
        assert_eq!(whole, 0);
        assert!(straight > 12, "without the second order {straight} of 48 were missed by {manner:?}");
        let [whole, _, restless] = missed_by_bends(0.2, manner);
        assert_eq!(whole, 0);
        assert!(restless > 12, "without the rest {restless} of 48 were missed by {manner:?}");
    }
}

/// Whether what is enclosed holds an exponential that starts between 1 and 1.1, at the end of a step and in its middle.
fn holds_exponential(within: &Triple, rate: f64, h: f64) -> bool {
    [0.0, 0.5 * h, h].iter().all(|t| [1.0, 1.1].iter().all(|start| within[VELOCITY].contains(start * (rate * t).exp())))
}

#[test]
fn a_long_step_of_what_is_damped_is_enclosed_and_what_grows_is_not_by_its_first_rate_alone() {
    let v = Interval::new(1.0, 1.1).expect("an interval");
    let start = [Interval::ZERO, v, Interval::ZERO];
    let linear = |rate: f64| {
        move |component: usize, state: &Triple| match component {
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
fn what_a_motion_passes_is_enclosed_whether_it_is_damped_or_grows() {
    let rest = |linear: f64, quadratic: f64| {
        let mut equation = field(Interval::ONE, Interval::point(quadratic));
        equation.active[Term::Linear as usize] = true;
        equation.terms[Term::Linear as usize] = Interval::point(linear);
        equation
    };
    let h_s = 0.4;
    for (linear, quadratic, v) in
        [(1.5, 0.0, 0.2), (-1.5, 0.0, 0.2), (0.3, 0.8, 0.1), (-0.5, 0.4, 0.3), (0.2, 0.5, 1.9)]
    {
        let start = [Interval::ZERO, Interval::new(v, v + 0.1).expect("an interval"), Interval::point(U)];
        let within =
            rest(linear, quadratic).passed(&start, Interval::point(U), Interval::point(h_s)).expect("an enclosure");
        let mut fastest = 0.0f64;
        for from in [v, v + 0.05, v + 0.1] {
            let rate = |[_, v]: [f64; 2]| [v, U - linear * v - quadratic * v * v];
            let mut state = [0.0, from];
            for _ in 0..100 {
                state = runge_kutta(state, h_s / 100.0, rate);
                assert!(holds(within[POSITION], state[0]) && holds(within[VELOCITY], state[1]), "{state:?} outside");
                fastest = fastest.max(state[1]);
            }
        }
        // Of what grows the first rate at the fastest end is not enough.
        let by_first = v + 0.1 + h_s * (U - linear * (v + 0.1) - quadratic * (v + 0.1) * (v + 0.1));
        assert_eq!(fastest > by_first.max(v + 0.1), linear < 0.0, "{fastest}, {by_first}");
    }
}

#[test]
fn what_is_damped_is_no_larger_than_at_first_and_what_grows_is_at_least_the_exponential() {
    let h = 0.6;
    let start = [Balls::ZERO, Balls::splat(Interval::ONE), Balls::splat(Interval::ONE)];
    for (damping, lag_rate) in [(-2.0, 3.0), (-0.1, 0.0), (0.5, -0.4)] {
        let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
        // No gain: the force moves nothing.
        for (term, value) in [(Term::Gain, 0.0), (Term::LagRate, lag_rate)] {
            (terms[term as usize], active[term as usize]) = (Interval::point(value), true);
        }
        let equations = Equations::of(&Field { terms, active, middle_speed: 0.0 }, ORDER);
        let rates = Interval::new(damping - 3.0, damping).expect("an interval");
        let sizes = equations.sizes(rates, [Sizes::ZERO; 2], &start, Interval::point(h)).expect("bounds");
        for (component, rate) in [(VELOCITY, damping), (FORCE, -lag_rate)] {
            let (size, most) = (sizes[component].interval().upper(), libm::exp(rate * h).max(1.0));
            assert!(size >= most, "{rate}: {size} for {most}");
            assert!(rate > 0.0 || size < 1.0 + 1e-12, "{rate}: {size} grew");
        }
    }
}
