//! A symmetric limit cycle of a given linear plant under a relay, with proof.

use nalgebra::DMatrix;

use super::relay_cycle::Levels;
use super::{OrbitError, RelayLoop};
use crate::numeric::{Interval, domain};
use crate::plant::StateSpace;
use crate::proof::Gradient;
use crate::proof::branch_and_bound::{Visit, subdivide};
use crate::proof::enclosure::{Roots, newton};
use crate::proof::interval_matrix::{contraction, exponential, solve};

type Matrix = DMatrix<Interval>;

/// Half-widths of the first enclosure of the half-period, relative to it; narrow first, which succeeds at once.
const RADII: [f64; 5] = [1e-11, 1e-9, 1e-7, 1e-5, 1e-3];
/// Cells of a half-period on which an earlier switching is ruled out.
const CELLS: usize = 4000;
/// Squarings of the return map, which has to shrink within `2^SQUARINGS` half-periods.
const SQUARINGS: u32 = 12;

/// What is proved of a limit cycle of a linear plant, whose matrices count as exactly the numbers they hold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RelayCertificate {
    /// The cycle's half-period lies in here, and no other symmetric cycle's does. Seconds.
    pub half_period_s: Interval,
    /// Slope of the output where it passes the upper level, output units per second.
    pub switching_rate: Interval,
    /// Half-periods after which the linearised return map has shrunk every deviation, in the norm of the largest component:
    /// the cycle attracts what starts near. `None` where that was not proved.
    pub contracts_after: Option<u32>,
    /// Cells used to rule out an earlier switching.
    pub cells: usize,
}

impl RelayLoop {
    /// Existence of the symmetric limit cycle near a half-period by interval Newton on Åström's condition; that the relay does
    /// not switch earlier on it by enclosing the output on the whole half-period; attraction by powers of the
    /// linearised return map. Global uniqueness is not proved.
    ///
    /// ```
    /// use selfosc::nonlinearity::RelayHysteresis;
    /// use selfosc::orbit::RelayLoop;
    /// use selfosc::plant::{StateSpace, TransferFunction};
    /// let plant = StateSpace::realise(&TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0])?)?;
    /// let closed = RelayLoop::new(plant, RelayHysteresis::new(1.0, 0.2, 0.0)?);
    /// let proof = closed.certify(1.8622)?;
    /// assert!(proof.half_period_s.contains(1.862_223_721_734_969) && proof.half_period_s.width() < 1e-12);
    /// assert!(proof.contracts_after.is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`OrbitError::OutOfDomain`]; [`OrbitError::NotSymmetric`]; [`OrbitError::LongDelay`] where the delay exceeds the
    /// half-period; [`OrbitError::NotProved`] where an enclosure stays too wide or the cycle is none.
    pub fn certify(&self, half_period_s: f64) -> Result<RelayCertificate, OrbitError> {
        domain::positive("half_period_s", half_period_s, "s")?;
        let (plant, levels) = (self.plant(), self.symmetric_levels()?);
        if plant.delay_s() >= half_period_s {
            return Err(OrbitError::LongDelay { delay_s: plant.delay_s(), half_period_s });
        }
        let not_proved = |what: &'static str| OrbitError::NotProved { what, half_period_s };
        let half = Half::new(plant, levels);
        let miss = |time: Gradient<1>| {
            let (value, slope) = half.miss(time.value()).unwrap_or((Interval::ENTIRE, Interval::ENTIRE));
            time.chain(value, slope)
        };
        let around =
            |radius: f64| Interval::point(half_period_s) + Interval::symmetric(radius) * Interval::point(half_period_s);
        let found = RADII.into_iter().find_map(|radius| match newton(miss, around(radius), 20) {
            Roots::Unique { enclosure, .. } => Some(enclosure),
            _ => None,
        });
        let period = found.ok_or(not_proved("that the output returns to the level"))?;
        let swing = half.swing(period).ok_or(not_proved("the state at the switching"))?;
        let cells = half.keeps_between(&swing).ok_or(not_proved("that the relay does not switch earlier"))?;
        let contracts_after = half.contracts_after(&swing);
        Ok(RelayCertificate { half_period_s: period, switching_rate: swing.rate, contracts_after, cells })
    }
}

/// The half-period that begins when the plant's input becomes high. Its output has to reach `level` a delay before it ends.
struct Half {
    /// System matrix bordered by the input vector, so that a singular one needs no special case.
    augmented: Matrix,
    output: Matrix,
    input: Interval,
    level: Interval,
    delay: Interval,
}

/// A half-period on which the state changes its sign.
struct Swing {
    period: Interval,
    /// State when the input becomes high; the last component is the input.
    start: Matrix,
    /// When the output passes the level.
    crossing: Interval,
    /// Slope of the output there.
    rate: Interval,
}

impl Half {
    fn new(plant: &StateSpace, levels: Levels) -> Self {
        let order = plant.order();
        let mut augmented = DMatrix::zeros(order + 1, order + 1);
        augmented.view_mut((0, 0), (order, order)).copy_from(plant.a());
        augmented.view_mut((0, order), (order, 1)).copy_from(plant.b());
        let mut output = DMatrix::zeros(1, order + 1);
        output.view_mut((0, 0), (1, order)).copy_from(plant.c());
        Self {
            augmented: augmented.map(Interval::point),
            output: output.map(Interval::point),
            input: Interval::point(levels.high),
            level: Interval::point(levels.upper),
            delay: Interval::point(plant.delay_s()),
        }
    }

    fn order(&self) -> usize {
        self.augmented.nrows() - 1
    }

    /// The flow over any time in `time`: of its middle, times that of the rest, which is short.
    fn flow(&self, time: Interval) -> Option<Matrix> {
        let middle = Interval::point(time.midpoint());
        let exact = exponential(&(&self.augmented * middle))?;
        if time.is_point() { Some(exact) } else { Some(exact * exponential(&(&self.augmented * (time - middle)))?) }
    }

    /// The state that the half-period turns into its opposite: `(1 + exp(a h)) start = -input` part, Åström's condition.
    fn start(&self, flow: &Matrix) -> Option<Matrix> {
        let order = self.order();
        let matrix = DMatrix::identity(order, order) + flow.view((0, 0), (order, order));
        let forced = flow.view((0, order), (order, 1)) * -self.input;
        Some(solve(matrix, forced)?.insert_row(order, self.input))
    }

    /// How far the output is from the level a delay before the end of a half-period, and its derivative by the half-period.
    fn miss(&self, period: Interval) -> Option<(Interval, Interval)> {
        let order = self.order();
        let flow = self.flow(period)?;
        let start = self.start(&flow)?;
        let to_crossing = self.flow(period - self.delay)?;
        // Differentiated: (1 + exp(a h)) start' = -exp(a h) (a start + b u).
        let rate = &flow * &self.augmented * &start;
        let matrix = DMatrix::identity(order, order) + flow.view((0, 0), (order, order));
        let change = solve(matrix, -rate.rows(0, order).into_owned())?.insert_row(order, Interval::ZERO);
        let crossing = &to_crossing * &start;
        let value = self.read(&crossing) - self.level;
        let slope = self.read(&(&self.augmented * &crossing)) + self.read(&(&to_crossing * change));
        Some((value, slope))
    }

    fn swing(&self, period: Interval) -> Option<Swing> {
        let start = self.start(&self.flow(period)?)?;
        let crossing = period - self.delay;
        let rate = self.read(&(&self.augmented * self.flow(crossing)? * &start));
        rate.is_positive().then_some(Swing { period, start, crossing, rate })
    }

    fn read(&self, state: &Matrix) -> Interval {
        (&self.output * state)[(0, 0)]
    }

    /// Cells used to show that the output stays below the level up to the crossing, and afterwards above the opposite one,
    /// which is the same of the next half-period.
    fn keeps_between(&self, swing: &Swing) -> Option<usize> {
        let end = swing.period.upper();
        let lengths = || (2..40).map(|k| end * 0.5f64.powi(k));
        // Rising throughout, it passes the level once.
        let passage = lengths()
            .map(|length| swing.crossing + Interval::symmetric(length))
            .find(|&cell| self.slope(swing, cell).is_some_and(Interval::is_positive))?;
        // The ideal relay without delay starts on the level.
        let starts_on_level = self.level == Interval::ZERO && self.delay == Interval::ZERO;
        let departure = if starts_on_level {
            lengths()
                .map(|length| Interval::ZERO.hull(Interval::point(length)))
                .find(|&cell| self.slope(swing, cell).is_some_and(Interval::is_negative))?
        } else {
            Interval::ZERO
        };
        let before = self.cover(swing, departure.upper(), passage.lower(), |y| (y - self.level).is_negative())?;
        let after = self.cover(swing, passage.upper(), end, |y| (y + self.level).is_positive())?;
        Some(before + after)
    }

    fn slope(&self, swing: &Swing, cell: Interval) -> Option<Interval> {
        Some(self.read(&(&self.augmented * self.flow(cell)? * &swing.start)))
    }

    /// Cells on each of which the output is as it should be.
    fn cover(&self, swing: &Swing, from: f64, to: f64, holds: impl Fn(Interval) -> bool) -> Option<usize> {
        // The ends overlap: nothing lies between them.
        let Some(between) = Interval::new(from, to) else { return (from > to).then_some(0) };
        let found = subdivide([between], CELLS, |&[cell]| {
            let middle = Interval::point(cell.midpoint());
            let (Some(flow), Some(slope)) = (self.flow(middle), self.slope(swing, cell)) else { return Visit::Stop };
            Visit::settled(holds(self.read(&(flow * &swing.start)) + slope * (cell - middle)))
        });
        found.unsettled.is_none().then_some(found.boxes)
    }

    /// Half-periods after which the linearised return map is a contraction. A deviation moves the crossing, hence the end.
    fn contracts_after(&self, swing: &Swing) -> Option<u32> {
        let order = self.order();
        let flow = self.flow(swing.period)?;
        let observed = &self.output * self.flow(swing.crossing)?;
        let along = &self.augmented * &flow * &swing.start * (Interval::ONE / swing.rate);
        let map = flow - along * observed;
        contraction(&map.view((0, 0), (order, order)).into_owned(), SQUARINGS)
    }
}
