//! The filter against a dense Gaussian likelihood that knows nothing of filters; gradients against differences.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::confounded_lags::chains;
use super::filter::{self, Evaluation};
use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::Observations;
use super::rounding;
use super::scoring::Fitted;
use crate::experiment::Record;
use crate::identify::answer::Term;
use crate::identify::signal::{Clock, SwitchingInstant};

/// A command that switches, and an output about the motion that [`model`] has.
fn record() -> Record {
    record_of(&model())
}

/// The same about the motion of another model.
fn record_of(model: &VehicleModel) -> Record {
    let time: Vec<f64> = (0..60).map(|k| 0.1 * f64::from(k)).collect();
    let input: Vec<f64> = (0..60).map(|k| if (k / 13) % 2 == 0 { 1.0 } else { -1.0 }).collect();
    // Of a reading that is zero the innovation is the prediction's negative.
    let gentle = time.iter().map(|t| (0.5 * t).sin()).collect();
    let gentle = Record::new(time.clone(), gentle, input.clone()).expect("a record");
    let mut observations = Observations::new(&gentle, Clock::Stamps, SwitchingInstant::AtSamples);
    observations.signal.output.fill(0.0);
    observations.weight.fill(1.0);
    let mut unheeded = model.clone();
    // Readings of no weight leave the motion to itself.
    unheeded.set_noise(NoiseParameter::White, 1e12, true);
    let pass = filter::run(&observations, &unheeded, Evaluation::Likelihood).expect("a pass");
    let wiggle = |k: usize| 0.02 * (17.0 * time[k]).cos() + 0.01 * (2.3 * time[k]).sin();
    let output = pass.innovations.iter().enumerate().map(|(k, innovation)| wiggle(k) - innovation.error).collect();
    Record::new(time.clone(), output, input).expect("a record")
}

fn model() -> VehicleModel {
    let mut model = VehicleModel {
        values: [0.0; Parameter::COUNT],
        free: [false; Parameter::COUNT],
        noise: [f64::NEG_INFINITY; NoiseParameter::COUNT],
        noise_free: [false; NoiseParameter::COUNT],
        switching: SwitchingInstant::AtSamples,
        clock: Clock::Stamps,
    };
    for (parameter, value) in [
        (Parameter::Alpha, 0.9),
        (Parameter::LinearDrag, 0.6),
        (Parameter::Disturbance, 0.1),
        (Parameter::DelayS, 0.13),
        (Parameter::Position, 0.05),
        (Parameter::Velocity, 0.4),
    ] {
        model.set(parameter, value, true);
    }
    model.set_noise(NoiseParameter::White, 4e-4, true);
    model
}

/// Position under unit force, and after a unit velocity: the kernel of `alpha x'' + beta x' = f`.
fn kernel(model: &VehicleModel, t: f64) -> f64 {
    let (alpha, beta) = (model.value(Parameter::Alpha), model.value(Parameter::LinearDrag));
    (1.0 - (-beta / alpha * t).exp()) / beta
}

/// Spacing of a table of responses, in s.
const SPACING_S: f64 = 5e-4;

/// Positions after a push, or after a late speed of one, [`SPACING_S`] apart: with drag that follows late the axis is linear in
/// three states, and an exponential takes them over a step.
fn responses(model: &VehicleModel, begin: Vector3<f64>) -> Vec<f64> {
    let [alpha, beta, memory, time_s] =
        [Parameter::Alpha, Parameter::LinearDrag, Parameter::Memory, Parameter::MemoryS].map(|p| model.value(p));
    let rates = Matrix3::new(0.0, 1.0, 0.0, 0.0, -beta / alpha, -memory / alpha, 0.0, 1.0 / time_s, -1.0 / time_s);
    let step = (rates * SPACING_S).exp();
    core::iter::successors(Some(begin), |state| Some(step * state)).take(12_000).map(|state| state[0]).collect()
}

#[test]
fn with_drag_that_follows_late_too() {
    let mut model = model();
    model.set(Parameter::Memory, 0.3, true);
    model.set(Parameter::MemoryS, 0.7, true);
    let observations = Observations::new(&record_of(&model), Clock::Stamps, SwitchingInstant::AtSamples);
    let alpha = model.value(Parameter::Alpha);
    let pushed = responses(&model, Vector3::new(0.0, 1.0 / alpha, 0.0));
    let late = responses(&model, Vector3::new(0.0, 0.0, 1.0));
    let input = |t: f64| {
        let at = t - model.value(Parameter::DelayS);
        let piece = observations.pieces.iter().rev().find(|piece| piece.begin_s <= at + 1e-12);
        piece.unwrap_or(&observations.pieces[0]).value + model.value(Parameter::Disturbance)
    };
    let samples = observations.time_s.len();
    // Samples are 200 spacings apart; the middles of 100 steps between them are on the table.
    let mean = |sample: usize| {
        let forced = |step: usize| {
            2.0 * SPACING_S * pushed[200 * sample - 2 * step - 1] * input((2 * step + 1) as f64 * SPACING_S)
        };
        let moving = alpha * model.value(Parameter::Velocity) * pushed[200 * sample];
        model.value(Parameter::Position) + moving + (0..100 * sample).map(forced).sum::<f64>()
    };
    let unknown = (0.5 * observations.fastest).powi(2);
    let covariance = DMatrix::from_fn(samples, samples, |i, j| {
        unknown * late[200 * i] * late[200 * j] + if i == j { model.size(NoiseParameter::White) } else { 0.0 }
    });
    let off = DVector::from_fn(samples, |k, _| observations.output[k] - mean(k));
    let factor = covariance.cholesky().expect("a covariance");
    let determinant: f64 = factor.l().diagonal().iter().map(|d| 2.0 * d.ln()).sum();
    let expected = -0.5 * (samples as f64 * core::f64::consts::TAU.ln() + determinant + off.dot(&factor.solve(&off)));
    let found = filter::run(&observations, &model, Evaluation::Likelihood).expect("a pass").log_likelihood;
    assert!((found - expected).abs() < 0.1, "{found} for {expected}");
}

/// Log-likelihood of the readings as one normal vector: mean by the integral over the kernel, covariance by sums over a grid.
fn dense(observations: &Observations, model: &VehicleModel) -> f64 {
    let n = observations.time_s.len();
    let alpha = model.value(Parameter::Alpha);
    let input = |t: f64| {
        let at = t - model.value(Parameter::DelayS);
        let piece = observations.pieces.iter().rev().find(|piece| piece.begin_s <= at + 1e-12);
        piece.unwrap_or(&observations.pieces[0]).value + model.value(Parameter::Disturbance)
    };
    let fine = 100;
    let h = 0.1 / f64::from(fine);
    let mean: Vec<f64> = observations
        .time_s
        .iter()
        .enumerate()
        .map(|(k, t)| {
            let steps = k * fine as usize;
            let forced: f64 =
                (0..steps).map(|j| (j as f64 + 0.5) * h).map(|s| h * kernel(model, t - s) * input(s)).sum();
            model.value(Parameter::Position) + alpha * kernel(model, *t) * model.value(Parameter::Velocity) + forced
        })
        .collect();
    // The walk's increments reach the position by the integral of the kernel.
    let (intensity, colour, rate) =
        (model.size(NoiseParameter::Force), model.size(NoiseParameter::Colour), model.size(NoiseParameter::ColourRate));
    let beta = model.value(Parameter::LinearDrag);
    let reach = |since: f64| if since <= 0.0 { 0.0 } else { (since - alpha * kernel(model, since)) / beta };
    let begin = 0.5 * colour / (rate + 1.0 / observations.duration_s());
    let covariance = DMatrix::from_fn(n, n, |i, j| {
        let (early, late) = (i.min(j), i.max(j));
        let (s, t) = (observations.time_s[early], observations.time_s[late]);
        let steps = early * 20;
        let walk: f64 =
            (0..steps).map(|k| (k as f64 + 0.5) * 0.005).map(|r| 0.005 * intensity * reach(s - r) * reach(t - r)).sum();
        let stationary = if rate > 0.0 { 0.5 * colour / rate } else { 0.0 };
        let kept = (-2.0 * rate * s).exp();
        let coloured = (begin * kept + stationary * (1.0 - kept)) * (-rate * (t - s)).exp();
        walk + coloured + if i == j { model.size(NoiseParameter::White) } else { 0.0 }
    });
    let off = DVector::from_fn(n, |k, _| observations.output[k] - mean[k]);
    let factor = covariance.cholesky().expect("a covariance");
    let determinant: f64 = factor.l().diagonal().iter().map(|d| 2.0 * d.ln()).sum();
    -0.5 * (n as f64 * core::f64::consts::TAU.ln() + determinant + off.dot(&factor.solve(&off)))
}

#[test]
fn the_filter_s_likelihood_is_that_of_the_dense_normal_vector() {
    let observations = Observations::new(&record(), Clock::Stamps, SwitchingInstant::AtSamples);
    let mut noisy = model();
    noisy.set_noise(NoiseParameter::Colour, 3e-4, true);
    noisy.set_noise(NoiseParameter::ColourRate, 0.8, true);
    let mut forced = noisy.clone();
    forced.set_noise(NoiseParameter::Force, 0.02, true);
    for (model, tolerance) in [(model(), 0.02), (noisy, 0.02), (forced, 0.05)] {
        let pass = filter::run(&observations, &model, Evaluation::Likelihood).expect("a pass");
        let expected = dense(&observations, &model);
        let off = (pass.log_likelihood - expected).abs();
        assert!(off < tolerance, "{} for {expected}", pass.log_likelihood);
    }
}

/// Derivative of the log-likelihood by central differences.
fn difference(
    observations: &Observations,
    model: &VehicleModel,
    step: f64,
    change: impl Fn(&mut VehicleModel, f64),
) -> f64 {
    let at = |by: f64| {
        let mut moved = model.clone();
        change(&mut moved, by);
        filter::run(observations, &moved, Evaluation::Likelihood).expect("a pass").log_likelihood
    };
    (at(step) - at(-step)) / (2.0 * step)
}

#[test]
fn scores_of_the_structure_are_the_likelihood_s_slopes() {
    let mut plain = model();
    for (parameter, value) in
        [(Parameter::QuadraticDrag, 0.4), (Parameter::CubicDrag, 0.2), (Parameter::Stiffness, 0.15)]
    {
        plain.set(parameter, value, true);
    }
    let mut lagged = plain.clone();
    lagged.set(Parameter::LagS, 0.17, true);
    let mut ramped = lagged.clone();
    ramped.set(Parameter::RampS, 0.45, true);
    let mut pausing = plain.clone();
    pausing.set(Parameter::PauseS, 0.23, true);
    let mut uneven = plain.clone();
    uneven.set(Parameter::Skew, 0.2, true);
    let observations = Observations::new(&record(), Clock::Stamps, SwitchingInstant::AtSamples);
    for model in [plain, lagged, ramped, pausing, uneven] {
        let score = filter::run(&observations, &model, Evaluation::Score).expect("a pass").score();
        for parameter in model.structure() {
            let slope = difference(&observations, &model, 1e-5, |m, by| m.values[parameter as usize] += by);
            let found = score.structure[parameter as usize];
            let scale = score.structure_information[parameter as usize][parameter as usize].sqrt();
            assert!((found - slope).abs() < 1e-2 * slope.abs() + 0.05 * scale, "{parameter:?}: {found} for {slope}");
        }
    }
}

/// Of what moves the output and no variance, where readings correct the state and with it how it depends on the parameters.
#[test]
fn scores_under_a_process_force_are_the_likelihood_s_slopes() {
    let observations = Observations::new(&record(), Clock::Stamps, SwitchingInstant::AtSamples);
    let mut model = model();
    model.set_noise(NoiseParameter::Force, 0.02, true);
    let score = filter::run(&observations, &model, Evaluation::Score).expect("a pass").score();
    for parameter in [Parameter::Disturbance, Parameter::DelayS, Parameter::Position, Parameter::Velocity] {
        let slope = difference(&observations, &model, 1e-5, |m, by| m.values[parameter as usize] += by);
        let found = score.structure[parameter as usize];
        assert!((found - slope).abs() < 1e-4 * slope.abs() + 1e-4, "{parameter:?}: {found} for {slope}");
    }
}

#[test]
fn scores_of_the_noise_are_the_likelihood_s_slopes() {
    let observations = Observations::new(&record(), Clock::Stamps, SwitchingInstant::Between);
    let mut model = model();
    for (noise, size) in [
        (NoiseParameter::Force, 0.02),
        (NoiseParameter::Colour, 3e-4),
        (NoiseParameter::ColourRate, 0.8),
        (NoiseParameter::Tracking, 1e-3),
    ] {
        model.set_noise(noise, size, true);
    }
    let score = filter::run(&observations, &model, Evaluation::Score).expect("a pass").score();
    for noise in NoiseParameter::ALL {
        let slope = difference(&observations, &model, 1e-4, |m, by| m.noise[noise as usize] += by);
        let found = score.noise[noise as usize];
        assert!((found - slope).abs() < 1e-3 * slope.abs() + 1e-3, "{noise:?}: {found} for {slope}");
    }
}

#[test]
fn scores_of_what_begins_uncertain_are_slopes_but_for_the_variances() {
    let mut filtered = model();
    filtered.set(Parameter::FilterS, 0.25, true);
    let mut remembering = model();
    remembering.set(Parameter::Memory, 0.3, true);
    remembering.set(Parameter::MemoryS, 0.7, true);
    for mut model in [filtered, remembering] {
        // The gain, whose change the score leaves out, is next to nothing.
        model.set_noise(NoiseParameter::White, 1e8, true);
        let mut predicted = Observations::new(&record_of(&model), Clock::Stamps, SwitchingInstant::AtSamples);
        let pass = filter::run(&predicted, &model, Evaluation::Likelihood).expect("a pass");
        for (output, innovation) in predicted.signal.output.iter_mut().zip(&pass.innovations) {
            *output -= innovation.error;
        }
        for sample in [5, 20, 40, 59] {
            let mut off = predicted.clone();
            off.signal.output[sample] += 1e3;
            let score = filter::run(&off, &model, Evaluation::Score).expect("a pass").score();
            for parameter in model.structure() {
                let slope = |observations: &Observations| {
                    difference(observations, &model, 1e-4, |m, by| m.values[parameter as usize] += by)
                };
                // What a parameter does to the variances is the same whatever the readings are.
                let (expected, found) = (slope(&off) - slope(&predicted), score.structure[parameter as usize]);
                assert!(
                    (found - expected).abs() < 1e-3 * expected.abs() + 1e-8,
                    "{parameter:?}: {found} for {expected}"
                );
            }
        }
    }
}

/// Rounds the motion on a grid at every place, and estimates by linear least squares with slopes from differences.
#[test]
fn estimates_of_rounded_readings_scatter_as_said() {
    const PLACES: usize = 400;
    let model = model();
    let structure: Vec<Parameter> = model.structure().collect();
    let mut observations = Observations::new(&record(), Clock::Stamps, SwitchingInstant::AtSamples);
    observations.signal.output.fill(0.0);
    observations.weight.fill(1.0);
    let motion = |model: &VehicleModel| {
        let pass = filter::run(&observations, model, Evaluation::Likelihood).expect("a pass");
        DVector::from_iterator(pass.innovations.len(), pass.innovations.iter().map(|innovation| -innovation.error))
    };
    let slopes = DMatrix::from_columns(
        &structure
            .iter()
            .map(|parameter| {
                let at = |by: f64| {
                    let mut moved = model.clone();
                    moved.values[*parameter as usize] += by;
                    motion(&moved)
                };
                (at(1e-5) - at(-1e-5)) / 2e-5
            })
            .collect::<Vec<_>>(),
    );
    let inverse = slopes.tr_mul(&slopes).cholesky().expect("six parameters").inverse();
    let (mut narrower, mut wider) = (0, 0);
    for step in [0.02, 0.1, 0.3, 0.8] {
        let positions = motion(&model);
        let mut expected = vec![0.0; structure.len()];
        for place in 0..PLACES {
            let shift = step * place as f64 / PLACES as f64;
            let rounding = positions.map(|y| step * ((y + shift) / step).round() - y - shift);
            let off = &inverse * slopes.tr_mul(&rounding);
            expected.iter_mut().zip(off.iter()).for_each(|(sum, off)| *sum += off * off / PLACES as f64);
        }
        let mut rounded = observations.clone();
        rounded.step = Some(step);
        rounded.signal.output = positions.iter().map(|y| step * (y / step).round()).collect();
        let mut model = model.clone();
        model.set_noise(NoiseParameter::White, step * step / 12.0, true);
        let pass = filter::run(&rounded, &model, Evaluation::Score).expect("a pass");
        let fitted = Fitted { log_likelihood: 0.0, score: pass.score(), pass, model, settled: true, integrated: 0 };
        let free: Vec<usize> = structure.iter().map(|parameter| *parameter as usize).collect();
        let factors = rounding::factors(&fitted, &rounded, &free).expect("rounded readings");
        for (place, parameter) in structure.iter().enumerate() {
            let ratio = (expected[place] / (inverse[(place, place)] * step * step / 12.0)).sqrt();
            let found = factors[*parameter as usize];
            // Roundings that cancel count as independent ones.
            assert!((found / ratio.max(1.0) - 1.0).abs() < 0.05, "{parameter:?} at {step}: {found} for {ratio}");
            narrower += usize::from(ratio < 0.9);
            wider += usize::from(ratio > 1.1);
        }
    }
    assert!(narrower > 0 && wider > 0, "{narrower} cancel, {wider} add up");
    observations.step = None;
    let pass = filter::run(&observations, &model, Evaluation::Score).expect("a pass");
    let fitted = Fitted { log_likelihood: 0.0, score: pass.score(), pass, model, settled: true, integrated: 0 };
    assert!(rounding::factors(&fitted, &observations, &[0]).is_none());
}

/// Mean time by which a force that jumps from -1 to 1 is late, in s: half of the area between the jump and the force. A ramp over T
/// and a pause of T take T/2, a time constant takes itself.
fn late_s(model: &VehicleModel) -> f64 {
    let [delay, lag, filter, ramp, pause] =
        [Parameter::DelayS, Parameter::LagS, Parameter::FilterS, Parameter::RampS, Parameter::PauseS]
            .map(|parameter| model.value(parameter));
    delay + lag + filter + 0.5 * (ramp + pause)
}

/// The chains of two commands, of one that changes its sign and one that does not, with the number of single lags and pairs.
#[test]
fn confounded_lags_share_the_mean_lag_and_a_pause_stands_apart() {
    let reverses = record();
    let (time, output) = (reverses.time_s().to_vec(), reverses.output().to_vec());
    let input = reverses.input().iter().map(|u| f64::from(*u > 0.0)).collect();
    let heats = Record::new(time, output, input).expect("a record");
    let lags = [
        (Term::Lag, Parameter::LagS),
        (Term::SensorFilter, Parameter::FilterS),
        (Term::RateLimit, Parameter::RampS),
        (Term::ReversalPause, Parameter::PauseS),
    ];
    for (record, known_delay_s, expected) in
        [(&reverses, None, 8), (&reverses, Some(0.02), 13), (&heats, None, 6), (&heats, Some(0.02), 10)]
    {
        let observations = Observations::new(record, Clock::Stamps, SwitchingInstant::AtSamples);
        for (term, parameter) in lags {
            let mut model = model();
            model.set(parameter, 0.2, true);
            let chains = chains(&model, known_delay_s, &observations);
            assert_eq!(chains.len(), expected, "{term:?}, {known_delay_s:?}");
            for chain in &chains {
                assert!((late_s(chain) - late_s(&model)).abs() < 1e-12, "{term:?}: {chain:?}");
                let pauses = chain.is_free(Parameter::PauseS);
                let behind = chain.is_free(Parameter::LagS) || chain.is_free(Parameter::RampS);
                assert!(!(pauses && behind), "{term:?}: {chain:?}");
            }
            assert!(chains.iter().any(|chain| chain.is_free(Parameter::PauseS)) == observations.reverses());
            let without = term.without(&model, known_delay_s);
            assert!(!term.is_in(&without) && (late_s(&without) - late_s(&model)).abs() < 1e-12, "{without:?}");
        }
    }
}
