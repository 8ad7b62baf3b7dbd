//! Readings in error by any amount: at most so many of all records together, whichever they are.
//!
//! Dealt into two groups more than there may be such readings, at least two groups are free of them. A parameter that misses no
//! more readings than that meets all of these two, so that what the pairs of groups leave encloses it. A reading that contradicts what
//! every pair leaves is missed by all such parameters: it is found, and the rest is dealt again.

use super::bounds::{Bounds, Consistency, Outlier, Quantity, QuantityRange};
use super::certificate::Witness;
use super::contract::Span;
use super::divide::around;
use super::explore::explore;
use super::problem::{Readings, Window};
use super::search::Search;
use super::settings::BoundedModel;
use super::setup::{Scales, Setup};
use super::witness::Tried;
use crate::identify::IdentifyError;
use crate::numeric::{Interval, Limit, OutOfDomain, Real};

#[cfg(test)]
mod tests;

/// Passes to show that a reading contradicts what a pair of groups leaves.
const PROOF: usize = 100;
/// Readings of one record that a pair of groups needs.
const FEWEST: usize = 40;

/// The numbers of two groups.
type Pair = [usize; 2];

/// The pairs of so many groups.
fn pairs(groups: usize) -> impl Iterator<Item = Pair> {
    (0..groups).flat_map(move |second| (0..second).map(move |first| [first, second]))
}

/// Records with readings that may be outliers.
struct Doubted<'a> {
    settings: &'a BoundedModel,
    readings: &'a [Readings],
    /// Number of each record's first reading, counted through all records.
    offsets: Vec<usize>,
    scales: Vec<Scales>,
    found: Vec<Outlier>,
    /// Of the answers with nothing left, the one that took most.
    hardest: Option<Bounds>,
    passes: usize,
}

/// What some of the readings leave.
struct Left {
    bounds: Bounds,
    /// The parameters; `None` where nothing is left.
    at: Option<Vec<Interval>>,
    /// Readings of all that the witness misses, the furthest off first.
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
    let offsets = readings.iter().scan(0, |next, own| {
        let offset = *next;
        *next += own.value.len();
        Some(offset)
    });
    let offsets = offsets.collect();
    Doubted { settings, readings, offsets, scales: Vec::new(), found: Vec::new(), hardest: None, passes: 0 }.enclose()
}

impl Doubted<'_> {
    fn within(&self, pair: Pair, groups: usize, place: Outlier) -> bool {
        pair.contains(&((self.offsets[place.record] + place.sample) % groups))
    }

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
    fn setup(&self, keep: impl Fn(Outlier) -> bool) -> Result<Setup, IdentifyError> {
        Setup::of(self.only(|place| !self.found.contains(&place) && keep(place)), self.settings, &self.scales)
    }

    fn enclose(mut self) -> Result<Bounds, IdentifyError> {
        let mut groups = self.settings.outliers + 2;
        self.measure(groups);
        let whole = self.setup(|_| true)?;
        let mut at = whole.search.clone();
        let mut pieces: Vec<(Pair, Left)> = Vec::new();
        while groups > 2 {
            pieces = self.pieces(groups, &at)?;
            if let (Some(bounds), true) = (self.hardest.take(), pieces.is_empty()) {
                // How much larger errors would have to be is known for this pair alone.
                return Ok(self.answer(Bounds { nearest: None, error_factor: [1.0, f64::MAX], ..bounds }, &whole));
            }
            at = around(pieces.iter().filter_map(|(_, piece)| piece.at.clone())).unwrap_or(at);
            let more = self.contradicted(&pieces, groups)?;
            if more.is_empty() {
                break;
            }
            groups -= more.len();
            self.found.extend(more);
        }
        self.conclude(&whole, &at, pieces, groups - 2)
    }

    /// What every pair of groups leaves of a box, but those that leave nothing.
    fn pieces(&mut self, groups: usize, at: &[Interval]) -> Result<Vec<(Pair, Left)>, IdentifyError> {
        let mut pieces: Vec<(Pair, Left)> = Vec::new();
        // Most pairs are soon known, and the others get what is left of the budget.
        let mut open: Vec<(Pair, Option<usize>)> = pairs(groups).map(|pair| (pair, None)).collect();
        while let Some((pair, least)) = open.pop() {
            let budget = self.settings.budget.saturating_sub(self.passes) / (open.len() + 1);
            // No pair goes without a first run, whatever is left.
            if least.is_some_and(|least| budget < least) {
                continue;
            }
            let piece = self.leave(|own, place| own.within(pair, groups, place), at, budget)?;
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
        for pair in pairs(groups) {
            let own = self.only(|place| self.within(pair, groups, place)).iter().map(Scales::of).collect();
            if self.scales.is_empty() {
                self.scales = own;
                continue;
            }
            for (calmest, own) in self.scales.iter_mut().zip(own) {
                if own.fastest < calmest.fastest {
                    *calmest = own;
                }
            }
        }
    }

    /// What the readings that are kept leave of a box, at the cost of so many passes over all.
    fn leave(
        &mut self,
        keep: impl Fn(&Self, Outlier) -> bool,
        at: &[Interval],
        budget: usize,
    ) -> Result<Left, IdentifyError> {
        let setup = self.setup(|place| keep(self, place))?.within(at);
        let all: usize = self.readings.iter().map(|own| own.value.len()).sum();
        let budget = budget * all / setup.samples();
        let settings = BoundedModel { budget, ..self.settings.clone() };
        let mut missed = Vec::new();
        let explored = explore(
            &setup,
            &settings,
            || None,
            |search, witness| {
                missed = witness.map(|witness| self.missed(search, witness)).unwrap_or_default();
            },
        )?;
        let mut bounds = explored.bounds;
        for part in &mut bounds.contradicting {
            let own = |place: Outlier| !self.found.contains(&place) && keep(self, place);
            part.sample = self.numbers(part.record, own)[part.sample];
        }
        self.passes += bounds.passes * setup.samples() / all;
        Ok(Left { bounds, at: explored.left, missed })
    }

    /// Readings of all that a witness of some misses, the furthest off first; from its own first one on.
    fn missed(&self, search: &Search<'_>, witness: &Tried) -> Vec<Outlier> {
        let windows = search.model.whole().into_iter().map(|span| {
            let Window { record, first, .. } = search.setup.layout.windows()[span.from];
            let begin = search.setup.records[record].time_s[first];
            let time_s = &self.readings[record].time_s;
            Window { record, first: time_s.partition_point(|time| *time < begin), last: time_s.len() - 1 }
        });
        let layout = search.setup.layout.clone().with_windows(windows.collect());
        let setup = Setup { records: self.readings.to_vec(), layout, ..search.setup.clone() };
        let all = Search::new(&setup);
        let at = Witness::of(search, &witness.at).values;
        let mut missed: Vec<(f64, Outlier)> = Vec::new();
        for (index, window) in setup.layout.windows().iter().enumerate() {
            let readings = &self.readings[window.record];
            let outputs = all.model.outputs(Span { from: index, to: index + 1 }, &at).unwrap_or_default();
            for (sample, output) in (window.first..).zip(outputs) {
                let misfit = (output - Interval::point(readings.value[sample])).abs().upper() / readings.error;
                let place = Outlier { record: window.record, sample };
                if misfit > 1.0 && !self.found.contains(&place) {
                    missed.push((misfit, place));
                }
            }
        }
        missed.sort_by(|a, b| b.0.total_cmp(&a.0));
        missed.into_iter().map(|(_, place)| place).collect()
    }

    /// Readings that contradict what every pair leaves, as many as may be outliers at most.
    fn contradicted(&self, pieces: &[(Pair, Left)], groups: usize) -> Result<Vec<Outlier>, IdentifyError> {
        let allowed = groups - 2;
        let mut suspects: Vec<Outlier> =
            pieces.iter().flat_map(|(_, piece)| piece.missed.iter().take(allowed).copied()).collect();
        suspects.sort_unstable();
        suspects.dedup();
        let mut sure = Vec::new();
        for suspect in suspects {
            let mut everywhere = sure.len() < allowed;
            for (pair, piece) in pieces {
                everywhere = everywhere
                    && !self.within(*pair, groups, suspect)
                    && self.contradicts(suspect, *pair, groups, piece)?;
            }
            if everywhere {
                sure.push(suspect);
            }
        }
        Ok(sure)
    }

    /// Whether nothing is left of what a pair leaves once one more reading has to be met.
    fn contradicts(&self, suspect: Outlier, pair: Pair, groups: usize, piece: &Left) -> Result<bool, IdentifyError> {
        let Some(at) = &piece.at else { return Ok(true) };
        let setup = self.setup(|place| place == suspect || self.within(pair, groups, place))?.within(at);
        let division = Search::new(&setup).search(setup.search.clone(), PROOF);
        Ok(division.kept.is_empty())
    }

    /// The answer once no more outliers are found, of which so many are still `allowed`.
    fn conclude(
        mut self,
        whole: &Setup,
        at: &[Interval],
        pieces: Vec<(Pair, Left)>,
        allowed: usize,
    ) -> Result<Bounds, IdentifyError> {
        let all = self.leave(|_, _| true, at, self.settings.budget)?;
        if allowed == 0 {
            return Ok(self.answer(all.bounds, whole));
        }
        let mut tried = all.bounds;
        if tried.witness.is_none() {
            // Which readings are outliers is not known, but a parameter that misses few shows that they may be.
            let missed = pieces.iter().map(|(_, piece)| &piece.missed).filter(|missed| !missed.is_empty());
            let fewest = missed.min_by_key(|missed| missed.len()).cloned().unwrap_or_default();
            let suspects = &fewest[..fewest.len().min(allowed)];
            tried = self.leave(|_, place| !suspects.contains(&place), at, self.settings.budget)?.bounds;
        }
        let verdict = if tried.witness.is_some() { Consistency::Consistent } else { Consistency::Undecided };
        let error_factor = [0.0, tried.error_factor[1]];
        let bounds = Bounds { verdict, bounds: union(&pieces), error_factor, contradicting: Vec::new(), ..tried };
        Ok(self.answer(bounds, whole))
    }

    fn answer(self, bounds: Bounds, whole: &Setup) -> Bounds {
        // A model that is refuted says nothing of readings.
        let outliers = if bounds.verdict == Consistency::Refuted { Vec::new() } else { self.found };
        Bounds { search_box: whole.ranges(&whole.search), outliers, passes: self.passes, ..bounds }
    }
}

/// What all pairs leave of each quantity; a record's first state is another one's with each pair, and left out.
fn union(pieces: &[(Pair, Left)]) -> Vec<QuantityRange> {
    let mut all: Vec<QuantityRange> = Vec::new();
    for range in pieces.iter().flat_map(|(_, piece)| &piece.bounds.bounds) {
        match all.iter_mut().find(|own| own.quantity == range.quantity) {
            _ if matches!(range.quantity, Quantity::Position(_) | Quantity::Velocity(_)) => {}
            Some(own) => (own.low, own.high) = (own.low.min(range.low), own.high.max(range.high)),
            None => all.push(*range),
        }
    }
    all
}
