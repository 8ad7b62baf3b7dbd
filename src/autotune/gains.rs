//! Gains for every process that a record leaves: the smallest integral of the absolute error after a step of the load, under a limit
//! of the sensitivity that is proved for all of them.

use nalgebra::SMatrix;

use super::exchange::{GainExchange, ideal};
use super::{ProcessModel, ProcessRecord};
use crate::control::{Gains, LinearProcess, ProcessIntervals, RobustCriterion};
use crate::identify::NORMAL_95;
use crate::numeric::Interval;

/// Which actions the controller has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Actions {
    /// Proportional and integral.
    Pi,
    /// With derivative.
    Pid,
    /// With derivative where that takes a tenth off the integral of the absolute error.
    #[default]
    Best,
}

/// What gains are for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GainsWanted {
    /// Largest sensitivity of any process.
    pub sensitivity: f64,
    /// Actions of the controller.
    pub actions: Actions,
    /// Derivative time over the time constant of its filter.
    pub derivative_filter: f64,
}

impl Default for GainsWanted {
    fn default() -> Self {
        Self { sensitivity: 1.4, actions: Actions::Best, derivative_filter: 10.0 }
    }
}

/// Gains with what is proved of them.
#[derive(Clone, Debug, PartialEq)]
pub struct ProvedGains {
    /// For an output that rises with the command; of a reverse process all change their sign.
    pub gains: Gains<f64>,
    /// No process of the sets has a larger sensitivity.
    pub sensitivity: f64,
    /// The confidence set, structure by structure, the likeliest first. Over an ellipsoid the range of any one figure, such as the
    /// sensitivity under any gains, is its 95 % interval, as far as errors are normal and the figure is linear; it does not hold all
    /// parameters at once with 95 %. Where a proof over the ellipsoids takes too long, all are their hulls.
    pub sets: Vec<ProcessIntervals>,
}

/// A principal axis shorter than this is rounding: eigenvalues are exact to 1e-16 or so, and their roots to 1e-8.
const FLAT: f64 = 1e-6;
/// A derivative has to take off so much of the integral of the absolute error.
const WORTH: f64 = 0.9;
/// Steps back from the largest gain until the limit is proved, each so much.
const STEPS_BACK: i32 = 40;
const BACK: f64 = 0.99;

impl ProcessModel {
    /// The process in numbers, for a gain above zero.
    #[must_use]
    pub fn process(&self) -> LinearProcess<f64> {
        let [alpha, drag, stiffness, zero_s, delay_s] = self.coefficients.map(|part| part.value);
        let none = 0.0;
        LinearProcess {
            alpha,
            drag,
            stiffness,
            memory: none,
            memory_s: none,
            lag_s: none,
            filter_s: none,
            zero_s,
            delay_s,
        }
    }

    /// The processes of this structure within the record's errors: an ellipsoid of 1.96 standard deviations, whose projection on the
    /// gradient of a figure is that figure's 95 % interval. A controller that holds its command for `interval_s` adds half of that to
    /// the delay.
    fn processes(&self, interval_s: f64) -> Option<ProcessIntervals> {
        let std = self.coefficients.map(|part| part.std);
        let correlation =
            SMatrix::<f64, 5, 5>::from_fn(|i, j| self.covariance[i][j] / (std[i] * std[j]).max(f64::MIN_POSITIVE));
        let found = correlation.symmetric_eigen();
        let lengths = found.eigenvalues.iter().map(|square| square.max(0.0).sqrt());
        let long = lengths.zip(found.eigenvectors.column_iter()).filter(|(length, _)| *length > FLAT);
        let mut axes = [[0.0; 9]; 5];
        for (axis, (length, direction)) in axes.iter_mut().zip(long) {
            let [alpha, drag, stiffness, zero_s, delay_s] =
                core::array::from_fn(|k| NORMAL_95 * length * direction[k] * std[k]);
            let none = 0.0;
            *axis = [alpha, drag, stiffness, none, none, none, none, zero_s, delay_s];
        }
        let mut process = self.process();
        process.delay_s += 0.5 * interval_s;
        let found = ProcessIntervals::ellipsoid(process.parts(), axes).ok();
        found.filter(|found| found.process().drag.is_positive())
    }
}

/// Ultimate gain and frequency, rad/s: where the phase passes -pi; `None` where it does not.
#[must_use]
pub fn ultimate(process: &LinearProcess<f64>) -> Option<[f64; 2]> {
    let LinearProcess { alpha, drag, stiffness, zero_s, delay_s, .. } = *process;
    let lag = |omega: f64| {
        libm::atan2(drag * omega, stiffness - alpha * omega * omega) + omega * delay_s
            - libm::atan(zero_s * omega)
            - core::f64::consts::PI
    };
    let (mut low, mut high) = (0.0, 1.0 / (delay_s + (alpha / drag).abs()).max(f64::MIN_POSITIVE));
    for _ in 0..60 {
        if lag(high) > 0.0 {
            break;
        }
        (low, high) = (high, 2.0 * high);
    }
    if !(lag(high) > 0.0) {
        return None;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if lag(middle) > 0.0 { high = middle } else { low = middle }
    }
    let omega = 0.5 * (low + high);
    let body = libm::hypot(stiffness - alpha * omega * omega, drag * omega);
    Some([body / libm::hypot(zero_s * omega, 1.0), omega])
}

impl ProcessRecord {
    /// The gains; `None` where no controller is proved for every process: the set is too wide.
    #[must_use]
    pub fn gains(&self, interval_s: f64, wanted: &GainsWanted) -> Option<ProvedGains> {
        let sets = self.models.iter().map(|model| model.processes(interval_s)).collect::<Option<Vec<_>>>()?;
        // A wide ellipsoid takes too many boxes: then its hull, over which the excess is monotonic more often.
        let hulls = sets.iter().map(ProcessIntervals::hull).collect();
        self.gains_for(sets, wanted).or_else(|| self.gains_for(hulls, wanted))
    }

    /// Ranges of ultimate gain and frequency, rad/s, over the corners of the hull of every structure's set.
    #[must_use]
    pub fn ultimate(&self) -> Option<[Interval; 2]> {
        let best = ultimate(&self.models.first()?.process())?;
        let hulls = self.models.iter().map(|model| Some(model.processes(0.0)?.hull())).collect::<Option<Vec<_>>>()?;
        let all = hulls.iter().flat_map(ProcessIntervals::corners).filter_map(|corner| ultimate(&corner));
        Some(all.fold(best.map(Interval::point), |range, one| [0, 1].map(|k| range[k].hull(Interval::point(one[k])))))
    }

    fn gains_for(&self, sets: Vec<ProcessIntervals>, wanted: &GainsWanted) -> Option<ProvedGains> {
        let mut search = GainExchange::new(&sets, wanted)?;
        let any = f64::INFINITY;
        let chosen = match wanted.actions {
            Actions::Pi => search.best(false, any)?,
            Actions::Pid => search.best(true, any)?,
            Actions::Best => {
                let pi = search.best(false, any);
                search.best(true, pi.map_or(any, |pi| WORTH * pi.1)).or(pi)?
            }
        };
        let ([gain, integral_s, derivative_s], _) = chosen;
        let proved = |back: i32| {
            let less = gain * BACK.powi(back);
            let gains = ideal([less, integral_s, derivative_s], wanted.derivative_filter)?;
            let limit = RobustCriterion::Sensitivity(wanted.sensitivity);
            sets.iter().all(|set| set.all_have(&gains, limit)).then_some(gains)
        };
        // A set too wide takes many boxes with each: bisection between the gain found and the least that is tried.
        let gains = proved(0).or_else(|| {
            let (mut unproved, mut back, mut least) = (0, STEPS_BACK, proved(STEPS_BACK)?);
            while back - unproved > 1 {
                let middle = (unproved + back) / 2;
                match proved(middle) {
                    Some(gains) => (back, least) = (middle, gains),
                    None => unproved = middle,
                }
            }
            Some(least)
        })?;
        Some(ProvedGains { gains, sensitivity: wanted.sensitivity, sets })
    }
}
