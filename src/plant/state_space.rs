//! Linear plants in state space, and their exact flow under a constant input.

use nalgebra::linalg::{Schur, balancing::balance_parlett_reinsch};
use nalgebra::{Complex, DMatrix, DVector, RowDVector};

use super::transfer::companion;
use super::{PlantError, TransferFunction, all_finite, checked_delay};
use crate::numeric::{Limit, domain};

/// `x' = a x + b u(t - delay)`, `y = c x`: one input, one output, no feedthrough, time in seconds.
///
/// ```
/// use selfosc::plant::{StateSpace, TransferFunction};
/// let plant = StateSpace::realise(&TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0])?)?;
/// assert!(plant.is_integrating());
/// assert_eq!(plant.order(), 2);
/// # Ok::<(), selfosc::plant::PlantError>(())
/// ```
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "StateSpaceParts")]
pub struct StateSpace {
    a: DMatrix<f64>,
    b: DVector<f64>,
    c: RowDVector<f64>,
    delay_s: f64,
}

/// A plant as it is written, not yet checked.
#[derive(serde::Deserialize)]
struct StateSpaceParts {
    a: DMatrix<f64>,
    b: DVector<f64>,
    c: RowDVector<f64>,
    delay_s: f64,
}

impl TryFrom<StateSpaceParts> for StateSpace {
    type Error = PlantError;

    fn try_from(StateSpaceParts { a, b, c, delay_s }: StateSpaceParts) -> Result<Self, PlantError> {
        Self::new(a, b, c)?.with_delay(delay_s)
    }
}

impl StateSpace {
    /// A plant from its matrices, without delay.
    ///
    /// # Errors
    /// [`PlantError::Shape`] where they do not fit together, [`PlantError::NotFinite`].
    pub fn new(a: DMatrix<f64>, b: DVector<f64>, c: RowDVector<f64>) -> Result<Self, PlantError> {
        let (rows, columns, inputs, outputs) = (a.nrows(), a.ncols(), b.len(), c.len());
        if rows == 0 || [columns, inputs, outputs] != [rows; 3] {
            return Err(PlantError::Shape { rows, columns, inputs, outputs });
        }
        all_finite("matrix a", a.iter())?;
        all_finite("vector b", b.iter())?;
        all_finite("vector c", c.iter())?;
        Ok(Self { a, b, c, delay_s: 0.0 })
    }

    /// The controllable realisation of a transfer function, balanced by powers of two; keeps the delay.
    ///
    /// # Errors
    /// [`PlantError::NotStrictlyProper`] where numerator and denominator have the same degree; [`PlantError::OutOfDomain`] for a
    /// coefficient of the denominator that is above 1e75 times the leading one.
    pub fn realise(plant: &TransferFunction) -> Result<Self, PlantError> {
        let (numerator, denominator) = (plant.numerator(), plant.denominator());
        let order = denominator.len() - 1;
        if numerator.len() > order {
            return Err(PlantError::NotStrictlyProper { degree: order });
        }
        let (a, scale) = balanced(companion(denominator))?;
        let b = DVector::from_fn(order, |row, _| if row == 0 { 1.0 / scale[0] } else { 0.0 });
        let skipped = order - numerator.len();
        let c = RowDVector::from_fn(order, |_, column| {
            if column < skipped { 0.0 } else { numerator[column - skipped] / denominator[0] * scale[column] }
        });
        Self::new(a, b, c)?.with_delay(plant.delay_s())
    }

    /// The same plant behind a dead time, which replaces the one it had.
    ///
    /// # Errors
    /// [`PlantError::OutOfDomain`] where the delay is negative or not finite.
    pub fn with_delay(self, delay_s: f64) -> Result<Self, PlantError> {
        Ok(Self { delay_s: checked_delay(delay_s)?, ..self })
    }

    /// System matrix, 1/s.
    #[must_use]
    pub fn a(&self) -> &DMatrix<f64> {
        &self.a
    }
    /// Input vector.
    #[must_use]
    pub fn b(&self) -> &DVector<f64> {
        &self.b
    }
    /// Output vector.
    #[must_use]
    pub fn c(&self) -> &RowDVector<f64> {
        &self.c
    }
    /// Dead time, seconds.
    #[must_use]
    pub fn delay_s(&self) -> f64 {
        self.delay_s
    }
    /// Number of states.
    #[must_use]
    pub fn order(&self) -> usize {
        self.b.len()
    }

    /// Eigenvalues of the system matrix, rad/s.
    ///
    /// # Errors
    /// [`PlantError::Eigenvalues`] where the iteration does not converge.
    pub fn poles(&self) -> Result<Vec<Complex<f64>>, PlantError> {
        eigenvalues(&self.a)
    }
    /// Whether the system matrix is singular to working precision: a pole at zero, the astatic process of Theorem 2.
    #[must_use]
    pub fn is_integrating(&self) -> bool {
        let values = self.a.singular_values();
        values.min() <= values.max() * self.order() as f64 * f64::EPSILON
    }
    /// Frequency response `c (jw - a)^-1 b exp(-jw delay)`.
    ///
    /// # Errors
    /// [`PlantError::PoleAt`] where `jw` is a pole.
    pub fn response(&self, omega_rad_s: f64) -> Result<Complex<f64>, PlantError> {
        let s = Complex::new(0.0, omega_rad_s);
        let order = self.order();
        let matrix = DMatrix::from_diagonal_element(order, order, s) - self.a.map(Complex::from);
        let state = matrix.lu().solve(&self.b.map(Complex::from)).ok_or(PlantError::PoleAt { omega_rad_s })?;
        let value = self.c.map(Complex::from).dot(&state.transpose()) * (-s * self.delay_s).exp();
        if value.is_finite() { Ok(value) } else { Err(PlantError::PoleAt { omega_rad_s }) }
    }

    /// The output at a state.
    #[must_use]
    pub fn output(&self, state: &DVector<f64>) -> f64 {
        self.c.tr_dot(state)
    }
    /// Rate of the state under the input `u` that has come through the delay.
    #[must_use]
    pub fn rate(&self, state: &DVector<f64>, u: f64) -> DVector<f64> {
        &self.a * state + &self.b * u
    }
    /// The map over `time_s` under a constant input, from a single exponential of the matrix augmented by the input, so that a
    /// singular system matrix needs no special case. Entries overflow to infinity where the plant is unstable enough.
    #[must_use]
    pub fn flow(&self, time_s: f64) -> Flow {
        let order = self.order();
        let mut augmented = DMatrix::zeros(order + 1, order + 1);
        augmented.view_mut((0, 0), (order, order)).copy_from(&(&self.a * time_s));
        augmented.view_mut((0, order), (order, 1)).copy_from(&(&self.b * time_s));
        let exponential = augmented.exp();
        Flow {
            state: exponential.view((0, 0), (order, order)).into_owned(),
            input: exponential.view((0, order), (order, 1)).column(0).into_owned(),
        }
    }
}

/// The exact step `x -> state x + input u` of a linear plant under a constant input u.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// `exp(a t)`.
    pub state: DMatrix<f64>,
    /// The integral of `exp(a s) b` from 0 to t.
    pub input: DVector<f64>,
}

impl Flow {
    /// The state at the end of the step.
    #[must_use]
    pub fn apply(&self, state: &DVector<f64>, u: f64) -> DVector<f64> {
        &self.state * state + &self.input * u
    }
}

/// Above this the squares of balancing overflow, and its iteration need not end.
const LARGEST_ENTRY: f64 = 1e75;
/// Steps of the QR algorithm allowed for each eigenvalue; two or three are usual.
const SWEEPS_PER_ORDER: usize = 100;

/// The matrix balanced by powers of two, and these.
fn balanced(mut matrix: DMatrix<f64>) -> Result<(DMatrix<f64>, DVector<f64>), PlantError> {
    // The largest, or what is no number.
    let largest = matrix.iter().map(|entry| entry.abs()).max_by(f64::total_cmp).unwrap_or(0.0);
    let limit = Limit::AtMost(LARGEST_ENTRY);
    domain::require("largest coefficient over the leading one", largest, "", limit, "scale the plant's time unit")?;
    let scale = balance_parlett_reinsch(&mut matrix);
    Ok((matrix, scale))
}

/// Eigenvalues of a square matrix: balanced, then by the QR algorithm.
///
/// # Errors
/// [`PlantError::Eigenvalues`] where the iteration does not converge, and [`PlantError::OutOfDomain`] for an entry above 1e75.
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, PlantError> {
    let order = matrix.nrows();
    if order == 0 {
        return Ok(Vec::new());
    }
    // Coefficients of a companion matrix span decades: without this its small eigenvalues drown.
    let (balanced, _) = balanced(matrix.clone())?;
    let spectrum = |matrix: DMatrix<f64>, shift: f64| {
        let schur = Schur::try_new(matrix, f64::EPSILON, SWEEPS_PER_ORDER * order)?;
        Some(schur.complex_eigenvalues().iter().map(|value| value - shift).collect())
    };
    // The iteration compares the entries below the diagonal with the diagonal, which a chain of integrators does not have: a
    // shift by the matrix' size gives it one.
    let size = balanced.norm();
    let shifted = || spectrum(&balanced + DMatrix::identity(order, order) * size, size);
    spectrum(balanced.clone(), 0.0).or_else(shifted).ok_or(PlantError::Eigenvalues { order })
}
