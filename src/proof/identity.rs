//! Identities proved over a whole interval or rectangle: functions that vanish everywhere, to a bound.
//!
//! Bisection alone would need cells as small as the bound. A Taylor polynomial with remainder does not: the coefficients at
//! a cell's midpoint vanish to rounding, and the remainder shrinks with a high power of the cell's length. In two variables
//! it is taken along as many lines as make up an interpolation in the other variable, whose remainder is bounded alike.

use std::array;

use super::branch_and_bound::{Visit, subdivide};
use super::outcome::{Bound, NotProved, Proved};
use crate::numeric::{Interval, Jet};

/// Coefficients of the jets; the last is unused, so that a [derivative](Jet::derivative) will do.
const ORDER: usize = 16;

/// The jet a function is asked for.
pub type IdentityJet = Jet<ORDER>;

/// Proves that `M` functions stay within `tolerance` of zero from `from` to `to`, on at most `budget` cells.
///
/// A kink (`abs`, `min`, `select`) is allowed where the values near it are within the tolerance anyway.
///
/// ```
/// use selfosc::numeric::Real;
/// use selfosc::proof::identity::{IdentityJet, prove_zero};
/// let pythagoras = |factor: f64| move |t: IdentityJet| [t.sin().square() + t.cos().square() - IdentityJet::from_f64(factor)];
/// assert!(prove_zero(pythagoras(1.0), 0.0, 10.0, 1e-13, 1000).is_ok());
/// assert!(prove_zero(pythagoras(1.00001), 0.0, 10.0, 1e-13, 1000).is_err());
/// ```
///
/// # Errors
/// [`NotProved`], because it is false or because the functions are not smooth enough.
pub fn prove_zero<const M: usize>(
    f: impl Fn(IdentityJet) -> [IdentityJet; M],
    from: f64,
    to: f64,
    tolerance: f64,
    budget: usize,
) -> Result<Proved<1>, NotProved<1>> {
    let domain = [range([from, to])?];
    let mut bound = 0.0_f64;
    let found = subdivide(domain, budget, |&[cell]| {
        let by_range = f(Jet::constant(cell)).map(|jet| jet.value().magnitude());
        let Some(value) = magnitude(&f, cell) else { return Visit::Stop };
        let value = value.min(by_range.into_iter().fold(0.0, f64::max));
        if value <= tolerance {
            bound = bound.max(value);
        }
        Visit::settled(value <= tolerance)
    });
    found.proved(domain, Bound::Residual(bound))
}

fn range<const N: usize>([from, to]: [f64; 2]) -> Result<Interval, NotProved<N>> {
    Interval::new(from, to).ok_or(NotProved::Undecided { at: [Interval::ENTIRE; N], boxes: 0 })
}

/// Proves that `M` functions of two variables stay within `tolerance` of zero on the rectangle `domain`, on at most `budget`
/// cells. `values` and `series` are the same functions in two arithmetics.
///
/// The functions have to be smooth on the closed rectangle. On a cell they are interpolated at Chebyshev nodes in both
/// variables; the remainders are bounded by the last coefficients of jets over the whole cell.
///
/// ```
/// use selfosc::numeric::Real;
/// use selfosc::proof::identity::prove_zero_of_two;
/// fn addition<T: Real>(a: T, b: T, factor: f64) -> [T; 1] {
///     [(a + b).sin() - a.sin() * b.cos() - a.cos() * b.sin() * T::from_f64(factor)]
/// }
/// let prove = |factor| {
///     prove_zero_of_two(
///         |a, b| addition(a, b, factor),
///         |a, b| addition(a, b, factor),
///         [[0.0, 2.0], [0.0, 2.0]],
///         1e-12,
///         1000,
///     )
/// };
/// assert!(prove(1.0).is_ok() && prove(1.00001).is_err());
/// ```
///
/// # Errors
/// [`NotProved::Undecided`], because it is false or because the functions are not smooth enough.
pub fn prove_zero_of_two<const M: usize>(
    values: impl Fn(Interval, Interval) -> [Interval; M],
    series: impl Fn(IdentityJet, IdentityJet) -> [IdentityJet; M],
    domain: [[f64; 2]; 2],
    tolerance: f64,
    budget: usize,
) -> Result<Proved<2>, NotProved<2>> {
    let domain = [range(domain[0])?, range(domain[1])?];
    let last = |jets: [IdentityJet; M]| largest(jets.map(|jet| jet.coefficients()[NODES]));
    let mut bound = 0.0_f64;
    let found = subdivide(domain, budget, |&[a, b]| {
        let (across_a, across_b) = (node_polynomial(a), node_polynomial(b));
        let rest_a = |b| LEBESGUE * across_a * last(series(IdentityJet::variable(a), IdentityJet::constant(b)));
        let rest_b = |a| across_b * last(series(IdentityJet::constant(a), IdentityJet::variable(b)));
        let rests = rest_a(b) + rest_b(a);
        if rests <= 0.5 * tolerance {
            let (Some(nodes_a), Some(nodes_b)) = (chebyshev(a), chebyshev(b)) else { return Visit::Stop };
            let pairs = nodes_a.iter().flat_map(|&a| nodes_b.iter().map(move |&b| (a, b)));
            let at_nodes = pairs.map(|(a, b)| largest(values(a, b))).fold(0.0, f64::max);
            let sum = LEBESGUE * LEBESGUE * at_nodes + rests;
            // A cell's nodes settle it: smaller cells have no smaller values.
            if sum > tolerance {
                return Visit::Stop;
            }
            bound = bound.max(sum);
            return Visit::Settled;
        }
        // A remainder too large on a line calls for shorter lines; else for fewer lines.
        let along_a = rest_a(Interval::point(b.midpoint())) > 0.25 * tolerance;
        let along_b = rest_b(Interval::point(a.midpoint())) > 0.25 * tolerance;
        let halve_a = if along_a == along_b { across_a >= across_b } else { along_a };
        Visit::Divide { rank: 0.0, along: Some(usize::from(!halve_a)) }
    });
    found.proved(domain, Bound::Residual(bound))
}

/// Nodes of an interpolation.
const NODES: usize = ORDER - 2;
/// An interpolation at `n` Chebyshev nodes exceeds the largest value there by `1 + (2/pi) ln n` at most: below 2.7 for 14.
const LEBESGUE: f64 = 3.0;

fn largest<const M: usize>(values: [Interval; M]) -> f64 {
    values.iter().map(|value| value.magnitude()).fold(0.0, f64::max)
}

/// The Chebyshev nodes of an interval; `None` if rounding displaces them noticeably.
fn chebyshev(interval: Interval) -> Option<[Interval; NODES]> {
    let (middle, half) = (interval.midpoint(), 0.5 * interval.width());
    let node = |k: usize| {
        let angle = core::f64::consts::PI * (k as f64 + 0.5) / NODES as f64;
        Interval::point(middle + half * libm::cos(angle))
    };
    (half > 1e-3 * (1.0 + middle.abs())).then(|| array::from_fn(node))
}

/// Bound of `prod (t - node)` over the interval: `2 (h/2)^n` for exact nodes, h half the length; nodes displaced by up to
/// `1e-12 h` add less than a thousandth to it.
fn node_polynomial(interval: Interval) -> f64 {
    2.002 * (0.25 * interval.width()).powi(NODES as i32)
}

/// A bound of the magnitudes of `f` on a cell, infinite where `f` is not smooth; `None` where `f` is far from zero at the
/// midpoint, so that no division helps.
pub(crate) fn magnitude<const M: usize>(f: &impl Fn(IdentityJet) -> [IdentityJet; M], cell: Interval) -> Option<f64> {
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
