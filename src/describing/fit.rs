//! Which characteristic has a measured gain, by Levenberg-Marquardt from several starts: every one of the catalogue fitted to points of P over amplitude, and ranked.

use nalgebra::{DMatrix, DVector};

use super::{CATALOGUE, DescribingError, Entry};
use crate::nonlinearity::{ParameterDomain, ParameterSpec, Sinusoid, checked_amplitude};

/// Parameter sets tried for each characteristic, how many of the best are refined, and in how many steps.
const CANDIDATES: u32 = 600;
const STARTS: usize = 10;
const STEPS: usize = 200;

/// A characteristic fitted to the points.
#[derive(Clone, Debug)]
pub struct FittedCharacteristic {
    /// The characteristic.
    pub entry: &'static Entry,
    /// Its parameter values, as [`Entry::build`] takes them.
    pub values: Vec<f64>,
    /// How many of them the points have any say on.
    pub parameters: usize,
    /// Standard deviation of the residuals, `sqrt(sum r^2/(points - parameters))`, output units per input unit.
    pub residual: f64,
}

/// Every characteristic of the catalogue fitted by least squares to points `(amplitude, P)` at one bias, the best first by the
/// standard deviation of its residuals, which counts parameters against it.
///
/// Left out: characteristics with as many parameters as there are points, and `piecewise-linear`, which fits anything. Several can fit
/// equally well (a preload without slope is a relay), and the search, from the best of 600 parameter sets each, can miss
/// the best parameters; a fit says nothing of amplitudes outside the points'.
///
/// # Errors
/// [`NonlinearityError::OutOfDomain`](crate::nonlinearity::NonlinearityError::OutOfDomain) or [`DescribingError::NotFinite`] for a point that is not two finite numbers with a
/// positive amplitude.
///
/// ```
/// use selfosc::describing::{fit, over_amplitudes};
/// use selfosc::nonlinearity::Saturation;
/// let amplitudes = [0.2, 0.5, 0.8, 1.1, 1.6, 2.5, 4.0];
/// let saturation = Saturation::new(2.0, 0.7)?;
/// let gains = over_amplitudes(&saturation, 0.0, amplitudes).map(|df| df.map(|df| df.p)).collect::<Result<Vec<_>, _>>()?;
/// let points: Vec<_> = amplitudes.into_iter().zip(gains).collect();
/// let ranked = fit(&points, 0.0)?;
/// assert!(ranked.iter().take(3).any(|fit| fit.entry.name == "saturation" && fit.residual < 1e-9));
/// # Ok::<(), selfosc::describing::DescribingError>(())
/// ```
pub fn fit(points: &[(f64, f64)], bias: f64) -> Result<Vec<FittedCharacteristic>, DescribingError> {
    for &(amplitude, p) in points {
        checked_amplitude(amplitude)?;
        if !p.is_finite() {
            return Err(DescribingError::NotFinite { input: amplitude, output: p });
        }
    }
    let mut fits: Vec<FittedCharacteristic> = CATALOGUE.iter().filter_map(|entry| best(entry, points, bias)).collect();
    fits.sort_by(|a, b| a.residual.total_cmp(&b.residual));
    Ok(fits)
}

/// A parameter as the search sees it: of one sign by its logarithm.
fn value(parameter: &ParameterSpec, searched: f64) -> f64 {
    if parameter.domain == ParameterDomain::Finite { searched } else { libm::exp(searched) }
}

fn values(entry: &Entry, searched: &DVector<f64>) -> Vec<f64> {
    entry.parameters.iter().zip(searched.iter()).map(|(parameter, &x)| value(parameter, x)).collect()
}

fn residuals(entry: &Entry, searched: &DVector<f64>, points: &[(f64, f64)], bias: f64) -> Option<DVector<f64>> {
    let characteristic = entry.build(&values(entry, searched)).ok()?;
    let residual = |&(amplitude, p): &(f64, f64)| {
        let sweep = Sinusoid::new(bias, amplitude).ok()?;
        let residual = characteristic.describing_function(&sweep).ok()?.p - p;
        residual.is_finite().then_some(residual)
    };
    points.iter().map(residual).collect::<Option<Vec<_>>>().map(DVector::from_vec)
}

fn best(entry: &'static Entry, points: &[(f64, f64)], bias: f64) -> Option<FittedCharacteristic> {
    if entry.parameters.iter().any(|parameter| parameter.domain == ParameterDomain::Points) {
        return None;
    }
    let candidates = (0..CANDIDATES).filter_map(|number| {
        let candidate = candidate(entry, points, number);
        residuals(entry, &candidate, points, bias).map(|residual| (candidate, residual.norm_squared()))
    });
    let mut candidates: Vec<_> = candidates.collect();
    candidates.sort_by(|a, b| a.1.total_cmp(&b.1));
    let starts = candidates.into_iter().take(STARTS);
    let (searched, sum) =
        starts.filter_map(|(start, _)| descend(entry, start, points, bias)).min_by(|a, b| a.1.total_cmp(&b.1))?;
    let jacobian = jacobian(entry, &searched, points, bias)?;
    let largest = jacobian.amax();
    let parameters = jacobian.column_iter().filter(|column| column.amax() > 1e-9 * largest).count();
    let freedom = points.len().checked_sub(parameters).filter(|&freedom| freedom > 0)?;
    Some(FittedCharacteristic {
        entry,
        values: values(entry, &searched),
        parameters,
        residual: (sum / freedom as f64).sqrt(),
    })
}

/// A parameter set: sizes spread evenly in their logarithm over those that the points suggest for inputs, outputs and
/// gains, by an additive recurrence in as many dimensions as there are parameters (irrational steps: square roots of primes).
fn candidate(entry: &Entry, points: &[(f64, f64)], number: u32) -> DVector<f64> {
    const STEPS: [f64; 10] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0];
    let sizes = points.iter().flat_map(|&(amplitude, p)| [amplitude, p.abs(), (p * amplitude).abs(), 1.0]);
    let sizes = sizes.filter(|size| *size > 0.0).map(libm::log);
    let (low, high) =
        sizes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), size| (low.min(size), high.max(size)));
    let size = |(place, parameter): (usize, &ParameterSpec)| {
        let fraction = (f64::from(number) * STEPS[place % STEPS.len()].sqrt()).fract();
        let size = low - 1.0 + (high - low + 2.0) * fraction;
        match (parameter.domain, parameter.default) {
            (ParameterDomain::Finite, Some(0.0)) => 0.0,
            (ParameterDomain::Finite, _) if number % 3 == 2 => -libm::exp(size),
            (ParameterDomain::Finite, _) => libm::exp(size),
            _ => size,
        }
    };
    DVector::from_iterator(entry.parameters.len(), entry.parameters.iter().enumerate().map(size))
}

fn jacobian(entry: &Entry, searched: &DVector<f64>, points: &[(f64, f64)], bias: f64) -> Option<DMatrix<f64>> {
    let mut jacobian = DMatrix::zeros(points.len(), searched.len());
    for place in 0..searched.len() {
        let step = 1e-6 * searched[place].abs().max(1e-3);
        let moved = |by: f64| {
            let mut moved = searched.clone();
            moved[place] += by;
            residuals(entry, &moved, points, bias)
        };
        jacobian.set_column(place, &((moved(step)? - moved(-step)?) / (2.0 * step)));
    }
    Some(jacobian)
}

/// How far the logarithm of a parameter may go from its start: a factor of 1000.
const REACH: f64 = 7.0;

/// Levenberg-Marquardt from one start: where it ends and the sum of squares there.
fn descend(entry: &Entry, start: DVector<f64>, points: &[(f64, f64)], bias: f64) -> Option<(DVector<f64>, f64)> {
    let within = |trial: &DVector<f64>| {
        let moves = entry.parameters.iter().zip(trial.iter().zip(start.iter()));
        moves
            .into_iter()
            .all(|(parameter, (x, from))| parameter.domain == ParameterDomain::Finite || (x - from).abs() <= REACH)
    };
    let (mut searched, mut damping) = (start.clone(), 1e-3);
    let mut residual = residuals(entry, &searched, points, bias)?;
    for _ in 0..STEPS {
        let Some(jacobian) = jacobian(entry, &searched, points, bias) else { break };
        let gradient = jacobian.tr_mul(&residual);
        let normal = jacobian.tr_mul(&jacobian);
        let ridge = 1e-12 * normal.diagonal().max() + f64::MIN_POSITIVE;
        let damped = &normal + DMatrix::from_diagonal(&normal.diagonal().add_scalar(ridge)) * damping;
        let Some(step) = damped.cholesky().map(|factor| factor.solve(&gradient)) else { break };
        let trial = &searched - &step;
        let residuals = within(&trial).then(|| residuals(entry, &trial, points, bias)).flatten();
        match residuals {
            Some(better) if better.norm_squared() < residual.norm_squared() => {
                let gain = residual.norm_squared() - better.norm_squared();
                (searched, residual, damping) = (trial, better, 0.2 * damping);
                if gain <= 1e-14 * residual.norm_squared() {
                    break;
                }
            }
            _ if damping > 1e12 => break,
            _ => damping *= 8.0,
        }
    }
    let sum = residual.norm_squared();
    Some((searched, sum))
}
