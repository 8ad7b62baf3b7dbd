//! Long records: a search ends on their beginnings first, and starts from there on all of them.

use super::gauss_newton::{GaussNewton, StartingPoint};
use crate::experiment::Record;
use crate::identify::answer::IdentifyError;
use crate::identify::signal::half_period_s;

/// Samples of a beginning.
const SAMPLES: usize = 4000;
/// A beginning shows less than the record where its half-periods are longer by this factor.
const LIVELY: f64 = 1.5;
/// Two ends are the same where no parameter differs by more, relative.
const SAME: f64 = 1e-3;

/// The beginnings of records that are all long, and move in them as they do later.
pub(super) fn of(records: &[&Record]) -> Option<Vec<Record>> {
    let lively = |record: &&Record| {
        record.beginning(SAMPLES).filter(|beginning| half_period_s(beginning) < LIVELY * half_period_s(record))
    };
    records.iter().map(lively).collect()
}

/// The ends on the beginnings, each once.
pub(super) fn places(ends: &[Result<GaussNewton<'_>, IdentifyError>]) -> Vec<StartingPoint> {
    let mut places: Vec<StartingPoint> = Vec::new();
    for place in ends.iter().flatten().map(GaussNewton::place) {
        if !places.iter().any(|other| is_same(&place, other)) {
            places.push(place);
        }
    }
    places
}

fn is_same(a: &StartingPoint, b: &StartingPoint) -> bool {
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME * a.abs().max(b.abs());
    a.between == b.between && a.shared.iter().zip(&b.shared).all(close)
}

#[cfg(test)]
mod tests;
