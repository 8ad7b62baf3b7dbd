use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::super::super::bend::Pairs;
use super::super::super::field::TERMS;
use super::super::super::mix::{By, Mix};
use super::super::super::simulated::runge_kutta;
use super::*;
use crate::numeric::Real;

/// An equation by its three coefficients, a velocity at the start, and a time.
#[derive(Clone, Copy, Debug)]
struct Case {
    coefficients: [f64; 3],
    v: f64,
    t: f64,
}

/// Position and velocity, their slopes by a, b, c and the start, and how these bend, by pairs.
type Passed<T> = [[T; 2]; VALUES];
const SLOPES: usize = 1;
const BENDS: usize = SLOPES + 4;
const VALUES: usize = BENDS + PAIRS.len();

/// What the classical method leaves.
const MISSED: f64 = 1e-10;

impl Case {
    fn random(source: &mut Pcg64Mcg) -> Self {
        let mut pick = |low: f64, high: f64| source.random_range(low..high);
        let sign = if pick(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let c = sign * libm::pow(10.0, pick(-4.0, 0.5));
        Self { coefficients: [pick(-1.5, 1.5), pick(-0.5, 2.0), c], v: sign * pick(0.0, 1.5), t: pick(0.01, 1.0) }
    }

    /// By the classical method of Runge and Kutta.
    fn passed(&self) -> Passed<f64> {
        const STEPS: usize = 400;
        let [a, b, c] = self.coefficients;
        let rate = |s: [f64; 2 * VALUES]| {
            let (v, mut rates) = (s[1], [0.0; 2 * VALUES]);
            let velocity = |value: usize| s[2 * value + 1];
            let damping = -b - 2.0 * c * v;
            // By a, b, c and the start: what pushes, and by how much the velocity changes that.
            let (pushed, by_v) = ([1.0, -v, -v * v, 0.0], [0.0, -1.0, -2.0 * v, 0.0]);
            let slope = |p: usize| velocity(SLOPES + p);
            let mut go = |value: usize, rate: f64| (rates[2 * value], rates[2 * value + 1]) = (velocity(value), rate);
            go(0, a - b * v - c * v * v);
            for (p, pushed) in pushed.into_iter().enumerate() {
                go(SLOPES + p, damping * slope(p) + pushed);
            }
            for (pair, [p, q]) in PAIRS.into_iter().enumerate() {
                let bent = by_v[p] * slope(q) + by_v[q] * slope(p) - 2.0 * c * slope(p) * slope(q);
                go(BENDS + pair, damping * velocity(BENDS + pair) + bent);
            }
            rates
        };
        let mut state = [0.0; 2 * VALUES];
        (state[1], state[2 * (SLOPES + V) + 1]) = (self.v, 1.0);
        for _ in 0..STEPS {
            state = runge_kutta(state, self.t / STEPS as f64, rate);
        }
        core::array::from_fn(|value| [state[2 * value], state[2 * value + 1]])
    }

    /// By the closed form, of a start that far off, of which the velocity's is the middle; `None` where the series do not suffice.
    fn at(&self, off: f64) -> Option<Passed<Interval>> {
        let [a, b, c] = self.coefficients;
        let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
        for (term, value) in [(Term::Disturbance, a), (Term::Linear, b), (Term::Quadratic, c.abs())] {
            (terms[term as usize], active[term as usize]) =
                (Interval::point(value), value != 0.0 || term == Term::Linear);
        }
        let field = Field { terms, active, middle_speed: 0.0 };
        assert!(Closed::exists(&field));
        let state = |v: Interval| [Interval::ZERO, v, Interval::ZERO];
        let start = [0.0, off].map(|off| state(Interval::point(self.v).inflate(off)));
        let by = [Term::Disturbance, Term::Linear, Term::Quadratic].map(By::Term);
        let mixes: Vec<Mix> = by.into_iter().chain([By::Start(VELOCITY)]).map(|by| Mix::of([(by, 1.0)])).collect();
        let deviations = vec![Interval::ZERO; mixes.len()];
        let (bundles, pairs) = (Bundle::of(&mixes, &deviations), Pairs::of(&mixes, &deviations));
        let columns: Vec<_> = bundles.iter().map(|bundle| bundle.start).collect();
        let carried = Carried { bundles: &bundles, columns: &columns, pairs: Some(&pairs), ..Carried::NOTHING };
        let closed = Closed::of(&field, [&start[0], &start[1]], Interval::ZERO, c < 0.0, &carried);
        let t = Interval::point(self.t);
        if !closed.suffices(t, self.v.abs() + 1.5 * self.t) {
            return None;
        }
        // More than four, of which it is not the first.
        let times = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.5].map(|share| Interval::point(share * self.t));
        let Values { state, by_start, by_push, bends } = closed.values(&times).swap_remove(5);
        let own = |balls: &[Balls; 3], place: usize| [POSITION, VELOCITY].map(|k| balls[k].interval_at(place));
        // The third is drag backwards.
        let sign = |k: usize| Interval::point(if k == C && c < 0.0 { -1.0 } else { 1.0 });
        Some(core::array::from_fn(|value| match value {
            0 => own(&state, 0),
            SLOPES..BENDS => {
                let p = value - SLOPES;
                let slopes = if p == V { own(&by_start, VELOCITY) } else { own(&by_push[0], p) };
                slopes.map(|slope| sign(p) * slope)
            }
            _ => {
                // Each with those before it and itself.
                let [p, q] = PAIRS[value - BENDS];
                let place = q * (q + 1) / 2 + p;
                let bends = own(&bends[place / Balls::COUNT], place % Balls::COUNT);
                bends.map(|bend| sign(p) * sign(q) * bend)
            }
        }))
    }
}

fn near(range: Interval, value: f64) -> bool {
    range.inflate(MISSED * (1.0 + value.abs())).contains(value)
}

#[test]
fn state_slopes_and_bends_are_those_of_the_motion_in_both_directions() {
    let mut source = Pcg64Mcg::seed_from_u64(5);
    let mut seen = [0; 2];
    for _ in 0..1500 {
        let case = Case::random(&mut source);
        let exact = case.passed();
        // The velocity has one sign.
        if !(exact[0][1] * case.v > 0.0) {
            continue;
        }
        let Some(at) = case.at(0.0) else { continue };
        seen[usize::from(case.v < 0.0)] += 1;
        for (value, (own, exact)) in at.into_iter().zip(exact).enumerate() {
            for k in 0..2 {
                assert!(near(own[k], exact[k]), "{case:?}: {value}: {} outside {:?}", exact[k], own[k]);
            }
        }
        // What divides by c, once for each side that is by it, loses so many digits, and no more.
        let [_, _, c] = case.coefficients;
        for (value, own) in at.iter().enumerate() {
            let by_c = match value {
                0 => 0,
                SLOPES..BENDS => i32::from(value - SLOPES == C),
                _ => PAIRS[value - BENDS].into_iter().filter(|side| *side == C).count() as i32,
            };
            let most = if value < BENDS { 2e-13 } else { 2e-12 } + 3e-13 / c.abs().powi(by_c);
            assert!(own.iter().all(|own| own.width() < most), "{case:?}: {value} is {own:?}");
        }
    }
    assert!(seen.iter().all(|seen| *seen > 300), "{seen:?} of 1500 were seen");
}

#[test]
fn drag_about_a_middle_speed_is_the_same_motion_as_about_none() {
    // The linear term is that at the middle speed: less by twice the quadratic one's times the speed.
    let (a, linear, quadratic, middle_speed, v, t) = (0.9, 0.7, 0.8, 0.3, 0.4, 0.5);
    let case = Case { coefficients: [a, linear - 2.0 * middle_speed * quadratic, quadratic], v, t };
    let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
    for (term, value) in [(Term::Disturbance, a), (Term::Linear, linear), (Term::Quadratic, quadratic)] {
        (terms[term as usize], active[term as usize]) = (Interval::point(value), true);
    }
    let field = Field { terms, active, middle_speed };
    let start = [Interval::ZERO, Interval::point(v), Interval::ZERO];
    let by = [Term::Linear, Term::Quadratic].map(|term| Mix::of([(By::Term(term), 1.0)]));
    let bundles = Bundle::of(&by, &[Interval::ZERO; 2]);
    let carried = Carried { bundles: &bundles, ..Carried::NOTHING };
    let closed = Closed::of(&field, [&start, &start], Interval::ZERO, false, &carried);
    let Values { state, by_push, .. } = closed.values(&[Interval::point(t)]).pop().expect("one");
    let [exact, _, by_b, by_c, ..] = case.passed();
    for k in 0..2 {
        let [of_linear, of_quadratic] = [0, 1].map(|place| by_push[0][k].interval_at(place));
        assert!(near(state[k].interval_at(0), exact[k]), "{:?} for {}", state[k], exact[k]);
        assert!(near(of_linear, by_b[k]) && near(of_quadratic, by_c[k] - 2.0 * middle_speed * by_b[k]), "{k}");
    }
}

#[test]
fn without_quadratic_drag_it_is_the_exponential_and_without_any_the_parabola() {
    for b in [0.0, 0.7, -0.4] {
        let case = Case { coefficients: [0.9, b, 0.0], v: 0.3, t: 0.8 };
        let [state, by_a, ..] = case.at(0.0).expect("enough terms");
        let (left, held) =
            if b == 0.0 { (1.0, case.t) } else { (libm::exp(-b * case.t), -libm::expm1(-b * case.t) / b) };
        let way = if b == 0.0 { 0.5 * case.t * case.t } else { (case.t - held) / b };
        let exact = [case.v * held + 0.9 * way, case.v * left + 0.9 * held];
        for (own, exact) in state.into_iter().zip(exact).chain(by_a.into_iter().zip([way, held])) {
            assert!(own.inflate(1e-15).contains(exact) && own.width() < 1e-13, "{b}: {exact} for {own:?}");
        }
    }
}

#[test]
fn slopes_and_bends_are_those_from_all_of_the_start_and_from_its_middle_alone_they_are_not() {
    let mut source = Pcg64Mcg::seed_from_u64(6);
    let (off, mut missed) = (1e-4, [0; 2]);
    for _ in 0..300 {
        let case = Case::random(&mut source);
        let Some((wide, thin)) = case.at(off).zip(case.at(0.0)) else { continue };
        for v in [case.v - 0.99 * off, case.v + 0.99 * off] {
            let exact = Case { v, ..case }.passed();
            if !(exact[0][1] * case.v > 0.0 && v * case.v > 0.0) {
                continue;
            }
            for value in SLOPES..VALUES {
                for k in 0..2 {
                    assert!(near(wide[value][k], exact[value][k]), "{case:?}: {value}, {k}");
                    missed[usize::from(value >= BENDS)] += usize::from(!near(thin[value][k], exact[value][k]));
                }
            }
        }
    }
    assert!(missed.iter().all(|missed| *missed > 1000), "from the middle alone {missed:?} were missed");
}

#[test]
fn what_a_series_leaves_out_is_counted_and_without_it_it_misses() {
    // More than is put into it, so that it shows.
    let w = 60.0;
    let cosine = nested(Balls::splat(Interval::point(w)), |k| (2 * k - 1) * 2 * k).interval_at(0);
    let exact = libm::cosh(libm::sqrt(w));
    assert!(cosine.contains(exact), "{exact} for {cosine:?}");
    assert!((cosine.midpoint() - exact).abs() > 1e-9 * exact);
    // Of the others it is constant: no less than a geometric series behind their first term.
    let first = (1..=2 * SERIES_TERMS).fold(SERIES_TERMS as f64, |term, k| term / k as f64)
        * libm::pow(MOST_Z, SERIES_TERMS as f64 - 1.0);
    assert!(1.1 * first < LEFT_OUT, "{first}");
    assert!(libm::pow(libm::tanh(0.5 * MOST_WAY), 2.0) < MOST_SQUARE);
}

#[test]
fn differences_are_divided_where_there_is_none_and_where_there_is() {
    let (point, root) = (|value: f64| Balls::splat(Interval::point(value)), libm::sqrt(MOST_Z));
    let [cosine, sine] = divided(point(MOST_Z), point(MOST_Z)).map(|own| own.interval_at(0));
    let exact = [libm::sinh(root) / (2.0 * root), (root * libm::cosh(root) - libm::sinh(root)) / (2.0 * root * MOST_Z)];
    assert!(cosine.inflate(1e-15).contains(exact[0]) && sine.inflate(1e-15).contains(exact[1]), "{cosine:?}, {sine:?}");
    let [cosine, sine] = divided(point(-MOST_Z), point(MOST_Z)).map(|own| own.interval_at(0));
    let exact = [
        (libm::cosh(root) - libm::cos(root)) / (2.0 * MOST_Z),
        (libm::sinh(root) - libm::sin(root)) / (2.0 * MOST_Z * root),
    ];
    assert!(cosine.inflate(1e-15).contains(exact[0]) && sine.inflate(1e-15).contains(exact[1]), "{cosine:?}, {sine:?}");
}

#[test]
fn the_area_tangent_is_enclosed_as_far_as_its_series_goes() {
    for w in [0.0, 0.1, -0.3, 0.4621] {
        let own = area(Balls::splat(Interval::point(w))).interval_at(0);
        let exact = if w == 0.0 { 1.0 } else { libm::atanh(w) / w };
        assert!(own.inflate(1e-15).contains(exact) && own.width() < 1e-14, "{w}: {exact} for {own:?}");
    }
    assert!(!area(Balls::splat(Interval::point(0.47))).interval_at(0).is_bounded());
}

#[test]
fn where_a_series_needs_more_terms_it_says_so() {
    let case = |coefficients: [f64; 3], t: f64| Case { coefficients, v: 0.5, t }.at(0.0).is_some();
    assert!(case([0.0, 1.0, 1e-3], 3.0) && !case([0.0, 1.0, 1e-3], 3.3));
    assert!(case([0.5, 0.0, 1.0], 0.6) && !case([0.5, 0.0, 1.0], 0.8));
}

#[test]
fn other_terms_have_no_closed_form_nor_has_a_drag_that_may_be_none() {
    let field = |terms: &[(Term, f64)]| {
        let (mut all, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
        terms.iter().for_each(|(term, value)| {
            (all[*term as usize], active[*term as usize]) = (Interval::point(*value), true);
        });
        Closed::exists(&Field { terms: all, active, middle_speed: 0.0 })
    };
    assert!(field(&[(Term::Gain, 1.0), (Term::Linear, 1.0)]) && field(&[(Term::Gain, 1.0), (Term::Quadratic, 1.0)]));
    for term in [Term::Cubic, Term::Stiffness, Term::LagRate] {
        assert!(!field(&[(Term::Gain, 1.0), (Term::Linear, 1.0), (term, 1.0)]));
    }
    assert!(!field(&[(Term::Gain, 1.0), (Term::Quadratic, 0.0)]));
}
