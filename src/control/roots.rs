//! Positive roots of polynomials of low degree, all of them, and Routh's table, without a heap.

use crate::numeric::{Real, Scalar, increasing_root};

/// Coefficients of degree four or less, ascending.
pub(super) type Polynomial<S> = [S; 5];

/// At most four numbers, ascending, with places that are empty.
pub(super) type Few<S> = [Option<S>; 4];

/// Value and derivative of the polynomial at a point.
pub(super) fn horner<S: Scalar>(polynomial: &[S], at: S) -> (S, S) {
    polynomial.iter().rev().fold((S::zero(), S::zero()), |(value, slope), &c| (value * at + c, slope * at + value))
}

pub(super) fn product<S: Scalar>(a: &[S], b: &[S]) -> Polynomial<S> {
    let mut product = [S::zero(); 5];
    for (i, &x) in a.iter().enumerate() {
        for (j, &y) in b.iter().enumerate() {
            if let Some(place) = product.get_mut(i + j) {
                *place = *place + x * y;
            }
        }
    }
    product
}

/// The polynomial less another of its degree or a lower one.
pub(super) fn less<S: Scalar, const N: usize>(mut polynomial: Polynomial<S>, other: [S; N]) -> Polynomial<S> {
    polynomial.iter_mut().zip(other).for_each(|(place, c)| *place = *place - c);
    polynomial
}

/// The points `> 0` where the polynomial changes its sign: between the critical points, which are the roots of the
/// derivative.
pub(super) fn positive_roots<S: Scalar>(polynomial: &Polynomial<S>) -> Few<S> {
    // The derivatives, from the one of first degree to the polynomial itself.
    let degree = polynomial.iter().rposition(|c| *c != S::zero()).unwrap_or(0);
    let mut turns = [None; 4];
    for order in (0..degree).rev() {
        let mut derivative = *polynomial;
        for _ in 0..order {
            for k in 1..derivative.len() {
                derivative[k - 1] = derivative[k] * S::from_f64(k as f64);
            }
            derivative[4] = S::zero();
        }
        turns = between(&derivative, degree - order, turns);
    }
    turns
}

/// Sign changes between neighbours of zero, the critical points, and a bound of all roots.
fn between<S: Scalar>(polynomial: &Polynomial<S>, degree: usize, turns: Few<S>) -> Few<S> {
    let leading = polynomial[degree];
    let largest = polynomial[..degree].iter().fold(S::zero(), |most, c| most.max((*c / leading).abs()));
    let bound = S::two() + largest;
    let mut roots = [None; 4];
    let mut lower = S::zero();
    for (root, upper) in roots.iter_mut().zip(turns.into_iter().flatten().chain([bound])) {
        let (at_lower, at_upper) = (horner(polynomial, lower).0, horner(polynomial, upper).0);
        if (at_lower < S::zero() && at_upper > S::zero()) || (at_lower > S::zero() && at_upper < S::zero()) {
            let sign = if at_upper > S::zero() { S::one() } else { -S::one() };
            let signed = |at: S| {
                let (value, slope) = horner(polynomial, at);
                (sign * value, sign * slope)
            };
            *root = increasing_root(signed, lower, upper, (lower + upper) / S::two());
        }
        lower = upper;
    }
    roots
}

/// The first column of Routh's table of a polynomial in ascending powers; what stands behind its degree means nothing.
pub(super) fn routh<T: Real, const N: usize>(polynomial: &[T; N], degree: usize) -> [T; N] {
    let entry = |index: usize| degree.checked_sub(index).map_or(T::zero(), |power| polynomial[power]);
    let row = |first: usize| core::array::from_fn(|k| entry(first + 2 * k));
    let (mut upper, mut lower): ([T; N], [T; N]) = (row(0), row(1));
    let mut column = [upper[0]; N];
    for place in &mut column[1..=degree] {
        *place = lower[0];
        let (ratio, past) = (upper[0] / lower[0], N - 1);
        let next = |k: usize| if k < past { upper[k + 1] - ratio * lower[k + 1] } else { T::zero() };
        (upper, lower) = (lower, core::array::from_fn(next));
    }
    column
}
