//! The rule AMIGO with its derivative filtered at a tenth of the derivative time: the largest sensitivity is at most 1.5 for every first-order
//! process with dead time and for the integrator, proved in intervals.
//!
//! Time is counted in dead times and the gain is scaled away: the process is `exp(-s)/((1 - r) s + r)` with the normalised dead time
//! `r = L/(L + T)` from 0, an integrator, to 1, a dead time alone. With `C P = N exp(-s)/D` the sensitivity is at most `M` where
//! `|D + N exp(-s)|^2 > |D|^2/M^2`, `s = i omega`.

use selfosc::autotune::FirstOrderProcess;
use selfosc::control::{Gains, LinearProcess, ProcessIntervals, Structure};
use selfosc::numeric::{Interval, Real};
use selfosc::proof::NotProved;
use selfosc::proof::branch_and_bound::{Visit, prove_positive, subdivide};

/// Up to this frequency the inequality is proved as it stands, in 1/dead time; above, `|C P| < 1 - 1/M` is.
const HIGHEST: f64 = 60.0;

/// Gain, integral time and derivative time at a normalised dead time.
fn amigo<T: Real>(r: T) -> [T; 3] {
    let process = FirstOrderProcess { drag: T::one() - r, stiffness: r, dead_time_s: T::one(), reverse: false };
    process.amigo(T::zero())
}

fn interval(low: f64, high: f64) -> Interval {
    Interval::new(low, high).unwrap()
}

/// Real and imaginary part of a product.
fn times<T: Real>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// `|D + N exp(-s)|^2 - |D|^2/M^2` at normalised dead time and frequency.
fn margin<T: Real>([r, omega]: [T; 2], largest: f64) -> T {
    let (zero, one) = (T::zero(), T::one());
    let [gain, integral_s, derivative_s] = amigo(r);
    let filter = [one, omega * derivative_s / T::from_f64(10.0)];
    // D = s ((1 - r) s + r)(filter s + 1), N = gain ((s + 1/Ti)(filter s + 1) + Td s^2).
    let below = times(times([zero, omega], [r, (one - r) * omega]), filter);
    let [re, im] = times([one / integral_s, omega], filter);
    let above = [gain * (re - derivative_s * omega.square()), gain * im];
    let turned = times(above, [omega.cos(), -omega.sin()]);
    let square = |[re, im]: [T; 2]| re.square() + im.square();
    square([below[0] + turned[0], below[1] + turned[1]]) - square(below) / T::from_f64(largest).square()
}

/// That `|C P| < 1 - 1/M` for `omega` above [`HIGHEST`]. With `x = (1 - r) omega` and `omega Td = d x`, `d = 0.5/(1 - 0.7 r)`,
/// `|C P| <= k (|1 + 1.1 i d x|/|1 + 0.1 i d x| + 1/(omega Ti))/|r + i x|`; `x = y/(1 - y)` for `y` from 0 to 1.
fn falls_off(largest: f64) -> bool {
    let number = Interval::point;
    let found = subdivide([interval(0.0, 1.0); 2], 200_000, |&[r, y]| {
        let w = number(1.0) - y;
        // x is at least (1 - r) HIGHEST.
        let least = (1.0 - r.upper()) * HIGHEST;
        if y.upper() < least / (1.0 + least) * (1.0 - 1e-12) {
            return Visit::Settled;
        }
        let [gain, integral_s, _] = amigo(r);
        let turn = number(0.5) / (number(1.0) - number(0.7) * r) * y;
        let lead = (w.square() + (number(1.1) * turn).square()) / (w.square() + (number(0.1) * turn).square());
        let own = (r * w).square() + y.square();
        if !own.is_positive() {
            return Visit::settled(false);
        }
        let size = gain * w / own.sqrt() * (lead.sqrt() + number(1.0) / (number(HIGHEST) * integral_s));
        Visit::settled(size.upper() < 1.0 - 1.0 / largest)
    });
    found.unsettled.is_none()
}

#[test]
fn amigo_keeps_a_sensitivity_of_one_and_a_half() {
    let domain = [interval(0.0, 1.0), interval(0.0, HIGHEST)];
    let proved = prove_positive(|at| margin(*at, 1.5), domain, 2_000_000);
    assert!(proved.is_ok(), "{proved:?}");
    assert!(falls_off(1.5));
    // The loop is stable for one of them; no root crosses the imaginary axis, where |1 + C P| > 0, on the way to another.
    let [gain, integral_s, derivative_s] = amigo(0.5_f64);
    let gains = Gains::new(Structure::Pid, gain, gain / integral_s, gain * derivative_s, 0.1 * derivative_s).unwrap();
    let mut parts = [Interval::ZERO; 9];
    (parts[1], parts[2], parts[8]) = (Interval::point(0.5), Interval::point(0.5), Interval::point(1.0));
    assert!(ProcessIntervals::new(LinearProcess::from_parts(parts)).unwrap().all_stable(&gains));
}

/// A sensitivity that some process exceeds is refuted by that process.
#[test]
fn a_smaller_bound_is_refuted() {
    let domain = [interval(0.0, 1.0), interval(0.0, HIGHEST)];
    let refuted = prove_positive(|at| margin(*at, 1.44), domain, 200_000);
    assert!(matches!(refuted, Err(NotProved::Refuted { .. })), "{refuted:?}");
    assert!(!falls_off(1.45));
}
