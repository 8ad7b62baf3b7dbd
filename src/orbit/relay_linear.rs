//! Exact limit cycles of a linear plant under a relay with hysteresis.

use core::ops::RangeInclusive;

use nalgebra::{Complex, Matrix2, Vector2};
use rayon::prelude::*;

use super::OrbitError;
use super::extrema::Extrema;
use super::relay_cycle::{Cycle, Levels};
use super::relay_multiplier::multipliers;
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{domain, scan};
use crate::plant::StateSpace;

/// The most samples a scan over periods takes.
const SAMPLES: usize = 20_000;
/// The most cycles that are followed. Where many periods fit into the delay there are as many, and the work grows as the square.
const CYCLES: usize = 150;
/// Shares of the period with positive command at which the scan for asymmetric cycles looks: 48 midpoints.
const SHARES: u32 = 48;
/// How far past a level the output may be before it counts as an earlier switching, relative to the output's size.
const PAST: f64 = 1e-9;
/// A multiplier nearer to the unit circle than this leaves stability open.
const NEUTRAL: f64 = 1e-9;

/// A linear plant in a loop with a relay: relay input `reference - y`, plant input `relay output + disturbance`, delayed.
///
/// ```
/// use selfosc::nonlinearity::RelayHysteresis;
/// use selfosc::orbit::RelayLoop;
/// use selfosc::plant::{StateSpace, TransferFunction};
/// let plant = StateSpace::realise(&TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0])?)?;
/// let orbits = RelayLoop::new(plant, RelayHysteresis::new(1.0, 0.2, 0.0)?).orbits(0.1..=100.0)?;
/// assert_eq!(orbits.len(), 1);
/// assert!((orbits[0].time_positive_s() - 1.862_223_721_734_969).abs() < 1e-14);
/// assert_eq!(orbits[0].is_stable(), Some(true));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RelayLoop {
    plant: StateSpace,
    relay: RelayHysteresis<f64>,
    reference: f64,
    disturbance: f64,
}

impl RelayLoop {
    /// With reference and disturbance zero.
    #[must_use]
    pub fn new(plant: StateSpace, relay: RelayHysteresis<f64>) -> Self {
        Self { plant, relay, reference: 0.0, disturbance: 0.0 }
    }
    /// A constant reference, in output units. On an integrating plant it shifts the cycle and does nothing else.
    ///
    /// # Errors
    /// [`OrbitError::OutOfDomain`] unless it is finite.
    pub fn with_reference(self, reference: f64) -> Result<Self, OrbitError> {
        Ok(Self { reference: domain::finite("reference", reference, "output units")?, ..self })
    }
    /// A constant disturbance at the plant's input, in input units.
    ///
    /// # Errors
    /// [`OrbitError::OutOfDomain`] unless it is finite.
    pub fn with_disturbance(self, disturbance: f64) -> Result<Self, OrbitError> {
        Ok(Self { disturbance: domain::finite("disturbance", disturbance, "input units")?, ..self })
    }

    /// All limit cycles with one switching each way in a period of the stated range, shortest first.
    ///
    /// Each is exact to rounding, and no earlier switching happens on it: the output's extrema between switchings are
    /// isolated from bounds of its derivatives. That none is missed is as sure as the scan is fine: it follows every
    /// turn of the delay and of the plant's own oscillations in at least 20 samples, and, on a plant without
    /// integrator, looks at 48 shares of positive command between 0 and 1. The delay may exceed the period. Cycles
    /// with more switchings in a period are not looked for, nor are periods over which an unstable plant magnifies
    /// rounding to more than 1e-9 of the cycle.
    ///
    /// # Errors
    /// [`OrbitError::Drift`] where an integrating plant cannot have one; [`OrbitError::OutOfDomain`],
    /// [`OrbitError::TooManySamples`], [`OrbitError::TooManyCycles`], [`OrbitError::TooManyPieces`], [`OrbitError::Plant`].
    pub fn orbits(&self, period_s: RangeInclusive<f64>) -> Result<Vec<RelayOrbit>, OrbitError> {
        let nodes = self.nodes(&period_s)?;
        let levels = self.levels();
        let cycles: Vec<Cycle> = if self.plant.is_integrating() {
            // The input's mean vanishes, which fixes the share of positive command.
            let share = levels.low / (levels.low - levels.high);
            if !(0.0 < share && share < 1.0) {
                let (disturbance, offset, level) = (self.disturbance, self.relay.offset(), self.relay.level());
                return Err(OrbitError::Drift { disturbance, offset, level });
            }
            let cycle = |period: f64| Cycle::new(&self.plant, true, levels, (share * period, (1.0 - share) * period));
            let miss = |period: f64| Some(cycle(period)?.misses(&self.plant).1);
            scan::roots(&nodes, miss).into_iter().filter_map(cycle).collect()
        } else {
            self.static_cycles(&nodes, levels)
        };
        self.genuine(cycles)
    }

    /// The limit cycles that repeat themselves with the opposite sign after half a period; promises as for
    /// [`orbits`](Self::orbits), faster on a plant without integrator.
    ///
    /// # Errors
    /// [`OrbitError::NotSymmetric`] where a constant input or reference rules them out; else as
    /// [`orbits`](Self::orbits).
    pub fn symmetric_orbits(&self, period_s: RangeInclusive<f64>) -> Result<Vec<RelayOrbit>, OrbitError> {
        let nodes = self.nodes(&period_s)?;
        let levels = self.symmetric_levels()?;
        let cycle = |period: f64| Cycle::symmetric(&self.plant, levels, 0.5 * period);
        let miss = |period: f64| Some(cycle(period)?.misses(&self.plant).1);
        self.genuine(scan::roots(&nodes, miss).into_iter().filter_map(cycle).collect())
    }

    /// The levels, unless they rule symmetric cycles out.
    pub(super) fn symmetric_levels(&self) -> Result<Levels, OrbitError> {
        let (constant_input, reference) = (self.constant_input(), self.reference);
        if constant_input != 0.0 || (reference != 0.0 && !self.plant.is_integrating()) {
            return Err(OrbitError::NotSymmetric { constant_input, reference });
        }
        Ok(self.levels())
    }

    pub(super) fn plant(&self) -> &StateSpace {
        &self.plant
    }

    fn constant_input(&self) -> f64 {
        self.relay.offset() + self.disturbance
    }

    /// The reference of an integrating plant is taken as zero here and added to the outputs reported.
    fn levels(&self) -> Levels {
        let (centre, input) = (self.reference - self.shift(), self.constant_input());
        Levels {
            high: input + self.relay.level(),
            low: input - self.relay.level(),
            lower: centre - self.relay.half_width(),
            upper: centre + self.relay.half_width(),
        }
    }
    fn shift(&self) -> f64 {
        if self.plant.is_integrating() { self.reference } else { 0.0 }
    }

    /// Periods to look at: steps of 2 %, less where the delay or an oscillation of the plant turns faster.
    fn nodes(&self, period_s: &RangeInclusive<f64>) -> Result<Vec<f64>, OrbitError> {
        let (from_s, to_s) = (*period_s.start(), *period_s.end());
        domain::ascending(["shortest period", "longest period"], period_s, "s")?;
        let fastest = self.plant.poles()?.iter().map(|pole| pole.im.abs()).fold(0.0, f64::max);
        let (delay, mut nodes, mut period) = (self.plant.delay_s(), Vec::new(), from_s);
        while period < to_s {
            if nodes.len() >= SAMPLES {
                return Err(OrbitError::TooManySamples { from_s, to_s, limit: SAMPLES });
            }
            nodes.push(period);
            let turning = (0.05 * period * period / delay).min(0.3 / fastest);
            period += turning.min(0.02 * period);
        }
        nodes.push(to_s);
        Ok(nodes)
    }

    /// Both misses vanish on a plant without integrator: cells of a grid in which their linear parts do, then Newton.
    fn static_cycles(&self, nodes: &[f64], levels: Levels) -> Vec<Cycle> {
        let cycle = |period: f64, share: f64| {
            if !(0.0 < share && share < 1.0 && period > 0.0) {
                return None;
            }
            Cycle::new(&self.plant, false, levels, (share * period, (1.0 - share) * period))
        };
        // Half the sum and the difference of the misses: bias and swing.
        let miss = |at: Vector2<f64>| {
            let (on, off) = cycle(at[0].exp(), at[1])?.misses(&self.plant);
            Some(Vector2::new(0.5 * (on + off), off - on))
        };
        let share = |index: u32| (f64::from(index) + 0.5) / f64::from(SHARES);
        let column = |period: &f64| -> Vec<(Vector2<f64>, Option<Vector2<f64>>)> {
            let at = |index| Vector2::new(period.ln(), share(index));
            (0..SHARES).map(at).map(|at| (at, miss(at))).collect()
        };
        let mut found: Vec<Vector2<f64>> = Vec::new();
        let columns: Vec<_> = nodes.par_iter().map(column).collect();
        for (last, next) in columns.iter().zip(columns.iter().skip(1)) {
            for (here, (right, above)) in last.iter().zip(next.iter().zip(last.iter().skip(1))) {
                let (Some(value), Some(at_right), Some(at_above)) = (here.1, right.1, above.1) else { continue };
                let cell = Vector2::new(right.0[0] - here.0[0], above.0[1] - here.0[1]);
                let slopes = Matrix2::from_columns(&[at_right - value, at_above - value]);
                let Some(step) = slopes.lu().solve(&-value) else { continue };
                if step.amax() > 2.0 {
                    continue;
                }
                let guess = here.0 + step.component_mul(&cell);
                let Some(root) = newton(miss, guess, cell) else { continue };
                let inside = root[0] >= nodes[0].ln() && root[0] <= nodes[nodes.len() - 1].ln();
                if inside && found.iter().all(|other| (other - root).amax() > 1e-7) {
                    found.push(root);
                }
            }
        }
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        found.iter().filter_map(|root| cycle(root[0].exp(), root[1])).collect()
    }

    /// The cycles on which the relay switches when it should and not before.
    fn genuine(&self, cycles: Vec<Cycle>) -> Result<Vec<RelayOrbit>, OrbitError> {
        if cycles.len() > CYCLES {
            return Err(OrbitError::TooManyCycles { cycles: cycles.len(), limit: CYCLES });
        }
        let mut orbits = Vec::new();
        for cycle in cycles {
            orbits.extend(self.orbit(cycle)?);
        }
        Ok(orbits)
    }

    fn orbit(&self, cycle: Cycle) -> Result<Option<RelayOrbit>, OrbitError> {
        let plant = &self.plant;
        let (on, off, period) = (cycle.command_on(plant), cycle.command_off(plant), cycle.period());
        let levels = cycle.levels();
        let output = |time: f64| plant.output(&cycle.state(plant, time));
        let mut ends = vec![0.0, cycle.positive, on, off, period];
        ends.sort_by(f64::total_cmp);
        ends.dedup();

        // By the slope too, as a sinusoid's amplitude would follow from it: under the ideal relay the output is zero here.
        let size = |time: f64| {
            let (state, turn) = (cycle.state(plant, time), period / core::f64::consts::TAU);
            plant.output(&state).abs().max(turn * plant.output(&plant.rate(&state, cycle.input(time))).abs())
        };
        let scale = [on, off, 0.0, cycle.positive].map(size).into_iter().fold(0.0, f64::max);
        let slack = PAST * scale.max(levels.upper - levels.lower);
        let extrema = Extrema::new(plant, scale);
        let (mut minimum, mut maximum) = (f64::INFINITY, f64::NEG_INFINITY);
        for pair in ends.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            // Which command holds here: the positive one from `on` up to `off`, around the end of the period or not.
            let middle = 0.5 * (from + to);
            let positive = (middle - on).rem_euclid(period) < (off - on).rem_euclid(period);
            let mut times = extrema.times(&cycle.state(plant, from), cycle.input(middle), to - from)?;
            times.extend([0.0, to - from]);
            for value in times.into_iter().map(|time| output(from + time)) {
                let early = if positive { value > levels.upper + slack } else { value < levels.lower - slack };
                if early {
                    return Ok(None);
                }
                (minimum, maximum) = (minimum.min(value), maximum.max(value));
            }
        }
        let multipliers = multipliers(plant, &cycle)?;
        let shift = self.shift();
        Ok(Some(RelayOrbit {
            plant: plant.clone(),
            cycle,
            shift,
            minimum: minimum + shift,
            maximum: maximum + shift,
            multipliers: multipliers.unwrap_or_default(),
        }))
    }
}

/// Newton's method with difference quotients for two unknowns, kept near the cell it starts from. Apart from
/// [`increasing_root`](crate::numeric::increasing_root), which needs one unknown and a bracket; from the balance's own, because
/// a start that leaves its cell is dropped here, not damped.
fn newton(
    miss: impl Fn(Vector2<f64>) -> Option<Vector2<f64>>,
    start: Vector2<f64>,
    cell: Vector2<f64>,
) -> Option<Vector2<f64>> {
    let mut at = start;
    let mut last = f64::INFINITY;
    for _ in 0..40 {
        let value = miss(at)?;
        let mut slopes = Matrix2::zeros();
        for axis in 0..2 {
            let mut offset = Vector2::zeros();
            offset[axis] = 1e-6;
            slopes.set_column(axis, &((miss(at + offset)? - miss(at - offset)?) / 2e-6));
        }
        let step = slopes.lu().solve(&value)?;
        at -= step;
        if (at - start).component_div(&cell).amax() > 4.0 {
            return None;
        }
        // Down to where rounding stops the steps from shrinking.
        if step.amax() < 1e-9 && step.amax() >= 0.5 * last {
            return Some(at);
        }
        last = step.amax();
        if last == 0.0 {
            return Some(at);
        }
    }
    (last < 1e-9).then_some(at)
}

/// A limit cycle of a [`RelayLoop`].
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "Parts")]
pub struct RelayOrbit {
    plant: StateSpace,
    cycle: Cycle,
    shift: f64,
    minimum: f64,
    maximum: f64,
    multipliers: Vec<Complex<f64>>,
}

/// An orbit as it is written, not yet checked.
#[derive(serde::Deserialize)]
struct Parts {
    plant: StateSpace,
    cycle: Cycle,
    shift: f64,
    minimum: f64,
    maximum: f64,
    multipliers: Vec<Complex<f64>>,
}

impl TryFrom<Parts> for RelayOrbit {
    type Error = &'static str;

    fn try_from(parts: Parts) -> Result<Self, &'static str> {
        let Parts { plant, cycle, shift, minimum, maximum, multipliers } = parts;
        if !cycle.belongs_to(&plant) {
            return Err("the cycle's states must be as many as the plant's order; write both from the same orbit");
        }
        Ok(Self { plant, cycle, shift, minimum, maximum, multipliers })
    }
}

impl RelayOrbit {
    /// Period, seconds.
    #[must_use]
    pub fn period_s(&self) -> f64 {
        self.cycle.period()
    }
    /// Time per period with positive command, seconds.
    #[must_use]
    pub fn time_positive_s(&self) -> f64 {
        self.cycle.positive
    }
    /// Time per period with negative command, seconds.
    #[must_use]
    pub fn time_negative_s(&self) -> f64 {
        self.cycle.negative
    }
    /// The least output.
    #[must_use]
    pub fn minimum(&self) -> f64 {
        self.minimum
    }
    /// The largest output.
    #[must_use]
    pub fn maximum(&self) -> f64 {
        self.maximum
    }
    /// Half the output's range, X_m.
    #[must_use]
    pub fn amplitude(&self) -> f64 {
        0.5 * (self.maximum - self.minimum)
    }
    /// The middle of the output's range, x_0.
    #[must_use]
    pub fn bias(&self) -> f64 {
        0.5 * (self.maximum + self.minimum)
    }
    /// The output, periodic, with the input's step up at time zero.
    #[must_use]
    pub fn output(&self, time_s: f64) -> f64 {
        let inside = time_s.rem_euclid(self.period_s());
        self.plant.output(&self.cycle.state(&self.plant, inside)) + self.shift
    }
    /// Eigenvalues of the return map, largest first; empty where the output grazes a level, so that there is none. With
    /// switchings under way in the delay, the map acts on their instants too; at least one eigenvalue is zero.
    #[must_use]
    pub fn multipliers(&self) -> &[Complex<f64>] {
        &self.multipliers
    }
    /// Whether small deviations die out: all multipliers inside the unit circle. `None` within 1e-9 of the circle or
    /// where the output grazes a level.
    #[must_use]
    pub fn is_stable(&self) -> Option<bool> {
        let largest = self.multipliers.first()?.norm();
        ((largest - 1.0).abs() > NEUTRAL).then_some(largest < 1.0)
    }
}
