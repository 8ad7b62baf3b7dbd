//! Identities of rational functions, proved exactly: the code is evaluated over formulas, and the difference of both sides is the zero
//! polynomial.
//!
//! No enclosure, no tolerance, no degree to be guessed. Where the code decides (`abs`, `max`, a comparison), it is evaluated
//! once for each case, at a point that lies in it; the identity proved there holds wherever the decisions are the same.

mod rational;
mod ring;

use super::outcome::NotProved;
use crate::numeric::Interval;
use rational::recorded;
pub use rational::{Decision, Rational};

/// An identity that holds, and the cases that it was proved in.
#[derive(Clone, Debug)]
pub struct Cases {
    /// The decisions of each case; none without decisions. Two points of the same case count once.
    pub decisions: Vec<Vec<Decision>>,
}

/// Proves that all functions of `statement` vanish in the cases in which the points lie.
///
/// ```
/// use selfosc::numeric::Real;
/// use selfosc::proof::polynomial::{Rational, prove_identity};
/// let squares = |[a, b]: [Rational; 2], factor: f64| {
///     Some([(a.square() - b.square()) / (a - b) - Rational::from_f64(factor) * (a + b)])
/// };
/// assert!(prove_identity([[1.0, 2.0]], |at| squares(at, 1.0)).is_ok());
/// assert!(prove_identity([[1.0, 2.0]], |at| squares(at, 1.000_000_1)).is_err());
/// // The root of a square is found on either side of zero: two cases.
/// let root = |[a]: [Rational; 1]| Some([a.square().sqrt() - a.abs()]);
/// assert_eq!(prove_identity([[1.0], [-2.0], [3.0]], root)?.decisions.len(), 2);
/// # Ok::<(), selfosc::proof::NotProved<1>>(())
/// ```
///
/// # Errors
/// [`NotProved::Undecided`] with the point at which `statement` refuses, a function does not vanish or a coefficient leaves
/// the range of whole numbers of 128 bits.
pub fn prove_identity<const N: usize, const M: usize>(
    points: impl IntoIterator<Item = [f64; N]>,
    statement: impl Fn([Rational; N]) -> Option<[Rational; M]>,
) -> Result<Cases, NotProved<N>> {
    let mut found = Cases { decisions: Vec::new() };
    for point in points {
        let (functions, decisions) = recorded(point, &statement);
        if !functions.is_some_and(|functions| functions.into_iter().all(Rational::is_zero)) {
            return Err(NotProved::Undecided { at: point.map(Interval::point), boxes: found.decisions.len() + 1 });
        }
        let same = |known: &Vec<Decision>| {
            known.len() == decisions.len() && known.iter().all(|decision| decisions.contains(decision))
        };
        if !found.decisions.iter().any(same) {
            found.decisions.push(decisions);
        }
    }
    Ok(found)
}

/// The result of code at a point, with the comparisons it made.
pub fn decided<R, const N: usize>(point: [f64; N], code: impl FnOnce([Rational; N]) -> R) -> (R, Vec<Decision>) {
    recorded(point, code)
}

#[cfg(test)]
mod tests {
    use super::{Rational, decided, prove_identity};
    use crate::numeric::Real;
    use crate::numeric::special::Special;

    fn number(value: f64) -> Rational {
        Rational::from_f64(value)
    }

    fn holds<const N: usize, const M: usize>(
        point: [f64; N],
        statement: impl Fn([Rational; N]) -> Option<[Rational; M]>,
    ) -> bool {
        prove_identity([point], statement).is_ok()
    }

    #[test]
    fn a_wrong_coefficient_or_degree_is_not_proved() {
        let power = |x: Rational, degree: usize| (0..degree).fold(number(1.0), |product, _| product * x);
        let binomial = |[a, b]: [Rational; 2], middle: f64| {
            let four = power(a, 4) + number(4.0) * power(a, 3) * b + number(middle) * power(a, 2) * power(b, 2);
            Some([power(a + b, 4) - four - number(4.0) * a * power(b, 3) - power(b, 4)])
        };
        assert!(holds([0.3, 0.7], |at| binomial(at, 6.0)));
        assert!(!holds([0.3, 0.7], |at| binomial(at, 6.0 + 1.0 / 1024.0)));
        assert!(!holds([0.3, 0.7], |at| binomial(at, 6.000_000_000_1)));
        // Zero at 0, 1, ..., 7, and not zero.
        let product = |[x]: [Rational; 1]| Some([(0..8).fold(number(1.0), |p, k| p * (x - number(f64::from(k))))]);
        (0..8).for_each(|k| assert!(!holds([f64::from(k)], product)));
        assert!(!holds([1.0], |[x]| Some([power(x, 5) - power(x, 4)])));
    }

    #[test]
    fn constants_are_what_they_are() {
        // Short fractions are numbers; 0.1 is not a tenth, but twice it is twice it.
        assert!(holds([1.0], |[x]| Some([number(0.5) * x + number(0.25) * x - number(0.75) * x])));
        assert!(!holds([1.0], |[x]| Some([number(0.1) * number(10.0) * x - x])));
        assert!(holds([1.0], |[x]| Some([number(0.1) * x + number(0.1) * x - number(2.0) * (number(0.1) * x)])));
        assert!(!holds([1.0], |[x]| Some([Rational::pi() * x - number(core::f64::consts::PI) * x])));
        assert!(holds([1.0], |[x]| Some([Rational::pi() * Rational::inverse_pi() * x - x])));
    }

    #[test]
    fn roots_are_those_of_squares_only() {
        let squared = |[a, b]: [Rational; 2]| (a - number(2.0) * b + number(1.0)).square();
        // On either side of zero the root is the other sign's.
        assert!(holds([1.0, 3.0], |at| Some([squared(at).sqrt() + at[0] - number(2.0) * at[1] + number(1.0)])));
        assert!(!holds([1.0, 0.0], |at| Some([squared(at).sqrt() + at[0] - number(2.0) * at[1] + number(1.0)])));
        assert!(holds([3.0, 1.0], |[a, b]| Some([(a.square() / b.square()).sqrt() - a / b])));
        // Nearly a square, and one at the point: a root of its own, which cancels with itself only.
        let nearly = |a: Rational| a.square() + number(1.0 / 1024.0);
        assert!(!holds([3.0], |[a]| Some([nearly(a).sqrt() - a])));
        assert!(holds([3.0], |[a]| Some([nearly(a).sqrt() - nearly(a + number(0.0)).sqrt()])));
        assert!(!holds([2.0], |[a]| Some([(a + number(2.0)).sqrt() - number(2.0)])));
        assert!(!holds([1.0], |[a]| Some([a.sin().square() + a.cos().square() - number(1.0)])));
    }

    #[test]
    fn nothing_is_proved_where_arithmetic_ends() {
        let huge = |[a]: [Rational; 1]| {
            let square = |x: Rational| x * x;
            let large = square(square(square(square(number(1000.0) * a + number(1.0)))));
            Some([large - large])
        };
        assert!(!holds([1.0], huge));
        assert!(!holds([1.0], |[a]| Some([number(f64::NAN) * a * number(0.0)])));
        assert!(!holds([0.0], |[a]| Some([a / (a - a) - a / (a - a)])));
        assert!(!holds([1.0], |[_]| None::<[Rational; 1]>));
        // So does the remainder of a root's square: below the range each by itself.
        let beyond = |[a]: [Rational; 1]| {
            let large = number(f64::from(1 << 30));
            let root = (large * large * a + number(1.0)).sqrt();
            Some([large * large * large * root * root + a])
        };
        assert!(!holds([1.0], beyond));
        // A comparison that is too close at the point decides nothing.
        assert!(!holds([0.0], |[a]| Some([a.abs() - a])) && !holds([0.0], |[a]| Some([a.abs() + a])));
        assert!(!holds([1e-20], |[a]| Some([a.abs() - a])));
    }

    /// Functions known by value and slope at a point are no formulas: their tangent must not pass for them.
    #[test]
    fn tangents_are_not_functions() {
        assert!(!holds([1.0], |[x]: [Rational; 1]| {
            let [j0, _] = x.bessel_j();
            let [again, _] = x.bessel_j();
            Some([j0 - again])
        }));
    }

    #[test]
    fn signs_of_arguments_are_told_apart() {
        assert!(holds([0.3], |[x]| Some([x.asin() + (-x).asin(), x.cosh() - (-x).cosh()])));
        assert!(!holds([0.3], |[x]| Some([x.exp() + (-x).exp()])));
        assert!(!holds([0.3], |[x]| Some([x.cos() + (-x).cos()])));
        // A root of a square times what another root is of, on either side of zero.
        let roots = |[x, y]: [Rational; 2], sign: f64| Some([(x.square() * y).sqrt() - number(sign) * x * y.sqrt()]);
        assert!(holds([1.0, 2.0], |at| roots(at, 1.0)) && holds([-1.0, 2.0], |at| roots(at, -1.0)));
        assert!(!holds([1.0, 2.0], |at| roots(at, -1.0)) && !holds([-1.0, 2.0], |at| roots(at, 1.0)));
        assert!(!holds([1.0, 2.0], |[x, y]| Some([(x * y).sqrt() - x * y.sqrt()])));
    }

    #[test]
    fn floors_are_whole_numbers_where_they_are_known() {
        assert!(
            holds([2.5], |[x]| Some([x.floor() - number(2.0)])) && holds([-0.5], |[x]| Some([x.floor() + number(1.0)]))
        );
        assert!(!holds([2.0], |[x]| Some([x.floor() - number(2.0)])));
        assert!(holds([2.0], |[_]| Some([number(2.0).floor() - number(2.0)])));
    }

    #[test]
    fn decisions_are_told() {
        let (larger, decisions) = decided([1.0, 2.0], |[a, b]| a.max(b));
        assert_eq!(decisions.len(), 1);
        let (again, _) = decided([1.0, 2.0], |[_, b]| b);
        assert!((larger - again).is_zero());
    }
}
