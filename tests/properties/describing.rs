//! Describing functions: closed form against the library's own quadrature, and the laws that every one obeys.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use selfosc::describing::{CATALOGUE, by_quadrature};
use selfosc::nonlinearity::Branch;

use crate::cases::case;
use crate::tolerance;

proptest! {
    #[test]
    fn closed_forms_equal_quadrature(index in 0..CATALOGUE.len(), seed: u64) {
        let entry = &CATALOGUE[index];
        let case = case(entry, &mut Pcg64Mcg::seed_from_u64(seed));
        let closed = case.characteristic.describing_function(&case.sweep).unwrap();
        // The quadrature may give up next to a kink; it may not be wrong.
        if let Ok(numeric) = by_quadrature(&*case.characteristic, &case.sweep) {
            let amplitude = case.sweep.amplitude();
            let mut largest = 0f64;
            for x in [case.sweep.minimum(), case.sweep.bias(), case.sweep.maximum()] {
                for branch in [Branch::Rising, Branch::Falling] {
                    largest = largest.max(case.characteristic.output(x, branch, &case.sweep).abs());
                }
            }
            for (name, closed, numeric) in [
                ("f0", closed.f0, numeric.f0),
                ("p", closed.p * amplitude, numeric.p * amplitude),
                ("q", closed.q * amplitude, numeric.q * amplitude),
            ] {
                prop_assert!(
                    (closed - numeric).abs() <= tolerance::QUADRATURE * largest,
                    "{}: {name} {closed} against {numeric}", entry.name
                );
            }
        }
    }
}
