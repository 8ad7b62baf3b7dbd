//! Certificates are accepted as they are written, and refused with anything changed.

use std::sync::LazyLock;

use super::super::tests::{record, settings};
use super::super::{BoundedModel, Consistency, DelayBound, enclose_with_certificate};
use super::{By, Certificate, Combination, Stage, Step, Unproved};
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
                Step::Contract { cuts, .. } | Step::Turn { cuts, .. } => {
                    cuts.iter_mut().map(|cut| &mut cut.rows).find(|rows| rows.len() > 1)
                }
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
        let first = Stage { left: Some(left), steps: vec![Step::Keep], ..REFUTED.stages[0].clone() };
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
fn a_window_that_starts_before_its_commands_are_known_is_refused() {
    let mut early = REFUTED.clone();
    early.stages[0].windows[0][1] = 0;
    assert_eq!(refused(&early), "malformed");
    let mut parted = CONSISTENT.clone();
    parted.stages[0].windows[1][1] += 1;
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

/// Steps that turn the box, by their numbers.
fn turns(certificate: &Certificate) -> Vec<usize> {
    let steps = certificate.stages[0].steps.iter().enumerate();
    steps.filter(|(_, step)| matches!(step, Step::Turn { .. })).map(|(number, _)| number).collect()
}

fn with_step(number: usize, step: Step) -> Certificate {
    let mut other = CONSISTENT.clone();
    other.stages[0].steps[number] = step;
    other
}

#[test]
fn a_coordinate_that_is_said_to_be_narrower_than_its_rows_show_is_refused() {
    let (mut refused, mut changed) = (0, 0);
    for number in turns(&CONSISTENT) {
        let mut step = CONSISTENT.stages[0].steps[number].clone();
        let Step::Turn { cuts, .. } = &mut step else { continue };
        let Some(pair) = cuts.windows(2).position(|pair| pair[0].unknown == pair[1].unknown) else { continue };
        cuts[pair].end = 0.6 * cuts[pair].end + 0.4 * cuts[pair + 1].end;
        changed += 1;
        refused += usize::from(with_step(number, step).check().is_err());
    }
    assert!(changed > 0 && refused == changed, "{refused} of {changed}");
}

#[test]
fn a_frame_that_is_none_or_nothing_known_is_refused() {
    let number = turns(&CONSISTENT)[0];
    let Step::Turn { by, frame: Some(axes), cuts } = CONSISTENT.stages[0].steps[number].clone() else {
        panic!("the first turn leads into a frame")
    };
    let mut square = axes.clone();
    square.lower[0].push(0.5);
    let mut short = axes.clone();
    short.centre.pop();
    let mut endless = axes.clone();
    endless.lower[1][0] = f64::INFINITY;
    for frame in [Some(square), Some(short), Some(endless), None] {
        // Into its own frame a box may be turned that has one.
        let step = Step::Turn { by, frame: frame.clone(), cuts: cuts.clone() };
        assert_eq!(refused(&with_step(number, step)), "step", "{frame:?}");
    }
    for by in [By::Chain(1), By::Slanted(0), By::Hats(1)] {
        let step = Step::Turn { by, frame: Some(axes.clone()), cuts: cuts.clone() };
        assert_eq!(refused(&with_step(number, step)), "step", "{by:?}");
    }
    let steps = &CONSISTENT.stages[0].steps;
    let first = steps.iter().position(|step| matches!(step, Step::Contract { by: By::Slanted(_), .. })).expect("one");
    let Step::Contract { cuts, .. } = steps[first].clone() else { panic!("it contracts") };
    assert_eq!(refused(&with_step(first, Step::Contract { by: By::Same, cuts })), "step");
}

#[test]
fn a_part_without_a_frame_or_outside_of_its_range_is_refused() {
    let insert = |number: usize, coordinate: usize, at: f64| {
        let mut other = CONSISTENT.clone();
        other.stages[0].steps.insert(number, Step::Part { coordinate, at });
        other
    };
    assert_eq!(refused(&insert(0, 0, 0.0)), "step");
    let after = turns(&CONSISTENT)[0] + 1;
    for (coordinate, at) in [(0, 1e9), (0, f64::NAN), (99, 0.0)] {
        assert_eq!(refused(&insert(after, coordinate, at)), "step", "{coordinate} {at}");
    }
    // A part that is left over.
    assert_ne!(insert(after, 0, 0.0).check().map_err(|unproved| unproved.code()).err(), None);
}
