//! Classic tuning rules from the ultimate gain and period.

use super::{ControlError, Gains, Structure, UltimatePoint};
use crate::numeric::Scalar;

/// A rule of the literature. They are for stable processes with lag and dead time, tell nothing of margins, and differ
/// in how brisk they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// `K_u/2` (Ziegler and Nichols, 1942): decay to a quarter in each oscillation.
    ZieglerNicholsP,
    /// `0.45 K_u`, `T_i = T_u/1.2` (the same).
    ZieglerNicholsPi,
    /// `0.6 K_u`, `T_i = T_u/2`, `T_d = T_u/8` (the same).
    ZieglerNicholsPid,
    /// `K_u/3.2`, `T_i = 2.2 T_u` (Tyreus and Luyben, 1992): for integrating processes with dead time.
    TyreusLuybenPi,
    /// `K_u/2.2`, `T_i = 2.2 T_u`, `T_d = T_u/6.3` (the same).
    TyreusLuybenPid,
    /// `K_u/3`, `T_i = T_u/2`, `T_d = T_u/3`: some overshoot (Perry and Chilton, 1973; Seborg, Edgar and Mellichamp).
    SomeOvershoot,
    /// `K_u/5`, `T_i = T_u/2`, `T_d = T_u/3`: none (the same).
    NoOvershoot,
}

impl Rule {
    /// Every rule.
    pub const ALL: [Self; 7] = [
        Self::ZieglerNicholsP,
        Self::ZieglerNicholsPi,
        Self::ZieglerNicholsPid,
        Self::TyreusLuybenPi,
        Self::TyreusLuybenPid,
        Self::SomeOvershoot,
        Self::NoOvershoot,
    ];

    /// Gain over `K_u`, integral time over `T_u` (`None` for no integral), derivative time over `T_u`.
    #[must_use]
    pub fn factors(self) -> (f64, Option<f64>, f64) {
        match self {
            Self::ZieglerNicholsP => (0.5, None, 0.0),
            Self::ZieglerNicholsPi => (0.45, Some(1.0 / 1.2), 0.0),
            Self::ZieglerNicholsPid => (0.6, Some(0.5), 0.125),
            Self::TyreusLuybenPi => (1.0 / 3.2, Some(2.2), 0.0),
            Self::TyreusLuybenPid => (1.0 / 2.2, Some(2.2), 1.0 / 6.3),
            Self::SomeOvershoot => (1.0 / 3.0, Some(0.5), 1.0 / 3.0),
            Self::NoOvershoot => (0.2, Some(0.5), 1.0 / 3.0),
        }
    }

    /// Gains by this rule, the derivative filtered with a tenth of the derivative time.
    ///
    /// ```
    /// use selfosc::control::{Rule, UltimatePoint};
    /// // 1/(s + 1)^3 oscillates at K_u = 8 with sqrt(3) rad/s.
    /// let ultimate = UltimatePoint::new(8.0_f64, 3.6276)?;
    /// let gains = Rule::ZieglerNicholsPid.gains(&ultimate)?;
    /// assert!((gains.proportional() - 4.8).abs() < 1e-12);
    /// assert!((gains.integral() - 4.8 / 1.8138).abs() < 1e-12);
    /// # Ok::<(), selfosc::control::ControlError>(())
    /// ```
    ///
    /// # Errors
    /// None in practice: gains of a positive finite point are; only at the ends of the arithmetic's range are they not.
    pub fn gains<T: Scalar>(self, ultimate: &UltimatePoint<T>) -> Result<Gains<T>, ControlError> {
        let (gain, integral, derivative) = self.factors();
        let (gain, period_s) = (T::from_f64(gain) * ultimate.gain(), ultimate.period_s());
        let derivative_s = T::from_f64(derivative) * period_s;
        let (structure, per_second) = match integral {
            Some(share) => (Structure::Pid, gain / (T::from_f64(share) * period_s)),
            None => (Structure::Pd, T::zero()),
        };
        Gains::new(structure, gain, per_second, gain * derivative_s, T::from_f64(0.1) * derivative_s)
    }
}
