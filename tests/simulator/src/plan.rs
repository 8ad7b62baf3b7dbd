//! Plans: scenarios drawn at random, in units in which the relay level is one and the output is in radians.

use crate::command::Commander;
use crate::random::Random;
use crate::scenario::{Logged, Scenario};
use crate::sensor::Sensor;
use crate::vehicle::{Drag, Vehicle};

/// A degree in radians.
pub(crate) const DEGREE: f64 = core::f64::consts::PI / 180.0;

/// Families of drag.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Law {
    Linear,
    Quadratic,
    /// Both, each with a quarter of the force at least.
    Mixed,
    /// Both, the linear part with 1 to 8 % of the force.
    MinorLinear,
    /// Both, the quadratic part with 1 to 8 % of the force.
    MinorQuadratic,
    /// Negative linear and quadratic: unstable at rest.
    Unstable,
    /// Linear and cubic.
    Cubic,
    /// Negative linear and cubic (Norrbin's ship).
    Norrbin,
    /// One of the first three.
    Any,
}

/// What the tool is told of the delay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum DelayTold {
    Right,
    Nothing,
    /// So much more than it is, in s, but never below zero.
    Wrong(f64),
}

/// What records of a kind must show to be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Anything that oscillates.
    Any,
    /// Cycles that repeat sample for sample.
    Locked,
}

/// One case before it is run.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub(crate) scenarios: Vec<Scenario>,
    pub(crate) delay: DelayTold,
    pub(crate) wanted: Wanted,
}

/// A drag of a family for this inertia; `speed` is one that is typical of the oscillation.
fn drag(random: &mut Random, law: Law, alpha: f64, half_width: f64, speed: f64) -> Drag {
    // Quadratic drag by beta x_a / alpha, on which alone the shape of the cycle depends; linear drag by its time constant.
    let quadratic = alpha / half_width * random.log_uniform(0.12, 1.2);
    let linear = alpha / random.log_uniform(0.6, 4.0);
    let total = quadratic * speed * speed;
    let shared = |share: f64| Drag {
        linear: share * total / speed,
        quadratic: (1.0 - share) * total / (speed * speed),
        ..Drag::default()
    };
    match law {
        Law::Linear => Drag { linear, ..Drag::default() },
        Law::Quadratic => Drag { quadratic, ..Drag::default() },
        Law::Mixed => shared(random.uniform(0.25, 0.75)),
        Law::MinorLinear => shared(random.uniform(0.01, 0.08)),
        Law::MinorQuadratic => shared(1.0 - random.uniform(0.01, 0.08)),
        Law::Unstable => {
            let negative = random.uniform(0.1, 0.4) * total;
            Drag { linear: -negative / speed, quadratic: (total + negative) / (speed * speed), ..Drag::default() }
        }
        Law::Cubic => {
            let share = random.uniform(0.3, 0.7);
            Drag { linear: share * total / speed, cubic: (1.0 - share) * total / speed.powi(3), ..Drag::default() }
        }
        Law::Norrbin => {
            let negative = random.uniform(0.1, 0.4) * total;
            Drag { linear: -negative / speed, cubic: (total + negative) / speed.powi(3), ..Drag::default() }
        }
        Law::Any => {
            let law = random.pick(&[Law::Linear, Law::Quadratic, Law::Mixed]);
            drag(random, law, alpha, half_width, speed)
        }
    }
}

impl Plan {
    /// A vehicle under a relay that is sampled at 10 Hz for 60 s, a perfect sensor.
    pub(crate) fn new(random: &mut Random, law: Law) -> Self {
        let alpha = random.log_uniform(0.4, 2.5);
        let half_width = random.uniform(11.0, 29.0) * DEGREE;
        let speed = (half_width / alpha).sqrt();
        let mut vehicle = Vehicle {
            alpha,
            drag: drag(random, law, alpha, half_width, speed),
            delta: random.uniform(-0.15, 0.15),
            ..Vehicle::default()
        };
        vehicle.actuator.delay_s = random.uniform(0.0, 0.4);
        let mut scenario = Scenario {
            vehicle,
            commander: Commander::Relay { levels: vec![(0.0, 1.0)], half_width, centre: 0.0, ideal: false },
            sensor: Sensor::default(),
            logged: Logged::Order,
            duration_s: 60.0,
            lead_s: 0.0,
            first_stamp_s: 0.0,
            position: 0.0,
            speed: 0.0,
            starts_high: true,
        };
        scenario.start_over(random);
        Self { scenarios: vec![scenario], delay: DelayTold::Right, wanted: Wanted::Any }
    }

    /// Changes every scenario.
    pub(crate) fn with(mut self, mut change: impl FnMut(&mut Scenario)) -> Self {
        self.scenarios.iter_mut().for_each(&mut change);
        self
    }

    /// Readings rounded to so many degrees.
    pub(crate) fn rounded(self, degrees: f64) -> Self {
        self.with(|scenario| scenario.sensor.quantum = degrees * DEGREE)
    }

    /// White noise of so many degrees.
    pub(crate) fn noisy(self, degrees: f64) -> Self {
        self.with(|scenario| scenario.sensor.noise = degrees * DEGREE)
    }

    /// Either a rounding to one degree or a noise of half a degree.
    pub(crate) fn any_sensor(self, random: &mut Random) -> Self {
        if random.chance(0.5) { self.rounded(1.0) } else { self.noisy(0.5) }
    }

    /// The delay is not told.
    pub(crate) fn delay_unknown(self) -> Self {
        Self { delay: DelayTold::Nothing, ..self }
    }

    /// The delay told is wrong.
    pub(crate) fn delay_wrong(self, by_s: f64) -> Self {
        Self { delay: DelayTold::Wrong(by_s), ..self }
    }

    /// A further record of the same vehicle, from another start under another constant force, changed.
    pub(crate) fn again(mut self, random: &mut Random, change: impl FnOnce(&mut Scenario)) -> Self {
        let mut next = self.scenarios[0].clone();
        next.start_over(random);
        next.vehicle.delta = random.uniform(-0.15, 0.15);
        change(&mut next);
        self.scenarios.push(next);
        self
    }
}

impl Scenario {
    /// Draws the start: somewhere within the relay's band, at once or after some time under way.
    fn start_over(&mut self, random: &mut Random) {
        let half_width = self.half_width();
        self.position = random.uniform(-half_width, half_width);
        self.speed = random.uniform(-0.3, 0.3) * half_width;
        self.starts_high = random.chance(0.5);
        self.lead_s = if random.chance(0.5) { 0.0 } else { random.uniform(1.0, 20.0).floor() };
        self.first_stamp_s = random.pick(&[0.0, 0.0, 100.0, 7.3]);
    }

    /// Half the width of the relay's hysteresis; one radian for others.
    pub(crate) fn half_width(&self) -> f64 {
        match self.commander {
            Commander::Relay { half_width, .. } => half_width,
            Commander::Sequence { .. } => 1.0,
        }
    }

    /// Changes the relay; other commanders stay.
    pub(crate) fn relay(&mut self, change: impl FnOnce(&mut Vec<(f64, f64)>, &mut f64)) {
        if let Commander::Relay { levels, half_width, .. } = &mut self.commander {
            change(levels, half_width);
        }
    }

    /// Orders in advance: levels drawn from these, each for a time between these in s, on the autopilot's clock.
    pub(crate) fn sequence(&mut self, random: &mut Random, levels: &[f64], dwell_s: (f64, f64)) {
        let mut time_s = 0.0;
        let mut level = random.pick(levels);
        let mut changes = Vec::new();
        while time_s < self.duration_s {
            changes.push((time_s, level));
            time_s += random.uniform(dwell_s.0, dwell_s.1);
            let before = level;
            while level == before {
                level = random.pick(levels);
            }
        }
        self.commander = Commander::Sequence { changes };
    }
}
