//! Rigorous quadrature, root enclosure and branch and bound: true statements are proved, false ones are not.

use selfosc::numeric::{Interval, Jet, Real};
use selfosc::proof::branch_and_bound::prove_positive;
use selfosc::proof::enclosure::{Roots, around, krawczyk, newton};
use selfosc::proof::rigorous_quadrature::{CellJet, Integrand, Quadrature, integrate};
use selfosc::proof::{Bound, Gradient, NotProved};

use crate::oracle::{Bracket, Down, Up, at, bracket};
use crate::sampling::seeded;
use crate::tolerance::{JET_ROUNDING, QUADRATURE_WIDTH};

fn interval(lo: f64, hi: f64) -> Interval {
    Interval::new(lo, hi).expect("an interval")
}

/// An integrand given by one formula, as an interval and as a jet.
struct Formula<F, G>(F, G);

impl<F: Fn(Interval) -> Interval, G: Fn(CellJet) -> CellJet> Integrand<1> for Formula<F, G> {
    fn range(&self, t: Interval) -> [Interval; 1] {
        [(self.0)(t)]
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; 1]> {
        Some([(self.1)(t)])
    }
}

macro_rules! formula {
    (|$t:ident| $value:expr) => {
        Formula(|$t: Interval| $value, |$t: CellJet| $value)
    };
}

/// A relay of level one with a dead zone up to `threshold`, driven by a biased sine, in phase with it.
struct Relay {
    bias: f64,
    threshold: f64,
}

impl Relay {
    fn output(&self, input: Interval) -> Option<f64> {
        let threshold = Interval::point(self.threshold);
        match input {
            x if threshold.precedes(x) => Some(1.0),
            x if x.precedes(-threshold) => Some(-1.0),
            x if x.is_interior_to(Interval::symmetric(self.threshold)) => Some(0.0),
            _ => None,
        }
    }
    /// First Fourier integral by the angles at which the output changes.
    fn exact(&self) -> f64 {
        let rise = (self.threshold - self.bias).asin();
        let fall = (self.threshold + self.bias).asin();
        2.0 * rise.cos() + 2.0 * fall.cos()
    }
}

impl Integrand<2> for Relay {
    fn range(&self, t: Interval) -> [Interval; 2] {
        let output = self.output(Interval::point(self.bias) + t.sin()).map_or(Interval::UNIT, Interval::point);
        [output, output * t.sin()]
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; 2]> {
        let output = Jet::from_f64(self.output(Interval::point(self.bias) + t.value().sin())?);
        Some([output, output * t.sin()])
    }
}

/// The circle, from an irrational start so that no breakpoint is met by luck.
fn around_the_circle<const M: usize>(integrand: &impl Integrand<M>, width: f64, budget: usize) -> Quadrature<M> {
    integrate(integrand, -Interval::PI, Interval::PI, width, budget)
}

/// Between ends that are intervals themselves: every integral from a point of one to a point of the other.
#[test]
fn wide_ends_are_enclosed() {
    let found = integrate(&formula!(|t| t.exp()), interval(0.0, 0.1), interval(1.0, 1.1), 1.0, 1000).integrals[0];
    for (from, to) in [(0.0, 1.0), (0.0, 1.1), (0.1, 1.0), (0.1, 1.1)] {
        assert!(found.contains(f64::exp(to) - f64::exp(from)), "{from} to {to}: {found}");
    }
}

#[test]
fn known_integrals_are_enclosed() {
    let turn = Interval::PI + Interval::PI;
    let check = |found: Quadrature<1>, exact: &Bracket| {
        let integral = found.integrals[0];
        assert!(found.reached && exact.lies_within(integral.bounds()), "{exact:?} not in {found:?}");
        let scale = Interval::point(1.0 + 1e-5) * integral;
        assert!(!exact.lies_within(scale.bounds()), "a falsified integral passes");
    };
    let one = 1.0;
    let rectified = integrate(&formula!(|t| t.sin().abs()), Interval::ZERO, turn, QUADRATURE_WIDTH, 10_000);
    check(rectified, &bracket!(one: at(4.0) * one));
    let exponential = integrate(&formula!(|t| t.exp()), Interval::ZERO, Interval::ONE, QUADRATURE_WIDTH, 1000);
    check(exponential, &bracket!(one: one.exp_m1()));
    let backwards = integrate(&formula!(|t| t.exp()), Interval::ONE, Interval::ZERO, QUADRATURE_WIDTH, 1000);
    check(backwards, &bracket!(one: -one.exp_m1()));
    // An endpoint known only to lie between one and 1.1 gives the integrals up to either; so does the start.
    let to_either = |end| integrate(&formula!(|t| t.exp()), interval(0.0, 0.1), end, 1.0, 1000).integrals[0];
    for (from, to) in [(0.0, 1.0), (0.0, 1.1), (0.1, 1.0), (0.1, 1.1)] {
        assert!(bracket!(from, to: to.exp() - from.exp()).lies_within(to_either(interval(1.0, 1.1)).bounds()));
    }
    let arc = integrate(&formula!(|t| one_over(t.square())), Interval::ZERO, Interval::ONE, QUADRATURE_WIDTH, 1000);
    check(arc, &bracket!(one: one.atan()));
    let kinked = integrate(&formula!(|t| t.min(half())), Interval::ZERO, Interval::ONE, QUADRATURE_WIDTH, 1000);
    check(kinked, &bracket!(one: at(0.375) * one));
}

/// A power that is singular at zero, wherever zero lies: `2/(1 + exponent)` over `[-1, 1]`, half of that on either side.
#[test]
fn cells_are_graded_towards_a_singular_end() {
    for (exponent, most) in [(0.25, 90), (0.5, 80), (1.5, 60)] {
        let power = formula!(|t| t.abs().pow(Real::from_f64(exponent)));
        let exact = bracket!(exponent: at(1.0) / (at(1.0) + exponent));
        let one = Interval::ONE;
        for (from, to) in [(Interval::ZERO, one), (-one, Interval::ZERO), (one, Interval::ZERO)] {
            let found = integrate(&power, from, to, QUADRATURE_WIDTH, 10_000);
            let integral = if to.is_point() && from == one { -found.integrals[0] } else { found.integrals[0] };
            assert!(found.reached && exact.lies_within(integral.bounds()), "{exponent}: {found:?}");
            assert!(found.cells <= most, "{exponent}: {} cells", found.cells);
        }
        let both = integrate(&power, interval(-0.75, -0.75), interval(0.75, 0.75), QUADRATURE_WIDTH, 10_000);
        let across =
            bracket!(exponent: at(2.0) * ((at(1.0) + exponent.clone()) * at(0.75).ln()).exp() / (at(1.0) + exponent));
        assert!(both.reached && across.lies_within(both.integrals[0].bounds()), "{exponent}: {both:?}");
    }
}

/// A bounded jet says nothing while the cell spans many periods: dividing goes on. The mean of `sin^2` is a half.
#[test]
fn an_oscillation_is_resolved() {
    let wave = formula!(|t| (t * Real::from_f64(40.0)).sin().square());
    let found = around_the_circle(&wave, QUADRATURE_WIDTH, 10_000);
    assert!(found.reached && found.integrals[0].contains(core::f64::consts::PI), "{found:?}");
    assert!(found.integrals[0].intersection(Interval::PI).is_some() && found.cells < 1000, "{found:?}");
}

/// `1/(1 + x)`.
fn one_over<T: Real>(x: T) -> T {
    T::one() / (T::one() + x)
}

fn half<T: Real>() -> T {
    T::from_f64(0.5)
}

#[test]
fn jumps_are_trapped() {
    for (bias, threshold) in [(0.0, 0.3), (0.21, 0.4), (-0.3, 0.5), (0.05, 0.01)] {
        let relay = Relay { bias, threshold };
        let found = around_the_circle(&relay, QUADRATURE_WIDTH, 10_000);
        let exact = relay.exact();
        assert!(found.reached, "{found:?}");
        // The comparison value carries rounding of its own.
        assert!(
            (found.integrals[1] - Interval::point(exact)).magnitude() < 2.0 * QUADRATURE_WIDTH,
            "{exact} {found:?}"
        );
        assert!(!found.integrals[1].contains(exact * 1.00001));
    }
}

#[test]
fn a_small_budget_widens_but_stays_sound() {
    let relay = Relay { bias: 0.21, threshold: 0.4 };
    let mut last = f64::INFINITY;
    for budget in [1, 3, 10, 30, 100, 300] {
        let found = around_the_circle(&relay, QUADRATURE_WIDTH, budget);
        assert!(found.cells <= budget && found.integrals[1].contains(relay.exact()), "{found:?}");
        assert!(found.integrals[1].width() <= last);
        last = found.integrals[1].width();
    }
    // A pole is not integrable, and nothing is claimed.
    let pole = integrate(&formula!(|t| one_over(t)), interval(-2.0, -2.0), Interval::ONE, 1e-3, 1000);
    assert!(!pole.reached && !pole.integrals[0].is_bounded());
}

/// `x^x` and its derivatives.
fn own_power(x: f64) -> [f64; 4] {
    let (power, slope) = (x.powf(x), x.ln() + 1.0);
    [power, power * slope, power * (slope.powi(2) + 1.0 / x), power * (slope.powi(3) + 3.0 * slope / x - 1.0 / (x * x))]
}

/// Each function with its derivative of order one to three, from the calculus books.
#[test]
fn jets_agree_with_derivatives() {
    let x = 0.4_f64;
    let root = (1.0 - x * x).sqrt();
    let (s, c, t, e) = (x.sin(), x.cos(), x.tan(), x.exp());
    let (sh, ch, th) = (x.sinh(), x.cosh(), x.tanh());
    let (sec, sech) = (1.0 + t * t, 1.0 - th * th);
    let q = 1.0 + x * x;
    let p = 1.0 - x * x;
    let (half, three) = (Jet::from_f64(0.5), Jet::from_f64(3.0));
    type Case<'a> = (&'static str, &'a dyn Fn(Jet<4>) -> Jet<4>, [f64; 4]);
    let cases: [Case; 22] = [
        ("root", &|x| x.pow(half), [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5), 0.375 * x.powf(-2.5)]),
        ("cube", &|x| x.pow(three), [x * x * x, 3.0 * x * x, 6.0 * x, 6.0]),
        ("own power", &|x| x.pow(x), own_power(x)),
        ("minus_own_sine", &|x| x.minus_own_sine(x.sin()), [x - s, 1.0 - c, s, c]),
        ("sqrt", &Real::sqrt, [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5), 0.375 * x.powf(-2.5)]),
        ("square", &Real::square, [x * x, 2.0 * x, 2.0, 0.0]),
        ("product", &|x| x * x * x, [x * x * x, 3.0 * x * x, 6.0 * x, 6.0]),
        ("reciprocal", &|x| Jet::one() / x, [1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3), -6.0 / x.powi(4)]),
        ("sin", &Real::sin, [s, c, -s, -c]),
        ("cos", &Real::cos, [c, -s, -c, s]),
        ("tan", &Real::tan, [t, sec, 2.0 * t * sec, 2.0 * sec * sec + 4.0 * t * t * sec]),
        (
            "asin",
            &Real::asin,
            [x.asin(), 1.0 / root, x / root.powi(3), 1.0 / root.powi(3) + 3.0 * x * x / root.powi(5)],
        ),
        (
            "acos",
            &Real::acos,
            [x.acos(), -1.0 / root, -x / root.powi(3), -1.0 / root.powi(3) - 3.0 * x * x / root.powi(5)],
        ),
        ("atan", &Real::atan, [x.atan(), 1.0 / q, -2.0 * x / (q * q), -2.0 / (q * q) + 8.0 * x * x / q.powi(3)]),
        ("exp", &Real::exp, [e; 4]),
        ("exp_m1", &Real::exp_m1, [x.exp_m1(), e, e, e]),
        ("ln", &Real::ln, [x.ln(), 1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3)]),
        ("ln_1p", &Real::ln_1p, [x.ln_1p(), 1.0 / (1.0 + x), -(1.0 + x).powi(-2), 2.0 * (1.0 + x).powi(-3)]),
        ("sinh", &Real::sinh, [sh, ch, sh, ch]),
        ("cosh", &Real::cosh, [ch, sh, ch, sh]),
        ("tanh", &Real::tanh, [th, sech, -2.0 * th * sech, -2.0 * sech * sech + 4.0 * th * th * sech]),
        ("atanh", &Real::atanh, [x.atanh(), 1.0 / p, 2.0 * x / (p * p), 2.0 / (p * p) + 8.0 * x * x / p.powi(3)]),
    ];
    for (name, function, derivatives) in cases {
        let jet = function(Jet::variable(Interval::point(x)));
        for ((k, coefficient), derivative) in jet.coefficients().iter().enumerate().zip(derivatives) {
            let exact = derivative / [1.0, 1.0, 2.0, 6.0][k];
            let error = (*coefficient - Interval::point(exact)).magnitude();
            assert!(error < JET_ROUNDING * exact.abs().max(1.0), "{name}, order {k}: {coefficient}, not {exact}");
        }
    }
}

/// Gradients agree with the jets' first coefficient, over intervals as well.
#[test]
fn gradients_agree_with_jets() {
    macro_rules! agree {
        ($($function:ident)+) => {
            $(
                for x in [interval(0.3, 0.3), interval(0.3, 0.31), interval(0.7, 0.9)] {
                    let jet = Jet::<2>::variable(x).$function();
                    let gradient = Gradient::variables([x])[0].$function();
                    assert_eq!(jet.value(), gradient.value());
                    let (a, b) = (jet.coefficients()[1], gradient.slopes()[0]);
                    assert!(a.intersection(b).is_some(), "{}: {a} and {b}", stringify!($function));
                    assert!(x.width() > 0.0 || a.hull(b).width() < JET_ROUNDING * 10.0, "{}", stringify!($function));
                }
            )+
        };
    }
    for x in [interval(0.4, 0.4), interval(0.4, 0.5)] {
        let (jet, [gradient]) = (Jet::<2>::variable(x), Gradient::variables([x]));
        let (jet, gradient) = (jet.pow(jet), gradient.pow(gradient));
        assert!(
            jet.coefficients()[1].intersection(gradient.slopes()[0]).is_some() && !gradient.slopes()[0].is_entire()
        );
    }
    agree!(sin cos tan asin acos atan exp exp_m1 ln ln_1p sinh cosh tanh atanh sqrt square abs);
}

#[test]
fn kinks_are_undecided() {
    let across = Jet::<3>::variable(Interval::UNIT);
    assert_eq!(across.abs().value(), interval(0.0, 1.0));
    assert!(
        !across.abs().is_bounded() && !across.min(Jet::zero()).is_bounded() && !across.max(Jet::zero()).is_bounded()
    );
    let choice = across.select(Jet::zero, Jet::one);
    assert!(choice.value() == interval(0.0, 1.0) && !choice.is_bounded() && !across.floor().is_bounded());
    assert!(Jet::<3>::variable(interval(1.0, 2.0)).abs().is_bounded());
    assert_eq!(Jet::<3>::variable(interval(1.1, 1.9)).floor(), Jet::one());
    let [x] = Gradient::variables([Interval::UNIT]);
    assert_eq!(x.abs().slopes()[0], Interval::UNIT);
    assert_eq!(x.floor().slopes()[0], Interval::ENTIRE);
    assert_eq!(x.select(Gradient::zero, Gradient::one).slopes()[0], Interval::ENTIRE);
    assert_eq!(x.max(Gradient::zero()).slopes()[0], interval(0.0, 1.0));
}

#[test]
fn newton_proves_what_is_true_only() {
    let root = newton(|x| x.square() - Gradient::two(), interval(1.0, 2.0), 30);
    let Roots::Unique { enclosure, .. } = root else { panic!("{root:?}") };
    let two = 2.0;
    assert!(bracket!(two: two.sqrt()).lies_within(enclosure.bounds()) && enclosure.width() < 1e-15);
    assert!(matches!(newton(|x| x.square() + Gradient::one(), interval(-5.0, 5.0), 30), Roots::None { .. }));
    assert!(matches!(newton(|x| x.exp() - x, interval(0.5, 2.0), 30), Roots::None { .. }));
    // Two roots, a double root, an interval whose root lies outside by little, a kink, a violated domain.
    assert!(matches!(newton(|x| x.square() - Gradient::two(), interval(-2.0, 2.0), 30), Roots::Undecided { .. }));
    assert!(matches!(newton(|x| x.square(), interval(-1.0, 2.0), 30), Roots::Undecided { .. }));
    assert!(!matches!(newton(|x| x.square() - Gradient::two(), interval(1.41422, 2.0), 30), Roots::Unique { .. }));
    assert!(!matches!(newton(|x| x.abs() - Gradient::from_f64(0.5), interval(-1.0, 1.0), 30), Roots::Unique { .. }));
    assert!(!matches!(newton(|x| x.sqrt() - Gradient::from_f64(0.1), interval(-1.0, 1.0), 30), Roots::Unique { .. }));
    assert!(matches!(newton(|x| x - Gradient::one(), interval(0.0, 3.0), 0), Roots::Undecided { steps: 0, .. }));
}

#[test]
fn krawczyk_proves_what_is_true_only() {
    let circle_and_exponential =
        |[x, y]: [Gradient<2>; 2]| [x.square() + y.square() - Gradient::from_f64(4.0), x.exp() + y - Gradient::one()];
    let (x, y) = (1.004_168_738_474_661, -1.729_637_287_025_821);
    let found = krawczyk(circle_and_exponential, around([x, y], 1e-3), 20);
    let Roots::Unique { enclosure, .. } = found else { panic!("{found:?}") };
    assert!(enclosure.iter().all(|side| side.width() < 1e-14), "{enclosure:?}");
    assert!((enclosure[0] - Interval::point(x)).magnitude() < 1e-5);
    // Beside the root, far from it, and with the whole circle.
    assert!(matches!(krawczyk(circle_and_exponential, around([x + 0.01, y], 1e-3), 20), Roots::None { .. }));
    assert!(!matches!(krawczyk(circle_and_exponential, around([0.0, 0.0], 3.0), 20), Roots::Unique { .. }));
    // A box around both roots, whose midpoint has a regular Jacobian.
    assert!(!matches!(krawczyk(circle_and_exponential, around([-0.4, -0.4], 2.5), 20), Roots::Unique { .. }));
    // A double root: circle and tangent.
    let touching = |[x, y]: [Gradient<2>; 2]| [x.square() + y.square() - Gradient::one(), y - Gradient::one()];
    assert!(!matches!(krawczyk(touching, around([0.0, 1.0], 1e-3), 20), Roots::Unique { .. }));
    assert!(!matches!(krawczyk(touching, around([0.01, 1.0], 0.1), 20), Roots::Unique { .. }));
    // Three unknowns, where rows must be exchanged.
    let cyclic = |[x, y, z]: [Gradient<3>; 3]| [y - x.cos(), z - y.cos(), x - z.cos()];
    let found = krawczyk(cyclic, around([0.739; 3], 1e-2), 20);
    let Roots::Unique { enclosure, .. } = found else { panic!("{found:?}") };
    assert!(enclosure.iter().all(|side| (*side - side.cos()).contains_zero() && side.width() < 1e-14));
}

/// Newton on `(x - a)(x^2 + 1)` finds `a` where it lies inside, and claims no root where it lies outside.
#[test]
fn newton_finds_the_root_that_is_there() {
    fn holds(position: f64) -> bool {
        let a = (position % 4.0) + 0.0;
        if !a.is_finite() {
            return true;
        }
        let cubic = |x: Gradient<1>| (x - Gradient::from_f64(a)) * (x.square() + Gradient::one());
        match newton(cubic, interval(1.0, 2.0), 60) {
            Roots::Unique { enclosure, .. } => enclosure.contains(a),
            Roots::None { .. } => !(1.0..=2.0).contains(&a),
            Roots::Undecided { remaining, .. } => remaining.contains(a) || !(1.0..=2.0).contains(&a),
        }
    }
    seeded().quickcheck(holds as fn(_) -> bool);
}

#[test]
fn branch_and_bound_proves_what_is_true_only() {
    // The dip of x^4 - x^2 + y^2 + c is c - 1/4.
    let margin =
        |c: f64| move |[x, y]: &[Interval; 2]| x.square().square() - x.square() + y.square() + Interval::point(c);
    let square = [interval(-2.0, 3.0), interval(-1.0, 2.0)];
    let proved = prove_positive(margin(0.26), square, 100_000);
    let bound = proved.as_ref().map(|proved| proved.bound);
    assert!(matches!(bound, Ok(Bound::Margin(margin)) if 0.0 < margin && margin <= 0.01), "{bound:?}");
    let refuted = prove_positive(margin(0.24), square, 100_000);
    let Err(NotProved::Refuted { witness: [x, y], value: at_witness, .. }) = refuted else { panic!("{refuted:?}") };
    assert!(at_witness.upper() <= 0.0 && x.powi(4) - x * x + y * y + 0.24 <= 0.0);
    // Equality at an irrational point can be neither proved nor refuted.
    assert!(matches!(prove_positive(margin(0.25), square, 20_000), Err(NotProved::Undecided { boxes: ..=20_000, .. })));
    assert!(matches!(prove_positive(margin(0.26), square, 3), Err(NotProved::Undecided { boxes: ..=3, .. })));
    // Outside the domain of the square root nothing is proved.
    let root = |[x]: &[Interval; 1]| x.sqrt() + Interval::ONE;
    assert!(matches!(prove_positive(root, [interval(-1.0, 1.0)], 1000), Err(NotProved::Undecided { .. })));
}
