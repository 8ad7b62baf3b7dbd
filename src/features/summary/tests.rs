//! What rounding does to a mean and a sum of squares.

use super::*;
use crate::numeric::rounded::testing::{Big, Formula, big, hold};

/// Mean and sum of squares so far, a value, and its number.
struct Step;

impl Formula<4, 2> for Step {
    fn of<T: Scalar>([mean, squares, value, count]: [T; 4]) -> [T; 2] {
        let mut moments = WelfordMoments { mean, squares };
        moments.push(value, count);
        [moments.mean, moments.squares]
    }

    fn exact([mean, squares, value, count]: [Big; 4]) -> [Big; 2] {
        let before = &count - big(1.0);
        let apart = &value - &mean;
        [(&before * mean + value) / &count, squares + &apart * &apart * before / count]
    }
}

/// As the documentation of `Summary::push` has it.
#[test]
fn rounding_of_a_step() {
    let domain = [(0.5, 2.0), (0.0, 1.0), (0.5, 2.0), (2.0, 256.0)];
    hold::<4, 2, Step>(domain, [8, 1, 8, 16], [[3.9e-16, 1.7e-15], [2.1e-7, 9e-7]]);
}
