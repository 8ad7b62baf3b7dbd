//! Multipliers for the steps: linear programmes, of which only what they show in intervals counts.

use super::super::contract::{Linear, Origin};
use super::super::frame::{Affine, Frame};
use super::super::lp::{Multipliers, Outcome, Programme};
use super::super::setup::Setup;
use super::{Combination, Cut};
use crate::numeric::Interval;

/// A contradiction is beyond doubt by this share of the errors that it weighs, and a range is empty whose ends contradict each other by
/// this share of its width.
const BEYOND: f64 = 0.01;
/// A cut that takes less than this of a range is left out.
const LEAST_CUT: f64 = 0.05;

/// Room for other enclosures than the search's, on either side of what the multipliers leave of a range.
#[derive(Clone, Copy)]
pub(super) struct Caution {
    /// A share of what is left, or of how far its ends contradict each other.
    pub(super) of_left: f64,
    /// A share of what slopes' ranges add, before a contradiction counts.
    pub(super) of_slopes: f64,
}

/// Inequalities, and the programme of those of their unknowns that are bounded.
pub(super) struct Seek<'a> {
    linear: &'a Linear,
    programme: Programme,
    caution: Caution,
    setup: &'a Setup,
}

/// What multipliers show of a combination of unknowns.
pub(super) enum Sought {
    /// Lower and upper end of its range, with what shows them.
    Range([(f64, Multipliers); 2]),
    /// Nothing meets the inequalities: these contradict each other by so much.
    Nothing(Multipliers, f64),
}

/// What a pass gave.
pub(super) enum Found {
    /// A contradiction, and by how much.
    Excluded(Combination, f64),
    Cuts(Vec<Cut>),
}

impl Found {
    /// A contradiction as a cut that leaves nothing of the first unknown: weighed as heavily as that takes.
    pub(super) fn into_cuts(self, at: &[Interval]) -> Vec<Cut> {
        match self {
            Self::Cuts(cuts) => cuts,
            Self::Excluded(rows, by) => {
                let weight = 4.0 * at[0].width() / by;
                let rows = rows.into_iter().map(|(origin, y)| (origin, weight * y)).collect();
                vec![Cut { unknown: 0, upper: true, end: at[0].lower() - at[0].width(), rows }]
            }
        }
    }
}

impl<'a> Seek<'a> {
    pub(super) fn new(setup: &'a Setup, linear: &'a Linear, places: &[usize], caution: Caution) -> Self {
        Self { linear, programme: linear.programme(places), caution, setup }
    }

    /// The error of a row's reading, which a contradiction must exceed; those of hats are not told apart.
    fn error(&self, row: usize) -> f64 {
        match self.linear.origins[row] {
            Origin::Reading { window, .. } => self.setup.records[self.setup.layout.windows()[window].record].error,
            _ => 0.0,
        }
    }

    /// What the ranges of slopes add to a combination of rows.
    fn in_doubt(&self, multipliers: &Multipliers) -> f64 {
        multipliers.iter().map(|(row, y)| y * self.linear.in_doubt(*row).map(|(_, part)| part).sum::<f64>()).sum()
    }

    /// `None` where a contradiction is not beyond doubt.
    fn sought(
        &self,
        objective: impl Fn(f64) -> Vec<(usize, f64)>,
        most: impl Fn(f64, &Multipliers) -> f64,
    ) -> Option<Sought> {
        let end = |sign: f64| match self.programme.maximise(&objective(sign)) {
            Outcome::Empty { multipliers } => {
                let bound = self.linear.rows.upper_bound(&[], &multipliers, &self.linear.deviations);
                let weighed: f64 = multipliers.iter().map(|(row, y)| y * self.error(*row)).sum();
                let doubt = BEYOND * weighed + self.caution.of_slopes * self.in_doubt(&multipliers);
                Err((bound < -doubt).then_some((multipliers, -bound)))
            }
            Outcome::Bounded { multipliers, .. } => Ok((sign * most(sign, &multipliers), multipliers)),
        };
        match (end(-1.0), end(1.0)) {
            (Ok(low), Ok(high)) => Some(Sought::Range([low, high])),
            (Err(nothing), _) | (_, Err(nothing)) => nothing.map(|(rows, by)| Sought::Nothing(rows, by)),
        }
    }

    /// Of one of the unknowns.
    pub(super) fn unknown(&self, unknown: usize) -> Option<Sought> {
        let most = |sign: f64, multipliers: &Multipliers| {
            let bound = self.linear.rows.upper_bound(&[(unknown, sign)], multipliers, &self.linear.deviations);
            (Interval::point(sign) * Interval::point(self.linear.centre[unknown]) + Interval::point(bound)).upper()
        };
        self.sought(|sign| vec![(unknown, sign)], most)
    }

    /// Of a combination of a frame's coordinates, which the unknowns are.
    pub(super) fn combination(&self, affine: &Affine, frame: &Frame) -> Option<Sought> {
        self.sought(|sign| affine.objective(sign), |sign, rows| affine.most(sign, frame, self.linear, rows))
    }

    /// Multipliers by what the rows are.
    pub(super) fn named(&self, multipliers: &Multipliers) -> Combination {
        multipliers.iter().filter(|(_, y)| *y > 0.0).map(|(row, y)| (self.linear.origins[*row], *y)).collect()
    }

    /// Cuts of several unknowns, each with its range, or a contradiction.
    pub(super) fn collect(
        &self,
        sought: impl Iterator<Item = (usize, Interval, Option<Sought>)>,
        face: impl Fn(usize) -> Option<Interval>,
    ) -> Found {
        let mut cuts = Vec::new();
        for (unknown, side, sought) in sought {
            match sought {
                Some(Sought::Nothing(multipliers, by)) => return Found::Excluded(self.named(&multipliers), by),
                Some(Sought::Range(ends)) => cuts.extend(self.cuts(unknown, side, &ends, face(unknown))),
                None => {}
            }
        }
        Found::Cuts(cuts)
    }

    /// Cuts that take something off a range of which no more than `face` needs to be left, if that is given; one alone where nothing
    /// is left.
    fn cuts(&self, unknown: usize, side: Interval, ends: &[(f64, Multipliers); 2], face: Option<Interval>) -> Vec<Cut> {
        let [(low, below), (high, above)] = ends;
        let Caution { of_left, of_slopes } = self.caution;
        let room = of_left * (high - low).abs();
        let mut cuts = Vec::new();
        for (upper, end, multipliers) in [(true, *high, above), (false, *low, below)] {
            let doubt = of_slopes * self.in_doubt(multipliers);
            let sign = if upper { 1.0 } else { -1.0 };
            let (now, other) = if upper { (side.upper(), side.lower()) } else { (side.lower(), side.upper()) };
            let end = end + sign * room;
            let gained = sign * (now - end);
            let reaches = face.is_some_and(|face| {
                let face = if upper { face.upper() } else { face.lower() };
                sign * (now - face) > 0.0 && sign * (end - face) <= 0.0
            });
            if !(gained > LEAST_CUT * side.width() || reaches && gained > 0.0) {
                continue;
            }
            let least = BEYOND * side.width();
            let nothing = sign * (other - end) > least + doubt;
            // A range that may be empty leaves a sliver to be dealt with.
            let end = if nothing || sign * (end - other) > least { end } else { other + sign * least };
            let cut = Cut { unknown, upper, end, rows: self.named(multipliers) };
            if nothing {
                return vec![cut];
            }
            cuts.push(cut);
        }
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::DragLaw;
    use crate::identify::bounded::effort::Effort;
    use crate::identify::bounded::lp::Rows;
    use crate::identify::bounded::tests::{record, settings};

    const CAUTION: Caution = Caution { of_left: 0.0, of_slopes: 0.25 };

    /// An unknown between -1 and 1, of which a slope between 0.9 and 1.1 is said to take it beyond `limit`: what is found of it, of
    /// which no more than `most` is left.
    fn found_of(limit: f64, most: f64) -> Found {
        let setup = Setup::new(&[&record(300)], &settings(DragLaw::Linear)).expect("a setup");
        let slope = Interval::new(-1.1, -0.9).expect("a range");
        let rows = Rows { slopes: vec![vec![(0, slope)]], limits: vec![-limit] };
        let linear = Linear {
            effort: Effort::default(),
            rows,
            origins: vec![Origin::LeastLinear],
            centre: vec![0.0],
            deviations: vec![Interval::symmetric(1.0)],
        };
        let seek = Seek::new(&setup, &linear, &[0], CAUTION);
        let side = Interval::new(-1.0, most).expect("a range");
        seek.collect([(0, side, seek.unknown(0))].into_iter(), |_| None)
    }

    #[test]
    fn a_contradiction_counts_where_wider_slopes_would_leave_it() {
        assert!(matches!(found_of(1.2, 1.0), Found::Excluded(..)));
        // By less than a quarter of what the slope's range adds.
        let Found::Cuts(cuts) = found_of(1.11, 1.0) else { panic!("beyond doubt") };
        assert!(cuts.is_empty());
    }

    #[test]
    fn a_range_that_may_be_empty_leaves_a_sliver() {
        let Found::Cuts(cuts) = found_of(1.0999, 1.0) else { panic!("empty") };
        assert_eq!(cuts.len(), 1);
        assert!(!cuts[0].upper && cuts[0].end <= 1.0 - BEYOND && cuts[0].end > 0.9, "{cuts:?}");
        // Beyond by more than a share of its width, by less with a quarter of what the slope's range adds; and by more than both.
        let Found::Cuts(cuts) = found_of(1.03, 0.9) else { panic!("empty") };
        assert!(cuts[0].end < 0.9, "{cuts:?}");
        let Found::Cuts(cuts) = found_of(1.08, 0.9) else { panic!("empty") };
        assert!(cuts[0].end > 0.9, "{cuts:?}");
        let Found::Cuts(cuts) = found_of(0.5, 1.0) else { panic!("empty") };
        assert!((cuts[0].end - 0.4).abs() < 0.05, "{cuts:?}");
    }
}
