//! The transition function over intervals of everything that it depends on: no lattice, no plant.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use super::*;
use crate::numeric::rounded::order::{Compared, every_outcome};
use crate::numeric::rounded::{Double, Rounded};
use crate::numeric::{Interval, Real};
use crate::on_board::Coordinate;

type Number = Compared<Double>;

fn between(lower: f64, upper: f64) -> Number {
    Compared(Rounded::input(Interval::new(lower, upper).unwrap()))
}

/// Whoever looks at the cycles says what it likes.
struct Any(Observation);

impl Observer<Number> for Any {
    fn begin(&mut self, _: &Protocol<Number>) {}
    fn sample(&mut self, _: &Protocol<Number>, _: Number, _: Number, _: Number) -> Observation {
        self.0
    }
}

const OBSERVATIONS: [Observation; 4] =
    [Observation::Between, Observation::Unsteady, Observation::Steady, Observation::Condition40];
const NEUTRAL: f64 = 0.25;

/// Running, with any numbers at all where a number is remembered, about a reference of zero; the relay is high or low.
fn running(largest_excursion: f64, high: bool, switched: bool, started: bool) -> Supervisor<Number> {
    let any = between(-1e6, 1e6);
    let protocol = Protocol {
        neutral_command: between(NEUTRAL, NEUTRAL),
        relay_offset: between(-1.0, 1.0),
        lowest_command: between(-8.0, -4.0),
        highest_command: between(4.0, 8.0),
        wrong_way: between(0.1, 10.0),
        dwell_s: between(0.0, 1.0),
        resolution: between(0.0, 1.0),
        largest_rate: between(0.1, 1e6),
        unchanged_s: between(1.0, 10.0),
        patience_s: between(10.0, 100.0),
        duration_s: between(100.0, 1e4),
        ..Protocol::new(
            Coordinate::Position,
            between(0.5, 2.0),
            between(0.1, 0.5),
            between(largest_excursion, largest_excursion),
            between(0.01, 1.0),
        )
    };
    let relay = protocol.relay(protocol.relay_level, protocol.half_width).unwrap();
    Supervisor {
        protocol,
        phase: Phase::Running,
        relay,
        high,
        sensor: SensorState { time_s: any, reading: any, position: any, changed_s: any },
        begun: started,
        started_s: any,
        switched_s: any,
        switchings: if switched { SEEN } else { 0 },
        farthest: any,
        anchor: any,
        moved_s: any,
        half_periods_s: (any, any),
        attempt: 1,
        cycles: 0,
        early: 0,
        hasty: false,
    }
}

/// Whether after such a reading, at any time, the command is neutral whatever was before, and stays so upon anything that follows; `None`
/// where there are too many ways to tell.
fn is_neutral_after(reading: Number, largest_excursion: f64) -> Option<bool> {
    let (any, neutral) = (between(-1e300, 1e300), Interval::point(NEUTRAL).bounds());
    let mut all = true;
    for case in 0..8_u8 {
        let of = |bit: u8| case & bit != 0;
        for observation in OBSERVATIONS {
            let ways = every_outcome(|| {
                let (mut supervisor, mut observer) =
                    (running(largest_excursion, of(1), of(2), of(4)), Any(observation));
                let first = supervisor.step(reading, any, &mut observer);
                let neutral = |step: Step<Number>| step.command.bounds() == neutral;
                // Only what is neutral has to stay so.
                neutral(first)
                    && neutral(supervisor.step(any, any, &mut observer))
                    && neutral(supervisor.tick(any))
                    && first.phase != Phase::Running
            })?;
            all &= ways.into_iter().all(|neutral| neutral);
        }
    }
    Some(all)
}

#[test]
fn beyond_the_largest_excursion_the_command_is_neutral() {
    let beyond = 1.0_f64.next_up();
    assert_eq!(is_neutral_after(between(beyond, 1e300), 1.0), Some(true));
    assert_eq!(is_neutral_after(between(-1e300, -beyond), 1.0), Some(true));
    // Not so of what is at the limit, and of a limit further out.
    assert_eq!(is_neutral_after(between(1.0, 1e300), 1.0), Some(false));
    assert_eq!(is_neutral_after(between(beyond, 1e300), 1.5), Some(false));
}
