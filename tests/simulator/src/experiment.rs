//! The loop: motion, sensor, autopilot, logger.

use crate::command::{History, Orders};
use crate::force::ForcePath;
use crate::integrate::{Motion, STEP_S, Stop};
use crate::random::Random;
use crate::scenario::{Logged, Scenario};
use crate::sensor::{Logger, Reader};
use crate::vehicle::{FILTER, POSITION, SPEED, State};

/// A log as a tool gets it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Stamps in s, increasing.
    pub time_s: Vec<f64>,
    /// Readings.
    pub output: Vec<f64>,
    /// The command given upon each reading.
    pub input: Vec<f64>,
}

/// A record with what no tool sees.
#[derive(Clone, Debug)]
pub struct Run {
    /// The scenario that was run.
    pub scenario: Scenario,
    /// The seed of its random numbers.
    pub seed: u64,
    /// The record.
    pub record: Record,
    /// The command behind the rate limit, in time since the start of the simulation.
    pub history: History,
    /// Forces from outside.
    pub path: ForcePath,
    /// For each sample of the record, the time since the start of the simulation at which the position was as read.
    pub instant_s: Vec<f64>,
    /// Time and state at the first look that belongs to the record.
    pub(crate) begin: (f64, State),
    /// The position behind the sensor's filter then.
    pub position: Vec<f64>,
    /// The speed then.
    pub speed: Vec<f64>,
}

impl Run {
    /// The span over which inertia drifts and a battery sags: the record, in time since the start of the simulation.
    pub(crate) fn span_s(scenario: &Scenario) -> (f64, f64) {
        (scenario.lead_s, scenario.duration_s)
    }
}

impl Scenario {
    /// Runs the experiment with the random numbers of a seed.
    #[must_use]
    pub fn run(&self, seed: u64) -> Run {
        self.run_in_steps(seed, STEP_S)
    }

    /// The same with steps of another length at most.
    #[must_use]
    pub fn run_in_steps(&self, seed: u64, step_s: f64) -> Run {
        let sensor = &self.sensor;
        let mut orders = Orders::new(&self.commander, self.starts_high);
        let mut history = History::new(orders.standing(-self.lead_s), self.vehicle.actuator.rate_limit);
        let path = ForcePath::new(self.vehicle.force, Random::new(seed, "force"));
        let start = self.vehicle.settled(self.position, self.speed, history.target());
        let mut motion = Motion::new(&self.vehicle, sensor.filter_s, start, path, step_s, Run::span_s(self));
        let mut reader = Reader::new(sensor, Random::new(seed, "sensor"));
        let mut logger = Logger::new(sensor, Random::new(seed, "logger"));
        let mut clock = Random::new(seed, "clock");
        let interval_s = sensor.interval_s();
        let count = |length_s: f64| (length_s / interval_s + 1e-9).floor() as u64;
        let before = count(self.lead_s);
        let all = before + count(self.duration_s);
        let (mut record, mut instant_s, mut position, mut speed) =
            (Record::default(), Vec::new(), Vec::new(), Vec::new());
        // Positions that have been seen but not yet read: with a latency, several are on their way.
        let mut seen = std::collections::VecDeque::new();
        let ticks: Vec<f64> =
            (0..=all).map(|tick| tick as f64 * interval_s + sensor.irregular_s * clock.uniform(-1.0, 1.0)).collect();
        let ticks: Vec<f64> = ticks.into_iter().map(|tick_s| tick_s.max(0.0) + sensor.latency_s).collect();
        let mut looked = 0;
        let mut begin = (0.0, start);
        for (tick, tick_s) in ticks.iter().copied().enumerate() {
            // Everything that the sensor looks at up to this tick, then the tick itself.
            while looked < ticks.len() && ticks[looked] - sensor.latency_s <= tick_s {
                let look_s = ticks[looked] - sensor.latency_s;
                while motion.advance(look_s, &history, orders.watched()) == Stop::Passed {
                    orders.switch();
                    history.order(motion.time_s, orders.standing(motion.time_s - self.lead_s));
                }
                let state = motion.state();
                let shown = if sensor.filter_s > 0.0 { state[FILTER] } else { state[POSITION] };
                if looked as u64 == before {
                    begin = (look_s, *state);
                }
                seen.push_back((look_s, shown, state[SPEED]));
                looked += 1;
                if sensor.latency_s == 0.0 {
                    break;
                }
            }
            while motion.advance(tick_s, &history, orders.watched()) == Stop::Passed {
                orders.switch();
                history.order(motion.time_s, orders.standing(motion.time_s - self.lead_s));
            }
            let Some((look_s, shown, moving)) = seen.pop_front() else { continue };
            let reading = reader.read(shown);
            let since_s = if sensor.irregular_s == 0.0 {
                (tick as f64 - before as f64) * interval_s
            } else {
                tick_s - sensor.latency_s - self.lead_s
            };
            history.order(tick_s, orders.upon(reading, since_s));
            if (tick as u64) < before || !(tick as u64 - before).is_multiple_of(u64::from(sensor.readings_per_sample)) {
                continue;
            }
            let Some(stamp_s) = logger.stamp(since_s) else { continue };
            record.time_s.push(self.first_stamp_s + stamp_s);
            record.output.push(logger.wrapped(reading));
            record.input.push(match self.logged {
                Logged::Order => history.target(),
                Logged::Rudder => history.at(tick_s),
            });
            instant_s.push(look_s);
            position.push(shown);
            speed.push(moving);
        }
        let path = motion.into_path();
        Run { scenario: self.clone(), seed, record, history, path, instant_s, begin, position, speed }
    }
}
