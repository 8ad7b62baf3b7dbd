//! The two curves of the Nyquist plot: points over a logarithmic range, closer where a curve moves faster.

use core::ops::RangeInclusive;

use nalgebra::Complex;

use super::BalanceError;
use crate::describing::{DescribingError, DescribingFunction};
use crate::nonlinearity::Sinusoid;
use crate::numeric::domain;
use crate::plant::TransferFunction;

/// Points in a decade before refinement.
const PER_DECADE: f64 = 24.0;
/// Halvings of a gap: the edge of a domain is found to 1e-7 of its place.
const DEPTH: u32 = 20;
/// The most points of a curve.
const POINTS: usize = 100_000;

/// The sampled quantity, for errors.
pub(super) struct SampledRange {
    pub(super) quantity: &'static str,
    pub(super) range: RangeInclusive<f64>,
}

impl SampledRange {
    /// Amplitudes of the characteristic's input.
    pub(super) fn amplitude(range: &RangeInclusive<f64>) -> Result<Self, BalanceError> {
        domain::ascending(["lowest amplitude", "highest amplitude"], range, "input units")?;
        Ok(Self { quantity: "amplitude", range: range.clone() })
    }
    /// Frequencies, rad/s.
    pub(super) fn frequency(range: &RangeInclusive<f64>) -> Result<Self, BalanceError> {
        domain::ascending(["lowest frequency", "highest frequency"], range, "rad/s")?;
        Ok(Self { quantity: "frequency", range: range.clone() })
    }

    /// Samples `curve`; halves every gap between two points that are not `close`, and every edge of its domain.
    pub(super) fn sample<V: Clone>(
        &self,
        mut curve: impl FnMut(f64) -> Option<V>,
        close: impl Fn(&V, &V) -> bool,
    ) -> Result<Vec<(f64, Option<V>)>, BalanceError> {
        let (from, to) = (*self.range.start(), *self.range.end());
        let gaps = (libm::log10(to / from) * PER_DECADE).ceil().max(1.0);
        let too_many = BalanceError::TooManyPoints { quantity: self.quantity, from, to, limit: POINTS };
        if gaps >= POINTS as f64 {
            return Err(too_many);
        }
        let node = |index: f64| if index == gaps { to } else { from * libm::pow(to / from, index / gaps) };
        let mut points: Vec<(f64, Option<V>)> = vec![(from, curve(from))];
        // Ends of the gaps still to be checked, the nearest on top.
        let nodes = (1..=gaps as u32).rev().map(|index| node(f64::from(index)));
        let mut open: Vec<(f64, Option<V>, u32)> = nodes.map(|x| (x, curve(x), 0)).collect();
        while let (Some((x, value, depth)), Some((last, before))) = (open.pop(), points.last()) {
            let fine = match (before, &value) {
                (Some(a), Some(b)) => close(a, b),
                (a, b) => a.is_none() && b.is_none(),
            };
            if fine || depth >= DEPTH {
                points.push((x, value));
                continue;
            }
            if points.len() + open.len() >= POINTS {
                return Err(too_many);
            }
            let middle = (last * x).sqrt();
            open.push((x, value, depth + 1));
            open.push((middle, curve(middle), depth + 1));
        }
        Ok(points)
    }
}

/// A step along a curve that counts as none, relative to its distance from the origin.
const STEP: f64 = 0.1;

pub(super) fn near(a: Complex<f64>, b: Complex<f64>) -> bool {
    (a - b).norm() <= STEP * a.norm().max(b.norm())
}

/// `G(jw)` over a range of frequencies in rad/s, as pairs of frequency and response, at most a tenth of its magnitude
/// apart. A pole on the imaginary axis makes a gap.
///
/// # Errors
/// [`BalanceError::OutOfDomain`]; [`BalanceError::TooManyPoints`] where a delay turns the curve too often.
///
/// ```
/// use selfosc::balance::nyquist_locus;
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[1.0], &[1.0, 1.0])?;
/// let locus = nyquist_locus(&plant, 0.01..=100.0)?;
/// // A semicircle through 1/2 - j/2:
/// assert!(locus.iter().all(|(_, response)| ((response - 0.5).norm() - 0.5).abs() < 1e-12));
/// # Ok::<(), selfosc::balance::BalanceError>(())
/// ```
pub fn nyquist_locus(
    plant: &TransferFunction,
    omega_rad_s: RangeInclusive<f64>,
) -> Result<Vec<(f64, Complex<f64>)>, BalanceError> {
    let points = SampledRange::frequency(&omega_rad_s)?.sample(|w| plant.response(w).ok(), |a, b| near(*a, *b))?;
    Ok(points.into_iter().filter_map(|(omega, response)| Some((omega, response?))).collect())
}

/// `-1/N(X)` over a range of amplitudes at a bias of the characteristic's input, as pairs of amplitude and value, at
/// most a tenth of its magnitude apart. Amplitudes without describing function, or where it vanishes, are omitted.
///
/// # Errors
/// [`BalanceError::OutOfDomain`], [`BalanceError::TooManyPoints`].
pub fn negative_inverse_locus(
    describing: impl Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
    bias: f64,
    amplitude: RangeInclusive<f64>,
) -> Result<Vec<(f64, Complex<f64>)>, BalanceError> {
    let value = |amplitude: f64| {
        let df = describing(&Sinusoid::new(bias, amplitude).ok()?).ok()?;
        Some(-Complex::new(df.p, df.q).inv()).filter(|value| value.is_finite())
    };
    let points = SampledRange::amplitude(&amplitude)?.sample(value, |a, b| near(*a, *b))?;
    Ok(points.into_iter().filter_map(|(amplitude, value)| Some((amplitude, value?))).collect())
}
