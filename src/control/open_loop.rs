//! The loop of an axis and its controller, cut open at the command.

use super::roots::{Few, Polynomial, horner, less, positive_roots, product, routh};
use super::{ControlError, Gains};
use crate::numeric::{Limit, Scalar, domain, increasing_root};
use crate::plant::DragAxis;

/// Phase crossovers looked at in one loop.
const CROSSOVERS: u32 = 10_000;

/// `L(s) = (n_2 s^2 + n_1 s + n_0) exp(-s delay)/(s^2 (filter s + 1)(s + drag))`, drag and gains divided by the
/// inertia.
///
/// The proportional, the integral and the filtered derivative action over one denominator; the axis with the slope of
/// its drag at one speed. Both squared magnitude over `y = w^2` and phase are in closed form, so that all crossovers
/// of gain come from a polynomial of fourth degree, and so do the points between which the phase is monotone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenLoop<T> {
    alpha: T,
    numerator: [T; 3],
    filter_s: T,
    drag: T,
    delay_s: T,
}

impl<T: Scalar> OpenLoop<T> {
    /// The loop of `gains` about `axis` while it moves at `speed` (per s, either sign): drag is taken by its slope
    /// there, `beta_1 + 2 beta_2 |speed|`. Slow signals on top of that speed, and no others, obey it.
    ///
    /// ```
    /// use selfosc::control::{Gains, OpenLoop, Structure};
    /// use selfosc::plant::DragAxis;
    /// let gains = Gains::new(Structure::Pd, 1.0_f64, 0.0, 1.0, 0.0)?;
    /// let resting = OpenLoop::new(&DragAxis::linear(1.0, 1.0)?, &gains, 0.0)?;
    /// let (re, im) = resting.response(1.0); // 1/s at s = j
    /// assert!(re.abs() < 1e-15 && (im + 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::OutOfDomain`] unless the speed is finite, where squares of the loop's coefficients, divided by the
    /// inertia, are not, and where the proportional gain is lost against the inertia.
    pub fn new(axis: &DragAxis<T>, gains: &Gains<T>, speed: T) -> Result<Self, ControlError> {
        domain::finite("speed", speed, "output units per s")?;
        let slope = axis.linear_drag() + T::two() * axis.quadratic_drag() * speed.abs();
        let (alpha, filter_s) = (axis.alpha(), gains.filter_s());
        let numerator = [
            gains.integral(),
            gains.proportional() + gains.integral() * filter_s,
            gains.derivative() + gains.proportional() * filter_s,
        ];
        let (numerator, drag, delay_s) = (numerator.map(|n| n / alpha), slope / alpha, axis.delay_s());
        let open_loop = Self { alpha, numerator, filter_s, drag, delay_s };
        let size = |squares: &[T]| squares.iter().fold(T::zero(), |sum, square| sum + square.abs());
        domain::representable("squared gain over inertia", size(&open_loop.numerator_squared()), "")?;
        domain::representable("squared drag over inertia, or filter", size(&open_loop.denominator_squared()), "")?;
        let remedy = "choose units in which gain and inertia are nearer to one";
        domain::require("gain over inertia", open_loop.numerator[1], "", Limit::Positive, remedy)?;
        Ok(open_loop)
    }

    /// Its delay, s.
    pub fn delay_s(&self) -> T {
        self.delay_s
    }

    /// That it is unstable.
    pub(super) fn unstable(&self, poles: u32) -> ControlError {
        let (alpha, drag, delay_s) = (self.alpha, self.alpha * self.drag, self.delay_s);
        ControlError::Unstable { poles, alpha: alpha.value(), drag: drag.value(), delay_s: delay_s.value() }
    }

    /// `|numerator|^2` at `s = jw`, ascending powers of `y = w^2`.
    pub(super) fn numerator_squared(&self) -> [T; 3] {
        let [n0, n1, n2] = self.numerator;
        [n0.square(), n1.square() - T::two() * n0 * n2, n2.square()]
    }

    /// `|denominator|^2` likewise.
    fn denominator_squared(&self) -> Polynomial<T> {
        let (zero, one) = (T::zero(), T::one());
        product(&[zero, zero, one], &product(&[one, self.filter_s.square()], &[self.drag.square(), one])[..3])
    }

    /// `|L|` at a frequency above zero, rad/s.
    pub fn magnitude(&self, omega_rad_s: T) -> T {
        let y = omega_rad_s.square();
        (horner(&self.numerator_squared(), y).0 / horner(&self.denominator_squared(), y).0).sqrt()
    }

    /// Angle of L above `-pi` in rad, without jumps: zero or a multiple of `2 pi` where L is real and negative.
    pub fn angle_above_critical(&self, omega_rad_s: T) -> T {
        let ([n0, n1, n2], w) = (self.numerator, omega_rad_s);
        (self.drag / w).atan()
            - ((n0 - n2 * w.square()) / (n1 * w)).atan()
            - (self.filter_s * w).atan()
            - w * self.delay_s
    }

    /// Real and imaginary part of L at a frequency above zero, rad/s.
    pub fn response(&self, omega_rad_s: T) -> (T, T) {
        let (magnitude, angle) = (self.magnitude(omega_rad_s), self.angle_above_critical(omega_rad_s));
        (-magnitude * angle.cos(), -magnitude * angle.sin())
    }

    /// `|denominator|^2 - |numerator|^2`: positive where `|L| < 1`.
    fn excess(&self) -> Polynomial<T> {
        less(self.denominator_squared(), self.numerator_squared())
    }

    /// The squared frequencies at which `|L|` passes one, all of them, ascending.
    pub(super) fn gain_crossovers_squared(&self) -> Few<T> {
        positive_roots(&self.excess())
    }

    /// The squared frequencies at which the phase turns round, ascending.
    pub(super) fn phase_turns_squared(&self) -> Few<T> {
        let one = T::one();
        let [n0, n1, n2] = self.numerator;
        let size = self.numerator_squared();
        let (filter, drag) = ([one, self.filter_s.square()], [self.drag.square(), one]);
        let both = product(&filter, &drag);
        let lead = product(&[n1 * n0, n1 * n2], &both[..3]);
        let parts = [
            product(&product(&size, &drag)[..4], &[self.filter_s]),
            product(&product(&size, &filter)[..4], &[self.drag]),
            product(&product(&size, &both[..3]), &[self.delay_s]),
        ];
        positive_roots(&parts.into_iter().fold(lead, less))
    }

    /// Slope of [`angle_above_critical`](Self::angle_above_critical) over frequency, s.
    fn phase_slope(&self, omega_rad_s: T) -> T {
        let y = omega_rad_s.square();
        let [n0, n1, n2] = self.numerator;
        let part = |time: T| time / (T::one() + time.square() * y);
        n1 * (n0 + n2 * y) / horner(&self.numerator_squared(), y).0
            - part(self.filter_s)
            - self.drag / (self.drag.square() + y)
            - self.delay_s
    }

    /// Hands every frequency at which L is real and negative to `visit`, each once, until that returns false. With a
    /// delay they are infinitely many.
    pub(super) fn phase_crossovers(&self, mut visit: impl FnMut(T) -> bool) {
        let (zero, turn) = (T::zero(), T::two() * T::pi());
        let half_pi = T::pi() / T::two();
        let begins = |positive: bool| if positive { half_pi } else { zero };
        // Towards frequency zero the filter and the delay do nothing.
        let mut from = (zero, begins(self.drag > zero) - begins(self.numerator[0] > zero));
        let turns = self.phase_turns_squared();
        let mut visits = CROSSOVERS;
        for y in turns.into_iter().flatten() {
            let to = y.sqrt();
            let at_to = self.angle_above_critical(to);
            let (low, high) = if from.1 < at_to { (from.1, at_to) } else { (at_to, from.1) };
            // Multiples of a turn strictly between, in the order of frequency.
            let (first, last) = ((low / turn).floor() + T::one(), (high / turn).floor());
            let mut k = if from.1 < at_to { first } else { last };
            while k >= first && k <= last && visits > 0 {
                visits -= 1;
                let passed = k * turn > low && k * turn < high;
                if passed && self.crossover(k * turn, from.0, to).is_some_and(|omega| !visit(omega)) {
                    return;
                }
                k = if from.1 < at_to { k + T::one() } else { k - T::one() };
            }
            from = (to, at_to);
        }
        if self.delay_s > zero {
            // The phase falls from here on, below pi less the delay's share.
            let mut k = -(-from.1 / turn).floor() - T::one();
            for _ in 0..visits {
                let to = (T::pi() - k * turn) / self.delay_s;
                if self.crossover(k * turn, from.0, to).is_none_or(|omega| !visit(omega)) {
                    return;
                }
                k = k - T::one();
            }
        } else if self.filter_s == zero && self.numerator[2] > zero && from.1 < zero {
            // Ideal derivative action lifts the phase to a quarter turn above critical.
            let mut to = T::one().max(T::two() * from.0);
            while self.angle_above_critical(to) <= zero && to.is_finite() {
                to = to * T::two();
            }
            if let Some(omega) = self.crossover(zero, from.0, to) {
                visit(omega);
            }
        }
    }

    /// Where the phase, monotone between two frequencies, has a value.
    fn crossover(&self, angle: T, from: T, to: T) -> Option<T> {
        let rising = self.phase_slope((from + to) / T::two()) > T::zero();
        let sign = if rising { T::one() } else { -T::one() };
        let signed = |w: T| (sign * (self.angle_above_critical(w) - angle), sign * self.phase_slope(w));
        increasing_root(signed, from, to, (from + to) / T::two())
    }

    /// No `|L|` at this frequency or above is larger.
    pub(super) fn magnitude_bound(&self, omega_rad_s: T) -> T {
        let ([n0, n1, n2], w) = (self.numerator, omega_rad_s);
        let filter = (T::one() + (self.filter_s * w).square()).sqrt();
        (n0 / w.square() + n1 / w + n2) / (filter * (self.drag.square() + w.square()).sqrt())
    }

    /// Numerator and denominator without the delay, in descending powers of s, common factors cancelled.
    #[cfg(feature = "std")]
    pub(crate) fn polynomials(&self) -> (Vec<T>, Vec<T>) {
        let [n0, n1, n2] = self.numerator;
        let (zero, one, f) = (T::zero(), T::one(), self.filter_s);
        let mut numerator = vec![n2, n1, n0];
        let mut denominator = vec![f, one + self.drag * f, self.drag, zero, zero];
        if n0 == zero {
            numerator.pop();
            denominator.pop();
        }
        let leading = |polynomial: &[T]| polynomial.iter().position(|c| *c != zero).unwrap_or(0);
        numerator.drain(..leading(&numerator));
        denominator.drain(..leading(&denominator));
        (numerator, denominator)
    }

    /// Roots of the closed loop's characteristic equation `1 + L = 0` that do not decay.
    ///
    /// Without delay by Routh's table. With it by the direct method (Walton and Marshall, 1987): roots can pass the
    /// imaginary axis only at the crossovers of gain, each at the delays that bring its phase to the critical one, and
    /// the sign of the slope of `|L|` there says in which direction. Exact but for rounding; a root within rounding of
    /// the axis counts as not decaying or not, as it falls.
    pub fn unstable_poles(&self) -> u32 {
        let mut poles = self.unstable_without_delay();
        let turn = T::two() * T::pi();
        let undelayed = Self { delay_s: T::zero(), ..*self };
        let excess = self.excess();
        for y in self.gain_crossovers_squared().into_iter().flatten() {
            let omega = y.sqrt();
            let angle = undelayed.angle_above_critical(omega);
            let first = angle - (angle / turn).floor() * turn;
            let passed = ((omega * self.delay_s - first) / turn).floor() + T::one();
            let passages = if passed > T::zero() { 2 * passages(passed) } else { 0 };
            if horner(&excess, y).1 > T::zero() {
                poles = poles.saturating_add(passages);
            } else {
                poles = poles.saturating_sub(passages);
            }
        }
        poles
    }

    /// Sign changes in the first column of Routh's table; a zero there counts as one.
    fn unstable_without_delay(&self) -> u32 {
        let [n0, n1, n2] = self.numerator;
        let (one, f) = (T::one(), self.filter_s);
        // Ascending powers; without integral action the root at zero is not there.
        let mut polynomial = [n0, n1, self.drag + n2, one + self.drag * f, f];
        if n0 == T::zero() {
            polynomial.rotate_left(1);
        }
        let degree = polynomial.iter().rposition(|c| *c != T::zero()).unwrap_or(0);
        let column = routh(&polynomial, degree);
        (0..degree).fold(0, |changes, k| changes + u32::from(!(column[k] * column[k + 1] > T::zero())))
    }
}

/// A whole number of passages, as many as can be counted.
fn passages<S: Scalar>(count: S) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, and is not negative")]
    let count = count.value() as u32;
    count.min(u32::MAX / 4)
}
