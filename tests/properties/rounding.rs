//! Proved bounds of rounding against what floats really do.

use dashu_float::round::mode::HalfEven;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use selfosc::describing::{CATALOGUE, DescribingFunction, Entry, RoundingBounds};
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::Sinusoid;
use selfosc::numeric::Interval;
use selfosc::numeric::rounded::{Double, Format, Rounded, Single};

use crate::fourier_oracle::{big, definition, describing_function};

/// Those whose closed form is not a sum over kernels.
const SMOOTH: [&str; 6] = ["power", "polynomial", "sine", "sinh", "arctan", "tanh"];
/// A bound of a piecewise-linear one is no larger than this many times the largest error found.
const FACTOR: f64 = 50.0;

fn parts(df: DescribingFunction<f64>) -> [f64; 3] {
    [df.f0, df.p, df.q]
}

/// Parameters, bias and amplitude, all of them single-precision numbers; corners are drawn more often.
fn draw(bounds: &RoundingBounds, rng: &mut Pcg64Mcg) -> (Vec<f32>, f32, f32) {
    #[allow(clippy::cast_possible_truncation, reason = "a float of the format")]
    let mut number = |(from, to): (f64, f64)| match rng.random_range(0..8) {
        0 => from as f32,
        1 => to as f32,
        _ => (from + (to - from) * rng.random::<f64>()) as f32,
    };
    let parameters = bounds.parameters.iter().map(|&range| number(range)).collect();
    (parameters, number(bounds.bias), number(bounds.amplitude))
}

/// The largest errors in single precision against double, of so many points.
fn found_in_single(entry: &Entry, bounds: &RoundingBounds, points: usize) -> [f64; 3] {
    let mut rng = Pcg64Mcg::seed_from_u64(0x51_4e);
    let mut worst = [0.0_f64; 3];
    for _ in 0..points {
        let (values, bias, amplitude) = draw(bounds, &mut rng);
        let single =
            entry.build(&values).unwrap().describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap();
        let wide: Vec<f64> = values.iter().copied().map(f64::from).collect();
        let sweep = Sinusoid::new(f64::from(bias), f64::from(amplitude)).unwrap();
        let double = parts(entry.build(&wide).unwrap().describing_function(&sweep).unwrap());
        let single = [single.f0, single.p, single.q].map(f64::from);
        worst = std::array::from_fn(|k| worst[k].max((single[k] - double[k]).abs()));
    }
    worst
}

/// The largest errors in double precision against 42 digits.
fn found_in_double(entry: &Entry, bounds: &RoundingBounds, points: usize) -> [f64; 3] {
    let mut rng = Pcg64Mcg::seed_from_u64(0xd0_b1);
    let mut worst = [0.0_f64; 3];
    for _ in 0..points {
        let mut number = |(from, to): (f64, f64)| from + (to - from) * rng.random::<f64>();
        let values: Vec<f64> = bounds.parameters.iter().map(|&range| number(range)).collect();
        let (bias, amplitude) = (number(bounds.bias), number(bounds.amplitude));
        let computed =
            entry.build(&values).unwrap().describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap();
        let (bias, amplitude) = (big(bias), big(amplitude));
        let exact = describing_function(&definition(entry.name, &values, &bias, &amplitude), &bias, &amplitude);
        for (k, computed) in parts(computed).into_iter().enumerate() {
            let error: dashu_float::FBig<HalfEven, 2> = big(computed) - &exact[k];
            worst[k] = worst[k].max(error.to_f64().value().abs());
        }
    }
    worst
}

fn hold(entry: &Entry, precision: &str, found: [f64; 3], bound: DescribingFunction<f64>, tight: bool) {
    for ((name, found), bound) in ["F_0", "P", "Q"].iter().zip(found).zip(parts(bound)) {
        assert!(found <= bound, "{} {precision}: {name} is off by {found:e}, bound {bound:e}", entry.name);
        let tight = !tight || SMOOTH.contains(&entry.name) || bound <= FACTOR * found;
        assert!(tight, "{} {precision}: bound of {name} {bound:e}, found {found:e}", entry.name);
    }
}

#[test]
fn every_entry_has_bounds() {
    assert!(CATALOGUE.iter().all(|entry| entry.rounding_bounds().is_some()));
}

#[test]
fn no_error_in_single_precision_is_larger() {
    CATALOGUE.par_iter().for_each(|entry| {
        let bounds = entry.rounding_bounds().unwrap();
        hold(entry, "f32", found_in_single(entry, &bounds, 50_000), bounds.single, true);
    });
}

#[test]
fn no_error_in_double_precision_is_larger() {
    CATALOGUE.par_iter().for_each(|entry| {
        let bounds = entry.rounding_bounds().unwrap();
        hold(entry, "f64", found_in_double(entry, &bounds, 40), bounds.double, false);
    });
}

/// The bounds that are stated are those that are proved, rounded up.
#[test]
fn bounds_are_proved() {
    CATALOGUE.par_iter().for_each(|entry| {
        let (stated, [double, single]) = (entry.rounding_bounds().unwrap(), entry.prove_rounding_bounds().unwrap());
        for (proved, stated) in [(double, stated.double), (single, stated.single)] {
            for (proved, stated) in parts(proved).into_iter().zip(parts(stated)) {
                assert!(proved <= stated && stated <= 1.15 * proved, "{}: {proved:e} stated as {stated:e}", entry.name);
            }
        }
    });
}

#[test]
fn pages_have_the_bounds() {
    for entry in CATALOGUE {
        let sentence = entry.rounding_sentence().unwrap();
        assert!(entry.page.contains(&sentence), "spec/characteristics/{}.md lacks:\n{sentence}", entry.name);
    }
}

/// Relay level, switching level, amplitude, bias, period, delay.
const OSCILLATION: [(f64, f64); 6] = [(0.5, 2.0), (0.25, 0.5), (1.0, 4.0), (-0.25, 0.25), (1.0, 4.0), (0.0, 0.25)];

fn oscillation<T: Copy>(inputs: &[T]) -> Oscillation<T> {
    Oscillation {
        relay_level: inputs[0],
        switch_level: inputs[1],
        amplitude: inputs[2],
        bias: inputs[3],
        period_s: inputs[4],
        delay_s: inputs[5],
    }
}

/// Bounds for inertia, linear and quadratic drag, disturbance over the whole of [`OSCILLATION`], divided into so many parts.
fn identification<F: Format>(halvings: usize) -> [f64; 4] {
    let mut parts = vec![OSCILLATION.map(|(from, to)| Interval::new(from, to).unwrap())];
    for step in 0..halvings {
        let halved = |part: &[Interval; 6]| {
            let (lower, upper) = part[step % 6].bisect();
            [lower, upper].map(|half| {
                let mut at = *part;
                at[step % 6] = half;
                at
            })
        };
        parts = parts.iter().flat_map(halved).collect();
    }
    parts.iter().fold([0.0; 4], |most, part| {
        let found = oscillation(&part.map(Rounded::<F>::input)).identify().unwrap();
        let errors = [found.alpha, found.beta, found.beta_quadratic, found.disturbance].map(Rounded::error);
        std::array::from_fn(|k| f64::max(most[k], errors[k]))
    })
}

/// As the documentation of `Oscillation::identify` has it.
#[test]
fn the_papers_identification() {
    let (double, single) = (identification::<Double>(12), identification::<Single>(12));
    assert!(double.iter().all(|bound| *bound < 1e-14), "{double:?}");
    assert!(single.iter().all(|bound| *bound < 5e-6), "{single:?}");
    let mut rng = Pcg64Mcg::seed_from_u64(0x150);
    for _ in 0..20_000 {
        #[allow(clippy::cast_possible_truncation, reason = "a float of the format")]
        let inputs = OSCILLATION.map(|(from, to)| (from + (to - from) * rng.random::<f64>()) as f32);
        let narrow = oscillation(&inputs).identify().unwrap();
        let wide = oscillation(&inputs.map(f64::from)).identify().unwrap();
        let narrow = [narrow.alpha, narrow.beta, narrow.beta_quadratic, narrow.disturbance].map(f64::from);
        let wide = [wide.alpha, wide.beta, wide.beta_quadratic, wide.disturbance];
        for k in 0..4 {
            assert!((narrow[k] - wide[k]).abs() <= single[k], "{inputs:?} {k}");
        }
    }
}
