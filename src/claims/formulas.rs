//! The program's formulas as definitions of Coq: the code that runs, evaluated over symbols, as the subject of proofs by a kernel.

use super::CLAIMS;
use super::checks::kernels::{BRANCHES, SIDES};
use crate::describing::{ClosedForm, DescribingFunction, bias_of_output};
use crate::identify::fit::select::pairwise::relative_spread_percent;
use crate::identify::iso::{amplitude_sensitivity, parameters};
use crate::nonlinearity::{
    Absolute, Backlash, DeadZone, DeadZoneSaturation, GainChanging, Kernel, NonlinearityError, PiecewiseLinear,
    Polyline, Polynomial, Preload, Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis, RelayHysteresis,
    Saturation, SaturationAsymmetric, Sinusoid,
};
use crate::numeric::{Interval, Real};
use crate::orbit;
use crate::proof::Expression;
use crate::vehicle::{Allocation, bilinear};

/// Any number; one above zero; zero or more.
const ANY: [f64; 2] = [-f64::MAX, f64::MAX];
const POSITIVE: [f64; 2] = [f64::MIN_POSITIVE, f64::MAX];
const NOT_NEGATIVE: [f64; 2] = [0.0, f64::MAX];
/// The power of two by which a band avoids overflow is 1 for these amplitudes; `kernel-band` proves that every power gives the same.
const NEAR_ONE: [f64; 2] = [f64::MIN_POSITIVE, 1.5];

const SMALL: [f64; 2] = [0.0, 1.0];
const LARGE: [f64; 2] = [2.0, f64::MAX];

/// Every formula, in the order of the claims: the text of `Formulas.v`.
///
/// A quantity stands for every number of its range; where the code decides by the ranges, the definition holds in them. Terms are
/// collected as [`Expression`] collects them.
///
/// ```
/// assert!(selfosc::claims::formulas().contains("Definition relay_f0_by_times (level t_high t_low : R)"));
/// ```
#[must_use]
pub fn formulas() -> String {
    let mut theory = Theory::default();
    kernels(&mut theory);
    members(&mut theory);
    identification(&mut theory);
    orbits(&mut theory);
    inequalities(&mut theory);
    format!("{HEAD}{}", theory.0)
}

const HEAD: &str = "\
(** The formulas of the program, written by [selfosc verify --formulas]: not to be edited. A changed formula changes this file, and breaks
    the theorems [formula_...] that say what it equals. *)
From Coq Require Import Reals List.
From Selfosc Require Import Kernels Catalogue.
Import ListNotations.
Open Scope R_scope.
";

/// The name of a quantity and its range.
type NamedRange = (&'static str, [f64; 2]);

/// Definitions, one a formula.
#[derive(Default)]
struct Theory(String);

impl Theory {
    /// A formula of quantities in ranges. An undefined formula is omitted, and every proof about it breaks.
    fn define<const N: usize>(
        &mut self,
        name: &str,
        quantities: [NamedRange; N],
        gives: impl FnOnce([Expression; N]) -> Option<String>,
    ) {
        let symbol = |(name, [from, to]): NamedRange| {
            Expression::symbol(name, name, Interval::new(from, to).unwrap_or(Interval::ENTIRE))
        };
        if let Some(term) = gives(quantities.map(symbol)) {
            let names = quantities.map(|(name, _)| name).join(" ");
            self.0 += &format!("\nDefinition {name} ({names} : R) :=\n  {term}.\n");
        }
    }
}

/// A number, or several as a tuple.
fn tuple<const N: usize>(terms: [Expression; N]) -> String {
    let terms = terms.map(Expression::coq).join(", ");
    if N == 1 { terms } else { format!("({terms})") }
}

/// Rows: the name of a definition, its quantities with their ranges, its numbers.
macro_rules! define {
    ($theory:ident; $($name:literal, [$($quantity:ident: $range:expr),+] => $numbers:expr;)+) => {$(
        $theory.define($name, [$((stringify!($quantity), $range)),+], |[$($quantity),+]| Some(tuple($numbers)));
    )+};
}

/// The same of a characteristic's term on a sweep, any or those given: bias and amplitude come last.
macro_rules! swept {
    ($theory:ident, $term:ident;
     $($name:expr, [$($quantity:ident: $range:expr),+] $(on $sweep:expr)? => $characteristic:expr;)+) => {$(
        let [bias, amplitude] = [$($sweep,)? [ANY, POSITIVE]][0];
        let quantities = [$((stringify!($quantity), $range),)+ ("bias", bias), ("amplitude", amplitude)];
        $theory.define(&$name, quantities, |[$($quantity,)+ bias, amplitude]| {
            $term($characteristic.ok()?, &Sinusoid::new(bias, amplitude).ok()?)
        });
    )+};
}

/// The closed form of each kernel, on each side and branch.
fn kernels(theory: &mut Theory) {
    fn closed(of: impl ClosedForm<Number = Expression>, sweep: &Sinusoid<Expression>) -> Option<String> {
        of.describing_function(sweep).ok().map(|df| tuple([df.f0, df.p, df.q]))
    }
    let ok = Ok::<Kernel<Expression>, NonlinearityError>;
    for (side, branches) in BRANCHES.into_iter().flat_map(|on| SIDES.map(|side| (side, on))) {
        let place = format!("{side:?}_{branches:?}").to_lowercase();
        swept! { theory, closed;
            format!("step_{place}"), [at_: ANY, height: ANY] => ok(Kernel::Step { at: at_, height, side, branches });
            format!("ramp_{place}"), [at_: ANY, slope: ANY] => ok(Kernel::Ramp { at: at_, slope, side, branches });
        }
    }
    for branches in BRANCHES {
        let place = format!("{branches:?}").to_lowercase();
        swept! { theory, closed;
            format!("sign_{place}"), [at_: ANY, level: ANY] => ok(Kernel::Sign { at: at_, level, branches });
            format!("constant_{place}"), [value: ANY] => ok(Kernel::Constant { value, branches });
        }
    }
    swept! { theory, closed;
        "line_df", [slope: ANY] => ok(Kernel::Line { slope });
        "band", [origin: ANY, lower: ANY, upper: ANY, slope: ANY] on [ANY, NEAR_ONE]
            => ok(Kernel::Band { origin, lower, upper, slope });
        "polynomial", [c0: ANY, c1: ANY, c2: ANY, c3: ANY, c4: ANY, c5: ANY]
            => Polynomial::new([c0, c1, c2, c3, c4, c5]);
    }
}

/// A kernel as a term of `Catalogue.v`.
fn kernel_term(kernel: Kernel<Expression>) -> String {
    let (name, numbers, place) = match kernel {
        Kernel::Constant { value, branches } => ("Constant", vec![value], format!(" {branches:?}")),
        Kernel::Line { slope } => ("Line", vec![slope], String::new()),
        Kernel::Sign { at, level, branches } => ("Sign", vec![at, level], format!(" {branches:?}")),
        Kernel::Step { at, height, side, branches } => ("Step", vec![at, height], format!(" {side:?} {branches:?}")),
        Kernel::Ramp { at, slope, side, branches } => ("Ramp", vec![at, slope], format!(" {side:?} {branches:?}")),
        Kernel::Band { origin, lower, upper, slope } => ("Band", vec![origin, lower, upper, slope], String::new()),
    };
    let numbers: Vec<_> = numbers.into_iter().map(Expression::coq_argument).collect();
    format!("{name} {}{place}", numbers.join(" "))
}

/// Each member of the piecewise-linear catalogue as its list of kernels: its parameters, bias and amplitude.
fn members(theory: &mut Theory) {
    fn list(of: impl PiecewiseLinear<Number = Expression>, sweep: &Sinusoid<Expression>) -> Option<String> {
        let mut terms = Vec::new();
        of.kernels(sweep, |kernel| terms.push(kernel_term(kernel)));
        Some(format!("[{}]", terms.join("; ")))
    }
    swept! { theory, list;
        "relay", [level: POSITIVE] => Relay::new(level);
        "relay_dead_zone", [level: POSITIVE, dead_zone: NOT_NEGATIVE] => RelayDeadZone::new(level, dead_zone);
        "relay_hysteresis", [level: POSITIVE, half_width: NOT_NEGATIVE, offset: ANY]
            => RelayHysteresis::new(level, half_width, offset);
        "relay_dead_zone_hysteresis", [level: POSITIVE, on_: LARGE, off: SMALL]
            => RelayDeadZoneHysteresis::new(level, on_, off);
        "saturation", [slope: POSITIVE, breakpoint: POSITIVE] => Saturation::new(slope, breakpoint);
        "saturation_asymmetric", [slope: POSITIVE, lower: SMALL, upper: LARGE]
            => SaturationAsymmetric::new(slope, lower, upper);
        "dead_zone", [slope: POSITIVE, half_width: NOT_NEGATIVE] => DeadZone::new(slope, half_width);
        "dead_zone_saturation", [slope: POSITIVE, half_width: SMALL, breakpoint: LARGE]
            => DeadZoneSaturation::new(slope, half_width, breakpoint);
        // By the three orders of the slopes.
        "gain_changing_1", [inner: [1.0, 2.0], outer: SMALL, breakpoint: POSITIVE]
            => GainChanging::new(inner, outer, breakpoint);
        "gain_changing_2", [inner: [0.5, 1.0], outer: [1.25, 2.0], breakpoint: POSITIVE]
            => GainChanging::new(inner, outer, breakpoint);
        "gain_changing_3", [inner: [1.0, 2.0], outer: [-2.0, -1.0], breakpoint: POSITIVE]
            => GainChanging::new(inner, outer, breakpoint);
        "preload", [slope: POSITIVE, level: POSITIVE] => Preload::new(slope, level);
        // Two treads either way.
        "quantizer", [tread: [1.0, 1.0]] on [[0.0, 0.0], [2.25, 2.25]] => Quantizer::new(tread);
        "absolute", [gain: ANY] => Absolute::new(gain);
        // The bias near the middle of three points.
        "polyline", [x0: [-2.0, -1.0], y0: ANY, x1: SMALL, y1: ANY, x2: [2.0, 3.0], y2: ANY, left: ANY, right: ANY]
            on [SMALL, POSITIVE] => Polyline::new([(x0, y0), (x1, y1), (x2, y2)], left, right);
        "backlash", [slope: POSITIVE, half_gap: NOT_NEGATIVE] => Backlash::new(slope, half_gap);
    }
}

/// From describing function to parameters, and their basis.
fn identification(theory: &mut Theory) {
    define! { theory;
        "relay_f0_by_times", [level: POSITIVE, t_high: POSITIVE, t_low: POSITIVE]
            => [bias_of_output(level, t_high, t_low)];
        "condition_40_least_amplitude", [half_width: NOT_NEGATIVE, bias: ANY]
            => [RelayHysteresis::new(Expression::one(), half_width, Expression::zero()).ok()?.least_amplitude(bias)];
        "table_3", [f0: ANY, p: ANY, q: ANY, amplitude: POSITIVE, omega: POSITIVE] => {
            let found = parameters(DescribingFunction { f0, p, q }, amplitude, omega);
            [found.alpha, found.beta, found.beta_quadratic, found.disturbance]
        };
        "delay_rotation", [f0: ANY, p: ANY, q: ANY, phase: ANY] => {
            let turned = DescribingFunction { f0, p, q }.delayed(phase);
            [turned.f0, turned.p, turned.q]
        };
        "quantisation", [ratio: [1.0, f64::MAX]] => {
            let found = amplitude_sensitivity(ratio);
            [found.alpha, found.beta, found.beta_quadratic]
        };
        "relative_spread", [first: ANY, second: ANY] => [relative_spread_percent(first, second)];
        "thruster_bilinear", [by_rate: POSITIVE, by_speed: NOT_NEGATIVE, rate: ANY, speed: ANY]
            => [bilinear([by_rate, by_speed], rate, speed)];
        "allocation_forces", [arm: POSITIVE, tau_1: ANY, tau_2: ANY]
            => Allocation::pair(arm).ok()?.forces(&[tau_1, tau_2]);
        // The inverse of the least arm has to be a number.
        "allocation_thrusts", [arm: [f64::MIN_POSITIVE, 1.0], force: ANY, moment: ANY]
            => Allocation::pair(arm).ok()?.thrusts(&[force, moment]);
    }
}

/// The exact orbits of a drag axis.
fn orbits(theory: &mut Theory) {
    const MU: [f64; 2] = [-1.0, 1.0];
    define! { theory;
        "quadratic_half_cycle", [y: ANY, gap: SMALL, ratio: POSITIVE] => [orbit::quadratic_half_cycle(y, gap, ratio)];
        "quadratic_speeds", [gap: SMALL, mu: MU] => orbit::quadratic_speeds(gap, mu);
        "quadratic_period", [g: POSITIVE] => [orbit::quadratic_period(g)];
        "linear_half_cycle", [speed: NOT_NEGATIVE, next: NOT_NEGATIVE, g: POSITIVE, ratio: POSITIVE]
            => [orbit::linear_half_cycle(speed, next, g, ratio)];
        "linear_half_width", [z: POSITIVE] => [orbit::linear_half_width(z)];
        "linear_amplitude_excess", [z: POSITIVE] => [orbit::linear_amplitude_excess(z)];
        "return_slope", [mu: MU, d_1: NOT_NEGATIVE, d_2: NOT_NEGATIVE] => orbit::return_slope(mu, [d_1, d_2]);
    }
}

/// The expression of each inequality of the orbit theorems, as its certificate prints it.
fn inequalities(theory: &mut Theory) {
    for claim in CLAIMS {
        for inequality in claim.theorem().map_or(&[][..], |theorem| theorem.inequalities) {
            let Some((formula, domain)) = inequality.margin.formula().zip(inequality.domain()) else { continue };
            let name = format!("{}_{}", claim.id, inequality.id).replace('-', "_");
            let used = |place: usize| Some(inequality.variables[place].name).filter(|name| !name.is_empty());
            let unused = ["unused_1", "unused_2", "unused_3"];
            let quantities = core::array::from_fn::<_, 3, _>(|place| {
                (used(place).unwrap_or(unused[place]), [domain[place].lower(), domain[place].upper()])
            });
            theory.define(&name, quantities, |at| Some((formula.expression)(at).coq()));
        }
    }
}
