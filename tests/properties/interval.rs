//! Intervals enclose what exact arithmetic gives.

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use selfosc::numeric::{Interval, Real};

use crate::oracle::{Bracket, Down, Up, at, bracket};
use crate::sampling::recorded;
use crate::tolerance::ELEMENTARY_WIDTH_ULP;

/// An elementary function with its oracle and the arguments it is defined for.
struct Elementary {
    name: &'static str,
    interval: fn(Interval) -> Interval,
    exact: fn(f64) -> Bracket,
    domain: (f64, f64),
    /// Sizes beyond which the value is a known limit, so that the oracle need not compute it.
    tight: (f64, f64),
    /// Arguments at which cases of the implementation meet.
    edges: &'static [f64],
}

const LARGEST: (f64, f64) = (f64::MIN, f64::MAX);
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;
/// Half odd multiples of `ln 2`, where the exponent of the reduction changes, and the ends of the exponential's range.
const EXP_EDGES: &[f64] = &[
    0.346_573_590_279_972_64,
    -0.346_573_590_279_972_64,
    1.039_720_770_839_918,
    -1.039_720_770_839_918,
    0.36,
    22.0,
    -22.0,
    37.0,
    -37.0,
    709.782_712_893_384,
    709.782_712_893_383_9,
    710.475_860_073_943_9,
    -708.396_418_532_264_1,
    -745.133_219_101_941_1,
    -745.2,
    711.0,
    -746.0,
];
/// Doubles close to multiples of a quarter turn, the worst of them known below 2^20, and ends of the reduction.
const TURN_EDGES: &[f64] = &[
    core::f64::consts::FRAC_PI_4,
    core::f64::consts::FRAC_PI_2,
    core::f64::consts::PI,
    3.0 * core::f64::consts::FRAC_PI_4,
    3.0 * core::f64::consts::FRAC_PI_2,
    2.0 * core::f64::consts::PI,
    11.0,
    22.0,
    355.0,
    710.0,
    103_993.0,
    104_348.0,
    208_341.0,
    312_689.0,
    833_719.0,
    1_048_576.0,
    -1_048_576.0,
];
const UNIT_EDGES: &[f64] = &[1.0, -1.0, BELOW_ONE, -BELOW_ONE, 0.5, core::f64::consts::FRAC_1_SQRT_2, 0.999_999_999];
const LN_EDGES: &[f64] = &[
    1.0,
    BELOW_ONE,
    1.0 + f64::EPSILON,
    0.5,
    2.0,
    core::f64::consts::SQRT_2,
    core::f64::consts::FRAC_1_SQRT_2,
    core::f64::consts::E,
];

macro_rules! elementary {
    ($name:ident, $domain:expr, $tight:expr, $edges:expr) => {
        Elementary {
            name: stringify!($name),
            interval: <Interval as Real>::$name,
            exact: |x| bracket!(x: x.$name()),
            domain: $domain,
            tight: $tight,
            edges: $edges,
        }
    };
}

const POSITIVE: (f64, f64) = (5e-324, f64::MAX);
const TURNS: (f64, f64) = (-1_048_576.0, 1_048_576.0);
const OPEN_UNIT: (f64, f64) = (-BELOW_ONE, BELOW_ONE);
const EXPONENTS: (f64, f64) = (-760.0, 760.0);

/// Every function of the arithmetic that rests on more than the five basic operations.
const ELEMENTARY: [Elementary; 15] = [
    elementary!(sin, TURNS, TURNS, TURN_EDGES),
    elementary!(cos, TURNS, TURNS, TURN_EDGES),
    elementary!(tan, TURNS, TURNS, TURN_EDGES),
    Elementary {
        name: "minus_own_sine",
        interval: |x| x.minus_own_sine(x.sin()),
        exact: |x| bracket!(x: x.clone() - x.sin()),
        domain: TURNS,
        tight: (1e-100, 1e6),
        edges: &[0.8, 1.0, 1.2, -1.2],
    },
    elementary!(asin, (-1.0, 1.0), (-1.0, 1.0), UNIT_EDGES),
    elementary!(acos, (-1.0, 1.0), (-1.0, 1.0), UNIT_EDGES),
    elementary!(atan, LARGEST, LARGEST, UNIT_EDGES),
    elementary!(exp, EXPONENTS, (-708.0, 709.0), EXP_EDGES),
    elementary!(exp_m1, EXPONENTS, (-760.0, 709.0), EXP_EDGES),
    elementary!(ln, POSITIVE, POSITIVE, LN_EDGES),
    elementary!(
        ln_1p,
        (-BELOW_ONE, f64::MAX),
        (-BELOW_ONE, 1e308),
        &[-0.29, 0.41, -0.5, 1.0, -0.292_893_218_813_452_5]
    ),
    elementary!(sinh, EXPONENTS, (-709.0, 709.0), EXP_EDGES),
    elementary!(cosh, EXPONENTS, (-709.0, 709.0), EXP_EDGES),
    elementary!(tanh, EXPONENTS, EXPONENTS, EXP_EDGES),
    elementary!(atanh, OPEN_UNIT, OPEN_UNIT, &[0.5, 0.9, 0.17]),
];

const COMMON_EDGES: [f64; 14] = [
    0.0,
    -0.0,
    5e-324,
    -5e-324,
    f64::MIN_POSITIVE,
    -f64::MIN_POSITIVE,
    1e-160,
    -1e-160,
    1e-8,
    -1e-8,
    1.0,
    -1.0,
    f64::MAX,
    f64::MIN,
];

fn interval(lo: f64, hi: f64) -> Interval {
    Interval::new(lo, hi).expect("an interval")
}

fn config(cases: u32) -> ProptestConfig {
    // Narrow domains keep few of the powers of two.
    ProptestConfig { max_local_rejects: u32::MAX, source_file: Some(file!()), ..recorded(cases) }
}

/// Numbers of a domain: evenly spread, of every magnitude, and close to the edges.
fn argument((lo, hi): (f64, f64), edges: &'static [f64]) -> impl Strategy<Value = f64> {
    let span = lo.max(-1e3)..hi.min(1e3);
    let near = (0..edges.len(), -64_i64..64)
        .prop_map(|(edge, steps)| f64::from_bits(edges[edge].to_bits().wrapping_add_signed(steps)));
    prop_oneof![
        span,
        (-1074.0..1024.0, any::<bool>()).prop_map(|(power, sign): (f64, bool)| if sign {
            power.exp2()
        } else {
            -power.exp2()
        }),
        (-60.0..20.0, any::<bool>()).prop_map(|(power, sign): (f64, bool)| if sign {
            power.exp2()
        } else {
            -power.exp2()
        }),
        near,
    ]
    .prop_filter("in the domain", move |x| lo <= *x && *x <= hi)
}

fn nearest(exact: &Bracket) -> f64 {
    exact.below.to_f64().value()
}

/// Width in units of the last place of the exact value.
fn width_ulp(enclosure: Interval, exact: &Bracket) -> f64 {
    let size = nearest(exact).abs();
    (enclosure.upper() - enclosure.lower()) / (size.next_up() - size)
}

/// Checks one argument and gives the width, where it is limited, and the exact value.
fn check_point(function: &Elementary, x: f64) -> Result<(f64, Bracket), TestCaseError> {
    let enclosure = (function.interval)(Interval::point(x));
    let exact = (function.exact)(x);
    prop_assert!(exact.lies_within(enclosure.bounds()), "{}({x:?}) = {exact:?} is not in {enclosure}", function.name);
    let width = width_ulp(enclosure, &exact);
    let tight = function.tight.0 <= x && x <= function.tight.1;
    prop_assert!(!tight || width <= ELEMENTARY_WIDTH_ULP, "{}({x:?}): {width} ulp, {enclosure}", function.name);
    Ok((if tight { width } else { 0.0 }, exact))
}

/// Random arguments of every function, and random elements of random intervals; gives the largest width of each function.
fn check_elementary(cases: u32) {
    for function in &ELEMENTARY {
        let widest = std::cell::Cell::new((0.0, 0.0));
        let total = std::cell::Cell::new(0.0);
        let arguments = argument(function.domain, function.edges);
        let other = argument(function.domain, function.edges);
        TestRunner::new(config(cases))
            .run(&(arguments, other, 0.0..1.0, 0_usize..4), |(x, y, weight, choice): (f64, f64, f64, usize)| {
                let (width, at_x) = check_point(function, x)?;
                total.set(total.get() + width);
                if width > widest.get().0 {
                    widest.set((width, x));
                }
                // A far second endpoint, a near one, one nearer, or within a few roundings, kept in the domain.
                let y = [y, x + weight * 4.0, x * (1.0 + weight * 1e-3), x * (1.0 + weight * 1e-14)][choice];
                let (lo, hi) = (x.min(y).max(function.domain.0), x.max(y).min(function.domain.1));
                let (range, inside) = (interval(lo, hi), (x + weight * (y - x)).clamp(lo, hi));
                let enclosure = (function.interval)(range);
                let at_inside = (function.exact)(inside);
                for (element, exact) in [(x, &at_x), (inside, &at_inside)] {
                    prop_assert!(
                        exact.lies_within(enclosure.bounds()),
                        "{}({element:?}) = {exact:?} is not in {enclosure}, the values over {range}",
                        function.name
                    );
                }
                Ok(())
            })
            .unwrap_or_else(|failure| panic!("{failure}"));
        let (width, at) = widest.get();
        eprintln!("{:6} widest {width:5.2} ulp at {at:?}, mean {:5.2}", function.name, total.get() / f64::from(cases));
    }
}

#[test]
fn elementary_functions_enclose_the_oracle() {
    check_elementary(300);
}

/// One evaluation over a narrow interval gives about what two at its ends would.
#[test]
fn narrow_intervals_give_narrow_enclosures() {
    for function in
        ELEMENTARY.iter().filter(|function| ["asin", "acos", "atan", "minus_own_sine"].contains(&function.name))
    {
        for i in 1..1000 {
            for width in [3e-16, 1e-14, 9e-13, 2e-12] {
                let x = 0.001 * f64::from(i);
                let at_end = |x: f64| (function.interval)(Interval::point(x));
                let by_ends = at_end(x).hull(at_end(x + width));
                let over = (function.interval)(interval(x, x + width));
                assert!(over.intersection(by_ends).is_some(), "{}: {over}, {by_ends}", function.name);
                let (found, expected) = (over.width(), 2.0 * by_ends.width());
                assert!(found <= expected, "{} over {x}, {width} more: {found:e}, ends {expected:e}", function.name);
            }
        }
    }
}

#[test]
#[ignore = "a hundred thousand arguments of each function take minutes"]
fn elementary_functions_enclose_the_oracle_at_length() {
    check_elementary(100_000);
}

#[test]
fn elementary_functions_enclose_the_oracle_at_edges() {
    for function in &ELEMENTARY {
        for &edge in COMMON_EDGES.iter().chain(function.edges) {
            for x in [edge.next_down(), edge, edge.next_up(), -edge] {
                if function.domain.0 <= x && x <= function.domain.1 {
                    check_point(function, x).unwrap_or_else(|failure| panic!("{failure}"));
                }
            }
        }
    }
}

/// A basic operation with its oracle.
struct Operation {
    name: &'static str,
    interval: fn(Interval, Interval) -> Interval,
    exact: fn(f64, f64) -> Bracket,
}

const OPERATIONS: [Operation; 6] = [
    Operation { name: "+", interval: |x, y| x + y, exact: |x, y| bracket!(x, y: x + y) },
    Operation { name: "-", interval: |x, y| x - y, exact: |x, y| bracket!(x, y: x - y) },
    Operation { name: "*", interval: |x, y| x * y, exact: |x, y| bracket!(x, y: x * y) },
    Operation { name: "/", interval: |x, y| x / y, exact: |x, y| bracket!(x, y: x / y) },
    Operation {
        name: "sqrt",
        interval: |x, _| x.abs().sqrt(),
        exact: |x, _| {
            let x = x.abs();
            bracket!(x: x.sqrt())
        },
    },
    Operation { name: "square", interval: |x, _| x.square(), exact: |x, _| bracket!(x: x.clone() * x) },
];

/// Doubles of every magnitude, with few or many significant bits, and the ends of the range.
fn double() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => any::<f64>().prop_filter("finite", |x| x.is_finite()),
        4 => -1e3..1e3,
        2 => (-40_i32..40).prop_map(f64::from),
        1 => proptest::sample::select(COMMON_EDGES.to_vec()),
        1 => (0_u64..64).prop_map(f64::from_bits),
    ]
}

/// Whether no double lies strictly between the endpoints.
fn is_tightest(x: Interval) -> bool {
    x.lower() == x.upper() || x.lower().next_up() == x.upper()
}

fn check_operations(cases: u32) {
    TestRunner::new(config(cases))
        .run(&([double(), double(), double(), double()], 0.0..1.0), |([a, b, c, d], weight): ([f64; 4], f64)| {
            let range = interval(a.min(b), a.max(b));
            let (lo, hi, middle) = (range.lower(), range.upper(), range.midpoint());
            let width = bracket!(lo, hi: hi - lo);
            prop_assert!(range.contains(middle) && width.lies_within((0.0, range.width())), "width of {range}");
            let halves = [bracket!(lo, middle: middle - lo), bracket!(middle, hi: hi - middle)];
            prop_assert!(halves.iter().all(|half| half.lies_within((0.0, range.radius()))), "radius of {range}");
            for operation in &OPERATIONS {
                let undefined = |y: Interval| operation.name == "/" && y.contains_zero();
                let (x, y) = (Interval::point(a), Interval::point(c));
                if !undefined(y) {
                    let enclosure = (operation.interval)(x, y);
                    let exact = (operation.exact)(a, c);
                    prop_assert!(
                        exact.lies_within(enclosure.bounds()),
                        "{a:?} {} {c:?} not in {enclosure}",
                        operation.name
                    );
                    // Near underflow and overflow the step is taken unasked.
                    let extreme = |x: f64| !(1e-130..1e145).contains(&x.abs());
                    let tight = is_tightest(enclosure) || [a, c, nearest(&exact)].into_iter().any(extreme);
                    prop_assert!(tight, "{a:?} {} {c:?} = {enclosure}", operation.name);
                }
                let (x, y) = (x.hull(Interval::point(b)), y.hull(Interval::point(d)));
                if !undefined(y) {
                    let enclosure = (operation.interval)(x, y);
                    let between =
                        |x: Interval| (x.lower() * (1.0 - weight) + x.upper() * weight).clamp(x.lower(), x.upper());
                    for (x, y) in [(a, c), (a, d), (b, c), (b, d), (between(x), between(y))] {
                        let exact = (operation.exact)(x, y);
                        prop_assert!(
                            exact.lies_within(enclosure.bounds()),
                            "{x:?} {} {y:?} not in {enclosure}",
                            operation.name
                        );
                    }
                }
            }
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
}

#[test]
fn operations_enclose_the_oracle() {
    check_operations(5_000);
}

#[test]
#[ignore = "a hundred thousand pairs take a minute"]
fn operations_enclose_the_oracle_at_length() {
    check_operations(100_000);
}

#[test]
fn exact_results_stay_exact() {
    let half = Interval::point(0.5);
    assert_eq!(half + half, Interval::ONE);
    assert_eq!(half * half / half, half);
    assert_eq!((Interval::ONE - Interval::UNIT.square()).bounds(), (0.0, 1.0));
    assert_eq!(Interval::point(9.0).sqrt(), Interval::point(3.0));
    for zero in [Interval::sin, Interval::tan, Interval::asin, Interval::atan, Interval::tanh, Interval::exp_m1] {
        assert_eq!(zero(Interval::ZERO), Interval::ZERO);
    }
    assert_eq!(Interval::ZERO.cos(), Interval::ONE);
    assert_eq!(Interval::ONE.acos(), Interval::ZERO);
}

#[test]
fn turning_points_are_reached() {
    let (quarter, turn) = (core::f64::consts::FRAC_PI_2, core::f64::consts::TAU);
    let around = |x: f64| Interval::new(x - 0.1, x + 0.1).expect("an interval");
    for k in -20..20 {
        let x = turn * f64::from(k);
        assert_eq!(around(x + quarter).sin().upper(), 1.0);
        assert_eq!(around(x - quarter).sin().lower(), -1.0);
        assert_eq!(around(x).cos().upper(), 1.0);
        assert_eq!(around(x + 2.0 * quarter).cos().lower(), -1.0);
        assert!(around(x + quarter).sin().lower() > 0.99);
        assert!(around(x).sin().magnitude() < 0.1);
        assert!(around(x + quarter).tan().is_entire(), "a pole at {x}");
        assert!(!around(x).tan().is_entire());
    }
    // No double is a turning point, so the one next to it belongs to one side.
    let beyond = Interval::new(quarter.next_up(), 2.0).expect("an interval");
    assert!(beyond.sin().upper() <= 1.0 && !beyond.tan().is_entire());
    assert_eq!(Interval::new(-1e9, 1e9).expect("an interval").cos(), Interval::UNIT);
}

#[test]
fn a_violated_domain_stays_visible() {
    let beyond = |lo, hi| Interval::new(lo, hi).expect("an interval");
    let violations = [
        Interval::ONE / beyond(0.0, 1.0),
        Interval::ONE / Interval::ZERO,
        beyond(-1e-300, 1.0).sqrt(),
        beyond(0.5, 1.0 + f64::EPSILON).asin(),
        beyond(-2.0, 0.0).acos(),
        beyond(0.0, 1.0).ln(),
        beyond(-1.0, 1.0).ln_1p(),
        beyond(0.0, 1.0).atanh(),
        beyond(1.0, 2.0).tan(),
        beyond(1e300, 2e300).tan(),
        Interval::point(f64::NAN),
    ];
    type Function = fn(Interval) -> Interval;
    let one = Interval::ONE;
    let functions: [Function; 26] = [
        Real::abs,
        Real::sqrt,
        Real::sin,
        Real::cos,
        Real::tan,
        Real::asin,
        Real::acos,
        Real::atan,
        Real::exp,
        Real::exp_m1,
        Real::ln,
        Real::ln_1p,
        Real::sinh,
        Real::cosh,
        Real::tanh,
        Real::atanh,
        Real::square,
        Real::clamp_unit,
        |x| x * Interval::ZERO,
        |x| Interval::ZERO * x,
        |x| x + Interval::ONE,
        |x| -x,
        |x| Interval::ONE / x,
        |x| x / Interval::ONE,
        |x| x.min(Interval::ONE),
        |x| Interval::ONE.max(x),
    ];
    for violation in violations {
        assert!(violation.is_entire());
        for function in functions {
            assert!(function(violation).is_entire());
        }
        assert_eq!(violation.intersection(one), Some(one));
    }
}

#[test]
fn unbounded_intervals_give_no_nan() {
    let ends = [f64::NEG_INFINITY, f64::MIN, -1.0, -5e-324, -0.0, 0.0, 5e-324, 1.0, f64::MAX, f64::INFINITY];
    let valid = |x: Interval| x.lower() <= x.upper() && x.lower() < f64::INFINITY && x.upper() > f64::NEG_INFINITY;
    let intervals: Vec<_> =
        ends.iter().flat_map(|&lo| ends.iter().filter_map(move |&hi| Interval::new(lo, hi))).collect();
    let beyond_one = Interval::ONE.hull(Interval::point(f64::INFINITY));
    for unbounded in
        [Interval::exp, Interval::exp_m1, Interval::sinh, Interval::cosh, Interval::ln, Interval::ln_1p, Interval::sqrt]
    {
        assert_eq!(unbounded(beyond_one).upper(), f64::INFINITY);
    }
    for &x in &intervals {
        for function in &ELEMENTARY {
            assert!(valid((function.interval)(x)), "{}({x})", function.name);
        }
        assert!(valid(Interval::point(x.midpoint())) && x.contains(x.midpoint()), "{x}");
        for &y in &intervals {
            for operation in &OPERATIONS {
                assert!(valid((operation.interval)(x, y)), "{x} {} {y}", operation.name);
            }
        }
    }
}

#[test]
fn powers_enclose_the_oracle() {
    let exponent = prop_oneof![0.0..9.0, -3.0..3.0, (0_u32..12).prop_map(f64::from)];
    let base = prop_oneof![1e-3..20.0, 0.9..1.1, (-60.0..60.0).prop_map(f64::exp2)];
    TestRunner::new(config(100))
        .run(&(base, 0.0..1.0, exponent, 0.0..1.0), |(x, width, p, spread): (f64, f64, f64, f64)| {
            let (base, exponent) = (interval(x, x * (1.0 + width)), interval(p, p + spread));
            let wide = base.pow(exponent);
            let with_zero = interval(0.0, base.upper()).pow(exponent);
            for x in [base.lower(), base.midpoint(), base.upper()] {
                for p in [exponent.lower(), exponent.midpoint(), exponent.upper()] {
                    let exact = bracket!(x, p: x.powf(&p));
                    prop_assert!(exact.lies_within(wide.bounds()), "{x}^{p} = {exact:?} is not in {wide}");
                    prop_assert!(exact.lies_within(with_zero.bounds()), "{x}^{p} = {exact:?} is not in {with_zero}");
                    let thin = Interval::point(x).pow(Interval::point(p));
                    prop_assert!(exact.lies_within(thin.bounds()), "{x}^{p} = {exact:?} is not in {thin}");
                    // The exponential amplifies the rounding of its argument.
                    let width = ELEMENTARY_WIDTH_ULP * f64::EPSILON * (1.0 + (p * x.ln()).abs()) * thin.magnitude();
                    prop_assert!(thin.width() < width, "{x}^{p} = {thin}");
                }
            }
            prop_assert_eq!(with_zero.is_entire(), exponent.lower() < 0.0);
            Ok(())
        })
        .unwrap_or_else(|failure| panic!("{failure}"));
    assert_eq!(Interval::ZERO.pow(Interval::ZERO), Interval::ONE);
    assert_eq!(Interval::ZERO.pow(Interval::point(0.5)), Interval::ZERO);
    assert_eq!(Interval::ZERO.pow(interval(0.0, 1.0)), interval(0.0, 1.0));
    assert!(interval(-1.0, 1.0).pow(Interval::point(2.0)).is_entire());
}

#[test]
fn decisions_join_what_they_cannot_tell_apart() {
    let (below, above) = (|| Interval::point(-3.0), || Interval::point(5.0));
    assert_eq!(interval(5e-324, 1.0).select(below, above), above());
    assert_eq!(interval(-1.0, 0.0).select(below, above), below());
    assert_eq!(interval(0.0, 1.0).select(below, above), interval(-3.0, 5.0));
    assert!(Interval::ENTIRE.select(below, above).is_entire());
    assert_eq!(interval(-0.5, 2.0).floor(), interval(-1.0, 2.0));
    assert_eq!(interval(2.25, 2.75).floor(), Interval::point(2.0));
}
