//! Margins and sensitivity over a box of processes, proved by exclusion of zero: a criterion holds for every process of the box
//! where a polynomial in `cos`, `sin` of the delay's phase and the frequency is positive on a box of both.
//!
//! With `L = N exp(-j phi)/D`: `|1 + L| >= 1/M` means `|D + N exp(-j phi)|^2 - |D|^2/M^2 >= 0`. Margins follow with a factor,
//! an angle or a delay as one more variable and `1/M = 0` (zero exclusion principle: Ackermann, *Robust Control*, 2002, ch. 4).

mod figures;
mod shape;

use super::process::{Fraction, LinearProcess, PARAMETERS, constants};
use super::{ControlError, Gains, RobustCriterion};
use crate::numeric::{Gradient, Interval, Real, domain};
use figures::{AN_OCTAVE, FEW, Figures};
use shape::Shape;

impl RobustCriterion {
    /// The variable that the criterion adds, and `1/M^2`.
    fn variable(self) -> (Interval, f64) {
        let between = |a: f64, b: f64| Interval::new(a, b).unwrap_or(Interval::ENTIRE);
        match self {
            Self::Sensitivity(most) => (Interval::ONE, 1.0 / (most * most)),
            Self::Gain(factor) => (between(1.0, factor.max(1.0)), 0.0),
            Self::GainReduction(factor) => (between((1.0 / factor).min(1.0), 1.0), 0.0),
            Self::PhaseRad(angle) => (between(-angle.abs(), angle.abs()), 0.0),
            Self::DelayS(time_s) => (between(0.0, time_s.max(0.0)), 0.0),
        }
    }

    /// `|D + N exp(-j phi)|^2 - |D|^2/M^2`.
    fn excess<T: Real>(self, process: &LinearProcess<T>, gains: &Gains<f64>, omega: T, extra: T) -> T {
        let loop_ = process.open_loop(constants(gains));
        self.excess_of(&loop_, process.delay_s, omega, extra)
    }

    fn excess_of<T: Real>(self, open_loop: &Fraction<T>, delay_s: T, omega: T, extra: T) -> T {
        let share = T::from_f64(self.variable().1);
        let angle = match self {
            Self::PhaseRad(_) => omega * delay_s + extra,
            Self::DelayS(_) => omega * (delay_s + extra),
            _ => omega * delay_s,
        };
        let [[re, im], [below_re, below_im]] = open_loop.parts(omega, angle);
        let factor = match self {
            Self::Gain(_) | Self::GainReduction(_) => extra,
            _ => T::one(),
        };
        let sum = (below_re + factor * re).square() + (below_im + factor * im).square();
        match self {
            Self::Sensitivity(_) => sum - share * (below_re.square() + below_im.square()),
            _ => sum,
        }
    }
}

/// Parameters, frequency, and the criterion's own variable.
const VARIABLES: usize = PARAMETERS + 2;
const OMEGA: usize = PARAMETERS;
const EXTRA: usize = PARAMETERS + 1;
/// Boxes that one proof may take: some two seconds.
const BOXES: usize = 100_000;
/// Octaves below and above 1 rad/s in which the end of the frequencies is looked for.
const OCTAVES: i32 = 100;
/// Sides smaller than this, relative to the whole, are not halved any more.
const SMALLEST: f64 = 1e-12;

/// Processes whose parameters lie in intervals: in all of their box, or in a parallelepiped inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProcessIntervals {
    process: LinearProcess<Interval>,
    shape: Shape,
}

/// A criterion, or stability on the way from no delay to the process' own.
#[derive(Clone, Copy, Debug)]
struct Question {
    criterion: RobustCriterion,
    on_the_way: bool,
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
    fn new(gain: f64, gain_reduction: f64, phase_rad: f64, delay_s: f64) -> Self {
        let limited = |factor: f64| Some(factor).filter(|factor| *factor < ProcessIntervals::NO_LIMIT);
        Self { gain: limited(gain), gain_reduction: limited(gain_reduction), phase_rad, delay_s }
    }
}

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

    /// Every process at `centre + sum z_k directions_k` with all `|z_k| <= 1`, parameters in the order of [`LinearProcess::parts`], whose
    /// inertia, times and delay are not negative. At most nine directions count.
    ///
    /// # Errors
    /// As [`new`](Self::new), for the intervals of the parameters.
    pub fn along(centre: [f64; PARAMETERS], directions: &[[f64; PARAMETERS]]) -> Result<Self, ControlError> {
        let shape = Shape::along(centre, directions);
        Ok(Self { shape, ..Self::new(shape.hull())? })
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

    /// Whether the excess is above zero at every frequency, for every process.
    fn excluded(&self, gains: &Gains<f64>, question: Question) -> bool {
        let Some(highest) = self.highest_frequency(gains, question.criterion) else { return false };
        let Some(omega) = Interval::new(0.0, highest) else { return false };
        let mut domain = [Interval::ZERO; VARIABLES];
        domain[..PARAMETERS].copy_from_slice(&self.shape.sides(&self.process));
        (domain[OMEGA], domain[EXTRA]) = (omega, question.criterion.variable().0);
        if question.on_the_way {
            domain[EXTRA] = Interval::ZERO.hull(Interval::ONE);
        }
        let (mut open, mut boxes) = (vec![domain], 0);
        while let Some(at) = open.pop() {
            boxes += 1;
            let Some((face, side)) = self.undecided(question, gains, at) else { continue };
            let large_enough = face[side].width() > SMALLEST * domain[side].width();
            if boxes >= BOXES || !large_enough {
                return false;
            }
            let (lower, upper) = halves(face[side], side == OMEGA);
            for half in [upper, lower] {
                let mut part = face;
                part[side] = half;
                open.push(part);
            }
        }
        true
    }

    /// The excess as a function of the variables.
    fn excess<T: Real>(&self, question: Question, gains: &Gains<f64>, variables: [T; VARIABLES]) -> T {
        let process = self.shape.process(core::array::from_fn(|k| variables[k]));
        let (omega, extra) = (variables[OMEGA], variables[EXTRA]);
        if question.on_the_way {
            let sooner = LinearProcess { delay_s: process.delay_s * extra, ..process };
            question.criterion.excess(&sooner, gains, omega, T::one())
        } else {
            question.criterion.excess(&process, gains, omega, extra)
        }
    }

    /// `None` where the excess is positive on the box; else a face of the box on which it is least, and the side of that face along
    /// which it changes most.
    fn undecided(
        &self,
        question: Question,
        gains: &Gains<f64>,
        mut at: [Interval; VARIABLES],
    ) -> Option<([Interval; VARIABLES], usize)> {
        loop {
            if self.excess(question, gains, at).is_positive() {
                return None;
            }
            let slopes = self.excess(question, gains, Gradient::variables(at)).slopes();
            // A function that rises along a side is least at its lower end.
            let mut fell = false;
            for (side, slope) in at.iter_mut().zip(slopes) {
                let end = if slope.lower() >= 0.0 {
                    side.lower()
                } else if slope.upper() <= 0.0 {
                    side.upper()
                } else {
                    continue;
                };
                fell |= !side.is_point();
                *side = Interval::point(end);
            }
            if fell {
                continue;
            }
            // Mean value form: F(x) >= F(m) - sum |F'_i| r_i.
            let middle = at.map(|side| Interval::point(side.midpoint()));
            let form = (0..VARIABLES)
                .filter(|k| !at[*k].is_point())
                .fold(self.excess(question, gains, middle), |sum, k| sum + slopes[k] * (at[k] - middle[k]));
            if form.is_positive() {
                return None;
            }
            let size = |k: &usize| if at[*k].is_point() { -1.0 } else { slopes[*k].magnitude() * at[*k].width() };
            return (0..VARIABLES).max_by(|a, b| size(a).total_cmp(&size(b))).map(|side| (at, side));
        }
    }

    /// A frequency above which `|L|` is too small for the criterion to fail, for every process.
    fn highest_frequency(&self, gains: &Gains<f64>, criterion: RobustCriterion) -> Option<f64> {
        let factor = match criterion {
            RobustCriterion::Gain(factor) => factor.max(1.0),
            _ => 1.0,
        };
        let most = match criterion {
            RobustCriterion::Sensitivity(most) => 1.0 - 1.0 / most,
            _ => 1.0,
        };
        (-OCTAVES..OCTAVES).map(|k| 2f64.powi(k)).find(|omega| {
            let bound = self.loop_gain_beyond(gains, *omega);
            bound.is_some_and(|bound| (Interval::point(factor) * bound).upper() < most)
        })
    }

    /// A bound of `|L(s)|` for every `s` with `|s| >= omega` and `Re s >= 0`, where no pole of the closed loop comes from infinity
    /// either, whatever degree is lost where a time constant reaches zero. With `u = 1/|s|`:
    ///
    /// - `|1 + T s|^2 = 1 + 2 T Re s + T^2 |s|^2 >= (u^2 + T^2)/u^2`, hence at least 1 for a `T` that may be zero;
    /// - `Re (alpha s + drag + memory/(memory_s s + 1)) >= drag + min(0, memory)`, hence
    ///   `|body| >= (drag + min(0, memory) - |stiffness| u)/u`; without inertia and of positive real parts, `|body| >= stiffness`;
    /// - `|body| >= (alpha - (|drag| + |memory|) u - |stiffness| u^2)/u^2`.
    fn loop_gain_beyond(&self, gains: &Gains<f64>, omega: f64) -> Option<Interval> {
        let LinearProcess { alpha, drag, stiffness, memory, lag_s, filter_s, zero_s, .. } = self.process;
        let u = Interval::new(0.0, 1.0 / omega)?;
        let size = |part: Interval| Interval::point(part.magnitude());
        let least = |part: Interval| Interval::point(part.lower());
        let negative = Interval::point(memory.lower().min(0.0));
        let passive = alpha == Interval::ZERO && drag.lower() >= 0.0 && memory.lower() >= 0.0;
        let bodies = [
            (2, least(alpha) - (size(drag) + size(memory)) * u - size(stiffness) * u.square()),
            (1, least(drag) + negative - size(stiffness) * u),
            (0, if passive { least(stiffness) } else { Interval::ZERO }),
        ];
        let [proportional, integral, derivative, gain_filter_s] = constants::<Interval>(gains);
        let controller = proportional + integral * u;
        // The derivative without a filter, and a zero, grow with 1/u.
        let unfiltered = derivative.is_positive() && !gain_filter_s.is_positive();
        let controller = if unfiltered {
            controller * u + derivative
        } else if derivative.is_positive() {
            controller + derivative / (u.square() + gain_filter_s.square()).sqrt()
        } else {
            controller
        };
        let zero = if zero_s == Interval::ZERO { Interval::ONE } else { u + size(zero_s) };
        let lags = [lag_s, filter_s].map(least);
        let slow = lags.into_iter().filter(|time| time.is_positive());
        let numerator = slow.clone().fold(controller * zero, |sum, time| sum / (u.square() + time.square()).sqrt());
        let falls = slow.count();
        let rises = usize::from(unfiltered) + usize::from(zero_s != Interval::ZERO);
        let bounds = bodies.into_iter().filter_map(|(degree, body)| {
            let power = (degree + falls).checked_sub(rises)?;
            body.is_positive().then(|| Interval::point((numerator * self::power(u, power) / body).upper()))
        });
        bounds.min_by(|a, b| a.upper().total_cmp(&b.upper()))
    }

    /// What the criterion's number is over the box: the worst that was met at middle and corners, and the best number near it that is
    /// proved. `of` makes the criterion from its number.
    ///
    /// # Errors
    /// [`ControlError::NotStabilised`] with a process of the box whose stability under the gains is not proved.
    pub fn enclose(&self, gains: &Gains<f64>, of: fn(f64) -> RobustCriterion) -> Result<CriterionRange, ControlError> {
        let (figures, stable) = self.figures_met(gains)?;
        Ok(self.near(gains, of, &figures, stable))
    }

    /// The four margins over the box, each as by [`enclose`](Self::enclose).
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
        let (figures, stable) = self.figures_met(gains)?;
        let near = |of| self.near(gains, of, &figures, stable);
        let [gain, reduction, phase, delay] = [
            near(RobustCriterion::Gain),
            near(RobustCriterion::GainReduction),
            near(RobustCriterion::PhaseRad),
            near(RobustCriterion::DelayS),
        ];
        let proved = |range: CriterionRange, none: f64| range.proved.unwrap_or(none);
        Ok(WorstMargins {
            at_least: WorstMargin::new(
                proved(gain, 1.0),
                proved(reduction, 1.0),
                proved(phase, 0.0),
                proved(delay, 0.0),
            ),
            met: WorstMargin::new(gain.met, reduction.met, phase.met, delay.met),
            proved: [gain, reduction, phase, delay].iter().all(|range| range.proved.is_some()),
        })
    }

    /// The best number near the worst that was met which is proved, of processes that are proved to be stable.
    fn near(
        &self,
        gains: &Gains<f64>,
        of: fn(f64) -> RobustCriterion,
        figures: &Figures,
        stable: bool,
    ) -> CriterionRange {
        let met = figures.number(of(1.0));
        let shares = GIVEN_UP.iter().filter(|_| stable);
        let numbers = shares.map(|share| match of(1.0) {
            RobustCriterion::Sensitivity(_) => met * (1.0 + share),
            RobustCriterion::Gain(_) | RobustCriterion::GainReduction(_) if !met.is_finite() => Self::NO_LIMIT,
            RobustCriterion::Gain(_) | RobustCriterion::GainReduction(_) => 1.0 + (met - 1.0) * (1.0 - share),
            _ => met * (1.0 - share),
        });
        let proved = numbers
            .into_iter()
            .find(|number| self.excluded(gains, Question { criterion: of(*number), on_the_way: false }));
        CriterionRange { proved, met }
    }
}

impl ProcessIntervals {
    /// The process in the middle.
    #[must_use]
    pub fn middle(&self) -> LinearProcess<f64> {
        self.process_at([0.0; PARAMETERS])
    }

    /// The process at coordinates from -1 to 1, as many as directions or parameters; `None` where an inertia, a time or a delay is negative.
    #[must_use]
    pub fn at(&self, coordinates: [f64; PARAMETERS]) -> Option<LinearProcess<f64>> {
        let found = self.shape.at(&self.process, coordinates);
        (found == self.process_at(coordinates)).then_some(found)
    }

    /// The same, where an inertia, a time or a delay that would be negative is zero.
    fn process_at(&self, coordinates: [f64; PARAMETERS]) -> LinearProcess<f64> {
        let parts = self.shape.at(&self.process, coordinates).parts();
        let not_negative = |k: usize| if shape::is_time_or_inertia(k) { parts[k].max(0.0) } else { parts[k] };
        LinearProcess::from_parts(core::array::from_fn(not_negative))
    }

    /// The corners; what is negative there and must not be is zero.
    #[must_use]
    pub fn corners(&self) -> Vec<LinearProcess<f64>> {
        let sides = self.shape.sides(&self.process);
        let wide: Vec<usize> = (0..PARAMETERS).filter(|k| !sides[*k].is_point()).collect();
        let corner = |bits: usize| {
            let mut coordinates = [0.0; PARAMETERS];
            for (place, &k) in wide.iter().enumerate() {
                coordinates[k] = if bits >> place & 1 == 0 { -1.0 } else { 1.0 };
            }
            self.process_at(coordinates)
        };
        (0..1 << wide.len()).map(corner).collect()
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

    /// The worst figures, and whether every process is proved to be stable.
    fn figures_met(&self, gains: &Gains<f64>) -> Result<(Figures, bool), ControlError> {
        let stable = self.all_stable(gains);
        match self.unstable_point(gains).filter(|_| !stable) {
            Some(LinearProcess { alpha, drag, delay_s, .. }) => {
                Err(ControlError::NotStabilised { alpha, drag, delay_s, stabilised_rad_s: None })
            }
            None => Ok((self.figures(gains, AN_OCTAVE), stable)),
        }
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

fn power(base: Interval, exponent: usize) -> Interval {
    (0..exponent).fold(Interval::ONE, |product, _| product * base)
}

/// Halves in the middle; of a wide range of frequencies in its geometric middle.
fn halves(whole: Interval, of_frequency: bool) -> (Interval, Interval) {
    let (low, high) = (whole.lower(), whole.upper());
    let middle = match (of_frequency, low > 0.0) {
        (true, true) if high > 2.0 * low => (low * high).sqrt(),
        (true, false) => high / 4.0,
        _ => return whole.bisect(),
    };
    match (Interval::new(low, middle), Interval::new(middle, high)) {
        (Some(lower), Some(upper)) => (lower, upper),
        _ => whole.bisect(),
    }
}

/// Whether all roots of numerator plus denominator decay: the first column of Routh's table is positive, in intervals.
fn is_hurwitz(open_loop: &Fraction<Interval>) -> bool {
    let sum: Vec<Interval> = open_loop.numerator.iter().zip(open_loop.denominator).map(|(n, d)| *n + d).collect();
    let Some(degree) = sum.iter().rposition(|c| *c != Interval::ZERO) else { return false };
    let entry = |index: usize| degree.checked_sub(index).map_or(Interval::ZERO, |power| sum[power]);
    let row = |first: usize| (0..=degree / 2).map(|k| entry(first + 2 * k)).collect::<Vec<_>>();
    let (mut upper, mut lower) = (row(0), row(1));
    let sign = if upper[0].is_negative() { -Interval::ONE } else { Interval::ONE };
    (0..degree).all(|_| {
        let decays = (sign * upper[0]).is_positive() && (sign * lower[0]).is_positive();
        let ratio = upper[0] / lower[0];
        let entry = |row: &[Interval], k: usize| row.get(k).copied().unwrap_or(Interval::ZERO);
        let next = (1..=upper.len()).map(|k| entry(&upper, k) - ratio * entry(&lower, k)).collect();
        upper = core::mem::replace(&mut lower, next);
        decays
    })
}

#[cfg(test)]
mod tests;
