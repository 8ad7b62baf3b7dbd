//! A transfer function as a sum over groups of poles, with proof: factors by Krawczyk's operator, partial fractions by elimination.

use nalgebra::{Complex, DMatrix, DVector};

use super::algebra::{Algebra, Element, MOST, ZERO};
use crate::numeric::Interval;
use crate::orbit::OrbitError;
use crate::plant::{TransferFunction, product};
use crate::proof::interval_matrix::solve;

/// Poles within this share of their size form a group: the shares of separate poles grow with the inverse of
/// their distances and cancel.
const GAP: f64 = 0.2;

/// A group of poles of the plant: `x' = A x + u`, its share of the output `sum_j output_j x_j`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mode {
    pub(super) algebra: Algebra,
    output: Element,
    /// `1/A`; `None` for the poles at zero.
    pub(super) inverse: Option<Element>,
    /// Whether it is unstable: its bounded motion follows from the future.
    pub(super) backwards: bool,
}

impl Mode {
    pub(super) fn output(&self, state: &Element) -> Interval {
        (0..self.algebra.degree).fold(Interval::ZERO, |sum, at| sum + self.output[at] * state[at])
    }

    /// A bound of `abs(output(x))/norm(x)`.
    pub(super) fn reach(&self) -> f64 {
        self.output.iter().map(|entry| entry.magnitude()).fold(0.0, f64::max)
    }

    /// The same group with each of its states as the output.
    pub(super) fn states(&self) -> impl Iterator<Item = Self> {
        (0..self.algebra.degree).map(|state| {
            let mut output = ZERO;
            output[state] = Interval::ONE;
            Self { output, ..self.clone() }
        })
    }

    pub(super) fn output_row(&self) -> &[Interval] {
        &self.output[..self.algebra.degree]
    }

    /// Gain at s = 0; `None` for the poles at zero.
    pub(super) fn static_gain(&self) -> Option<Interval> {
        Some(-self.output(self.inverse.as_ref()?))
    }
}

/// Approximate factors, ascending without the leading coefficient, of a polynomial without a root at zero.
fn factors(descending: &[f64]) -> Result<Vec<Vec<f64>>, OrbitError> {
    let poles = TransferFunction::new(&[1.0], descending)?.poles()?;
    let turns = |pole: &Complex<f64>| 2.0 * pole.im.abs() > GAP * pole.norm();
    let (turning, real): (Vec<_>, Vec<_>) = poles.into_iter().partition(turns);
    let mut real: Vec<f64> = real.iter().map(|pole| pole.re).collect();
    real.sort_by(f64::total_cmp);
    let groups = real.chunk_by(|a, b| (b - a).abs() <= GAP * a.abs().max(b.abs()));
    // More poles than a group takes are divided evenly.
    let groups = groups.flat_map(|group| group.chunks(group.len().div_ceil(group.len().div_ceil(MOST))));
    let real = groups.map(|group| {
        let monic = group.iter().fold(vec![1.0], |factor, &pole| product(&factor, &[1.0, -pole]));
        monic[1..].iter().rev().copied().collect()
    });
    let pairs = turning.iter().filter(|pole| pole.im > 0.0).map(|pole| vec![pole.norm_sqr(), -2.0 * pole.re]);
    Ok(real.chain(pairs).collect())
}

/// Product of monic polynomials, ascending, all but the factor `without`; `None`: of all.
fn others(factors: &[Vec<Interval>], without: Option<usize>) -> Vec<Interval> {
    let kept = factors.iter().enumerate().filter(|(index, _)| Some(*index) != without).map(|(_, factor)| factor);
    kept.fold(vec![Interval::ONE], |product, factor| {
        let mut result = vec![Interval::ZERO; product.len() + factor.len()];
        for (i, &a) in product.iter().enumerate() {
            for (j, &b) in factor.iter().chain([&Interval::ONE]).enumerate() {
                result[i + j] += a * b;
            }
        }
        result
    })
}

/// The matrix whose columns are `s^j` times the product of the remaining factors, for each coefficient of each factor.
fn columns(factors: &[Vec<Interval>]) -> DMatrix<Interval> {
    let size = factors.iter().map(Vec::len).sum();
    let mut matrix = DMatrix::zeros(size, size);
    let mut column = 0;
    for (index, factor) in factors.iter().enumerate() {
        let rest = others(factors, Some(index));
        for power in 0..factor.len() {
            rest.iter().enumerate().for_each(|(row, &entry)| matrix[(row + power, column)] = entry);
            column += 1;
        }
    }
    matrix
}

/// A list in parts as long as these.
fn cut_like<T>(mut list: &[Interval], parts: &[Vec<T>]) -> Vec<Vec<Interval>> {
    let cut = |part: &Vec<T>| {
        let (head, tail) = list.split_at(part.len());
        list = tail;
        head.to_vec()
    };
    parts.iter().map(cut).collect()
}

/// Encloses the factors near approximate factors: Krawczyk's operator on the coefficients. `monic` ascends.
fn enclose(near: &[Vec<f64>], monic: &[Interval]) -> Option<Vec<Vec<Interval>>> {
    if let [_] = near {
        return Some(vec![monic.to_vec()]);
    }
    let size = monic.len();
    let split = |flat: &DVector<Interval>| cut_like(flat.as_slice(), near);
    let miss = |factors: &[Vec<Interval>]| {
        let whole = others(factors, None);
        DVector::from_fn(size, |row, _| whole[row] - monic[row])
    };
    let mut middle = DVector::from_iterator(size, near.iter().flatten().copied());
    let mut inverse = None;
    for _ in 0..4 {
        let at = split(&middle.map(Interval::point));
        let approximate = columns(&at).map(Interval::midpoint).try_inverse()?;
        let step = &approximate * miss(&at).map(Interval::midpoint);
        middle -= step;
        inverse = Some(approximate.map(Interval::point));
    }
    let (inverse, point) = (inverse?, middle.map(Interval::point));
    let correction = &inverse * miss(&split(&point));
    let mut radius: Vec<f64> =
        correction.iter().zip(&middle).map(|(c, m)| 4.0 * c.magnitude() + 1e-16 * m.abs()).collect();
    for _ in 0..8 {
        let spread = DVector::from_fn(size, |row, _| Interval::symmetric(radius[row]));
        let jacobian = columns(&split(&(&point + &spread)));
        let image = -&correction + (DMatrix::identity(size, size) - &inverse * jacobian) * &spread;
        if (0..size).all(|row| image[row].is_interior_to(spread[row])) {
            return Some(split(&(point + image)));
        }
        radius.iter_mut().for_each(|radius| *radius *= 4.0);
    }
    None
}

/// The coefficients of a polynomial in `s - shift`, ascending.
fn shifted(ascending: &[Interval], shift: Interval) -> Vec<Interval> {
    let mut moved = ascending.to_vec();
    for start in 0..moved.len() {
        for at in (start..moved.len() - 1).rev() {
            moved[at] = moved[at] + shift * moved[at + 1];
        }
    }
    moved
}

/// The group with a share `numerator/factor` of the transfer function.
fn mode(factor: &[Interval], numerator: &[Interval], at_zero: bool) -> Option<Mode> {
    let degree = factor.len();
    let last = factor[degree - 1] / Interval::point(degree as f64);
    // Up to two poles are moved by exactly their mean: nothing remains of the last coefficient.
    let shift = match degree {
        _ if at_zero => Interval::ZERO,
        1 => -factor[0],
        2 => -last,
        _ => Interval::point(-last.midpoint()),
    };
    let monic: Vec<Interval> = factor.iter().copied().chain([Interval::ONE]).collect();
    let mut moved = shifted(&monic, shift);
    moved.pop();
    if degree <= 2 {
        moved[degree - 1] = Interval::ZERO;
    }
    let numerator = shifted(numerator, shift);
    let algebra = Algebra::new(shift, &moved)?;
    // n/g = sum_j h_j (s - shift)^(-j-1): h_j = n_(degree-1-j) - sum_(i<j) g_(degree-j+i) h_i.
    let mut output = ZERO;
    for j in 0..degree {
        let known = (0..j).fold(Interval::ZERO, |sum, i| sum + moved[degree - j + i] * output[i]);
        output[j] = numerator[degree - 1 - j] - known;
    }
    let mut unit = Interval::ONE;
    for entry in output.iter_mut().take(degree) {
        *entry = *entry / unit;
        unit *= Interval::point(algebra.scale);
    }
    let inverse = if at_zero { None } else { Some(algebra.reciprocal(&algebra.generator())?) };
    let backwards = !at_zero && algebra.shift.is_positive();
    Some(Mode { algebra, output, inverse, backwards })
}

/// All groups of poles of a strictly proper plant, those at zero first.
pub(super) fn modes(plant: &TransferFunction) -> Result<Vec<Mode>, OrbitError> {
    let (numerator, denominator) = (plant.numerator(), plant.denominator());
    let order = denominator.len() - 1;
    if numerator.len() > order {
        return Err(crate::plant::PlantError::NotStrictlyProper { degree: order }.into());
    }
    let at_zero = denominator.iter().rev().take_while(|&&coefficient| coefficient == 0.0).count();
    let lead = Interval::point(denominator[0]);
    let rest = &denominator[..=order - at_zero];
    let mut parts: Vec<Vec<Interval>> = Vec::new();
    let crowded = |order| OrbitError::CrowdedPoles { order };
    if rest.len() > 1 {
        let monic: Vec<Interval> = rest[1..].iter().rev().map(|&c| Interval::point(c) / lead).collect();
        parts = enclose(&factors(rest)?, &monic).ok_or(crowded(order))?;
    }
    if at_zero > 0 {
        parts.insert(0, vec![Interval::ZERO; at_zero]);
    }
    if parts.iter().any(|part| part.len() > MOST) {
        return Err(crowded(order));
    }
    let mut right = DMatrix::zeros(order, 1);
    numerator.iter().rev().enumerate().for_each(|(row, &c)| right[(row, 0)] = Interval::point(c) / lead);
    let shares = solve(columns(&parts), right).ok_or(crowded(order))?;
    let shares = cut_like(shares.as_slice(), &parts);
    let groups = parts.iter().zip(&shares).enumerate();
    groups.map(|(at, (part, share))| mode(part, share, at == 0 && at_zero > 0).ok_or(crowded(order))).collect()
}
