//! Multipliers for the steps of a proof, with room for the enclosures of another checker.

use super::super::linear_program::{Multipliers, Outcome};
use super::super::linear_relaxation::{Origin, Relaxation};
use super::super::problem::Problem;
use super::format::{Combination, Cut};
use crate::numeric::Interval;

/// Room for the enclosures of another checker: on either side of a range, in shares of it; and of a contradiction, in shares of the slack of
/// its readings. A cut that takes less off a range is omitted.
pub(super) const ROOM: f64 = 0.03;

/// The result of a contraction.
pub(super) enum Contraction {
    /// A contradiction, and its size.
    Contradiction(Combination, f64),
    Cuts(Vec<Cut>),
}

impl Contraction {
    /// A contradiction as a cut that empties the range of the first unknown: any objective is bounded by enough of a contradiction.
    pub(super) fn into_cuts(self, at: &[Interval]) -> Vec<Cut> {
        match self {
            Self::Cuts(cuts) => cuts,
            Self::Contradiction(rows, by) => {
                let weight = 4.0 * at[0].width() / by;
                let rows = rows.into_iter().map(|(origin, y)| (origin, weight * y)).collect();
                vec![Cut { unknown: 0, upper: true, end: at[0].lower() - at[0].width(), rows }]
            }
        }
    }
}

/// Shares by which a contradiction counts.
#[derive(Clone, Copy)]
pub(super) struct ExclusionMargin {
    /// Of the errors of the readings: the slack of the feasible point. Beyond bounds that are wider by half, misfits
    /// exceed 1 by about the slack: a larger margin would leave points near the bounds that no step excludes.
    pub(super) slack: f64,
    /// Of the ranges of the coefficients.
    pub(super) of_uncertainty: f64,
}

/// Seeks cuts of the `unknowns` of a box, none of which needs to be narrower than its `target`.
pub(super) fn seek(
    problem: &Problem,
    relaxation: &Relaxation,
    at: &[Interval],
    unknowns: &[usize],
    target: &[Interval],
    margin: ExclusionMargin,
) -> Contraction {
    let programme = relaxation.programme();
    let uncertainty = |multipliers: &Multipliers| -> f64 {
        let of = |(row, y): &(usize, f64)| y * relaxation.uncertainty(*row).map(|(_, part)| part).sum::<f64>();
        margin.of_uncertainty * multipliers.iter().map(of).sum::<f64>()
    };
    let error = |row: usize| match relaxation.origins[row] {
        Origin::Reading { interval, .. } => problem.records[problem.unknowns.shooting[interval].record].error,
        _ => 0.0,
    };
    let named = |multipliers: &Multipliers| -> Combination {
        multipliers.iter().filter(|(_, y)| *y > 0.0).map(|(row, y)| (relaxation.origins[*row], *y)).collect()
    };
    let mut cuts = Vec::new();
    'unknowns: for &unknown in unknowns {
        let mut ends = Vec::new();
        for sign in [1.0, -1.0] {
            match programme.maximise(&[(unknown, sign)]) {
                Outcome::Empty { multipliers } => {
                    let bound = relaxation.upper_bound(&[], &multipliers);
                    let weighed: f64 = multipliers.iter().map(|(row, y)| y * error(*row)).sum();
                    if bound < -ROOM * margin.slack * weighed - uncertainty(&multipliers) {
                        return Contraction::Contradiction(named(&multipliers), -bound);
                    }
                    continue 'unknowns;
                }
                Outcome::Bounded { multipliers, .. } => {
                    let bound = relaxation.upper_bound(&[(unknown, sign)], &multipliers);
                    ends.push((relaxation.centre[unknown] + sign * bound, multipliers));
                }
            }
        }
        let (side, target) = (at[unknown], target.get(unknown));
        let room = ROOM * (ends[0].0 - ends[1].0).abs();
        let mut own = Vec::new();
        for ((end, multipliers), upper) in ends.iter().zip([true, false]) {
            let sign = if upper { 1.0 } else { -1.0 };
            let of = |side: Interval| if upper { side.upper() } else { side.lower() };
            let (now, other) = (of(side), -of(-side));
            let (end, least) = (end + sign * room, ROOM * side.width());
            let gained = sign * (now - end);
            let reaches =
                target.is_some_and(|target| sign * (now - of(*target)) > 0.0 && sign * (end - of(*target)) <= 0.0);
            if gained <= 0.0 || gained <= ROOM * side.width() && !reaches {
                continue;
            }
            let empty = sign * (other - end) > least + uncertainty(multipliers);
            // Of a range that may be empty a sliver remains.
            let end = if empty || sign * (end - other) > least { end } else { other + sign * least };
            let cut = Cut { unknown, upper, end, rows: named(multipliers) };
            if empty {
                own = vec![cut];
                break;
            }
            own.push(cut);
        }
        cuts.extend(own);
    }
    Contraction::Cuts(cuts)
}
