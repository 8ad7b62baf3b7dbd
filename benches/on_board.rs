//! Benchmarks of the experiment on board. Target: below 200 ns for a sample, no allocation.
#![allow(clippy::unwrap_used, reason = "a benchmark may panic")]

use divan::{AllocProfiler, Bencher, black_box};
use selfosc::identify::DragLaw;
use selfosc::numeric::Scalar;
use selfosc::on_board::{Coordinate, Experiment, Phase, Protocol};

#[global_allocator]
static ALLOCATOR: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

/// An experiment that goes on for long.
fn running<T: Scalar>(coordinate: Coordinate) -> Experiment<T> {
    let number = T::from_f64;
    let protocol = Protocol::new(coordinate, number(1.0), number(0.5), number(50.0), number(0.1));
    Experiment::new(Protocol { cycles: 200, most_cycles: 250, duration_s: number(1e4), ..protocol }).unwrap()
}

/// Samples of a sinusoid (its integral too passes both levels), in batches of a thousand: the time of one is a thousandth of this.
fn thousand<T: Scalar>(experiment: &mut Experiment<T>, readings: &[T]) -> Phase {
    let mut phase = Phase::Running;
    for (sample, reading) in readings.iter().enumerate() {
        phase = experiment.step(*black_box(reading), T::from_f64(0.1 * sample as f64)).phase;
    }
    phase
}

/// Periods of 40 samples: one sample in 40 completes a cycle.
#[divan::bench(types = [f32, f64], args = [Coordinate::Position, Coordinate::HeadingDegrees, Coordinate::Speed])]
fn thousand_samples<T: Scalar>(bencher: Bencher<'_, '_>, coordinate: Coordinate) {
    let angle = |sample: u32| f64::from(sample) * core::f64::consts::TAU / 40.0;
    let readings: Vec<T> = (0..1000).map(|sample| T::from_f64(angle(sample).cos())).collect();
    bencher.with_inputs(|| running::<T>(coordinate)).bench_local_refs(|experiment| {
        let phase = thousand(experiment, &readings);
        assert_eq!(phase, Phase::Running);
    });
}

/// The longest single call: it completes a cycle, the cycles are alike, and condition 40 is checked.
#[divan::bench(types = [f32, f64])]
fn last_sample<T: Scalar>(bencher: Bencher<'_, '_>) {
    let number = T::from_f64;
    let reading = |sample: u32| number((f64::from(sample) * core::f64::consts::TAU / 40.0).sin());
    let time_s = |sample: u32| number(0.1 * f64::from(sample));
    let protocol = Protocol::new(Coordinate::Position, number(1.0), number(0.5), number(50.0), number(0.1));
    let (mut experiment, mut sample) = (Experiment::new(protocol).unwrap(), 0);
    let before = loop {
        let before = experiment;
        if experiment.step(reading(sample), time_s(sample)).phase != Phase::Running {
            assert_eq!(experiment.phase(), Phase::Done);
            break before;
        }
        sample += 1;
    };
    bencher
        .with_inputs(|| before)
        .bench_local_refs(|experiment| experiment.step(black_box(reading(sample)), black_box(time_s(sample))));
}

/// The identification afterwards, by orbit inversion.
#[divan::bench(types = [f32, f64], args = [DragLaw::Linear, DragLaw::Quadratic])]
fn identification<T: Scalar>(bencher: Bencher<'_, '_>, law: DragLaw) {
    let number = T::from_f64;
    let mut experiment =
        Experiment::new(Protocol::new(Coordinate::Position, number(1.0), number(0.5), number(50.0), number(0.1)))
            .unwrap();
    for sample in 0..1000 {
        let angle = f64::from(sample) * core::f64::consts::TAU / 40.0;
        experiment.step(number(angle.sin()), number(0.1 * f64::from(sample)));
    }
    let outcome = experiment.outcome().unwrap();
    bencher.bench_local(|| black_box(&outcome).exact(law, number(0.1)).unwrap());
}
