//! Thruster models and their inverses.

use proptest::prelude::*;
use selfosc::vehicle::{BilinearThruster, ThrustSide, Thruster, VehicleError};

use crate::tolerance::{COMMAND_ROUND_TRIP, THRUST_ROUND_TRIP, THRUST_ROUND_TRIP_F32};

/// Coefficients (a, b, dead zone, limit) of a side whose slope stays above a twentieth of its largest.
fn coefficients() -> impl Strategy<Value = (f64, f64, f64, f64)> {
    let any_curvature = (-0.9..20.0_f64, 1e-3..0.1_f64, 0.0..0.4_f64, 1.0..300.0_f64)
        .prop_map(|(bend, b, rest, limit)| (bend * b / (2.0 * limit), b, rest * limit, limit));
    // Negative linear coefficient, hidden by the dead zone: a n + b >= 0 from n = d on.
    let hidden = (1e-4..1e-2_f64, 0.2..0.95_f64, 0.1..0.4_f64, 1.0..300.0_f64)
        .prop_map(|(a, share, rest, limit)| (a, -share * a * rest * limit, rest * limit, limit));
    prop_oneof![any_curvature, hidden]
}

fn side() -> impl Strategy<Value = ThrustSide<f64>> {
    coefficients().prop_map(|(a, b, dead_zone, limit)| ThrustSide::new(a, b, dead_zone, limit).unwrap())
}

fn thruster() -> impl Strategy<Value = Thruster<f64>> {
    (side(), side()).prop_map(|(forward, backward)| Thruster::asymmetric(forward, backward))
}

fn limits(thruster: &Thruster<f64>) -> (f64, f64) {
    (-thruster.backward().limit(), thruster.forward().limit())
}

/// A point between two bounds.
fn between((lower, upper): (f64, f64), fraction: f64) -> f64 {
    lower + (upper - lower) * fraction
}

/// Relative error of thrust after `inverse` and the map.
fn thrust_error(thruster: &Thruster<f64>, thrust: f64, inverse: impl Fn(f64) -> f64) -> f64 {
    (thruster.thrust(inverse(thrust)) - thrust).abs() / thrust.abs()
}

proptest! {
    #![proptest_config(crate::sampling::recorded(512))]

    #[test]
    fn thrust_survives_inverse_and_map(thruster in thruster(), fraction in 0.0..=1.0_f64, ahead: bool) {
        let side = if ahead { thruster.forward() } else { thruster.backward() };
        let magnitude = between((side.smallest_thrust_n(), side.largest_thrust_n()), fraction);
        prop_assume!(magnitude > 0.0);
        let thrust = if ahead { magnitude } else { -magnitude };
        let command = thruster.command(thrust).unwrap();
        prop_assert!(thrust_error(&thruster, thrust, |_| command) < THRUST_ROUND_TRIP);
        prop_assert_eq!(thruster.command_clamped(thrust).unwrap().command, command);
        // False variant: the other side's inverse, negated.
        if thruster.forward() != thruster.backward() && let Ok(mirrored) = thruster.command(-thrust) {
            let wrong = thrust_error(&thruster, thrust, |_| -mirrored);
            let differs = (thruster.thrust(command) + thruster.thrust(-command)).abs() / magnitude;
            prop_assert!(wrong > THRUST_ROUND_TRIP || differs < 1e-9);
        }
    }

    #[test]
    fn command_survives_map_and_inverse(thruster in thruster(), fraction in 0.0..=1.0_f64) {
        let command = between(limits(&thruster), fraction);
        let back = thruster.command(thruster.thrust(command)).unwrap();
        let side = if command < 0.0 { thruster.backward() } else { thruster.forward() };
        let expected = if command.abs() < side.dead_zone() { 0.0 } else { command };
        prop_assert!((back - expected).abs() <= COMMAND_ROUND_TRIP * side.limit());
    }

    #[test]
    fn thrust_never_falls(thruster in thruster(), a in -0.1..1.1_f64, b in -0.1..1.1_f64) {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let at = |fraction| thruster.thrust(between(limits(&thruster), fraction));
        prop_assert!(at(low) <= at(high) + 1e-15 * at(high).abs());
        // Past the limits nothing is added.
        prop_assert_eq!(thruster.thrust(2.0 * thruster.forward().limit()), thruster.forward().largest_thrust_n());
    }

    #[test]
    fn a_side_is_accepted_exactly_when_sampling_finds_no_fall(
        a in -1.0..1.0_f64, b in -1.0..1.0_f64, dead_zone in 0.0..0.9_f64,
    ) {
        let curve = |n: f64| a * n * n + b * n;
        let samples: Vec<f64> = (0..=2000).map(|i| curve(between((dead_zone, 1.0), f64::from(i) / 2000.0))).collect();
        let lowest_slope = samples.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        let margin = lowest_slope.min(samples[0]).abs();
        prop_assume!(margin > 1e-6 || dead_zone == 0.0); // a close call is not decided by samples
        prop_assert_eq!(ThrustSide::new(a, b, dead_zone, 1.0).is_ok(), lowest_slope > 0.0 && samples[0] >= 0.0);
    }

    #[test]
    fn what_cannot_be_had_is_refused_with_its_limit_and_clamped_to_the_nearest(
        thruster in thruster(), scale in -2.0..2.0_f64,
    ) {
        let side = if scale < 0.0 { thruster.backward() } else { thruster.forward() };
        let thrust = scale * side.largest_thrust_n();
        let (least, most) = (side.smallest_thrust_n(), side.largest_thrust_n());
        match thruster.command(thrust) {
            Err(VehicleError::Saturated { largest_n, .. }) => prop_assert!(thrust.abs() > most && largest_n.abs() == most),
            Err(VehicleError::InDeadZone { smallest_n, .. }) => {
                prop_assert!(thrust.abs() < least && smallest_n.abs() == least);
            }
            other => prop_assert!(other.is_ok() && (least..=most).contains(&thrust.abs())),
        }
        let clamped = thruster.command_clamped(thrust).unwrap();
        let miss = (clamped.thrust_n - thrust).abs();
        prop_assert!((thruster.thrust(clamped.command) - clamped.thrust_n).abs() <= THRUST_ROUND_TRIP * most);
        for i in 0..=200 {
            let any = thruster.thrust(between(limits(&thruster), f64::from(i) / 200.0));
            prop_assert!((any - thrust).abs() >= miss * (1.0 - 1e-12), "{any} is nearer to {thrust}");
        }
    }

    #[test]
    fn single_precision_agrees((a, b, dead_zone, limit) in coefficients(), fraction in 0.05..0.95_f64) {
        let wide = Thruster::affine(a, b, dead_zone, limit).unwrap();
        let narrow = Thruster::affine(a as f32, b as f32, dead_zone as f32, limit as f32).unwrap();
        let thrust = between((wide.forward().smallest_thrust_n(), wide.forward().largest_thrust_n()), fraction);
        let command = narrow.command(thrust as f32).unwrap();
        prop_assert!((f64::from(narrow.thrust(command)) / thrust - 1.0).abs() < THRUST_ROUND_TRIP_F32);
    }

    #[test]
    fn bilinear_thrust_survives_its_inverse(
        by_rate in 1e-3..1.0_f64, by_speed in 0.0..1.0_f64, speed in -2.0..2.0_f64, thrust in -50.0..50.0_f64,
    ) {
        prop_assume!(thrust.abs() > 1e-6);
        let propeller = BilinearThruster::new((by_rate, by_speed), (1.0, 0.0), 1e6).unwrap();
        let rate = propeller.rate(thrust, speed).unwrap();
        // Eq. 1 once more, by hand.
        let eq_1 = |n: f64| by_rate * n.abs() * n - by_speed * n.abs() * speed;
        let scale = by_rate * rate * rate + by_speed * (rate * speed).abs();
        prop_assert!((eq_1(rate) - thrust).abs() < THRUST_ROUND_TRIP * scale);
        prop_assert!(rate * thrust > 0.0);
        let with_flow = rate * speed > 0.0;
        prop_assert!(!with_flow || rate.abs() >= by_speed * speed.abs() / by_rate * (1.0 - 1e-12));
        // False variant: still water assumed.
        let still = (thrust.abs() / by_rate).sqrt().copysign(thrust);
        prop_assert!((eq_1(still) - thrust).abs() > THRUST_ROUND_TRIP * scale || (by_speed * speed).abs() < 1e-9);
    }

    #[test]
    fn bilinear_rate_survives_the_map_outside_braking(
        by_speed in 0.0..1.0_f64, speed in -2.0..2.0_f64, rate in -40.0..40.0_f64,
    ) {
        let propeller = BilinearThruster::new((0.1, by_speed), (0.2, by_speed), 40.0).unwrap();
        prop_assume!(rate.abs() > 0.1 + by_speed * speed.abs() / 0.1);
        let back = propeller.rate(propeller.thrust(rate, speed), speed).unwrap();
        prop_assert!((back - rate).abs() < COMMAND_ROUND_TRIP * 40.0);
        let torque = 0.2 * rate.abs() * rate - by_speed * rate.abs() * speed;
        prop_assert!((propeller.torque(rate, speed) - torque).abs() < THRUST_ROUND_TRIP * 400.0);
    }
}

/// Branches at which the coefficients of thrust vanish or the command does.
#[test]
fn corners() {
    let square = Thruster::affine(1.0, 0.0, 0.0, 2.0).unwrap();
    assert_eq!((square.command(0.0), square.command(4.0), square.command(-1.0)), (Ok(0.0), Ok(2.0), Ok(-1.0)));
    let line = Thruster::affine(0.0, 3.0, 0.0, 2.0).unwrap();
    assert_eq!(line.command(1.5), Ok(0.5));
    // The vertex at the limit: thrust stops growing there.
    let bent = Thruster::affine(-0.25, 1.0, 0.0, 2.0).unwrap();
    assert_eq!((bent.command(1.0), bent.thrust(3.0)), (Ok(2.0), 1.0));
    assert!(matches!(Thruster::affine(-0.26, 1.0, 0.0, 2.0), Err(VehicleError::NotMonotone { .. })));
    assert!(matches!(Thruster::affine(1.0, -0.5, 0.4, 2.0), Err(VehicleError::NotMonotone { .. })));
    assert!(Thruster::affine(1.0, -0.5, 0.5, 2.0).is_ok());
    assert!(matches!(Thruster::affine(0.0, 0.0, 0.0, 2.0), Err(VehicleError::NotMonotone { .. })));
    for broken in [f64::NAN, f64::INFINITY] {
        assert!(matches!(square.command(broken), Err(VehicleError::OutOfDomain { .. })));
        assert!(matches!(square.command_clamped(broken), Err(VehicleError::OutOfDomain { .. })));
        assert!(Thruster::affine(broken, 1.0, 0.0, 2.0).is_err());
        assert!(Thruster::affine(1.0, 1.0, 0.0, broken).is_err());
    }
    // Finite coefficients whose thrust is not.
    assert!(matches!(Thruster::affine(1.0, 0.0, 0.0, 1e200), Err(VehicleError::OutOfDomain { .. })));
}
