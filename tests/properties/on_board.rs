//! The experiment on board: the same numbers as the record's, named faults, limits.

use std::cell::Cell;
use std::collections::{BTreeSet, VecDeque};

use proptest::prelude::*;
use selfosc::experiment::Record;
use selfosc::features::RecordFeatures;
use selfosc::identify::DragLaw;
use selfosc::identify::exact::MeanCycle;
use selfosc::identify::iso::Oscillation;
use selfosc::numeric::Scalar;
use selfosc::on_board::{Coordinate, Experiment, Fault, Outcome, Phase, Protocol};
use selfosc::plant::{DragAxis, State};

use crate::tolerance;

const INTERVAL_S: f64 = 0.1;

/// An axis in simulation, one delay of whole samples, seen through a sensor.
struct Pool {
    axis: DragAxis<f64>,
    state: State<f64>,
    pending: VecDeque<f64>,
}

impl Pool {
    fn new(axis: DragAxis<f64>, late: usize) -> Self {
        Self { axis, state: State { position: 0.0, velocity: 0.0 }, pending: std::iter::repeat_n(0.0, late).collect() }
    }

    fn advance(&mut self, command: f64) {
        self.pending.push_back(command);
        let acting = self.pending.pop_front().unwrap();
        self.state = self.axis.advance(self.state, acting, INTERVAL_S);
    }
}

/// What an experiment left behind.
struct Run<T> {
    experiment: Experiment<T>,
    time_s: Vec<f64>,
    position: Vec<f64>,
    command: Vec<f64>,
    /// Sample at which the last attempt began.
    attempt_began: usize,
}

/// Runs until the experiment ends; `sensor` turns the state into a reading.
fn run<T: Scalar>(protocol: Protocol<T>, mut pool: Pool, sensor: impl Fn(f64, &State<f64>) -> f64) -> Run<T> {
    let experiment = Experiment::new(protocol).unwrap();
    let mut run = Run { experiment, time_s: Vec::new(), position: Vec::new(), command: Vec::new(), attempt_began: 0 };
    for sample in 0..20_000 {
        let time_s = INTERVAL_S * f64::from(sample);
        let attempt = run.experiment.attempt();
        let before = run.experiment.command();
        let step = run.experiment.step(T::from_f64(sensor(time_s, &pool.state)), T::from_f64(time_s));
        assert!(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
        // The last command of an experiment that has ended is neutral, and was not the relay's.
        let command = if step.phase == Phase::Running { step.command } else { before };
        run.time_s.push(time_s);
        run.position.push(run.experiment.position().map_or(0.0, Scalar::value));
        run.command.push(command.value());
        if run.experiment.attempt() != attempt {
            run.attempt_began = run.time_s.len();
        }
        if step.phase != Phase::Running {
            assert_eq!(step.command.value(), protocol.neutral_command.value());
            break;
        }
        pool.advance(step.command.value());
    }
    run
}

fn plain(_: f64, state: &State<f64>) -> f64 {
    state.position
}

fn axis(drag: (f64, f64), disturbance: f64) -> DragAxis<f64> {
    DragAxis::mixed(1.0, drag.0, drag.1).unwrap().with_disturbance(disturbance).unwrap()
}

fn protocol() -> Protocol<f64> {
    Protocol::new(Coordinate::Position, 1.0, 0.5, 20.0, INTERVAL_S)
}

fn done<T: Scalar>(run: &Run<T>) -> Outcome<T> {
    run.experiment.outcome().unwrap_or_else(|| panic!("{:?}", run.experiment.phase()))
}

fn fault<T: Scalar>(run: &Run<T>) -> Fault {
    match run.experiment.phase() {
        Phase::Failed(fault) => fault,
        other => panic!("{other:?} after {:?} s", run.time_s.last()),
    }
}

proptest! {
    #![proptest_config(crate::sampling::config(64))]

    /// The last attempt's samples as a record: the same features, and parameters, to the last bit.
    #[test]
    fn the_stream_agrees_with_the_batch(
        linear in 0.1..1.0f64, quadratic in 0.0..1.0f64, disturbance in -0.4..0.4f64, late in 0usize..3,
        quantum in prop_oneof![Just(0.0), 0.01..0.1f64],
    ) {
        let protocol = Protocol { resolution: quantum, ..protocol() };
        let rounded = |_, state: &State<f64>| {
            if quantum > 0.0 { (state.position / quantum).round() * quantum } else { state.position }
        };
        let run = run(protocol, Pool::new(axis((linear, quadratic), disturbance), late), rounded);
        let outcome = done(&run);
        // The relay's own last command: the sample that completes a cycle turns it positive.
        let from = run.attempt_began;
        let mut command = run.command[from..].to_vec();
        *command.last_mut().unwrap() = outcome.relay_level;
        let record = Record::new(run.time_s[from..].to_vec(), run.position[from..].to_vec(), command).unwrap();
        let batch = RecordFeatures::of(&record).unwrap();
        prop_assert_eq!(outcome.features, batch.features);
        prop_assert_eq!(outcome.relay_level, batch.relay.level);
        let delay_s = INTERVAL_S * late as f64;
        let parameters = Oscillation::of(&batch.features, batch.relay.level, delay_s).identify();
        prop_assert_eq!(outcome.iso(delay_s), parameters);
        let cycle = MeanCycle::of(&batch.features, batch.relay.level, delay_s);
        prop_assert_eq!(outcome.exact(DragLaw::Linear, delay_s), cycle.linear_drag());
        prop_assert_eq!(outcome.exact(DragLaw::Quadratic, delay_s), cycle.quadratic_drag());
    }
}

/// A square wave none of whose halves is as long as the one before.
fn irregular(time_s: f64) -> f64 {
    let (mut left, mut half) = (time_s, 0);
    while left > 0.0 {
        half += 1;
        left -= 1.0 + 3.0 * (0.618 * f64::from(half)).fract();
    }
    if half % 2 == 0 { 1.0 } else { -1.0 }
}

/// A reading that noise of this range on either side throws about, evenly spread and the same each time.
fn shaken(range: f64) -> impl Fn(f64, &State<f64>) -> f64 {
    move |time_s, state| {
        let sample = (time_s / INTERVAL_S).round();
        state.position
            + range * (2.0 * (0.618_033_988_75 * sample + 0.5 * (0.414_213_562 * sample).fract()).fract() - 1.0)
    }
}

/// One scenario for each fault, and no fault without one.
#[test]
fn every_fault_has_a_name() {
    let calm = || Pool::new(axis((0.5, 0.0), 0.0), 1);
    let broken =
        |at: f64, what: f64| move |time_s: f64, state: &State<f64>| if time_s >= at { what } else { state.position };
    let mut found = BTreeSet::new();
    let mut expect = |code: &str, run: Run<f64>| {
        assert_eq!(fault(&run).code(), code, "{code}");
        assert!(!fault(&run).to_string().is_empty());
        found.insert(code.to_owned());
    };
    expect("not-finite", run(protocol(), calm(), broken(3.0, f64::NAN)));
    expect("jump", run(protocol(), calm(), broken(3.0, 1e3)));
    expect("stuck", run(protocol(), calm(), broken(0.0, 0.01)));
    // A disturbance that the limits do not allow to overcome.
    let roomy = Protocol { largest_excursion: 1e4, wrong_way: 1e4, ..protocol() };
    expect("no-oscillation", run(roomy, Pool::new(axis((0.5, 0.0), 5.0), 1), plain));
    expect("excursion", run(Protocol { wrong_way: 1e4, ..protocol() }, Pool::new(axis((0.5, 0.0), 5.0), 1), plain));
    // A reversed actuator.
    expect("wrong-way", run(protocol(), calm(), |_, state| -state.position));
    let degrees = Protocol { coordinate: Coordinate::HeadingDegrees, ..protocol() };
    expect("range", run(degrees, calm(), broken(1.0, 1e17)));
    expect(
        "no-motion",
        run(protocol(), calm(), |time_s, _| if (time_s / INTERVAL_S).round() % 2.0 > 0.5 { 0.01 } else { 0.0 }),
    );
    expect("noise", run(Protocol { factor: 1.1, largest_rate: 1e3, ..protocol() }, calm(), shaken(2.0)));
    // Cycles that come as they like.
    let jitter = |time_s: f64, _: &State<f64>| irregular(time_s);
    expect("not-converged", run(Protocol { largest_rate: 1e3, factor: 1.1, ..protocol() }, calm(), jitter));
    // Outliers switch the relay, and the motion does not reach as far: x_a* above X_m.
    let outliers = |time_s: f64, _: &State<f64>| {
        let sample = (time_s / INTERVAL_S).round() as usize % 40;
        let side = if sample < 20 { 1.0 } else { -1.0 };
        side * [1.0, 0.8, 1.01, 0.8, 0.6, 0.3].get(sample % 20).copied().unwrap_or(0.0)
    };
    expect("condition-40", run(Protocol { largest_rate: 1e3, ..protocol() }, calm(), outliers));
    expect("overtime", run(Protocol { duration_s: 21.0, patience_s: 20.5, cycles: 9, ..protocol() }, calm(), plain));
    let mut late = Experiment::new(protocol()).unwrap();
    assert!(matches!(late.step(0.0, 1e15).phase, Phase::Failed(fault) if fault.code() == "coarse-time"));
    found.insert("coarse-time".to_owned());
    for (code, time_s) in [("not-finite", f64::NAN), ("time-order", 0.1), ("time-order", -1.0), ("gap", 9.0)] {
        let mut experiment = Experiment::new(protocol()).unwrap();
        for sample in 0..2 {
            experiment.step(0.01 * f64::from(sample), 0.1 * f64::from(sample));
        }
        let step = experiment.step(0.02, time_s);
        assert!(matches!(step.phase, Phase::Failed(fault) if fault.code() == code), "{:?}", step.phase);
        found.insert(code.to_owned());
    }
    let all = [
        "not-finite",
        "time-order",
        "coarse-time",
        "gap",
        "jump",
        "range",
        "excursion",
        "wrong-way",
        "no-motion",
        "noise",
        "stuck",
        "no-oscillation",
        "not-converged",
        "condition-40",
        "overtime",
    ];
    assert_eq!(found, all.map(str::to_owned).into());
}

#[test]
fn a_protocol_outside_its_domain_is_refused() {
    let good = protocol();
    assert!(Experiment::new(good).is_ok());
    for bad in [
        Protocol { reference: f64::NAN, ..good },
        Protocol { neutral_command: f64::INFINITY, ..good },
        Protocol { lowest_command: f64::NEG_INFINITY, ..good },
        Protocol { highest_command: 0.5, ..good },
        Protocol { neutral_command: 1.5, ..good },
        Protocol { relay_offset: f64::NAN, ..good },
        Protocol { relay_offset: 1.5, ..good },
        // The neutral command lies outside the limits.
        Protocol { relay_offset: 3.0, lowest_command: 1.0, highest_command: 5.0, ..good },
        Protocol { relay_level: 0.0, ..good },
        Protocol { half_width: 0.0, ..good },
        Protocol { largest_excursion: 0.5, ..good },
        Protocol { largest_excursion: f64::INFINITY, ..good },
        Protocol { wrong_way: 0.0, ..good },
        Protocol { dwell_s: -1.0, ..good },
        Protocol { dwell_s: 20.0, ..good },
        Protocol { interval_s: 0.0, ..good },
        Protocol { resolution: -0.1, ..good },
        Protocol { largest_rate: f64::NAN, ..good },
        Protocol { unchanged_s: 20.0, ..good },
        Protocol { unchanged_s: 0.05, ..good },
        Protocol { patience_s: 300.0, ..good },
        Protocol { duration_s: f64::INFINITY, ..good },
        Protocol { cycles: 1, ..good },
        Protocol { most_cycles: 2, ..good },
        Protocol { attempts: 0, ..good },
        Protocol { spread: 0.0, ..good },
        Protocol { factor: 1.0, ..good },
    ] {
        let refusal = Experiment::new(bad).unwrap_err();
        assert!(refusal.to_string().contains(refusal.quantity), "{bad:?}");
    }
}

/// What a vehicle needs more of, it gets, within its limits.
#[test]
fn attempts_change_the_relay() {
    // The disturbance is above the first level and below the second, which the limits cut.
    let strong = Pool::new(axis((0.5, 0.0), 1.1), 1);
    let raised =
        run(Protocol { highest_command: 1.4, lowest_command: -3.0, patience_s: 15.0, ..protocol() }, strong, plain);
    let outcome = done(&raised);
    assert_eq!((outcome.attempts, outcome.relay_level, outcome.half_width), (2, 1.4, 0.5));
    // A ripple on the sensor makes the relay switch as it likes until its hysteresis is wider.
    let ripple = |time_s: f64, state: &State<f64>| state.position + 0.2 * irregular(5.0 * time_s);
    let narrow = Protocol { half_width: 0.15, largest_rate: 1e3, spread: 0.3, factor: 2.0, attempts: 6, ..protocol() };
    let outcome = done(&run(narrow, Pool::new(axis((0.5, 0.0), 0.0), 1), ripple));
    assert!(outcome.attempts > 1 && outcome.half_width > 0.15, "{outcome:?}");
}

/// A relay that is off or full on swings a vehicle under a constant force as one about zero does without; off again when it ends.
#[test]
fn levels_about_an_offset_are_a_constant_force() {
    let heater = Protocol { relay_offset: 1.0, lowest_command: 0.0, ..protocol() };
    // The neutral command is no level, and lies on one side of both.
    let pump = Protocol { relay_offset: 3.0, lowest_command: 0.0, highest_command: 4.0, ..protocol() };
    let [symmetric, shifted, one_sided] = [(protocol(), 0.0), (heater, 1.0), (pump, 3.0)]
        .map(|(protocol, offset)| run(protocol, Pool::new(axis((0.5, 0.0), 0.1 - offset), 0), plain));
    assert!(shifted.command.iter().all(|command| [0.0, 2.0].contains(command)));
    assert!(one_sided.command.iter().all(|command| [2.0, 4.0].contains(command)));
    let [about_zero, off_or_on, on_one_side] =
        [symmetric, shifted, one_sided].map(|run| done(&run).exact(DragLaw::Linear, 0.5 * INTERVAL_S).unwrap());
    for of in [DragAxis::alpha, DragAxis::linear_drag, DragAxis::disturbance] {
        approx::assert_relative_eq!(of(&on_one_side), of(&about_zero), max_relative = tolerance::AXIS_INTEGRATION);
        approx::assert_relative_eq!(of(&off_or_on), of(&about_zero), max_relative = tolerance::AXIS_INTEGRATION);
    }
}

#[test]
fn an_end_is_an_end_until_a_restart() {
    let mut experiment = Experiment::new(Protocol { neutral_command: 0.25, ..protocol() }).unwrap();
    assert_eq!((experiment.command(), experiment.position(), experiment.outcome()), (0.25, None, None));
    assert_eq!(experiment.step(-1.0, 0.0).command, 1.25);
    experiment.abort();
    assert_eq!((experiment.phase(), experiment.command()), (Phase::Aborted, 0.25));
    assert_eq!(experiment.step(f64::NAN, 0.1).phase, Phase::Aborted);
    experiment.restart().unwrap();
    assert_eq!(experiment.step(1.0, 7.0).command, -0.75);
    assert!(matches!(experiment.step(1.0, 6.0).phase, Phase::Failed(Fault::TimeOrder { .. })));
    experiment.abort();
    assert!(matches!(experiment.phase(), Phase::Failed(Fault::TimeOrder { .. })));
}

/// Every sequence of seven samples out of eight, broken ones among them, through the whole machine.
#[test]
fn no_sequence_of_samples_leaves_the_limits() {
    const SAMPLES: [(f64, f64); 8] = [
        (0.0, 0.1),
        (0.6, 0.1),
        (-0.6, 0.1),
        (-0.6, 0.3),
        (f64::NAN, 0.1),
        (f64::INFINITY, 0.1),
        (1e9, 0.1),
        (0.6, 0.0),
    ];
    fn go(experiment: &Experiment<f64>, protocol: &Protocol<f64>, time_s: f64, left: u32) -> u32 {
        let mut ends = 0;
        for (reading, interval_s) in SAMPLES {
            let (mut next, time_s) = (*experiment, time_s + interval_s);
            let step = next.step(reading, time_s);
            assert!(step.command >= protocol.lowest_command && step.command <= protocol.highest_command);
            if step.phase == Phase::Running {
                ends += if left == 0 { 1 } else { go(&next, protocol, time_s, left - 1) };
            } else {
                let after = next.step(0.0, time_s + 0.1);
                assert_eq!(
                    (after.command, format!("{:?}", after.phase)),
                    (protocol.neutral_command, format!("{:?}", step.phase))
                );
                assert_eq!(step.command, protocol.neutral_command);
                ends += 1;
            }
        }
        ends
    }
    let protocol = Protocol { neutral_command: 0.5, cycles: 2, most_cycles: 2, ..protocol() };
    let ends = go(&Experiment::new(protocol).unwrap(), &protocol, 0.0, 6);
    assert!(ends > 10_000, "{ends}");
}

/// How a heading experiment of 0.02 N m ended whose compass of one degree froze, toggling by that degree: code of the fault, time from
/// then on in s, largest command, the way of the vehicle from its reference in degrees. The vehicle is of this test, by Euler's rule.
fn toggling<T: Scalar>(freezes_s: f64) -> (&'static str, f64, f64, f64) {
    let number = T::from_f64;
    let plain = Protocol::heading_degrees(number(0.02), number(15.0), number(0.05));
    let protocol = Protocol { resolution: T::one(), largest_rate: number(90.0), ..plain };
    let mut experiment = Experiment::new(protocol).unwrap();
    let (mut heading, mut rate_rad_s, mut held) = (0.0_f64, 0.0_f64, None);
    let (mut largest, mut farthest) = (0.0_f64, 0.0_f64);
    for sample in 0..6000 {
        let time_s = 0.05 * f64::from(sample);
        let read = (heading + 0.5).floor();
        let held = if time_s < freezes_s { None } else { Some(*held.get_or_insert(read)) };
        let reading = held.map_or(read, |at| at + f64::from(sample % 2)) % 360.0;
        let step = experiment.step(number(reading), number(time_s));
        if let Phase::Failed(fault) = step.phase {
            return (fault.code(), time_s - freezes_s, largest, farthest);
        }
        let command = step.command.value();
        largest = largest.max(command.abs());
        for _ in 0..50 {
            rate_rad_s += 0.001 * (command - 0.017 * rate_rad_s * rate_rad_s.abs()) / 0.04;
            heading += 0.001 * rate_rad_s.to_degrees();
        }
        farthest = farthest.max(heading.abs());
    }
    panic!("no end");
}

/// A heading that froze raised the level and turned the vehicle by 2570 degrees.
#[test]
fn a_toggling_compass_raises_no_level() {
    let bound = |patience_s: f64| 90.0 + 90.0 * (2.0 * patience_s + 3.0 * 0.05);
    for tenths in 40..300_u32 {
        let freezes_s = 0.1 * f64::from(tenths);
        for (code, after_s, largest, farthest) in [toggling::<f64>(freezes_s), toggling::<f32>(freezes_s)] {
            assert!(code == "no-motion" && largest <= 0.020_001, "{freezes_s}: {code}, {largest}");
            // Half-periods are of 3.7 s; three have passed after 13 s.
            let patience_s = if freezes_s < 13.0 { 20.0 } else { 4.0 * 3.9 };
            assert!(
                after_s <= 2.0 * patience_s + 0.2 && farthest <= bound(patience_s),
                "{freezes_s}: {after_s} s, {farthest}"
            );
        }
    }
    // Before, 2568 and 2572 degrees.
    assert!(toggling::<f64>(8.0).3 < 1150.0 && toggling::<f32>(8.0).3 < 1150.0);
    assert!(toggling::<f64>(20.0).3 < 850.0 && toggling::<f32>(20.0).3 < 850.0);
}

/// A clock since power-up, three days on: in f32 its numbers are 1/32 s apart.
#[test]
fn a_clock_too_far_on_is_refused_with_the_remedy() {
    let first = |time_s: f32| {
        let protocol = Protocol::new(Coordinate::Position, 1f32, 0.5, 20.0, 0.01);
        Experiment::new(protocol).unwrap().step(0.0, time_s).phase
    };
    let Phase::Failed(fault) = first(72.0 * 3600.0) else { panic!("not refused") };
    assert_eq!(fault.code(), "coarse-time");
    assert!(fault.to_string().contains("since the start of the experiment"), "{fault}");
    // Numbers from 2^13 s on are 1/1024 s apart, from 2^14 s on 1/512 s: an eighth of the interval lies between. 300 s are to come.
    assert_eq!(first(16_384.0 - 301.0), Phase::Running);
    assert!(matches!(first(16_384.0 - 299.0), Phase::Failed(Fault::CoarseTime { .. })));
    let wide = Protocol::new(Coordinate::Position, 1.0, 0.5, 20.0, 0.01);
    assert_eq!(Experiment::new(wide).unwrap().step(0.0, 72.0 * 3600.0).phase, Phase::Running);
}

proptest! {
    #![proptest_config(crate::sampling::config(256))]

    /// Any bits at all for readings and times.
    #[test]
    fn no_sample_panics(samples in proptest::collection::vec((any::<f64>(), any::<f64>()), 1..20), coordinate in 0usize..4) {
        let kinds = [Coordinate::Position, Coordinate::HeadingRad, Coordinate::HeadingDegrees, Coordinate::Speed];
        let protocol = Protocol { coordinate: kinds[coordinate], largest_rate: f64::MAX, ..protocol() };
        let mut wide = Experiment::new(protocol).unwrap();
        let mut narrow = Experiment::new(Protocol::new(kinds[coordinate], 1f32, 0.5, 20.0, 0.1)).unwrap();
        for (sample, (reading, time_s)) in samples.iter().enumerate() {
            // Every other time is a sound one, so that the readings are looked at.
            let time_s = if sample % 2 == 0 { *time_s } else { 0.1 * sample as f64 };
            prop_assert!(wide.step(*reading, 0.1 * sample as f64).command.abs() <= 2.0);
            prop_assert!(narrow.step(*reading as f32, time_s as f32).command.abs() <= 2.0);
        }
    }

    /// A coarse sensor stays at one value for long; it is not stuck.
    #[test]
    fn a_coarse_sensor_is_not_stuck(share in 0.05..0.9f64, linear in 0.2..1.0f64, disturbance in -0.3..0.3f64) {
        let quantum = 0.5 * share;
        let coarse = |_, state: &State<f64>| (state.position / quantum).round() * quantum;
        let protocol = Protocol { resolution: quantum, spread: 0.3, ..protocol() };
        let run = run(protocol, Pool::new(axis((linear, 0.3), disturbance), 1), coarse);
        prop_assert_eq!(run.experiment.phase(), Phase::Done);
    }

    /// A heading that jumps by whole turns is the plain number; a speed is what it is the speed of.
    #[test]
    fn the_kind_of_coordinate_does_not_matter(linear in 0.2..1.0f64, disturbance in -0.3..0.3f64, reference in -720.0..720.0f64) {
        let pool = || Pool::new(axis((linear, 0.3), disturbance), 1);
        let wrapped = |turn: f64| move |_: f64, state: &State<f64>| {
            let heading = reference + state.position;
            heading - turn * (heading / turn).round()
        };
        let expected = done(&run(protocol(), pool(), plain)).features;
        let degrees = Protocol { coordinate: Coordinate::HeadingDegrees, reference, ..protocol() };
        let radians = Protocol { coordinate: Coordinate::HeadingRad, reference, ..protocol() };
        for found in [
            done(&run(degrees, pool(), wrapped(360.0))).features,
            done(&run(radians, pool(), wrapped(core::f64::consts::TAU))).features,
        ] {
            prop_assert_eq!(found.cycles, expected.cycles);
            prop_assert!((found.amplitude.mean - expected.amplitude.mean).abs() < tolerance::WRAPPED);
            prop_assert!((found.bias.mean - expected.bias.mean).abs() < tolerance::WRAPPED);
            prop_assert_eq!(found.period_s, expected.period_s);
        }
        // Against its integral by trapezoids.
        let speed = Protocol { coordinate: Coordinate::Speed, ..protocol() };
        let integral = Cell::new((0.0, 0.0));
        let integrated = |_, state: &State<f64>| {
            let (before, sum) = integral.get();
            integral.set((state.velocity, sum + 0.5 * (before + state.velocity) * INTERVAL_S));
            integral.get().1
        };
        let found = done(&run(speed, pool(), |_, state| state.velocity)).features;
        let expected = done(&run(protocol(), pool(), integrated)).features;
        prop_assert!((found.amplitude.mean - expected.amplitude.mean).abs() < tolerance::WRAPPED);
        prop_assert_eq!(found.period_s, expected.period_s);
    }

    /// Single precision sees the same cycles.
    #[test]
    fn single_precision_agrees(linear in 0.2..1.0f64, disturbance in -0.3..0.3f64) {
        let pool = || Pool::new(axis((linear, 0.3), disturbance), 1);
        let wide = done(&run(protocol(), pool(), plain));
        let protocol = Protocol::new(Coordinate::Position, 1f32, 0.5, 20.0, INTERVAL_S as f32);
        let narrow = done(&run(protocol, pool(), plain));
        for law in [DragLaw::Linear, DragLaw::Quadratic] {
            let (wide, narrow) = (wide.exact(law, 0.1).unwrap(), narrow.exact(law, 0.1).unwrap());
            prop_assert!((f64::from(narrow.alpha()) / wide.alpha() - 1.0).abs() < tolerance::SINGLE_EXPERIMENT);
        }
    }

    /// What is identified on board from a dense record is the axis.
    #[test]
    fn the_axis_is_found(drag in 0.2..1.0f64, disturbance in -0.3..0.3f64, quadratic: bool) {
        let law = if quadratic { DragLaw::Quadratic } else { DragLaw::Linear };
        let axis = axis(if quadratic { (0.0, drag) } else { (drag, 0.0) }, disturbance);
        let found = done(&run(protocol(), Pool::new(axis, 2), plain)).exact(law, 0.2).unwrap();
        prop_assert!((found.alpha() - 1.0).abs() < tolerance::SLOW_MODEL, "{found:?}");
        let [was, is] = [&axis, &found].map(|axis| axis.linear_drag() + axis.quadratic_drag());
        prop_assert!((is / was - 1.0).abs() < 3.0 * tolerance::SLOW_MODEL, "{found:?}");
        prop_assert!((found.disturbance() - disturbance).abs() < tolerance::SLOW_MODEL, "{found:?}");
    }
}

/// What a run did to its vehicle: the fault, the largest true excursion, how long it drove, the largest command, and the shortest
/// time between two switchings.
struct Harm {
    code: &'static str,
    excursion: f64,
    drove_s: f64,
    strongest: f64,
    shortest_s: f64,
}

/// A plant by the sign of its actuator, seen through a sensor, under an experiment in either precision.
fn harm<T: Scalar>(protocol: Protocol<f64>, sign: f64, sensor: impl Fn(f64, &State<f64>) -> f64) -> Harm {
    let number = T::from_f64;
    let protocol = Protocol {
        resolution: number(protocol.resolution),
        largest_rate: number(protocol.largest_rate),
        factor: number(protocol.factor),
        ..Protocol::new(
            protocol.coordinate,
            number(protocol.relay_level),
            number(protocol.half_width),
            number(protocol.largest_excursion),
            number(protocol.interval_s),
        )
    };
    let mut experiment = Experiment::new(protocol).unwrap();
    let mut pool = Pool::new(axis((0.5, 0.0), 0.0), 1);
    let mut harm = Harm { code: "none", excursion: 0.0, drove_s: 0.0, strongest: 0.0, shortest_s: f64::INFINITY };
    let (mut switched_s, mut before) = (None, 0.0);
    for sample in 0..10_000 {
        let time_s = INTERVAL_S * f64::from(sample);
        let step = experiment.step(number(sensor(time_s, &pool.state)), number(time_s));
        let command = step.command.value();
        if let Phase::Failed(fault) = step.phase {
            harm.code = fault.code();
            assert_eq!(command, 0.0);
            break;
        }
        if command * before < 0.0 {
            harm.shortest_s = switched_s.map_or(harm.shortest_s, |at_s| harm.shortest_s.min(time_s - at_s));
            switched_s = Some(time_s);
        }
        before = command;
        pool.advance(sign * command);
        harm.drove_s = time_s;
        harm.strongest = harm.strongest.max(command.abs());
        harm.excursion = harm.excursion.max(pool.state.position.abs());
    }
    harm
}

/// What a fault may do before it has a name, in single and in double precision.
#[test]
fn a_fault_is_named_before_it_does_harm() {
    fn all<T: Scalar>() {
        let calm = Protocol::new(Coordinate::Position, 1.0, 0.5, 3.0, INTERVAL_S);
        let reversed = harm::<T>(calm, -1.0, plain);
        // Two half-widths, and a little for the delay; at the first level.
        assert_eq!(reversed.code, "wrong-way");
        assert!(
            reversed.excursion < 1.5 && reversed.drove_s < 5.0 && reversed.strongest == 1.0,
            "{}",
            reversed.excursion
        );

        let toggling =
            harm::<T>(calm, 1.0, |time_s, _| if (time_s / INTERVAL_S).round() % 2.0 > 0.5 { 0.01 } else { 0.0 });
        assert_eq!(toggling.code, "no-motion");
        // The patience, and never at a higher level.
        assert!(toggling.drove_s < 20.2 && toggling.strongest == 1.0);

        let noisy =
            harm::<T>(Protocol { largest_rate: 1e3, largest_excursion: 20.0, factor: 1.1, ..calm }, 1.0, shaken(2.0));
        assert_eq!(noisy.code, "noise");
        // Not sooner than the dwell of four intervals, and never at a higher level.
        assert!(noisy.shortest_s > 3.9 * INTERVAL_S && noisy.strongest == 1.0, "{}", noisy.shortest_s);
        assert!(noisy.excursion < 20.0 && noisy.drove_s < 60.0);
    }
    all::<f32>();
    all::<f64>();
}

/// Headings that no vehicle has, at the defaults.
#[test]
fn absurd_headings_are_refused() {
    fn refused<T: Scalar>() {
        let number = T::from_f64;
        for (protocol, turn) in [
            (Protocol::<T>::heading_rad(number(0.1), number(0.2), number(0.05)), core::f64::consts::TAU),
            (Protocol::heading_degrees(number(0.1), number(15.0), number(0.05)), 360.0),
        ] {
            for (reading, code) in [
                (1e17, "range"),
                (-1e30, "range"),
                (100.5 * turn, "range"),
                (170.0 / 360.0 * turn, "jump"),
                (10.0 / 360.0 * turn, "jump"),
            ] {
                let mut experiment = Experiment::new(protocol).unwrap();
                let first = experiment.step(number(0.0), number(0.0));
                assert_eq!((first.phase, first.command), (Phase::Running, number(0.1)));
                let step = experiment.step(number(reading), number(0.05));
                assert!(matches!(step.phase, Phase::Failed(fault) if fault.code() == code), "{reading} {step:?}");
                assert_eq!(step.command, T::zero());
            }
            // At once, where the first reading is astray, and for a start beyond a quarter turn.
            for (reading, code) in [(1e17, "range"), (100.0 / 360.0 * turn, "excursion")] {
                let step = Experiment::new(protocol).unwrap().step(number(reading), number(0.0));
                assert!(matches!(step.phase, Phase::Failed(fault) if fault.code() == code), "{reading} {step:?}");
            }
        }
    }
    refused::<f32>();
    refused::<f64>();
}

/// A timer beside a driver that blocks ends the command within the longest gap.
#[test]
fn a_blocked_driver_is_noticed_by_the_clock() {
    fn noticed<T: Scalar>() {
        let number = T::from_f64;
        let protocol = Protocol::new(Coordinate::Position, number(1.0), number(0.5), number(3.0), number(0.125));
        let fresh = Experiment::new(protocol).unwrap();
        let mut waiting = fresh;
        assert_eq!((waiting.tick(number(9.0)).command, waiting.phase()), (T::zero(), Phase::Running));
        let mut driven = fresh;
        assert_eq!(driven.step(number(0.0), number(1.0)).command, number(1.0));
        for (ticks, code) in
            [(vec![1.0, 1.25, 1.5, 1.501], "gap"), (vec![f64::NAN], "not-finite"), (vec![0.9], "time-order")]
        {
            let mut experiment = driven;
            let (last, sound) = ticks.split_last().unwrap();
            for time_s in sound {
                assert_eq!(experiment.tick(number(*time_s)).command, number(1.0));
            }
            let step = experiment.tick(number(*last));
            assert!(matches!(step.phase, Phase::Failed(fault) if fault.code() == code), "{step:?}");
            assert_eq!((step.command, experiment.step(number(0.0), number(1.125)).command), (T::zero(), T::zero()));
        }
        // Sound ticks change nothing.
        let mut ticked = driven;
        ticked.tick(number(1.1));
        assert_eq!(ticked.step(number(0.1), number(1.125)), driven.step(number(0.1), number(1.125)));
    }
    noticed::<f32>();
    noticed::<f64>();
}
