//! The functions of `libm` in single precision, at every argument: what `Format::FUNCTIONS` of `Single` says of them.
//!
//! Sine, cosine and tangent up to 1024. `fixtures/libm_single.txt` has what came out.

use crate::numeric::rounded::{Format, Single};
use rayon::prelude::*;

/// A unit in the last place of single precision at a number.
fn unit(value: f64) -> f64 {
    const LEAST: f64 = 1.401_298_464_324_817e-45;
    let exponent = ((value.abs().to_bits() >> 52) as i32 - 1023).clamp(-126, 127);
    2f64.powi(exponent - 23).max(LEAST)
}

/// The largest error in units in the last place over all arguments up to a size, either sign where both are in the domain.
fn worst(single: fn(f32) -> f32, double: fn(f64) -> f64, most: f32, both: bool) -> (f64, f32) {
    let of = |bits: u32| {
        let x = f32::from_bits(bits);
        let exact = double(f64::from(x));
        let counts = exact.is_finite() && exact.abs() <= f64::from(f32::MAX);
        (if counts { (f64::from(single(x)) - exact).abs() / unit(exact) } else { 0.0 }, x)
    };
    let signs: &[u32] = if both { &[0, 1 << 31] } else { &[0] };
    let larger = |a: (f64, f32), b: (f64, f32)| if b.0 > a.0 { b } else { a };
    let all =
        |sign: u32| (0..=most.to_bits()).into_par_iter().map(move |bits| of(bits | sign)).reduce(|| (0.0, 0.0), larger);
    signs.iter().map(|&sign| all(sign)).fold((0.0, 0.0), larger)
}

#[test]
#[ignore = "minutes: every argument of every function"]
fn every_argument() {
    let units = Single::FUNCTIONS;
    let below_one = 1.0_f32.next_down();
    let functions: [(&str, fn(f32) -> f32, fn(f64) -> f64, f32, bool, f64); 16] = [
        ("sqrt", libm::sqrtf, libm::sqrt, f32::MAX, false, 0.5),
        ("sin", libm::sinf, libm::sin, 1024.0, true, units.sin_cos),
        ("cos", libm::cosf, libm::cos, 1024.0, true, units.sin_cos),
        ("tan", libm::tanf, libm::tan, 1024.0, true, units.tan),
        ("asin", libm::asinf, libm::asin, 1.0, true, units.asin),
        ("atan", libm::atanf, libm::atan, f32::MAX, true, units.atan),
        ("exp", libm::expf, libm::exp, 110.0, true, units.exp),
        ("exp_m1", libm::expm1f, libm::expm1, 110.0, true, units.exp),
        ("ln", libm::logf, libm::log, f32::MAX, false, units.ln),
        ("ln_1p below one", libm::log1pf, libm::log1p, below_one, true, units.ln),
        ("ln_1p", libm::log1pf, libm::log1p, f32::MAX, false, units.ln),
        ("sinh", libm::sinhf, libm::sinh, 95.0, true, units.hyperbolic),
        ("cosh", libm::coshf, libm::cosh, 95.0, true, units.hyperbolic),
        ("tanh", libm::tanhf, libm::tanh, 30.0, true, units.hyperbolic),
        ("atanh", libm::atanhf, libm::atanh, below_one, true, units.hyperbolic),
        ("floor", libm::floorf, libm::floor, f32::MAX, true, 0.0),
    ];
    for (name, single, double, most, both, limit) in functions {
        let (error, at) = worst(single, double, most, both);
        println!("{name:16} {error:.4} units at {at:e}");
        assert!(error <= limit, "{name} at {at:e}: {error} units, {limit} said");
    }
}
