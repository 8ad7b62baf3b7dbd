//! Claims about exact orbits that are proved by enclosure.

use super::algebra::{exactly, number};
use super::family::cycle;
use super::method_bias::SymmetricOrbit;
use super::{
    Case, ClaimDomain, ClaimPart, ClaimVariable, Distortion, Draw, Evidence, Hypothesis, Verdict, Witness, claim, drawn,
};
use crate::numeric::{Interval, Real};
use crate::orbit::return_slope;
use crate::orbit::theorem::{self, BUDGET, Theorem};
use crate::proof::Expression;
use crate::proof::inequality::Inequality;
use crate::proof::margin::Margin;
use crate::proof::margin::{VARIABLES, VariableBox};
use crate::proof::polynomial::Rational;
use crate::proof::{Extent, NotProved, formula};

/// The verdict of a theorem's inequalities: they establish these parts.
pub(super) fn proved(theorem: &Theorem, parts: &'static [ClaimPart]) -> Verdict {
    match theorem.prove() {
        Ok(proofs) => {
            let margin = proofs.iter().map(|proof| proof.bound).fold(f64::INFINITY, f64::min);
            let boxes = proofs.iter().map(|proof| proof.boxes.len()).sum();
            Verdict::Holds(Evidence::inequality(ClaimDomain::new(parts), margin, boxes))
        }
        Err((inequality, why)) => failed(&inequality, why),
    }
}

/// The verdict of an inequality by itself, which establishes no part of any claim.
fn single(inequality: &Inequality) -> Verdict {
    match inequality.prove(BUDGET) {
        Ok(proof) => Verdict::Holds(Evidence::inequality(ClaimDomain::default(), proof.bound, proof.boxes.len())),
        Err(why) => failed(inequality, why),
    }
}

fn failed(inequality: &Inequality, why: NotProved<VARIABLES>) -> Verdict {
    match why {
        NotProved::Refuted { witness, value: margin, .. } => {
            let named = inequality.variables.iter().zip(witness).filter(|(side, _)| !side.name.is_empty());
            let mut numbers: Vec<_> = named.map(|(side, value)| (side.name, value)).collect();
            numbers.push(("margin", margin.midpoint()));
            Verdict::Refuted(Witness::new(numbers))
        }
        NotProved::Undecided { boxes, .. } => {
            Verdict::Undecided { spent: format!("{boxes} boxes for {}", inequality.id) }
        }
    }
}

/// Every disturbance below the level: the inequalities hold up to the level itself, where the forces that they are about vanish.
const EVERY_AXIS: ClaimPart =
    ClaimPart::over("every-axis", "", const { &[ClaimVariable::number("abs(delta)/C", 0.0, 1.0)] });
/// The start of the inequalities about braking: under a disturbance as large as the level the drag brakes alone.
fn at_the_level(part: ClaimPart) -> Verdict {
    exactly(part, Distortion::None, &[[0.5]], |[drag]: [Rational; 1], factor: Rational| {
        Some([theorem::brake([number(1.0), drag, number(0.0)]) - factor * drag])
    })
}

const EXCESS: ClaimPart = ClaimPart::named("excess");
const RATE: ClaimPart = ClaimPart::named("rate");
const EVERY_G: ClaimPart = ClaimPart::named("every-g");
const UP_TO_TEN: ClaimPart = ClaimPart::named("g-up-to-ten");

fn excess_of_the_wrong_sign<T: Real>([mu, upper, lower]: [T; VARIABLES]) -> T {
    let [numerator, denominator] = return_slope(mu, [-upper, -lower]);
    denominator - numerator
}

/// Negative drag, which feeds the motion.
const FALSE_DRAG: Inequality = Inequality {
    id: "false-drag",
    statement: "the map contracts with drag of the wrong sign",
    margin: Margin::Slope { of: formula!(excess_of_the_wrong_sign), by: 1 },
    ..theorem::EXCESS_FIRST
};

/// A disturbance beyond the relay's level.
const FALSE_BRAKING: Inequality = Inequality {
    id: "false-braking",
    statement: "the other command brakes whatever the disturbance",
    variables: [Extent::new("mu", -1.5, 1.5), Extent::new("drag", 0.0, 2.0), Extent::NONE],
    margin: Margin::Value(formula!(theorem::brake)),
};

/// Too small a denominator.
const FALSE_DENOMINATOR: Inequality = Inequality {
    id: "false-denominator",
    statement: "0.48 times the slope's denominator is below 1.89",
    margin: Margin::Enclosed(|at| theorem::DENOMINATOR.margin.over(at) - Interval::point(0.1)),
    ..theorem::DENOMINATOR
};

/// The other direction.
const FALSE_OVERSHOOT_QUADRATIC: Inequality = Inequality {
    id: "false-overshoot-quadratic",
    statement: "quadratic drag: the relative overshoot grows with g",
    margin: Margin::Enclosed(|at| -theorem::QUADRATIC_OVERSHOOT_WEAK.margin.over(at)),
    ..theorem::QUADRATIC_OVERSHOOT_WEAK
};

/// The other direction.
const FALSE_OVERSHOOT_LINEAR: Inequality = Inequality {
    id: "false-overshoot-linear",
    statement: "linear drag: the relative overshoot grows with g",
    margin: Margin::Enclosed(|at| -theorem::LINEAR_OVERSHOOT_WEAK.margin.over(at)),
    ..theorem::LINEAR_OVERSHOOT_WEAK
};

/// Under a disturbance above the level there is no limit cycle.
fn beyond_the_level(draw: &mut Draw) -> Option<Case> {
    let (level, share) = (draw.uniform("level", 0.1, 1.0), draw.uniform("disturbance_over_level", 1.0, 2.0));
    Some(Case::truth(cycle(1.0, [0.5, 0.5], share * level, 0.0, [level, 0.2]).is_some()))
}

const BELOW_LEVEL: Hypothesis =
    Hypothesis { id: "disturbance-below-level", counterexample: drawn!(beyond_the_level()) };

/// Claims that inequalities establish: theorem, false inequality, parts of the domain, further proofs, hypotheses.
macro_rules! enclosed {
    ($($constant:ident = $id:literal $statement:literal,
       $theorem:path, not $false:ident, on $parts:expr, $(and $more:expr,)? if $hypotheses:expr;)+) => {
        $(
            claim! {
                $constant = $id Theorem $statement {
                    corrected: Some(|_| proved(&$theorem, const { $parts })$(.and(|| $more))?),
                    theorem: Some(&$theorem),
                    falsified: |_| single(&$false),
                    hypotheses: $hypotheses,
                }
            }
        )+
    };
}

enclosed! {
    NO_EARLY_SWITCHING = "orbit-no-early-switching"
        "Between two switchings the velocity changes sign once, beyond the relay's level: the command switches when the formulas say",
        theorem::NO_EARLY_SWITCHING, not FALSE_BRAKING, on &[EVERY_AXIS], and at_the_level(EVERY_AXIS), if &[BELOW_LEVEL];
    MULTIPLIER = "orbit-multiplier"
        "Without delay 1 - m > 0.48 (d_1 + d_2): the multiplier m by the drag forces d_1, d_2 at the switchings over C",
        theorem::MULTIPLIER, not FALSE_DENOMINATOR, on &[EXCESS, RATE], if &[BELOW_LEVEL];
    QUADRATIC_DISTURBED = "orbit-quadratic-disturbed"
        "Quadratic drag with a disturbance: one limit cycle, reached from every start",
        theorem::QUADRATIC_DISTURBED, not FALSE_DRAG, on &[EVERY_AXIS], and at_the_level(EVERY_AXIS), if &[BELOW_LEVEL];
    LINEAR_DISTURBED = "orbit-linear-disturbed"
        "Linear drag with a disturbance: one limit cycle, reached from every start",
        theorem::LINEAR_DISTURBED, not FALSE_DRAG, on &[EVERY_AXIS], and at_the_level(EVERY_AXIS), if &[BELOW_LEVEL];
    AMPLITUDE_MONOTONE_QUADRATIC = "orbit-amplitude-monotone-quadratic"
        "Quadratic drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g",
        theorem::QUADRATIC_OVERSHOOT, not FALSE_OVERSHOOT_QUADRATIC, on &[EVERY_G], if &[];
    AMPLITUDE_MONOTONE_LINEAR = "orbit-amplitude-monotone-linear"
        "Linear drag: (X_m - x_a)/x_a falls as g grows, so that the amplitude identifies g",
        theorem::LINEAR_OVERSHOOT, not FALSE_OVERSHOOT_LINEAR, on &[EVERY_G], if &[];
}

/// An error of the method: its distance from `centre` is below `radius` on a range of the coordinate.
macro_rules! within {
    ($id:literal: $law:ident $part:ident on $from:literal to $to:literal is $centre:expr, $radius:literal) => {
        Inequality {
            id: $id,
            statement: concat!("the relative error is within ", stringify!($radius), " of ", stringify!($centre)),
            variables: [Extent::new("coordinate", $from, $to), Extent::NONE, Extent::NONE],
            margin: Margin::Curve {
                over: |at: &VariableBox| match SymmetricOrbit::$law.error(at[0]) {
                    Some(error) => Interval::point($radius) - (error.$part - Interval::point($centre)).abs(),
                    None => Interval::ENTIRE,
                },
                expression: |[coordinate, ..]| {
                    let off = SymmetricOrbit::$law.formula(coordinate)?.$part - Expression::from_f64($centre);
                    Some(Expression::from_f64($radius) - off.abs())
                },
            },
        }
    };
}

/// A curve of the method's error: uniform bounds, and where it passes.
macro_rules! curve {
    (
        $constant:ident, $theorem:ident, $false:ident: $id:literal, $name:literal, $law:ident $part:ident,
        ends $one:literal and $ten:literal, up_to_one $small:literal, up_to_ten $large:literal, too_small $wrong:literal,
        at_zero $zero:literal, at_one [$one_from:literal, $one_value:expr], at_ten [$ten_from:literal, $ten_value:expr]
    ) => {
        #[doc = concat!("What `", $id, "` rests on.")]
        const $theorem: Theorem = Theorem {
            id: $id,
            domain: "every alpha, drag, C, x_a > 0 with 0 < g <= 10, delta = 0",
            inequalities: &[
        within!("up-to-one": $law $part on 0.0 to $one is 0.0, $small),
        within!("up-to-ten": $law $part on 0.0 to $ten is 0.0, $large),
        within!("at-zero": $law $part on 0.0 to 0.01 is $zero, 0.002),
        within!("at-one": $law $part on $one_from to $one is $one_value, 0.006),
        within!("at-ten": $law $part on $ten_from to $ten is $ten_value, 0.006),
            ],
        };
        #[doc = concat!("Too narrow a bound for `", $id, "`.")]
const $false: Inequality = within!("false-bound": $law $part on 0.0 to $ten is 0.0, $wrong);

        enclosed! { $constant = $id $name, $theorem, not $false, on &[UP_TO_TEN], if &[]; }
    };
}

curve! {
    BIAS_ALPHA_LINEAR, ALPHA_LINEAR, FALSE_ALPHA_LINEAR: "method-bias-alpha-linear",
    "Linear drag: the method's error of alpha is +3.2 % as g goes to 0, -3 % at 1, +47 % at 10, below 5 % for g <= 1",
    Linear alpha, ends 1.97 and 11.0, up_to_one 0.05, up_to_ten 0.48, too_small 0.4,
    at_zero 0.032, at_one [1.95, -0.03], at_ten [10.99, 0.47]
}

curve! {
    BIAS_BETA_LINEAR, BETA_LINEAR, FALSE_BETA_LINEAR: "method-bias-beta-linear",
    "Linear drag: the method's error of beta is +8 % as g goes to 0, -4 % at 1, -16 % at 10, below 17 % up to there",
    Linear drag, ends 1.97 and 11.0, up_to_one 0.09, up_to_ten 0.17, too_small 0.1,
    at_zero 0.0808, at_one [1.95, -0.041], at_ten [10.99, -0.16]
}

curve! {
    BIAS_ALPHA_QUADRATIC, ALPHA_QUADRATIC, FALSE_ALPHA_QUADRATIC: "method-bias-alpha-quadratic",
    "Quadratic drag: the method's error of alpha is +3.2 % as g goes to 0, -6.5 % at 1, +52 % at 10",
    Quadratic alpha, ends 2.7 and 20.7, up_to_one 0.08, up_to_ten 0.53, too_small 0.4,
    at_zero 0.032, at_one [2.68, -0.065], at_ten [20.68, 0.52]
}

curve! {
    BIAS_BETA_QUADRATIC, BETA_QUADRATIC, FALSE_BETA_QUADRATIC: "method-bias-beta-quadratic",
    "Quadratic drag: the method's error of beta_xx is +22 % as g goes to 0, -9 % at 1, -35 % at 10, below 36 % up to there",
    Quadratic drag, ends 2.7 and 20.7, up_to_one 0.22, up_to_ten 0.36, too_small 0.3,
    at_zero 0.2158, at_one [2.68, -0.088], at_ten [20.68, -0.346]
}
