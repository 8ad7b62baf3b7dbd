//! The critical point of a process: from relay experiments (ATV, auto-tuning variation), and from a known transfer
//! function.

use super::ControlError;
use crate::describing::ClosedForm;
use crate::nonlinearity::{RelayHysteresis, Sinusoid};
use crate::numeric::{Limit, Scalar, domain};

/// The gain at which proportional control oscillates for ever, and the period of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UltimatePoint<T> {
    gain: T,
    period_s: T,
}

/// What a relay experiment on a process shows: relay input `reference - y`, output `y` an oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelayTest<T> {
    /// Relay level C, in command units.
    pub level: T,
    /// Half-width of the relay's hysteresis, in output units; the measured one where it is sampled.
    pub half_width: T,
    /// Half the range of the output.
    pub amplitude: T,
    /// Middle of the output against the reference: a load or an uneven relay shifts it.
    pub bias: T,
    /// Period, s.
    pub period_s: T,
}

/// A point of a process' frequency response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrequencyPoint<T> {
    /// Frequency, rad/s.
    pub omega_rad_s: T,
    /// `|G|`, output per command.
    pub magnitude: T,
    /// Angle of G above `-pi`, rad.
    pub angle_above_critical: T,
}

impl<T: Scalar> UltimatePoint<T> {
    /// From gain and period (s).
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless both are positive and finite.
    pub fn new(gain: T, period_s: T) -> Result<Self, ControlError> {
        domain::positive("ultimate gain", gain, "command per output unit")?;
        domain::positive("ultimate period", period_s, "s")?;
        Ok(Self { gain, period_s })
    }
    /// K_u, command per output.
    pub fn gain(&self) -> T {
        self.gain
    }
    /// T_u, s.
    pub fn period_s(&self) -> T {
        self.period_s
    }

    /// Where the phase is `-pi`, from two points with different phases: frequency and logarithm of the magnitude on a
    /// straight line over the phase. Between or just beyond the two.
    ///
    /// Two relay experiments with different half-widths, none zero, give the critical point so without chattering at
    /// zero half-width.
    ///
    /// # Errors
    /// [`ControlError::OnePhase`]; [`ControlError::OutOfDomain`] where the line leads to no positive frequency.
    pub fn between(first: &FrequencyPoint<T>, second: &FrequencyPoint<T>) -> Result<Self, ControlError> {
        let turned = second.angle_above_critical - first.angle_above_critical;
        if !(turned.abs() > T::from_f64(16.0) * T::epsilon()) {
            return Err(ControlError::OnePhase {
                phase_deg: (first.angle_above_critical - T::pi()).value().to_degrees(),
            });
        }
        let share = -first.angle_above_critical / turned;
        let line = |from: T, to: T| from + share * (to - from);
        let omega = line(first.omega_rad_s, second.omega_rad_s);
        let magnitude = line(first.magnitude.ln(), second.magnitude.ln()).exp();
        let remedy = "repeat the experiments with smaller half-widths";
        domain::require("ultimate frequency", omega, "rad/s", Limit::Positive, remedy)?;
        Self::new(T::one() / magnitude, T::two() * T::pi() / omega)
    }
}

impl<T: Scalar> RelayTest<T> {
    /// The point of the process' frequency response at the frequency of the oscillation, `G = -1/N` with the
    /// describing function N of the relay: hysteresis turns it by `asin(half_width/amplitude)` (more with a bias), and
    /// the bias lowers the gain (eqs. 30-31).
    ///
    /// It takes the oscillation for a sinusoid. What that costs depends on how far the process suppresses the third
    /// and higher harmonics. Without hysteresis, exact oscillations against the true critical points:
    ///
    /// | process | K_u off by | T_u off by |
    /// |---|---|---|
    /// | `1/(s + 1)^3` | -2.4 % | +1.4 % |
    /// | `1/(s + 1)^4` | -1.8 % | +0.7 % |
    /// | `exp(-0.2 s)/(s (s + 1))` | -8.0 % | +5.5 % |
    /// | `exp(-s)/(s + 1)` | -10.9 % | -3.8 % |
    /// | `exp(-s)/s` | -18.9 % (`8/pi^2`) | exact |
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] for a level, half-width, amplitude or period outside its domain, and for a result that the
    /// arithmetic cannot represent; [`ControlError::BelowSwitching`] where condition 40 fails.
    pub fn point(&self) -> Result<FrequencyPoint<T>, ControlError> {
        let zero = T::zero();
        domain::positive("relay level", self.level, "command units")?;
        domain::non_negative("half-width", self.half_width, "output units")?;
        domain::positive("amplitude", self.amplitude, "output units")?;
        domain::finite("bias", self.bias, "output units")?;
        domain::positive("period", self.period_s, "s")?;
        let below = ControlError::BelowSwitching {
            amplitude: self.amplitude.value(),
            bias: self.bias.value(),
            half_width: self.half_width.value(),
        };
        let relay = RelayHysteresis::new(self.level, self.half_width, zero).map_err(|_| below)?;
        let sweep = Sinusoid::new(self.bias, self.amplitude).map_err(|_| below)?;
        let n = relay.describing_function(&sweep).map_err(|_| below)?;
        let size = (n.p.square() + n.q.square()).sqrt();
        // -1/N has the angle pi less that of N, which is a lag.
        let lag = T::pi() / T::two() - (n.p / -n.q).atan();
        let angle_above_critical = if n.q < zero { lag } else { zero };
        let frequency = T::two() * T::pi() / self.period_s;
        let positive = |quantity, value, unit| domain::require(quantity, value, unit, Limit::Positive, domain::UNITS);
        Ok(FrequencyPoint {
            omega_rad_s: positive("frequency of the oscillation", frequency, "rad/s")?,
            magnitude: positive("gain of the process", T::one() / size, "output per command units")?,
            angle_above_critical: domain::representable("angle of the process", angle_above_critical, "rad")?,
        })
    }

    /// The point of this one experiment taken for the critical one, as the ATV method does: `K_u = |N|`, and the
    /// period as it is. With hysteresis the real critical frequency is higher, by as much as the process needs to lag
    /// by `asin(half_width/amplitude)` more; a second experiment tells ([`UltimatePoint::between`]).
    ///
    /// ```
    /// use selfosc::control::RelayTest;
    /// // exp(-s)/s under an ideal relay: a triangle of amplitude 1 and period 4 (exactly T_u), K_u = pi/2.
    /// let test = RelayTest { level: 1.0, half_width: 0.0, amplitude: 1.0, bias: 0.0, period_s: 4.0 };
    /// let ultimate = test.ultimate()?;
    /// let share = ultimate.gain() / core::f64::consts::FRAC_PI_2;
    /// assert!((share - 8.0 / core::f64::consts::PI.powi(2)).abs() < 1e-15); // the triangle is no sine
    /// # Ok::<(), selfosc::control::ControlError>(())
    /// ```
    ///
    /// # Errors
    /// As [`point`](Self::point).
    pub fn ultimate(&self) -> Result<UltimatePoint<T>, ControlError> {
        UltimatePoint::new(T::one() / self.point()?.magnitude, self.period_s)
    }
}

/// The critical point of a transfer function: the crossover of `-180` degrees with the largest gain, between two
/// frequencies in rad/s.
///
/// Crossovers are looked for between 2000 points evenly spaced in the logarithm, closer where the delay turns faster;
/// two between neighbouring points are missed.
///
/// ```
/// use selfosc::control::critical_point;
/// use selfosc::plant::TransferFunction;
/// let ultimate = critical_point(&TransferFunction::new(&[1.0], &[1.0, 3.0, 3.0, 1.0])?, 0.01..=100.0)?;
/// assert!((ultimate.gain() - 8.0).abs() < 1e-12);
/// assert!((ultimate.period_s() - core::f64::consts::TAU / 3f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ControlError::NoCriticalPoint`]; [`ControlError::OutOfDomain`] unless `0 < from < to`, both finite.
#[cfg(feature = "std")]
pub fn critical_point(
    plant: &crate::plant::TransferFunction,
    omega_rad_s: core::ops::RangeInclusive<f64>,
) -> Result<UltimatePoint<f64>, ControlError> {
    use crate::numeric::scan;
    const POINTS: i32 = 2000;
    let (from, to) = omega_rad_s.into_inner();
    domain::positive("lowest frequency", from, "rad/s")?;
    domain::require("highest frequency", to, "rad/s", Limit::Above(from), "give the range with the lower end first")?;
    let ratio = libm::pow(to / from, 1.0 / f64::from(POINTS));
    let mut nodes = vec![from];
    while let Some(&last) = nodes.last().filter(|last| **last < to && nodes.len() < 1_000_000) {
        nodes.push((last * ratio).min(last + 0.2 / plant.delay_s().max(f64::MIN_POSITIVE)).min(to));
    }
    let response = |omega: f64| plant.response(omega).ok();
    let real = scan::roots(&nodes, &mut |omega| response(omega).map(|g| g.im / g.norm()));
    let largest = real
        .into_iter()
        .filter_map(|omega| Some((omega, response(omega)?.re)))
        .filter(|(_, re)| *re < 0.0)
        .min_by(|a, b| a.1.total_cmp(&b.1));
    let (omega, re) = largest.ok_or(ControlError::NoCriticalPoint { from_rad_s: from, to_rad_s: to })?;
    UltimatePoint::new(-1.0 / re, core::f64::consts::TAU / omega)
}
