//! Intervals enclose what exact arithmetic gives.

use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, TestRunner};
use selfosc::numeric::{Interval, Real};

use crate::oracle::{Bracket, bracket};
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
const UNIT_EDGES: &[f64] = &[1.0, -1.0, BELOW_ONE, -BELOW_ONE, 0.5, 0.707_106_781_186_547_5, 0.999_999_999];
const LN_EDGES: &[f64] =
    &[1.0, BELOW_ONE, 1.0 + f64::EPSILON, 0.5, 2.0, core::f64::consts::SQRT_2, 0.707_106_781_186_547_6, core::f64::consts::E];

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
const ELEMENTARY: [Elementary; 14] = [
    elementary!(sin, TURNS, TURNS, TURN_EDGES),
    elementary!(cos, TURNS, TURNS, TURN_EDGES),
    elementary!(tan, TURNS, TURNS, TURN_EDGES),
    elementary!(asin, (-1.0, 1.0), (-1.0, 1.0), UNIT_EDGES),
    elementary!(acos, (-1.0, 1.0), (-1.0, 1.0), UNIT_EDGES),
    elementary!(atan, LARGEST, LARGEST, UNIT_EDGES),
    elementary!(exp, EXPONENTS, (-708.0, 709.0), EXP_EDGES),
    elementary!(exp_m1, EXPONENTS, (-760.0, 709.0), EXP_EDGES),
    elementary!(ln, POSITIVE, POSITIVE, LN_EDGES),
    elementary!(ln_1p, (-BELOW_ONE, f64::MAX), (-BELOW_ONE, f64::MAX), &[-0.29, 0.41, -0.5, 1.0, -0.292_893_218_813_452_5]),
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

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..ProptestConfig::default()
    }
}

/// Numbers of a domain: evenly spread, of every magnitude, and close to the edges.
fn argument((lo, hi): (f64, f64), edges: &'static [f64]) -> impl Strategy<Value = f64> {
    let span = lo.max(-1e3)..hi.min(1e3);
    let near = (0..edges.len(), -64_i64..64)
        .prop_map(|(edge, steps)| f64::from_bits(edges[edge].to_bits().wrapping_add_signed(steps)));
    prop_oneof![
        span,
        (-1074.0..1024.0, any::<bool>()).prop_map(|(power, sign): (f64, bool)| if sign { power.exp2() } else { -power.exp2() }),
        (-60.0..20.0, any::<bool>()).prop_map(|(power, sign): (f64, bool)| if sign { power.exp2() } else { -power.exp2() }),
        near,
    ]
    .prop_filter("in the domain", move |x| lo <= *x && *x <= hi)
}

/// Width in units of the last place of the exact value.
fn width_ulp(enclosure: Interval, exact: &Bracket) -> f64 {
    let size = exact.nearest().abs();
    (enclosure.upper() - enclosure.lower()) / (size.next_up() - size)
}

/// Checks one argument and gives the width.
fn check_point(function: &Elementary, x: f64) -> Result<f64, TestCaseError> {
    let enclosure = (function.interval)(Interval::point(x));
    let exact = (function.exact)(x);
    prop_assert!(exact.lies_within(enclosure.bounds()), "{}({x:?}) = {exact:?} is not in {enclosure}", function.name);
    let width = width_ulp(enclosure, &exact);
    let tight = function.tight.0 <= x && x <= function.tight.1;
    prop_assert!(!tight || width <= ELEMENTARY_WIDTH_ULP, "{}({x:?}): {width} ulp, {enclosure}", function.name);
    Ok(if tight { width } else { 0.0 })
}

/// Random arguments of every function, and random elements of random intervals; gives the largest width of each function.
fn check_elementary(cases: u32) {
    for function in &ELEMENTARY {
        let widest = std::cell::Cell::new((0.0, 0.0));
        let total = std::cell::Cell::new(0.0);
        let arguments = argument(function.domain, function.edges);
        let other = argument(function.domain, function.edges);
        TestRunner::new(config(cases))
            .run(&(arguments, other, 0.0..1.0), |(x, y, weight): (f64, f64, f64)| {
                let width = check_point(function, x)?;
                total.set(total.get() + width);
                if width > widest.get().0 {
                    widest.set((width, x));
                }
                // Close neighbours and far ones.
                for y in [y, x + weight * 4.0, x * (1.0 + weight * 1e-3)] {
                    let Some(range) = Interval::new(x.min(y), x.max(y)) else { continue };
                    let inside = (x + weight * (y - x)).clamp(range.lower(), range.upper());
                    if range.lower() < function.domain.0 || range.upper() > function.domain.1 {
                        continue;
                    }
                    let enclosure = (function.interval)(range);
                    for element in [x, inside] {
                        let exact = (function.exact)(element);
                        prop_assert!(
                            exact.lies_within(enclosure.bounds()),
                            "{}({element:?}) = {exact:?} is not in {enclosure}, the values over {range}",
                            function.name
                        );
                    }
                }
                Ok(())
            })
            .unwrap_or_else(|failure| panic!("{failure}"));
        let (width, at) = widest.get();
        println!("{:6} widest {width:5.2} ulp at {at:?}, mean {:5.2}", function.name, total.get() / f64::from(cases));
    }
}

#[test]
fn elementary_functions_enclose_the_oracle() {
    check_elementary(300);
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
