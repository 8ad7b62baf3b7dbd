//! What rounding does to thruster maps and their inverses.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use super::*;
use crate::numeric::Scalar;
use crate::numeric::rounded::testing::{Big, Formula, big, hold};

/// Quadratic and linear coefficient, dead zone, limit; then a command, or a thrust.
const MAP: [(f64, f64); 4] = [(1.0 / 8192.0, 1.0 / 4096.0), (1.0 / 128.0, 1.0 / 64.0), (8.0, 16.0), (192.0, 256.0)];

struct Thrust;

impl Formula<5, 1> for Thrust {
    fn of<T: Scalar>([quadratic, linear, dead_zone, limit, command]: [T; 5]) -> [T; 1] {
        [Thruster::affine(quadratic, linear, dead_zone, limit).unwrap().thrust(command)]
    }

    fn exact([quadratic, linear, dead_zone, limit, command]: [Big; 5]) -> [Big; 1] {
        let ahead = command >= big(0.0);
        let size = if ahead { command } else { -command };
        let size = if size < dead_zone { big(0.0) } else { size.min(limit) };
        let thrust = quadratic * &size * &size + linear * size;
        [if ahead { thrust } else { -thrust }]
    }
}

struct Command;

impl Formula<5, 1> for Command {
    fn of<T: Scalar>([quadratic, linear, dead_zone, limit, thrust]: [T; 5]) -> [T; 1] {
        [Thruster::affine(quadratic, linear, dead_zone, limit).unwrap().command(thrust).unwrap()]
    }

    fn exact([quadratic, linear, _, _, thrust]: [Big; 5]) -> [Big; 1] {
        let ahead = thrust >= big(0.0);
        let size = if ahead { thrust } else { -thrust };
        let root = (&linear * &linear + big(4.0) * &quadratic * size).sqrt();
        let command = (root - linear) / (big(2.0) * quadratic);
        [if ahead { command } else { -command }]
    }
}

/// As the documentation of `Thruster` has it.
#[test]
fn rounding_of_a_thruster_and_its_inverse() {
    let with = |last: (f64, f64)| [MAP[0], MAP[1], MAP[2], MAP[3], last];
    hold::<5, 1, Thrust>(with((-256.0, 256.0)), [4, 2, 2, 2, 32], [[6.3e-15], [3.4e-6]]);
    // More than the dead zone hides, less than the limit gives.
    for range in [(0.375, 5.0), (-5.0, -0.375)] {
        hold::<5, 1, Command>(with(range), [8, 8, 1, 1, 32], [[8.5e-14], [4.4e-5]]);
    }
}

/// `T_nn`, `T_nu`.
const PROPELLER: [(f64, f64); 2] = [(1.0 / 128.0, 1.0 / 64.0), (1.0 / 64.0, 1.0 / 16.0)];

struct InFlow;

impl Formula<4, 1> for InFlow {
    fn of<T: Scalar>([by_rate, by_speed, rate, speed]: [T; 4]) -> [T; 1] {
        let one = T::one();
        [BilinearThruster::new((by_rate, by_speed), (one, one), T::from_f64(64.0)).unwrap().thrust(rate, speed)]
    }

    fn exact([by_rate, by_speed, rate, speed]: [Big; 4]) -> [Big; 1] {
        let size = if rate < big(0.0) { -rate.clone() } else { rate.clone() };
        [size * (by_rate * rate - by_speed * speed)]
    }
}

struct Rate;

impl Formula<4, 1> for Rate {
    fn of<T: Scalar>([by_rate, by_speed, thrust, speed]: [T; 4]) -> [T; 1] {
        let one = T::one();
        [BilinearThruster::new((by_rate, by_speed), (one, one), T::from_f64(64.0))
            .unwrap()
            .rate(thrust, speed)
            .unwrap()]
    }

    fn exact([by_rate, by_speed, thrust, speed]: [Big; 4]) -> [Big; 1] {
        let ahead = thrust >= big(0.0);
        let (size, speed) = if ahead { (thrust, speed) } else { (-thrust, -speed) };
        let with_flow = by_speed * speed;
        let root = (&with_flow * &with_flow + big(4.0) * &by_rate * size).sqrt();
        let rate = (with_flow + root) / (big(2.0) * by_rate);
        [if ahead { rate } else { -rate }]
    }
}

/// As the documentation of `BilinearThruster` has it.
#[test]
fn rounding_of_a_propeller_in_flow_and_its_inverse() {
    let with = |range: (f64, f64)| [PROPELLER[0], PROPELLER[1], range, (-1.0, 1.0)];
    hold::<4, 1, InFlow>(with((-32.0, 32.0)), [4, 1, 32, 1], [[6.1e-15], [3.3e-6]]);
    for range in [(0.5, 8.0), (-8.0, -0.5)] {
        hold::<4, 1, Rate>(with(range), [8, 2, 32, 8], [[1.8e-14], [9.7e-6]]);
    }
}
