//! Characteristics that are not in the catalogue: a function of the user's, and the sum of two.

use super::{Branch, Characteristic, NonlinearityError, Sinusoid};
use crate::numeric::Real;

/// A function of the input and of the branch, with the input values at which it is not smooth.
///
/// Nothing is known of it but its values: its describing function comes from quadrature alone.
///
/// ```
/// use selfosc::describing::by_quadrature;
/// use selfosc::nonlinearity::{Custom, Sinusoid};
/// let square = Custom::new(|x: f64, _| x * x, &[]);
/// let df = by_quadrature(&square, &Sinusoid::new(0.0, 2.0)?)?;
/// assert!((df.f0 - 2.0).abs() < 1e-12);
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Custom<'a, T, F> {
    function: F,
    kinks: &'a [T],
}

impl<'a, T: Real, F: Fn(T, Branch) -> T> Custom<'a, T, F> {
    /// A kink left out costs accuracy or makes the quadrature give up; one too many costs a little time.
    pub fn new(function: F, kinks: &'a [T]) -> Self {
        Self { function, kinks }
    }
}

impl<T: Real, F: Fn(T, Branch) -> T> Characteristic for Custom<'_, T, F> {
    type Number = T;

    fn output(&self, x: T, branch: Branch, _: &Sinusoid<T>) -> T {
        (self.function)(x, branch)
    }
    fn kinks(&self, _: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        self.kinks.iter().copied().for_each(report);
    }
}

/// Two characteristics side by side, their outputs added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sum<A, B>(
    /// One summand.
    pub A,
    /// The other.
    pub B,
);

impl<T: Real, A: Characteristic<Number = T>, B: Characteristic<Number = T>> Characteristic for Sum<A, B> {
    type Number = T;

    fn output(&self, x: T, branch: Branch, sweep: &Sinusoid<T>) -> T {
        self.0.output(x, branch, sweep) + self.1.output(x, branch, sweep)
    }
    fn kinks(&self, sweep: &Sinusoid<T>, report: &mut dyn FnMut(T)) {
        self.0.kinks(sweep, report);
        self.1.kinks(sweep, report);
    }
    fn has_memory(&self) -> bool {
        self.0.has_memory() || self.1.has_memory()
    }
    fn admits(&self, sweep: &Sinusoid<T>) -> Result<(), NonlinearityError> {
        self.0.admits(sweep)?;
        self.1.admits(sweep)
    }
}
