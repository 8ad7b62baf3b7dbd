//! What a controller costs on board, and what its margins cost at the desk.

use divan::Bencher;
use selfosc::control::{Controller, FeedForward, LinearProcess, OpenLoop, ProcessIntervals, Structure, Tuning};
use selfosc::numeric::Interval;
use selfosc::plant::DragAxis;

fn main() {
    divan::main();
}

fn tuned() -> Option<Tuning<f64>> {
    let axis = DragAxis::mixed(0.033, 0.01, 0.06).ok()?.with_delay_s(0.2).ok()?;
    Tuning::new(&axis, Structure::Pid, 0.8).ok()
}

/// One step with limits, on a circle, along a guided reference.
#[divan::bench]
fn step(bencher: Bencher) {
    let ready = || -> Option<Controller<f64>> {
        let tuning = tuned()?;
        let along = FeedForward::new(tuning.axis(), 1.0, None).ok()?;
        let controller = Controller::new(tuning.gains()).with_limits(-0.1, 0.1).ok()?;
        Some(controller.on_circle(core::f64::consts::TAU).ok()?.with_feed_forward(along))
    };
    let Some(mut controller) = ready() else { return };
    let mut heading = 0.0;
    bencher.bench_local(|| {
        heading += 0.01;
        controller.step(divan::black_box(1.0), divan::black_box(heading), 0.1)
    });
}

#[divan::bench]
fn margins(bencher: Bencher) {
    let Some(open_loop) = tuned().and_then(|t| OpenLoop::new(t.axis(), t.gains(), 0.0).ok()) else { return };
    bencher.bench(|| divan::black_box(open_loop).margins());
}

#[divan::bench]
fn worst_margins(bencher: Bencher) {
    let between = |low, high| Interval::new(low, high).unwrap_or(Interval::ENTIRE);
    let mut parts = [Interval::ZERO; 9];
    (parts[0], parts[1], parts[8]) = (between(0.031, 0.035), between(0.005, 0.08), between(0.18, 0.22));
    let (Some(tuning), Ok(intervals)) = (tuned(), ProcessIntervals::new(LinearProcess::from_parts(parts))) else {
        return;
    };
    bencher.bench(|| intervals.worst_margins(tuning.gains()));
}
