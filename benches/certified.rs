//! Cost of an enclosed describing function, by quadrature and by closed form, and of the kernels' proofs.

#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{Bencher, black_box};
use selfosc::claims::{CLAIMS, Claim};
use selfosc::describing::{CATALOGUE, ClosedForm, Entry, KernelForm, certified};
use selfosc::nonlinearity::{Power, Sinusoid};
use selfosc::numeric::{Interval, Real};
use selfosc::proof::rigorous_quadrature::CellJet;

fn main() {
    divan::main();
}

/// The example of each page, at a bias of a fifth of its amplitude.
#[divan::bench(args = CATALOGUE.iter().map(|entry| entry.name), sample_count = 20)]
fn quadrature(bencher: Bencher, name: &str) {
    let entry = Entry::find(name).unwrap();
    let example = entry.example().unwrap();
    let values: Vec<_> = example.values.iter().map(|&value| CellJet::from_f64(value)).collect();
    let characteristic = entry.build(&values).unwrap();
    let number = CellJet::from_f64;
    let sweep = Sinusoid::new(number(0.2 * example.amplitude), number(example.amplitude)).unwrap();
    bencher.bench_local(|| certified(&*characteristic, black_box(&sweep)));
}

/// Exponents of drag and of springs; a whole one is smooth on either side of zero, the others are not.
#[divan::bench(args = [0.5, 1.0, 1.5, 1.7, 2.0, 3.0], sample_count = 20)]
fn power_law(bencher: Bencher, exponent: f64) {
    let number = CellJet::from_f64;
    let power = Power::new(number(1.0), number(exponent)).unwrap();
    let sweep = Sinusoid::new(number(0.2), number(1.0)).unwrap();
    bencher.bench_local(|| certified(&power, black_box(&sweep)));
}

/// The same sweeps by the closed forms in intervals.
#[divan::bench(args = CATALOGUE.iter().map(|entry| entry.name))]
fn closed_form(bencher: Bencher, name: &str) {
    let entry = Entry::find(name).unwrap();
    let example = entry.example().unwrap();
    let values: Vec<_> = example.values.iter().map(|&value| Interval::point(value)).collect();
    let characteristic = entry.build(&values).unwrap();
    let number = Interval::point;
    let sweep = Sinusoid::new(number(0.2 * example.amplitude), number(example.amplitude)).unwrap();
    bencher.bench_local(|| characteristic.describing_function(black_box(&sweep)));
}

/// Within the sweep, and where the sweep's end is near zero on either side: each series of the closed form.
#[divan::bench(args = [(0.5, 0.2), (0.5, 0.95), (0.5, 1.05), (1.5, 0.2), (1.5, 0.95), (1.5, 1.05), (1.7, 0.2), (1.7, 0.95),
    (1.7, 1.05), (2.0, 0.2), (2.0, 0.95), (2.0, 1.05), (3.0, 0.2), (3.0, 0.95), (3.0, 1.05), (1.7, 0.71), (1.7, 1.34)])]
fn closed_power(bencher: Bencher, (exponent, bias): (f64, f64)) {
    let power = Power::new(Interval::ONE, Interval::point(exponent)).unwrap();
    let sweep = Sinusoid::new(Interval::point(bias), Interval::ONE).unwrap();
    bencher.bench_local(|| power.describing_function(black_box(&sweep)));
}

#[divan::bench(sample_count = 3)]
fn kernels(bencher: Bencher) {
    let forms = [KernelForm::Step, KernelForm::Ramp, KernelForm::Sign, KernelForm::Band];
    bencher.bench_local(|| black_box(forms).map(|form| form.prove()));
}

#[divan::bench(sample_count = 3)]
fn proofs(bencher: Bencher) {
    bencher.bench_local(|| CLAIMS.iter().filter_map(Claim::prove).filter(|proof| black_box(proof).holds()).count());
}
