//! A limit cycle with proof: for a given axis, existence in a narrow enclosure; uniqueness and attraction by theorem.

use super::drag_axis::{LimitCycle, solve};
use super::half_cycle::{End, HalfCycle, Swing};
use super::{OrbitError, limit_cycle};
use crate::nonlinearity::RelayHysteresis;
use crate::numeric::{Interval, Jet, Real};
use crate::plant::{DragAxis, OneWay, PlantError};
use crate::proof::Gradient;
use crate::proof::enclosure::{Roots, krawczyk};
use crate::proof::rigorous_quadrature::{CellJet, integrate};

/// The proof about the limit cycle of an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Certificate {
    /// It is the only oscillation. With a delay that does not exclude several commands on their way at once this is
    /// withheld: faster oscillations of that kind may exist.
    pub unique: bool,
    /// Every start that leads to switchings of both kinds approaches it. Withheld likewise.
    pub attracting: bool,
    /// Which starts that lead to switchings of both kinds approach it.
    pub starts: Starts,
    /// Contains the limit cycle of exactly the parameters given.
    pub enclosure: LimitCycle<Interval>,
}

/// From where a limit cycle is approached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "std", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Starts {
    /// From everywhere: the delay is shorter than every passage between the levels: after a delay at most a
    /// single command is on its way.
    Every,
    /// From states with at most a single command on its way, then and later. Among these motions the cycle is unique.
    OneCommandOnItsWay,
}

/// The limit cycle of `axis` under `relay` by enclosure: nothing in it rests on rounding having been kind.
///
/// **Existence** by Krawczyk's operator, for four unknowns: each half cycle's speed at the relay's level and at the real
/// switching. **Uniqueness and attraction** because the way from rest to the level maps onto the next such way by an
/// increasing, concave function with a positive value at zero: its slope `2 C v/((C -+ (delta + d) + drag(v)) v_0) - 1`,
/// `v_0` the speed at the level and `v` at the switching, is positive and falls with `v_0` for linear, quadratic and
/// mixed drag and any delay. The half cycles in turn have exactly 1 fixed point, which every start with at most a single
/// command on its way approaches from its own side. Every start is such a start where the axis, driven from rest by the
/// larger force, takes longer than the delay between the levels: it rests between crossing either.
///
/// ```
/// use selfosc::{nonlinearity::RelayHysteresis, orbit::certify, plant::DragAxis};
/// let axis = DragAxis::quadratic(1.0, 0.5)?;
/// let proof = certify(&axis, &RelayHysteresis::new(1.0, 0.3, 0.0)?)?;
/// let y = (1.0 - (-4.0 * 0.5 * 0.3f64).exp()).sqrt();
/// let amplitude = proof.enclosure.amplitude;
/// assert!(proof.unique && amplitude.width() < 1e-12 && (amplitude.midpoint() - (0.3 + (1.0 + y).ln())).abs() < 1e-12);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
///
/// # Errors
/// As [`limit_cycle`]; [`OrbitError::NotProved`] where the enclosure fails, as with a multiplier near 1.
pub fn certify(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>) -> Result<Certificate, OrbitError> {
    let halves = HalfCycle::pair(axis, relay)?;
    let swings = solve(&halves)?;
    let half_period_s = 0.5 * limit_cycle(axis, relay)?.period_s;
    let not_proved = |what| OrbitError::NotProved { what, half_period_s };
    let [upward, downward] = Half::pair(axis, relay)?;
    let guess = {
        let ([a, b], [c, d]) = (angles(&halves[0], &swings[0], axis), angles(&halves[1], &swings[1], axis));
        [a, b, c, d]
    };
    let half_width = Interval::point(relay.half_width());
    let delay_s = Interval::point(axis.delay_s());
    let misses = |[a0, a, b0, b]: [Gradient<4>; 4]| {
        let (above, below) = (upward.excursion(a0, a), downward.excursion(b0, b));
        let width = Gradient::constant(Interval::two() * half_width);
        let delay = Gradient::constant(delay_s);
        [
            upward.approach(a0) - below - width,
            downward.approach(b0) - above - width,
            upward.rise_time(a) - upward.rise_time(a0) - delay,
            downward.rise_time(b) - downward.rise_time(b0) - delay,
        ]
    };
    // Narrow first: a narrow box that contains the root is accepted at once.
    let found = [1e-11, 1e-9, 1e-7, 1e-5].into_iter().find_map(|radius| {
        let start = guess.map(|angle| Interval::point(angle) + Interval::symmetric(radius * angle));
        match krawczyk(misses, start, 20) {
            Roots::Unique { enclosure, .. } => Some(enclosure),
            _ => None,
        }
    });
    let [a0, a, b0, b] = found.ok_or(not_proved("that it exists beside its floating-point approximation"))?;
    let (above, below) = (upward.end(a0, a), downward.end(b0, b));
    let enclosure = LimitCycle::between(half_width, &above, &below);
    if !enclosure.period_s.is_bounded() || !(enclosure.multiplier.upper() < 1.0) {
        return Err(not_proved("that deviations from it shrink"));
    }
    let way = Interval::two() * half_width;
    let starts = if [upward, downward].iter().all(|half| half.farthest(delay_s).precedes(way)) {
        Starts::Every
    } else {
        Starts::OneCommandOnItsWay
    };
    let alone = starts == Starts::Every;
    Ok(Certificate { unique: alone, attracting: alone, starts, enclosure })
}

/// Near the angles (see [`Half`]) of the level and of the switching.
fn angles(half: &HalfCycle<f64>, swing: &Swing<f64>, axis: &DragAxis<f64>) -> [f64; 2] {
    let drive = &half.drive;
    let terminal = drive.terminal_speed();
    let angle = |speed: f64, acceleration: f64| {
        if speed < 0.5 * terminal {
            -Real::ln_1p(-speed / terminal)
        } else {
            -Real::ln(acceleration / (terminal * (drive.linear + drive.quadratic * (terminal + speed))))
        }
    };
    let (speed, acceleration) = (swing.level_speed, swing.level_acceleration);
    let lag = drive.advance(speed, axis.delay_s());
    [angle(speed, acceleration), angle(lag.speed, acceleration * lag.speed_gain)]
}

/// A half cycle over intervals. The motion from rest has the coordinate `angle` with `speed = terminal (1 - exp(-angle))`,
/// whose rate is `slow + (fast - slow)(1 - exp(-angle))`: nothing in it is singular at terminal speed.
#[derive(Clone, Copy, Debug)]
struct Half {
    /// Force of the command that drives over alpha.
    drive: Interval,
    brake: OneWay<Interval>,
    terminal: Interval,
    /// Rate of the angle at rest, in 1/s.
    slow: Interval,
    /// Rate of the angle at terminal speed, in 1/s.
    fast: Interval,
}

impl Half {
    fn pair(axis: &DragAxis<f64>, relay: &RelayHysteresis<f64>) -> Result<[Self; 2], PlantError> {
        let exact = Interval::point;
        let interval = DragAxis::mixed(exact(axis.alpha()), exact(axis.linear_drag()), exact(axis.quadratic_drag()))?;
        let (level, constant) = (exact(relay.level()), exact(axis.disturbance()) + exact(relay.offset()));
        let (upward, downward) = (level + constant, level - constant);
        let half = |drive, brake: Interval| {
            let motion = interval.one_way(drive);
            let terminal = motion.terminal_speed();
            let slow = motion.linear + motion.quadratic * terminal;
            let fast = slow + motion.quadratic * terminal;
            Self { drive: motion.drive, brake: interval.one_way(-brake), terminal, slow, fast }
        };
        Ok([half(upward, downward), half(downward, upward)])
    }

    /// No way from rest is longer after a time under this command: by the drive without drag, and by terminal speed.
    fn farthest(&self, time_s: Interval) -> Interval {
        let free = self.drive * time_s.square() / Interval::two();
        free.min(self.terminal * time_s)
    }

    fn rate(&self, angle: Interval) -> Interval {
        self.slow - (self.fast - self.slow) * (-angle).exp_m1()
    }

    fn speed(&self, angle: Interval) -> Interval {
        -self.terminal * (-angle).exp_m1()
    }

    /// Time from rest: the integral of `1/rate`.
    fn rise_time(&self, angle: Gradient<4>) -> Gradient<4> {
        let at = angle.value();
        let bend = -((self.fast - self.slow) / self.slow) * (-at).exp_m1();
        angle.chain((at + bend.ln_1p()) / self.fast, Interval::ONE / self.rate(at))
    }

    /// Way from rest: the integral of `speed/rate`.
    fn approach(&self, angle: Gradient<4>) -> Gradient<4> {
        let at = angle.value();
        let numbers = [at, self.slow, self.fast - self.slow];
        let [share] = integral(|share| rise(share, numbers), |share| rise(share, numbers.map(Jet::constant)));
        let way = at * self.terminal * share;
        angle.chain(way, self.speed(at) / self.rate(at))
    }

    /// Way from a speed, reached at `angle`, to rest under the opposite command.
    fn stop(&self, angle: Gradient<4>) -> Gradient<4> {
        let speed = self.speed(angle.value());
        let slope = self.terminal * (-angle.value()).exp() * speed / self.braking(speed);
        angle.chain(self.stop_integrals(speed)[0], slope)
    }

    /// Way from the relay's level to rest.
    fn excursion(&self, level: Gradient<4>, switch: Gradient<4>) -> Gradient<4> {
        self.approach(switch) - self.approach(level) + self.stop(switch)
    }

    fn braking(&self, speed: Interval) -> Interval {
        -self.brake.acceleration(speed)
    }

    /// Way and time to rest.
    fn stop_integrals(&self, speed: Interval) -> [Interval; 2] {
        let force = -self.brake.drive;
        let linear = self.brake.linear * speed / force;
        let quadratic = self.brake.quadratic * speed.square() / force;
        let drag = [linear, quadratic];
        let [way, time] = integral(|share| stop(share, drag), |share| stop(share, drag.map(Jet::constant)));
        [speed.square() / force * way, speed / force * time]
    }

    fn end(&self, level: Interval, switch: Interval) -> End<Interval> {
        let constant = Gradient::constant;
        let lag = (self.approach(constant(switch)) - self.approach(constant(level))).value();
        let (speed, level_speed) = (self.speed(switch), self.speed(level));
        let [stop, stop_time_s] = self.stop_integrals(speed);
        // Speeds by angles: nothing cancels near terminal speed.
        let gained = -self.terminal * (-level).exp() * (level - switch).exp_m1();
        let driving = self.terminal * (-switch).exp() * self.rate(switch);
        End {
            switch_speed: speed,
            switch_lag: lag,
            excursion: lag + stop,
            rise_time_s: self.rise_time(constant(switch)).value(),
            stop_time_s,
            gain: (gained + speed * driving / self.braking(speed)) / level_speed,
        }
    }
}

/// Integral over [0, 1], nearly as narrow as rounding allows, of a formula in both arithmetics.
fn integral<const M: usize>(
    range: impl Fn(Interval) -> [Interval; M],
    jet: impl Fn(CellJet) -> [CellJet; M],
) -> [Interval; M] {
    let scale = range(Interval::ONE).map(Interval::magnitude).into_iter().fold(f64::INFINITY, f64::min);
    let integrand = (range, |share| Some(jet(share)));
    integrate(&integrand, Interval::ZERO, Interval::ONE, 1e-14 * scale, 300).integrals
}

/// `speed/(terminal rate)` over the share of an angle; rates at rest, and by how much they grow.
fn rise<T: Real>(share: T, [angle, slow, growth]: [T; 3]) -> [T; 1] {
    let speed = -(-(angle * share)).exp_m1();
    [speed / (slow + growth * speed)]
}

/// Way and time to rest over the share of a speed, with the drag there in units of the braking force.
fn stop<T: Real>(share: T, [linear, quadratic]: [T; 2]) -> [T; 2] {
    let time = T::one() / (T::one() + (linear + quadratic * share) * share);
    [share * time, time]
}
