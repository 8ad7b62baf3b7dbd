//! Rigorous quadrature by Taylor models: integrals of piecewise smooth functions, without antiderivatives and without given
//! breakpoints.
//!
//! It subdivides on its own, not by branch and bound: the widest contribution goes first, since a sum of widths decides and
//! not a single cell; and cells shrink geometrically towards an end at which derivatives grow without bound.

use core::array;

use crate::numeric::{Interval, Jet};

/// Degree of the Taylor polynomial whose remainder bounds a cell's integral; even, so that the remainder's weight is
/// nonnegative.
const DEGREE: usize = 14;

/// The jet an integrand is asked for.
pub type CellJet = Jet<{ DEGREE + 1 }>;

/// `M` functions of a single variable, smooth but for finitely many points, that share their breakpoints.
pub trait Integrand<const M: usize> {
    /// Enclosures of all values on `t`.
    fn range(&self, t: Interval) -> [Interval; M];

    /// The jets on the cell or point `t.value()`; `None` where a breakpoint may lie in it. A jet with unbounded
    /// coefficients counts as `None`, so a formula of `abs`, `min` and `max` decides for itself.
    fn jet(&self, t: CellJet) -> Option<[CellJet; M]>;
}

/// Ranges and jets.
impl<const M: usize, R: Fn(Interval) -> [Interval; M], J: Fn(CellJet) -> Option<[CellJet; M]>> Integrand<M> for (R, J) {
    fn range(&self, t: Interval) -> [Interval; M] {
        self.0(t)
    }
    fn jet(&self, t: CellJet) -> Option<[CellJet; M]> {
        self.1(t)
    }
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

/// Encloses the integrals from `from` to `to`, which may themselves be enclosures (of `2 pi`, say), by dividing the cell of the
/// widest contribution until each integral's width is at most `width`, or `budget` cells have been evaluated. Cells are halved,
/// and graded towards an end at which the derivatives grow without bound (a root of a power, say).
///
/// The enclosure is sound in any case: how cells are divided decides its width and the work. A width near the rounding error of
/// the sum is not reached.
///
/// ```
/// use selfosc::proof::rigorous_quadrature::{CellJet, integrate};
/// use selfosc::numeric::{Interval, Real};
///
/// let rectified = (|t: Interval| [t.sin().abs()], |t: CellJet| Some([t.sin().abs()]));
/// let turn = Interval::pi() * Interval::two();
/// let found = integrate(&rectified, Interval::ZERO, turn, 1e-12, 10_000);
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
    let sign = if end.precedes(start) { -Interval::ONE } else { Interval::ONE };
    // Contribution of the endpoints' own widths.
    let (at_start, at_end) = (integrand.range(from), integrand.range(to));
    let mut settled = array::from_fn(|i| sign * (at_start[i] * (start - from) + at_end[i] * (to - end)));

    let whole = start.hull(end);
    let mut open = vec![Subdomain::new(integrand, whole, width, false)];
    let mut cells = 1;
    while let Some(widest) = widest(&open) {
        // The sum is formed only once no single cell is too wide.
        if open[widest].width <= width && largest_width(&total(settled, &open)) <= width {
            break;
        }
        let parts = open[widest].parts(whole);
        if cells + parts.len() > budget {
            break;
        }
        cells += parts.len();
        let parent = open.swap_remove(widest);
        let rough = parent.smoothness != Smoothness::Decided;
        let parts: Vec<_> = parts.into_iter().map(|part| Subdomain::new(integrand, part, width, rough)).collect();
        // Where a smooth cell's halves are no better, only rounding remains.
        let exhausted = !rough && parts.iter().map(|part| part.width).sum::<f64>() > 0.9 * parent.width;
        for part in parts {
            if exhausted || part.width <= width * NEGLIGIBLE || !part.divisible() {
                settled = add(settled, part.integrals);
            } else {
                open.push(part);
            }
        }
    }
    let integrals = total(settled, &open).map(|integral| sign * integral);
    Quadrature { integrals, cells, reached: integrals.iter().all(|integral| integral.width() <= width) }
}

fn add<const M: usize>(a: [Interval; M], b: [Interval; M]) -> [Interval; M] {
    array::from_fn(|i| a[i] + b[i])
}

/// The sum over settled and open cells.
fn total<const M: usize>(settled: [Interval; M], open: &[Subdomain<M>]) -> [Interval; M] {
    open.iter().fold(settled, |sum, cell| add(sum, cell.integrals))
}

fn widest<const M: usize>(open: &[Subdomain<M>]) -> Option<usize> {
    let numbered = open.iter().enumerate();
    numbered.max_by(|(_, a), (_, b)| a.width.total_cmp(&b.width)).map(|(index, _)| index)
}

/// Share of the wanted width that no cell is divided for.
const NEGLIGIBLE: f64 = 1.0 / 1024.0;
/// A cell whose remainder is this much wider than wanted has a singularity within or next to it.
const SINGULAR: f64 = 1e30;
/// Halvings towards a singularity, before the jets are asked again.
const GRADES: usize = 3;

/// Verdict of the jet over a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Smoothness {
    /// The integrals are by the jets.
    Decided,
    /// The cell is too long.
    TooLong,
    /// Divisions away from a single point do not suffice.
    Singular,
}

/// Part of the domain, with its contribution.
struct Subdomain<const M: usize> {
    domain: Interval,
    integrals: [Interval; M],
    /// The largest width of a contribution.
    width: f64,
    smoothness: Smoothness,
}

impl<const M: usize> Subdomain<M> {
    /// By the jets, or by the range where they do not decide; by the range first where they did not on a larger cell.
    fn new(integrand: &impl Integrand<M>, domain: Interval, wanted: f64, rough: bool) -> Self {
        let length = Interval::point(domain.upper()) - Interval::point(domain.lower());
        let by_range = || integrand.range(domain).map(|value| value * length);
        let of = |integrals: [Interval; M], smoothness| Self {
            domain,
            integrals,
            width: largest_width(&integrals),
            smoothness,
        };
        let first = rough.then(|| of(by_range(), Smoothness::TooLong));
        if let Some(cell) = first.filter(|cell| cell.width <= wanted * NEGLIGIBLE) {
            return cell;
        }
        taylor(integrand, domain, wanted).map_or_else(|why| of(by_range(), why), |found| of(found, Smoothness::Decided))
    }

    fn divisible(&self) -> bool {
        let middle = self.domain.midpoint();
        self.domain.lower() < middle && middle < self.domain.upper()
    }

    /// Halves; beside an end of the whole domain that is singular, halves of halves towards that end.
    fn parts(&self, whole: Interval) -> Vec<Interval> {
        let (at_start, at_end) = (self.domain.lower() <= whole.lower(), self.domain.upper() >= whole.upper());
        let graded = self.smoothness == Smoothness::Singular && at_start != at_end;
        let (mut rest, mut parts) = (self.domain, Vec::with_capacity(GRADES + 1));
        for _ in 0..if graded { GRADES } else { 1 } {
            let (left, right) = rest.bisect();
            let part;
            (part, rest) = if at_end { (left, right) } else { (right, left) };
            parts.push(part);
        }
        parts.push(rest);
        parts
    }
}

fn largest_width<const M: usize>(integrals: &[Interval; M]) -> f64 {
    integrals.iter().map(|integral| integral.width()).fold(0.0, f64::max)
}

/// The integrals over a cell from the jets at its midpoint, with the coefficient of the whole cell as the last one; unless
/// that makes them wider than `wanted`.
fn taylor<const M: usize>(
    integrand: &impl Integrand<M>,
    domain: Interval,
    wanted: f64,
) -> Result<[Interval; M], Smoothness> {
    let decided = |at| integrand.jet(Jet::variable(at)).filter(|jets| jets.iter().all(Jet::is_bounded));
    let middle = Interval::point(domain.midpoint());
    let (left, right) = (Interval::point(domain.lower()) - middle, Interval::point(domain.upper()) - middle);
    let (mut left_power, mut right_power) = (Interval::ONE, Interval::ONE);
    // Of `(t - middle)^k` over the cell.
    let weights: [Interval; DEGREE + 1] = array::from_fn(|k| {
        left_power *= left;
        right_power *= right;
        (right_power - left_power) / Interval::point((k + 1) as f64)
    });
    let over_cell = decided(domain).ok_or(Smoothness::Singular)?;
    let rest = over_cell.map(|jet| jet.coefficients()[DEGREE] * weights[DEGREE]);
    match largest_width(&rest) / wanted {
        excess if excess <= 1.0 => {}
        excess if excess <= SINGULAR => return Err(Smoothness::TooLong),
        _ => return Err(Smoothness::Singular),
    }
    let at_middle = decided(middle).ok_or(Smoothness::Singular)?;
    Ok(array::from_fn(|i| {
        let terms = at_middle[i].coefficients().iter().copied().zip(weights);
        rest[i] + Interval::dot(terms.take(DEGREE))
    }))
}
