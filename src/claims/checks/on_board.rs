//! The state machine of the experiment on board, every state of it over a lattice of readings and times.

use super::machine::{Defect, Event, INTERVALS_S, LATTICES, Lattice, Machine, SOUND, explore};
use super::{AsPrinted, claim};
use crate::on_board::{Coordinate, Phase};

claim! {
    ON_BOARD_ENDS = "on-board-ends" "of this project" Theorem
    "Whatever the samples, the experiment ends within its time, and until then one more sample may complete it"
    {
        domain: LATTICES,
        printed: AsPrinted::Absent,
        corrected: Some(|_| explore(Defect::None, ends)),
        // Its time over, it begins anew.
        falsified: |_| explore(Defect::Restarts, ends),
        hypotheses: &[],
        depends: &[],
    }
}

fn ends(lattice: &Lattice, machine: &Machine, successors: &[(Event, Machine)]) -> Result<(), Option<usize>> {
    let duration_s = lattice.protocol.duration_s;
    for (index, (event, after)) in successors.iter().enumerate() {
        // A running machine has accepted its sample, which was later than the one before: there are finitely many.
        let later = matches!(event, Event::Sample { .. }) && (after.time_s > machine.time_s || machine.seen.is_none());
        if after.running() && !(later && after.time_s < duration_s) {
            return Err(Some(index));
        }
    }
    let time_left = machine.time_s + INTERVALS_S[0] < duration_s;
    let may_succeed = successors.iter().any(|(_, after)| after.phase() == Phase::Done);
    if machine.running() && time_left && !may_succeed { Err(None) } else { Ok(()) }
}

claim! {
    ON_BOARD_SWITCHES = "on-board-switches" "of this project" Theorem
    "Between two switchings the coordinate moves by both half-widths, at no more than its largest rate: no chattering"
    {
        domain: LATTICES,
        printed: AsPrinted::Absent,
        corrected: Some(|_| explore(Defect::None, switches)),
        // A relay without hysteresis.
        falsified: |_| explore(Defect::NoHysteresis, switches),
        hypotheses: &[],
        depends: &[],
    }
}

fn switches(lattice: &Lattice, machine: &Machine, successors: &[(Event, Machine)]) -> Result<(), Option<usize>> {
    let (protocol, neutral) = (&lattice.protocol, lattice.protocol.neutral_command);
    let Some(before) = machine.position().filter(|_| machine.running()) else { return Ok(()) };
    for (index, (_, after)) in successors.iter().enumerate() {
        let Some(position) = after.position().filter(|_| after.running()) else { continue };
        let up = machine.command < neutral && after.command > neutral;
        let down = machine.command > neutral && after.command < neutral;
        // An upward switching lies beyond one threshold, a downward one beyond the other.
        let crossed = (!up || position <= protocol.reference - machine.half_width())
            && (!down || position >= protocol.reference + machine.half_width());
        // The rate bounds the motion of a coordinate that is measured; a speed's integral moves by the speed.
        let moved = (position - before).abs();
        let measured = protocol.coordinate != Coordinate::Speed;
        let slow = !measured || moved <= protocol.largest_rate * (after.time_s - machine.time_s);
        if !(crossed && slow) {
            return Err(Some(index));
        }
    }
    Ok(())
}

claim! {
    ON_BOARD_ABORT = "on-board-abort" "of this project" Theorem
    "From every state an abort gives the neutral command at once, and nothing but a restart changes that"
    {
        domain: LATTICES,
        printed: AsPrinted::Absent,
        corrected: Some(|_| explore(Defect::None, abort)),
        // Obeyed in the first attempt only.
        falsified: |_| explore(Defect::IgnoresAbort, abort),
        hypotheses: &[],
        depends: &[],
    }
}

fn abort(lattice: &Lattice, machine: &Machine, successors: &[(Event, Machine)]) -> Result<(), Option<usize>> {
    let safe = |after: &Machine| !after.running() && after.command == lattice.protocol.neutral_command;
    let wrong = successors.iter().position(|(event, after)| match event {
        Event::Abort => !safe(after),
        Event::Sample { .. } => machine.phase() == Phase::Aborted && (after.phase() != Phase::Aborted || !safe(after)),
    });
    wrong.map_or(Ok(()), |index| Err(Some(index)))
}

claim! {
    ON_BOARD_LIMITS = "on-board-limits" "of this project" Theorem
    "The command is within its limits in every state, after every change of the relay too, and neutral unless running"
    {
        domain: LATTICES,
        printed: AsPrinted::Absent,
        corrected: Some(|_| explore(Defect::None, limits)),
        // The level raised without regard to the limits.
        falsified: |_| explore(Defect::Unclamped, limits),
        hypotheses: &[],
        depends: &[],
    }
}

fn limits(lattice: &Lattice, machine: &Machine, _: &[(Event, Machine)]) -> Result<(), Option<usize>> {
    let protocol = &lattice.protocol;
    let within = (protocol.lowest_command..=protocol.highest_command).contains(&machine.command);
    let neutral = machine.running() && machine.seen.is_some() || machine.command == protocol.neutral_command;
    if within && neutral { Ok(()) } else { Err(None) }
}

claim! {
    ON_BOARD_FAULTS = "on-board-faults" "of this project" Theorem
    "A sample that a sound sensor and clock cannot have given is a fault by its name, a sound one is none, and faults stay"
    {
        domain: LATTICES,
        printed: AsPrinted::Absent,
        corrected: Some(|_| explore(Defect::None, faults)),
        // Goes on with the next sample after a fault.
        falsified: |_| explore(Defect::Forgives, faults),
        hypotheses: &[],
        depends: &["on-board-limits"],
    }
}

/// Faults of sensor and clock, rather than of the experiment.
const OF_A_SAMPLE: [&str; 5] = ["not-finite", "time-order", "gap", "jump", "stuck"];

fn faults(lattice: &Lattice, machine: &Machine, successors: &[(Event, Machine)]) -> Result<(), Option<usize>> {
    let wrong = successors.iter().position(|(event, after)| {
        let Event::Sample { reading, interval_s, .. } = *event else { return false };
        let found = match after.phase() {
            Phase::Failed(fault) if OF_A_SAMPLE.contains(&fault.code()) => Some(fault.code()),
            _ => None,
        };
        if machine.running() {
            found != expected(lattice, machine, reading, interval_s)
        } else {
            let neutral = after.command == lattice.protocol.neutral_command;
            !(neutral && core::mem::discriminant(&after.phase()) == core::mem::discriminant(&machine.phase()))
        }
    });
    wrong.map_or(Ok(()), |index| Err(Some(index)))
}

/// The fault that a sample is, by the words of the protocol.
fn expected(lattice: &Lattice, machine: &Machine, reading: f64, interval_s: f64) -> Option<&'static str> {
    let protocol = &lattice.protocol;
    let Some((before, since_s)) = machine.seen else { return (!reading.is_finite()).then_some("not-finite") };
    let change = match protocol.coordinate {
        // The short way round.
        Coordinate::HeadingDegrees => 180.0 - ((reading - before).abs() - 180.0).abs(),
        _ => (reading - before).abs(),
    };
    if !(reading.is_finite() && interval_s.is_finite()) {
        Some("not-finite")
    } else if interval_s <= 0.0 {
        Some("time-order")
    } else if !INTERVALS_S[..SOUND].contains(&interval_s) {
        Some("gap")
    } else if change > protocol.largest_rate * interval_s {
        Some("jump")
    } else if change == 0.0 && machine.time_s + interval_s - since_s > protocol.unchanged_s {
        Some("stuck")
    } else {
        None
    }
}
