//! Rational transfer functions with dead time.

use nalgebra::{Complex, DMatrix};

use super::{PlantError, all_finite, checked_delay, eigenvalues};

/// Highest order of Padé approximant: beyond it the coefficients span more than 15 decades.
const PADE_LIMIT: usize = 10;

/// `numerator(s)/denominator(s) exp(-s delay)`, coefficients in descending powers of s, time in seconds.
///
/// ```
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[8.0], &[1.0, 2.0, 2.0, 1.0])?;
/// // The phase crossover of 8/(s^3 + 2s^2 + 2s + 1):
/// let response = plant.response(2f64.sqrt())?;
/// assert!((response.re + 8.0 / 3.0).abs() < 1e-14 && response.im.abs() < 1e-14);
/// assert!(!plant.is_integrating());
/// # Ok::<(), selfosc::plant::PlantError>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "TransferFunctionParts")]
pub struct TransferFunction {
    numerator: Vec<f64>,
    denominator: Vec<f64>,
    delay_s: f64,
}

/// A plant as it is written, not yet checked.
#[derive(serde::Deserialize)]
struct TransferFunctionParts {
    numerator: Vec<f64>,
    denominator: Vec<f64>,
    delay_s: f64,
}

impl TryFrom<TransferFunctionParts> for TransferFunction {
    type Error = PlantError;

    fn try_from(parts: TransferFunctionParts) -> Result<Self, PlantError> {
        Self::new(&parts.numerator, &parts.denominator)?.with_delay(parts.delay_s)
    }
}

impl TransferFunction {
    /// A plant without delay.
    ///
    /// # Errors
    /// [`PlantError`] where a polynomial is empty, begins with zero or has an entry that is not finite, where the
    /// fraction is improper, and where both polynomials have the factor s.
    pub fn new(numerator: &[f64], denominator: &[f64]) -> Result<Self, PlantError> {
        for (polynomial, coefficients) in [("numerator", numerator), ("denominator", denominator)] {
            all_finite(polynomial, coefficients)?;
            match coefficients.first() {
                None => return Err(PlantError::NoCoefficients { polynomial }),
                Some(0.0) => return Err(PlantError::LeadingZero { polynomial }),
                Some(_) => {}
            }
        }
        if numerator.len() > denominator.len() {
            return Err(PlantError::Improper { numerator: numerator.len() - 1, denominator: denominator.len() - 1 });
        }
        if numerator.last() == Some(&0.0) && denominator.last() == Some(&0.0) {
            return Err(PlantError::CommonFactor);
        }
        Ok(Self { numerator: numerator.to_vec(), denominator: denominator.to_vec(), delay_s: 0.0 })
    }

    /// The same plant behind a dead time, which replaces the one it had.
    ///
    /// # Errors
    /// [`PlantError::OutOfDomain`] where the delay is negative or not finite.
    pub fn with_delay(self, delay_s: f64) -> Result<Self, PlantError> {
        Ok(Self { delay_s: checked_delay(delay_s)?, ..self })
    }

    /// The Padé approximant of `exp(-s delay)` with numerator and denominator of degree `order`: all-pass, its phase
    /// agrees to `order` well past `w delay = 1`.
    ///
    /// # Errors
    /// [`PlantError::PadeOrder`] outside 1 to 10, [`PlantError::OutOfDomain`] unless the delay is finite and not negative.
    pub fn pade(delay_s: f64, order: usize) -> Result<Self, PlantError> {
        if !(1..=PADE_LIMIT).contains(&order) {
            return Err(PlantError::PadeOrder { order, limit: PADE_LIMIT });
        }
        let delay_s = checked_delay(delay_s)?;
        // Coefficient of (s T)^k: (2n - k)! n! / ((2n)! k! (n - k)!), by its ratio to the one before.
        let mut ascending = vec![1.0];
        for k in 0..order {
            let last = ascending[k];
            let (left, all) = ((order - k) as f64, (2 * order - k) as f64);
            ascending.push(last * delay_s * left / (all * (k + 1) as f64));
        }
        while ascending.last() == Some(&0.0) {
            ascending.pop();
        }
        let denominator: Vec<f64> = ascending.iter().rev().copied().collect();
        let odd = |k: usize| (ascending.len() - 1 - k) % 2 == 1;
        let numerator: Vec<f64> = denominator.iter().enumerate().map(|(k, &c)| if odd(k) { -c } else { c }).collect();
        Self::new(&numerator, &denominator)
    }

    /// This plant followed by another: polynomials multiplied, delays added.
    ///
    /// # Errors
    /// [`PlantError::CommonFactor`] if a pole at s = 0 cancels a zero in the product.
    pub fn series(&self, other: &Self) -> Result<Self, PlantError> {
        let numerator = product(&self.numerator, &other.numerator);
        let denominator = product(&self.denominator, &other.denominator);
        Self::new(&numerator, &denominator)?.with_delay(self.delay_s + other.delay_s)
    }

    /// Coefficients of the numerator, descending powers.
    #[must_use]
    pub fn numerator(&self) -> &[f64] {
        &self.numerator
    }
    /// Coefficients of the denominator, descending powers.
    #[must_use]
    pub fn denominator(&self) -> &[f64] {
        &self.denominator
    }
    /// Dead time, seconds.
    #[must_use]
    pub fn delay_s(&self) -> f64 {
        self.delay_s
    }
    /// Whether there is a pole at s = 0: the astatic process of Theorem 2.
    #[must_use]
    pub fn is_integrating(&self) -> bool {
        self.denominator.last() == Some(&0.0)
    }
    /// The gain at s = 0; `None` for an integrating plant.
    #[must_use]
    pub fn static_gain(&self) -> Option<f64> {
        match (self.numerator.last(), self.denominator.last()) {
            (Some(&numerator), Some(&denominator)) if denominator != 0.0 => Some(numerator / denominator),
            _ => None,
        }
    }

    /// Frequency response `G(jw)`, delay included.
    ///
    /// # Errors
    /// [`PlantError::PoleAt`] where `jw` is a pole.
    pub fn response(&self, omega_rad_s: f64) -> Result<Complex<f64>, PlantError> {
        let s = Complex::new(0.0, omega_rad_s);
        let value = horner(&self.numerator, s) / horner(&self.denominator, s) * (-s * self.delay_s).exp();
        if value.is_finite() { Ok(value) } else { Err(PlantError::PoleAt { omega_rad_s }) }
    }

    /// Roots of the denominator, rad/s, the eigenvalues of its companion matrix; those at s = 0 are exact. Another root of
    /// multiplicity m comes out with an error of about the m-th root of the rounding error.
    ///
    /// # Errors
    /// [`PlantError::Eigenvalues`] where the iteration does not converge.
    pub fn poles(&self) -> Result<Vec<Complex<f64>>, PlantError> {
        roots(&self.denominator)
    }
    /// Roots of the numerator, as [`poles`](Self::poles).
    ///
    /// # Errors
    /// [`PlantError::Eigenvalues`] where the iteration does not converge.
    pub fn zeros(&self) -> Result<Vec<Complex<f64>>, PlantError> {
        roots(&self.numerator)
    }
}

/// A polynomial in descending powers at `s`.
pub(crate) fn horner(descending: &[f64], s: Complex<f64>) -> Complex<f64> {
    descending.iter().fold(Complex::new(0.0, 0.0), |sum, &coefficient| sum * s + coefficient)
}

/// Coefficients of the product of two polynomials that have some.
pub(crate) fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// The companion matrix with the coefficients in its first row.
pub(super) fn companion(descending: &[f64]) -> DMatrix<f64> {
    let order = descending.len() - 1;
    DMatrix::from_fn(order, order, |row, column| match row {
        0 => -descending[column + 1] / descending[0],
        _ => f64::from(u8::from(row == column + 1)),
    })
}

/// Roots at zero are exact: they are those of the trailing coefficients, and only the others are computed.
fn roots(descending: &[f64]) -> Result<Vec<Complex<f64>>, PlantError> {
    let trailing = descending.iter().rev().take_while(|coefficient| **coefficient == 0.0).count();
    let mut roots = eigenvalues(&companion(&descending[..descending.len() - trailing]))?;
    roots.extend(core::iter::repeat_n(Complex::new(0.0, 0.0), trailing));
    Ok(roots)
}
