//! Certificates of bounds are accepted as they are written, and refused with a combination of inequalities changed. Other changes are in
//! `fixtures/forgeries.json`.

use std::sync::LazyLock;

use selfosc::identify::DragLaw;
use selfosc::identify::bounded::certificate::{Certificate, Unproved};
use selfosc::identify::bounded::{BoundedModel, Consistency, DelayBound, enclose_with_certificate};
use serde_json::{Value, json};

use super::bounds::{record, settings};

fn written(model: &BoundedModel, verdict: Consistency) -> Value {
    let (bounds, certificate) = enclose_with_certificate(&[&record(300)], model).expect("bounds");
    assert_eq!(bounds.verdict, verdict);
    serde_json::from_str(&certificate.expect("a proof").to_string()).expect("JSON")
}

static CONSISTENT: LazyLock<Value> = LazyLock::new(|| written(&settings(DragLaw::Linear), Consistency::Consistent));

/// By a delay that is not the vehicle's.
static REFUTED: LazyLock<Value> = LazyLock::new(|| {
    let late = BoundedModel { delay: DelayBound::KnownS(0.15), ..settings(DragLaw::Linear) };
    written(&late, Consistency::Refuted)
});

fn both() -> [&'static Value; 2] {
    [&CONSISTENT, &REFUTED]
}

fn read(certificate: &Value) -> Certificate {
    Certificate::read(&certificate.to_string()).expect("a certificate")
}

fn refused(certificate: &Value) -> Option<&'static str> {
    read(certificate).check().err().map(|unproved: Unproved| unproved.code())
}

#[test]
fn what_is_written_is_accepted_and_read_back() {
    for certificate in both() {
        let read = read(certificate);
        assert_eq!(serde_json::to_value(&read).expect("JSON"), *certificate);
        let shown = read.check().expect("accepted");
        assert!(shown.enclosures > 0 && shown.readings == 300);
        assert_eq!(shown.left.is_empty(), certificate["stages"][0]["left"].is_null());
        assert!(read.agrees(&[record(300)]).is_ok() && read.agrees(&[record(299)]).is_err());
    }
}

/// The first combination of several inequalities of a step.
fn combination(step: &mut Value) -> Option<&mut Vec<Value>> {
    let several = |rows: &Value| rows.as_array().is_some_and(|rows| rows.len() > 1);
    let rows = match step.as_object_mut()?.iter_mut().next()? {
        (kind, body) if kind == "contract" => {
            let cuts = body["cuts"].as_array_mut()?;
            cuts.iter_mut().map(|cut| &mut cut["rows"]).find(|rows| several(rows))?
        }
        (kind, body) if kind == "exclude" => Some(&mut body["rows"]).filter(|rows| several(rows))?,
        _ => return None,
    };
    rows.as_array_mut()
}

/// Every step's first combination, one at a time: how many are refused when changed, and how many there are. What says less than its
/// rows show may do with fewer, and what is accepted is then shown by the rest.
fn each_changed(change: impl Fn(&mut Vec<Value>, usize)) -> (usize, usize) {
    let (mut refusals, mut changed) = (0, 0);
    for certificate in both() {
        let steps = certificate["stages"][0]["steps"].as_array().expect("steps").len();
        for step in 0..steps {
            let mut other = certificate.clone();
            let Some(rows) = combination(&mut other["stages"][0]["steps"][step]) else { continue };
            let weight = |row: &Value| row[1].as_f64().expect("a multiplier");
            let heaviest = (0..rows.len()).max_by(|a, b| weight(&rows[*a]).total_cmp(&weight(&rows[*b])));
            change(rows, heaviest.expect("several rows"));
            changed += 1;
            if let Some(code) = refused(&other) {
                assert_eq!(code, "step");
                refusals += 1;
            }
        }
    }
    (refusals, changed)
}

#[test]
fn one_constraint_dropped_or_one_multiplier_altered_is_refused() {
    let times = |rows: &mut Vec<Value>, row: usize, factor: f64| {
        rows[row][1] = json!(factor * rows[row][1].as_f64().expect("a multiplier"));
    };
    let changes: [&dyn Fn(&mut Vec<Value>, usize); 3] = [
        &|rows, heaviest| _ = rows.remove(heaviest),
        &|rows, heaviest| times(rows, heaviest, 3.0),
        &|rows, heaviest| times(rows, heaviest, -1.0),
    ];
    for change in changes {
        let (refused, changed) = each_changed(change);
        assert!(changed > 5 && 10 * refused >= 8 * changed, "{refused} of {changed} refused");
    }
}

#[test]
fn a_narrower_remainder_is_refused_and_a_stage_from_where_the_one_before_ended_is_not() {
    let mut narrower = CONSISTENT.clone();
    let range = &mut narrower["stages"][0]["left"][0];
    let ends = [0, 1].map(|end| range[end].as_f64().expect("an end"));
    range[1] = json!(0.5 * (ends[0] + ends[1]));
    assert_eq!(refused(&narrower), Some("step"));
    let mut twice = REFUTED.clone();
    let mut first = REFUTED["stages"][0].clone();
    (first["left"], first["steps"]) = (REFUTED["searched"]["from"].clone(), json!(["keep"]));
    twice["stages"].as_array_mut().expect("stages").insert(0, first);
    assert_eq!(refused(&twice), None);
}
