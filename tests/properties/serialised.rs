//! What users hold can be sent, shared, cloned and written: it comes back from JSON equal, and damaged files are refused.

use serde::{Serialize, de::DeserializeOwned};

use selfosc::balance::{HarmonicBalance, Intersection};
use selfosc::control::{Structure, Tuning, WorstMargins};
use selfosc::describing::{Certified, ClosedForm, DescribingFunction, certified};
use selfosc::experiment::SimulatedExperiment;
use selfosc::features::RecordFeatures;
use selfosc::nonlinearity::{RelayHysteresis, Saturation, Sinusoid};
use selfosc::numeric::Interval;
use selfosc::on_board::Outcome;
use selfosc::orbit::{Certificate, certify};
use selfosc::plant::{DragAxis, StateSpace, TransferFunction};
use selfosc::proof::rigorous_quadrature::CellJet;

use crate::control::worst_case::axes;

fn comes_back<T: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug + Clone + Send + Sync>(value: &T) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(serde_json::from_str::<T>(&text).unwrap(), value.clone(), "{text}");
}

fn damaged<T: DeserializeOwned>(value: &impl Serialize, pointer: &str, by: serde_json::Value) -> String {
    let mut tree = serde_json::to_value(value).unwrap();
    *tree.pointer_mut(pointer).unwrap() = by;
    serde_json::from_value::<T>(tree).map(|_| ()).unwrap_err().to_string()
}

fn relay() -> RelayHysteresis<f64> {
    RelayHysteresis::new(1.0, 0.2, 0.0).unwrap()
}

fn plant() -> TransferFunction {
    TransferFunction::new(&[1.0], &[1.0, 1.0, 0.0]).unwrap().with_delay(0.1).unwrap()
}

#[test]
fn describing_functions_come_back() {
    let saturation = Saturation::new(1.0, 0.5).unwrap();
    let sweep = Sinusoid::new(0.1, 1.3).unwrap();
    comes_back::<DescribingFunction<f64>>(&saturation.describing_function(&sweep).unwrap());
    let jet = |value| CellJet::constant(Interval::point(value));
    let saturation = Saturation::new(jet(1.0), jet(0.5)).unwrap();
    comes_back::<Certified>(&certified(&saturation, &Sinusoid::new(jet(0.1), jet(1.3)).unwrap()).unwrap());
}

#[test]
fn oscillations_come_back() {
    let plant = plant();
    let relay = relay();
    let found =
        HarmonicBalance::new(&plant, |sweep| relay.describing_function(sweep)).unwrap().intersections().unwrap();
    comes_back::<Vec<Intersection>>(&found);
    assert!(!found.is_empty());
    let axis = DragAxis::mixed(1.0, 0.2, 0.3).unwrap().with_disturbance(0.1).unwrap();
    comes_back::<Certificate>(&certify(&axis, &relay).unwrap());
    comes_back::<TransferFunction>(&plant);
    comes_back::<StateSpace>(&StateSpace::realise(&plant).unwrap());
}

#[test]
fn margins_and_outcomes_come_back() {
    let axis = DragAxis::linear(1.0, 0.4).unwrap();
    let tuning = Tuning::new(&axis, Structure::Pd, 1.0).unwrap();
    let interval = |low, high| Interval::new(low, high).unwrap();
    let axes = axes([interval(0.9, 1.1), interval(0.35, 0.45), interval(0.0, 0.05)]);
    comes_back::<WorstMargins>(&axes.worst_margins(tuning.gains()).unwrap());
    let record = SimulatedExperiment::new(axis, relay(), 10.0).unwrap().run(60.0).unwrap();
    let features = RecordFeatures::of(&record).unwrap().features;
    let written = serde_json::json!({ "features": features, "relay_level": 1.0, "half_width": 0.2, "attempts": 1 });
    comes_back::<Outcome<f64>>(&serde_json::from_value(written).unwrap());
}

#[test]
fn damaged_plants_are_refused() {
    assert!(damaged::<TransferFunction>(&plant(), "/denominator", serde_json::json!([])).contains("coefficient"));
    let state_space = StateSpace::realise(&plant()).unwrap();
    assert!(damaged::<StateSpace>(&state_space, "/delay_s", (-1.0).into()).contains("delay"));
}
