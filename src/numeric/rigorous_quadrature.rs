//! Enclosures of integrals of piecewise smooth functions, without antiderivatives and without known breakpoints.

use core::array;

use super::{Interval, Jet};

/// Degree of the Taylor polynomial whose remainder bounds a cell's integral; even, so that the remainder's weight is
/// nonnegative.
const DEGREE: usize = 14;

/// The jet an integrand is asked for.
pub type CellJet = Jet<{ DEGREE + 1 }>;

/// `M` functions of one variable, smooth but for finitely many points, that share their breakpoints.
pub trait Integrand<const M: usize> {
    /// Enclosures of all values on `t`.
    fn range(&self, t: Interval) -> [Interval; M];

    /// The jets on the cell or point `t.value()`; `None` where a breakpoint may lie in it. A jet with unbounded
    /// coefficients counts as `None`, so a formula of `abs`, `min` and `max` decides for itself.
    fn jet(&self, t: CellJet) -> Option<[CellJet; M]>;
}

/// What [`integrate`] found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrature<const M: usize> {
    /// The enclosures of the integrals; valid whether or not the wanted width was reached.
    pub integrals: [Interval; M],
    /// Cells evaluated.
    pub cells: usize,
    /// Whether every enclosure is at most as wide as wanted.
    pub reached: bool,
}

/// Encloses the integrals from `from` to `to`, which may themselves be enclosures (of `2 pi`, say), by bisecting the widest
/// contribution until each integral's width is at most `width`, or `budget` cells have been evaluated.
///
/// The enclosure is sound in any case. A width near the rounding error of the sum is not reached.
///
/// ```
/// use selfosc::numeric::rigorous_quadrature::{CellJet, Integrand, integrate};
/// use selfosc::numeric::{Interval, Real};
///
/// struct Rectified;
/// impl Integrand<1> for Rectified {
///     fn range(&self, t: Interval) -> [Interval; 1] {
///         [t.sin().abs()]
///     }
///     fn jet(&self, t: CellJet) -> Option<[CellJet; 1]> {
///         Some([t.sin().abs()])
///     }
/// }
/// let turn = Interval::pi() * Interval::two();
/// let found = integrate(&Rectified, Interval::ZERO, turn, 1e-12, 10_000);
/// assert!(found.reached && found.integrals[0].contains(4.0));
/// ```
#[must_use]
pub fn integrate<const M: usize>(
    integrand: &impl Integrand<M>,
    from: Interval,
    to: Interval,
    width: f64,
    budget: usize,
) -> Quadrature<M> {
    let (start, end) = (Interval::point(from.midpoint()), Interval::point(to.midpoint()));
    // What the endpoints' own widths contribute.
    let (at_start, at_end) = (integrand.range(from), integrand.range(to));
    let ends = array::from_fn(|i| at_start[i] * (start - from) + at_end[i] * (to - end));
    let sign = if end.precedes(start) { -Interval::ONE } else { Interval::ONE };

    let negligible = width / 1024.0;
    let first = Cell::new(integrand, start.hull(end), negligible);
    let mut settled = [Interval::ZERO; M];
    let mut open = vec![first];
    let mut cells = 1;
    while widths(settled, &open).iter().any(|&sum| sum > width) && cells + 2 <= budget {
        let Some(widest) = widest(&open) else { break };
        let parent = open.swap_remove(widest);
        let (left, right) = parent.domain.bisect();
        let halves = [left, right].map(|half| Cell::new(integrand, half, negligible));
        cells += 2;
        // Where a smooth cell's halves are no better, rounding is all that is left.
        let exhausted = parent.smooth && halves[0].width + halves[1].width > 0.9 * parent.width;
        for half in halves {
            if exhausted || half.width <= negligible || !half.divisible {
                settled = add(settled, half.integrals);
            } else {
                open.push(half);
            }
        }
    }
    let inner = open.iter().fold(settled, |sum, cell| add(sum, cell.integrals));
    let integrals = add(ends, inner.map(|integral| sign * integral));
    Quadrature { integrals, cells, reached: integrals.iter().all(|integral| integral.width() <= width) }
}

fn add<const M: usize>(a: [Interval; M], b: [Interval; M]) -> [Interval; M] {
    array::from_fn(|i| a[i] + b[i])
}

/// Estimates of the widths of the sums: they steer, and prove nothing.
fn widths<const M: usize>(settled: [Interval; M], open: &[Cell<M>]) -> [f64; M] {
    array::from_fn(|i| settled[i].width() + open.iter().map(|cell| cell.integrals[i].width()).sum::<f64>())
}

fn widest<const M: usize>(open: &[Cell<M>]) -> Option<usize> {
    let numbered = open.iter().enumerate();
    numbered.max_by(|(_, a), (_, b)| a.width.total_cmp(&b.width)).map(|(index, _)| index)
}

/// Part of the domain, with what it contributes.
struct Cell<const M: usize> {
    domain: Interval,
    integrals: [Interval; M],
    /// The largest width of a contribution.
    width: f64,
    /// Whether the jet decided the piece.
    smooth: bool,
    divisible: bool,
}

impl<const M: usize> Cell<M> {
    fn new(integrand: &impl Integrand<M>, domain: Interval, negligible: f64) -> Self {
        let length = Interval::point(domain.upper()) - Interval::point(domain.lower());
        let by_range = integrand.range(domain).map(|value| value * length);
        let by_jet = if largest_width(&by_range) <= negligible { None } else { taylor(integrand, domain) };
        let smooth = by_jet.is_some();
        let integrals = by_jet.map_or(by_range, |by_jet| {
            // Both hold, so the intersection is not empty.
            array::from_fn(|i| by_jet[i].intersection(by_range[i]).unwrap_or(by_range[i]))
        });
        let middle = domain.midpoint();
        let divisible = domain.lower() < middle && middle < domain.upper();
        Self { domain, integrals, width: largest_width(&integrals), smooth, divisible }
    }
}

fn largest_width<const M: usize>(integrals: &[Interval; M]) -> f64 {
    integrals.iter().map(|integral| integral.width()).fold(0.0, f64::max)
}

/// The integrals over a cell from the jets at its midpoint, with the coefficient of the whole cell as the last one.
fn taylor<const M: usize>(integrand: &impl Integrand<M>, domain: Interval) -> Option<[Interval; M]> {
    let decided = |at| integrand.jet(Jet::variable(at)).filter(|jets| jets.iter().all(Jet::is_bounded));
    let over_cell = decided(domain)?;
    let middle = Interval::point(domain.midpoint());
    let at_middle = decided(middle)?;
    let (left, right) = (Interval::point(domain.lower()) - middle, Interval::point(domain.upper()) - middle);
    let (mut left_power, mut right_power) = (Interval::ONE, Interval::ONE);
    let mut integrals = [Interval::ZERO; M];
    for k in 0..=DEGREE {
        left_power *= left;
        right_power *= right;
        let weight = (right_power - left_power) / Interval::point((k + 1) as f64);
        let jets = if k == DEGREE { &over_cell } else { &at_middle };
        for (integral, jet) in integrals.iter_mut().zip(jets) {
            *integral += jet.coefficients()[k] * weight;
        }
    }
    Some(integrals)
}
