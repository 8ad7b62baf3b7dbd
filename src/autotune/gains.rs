//! Gains for every process that a record leaves: the smallest integral of the absolute error after a step of the load, under a limit
//! of the sensitivity that is proved for all of them.

use nalgebra::SMatrix;

use super::{ProcessModel, ProcessRecord};
use crate::control::{Gains, LinearProcess, ProcessIntervals, RobustCriterion, Structure};
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
    /// The confidence set, structure by structure, the likeliest first. Each holds 95 % of the normal distribution of the errors. Which axes it
    /// lies along depends on the record, so that of many records 90 % hold theirs at least, as far as the errors are normal.
    pub sets: Vec<ProcessIntervals>,
}

/// Standard deviations that a set of processes reaches along each principal axis: 95 % for five independent axes at once, since
/// `(2 Phi(2.57) - 1)^5 = 0.95`; along each coefficient the same or more (Sidak's inequality).
const REACH: f64 = 2.57;
/// A principal axis shorter than this is rounding: eigenvalues are exact to 1e-16 or so, and their roots to 1e-8.
const FLAT: f64 = 1e-6;
/// A derivative has to take off so much of the integral of the absolute error.
const WORTH: f64 = 0.9;
/// The search aims so far below the limit: a proof at the limit itself has no room, and splits boxes without end.
const ROOM: f64 = 0.01;
/// Steps back from the largest gain until the limit is proved, each so much.
const STEPS_BACK: i32 = 8;
const BACK: f64 = 0.95;
/// Times of integral and derivative that are tried first, over the ultimate period.
const INTEGRAL: [f64; 10] = [0.15, 0.22, 0.33, 0.5, 0.7, 1.0, 1.5, 2.2, 3.5, 6.0];
const DERIVATIVE: [f64; 5] = [0.05, 0.08, 0.12, 0.17, 0.25];

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

    /// The processes of this structure within the record's errors; a controller that holds its command for `interval_s` adds half of that
    /// to the delay.
    fn processes(&self, interval_s: f64, axes: Axes) -> Option<ProcessIntervals> {
        let std = self.coefficients.map(|part| part.std);
        let scaled = |i: usize, j: usize| self.covariance[i][j] / (std[i] * std[j]).max(f64::MIN_POSITIVE);
        let correlation = match axes {
            Axes::Principal => SMatrix::<f64, 5, 5>::from_fn(scaled),
            Axes::Coefficients => SMatrix::from_fn(|i, j| if i == j { scaled(i, i) } else { 0.0 }),
        };
        let found = correlation.symmetric_eigen();
        let lengths = found.eigenvalues.iter().map(|square| square.max(0.0).sqrt());
        let long = lengths.zip(found.eigenvectors.column_iter()).filter(|(length, _)| *length > FLAT);
        let directions = long.map(|(length, axis)| {
            let [alpha, drag, stiffness, zero_s, delay_s] = core::array::from_fn(|k| REACH * length * axis[k] * std[k]);
            let none = 0.0;
            [alpha, drag, stiffness, none, none, none, none, zero_s, delay_s]
        });
        let mut process = self.process();
        process.delay_s += 0.5 * interval_s;
        let found = ProcessIntervals::along(process.parts(), &directions.collect::<Vec<_>>()).ok();
        found.filter(|found| found.process().drag.is_positive())
    }
}

/// Along which axes a confidence set is a parallelepiped: it holds 95 % either way.
#[derive(Clone, Copy)]
enum Axes {
    /// Those of the coefficients' correlation: the smallest.
    Principal,
    /// The coefficients: longer, and shorter in projection where they vary independently.
    Coefficients,
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

/// Gains in the ideal form: gain, integral time, derivative time.
fn ideal([gain, integral_s, derivative_s]: [f64; 3], filter: f64) -> Option<Gains<f64>> {
    Gains::new(Structure::Pid, gain, gain / integral_s, gain * derivative_s, derivative_s / filter).ok()
}

/// Steps of an answer to a load, and how many an ultimate period has.
pub(super) const STEPS: usize = 4000;
pub(super) const STEPS_PER_PERIOD: f64 = 200.0;

/// The output after a unit step of the load, in semi-implicit Euler steps; `each` takes the time and the output until it returns false.
pub(super) fn load_step(
    process: &LinearProcess<f64>,
    gains: &Gains<f64>,
    period_s: f64,
    mut each: impl FnMut(f64, f64) -> bool,
) {
    let step_s = period_s / STEPS_PER_PERIOD;
    let late = (process.delay_s / step_s).round().min(1e5) as usize;
    let mut under_way = vec![0.0; late + 1];
    let (mut x, mut v, mut filtered, mut integral) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0);
    for k in 0..STEPS {
        let y = x + process.zero_s * v;
        let rate = if gains.filter_s() > 0.0 { (y - filtered) / gains.filter_s().max(step_s) } else { 0.0 };
        filtered += step_s * rate;
        integral -= step_s * y;
        let command = -gains.proportional() * y + gains.integral() * integral - gains.derivative() * rate;
        let place = k % (late + 1);
        under_way[place] = command;
        let acts = 1.0 + under_way[(k + 1) % (late + 1)];
        if process.alpha > 0.0 {
            v += step_s * (acts - process.drag * v - process.stiffness * x) / process.alpha.max(step_s * process.drag);
        } else {
            v = (acts - process.stiffness * x) / process.drag;
        }
        x += step_s * v;
        if !each(k as f64 * step_s, y) {
            return;
        }
    }
}

/// The integral of the absolute error after a unit step of the load.
fn absolute_error(process: &LinearProcess<f64>, gains: &Gains<f64>, period_s: f64) -> f64 {
    let mut sum = 0.0_f64;
    load_step(process, gains, period_s, |_, y| {
        sum += period_s / STEPS_PER_PERIOD * y.abs();
        sum.is_finite()
    });
    if !sum.is_finite() {
        return f64::INFINITY;
    }
    // A slow tail goes on beyond the steps: the integral of the error itself is 1/Ki, since integral action ends at the load.
    sum.max(gains.integral().recip())
}

/// Gain, integral time, derivative time, with the integral of the absolute error that they leave on the likeliest process.
type Judged = ([f64; 3], f64);

/// A search of gains for all processes at once, by exchange (Hettich and Kortanek, SIAM Review 35, 1993): the largest gain is found
/// for few processes; where another process exceeds the limit, that process joins them.
struct GainExchange<'a> {
    nominal: LinearProcess<f64>,
    /// Ultimate gain and period of the likeliest process.
    ultimate: f64,
    period_s: f64,
    /// Middle and corners of every set.
    all: Vec<ProcessIntervals>,
    /// Those that have bound a gain, the latest first.
    active: Vec<ProcessIntervals>,
    wanted: &'a GainsWanted,
}

impl<'a> GainExchange<'a> {
    fn new(nominal: LinearProcess<f64>, sets: &[ProcessIntervals], wanted: &'a GainsWanted) -> Option<Self> {
        let [ultimate, omega] = ultimate(&nominal)?;
        let point = |process: &LinearProcess<f64>| {
            ProcessIntervals::new(LinearProcess::from_parts(process.parts().map(Interval::point))).ok()
        };
        let points = sets.iter().flat_map(|set| core::iter::once(set.middle()).chain(set.corners()));
        let all = points.map(|process| point(&process)).collect::<Option<Vec<_>>>()?;
        let active = vec![point(&nominal)?];
        Some(Self { nominal, ultimate, period_s: core::f64::consts::TAU / omega, all, active, wanted })
    }

    fn meets(&self, process: &ProcessIntervals, [gain, integral_s, derivative_s]: [f64; 3]) -> bool {
        ideal([gain, integral_s, derivative_s], self.wanted.derivative_filter).is_some_and(|gains| {
            process.meets(&gains, RobustCriterion::Sensitivity((1.0 - ROOM) * self.wanted.sensitivity))
        })
    }

    /// The largest gain above `least` at these times with which the active processes meet the limit, up to rounding.
    fn largest_gain(&self, times: [f64; 2], least: f64) -> Option<f64> {
        let meets = |gain: f64| self.active.iter().all(|process| self.meets(process, [gain, times[0], times[1]]));
        let grid = |k: u32| self.ultimate * 0.8_f64.powi(k as i32);
        let first = (1..24).take_while(|k| grid(*k - 1) > least).find(|k| meets(grid(*k)))?;
        let (mut low, mut high) = (grid(first), grid(first - 1));
        for _ in 0..6 {
            let middle = 0.5 * (low + high);
            if meets(middle) { low = middle } else { high = middle }
        }
        Some(low)
    }

    /// The gains at these times, where they leave less than `best`. The integral of the absolute error is at least
    /// `|int e dt| = Ti/K`: a gain below `Ti/best` cannot.
    fn better(&mut self, times: [f64; 2], best: f64) -> Option<Judged> {
        loop {
            let gain = self.largest_gain(times, times[0] / best)?;
            let found = [gain, times[0], times[1]];
            let gains = ideal(found, self.wanted.derivative_filter)?;
            let error = absolute_error(&self.nominal, &gains, self.period_s);
            if !(error < best) {
                return None;
            }
            match self.all.iter().find(|process| !self.meets(process, found)) {
                Some(process) => self.active.insert(0, *process),
                None => return Some((found, error)),
            }
        }
    }

    /// The best gains that leave less than `best`, with or without derivative: a grid of times, then a pattern search.
    fn best(&mut self, derivative: bool, best: f64) -> Option<Judged> {
        let derivatives: &[f64] = if derivative { &DERIVATIVE } else { &[0.0] };
        let mut found: Option<Judged> = None;
        let period_s = self.period_s;
        let mut try_all = |found: &mut Option<Judged>, around: &[[f64; 2]]| {
            let before = *found;
            for times in around {
                *found = self.better(*times, found.map_or(best, |found| found.1)).or(*found);
            }
            *found != before
        };
        for integral in INTEGRAL {
            let times = derivatives.iter().map(|derivative| [integral, *derivative].map(|time| time * period_s));
            try_all(&mut found, &times.collect::<Vec<_>>());
        }
        let mut factor = 1.35_f64;
        while factor > 1.05 {
            let [_, integral_s, derivative_s] = found?.0;
            let mut around = vec![[integral_s * factor, derivative_s], [integral_s / factor, derivative_s]];
            if derivative {
                around.extend([[integral_s, derivative_s * factor], [integral_s, derivative_s / factor]]);
            }
            if !try_all(&mut found, &around) {
                factor = factor.sqrt();
            }
        }
        found
    }
}

impl ProcessRecord {
    /// The gains; `None` where no controller is proved for every process: the set is too wide.
    #[must_use]
    pub fn gains(&self, interval_s: f64, wanted: &GainsWanted) -> Option<ProvedGains> {
        [Axes::Principal, Axes::Coefficients].into_iter().find_map(|axes| {
            let sets = self.models.iter().map(|model| model.processes(interval_s, axes)).collect::<Option<_>>()?;
            self.gains_for(sets, wanted)
        })
    }

    /// Ranges of ultimate gain and frequency, rad/s, over the corners of every structure's set.
    #[must_use]
    pub fn ultimate(&self) -> Option<[Interval; 2]> {
        let best = ultimate(&self.models.first()?.process())?;
        let sets =
            self.models.iter().map(|model| model.processes(0.0, Axes::Coefficients)).collect::<Option<Vec<_>>>()?;
        let all = sets.iter().flat_map(ProcessIntervals::corners).filter_map(|corner| ultimate(&corner));
        Some(all.fold(best.map(Interval::point), |range, one| [0, 1].map(|k| range[k].hull(Interval::point(one[k])))))
    }

    fn gains_for(&self, sets: Vec<ProcessIntervals>, wanted: &GainsWanted) -> Option<ProvedGains> {
        let mut search = GainExchange::new(sets.first()?.middle(), &sets, wanted)?;
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
