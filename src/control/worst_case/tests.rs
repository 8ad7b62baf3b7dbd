//! The bound of one box by itself: branch and bound would hide a bound that is a little too good.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::*;
use crate::control::{Structure, Tuning};
use crate::plant::DragAxis;

#[test]
fn no_axis_of_a_box_is_below_its_bound() {
    let mut random = Pcg64::seed_from_u64(1);
    let mut near = 0;
    for _ in 0..400 {
        let mut draw = |from: f64, to: f64| random.random_range(from..to);
        let (alpha, drag, delay_s) = (draw(0.7, 1.4), draw(0.0, 1.0), draw(0.0, 0.1));
        let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][draw(0.0, 3.0) as usize];
        let axis = DragAxis::linear(1.0, 0.5).unwrap().with_delay_s(0.05).unwrap();
        let tuning = Tuning::new(&axis, structure, 0.8).unwrap();
        let (gains, mut spread) = (tuning.gains(), |value: f64| Interval::new(value, value + draw(0.0, 0.3)).unwrap());
        let part = AxisIntervals::new(spread(alpha), spread(drag), spread(delay_s)).unwrap();
        let bound = part.bound(gains, 1e3);
        let inside = |interval: Interval, share: f64| interval.lower() + share * interval.width();
        let mut worst = [f64::INFINITY; 4];
        for point in 0..216 {
            let share = |k: i32| f64::from(point / 6_i32.pow(k as u32) % 6) / 5.0;
            let (alpha, drag) = (inside(part.alpha, share(0)), inside(part.drag, share(1)));
            let open_loop = OpenLoop::linear(alpha, drag, inside(part.delay_s, share(2)), gains);
            worst = lesser(worst, scores(&open_loop).unwrap_or([0.0; 4]));
        }
        for (bound, worst) in bound.0.iter().zip(worst) {
            // An unstable axis has no margin, and the bound of its box is none or one.
            assert!(*bound <= worst * (1.0 + 1e-9) || (worst == 0.0 && *bound <= 1.0), "{bound} {worst} {part:?}");
            near += u32::from(*bound > 0.7 * worst && worst > 0.0 && worst.is_finite());
        }
    }
    // Nor is the bound nothing at all.
    assert!(near > 600, "{near}");
}
