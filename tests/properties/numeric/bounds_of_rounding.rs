//! The bounds against floats: every operation on random boxes, and an arithmetic that forgets most of its rounding.

use crate::numeric::rounded::format::Units;
use crate::numeric::rounded::{Double, Format, Rounded, Single};
use crate::numeric::{Interval, Real};

/// Every operation, of numbers near one; steep places and branches within.
fn formulas<T: Real>([a, b, c]: [T; 3]) -> Vec<T> {
    let half = T::from_f64(0.5);
    let u = half * (a - b);
    vec![
        a + b * c,
        (a - b) / c,
        a * T::from_f64(0.1) - b / T::from_f64(3.0),
        a.square() - b.square(),
        (a * b).sqrt() + (u.abs() + T::from_f64(0.01)).sqrt(),
        u.sin() * c.cos() - u.tan(),
        u.asin() - (a * c).atan(),
        u.exp() - u.exp_m1(),
        a.ln() + u.ln_1p(),
        u.sinh() + c.cosh() - a.tanh() + (half * u).atanh(),
        a.pow(b),
        a.max(b).min(c) + u.clamp_unit(),
        T::pi() * a - T::inverse_pi() * b,
        c.minus_own_sine(c.sin()) + (half * c).minus_own_sine((half * c).sin()),
        u.prefer(|| u * half, || half * u),
        u.abs().select(|| a, || b * a),
    ]
}

/// Splitmix64 (Steele, Lea and Flood, 2014).
struct Random(u64);

impl Random {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A single-precision number between 1/2 and 2.
    #[allow(clippy::cast_possible_truncation, reason = "a float of the format")]
    fn number(&mut self) -> f32 {
        (0.5 + 1.5 * self.share()) as f32
    }
}

/// How many floats lie outside their bounds, and how many there were.
fn outside<F: Format>(boxes: usize) -> (usize, usize) {
    let (mut random, mut count) = (Random(11), (0, 0));
    for _ in 0..boxes {
        let ends: [[f32; 2]; 3] = core::array::from_fn(|_| {
            let (from, width) = (random.number(), [0.0, 1e-6, 1e-2, 0.3][(4.0 * random.share()) as usize]);
            [from, (from * (1.0 + width)).min(2.0)]
        });
        let inputs = ends.map(|[from, to]| Interval::new(from.into(), to.into()).unwrap_or(Interval::ENTIRE));
        let bounds = formulas(inputs.map(Rounded::<F>::input));
        for _ in 0..20 {
            let point = ends.map(|[from, to]| (from + (to - from) * random.number() / 2.0).clamp(from, to));
            let (single, exact) = (formulas(point), formulas(point.map(f64::from)));
            for ((bound, single), exact) in bounds.iter().zip(single).zip(exact) {
                // The exact value is known to some roundings of double precision.
                let known = 1e-14;
                let error = (f64::from(single) - exact).abs();
                let inside = error <= bound.error() + known && bound.exact().inflate(known).contains(exact);
                count = (count.0 + usize::from(!inside), count.1 + 1);
            }
        }
    }
    count
}

#[test]
fn no_float_lies_outside() {
    assert_eq!(outside::<Single>(3000).0, 0);
}

/// Single precision whose rounding is thought to be eight times as small.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Careless;

impl Format for Careless {
    const UNIT: f64 = Single::UNIT / 8.0;
    const TINY: f64 = Single::TINY;
    const LARGEST: f64 = Single::LARGEST;
    const FUNCTIONS: Units = Single::FUNCTIONS;
    fn nearest(value: f64) -> f64 {
        Single::nearest(value)
    }
}

#[test]
fn too_small_a_unit_shows() {
    let (outside, all) = outside::<Careless>(300);
    assert!(outside > all / 100, "{outside} of {all}");
}

/// Where nothing is rounded, nothing is added.
#[test]
fn powers_of_two_and_zero_are_exact() {
    let x = Rounded::<Double>::input(Interval::UNIT);
    assert!((x * Rounded::from_f64(0.25)).error() < 1e-300);
    assert_eq!((x + Rounded::zero()).error(), 0.0);
    assert_eq!((x * Rounded::zero()).error(), 0.0);
    assert_eq!(Rounded::<Double>::from_f64(0.1).error(), 0.0);
    assert!(Rounded::<Single>::from_f64(0.1).error() > 1e-9);
}

/// A domain that is left gives no bound.
#[test]
fn outside_a_domain_nothing_is_known() {
    let x = Rounded::<Double>::input(Interval::UNIT);
    assert!((Rounded::one() / x).error().is_infinite());
    assert!(x.sqrt().error().is_infinite());
    assert!((x + Rounded::one() + Rounded::from_f64(0.1)).asin().error().is_infinite());
}
