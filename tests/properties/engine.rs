//! Falsehoods made for the engine: each test states which weakening of it would let them through.

use selfosc::describing::KernelForm;
use selfosc::numeric::special::Special;
use selfosc::numeric::{Interval, Real};
use selfosc::orbit::theorem::{self, Theorem};
use selfosc::orbit::{certify, quadratic_half_cycle};
use selfosc::plant::DragAxis;
use selfosc::proof::branch_and_bound::prove_positive;
use selfosc::proof::enclosure::{Roots, newton};
use selfosc::proof::identity::{IdentityJet, prove_zero, prove_zero_of_two};
use selfosc::proof::inequality::Inequality;
use selfosc::proof::margin::Margin;
use selfosc::proof::margin::VariableBox;
use selfosc::proof::{Change, Gradient, NotProved, formula};

use crate::tolerance::{CENTRAL_DIFFERENCE, ROUNDING};

/// Places of the interpolation's nodes on `[-1, 1]`.
const NODES: usize = 14;

fn node(k: usize) -> f64 {
    (core::f64::consts::PI * (k as f64 + 0.5) / NODES as f64).cos()
}

/// The polynomial that vanishes at every node, one at both ends.
fn between_the_nodes<T: Real>(x: T) -> T {
    let (mut before, mut last) = (T::one(), x);
    for _ in 1..NODES {
        (before, last) = (last, T::two() * x * last - before);
    }
    last
}

fn tried_on_a_square<F: Fn(IdentityJet, IdentityJet) -> IdentityJet, G: Fn(Interval, Interval) -> Interval>(
    f: G,
    g: F,
    tolerance: f64,
) -> bool {
    prove_zero_of_two(|a, b| [f(a, b)], |a, b| [g(a, b)], [[-1.0, 1.0], [-1.0, 1.0]], tolerance, 2000).is_ok()
}

macro_rules! tried {
    (|$a:ident, $b:ident| $value:expr, $tolerance:expr) => {
        tried_on_a_square(|$a, $b| $value, |$a, $b| $value, $tolerance)
    };
}

fn times<T: Real>(factor: f64, x: T) -> T {
    T::from_f64(factor) * x
}

/// Without the remainders, or with a node polynomial too small, the nodes alone would decide.
#[test]
fn what_vanishes_at_the_nodes_is_seen_between_them() {
    assert!(!tried!(|a, b| times(2e-9, between_the_nodes(a)) + times(0.0, b), 1e-9));
    assert!(!tried!(|a, b| times(2e-9, between_the_nodes(b)) + times(0.0, a), 1e-9));
    // The remainder is zero on the line through the middle, and nowhere else.
    assert!(!tried!(|a, b| times(2e-9, between_the_nodes(a) * b), 1e-9));
    assert!(!tried!(|a, b| times(2e-9, between_the_nodes(b) * a), 1e-9));
    assert!(tried!(|a, b| times(1e-11, between_the_nodes(a) * b), 1e-9));
}

/// The polynomial of the lowest degree with these values at the nodes.
fn through_the_nodes<T: Real>(x: T, values: [f64; NODES]) -> T {
    let term = |k: usize| {
        let others = (0..NODES).filter(|&j| j != k);
        others.fold(T::from_f64(values[k]), |product, j| {
            product * (x - T::from_f64(node(j))) / T::from_f64(node(k) - node(j))
        })
    };
    (0..NODES).fold(T::zero(), |sum, k| sum + term(k))
}

/// A small constant for what an interpolation makes of its nodes' values would prove this.
#[test]
fn an_interpolation_exceeds_its_nodes() {
    // Of the sign that makes the value at one the largest.
    let values = core::array::from_fn(|k| {
        let basis =
            (0..NODES).filter(|&j| j != k).fold(1.0, |product, j| product * (1.0 - node(j)) / (node(k) - node(j)));
        basis.signum()
    });
    let largest = through_the_nodes(1.0_f64, values).powi(2);
    assert!(largest > 6.5, "{largest}");
    // At the nodes up to the tolerance itself, and beyond it between them.
    for share in [0.8, 0.3, 0.16] {
        let tolerance = share * largest * 1e-9;
        assert!(!tried!(|a, b| times(1e-9, through_the_nodes(a, values) * through_the_nodes(b, values)), tolerance));
    }
}

/// A cell that reaches over a kink by a little has both its sides.
#[test]
fn a_kink_is_seen_from_either_side() {
    let over = |from: f64, to: f64| IdentityJet::variable(Interval::new(from, to).unwrap());
    let slope = over(-5e-10, 0.1).abs().coefficients()[1];
    assert!(slope.contains(-1.0) && slope.contains(1.0), "{slope}");
    let step = over(-0.001, 0.002).select(|| IdentityJet::from_f64(-1.0), IdentityJet::one).value();
    assert!(step.contains(-1.0) && step.contains(1.0), "{step}");
}

fn square_of<T: Real>([x, ..]: [T; 3]) -> T {
    x.square()
}

/// The slope of a square over a cell whose middle is not the vertex.
#[test]
fn a_slope_is_that_of_the_whole_cell() {
    let cell = [Interval::new(-1.0, 3.0).unwrap(), Interval::ZERO, Interval::ZERO];
    let slope = Margin::Slope { of: formula!(square_of), by: 0 }.over(&cell);
    assert!(slope.contains(-2.0) && slope.contains(6.0), "{slope}");
}

/// A disturbance as large as the relay's level leaves the drag alone to brake.
#[test]
fn braking_by_drag_alone() {
    let lost = theorem::BRAKING.margin.formula().unwrap();
    for drag in [0.0, 0.3, 1.0] {
        let at = [1.0, drag, 0.0].map(Interval::point);
        assert_eq!((lost.interval)(at), Interval::point(-drag));
    }
}

/// Zero with fourteen derivatives in the middle, a millionth at the ends.
#[test]
fn a_remainder_is_taken_over_the_whole_cell() {
    let flat =
        |height: f64| move |t: IdentityJet| [times(height, (0..20).fold(IdentityJet::one(), |power, _| power * t))];
    assert!(prove_zero(flat(1e-6), -1.0, 1.0, 1e-9, 5000).is_err());
    assert!(prove_zero(flat(1e-10), -1.0, 1.0, 1e-9, 5000).is_ok());
}

/// A bump on a thousandth of the domain, and a ripple.
#[test]
fn local_falsehoods_are_not_proved() {
    for at in [0.3, 0.123_456, 0.999_9] {
        let bump = |t: IdentityJet| {
            let away = (t - IdentityJet::from_f64(at)) * IdentityJet::from_f64(2000.0);
            [times(1e-6, IdentityJet::one() / (IdentityJet::one() + away.square() * away.square()))]
        };
        assert!(prove_zero(bump, 0.0, 1.0, 1e-9, 20_000).is_err(), "{at}");
        let dip = |[x]: &[Interval; 1]| {
            let away = (*x - Interval::point(at)) * Interval::point(2000.0);
            Interval::point(1e-6) - times(1.000_001e-6, Interval::ONE / (Interval::ONE + away.square()))
        };
        assert!(prove_positive(dip, [Interval::new(0.0, 1.0).unwrap()], 20_000).is_err(), "{at}");
    }
    let ripple = |t: IdentityJet| [times(1e-6, (t * IdentityJet::from_f64(1e4)).sin())];
    assert!(prove_zero(ripple, 0.0, 1.0, 1e-9, 20_000).is_err());
    let rippled = |[x]: &[Interval; 1]| Interval::ONE + times(1.000_001, (*x * Interval::point(1e4)).sin());
    assert!(prove_positive(rippled, [Interval::new(0.0, 1.0).unwrap()], 20_000).is_err());
    assert!(
        tried!(|a, b| times(0.0, a + b), 1e-9)
            && !tried!(|a, b| times(2e-9, (times(200.0, a)).sin()) + times(0.0, b), 1e-9)
    );
}

/// Without the inclusion the first step would call this unique.
#[test]
fn a_root_just_outside_the_box_is_not_in_it() {
    let f = |x: Gradient<1>| (x + x * x) - x - Gradient::from_f64(1.21);
    for upper in [1.099_9, 1.099_999_9] {
        let start = Interval::new(0.2, upper).unwrap();
        for steps in 1..30 {
            let found = newton(f, start, steps);
            assert!(!matches!(found, Roots::Unique { .. }), "{steps} steps from {start}: {found:?}");
        }
    }
    assert!(matches!(newton(f, Interval::new(0.9, 1.2).unwrap(), 30), Roots::Unique { .. }));
}

/// Added to the closed form where the ratio is below a bound, or everywhere.
struct Added(f64, f64);

impl Change for Added {
    fn apply<T: Special, const N: usize, const M: usize>(&self, at: [T; N], values: [T; M]) -> [T; M] {
        let Self(height, below) = *self;
        let height = (at[0] - T::from_f64(below)).select(|| T::from_f64(height), T::zero);
        values.map(|value| value + height)
    }
}

/// Added in proportion to the angle.
struct Tilted(f64);

impl Change for Tilted {
    fn apply<T: Special, const N: usize, const M: usize>(&self, at: [T; N], values: [T; M]) -> [T; M] {
        let tilt = T::from_f64(self.0) * at[0];
        values.map(|value| value + tilt)
    }
}

/// Each part of a kernel's bound is missed by one of these: the far end, the bulk, and the whole step at the minimum.
#[test]
fn every_part_of_a_kernel_counts() {
    for form in [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band] {
        let far = Added(1e-9, -1.0 + 2.3e-16);
        assert!(form.prove_changed(&far).is_err(), "{form:?} at the far end");
        let bound = form.prove().unwrap().bound.value();
        let tilted = form.prove_changed(&Tilted(9e-14)).map(|proved| proved.bound.value());
        assert!(tilted.is_err() || tilted.unwrap() > bound + 1.5e-13, "{form:?} in the bulk");
    }
    let spare = 1e-11 - KernelForm::Step.prove().unwrap().bound.value();
    let counted_twice = Added(0.7 * spare, 2.0);
    assert!(KernelForm::Step.prove_changed(&counted_twice).is_err());
    assert!(KernelForm::Ramp.prove_changed(&counted_twice).is_ok());
}

/// Values by Arb at 120 bits.
#[test]
fn large_angles_are_enclosed() {
    for (angle, sine) in LARGE_ANGLES {
        let found = Interval::point(angle).sin();
        assert!(found.lower() <= sine && sine <= found.upper(), "{angle}: {sine} not in {found}");
    }
    for (angle, cosine) in NEXT_TO_QUARTERS {
        let found = Interval::point(angle).cos();
        assert!(found.lower() <= cosine && cosine <= found.upper(), "{angle}: {cosine} not in {found}");
    }
}

/// Doubles next to odd multiples of a quarter turn, with their cosines: these show what is left of the reduction's last bits.
const NEXT_TO_QUARTERS: [(f64, f64); 5] = [
    (8380002.053909924, -2.202293541700382e-10),
    (8380005.195502577, 3.41771364300162e-10),
    (8380008.337095231, -4.633133744302859e-10),
    (8380011.478687885, -3.4646719005506876e-10),
    (6588402.029050122, -4.391400636077328e-10),
];

/// Angles beyond a million radians, with their sines rounded to doubles.
const LARGE_ANGLES: [(f64, f64); 12] = [
    (1048576.0, 0.3304931400217347),
    (1048577.5, 0.9648223011268932),
    (2097152.0, 0.6238443993586297),
    (3294199.0, 0.33506048864245513),
    (5000001.0, -0.7088177922086756),
    (6588397.5, 0.18231348373094985),
    (8388607.0, 0.9923450937696126),
    (12345678.9, -0.8973068124812599),
    (1000000000.0, 0.5458434494486996),
    (1e+22, -0.8522008497671888),
    (5.319372648326541e+255, 1.0),
    (1.7976931348623157e+308, 0.004961954789184062),
];

/// What each inequality stands for, by formulas of this test: the margin may be smaller, never larger.
#[test]
fn inequalities_are_no_more_than_what_they_stand_for() {
    let slope = |f: &dyn Fn(f64) -> f64, at: f64| (f(at + 1e-6) - f(at - 1e-6)) / 2e-6;
    let stands_for = |id: &str, [a, b, c]: [f64; 3]| -> Option<f64> {
        let excess = |d: f64, e: f64| (1.0 - a + d) * (1.0 + a + e) - (1.0 + a - d) * (1.0 - a - e);
        Some(match id {
            "excess-first" => slope(&|d| excess(d, c), b) - 1.99,
            "excess-second" => slope(&|e| excess(b, e), c) - 1.99,
            "denominator" => 1.99 - 0.48 * (1.0 - a + b * (1.0 + a)) * (1.0 + a + c * (1.0 - a)),
            "force-slow" => 1.0 - b * a - (1.0 - b) * a * a,
            "force-fast" => b + 2.0 * (1.0 - b) * a,
            "braking" => -slope(&|mu| 1.0 - mu + b, a),
            "braking-drag" => slope(&|drag| 1.0 - a + drag, b),
            "quadratic-next" => slope(&|gap| quadratic_half_cycle(a, gap, 1.0), b),
            "linear-width-short" => (a - a.tanh()) / a.powi(3),
            "linear-width-long" => a.tanh().powi(2),
            "quadratic-overshoot-weak" if a <= 0.05 => ((1.0 + a) * a.ln_1p() + (1.0 - a) * (-a).ln_1p()) / a.powi(2),
            "quadratic-overshoot-weak" | "quadratic-overshoot-strong" => {
                (1.0 + a) * a.ln_1p() + (1.0 - a) * (-a).ln_1p()
            }
            "linear-overshoot-weak" if a <= 0.05 => (a * (a - a.ln_1p()) - (1.0 - a) * (a.atanh() - a)) / a.powi(3),
            "linear-overshoot-weak" | "linear-overshoot-strong" => a * (a - a.ln_1p()) - (1.0 - a) * (a.atanh() - a),
            "logarithm-low" => a.exp() - 2.0 * a,
            "logarithm-high" => a.exp() - 2.0,
            _ => return None,
        })
    };
    let theorems: [Theorem; 5] = [
        theorem::QUADRATIC_DISTURBED,
        theorem::QUADRATIC,
        theorem::LINEAR,
        theorem::QUADRATIC_OVERSHOOT,
        theorem::LINEAR_OVERSHOOT,
    ];
    for inequality in theorems.iter().flat_map(|theorem| theorem.inequalities) {
        let domain = inequality.domain().unwrap();
        for k in 1..40 {
            let share = |step: f64| (f64::from(k) * step).fract().clamp(0.01, 0.99);
            let point: [f64; 3] = core::array::from_fn(|i| {
                let (lower, upper) = (domain[i].lower(), domain[i].upper().min(domain[i].lower() + 20.0));
                lower + (upper - lower) * share([0.618, 0.414, 0.732][i])
            });
            let over_power = inequality.id.ends_with("short") || (inequality.id.ends_with("weak") && point[0] <= 0.05);
            let exact =
                stands_for(inequality.id, point).unwrap_or_else(|| panic!("{} has no formula here", inequality.id));
            let margin = inequality.margin.over(&point.map(Interval::point));
            let slack = CENTRAL_DIFFERENCE * (1.0 + exact.abs());
            assert!(margin.lower() <= exact + slack, "{} at {point:?}: {margin} above {exact}", inequality.id);
            let bound = inequality.id.ends_with("strong") || over_power;
            assert!(bound || margin.upper() >= exact - slack, "{} at {point:?}: {margin} below {exact}", inequality.id);
        }
    }
}

/// Positive beyond a thousandth and negative below: the leading coefficient alone does not show it.
#[test]
fn a_zero_of_a_lower_order_is_not_divided_out() {
    fn sunk<T: Real>([r, _, _]: [T; 3]) -> T {
        theorem::quadratic_overshoot([r, r, r]) - T::from_f64(1e-3) * r
    }
    let inequality = Inequality {
        margin: Margin::OverPower { of: formula!(sunk), order: 2, near: 0.05 },
        ..theorem::QUADRATIC_OVERSHOOT_WEAK
    };
    assert!(inequality.prove(2000).is_err());
    let near: VariableBox = [Interval::new(0.0, 0.04).unwrap(), Interval::ZERO, Interval::ZERO];
    assert_eq!(inequality.margin.over(&near), Interval::ENTIRE);
    assert!(theorem::QUADRATIC_OVERSHOOT_WEAK.margin.over(&near).is_positive());
}

/// No axis is certified without a multiplier below one, however weak its drag.
#[test]
fn certificates_need_a_multiplier_below_one() {
    let relay = selfosc::nonlinearity::RelayHysteresis::new(1.0, 0.3, 0.0).unwrap();
    let mut refused = 0;
    for drag in (50..160).map(|tenths| 10f64.powf(-0.1 * f64::from(tenths))) {
        for axis in [DragAxis::linear(1.0, drag), DragAxis::quadratic(1.0, drag), DragAxis::mixed(1.0, drag, drag)] {
            match certify(&axis.unwrap(), &relay) {
                Ok(proof) => assert!(proof.enclosure.multiplier.upper() < 1.0, "{proof:?}"),
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 0);
}

/// A false inequality is refuted at a point, and what the engine gives for its margin there is what it is.
#[test]
fn a_refutation_shows_its_point() {
    let Err(NotProved::Refuted { witness, value, .. }) =
        prove_positive(|[x]: &[Interval; 1]| Interval::point(0.9) - x.sin(), [Interval::new(0.0, 3.0).unwrap()], 1000)
    else {
        panic!("not refuted")
    };
    assert!(witness[0].sin() >= 0.9 && (value.midpoint() - (0.9 - witness[0].sin())).abs() <= ROUNDING);
}

/// The delay of the example that showed it: the cycle of a tenth of a second is one of this axis too.
#[test]
fn attraction_is_withheld_where_faster_cycles_exist() {
    let axis = |delay_s: f64| DragAxis::linear(1.0, 0.3).unwrap().with_delay_s(delay_s).unwrap();
    let relay = selfosc::nonlinearity::RelayHysteresis::new(1.0, 0.2, 0.0).unwrap();
    let long = certify(&axis(31.066_538_489_236_64), &relay).unwrap();
    assert!(!long.unique && !long.attracting && long.starts == selfosc::orbit::Starts::OneCommandOnItsWay);
    let short = certify(&axis(0.1), &relay).unwrap();
    assert!(short.unique && short.attracting && short.starts == selfosc::orbit::Starts::Every);
    let turns = (31.066_538_489_236_64 - 0.1) / short.enclosure.period_s.midpoint();
    assert!((turns - turns.round()).abs() < 1e-9, "{turns}");
}
