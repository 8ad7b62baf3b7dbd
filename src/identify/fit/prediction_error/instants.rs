//! When the command changed within a gap of the log: at one of the instants of the samples that are missing, and the readings after the
//! gap tell which.
//!
//! A switching misplaced by a sample displaces the motion by many times the error of a reading. A variance about the mean
//! instant says less: readings within the gap's span of instants come before that mean as often as after it.

use super::filter::{self, Evaluation};
use super::model::VehicleModel;
use super::observations::Observations;

/// Share of the likelihood from which on an instant counts as known.
const CERTAIN: f64 = 0.999;
/// Every second switching is tried at once: the switchings between stay uncertain, so that the filter converges back to the readings.
const APART: usize = 2;
/// Part of the time between candidate instants by which a less certain instant may move and still count as the same.
const SAME: f64 = 0.1;

/// The record with its switchings in gaps where the model makes it likeliest, as far as the readings tell; `None` where no switching is
/// in a gap.
pub(super) fn told(observations: &Observations, model: &VehicleModel) -> Option<Observations> {
    let in_gaps: Vec<usize> =
        (0..observations.kicks.len()).filter(|kick| observations.kicks[*kick].choices > 1).collect();
    if in_gaps.is_empty() {
        return None;
    }
    let mut open = observations.clone();
    in_gaps.iter().for_each(|kick| open.open(*kick));
    let mut told = observations.clone();
    for first in 0..APART {
        let group: Vec<usize> = in_gaps.iter().skip(first).step_by(APART).copied().collect();
        for (kick, shares) in group.iter().zip(shares(&open, &group, model)?) {
            match shares.iter().position(|share| *share > CERTAIN) {
                Some(choice) => told.choose(*kick, choice),
                None => told.weigh(*kick, &shares),
            }
        }
    }
    Some(told)
}

/// How likely each instant of some switchings makes the readings from its gap to that of the next of them, as shares of one.
fn shares(open: &Observations, group: &[usize], model: &VehicleModel) -> Option<Vec<Vec<f64>>> {
    let choices = |kick: &usize| open.kicks[*kick].choices;
    let begin = |kick: &usize| open.time_s.partition_point(|t| *t <= open.kicks[*kick].begin_s).max(open.first);
    let mut ends: Vec<usize> = group.iter().skip(1).map(begin).collect();
    ends.push(open.time_s.len());
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); group.len()];
    let mut tried = open.clone();
    for choice in 0..group.iter().map(choices).max().unwrap_or(0) {
        group.iter().for_each(|kick| tried.choose(*kick, choice.min(choices(kick) - 1)));
        let pass = filter::run(&tried, model, Evaluation::Likelihood)?;
        for ((kick, end), values) in
            group.iter().zip(&ends).zip(&mut values).filter(|((kick, _), _)| choice < choices(kick))
        {
            let seen = begin(kick)..*end;
            let value = |sample: usize| tried.weight[sample] * pass.innovations[sample - tried.first].log_density();
            values.push(seen.map(value).sum());
        }
    }
    let share = |values: Vec<f64>| {
        let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let likelihoods: Vec<f64> = values.iter().map(|value| libm::exp(value - most)).collect();
        let sum: f64 = likelihoods.iter().sum();
        likelihoods.into_iter().map(|likelihood| likelihood / sum).collect()
    };
    Some(values.into_iter().map(share).collect())
}

/// Whether the instant of a switching differs, or its variance.
pub(super) fn differ(a: &Observations, b: &Observations) -> bool {
    a.kicks.iter().zip(&b.kicks).any(|(a, b)| {
        let apart = (a.at_s - b.at_s).abs().max((a.variance_s2.sqrt() - b.variance_s2.sqrt()).abs());
        apart > SAME * a.step_s
    })
}

#[cfg(test)]
mod tests {
    use super::{differ, told};
    use crate::experiment::{Record, Sensor, SimulatedExperiment};
    use crate::identify::fit::prediction_error::model::{NoiseParameter, Parameter, VehicleModel};
    use crate::identify::fit::prediction_error::observations::Observations;
    use crate::identify::signal::{Clock, SwitchingInstant};
    use crate::nonlinearity::RelayHysteresis;
    use crate::plant::DragAxis;

    const NOISE: f64 = 0.009;
    const DELAY_S: f64 = 0.3;

    /// A record with all samples, and the same without up to seven about every second switching, each time elsewhere in its gap.
    fn records() -> (Record, Record) {
        let axis = DragAxis::linear(1.0, 0.5).expect("an axis").with_delay_s(DELAY_S).expect("a delay");
        let relay = RelayHysteresis::new(1.0, 0.3, 0.0).expect("a relay");
        let sensor = Sensor { noise: NOISE, ..Sensor::default() };
        let experiment = SimulatedExperiment::new(axis, relay, 10.0).expect("an experiment").held();
        let whole = experiment.with_sensor(sensor).expect("a sensor").run(60.0).expect("a record");
        let input = whole.input();
        let changes: Vec<usize> = (1..input.len()).filter(|k| input[*k] != input[k - 1]).collect();
        let missing = |sample: &usize| {
            changes.iter().enumerate().any(|(place, change)| {
                let begin = change - place % 8;
                place % 2 == 1 && (begin..begin + 7).contains(sample)
            })
        };
        let kept: Vec<usize> = (0..input.len()).filter(|sample| !missing(sample)).collect();
        let of = |values: &[f64]| kept.iter().map(|sample| values[*sample]).collect::<Vec<f64>>();
        let with_gaps = Record::new(of(whole.time_s()), of(whole.output()), of(whole.input())).expect("a record");
        (whole, with_gaps)
    }

    fn model(noise: f64, switching: SwitchingInstant) -> VehicleModel {
        let mut model = VehicleModel::plain(switching);
        for (parameter, value) in [(Parameter::Alpha, 1.0), (Parameter::LinearDrag, 0.5), (Parameter::DelayS, DELAY_S)]
        {
            model.set(parameter, value, true);
        }
        model.set_noise(NoiseParameter::White, noise * noise, true);
        model
    }

    #[test]
    fn switchings_in_gaps_are_where_they_were() {
        let (whole, with_gaps) = records();
        for switching in [SwitchingInstant::AtSamples, SwitchingInstant::Between] {
            let [whole, before] =
                [&whole, &with_gaps].map(|record| Observations::new(record, Clock::Stamps, switching));
            assert!(told(&whole, &model(NOISE, switching)).is_none(), "nothing is missing");
            let after = told(&before, &model(NOISE, switching)).expect("gaps");
            assert_eq!(after.kicks.len(), whole.kicks.len());
            let moved = before.kicks.iter().filter(|kick| kick.choices > 1).count();
            assert!(moved >= 8 && differ(&before, &after), "{moved} in gaps");
            for ((found, at), piece) in after.kicks.iter().zip(&whole.kicks).zip(&after.pieces[1..]) {
                // Between samples the interval after the true instant is as likely as the interval before it.
                let off = if switching == SwitchingInstant::Between && found.choices > 1 { 0.11 } else { 1e-9 };
                assert!((found.at_s - at.at_s).abs() < off, "{switching:?}: {found:?} for {at:?}");
                assert!(found.variance_s2 <= at.variance_s2 + 0.003, "{switching:?}: {found:?} for {at:?}");
                assert_eq!(piece.begin_s, found.at_s);
            }
        }
    }

    #[test]
    fn what_readings_do_not_tell_stays_open() {
        let (_, with_gaps) = records();
        let before = Observations::new(&with_gaps, Clock::Stamps, SwitchingInstant::AtSamples);
        let after = told(&before, &model(1e6 * NOISE, SwitchingInstant::AtSamples)).expect("gaps");
        for (a, b) in after.kicks.iter().zip(&before.kicks) {
            assert!((a.at_s - b.at_s).abs() < 1e-3 && (a.variance_s2 - b.variance_s2).abs() < 1e-3, "{a:?} for {b:?}");
        }
    }
}
