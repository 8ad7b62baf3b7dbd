//! First-order processes with dead time: their oscillation under a relay, and gains of bounded sensitivity.

use super::{Case, ClaimDomain, ClaimPart, ClaimVariable, Draw, Evidence, Verdict, Witness, claim, tolerance};
use crate::autotune::FirstOrderProcess;
use crate::control::{LinearProcess, ProcessIntervals};
use crate::numeric::{Interval, Real};
use crate::orbit::{TwoLevelRelay, orbits};
use crate::plant::TransferFunction;
use crate::proof::NotProved;
use crate::proof::branch_and_bound::{Visit, prove_positive, subdivide};

claim! {
    RELAY_FIRST_ORDER = "relay-first-order" Theorem
    "a first-order process or an integrator with dead time under a two-level relay: half-periods and extremes in closed form, once a command has stood for a dead time";
    cases |all| all.min(200);
    corrected first_order_cycle(0.9, 1.0, SLOWEST);
    // The output turns at the relay's level: no dead time beyond it.
    false first_order_cycle(0.9, 0.0, SLOWEST);
    needs "levels-passed" first_order_cycle(1.1, 1.0, SLOWEST);
    needs "low-for-a-dead-time" first_order_cycle(0.9, 1.0, FASTER);
    not_proved "half-periods are logarithms of the parameters: the program samples them, the kernel checks them";
}

/// Shares of the closed form's period between which its oscillation is looked for, or a faster oscillation that a dead time allows.
const SLOWEST: [f64; 2] = [0.9, 1.1];
const FASTER: [f64; 2] = [0.05, 0.5];

/// The slowest enclosed oscillation of those looked for against the closed form. The levels reach up to `reach` of the
/// outputs at which the process settles; `dead` is the share of the dead time in the closed form.
fn first_order_cycle(draw: &mut Draw, reach: f64, dead: f64, shares: [f64; 2]) -> Option<Case> {
    let (gain, time_s) = (draw.log_uniform("gain", 1e-1, 1e1), draw.log_uniform("time_s", 1e-1, 1e1));
    let dead_time_s = time_s * draw.log_uniform("dead_over_time", 0.1, 3.0);
    let (high, low) = (draw.log_uniform("high", 0.1, 10.0), -draw.log_uniform("low", 0.1, 10.0));
    let level = reach * draw.uniform("level_share", 0.95, 1.0);
    let integrates = draw.index("integrates", 2) == 1;
    // Levels as shares of the way to where either command settles, or of the way in a time constant.
    let (upper, lower) = (level * gain * high, draw.uniform("lower_share", -0.5, 0.5) * level * gain * high.min(-low));
    let relay =
        TwoLevelRelay::new(high, low, 0.5 * (upper - lower)).ok()?.with_reference(0.5 * (upper + lower)).ok()?;
    let (drag, stiffness) = (time_s / gain, if integrates { 0.0 } else { 1.0 / gain });
    let closed = FirstOrderProcess { drag, stiffness, dead_time_s: dead * dead_time_s, reverse: false };
    let Ok(cycle) = closed.relay_cycle(&relay, 0.0) else { return Some(Case::truth(false)) };
    let (period_s, [least, most]) = (cycle.time_high_s + cycle.time_low_s, shares);
    let plant = TransferFunction::new(&[1.0], &[drag, stiffness]).ok()?.with_delay(dead_time_s).ok()?;
    let found = orbits(&plant, &relay, Some(least * period_s..=most * period_s)).ok()?;
    // A faster oscillation need not be there.
    let Some(orbit) = found.orbits.first() else { return (most > 1.0).then(|| Case::truth(false)) };
    let size = cycle.maximum - cycle.minimum;
    let equations = [
        ("time_high_s", cycle.time_high_s, orbit.time_high_s.midpoint(), period_s),
        ("time_low_s", cycle.time_low_s, orbit.time_low_s.midpoint(), period_s),
        ("minimum", cycle.minimum, orbit.minimum.midpoint(), size),
        ("maximum", cycle.maximum, orbit.maximum.midpoint(), size),
    ];
    Some(draw.equations(equations, tolerance::CANCELLING))
}

claim! {
    AMIGO_SENSITIVITY = "amigo-sensitivity" Theorem
    "the rule AMIGO with its derivative filtered at a tenth of the derivative time keeps the sensitivity at most 1.5 for every first-order process with dead time and every integrator" {
        corrected: Some(|_| amigo_sensitivity(1.5)),
        // Some process exceeds this.
        falsified: |_| amigo_sensitivity(1.44),
    }
}

/// Time is counted in dead times and the gain is scaled away: the process is `exp(-s)/((1 - r) s + r)` with the normalised dead time
/// `r = L/(L + T)` from 0, an integrator, to 1, a dead time alone.
const EVERY_PROCESS: ClaimPart =
    ClaimPart::over("every-process", "", const { &[ClaimVariable::number("L/(L + T)", 0.0, 1.0)] });
/// Up to this frequency the inequality is proved as it stands, in 1/dead time; above, `|C P| < 1 - 1/M` is.
const HIGHEST: f64 = 60.0;
/// Boxes of the inequality, and of the fall beyond [`HIGHEST`].
const BOXES: usize = 2_000_000;
const BOXES_BEYOND: usize = 200_000;

fn from_zero(upper: f64) -> Interval {
    Interval::ZERO.hull(Interval::point(upper))
}

fn process<T: Real>(r: T) -> FirstOrderProcess<T> {
    FirstOrderProcess { drag: T::one() - r, stiffness: r, dead_time_s: T::one(), reverse: false }
}

/// Real and imaginary part of a product.
fn times<T: Real>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// `|D + N exp(-s)|^2 - |D|^2/M^2` at normalised dead time and frequency, with `C P = N exp(-s)/D`, `s = i omega`: positive where the
/// sensitivity is below M.
fn room<T: Real>([r, omega]: [T; 2], largest: f64) -> T {
    let (zero, one) = (T::zero(), T::one());
    let [gain, integral_s, derivative_s] = process(r).amigo(zero);
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
    let found = subdivide([from_zero(1.0); 2], BOXES_BEYOND, |&[r, y]| {
        let w = number(1.0) - y;
        // x is at least (1 - r) HIGHEST.
        let least = (1.0 - r.upper()) * HIGHEST;
        if y.upper() < least / (1.0 + least) * (1.0 - 1e-12) {
            return Visit::Settled;
        }
        let [gain, integral_s, _] = process(r).amigo(number(0.0));
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

/// A process of the family is stable under its gains: no root passes the imaginary axis, where `|1 + C P| > 0`, on the way to another.
fn one_is_stable() -> bool {
    let one = process(0.5);
    let number = Interval::point;
    let parts = [0.0, one.drag, one.stiffness, 0.0, 0.0, 0.0, 0.0, 0.0, one.dead_time_s].map(number);
    let set = ProcessIntervals::new(LinearProcess::from_parts(parts));
    set.is_ok_and(|set| one.gains(0.0).is_ok_and(|gains| set.all_stable(&gains)))
}

fn amigo_sensitivity(largest: f64) -> Verdict {
    let domain = [from_zero(1.0), from_zero(HIGHEST)];
    match prove_positive(|at| room(*at, largest), domain, BOXES) {
        Ok(proof) if falls_off(largest) && one_is_stable() => {
            let margin = proof.bound.value();
            Verdict::Holds(Evidence::inequality(ClaimDomain::new(const { &[EVERY_PROCESS] }), margin, proof.boxes))
        }
        Ok(_) => Verdict::undecided("the frequencies beyond 60/L, or the stability of one process"),
        Err(NotProved::Refuted { witness: [r, omega], value, .. }) => {
            let value = value.midpoint();
            Verdict::Refuted(Witness::new(vec![("L/(L + T)", r), ("omega L", omega), ("margin", value)]))
        }
        Err(NotProved::Undecided { boxes, .. }) => Verdict::Undecided { spent: format!("{boxes} boxes") },
    }
}
