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

/// What the classical method leaves.
const MISSED: f64 = 1e-10;

impl Case {
    fn random(source: &mut Pcg64Mcg) -> Self {
        let mut pick = |low: f64, high: f64| source.random_range(low..high);
        let sign = if pick(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let c = sign * libm::pow(10.0, pick(-4.0, 0.5));
        Self { coefficients: [pick(-1.5, 1.5), pick(-0.5, 2.0), c], v: sign * pick(0.0, 1.5), t: pick(0.01, 1.0) }
    }

    /// Position and velocity, and their slopes by a, b, c and the start, by the classical method of Runge and Kutta.
    fn passed(&self) -> [[f64; 2]; 5] {
        const STEPS: usize = 400;
        let [a, b, c] = self.coefficients;
        let rate = |s: [f64; 10]| {
            let v = s[1];
            let by = |k: usize, push: f64| (-b - 2.0 * c * v) * s[k] + push;
            [v, a - b * v - c * v * v, s[3], by(3, 1.0), s[5], by(5, -v), s[7], by(7, -v * v), s[9], by(9, 0.0)]
        };
        let mut state = [0.0, self.v, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        for _ in 0..STEPS {
            state = runge_kutta(state, self.t / STEPS as f64, rate);
        }
        core::array::from_fn(|k| [state[2 * k], state[2 * k + 1]])
    }

    /// How these slopes bend by each other, by the same method: for position and velocity.
    fn bent(&self) -> [[f64; 2]; PAIRS.len()] {
        const STEPS: usize = 400;
        const SLOPES: usize = 2;
        const BENDS: usize = SLOPES + 8;
        let [a, b, c] = self.coefficients;
        let rate = |s: [f64; BENDS + 2 * PAIRS.len()]| {
            let (v, mut rates) = (s[1], [0.0; BENDS + 2 * PAIRS.len()]);
            let damping = -b - 2.0 * c * v;
            // By a, b, c and the start: what pushes, and by how much the velocity changes that.
            let (pushed, by_v) = ([1.0, -v, -v * v, 0.0], [0.0, -1.0, -2.0 * v, 0.0]);
            (rates[0], rates[1]) = (v, a - b * v - c * v * v);
            let slope = |p: usize| s[SLOPES + 2 * p + 1];
            for p in 0..4 {
                rates[SLOPES + 2 * p] = slope(p);
                rates[SLOPES + 2 * p + 1] = damping * slope(p) + pushed[p];
            }
            for (pair, [p, q]) in PAIRS.into_iter().enumerate() {
                let own = s[BENDS + 2 * pair + 1];
                let bent = by_v[p] * slope(q) + by_v[q] * slope(p) - 2.0 * c * slope(p) * slope(q);
                rates[BENDS + 2 * pair] = own;
                rates[BENDS + 2 * pair + 1] = damping * own + bent;
            }
            rates
        };
        let mut state = [0.0; BENDS + 2 * PAIRS.len()];
        (state[1], state[SLOPES + 7]) = (self.v, 1.0);
        for _ in 0..STEPS {
            state = runge_kutta(state, self.t / STEPS as f64, rate);
        }
        core::array::from_fn(|pair| [state[BENDS + 2 * pair], state[BENDS + 2 * pair + 1]])
    }

    /// The same by the closed form, of a start that is that far off.
    fn bends(&self, off: f64) -> Option<[[Interval; 2]; PAIRS.len()]> {
        let unknowns = [Term::Disturbance, Term::Linear, Term::Quadratic].map(By::Term);
        let mixes: Vec<Mix> =
            unknowns.into_iter().chain([By::Start(VELOCITY)]).map(|by| Mix::of([(by, 1.0)])).collect();
        let closed = self.closed(off, &mixes);
        let t = Interval::point(self.t);
        if !closed.suffices(t, self.v.abs() + 1.5 * self.t) {
            return None;
        }
        let Values { bends, .. } = closed.values(&[t]).pop().expect("one");
        // Each with those before it and itself; the third is drag backwards.
        let sign = |k: usize| if k == C && self.coefficients[2] < 0.0 { -1.0 } else { 1.0 };
        Some(PAIRS.map(|[p, q]| {
            let place = q * (q + 1) / 2 + p;
            let sign = Interval::point(sign(p) * sign(q));
            [POSITION, VELOCITY].map(|k| sign * bends[place / Balls::COUNT][k].interval_at(place % Balls::COUNT))
        }))
    }

    /// With a start that far off, of which the velocity's is the middle, and what moves and bends it.
    fn closed(&self, off: f64, mixes: &[Mix]) -> Closed {
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
        let deviations = vec![Interval::ZERO; mixes.len()];
        let (bundles, pairs) = (Bundle::of(mixes, &deviations), Pairs::of(mixes, &deviations));
        let columns: Vec<_> = bundles.iter().map(|bundle| bundle.start).collect();
        let carried = Carried { bundles: &bundles, columns: &columns, pairs: Some(&pairs), ..Carried::NOTHING };
        Closed::of(&field, [&start[0], &start[1]], Interval::ZERO, c < 0.0, &carried)
    }

    /// The same as [`Self::passed`]; `None` where the series do not suffice.
    fn at(&self, off: f64) -> Option<[[Interval; 2]; 5]> {
        let by = [Term::Disturbance, Term::Linear, Term::Quadratic].map(|term| Mix::of([(By::Term(term), 1.0)]));
        let (closed, t) = (self.closed(off, &by), Interval::point(self.t));
        if !closed.suffices(t, self.v.abs() + 1.5 * self.t) {
            return None;
        }
        // More than four, of which it is not the first.
        let times = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.5].map(|share| Interval::point(share * self.t));
        let Values { state, by_start, by_push, .. } = closed.values(&times).swap_remove(5);
        let own = |balls: [Balls; 3], place: usize| [balls[0].interval_at(place), balls[1].interval_at(place)];
        let backwards = self.coefficients[2] < 0.0;
        let by_c = own(by_push[0], 2).map(|slope| if backwards { -slope } else { slope });
        Some([own(state, 0), own(by_push[0], 0), own(by_push[0], 1), by_c, own(by_start, 1)])
    }
}

fn near(range: Interval, value: f64) -> bool {
    range.inflate(MISSED * (1.0 + value.abs())).contains(value)
}

#[test]
fn state_and_slopes_are_those_of_the_motion_in_both_directions() {
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
        for (own, exact) in at.into_iter().zip(exact) {
            for k in 0..2 {
                assert!(near(own[k], exact[k]), "{case:?}: {} outside {:?}", exact[k], own[k]);
            }
        }
        // What divides by c loses so many digits, and no more.
        let [_, _, c] = case.coefficients;
        for (k, own) in at.iter().enumerate() {
            let most = if k == 3 { 1e-13 / c.abs() } else { 0.0 } + 2e-13;
            assert!(own.iter().all(|own| own.width() < most), "{case:?}: {k} is {own:?}");
        }
    }
    assert!(seen.iter().all(|seen| *seen > 300), "{seen:?} of 1500 were seen");
}

#[test]
fn bends_are_those_of_the_motion_in_both_directions() {
    let mut source = Pcg64Mcg::seed_from_u64(7);
    let mut seen = [0; 2];
    for _ in 0..1500 {
        let case = Case::random(&mut source);
        let [_, _, c] = case.coefficients;
        // Still with one sign.
        if !(case.passed()[0][1] * case.v > 0.0) {
            continue;
        }
        let Some(bends) = case.bends(0.0) else { continue };
        seen[usize::from(case.v < 0.0)] += 1;
        for ((pair, own), exact) in PAIRS.into_iter().zip(bends).zip(case.bent()) {
            for k in 0..2 {
                assert!(near(own[k], exact[k]), "{case:?}: {pair:?}: {} outside {:?}", exact[k], own[k]);
            }
            // The way is divided by c once for each side by it.
            let sides = pair.into_iter().filter(|side| *side == C).count() as i32;
            let most = 2e-12 + 3e-13 / c.abs().powi(sides);
            assert!(own.iter().all(|own| own.width() < most), "{case:?}: {pair:?} is {own:?}");
        }
    }
    assert!(seen.iter().all(|seen| *seen > 300), "{seen:?} of 1500 were seen");
}

#[test]
fn bends_are_those_from_all_of_the_start_and_from_its_middle_alone_they_are_not() {
    let mut source = Pcg64Mcg::seed_from_u64(8);
    let (off, mut missed) = (1e-4, 0);
    for _ in 0..100 {
        let case = Case::random(&mut source);
        let Some((wide, thin)) = case.bends(off).zip(case.bends(0.0)) else { continue };
        for v in [case.v - 0.99 * off, case.v + 0.99 * off] {
            let other = Case { v, ..case };
            if !(other.passed()[0][1] * case.v > 0.0 && v * case.v > 0.0) {
                continue;
            }
            for ((wide, thin), exact) in wide.into_iter().zip(thin).zip(other.bent()) {
                for k in 0..2 {
                    assert!(near(wide[k], exact[k]), "{case:?}: {} outside {:?}", exact[k], wide[k]);
                    missed += usize::from(!near(thin[k], exact[k]));
                }
            }
        }
    }
    assert!(missed > 500, "from the middle alone {missed} were missed");
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
    let [exact, _, by_b, by_c, _] = case.passed();
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
fn slopes_are_those_from_all_of_the_start_and_from_its_middle_alone_they_are_not() {
    let mut source = Pcg64Mcg::seed_from_u64(6);
    let (off, mut missed) = (1e-4, 0);
    for _ in 0..300 {
        let case = Case::random(&mut source);
        let Some((wide, thin)) = case.at(off).zip(case.at(0.0)) else { continue };
        for v in [case.v - 0.99 * off, case.v + 0.99 * off] {
            let exact = Case { v, ..case }.passed();
            if !(exact[0][1] * case.v > 0.0 && v * case.v > 0.0) {
                continue;
            }
            for part in 1..5 {
                for k in 0..2 {
                    assert!(near(wide[part][k], exact[part][k]), "{case:?}: {part}, {k}");
                    missed += usize::from(!near(thin[part][k], exact[part][k]));
                }
            }
        }
    }
    assert!(missed > 1000, "from the middle alone {missed} were missed");
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
