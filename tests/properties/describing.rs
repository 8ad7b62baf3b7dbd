//! Describing functions: closed form against the library's own quadrature, and the laws that every one obeys.

use proptest::prelude::*;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use selfosc::describing::{Boxed, CATALOGUE, Entry, by_quadrature};
use selfosc::nonlinearity::{Branch, Sinusoid};

use crate::cases::case;
use crate::tolerance;

/// Closed form against quadrature, relative to the largest output on the sweep.
fn disagreement(characteristic: &Boxed<f64>, sweep: &Sinusoid<f64>) -> Option<String> {
    let closed = characteristic.describing_function(sweep).unwrap();
    let numeric = by_quadrature(&**characteristic, sweep).ok()?;
    let amplitude = sweep.amplitude();
    let mut largest = 0f64;
    for x in [sweep.minimum(), sweep.bias(), sweep.maximum()] {
        for branch in [Branch::Rising, Branch::Falling] {
            largest = largest.max(characteristic.output(x, branch, sweep).abs());
        }
    }
    [
        ("f0", closed.f0, numeric.f0),
        ("p", closed.p * amplitude, numeric.p * amplitude),
        ("q", closed.q * amplitude, numeric.q * amplitude),
    ]
    .into_iter()
    .find(|(_, closed, numeric)| !((closed - numeric).abs() <= tolerance::QUADRATURE * largest))
    .map(|(name, closed, numeric)| format!("{name} {closed} against {numeric}"))
}

proptest! {
    #[test]
    fn closed_forms_equal_quadrature(index in 0..CATALOGUE.len(), seed: u64) {
        let entry = &CATALOGUE[index];
        let case = case(entry, &mut Pcg64Mcg::seed_from_u64(seed));
        // The oracle looks at the edges.
        if !case.on_edge() {
            prop_assert_eq!(disagreement(&case.characteristic, &case.sweep), None, "{}", entry.name);
        }
    }
}

/// Integrands with so little between the nodes of a rule, or with such luck there, that its error estimate was fooled.
#[test]
fn quadrature_is_not_fooled() {
    for (name, values, bias, amplitude) in [
        ("tanh", [0.06569823300633566, 15.094224555856883], -8.787583811679266, 14.071868762408329),
        ("tanh", [1.4060947191203077, 25.24058504802975], -66.28915423462205, 66.66897114004772),
        ("power", [2.170576140153123, 0.5938649358545255], 0.00708736947894297, 8.510681644202595),
    ] {
        let characteristic = Entry::find(name).unwrap().build(&values).unwrap();
        let sweep = Sinusoid::new(bias, amplitude).unwrap();
        assert!(by_quadrature(&*characteristic, &sweep).is_ok(), "{name}");
        assert_eq!(disagreement(&characteristic, &sweep), None, "{name}");
    }
}
