//! Benchmarks of the proofs about exact orbits: search, check of the proof found, certificate of one axis.
#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{Bencher, black_box};
use selfosc::claims::{CLAIMS, Claim};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::certify;
use selfosc::orbit::theorem::Theorem;
use selfosc::plant::DragAxis;

fn main() {
    divan::main();
}

fn theorem(id: &str) -> &'static Theorem {
    CLAIMS.iter().filter_map(Claim::theorem).find(|theorem| theorem.id == id).unwrap()
}

fn ids() -> impl Iterator<Item = &'static str> {
    CLAIMS.iter().filter_map(Claim::theorem).map(|theorem| theorem.id)
}

#[divan::bench(args = ids())]
fn search(bencher: Bencher<'_, '_>, id: &str) {
    bencher.bench(|| black_box(theorem(id)).prove().unwrap());
}

#[divan::bench(args = ids())]
fn check(bencher: Bencher<'_, '_>, id: &str) {
    let theorem = theorem(id);
    let proofs = theorem.prove().unwrap();
    bencher.bench(|| {
        for (inequality, proof) in theorem.inequalities.iter().zip(&proofs) {
            inequality.check(black_box(proof)).unwrap();
        }
    });
}

/// Linear and quadratic drag, disturbance, delay in s.
#[divan::bench(args = [[0.4, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.2, 0.3, 0.4, 0.0], [0.2, 0.3, 0.4, 0.5]])]
fn one_axis(bencher: Bencher<'_, '_>, case: &[f64; 4]) {
    let axis = DragAxis::mixed(1.0, case[0], case[1]).unwrap();
    let axis = axis.with_disturbance(case[2]).unwrap().with_delay_s(case[3]).unwrap();
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0).unwrap();
    bencher.bench(|| certify(black_box(&axis), black_box(&relay)).unwrap());
}
