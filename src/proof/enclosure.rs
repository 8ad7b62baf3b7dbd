//! Existence and uniqueness of roots by enclosure: interval Newton in one dimension, Krawczyk in several.

use core::array;

use super::Gradient;
use crate::numeric::Interval;

/// Verdict on the roots in a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Roots<T> {
    /// The box has exactly one root, and `enclosure` contains it.
    Unique {
        /// Contains the root.
        enclosure: T,
        /// Steps taken.
        steps: usize,
    },
    /// The box has no root.
    None {
        /// Steps taken.
        steps: usize,
    },
    /// Neither was proved. Roots, if there are any, lie in `remaining`.
    Undecided {
        /// The part of the box that was not ruled out.
        remaining: T,
        /// Steps taken: the budget, or fewer when a step gained nothing.
        steps: usize,
    },
}

/// A step that keeps more than this share of the width makes no progress.
const GAIN: f64 = 0.9;

/// Interval Newton in one dimension: `f` gives value and derivative over an interval, and is asked at most `2 budget` times.
///
/// It neither bisects nor searches: on a wide interval whose derivative straddles zero it is undecided.
///
/// ```
/// use selfosc::proof::enclosure::{Roots, newton};
/// use selfosc::numeric::{Interval, Real};
/// use selfosc::proof::Gradient;
/// let start = Interval::new(1.0, 2.0).unwrap_or(Interval::ENTIRE);
/// let found = newton(|x: Gradient<1>| x.square() - Gradient::two(), start, 20);
/// let Roots::Unique { enclosure, .. } = found else { panic!("{found:?}") };
/// assert!(enclosure.contains(2_f64.sqrt()) && enclosure.width() < 1e-15);
/// ```
#[must_use]
pub fn newton(f: impl Fn(Gradient<1>) -> Gradient<1>, start: Interval, budget: usize) -> Roots<Interval> {
    contract([start], budget, |[x]| {
        let [variable] = Gradient::variables([x]);
        let over = f(variable);
        if !over.value().contains_zero() {
            return Image::Empty;
        }
        let middle = Interval::point(x.midpoint());
        // Entire when the derivative may vanish.
        let image = middle - f(Gradient::constant(middle)).value() / over.slopes()[0];
        // A nonzero derivative makes the closed inclusion enough.
        Image::Box { image: [image], certain: image.is_bounded() && image.is_subset_of(x) }
    })
    .map(|[x]| x)
}

/// Krawczyk's operator for `N` equations in `N` unknowns: `f` gives values and gradients over a box, and is asked at
/// most `2 budget` times.
///
/// Start from a small box around a floating-point root (see [`around`]): a crude box is undecided.
///
/// ```
/// use selfosc::proof::enclosure::{Roots, around, krawczyk};
/// use selfosc::numeric::Real;
/// use selfosc::proof::Gradient;
/// let circle_and_line = |[x, y]: [Gradient<2>; 2]| [x.square() + y.square() - Gradient::one(), x - y];
/// let found = krawczyk(circle_and_line, around([0.7071, 0.7071], 1e-3), 20);
/// assert!(matches!(found, Roots::Unique { .. }));
/// ```
#[must_use]
pub fn krawczyk<const N: usize>(
    f: impl Fn([Gradient<N>; N]) -> [Gradient<N>; N],
    start: [Interval; N],
    budget: usize,
) -> Roots<[Interval; N]> {
    contract(start, budget, |x| {
        let over = f(Gradient::variables(x));
        if over.iter().any(|component| !component.value().contains_zero()) {
            return Image::Empty;
        }
        let middle = x.map(|side| Interval::point(side.midpoint()));
        let at_middle = f(Gradient::variables(middle));
        // Any matrix will do; the inverse of the Jacobian at the midpoint makes the operator contract.
        let Some(inverse) = inverse(array::from_fn(|i| array::from_fn(|j| at_middle[i].slopes()[j].midpoint()))) else {
            return Image::Box { image: x, certain: false };
        };
        let inverse = inverse.map(|row| row.map(Interval::point));
        let image = array::from_fn(|i| {
            let correction = dot(&inverse[i], &at_middle.map(|component| component.value()));
            let spread: [Interval; N] = array::from_fn(|j| {
                let identity = if i == j { Interval::ONE } else { Interval::ZERO };
                (identity - dot(&inverse[i], &over.map(|component| component.slopes()[j]))) * (x[j] - middle[j])
            });
            middle[i] - correction + spread.into_iter().fold(Interval::ZERO, |sum, term| sum + term)
        });
        Image::Box { image, certain: (0..N).all(|i| image[i].is_interior_to(x[i])) }
    })
}

/// The box of half-width `radius` around a point.
#[must_use]
pub fn around<const N: usize>(point: [f64; N], radius: f64) -> [Interval; N] {
    point.map(|coordinate| Interval::point(coordinate) + Interval::symmetric(radius))
}

/// The image of a box under an operator that keeps every root.
enum Image<const N: usize> {
    /// No root.
    Empty,
    /// All roots lie in `image`; there is exactly one in the box if `certain`.
    Box { image: [Interval; N], certain: bool },
}

/// Intersects a box with its image until that gains nothing.
fn contract<const N: usize>(
    start: [Interval; N],
    budget: usize,
    operator: impl Fn([Interval; N]) -> Image<N>,
) -> Roots<[Interval; N]> {
    let (mut remaining, mut unique) = (start, false);
    for steps in 1..=budget {
        let Image::Box { image, certain } = operator(remaining) else { return Roots::None { steps } };
        unique |= certain;
        let mut gained = false;
        for (side, image) in remaining.iter_mut().zip(image) {
            let Some(common) = side.intersection(image) else { return Roots::None { steps } };
            gained |= common.width() < GAIN * side.width();
            *side = common;
        }
        if !gained {
            return Roots::of(remaining, unique, steps);
        }
    }
    Roots::of(remaining, unique, budget)
}

impl<T> Roots<T> {
    fn of(remaining: T, unique: bool, steps: usize) -> Self {
        if unique { Self::Unique { enclosure: remaining, steps } } else { Self::Undecided { remaining, steps } }
    }

    fn map<U>(self, change: impl Fn(T) -> U) -> Roots<U> {
        match self {
            Self::Unique { enclosure, steps } => Roots::Unique { enclosure: change(enclosure), steps },
            Self::None { steps } => Roots::None { steps },
            Self::Undecided { remaining, steps } => Roots::Undecided { remaining: change(remaining), steps },
        }
    }
}

fn dot<const N: usize>(a: &[Interval; N], b: &[Interval; N]) -> Interval {
    a.iter().zip(b).fold(Interval::ZERO, |sum, (&a, &b)| sum + a * b)
}

/// Gauss-Jordan elimination in floating point, with row exchanges; `None` if a pivot vanishes.
fn inverse<const N: usize>(mut matrix: [[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut inverse: [[f64; N]; N] = array::from_fn(|i| array::from_fn(|j| f64::from(u8::from(i == j))));
    for column in 0..N {
        let pivot = (column..N).max_by(|&a, &b| matrix[a][column].abs().total_cmp(&matrix[b][column].abs()))?;
        matrix.swap(column, pivot);
        inverse.swap(column, pivot);
        let scale = 1.0 / matrix[column][column];
        if !scale.is_finite() {
            return None;
        }
        matrix[column] = matrix[column].map(|entry| entry * scale);
        inverse[column] = inverse[column].map(|entry| entry * scale);
        for row in (0..N).filter(|&row| row != column) {
            let factor = matrix[row][column];
            matrix[row] = array::from_fn(|j| matrix[row][j] - factor * matrix[column][j]);
            inverse[row] = array::from_fn(|j| inverse[row][j] - factor * inverse[column][j]);
        }
    }
    Some(inverse)
}
