//! Motion in one direction: closed forms of speed, distance and event times.

use crate::numeric::{Real, Scalar};
use crate::numeric::{
    atanh_root_ratio, cosh_root, cosh_root_difference, exp_m1_ratio, increasing_root, ln_1p_ratio,
    sinh_root_difference, sinh_root_ratio,
};

/// Motion of a drag axis while the velocity keeps its sign and the force is constant:
/// `p' = drive - linear p - quadratic p^2` for the speed `p >= 0`, a Riccati equation with constant coefficients.
///
/// Its solutions are hyperbolic, trigonometric or rational by the sign of `linear^2/4 + drive quadratic`. The forms here
/// pass continuously between the three, and to vanishing drag of either kind, without cancellation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneWay<T> {
    /// Force along the motion over alpha, in x/s^2; negative where it brakes.
    pub drive: T,
    /// Linear drag over alpha, in 1/s, zero or more.
    pub linear: T,
    /// Quadratic drag over alpha, in 1/x, zero or more.
    pub quadratic: T,
}

/// What a duration brings, with the sensitivities to the speed at its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passage<T> {
    /// Way travelled, in x.
    pub distance: T,
    /// Speed at the end, in x/s.
    pub speed: T,
    /// Derivative of the final speed with respect to the initial one, `> 0`.
    pub speed_gain: T,
    /// Derivative of the distance with respect to the initial speed, in s.
    pub distance_gain: T,
}

impl<T: Real> OneWay<T> {
    /// `linear^2/4 + drive quadratic`, in 1/s^2: the square of the rate at which two motions approach each other.
    pub fn discriminant(&self) -> T {
        (T::from_f64(0.5) * self.linear).square() + self.drive * self.quadratic
    }

    /// The speed at which drag balances the drive; negative for a braking drive, where it is only a number of the
    /// formulas. Domain: discriminant `>= 0`, and drag of some kind.
    pub fn terminal_speed(&self) -> T {
        self.terminal_by(self.discriminant().sqrt())
    }

    /// By the root of the discriminant.
    fn terminal_by(&self, root: T) -> T {
        self.drive / (T::from_f64(0.5) * self.linear + root)
    }

    /// Acceleration at a speed, in x/s^2.
    pub fn acceleration(&self, speed: T) -> T {
        self.drive - (self.linear + self.quadratic * speed) * speed
    }

    /// The passage as an approach to the terminal speed. Domain: discriminant `> 0`. Accurate where the duration is not
    /// short against `1/sqrt(discriminant)`, true everywhere.
    pub fn settle(&self, speed: T, duration: T) -> Passage<T> {
        let root = self.discriminant().sqrt();
        let (terminal, rate) = (self.terminal_by(root), T::two() * root);
        let excess = speed - terminal;
        let decay = (-(rate * duration)).exp();
        let time = (T::one() - decay) / rate;
        let bend = T::one() + self.quadratic * excess * time;
        Passage {
            distance: terminal * duration + excess * time * ln_1p_ratio(self.quadratic * excess * time),
            speed: terminal + excess * decay / bend,
            speed_gain: decay / bend.square(),
            distance_gain: time / bend,
        }
    }
}

impl<S: Scalar> OneWay<S> {
    /// Distance and speed after `duration >= 0` from `speed >= 0`. Domain: the motion does not come to
    /// [rest](Self::time_to_rest) before.
    #[inline]
    pub fn advance(&self, speed: S, duration: S) -> Passage<S> {
        let square = self.discriminant() * duration * duration;
        if square > S::from_f64(0.25) {
            return self.settle(speed, duration);
        }
        let half = S::from_f64(0.5) * self.linear;
        let h = half * duration;
        let decay = (-h).exp();
        // How a constant force adds up to a way: the integral of s exp(-h s) sinh(r s)/(r s) over s from 0 to 1, r^2 = square.
        let product = h * h - square;
        let (cosine, sine, integral) = if product.abs() > S::from_f64(0.5) {
            let (cosine, sine) = (cosh_root(square), sinh_root_ratio(square));
            (cosine, sine, (S::one() - decay * (cosine + h * sine)) / product)
        } else {
            // exp(h) = cosh h + h (sinh h)/h: its difference from the rest is one of divided differences.
            let (cosine, cosine_difference) = cosh_root_difference(square, h * h);
            let (sine, sine_difference) = sinh_root_difference(square, h * h);
            (cosine, sine, decay * (cosine_difference + h * sine_difference))
        };
        let sine = duration * sine;
        let way = self.drive * duration * duration * integral + speed * sine * decay;
        let bend = cosine + (half + self.quadratic * speed) * sine;
        Passage {
            distance: way * ln_1p_ratio(self.quadratic * way),
            speed: (speed * (cosine - half * sine) + self.drive * sine) / bend,
            speed_gain: S::one() / (bend * bend),
            distance_gain: sine / bend,
        }
    }

    /// Time in which a braking drive brings the motion to rest; `None` where the drive does not brake.
    #[inline]
    pub fn time_to_rest(&self, speed: S) -> Option<S> {
        if self.drive >= S::zero() {
            return None;
        }
        let half = S::from_f64(0.5) * self.linear;
        let discriminant = self.discriminant();
        let time = speed / (half * speed - self.drive);
        let square = discriminant * time * time;
        if square <= S::from_f64(0.04) {
            return Some(time * atanh_root_ratio(square));
        }
        let root = discriminant.sqrt();
        let scaled = -speed / (self.drive * (S::one() + self.quadratic * speed / (half + root)));
        Some(scaled * ln_1p_ratio(S::two() * root * scaled))
    }

    /// Time to travel `distance >= 0` from `speed >= 0`; `None` where the motion comes to rest, or comes ever closer to
    /// it, before.
    pub fn time_to_distance(&self, speed: S, distance: S) -> Option<S> {
        let zero = S::zero();
        if distance <= zero {
            return (distance == zero).then_some(zero);
        }
        if self.drive == zero {
            let time = distance * exp_m1_ratio(self.quadratic * distance) / speed;
            let lost = self.linear * time;
            return (lost < S::one()).then(|| time * ln_1p_ratio(-lost));
        }
        let upper = match self.time_to_rest(speed) {
            Some(rest) if self.advance(speed, rest).distance < distance => return None,
            Some(rest) => rest,
            // From rest and without drag, plus at terminal speed: together longer than it takes.
            None => self.time_bound(distance),
        };
        let guess = if self.drive > zero { self.time_guess(speed, distance) } else { distance / speed };
        let beyond = |time| {
            let passage = self.advance(speed, time);
            (passage.distance - distance, passage.speed)
        };
        increasing_root(beyond, zero, upper, S::from_f64(guess.value()))
    }

    /// A time in which a positive drive certainly covers `distance`.
    fn time_bound(&self, distance: S) -> S {
        let free = (S::two() * distance / self.drive).sqrt();
        let rate = self.linear / S::two() + self.discriminant().sqrt();
        S::from_f64((free + distance * rate / self.drive).value())
    }

    /// Near the time in which a positive drive covers `distance`.
    fn time_guess(&self, speed: S, distance: S) -> S {
        let rate = self.linear / S::two() + self.discriminant().sqrt();
        let settled = distance * rate / self.drive;
        let free = S::two() * distance / (speed + (speed * speed + S::two() * self.drive * distance).sqrt());
        (free * free + settled * settled).sqrt()
    }
}
