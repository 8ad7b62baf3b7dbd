//! What the tests of bounds share: a formula in floats, in `Rounded` over a domain divided into boxes, and in 42 digits.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::order::{Compared, every_way};
use super::{Double, Format, Rounded, Single};
use crate::numeric::{Interval, Scalar};

pub(crate) type Big = FBig<HalfEven, 2>;

/// 42 decimal digits.
pub(crate) fn big(x: f64) -> Big {
    Big::try_from(x).unwrap().with_precision(140).value()
}

/// `N` inputs, `M` results; exactly by an expression of its own.
pub(crate) trait Formula<const N: usize, const M: usize> {
    /// What is judged.
    fn of<T: Scalar>(inputs: [T; N]) -> [T; M];
    /// What judges.
    fn exact(inputs: [Big; N]) -> [Big; M];
}

/// The largest bounds over a domain, each side of it divided into so many parts; infinite where there is none.
fn proved<F: Format, const N: usize, const M: usize, C: Formula<N, M>>(
    domain: [(f64, f64); N],
    parts: [u32; N],
) -> [f64; M] {
    let boxes: u32 = parts.iter().product();
    (0..boxes).fold([0.0; M], |most: [f64; M], mut number| {
        let inputs = core::array::from_fn(|k| {
            let ((from, to), place) = (domain[k], f64::from(number % parts[k]));
            number /= parts[k];
            let at = |place: f64| from + (to - from) * place / f64::from(parts[k]);
            Compared(Rounded::<F>::input(Interval::new(at(place), at(place + 1.0).min(to)).unwrap()))
        });
        let Some(ways) = every_way(|| C::of(inputs)) else { return [f64::INFINITY; M] };
        ways.iter().fold(most, |most, results| core::array::from_fn(|k| most[k].max(results[k].0.error())))
    })
}

/// That the bounds, in double and in single precision, are proved and stated no more than 15 % above, that no error found exceeds them,
/// and that an error found is within a factor of 100 of them.
pub(crate) fn hold<const N: usize, const M: usize, C: Formula<N, M>>(
    domain: [(f64, f64); N],
    parts: [u32; N],
    stated: [[f64; M]; 2],
) {
    let mut random = Pcg64::seed_from_u64(0xb0_5d);
    let mut found = [[0.0_f64; M]; 2];
    for _ in 0..5000 {
        let mut number = |(from, to): (f64, f64)| match random.random_range(0..8) {
            0 => from,
            1 => to,
            _ => from + (to - from) * random.random::<f64>(),
        };
        let wide = domain.map(&mut number);
        let narrow = wide.map(|input| input as f32);
        let (double, exact) = (C::of(wide), C::exact(wide.map(big)));
        let single = C::of(narrow).map(f64::from);
        let from_single = C::exact(narrow.map(|input| big(f64::from(input))));
        for k in 0..M {
            let apart = |computed: f64, exact: &Big| (big(computed) - exact).to_f64().value().abs();
            found[0][k] = found[0][k].max(apart(double[k], &exact[k]));
            found[1][k] = found[1][k].max(apart(single[k], &from_single[k]));
        }
    }
    let proved = [proved::<Double, N, M, C>(domain, parts), proved::<Single, N, M, C>(domain, parts)];
    let told = format!("found {found:?}, proved {proved:?}, stated {stated:?}");
    for precision in 0..2 {
        for k in 0..M {
            let (found, proved, stated) = (found[precision][k], proved[precision][k], stated[precision][k]);
            assert!(found <= stated && stated <= 100.0 * found, "{told}");
            assert!(proved <= stated && stated <= 1.15 * proved, "{told}");
        }
    }
}

#[test]
fn every_case_is_followed() {
    let input = |from, to| Compared(Rounded::<Double>::input(Interval::new(from, to).unwrap()));
    let [one, x] = [input(1.0, 1.0), input(-2.0, 2.0)];
    let case = |x: Compared<Double>| if x < -one { -1 } else { i32::from(x > one) };
    assert_eq!(every_way(|| case(x)), Some(vec![-1, 1, 0]));
    assert_eq!(every_way(|| case(input(2.0, 3.0))), Some(vec![1]));
    // A third of three may be one or not.
    let three = input(3.0, 3.0);
    assert_eq!(every_way(|| one / three * three > one), None);
    assert_eq!(every_way(|| one / three > one), Some(vec![false]));
}
