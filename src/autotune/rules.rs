//! Rules of thumb on the same process, and the sensitivity that each would have.

use super::FirstOrderProcess;
use super::gains::ultimate;
use crate::control::{Gains, LinearProcess, ProcessIntervals, RobustCriterion, Rule, Structure, UltimatePoint};
use crate::numeric::Interval;

/// A rule's gains, with the largest sensitivity that the likeliest process has under them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ruled {
    /// Name of the rule.
    pub name: &'static str,
    /// Its gains, for an output that rises with the command.
    pub gains: Gains<f64>,
    /// `None` where the loop is not stable.
    pub sensitivity: Option<f64>,
}

/// The rules that apply to a process. Those of Skogestad (J. Process Control 13, 2003) and Astrom and Hagglund (AMIGO, J. Process
/// Control 14, 2004) are for first-order processes and integrators; of a second lag half counts as dead time (Skogestad's half
/// rule).
#[must_use]
pub fn rules(process: &LinearProcess<f64>) -> Vec<Ruled> {
    let mut found = Vec::new();
    let mut add = |name: &'static str, gains: Option<Gains<f64>>| {
        let Some(gains) = gains else { return };
        let point = ProcessIntervals::new(LinearProcess::from_parts(process.parts().map(Interval::point)));
        let sensitivity = point
            .ok()
            .filter(|point| point.all_stable(&gains))
            .and_then(|point| point.enclose(&gains, RobustCriterion::Sensitivity).ok().map(|found| found.met));
        found.push(Ruled { name, gains, sensitivity });
    };
    if let Some([ku, omega]) = ultimate(process)
        && let Ok(point) = UltimatePoint::new(ku, core::f64::consts::TAU / omega)
    {
        for (rule, name) in [
            (Rule::ZieglerNicholsPi, "Ziegler-Nichols PI"),
            (Rule::ZieglerNicholsPid, "Ziegler-Nichols PID"),
            (Rule::TyreusLuybenPi, "Tyreus-Luyben PI"),
            (Rule::TyreusLuybenPid, "Tyreus-Luyben PID"),
            (Rule::NoOvershoot, "no overshoot"),
        ] {
            add(name, rule.gains(&point).ok());
        }
    }
    // First-order equivalent: alpha/drag is about the shorter lag.
    let LinearProcess { alpha, drag, stiffness, delay_s, .. } = *process;
    let short_s = alpha / drag;
    let late_s = delay_s + 0.5 * short_s;
    let ideal = |gain: f64, integral_s: f64, derivative_s: f64| {
        Gains::new(Structure::Pid, gain, gain / integral_s, gain * derivative_s, derivative_s / 10.0).ok()
    };
    if late_s > 0.0 {
        // SIMC with the closed loop's time constant equal to the dead time; T/K is `drag` whether or not T is finite.
        let time_s = if stiffness > 0.0 { drag / stiffness } else { f64::INFINITY };
        add("SIMC PI", ideal(drag / (2.0 * late_s), time_s.min(8.0 * late_s), 0.0));
        let first_order = FirstOrderProcess { drag, stiffness, dead_time_s: late_s, reverse: false };
        add("AMIGO PID", first_order.gains(0.0).ok());
    }
    found
}
