//! Thruster maps from dynamometer points.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_distr::{Distribution, Normal};
use selfosc::vehicle::{DynamometerPoint, ThrustSide, Thruster, ThrusterMap, VehicleError};

use crate::tolerance::{STANDARD_ERROR, VEHICLE_ALGEBRA};

const STANDING_N: f64 = 0.05;

fn dynamometer(thruster: &Thruster<f64>, noise_n: &mut impl FnMut() -> f64) -> Vec<DynamometerPoint> {
    let reading = |command: f64| {
        let thrust = thruster.thrust(command);
        DynamometerPoint { command, thrust_n: if thrust == 0.0 { 0.0 } else { thrust + noise_n() } }
    };
    (-20..=20).map(|i| f64::from(i) * 10.0).map(reading).collect()
}

fn reference() -> Thruster<f64> {
    Thruster::asymmetric(
        ThrustSide::new(1.5e-4, 0.01, 15.0, 200.0).unwrap(),
        ThrustSide::new(1.0e-4, 0.012, 25.0, 200.0).unwrap(),
    )
}

proptest! {
    #![proptest_config(crate::sampling::recorded(128))]

    #[test]
    fn a_thruster_without_noise_is_found(
        ahead in (1e-5..1e-3_f64, 5e-3..0.1_f64), astern in (1e-5..1e-3_f64, 5e-3..0.1_f64), dead_zone in 11.0..60.0_f64,
    ) {
        let side = |(a, b)| ThrustSide::new(a, b, dead_zone, 200.0).unwrap();
        let points = dynamometer(&Thruster::asymmetric(side(ahead), side(astern)), &mut || 0.0);
        let map = ThrusterMap::asymmetric(&points, STANDING_N).unwrap();
        let errors = |found: (f64, f64), truth: (f64, f64)| (found.0 / truth.0 - 1.0).abs() + (found.1 / truth.1 - 1.0).abs();
        prop_assert!(errors((map.forward.quadratic, map.forward.linear), ahead) < 1e3 * VEHICLE_ALGEBRA);
        prop_assert!(errors((map.backward.quadratic, map.backward.linear), astern) < 1e3 * VEHICLE_ALGEBRA);
        // The last command at which it stood, on a grid of 10.
        let stood = map.thruster.forward().dead_zone();
        prop_assert!(stood < dead_zone && dead_zone <= stood + 10.0);
        // False variant: one curve for two different sides cannot be right for both.
        if (ahead.0 / astern.0 - 1.0).abs() > 0.1 && let Ok(one) = ThrusterMap::affine(&points, STANDING_N) {
            prop_assert!(errors((one.forward.quadratic, one.forward.linear), ahead) > 1e3 * VEHICLE_ALGEBRA);
            prop_assert!(one.forward.residual_n > 1e3 * map.forward.residual_n);
        }
    }
}

/// Standard errors are the spread of the coefficients over repeated measurements.
#[test]
fn standard_errors_are_honest() {
    const FITS: usize = 2000;
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(7);
    let normal = Normal::new(0.0, 0.02).unwrap();
    let maps: Vec<_> = (0..FITS)
        .map(|_| dynamometer(&reference(), &mut || normal.sample(&mut random)))
        .map(|points| ThrusterMap::asymmetric(&points, STANDING_N).unwrap())
        .collect();
    let mean = |values: &dyn Fn(&ThrusterMap) -> f64| maps.iter().map(values).sum::<f64>() / FITS as f64;
    let check = |value: &dyn Fn(&ThrusterMap) -> f64, claimed: &dyn Fn(&ThrusterMap) -> f64, factor: f64| {
        let centre = mean(value);
        let spread = mean(&|map| (value(map) - centre).powi(2)).sqrt();
        let claimed = mean(&|map| claimed(map).powi(2)).sqrt() * factor;
        (claimed / spread - 1.0).abs() < STANDARD_ERROR
    };
    for factor in [1.0, 0.9, 1.1] {
        // False variant: errors off by a tenth are noticed.
        let honest = factor == 1.0;
        assert_eq!(check(&|m| m.forward.quadratic, &|m| m.forward.quadratic_standard_error, factor), honest);
        assert_eq!(check(&|m| m.backward.linear, &|m| m.backward.linear_standard_error, factor), honest);
    }
    assert!((mean(&|map| map.forward.residual_n.powi(2)).sqrt() / 0.02 - 1.0).abs() < STANDARD_ERROR);
}

#[test]
fn data_that_cannot_tell_is_refused() {
    let point = |command, thrust_n| DynamometerPoint { command, thrust_n };
    let good = dynamometer(&reference(), &mut || 0.0);
    let refused = |points: &[DynamometerPoint]| ThrusterMap::asymmetric(points, STANDING_N).unwrap_err();

    let few = [point(50.0, 1.0), point(100.0, 3.0), point(-50.0, -1.0), point(-100.0, -2.0), point(-150.0, -4.0)];
    assert_eq!(refused(&few), VehicleError::Count { what: "points of a turning propeller", count: 2, needed: 3 });
    let mut against = good.clone();
    against[40].thrust_n = -7.0;
    assert_eq!(refused(&against), VehicleError::ThrustAgainstCommand { index: 40, command: 200.0, thrust_n: -7.0 });
    let mut unclear = good.clone();
    unclear[38].thrust_n = 0.0;
    assert!(matches!(refused(&unclear), VehicleError::DeadZoneUnclear { turned_at: 20.0, stood_at: 180.0, .. }));
    let same: Vec<_> = [100.0, 100.0, 100.0, -100.0, -100.0, -100.0].map(|c| point(c, c / 50.0)).to_vec();
    assert!(matches!(refused(&same), VehicleError::RankDeficient { rank: 1, needed: 2, .. }));
    // Thrust that falls with the command: nothing to invert.
    let falling: Vec<_> = [50.0, 100.0, 150.0, 200.0, -50.0, -100.0, -150.0, -200.0]
        .map(|c: f64| point(c, c.signum() * (5.0 - c.abs() / 50.0)))
        .to_vec();
    assert!(matches!(refused(&falling), VehicleError::NotMonotone { .. }));
    assert!(matches!(ThrusterMap::affine(&good[21..], STANDING_N), Err(VehicleError::Count { count: 0, .. })));
    let mut broken = good;
    broken[3].thrust_n = f64::NAN;
    assert!(matches!(refused(&broken), VehicleError::OutOfDomain { .. }));
}
