use super::{Branch, Catalogued, Characteristic, NonlinearityError, ParameterDomain, ParameterSpec, Sinusoid};
use crate::numeric::Real;

/// Names of the coefficients, in the order of the powers they go with.
const NAMES: [&str; 10] = ["c0", "c1", "c2", "c3", "c4", "c5", "c6", "c7", "c8", "c9"];

#[doc = super::parameter::document!("polynomial")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial<T, const N: usize = 10> {
    coefficients: [T; N],
}

impl<T: Real, const N: usize> Polynomial<T, N> {
    /// `coefficients[0] + coefficients[1] x + ...`; each in output units over input units to its power.
    ///
    /// # Errors
    /// [`NonlinearityError::Parameter`] where a coefficient is not finite.
    ///
    /// ```
    /// use selfosc::describing::ClosedForm;
    /// use selfosc::nonlinearity::{Polynomial, Sinusoid};
    /// let spring = Polynomial::new([0.0f64, 1.0, 0.0, 0.2])?;
    /// let df = spring.describing_function(&Sinusoid::new(0.0, 2.0)?)?;
    /// assert!((df.p - (1.0 + 0.75 * 0.2 * 4.0)).abs() < 1e-15);
    /// # Ok::<(), selfosc::describing::DescribingError>(())
    /// ```
    pub fn new(coefficients: [T; N]) -> Result<Self, NonlinearityError> {
        for (power, &coefficient) in coefficients.iter().enumerate() {
            let parameter = Self::parameter(NAMES.get(power).copied().unwrap_or("coefficient of a high power"));
            parameter.check("polynomial", coefficient)?;
        }
        Ok(Self { coefficients })
    }

    /// The coefficients, lowest power first.
    pub fn coefficients(&self) -> &[T; N] {
        &self.coefficients
    }
}

impl<T, const N: usize> Polynomial<T, N> {
    const fn parameter(name: &'static str) -> ParameterSpec {
        let meaning = "Coefficient of that power of x, in output units over input units to the power.";
        ParameterSpec { name, meaning, domain: ParameterDomain::Finite, default: Some(0.0) }
    }
}

impl<T: Real> Catalogued<T> for Polynomial<T> {
    const NAME: &'static str = "polynomial";
    const PARAMETERS: &'static [ParameterSpec] = &{
        let mut parameters = [Self::parameter(""); 10];
        let mut power = 0;
        while power < NAMES.len() {
            parameters[power] = Self::parameter(NAMES[power]);
            power += 1;
        }
        parameters
    };
    const ORDERED: &'static [(&'static str, &'static str)] = &[];
    const SPEC: &'static str = super::parameter::specification!("polynomial");

    fn from_values(values: &[T]) -> Result<Self, NonlinearityError> {
        Self::new(core::array::from_fn(|power| values.get(power).copied().unwrap_or_else(|| T::from_f64(f64::NAN))))
    }
}

impl<T: Real, const N: usize> Characteristic for Polynomial<T, N> {
    type Number = T;

    fn has_memory(&self) -> bool {
        false
    }

    fn output(&self, x: T, _: Branch, _: &Sinusoid<T>) -> T {
        self.coefficients.iter().rev().fold(T::zero(), |sum, &coefficient| sum * x + coefficient)
    }
    fn kinks(&self, _: &Sinusoid<T>, _: &mut dyn FnMut(T)) {}
}
