//! Turning points, and what rounding does to them.
#![cfg(feature = "std")]

use super::*;
use crate::numeric::rounded::testing::{Big, Formula, big, hold};

/// The top of a tent is a sample; what comes after it is lower, though above where the window began.
#[test]
fn the_largest_sample_stays_the_largest() {
    let (mut recent, mut peak) = (Recent::new(), Peak::new());
    for time in -10..=10 {
        let time = f64::from(time);
        let value = 10.0 - time.abs();
        peak.push(time, value, &recent, 1.0);
        recent.push(time, value);
    }
    assert_eq!(peak.value(&recent, 1.0, 0.0), Some(10.0));
}

/// Nine samples, times first: the height of the parabola through them.
struct ParabolaVertex;

impl Formula<18, 1> for ParabolaVertex {
    fn of<T: Scalar>(inputs: [T; 18]) -> [T; 1] {
        let samples: [(T, T); 9] = core::array::from_fn(|k| (inputs[k], inputs[9 + k]));
        [vertex(&samples, samples[4].1).unwrap_or(T::zero())]
    }

    /// Normal equations in powers of the time since the first sample, by elimination.
    fn exact(inputs: [Big; 18]) -> [Big; 1] {
        let mut rows = [(); 3].map(|()| [(); 4].map(|()| big(0.0)));
        for k in 0..9 {
            let s = &inputs[k] - &inputs[0];
            let powers = [big(1.0), s.clone(), &s * &s];
            for row in 0..3 {
                for column in 0..3 {
                    rows[row][column] += &powers[row] * &powers[column];
                }
                rows[row][3] += &powers[row] * &inputs[9 + k];
            }
        }
        for pivot in 0..3 {
            for row in (0..3).filter(|row| *row != pivot) {
                let factor = &rows[row][pivot] / &rows[pivot][pivot];
                let parts = rows[pivot].clone().map(|entry| &factor * entry);
                for (entry, part) in rows[row].iter_mut().zip(parts) {
                    *entry -= part;
                }
            }
        }
        let [constant, slope, curvature] = [0, 1, 2].map(|k| &rows[k][3] / &rows[k][k]);
        [constant - &slope * &slope / (big(4.0) * curvature)]
    }
}

/// As the documentation of `Cycles::step` has it.
#[test]
fn rounding_of_a_turning_point() {
    let domain = core::array::from_fn(|k| {
        let place = (k % 9) as f64 / 4.0 - 1.0;
        if k < 9 {
            let time = 4.0 + 0.5 * (place + 1.0);
            (time - 1.0 / 4096.0, time + 1.0 / 4096.0)
        } else {
            let value = 1.0 - 0.5 * place * place;
            (value - 1.0 / 256.0, value + 1.0 / 256.0)
        }
    });
    hold::<18, 1, ParabolaVertex>(domain, [1; 18], [[1.8e-14], [9.5e-6]]);
}
