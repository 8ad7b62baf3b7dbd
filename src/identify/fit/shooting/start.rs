//! Where the search starts: parameters from weighted integrals of the record, states from its neighbourhood.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use crate::experiment::Record;
use crate::identify::answer::DragLaw;
use crate::identify::signal::half_period_s;
use crate::plant::State;

/// Inertia, one drag coefficient and disturbance that satisfy the axis's equation under smooth weights, each as long as a
/// swing: derivatives fall on the weight, so that noise is not differentiated.
pub(super) fn parameters(record: &Record, law: DragLaw, delay_s: f64) -> Option<[f64; 3]> {
    let swing = half_period_s(record);
    let (time, output, input) = (record.time_s(), record.output(), record.input());
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    let reach = (swing / (8.0 * record.interval_s())).max(1.0) as usize;
    let mut equations: Vec<[f64; 4]> = Vec::new();
    let mut begin = time[0] + delay_s;
    let mut first = 0;
    while begin + swing <= time[time.len() - 1] {
        while time[first] < begin {
            first += 1;
        }
        let last = first + time[first..].partition_point(|t| *t <= begin + swing);
        let mut sums = [0.0; 4];
        let mut command = time.partition_point(|t| *t <= begin - delay_s).saturating_sub(1);
        let middle = output[first];
        for k in first.max(1)..last.min(time.len() - 1) {
            let weight = 0.5 * (time[k + 1] - time[k - 1]);
            let angle = core::f64::consts::TAU * (time[k] - begin) / swing;
            let rate = core::f64::consts::TAU / swing;
            let (value, slope, bend) =
                (0.5 * (1.0 - angle.cos()), 0.5 * rate * angle.sin(), 0.5 * rate * rate * angle.cos());
            while command + 1 < time.len() && time[command + 1] <= time[k] - delay_s {
                command += 1;
            }
            let (back, ahead) = (k.saturating_sub(reach), (k + reach).min(time.len() - 1));
            let speed = (output[ahead] - output[back]) / (time[ahead] - time[back]);
            sums[0] += weight * bend * (output[k] - middle);
            sums[1] += weight
                * if law == DragLaw::Quadratic { value * speed * speed.abs() } else { -slope * (output[k] - middle) };
            sums[2] -= weight * value;
            sums[3] += weight * value * input[command];
        }
        equations.push(sums);
        begin += 0.3 * swing;
    }
    if equations.len() < 4 {
        return None;
    }
    let qr = DMatrix::from_fn(equations.len(), 3, |row, column| equations[row][column]).qr();
    let mut right = DVector::from_fn(equations.len(), |row, _| equations[row][3]);
    qr.q_tr_mul(&mut right);
    // Singular equations say nothing: the fallback below takes over.
    let solution = qr.unpack_r().solve_upper_triangular(&right.rows(0, 3)).unwrap_or_else(|| DVector::zeros(3));
    let force = 0.5 * input.iter().map(|value| value.abs()).fold(0.0, f64::max);
    let span =
        output.iter().copied().fold(f64::NEG_INFINITY, f64::max) - output.iter().copied().fold(f64::INFINITY, f64::min);
    // Orders of magnitude where noise makes an answer impossible.
    let speed = span / swing;
    let fallback = [force * swing / speed, force / if law == DragLaw::Quadratic { speed * speed } else { speed }];
    let or = |value: f64, fallback: f64| {
        if value > 0.02 * fallback && value < 50.0 * fallback { value } else { 0.3 * fallback }
    };
    let disturbance = solution[2].clamp(-force, force);
    Some([or(solution[0], fallback[0]), or(solution[1], fallback[1]), disturbance])
}

/// State at a time from the parabola of least squares through the samples within `reach_s`.
pub(super) fn state_near(record: &Record, at_s: f64, reach_s: f64) -> State<f64> {
    let (time, output) = (record.time_s(), record.output());
    let reach = reach_s.max(1.6 * record.interval_s());
    let from = time.partition_point(|t| *t < at_s - reach).min(time.len() - 3);
    let to = time.partition_point(|t| *t <= at_s + reach).max(from + 3).min(time.len());
    let offset = output[from];
    let (mut t, mut m) = ([0.0; 5], [0.0; 3]);
    for k in from..to {
        let s = (time[k] - at_s) / reach;
        let mut power = 1.0;
        for order in 0..5 {
            t[order] += power;
            if order < 3 {
                m[order] += power * (output[k] - offset);
            }
            power *= s;
        }
    }
    let moments = Matrix3::new(t[0], t[1], t[2], t[1], t[2], t[3], t[2], t[3], t[4]);
    match moments.lu().solve(&Vector3::from(m)) {
        Some(line) => State { position: offset + line[0], velocity: line[1] / reach },
        None => State { position: output[from], velocity: 0.0 },
    }
}
