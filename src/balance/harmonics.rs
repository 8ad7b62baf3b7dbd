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
/// Residual over amplitude at which Newton's method has arrived.
const ARRIVED: f64 = 1e-11;

/// A periodic solution with finitely many harmonics: the characteristic's input
/// `bias + sum over k of b_k sin(k theta) + c_k cos(k theta)`, with `c_1 = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct MultiHarmonic {
    omega_rad_s: f64,
    bias: f64,
    /// `b_k + j c_k`, from k = 1.
    harmonics: Vec<Complex<f64>>,
    turns: Vec<f64>,
}

impl MultiHarmonic {
    /// Frequency, rad/s.
    #[must_use]
    pub fn omega_rad_s(&self) -> f64 {
        self.omega_rad_s
    }
    /// Mean of the characteristic's input.
    #[must_use]
    pub fn bias(&self) -> f64 {
        self.bias
    }
    /// `b_k + j c_k` of the input, from k = 1.
    #[must_use]
    pub fn harmonics(&self) -> &[Complex<f64>] {
        &self.harmonics
    }
    /// The input at phase `theta`, rad.
    #[must_use]
    pub fn input(&self, theta: f64) -> f64 {
        evaluate(self.bias, &self.harmonics, theta).0
    }
    /// Half the range of the input, which is the plant output's too.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        let inputs = self.turns.iter().map(|&theta| self.input(theta));
        let (low, high) = inputs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
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
    /// assert!(error(many.omega_rad_s()) < 0.05 * error(first.omega_rad_s));
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
        let mut unknowns = DVector::from_column_slice(&[start.bias, start.amplitude, libm::log(start.omega_rad_s)]);
        let mut reached = 1;
        loop {
            unknowns = self.settle(characteristic, unknowns, reached)?;
            if reached == order {
                break;
            }
            let next = order.min(2 * reached);
            unknowns = self.extended(characteristic, &unknowns, next)?;
            reached = next;
        }
        let (bias, omega_rad_s, harmonics) = unpack(&unknowns);
        let turns = turning_points(bias, &harmonics);
        Ok(MultiHarmonic { omega_rad_s, bias, harmonics, turns })
    }

    /// The plant's response to the harmonics of the characteristic's output under the present harmonics.
    fn extended(
        &self,
        characteristic: &(impl Characteristic<Number = f64> + ?Sized),
        unknowns: &DVector<f64>,
        order: usize,
    ) -> Result<DVector<f64>, BalanceError> {
        let (bias, omega, mut harmonics) = unpack(unknowns);
        let (_, outputs) = output_harmonics(characteristic, bias, &harmonics, order)?;
        for (k, output) in outputs.iter().enumerate().skip(harmonics.len()) {
            harmonics.push(-self.plant().response((k + 1) as f64 * omega)? * output);
        }
        Ok(pack(bias, omega, &harmonics))
    }

    /// Newton's method with backtracking on the residual's norm. Its own loop: a step counts only if it lessens that
    /// norm, and the residual when none does is reported; the first harmonic alone stops by its steps.
    fn settle(
        &self,
        characteristic: &(impl Characteristic<Number = f64> + ?Sized),
        mut unknowns: DVector<f64>,
        order: usize,
    ) -> Result<DVector<f64>, BalanceError> {
        let size = unknowns.len();
        let mut residual = self.miss(characteristic, &unknowns, order)?;
        for _ in 0..30 {
            let amplitude = unknowns[1].abs();
            if residual.amax() <= ARRIVED * amplitude {
                return Ok(unknowns);
            }
            let mut slopes = DMatrix::zeros(size, size);
            for column in 0..size {
                let step = if column == 2 { 1e-6 } else { 1e-6 * amplitude };
                let mut moved = unknowns.clone();
                moved[column] += step;
                let after = self.miss(characteristic, &moved, order)?;
                moved[column] -= 2.0 * step;
                let before = self.miss(characteristic, &moved, order)?;
                slopes.set_column(column, &((after - before) / (2.0 * step)));
            }
            let stuck = BalanceError::NotConverged { order, residual: residual.amax() / amplitude };
            let step = slopes.lu().solve(&residual).ok_or(stuck.clone())?;
            let mut share = 1.0;
            (unknowns, residual) = loop {
                let moved = &unknowns - &step * share;
                match self.miss(characteristic, &moved, order) {
                    Ok(after) if after.norm() < residual.norm() => break (moved, after),
                    // Rounding keeps it from shrinking further.
                    _ if residual.amax() <= 1e3 * ARRIVED * amplitude && share < 1e-2 => return Ok(unknowns),
                    _ if share < 1e-6 => return Err(stuck),
                    _ => share *= 0.5,
                }
            };
        }
        Err(BalanceError::NotConverged { order, residual: residual.amax() / unknowns[1].abs() })
    }

    /// The loop's equation in every harmonic: `E_k + G(jkw) U_k`.
    fn miss(
        &self,
        characteristic: &(impl Characteristic<Number = f64> + ?Sized),
        unknowns: &DVector<f64>,
        order: usize,
    ) -> Result<DVector<f64>, BalanceError> {
        let (bias, omega, harmonics) = unpack(unknowns);
        let (mean, outputs) = output_harmonics(characteristic, bias, &harmonics, order)?;
        let mut misses = vec![self.bias_miss(bias, mean)];
        for (index, (input, output)) in harmonics.iter().zip(&outputs).enumerate() {
            let miss = input + self.plant().response((index + 1) as f64 * omega)? * output;
            misses.extend([miss.re, miss.im]);
        }
        Ok(DVector::from_vec(misses))
    }
}

/// Unknowns in order: bias, b_1, logarithm of frequency, then b_k and c_k from k = 2.
fn pack(bias: f64, omega: f64, harmonics: &[Complex<f64>]) -> DVector<f64> {
    let higher = harmonics.iter().skip(1).flat_map(|harmonic| [harmonic.re, harmonic.im]);
    let values: Vec<f64> = [bias, harmonics[0].re, libm::log(omega)].into_iter().chain(higher).collect();
    DVector::from_vec(values)
}

fn unpack(unknowns: &DVector<f64>) -> (f64, f64, Vec<Complex<f64>>) {
    let mut harmonics = vec![Complex::new(unknowns[1], 0.0)];
    harmonics.extend(unknowns.as_slice()[3..].chunks(2).map(|pair| Complex::new(pair[0], pair[1])));
    (unknowns[0], libm::exp(unknowns[2]), harmonics)
}

/// Value and derivative at phase `theta`.
fn evaluate(bias: f64, harmonics: &[Complex<f64>], theta: f64) -> (f64, f64) {
    let turn = Complex::from_polar(1.0, theta);
    let mut power = Complex::new(1.0, 0.0);
    let (mut value, mut slope) = (bias, 0.0);
    for (index, harmonic) in harmonics.iter().enumerate() {
        power *= turn;
        value += harmonic.re * power.im + harmonic.im * power.re;
        slope += (index + 1) as f64 * (harmonic.re * power.re - harmonic.im * power.im);
    }
    (value, slope)
}

/// Phases in `[0, 2 pi)` at which the input turns.
fn turning_points(bias: f64, harmonics: &[Complex<f64>]) -> Vec<f64> {
    let count = 16 * harmonics.len() + 32;
    let nodes: Vec<f64> = (0..=count).map(|index| 2.0 * PI * index as f64 / count as f64).collect();
    let mut turns = scan::roots(&nodes, |theta| Some(evaluate(bias, harmonics, theta).1));
    turns.retain(|&theta| theta < 2.0 * PI);
    turns
}

/// Mean and `Y_Pk + j Y_Qk` of the characteristic's output, `k = 1..=order`.
fn output_harmonics(
    characteristic: &(impl Characteristic<Number = f64> + ?Sized),
    bias: f64,
    harmonics: &[Complex<f64>],
    order: usize,
) -> Result<(f64, Vec<Complex<f64>>), BalanceError> {
    let value = |theta: f64| evaluate(bias, harmonics, theta).0;
    let mut ends = turning_points(bias, harmonics);
    let Some(&first) = ends.first() else {
        return Err(BalanceError::NotConverged { order, residual: f64::INFINITY });
    };
    let turns: Vec<f64> = ends.iter().map(|&theta| value(theta)).collect();
    ends.push(first + 2.0 * PI);
    let (low, high) =
        turns.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| (low.min(x), high.max(x)));
    let sweep = Sinusoid::new(0.5 * (low + high), 0.5 * (high - low))?;
    characteristic.admits(&sweep)?;
    // A characteristic without memory at the turning points between the extremes needs no more than the extremes.
    let output = |x: f64, branch: Branch| characteristic.output(x, branch, &sweep);
    for &x in turns.iter().filter(|&&x| turns.len() > 2 && low < x && x < high) {
        if output(x, Branch::Rising) != output(x, Branch::Falling) {
            return Err(BalanceError::TurnsInMemory { input: x });
        }
    }
    let mut kinks = Vec::new();
    characteristic.kinks(&sweep, &mut |x| kinks.push(x));

    let mut sums = vec![Complex::new(0.0, 0.0); order + 1];
    for pair in ends.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let branch = if value(to) > value(from) { Branch::Rising } else { Branch::Falling };
        let mut cuts = vec![from, to];
        for &kink in &kinks {
            cuts.extend(scan::bracketed(|theta| Some(value(theta) - kink), from, to));
        }
        cuts.sort_by(f64::total_cmp);
        for piece in cuts.windows(2) {
            let cells = ((piece[1] - piece[0]) * order.max(harmonics.len()) as f64 / PI).ceil().max(1.0);
            let half = 0.5 * (piece[1] - piece[0]) / cells;
            for cell in 0..cells as usize {
                let centre = piece[0] + half * (2 * cell + 1) as f64;
                for (node, weight, _) in RULE {
                    let sides: &[f64] = if node == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
                    for side in sides {
                        let theta = centre + side * half * node;
                        add(&mut sums, theta, half * weight * output(value(theta), branch));
                    }
                }
            }
        }
    }
    let mean = sums[0].re / (2.0 * PI);
    Ok((mean, sums.into_iter().skip(1).map(|sum| sum / PI).collect()))
}

/// Adds `weighted (sin(k theta) + j cos(k theta))` to the k-th sum; to the sum for zero, `weighted`.
fn add(sums: &mut [Complex<f64>], theta: f64, weighted: f64) {
    let turn = Complex::from_polar(1.0, theta);
    let mut power = Complex::new(1.0, 0.0);
    if let Some((mean, rest)) = sums.split_first_mut() {
        mean.re += weighted;
        for sum in rest {
            power *= turn;
            *sum += Complex::new(power.im, power.re) * weighted;
        }
    }
}
