//! What every process of a box is to have.

/// A criterion of a loop, with its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RobustCriterion {
    /// `|1/(1 + L)|` is below this at every frequency.
    Sensitivity(f64),
    /// Stable with every gain from its own to this factor of it.
    Gain(f64),
    /// Stable with every gain from its own to this part of it.
    GainReduction(f64),
    /// Stable with up to so much more lag, or lead, of phase, rad.
    PhaseRad(f64),
    /// Stable with up to so much more delay, s.
    DelayS(f64),
}

impl RobustCriterion {
    /// Its number.
    #[must_use]
    pub fn number(self) -> f64 {
        match self {
            Self::Sensitivity(number)
            | Self::Gain(number)
            | Self::GainReduction(number)
            | Self::PhaseRad(number)
            | Self::DelayS(number) => number,
        }
    }

    /// Whether a loop with this number has at least the criterion's margin.
    #[must_use]
    pub fn is_met_by(self, number: f64) -> bool {
        match self {
            Self::Sensitivity(most) => number <= most,
            _ => number >= self.number(),
        }
    }
}
