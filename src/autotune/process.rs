//! Structures of processes, and the record's answer: parameters with their intervals.

use super::{ProcessError, fit};
use crate::experiment::Record;

/// Structure of a process.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// `K exp(-L s)/(T s + 1)`.
    FirstOrder,
    /// `K exp(-L s)/((T s + 1)(T_2 s + 1))`.
    SecondOrder,
    /// `K exp(-L s)/(T s + 1)^2`.
    EqualLags,
    /// `K (T_z s + 1) exp(-L s)/((T s + 1)(T_2 s + 1))`.
    SecondOrderZero,
    /// `K exp(-L s)/s`.
    Integrator,
    /// `K exp(-L s)/(s (T s + 1))`.
    IntegratorLag,
}

impl Family {
    /// Every structure.
    pub const ALL: [Self; 6] = [
        Self::FirstOrder,
        Self::SecondOrder,
        Self::EqualLags,
        Self::SecondOrderZero,
        Self::Integrator,
        Self::IntegratorLag,
    ];

    /// Name in JSON and in text.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FirstOrder => "first-order",
            Self::SecondOrder => "second-order",
            Self::EqualLags => "equal-lags",
            Self::SecondOrderZero => "second-order-zero",
            Self::Integrator => "integrator",
            Self::IntegratorLag => "integrator-lag",
        }
    }

    /// Whether a constant command moves the output for ever.
    #[must_use]
    pub fn integrates(self) -> bool {
        matches!(self, Self::Integrator | Self::IntegratorLag)
    }

    /// Structures that this becomes where a lag or the zero is 0, lags are equal, or a lag is longer than any record.
    pub(super) fn limits(self) -> &'static [Self] {
        match self {
            Self::EqualLags | Self::Integrator => &[],
            Self::FirstOrder | Self::IntegratorLag => &[Self::Integrator],
            Self::SecondOrder => &[Self::FirstOrder, Self::EqualLags, Self::IntegratorLag],
            Self::SecondOrderZero => &[Self::FirstOrder, Self::EqualLags, Self::SecondOrder, Self::IntegratorLag],
        }
    }

    /// Names of the parameters, in the order of [`ProcessModel::parameters`].
    #[must_use]
    pub fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::FirstOrder | Self::EqualLags | Self::IntegratorLag => &["gain", "dead_time_s", "time_constant_s"],
            Self::SecondOrder => &["gain", "dead_time_s", "time_constant_s", "second_time_constant_s"],
            Self::SecondOrderZero => {
                &["gain", "dead_time_s", "time_constant_s", "second_time_constant_s", "zero_time_constant_s"]
            }
            Self::Integrator => &["gain", "dead_time_s"],
        }
    }
}

/// A number with its standard deviation and its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ranged {
    /// Best estimate.
    pub value: f64,
    /// Standard deviation.
    pub std: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// A structure with its parameters as a record determines them.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessModel {
    /// The structure.
    pub family: Family,
    /// Its share of the evidence among all structures, by the Bayesian information criterion.
    pub weight: f64,
    /// Gain, dead time, time constants, as [`Family::parameters`] names them.
    pub parameters: Vec<Ranged>,
    /// `alpha, drag, stiffness, zero_s, delay_s` of `(zero_s s + 1) exp(-delay_s s)/(alpha s^2 + drag s + stiffness)` for a gain above
    /// zero: these depend on each other far less than gain and time constants do.
    pub coefficients: [Ranged; 5],
    /// Covariance of these.
    pub covariance: [[f64; 5]; 5],
}

/// How a record shows that no linear process answers its command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contradiction {
    /// The output moves before the changes of the command as for a process of the other sign: command and output do not belong
    /// together, such as a thermostat's wish that a lockout holds back.
    AgainstRelay,
    /// The output stands at its extreme as no model does: a sensor at the end of its range.
    Saturated,
}

/// The structures that a record leaves, the likeliest first.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessRecord {
    /// With weights above [`LEAST_WEIGHT`](Self::LEAST_WEIGHT).
    pub models: Vec<ProcessModel>,
    /// Whether the output falls with the command.
    pub reverse: bool,
    /// Why the record is none of a linear process, where it shows so.
    pub contradiction: Option<Contradiction>,
    /// Root mean square of the residuals, output units.
    pub residual: f64,
    /// The last [`samples`](Self::samples) readings less what the likeliest structure predicts of each from the readings before, output
    /// units: the innovations under a load that wanders.
    pub residuals: Vec<f64>,
    /// Correlation of neighbouring errors under a load that is constant.
    pub correlation: f64,
    /// Samples used.
    pub samples: usize,
    /// Changes of the command.
    pub changes: usize,
}

impl ProcessRecord {
    /// A structure with less weight is left out.
    pub const LEAST_WEIGHT: f64 = 0.02;

    /// Identifies a process from a record with at least [`ProcessError::LEAST_CHANGES`] changes of the command.
    ///
    /// ```
    /// use selfosc::experiment::Record;
    /// use selfosc::autotune::{Family, ProcessRecord};
    /// // 2/(5 s + 1) after 1 s under a square wave of period 8 s, read at 10 Hz.
    /// let (mut time, mut output, mut input, mut y) = (vec![], vec![], vec![], 0.0_f64);
    /// let command = |t: f64| f64::from(u8::from(t.rem_euclid(8.0) < 4.0));
    /// for k in 0..600 {
    ///     let t = f64::from(k) * 0.1;
    ///     time.push(t);
    ///     output.push((y * 200.0).round() / 200.0);
    ///     input.push(command(t));
    ///     let u = 2.0 * command(t - 1.0 + 1e-9);
    ///     y = u + (y - u) * (-0.1_f64 / 5.0).exp();
    /// }
    /// let found = ProcessRecord::of(&Record::new(time, output, input)?)?;
    /// let best = &found.models[0];
    /// assert_eq!(best.family, Family::FirstOrder);
    /// assert!((best.parameters[0].value - 2.0).abs() < 0.05 && (best.parameters[1].value - 1.0).abs() < 0.05);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ProcessError`].
    pub fn of(record: &Record) -> Result<Self, ProcessError> {
        fit::fit(record)
    }
}
