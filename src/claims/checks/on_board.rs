//! The state machine of the experiment on board, every state of it over a lattice of readings and times.

use super::claim;
use super::machine::{
    Defect, INTERVALS_S, LATTICES, Lattice, Machine, MachineEvent, Property, SOUND, WITH_COARSE, explore,
};
use crate::on_board::{Coordinate, Observation, Phase, Protocol};

/// A property of every state of the machine, and a defect that takes it away.
macro_rules! explored {
    ($constant:ident = $id:literal $statement:literal $property:expr, over $lattices:ident, but not $defect:ident) => {
        claim! {
            $constant = $id Theorem $statement {
                corrected: Some(|_| explore($lattices, Defect::None, $property)),
                falsified: |_| explore($lattices, Defect::$defect, $property),
            }
        }
    };
}

explored! {
    ON_BOARD_ENDS = "on-board-ends"
    "Whatever the samples, the experiment ends within its time, and until that or its patience is over one more sample may complete it"
    Property { state: may_succeed, step: in_time }, over LATTICES, but not Restarts
}

/// A running machine has accepted its sample, which was later than the sample before: there are finitely many.
fn in_time(lattice: &Lattice, machine: &Machine, event: MachineEvent, after: &Machine) -> bool {
    let (duration_s, first) = (lattice.protocol.duration_s, machine.seen.is_none());
    let in_time = match event {
        MachineEvent::Tick { age_s } => first || machine.time_s + age_s < duration_s,
        MachineEvent::Sample { .. } => (after.time_s > machine.time_s || first) && after.time_s < duration_s,
        MachineEvent::Abort => false,
    };
    in_time || !after.running()
}

fn may_succeed(lattice: &Lattice, machine: &Machine, successors: &[(MachineEvent, Machine)]) -> bool {
    let next_s = machine.time_s + INTERVALS_S[0];
    let time_left = next_s < lattice.protocol.duration_s && !machine.motion.still(&lattice.protocol, next_s);
    let succeeds = |(_, after): &(MachineEvent, Machine)| after.supervisor.phase() == Phase::Done;
    !machine.running() || !time_left || successors.iter().any(succeeds)
}

explored! {
    ON_BOARD_SWITCHES = "on-board-switches"
    "Two switchings are the least dwell apart and both half-widths, crossed at no more than the largest rate: no chattering"
    Property::step(switches), over LATTICES, but not NoHysteresis
}

fn switches(lattice: &Lattice, machine: &Machine, _: MachineEvent, after: &Machine) -> bool {
    let (protocol, neutral) = (&lattice.protocol, lattice.protocol.neutral_command);
    let at = |machine: &Machine| machine.supervisor.position().filter(|_| machine.running());
    let (Some(before), Some(position)) = (at(machine), at(after)) else { return true };
    let up = machine.command < neutral && after.command > neutral;
    let down = machine.command > neutral && after.command < neutral;
    // An upward switching lies beyond the upper threshold, a downward switching beyond the lower.
    let half_width = machine.supervisor.half_width();
    let crossed =
        (!up || position <= protocol.reference - half_width) && (!down || position >= protocol.reference + half_width);
    // The rate bounds the motion of a coordinate that is measured; a speed's integral moves by the speed.
    let measured = protocol.coordinate != Coordinate::Speed;
    let slow = (position - before).abs() <= protocol.largest_rate * (after.time_s - machine.time_s);
    let dwelt = machine.supervisor.switched_s().is_none_or(|since_s| after.time_s - since_s >= protocol.dwell_s);
    crossed && (slow || !measured) && (dwelt || !(up || down))
}

explored! {
    ON_BOARD_ABORT = "on-board-abort"
    "From every state an abort gives the neutral command at once, and nothing but a restart changes that"
    Property::step(abort), over LATTICES, but not IgnoresAbort
}

fn abort(lattice: &Lattice, machine: &Machine, event: MachineEvent, after: &Machine) -> bool {
    let safe = !after.running() && after.command == lattice.protocol.neutral_command;
    let aborted = |machine: &Machine| machine.supervisor.phase() == Phase::Aborted;
    match event {
        MachineEvent::Abort => safe,
        _ => !aborted(machine) || aborted(after) && safe,
    }
}

explored! {
    ON_BOARD_LIMITS = "on-board-limits"
    "The command is within its limits in every state, after every change of the relay too, and neutral unless running"
    Property { state: limits, step: |_, _, _, _| true }, over LATTICES, but not Unclamped
}

fn limits(lattice: &Lattice, machine: &Machine, _: &[(MachineEvent, Machine)]) -> bool {
    let protocol = &lattice.protocol;
    let within = (protocol.lowest_command..=protocol.highest_command).contains(&machine.command);
    within && (machine.running() && machine.seen.is_some() || machine.command == protocol.neutral_command)
}

explored! {
    ON_BOARD_FAULTS = "on-board-faults"
    "A sample that a sound sensor and clock cannot have given is a fault by its name, a sound one is none, and faults stay"
    Property::step(faults), over LATTICES, but not Forgives
}

/// Faults of sensor and clock, rather than of the experiment.
const OF_A_SAMPLE: [&str; 7] = ["not-finite", "time-order", "gap", "jump", "stuck", "excursion", "wrong-way"];

fn faults(lattice: &Lattice, machine: &Machine, event: MachineEvent, after: &Machine) -> bool {
    let (phase, before) = (after.supervisor.phase(), machine.supervisor.phase());
    let expected = match event {
        MachineEvent::Sample { reading, interval_s, .. } => expected(lattice, machine, reading, interval_s),
        MachineEvent::Tick { age_s } => expected_of_time(machine, age_s),
        MachineEvent::Abort => return true,
    };
    let found = match phase {
        Phase::Failed(fault) if OF_A_SAMPLE.contains(&fault.code()) => Some(fault.code()),
        _ => None,
    };
    let stays = core::mem::discriminant(&phase) == core::mem::discriminant(&before);
    if machine.running() { found == expected } else { after.command == lattice.protocol.neutral_command && stays }
}

/// The fault that a sample is, by the words of the protocol.
fn expected(lattice: &Lattice, machine: &Machine, reading: f64, interval_s: f64) -> Option<&'static str> {
    let protocol = &lattice.protocol;
    let far = |position: f64| (position - protocol.reference).abs() > protocol.largest_excursion;
    // The short way round.
    let round = |way: f64| 180.0 - (180.0 - way).rem_euclid(360.0);
    let (Some((before, since_s)), Some(position)) = (machine.seen, machine.supervisor.position()) else {
        let first = match protocol.coordinate {
            Coordinate::Speed => 0.0,
            Coordinate::HeadingDegrees => round(reading),
            _ => reading,
        };
        return if !reading.is_finite() { Some("not-finite") } else { far(first).then_some("excursion") };
    };
    if !reading.is_finite() {
        return Some("not-finite");
    }
    if let Some(late) = expected_of_time(machine, interval_s) {
        return Some(late);
    }
    if interval_s == 0.0 {
        return Some("time-order");
    }
    let (change, next) = match protocol.coordinate {
        Coordinate::HeadingDegrees => (round(reading - before), position + round(reading - before)),
        Coordinate::Speed => (reading - before, position + interval_s * (reading + before) / 2.0),
        _ => (reading - before, reading),
    };
    let back = match machine.supervisor.farthest() {
        Some(highest) if machine.command > protocol.neutral_command => highest - next,
        Some(lowest) => next - lowest,
        None => 0.0,
    };
    if change.abs() > protocol.largest_rate * interval_s {
        Some("jump")
    } else if change == 0.0 && machine.time_s + interval_s - since_s > protocol.unchanged_s {
        Some("stuck")
    } else if far(next) {
        Some("excursion")
    } else {
        (back > protocol.wrong_way).then_some("wrong-way")
    }
}

/// The fault that the time since the last sample is.
fn expected_of_time(machine: &Machine, age_s: f64) -> Option<&'static str> {
    if machine.seen.is_none() {
        None
    } else if !age_s.is_finite() {
        Some("not-finite")
    } else if age_s < 0.0 {
        Some("time-order")
    } else {
        (age_s > 0.0 && !INTERVALS_S[..SOUND].contains(&age_s)).then_some("gap")
    }
}

explored! {
    ON_BOARD_STILL = "on-board-still"
    "Readings that go nowhere for the patience end the experiment, and no level is raised upon them for want of a switching"
    Property::step(still), over WITH_COARSE, but not Restless
}

fn still(lattice: &Lattice, machine: &Machine, event: MachineEvent, after: &Machine) -> bool {
    let (MachineEvent::Sample { observation, .. }, Some(position)) = (event, after.supervisor.position()) else {
        return true;
    };
    if machine.seen.is_none() || !machine.running() {
        return true;
    }
    let protocol = &lattice.protocol;
    let level = |machine: &Machine| (machine.command - protocol.neutral_command).abs();
    let gone = machine.motion.gone(protocol, machine.supervisor.half_width(), position);
    let late = !gone && machine.motion.still(protocol, after.time_s);
    let named = matches!(after.supervisor.phase(), Phase::Failed(fault) if fault.code() == "no-motion");
    // A cycle that ends here may have too small an amplitude.
    let raised = after.running() && level(after) > level(machine);
    !(named && !late || after.running() && late || raised && !gone && observation != Observation::Condition40)
}

explored! {
    ON_BOARD_EXCURSION = "on-board-excursion"
    "Whatever plant and sensor say, the relay drives no further than the largest excursion and one gap at the largest rate"
    Property { state: within, step: within_a_gap }, over LATTICES, but not Boundless
}

fn drives(lattice: &Lattice, machine: &Machine) -> bool {
    machine.command != lattice.protocol.neutral_command
}

/// Every sequence of readings comes, those of a plant of the wrong sign, a stuck or a late plant, and a sensor that
/// wanders too. The coordinate is the reading: a wandering sensor adds its error.
fn within(lattice: &Lattice, machine: &Machine, _: &[(MachineEvent, Machine)]) -> bool {
    let protocol = &lattice.protocol;
    let within = |position: f64| (position - protocol.reference).abs() <= protocol.largest_excursion;
    !drives(lattice, machine) || machine.supervisor.position().is_some_and(within)
}

/// Between samples it is driven for no longer than a gap: a tick or a sample that comes later ends it.
fn within_a_gap(lattice: &Lattice, machine: &Machine, event: MachineEvent, after: &Machine) -> bool {
    let longest_s = Protocol::<f64>::LONGEST_GAP * lattice.protocol.interval_s;
    !drives(lattice, after)
        || match event {
            MachineEvent::Sample { interval_s: age_s, .. } | MachineEvent::Tick { age_s } => {
                machine.seen.is_none() || age_s <= longest_s
            }
            MachineEvent::Abort => false,
        }
}
