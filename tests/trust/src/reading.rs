//! What every binding needs: a log made a record, an estimate made an interval.

use selfosc::experiment::Record;
use selfosc::identify::Estimate;
use selfosc_simulator::answer::Interval;

/// The record as a user reads it: wrapped headings made continuous.
pub(crate) fn record(log: &selfosc_simulator::experiment::Record, turn: Option<f64>) -> Result<Record, String> {
    let mut output = log.output.clone();
    if let Some(turn) = turn {
        for index in 1..output.len() {
            let jump = output[index] - output[index - 1];
            output[index] -= turn * (jump / turn).round();
        }
    }
    Record::new(log.time_s.clone(), output, log.input.clone()).map_err(|error| error.code().to_owned())
}

/// An estimate that ended on its bound has no interval: it is taken at its word.
pub(crate) fn interval(estimate: Estimate) -> Interval {
    let Estimate { value, spread, .. } = estimate;
    spread.map_or(Interval::exact(value), |spread| Interval { value, low: spread.low, high: spread.high })
}
