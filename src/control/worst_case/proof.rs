//! Margins proved: enclosures over cells of frequency, inertia, drag and delay.

use super::{AxisIntervals, Scores};
use crate::control::Gains;
use crate::numeric::{Interval, Real};

/// Cells that a proof may take.
const CELLS: usize = 400_000;
/// No limit of the gain stands for none within this factor.
pub(super) const NO_LIMIT: f64 = 1e6;
/// Cells smaller than this, relative, are not divided any more.
const SMALLEST: f64 = 1e-12;
/// Octaves that are searched for the ends of the frequencies.
const OCTAVES: usize = 200;

/// That no loop of the axes has smaller margins.
pub(super) struct Statement {
    /// Numerator of the controller over `s (filter s + 1)`, ascending powers of s, and the time constant of its filter.
    numerator: [Interval; 3],
    filter_s: Interval,
    integral: bool,
    filtered: bool,
    /// `|L|^2` is not between these where L is real and negative.
    critical: (f64, f64),
    phase_rad: f64,
    delay_s: f64,
}

/// A range of frequencies, rad/s, and of axes.
#[derive(Clone, Copy)]
struct Cell {
    omega: Interval,
    axes: AxisIntervals,
}

impl Statement {
    /// That of gains with these scores; a limit of the gain beyond [`NO_LIMIT`] is that much.
    pub(super) fn new(gains: &Gains<f64>, [gain, reduction, phase_rad, delay_s]: Scores) -> Self {
        let [integral, proportional, derivative, filter_s] =
            [gains.integral(), gains.proportional(), gains.derivative(), gains.filter_s()].map(Interval::point);
        let squared = |factor: f64| Interval::point(factor.min(NO_LIMIT)).square();
        Self {
            numerator: [integral, proportional + integral * filter_s, derivative + proportional * filter_s],
            filter_s,
            integral: gains.integral() > 0.0,
            filtered: gains.filter_s() > 0.0,
            critical: ((Interval::ONE / squared(gain)).lower(), squared(reduction).upper()),
            phase_rad,
            delay_s,
        }
    }

    /// Whether it is proved of all axes, and that they are stable. `false` says nothing.
    pub(super) fn is_proved(&self, axes: &AxisIntervals) -> bool {
        let Some(sooner) = Interval::new(0.0, axes.delay_s.lower()) else { return false };
        // No pole passes the imaginary axis while the delay grows from none, nor from one axis to another.
        let never_critical = Self { critical: (1.0, 1.0), phase_rad: 0.0, delay_s: 0.0, ..*self };
        self.stable_without_delay(axes)
            && never_critical.holds_over(&AxisIntervals { delay_s: sooner, ..*axes })
            && self.holds_over(axes)
    }

    /// Whether all poles of one loop without delay decay: Hurwitz' conditions.
    fn stable_without_delay(&self, axes: &AxisIntervals) -> bool {
        let ([n0, n1, n2], f) = (self.numerator, self.filter_s);
        let [alpha, drag] = [axes.alpha, axes.drag].map(|side| Interval::point(side.upper()));
        let ascending = [n0, n1, drag + n2, alpha + drag * f, alpha * f];
        // Without integral action the root at zero is not there, without a filter the highest power.
        let present = ascending.get(usize::from(!self.integral)..4 + usize::from(self.filtered));
        let above = |a: Interval, b: Interval| (a - b).is_positive();
        present.is_some_and(|present| {
            present.iter().all(|coefficient| coefficient.is_positive())
                && match *present {
                    [a0, a1, a2, a3] => above(a2 * a1, a3 * a0),
                    [a0, a1, a2, a3, a4] => above(a3 * a2 * a1, a4 * a1.square() + a3.square() * a0),
                    _ => true,
                }
        })
    }

    fn holds_over(&self, axes: &AxisIntervals) -> bool {
        let Some(omega) = self.frequencies(axes) else { return false };
        let (mut open, mut cells) = (vec![Cell { omega, axes: *axes }], 0);
        while let Some(cell) = open.pop() {
            cells += 1;
            if self.holds_in(&cell) {
                continue;
            }
            match cell.halves().filter(|_| cells < CELLS) {
                Some(halves) => open.extend(halves),
                None => return false,
            }
        }
        true
    }

    /// The frequencies outside of which the magnitude is beyond all that is asked of it.
    fn frequencies(&self, axes: &AxisIntervals) -> Option<Interval> {
        let [n0, n1, n2] = self.numerator;
        let poles = |omega: Interval, alpha: f64, drag: f64| {
            let filter = (Interval::ONE + (self.filter_s * omega).square()).sqrt();
            filter * ((Interval::point(alpha) * omega).square() + Interval::point(drag).square()).sqrt()
        };
        // Both fall with the frequency, so that what they are at its end bounds all beyond.
        let least = |omega: Interval| n1 / (omega * poles(omega, axes.alpha.upper(), axes.drag.upper()));
        let most = |omega: Interval| {
            (n0 / omega.square() + n1 / omega + n2) / poles(omega, axes.alpha.lower(), axes.drag.lower())
        };
        let (small, large) = (self.critical.0.min(1.0), self.critical.1.max(1.0));
        let octaves = |factor: f64| core::iter::successors(Some(1.0), move |omega| Some(omega * factor)).take(OCTAVES);
        let lowest = octaves(0.5).find(|omega| least(Interval::point(*omega)).square().lower() > large)?;
        let highest = octaves(2.0).find(|omega| most(Interval::point(*omega)).square().upper() < small)?;
        Interval::new(lowest, highest)
    }

    fn holds_in(&self, Cell { omega, axes }: &Cell) -> bool {
        let ([n0, n1, n2], y) = (self.numerator, omega.square());
        let poles = (Interval::ONE + self.filter_s.square() * y) * (axes.alpha.square() * y + axes.drag.square());
        let squared = ((n0 - n2 * y).square() + n1.square() * y) / (y.square() * poles);
        let ratio = n0 / (n1 * *omega) - n2 / n1 * *omega;
        // Above critical, as `OpenLoop::angle_above_critical` has it.
        let angle = (axes.drag / (axes.alpha * *omega)).atan()
            - ratio.atan()
            - (self.filter_s * *omega).atan()
            - *omega * axes.delay_s;
        let longer = (Interval::point(self.delay_s) * *omega).upper();
        let far = !squared.contains(1.0) || !reaches(angle, self.phase_rad, self.phase_rad.max(longer));
        let (small, large) = self.critical;
        far && (squared.upper() <= small || squared.lower() >= large || !reaches(angle, 0.0, 0.0))
    }
}

/// Whether an angle may lie within so much below or above a whole number of turns.
fn reaches(angle: Interval, below: f64, above: f64) -> bool {
    let turn = Interval::point(2.0) * Interval::PI;
    let from = ((Interval::point(angle.lower()) - Interval::point(above)) / turn).lower();
    let to = ((Interval::point(angle.upper()) + Interval::point(below)) / turn).upper();
    !(from.ceil() > to)
}

impl Cell {
    /// Halved along the side that matters most to magnitude and phase.
    fn halves(&self) -> Option<[Self; 2]> {
        let Self { omega, axes } = *self;
        let slowest = axes.drag.upper() + axes.alpha.lower() * omega.lower();
        let sides = [
            omega.width() / omega.lower(),
            axes.alpha.width() / axes.alpha.lower(),
            if axes.drag.is_point() { 0.0 } else { axes.drag.width() / slowest },
            axes.delay_s.width() * omega.upper(),
        ];
        let longest = sides.iter().copied().fold(0.0, f64::max);
        let mut halves = [*self; 2];
        let [lower, upper] = &mut halves;
        if !(longest > SMALLEST) {
            return None;
        } else if sides[0] == longest {
            let middle = if longest > 1.0 { (omega.lower() * omega.upper()).sqrt() } else { omega.midpoint() };
            lower.omega = Interval::new(omega.lower(), middle)?;
            upper.omega = Interval::new(middle, omega.upper())?;
        } else if sides[1] == longest {
            (lower.axes.alpha, upper.axes.alpha) = axes.alpha.bisect();
        } else if sides[2] == longest {
            (lower.axes.drag, upper.axes.drag) = axes.drag.bisect();
        } else {
            (lower.axes.delay_s, upper.axes.delay_s) = axes.delay_s.bisect();
        }
        Some(halves)
    }
}
