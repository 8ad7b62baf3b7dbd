//! Describing functions: closed form against quadrature, and the laws that every one obeys.

use proptest::prelude::*;
use selfosc::describing::{CATALOGUE, Entry, by_quadrature};
use selfosc::nonlinearity::{Domain, Sinusoid};

use crate::tolerance;

/// Parameter values inside their domains, sorted where an order is asked for.
fn values(entry: &Entry, raw: &[f64]) -> Vec<f64> {
    let mut values: Vec<f64> = entry
        .parameters
        .iter()
        .zip(raw)
        .map(|(parameter, &raw)| match parameter.domain {
            Domain::Finite => raw,
            Domain::NonNegative | Domain::Positive => raw.abs() + 1e-3,
        })
        .collect();
    let place = |name: &str| entry.parameters.iter().position(|p| p.name == name);
    for (lesser, greater) in [("off", "on"), ("lower", "upper"), ("half_width", "breakpoint")] {
        if let (Some(lesser), Some(greater)) = (place(lesser), place(greater)) {
            let (a, b) = (values[lesser], values[greater]);
            (values[lesser], values[greater]) = (a.min(b), a.max(b) + 1e-3);
        }
    }
    values
}

proptest! {
    #[test]
    fn closed_forms_equal_quadrature(
        index in 0..CATALOGUE.len(),
        raw in prop::array::uniform4(-2.0..2.0f64),
        bias in -2.0..2.0f64,
        amplitude in 0.05..4.0f64,
    ) {
        let entry = &CATALOGUE[index];
        let bias = if entry.name == "power" { 0.0 } else { bias };
        let characteristic = entry.build(&values(entry, &raw)).unwrap();
        let sweep = Sinusoid::new(bias, amplitude).unwrap();
        match (characteristic.describing_function(&sweep), by_quadrature(&*characteristic, &sweep)) {
            (Ok(closed), Ok(numeric)) => {
                let scale = 1.0 + (amplitude + bias.abs()).powf(raw[1].abs().max(1.0)) * raw[0].abs().max(raw[1].abs()).max(1.0);
                for (name, closed, numeric) in
                    [("f0", closed.f0, numeric.f0), ("p", closed.p * amplitude, numeric.p * amplitude), ("q", closed.q * amplitude, numeric.q * amplitude)]
                {
                    prop_assert!(
                        (closed - numeric).abs() <= tolerance::QUADRATURE * scale,
                        "{}: {name} {closed} against {numeric}", entry.name
                    );
                }
            }
            (closed, numeric) => prop_assert_eq!(closed, numeric),
        }
    }
}
