//! Margins over intervals of the parameters: found in floating point, then proved in intervals.

mod proof;

use proof::Statement;

use super::{ControlError, Gains, OpenLoop};
use crate::numeric::{Interval, domain};

/// Intervals that an identification gives for an axis.
///
/// Drag is a slope here, force over speed; [`at_speeds`](Self::at_speeds) makes it from linear and quadratic drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisIntervals {
    alpha: Interval,
    drag: Interval,
    delay_s: Interval,
}

/// Margins that every axis of the intervals has, between a proved bound and the worst that was met.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstMargins {
    /// Every axis of the intervals has at least these: proved in interval arithmetic, and with them, unless they are none at all (factors
    /// of one, phase and delay zero), that every axis is stable.
    pub at_least: WorstMargin,
    /// Some axis of the intervals has this little of one kind, another of another.
    pub met: WorstMargin,
    /// Boxes that the intervals were divided into.
    pub boxes: usize,
    /// Whether bound and worst case agree to 1.1 %. Otherwise the work was cut short: the bound is proved, but may lie far below, or
    /// say nothing.
    pub converged: bool,
}

/// The four margins, without the place where each is met; fields as in [`Margins`](super::Margins).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
pub struct WorstMargin {
    /// The gain may grow by less than this factor; `None` for no limit, of a bound for none below a million.
    pub gain: Option<f64>,
    /// The gain may be divided by less than this factor; `None` likewise.
    pub gain_reduction: Option<f64>,
    /// Phase, rad.
    pub phase_rad: f64,
    /// Delay, s, on top of the axis' own.
    pub delay_s: f64,
}

/// Boxes that are looked at before the bound is left as it is.
const BUDGET: usize = 20_000;
/// Crossovers of phase, likewise: with a delay one box may have very many.
const CROSSOVERS: usize = 1_000_000;
/// Bound and worst case are brought this near in floating point, relative.
const GAP: f64 = 0.01;
/// What is given up, relative, so that a proof is found: the least first; as little as the first two counts as none.
const GIVEN_UP: [f64; 5] = [1e-5, 1e-3, 0.01, 0.1, 0.5];
/// What is true of every loop.
const NONE: Scores = [1.0, 1.0, 0.0, 0.0];
const TURN: f64 = core::f64::consts::TAU;

/// Gain as a factor, reduction as a factor, phase, delay: more is better in each. Infinite for no limit.
type Scores = [f64; 4];

impl AxisIntervals {
    /// Intervals of inertia, slope of drag and delay.
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless inertia is above zero, drag and delay zero or more, all bounded.
    pub fn new(alpha: Interval, drag: Interval, delay_s: Interval) -> Result<Self, ControlError> {
        domain::positive("inertia's lower bound", alpha.lower(), "F s^2/x")?;
        domain::finite("inertia's upper bound", alpha.upper(), "F s^2/x")?;
        for (lower, upper, interval, unit) in [
            ("drag's lower bound", "drag's upper bound", drag, "F s/x"),
            ("delay's lower bound", "delay's upper bound", delay_s, "s"),
        ] {
            domain::non_negative(lower, interval.lower(), unit)?;
            domain::finite(upper, interval.upper(), unit)?;
        }
        Ok(Self { alpha, drag, delay_s })
    }

    /// With linear and quadratic drag, at all speeds up to `top_speed` either way: the slope `beta_1 + 2 beta_2 |v|`
    /// is between the lower bound of `linear_drag` and the upper one at the top speed.
    ///
    /// # Errors
    /// As [`new`](Self::new); the same for quadratic drag and top speed.
    pub fn at_speeds(
        alpha: Interval,
        linear_drag: Interval,
        quadratic_drag: Interval,
        top_speed: f64,
        delay_s: Interval,
    ) -> Result<Self, ControlError> {
        domain::non_negative("top speed", top_speed, "output units per s")?;
        let lowest = quadratic_drag.lower();
        domain::non_negative("quadratic drag's lower bound", lowest, "F s^2/x^2")?;
        let speeds = Interval::new(0.0, top_speed).unwrap_or(Interval::ENTIRE);
        Self::new(alpha, linear_drag + Interval::point(2.0) * quadratic_drag * speeds, delay_s)
    }

    /// The worst margins of a controller on any linear axis of the intervals, enclosed between a bound and a case.
    ///
    /// Branch and bound: on a box, the phase at each frequency is lowest at greatest inertia, least drag and longest
    /// delay, and the magnitude largest at least inertia and drag, so that the extreme curves bound every loop of the
    /// box; their crossovers are complete (see [`OpenLoop::margins`]), and boxes are halved until bound and worst case
    /// agree or the budget of 20 000 boxes and a million crossovers is spent.
    ///
    /// That is floating point. Its bound, less 1e-5 of it, is then proved: cells of frequency and parameters, over which magnitude
    /// and phase are enclosed with outward rounding, are halved until no loop of a cell is nearer to critical. Stability follows
    /// from Hurwitz' conditions without delay, and from no loop being critical at any delay up to its own, or at any axis
    /// between. Where that takes more than 400 000 cells, up to half of the bound is given up, in steps, and at last all of it;
    /// [`WorstMargins::converged`] tells. Parameters are taken to be constant; a slope of drag that moves with the speed is covered only as far
    /// as it moves slowly.
    ///
    /// ```
    /// use selfosc::control::{AxisIntervals, Structure, Tuning};
    /// use selfosc::numeric::Interval;
    /// use selfosc::plant::DragAxis;
    /// let between = |low, high| Interval::new(low, high).ok_or("reversed");
    /// let tuning = Tuning::new(&DragAxis::linear(1.0, 0.3)?.with_delay_s(0.2)?, Structure::Pid, 0.7)?;
    /// let intervals = AxisIntervals::new(between(0.9, 1.1)?, between(0.2, 0.4)?, between(0.15, 0.25)?)?;
    /// let worst = intervals.worst_margins(tuning.gains())?;
    /// assert!(worst.at_least.phase_rad <= worst.met.phase_rad && worst.met.phase_rad < tuning.margins().phase_rad);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::Unstable`] with an axis of the intervals that the controller does not stabilise.
    pub fn worst_margins(&self, gains: &Gains<f64>) -> Result<WorstMargins, ControlError> {
        let mut met = self.corners().try_fold([f64::INFINITY; 4], |worst, corner| {
            Ok::<_, ControlError>(lesser(worst, scores(&corner.middle(gains))?))
        })?;
        let (mut at_least, mut boxes, mut crossovers, mut converged) = ([f64::INFINITY; 4], 0, 0, true);
        let mut open = vec![*self];
        while let Some(part) = open.pop() {
            boxes += 1;
            met = lesser(met, scores(&part.middle(gains))?);
            let (bound, looked_at) = part.bound(gains, met[0]);
            crossovers += looked_at;
            let near = bound.iter().zip(&met).all(|(bound, met)| *bound >= met * (1.0 - GAP));
            let affordable = boxes + open.len() < BUDGET && crossovers < CROSSOVERS;
            match part.halves(self).filter(|_| !near && affordable) {
                Some(halves) => open.extend(halves),
                None => {
                    at_least = lesser(at_least, bound);
                    converged &= near;
                }
            }
        }
        // A case is a bound too, where rounding puts it below.
        let (at_least, given_up) = self.proved(gains, lesser(at_least, met));
        converged &= given_up <= GIVEN_UP[1];
        Ok(WorstMargins { at_least: at_least.into(), met: met.into(), boxes, converged })
    }

    /// Scores that are proved, near those that are bounds up to rounding, and the share of them that was given up.
    fn proved(&self, gains: &Gains<f64>, bound: Scores) -> (Scores, f64) {
        let less = |share: f64| {
            let [gain, reduction, phase_rad, delay_s] = bound.map(|score| score * (1.0 - share));
            [gain.max(1.0), reduction.max(1.0), phase_rad, delay_s]
        };
        let found = GIVEN_UP.iter().find(|share| Statement::new(gains, less(**share)).is_proved(self));
        found.map_or((NONE, 1.0), |share| (less(*share), *share))
    }

    /// The loop at the middle of the intervals.
    fn middle(&self, gains: &Gains<f64>) -> OpenLoop<f64> {
        OpenLoop::linear(self.alpha.midpoint(), self.drag.midpoint(), self.delay_s.midpoint(), gains)
    }

    /// The eight corners, as boxes without extent.
    fn corners(&self) -> impl Iterator<Item = Self> {
        let ends = |interval: Interval| [interval.lower(), interval.upper()].map(Interval::point);
        let (alphas, drags, delays) = (ends(self.alpha), ends(self.drag), ends(self.delay_s));
        (0..8).map(move |k| Self { alpha: alphas[k & 1], drag: drags[(k >> 1) & 1], delay_s: delays[k >> 2] })
    }

    /// Halved along the side that is longest compared with the whole.
    fn halves(&self, whole: &Self) -> Option<[Self; 2]> {
        let share = |part: Interval, whole: Interval| if whole.is_point() { 0.0 } else { part.width() / whole.width() };
        let shares = [share(self.alpha, whole.alpha), share(self.drag, whole.drag), share(self.delay_s, whole.delay_s)];
        let longest = shares.iter().copied().fold(0.0, f64::max);
        if longest < 1e-9 {
            return None;
        }
        let mut halves = [*self; 2];
        if shares[0] == longest {
            (halves[0].alpha, halves[1].alpha) = self.alpha.bisect();
        } else if shares[1] == longest {
            (halves[0].drag, halves[1].drag) = self.drag.bisect();
        } else {
            (halves[0].delay_s, halves[1].delay_s) = self.delay_s.bisect();
        }
        Some(halves)
    }

    /// Scores that no axis of the box falls below, and the crossovers of phase looked at; gain margins above twice `gain_met` are of no interest.
    fn bound(&self, gains: &Gains<f64>, gain_met: f64) -> (Scores, usize) {
        let at = |alpha, drag, delay_s| OpenLoop::linear(alpha, drag, delay_s, gains);
        let ends = |interval: Interval| (interval.lower(), interval.upper());
        let ((light, heavy), (slick, rough), (short, long)) = (ends(self.alpha), ends(self.drag), ends(self.delay_s));
        let curves = Curves {
            largest: at(light, slick, short),
            smallest: at(heavy, rough, short),
            lagging: at(heavy, slick, long),
            leading: at(light, rough, short),
        };
        let [phase_rad, delay_s] = curves.at_unit_gain();
        let ([gain, reduction], crossovers) = curves.at_critical_phase(0.5 / gain_met);
        ([gain, reduction, phase_rad, delay_s], crossovers)
    }
}

/// Loops whose magnitudes and phases bound those of a box, frequency by frequency.
struct Curves {
    largest: OpenLoop<f64>,
    smallest: OpenLoop<f64>,
    lagging: OpenLoop<f64>,
    leading: OpenLoop<f64>,
}

impl Curves {
    /// Least distance of the phase from critical, and of the delay, where some loop of the box has `|L| = 1`.
    fn at_unit_gain(&self) -> [f64; 2] {
        let crossovers = |curve: &OpenLoop<f64>| curve.gain_crossovers_squared().as_slice().to_vec();
        let nodes = [&self.largest, &self.smallest].into_iter().flat_map(crossovers).map(f64::sqrt).collect();
        let mut worst = [f64::INFINITY; 2];
        for (from, to) in
            pieces(nodes, |omega| self.largest.magnitude(omega) >= 1.0 && self.smallest.magnitude(omega) <= 1.0)
        {
            let lowest = extreme(&self.lagging, from, to, f64::min);
            let highest = extreme(&self.leading, from, to, f64::max);
            let above = lowest.rem_euclid(TURN);
            let below = TURN - above - (highest - lowest);
            let (phase, delay) = if below > 0.0 { (above.min(below), above / to) } else { (0.0, 0.0) };
            worst = [worst[0].min(phase), worst[1].min(delay)];
        }
        worst
    }

    /// Least factors on the gain where some loop of the box has a critical phase; magnitudes below `small` do not
    /// matter. And how many crossovers of phase there are.
    fn at_critical_phase(&self, small: f64) -> ([f64; 2], usize) {
        let mut nodes = vec![0.0];
        for curve in [&self.lagging, &self.leading] {
            curve.phase_crossovers(|omega| {
                nodes.push(omega);
                self.largest.magnitude_bound(omega) > small
            });
        }
        let crossovers = nodes.len();
        let turns = |curve: &OpenLoop<f64>, omega| curve.angle_above_critical(omega) / TURN;
        let critical = |omega| turns(&self.leading, omega).floor() >= turns(&self.lagging, omega).ceil();
        let mut worst = [f64::INFINITY; 2];
        for (from, to) in pieces(nodes, critical).into_iter().filter(|(_, to)| *to > 0.0) {
            let (least, most) = (self.smallest.magnitude_over(from, to).0, self.largest.magnitude_over(from, to).1);
            if most < 1.0 {
                worst[0] = worst[0].min(1.0 / most);
            } else if least > 1.0 {
                worst[1] = worst[1].min(least);
            } else {
                worst = [1.0; 2];
            }
        }
        (worst, crossovers)
    }
}

/// The nodes, each a piece by itself, and the pieces between neighbours whose middles are `inside`.
fn pieces(mut nodes: Vec<f64>, inside: impl Fn(f64) -> bool) -> Vec<(f64, f64)> {
    nodes.sort_by(f64::total_cmp);
    let between = nodes.windows(2).map(|pair| (pair[0], pair[1]));
    let between = between.filter(|(from, to)| inside(0.5 * (from + to)));
    nodes.iter().map(|node| (*node, *node)).chain(between).collect()
}

/// The least or greatest phase between two frequencies.
fn extreme(curve: &OpenLoop<f64>, from: f64, to: f64, of: fn(f64, f64) -> f64) -> f64 {
    let turns = curve.phase_turns_squared();
    let inside = turns.as_slice().iter().map(|y| y.sqrt()).filter(|omega| (from..to).contains(omega));
    inside.chain([to]).map(|omega| curve.angle_above_critical(omega)).fold(curve.angle_above_critical(from), of)
}

fn lesser(a: Scores, b: Scores) -> Scores {
    core::array::from_fn(|i| a[i].min(b[i]))
}

fn scores(open_loop: &OpenLoop<f64>) -> Result<Scores, ControlError> {
    let margins = open_loop.margins()?;
    let limit = |margin: Option<f64>| margin.unwrap_or(f64::INFINITY);
    Ok([limit(margins.gain), limit(margins.gain_reduction), margins.phase_rad, margins.delay_s])
}

impl From<Scores> for WorstMargin {
    fn from([gain, reduction, phase_rad, delay_s]: Scores) -> Self {
        let limit = |score: f64| score.is_finite().then_some(score);
        Self { gain: limit(gain), gain_reduction: limit(reduction), phase_rad, delay_s }
    }
}

#[cfg(test)]
mod tests;
