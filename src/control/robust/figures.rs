//! Margins and peak of the sensitivity of a loop on a grid of frequencies, by floating point: to choose by, no proof.

use core::mem::discriminant;

use super::RobustCriterion;
use crate::control::Gains;
use crate::control::process::{LinearProcess, constants};

/// Of each criterion the worst number that was met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figures([RobustCriterion; 5]);

/// Frequencies an octave, to judge by and to choose by; octaves below and above the highest frequency at which the gain may be one.
pub(super) const AN_OCTAVE: i32 = 40;
pub(super) const FEW: i32 = 12;
const BELOW: i32 = 16;
const ABOVE: i32 = 6;

impl Figures {
    /// Those of no loop at all.
    pub(super) const NONE: Self = Self([
        RobustCriterion::Sensitivity(1.0),
        RobustCriterion::Gain(f64::INFINITY),
        RobustCriterion::GainReduction(f64::INFINITY),
        RobustCriterion::PhaseRad(f64::INFINITY),
        RobustCriterion::DelayS(f64::INFINITY),
    ]);

    /// The same after one more number was met.
    fn with(self, met: RobustCriterion) -> Self {
        let worse =
            |known: &RobustCriterion| discriminant(known) == discriminant(&met) && met.is_met_by(known.number());
        Self(self.0.map(|known| if worse(&known) { met } else { known }))
    }

    pub(super) fn worse(self, other: Self) -> Self {
        other.0.into_iter().fold(self, Self::with)
    }

    pub(super) fn of(process: &LinearProcess<f64>, gains: &Gains<f64>, high: f64, an_octave: i32) -> Self {
        let open_loop = process.open_loop(constants(gains));
        let response = |omega: f64| open_loop.response(omega, process.delay_s);
        let excess = |[re, im]: [f64; 2]| libm::hypot(re, im) - 1.0;
        let at = |k: i32| high * libm::pow(2f64, f64::from(k) / f64::from(an_octave) - f64::from(BELOW));
        let samples = (0..=an_octave * (BELOW + ABOVE)).map(|k| (at(k), response(at(k))));
        let (mut found, mut sensitivity, mut before) = (Self::NONE, 1.0_f64, None);
        for (omega, here) in samples {
            let [re, im] = here;
            sensitivity = sensitivity.max(libm::hypot(1.0 + re, im).recip());
            if let Some((last, [last_re, last_im])) = before.replace((omega, here)) {
                if last_im * im <= 0.0 && re < 0.0 && last_re < 0.0 {
                    let at = bisect(|omega| response(omega)[1], last, omega);
                    let size = response(at)[0].abs();
                    let gain = RobustCriterion::Gain(1.0 / size);
                    found = found.with(if size < 1.0 { gain } else { RobustCriterion::GainReduction(size) });
                }
                if excess([last_re, last_im]) * excess(here) <= 0.0 {
                    let at = bisect(|omega| excess(response(omega)), last, omega);
                    let [re, im] = response(at);
                    // Angle above critical, from 0 to a turn.
                    let above = libm::atan2(-im, -re).rem_euclid(core::f64::consts::TAU);
                    let phase_rad = above.min(core::f64::consts::TAU - above);
                    found = found.with(RobustCriterion::PhaseRad(phase_rad)).with(RobustCriterion::DelayS(above / at));
                }
            }
        }
        found.with(RobustCriterion::Sensitivity(sensitivity))
    }

    /// The worst number of this criterion.
    pub(super) fn number(&self, criterion: RobustCriterion) -> f64 {
        let known = self.0.iter().find(|known| discriminant(*known) == discriminant(&criterion));
        known.map_or(f64::NAN, |known| known.number())
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
