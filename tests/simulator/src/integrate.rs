//! The motion by fourth-order Runge-Kutta steps that never step over a change of anything: steps end where the delayed command
//! bends, at the knots of the force, where the vehicle turns, where an ideal relay switches, and where a reading is taken.

use crate::command::History;
use crate::force::ForcePath;
use crate::vehicle::{Acting, POSITION, SPEED, State, Vehicle};

/// The longest step, and the distance of the force's knots, in s.
pub const STEP_S: f64 = 0.002;

/// The shortest step to a turn in s.
const SHORTEST_S: f64 = 1e-12;

/// Which way the vehicle moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Towards larger outputs.
    Up,
    /// Towards smaller outputs.
    Down,
    /// Not at all: Coulomb friction holds it.
    Held,
}

impl Direction {
    pub(crate) fn of(value: f64) -> Self {
        if value < 0.0 { Self::Down } else { Self::Up }
    }

    /// One, minus one, or zero.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Up => 1.0,
            Self::Down => -1.0,
            Self::Held => 0.0,
        }
    }
}

/// A motion under way.
#[derive(Clone, Debug)]
pub struct Motion<'a> {
    vehicle: &'a Vehicle,
    filter_s: f64,
    /// The time over which inertia drifts and the battery sags: beginning and length.
    span_s: (f64, f64),
    step_s: f64,
    path: ForcePath,
    direction: Direction,
    /// Time in s.
    pub time_s: f64,
    state: State,
    /// Index of the command's segment that acts.
    segment: usize,
    cell: usize,
}

/// Why a motion stopped before its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The time is reached.
    Time,
    /// The watched position is passed.
    Passed,
}

impl<'a> Motion<'a> {
    /// Begins at time zero.
    pub(crate) fn new(
        vehicle: &'a Vehicle,
        filter_s: f64,
        state: State,
        path: ForcePath,
        step_s: f64,
        span_s: (f64, f64),
    ) -> Self {
        let direction = Direction::of(state[SPEED]);
        Self { vehicle, filter_s, span_s, step_s, path, direction, time_s: 0.0, state, segment: 0, cell: 0 }
    }

    /// The state.
    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// The forces drawn so far.
    pub(crate) fn into_path(self) -> ForcePath {
        self.path
    }

    /// Advances to a time, or to where the watched position is passed.
    pub(crate) fn advance(&mut self, until_s: f64, history: &History, watched: Option<(f64, bool)>) -> Stop {
        let delay_s = self.vehicle.actuator.delay_s;
        let passed = |state: &State, (level, up): (f64, bool)| {
            if up { state[POSITION] >= level } else { state[POSITION] <= level }
        };
        if watched.is_some_and(|watched| passed(&self.state, watched)) {
            return Stop::Passed;
        }
        while self.time_s < until_s {
            let segments = history.segments();
            while self.segment + 1 < segments.len() && segments[self.segment + 1].begin_s + delay_s <= self.time_s {
                self.segment += 1;
            }
            let knot = |cell: usize| cell as f64 * STEP_S;
            while knot(self.cell + 1) <= self.time_s {
                self.cell += 1;
            }
            let mut end_s = until_s.min(knot(self.cell + 1)).min(self.time_s + self.step_s);
            if let Some(next) = segments.get(self.segment + 1) {
                end_s = end_s.min(next.begin_s + delay_s);
            }
            let segment = segments[self.segment];
            let (left, slope) = self.path.cell(self.cell);
            let begin_s = knot(self.cell);
            let (path, span_s) = (&self.path, self.span_s);
            let acting = |time_s: f64| Acting {
                command: if segment.slope == 0.0 { segment.value } else { segment.at(time_s - delay_s) },
                force: left + slope * (time_s - begin_s) + path.sine(time_s),
                elapsed: ((time_s - span_s.0) / span_s.1).clamp(0.0, 1.0),
            };
            if self.direction == Direction::Held || self.state[SPEED] == 0.0 {
                self.state[SPEED] = 0.0;
                self.direction = self.vehicle.departure(&self.state, &acting(self.time_s));
            }
            let (vehicle, filter_s, direction, from_s, from) =
                (self.vehicle, self.filter_s, self.direction, self.time_s, self.state);
            let step = |length_s: f64| {
                let derivative =
                    |time_s: f64, state: &State| vehicle.derivative(state, direction, &acting(time_s), filter_s);
                runge_kutta(&from, from_s, length_s, derivative)
            };
            let whole_s = end_s - from_s;
            let mut state = step(whole_s);
            let mut reached_s = end_s;
            // The first of the two events within the step, if any.
            let turned = |state: &State| direction != Direction::Held && direction.sign() * state[SPEED] < 0.0;
            if turned(&state) {
                // Never shorter than this: a step that rounds to nothing would be tried for ever.
                let length_s = locate(whole_s, |length_s| turned(&step(length_s))).max(SHORTEST_S);
                state = step(length_s);
                state[SPEED] = 0.0;
                reached_s = from_s + length_s;
            }
            let mut stop = None;
            if let Some(watched) = watched.filter(|watched| passed(&state, *watched)) {
                let length_s = locate(reached_s - from_s, |length_s| passed(&step(length_s), watched));
                state = step(length_s);
                reached_s = from_s + length_s;
                stop = Some(Stop::Passed);
            }
            self.state = state;
            self.time_s = reached_s;
            if let Some(stop) = stop {
                return stop;
            }
        }
        Stop::Time
    }
}

/// The least length in `[0, whole]` at which something has happened, to the last bits but not short of it.
fn locate(whole: f64, happened: impl Fn(f64) -> bool) -> f64 {
    let (mut before, mut after) = (0.0, whole);
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        if middle <= before || middle >= after {
            break;
        }
        if happened(middle) { after = middle } else { before = middle }
    }
    after
}

/// One classical Runge-Kutta step.
fn runge_kutta(from: &State, time_s: f64, length_s: f64, derivative: impl Fn(f64, &State) -> State) -> State {
    let along = |slope: &State, length_s: f64| core::array::from_fn(|i| from[i] + length_s * slope[i]);
    let half_s = 0.5 * length_s;
    let first = derivative(time_s, from);
    let second = derivative(time_s + half_s, &along(&first, half_s));
    let third = derivative(time_s + half_s, &along(&second, half_s));
    let fourth = derivative(time_s + length_s, &along(&third, length_s));
    core::array::from_fn(|i| from[i] + length_s / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}
