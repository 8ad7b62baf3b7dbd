//! The q-relaxed intersection (Jaulin and Walter, *Automatica* 38, 2002): at most q readings of all records may be in error by any amount.
//!
//! Dealt into q + 2 groups, at least two groups are free of outliers. A parameter that misses at most q readings satisfies all of these two,
//! hence the union of the sets of all pairs of groups encloses it. A reading that contradicts the set of every pair is missed by all such
//! parameters: it is an outlier, and the rest is dealt again with q - 1.

#[cfg(test)]
mod tests;

use super::answer::{Bounds, Consistency, Outlier, Quantity, QuantityRange};
use super::branch_and_prune::hull;
use super::contraction::Contractor;
use super::feasible_point::ParameterPoint;
use super::linear_relaxation::Span;
use super::problem::Problem;
use super::record::{Readings, Scales};
use super::settings::BoundedModel;
use super::solve::solve;
use super::unknowns::Shooting;
use crate::identify::IdentifyError;
use crate::numeric::{Interval, Limit, OutOfDomain};

/// Passes for the proof that a reading contradicts the set of a pair.
const PROOF: usize = 100;
/// Readings of a record that a pair of groups needs.
const FEWEST: usize = 40;

/// The numbers of two groups.
type Groups = [usize; 2];

/// The pairs of this number of groups.
fn pairs(groups: usize) -> impl Iterator<Item = Groups> {
    (0..groups).flat_map(move |second| (0..second).map(move |first| [first, second]))
}

/// Records with readings that may be outliers.
struct Relaxed<'a> {
    settings: &'a BoundedModel,
    readings: &'a [Readings],
    scales: Vec<Scales>,
    found: Vec<Outlier>,
    /// The empty answer with most passes.
    hardest: Option<Bounds>,
    passes: usize,
}

/// The set of some of the readings.
struct Left {
    bounds: Bounds,
    /// The parameters; `None` for an empty set.
    at: Option<Vec<Interval>>,
    /// Readings of all that the feasible point misses, the furthest off first.
    missed: Vec<Outlier>,
}

/// Bounds where [`BoundedModel::outliers`] readings may be in error by any amount.
///
/// # Errors
/// [`IdentifyError::OutOfDomain`] for more of them than the records can bear.
pub(super) fn enclose(readings: &[Readings], settings: &BoundedModel) -> Result<Bounds, IdentifyError> {
    let shortest = readings.iter().map(|own| own.value.len()).min().unwrap_or(0);
    let most = (2 * shortest / FEWEST).saturating_sub(2);
    if settings.outliers > most {
        return Err(OutOfDomain {
            quantity: "readings that may be in error by any amount",
            value: settings.outliers as f64,
            unit: "",
            limit: Limit::AtMost(most as f64),
            remedy: "allow fewer, or give longer records",
        }
        .into());
    }
    Relaxed { settings, readings, scales: Vec::new(), found: Vec::new(), hardest: None, passes: 0 }.enclose()
}

/// Whether a reading is in one of two groups: each record is dealt by itself.
fn within(pair: Groups, groups: usize, place: Outlier) -> bool {
    pair.contains(&(place.sample % groups))
}

impl Relaxed<'_> {
    /// The numbers of a record's readings that are kept.
    fn numbers(&self, record: usize, keep: impl Fn(Outlier) -> bool) -> Vec<usize> {
        (0..self.readings[record].value.len()).filter(|&sample| keep(Outlier { record, sample })).collect()
    }

    /// The readings that are kept.
    fn only(&self, keep: impl Fn(Outlier) -> bool) -> Vec<Readings> {
        let each = self.readings.iter().enumerate().map(|(record, own)| {
            let numbers = self.numbers(record, &keep);
            let [time_s, value] =
                [&own.time_s, &own.value].map(|all| numbers.iter().map(|number| all[*number]).collect());
            Readings { time_s, value, ..own.clone() }
        });
        each.collect()
    }

    /// The same without the outliers found, as constraints.
    fn problem(&self, keep: impl Fn(Outlier) -> bool) -> Result<Problem, IdentifyError> {
        Problem::of(self.only(|place| !self.found.contains(&place) && keep(place)), self.settings, &self.scales)
    }

    fn enclose(mut self) -> Result<Bounds, IdentifyError> {
        let mut groups = self.settings.outliers + 2;
        self.measure(groups);
        let whole = self.problem(|_| true)?;
        let mut at = whole.search.clone();
        let mut pieces: Vec<(Groups, Left)> = Vec::new();
        while groups > 2 {
            pieces = self.pieces(groups, &at)?;
            if let (Some(bounds), true) = (self.hardest.take(), pieces.is_empty()) {
                // The factor of larger errors is found for this pair alone.
                return Ok(self.answer(Bounds { nearest: None, error_factor: [1.0, f64::MAX], ..bounds }, &whole));
            }
            at = hull(pieces.iter().filter_map(|(_, piece)| piece.at.clone())).unwrap_or(at);
            let more = self.contradicted(&pieces, groups)?;
            if more.is_empty() {
                break;
            }
            groups -= more.len();
            self.found.extend(more);
        }
        self.conclude(&whole, &at, pieces, groups - 2)
    }

    /// The nonempty sets of the pairs of groups within a box.
    fn pieces(&mut self, groups: usize, at: &[Interval]) -> Result<Vec<(Groups, Left)>, IdentifyError> {
        let mut pieces: Vec<(Groups, Left)> = Vec::new();
        // Most pairs end soon, and the rest of the budget goes to those that do not.
        let mut open: Vec<(Groups, Option<usize>)> = pairs(groups).map(|pair| (pair, None)).collect();
        while let Some((pair, least)) = open.pop() {
            let budget = self.settings.budget.saturating_sub(self.passes) / (open.len() + 1);
            // Every pair has a first run, even beyond the budget.
            if least.is_some_and(|least| budget < least) {
                continue;
            }
            let piece = self.leave(|place| within(pair, groups, place), at, budget)?;
            pieces.retain(|(own, _)| *own != pair);
            if piece.at.is_none() {
                if self.hardest.as_ref().is_none_or(|hardest| hardest.passes < piece.bounds.passes) {
                    self.hardest = Some(piece.bounds);
                }
                continue;
            }
            if piece.bounds.verdict == Consistency::Undecided {
                open.insert(0, (pair, Some(2 * budget.max(1))));
            }
            pieces.push((pair, piece));
        }
        Ok(pieces)
    }

    /// The records' scales where they are calmest: no outlier makes speeds seem larger there.
    fn measure(&mut self, groups: usize) {
        let of = |pair| self.only(|place| within(pair, groups, place)).iter().map(Readings::scales).collect();
        let calmer = |a: Vec<Scales>, b: Vec<Scales>| {
            a.into_iter().zip(b).map(|(a, b)| if b.fastest < a.fastest { b } else { a }).collect()
        };
        self.scales = pairs(groups).map(of).reduce(calmer).unwrap_or_default();
    }

    /// The remainder of a box by the kept readings, for at most `budget` passes over all.
    fn leave(&mut self, keep: impl Fn(Outlier) -> bool, at: &[Interval], budget: usize) -> Result<Left, IdentifyError> {
        let problem = self.problem(&keep)?.within(at);
        let settings = BoundedModel { budget, ..self.settings.clone() };
        let solved = solve(&problem, &settings, || None)?;
        let missed = solved.feasible.as_ref().map(|(point, problem)| self.missed(problem, point));
        let mut bounds = solved.bounds;
        for part in &mut bounds.contradicting {
            let own = |place: Outlier| !self.found.contains(&place) && keep(place);
            part.sample = self.numbers(part.record, own)[part.sample];
        }
        self.passes += bounds.passes;
        Ok(Left { bounds, at: solved.left, missed: missed.unwrap_or_default() })
    }

    /// Readings of all that a feasible point of some misses, the furthest off first; from its own first reading on.
    fn missed(&self, of: &Problem, point: &ParameterPoint) -> Vec<Outlier> {
        let unknowns = &of.unknowns;
        let shooting = (0..self.readings.len()).map(|record| {
            let begin = of.records[record].time_s[unknowns.shooting[unknowns.first(record)].first];
            let time_s = &self.readings[record].time_s;
            Shooting { record, first: time_s.partition_point(|time| *time < begin), last: time_s.len() - 1 }
        });
        let all = Problem {
            unknowns: unknowns.with_shooting(shooting.collect()),
            records: self.readings.to_vec(),
            ..of.clone()
        };
        let at: Vec<f64> = unknowns.of_single_shooting().into_iter().map(|place| point.at[place]).collect();
        let mut missed: Vec<(f64, Outlier)> = Vec::new();
        for (index, interval) in all.unknowns.shooting.iter().enumerate() {
            let misfits = all.misfits(Span::single(index), &at).unwrap_or_default();
            for (sample, misfit) in (interval.first..).zip(misfits) {
                let place = Outlier { record: interval.record, sample };
                if misfit > 1.0 && !self.found.contains(&place) {
                    missed.push((misfit, place));
                }
            }
        }
        missed.sort_by(|a, b| b.0.total_cmp(&a.0));
        missed.into_iter().map(|(_, place)| place).collect()
    }

    /// Readings that contradict the set of every pair, at most as many as may be outliers.
    fn contradicted(&self, pieces: &[(Groups, Left)], groups: usize) -> Result<Vec<Outlier>, IdentifyError> {
        let allowed = groups - 2;
        let mut suspects: Vec<Outlier> =
            pieces.iter().flat_map(|(_, piece)| piece.missed.iter().take(allowed).copied()).collect();
        suspects.sort_unstable();
        suspects.dedup();
        let mut sure = Vec::new();
        for suspect in suspects {
            let mut everywhere = sure.len() < allowed;
            for (pair, piece) in pieces {
                everywhere =
                    everywhere && !within(*pair, groups, suspect) && self.contradicts(suspect, *pair, groups, piece)?;
            }
            if everywhere {
                sure.push(suspect);
            }
        }
        Ok(sure)
    }

    /// Whether the set of a pair is empty once a further reading is a constraint.
    fn contradicts(&self, suspect: Outlier, pair: Groups, groups: usize, piece: &Left) -> Result<bool, IdentifyError> {
        let Some(at) = &piece.at else { return Ok(true) };
        let problem = self.problem(|place| place == suspect || within(pair, groups, place))?.within(at);
        Ok(Contractor::new(problem.clone()).prune(problem.search, PROOF).kept.is_empty())
    }

    /// The answer once no more outliers are found, with a number of them still `allowed`.
    fn conclude(
        mut self,
        whole: &Problem,
        at: &[Interval],
        pieces: Vec<(Groups, Left)>,
        allowed: usize,
    ) -> Result<Bounds, IdentifyError> {
        let all = self.leave(|_| true, at, self.settings.budget)?;
        if allowed == 0 {
            return Ok(self.answer(all.bounds, whole));
        }
        let mut tried = all.bounds;
        if tried.witness.is_none() {
            // Which readings are outliers is undecided, but a parameter that misses few shows that they may be.
            let missed = pieces.iter().map(|(_, piece)| &piece.missed).filter(|missed| !missed.is_empty());
            let fewest = missed.min_by_key(|missed| missed.len()).cloned().unwrap_or_default();
            let suspects = &fewest[..fewest.len().min(allowed)];
            tried = self.leave(|place| !suspects.contains(&place), at, self.settings.budget)?.bounds;
        }
        // A record's first state differs with each pair, and is omitted.
        let of_all = |range: &QuantityRange| !matches!(range.quantity, Quantity::Position(_) | Quantity::Velocity(_));
        let ranges = pieces.iter().flat_map(|(_, piece)| piece.bounds.bounds.iter().copied());
        let union = QuantityRange::union(ranges.filter(of_all));
        let verdict = if tried.witness.is_some() { Consistency::Consistent } else { Consistency::Undecided };
        let error_factor = [0.0, tried.error_factor[1]];
        let bounds = Bounds { verdict, bounds: union, error_factor, contradicting: Vec::new(), ..tried };
        Ok(self.answer(bounds, whole))
    }

    fn answer(self, bounds: Bounds, whole: &Problem) -> Bounds {
        // A refuted model shows no outliers.
        let outliers = if bounds.verdict == Consistency::Refuted { Vec::new() } else { self.found };
        Bounds { search_box: whole.ranges(&whole.search), outliers, passes: self.passes, ..bounds }
    }
}
