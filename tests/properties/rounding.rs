//! Proved bounds of rounding against what floats really do.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use dashu_float::round::mode::HalfEven;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use selfosc::describing::{CATALOGUE, DescribingFunction, Entry, RoundingBounds};
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::{ParameterDomain, Sinusoid};

use crate::fourier_oracle::{big, definition, describing_function};
use crate::numeric::Interval;
use crate::numeric::rounded::{Double, Format, Rounded, Single};
use crate::tolerance;
use crate::wide::{Wide, wide};
use crate::wide_oracle;

/// Those whose closed form is not a sum over kernels.
const SMOOTH: [&str; 6] = ["power", "polynomial", "sine", "sinh", "arctan", "tanh"];
/// A bound of a piecewise-linear one is no larger than this many times the largest error found.
const FACTOR: f64 = 50.0;

fn parts(df: DescribingFunction<f64>) -> [f64; 3] {
    [df.f0, df.p, df.q]
}

/// Parameters, bias and amplitude; corners are drawn more often.
fn draw(bounds: &RoundingBounds, rng: &mut Pcg64Mcg) -> (Vec<f64>, f64, f64) {
    let mut number = |(from, to): (f64, f64)| match rng.random_range(0..8) {
        0 => from,
        1 => to,
        _ => from + (to - from) * rng.random::<f64>(),
    };
    let parameters = bounds.parameters.iter().map(|&range| number(range)).collect();
    (parameters, number(bounds.bias), number(bounds.amplitude))
}

fn largest(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k].max(b[k]))
}

fn off(computed: [f64; 3], exact: [Wide; 3]) -> [f64; 3] {
    std::array::from_fn(|k| (wide(computed[k]) - exact[k]).0.abs())
}

/// The errors of both precisions at one point, against 32 digits.
fn errors_at(entry: &Entry, bounds: &RoundingBounds, rng: &mut Pcg64Mcg) -> [[f64; 3]; 2] {
    let (values, bias, amplitude) = draw(bounds, rng);
    let computed = entry.build(&values).unwrap().describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap();
    let exact = wide_oracle::describing_function(entry.name, &values, bias, amplitude);
    let double = off(parts(computed), exact);
    #[allow(clippy::cast_possible_truncation, reason = "a float of the format")]
    let (values, bias, amplitude): (Vec<f32>, _, _) =
        (values.iter().map(|&value| value as f32).collect(), bias as f32, amplitude as f32);
    let computed = entry.build(&values).unwrap().describing_function(&Sinusoid::new(bias, amplitude).unwrap()).unwrap();
    let values: Vec<f64> = values.into_iter().map(f64::from).collect();
    let exact = wide_oracle::describing_function(entry.name, &values, f64::from(bias), f64::from(amplitude));
    [double, off([computed.f0, computed.p, computed.q].map(f64::from), exact)]
}

/// The largest of so many points.
fn found_of(entry: &Entry, bounds: &RoundingBounds, points: u64) -> [[f64; 3]; 2] {
    const CHUNK: u64 = 1000;
    let chunk = |seed: u64| {
        let mut rng = Pcg64Mcg::seed_from_u64(0x51_4e + seed);
        (0..CHUNK).fold([[0.0; 3]; 2], |most, _| {
            let errors = errors_at(entry, bounds, &mut rng);
            [largest(most[0], errors[0]), largest(most[1], errors[1])]
        })
    };
    (0..points / CHUNK)
        .into_par_iter()
        .map(chunk)
        .reduce(|| [[0.0; 3]; 2], |a, b| [largest(a[0], b[0]), largest(a[1], b[1])])
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

/// The fast oracle against the slow one, to what the slow one keeps.
#[test]
fn two_oracles_agree() {
    CATALOGUE.par_iter().for_each(|entry| {
        let (bounds, mut rng) = (entry.rounding_bounds().unwrap(), Pcg64Mcg::seed_from_u64(0x2_0a));
        for _ in 0..2 {
            let (values, bias, amplitude) = draw(&bounds, &mut rng);
            let found = wide_oracle::describing_function(entry.name, &values, bias, amplitude);
            let (b, a) = (big(bias), big(amplitude));
            let exact = describing_function(&definition(entry.name, &values, &b, &a), &b, &a);
            for (found, exact) in found.iter().zip(exact) {
                let apart: dashu_float::FBig<HalfEven, 2> = big(found.0) + big(found.1) - exact;
                let apart = apart.to_f64().value().abs();
                assert!(apart < tolerance::TWO_ORACLES, "{}: {apart:e} at {values:?}, {bias}, {amplitude}", entry.name);
            }
        }
    });
}

#[test]
fn no_error_of_a_sample_is_larger() {
    CATALOGUE.par_iter().for_each(|entry| {
        let bounds = entry.rounding_bounds().unwrap();
        let [double, single] = found_of(entry, &bounds, 10_000);
        hold(entry, "f64", double, bounds.double, false);
        hold(entry, "f32", single, bounds.single, true);
    });
}

/// `fixtures/rounding_million.txt` has what came out.
#[test]
#[ignore = "minutes: a million points of each entry, in both precisions"]
fn no_error_of_a_million_points_is_larger() {
    for entry in CATALOGUE {
        let bounds = entry.rounding_bounds().unwrap();
        for (precision, found, bound) in ["f64", "f32"]
            .iter()
            .zip(found_of(entry, &bounds, 1_000_000))
            .zip([bounds.double, bounds.single])
            .map(|((precision, found), bound)| (precision, found, bound))
        {
            let factors: Vec<String> = ["F_0", "P", "Q"]
                .iter()
                .zip(found)
                .zip(parts(bound))
                .filter(|(_, bound)| *bound > 0.0)
                .map(|((name, found), bound)| format!("{name} {found:.2e} of {bound:.1e} ({:.1})", bound / found))
                .collect();
            println!("{:27} {precision} {}", entry.name, factors.join(", "));
            hold(entry, precision, found, bound, true);
        }
    }
}

#[test]
fn no_error_in_double_precision_is_larger() {
    CATALOGUE.par_iter().for_each(|entry| {
        let bounds = entry.rounding_bounds().unwrap();
        hold(entry, "f64", found_in_double(entry, &bounds, 40), bounds.double, false);
    });
}

/// Boxes that a domain is divided into. A bound is finished where more of them lower it by a few percent only.
const BOXES: usize = 3000;

/// A box, and its bounds.
struct BoundedBox {
    at: Vec<Interval>,
    errors: [f64; 3],
    /// The largest error against the others' scale.
    rank: f64,
}

impl PartialEq for BoundedBox {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for BoundedBox {}
impl PartialOrd for BoundedBox {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for BoundedBox {
    fn cmp(&self, other: &Self) -> Ordering {
        self.rank.total_cmp(&other.rank)
    }
}

/// The largest bounds over the domain of `bounds`: the box with the largest is halved until there are enough.
fn proved<F: Format>(entry: &Entry, bounds: &RoundingBounds) -> [f64; 3] {
    let sides = bounds.parameters.iter().chain([&bounds.bias, &bounds.amplitude]);
    let domain: Vec<_> = sides.map(|&(from, to)| Interval::new(from, to).unwrap()).collect();
    let whole = errors::<F>(entry, &domain);
    let middle: Vec<_> = domain.iter().map(|side| Interval::point(side.midpoint())).collect();
    let scale = errors::<F>(entry, &middle).map(|error| error.max(F::UNIT * 1e-3));
    let rank = |errors: &[f64; 3]| errors.iter().zip(scale).map(|(error, scale)| error / scale).fold(0.0, f64::max);
    let mut open = BinaryHeap::from([BoundedBox { at: domain.clone(), errors: whole, rank: rank(&whole) }]);
    while open.len() < BOXES {
        let Some(part) = open.pop() else { break };
        let share = |k: &usize| if domain[*k].is_point() { 0.0 } else { part.at[*k].width() / domain[*k].width() };
        let Some(side) = (0..domain.len()).max_by(|a, b| share(a).total_cmp(&share(b))) else { break };
        let (lower, upper) = part.at[side].bisect();
        for half in [lower, upper] {
            let mut at = part.at.clone();
            at[side] = half;
            let errors = errors::<F>(entry, &at);
            open.push(BoundedBox { at, errors, rank: rank(&errors) });
        }
    }
    open.iter().fold([0.0; 3], |most, part| largest(most, part.errors))
}

/// Bounds over a box; infinite where there are none.
fn errors<F: Format>(entry: &Entry, at: &[Interval]) -> [f64; 3] {
    let inputs: Vec<_> = at.iter().map(|&side| Rounded::<F>::input(side)).collect();
    let df = inputs.split_last_chunk::<2>().and_then(|(values, &[bias, amplitude])| {
        entry.build(values).ok()?.describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok()
    });
    df.map_or([f64::INFINITY; 3], |df| [df.f0, df.p, df.q].map(Rounded::error))
}

/// The bounds that are stated are those that are proved, rounded up.
#[test]
fn bounds_are_proved() {
    CATALOGUE.par_iter().for_each(|entry| {
        let stated = entry.rounding_bounds().unwrap();
        let [double, single] = [proved::<Double>(entry, &stated), proved::<Single>(entry, &stated)];
        for (proved, stated) in [(double, stated.double), (single, stated.single)] {
            for (proved, stated) in proved.into_iter().zip(parts(stated)) {
                assert!(proved <= stated && stated <= 1.15 * proved, "{}: {proved:e} stated as {stated:e}", entry.name);
            }
        }
    });
}

/// The bounds in a sentence, as the page has it.
fn sentence(entry: &Entry, bounds: RoundingBounds) -> String {
    let between = |(from, to): (f64, f64)| if from < to { format!("{from} to {to}") } else { from.to_string() };
    let (mut inputs, mut values) = (Vec::new(), bounds.parameters.iter().copied());
    for parameter in entry.parameters {
        let value = match parameter.domain {
            ParameterDomain::Points => {
                let rest: Vec<_> = values.by_ref().map(between).collect();
                rest.chunks(2).map(|point| point.join(":")).collect::<Vec<_>>().join(",")
            }
            _ => between(values.next().unwrap()),
        };
        inputs.push(format!("`{}` {value}", parameter.name));
    }
    let last = format!("bias {} and amplitude {}", between(bounds.bias), between(bounds.amplitude));
    let number = |bound: f64| if bound > 0.0 { format!("{bound:e}") } else { "0".to_owned() };
    let numbers = |df: DescribingFunction<f64>| [df.f0, df.p, df.q].map(number).join(", ");
    format!(
        "**Rounding.** For all floats with {}, {last}, the computed `F_0`, `P`, `Q` are within {} of the exact values in f64 and within {} \
         in f32; `spec/rounding.md` gives the assumptions.",
        inputs.join(", "),
        numbers(bounds.double),
        numbers(bounds.single),
    )
}

#[test]
fn pages_have_the_bounds() {
    for entry in CATALOGUE {
        let sentence = sentence(entry, entry.rounding_bounds().unwrap());
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
    let mut answered = 0;
    for _ in 0..20_000 {
        #[allow(clippy::cast_possible_truncation, reason = "a float of the format")]
        let inputs = OSCILLATION.map(|(from, to)| (from + (to - from) * rng.random::<f64>()) as f32);
        // Where a long delay turns the inertia negative there is no answer to be wrong.
        let (Ok(narrow), Ok(wide)) = (oscillation(&inputs).identify(), oscillation(&inputs.map(f64::from)).identify())
        else {
            continue;
        };
        answered += 1;
        let narrow = [narrow.alpha, narrow.beta, narrow.beta_quadratic, narrow.disturbance].map(f64::from);
        let wide = [wide.alpha, wide.beta, wide.beta_quadratic, wide.disturbance];
        for k in 0..4 {
            assert!((narrow[k] - wide[k]).abs() <= single[k], "{inputs:?} {k}");
        }
    }
    assert!(answered > 15_000, "{answered}");
}
