//! The drag axis with a single law of drag: formulas without case distinctions, for every arithmetic.
//!
//! Without delay, and with quadratic drag alone, everything depends on `E = exp(-4 g)`, `g = beta x_a/alpha`, which maps all
//! parameters onto (0, 1); with linear drag alone on `g = x_a beta^2/(C alpha)`. The disturbance enters as the
//! ratio `mu = (delta + d)/C`. Levels at `+-x_a`, force ratio `1 + mu` with the positive command, `1 - mu` with the negative.

use crate::numeric::{Real, minus_ln_1p, minus_tanh};

/// Quadratic drag, half-cycle map: from `y = (V/k)^2` at a switching to that at the next, `k = sqrt(C/beta)`, when the
/// command in between gives the force `ratio` (in units of C); `gap = 1 - E = 1 - exp(-4 g)`.
///
/// `y -> ratio (y + ratio gap)/(y + ratio)`; with ratio 1 it is `1 - E/(1 + y)`.
pub fn quadratic_half_cycle<T: Real>(y: T, gap: T, ratio: T) -> T {
    ratio * (y + ratio * gap) / (y + ratio)
}

/// Quadratic drag: `y` at the upper and at the lower switching on the limit cycle, `gap = 1 - E`, `mu` in (-1, 1).
///
/// The fixed point of two half-cycle maps solves `y^2 - 2 mu gap y - (1 - mu^2) gap = 0`; without disturbance both are
/// `sqrt(1 - E)`.
pub fn quadratic_speeds<T: Real>(gap: T, mu: T) -> [T; 2] {
    let shift = mu.abs() * gap;
    let product = (T::one() - mu.square()) * gap;
    let larger = shift + (shift.square() + product).sqrt();
    let smaller = product / larger;
    // A constant force up makes the axis faster on its way up; zero counts as up, as `abs` has it for derivatives.
    let down = -mu;
    [down.select(|| larger, || smaller), down.select(|| smaller, || larger)]
}

/// Quadratic drag without disturbance: `T/2 sqrt(beta C)/alpha = atan sqrt(y) + atanh sqrt(y)` at `y = sqrt(gap)`.
///
/// For large g, sqrt(y) is 1 within rounding; `1 - y = E/(1 + y)` then gives the logarithm from g itself.
pub fn quadratic_period<T: Real>(g: T) -> T {
    let four = T::from_f64(4.0);
    let y = (-(-four * g).exp_m1()).sqrt();
    let root = y.sqrt();
    // atanh r = ln(1 + r) - ln(1 - r^2)/2 with ln(1 - y) = -4 g - ln(1 + y)
    let large = root.ln_1p() + T::two() * g + y.ln_1p() / T::two();
    root.atan() + (g - T::from_f64(0.1)).select(|| root.atanh(), || large)
}

/// Linear drag: zero where `next` follows `speed` (both `V beta/C`) over a half cycle; `g` as above, force `ratio` as in
/// [`quadratic_half_cycle`]. It increases with `next` and decreases with `speed`, for `0 <= next < ratio`.
pub fn linear_half_cycle<T: Real>(speed: T, next: T, g: T, ratio: T) -> T {
    let (before, after) = (speed / ratio, next / ratio);
    let (braked, driven) = (minus_ln_1p(before), minus_ln_1p(-after));
    ratio * (driven - braked) - T::two() * g
}

/// Linear drag without disturbance: `g = z - tanh z` from `z = beta T/(4 alpha)`.
pub fn linear_half_width<T: Real>(z: T) -> T {
    minus_tanh(z)
}

/// Linear drag without disturbance: `(X_m - x_a) beta^2/(C alpha) = tanh z - ln(1 + tanh z)`.
pub fn linear_amplitude_excess<T: Real>(z: T) -> T {
    minus_ln_1p(z.tanh())
}

/// Slope of the return map without delay, as numerator and denominator, for every drag law: the drag forces at the
/// upper and at the lower switching are `drags`, the disturbance with the relay's offset is `mu`, all in units of C.
///
/// Energy gives a half cycle's share: net driving force over force that brakes, `(1 + mu - d_1)/(1 - mu + d_1)`. The
/// denominator exceeds the numerator by exactly `2 (d_1 + d_2)`: the map contracts wherever there is drag.
pub fn return_slope<T: Real>(mu: T, drags: [T; 2]) -> [T; 2] {
    let [upward, downward] = [T::one() + mu, T::one() - mu];
    let [upper, lower] = drags;
    [(upward - upper) * (downward - lower), (downward + upper) * (upward + lower)]
}

/// 1 less drag over force, at the share `speed` of the terminal speed, where `linear` is the linear share of the
/// drag at terminal speed.
pub fn force_left<T: Real>(speed: T, linear: T) -> T {
    T::one() - (linear + (T::one() - linear) * speed) * speed
}
