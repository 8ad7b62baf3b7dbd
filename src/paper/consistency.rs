//! Table 4's rows as constraints on their common unknowns: the loop's delay, an error of the relay level, and the vehicle.
//!
//! Every printed number has an uncertainty of half a unit of its column's last decimal. Question: for which delay and which offset of the
//! relay level the paper's formulas (Table 3 with eq. 34) can be true of all rows at once. Boxes of these unknowns are halved;
//! a box on which the rows' enclosures do not intersect has no solution for any numbers within the printed decimals.
//! The remaining boxes enclose all solutions. If none remains, the searched box is proved to have none; nothing is claimed outside it.
//! A remaining box need not hold a solution.
//!
//! Two simplifications make boxes harder to exclude, never easier: a reading may take another value in each quantity that is
//! computed of it, and only its own row's unknowns constrain it. The formulas are those of first harmonics: that no vehicle
//! fits them does not show that none has these limit cycles.

use rayon::prelude::*;
use serde::Serialize;

use super::table4::{PrintedTable, Yaw, oscillation, printed};
use crate::identify::IdentifyError;
use crate::identify::iso::Oscillation;
use crate::numeric::{Interval, Real};
use crate::proof::Gradient;
use crate::proof::branch_and_bound::{Visit, subdivide};

/// Delays searched, s.
const DELAY_S: [f64; 2] = [0.0, 0.6];
/// Offsets searched, 1e-2 N m: the relay level is a factor times `C + offset`.
const LEVEL_OFFSET: [f64; 2] = [-1.0, 2.0];
/// Factors searched. They are confounded with the vehicle's scale, so a vehicle is searched without them.
const LEVEL_FACTOR: [f64; 2] = [0.5, 2.0];
/// A side is not halved further at this part of the domain's.
const RESOLUTION: f64 = 1.0 / 512.0;
/// Most boxes of a search: for the remaining set; for its emptiness; with a row omitted.
const BUDGETS: [usize; 3] = [20_000, 400, 200];
/// Largest growth of the half-units looked at, and the ratio of a bracket that is narrow enough.
const GROWTH: [f64; 2] = [256.0, 1.15];
/// Speed in deg/s of which [`RowQuantity::Drag`] is the drag, over the speed.
const SHARE_AT_DEG_S: f64 = 50.0;

/// Quantity computed from a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RowQuantity {
    Alpha,
    LinearDrag,
    QuadraticDrag,
    /// `beta + 50 beta_quadratic` of mixed drag whose second term is the searched share of it.
    Drag,
    /// Free of the relay level, as the next is.
    LinearDragOverAlpha,
    DragOverAlpha,
}

/// x_a*, X_m, x_0, T, delay, share.
type Variables<T> = [T; 6];

/// Each [`RowQuantity`] per unit of the relay level, in the table's units.
fn quantities<T: Real>(at: Variables<T>) -> Result<[T; 6], IdentifyError> {
    let [switch_level, amplitude, bias, period_s, delay_s, share] = at;
    let relay_level = T::one();
    let found = Oscillation { relay_level, switch_level, amplitude, bias, period_s, delay_s }.identify()?;
    let [alpha, linear] = [found.alpha, found.beta].map(|value| value * T::from_f64(100.0));
    let quadratic = found.beta_quadratic * T::from_f64(1000.0);
    // Ten, as the table's unit of quadratic drag is a tenth of that of linear drag.
    let drag = T::one() / ((T::one() - share) / linear + share / (quadratic * T::from_f64(SHARE_AT_DEG_S / 10.0)));
    Ok([alpha, linear, quadratic, drag, linear / alpha, drag / alpha])
}

impl RowQuantity {
    fn has_level(self) -> bool {
        !matches!(self, Self::LinearDragOverAlpha | Self::DragOverAlpha)
    }

    /// Its printed interval; a vehicle's parameters are not in the table.
    fn printed(self, row: &Yaw<Interval>) -> Interval {
        match self {
            Self::Alpha => row.alpha,
            Self::LinearDrag => row.beta_r,
            Self::QuadraticDrag => row.beta_rr,
            Self::LinearDragOverAlpha => row.beta_r / row.alpha,
            Self::Drag | Self::DragOverAlpha => Interval::ENTIRE,
        }
    }

    /// Its values on a box, given all with their derivatives there: variables in which it is monotone stand at their ends.
    fn range(self, at: &Variables<Interval>, over: &[Gradient<6>; 6]) -> Interval {
        let over = over[self as usize];
        let slopes = over.slopes();
        let extreme = |largest: bool| {
            let corner = std::array::from_fn(|i| {
                let (rises, falls) = (slopes[i].lower() >= 0.0, slopes[i].upper() <= 0.0);
                match rises || falls {
                    true if rises == largest => Interval::point(at[i].upper()),
                    true => Interval::point(at[i].lower()),
                    false => at[i],
                }
            });
            quantities(corner).map_or(Interval::ENTIRE, |values| values[self as usize])
        };
        let ends = Interval::new(extreme(false).lower(), extreme(true).upper());
        ends.and_then(|ends| ends.intersection(over.value())).unwrap_or(over.value())
    }
}

/// The unknowns common to all rows.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Common {
    /// A factor of the relay level in this range: printed over computed, of every quantity.
    Factor([f64; 2]),
    /// Each quantity itself, above zero: one vehicle.
    Vehicle,
}

/// Delay in s, offset of the relay level in 1e-2 N m, share of quadratic drag at 50 deg/s.
type Shared = [Interval; 3];

/// A question to all rows.
#[derive(Clone, Copy, Debug)]
struct ConsistencyQuestion {
    question: &'static str,
    allowed: &'static str,
    quantities: &'static [RowQuantity],
    common: Common,
    domain: [[f64; 2]; 3],
}

/// A row with its half-units grown.
struct WidenedRow {
    experiment: u32,
    level: Interval,
    readings: [Interval; 4],
    printed: Yaw<Interval>,
}

/// The rows, from both ends of the table inwards: rows that differ most come first.
fn rows(table: &PrintedTable, growth: f64) -> Vec<WidenedRow> {
    let row = |experiment| {
        let read = table.within(experiment, growth);
        let found = oscillation(&read);
        let readings = [found.switch_level, found.amplitude, found.bias, found.period_s];
        WidenedRow { experiment: experiment.number, level: found.relay_level, readings, printed: printed(&read) }
    };
    let all = table.experiments();
    (0..all.len()).map(|i| row(&all[if i % 2 == 0 { i / 2 } else { all.len() - 1 - i / 2 }])).collect()
}

impl ConsistencyQuestion {
    fn whole(&self) -> Shared {
        self.domain.map(between)
    }

    /// Whether the rows' enclosures meet on a box.
    fn met(&self, rows: &[WidenedRow], at: &Shared) -> bool {
        let mut common = [match self.common {
            Common::Factor(range) => between(range),
            Common::Vehicle => between([0.0, f64::MAX]),
        }; 3];
        rows.iter().all(|row| self.narrow(row, at, &mut common))
    }

    /// Intersects the common values with those that a row admits; `false` if the intersection is empty.
    fn narrow(&self, row: &WidenedRow, &[delay_s, offset, share]: &Shared, common: &mut [Interval; 3]) -> bool {
        let [switch_level, amplitude, bias, period_s] = row.readings;
        let at = [switch_level, amplitude, bias, period_s, delay_s, share];
        let over = match quantities(Gradient::variables(at)) {
            Ok(over) => over,
            // On all of the box, inertia or drag is not above zero.
            Err(IdentifyError::Unphysical { .. }) => return false,
            Err(_) => return true,
        };
        self.quantities.iter().zip(0..).all(|(quantity, place)| {
            let level = if quantity.has_level() { row.level + offset } else { Interval::ONE };
            let value = quantity.range(&at, &over) * level;
            let (place, value): (usize, _) = match self.common {
                Common::Factor(_) => (0, quantity.printed(&row.printed) / value),
                Common::Vehicle => (place, value),
            };
            let left = common[place].intersection(value);
            common[place] = left.unwrap_or(common[place]);
            left.is_some()
        })
    }

    /// The hull of the remaining boxes, `None` if none remain; and whether the search was completed.
    fn left(&self, rows: &[WidenedRow]) -> (Option<Shared>, bool) {
        let (whole, mut hull) = (self.whole(), None);
        let found = subdivide(whole, BUDGETS[0], |at| {
            let within = |hull: &Shared| at.iter().zip(hull).all(|(side, hull)| side.is_subset_of(*hull));
            if hull.as_ref().is_some_and(within) || !self.met(rows, at) {
                return Visit::Settled;
            }
            let small = at.iter().zip(whole).all(|(side, whole)| side.width() <= 1.01 * RESOLUTION * whole.width());
            if small {
                let old: Shared = hull.unwrap_or(*at);
                hull = Some(std::array::from_fn(|i| old[i].hull(at[i])));
            }
            Visit::settled(small)
        });
        (hull, found.unsettled.is_none())
    }

    /// Whether no box remains; `false` where enclosures meet at a point, `None` where the budget was spent.
    fn refuted(&self, rows: &[WidenedRow], budget: usize) -> Option<bool> {
        let mut met = false;
        let found = subdivide(self.whole(), budget, |at| {
            let middle = at.map(|side| Interval::point(side.midpoint()));
            if !self.met(rows, at) {
                return Visit::Settled;
            }
            met = self.met(rows, &middle);
            if met { Visit::Stop } else { Visit::settled(false) }
        });
        if met { Some(false) } else { found.unsettled.is_none().then_some(true) }
    }

    /// A growth of the half-units at which the rows are still refuted, and one at which their enclosures meet at a point.
    fn growth(&self, table: &PrintedTable) -> (f64, Option<f64>) {
        let refuted = |growth| self.refuted(&rows(table, growth), BUDGETS[1]);
        let (mut low, mut high) = (1.0, 2.0);
        while high < GROWTH[0] && refuted(high) == Some(true) {
            (low, high) = (high, 2.0 * high);
        }
        while high < GROWTH[0] && refuted(high) != Some(false) {
            high *= 2.0;
        }
        if high >= GROWTH[0] {
            return (low, None);
        }
        while high / low > GROWTH[1] {
            let middle = f64::sqrt(low * high);
            match refuted(middle) {
                Some(true) => low = middle,
                Some(false) => high = middle,
                None => break,
            }
        }
        (low, Some(high))
    }

    /// Rows that are refuted by themselves, none of which the search can spare, with half-units grown so much; none where the
    /// search is too long.
    fn contradicting(&self, table: &PrintedTable, growth: f64) -> Vec<u32> {
        let refuted = |rows: &[WidenedRow]| self.refuted(rows, BUDGETS[2]) == Some(true);
        let mut kept = rows(table, growth);
        if !refuted(&kept) {
            return Vec::new();
        }
        for index in (0..kept.len()).rev() {
            let row = kept.remove(index);
            if !refuted(&kept) {
                kept.insert(index, row);
            }
        }
        let mut numbers: Vec<u32> = kept.iter().map(|row| row.experiment).collect();
        numbers.sort_unstable();
        numbers
    }

    fn answer(&self, table: &PrintedTable) -> Consistency {
        let (left, complete) = self.left(&rows(table, 1.0));
        let refuted = left.is_none() && complete;
        let growth = refuted.then(|| self.growth(table));
        // Well below it, where few rows are enough and the search is short.
        let contradicting = growth.map_or_else(Vec::new, |(low, _)| self.contradicting(table, (0.25 * low).max(1.0)));
        let left = if complete { left } else { Some(self.whole()) };
        let side = |i: usize| left.map(|left| left[i].bounds());
        Consistency {
            question: self.question,
            allowed: self.allowed,
            verdict: if refuted { Verdict::Refuted } else { Verdict::NotRefuted },
            searched: self.domain,
            delay_s: side(0),
            level_offset: side(1),
            growth,
            contradicting,
        }
    }
}

fn between([lower, upper]: [f64; 2]) -> Interval {
    Interval::new(lower, upper).unwrap_or(Interval::ENTIRE)
}

/// Verdict of a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Proved: nothing in the box searched is consistent with all rows.
    Refuted,
    /// A box is left; whether an answer is in it is not proved.
    NotRefuted,
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Consistency {
    /// The quantities in which the rows must agree.
    pub question: &'static str,
    /// The error of the relay level that was allowed.
    pub allowed: &'static str,
    /// What is known.
    pub verdict: Verdict,
    /// The box searched: delay in s, offset of the relay level in 1e-2 N m, share of quadratic drag at 50 deg/s.
    pub searched: [[f64; 2]; 3],
    /// Bounds of the delays left, s: proved that none outside of them is consistent.
    pub delay_s: Option<(f64, f64)>,
    /// Bounds of the offsets left, 1e-2 N m: likewise.
    pub level_offset: Option<(f64, f64)>,
    /// Where refuted: a factor on the half-units that is refuted too, and a factor at which all rows' enclosures meet at a
    /// point, so that this search cannot refute them. Between the factors the question is open.
    pub growth: Option<(f64, Option<f64>)>,
    /// Experiments that contradict each other, even with a quarter of the first growth (and never below one); none where that was not found in a short search.
    pub contradicting: Vec<u32>,
}

/// Every question's answer.
///
/// Boxes: delay 0 to 0.6 s, offset -1 to 2 (1e-2 N m), factor 0.5 to 2 where one is allowed, drag coefficients of zero or more.
#[must_use]
pub fn consistency(table: &PrintedTable) -> Vec<Consistency> {
    use RowQuantity::{Alpha, Drag, DragOverAlpha, LinearDrag, LinearDragOverAlpha, QuadraticDrag};
    const OFFSET: &str = "offset";
    const SCALED: &str = "offset and factor";
    let printed = |question, allowed, quantities, factors| ConsistencyQuestion {
        question,
        allowed,
        quantities,
        common: Common::Factor(factors),
        domain: [DELAY_S, LEVEL_OFFSET, [0.0; 2]],
    };
    let each = printed("alpha and beta_r", "any, in each experiment", &[LinearDragOverAlpha][..], [1.0; 2]);
    let vehicle = |question, share| ConsistencyQuestion {
        question,
        allowed: SCALED,
        quantities: &[Alpha, Drag, DragOverAlpha],
        common: Common::Vehicle,
        domain: [DELAY_S, LEVEL_OFFSET, share],
    };
    let cases = [
        printed("alpha", OFFSET, &[Alpha][..], [1.0; 2]),
        printed("alpha", SCALED, &[Alpha], LEVEL_FACTOR),
        printed("beta_r", OFFSET, &[LinearDrag], [1.0; 2]),
        printed("beta_rr", OFFSET, &[QuadraticDrag], [1.0; 2]),
        printed("beta_r and beta_rr", SCALED, &[LinearDrag, QuadraticDrag], LEVEL_FACTOR),
        printed("alpha, beta_r and beta_rr", SCALED, &[Alpha, LinearDrag, QuadraticDrag], LEVEL_FACTOR),
        ConsistencyQuestion { domain: [DELAY_S, [0.0; 2], [0.0; 2]], ..each },
        vehicle("one vehicle, linear drag", [0.0; 2]),
        vehicle("one vehicle, quadratic drag", [1.0; 2]),
        vehicle("one vehicle, mixed drag", [0.0, 1.0]),
    ];
    cases.par_iter().map(|case| case.answer(table)).collect()
}
