//! Margins and peak of the sensitivity of a loop on a grid of frequencies, by floating point: to choose by, no proof.

use super::RobustCriterion;
use crate::control::Gains;
use crate::control::process::{LinearProcess, constants};

/// Margins and peak of the sensitivity of one loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figures {
    sensitivity: f64,
    gain: f64,
    gain_reduction: f64,
    phase_rad: f64,
    delay_s: f64,
}

/// Frequencies an octave, to judge by and to choose by; octaves below and above the highest frequency at which the gain may be one.
pub(super) const AN_OCTAVE: i32 = 40;
pub(super) const FEW: i32 = 12;
const BELOW: i32 = 16;
const ABOVE: i32 = 6;

impl Figures {
    /// Those of no loop at all.
    pub(super) const NONE: Self = Self {
        sensitivity: 1.0,
        gain: f64::INFINITY,
        gain_reduction: f64::INFINITY,
        phase_rad: f64::INFINITY,
        delay_s: f64::INFINITY,
    };

    pub(super) fn worse(self, other: Self) -> Self {
        Self {
            sensitivity: self.sensitivity.max(other.sensitivity),
            gain: self.gain.min(other.gain),
            gain_reduction: self.gain_reduction.min(other.gain_reduction),
            phase_rad: self.phase_rad.min(other.phase_rad),
            delay_s: self.delay_s.min(other.delay_s),
        }
    }

    pub(super) fn of(process: &LinearProcess<f64>, gains: &Gains<f64>, high: f64, an_octave: i32) -> Self {
        let open_loop = process.open_loop(constants(gains));
        let response = |omega: f64| open_loop.response(omega, process.delay_s);
        let (mut found, mut before) = (Self::NONE, None::<(f64, [f64; 2])>);
        for k in 0..=an_octave * (BELOW + ABOVE) {
            let omega = high * 2f64.powf(f64::from(k) / f64::from(an_octave) - f64::from(BELOW));
            let here = response(omega);
            found.sensitivity = found.sensitivity.max((1.0 + here[0]).hypot(here[1]).recip());
            if let Some((last, [last_re, last_im])) = before {
                let [re, im] = here;
                if last_im * im <= 0.0 && re < 0.0 && last_re < 0.0 {
                    let at = bisect(|omega| response(omega)[1], last, omega);
                    let size = response(at)[0].abs();
                    if size < 1.0 {
                        found.gain = found.gain.min(1.0 / size);
                    } else {
                        found.gain_reduction = found.gain_reduction.min(size);
                    }
                }
                let excess = |[re, im]: [f64; 2]| re.hypot(im) - 1.0;
                if excess([last_re, last_im]) * excess(here) <= 0.0 {
                    let at = bisect(|omega| excess(response(omega)), last, omega);
                    let [re, im] = response(at);
                    // Angle above critical, from 0 to a turn.
                    let above = (-im).atan2(-re).rem_euclid(core::f64::consts::TAU);
                    found.phase_rad = found.phase_rad.min(above.min(core::f64::consts::TAU - above));
                    found.delay_s = found.delay_s.min(above / at);
                }
            }
            before = Some((omega, here));
        }
        found
    }

    pub(super) fn number(&self, criterion: RobustCriterion) -> f64 {
        match criterion {
            RobustCriterion::Sensitivity(_) => self.sensitivity,
            RobustCriterion::Gain(_) => self.gain,
            RobustCriterion::GainReduction(_) => self.gain_reduction,
            RobustCriterion::PhaseRad(_) => self.phase_rad,
            RobustCriterion::DelayS(_) => self.delay_s,
        }
    }
}

/// A sign change between two frequencies, to rounding.
fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > f(low);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}
