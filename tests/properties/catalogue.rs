//! The catalogue against the oracle.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use selfosc::describing::{CATALOGUE, Entry};

use crate::cases::{Case, case};
use crate::fourier_oracle::{Big, big, definition, describing_function};
use crate::tolerance;

/// What a batch of comparisons showed.
#[derive(Clone, Debug, Default)]
struct Tally {
    /// Largest relative error of `F_0` and of `P`, `Q` (to the complex gain's magnitude) among those that meet the tolerance.
    worst: f64,
    /// Values whose error is above the tolerance but no larger than what rounding the input does to the exact value.
    conditioned: usize,
    failures: Vec<String>,
}

/// The exact value, with one input moved by about half a unit in its last place: a parameter, the bias (by that of the
/// sweep's far end, as which it enters), or the amplitude.
fn exact(entry: &Entry, case: &Case, moved: Option<usize>) -> [Big; 3] {
    let mut values = case.values.clone();
    let (mut bias, mut amplitude) = (big(case.sweep.bias()), big(case.sweep.amplitude()));
    let half = big(f64::EPSILON / 2.0);
    match moved {
        Some(k) if k < values.len() => values[k] *= 1.0 + f64::EPSILON,
        Some(k) if k == values.len() => bias += big(case.sweep.bias().abs() + case.sweep.amplitude()) * half,
        Some(_) => amplitude = &amplitude * (big(1.0) + half),
        None => {}
    }
    describing_function(&definition(entry.name, &values, &bias, &amplitude), &bias, &amplitude)
}

fn compare(entry: &Entry, case: &Case) -> Tally {
    let mut tally = Tally::default();
    let computed = case.characteristic.describing_function(&case.sweep).unwrap();
    let reference = exact(entry, case, None);
    let computed = [computed.f0, computed.p, computed.q];
    let mut spread: Option<[f64; 3]> = None;
    for part in 0..3 {
        let error = (big(computed[part]) - &reference[part]).to_f64().value().abs();
        // P and Q are parts of one complex gain.
        let of = |part: usize| reference[part].to_f64().value().abs();
        let size = if part == 0 { of(0) } else { of(1).hypot(of(2)) };
        let largest = of(0) + case.sweep.amplitude() * of(1).hypot(of(2));
        let unit = if part == 0 { 1.0 } else { case.sweep.amplitude() };
        if error <= tolerance::CLOSED_FORM * size || error * unit <= tolerance::ORACLE * largest {
            tally.worst = tally.worst.max(if error <= tolerance::CLOSED_FORM * size { error / size } else { 0.0 });
            continue;
        }
        let spread = spread.get_or_insert_with(|| {
            let mut spread = [0.0; 3];
            for input in 0..case.values.len() + 2 {
                let moved = exact(entry, case, Some(input));
                for part in 0..3 {
                    spread[part] += (&moved[part] - &reference[part]).to_f64().value().abs();
                }
            }
            spread
        });
        if error <= tolerance::CONDITION * spread[part] {
            tally.conditioned += 1;
        } else {
            tally.failures.push(format!(
                "{} {:?} bias {:e} amplitude {:e}: {} = {:e}, exact {:e}, relative error {:.1e}, rounding the input {:.1e}",
                entry.name,
                case.values,
                case.sweep.bias(),
                case.sweep.amplitude(),
                ["F_0", "P", "Q"][part],
                computed[part],
                reference[part].to_f64().value(),
                error / size,
                spread[part] / size,
            ));
        }
    }
    tally
}

fn sets(entry: &Entry, count: u64) -> Tally {
    let tallies = (0..count).into_par_iter().map(|seed| {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        compare(entry, &case(entry, &mut rng))
    });
    tallies.reduce(Tally::default, |a, b| Tally {
        worst: a.worst.max(b.worst),
        conditioned: a.conditioned + b.conditioned,
        failures: [a.failures, b.failures].concat(),
    })
}

fn all(count: u64) {
    let mut failures = Vec::new();
    let only = std::env::var("SELFOSC_ONLY").ok();
    for entry in
        CATALOGUE.iter().filter(|entry| only.as_ref().is_none_or(|only| only.split(',').any(|name| name == entry.name)))
    {
        let started = std::time::Instant::now();
        let tally = sets(entry, count);
        println!(
            "{:28} worst {:.1e}  ill-conditioned {:4}  failures {:4}  {:.1} s",
            entry.name,
            tally.worst,
            tally.conditioned,
            tally.failures.len(),
            started.elapsed().as_secs_f64()
        );
        for failure in tally.failures.into_iter().take(6) {
            println!("    {failure}");
            failures.push(failure);
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn closed_forms_equal_the_oracle() {
    all(4);
}

#[test]
#[ignore = "1000 parameter sets take minutes, most of them for the arc tangent; SELFOSC_ONLY=name,name picks entries"]
fn closed_forms_equal_the_oracle_at_1000_sets() {
    all(1000);
}
