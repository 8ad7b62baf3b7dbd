//! Certificates of limit cycles of linear plants: against the floating-point orbits, and of what is none.

use proptest::prelude::*;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::orbit::{OrbitError, RelayLoop};
use selfosc::plant::{StateSpace, TransferFunction};
use selfosc::{numeric::Interval, proof::interval_matrix};

use crate::tolerance;

fn closed(numerator: &[f64], denominator: &[f64], delay_s: f64, half_width: f64) -> RelayLoop {
    let transfer = TransferFunction::new(numerator, denominator).unwrap().with_delay(delay_s).unwrap();
    let plant = StateSpace::realise(&transfer).unwrap();
    RelayLoop::new(plant, RelayHysteresis::new(1.0, half_width, 0.0).unwrap())
}

/// The value that Astroem's condition for an integrator with a lag gives: `h` where `h/2 - tanh(h/2) = half_width`.
#[test]
fn an_integrator_with_a_lag_has_the_cycle_of_its_closed_form() {
    for half_width in [1e-3, 0.2, 5.0] {
        let by_formula = |h: f64| 0.5 * h - (0.5 * h).tanh() - half_width;
        let (mut low, mut high) = (0.0, 100.0);
        while high - low > 1e-15 * high && 0.5 * (low + high) > low && 0.5 * (low + high) < high {
            let middle = 0.5 * (low + high);
            if by_formula(middle) < 0.0 { low = middle } else { high = middle }
        }
        let proof = closed(&[1.0], &[1.0, 1.0, 0.0], 0.0, half_width).certify(low).unwrap();
        let near = proof.half_period_s + Interval::symmetric(tolerance::HALF_PERIOD_ROUNDING * low);
        assert!(near.contains(low) && proof.half_period_s.width() < 1e-10 * low, "{half_width}: {proof:?}");
    }
}

#[test]
fn the_ideal_relay_starts_on_its_level() {
    let closed = closed(&[1.0], &[1.0, 3.0, 3.0, 1.0], 0.0, 0.0);
    let orbit = &closed.symmetric_orbits(0.1..=100.0).unwrap()[0];
    let proof = closed.certify(0.5 * orbit.period_s()).unwrap();
    assert!(proof.half_period_s.contains(0.5 * orbit.period_s()) && proof.contracts_after.is_some());
}

/// On a lightly damped plant the condition at the switching alone has many solutions; on most of them the relay would have
/// switched before.
#[test]
fn a_cycle_with_an_earlier_switching_is_refused() {
    refused_where_it_switched_before(0.1, 0.3);
}

/// Of some such solutions the output is below the level half-way to the switching, and above it before.
#[test]
fn an_earlier_switching_beside_the_middle_is_seen() {
    refused_where_it_switched_before(0.02, 0.5);
}

fn refused_where_it_switched_before(damping: f64, level: f64) {
    let closed = closed(&[1.0], &[1.0, damping, 1.0], 0.0, level);
    let transfer = TransferFunction::new(&[1.0], &[1.0, damping, 1.0]).unwrap();
    let plant = StateSpace::realise(&transfer).unwrap();
    let miss = |h: f64| {
        let flow = plant.flow(h);
        let matrix = nalgebra::DMatrix::identity(2, 2) + &flow.state;
        -level - plant.output(&matrix.lu().solve(&-flow.input).unwrap())
    };
    let genuine: Vec<f64> = closed.symmetric_orbits(0.5..=60.0).unwrap().iter().map(|o| 0.5 * o.period_s()).collect();
    let (mut refused, mut proved) = (0, 0);
    for k in 0..6000 {
        let (mut low, mut high) = (0.5 + 0.004 * f64::from(k), 0.5 + 0.004 * f64::from(k + 1));
        if miss(low) * miss(high) > 0.0 || (miss(low) - miss(high)).abs() > 1.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if miss(low) * miss(middle) <= 0.0 { high = middle } else { low = middle }
        }
        let expected = genuine.iter().any(|h| (h - low).abs() < 1e-9);
        match closed.certify(low) {
            Ok(_) => proved += 1,
            Err(OrbitError::NotProved { .. }) => refused += 1,
            Err(other) => panic!("{other}"),
        }
        assert_eq!(closed.certify(low).is_ok(), expected, "half-period {low}");
    }
    assert!(proved >= 1 && refused >= 2, "{proved} proved, {refused} refused");
}

/// All of this half-period that is not within a quarter of the passage of the level lies after it, and is looked at.
#[test]
fn the_output_after_the_passage_is_looked_at() {
    let closed = closed(&[1.0], &[1.0, 1.0], 5.0, 0.01);
    let orbit = &closed.symmetric_orbits(5.2..=100.0).unwrap()[0];
    assert!(closed.certify(0.5 * orbit.period_s()).unwrap().cells > 0);
}

#[test]
fn what_cannot_be_certified_says_why() {
    let orbitless = closed(&[1.0], &[1.0, 1.0, 0.0], 0.0, 0.2);
    assert!(matches!(orbitless.certify(1.9), Err(OrbitError::NotProved { .. })));
    assert!(matches!(orbitless.certify(f64::NAN), Err(OrbitError::OutOfDomain(_))));
    let disturbed = orbitless.with_disturbance(0.1).unwrap();
    assert!(matches!(disturbed.certify(1.86), Err(OrbitError::NotSymmetric { .. })));
    let late = closed(&[1.0], &[1.0, 1.0], 5.0, 0.1);
    assert!(matches!(late.certify(4.0), Err(OrbitError::LongDelay { .. })));
}

/// Three integrators and two zeros are stable only where the gain is high, and a relay's gain falls with the amplitude: the
/// cycle repels. Its existence is proved all the same.
#[test]
fn a_repelling_cycle_is_not_called_attracting() {
    let closed = closed(&[1.0, 2.0, 1.0], &[1.0, 0.0, 0.0, 0.0], 0.0, 0.05);
    let orbits = closed.symmetric_orbits(0.5..=50.0).unwrap();
    assert!(orbits.iter().any(|orbit| orbit.is_stable() == Some(false)), "{orbits:?}");
    for orbit in orbits {
        let proof = closed.certify(0.5 * orbit.period_s()).unwrap();
        assert_eq!(proof.contracts_after.is_some(), orbit.is_stable() == Some(true), "{orbit:?}");
    }
}

proptest! {
    #[test]
    fn certificates_agree_with_the_orbits(
        times in prop::collection::vec(0.2f64..3.0, 1..4),
        integrating: bool,
        delay_s in prop_oneof![Just(0.0), 0.01f64..0.5],
        half_width in 0.01f64..0.3,
    ) {
        let start: &[f64] = if integrating { &[1.0, 0.0] } else { &[1.0] };
        let lag = |time: f64| TransferFunction::new(&[1.0], &[time, 1.0]).unwrap();
        let start = TransferFunction::new(&[1.0], start).unwrap();
        let transfer = times.iter().fold(start, |all, &time| all.series(&lag(time)).unwrap());
        let plant = StateSpace::realise(&transfer.with_delay(delay_s).unwrap()).unwrap();
        let closed = RelayLoop::new(plant, RelayHysteresis::new(1.0, half_width, 0.0).unwrap());
        for orbit in closed.symmetric_orbits(0.05..=200.0).unwrap() {
            let half = 0.5 * orbit.period_s();
            if delay_s >= half {
                continue;
            }
            let proof = closed.certify(half);
            prop_assert!(proof.is_ok(), "{:?}", proof);
            let proof = proof.unwrap();
            let near = proof.half_period_s + Interval::symmetric(tolerance::HALF_PERIOD_ROUNDING * half);
            prop_assert!(near.contains(half), "{:?} {}", proof, half);
            prop_assert_eq!(proof.contracts_after.is_some(), orbit.is_stable() == Some(true));
        }
    }

    /// The exponential of a matrix made by a known change of coordinates from a diagonal one, in floating point.
    #[test]
    fn exponentials_enclose(eigenvalues in prop::array::uniform3(-40.0f64..3.0), mix in prop::array::uniform3(-1.0f64..1.0)) {
        let [p, q, r] = mix;
        let basis = nalgebra::Matrix3::new(1.0, p, q, 0.0, 1.0, r, 0.0, 0.0, 1.0);
        let inverse = nalgebra::Matrix3::new(1.0, -p, p * r - q, 0.0, 1.0, -r, 0.0, 0.0, 1.0);
        // The matrix in intervals, so that its own rounding is inside.
        let wide = |matrix: nalgebra::Matrix3<f64>| nalgebra::DMatrix::from_fn(3, 3, |i, j| Interval::point(matrix[(i, j)]));
        let diagonal = |f: fn(f64) -> f64| nalgebra::Matrix3::from_diagonal(&eigenvalues.map(f).into());
        // `p r - q` is rounded: enclosed by solving instead.
        let right = wide(diagonal(|x| x)) * interval_matrix::solve(wide(basis), nalgebra::DMatrix::identity(3, 3)).unwrap();
        let enclosed = interval_matrix::exponential(&(wide(basis) * right)).unwrap();
        let expected = basis * diagonal(f64::exp) * inverse;
        for (enclosed, &expected) in enclosed.iter().zip(expected.iter()) {
            let near = *enclosed + Interval::symmetric(tolerance::MATRIX_EXPONENTIAL * expected.abs().max(1.0));
            prop_assert!(near.contains(expected), "{enclosed:?} {expected}");
        }
    }
}
