//! What rounding does to a step.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use super::*;
use crate::numeric::rounded::testing::{Big, Formula, big, hold};

/// Of a PD (0), PID (1), I-PD (2): gains and filter, reference, measurement, interval, and what the step before left: measurement, speed,
/// integral. Command, speed and integral come out.
struct Step<const KIND: usize>;

impl<const KIND: usize> Formula<10, 3> for Step<KIND> {
    fn of<T: Scalar>([kp, ki, kd, filter_s, reference, now, dt_s, before, speed, integral]: [T; 10]) -> [T; 3] {
        let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][KIND];
        let ki = if KIND == 0 { T::zero() } else { ki };
        let gains = Gains::new(structure, kp, ki, kd, filter_s).unwrap();
        let mut controller = Controller::new(&gains).on_circle(T::from_f64(8.0)).unwrap();
        controller.memory = Some(Memory { measurement: before, speed, integral, guided: Guided::at_rest(before) });
        let step = controller.step(reference, now, dt_s);
        assert_eq!(step.fault, None);
        let memory = controller.memory.unwrap();
        [step.command, memory.speed, memory.integral]
    }

    fn exact([kp, ki, kd, filter_s, reference, now, dt_s, before, speed, integral]: [Big; 10]) -> [Big; 3] {
        let (error, moved) = (reference - &now, now - before);
        let speed = (filter_s.clone() * speed + &moved) / (filter_s + &dt_s);
        let accumulated = if KIND == 0 { big(0.0) } else { ki * &error * dt_s };
        let integral = integral + accumulated;
        let (integral, direct) = if KIND == 2 { (integral - kp * moved, big(0.0)) } else { (integral, kp * error) };
        [direct + &integral - kd * &speed, speed, integral]
    }
}

/// As the documentation of `Controller::step` has it.
fn holds<const KIND: usize>(stated: [[f64; 3]; 2]) {
    let (gain, one) = ((0.5, 2.0), (-1.0, 1.0));
    let domain = [gain, (0.125, 0.5), gain, (0.0625, 0.5), one, one, (0.0625, 0.25), one, one, one];
    hold::<10, 3, Step<KIND>>(domain, [1, 1, 2, 4, 1, 2, 8, 2, 1, 1], stated);
}

#[test]
fn rounding_of_a_pd_step() {
    holds::<0>([[5.5e-14, 2.1e-14, 0.0], [2.9e-5, 1.1e-5, 0.0]]);
}

#[test]
fn rounding_of_a_pid_step() {
    holds::<1>([[5.5e-14, 2.1e-14, 3.7e-16], [2.9e-5, 1.1e-5, 2e-7]]);
}

#[test]
fn rounding_of_an_ipd_step() {
    holds::<2>([[5.5e-14, 2.1e-14, 2.8e-15], [2.9e-5, 1.1e-5, 1.5e-6]]);
}
