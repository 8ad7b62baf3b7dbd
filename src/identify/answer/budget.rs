//! The uncertainty budget: sources of error that no residual shows, and the shift of each.
//!
//! The record's scatter gives the statistical interval (type A of JCGM 100:2008, the GUM). A compass with hard iron or a thruster
//! whose thrust changes after a reversal moves the inertia and not the residuals: such sources have sizes that are
//! declared (type B).
//! The [practical half-width](super::practical) adds them.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::numeric::domain::require;
use crate::numeric::{Limit, OutOfDomain};

/// A source of error that no residual shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorSource {
    /// Scale of the sensor.
    SensorGain,
    /// Scale of the time stamps.
    Clock,
    /// Heading error of a single cycle per turn, as by hard iron near a compass.
    HeadingError,
    /// Thrust after a reversal that differs from steady thrust, as the propeller's own wash makes.
    ThrustDynamics,
}

/// The shift by a unit of a source, in percent.
pub(super) struct Shares {
    /// Scale of the output, and of time: they move every parameter by the power that its unit has of them.
    pub(super) output: f64,
    pub(super) time: f64,
    /// Of the inertia.
    pub(super) alpha: f64,
    /// Of the drag force at the record's top speed.
    pub(super) drag: f64,
    /// Constant force, of the command's level.
    pub(super) delta: f64,
    /// Delay, of half the period.
    pub(super) delay: f64,
}

/// Shares of the trial: medians over 24 simulated vehicles, seeds 5530000 to 5530023, made by `tests/trust/budget.py`.
const HEADING_ERROR: Shares = Shares { output: 0.0, time: 0.0, alpha: 1.4, drag: 8.8, delta: 1.3, delay: 0.11 };
const THRUST_DYNAMICS: Shares = Shares { output: 0.0, time: 0.0, alpha: 0.45, drag: 0.93, delta: 0.001, delay: 0.004 };
/// Exact: the record of `(1 + e) x` or of `(1 + e) t` is a record of the same model with scaled parameters.
const SENSOR_GAIN: Shares = Shares { output: 1.0, time: 0.0, alpha: 0.0, drag: 0.0, delta: 0.0, delay: 0.0 };
const CLOCK: Shares = Shares { output: 0.0, time: 1.0, alpha: 0.0, drag: 0.0, delta: 0.0, delay: 0.0 };

impl ErrorSource {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::SensorGain, Self::Clock, Self::HeadingError, Self::ThrustDynamics];

    /// Name on the command line and in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SensorGain => "sensor-gain",
            Self::Clock => "clock",
            Self::HeadingError => "heading-error",
            Self::ThrustDynamics => "thrust-dynamics",
        }
    }

    /// Unit of its size.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::HeadingError => "degree",
            Self::SensorGain | Self::Clock | Self::ThrustDynamics => "%",
        }
    }

    /// What makes it smaller.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        match self {
            Self::SensorGain => "calibrate the sensor against a known distance or full turns",
            Self::Clock => "log the stamps of the autopilot's own clock",
            Self::HeadingError => "swing the compass, or log an integrated gyroscope",
            Self::ThrustDynamics => "record a second relay level, or a longer period",
        }
    }

    pub(super) fn shares(self) -> Shares {
        match self {
            Self::SensorGain => SENSOR_GAIN,
            Self::Clock => CLOCK,
            Self::HeadingError => HEADING_ERROR,
            Self::ThrustDynamics => THRUST_DYNAMICS,
        }
    }
}

/// Sizes of the sources: each the half-width of a 95 % interval. The default is of a calibrated vehicle.
///
/// ```
/// use selfosc::identify::{Assumptions, ErrorSource};
/// let uncalibrated = Assumptions { heading_error_deg: 1.0, ..Assumptions::default() };
/// assert_eq!(uncalibrated.size(ErrorSource::HeadingError), 1.0);
/// assert_eq!(Assumptions::NONE.size(ErrorSource::Clock), 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Assumptions {
    /// Scale error of the sensor, in percent.
    #[serde(rename = "sensor-gain")]
    pub sensor_gain_percent: f64,
    /// Scale error of the time stamps, in percent.
    #[serde(rename = "clock")]
    pub clock_percent: f64,
    /// Amplitude of the heading error of a single cycle per turn, in degrees. It counts for headings alone.
    #[serde(rename = "heading-error")]
    pub heading_error_deg: f64,
    /// Difference of the thrust after a reversal from steady thrust, in percent of steady thrust.
    #[serde(rename = "thrust-dynamics")]
    pub thrust_dynamics_percent: f64,
}

/// The sources of the sizes are in spec/conventions.md.
impl Default for Assumptions {
    fn default() -> Self {
        Self {
            sensor_gain_percent: 0.5,
            clock_percent: 0.25,
            heading_error_deg: 1.0 / 3.0,
            thrust_dynamics_percent: 1.0,
        }
    }
}

impl Assumptions {
    /// No source: the practical intervals are twice as wide as the statistical intervals.
    pub const NONE: Self =
        Self { sensor_gain_percent: 0.0, clock_percent: 0.0, heading_error_deg: 0.0, thrust_dynamics_percent: 0.0 };

    /// Size of a source, in its [unit](ErrorSource::unit).
    #[must_use]
    pub fn size(&self, source: ErrorSource) -> f64 {
        match source {
            ErrorSource::SensorGain => self.sensor_gain_percent,
            ErrorSource::Clock => self.clock_percent,
            ErrorSource::HeadingError => self.heading_error_deg,
            ErrorSource::ThrustDynamics => self.thrust_dynamics_percent,
        }
    }

    /// With another size of a source.
    #[must_use]
    pub fn with(mut self, source: ErrorSource, size: f64) -> Self {
        *match source {
            ErrorSource::SensorGain => &mut self.sensor_gain_percent,
            ErrorSource::Clock => &mut self.clock_percent,
            ErrorSource::HeadingError => &mut self.heading_error_deg,
            ErrorSource::ThrustDynamics => &mut self.thrust_dynamics_percent,
        } = size;
        self
    }

    /// For outputs that are no headings: depth, position.
    pub(crate) fn without_heading(self) -> Self {
        self.with(ErrorSource::HeadingError, 0.0)
    }

    /// Whether every size is finite and not negative.
    pub(crate) fn check(&self) -> Result<(), OutOfDomain> {
        ErrorSource::ALL.into_iter().try_for_each(|source| {
            let remedy = "give 0 for a source that does not act";
            require("size of a source of error", self.size(source), source.unit(), Limit::NonNegative, remedy)
                .map(|_| ())
        })
    }
}

/// A line of the budget.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BudgetEntry {
    /// Name of the [source](ErrorSource).
    pub source: Cow<'static, str>,
    /// Size assumed.
    pub size: f64,
    /// Its unit.
    pub unit: Cow<'static, str>,
    /// Half-width of the inertia's interval by this source alone, in percent of the inertia.
    pub share_percent: f64,
    /// What makes it smaller.
    pub remedy: Cow<'static, str>,
}

#[cfg(test)]
mod tests {
    use super::{Assumptions, ErrorSource};

    #[test]
    fn sizes_are_finite_and_not_negative() {
        assert!(Assumptions::default().check().is_ok() && Assumptions::NONE.check().is_ok());
        for size in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(ErrorSource::ALL.into_iter().all(|source| Assumptions::NONE.with(source, size).check().is_err()));
        }
    }
}
