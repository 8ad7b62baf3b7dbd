//! The bound of the loop at high frequencies, against complex arithmetic.

use nalgebra::Complex;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use selfosc::control::{Gains, LinearProcess, Structure, loop_gain_beyond};
use selfosc::numeric::Interval;

/// `|L(s)|` from the factors of the loop, without its delay: `|exp(-s delay)| <= 1` where `Re s >= 0`.
fn loop_gain(
    [alpha, drag, stiffness, memory, memory_s, lag_s, filter_s, zero_s, _]: [f64; 9],
    gains: &Gains<f64>,
    s: Complex<f64>,
) -> f64 {
    let body = s * s * alpha + s * drag + s * memory / (s * memory_s + 1.0) + stiffness;
    let derivative = s * gains.derivative() / (s * gains.filter_s() + 1.0);
    let controller = Complex::from(gains.integral()) / s + derivative + gains.proportional();
    (controller * (s * zero_s + 1.0) / ((s * lag_s + 1.0) * (s * filter_s + 1.0) * body)).norm()
}

/// A box of processes: inertia, lag, filter and time of the late drag may reach zero, stiffness and late drag may be negative.
fn drawn(random: &mut Pcg64Mcg) -> [Interval; 9] {
    let mut between = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    let mut reaching = |most: f64| {
        let low = between(-0.5, 1.0).max(0.0) * most;
        Interval::new(low, low + between(0.0, 0.3) * most).unwrap()
    };
    let (alpha, memory_s) = (reaching(2.0), reaching(1.0));
    let [lag_s, filter_s, zero_s, delay_s] = [0.2, 0.1, 0.5, 0.5].map(reaching);
    let drag = between(0.2, 1.0);
    let sized = |size: f64| Interval::new(size - 0.05, size + 0.05).unwrap();
    let (stiffness, memory) = (sized(between(-0.5, 1.0)), sized(between(-0.9, 0.9) * drag));
    [alpha, sized(drag), stiffness, memory, memory_s, lag_s, filter_s, zero_s, delay_s]
}

/// No process of a box has a larger loop gain beyond the frequency than the bound says; the bound is within two decades of the largest.
#[test]
fn no_loop_gain_exceeds_its_bound() {
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let (mut bounded, mut largest) = (0, 0.0_f64);
    for draw in 0..400 {
        let parts = drawn(&mut random);
        let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][draw % 3];
        let integral = if draw % 3 == 0 { 0.0 } else { 0.2 };
        let gains = Gains::new(structure, 0.8, integral, 0.6, 0.1).unwrap();
        let processes = LinearProcess::from_parts(parts);
        for octave in [-1, 2, 5] {
            let omega = 2f64.powi(octave);
            let Some(bound) = loop_gain_beyond(&processes, &gains, omega) else { continue };
            bounded += 1;
            for _ in 0..60 {
                let process = parts.map(|side| {
                    // The ends as often as the inside: the bound is met there.
                    let share = (2.0 * random.random::<f64>() - 0.5).clamp(0.0, 1.0);
                    side.lower() + share * side.width()
                });
                let angle = core::f64::consts::FRAC_PI_2 * (2.0 * random.random::<f64>() - 1.0);
                let s = Complex::from_polar(omega * (1.0 + 3.0 * random.random::<f64>().powi(3)), angle);
                let share = loop_gain(process, &gains, s) / bound.upper();
                assert!(share <= 1.0 + 1e-12, "{share} of the bound at {s} of {process:?}");
                largest = largest.max(share);
            }
        }
    }
    assert!(bounded >= 300 && largest > 0.5, "{bounded} bounds, the nearest {largest}");
}
