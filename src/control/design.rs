//! Gains from an identified axis and a requested bandwidth, by pole placement.

use super::{ControlError, Gains, Margins, OpenLoop, Structure};
use crate::numeric::{Limit, Scalar, domain};
use crate::plant::DragAxis;

/// The filter on the derivative is this much faster than the closed loop's double pole.
const FILTER: f64 = 0.1;

impl Structure {
    /// The slow pole of the closed loop as a share of the double one. An integral action ten times slower than the
    /// rest is the marine craft literature's choice (Fossen, *Handbook of Marine Craft Hydrodynamics and Motion
    /// Control*, PID by pole placement); I-PD takes all three poles together.
    pub(crate) fn slow_pole(self) -> f64 {
        match self {
            Self::Pd => 0.0,
            Self::Pid => 0.1,
            Self::Ipd => 1.0,
        }
    }

    /// Bandwidth over the place of the double pole, for an ideal derivative and no delay: where `|x/r|^2` is one half.
    ///
    /// `1/(1 + y)^2 = 1/2` for PD, `1/(1 + y)^3 = 1/2` for I-PD, and for PID, whose proportional action adds a zero,
    /// the positive root of `(1 + y)^2 (c^2 + y) = 2 ((1 + 2c)^2 y + c^2)` with c = 0.1; the ratio is the root of y.
    #[must_use]
    pub fn bandwidth_ratio(self) -> f64 {
        match self {
            Self::Pd => 0.643_594_252_905_582_7,
            Self::Pid => 0.832_686_072_787_830_5,
            Self::Ipd => 0.509_824_528_533_958_7,
        }
    }
}

/// A controller designed for an axis, with the margins it has there.
///
/// The closed loop without delay gets the poles `(s + w)^2 (s + c w)(s + p)`: w from the bandwidth, c = 0, 0.1, 1 for
/// PD, PID, I-PD, and p the pole that the filter adds, about `8/w`, which the design takes into account. Drag enters
/// with a slope, `d`: that at rest, `beta_1`, the least there is, since quadratic drag only damps more. With `f` the filter's
/// time constant and `q = alpha (1 - (2 + c) w f) + d f`, `K_i = q c w^3`, `K_p + K_i f = alpha f c w^3 + q (1 + 2c)
/// w^2`, `K_d + K_p f = alpha f (1 + 2c) w^2 + q (2 + c) w - d`.
///
/// The bandwidth is that of the answer to the reference, at -3 dB. Filter and delay move it; the filter by less than
/// 0.5 %.
///
/// ```
/// use selfosc::control::{Structure, Tuning};
/// use selfosc::plant::DragAxis;
/// let yaw = DragAxis::mixed(0.033, 0.01, 0.06)?.with_delay_s(0.2)?;
/// let tuning = Tuning::new(&yaw, Structure::Pd, 0.8)?;
/// assert!(tuning.margins().phase_rad > 0.5 && tuning.gains().proportional() > 0.0);
/// assert!(Tuning::new(&yaw, Structure::Pd, 8.0).is_err()); // the delay forbids it
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "std",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Wanted<T>", bound(deserialize = "T: Scalar + serde::Deserialize<'de>"))
)]
pub struct Tuning<T> {
    axis: DragAxis<T>,
    slope: T,
    bandwidth_rad_s: T,
    gains: Gains<T>,
    margins: Margins<T>,
}

/// What a written design was made for; it is made again, so that its margins are those of its gains.
#[cfg(feature = "std")]
#[derive(serde::Deserialize)]
#[serde(bound(deserialize = "T: Scalar + serde::Deserialize<'de>"))]
struct Wanted<T> {
    axis: DragAxis<T>,
    slope: T,
    bandwidth_rad_s: T,
    gains: Gains<T>,
}

#[cfg(feature = "std")]
impl<T: Scalar> TryFrom<Wanted<T>> for Tuning<T> {
    type Error = ControlError;

    fn try_from(wanted: Wanted<T>) -> Result<Self, ControlError> {
        Self::for_slope(&wanted.axis, wanted.slope, wanted.gains.structure(), wanted.bandwidth_rad_s)
    }
}

impl<T: Scalar> Tuning<T> {
    /// Least gain margin a design may have, as a factor (6 dB).
    pub const LEAST_GAIN_MARGIN: f64 = 2.0;
    /// Least phase margin a design may have, in degrees. Both are the usual lower ends (Astrom and Hagglund, *Advanced
    /// PID Control*).
    pub const LEAST_PHASE_MARGIN_DEG: f64 = 30.0;

    /// Designs for an axis at rest, and checks the margins there, delay and filter included.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the bandwidth is positive and finite; [`ControlError::Overdamped`] below the
    /// bandwidth at which drag alone damps more than the design; [`ControlError::TooFast`] above that at which the
    /// margins fall below the least ones; [`ControlError::NoBandwidth`] where the two leave none.
    pub fn new(axis: &DragAxis<T>, structure: Structure, bandwidth_rad_s: T) -> Result<Self, ControlError> {
        Self::for_slope(axis, axis.linear_drag(), structure, bandwidth_rad_s)
    }

    /// Designs for a drag that may be less than the axis' own: for the least slope that it may have, below zero where it drives. Every
    /// larger slope damps more and answers slower than the bandwidth. The margins are those of the axis.
    ///
    /// ```
    /// use selfosc::control::{Structure, Tuning};
    /// use selfosc::plant::DragAxis;
    /// let yaw = DragAxis::mixed(0.033, 0.01, 0.06)?.with_delay_s(0.2)?;
    /// let (known, uncertain) = (Tuning::new(&yaw, Structure::Pd, 0.5)?, Tuning::for_slope(&yaw, -0.005, Structure::Pd, 0.5)?);
    /// assert!(uncertain.gains().derivative() > known.gains().derivative());
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new); [`ControlError::OutOfDomain`] unless the slope is finite.
    pub fn for_slope(
        axis: &DragAxis<T>,
        slope: T,
        structure: Structure,
        bandwidth_rad_s: T,
    ) -> Result<Self, ControlError> {
        domain::positive("bandwidth", bandwidth_rad_s, "rad/s")?;
        domain::finite("slope of the drag", slope, "F s/x")?;
        let body = Body { alpha: axis.alpha(), slope };
        let least = body.least_bandwidth(structure);
        if bandwidth_rad_s < least {
            let (bandwidth_rad_s, least_rad_s) = (bandwidth_rad_s.value(), least.value());
            // A least bandwidth that the delay forbids is no remedy.
            return match Self::for_slope(axis, slope, structure, least) {
                Err(none @ ControlError::NoBandwidth { .. }) => Err(none),
                _ => Err(ControlError::Overdamped { bandwidth_rad_s, least_rad_s }),
            };
        }
        let gains = body.place(structure, bandwidth_rad_s)?;
        if let Some(margins) = sufficient(axis, &gains) {
            return Ok(Self { axis: *axis, slope, bandwidth_rad_s, gains, margins });
        }
        let delay_s = axis.delay_s().value();
        let most = body.most_bandwidth(axis, structure, bandwidth_rad_s);
        if most < least || most == T::zero() {
            let (least_rad_s, most_rad_s) = (least.value(), most.value());
            return Err(ControlError::NoBandwidth { delay_s, least_rad_s, most_rad_s });
        }
        let (bandwidth_rad_s, most_rad_s) = (bandwidth_rad_s.value(), most.value());
        Err(ControlError::TooFast { bandwidth_rad_s, delay_s, most_rad_s })
    }

    /// The axis designed for.
    pub fn axis(&self) -> &DragAxis<T> {
        &self.axis
    }
    /// The slope of the drag that the poles are placed for, F s/x.
    pub fn slope(&self) -> T {
        self.slope
    }
    /// The bandwidth asked for, rad/s.
    pub fn bandwidth_rad_s(&self) -> T {
        self.bandwidth_rad_s
    }
    /// The double pole's distance from zero, rad/s.
    pub fn double_pole_rad_s(&self) -> T {
        double_pole(self.gains.structure(), self.bandwidth_rad_s)
    }
    /// The gains.
    pub fn gains(&self) -> &Gains<T> {
        &self.gains
    }
    /// The margins at rest.
    pub fn margins(&self) -> &Margins<T> {
        &self.margins
    }
}

pub(crate) fn double_pole<T: Scalar>(structure: Structure, bandwidth: T) -> T {
    bandwidth / T::from_f64(structure.bandwidth_ratio())
}

/// Inertia and slope of the drag that the poles are placed for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<T> {
    pub(crate) alpha: T,
    pub(crate) slope: T,
}

impl<T: Scalar> Body<T> {
    /// Gains that place the poles; the derivative gain is negative below the least bandwidth.
    fn unchecked(&self, structure: Structure, bandwidth: T) -> [T; 4] {
        let (one, two) = (T::one(), T::two());
        let (c, w) = (T::from_f64(structure.slow_pole()), double_pole(structure, bandwidth));
        let (Self { alpha, slope }, filter) = (*self, T::from_f64(FILTER) / w);
        let (sum, products) = ((two + c) * w, (one + two * c) * w.square());
        let cube = c * w * w.square();
        let q = alpha * (one - sum * filter) + slope * filter;
        let integral = q * cube;
        let proportional = alpha * filter * cube + q * products - integral * filter;
        let derivative = alpha * filter * products + q * sum - slope - proportional * filter;
        [proportional, integral, derivative, filter]
    }

    pub(crate) fn place(&self, structure: Structure, bandwidth: T) -> Result<Gains<T>, ControlError> {
        let [proportional, integral, derivative, filter] = self.unchecked(structure, bandwidth);
        let gives = proportional > T::zero() && proportional.is_finite() && filter.is_finite();
        let limit = Limit::Words("such that the gains are neither 0 nor beyond the largest number");
        let remedy = "check the units of inertia and bandwidth";
        domain::require_that(gives, "bandwidth", bandwidth, "rad/s", limit, remedy)?;
        // Rounding at the least bandwidth itself.
        Gains::new(structure, proportional, integral, derivative.max(T::zero()), filter)
    }

    /// The bandwidth at which the derivative gain is zero, and zero for a slope below: that gain over `alpha w` is a straight line
    /// in `slope/(alpha w)`.
    fn least_bandwidth(&self, structure: Structure) -> T {
        let ratio = T::from_f64(structure.bandwidth_ratio());
        let derivative = |slope| Self { alpha: T::one(), slope }.unchecked(structure, ratio)[2];
        let (without, with) = (derivative(T::zero()), derivative(T::one()));
        (self.slope / self.alpha * (without - with) / without * ratio).max(T::zero())
    }

    /// The largest bandwidth below one that is too large whose margins suffice, to 1 %; zero where none does in thirty halvings.
    fn most_bandwidth(&self, axis: &DragAxis<T>, structure: Structure, too_large: T) -> T {
        let suffices =
            |bandwidth| self.place(structure, bandwidth).is_ok_and(|gains| sufficient(axis, &gains).is_some());
        let (mut lower, mut upper) = (too_large, too_large);
        for _ in 0..30 {
            lower = lower / T::two();
            if suffices(lower) {
                break;
            }
            upper = lower;
        }
        if upper == lower {
            return T::zero();
        }
        while upper - lower > T::from_f64(0.01) * upper {
            let middle = (lower + upper) / T::two();
            if suffices(middle) { lower = middle } else { upper = middle }
        }
        lower
    }
}

/// The margins, if they are at least the least ones.
fn sufficient<T: Scalar>(axis: &DragAxis<T>, gains: &Gains<T>) -> Option<Margins<T>> {
    let margins = OpenLoop::new(axis, gains, T::zero()).ok()?.margins().ok()?;
    let least = |margin: Option<T>| margin.is_none_or(|m| m >= T::from_f64(Tuning::<T>::LEAST_GAIN_MARGIN));
    let phase = margins.phase_rad >= T::from_f64(Tuning::<T>::LEAST_PHASE_MARGIN_DEG.to_radians());
    (phase && least(margins.gain) && least(margins.gain_reduction)).then_some(margins)
}
