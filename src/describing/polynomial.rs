//! Describing function of a polynomial.

use super::closed_form::{ClosedForm, finite};
use super::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Polynomial, Sinusoid};
use crate::numeric::Real;

impl<T: Real, const N: usize> ClosedForm for Polynomial<T, N> {
    /// From the coefficients `b_m` about the bias (Horner's scheme, N^2/2 operations) and the means of even powers of the
    /// sine, `1, 1/2, 3/8, ...`: `F_0 = sum b_2j X^2j <sin^2j>`, `P = 2 sum b_2j+1 X^2j <sin^2j+2>`, `Q = 0`.
    fn describing_function(&self, sweep: &Sinusoid<T>) -> Result<DescribingFunction<T>, DescribingError> {
        let mut about_bias = *self.coefficients();
        for lowest in 0..N {
            for power in (lowest + 1..N).rev() {
                about_bias[power - 1] = about_bias[power - 1] + sweep.bias() * about_bias[power];
            }
        }
        let square = sweep.amplitude().square();
        let (mut f0, mut p) = (T::zero(), T::zero());
        // <sin^2j> X^2j; two more powers of the sine multiply the mean by (2j + 1)/(2j + 2).
        let (mut mean, mut even) = (T::one(), 0u32);
        for pair in about_bias.chunks(2) {
            f0 = f0 + pair[0] * mean;
            let next = mean * (T::from_f64(f64::from(even + 1)) / T::from_f64(f64::from(even + 2)));
            if let Some(&odd) = pair.get(1) {
                p = p + odd * T::two() * next;
            }
            mean = next * square;
            even += 2;
        }
        finite(DescribingFunction { f0, p, q: T::zero() }, sweep)
    }
}
