//! A linear process with everything that an identification may find in it.

use super::Gains;
use crate::numeric::Real;

/// Parameters of a [`LinearProcess`].
pub(super) const PARAMETERS: usize = NAMES.len();

/// `y = (zero_s s + 1) exp(-delay_s s) u / ((lag_s s + 1)(filter_s s + 1)(alpha s^2 + drag s + stiffness + memory s/(memory_s s + 1)))`.
///
/// An axis has an inertia and a drag; an actuator adds its lag, a sensor its filter, water set in motion its memory. Without
/// inertia the same is a first-order process of gain `1/stiffness` and time constant `drag/stiffness`, or an integrator of gain
/// `1/drag`. Zero stands for a part that is not there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearProcess<T> {
    /// Inertia, F s^2/x.
    pub alpha: T,
    /// Slope of the drag, F s/x.
    pub drag: T,
    /// Restoring force, F/x.
    pub stiffness: T,
    /// Drag that follows the speed late, F s/x.
    pub memory: T,
    /// Time constant with which it follows, s.
    pub memory_s: T,
    /// Lag of the actuator, s.
    pub lag_s: T,
    /// Filter of the sensor, s.
    pub filter_s: T,
    /// Zero of the numerator, s.
    pub zero_s: T,
    /// Delay of the loop, s.
    pub delay_s: T,
}

/// The fields of a struct in one order: their names, from them and to them.
macro_rules! in_order {
    ($visible:vis $names:ident[$count:expr] of $type:ident: $($field:ident),+) => {
        /// Names of the fields, in the order of the parts.
        $visible const $names: [&str; $count] = [$(stringify!($field)),+];

        impl<T> $type<T> {
            /// From parts in the order of the fields.
            pub fn from_parts([$($field),+]: [T; $count]) -> Self {
                Self { $($field),+ }
            }

            /// The parts in the order of the fields.
            pub fn parts(self) -> [T; $count] {
                let Self { $($field),+ } = self;
                [$($field),+]
            }
        }
    };
}
pub(super) use in_order;
in_order! { NAMES[9] of LinearProcess: alpha, drag, stiffness, memory, memory_s, lag_s, filter_s, zero_s, delay_s }

impl<T: Real> LinearProcess<T> {
    /// Numerator and denominator of the open loop without its delay, ascending powers of s.
    pub(super) fn open_loop(&self, gains: [T; 4]) -> Fraction<T> {
        let [proportional, integral, derivative, gain_filter_s] = gains;
        let mut controller =
            [integral, proportional + integral * gain_filter_s, derivative + proportional * gain_filter_s];
        // s ((alpha s^2 + drag s + stiffness)(memory_s s + 1) + memory s).
        let mut body = [
            T::zero(),
            self.stiffness,
            self.drag + self.memory + self.stiffness * self.memory_s,
            self.alpha + self.drag * self.memory_s,
            self.alpha * self.memory_s,
        ];
        // Without integral action numerator and denominator have the factor s in common.
        if integral.vanishes() {
            controller.rotate_left(1);
            body.rotate_left(1);
        }
        let numerator = times(times(spread(controller), self.zero_s), self.memory_s);
        let denominator = [gain_filter_s, self.lag_s, self.filter_s].into_iter().fold(spread(body), times);
        Fraction { numerator, denominator }
    }
}

impl LinearProcess<f64> {
    /// Open loop under a controller at frequencies in rad/s: real and imaginary part of each.
    pub(crate) fn open_loop_at(&self, gains: &Gains<f64>, omega_rad_s: &[f64]) -> Vec<[f64; 2]> {
        let open_loop = self.open_loop(constants(gains));
        omega_rad_s.iter().map(|omega| open_loop.response(*omega, self.delay_s)).collect()
    }
}

/// Degree of the open loop's denominator with every part there.
pub(super) const DEGREE: usize = 7;

/// Ascending powers of s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fraction<T> {
    pub(super) numerator: [T; DEGREE + 1],
    pub(super) denominator: [T; DEGREE + 1],
}

fn spread<T: Real, const N: usize>(polynomial: [T; N]) -> [T; DEGREE + 1] {
    core::array::from_fn(|k| polynomial.get(k).copied().unwrap_or(T::zero()))
}

/// The polynomial times `time_s s + 1`.
fn times<T: Real>(polynomial: [T; DEGREE + 1], time_s: T) -> [T; DEGREE + 1] {
    core::array::from_fn(|k| match k {
        0 => polynomial[0],
        _ => polynomial[k] + polynomial[k - 1] * time_s,
    })
}

/// The gains as numbers of any arithmetic: proportional, integral, derivative, filter.
pub(super) fn constants<T: Real>(gains: &Gains<f64>) -> [T; 4] {
    [gains.proportional(), gains.integral(), gains.derivative(), gains.filter_s()].map(T::from_f64)
}

impl<T: Real> Fraction<T> {
    /// Real and imaginary part of a polynomial at `s = j omega`.
    fn at(polynomial: &[T; DEGREE + 1], omega: T) -> [T; 2] {
        let y = -omega.square();
        let even = (0..=DEGREE / 2).rev().fold(T::zero(), |sum, k| sum * y + polynomial[2 * k]);
        let odd = (0..=DEGREE / 2).rev().fold(T::zero(), |sum, k| sum * y + polynomial[2 * k + 1]);
        [even, odd * omega]
    }

    /// Numerator, turned by `-angle`, and denominator at `s = j omega`.
    pub(super) fn parts(&self, omega: T, angle: T) -> [[T; 2]; 2] {
        let ([re, im], below) = (Self::at(&self.numerator, omega), Self::at(&self.denominator, omega));
        let (sine, cosine) = (angle.sin(), angle.cos());
        [[re * cosine + im * sine, im * cosine - re * sine], below]
    }
}

impl Fraction<f64> {
    /// Its value at `s = j omega` behind a delay.
    pub(super) fn response(&self, omega: f64, delay_s: f64) -> [f64; 2] {
        let [[re, im], [below_re, below_im]] = self.parts(omega, omega * delay_s);
        let size = libm::hypot(below_re, below_im).powi(2);
        [(re * below_re + im * below_im) / size, (im * below_re - re * below_im) / size]
    }
}
