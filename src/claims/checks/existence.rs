//! Oscillations proved by a rigorous describing function, against a step-by-step integration.

use super::{Case, Draw, claim, tolerance};
use crate::balance::{HarmonicBalance, LipschitzLoop, OddCharacteristic, ProvedOscillation};
use crate::describing::ClosedForm;
use crate::nonlinearity::Tanh;
use crate::numeric::{Interval, runge_kutta};
use crate::plant::TransferFunction;

/// Steps of a period by the classical Runge-Kutta method, of fourth order: `(2 pi/4000)^4 = 6e-12`; `(2 pi/4000)^3/6 = 6e-10` where quadratic
/// drag has its kink.
pub(super) const STEPS: u32 = 4000;

claim! {
    RIGOROUS_DESCRIBING_FUNCTION = "rigorous-describing-function" Theorem
    "A box of frequency and harmonics that the loop's balance maps into itself, the harmonics above being a contraction, holds an oscillation";
    cases |all| all.div_ceil(100);
    corrected returns(1.0);
    // The oscillation of another loop, whose gain is 0.1 % larger.
    false returns(1.001);
    not_proved "the theorem is proved by hand, each box by two programs";
}

/// The lags, the gain and the characteristic `tanh(scale x)` of `gain/(s (s + a)(s + b))`.
struct TanhLoop {
    poles: [f64; 2],
    gain: f64,
    scale: f64,
}

impl TanhLoop {
    /// Above the critical gain `a b (a + b)/scale`, at which the loop begins to oscillate.
    fn draw(draw: &mut Draw) -> Self {
        let poles = [draw.log_uniform("first_pole", 0.3, 3.0), draw.log_uniform("second_pole", 0.3, 3.0)];
        let scale = draw.log_uniform("scale", 0.3, 3.0);
        let critical = poles[0] * poles[1] * (poles[0] + poles[1]) / scale;
        Self { poles, gain: critical * draw.log_uniform("gain_over_critical", 1.2, 5.0), scale }
    }

    fn proved(&self) -> Option<ProvedOscillation> {
        let plant = with_integrator(self.poles, self.gain)?;
        let characteristic = Tanh::new(1.0, self.scale).ok()?;
        let balance = HarmonicBalance::new(&plant, |sweep| characteristic.describing_function(sweep)).ok()?;
        let first = *balance.intersections().ok()?.first()?;
        let odd = OddCharacteristic::from_catalogue("tanh", &[1.0, self.scale]).ok()?;
        LipschitzLoop::new(&plant, odd).ok()?.prove_near(first.amplitude, first.omega_rad_s).ok()
    }
}

/// `gain/(s (s + a)(s + b))`.
pub(super) fn with_integrator([a, b]: [f64; 2], gain: f64) -> Option<TransferFunction> {
    TransferFunction::new(&[gain], &[1.0, a + b, a * b, 0.0]).ok()
}

/// How far from its state at phase zero a loop `x = -gain/(s (s + a)(s + b)) n(x)` is a period later, in shares of the amplitudes of
/// the state's components. The start and the period are a proved oscillation's.
pub(super) fn return_error(proved: &ProvedOscillation, [a, b]: [f64; 2], gain: f64, n: impl Fn(f64) -> f64) -> f64 {
    let (omega, amplitude) = (proved.omega_rad_s().midpoint(), proved.amplitude().midpoint());
    // Re sum X_k, Re sum jkw X_k, Re sum (jkw)^2 X_k.
    let start = (0..=proved.highest_harmonic()).fold([0.0; 3], |[y, v, w], k| {
        let [re, im] = proved.harmonic(k).map_or([0.0; 2], |parts| parts.map(Interval::midpoint));
        let rate = k as f64 * omega;
        [y + re, v - rate * im, w - rate * rate * re]
    });
    let slope = |[y, v, w]: [f64; 3]| [v, w, -(a + b) * w - a * b * v - gain * n(y)];
    let step = core::f64::consts::TAU / omega / f64::from(STEPS);
    let end = (0..STEPS).fold(start, |state, _| runge_kutta(state, step, slope));
    let scales = [amplitude, amplitude * omega, amplitude * omega * omega];
    (0..3).map(|i| (end[i] - start[i]).abs() / scales[i]).fold(0.0, f64::max)
}

/// From the state that a proved box has at phase zero, the loop with its gain times `factor` returns to it after a period.
fn returns(draw: &mut Draw, factor: f64) -> Option<Case> {
    let control_loop = TanhLoop::draw(draw);
    let proved = control_loop.proved()?;
    draw.note("omega_rad_s", proved.omega_rad_s().midpoint());
    draw.note("amplitude", proved.amplitude().midpoint());
    let TanhLoop { poles, gain, scale } = control_loop;
    let off = return_error(&proved, poles, factor * gain, |x| libm::tanh(scale * x));
    Some(Case::margin(1.0 - draw.note("off", off) / tolerance::INTEGRATED))
}
