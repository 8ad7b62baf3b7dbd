//! A linear plant under a relay: its exact limit cycles, and what is proved of them.

use pyo3::prelude::*;
use selfosc::Error;
use selfosc::nonlinearity::RelayHysteresis;
use selfosc::numeric::Interval;
use selfosc::orbit::{RelayLoop, RelayOrbit};
use selfosc::plant::{StateSpace, TransferFunction};
use serde_json::{Value, json};

use crate::{failure, work};

/// The symmetric limit cycles of a transfer function under a relay with hysteresis whose periods are in a range, each with
/// its proof or why there is none, as a JSON document. Powers of s descend; times in s.
#[pyfunction]
pub(crate) fn certify(
    py: Python<'_>,
    num: Vec<f64>,
    den: Vec<f64>,
    delay_s: f64,
    level: f64,
    half_width: f64,
    period_s: (f64, f64),
) -> PyResult<String> {
    let work = move || -> Result<Value, Error> {
        let plant = StateSpace::realise(&TransferFunction::new(&num, &den)?.with_delay(delay_s)?)?;
        let closed = RelayLoop::new(plant, RelayHysteresis::new(level, half_width, 0.0)?);
        let orbits = closed.symmetric_orbits(period_s.0..=period_s.1)?;
        Ok(json!({ "orbits": orbits.iter().map(|orbit| document(&closed, orbit)).collect::<Vec<_>>() }))
    };
    let found = work::interruptible(py, None, move |_| work())?;
    found.map(|found| found.to_string()).map_err(|error| failure::library(py, error))
}

fn document(closed: &RelayLoop, orbit: &RelayOrbit) -> Value {
    let bounds = |interval: Interval| [interval.lower(), interval.upper()];
    let proof = closed.certify(0.5 * orbit.period_s());
    let certificate = proof.as_ref().ok().map(|proof| {
        json!({
            "half_period_s": bounds(proof.half_period_s),
            "switching_rate": bounds(proof.switching_rate),
            "attracting": proof.contracts_after.is_some(),
            "contracts_after": proof.contracts_after,
            "cells": proof.cells,
        })
    });
    let refused = proof.as_ref().err().map(|why| json!({ "code": why.code(), "text": why.to_string() }));
    json!({
        "period_s": orbit.period_s(),
        "amplitude": orbit.amplitude(),
        "maximum": orbit.maximum(),
        "minimum": orbit.minimum(),
        "stable": orbit.is_stable(),
        "certificate": certificate,
        "certificate_refused": refused,
    })
}
