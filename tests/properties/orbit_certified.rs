//! Proofs about exact orbits: they exist, they can be checked again, and nothing false passes.

use selfosc::claims::method_bias::{MethodError, SymmetricOrbit};
use selfosc::claims::{CLAIMS, Certificate, Claim};
use selfosc::identify::iso::Oscillation;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::numeric::Interval;
use selfosc::orbit::theorem::{BUDGET, QUADRATIC};
use selfosc::orbit::{OrbitError, certify, force_left, limit_cycle, return_slope};
use selfosc::plant::DragAxis;
use selfosc::proof::inequality::{Inequality, Proof, Refusal};
use selfosc::proof::margin::VariableBox;
use selfosc::proof::margin::{Form, Margin};
use selfosc::proof::{Extent, Gradient};

use crate::tolerance::{CENTRAL_DIFFERENCE, ORBIT_ENCLOSURE, REFERENCE, ROUNDING};

fn proofs() -> Vec<(Inequality, Proof)> {
    let prove = |inequality: &Inequality| match inequality.prove(BUDGET) {
        Ok(proof) => (*inequality, proof),
        Err(why) => panic!("{}: {why}", inequality.id),
    };
    CLAIMS.iter().filter_map(Claim::theorem).flat_map(|theorem| theorem.inequalities.iter().map(prove)).collect()
}

#[test]
fn every_theorem_is_proved_and_its_certificate_survives_a_file() {
    for claim in CLAIMS.iter().filter(|claim| claim.theorem().is_some()) {
        let certificate = Certificate::of(claim).unwrap_or_else(|| panic!("{} is not proved", claim.id));
        let read: Certificate = certificate.to_string().parse().unwrap();
        assert_eq!(read, certificate);
        assert_eq!(read.check(), Ok(()), "{}", claim.id);
        let other = Certificate { statement: "every loop oscillates".to_owned(), ..certificate };
        assert!(matches!(other.check(), Err(Refusal::Statement { field: "statement", .. })));
    }
}

#[test]
fn certificates_that_say_something_else_are_refused() {
    let claim = Claim::find("orbit-quadratic-disturbed").unwrap();
    let certificate = Certificate::of(claim).unwrap();
    let refused = |change: fn(&mut Certificate)| {
        let mut changed = certificate.clone();
        change(&mut changed);
        changed.check().unwrap_err().code()
    };
    assert_eq!(refused(|c| c.by_hand.push("as is well known".to_owned())), "other-statement");
    assert_eq!(refused(|c| c.claim = "orbit-linear-disturbed".to_owned()), "other-statement");
    assert_eq!(refused(|c| c.claim = "lemma-1".to_owned()), "malformed-proof");
    assert_eq!(refused(|c| c.inequalities[0].expression = Some("mu".to_owned())), "other-statement");
    assert_eq!(refused(|c| c.inequalities[0].form = Form::Value), "other-statement");
    assert_eq!(refused(|c| c.inequalities[2].proof.boxes.truncate(1)), "not-covered");
    assert_eq!(refused(|c| c.inequalities[5].proof.bound *= 10.0), "not-shown");
    assert_eq!(refused(|c| drop(c.inequalities.pop())), "other-statement");
    for text in ["", "[]", r#"{"format":1}"#, &certificate.to_string().replace("[-1.0,1.0]", "[1.0,-1.0]")] {
        assert!(matches!(text.parse::<Certificate>(), Err(Refusal::Malformed { .. })), "{text}");
    }
}

#[test]
fn corrupted_proofs_are_refused() {
    for (inequality, proof) in proofs() {
        // The bound is the lowest that is shown.
        for bound in [proof.bound.next_up(), 10.0 * proof.bound.max(1.0)] {
            let boast = Proof { bound, ..proof.clone() };
            assert!(matches!(inequality.check(&boast), Err(Refusal::NotShown { .. })), "{}", inequality.id);
        }
        let vacuous = Proof { bound: 0.0, ..proof.clone() };
        assert!(matches!(inequality.check(&vacuous), Err(Refusal::Bound { .. })));
        let other = Proof { inequality: "another".to_owned(), ..proof.clone() };
        assert!(matches!(inequality.check(&other), Err(Refusal::Other { .. })));
        let mut elsewhere = proof;
        elsewhere.domain[0] = Interval::UNIT + Interval::UNIT;
        assert!(matches!(inequality.check(&elsewhere), Err(Refusal::Domain { .. })));
    }
}

/// `boxes` with one of them changed.
fn with(boxes: &[VariableBox], index: usize, change: impl FnOnce(&mut VariableBox)) -> Vec<VariableBox> {
    let mut boxes = boxes.to_vec();
    change(&mut boxes[index]);
    boxes
}

/// Wherever in the list: a box left out, given twice, a step too small, in another's place.
#[test]
fn boxes_that_do_not_make_up_the_domain_are_refused() {
    for (inequality, proof) in proofs() {
        let refused = |boxes: Vec<VariableBox>, what: &str| {
            let found = inequality.check(&Proof { boxes, ..proof.clone() });
            assert_eq!(found, Err(Refusal::NotCovered), "{}: {what}", inequality.id);
        };
        let count = proof.boxes.len();
        for index in [0, count / 3, count / 2, count - 1] {
            let mut boxes = proof.boxes.clone();
            boxes.remove(index);
            refused(boxes, "a box missing");
            let mut boxes = proof.boxes.clone();
            boxes.insert(index, boxes[index]);
            refused(boxes, "a box twice");
            for (i, side) in proof.boxes[index].into_iter().enumerate().filter(|(_, side)| !side.is_point()) {
                let (lower, upper) = (side.lower(), side.upper());
                let shrunk = [Interval::new(lower.next_up(), upper), Interval::new(lower, upper.next_down())];
                for smaller in shrunk {
                    refused(with(&proof.boxes, index, |at| at[i] = smaller.unwrap()), "a box too small by one step");
                }
            }
        }
        if count > 1 {
            refused(proof.boxes.iter().rev().copied().collect(), "the order turned round");
            let mut boxes = proof.boxes.clone();
            boxes.swap(0, count - 1);
            refused(boxes, "two boxes exchanged");
        }
        refused(Vec::new(), "no boxes");
    }
}

/// The check asks for cuts, not for halves, and for as much of the domain as it states.
#[test]
fn any_cuts_will_do() {
    const ANYWHERE: Inequality = Inequality {
        id: "anywhere",
        statement: "one is positive",
        variables: [Extent::new("x", 0.0, 3.0), Extent::new("y", 0.0, 2.0), Extent::NONE],
        margin: Margin::Enclosed(|_| Interval::ONE),
    };
    let side = |lower, upper| Interval::new(lower, upper).unwrap();
    let cell = |x: (f64, f64), y: (f64, f64)| [side(x.0, x.1), side(y.0, y.1), Interval::ZERO];
    let check = |boxes: &[VariableBox]| {
        let domain = ANYWHERE.domain().unwrap();
        ANYWHERE.check(&Proof { inequality: "anywhere".to_owned(), domain, bound: 1.0, boxes: boxes.to_vec() })
    };
    let thirds = [cell((0.0, 1.0), (0.0, 2.0)), cell((1.0, 2.5), (0.0, 2.0)), cell((2.5, 3.0), (0.0, 2.0))];
    assert_eq!(check(&thirds), Ok(()));
    let nested = [
        cell((0.0, 1.0), (0.0, 2.0)),
        cell((1.0, 3.0), (0.0, 0.5)),
        cell((1.0, 2.0), (0.5, 2.0)),
        cell((2.0, 3.0), (0.5, 2.0)),
    ];
    assert_eq!(check(&nested), Ok(()));
    let gap = with(&nested, 2, |at| at[1] = side(0.75, 2.0));
    assert_eq!(check(&gap), Err(Refusal::NotCovered));
    let beyond = with(&thirds, 2, |at| at[0] = side(2.5, 4.0));
    assert_eq!(check(&beyond), Err(Refusal::NotCovered));
    let overlap = with(&thirds, 2, |at| at[0] = side(2.0, 3.0));
    assert_eq!(check(&overlap), Err(Refusal::NotCovered));
    assert_eq!(check(&thirds[..2]), Err(Refusal::NotCovered));
}

/// Linear and quadratic drag, disturbance, delay, half-width; alpha and level are one.
const AXES: [[f64; 5]; 11] = [
    [0.4, 0.0, 0.0, 0.0, 0.3],
    [0.0, 0.5, 0.0, 0.0, 0.3],
    [0.2, 0.3, 0.0, 0.0, 0.3],
    [0.2, 0.3, 0.4, 0.0, 0.3],
    [2e-4, 3e-4, -0.4, 0.0, 0.3],
    [20.0, 30.0, 0.4, 0.0, 0.3],
    [0.2, 0.3, 0.4, 0.5, 0.3],
    [0.2, 0.3, -0.4, 0.5, 0.0],
    [0.0, 1.0, 0.0, 0.0, 10.0],
    [0.0, 1.0, 0.95, 0.0, 10.0],
    [1e-6, 0.0, 0.0, 0.0, 0.3],
];

fn build([linear, quadratic, disturbance, delay_s, half_width]: [f64; 5]) -> (DragAxis<f64>, RelayHysteresis<f64>) {
    let axis = DragAxis::mixed(1.0, linear, quadratic).unwrap().with_disturbance(disturbance).unwrap();
    (axis.with_delay_s(delay_s).unwrap(), RelayHysteresis::new(1.0, half_width, 0.0).unwrap())
}

#[test]
fn enclosures_of_one_axis_are_narrow_and_hold_the_orbit() {
    for case in AXES {
        let (axis, relay) = build(case);
        let proof = certify(&axis, &relay).unwrap();
        // The ideal relay with a delay has faster oscillations too.
        assert_eq!([proof.unique, proof.attracting], [case[4] > 0.0; 2], "{case:?}");
        let (cycle, enclosure) = (limit_cycle(&axis, &relay).unwrap(), proof.enclosure);
        // Rounding of the floating-point cycle grows as its multiplier nears one.
        let allowed = ORBIT_ENCLOSURE / (1.0 - cycle.multiplier);
        for (value, interval, scale) in [
            (cycle.amplitude, enclosure.amplitude, cycle.amplitude),
            (cycle.bias, enclosure.bias, cycle.amplitude),
            (cycle.maximum, enclosure.maximum, cycle.amplitude),
            (cycle.minimum, enclosure.minimum, cycle.amplitude),
            (cycle.period_s, enclosure.period_s, cycle.period_s),
            (cycle.time_positive_s, enclosure.time_positive_s, cycle.period_s),
            (cycle.time_negative_s, enclosure.time_negative_s, cycle.period_s),
            (cycle.upper_switch.position, enclosure.upper_switch.position, cycle.amplitude),
            (cycle.upper_switch.velocity, enclosure.upper_switch.velocity, cycle.upper_switch.velocity),
            (cycle.multiplier, enclosure.multiplier, 1.0),
        ] {
            let off = (interval - Interval::point(value)).magnitude();
            assert!(off <= allowed * scale.abs(), "{case:?}: {value} and {interval}");
        }
    }
}

/// The closed form of the symmetric case in intervals, by another path, meets the enclosure.
#[test]
fn enclosures_hold_the_closed_form() {
    use selfosc::numeric::Real;
    for g in [1e-3, 0.1, 1.0, 5.0] {
        let (axis, relay) = build([0.0, 1.0, 0.0, 0.0, g]);
        let y = (-(Interval::point(-4.0) * Interval::point(g)).exp_m1()).sqrt();
        let amplitude = Interval::point(g) + y.ln_1p() / Interval::two();
        assert!(certify(&axis, &relay).unwrap().enclosure.amplitude.intersection(amplitude).is_some(), "{g}");
    }
}

#[test]
fn refusals_are_named() {
    let refusal = |case| {
        let (axis, relay) = build(case);
        certify(&axis, &relay).unwrap_err()
    };
    assert!(matches!(refusal([0.1, 0.0, 1.0, 0.0, 0.3]), OrbitError::Drift { .. }));
    assert!(matches!(refusal([0.0, 0.0, 0.0, 0.0, 0.3]), OrbitError::NoDrag));
    assert!(matches!(refusal([0.1, 0.0, 0.0, 0.0, 0.0]), OrbitError::NoHysteresis));
    assert!(matches!(refusal([1e-300, 0.0, 0.0, 0.0, 0.3]), OrbitError::Unresolved { .. }));
}

/// The slope that the theorems rest on is the slope of the map itself, and obeys the proved bound.
#[test]
fn slope_formula_is_the_multiplier() {
    for case in AXES.into_iter().filter(|case| case[3] == 0.0) {
        let (axis, relay) = build(case);
        let cycle = limit_cycle(&axis, &relay).unwrap();
        let drag = |speed: f64| (case[0] + case[1] * speed) * speed;
        let drags = [drag(cycle.upper_switch.velocity), drag(-cycle.lower_switch.velocity)];
        let [numerator, denominator] = return_slope(case[2], drags);
        // At strong drag the numerator is what rounding leaves.
        let off = (numerator / denominator - cycle.multiplier).abs();
        assert!(off <= REFERENCE / (1.0 - cycle.multiplier), "{case:?}: {off}");
        assert!(1.0 - cycle.multiplier > 0.48 * (drags[0] + drags[1]), "{case:?}");
    }
    let [x, y] = Gradient::variables([Interval::point(0.3), Interval::point(0.2)]);
    let [numerator, denominator] = return_slope(Gradient::constant(Interval::point(0.1)), [x, y]);
    assert!((denominator - numerator).slopes().iter().all(|slope| slope.contains(2.0)));
    assert!(force_left(1.0, 0.3f64).abs() <= ROUNDING);
}

/// An enclosure of the coordinate of `g`, by bisection with a sign that is certain.
fn coordinate(law: SymmetricOrbit, g: f64) -> Interval {
    let (mut lower, mut upper) = (0.0, 2.0 * g + 3.0);
    for _ in 0..100 {
        let middle = 0.5 * (lower + upper);
        match law.group(Interval::point(middle)) {
            found if found.upper() <= g => lower = middle,
            found if found.lower() >= g => upper = middle,
            _ => break,
        }
    }
    Interval::new(lower, upper).unwrap()
}

/// The errors over a range of the coordinate, halved until their enclosures are narrow.
fn hull(law: SymmetricOrbit, coordinate: Interval, halvings: u32) -> MethodError {
    const RESOLUTION: f64 = 5e-3;
    match law.error(coordinate) {
        Some(whole) if whole.alpha.width() < RESOLUTION && whole.drag.width() < RESOLUTION => whole,
        whole if halvings == 0 => whole.unwrap(),
        _ => {
            let (lower, upper) = coordinate.bisect();
            let (lower, upper) = (hull(law, lower, halvings - 1), hull(law, upper, halvings - 1));
            MethodError { alpha: lower.alpha.hull(upper.alpha), drag: lower.drag.hull(upper.drag) }
        }
    }
}

fn error_over(law: SymmetricOrbit, from: f64, to: f64) -> MethodError {
    hull(law, coordinate(law, from).hull(coordinate(law, to)), 24)
}

/// The enclosed errors are those of the method on the computed orbit.
#[test]
fn method_errors_are_enclosed() {
    for g in [1e-6, 1e-3, 0.1, 1.0, 3.0, 10.0, 50.0] {
        for law in [SymmetricOrbit::Linear, SymmetricOrbit::Quadratic] {
            let drag = if law == SymmetricOrbit::Linear { [1.0, 0.0] } else { [0.0, 1.0] };
            let (axis, relay) = build([drag[0], drag[1], 0.0, 0.0, g]);
            let cycle = limit_cycle(&axis, &relay).unwrap();
            let read = Oscillation {
                relay_level: 1.0,
                switch_level: g,
                amplitude: cycle.amplitude,
                bias: 0.0,
                period_s: cycle.period_s,
                delay_s: 0.0,
            };
            let found = read.identify().unwrap();
            let errors = [found.alpha, if law == SymmetricOrbit::Linear { found.beta } else { found.beta_quadratic }];
            let enclosed = error_over(law, g, g);
            for (error, interval) in errors.into_iter().zip([enclosed.alpha, enclosed.drag]) {
                let off = (interval - Interval::point(error - 1.0)).magnitude();
                assert!(off < interval.width() + CENTRAL_DIFFERENCE, "{law:?} {g}: {error} {interval}");
            }
            let over = error_over(law, 0.5 * g, 2.0 * g);
            assert!(enclosed.alpha.is_subset_of(over.alpha) && enclosed.drag.is_subset_of(over.drag));
        }
    }
}

/// The coordinates at which the curves are proved enclose the values of `g` that the claims name.
#[test]
fn coordinates_bracket_the_stated_groups() {
    for (law, from, to, g) in [
        (SymmetricOrbit::Linear, 1.95, 1.97, 1.0),
        (SymmetricOrbit::Linear, 10.99, 11.0, 10.0),
        (SymmetricOrbit::Quadratic, 2.68, 2.7, 1.0),
        (SymmetricOrbit::Quadratic, 20.68, 20.7, 10.0),
    ] {
        let [lower, upper] = [from, to].map(|coordinate| law.group(Interval::point(coordinate)));
        assert!(lower.upper() < g && g < lower.hull(upper).upper() && upper.lower() > g, "{law:?} {g}");
    }
}

#[test]
fn a_theorem_wants_every_inequality() {
    let mut proofs = QUADRATIC.prove().map_err(|(inequality, _)| inequality.id).unwrap();
    assert!(QUADRATIC.check(&proofs).is_ok());
    let dropped = proofs.pop().unwrap();
    assert!(QUADRATIC.check(&proofs).unwrap_err().to_string().contains(&dropped.inequality));
}
