//! Steps of experiments and controllers upon readings and clocks of all bit patterns: no panic, no command beyond its limits, and
//! a neutral one after an end. Experiments under a sensor that freezes or toggles: no higher level, and the vehicle no further than
//! `spec/claims/on-board-still.md` says.
//!
//! `cargo run --release --example fuzz_on_board -- STEPS SEED`; without arguments a million steps from seed 1. The longest run so
//! far is recorded in `fixtures/fuzz_on_board.txt`.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use std::ops::ControlFlow;

use selfosc::control::{Controller, Gains, Structure};
use selfosc::numeric::Scalar;
use selfosc::on_board::{Coordinate, Experiment, Phase, Protocol};

/// Splitmix64 (Steele, Lea and Flood, 2014): every bit pattern comes.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, count: u64) -> u64 {
        self.bits() % count
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// Any f64, or any f32.
    fn any(&mut self) -> f64 {
        let bits = self.bits();
        if bits & 1 == 0 { f64::from_bits(self.bits()) } else { f64::from(f32::from_bits((bits >> 32) as u32)) }
    }
}

/// What was seen, so that a run that looks at nothing shows.
#[derive(Debug, Default)]
pub struct Seen {
    /// Steps of experiments and controllers.
    pub steps: u64,
    /// Steps under a command that drives.
    pub driven: u64,
    /// Experiments begun.
    pub experiments: u64,
    /// Experiments that came to their end.
    pub done: u64,
    /// Controllers begun.
    pub controllers: u64,
    /// Experiments that ended in each fault.
    pub faults: std::collections::BTreeMap<&'static str, u64>,
    /// Experiments under a sensor that froze while they ran, by how they ended.
    pub frozen: std::collections::BTreeMap<&'static str, u64>,
    /// How many of them had seen enough half-periods to be less patient.
    pub hastened: u64,
    /// Largest distance of the vehicle from its reference against the bound, over them.
    pub nearest_to_bound: f64,
}

fn protocol<T: Scalar>(random: &mut Random) -> Protocol<T> {
    let kinds = [Coordinate::Position, Coordinate::HeadingRad, Coordinate::HeadingDegrees, Coordinate::Speed];
    let coordinate = kinds[random.below(4) as usize];
    let number = T::from_f64;
    let half_width = if coordinate == Coordinate::HeadingDegrees { 15.0 } else { 0.3 };
    let largest_excursion = half_width * random.between(1.5, 20.0);
    let neutral = random.between(-0.5, 0.5);
    let protocol = Protocol::new(coordinate, number(1.0), number(half_width), number(largest_excursion), number(0.1));
    Protocol {
        neutral_command: number(neutral),
        lowest_command: number(neutral - 1.0 - random.between(0.0, 2.0)),
        highest_command: number(neutral + 1.0 + random.between(0.0, 2.0)),
        resolution: number([0.0, 0.01, 0.1][random.below(3) as usize] * half_width),
        largest_rate: number([1.0, 1.0, 1e3][random.below(3) as usize]) * protocol.largest_rate,
        cycles: 2 + random.below(3) as u8,
        attempts: 1 + random.below(5) as u8,
        ..protocol
    }
}

/// One experiment to its end and a little beyond.
fn experiment<T: Scalar>(random: &mut Random, seen: &mut Seen) {
    let protocol = protocol::<T>(random);
    let number = T::from_f64;
    let Ok(mut experiment) = Experiment::new(protocol) else { return };
    seen.experiments += 1;
    // Mostly a plant, so that the experiment goes far, now and then whatever bits.
    let (gain, noise) = (random.between(-1.0, 3.0), random.between(0.0, 2.0));
    let wild = [0, 50, 1000][random.below(3) as usize];
    let scale = protocol.half_width.value();
    let (mut position, mut velocity, mut time_s) = (0.0, 0.0, random.between(-10.0, 10.0));
    let mut ended: Option<Phase> = None;
    let mut left = 20;
    let mut last_good_s = None;
    for _ in 0..4000 {
        time_s += random.between(0.05, 0.15);
        let strikes = |random: &mut Random| wild > 0 && random.below(wild) == 0;
        let plain = if protocol.coordinate == Coordinate::Speed { velocity } else { position };
        let reading = if strikes(random) { random.any() } else { plain + noise * scale * random.between(-1.0, 1.0) };
        let at_s = if strikes(random) { random.any() } else { time_s };
        let tick = random.below(10) == 0;
        let step = if tick { experiment.tick(number(at_s)) } else { experiment.step(number(reading), number(at_s)) };
        seen.steps += 1;
        let command = step.command;
        assert!(command >= protocol.lowest_command && command <= protocol.highest_command, "{protocol:?} {step:?}");
        assert_eq!(command.value(), experiment.command().value());
        if step.phase == Phase::Running {
            assert!(ended.is_none());
            if command != protocol.neutral_command {
                seen.driven += 1;
                let away = experiment.position().map(|x| (x - protocol.reference).abs());
                assert!(away.is_some_and(|away| away <= protocol.largest_excursion), "{protocol:?} at {away:?}");
                let age_s = number(at_s) - last_good_s.unwrap_or(number(at_s));
                assert!(age_s <= number(4.0) * protocol.interval_s, "{protocol:?} after {age_s:?} s");
            }
            if !tick {
                last_good_s = Some(number(at_s));
            }
        } else {
            assert_eq!(command.value(), protocol.neutral_command.value(), "{protocol:?} {step:?}");
            let first = *ended.get_or_insert(step.phase);
            // A fault may hold a number that is none, which equals nothing: compare what is shown.
            assert_eq!(format!("{first:?}"), format!("{:?}", step.phase));
            left -= 1;
            if left == 0 {
                break;
            }
        }
        let force = gain * (command.value() - protocol.neutral_command.value());
        velocity += 0.1 * (scale * force - 0.4 * velocity);
        position += 0.1 * velocity;
    }
    match ended {
        Some(Phase::Failed(fault)) => *seen.faults.entry(fault.code()).or_default() += 1,
        Some(Phase::Done) => {
            seen.done += 1;
            assert!(experiment.outcome().is_some());
        }
        _ => {}
    }
}

/// How a sensor fails.
#[derive(Clone, Copy)]
enum Frozen {
    /// It shows one reading for ever.
    Still,
    /// It goes to and fro with every sample.
    Toggling,
    /// The same, now and then.
    Seldom,
    /// It wanders over all of a range.
    Wandering,
}

/// Half-periods of a relay as whoever stands beside sees them.
#[derive(Default)]
struct Swings {
    switched_s: Option<f64>,
    ended_s: Vec<f64>,
    wider: f64,
}

impl Swings {
    fn switch(&mut self, time_s: f64) {
        self.ended_s.extend(self.switched_s.map(|since_s| time_s - since_s));
        self.switched_s = Some(time_s);
    }

    /// Four of the longest, the last left out, once one of either sign is known.
    fn patience_s(&self, planned_s: f64) -> f64 {
        match self.ended_s.split_last() {
            Some((_, before @ [_, _, ..])) => {
                let longest_s = before.iter().copied().fold(0.0, f64::max);
                planned_s.min(4.0 * longest_s * self.wider)
            }
            _ => planned_s,
        }
    }
}

/// An experiment on a vehicle whose sensor freezes within a range of less than a half-width.
fn frozen<T: Scalar>(random: &mut Random, seen: &mut Seen) {
    let number = T::from_f64;
    let coordinate =
        [Coordinate::Position, Coordinate::HeadingRad, Coordinate::HeadingDegrees][random.below(3) as usize];
    let half_width = if coordinate == Coordinate::HeadingDegrees { 10.0 } else { 0.2 };
    let (largest_excursion, interval_s) = (half_width * random.between(2.0, 9.0), 0.1);
    let plain =
        Protocol::new(coordinate, number(1.0), number(half_width), number(largest_excursion), number(interval_s));
    let protocol = Protocol {
        resolution: number([0.0, 0.01, 0.1][random.below(3) as usize] * half_width),
        cycles: 200,
        most_cycles: if random.below(3) == 0 { 4 } else { 250 },
        ..plain
    };
    let Ok(mut experiment) = Experiment::new(protocol) else { return };
    // Terminal speed at the highest level and a disturbance: below the largest rate.
    let rate = protocol.largest_rate.value();
    let (speed, drift, lag_s) =
        (rate * random.between(0.05, 0.4), rate * random.between(-0.15, 0.15), random.between(0.2, 2.0));
    let freezes_s = random.between(0.0, 60.0);
    let kind = [Frozen::Still, Frozen::Toggling, Frozen::Seldom, Frozen::Wandering][random.below(4) as usize];
    // The narrowest relay of three attempts has 4/9 of the half-width.
    let range = half_width * random.between(0.0, 0.44);
    let mut held = None;
    let (mut swings, mut level) = (Swings { wider: 1.0, ..Swings::default() }, 0.0);
    let (mut position, mut velocity, mut attempt) = (0.0, 0.0, 1);
    let (mut farthest, mut before): (f64, Option<f64>) = (0.0, None);
    let (mut way, mut raised) = ((0.0, 0.0), 0);
    for sample in 0..4000_u32 {
        let time_s = interval_s * f64::from(sample);
        let (sound, offset) = (held.is_none(), random.between(0.0, range));
        let reading = match (held, kind) {
            (None, _) if time_s < freezes_s => position,
            (None, _) => *held.insert(position),
            (Some(at), Frozen::Still) => at,
            (Some(at), Frozen::Toggling) => at + range * f64::from(sample % 2),
            (Some(at), Frozen::Seldom) => at + if random.below(40) == 0 { range } else { 0.0 },
            (Some(at), Frozen::Wandering) => at + offset,
        };
        let step = experiment.step(number(reading), number(time_s));
        seen.steps += 1;
        if step.phase != Phase::Running {
            let code = if let Phase::Failed(fault) = step.phase { fault.code() } else { "done" };
            if held.is_some() {
                *seen.frozen.entry(code).or_default() += 1;
            }
            break;
        }
        let command = step.command.value();
        let switched = before.is_some_and(|before: f64| before * command < 0.0);
        if experiment.attempt() != attempt && command.abs() <= level {
            swings.wider *= protocol.factor.value();
        }
        // A level is raised at a switching, where a cycle ends, or where the readings have gone somewhere since the last: of a frozen
        // sensor, away from the last that was true, once.
        way = if switched { (reading, reading) } else { (reading.min(way.0), reading.max(way.1)) };
        if before.is_some() && !switched && command.abs() > level {
            assert!(way.1 - way.0 >= 0.4999 * half_width, "{protocol:?} frozen at {freezes_s} s, raised at {time_s} s");
            raised += u8::from(!sound);
            assert!(raised <= 1, "{protocol:?} frozen at {freezes_s} s, raised again at {time_s} s");
        }
        (attempt, level, before) = (experiment.attempt(), command.abs(), Some(command));
        if switched {
            swings.switch(time_s);
        }
        for _ in 0..10 {
            velocity += 0.1 * interval_s * (speed * command + drift - velocity) / lag_s;
            position += 0.1 * interval_s * velocity;
        }
        assert!(velocity.abs() <= rate);
        if held.is_some() {
            farthest = farthest.max(position.abs());
        }
    }
    let patience_s = swings.patience_s(protocol.patience_s.value());
    let bound = largest_excursion + rate * (2.0 * patience_s + 3.0 * interval_s);
    assert!(farthest <= bound, "{protocol:?} frozen at {freezes_s} s went {farthest}, bound {bound}");
    if held.is_some() {
        seen.hastened += u64::from(patience_s < protocol.patience_s.value());
        seen.nearest_to_bound = seen.nearest_to_bound.max(farthest / bound);
    }
}

/// A controller for a hundred steps.
fn controller<T: Scalar>(random: &mut Random, seen: &mut Seen) -> ControlFlow<()> {
    let number = T::from_f64;
    let structures = [Structure::Pd, Structure::Pid, Structure::Ipd];
    let structure = structures[random.below(3) as usize];
    let mut gain = |plain: f64| if random.below(4) == 0 { random.any().abs() } else { plain };
    let integral = if structure == Structure::Pd { 0.0 } else { gain(0.3) };
    let gains = Gains::new(structure, number(gain(1.0)), number(integral), number(gain(0.5)), number(gain(0.1)));
    let Ok(gains) = gains else { return ControlFlow::Continue(()) };
    let (low, high) = (random.between(-2.0, 0.0), random.between(0.1, 2.0));
    let Ok(limited) = Controller::new(&gains).with_limits(number(low), number(high)) else {
        return ControlFlow::Continue(());
    };
    let hold_s = random.between(0.0, 3.0);
    let Ok(held) = limited.with_longest_hold(number(hold_s), number(0.05)) else { return ControlFlow::Break(()) };
    let mut controller = if random.below(2) == 0 { held } else { limited };
    if random.below(2) == 0 {
        controller = controller.on_circle(number(core::f64::consts::TAU)).unwrap_or(controller);
    }
    seen.controllers += 1;
    for _ in 0..100 {
        let mut either = |plain: f64| if random.below(5) == 0 { random.any() } else { plain };
        let (reference, dt_s) = (either(1.0), either(0.1));
        let measurement = either(0.5);
        let step = controller.step(number(reference), number(measurement), number(dt_s));
        seen.steps += 1;
        assert!(step.command >= number(low) && step.command <= number(high), "{controller:?} {step:?}");
    }
    ControlFlow::Continue(())
}

/// A run of at least so many steps; what was seen.
pub fn run(steps: u64, seed: u64) -> Seen {
    let (mut random, mut seen) = (Random(seed), Seen::default());
    while seen.steps < steps {
        experiment::<f64>(&mut random, &mut seen);
        experiment::<f32>(&mut random, &mut seen);
        frozen::<f64>(&mut random, &mut seen);
        frozen::<f32>(&mut random, &mut seen);
        for _ in 0..4 {
            let held = controller::<f64>(&mut random, &mut seen).is_continue();
            assert!(held && controller::<f32>(&mut random, &mut seen).is_continue(), "a hold was refused");
        }
    }
    seen
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut argument = |default| arguments.next().map_or(Ok(default), |text| text.parse());
    let (steps, seed) = (argument(1_000_000)?, argument(1)?);
    println!("seed {seed}: {:#?}", run(steps, seed));
    Ok(())
}
