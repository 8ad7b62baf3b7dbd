//! All oscillations that the first harmonic predicts, and the generalised Nyquist criterion's verdict on each.

use core::cell::Cell;
use core::ops::RangeInclusive;

use nalgebra::{Complex, DMatrix, DVector, Matrix2, Vector2};

use super::BalanceError;
use super::harmonics::{Output, pack};
use super::nyquist::{SampledRange, near};
use super::nyquist_count::roots_beyond;
use crate::describing::{DescribingError, DescribingFunction};
use crate::nonlinearity::Sinusoid;
use crate::numeric::{domain, scan};
use crate::plant::TransferFunction;

/// Loop gain below which no oscillation can be near: the curve is not refined there.
const QUIET: f64 = 0.3;
/// Two solutions nearer than this, relative, are the same.
const SAME: f64 = 1e-6;
/// Sine of the angle between the derivatives of the balance at which Loeb's criterion is degenerate.
const PARALLEL: f64 = 1e-6;
/// Distance from the axis, over the frequency, beyond which a root counts in addition to the pair on it.
const ASIDE: f64 = 1e-4;

/// The condition on the mean of the characteristic's input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bias {
    /// It is given, in input units.
    Fixed(f64),
    /// The loop's static balance fixes it (eqs. 17, 20): `bias = reference - G(0) (F_0 + disturbance)`, and
    /// `F_0 + disturbance = 0` for an integrating plant.
    Loop {
        /// Constant reference, in units of the plant's output.
        reference: f64,
        /// Constant disturbance at the plant's input.
        disturbance: f64,
    },
}

/// An oscillation predicted by the first harmonic.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct Intersection {
    /// Amplitude X of the characteristic's input, which is the plant output's too.
    pub amplitude: f64,
    /// Mean of the characteristic's input; the plant output's mean is the reference less this.
    pub bias: f64,
    /// Frequency, rad/s.
    pub omega_rad_s: f64,
    /// Whether the oscillation returns after a disturbance of its amplitude (Loeb's criterion), and the loop with the gain N has no
    /// further roots in the right half plane: their motions would grow. `None` where the criterion is degenerate: the curves
    /// touch, or the balance does not fix the bias. A statement of the approximation, not of the loop.
    pub stable: Option<bool>,
    /// Roots of `1 + N G` in the right half plane, without the pair on the axis: the generalised Nyquist count, dead
    /// time included. `None` where N is complex or the count fails; then `stable` is Loeb's criterion alone.
    pub unstable_roots: Option<usize>,
}

/// A plant in a loop with a characteristic, given by its describing function.
///
/// ```
/// use selfosc::balance::HarmonicBalance;
/// use selfosc::describing::ClosedForm;
/// use selfosc::nonlinearity::Saturation;
/// use selfosc::plant::TransferFunction;
/// let plant = TransferFunction::new(&[8.0], &[1.0, 2.0, 2.0, 1.0])?;
/// let saturation = Saturation::new(1.0, 1.0)?;
/// let found = HarmonicBalance::new(&plant, |sweep| saturation.describing_function(sweep))?.intersections()?;
/// assert_eq!(found.len(), 1);
/// assert!((found[0].omega_rad_s - 2f64.sqrt()).abs() < 1e-12);
/// assert!((found[0].amplitude - 3.343_998_730_206).abs() < 1e-11);
/// assert_eq!(found[0].stable, Some(true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct HarmonicBalance<'a, N> {
    pub(super) plant: &'a TransferFunction,
    describing: N,
    bias: Bias,
    pub(crate) amplitude: RangeInclusive<f64>,
    omega_rad_s: RangeInclusive<f64>,
}

/// A bias, and the gain of the characteristic there at an amplitude.
type BiasedGain = (f64, Complex<f64>);

impl<'a, N> HarmonicBalance<'a, N>
where
    N: Fn(&Sinusoid<f64>) -> Result<DescribingFunction<f64>, DescribingError>,
{
    /// At bias zero, amplitudes from 1e-6 to 1e6, frequencies three decades around the plant's poles and zeros (with a
    /// delay, up to 100/delay or ten times the fastest of them).
    ///
    /// # Errors
    /// [`BalanceError::Plant`] where the plant's poles cannot be computed.
    pub fn new(plant: &'a TransferFunction, describing: N) -> Result<Self, BalanceError> {
        let (roots, delay) = ([plant.poles()?, plant.zeros()?].concat(), plant.delay_s());
        let mut corners: Vec<f64> = roots.iter().map(|root| root.norm()).chain([1.0 / delay]).collect();
        corners.retain(|corner| *corner > 0.0 && corner.is_finite());
        let slowest = corners.iter().copied().reduce(f64::min).unwrap_or(1.0);
        let fastest = corners.iter().copied().reduce(f64::max).unwrap_or(1.0);
        let highest = if delay > 0.0 { (10.0 * fastest).max(100.0 / delay) } else { 1e3 * fastest };
        let omega_rad_s = 1e-3 * slowest..=highest;
        Ok(Self { plant, describing, bias: Bias::Fixed(0.0), amplitude: 1e-6..=1e6, omega_rad_s })
    }

    /// With another condition on the bias.
    ///
    /// # Errors
    /// [`BalanceError::OutOfDomain`].
    pub fn with_bias(self, bias: Bias) -> Result<Self, BalanceError> {
        match bias {
            Bias::Fixed(bias) => _ = domain::finite("bias", bias, "input units")?,
            Bias::Loop { reference, disturbance } => {
                domain::finite("reference", reference, "output units")?;
                domain::finite("disturbance", disturbance, "plant input units")?;
            }
        }
        Ok(Self { bias, ..self })
    }
    /// Within these amplitudes of the characteristic's input and these frequencies, rad/s.
    ///
    /// # Errors
    /// [`BalanceError::OutOfDomain`] unless both ranges are positive, finite and ascending.
    pub fn within(
        self,
        amplitude: RangeInclusive<f64>,
        omega_rad_s: RangeInclusive<f64>,
    ) -> Result<Self, BalanceError> {
        SampledRange::amplitude(&amplitude)?;
        SampledRange::frequency(&omega_rad_s)?;
        Ok(Self { amplitude, omega_rad_s, ..self })
    }
    /// The range of frequencies searched, rad/s.
    #[must_use]
    pub fn omega_rad_s(&self) -> RangeInclusive<f64> {
        self.omega_rad_s.clone()
    }

    /// All solutions of `1 + N(X) G(jw) = 0` and of the condition on the bias, ascending in frequency, then amplitude.
    ///
    /// Both curves are sampled to a tenth of their magnitude, every pair of steps is tried with their linear parts, and
    /// Newton's method finishes. Two solutions are separated where the curves bend less than that between them; a
    /// solution at which the curves touch may be missed.
    ///
    /// # Errors
    /// [`BalanceError::TooManyPoints`]; [`BalanceError::Describing`] where the describing function fails, except for an
    /// amplitude below switching.
    pub fn intersections(&self) -> Result<Vec<Intersection>, BalanceError> {
        let failure = Cell::new(None);
        let amplitude = SampledRange::amplitude(&self.amplitude)?;
        let omega = SampledRange::frequency(&self.omega_rad_s)?;
        let gains = amplitude.sample(
            |amplitude| Some(self.gains(amplitude, &failure)).filter(|gains| !gains.is_empty()),
            |a, b| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| near(a.1, b.1)),
        )?;
        if let Some(error) = failure.take() {
            return Err(error.into());
        }
        let loudest = gains.iter().flat_map(|(_, gains)| gains).flatten().map(|gain| gain.1.norm()).fold(0.0, f64::max);
        let quiet = |a: &Complex<f64>, b: &Complex<f64>| a.norm().max(b.norm()) * loudest < QUIET;
        let responses = omega.sample(|omega| self.plant.response(omega).ok(), |a, b| near(*a, *b) || quiet(a, b))?;

        let describe: Output = &|bias, harmonics, _| {
            let df = self.describe(harmonics[0].re, bias)?;
            Ok((df.f0, vec![harmonics[0] * Complex::new(df.p, df.q)]))
        };
        let between = |a: f64, b: f64, share: f64| libm::exp(libm::log(a) + share * libm::log(b / a));
        let steps = responses.windows(2).filter_map(|pair| Some(([pair[0].0, pair[1].0], [pair[0].1?, pair[1].1?])));
        let response_steps: Vec<([f64; 2], [Complex<f64>; 2])> = steps.collect();
        let mut found: Vec<Intersection> = Vec::new();
        for steps in gains.windows(2) {
            let (Some(here), Some(next)) = (&steps[0].1, &steps[1].1) else { continue };
            for gain in here {
                let nearest = |a: &&BiasedGain, b: &&BiasedGain| (a.0 - gain.0).abs().total_cmp(&(b.0 - gain.0).abs());
                let Some(after) = next.iter().min_by(nearest) else { continue };
                for (omega, response) in &response_steps {
                    let Some(share) = crossing([gain.1, after.1], *response) else { continue };
                    let amplitude = Complex::new(between(steps[0].0, steps[1].0, share[0]), 0.0);
                    let bias = gain.0 + share[0] * (after.0 - gain.0);
                    let guess = pack(bias, between(omega[0], omega[1], share[1]), &[amplitude]);
                    let root = self.settle(describe, guess).ok().and_then(|root| self.intersection(describe, &root));
                    let inside = |one: &Intersection| {
                        self.amplitude.contains(&one.amplitude) && self.omega_rad_s.contains(&one.omega_rad_s)
                    };
                    found.extend(root.filter(|one| inside(one) && !found.iter().any(|known| same(known, one))));
                }
            }
        }
        found.sort_by(|a, b| a.omega_rad_s.total_cmp(&b.omega_rad_s).then(a.amplitude.total_cmp(&b.amplitude)));
        Ok(found)
    }

    /// A solution of the first harmonic's balance with its verdicts.
    fn intersection(&self, describe: Output, root: &DVector<f64>) -> Option<Intersection> {
        let slopes = self.slopes(describe, root, &self.miss(describe, root).ok()?).ok()?;
        let (bias, amplitude, omega_rad_s) = (root[0], root[1], root[2]);
        // Clearly to the right of the pair on the axis.
        let gain = self.describe(amplitude, bias).ok().filter(|df| df.q == 0.0);
        let unstable_roots = gain.and_then(|df| roots_beyond(self.plant, df.p, ASIDE * omega_rad_s));
        let grows_beside = unstable_roots.is_some_and(|count| count > 0);
        let stable = if grows_beside { Some(false) } else { loeb(&slopes) };
        Some(Intersection { amplitude, bias, omega_rad_s, stable, unstable_roots })
    }

    fn describe(&self, amplitude: f64, bias: f64) -> Result<DescribingFunction<f64>, DescribingError> {
        (self.describing)(&Sinusoid::new(bias, amplitude)?)
    }

    /// The error of the bias, with `f0` the mean of the characteristic's output.
    pub(super) fn bias_miss(&self, bias: f64, f0: f64) -> f64 {
        match (self.bias, self.plant.static_gain()) {
            (Bias::Fixed(fixed), _) => bias - fixed,
            (Bias::Loop { reference, disturbance }, Some(gain)) => bias - reference + gain * (f0 + disturbance),
            (Bias::Loop { disturbance, .. }, None) => f0 + disturbance,
        }
    }

    /// Every bias that fits an amplitude, with the gain there. Keeps every failure but of the amplitude's size.
    fn gains(&self, amplitude: f64, failure: &Cell<Option<DescribingError>>) -> Vec<BiasedGain> {
        let describe = |bias: f64| match self.describe(amplitude, bias) {
            Ok(df) => Some(df),
            Err(DescribingError::Nonlinearity(_) | DescribingError::NotFinite { .. }) => None,
            Err(other) => {
                failure.set(Some(other));
                None
            }
        };
        let biases = match self.bias {
            Bias::Fixed(bias) => vec![bias],
            Bias::Loop { reference, .. } => {
                // Evenly where the sweep straddles zero, geometrically beyond, and about the reference.
                let even = (-20..=20).map(|step| f64::from(step) * 0.05 * amplitude);
                let far = (1..=24).flat_map(|step| [-1.0, 1.0].map(|side| side * amplitude * 1.5f64.powi(step)));
                let mut nodes: Vec<f64> = even.chain(far).flat_map(|node| [node, node + reference]).collect();
                nodes.sort_by(f64::total_cmp);
                nodes.dedup();
                scan::roots(&nodes, &mut |bias| Some(self.bias_miss(bias, describe(bias)?.f0)))
            }
        };
        let gain = |bias: f64| {
            let df = describe(bias)?;
            Some((bias, Complex::new(df.p, df.q))).filter(|gain| gain.1.is_finite())
        };
        biases.into_iter().filter_map(gain).collect()
    }
}

fn same(a: &Intersection, b: &Intersection) -> bool {
    let near = |a: f64, b: f64| libm::log(a / b).abs() < SAME;
    let bias = (a.bias - b.bias).abs() < SAME * b.amplitude;
    near(a.amplitude, b.amplitude) && near(a.omega_rad_s, b.omega_rad_s) && bias
}

/// Where, in shares of the two steps, the linear part of `1 + N G` vanishes; `None` if not near them.
fn crossing(gain: [Complex<f64>; 2], response: [Complex<f64>; 2]) -> Option<Vector2<f64>> {
    let here = gain[0] * response[0] + 1.0;
    let (by_gain, by_response) = ((gain[1] - gain[0]) * response[0], gain[0] * (response[1] - response[0]));
    let reach = 2.0;
    if here.norm() > reach * (by_gain.norm() + by_response.norm()) {
        return None;
    }
    let slopes = Matrix2::new(by_gain.re, by_response.re, by_gain.im, by_response.im);
    let share = slopes.lu().solve(&Vector2::new(-here.re, -here.im))?;
    (share.amax() <= reach).then_some(share)
}

/// Loeb's criterion: with `1 + N(X) G(s) = 0` kept, a larger X must move s to the left, that is
/// `R_X I_w - I_X R_w > 0` for the real and imaginary parts R, I of the balance. The bias follows the amplitude.
fn loeb(slopes: &DMatrix<f64>) -> Option<bool> {
    let follow = -slopes[(0, 1)] / slopes[(0, 0)];
    let balance = slopes.fixed_rows::<2>(1);
    let (by_amplitude, by_frequency) = (balance.column(1) + balance.column(0) * follow, balance.column(2));
    let determinant = by_amplitude[0] * by_frequency[1] - by_amplitude[1] * by_frequency[0];
    let scale = by_amplitude.norm() * by_frequency.norm();
    (determinant.abs() > PARALLEL * scale).then_some(determinant > 0.0)
}
