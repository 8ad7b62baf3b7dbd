//! Margins and sensitivity over a box of processes, proved by exclusion of zero: a criterion holds for every process of the box
//! where a polynomial in `cos`, `sin` of the delay's phase and the frequency is positive on a box of both.
//!
//! With `L = N exp(-j phi)/D`: `|1 + L| >= 1/M` means `|D + N exp(-j phi)|^2 - |D|^2/M^2 >= 0`. Margins follow with a factor,
//! an angle or a delay as one more variable and `1/M = 0` (zero exclusion principle: Ackermann, *Robust Control*, 2002, ch. 4).

mod exclusion;
mod figures;
mod high_frequency;
mod shape;
mod taylor;

use super::process::{LinearProcess, PARAMETERS, constants};
use super::{ControlError, Gains, RobustCriterion};
use crate::numeric::{Interval, domain};
use exclusion::{Question, is_hurwitz};
use figures::{AN_OCTAVE, FEW, Figures};
pub use high_frequency::loop_gain_beyond;
use shape::Shape;

/// Processes whose parameters lie in intervals: in all of their box, or in an ellipsoid inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessIntervals {
    process: LinearProcess<Interval>,
    shape: Shape,
}

/// What is known of a criterion over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct CriterionRange {
    /// Every process of the box is at least as good: proved. `None` where nothing was proved.
    pub proved: Option<f64>,
    /// Some process of the box is no better.
    pub met: f64,
}

/// Margins of a box of processes, between a proved bound and the worst that was met.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstMargins {
    /// Every process of the box has at least these: proved in interval arithmetic. A factor of one, a phase or a delay of zero says nothing.
    pub at_least: WorstMargin,
    /// Some process of the box has this little of one kind, another of another.
    pub met: WorstMargin,
    /// Whether all four bounds say something.
    pub proved: bool,
    /// The largest sensitivity.
    pub sensitivity: CriterionRange,
}

/// The four margins, without the place where each is met; fields as in [`Margins`](super::Margins).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstMargin {
    /// The gain may grow by less than this factor; `None` for none below [`ProcessIntervals::NO_LIMIT`].
    pub gain: Option<f64>,
    /// The gain may be divided by less than this factor; `None` likewise.
    pub gain_reduction: Option<f64>,
    /// Phase, rad.
    pub phase_rad: f64,
    /// Delay, s, on top of the process' own.
    pub delay_s: f64,
}

impl WorstMargin {
    fn new([gain, gain_reduction, phase_rad, delay_s]: [f64; 4]) -> Self {
        let limited = |factor: f64| Some(factor).filter(|factor| *factor < ProcessIntervals::NO_LIMIT);
        Self { gain: limited(gain), gain_reduction: limited(gain_reduction), phase_rad, delay_s }
    }
}

/// The criterion of a number.
type CriterionOf = fn(f64) -> RobustCriterion;

impl ProcessIntervals {
    /// A gain without a limit is one within this factor.
    pub const NO_LIMIT: f64 = 1e3;

    /// Intervals of a process.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless all are bounded, inertia, times and delay are zero or more, and inertia, drag or stiffness
    /// is above zero throughout.
    pub fn new(process: LinearProcess<Interval>) -> Result<Self, ControlError> {
        let names = [
            "inertia",
            "drag",
            "stiffness",
            "late drag",
            "time of late drag",
            "lag",
            "filter of the sensor",
            "zero",
            "delay",
        ];
        for (index, (name, part)) in names.into_iter().zip(process.parts()).enumerate() {
            domain::finite(name, part.lower(), "")?;
            domain::finite(name, part.upper(), "")?;
            if shape::is_time_or_inertia(index) {
                domain::non_negative(name, part.lower(), "")?;
            }
        }
        let leading = process.alpha.lower().max(process.drag.lower()).max(process.stiffness.lower());
        domain::positive("inertia, drag or stiffness", leading, "")?;
        Ok(Self { process, shape: Shape::Box })
    }

    /// Every process at `centre + sum z_k axes_k` with `sum z_k^2 <= 1`, parameters in the order of [`LinearProcess::parts`], whose
    /// inertia, times and delay are not negative. An axis may be zero.
    ///
    /// # Errors
    /// As [`new`](Self::new), for the intervals of the parameters.
    pub fn ellipsoid(centre: [f64; PARAMETERS], axes: [[f64; PARAMETERS]; shape::AXES]) -> Result<Self, ControlError> {
        Ok(Self { shape: Shape::Ellipsoid { centre, axes }, ..Self::new(shape::hull(centre, axes))? })
    }

    /// All processes of the intervals.
    #[must_use]
    pub fn hull(&self) -> Self {
        Self { shape: Shape::Box, ..*self }
    }

    /// The intervals.
    #[must_use]
    pub fn process(&self) -> &LinearProcess<Interval> {
        &self.process
    }

    /// Whether the criterion is proved for every process, and that each is stable under the gains. `false` says nothing.
    ///
    /// ```
    /// use selfosc::control::{RobustCriterion, Gains, LinearProcess, ProcessIntervals, Structure};
    /// use selfosc::numeric::Interval;
    /// let between = |low, high| Interval::new(low, high).ok_or("reversed");
    /// let none = Interval::ZERO;
    /// let process = LinearProcess {
    ///     alpha: between(0.9, 1.1)?, drag: between(0.2, 0.4)?, delay_s: between(0.15, 0.25)?, lag_s: between(0.0, 0.1)?,
    ///     stiffness: none, memory: none, memory_s: none, filter_s: none, zero_s: none,
    /// };
    /// let gains = Gains::new(Structure::Pd, 0.5, 0.0, 0.9, 0.1)?;
    /// let processes = ProcessIntervals::new(process)?;
    /// assert!(processes.all_have(&gains, RobustCriterion::Sensitivity(2.5)));
    /// assert!(!processes.all_have(&gains, RobustCriterion::Sensitivity(1.05)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn all_have(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> bool {
        self.all_stable(gains) && self.excluded(gains, Question { criterion, on_the_way: false })
    }

    /// Whether every process is proved to be stable under the gains: one without delay is by Routh's table, and no pole passes the
    /// imaginary axis on the way from it to any other.
    #[must_use]
    pub fn all_stable(&self, gains: &Gains<f64>) -> bool {
        let start = LinearProcess { delay_s: 0.0, ..self.middle() };
        let start = LinearProcess::from_parts(start.parts().map(Interval::point));
        let on_the_way = Question { criterion: RobustCriterion::Gain(1.0), on_the_way: true };
        is_hurwitz(&start.open_loop(constants(gains))) && self.excluded(gains, on_the_way)
    }

    /// What the criterion's number is over the box: the worst that was met at middle and corners, and the best number near it that is
    /// proved. `of` makes the criterion from its number.
    ///
    /// # Errors
    /// [`ControlError::NotStabilised`] with a process of the box whose stability under the gains is not proved.
    pub fn enclose(&self, gains: &Gains<f64>, of: fn(f64) -> RobustCriterion) -> Result<CriterionRange, ControlError> {
        Ok(self.ranges(gains)?(of))
    }

    /// The four margins and the sensitivity over the box, each as by [`enclose`](Self::enclose).
    ///
    /// Parameters are taken to be constant; a slope of drag that moves with the speed is covered only as far as it moves slowly.
    ///
    /// ```
    /// use selfosc::control::{LinearProcess, ProcessIntervals, Structure, Tuning};
    /// use selfosc::numeric::Interval;
    /// use selfosc::plant::DragAxis;
    /// let tuning = Tuning::new(&DragAxis::linear(1.0, 0.3)?.with_delay_s(0.2)?, Structure::Pid, 0.7)?;
    /// let between = |low, high| Interval::new(low, high).ok_or("reversed");
    /// let mut parts = [Interval::ZERO; 9];
    /// (parts[0], parts[1], parts[8]) = (between(0.9, 1.1)?, between(0.2, 0.4)?, between(0.15, 0.25)?);
    /// let worst = ProcessIntervals::new(LinearProcess::from_parts(parts))?.worst_margins(tuning.gains())?;
    /// assert!(worst.at_least.phase_rad <= worst.met.phase_rad && worst.met.phase_rad < tuning.margins().phase_rad);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`enclose`](Self::enclose).
    pub fn worst_margins(&self, gains: &Gains<f64>) -> Result<WorstMargins, ControlError> {
        let near = self.ranges(gains)?;
        let margins = [
            near(RobustCriterion::Gain),
            near(RobustCriterion::GainReduction),
            near(RobustCriterion::PhaseRad),
            near(RobustCriterion::DelayS),
        ];
        let none = [1.0, 1.0, 0.0, 0.0];
        Ok(WorstMargins {
            at_least: WorstMargin::new(core::array::from_fn(|k| margins[k].proved.unwrap_or(none[k]))),
            met: WorstMargin::new(margins.map(|range| range.met)),
            proved: margins.iter().all(|range| range.proved.is_some()),
            sensitivity: near(RobustCriterion::Sensitivity),
        })
    }

    /// What is known of each criterion: of processes that are proved to be stable, the best number near the worst that was met which is
    /// proved.
    fn ranges(&self, gains: &Gains<f64>) -> Result<impl Fn(CriterionOf) -> CriterionRange, ControlError> {
        let stable = self.all_stable(gains);
        if !stable && let Some(LinearProcess { alpha, drag, delay_s, .. }) = self.unstable_point(gains) {
            return Err(ControlError::NotStabilised { alpha, drag, delay_s, stabilised_rad_s: None });
        }
        let figures = self.figures(gains, AN_OCTAVE);
        Ok(move |of: CriterionOf| {
            let met = figures.number(of(1.0));
            let number = |share: &f64| match of(1.0) {
                RobustCriterion::Sensitivity(_) => met * (1.0 + share),
                RobustCriterion::Gain(_) | RobustCriterion::GainReduction(_) if !met.is_finite() => Self::NO_LIMIT,
                RobustCriterion::Gain(_) | RobustCriterion::GainReduction(_) => 1.0 + (met - 1.0) * (1.0 - share),
                _ => met * (1.0 - share),
            };
            let has = |number: &f64| self.excluded(gains, Question { criterion: of(*number), on_the_way: false });
            let proved = GIVEN_UP.iter().filter(|_| stable).map(number).find(has);
            CriterionRange { proved, met }
        })
    }

    /// The process in the middle.
    #[must_use]
    pub fn middle(&self) -> LinearProcess<f64> {
        self.nearest([0.0; PARAMETERS])
    }

    /// The process at coordinates from -1 to 1, as many as axes or parameters; `None` outside of an ellipsoid, and where an inertia, a time or
    /// a delay is negative.
    #[must_use]
    pub fn at(&self, coordinates: [f64; PARAMETERS]) -> Option<LinearProcess<f64>> {
        let found = self.shape.at(&self.process, coordinates);
        let wide = self.wide().into_iter().map(|k| Interval::point(coordinates[k])).collect::<Vec<_>>();
        (!self.shape.misses(&wide) && found == self.nearest(coordinates)).then_some(found)
    }

    /// The same, where an inertia, a time or a delay that would be negative is zero.
    pub(crate) fn nearest(&self, coordinates: [f64; PARAMETERS]) -> LinearProcess<f64> {
        let parts = self.shape.at(&self.process, coordinates).parts();
        let not_negative = |k: usize| if shape::is_time_or_inertia(k) { parts[k].max(0.0) } else { parts[k] };
        LinearProcess::from_parts(core::array::from_fn(not_negative))
    }

    /// Coordinates along which processes differ.
    pub(crate) fn wide(&self) -> Vec<usize> {
        let sides = self.shape.sides(&self.process);
        (0..PARAMETERS).filter(|k| !sides[*k].is_point()).collect()
    }

    /// The corners of a box, or both ends of each axis of an ellipsoid; what is negative there and must not be is zero.
    #[must_use]
    pub fn corners(&self) -> Vec<LinearProcess<f64>> {
        let wide = self.wide();
        let count = match self.shape {
            Shape::Box => 1 << wide.len(),
            Shape::Ellipsoid { .. } => 2 * wide.len(),
        };
        let corner = |number: usize| {
            let mut coordinates = [0.0; PARAMETERS];
            for (place, &k) in wide.iter().enumerate() {
                let sign = |up: bool| if up { 1.0 } else { -1.0 };
                coordinates[k] = match self.shape {
                    Shape::Box => sign(number >> place & 1 == 1),
                    Shape::Ellipsoid { .. } if number / 2 == place => sign(number & 1 == 1),
                    Shape::Ellipsoid { .. } => 0.0,
                };
            }
            self.nearest(coordinates)
        };
        (0..count).map(corner).collect()
    }

    /// Points of the box: its middle, and its corners.
    fn points(&self) -> Vec<LinearProcess<f64>> {
        core::iter::once(self.middle()).chain(self.corners()).collect()
    }

    /// Whether the middle and the corners of the box meet the criterion, up to rounding: no proof.
    #[must_use]
    pub fn meets(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> bool {
        criterion.is_met_by(self.worst_number(gains, criterion))
    }

    /// The worst number of the criterion at the middle and the corners of the box, up to rounding: no proof.
    #[must_use]
    pub fn worst_number(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> f64 {
        self.figures(gains, FEW).number(criterion)
    }

    /// The worst figures at the middle and the corners of the box.
    fn figures(&self, gains: &Gains<f64>, an_octave: i32) -> Figures {
        let high = self.highest_frequency(gains, RobustCriterion::Gain(1.0)).unwrap_or(f64::INFINITY);
        self.points().iter().map(|point| Figures::of(point, gains, high, an_octave)).fold(Figures::NONE, Figures::worse)
    }

    /// Whether the middle and the corners of the box are each proved to be stable; nothing is said of the processes between.
    #[must_use]
    pub fn points_stable(&self, gains: &Gains<f64>) -> bool {
        self.unstable_point(gains).is_none()
    }

    /// A point of the box that is not proved to be stable.
    fn unstable_point(&self, gains: &Gains<f64>) -> Option<LinearProcess<f64>> {
        self.points().into_iter().find(|process| {
            let process = LinearProcess::from_parts(process.parts().map(Interval::point));
            !Self { process, shape: Shape::Box }.all_stable(gains)
        })
    }
}

/// What is given up of the worst that was met, so that a proof is found: the least first.
const GIVEN_UP: [f64; 4] = [0.003, 0.02, 0.1, 0.3];
