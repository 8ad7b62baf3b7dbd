//! Identities of one variable proved over a whole interval: functions that vanish everywhere, to a bound.
//!
//! Bisection alone would need cells as small as the bound. A Taylor polynomial with remainder does not: the coefficients at
//! a cell's midpoint vanish to rounding, and the remainder shrinks with a high power of the cell's length.

use super::{Interval, Jet};

/// Coefficients of the jets; the last is not used, so that a [derivative](Jet::derivative) will do.
const ORDER: usize = 16;

/// The jet a function is asked for.
pub type Series = Jet<ORDER>;

/// What [`prove_zero`] proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vanishing {
    /// No value is larger than this in magnitude.
    pub bound: f64,
    /// Cells that the interval was divided into.
    pub cells: usize,
}

/// Proves that `M` functions stay within `tolerance` of zero from `from` to `to`; `None` if that was not proved with
/// `budget` cells, because it is false or because the functions are not smooth enough.
///
/// A kink (`abs`, `min`, `select`) is allowed where the values near it are within the tolerance anyway.
///
/// ```
/// use selfosc::numeric::Real;
/// use selfosc::numeric::identity::{Series, prove_zero};
/// let pythagoras = |factor: f64| move |t: Series| [t.sin().square() + t.cos().square() - Series::from_f64(factor)];
/// assert!(prove_zero(pythagoras(1.0), 0.0, 10.0, 1e-13, 1000).is_some());
/// assert!(prove_zero(pythagoras(1.00001), 0.0, 10.0, 1e-13, 1000).is_none());
/// ```
#[must_use]
pub fn prove_zero<const M: usize>(
    f: impl Fn(Series) -> [Series; M],
    from: f64,
    to: f64,
    tolerance: f64,
    budget: usize,
) -> Option<Vanishing> {
    let mut bound = 0.0_f64;
    let cells = cover(Interval::new(from, to)?, budget, |cell| {
        let by_range = f(Jet::constant(cell)).map(|jet| jet.value().magnitude());
        let value = magnitude(&f, cell)?.min(by_range.into_iter().fold(0.0, f64::max));
        if value <= tolerance {
            bound = bound.max(value);
        }
        Some(value <= tolerance)
    })?;
    Some(Vanishing { bound, cells })
}

/// Divides `domain` from left to right until `settled` says that each cell is done; `None` where it gives up, a cell
/// cannot be halved, or `budget` cells do not suffice.
pub(crate) fn cover(
    domain: Interval,
    budget: usize,
    mut settled: impl FnMut(Interval) -> Option<bool>,
) -> Option<usize> {
    let mut open = vec![domain];
    let mut cells = 0;
    while let Some(cell) = open.pop() {
        cells += 1;
        if settled(cell)? {
            continue;
        }
        let (left, right) = cell.bisect();
        if cells >= budget || left.is_point() || right.is_point() {
            return None;
        }
        open.extend([right, left]);
    }
    Some(cells)
}

/// A bound of the magnitudes of `f` on a cell, infinite where `f` is not smooth; `None` where `f` is far from zero at the
/// midpoint, so that no division helps.
pub(crate) fn magnitude<const M: usize>(f: &impl Fn(Series) -> [Series; M], cell: Interval) -> Option<f64> {
    const LAST: usize = ORDER - 2;
    let middle = Interval::point(cell.midpoint());
    let (over_cell, at_middle) = (f(Jet::variable(cell)), f(Jet::variable(middle)));
    let offset = cell - middle;
    let mut largest = 0.0_f64;
    for (over_cell, at_middle) in over_cell.iter().zip(&at_middle) {
        let value = at_middle.value();
        if value.lower().max(-value.upper()) > HOPELESS {
            return None;
        }
        let remainder = over_cell.coefficients()[LAST];
        let sum = at_middle.coefficients()[..LAST].iter().rev().fold(remainder, |sum, &c| sum * offset + c);
        largest = largest.max(sum.magnitude());
    }
    Some(largest)
}

/// A value this far from zero at a single point ends the attempt: the identities that are proved are far closer.
const HOPELESS: f64 = 1e-9;
