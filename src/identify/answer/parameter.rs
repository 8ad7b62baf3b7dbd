//! The parameters of a drag axis, and its delay, given or to be estimated.

/// A parameter that all experiments share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AxisParameter {
    /// Inertia with added mass alpha.
    Alpha,
    /// Linear drag beta_1.
    LinearDrag,
    /// Quadratic drag beta_2.
    QuadraticDrag,
    /// Delay of the whole loop, in seconds.
    DelayS,
}

impl AxisParameter {
    /// How many there are.
    pub(crate) const COUNT: usize = 4;

    /// Name in a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Alpha => "inertia",
            Self::LinearDrag => "linear drag",
            Self::QuadraticDrag => "quadratic drag",
            Self::DelayS => "delay",
        }
    }
}

/// The treatment of the delay.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Delay {
    /// It is given, in seconds.
    KnownS(f64),
    /// It is estimated with the parameters of motion, zero or more.
    #[default]
    Estimated,
}
