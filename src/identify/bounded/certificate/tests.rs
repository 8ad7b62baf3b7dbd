//! Certificates are accepted as they are written, and refused with anything changed.

use std::sync::LazyLock;

use super::super::tests::{record, settings};
use super::super::{BoundedModel, Consistency, DelayBound, enclose_with_certificate};
use super::format::{Certificate, Combination, ProofStage, Step};
use super::unproved::Unproved;
use crate::identify::DragLaw;

fn written(model: &BoundedModel, verdict: Consistency) -> Certificate {
    let (bounds, certificate) = enclose_with_certificate(&[&record(300)], model).expect("bounds");
    assert_eq!(bounds.verdict, verdict);
    certificate.expect("a proof")
}

static CONSISTENT: LazyLock<Certificate> =
    LazyLock::new(|| written(&settings(DragLaw::Linear), Consistency::Consistent));

/// By a delay that is not the vehicle's.
static REFUTED: LazyLock<Certificate> = LazyLock::new(|| {
    let late = BoundedModel { delay: DelayBound::KnownS(0.15), ..settings(DragLaw::Linear) };
    written(&late, Consistency::Refuted)
});

fn both() -> [&'static Certificate; 2] {
    [&CONSISTENT, &REFUTED]
}

fn refused(certificate: &Certificate) -> &'static str {
    certificate.check().map_or_else(|unproved| unproved.code(), |shown| panic!("accepted: {shown:?}"))
}

#[test]
fn what_is_written_is_accepted_and_read_back() {
    for certificate in both() {
        let read = Certificate::read(&certificate.to_string()).expect("a certificate");
        assert_eq!(read, *certificate);
        let shown = read.check().expect("accepted");
        assert!(shown.enclosures > 0 && shown.readings == 300);
        assert_eq!(shown.left.is_empty(), read.stages[0].left.is_none());
        assert!(read.agrees(&[record(300)]).is_ok() && read.agrees(&[record(299)]).is_err());
    }
}

/// Every step's first combination, one at a time: how many are refused when changed, and how many there are. What says less than its
/// rows show may do with fewer, and what is accepted is then shown by the rest.
fn each_changed(change: impl Fn(&mut Combination)) -> (usize, usize) {
    let (mut refused, mut changed) = (0, 0);
    for certificate in both() {
        for step in 0..certificate.stages[0].steps.len() {
            let mut other = certificate.clone();
            let rows = match &mut other.stages[0].steps[step] {
                Step::Contract { cuts, .. } => cuts.iter_mut().map(|cut| &mut cut.rows).find(|rows| rows.len() > 1),
                Step::Exclude { rows, .. } => Some(rows).filter(|rows| rows.len() > 1),
                _ => None,
            };
            let Some(rows) = rows else { continue };
            change(rows);
            changed += 1;
            if let Err(unproved) = other.check() {
                assert_eq!(unproved.code(), "step");
                refused += 1;
            }
        }
    }
    (refused, changed)
}

fn heaviest(rows: &Combination) -> usize {
    (0..rows.len()).max_by(|a, b| rows[*a].1.total_cmp(&rows[*b].1)).unwrap_or(0)
}

#[test]
fn one_constraint_dropped_or_one_multiplier_altered_is_refused() {
    let changes: [fn(&mut Combination); 3] = [
        |rows| {
            rows.remove(heaviest(rows));
        },
        |rows| {
            let heaviest = heaviest(rows);
            rows[heaviest].1 *= 3.0;
        },
        |rows| {
            let heaviest = heaviest(rows);
            rows[heaviest].1 *= -1.0;
        },
    ];
    for change in changes {
        let (refused, changed) = each_changed(change);
        assert!(changed > 5 && 10 * refused >= 8 * changed, "{refused} of {changed} refused");
    }
}

#[test]
fn boxes_left_out_or_made_smaller_are_refused() {
    for certificate in both() {
        let mut shorter = certificate.clone();
        shorter.stages[0].steps.pop();
        assert_eq!(refused(&shorter), "incomplete");
        let mut longer = certificate.clone();
        longer.stages[0].steps.push(Step::Keep);
        assert_eq!(refused(&longer), "incomplete");
        let mut without = certificate.clone();
        without.stages.clear();
        without.statement = REFUTED.statement.clone();
        assert_eq!(refused(&without), "malformed");
    }
    let mut narrower = CONSISTENT.clone();
    let left = narrower.stages[0].left.as_mut().expect("a box");
    left[0][1] = 0.5 * (left[0][0] + left[0][1]);
    assert_eq!(refused(&narrower), "step");
    let mut refuted = CONSISTENT.clone();
    refuted.stages[0].left = None;
    refuted.statement = REFUTED.statement.clone();
    assert_eq!(refused(&refuted), "step");
}

/// A stage begins with what the one before left, and with no more than was searched.
#[test]
fn a_stage_that_begins_elsewhere_is_refused() {
    let whole = |left: Vec<[f64; 2]>| {
        let mut mixed = REFUTED.clone();
        let first = ProofStage { left: Some(left), steps: vec![Step::Keep], ..REFUTED.stages[0].clone() };
        mixed.stages.insert(0, first);
        mixed
    };
    let from = &REFUTED.searched.from;
    assert!(whole(from.clone()).check().is_ok());
    let mut wider = from.clone();
    wider[0][1] *= 2.0;
    assert_eq!(refused(&whole(wider)), "malformed");
    let mut nothing = whole(from.clone());
    nothing.stages[0].left = None;
    assert_eq!(refused(&nothing), "malformed");
}

#[test]
fn a_shooting_interval_that_starts_before_its_commands_are_known_is_refused() {
    let mut early = REFUTED.clone();
    early.stages[0].shooting[0][1] = 0;
    assert_eq!(refused(&early), "malformed");
    let mut parted = CONSISTENT.clone();
    parted.stages[0].shooting[1][1] += 1;
    assert_eq!(refused(&parted), "malformed");
}

#[test]
fn a_witness_that_misses_a_reading_and_words_that_say_more_are_refused() {
    let mut missing = CONSISTENT.clone();
    missing.witness.as_mut().expect("a witness").values[1] *= 1.05;
    assert_eq!(refused(&missing), "witness");
    let mut boast = CONSISTENT.clone();
    boast.statement = REFUTED.statement.clone();
    assert_eq!(refused(&boast), "statement");
    assert!(matches!(Certificate::read("{}"), Err(Unproved::Foreign { .. })));
}
