//! A search of gains for all processes at once, by exchange (Hettich and Kortanek, *SIAM Review* 35, 1993): the largest gain is found
//! for few processes; where another process exceeds the limit, that process joins them.

use super::GainsWanted;
use super::gains::ultimate;
use super::load_step::absolute_error;
use crate::control::{Gains, LinearProcess, ProcessIntervals, Structure};

/// The search aims so far below the limit: a proof at the limit itself has no room, and splits boxes without end.
const ROOM: f64 = 0.004;
/// Times of integral and derivative that are tried first, over the ultimate period.
const INTEGRAL: [f64; 10] = [0.15, 0.22, 0.33, 0.5, 0.7, 1.0, 1.5, 2.2, 3.5, 6.0];
const DERIVATIVE: [f64; 5] = [0.05, 0.08, 0.12, 0.17, 0.25];
/// Octaves of frequency about the ultimate in which the sensitivity has its peak, and frequencies in each.
const OCTAVES: [i32; 2] = [-5, 6];
const AN_OCTAVE: i32 = 16;
/// A turn of `L` between two frequencies, rad: half of it away from the worst phase the real part is off by `|L| (1 - cos 0.25)`, 3 %.
const FAR_RAD: f64 = 0.5;

/// Gains in the ideal form: gain, integral time, derivative time.
pub(super) fn ideal([gain, integral_s, derivative_s]: [f64; 3], filter: f64) -> Option<Gains<f64>> {
    Gains::new(Structure::Pid, gain, gain / integral_s, gain * derivative_s, derivative_s / filter).ok()
}

/// Gain, integral time, derivative time, with the integral of the absolute error that they leave on the likeliest process.
pub(super) type Judged = ([f64; 3], f64);

/// The search.
pub(super) struct GainExchange<'a> {
    nominal: LinearProcess<f64>,
    /// Ultimate gain and period of the likeliest process.
    ultimate: f64,
    period_s: f64,
    omega_rad_s: Vec<f64>,
    sets: &'a [ProcessIntervals],
    /// Processes that have bound a gain, the latest first.
    active: Vec<LinearProcess<f64>>,
    wanted: &'a GainsWanted,
}

impl<'a> GainExchange<'a> {
    pub(super) fn new(sets: &'a [ProcessIntervals], wanted: &'a GainsWanted) -> Option<Self> {
        let nominal = sets.first()?.middle();
        let [ultimate, omega] = ultimate(&nominal)?;
        let [low, high] = OCTAVES.map(|octaves| octaves * AN_OCTAVE);
        let omega_rad_s = (low..=high).map(|k| omega * libm::exp2(f64::from(k) / f64::from(AN_OCTAVE))).collect();
        let period_s = core::f64::consts::TAU / omega;
        Some(Self { nominal, ultimate, period_s, omega_rad_s, sets, active: vec![nominal], wanted })
    }

    /// The largest sensitivity `1/|1 + L|` of a loop on the grid, and its frequency. Where the delay turns `L` by far from one frequency
    /// to the next, some frequency between has the worst phase, and `1/(1 - |L|)`.
    fn peak(&self, process: &LinearProcess<f64>, gains: &Gains<f64>) -> (f64, f64) {
        let loops = process.open_loop_at(gains, &self.omega_rad_s);
        let all = loops.iter().zip(&self.omega_rad_s).map(|([re, im], omega)| {
            let turns = omega * process.delay_s * core::f64::consts::LN_2 / f64::from(AN_OCTAVE);
            let distance = if turns > FAR_RAD { 1.0 - libm::hypot(*re, *im) } else { libm::hypot(1.0 + re, *im) };
            (distance.max(0.0).recip(), *omega)
        });
        all.fold((1.0, 0.0), |worst, one| if one.0 > worst.0 { one } else { worst })
    }

    fn ideal(&self, [gain, integral_s, derivative_s]: [f64; 3]) -> Option<Gains<f64>> {
        ideal([gain, integral_s, derivative_s], self.wanted.derivative_filter)
    }

    fn meets(&self, process: &LinearProcess<f64>, gains: &Gains<f64>, room: f64) -> bool {
        self.peak(process, gains).0 <= (1.0 - room) * self.wanted.sensitivity
    }

    /// The largest gain above `least` at these times with which the active processes meet the limit, up to rounding.
    fn largest_gain(&self, [integral_s, derivative_s]: [f64; 2], least: f64) -> Option<f64> {
        let meets = |gain: f64| {
            self.ideal([gain, integral_s, derivative_s])
                .is_some_and(|gains| self.active.iter().all(|process| self.meets(process, &gains, ROOM)))
        };
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
            let gains = self.ideal(found)?;
            let error = absolute_error(&self.nominal, &gains, self.period_s);
            if !(error < best) {
                return None;
            }
            let mut worst = self.sets.iter().flat_map(ProcessIntervals::corners);
            match worst.find(|process| !self.meets(process, &gains, 0.5 * ROOM)) {
                Some(process) => self.active.insert(0, process),
                None => return Some((found, error)),
            }
        }
    }

    /// The best gains that leave less than `best`, with or without derivative: a grid of times, then a pattern search.
    pub(super) fn best(&mut self, derivative: bool, best: f64) -> Option<Judged> {
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
