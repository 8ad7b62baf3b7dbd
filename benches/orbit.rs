//! Benchmarks of the exact limit cycles. Targets: below 2 us without delay, 10 us with, no allocation.
#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{AllocProfiler, Bencher, black_box};
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::limit_cycle;
use selfosc::plant::DragAxis;

#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

/// Linear and quadratic drag, disturbance, delay in s.
const CASES: [(&str, [f64; 4]); 7] = [
    ("linear", [0.4, 0.0, 0.0, 0.0]),
    ("quadratic", [0.0, 0.5, 0.0, 0.0]),
    ("mixed", [0.2, 0.3, 0.0, 0.0]),
    ("mixed, disturbed", [0.2, 0.3, 0.4, 0.0]),
    ("mixed, disturbed, weak drag", [2e-4, 3e-4, 0.4, 0.0]),
    ("mixed, disturbed, strong drag", [20.0, 30.0, 0.4, 0.0]),
    ("mixed, disturbed, delayed", [0.2, 0.3, 0.4, 0.5]),
];

fn build(name: &str) -> (DragAxis<f64>, RelayHysteresis<f64>) {
    let [linear, quadratic, disturbance, delay_s] = CASES.iter().find(|case| case.0 == name).unwrap().1;
    let axis = DragAxis::mixed(1.0, linear, quadratic).unwrap();
    let axis = axis.with_disturbance(disturbance).unwrap().with_delay_s(delay_s).unwrap();
    (axis, RelayHysteresis::new(1.0, 0.3, 0.0).unwrap())
}

#[divan::bench(args = CASES.map(|case| case.0))]
fn exact_orbit(bencher: Bencher<'_, '_>, name: &str) {
    let (axis, relay) = build(name);
    bencher.bench(|| limit_cycle(black_box(&axis), black_box(&relay)).unwrap());
}
