//! The linear plant of every loop: a strictly proper transfer function with dead time.

use serde::{Deserialize, Serialize};

/// `num(s)/den(s) exp(-delay s)`, coefficients in descending powers of s, time in seconds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plant {
    /// Numerator.
    pub num: Vec<f64>,
    /// Denominator.
    pub den: Vec<f64>,
    /// Dead time in s.
    #[serde(default)]
    pub delay: f64,
}

/// A plant that the judge does not simulate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlantError {
    /// Leading coefficient of the denominator, or a value.
    #[error("plant: {0} is not a finite number with a leading denominator coefficient other than zero")]
    Coefficient(f64),
    /// Orders of numerator and denominator.
    #[error(
        "plant: numerator of degree {numerator} over denominator of degree {denominator}: must be strictly proper, of order 1 to {MAXIMAL_ORDER}"
    )]
    Order {
        /// Degree of the numerator.
        numerator: usize,
        /// Degree of the denominator.
        denominator: usize,
    },
    /// Dead time in s.
    #[error("plant: dead time {0} s must be finite and not negative")]
    Delay(f64),
}

/// Highest order that is simulated.
pub const MAXIMAL_ORDER: usize = 6;

impl Plant {
    /// The plant of these coefficients.
    #[must_use]
    pub fn new(num: &[f64], den: &[f64], delay: f64) -> Self {
        Self { num: num.to_vec(), den: den.to_vec(), delay }
    }

    /// Order of the denominator.
    #[must_use]
    pub fn order(&self) -> usize {
        self.den.len().saturating_sub(1)
    }

    /// Degree of the denominator less that of the numerator.
    #[must_use]
    pub fn relative_degree(&self) -> usize {
        let leading_zeros = self.num.iter().take_while(|&&b| b == 0.0).count();
        self.order() + 1 + leading_zeros - self.num.len()
    }

    /// Checks orders and finiteness.
    ///
    /// # Errors
    /// An improper plant, an order beyond [`MAXIMAL_ORDER`], a number that is not finite, a negative dead time.
    pub fn check(&self) -> Result<(), PlantError> {
        let finite = self.num.iter().chain(&self.den).find(|value| !value.is_finite());
        if let Some(&value) = finite.or(self.den.first().filter(|&&leading| leading == 0.0)) {
            return Err(PlantError::Coefficient(value));
        }
        let (numerator, denominator) = (self.num.len().saturating_sub(1), self.order());
        if self.num.is_empty() || !(1..=MAXIMAL_ORDER).contains(&denominator) || numerator >= denominator {
            return Err(PlantError::Order { numerator, denominator });
        }
        if self.delay.is_finite() && self.delay >= 0.0 { Ok(()) } else { Err(PlantError::Delay(self.delay)) }
    }
}

/// Product of polynomials in descending powers.
#[must_use]
pub fn multiply(left: &[f64], right: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; left.len() + right.len() - 1];
    for (i, a) in left.iter().enumerate() {
        for (j, b) in right.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}
