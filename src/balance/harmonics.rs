//! Harmonic balance with more than the first harmonic (Galerkin's method), by damped Newton iteration.

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector};

use super::{BalanceError, HarmonicBalance, Intersection};
use crate::describing::{DescribingError, DescribingFunction};
use crate::nonlinearity::{Branch, Characteristic, Sinusoid};
use crate::numeric::quadrature::RULE;
use crate::numeric::scan;

/// The most harmonics: the Jacobian is full.
const ORDER: usize = 200;
/// Residual over amplitude that rounding may leave.
const ROUNDING: f64 = 1e-8;
/// Step of the difference quotients, relative to the amplitude or the frequency.
const STEP: f64 = 1e-6;

/// A periodic solution with finitely many harmonics: the characteristic's input
/// `bias + sum over k of b_k sin(k theta) + c_k cos(k theta)`, with `c_1 = 0`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MultiHarmonic {
    /// Frequency, rad/s.
    pub omega_rad_s: f64,
    /// Mean of the characteristic's input.
    pub bias: f64,
    /// `b_k + j c_k` of the input, from k = 1.
    pub harmonics: Vec<Complex<f64>>,
}

impl MultiHarmonic {
    /// The input at phase `theta`, rad.
    #[must_use]
    pub fn input(&self, theta: f64) -> f64 {
        evaluate(self.bias, &self.harmonics, theta).0
    }
    /// Half the range of the input, which is the plant output's too.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        let turns = turning_points(self.bias, &self.harmonics);
        let (low, high) = range(turns.into_iter().map(|theta| self.input(theta)));
        0.5 * (high - low)
    }
}

impl<N> HarmonicBalance<'_, N>
where
    N: Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
{
    /// The balance of harmonics 0 to `order` that continues `start`, an [intersection](Self::intersections) of the same
    /// loop: Newton's method on the Fourier coefficients, the characteristic's output integrated between its kinks.
    ///
    /// With growing order it converges to a periodic solution of the loop, by a power of the order that the smoothness
    /// of the plant's output gives.
    ///
    /// # Errors
    /// [`BalanceError::Order`]; [`BalanceError::NotConverged`]; [`BalanceError::TurnsInMemory`] where the input has more
    /// than two turning points and the characteristic's memory needs to know about them.
    ///
    /// ```
    /// use selfosc::balance::HarmonicBalance;
    /// use selfosc::describing::ClosedForm;
    /// use selfosc::nonlinearity::RelayHysteresis;
    /// use selfosc::plant::TransferFunction;
    /// let plant = TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0])?;
    /// let relay = RelayHysteresis::new(1.0, 0.2, 0.0)?;
    /// let balance = HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep))?;
    /// let first = balance.intersections()?[0];
    /// let error = |omega: f64| (core::f64::consts::PI / omega / 1.862_223_721_734_969 - 1.0).abs();
    /// let many = balance.with_harmonics(&relay, &first, 15)?;
    /// assert!(error(many.omega_rad_s) < 0.05 * error(first.omega_rad_s));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_harmonics(
        &self,
        characteristic: &(impl Characteristic<Number = f64> + ?Sized),
        start: &Intersection,
        order: usize,
    ) -> Result<MultiHarmonic, BalanceError> {
        if !(1..=ORDER).contains(&order) {
            return Err(BalanceError::Order { order, limit: ORDER });
        }
        let output: Output = &|bias, harmonics, order| output_harmonics(characteristic, bias, harmonics, order);
        let mut unknowns = pack(start.bias, start.omega_rad_s, &[Complex::new(start.amplitude, 0.0)]);
        let mut reached = 1;
        loop {
            unknowns = self.settle(output, unknowns)?;
            let (bias, omega_rad_s, mut harmonics) = unpack(&unknowns);
            if reached == order {
                return Ok(MultiHarmonic { omega_rad_s, bias, harmonics });
            }
            // The plant's response to the further harmonics of the output under the present ones.
            reached = order.min(2 * reached);
            let (_, outputs) = output(bias, &harmonics, reached)?;
            for (k, output) in outputs.iter().enumerate().skip(harmonics.len()) {
                harmonics.push(-self.plant.response((k + 1) as f64 * omega_rad_s)? * output);
            }
            unknowns = pack(bias, omega_rad_s, &harmonics);
        }
    }

    /// Newton's method with backtracking on the residual's norm, until rounding keeps it from shrinking.
    pub(super) fn settle(&self, output: Output, mut unknowns: DVector<f64>) -> Result<DVector<f64>, BalanceError> {
        let order = unknowns.len() / 2;
        let mut residual = self.miss(output, &unknowns)?;
        for _ in 0..30 {
            let size = residual.amax() / unknowns[1].abs();
            let stuck = BalanceError::NotConverged { order, residual: size };
            let step = self.slopes(output, &unknowns, &residual)?.lu().solve(&residual).ok_or(stuck.clone())?;
            let mut share = 1.0;
            (unknowns, residual) = loop {
                let moved = &unknowns - &step * share;
                match self.miss(output, &moved) {
                    Ok(after) if after.norm() < residual.norm() => break (moved, after),
                    _ if size <= ROUNDING => return Ok(unknowns),
                    _ if share < 1e-6 => return Err(stuck),
                    _ => share *= 0.5,
                }
            };
        }
        let residual = residual.amax() / unknowns[1].abs();
        if residual <= ROUNDING { Ok(unknowns) } else { Err(BalanceError::NotConverged { order, residual }) }
    }

    /// Derivatives of the loop's equations by the unknowns; one-sided at an edge of the characteristic's domain.
    pub(super) fn slopes(
        &self,
        output: Output,
        unknowns: &DVector<f64>,
        here: &DVector<f64>,
    ) -> Result<DMatrix<f64>, BalanceError> {
        let mut slopes = DMatrix::zeros(here.len(), unknowns.len());
        for column in 0..unknowns.len() {
            let step = STEP * unknowns[if column == 2 { 2 } else { 1 }].abs();
            let at = |offset: f64| {
                let mut moved = unknowns.clone();
                moved[column] += offset;
                self.miss(output, &moved)
            };
            let slope = match (at(step), at(-step)) {
                (Ok(after), Ok(before)) => (after - before) / (2.0 * step),
                (Ok(after), Err(_)) => (after - here) / step,
                (Err(_), Ok(before)) => (here - before) / step,
                (Err(error), Err(_)) => return Err(error),
            };
            slopes.set_column(column, &slope);
        }
        Ok(slopes)
    }

    /// The loop's equation in every harmonic: `E_k + G(jkw) U_k`.
    pub(super) fn miss(&self, output: Output, unknowns: &DVector<f64>) -> Result<DVector<f64>, BalanceError> {
        let (bias, omega, harmonics) = unpack(unknowns);
        let (mean, outputs) = output(bias, &harmonics, harmonics.len())?;
        let mut misses = vec![self.bias_miss(bias, mean)];
        for (index, (input, output)) in harmonics.iter().zip(&outputs).enumerate() {
            let miss = input + self.plant.response((index + 1) as f64 * omega)? * output;
            misses.extend([miss.re, miss.im]);
        }
        Ok(DVector::from_vec(misses))
    }
}

/// Mean and `Y_Pk + j Y_Qk` of the characteristic's output, from k = 1.
type OutputHarmonics = (f64, Vec<Complex<f64>>);
/// Those up to an order, from the bias and the harmonics of the input.
pub(super) type Output<'a> = &'a dyn Fn(f64, &[Complex<f64>], usize) -> Result<OutputHarmonics, BalanceError>;

/// Unknowns in order: bias, b_1, frequency, then b_k and c_k from k = 2.
pub(super) fn pack(bias: f64, omega: f64, harmonics: &[Complex<f64>]) -> DVector<f64> {
    let higher = harmonics[1..].iter().flat_map(|harmonic| [harmonic.re, harmonic.im]);
    DVector::from_vec([bias, harmonics[0].re, omega].into_iter().chain(higher).collect())
}

fn unpack(unknowns: &DVector<f64>) -> (f64, f64, Vec<Complex<f64>>) {
    let higher = unknowns.as_slice()[3..].chunks(2).map(|pair| Complex::new(pair[0], pair[1]));
    let harmonics = core::iter::once(Complex::new(unknowns[1], 0.0)).chain(higher).collect();
    (unknowns[0], unknowns[2], harmonics)
}

/// `exp(jk theta)` from k = 1.
fn turns(theta: f64) -> impl Iterator<Item = Complex<f64>> {
    let turn = Complex::from_polar(1.0, theta);
    core::iter::successors(Some(turn), move |power| Some(power * turn))
}

/// Value and derivative at phase `theta`.
fn evaluate(bias: f64, harmonics: &[Complex<f64>], theta: f64) -> (f64, f64) {
    harmonics.iter().zip(turns(theta)).zip(1..).fold((bias, 0.0), |(value, slope), ((harmonic, turn), k)| {
        let term = harmonic * turn;
        (value + term.im, slope + f64::from(k) * term.re)
    })
}

/// Phases in `[0, 2 pi)` at which the input turns.
fn turning_points(bias: f64, harmonics: &[Complex<f64>]) -> Vec<f64> {
    let count = 16 * harmonics.len() + 32;
    let nodes: Vec<f64> = (0..=count).map(|index| 2.0 * PI * index as f64 / count as f64).collect();
    let mut turns = scan::roots(&nodes, &mut |theta| Some(evaluate(bias, harmonics, theta).1));
    turns.retain(|&theta| theta < 2.0 * PI);
    turns
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// The first harmonics of a characteristic's output, integrated between its kinks and the turning points of the input.
fn output_harmonics(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    bias: f64,
    harmonics: &[Complex<f64>],
    order: usize,
) -> Result<OutputHarmonics, BalanceError> {
    let value = |theta: f64| evaluate(bias, harmonics, theta).0;
    let mut ends = turning_points(bias, harmonics);
    let Some(&first) = ends.first() else {
        return Err(BalanceError::NotConverged { order, residual: f64::INFINITY });
    };
    let extremes: Vec<f64> = ends.iter().map(|&theta| value(theta)).collect();
    ends.push(first + 2.0 * PI);
    let (low, high) = range(extremes.iter().copied());
    let sweep = Sinusoid::new(0.5 * (low + high), 0.5 * (high - low))?;
    characteristic.admits(&sweep)?;
    // A characteristic without memory at the turning points between the extremes needs no more than the extremes.
    let output = |x: f64, branch: Branch| characteristic.output(x, branch, &sweep);
    let between = extremes.into_iter().filter(|&x| low < x && x < high);
    if let Some(input) = between.into_iter().find(|&x| output(x, Branch::Rising) != output(x, Branch::Falling)) {
        return Err(BalanceError::TurnsInMemory { input });
    }
    let mut kinks = Vec::new();
    characteristic.kinks(&sweep, &mut |x| kinks.push(x));

    let mut integrals = (0.0, vec![Complex::new(0.0, 0.0); order]);
    for pair in ends.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let branch = if value(to) > value(from) { Branch::Rising } else { Branch::Falling };
        let mut cuts = vec![from, to];
        cuts.extend(kinks.iter().filter_map(|kink| scan::bracketed(&mut |theta| Some(value(theta) - kink), from, to)));
        cuts.sort_by(f64::total_cmp);
        for piece in cuts.windows(2) {
            let cells = ((piece[1] - piece[0]) * order.max(harmonics.len()) as f64 / PI).ceil().max(1.0);
            let half = 0.5 * (piece[1] - piece[0]) / cells;
            for cell in 0..cells as usize {
                let centre = piece[0] + half * (2 * cell + 1) as f64;
                for (node, weight, _) in RULE {
                    // The middle twice, half each time.
                    let share = if node == 0.0 { 0.5 } else { 1.0 };
                    for side in [-1.0, 1.0] {
                        let theta = centre + side * half * node;
                        let weighted = share * half * weight * output(value(theta), branch);
                        integrals.0 += weighted;
                        integrals.1.iter_mut().zip(turns(theta)).for_each(|(sum, turn)| *sum += turn.conj() * weighted);
                    }
                }
            }
        }
    }
    // sin + j cos = j exp(-j theta)
    let outputs = integrals.1.into_iter().map(|sum| sum * Complex::i() / PI);
    Ok((integrals.0 / (2.0 * PI), outputs.collect()))
}
