//! The periodic response of a linear plant to a two-level input, from the matrix exponential.

use nalgebra::{DMatrix, DVector};

use crate::plant::StateSpace;

/// A gap between the ends of a cycle that counts as rounding, relative to its size.
const CLOSED: f64 = 1e-9;

/// The two inputs after offset and disturbance, and the output levels at which the relay switches.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Levels {
    /// Plant input while the command is positive, and while it is negative.
    pub(super) high: f64,
    pub(super) low: f64,
    /// Output at which the command becomes positive (falling past it), and negative (rising past it).
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// One period of a plant whose input is `high` on `[0, positive)` and `low` on `[positive, positive + negative)`.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Cycle {
    pub(super) positive: f64,
    pub(super) negative: f64,
    /// State when the input becomes high, and when it becomes low.
    start: DVector<f64>,
    turn: DVector<f64>,
    levels: Levels,
}

impl Cycle {
    /// Whether this is a cycle of such a plant, by the number of its states.
    pub(super) fn belongs_to(&self, plant: &StateSpace) -> bool {
        [self.start.len(), self.turn.len()] == [plant.order(); 2]
    }

    /// The periodic response; `None` where there is none or not one alone (a pole on the imaginary axis in resonance), or
    /// where rounding hides it.
    ///
    /// An integrating plant has one only if the input's mean vanishes, and then with any constant added: the one is
    /// returned that is at the lower level when the command becomes positive.
    pub(super) fn new(plant: &StateSpace, integrating: bool, levels: Levels, times: (f64, f64)) -> Option<Self> {
        let (positive, negative) = times;
        let (first, second) = (plant.flow(positive), plant.flow(negative));
        let order = plant.order();
        let period = &second.state * &first.state;
        let forced = second.apply(&(&first.input * levels.high), levels.low);
        let matrix = DMatrix::identity(order, order) - &period;
        let start = if integrating {
            // The missing condition is the level; the column for it stands for a constant input, which comes out zero.
            let rest =
                Self { positive, negative, start: DVector::zeros(order), turn: &first.input * levels.high, levels };
            let on = rest.command_on(plant);
            let reached = rest.state(plant, on);
            let (observed, whole) = (plant.flow(on), plant.flow(positive + negative));
            let mut bordered = DMatrix::zeros(order + 1, order + 1);
            bordered.view_mut((0, 0), (order, order)).copy_from(&matrix);
            bordered.view_mut((0, order), (order, 1)).copy_from(&-whole.input);
            bordered.view_mut((order, 0), (1, order)).copy_from(&(plant.c() * observed.state));
            bordered[(order, order)] = plant.output(&observed.input);
            let right = forced.push(levels.lower - plant.output(&reached));
            bordered.lu().solve(&right)?.rows(0, order).into_owned()
        } else {
            matrix.lu().solve(&forced)?
        };
        let turn = first.apply(&start, levels.high);
        let end = second.apply(&turn, levels.low);
        Self { positive, negative, start, turn, levels }.closed(&end)
    }

    /// The response that repeats itself with the opposite sign after half a period (Åström's condition): regular for an
    /// integrating plant too.
    pub(super) fn symmetric(plant: &StateSpace, levels: Levels, half_period: f64) -> Option<Self> {
        let order = plant.order();
        let flow = plant.flow(half_period);
        let start = (DMatrix::identity(order, order) + &flow.state).lu().solve(&(&flow.input * -levels.high))?;
        let (end, turn) = (-flow.apply(&start, levels.high), -&start);
        Self { positive: half_period, negative: half_period, start, turn, levels }.closed(&end)
    }

    /// Itself if it ends where it began; a plant unstable enough magnifies rounding until it does not.
    fn closed(self, end: &DVector<f64>) -> Option<Self> {
        let size = self.start.amax().max(self.turn.amax());
        ((end - &self.start).amax() <= CLOSED * size).then_some(self)
    }

    pub(super) fn period(&self) -> f64 {
        self.positive + self.negative
    }
    /// When the command becomes positive: a delay before the input does.
    pub(super) fn command_on(&self, plant: &StateSpace) -> f64 {
        (-plant.delay_s()).rem_euclid(self.period())
    }
    /// When the command becomes negative.
    pub(super) fn command_off(&self, plant: &StateSpace) -> f64 {
        (self.positive - plant.delay_s()).rem_euclid(self.period())
    }
    /// The input after `time`, for `0 <= time < period`.
    pub(super) fn input(&self, time: f64) -> f64 {
        if time < self.positive { self.levels.high } else { self.levels.low }
    }
    /// The state at `0 <= time <= period`.
    pub(super) fn state(&self, plant: &StateSpace, time: f64) -> DVector<f64> {
        if time == 0.0 {
            self.start.clone()
        } else if time == self.positive {
            self.turn.clone()
        } else if time < self.positive {
            plant.flow(time).apply(&self.start, self.levels.high)
        } else {
            plant.flow(time - self.positive).apply(&self.turn, self.levels.low)
        }
    }
    /// How far the output is from the level at which the command becomes positive, when it does; and the other one.
    pub(super) fn misses(&self, plant: &StateSpace) -> (f64, f64) {
        let output = |time| plant.output(&self.state(plant, time));
        (output(self.command_on(plant)) - self.levels.lower, output(self.command_off(plant)) - self.levels.upper)
    }
    pub(super) fn levels(&self) -> Levels {
        self.levels
    }
}
