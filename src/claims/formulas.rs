//! The program's formulas as definitions of Coq: the code that runs, evaluated over symbols, as the subject of proofs by a kernel.

use super::CLAIMS;
use super::checks::SingleKernel;
use crate::describing::{ClosedForm, DescribingFunction, bias_of_output};
use crate::identify::fit::select::pairwise::relative_spread_percent;
use crate::identify::iso::{amplitude_sensitivity, parameters};
use crate::nonlinearity::{
    Absolute, Backlash, Branches, Catalogued, DeadZone, DeadZoneSaturation, GainChanging, Kernel, NonlinearityError,
    PiecewiseLinear, Polyline, Polynomial, Preload, Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis,
    RelayHysteresis, Saturation, SaturationAsymmetric, Side, Sinusoid,
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

const BIAS: NamedRange = ("bias", ANY);
const AMPLITUDE: NamedRange = ("amplitude", POSITIVE);

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
    /// A characteristic, made of its parameters, as the list of its kernels; bias and amplitude come last.
    fn member<C: PiecewiseLinear<Number = Expression>, const N: usize>(
        &mut self,
        name: &str,
        quantities: [NamedRange; N],
        made: fn(&[Expression]) -> Result<C, NonlinearityError>,
    ) {
        self.define(name, quantities, |at| {
            let (parameters, &[bias, amplitude]) = at.split_last_chunk()?;
            let mut terms = Vec::new();
            made(parameters).ok()?.kernels(&Sinusoid::new(bias, amplitude).ok()?, |kernel| terms.push(term(kernel)));
            Some(format!("[{}]", terms.join("; ")))
        });
    }

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

/// Several numbers as a tuple.
fn tuple<const N: usize>(terms: [Expression; N]) -> Option<String> {
    Some(format!("({})", terms.map(Expression::coq).join(", ")))
}

fn describing(df: DescribingFunction<Expression>) -> Option<String> {
    tuple([df.f0, df.p, df.q])
}

/// The closed form of each kernel, on each side and branch.
fn kernels(theory: &mut Theory) {
    let branches = [Branches::Both, Branches::Rising, Branches::Falling];
    let of = |kernel, bias, amplitude| {
        describing(SingleKernel(kernel).describing_function(&Sinusoid::new(bias, amplitude).ok()?).ok()?)
    };
    let sided = branches.into_iter().flat_map(|on| [Side::Above, Side::Below].map(|side| (side, on)));
    for (side, branches) in sided {
        let place = format!("{side:?}_{branches:?}").to_lowercase();
        theory.define(
            &format!("step_{place}"),
            [("at_", ANY), ("height", ANY), BIAS, AMPLITUDE],
            |[at, height, b, x]| of(Kernel::Step { at, height, side, branches }, b, x),
        );
        theory.define(
            &format!("ramp_{place}"),
            [("at_", ANY), ("slope", ANY), BIAS, AMPLITUDE],
            |[at, slope, b, x]| of(Kernel::Ramp { at, slope, side, branches }, b, x),
        );
    }
    for branches in branches {
        let place = format!("{branches:?}").to_lowercase();
        theory.define(
            &format!("sign_{place}"),
            [("at_", ANY), ("level", ANY), BIAS, AMPLITUDE],
            |[at, level, b, x]| of(Kernel::Sign { at, level, branches }, b, x),
        );
        theory.define(&format!("constant_{place}"), [("value", ANY), BIAS, AMPLITUDE], |[value, b, x]| {
            of(Kernel::Constant { value, branches }, b, x)
        });
    }
    theory.define("line_df", [("slope", ANY), BIAS, AMPLITUDE], |[slope, b, x]| of(Kernel::Line { slope }, b, x));
    let band = [("origin", ANY), ("lower", ANY), ("upper", ANY), ("slope", ANY), BIAS, ("amplitude", NEAR_ONE)];
    theory.define("band", band, |[origin, lower, upper, slope, b, x]| {
        of(Kernel::Band { origin, lower, upper, slope }, b, x)
    });
    let coefficients = ["c0", "c1", "c2", "c3", "c4", "c5"].map(|name| (name, ANY));
    let [c0, c1, c2, c3, c4, c5] = coefficients;
    theory.define("polynomial", [c0, c1, c2, c3, c4, c5, BIAS, AMPLITUDE], |[c0, c1, c2, c3, c4, c5, b, x]| {
        let polynomial = Polynomial::new([c0, c1, c2, c3, c4, c5]).ok()?;
        describing(polynomial.describing_function(&Sinusoid::new(b, x).ok()?).ok()?)
    });
}

/// A kernel as a term of `Catalogue.v`.
fn term(kernel: Kernel<Expression>) -> String {
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
    const LEVEL: NamedRange = ("level", POSITIVE);
    const SLOPE: NamedRange = ("slope", POSITIVE);
    const SMALL: [f64; 2] = [0.0, 1.0];
    const LARGE: [f64; 2] = [2.0, f64::MAX];
    theory.member("relay", [LEVEL, BIAS, AMPLITUDE], Relay::from_values);
    theory.member("relay_dead_zone", [LEVEL, ("dead_zone", NOT_NEGATIVE), BIAS, AMPLITUDE], RelayDeadZone::from_values);
    let hysteresis = [LEVEL, ("half_width", NOT_NEGATIVE), ("offset", ANY), BIAS, AMPLITUDE];
    theory.member("relay_hysteresis", hysteresis, RelayHysteresis::from_values);
    let three_levels = [LEVEL, ("on_", LARGE), ("off", SMALL), BIAS, AMPLITUDE];
    theory.member("relay_dead_zone_hysteresis", three_levels, RelayDeadZoneHysteresis::from_values);
    theory.member("saturation", [SLOPE, ("breakpoint", POSITIVE), BIAS, AMPLITUDE], Saturation::from_values);
    let unequal = [SLOPE, ("lower", SMALL), ("upper", LARGE), BIAS, AMPLITUDE];
    theory.member("saturation_asymmetric", unequal, SaturationAsymmetric::from_values);
    theory.member("dead_zone", [SLOPE, ("half_width", NOT_NEGATIVE), BIAS, AMPLITUDE], DeadZone::from_values);
    let dead_then_limited = [SLOPE, ("half_width", SMALL), ("breakpoint", LARGE), BIAS, AMPLITUDE];
    theory.member("dead_zone_saturation", dead_then_limited, DeadZoneSaturation::from_values);
    // By the three orders of the slopes.
    for (order, inner, outer) in [(1, [1.0, 2.0], SMALL), (2, [0.5, 1.0], [1.25, 2.0]), (3, [1.0, 2.0], [-2.0, -1.0])] {
        let quantities = [("inner", inner), ("outer", outer), ("breakpoint", POSITIVE), BIAS, AMPLITUDE];
        theory.member(&format!("gain_changing_{order}"), quantities, GainChanging::from_values);
    }
    theory.member("preload", [SLOPE, LEVEL, BIAS, AMPLITUDE], Preload::from_values);
    // Two treads either way.
    let two_treads = [("tread", [1.0, 1.0]), ("bias", [0.0, 0.0]), ("amplitude", [2.25, 2.25])];
    theory.member("quantizer", two_treads, Quantizer::from_values);
    theory.member("absolute", [("gain", ANY), BIAS, AMPLITUDE], Absolute::from_values);
    let [x0, x1, x2] = [("x0", [-2.0, -1.0]), ("x1", [0.0, 1.0]), ("x2", [2.0, 3.0])];
    let [y0, y1, y2, left, right] = ["y0", "y1", "y2", "left", "right"].map(|name| (name, ANY));
    // The bias near the middle of three points.
    theory.member("polyline", [x0, y0, x1, y1, x2, y2, left, right, ("bias", SMALL), AMPLITUDE], |v| {
        Polyline::new([(v[0], v[1]), (v[2], v[3]), (v[4], v[5])], v[6], v[7])
    });
    theory.member("backlash", [SLOPE, ("half_gap", NOT_NEGATIVE), BIAS, AMPLITUDE], Backlash::from_values);
}

/// From describing function to parameters, and their basis.
fn identification(theory: &mut Theory) {
    let [f0, p, q] = ["f0", "p", "q"].map(|name| (name, ANY));
    theory.define(
        "relay_f0_by_times",
        [("level", POSITIVE), ("t_high", POSITIVE), ("t_low", POSITIVE)],
        |[c, h, l]| Some(bias_of_output(c, h, l).coq()),
    );
    theory.define("condition_40_least_amplitude", [("half_width", NOT_NEGATIVE), BIAS], |[width, bias]| {
        Some(RelayHysteresis::new(Expression::one(), width, Expression::zero()).ok()?.least_amplitude(bias).coq())
    });
    theory.define("table_3", [f0, p, q, AMPLITUDE, ("omega", POSITIVE)], |[f0, p, q, amplitude, omega]| {
        let found = parameters(DescribingFunction { f0, p, q }, amplitude, omega);
        tuple([found.alpha, found.beta, found.beta_quadratic, found.disturbance])
    });
    theory.define("delay_rotation", [f0, p, q, ("phase", ANY)], |[f0, p, q, phase]| {
        describing(DescribingFunction { f0, p, q }.delayed(phase))
    });
    theory.define("quantisation", [("ratio", [1.0, f64::MAX])], |[ratio]| {
        let found = amplitude_sensitivity(ratio);
        tuple([found.alpha, found.beta, found.beta_quadratic])
    });
    theory.define("relative_spread", [("first", ANY), ("second", ANY)], |[first, second]| {
        Some(relative_spread_percent(first, second).coq())
    });
    let bilinear_thrust = [("by_rate", POSITIVE), ("by_speed", NOT_NEGATIVE), ("rate", ANY), ("speed", ANY)];
    theory.define("thruster_bilinear", bilinear_thrust, |[by_rate, by_speed, rate, speed]| {
        Some(bilinear([by_rate, by_speed], rate, speed).coq())
    });
    theory.define("allocation_forces", [("arm", POSITIVE), ("tau_1", ANY), ("tau_2", ANY)], |[arm, one, two]| {
        tuple(Allocation::pair(arm).ok()?.forces(&[one, two]))
    });
    // The inverse of the least arm has to be a number.
    let arm = ("arm", [f64::MIN_POSITIVE, 1.0]);
    theory.define("allocation_thrusts", [arm, ("force", ANY), ("moment", ANY)], |[arm, force, moment]| {
        tuple(Allocation::pair(arm).ok()?.thrusts(&[force, moment]))
    });
}

/// The exact orbits of a drag axis.
fn orbits(theory: &mut Theory) {
    const G: NamedRange = ("g", POSITIVE);
    const MU: NamedRange = ("mu", [-1.0, 1.0]);
    theory.define("quadratic_half_cycle", [("y", ANY), ("gap", [0.0, 1.0]), ("ratio", POSITIVE)], |[y, gap, ratio]| {
        Some(orbit::quadratic_half_cycle(y, gap, ratio).coq())
    });
    theory.define("quadratic_speeds", [("gap", [0.0, 1.0]), MU], |[gap, mu]| tuple(orbit::quadratic_speeds(gap, mu)));
    theory.define("quadratic_period", [G], |[g]| Some(orbit::quadratic_period(g).coq()));
    let half_cycle = [("speed", NOT_NEGATIVE), ("next", NOT_NEGATIVE), G, ("ratio", POSITIVE)];
    theory.define("linear_half_cycle", half_cycle, |[speed, next, g, ratio]| {
        Some(orbit::linear_half_cycle(speed, next, g, ratio).coq())
    });
    theory.define("linear_half_width", [("z", POSITIVE)], |[z]| Some(orbit::linear_half_width(z).coq()));
    theory.define("linear_amplitude_excess", [("z", POSITIVE)], |[z]| Some(orbit::linear_amplitude_excess(z).coq()));
    theory.define("return_slope", [MU, ("d_1", NOT_NEGATIVE), ("d_2", NOT_NEGATIVE)], |[mu, first, second]| {
        tuple(orbit::return_slope(mu, [first, second]))
    });
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
