//! What becomes of a loop from a start: a cycle, an escape, rest, or no end in sight.

use f256::f256;

use super::attraction::{Fate, fate};
use super::control_loop::Level;
use super::orbit::Orbit;
use super::simulation::{Event, Limit, Simulator, State};

/// End of a simulation from a start.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// A cycle with one switching each way: its times at high and low in s.
    Cycle {
        /// Time at the upper level in s.
        time_high: f64,
        /// Time at the lower level in s.
        time_low: f64,
    },
    /// A cycle with several switchings each way.
    LongCycle {
        /// Switchings in a period.
        switchings: usize,
        /// Period in s.
        period: f64,
    },
    /// The output went beyond every bound.
    Escaped,
    /// The relay stopped switching.
    Stuck,
    /// Neither in the switchings followed.
    Wandering,
    /// The output touched a threshold as closely as floats can tell.
    Unclear,
}

/// Sizes natural to a loop.
#[derive(Clone, Debug)]
pub struct Scales {
    /// Dead time or the plant's shortest time, in s.
    pub time: f64,
    /// Output that half the step between the levels makes in that time from rest, or half the hysteresis.
    pub output: f64,
    /// The states of the plant that it makes.
    pub states: Vec<f64>,
    /// Where a run ends without a switching.
    pub limit: Limit,
}

/// Switchings followed from a start.
const SWITCHINGS: usize = 2000;
/// Half-periods that repeat to this share of the period are a cycle.
const REPEATS: f64 = 1e-9;
/// Switchings in a period that are recognised.
const PATTERNS: [usize; 7] = [2, 4, 6, 8, 10, 12, 16];

impl Scales {
    /// The sizes of a loop.
    #[must_use]
    pub fn of(simulator: &Simulator<f64>) -> Self {
        let motion = &simulator.motion;
        let time = simulator.delay.max(motion.step());
        let swing = simulator.input(Level::High) - simulator.input(Level::Low);
        let mut state = vec![0.0; motion.order()];
        let mut states = state.clone();
        let mut output = 0.5 * (simulator.upper - simulator.lower);
        for _ in 0..(time / motion.step()).ceil() as usize {
            motion.advance(&mut state, 0.5 * swing, motion.step());
            states.iter_mut().zip(&state).for_each(|(most, z): (&mut f64, _)| *most = most.max(z.abs()));
            output = output.max(motion.output(&state).abs());
        }
        let largest = motion.static_gain().map_or(output, |gain| output.max((gain * swing).abs()));
        // 40 slowest time constants leave e^-40 of a transient; integrators move by their input. A resonance of damping 0.05
        // swings to 20 times the static gain.
        let duration = motion.slowest_rate().map_or(0.0, |rate| 40.0 / rate) + 300.0 * time;
        Self { time, output, states, limit: Limit { duration, distance: 1e3 * largest } }
    }
}

/// Follows a start to its end.
#[must_use]
pub fn settle(simulator: &Simulator<f64>, scales: &Scales, mut state: State<f64>) -> End {
    let mut halves: Vec<f64> = Vec::new();
    // Half-periods begin with that at low.
    let begins_low = state.command == Level::High;
    for count in 0..SWITCHINGS {
        match simulator.run(&mut state, scales.limit) {
            Event::Switched(after) => halves.push(after),
            Event::Quiet if rests(simulator, &state) => return End::Stuck,
            Event::Quiet | Event::Escaped => return End::Escaped,
            Event::Unclear => return End::Unclear,
        }
        if count % 8 == 7 {
            let window = 2 * (state.due.len() + state.z.len()) + 4;
            for pattern in PATTERNS {
                if repeats(&halves, pattern, window + 2 * pattern) {
                    return cycle(&halves, pattern, begins_low);
                }
            }
        }
    }
    End::Wandering.or_nearly(simulator, &halves, begins_low)
}

/// Whether a plant whose command stays the same has come to rest: a pole at the origin or in the right half plane does not let it.
fn rests(simulator: &Simulator<f64>, state: &State<f64>) -> bool {
    let input = simulator.input(state.applied());
    let derivatives = simulator.motion.derivatives(&state.z, input);
    let series = simulator.motion.output_series(&derivatives, simulator.motion.step());
    let moving: f64 = series[1..].iter().map(|c| c.abs()).sum();
    let size = simulator.motion.static_gain().map_or(0.0, |gain| (gain * input).abs())
        + 0.5 * (simulator.upper - simulator.lower);
    moving <= 1e-9 * size.max(f64::MIN_POSITIVE)
}

fn repeats(halves: &[f64], pattern: usize, window: usize) -> bool {
    if halves.len() < window + pattern + 1 {
        return false;
    }
    let period: f64 = halves[halves.len() - pattern..].iter().sum();
    (halves.len() - window..halves.len()).all(|i| (halves[i] - halves[i - pattern]).abs() <= REPEATS * period)
}

/// The cycle of the last switchings. The first entry of `halves` ends with a switching to low where `begins_low`.
fn cycle(halves: &[f64], pattern: usize, begins_low: bool) -> End {
    let last = &halves[halves.len() - pattern..];
    if pattern > 2 {
        return End::LongCycle { switchings: pattern, period: last.iter().sum() };
    }
    // Entry i ends a time at high if i is even where the first switching is to low.
    let ends_high = (halves.len() - 1).is_multiple_of(2) == begins_low;
    let (time_high, time_low) = if ends_high { (last[1], last[0]) } else { (last[0], last[1]) };
    End::Cycle { time_high, time_low }
}

impl End {
    /// A cycle after all where the last half-periods stand near one that attracts slowly.
    fn or_nearly(self, simulator: &Simulator<f64>, halves: &[f64], begins_low: bool) -> Self {
        let near = cycle(halves, 2, begins_low);
        let Self::Cycle { time_high, time_low } = near else { return self };
        let exact = Simulator::<f256>::new(&simulator.control_loop);
        let Ok(orbit) = Orbit::near(&exact, time_high, time_low) else { return self };
        let period = orbit.period();
        let off =
            ((orbit.time_high - f256::from(time_high)).abs() + (orbit.time_low - f256::from(time_low)).abs()) / period;
        let attracts = || orbit.simulate(&exact).is_ok_and(|path| fate(&exact, &orbit, &path) == Fate::Returns);
        if off < f256::from(1e-3) && attracts() { near } else { self }
    }
}
