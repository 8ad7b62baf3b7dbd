use super::*;
use crate::experiment::{Sensor, SimulatedExperiment};
use crate::identify::answer::{Delay, DragLaw};
use crate::identify::fit::shooting::{Between, Fit, likeliest};
use crate::nonlinearity::RelayHysteresis;
use crate::plant::DragAxis;

const WAYS: [Between; 2] = [Between::AtSamples, Between::Anywhere];

fn long(rest: usize) -> Record {
    let axis = DragAxis::quadratic(1.0, 0.5).unwrap().with_delay_s(0.13).unwrap();
    let sensor = Sensor { quantum: 0.02, ..Sensor::default() };
    let relay = RelayHysteresis::new(1.0, 0.3, 0.0).unwrap();
    let run =
        SimulatedExperiment::new(axis, relay, 10.0).unwrap().held().with_sensor(sensor).unwrap().run(900.0).unwrap();
    let before = |value: f64, values: &[f64]| [vec![value; rest], values.to_vec()].concat();
    let time_s = (0..rest + run.samples()).map(|sample| 0.1 * sample as f64).collect();
    Record::new(time_s, before(run.output()[0], run.output()), before(0.0, run.input())).unwrap()
}

#[test]
fn a_search_by_way_of_the_beginning_ends_where_one_of_all_samples_does() {
    let record = long(0);
    assert!(of(&[&record]).is_some());
    let mut spared = 0;
    for law in DragLaw::ALL {
        let fit = Fit::new(law, Delay::Estimated);
        let end = |ends| likeliest(ends, GaussNewton::evidence).unwrap().settle().unwrap();
        let (short, whole) = (end(fit.ends(&[&record], &WAYS, Vec::new())), end(fit.approach(&[&record], &WAYS, &[])));
        assert!(short.evidence() > whole.evidence() - 0.1, "{law:?}: {} {}", short.evidence(), whole.evidence());
        spared += whole.steps - short.steps;
    }
    assert!(spared > 0);
}

#[test]
fn a_beginning_at_rest_is_not_begun_with() {
    assert!(of(&[&long(SAMPLES)]).is_none());
}

#[test]
fn equal_ends_are_one_and_each_way_has_its_own() {
    let record = long(0).beginning(SAMPLES).unwrap();
    let ends = Fit::new(DragLaw::Quadratic, Delay::Estimated).approach(&[&record], &[WAYS[0], WAYS[0], WAYS[1]], &[]);
    let ways: Vec<Between> = places(&ends).iter().map(|place| place.between).collect();
    assert_eq!(ways, WAYS);
}
