//! Loops in complex arithmetic, straight from their block diagram.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;
use proptest::prelude::*;
use selfosc::control::{Gains, OpenLoop, Structure};
use selfosc::plant::DragAxis;

/// An axis with linear drag, and a controller for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) alpha: f64,
    pub(super) drag: f64,
    pub(super) delay_s: f64,
    pub(super) gains: Gains<f64>,
}

impl Case {
    pub(super) fn axis(&self) -> DragAxis<f64> {
        DragAxis::linear(self.alpha, self.drag).unwrap().with_delay_s(self.delay_s).unwrap()
    }
    pub(super) fn open_loop(&self) -> OpenLoop<f64> {
        OpenLoop::new(&self.axis(), &self.gains, 0.0).unwrap()
    }

    /// Controller times axis at `s = jw`, block by block.
    pub(super) fn response(&self, omega: f64) -> Complex<f64> {
        let (s, g) = (Complex::new(0.0, omega), &self.gains);
        let controller = g.proportional() + g.integral() / s + g.derivative() * s / (g.filter_s() * s + 1.0);
        controller / (s * (s * self.alpha + self.drag)) * (-s * self.delay_s).exp()
    }

    /// Roots of the characteristic equation in the right half plane by Mikhailov's count: how far the angle of
    /// `D(jw) + N(jw) exp(-jw delay)` turns from zero to high frequency.
    pub(super) fn unstable_by_angle(&self) -> f64 {
        let (g, integral) = (&self.gains, self.gains.integral() > 0.0);
        let characteristic = |omega: f64| {
            let s = Complex::new(0.0, omega);
            let filter = s * g.filter_s() + 1.0;
            // Without integral action one factor s less.
            let axis = (s * self.alpha + self.drag) * filter * s * if integral { s } else { Complex::new(1.0, 0.0) };
            let below = if integral { s } else { Complex::new(1.0, 0.0) };
            let action = (below * g.proportional() + g.integral()) * filter + s * below * g.derivative();
            axis + action * (-s * self.delay_s).exp()
        };
        let degree = 2.0 + f64::from(u8::from(integral)) + f64::from(u8::from(g.filter_s() > 0.0));
        let (mut omega, mut value, mut turned) = (0.0, characteristic(0.0), 0.0);
        let top = 1e5;
        let mut step = 1e-6;
        while omega < top {
            let next = characteristic(omega + step);
            let turn = (next / value).arg();
            if turn.abs() > 0.05 && step > 1e-9 {
                step *= 0.5;
                continue;
            }
            (omega, value, turned) = (omega + step, next, turned + turn);
            step = (step * 1.5).min(0.02 * omega + 1e-6);
        }
        (degree - turned * 2.0 / PI) / 2.0
    }

    /// Frequencies from a fine grid at which `of` changes its sign without a jump.
    fn crossings(&self, of: impl Fn(Complex<f64>) -> f64) -> Vec<f64> {
        let nodes = || (0..=400_000).map(|k| 1e-4 * 1e8f64.powf(f64::from(k) / 400_000.0));
        let value = |omega: f64| of(self.response(omega));
        let mut found = Vec::new();
        let mut last = (1e-4, value(1e-4));
        for omega in nodes().skip(1) {
            let now = (omega, value(omega));
            if last.1 * now.1 < 0.0 {
                let (mut low, mut high) = (last.0, now.0);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if value(middle) * last.1 > 0.0 { low = middle } else { high = middle }
                }
                found.push(0.5 * (low + high));
            }
            last = now;
        }
        found
    }

    /// Gain, gain reduction (infinite for none), phase and delay margin by sweep.
    pub(super) fn swept(&self) -> [f64; 4] {
        let mut worst = [f64::INFINITY; 4];
        for omega in self.crossings(|l| l.norm().ln()) {
            let above = (self.response(omega).arg() + PI).rem_euclid(TAU);
            worst[2] = worst[2].min(above).min(TAU - above);
            worst[3] = worst[3].min(above / omega);
        }
        for omega in self.crossings(|l| l.im / l.norm()) {
            let l = self.response(omega);
            if l.re < 0.0 && l.norm() < 1.0 {
                worst[0] = worst[0].min(1.0 / l.norm());
            } else if l.re < 0.0 {
                worst[1] = worst[1].min(l.norm());
            }
        }
        worst
    }
}

/// Any gains, stable or not; frequencies of order one. Half of them with little proportional gain, so that `|L|` passes one three times
/// and delay takes poles to the left as well as to the right.
pub(super) fn case() -> impl Strategy<Value = Case> {
    let drag = prop_oneof![Just(0.0), 0.01..3.0_f64];
    let delay = prop_oneof![Just(0.0), 0.01..1.5_f64];
    let filter = prop_oneof![Just(0.0), 0.01..0.3_f64];
    let any = (0.1..5.0_f64, prop_oneof![Just(0.0), 0.01..2.0_f64], 0.0..3.0_f64);
    let lean = (0.05..0.8_f64, 0.1..2.0_f64, 1.5..4.0_f64);
    let gains = prop_oneof![any, lean];
    (0.2..3.0_f64, drag, delay, gains, filter).prop_map(|(alpha, drag, delay_s, gains, filter)| {
        let (proportional, integral, derivative) = gains;
        let structure = if integral > 0.0 { Structure::Pid } else { Structure::Pd };
        let gains = Gains::new(structure, proportional, integral, derivative, filter).unwrap();
        Case { alpha, drag, delay_s, gains }
    })
}
