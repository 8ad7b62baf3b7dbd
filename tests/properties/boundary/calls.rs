//! One call of each function with numbers that the probe draws, and what its page says of the answer.

use selfosc::autotune::{FirstOrderProcess, ProcessReadings};
use selfosc::control::{
    Controller, FeedForward, FrequencyPoint, Gains, OpenLoop, RelayTest, RobustCriterion, Rule, Structure, Tuning,
    UltimatePoint,
};
use selfosc::describing::{ClosedForm, DescribingFunction};
use selfosc::experiment::RelayState;
use selfosc::features::{Cycle, Cycles, Features, Summary};
use selfosc::identify::DragLaw;
use selfosc::identify::exact::MeanCycle;
use selfosc::identify::iso::{self, Oscillation};
use selfosc::nonlinearity::{
    Absolute, Affine, Arctan, Backlash, Branch, Catalogued, Characteristic, Custom, DeadZone, DeadZoneSaturation,
    GainChanging, Polyline, Polynomial, Power, Preload, Quantizer, Relay, RelayDeadZone, RelayDeadZoneHysteresis,
    RelayHysteresis, Saturation, SaturationAsymmetric, Sine, Sinh, Sinusoid, Tanh,
};
use selfosc::numeric::{Scalar, Special};
use selfosc::on_board::{Coordinate, Experiment, Phase, Protocol};
use selfosc::orbit::limit_cycle;
use selfosc::plant::{DragAxis, State};
use selfosc::vehicle::{Allocation, BilinearThruster, Compensation, ThrustSide, Thruster};

use super::{Draw, Probe};

/// One of each.
pub(super) fn every<T: Scalar + Special>(probe: &mut Probe) {
    characteristics::<T>(probe);
    affine::<T>(probe);
    describing::<T>(probe);
    plant::<T>(probe);
    orbit::<T>(probe);
    features::<T>(probe);
    identify::<T>(probe);
    on_board::<T>(probe);
    thrusters::<T>(probe);
    allocation::<T>(probe);
    gains::<T>(probe);
    tuning::<T>(probe);
    controller::<T>(probe);
    ultimate::<T>(probe);
    process::<T>(probe);
}

fn sweep<T: Scalar>(probe: &mut Probe) -> Option<Sinusoid<T>> {
    let (bias, amplitude) = (if probe.random.below(2) == 0 { T::zero() } else { probe.any() }, probe.given());
    let sweep = probe.result("Sinusoid::new", Sinusoid::new(bias, amplitude))?;
    let said = (bias, amplitude);
    probe.note("Sinusoid::new", &[sweep.bias(), sweep.amplitude()], sweep.amplitude() > T::zero(), &said);
    probe.note("Sinusoid::bias", &[sweep.bias()], true, &said);
    probe.note("Sinusoid::amplitude", &[sweep.amplitude()], true, &said);
    probe.formula("Sinusoid::maximum", &[sweep.maximum()], &said);
    probe.formula("Sinusoid::minimum", &[sweep.minimum()], &said);
    Some(sweep)
}

/// A characteristic's output and describing function on a sweep.
fn on_a_sweep<T: Scalar, C: ClosedForm<Number = T> + core::fmt::Debug>(probe: &mut Probe, characteristic: &C) {
    let Some(sweep) = sweep::<T>(probe) else { return };
    let said = (characteristic, sweep);
    if let Some(df) = probe.result("ClosedForm::describing_function", characteristic.describing_function(&sweep)) {
        probe.note("ClosedForm::describing_function", &[df.f0, df.p, df.q], true, &said);
    }
    let _ = probe.result("Characteristic::admits", characteristic.admits(&sweep));
    if characteristic.admits(&sweep).is_ok() {
        probe.note::<T>("Characteristic::admits", &[], true, &said);
        let x = sweep.bias() + sweep.amplitude() * T::from_f64(probe.random.between(-1.0, 1.0));
        // The sinh leaves the range of f32 at an argument of 89, with scales of up to a thousand here.
        let near = x.abs() <= T::from_f64(0.08);
        for branch in [Branch::Rising, Branch::Falling] {
            let output = characteristic.output(x, branch, &sweep);
            probe.formula(
                "Characteristic::output",
                if near { core::slice::from_ref(&output) } else { &[] },
                &(x, said),
            );
        }
    }
    probe.note::<T>(
        "Characteristic::has_memory",
        &[],
        characteristic.has_memory() || !characteristic.has_memory(),
        &said,
    );
}

fn characteristics<T: Scalar + Special>(probe: &mut Probe) {
    let values: [T; 12] = core::array::from_fn(|_| probe.given());
    macro_rules! each {
        ($($type:ident),+ $(,)?) => { $({
            let count = <$type<T> as Catalogued<T>>::PARAMETERS.len();
            if let Some(built) = probe.result("Catalogued::from_values", <$type<T>>::from_values(&values[..count])) {
                probe.note::<T>("Catalogued::from_values", &[], true, &built);
                on_a_sweep(probe, &built);
            }
            // Values that are missing are no numbers.
            assert!(<$type<T>>::from_values(&values[..count - 1]).is_err());
        })+ };
    }
    each!(
        Relay,
        RelayDeadZone,
        RelayHysteresis,
        RelayDeadZoneHysteresis,
        Saturation,
        SaturationAsymmetric,
        DeadZone,
        DeadZoneSaturation,
        GainChanging,
        Preload,
        Quantizer,
        Power,
        Sine,
        Sinh,
        Arctan,
        Tanh,
        Absolute,
        Backlash,
    );
    if let Some(built) = probe.result("Polynomial::new", Polynomial::<T, 10>::new(core::array::from_fn(|i| values[i])))
    {
        probe.note("Polynomial::new", built.coefficients(), true, &built);
        probe.note("Polynomial::coefficients", built.coefficients(), true, &built);
        on_a_sweep(probe, &built);
    }
    let mut at = -values[0];
    let points: [(T, T); 4] = core::array::from_fn(|i| {
        at = at + values[i + 1];
        (at, values[i + 5])
    });
    let built = Polyline::new(points, values[9], values[10]);
    if let Some(built) = probe.result("Polyline::new", built) {
        probe.note("Polyline::new", &[built.left_slope(), built.right_slope()], true, &built);
        probe.note("Polyline::left_slope", &[built.left_slope()], true, &built);
        probe.note("Polyline::right_slope", &[built.right_slope()], true, &built);
        let numbers: Vec<T> = built.points().iter().flat_map(|(x, y)| [*x, *y]).collect();
        probe.note("Polyline::points", &numbers, true, &built);
        on_a_sweep(probe, &built);
    }
    if let Some(built) = probe.result("Polyline::measured", Polyline::measured(points)) {
        probe.note("Polyline::measured", &[built.left_slope(), built.right_slope()], true, &points);
    }
    let kinks = [T::zero()];
    let custom = Custom::new(|x: T, _| x.abs(), &kinks);
    probe.note(
        "Custom::new",
        &[custom.output(T::one(), Branch::Rising, &Sinusoid::new(T::zero(), T::one()).unwrap())],
        true,
        &(),
    );
}

fn affine<T: Scalar + Special>(probe: &mut Probe) {
    let [a, b, c, d]: [T; 4] = core::array::from_fn(|_| probe.given());
    let plain = Affine::of(RelayHysteresis::new(T::one(), T::from_f64(0.1), T::zero()).unwrap());
    for (name, built) in [
        ("Affine::of", plain),
        ("Affine::scaled", plain.scaled(a)),
        ("Affine::offset", plain.offset(b)),
        ("Affine::shifted", plain.shifted(c)),
    ] {
        let (input, output, offset) = built.gains();
        probe.formula(name, &[input, output, offset], &(a, b, c));
        probe.formula("Affine::gains", &[input, output, offset], &built);
        probe.note("Affine::inner", &[built.inner().level()], true, &());
    }
    if let Some(built) = probe.result("Affine::after_gain", plain.shifted(c).after_gain(d)) {
        probe.formula("Affine::after_gain", &[built.gains().0], &d);
        on_a_sweep(probe, &built.scaled(a).offset(b));
        if let Some(sweep) = sweep(probe)
            && let Some(inner) = probe.result("Affine::inner_sweep", built.inner_sweep(&sweep))
        {
            probe.note("Affine::inner_sweep", &[inner.bias(), inner.amplitude()], true, &(built, sweep));
        }
    }
}

fn describing<T: Scalar>(probe: &mut Probe) {
    let df = DescribingFunction { f0: probe.any::<T>(), p: probe.any(), q: probe.any() };
    let phase = probe.any();
    let turned = df.delayed(phase);
    probe.formula("DescribingFunction::delayed", &[turned.f0, turned.p, turned.q], &(df, phase));
    let zero = DescribingFunction::<T>::zero();
    probe.note("DescribingFunction::zero", &[zero.f0, zero.p, zero.q], true, &());
}

fn axis<T: Scalar>(probe: &mut Probe) -> Option<DragAxis<T>> {
    let (alpha, linear, quadratic) = (probe.given(), probe.perhaps(), probe.perhaps());
    let axis = probe.result("DragAxis::mixed", DragAxis::mixed(alpha, linear, quadratic))?;
    let (disturbance, delay_s) = (if probe.random.below(2) == 0 { T::zero() } else { probe.any() }, probe.perhaps());
    let axis = probe.result("DragAxis::with_disturbance", axis.with_disturbance(disturbance))?;
    let axis = probe.result("DragAxis::with_delay_s", axis.with_delay_s(delay_s))?;
    let numbers = [axis.alpha(), axis.linear_drag(), axis.quadratic_drag(), axis.disturbance(), axis.delay_s()];
    let sound = numbers[0] > T::zero() && numbers[1] >= T::zero() && numbers[2] >= T::zero() && numbers[4] >= T::zero();
    for name in [
        "DragAxis::mixed",
        "DragAxis::with_disturbance",
        "DragAxis::with_delay_s",
        "DragAxis::alpha",
        "DragAxis::linear_drag",
        "DragAxis::quadratic_drag",
        "DragAxis::disturbance",
        "DragAxis::delay_s",
    ] {
        probe.note(name, &numbers, sound, &axis);
    }
    Some(axis)
}

fn plant<T: Scalar>(probe: &mut Probe) {
    let [alpha, drag]: [T; 2] = core::array::from_fn(|_| probe.given());
    let pair = [
        ("DragAxis::linear", DragAxis::linear(alpha, drag)),
        ("DragAxis::quadratic", DragAxis::quadratic(alpha, drag)),
    ];
    for (name, built) in pair {
        if let Some(built) = probe.result(name, built) {
            probe.note(name, &[built.alpha(), built.linear_drag(), built.quadratic_drag()], true, &built);
        }
    }
    let Some(axis) = axis::<T>(probe) else { return };
    let (state, input, time_s, level) =
        (State { position: probe.any::<T>(), velocity: probe.any() }, probe.any(), probe.size(), probe.any());
    let said = (axis, state, input, time_s, level);
    let next = axis.advance(state, input, time_s);
    probe.formula("DragAxis::advance", &[next.position, next.velocity], &said);
    let way = axis.one_way(input);
    probe.formula("DragAxis::one_way", &[way.drive, way.linear, way.quadratic], &said);
    probe.formula("DragAxis::time_to_rest", axis.time_to_rest(state, input).as_slice(), &said);
    probe.formula("DragAxis::time_to_position", axis.time_to_position(state, input, level).as_slice(), &said);
}

fn orbit<T: Scalar>(probe: &mut Probe) {
    let Some(axis) = axis::<T>(probe) else { return };
    let Ok(relay) = RelayHysteresis::new(probe.given(), probe.perhaps(), T::zero()) else { return };
    if let Some(cycle) = probe.result("limit_cycle", limit_cycle(&axis, &relay)) {
        let (zero, one) = (T::zero(), T::one());
        let switches = [cycle.upper_switch, cycle.lower_switch].map(|switch| [switch.position, switch.velocity]);
        let positive = [cycle.amplitude, cycle.period_s, cycle.time_positive_s, cycle.time_negative_s];
        let sound = positive.iter().all(|value| *value > zero) && cycle.multiplier >= zero && cycle.multiplier <= one;
        probe.note("limit_cycle", switches.as_flattened(), true, &(axis, relay));
        probe.note("limit_cycle", &[cycle.bias, cycle.maximum, cycle.minimum, cycle.multiplier], true, &(axis, relay));
        probe.note("limit_cycle", &positive, sound, &(axis, relay));
    }
    let mut state = RelayState::new(relay, false);
    let input = probe.any();
    let before = state.output();
    let after = state.step(input);
    probe.formula("RelayState::new", &[before], &relay);
    probe.formula("RelayState::output", &[state.output()], &relay);
    probe.formula("RelayState::step", &[after], &relay);
    probe.note("RelayState::characteristic", &[state.characteristic().level()], true, &relay);
}

fn check_features<T: Scalar>(
    probe: &mut Probe,
    name: &'static str,
    features: &Features<T>,
    said: &dyn core::fmt::Debug,
) {
    let every = [
        features.amplitude,
        features.bias,
        features.reference,
        features.period_s,
        features.switch_level,
        features.time_positive_s,
        features.time_negative_s,
    ];
    let numbers: Vec<T> = every.iter().flat_map(|statistics| [statistics.mean, statistics.std]).collect();
    let sound = every.iter().all(|statistics| statistics.std >= T::zero()) && features.cycles > 0;
    probe.note(name, &numbers, sound, said);
}

fn features<T: Scalar>(probe: &mut Probe) {
    let threshold = probe.any();
    let mut cycles = Cycles::<T>::new(threshold);
    let (step_s, size) = (probe.size::<T>(), probe.size::<T>());
    let mut summary = Summary::new();
    for sample in 0..60 {
        let angle = 0.35 * f64::from(sample);
        let (mut time_s, mut output) = (T::from_f64(f64::from(sample)) * step_s, size * T::from_f64(-angle.cos()));
        if probe.draw == Draw::Any && probe.random.below(40) == 0 {
            (time_s, output) = (probe.any(), probe.any());
        }
        let input = threshold + T::from_f64(angle.cos()) * (T::one() + threshold.abs());
        if let Some(cycle) = cycles.step(time_s, output, input) {
            let numbers = [cycle.period_s, cycle.maximum, cycle.minimum, cycle.upper_level, cycle.lower_level];
            probe.formula("Cycles::step", &numbers, &cycle);
            summary.push(cycle);
        }
    }
    probe.formula("Cycles::new", cycles.last_change_s().as_slice(), &threshold);
    probe.formula("Cycles::last_change_s", cycles.last_change_s().as_slice(), &threshold);
    probe.note::<T>("Cycles::switchings", &[], cycles.switchings() <= 60, &threshold);
    if let Some(found) = probe.result("Summary::features", summary.features()) {
        check_features(probe, "Summary::features", &found, &summary);
    }
    let cycle = Cycle {
        begin_s: probe.any::<T>(),
        period_s: probe.given(),
        time_positive_s: probe.given(),
        maximum: probe.any(),
        minimum: probe.any(),
        upper_level: probe.any(),
        lower_level: probe.any(),
    };
    for (name, value) in [
        ("Cycle::amplitude", cycle.amplitude()),
        ("Cycle::bias", cycle.bias()),
        ("Cycle::reference", cycle.reference()),
        ("Cycle::switch_level", cycle.switch_level()),
        ("Cycle::time_negative_s", cycle.time_negative_s()),
    ] {
        probe.formula(name, &[value], &cycle);
    }
    let mut summary = Summary::new();
    for near in 0..4 {
        let cycle = Cycle { period_s: cycle.period_s * T::from_f64(1.0 + 0.001 * f64::from(near)), ..cycle };
        summary.push(cycle);
    }
    probe.note::<T>("Summary::new", &[], true, &());
    probe.note::<T>("Summary::push", &[], true, &());
    probe.note::<T>("Summary::cycles", &[], summary.cycles() <= 4, &cycle);
    if let Some(found) = probe.result("Summary::features", summary.features()) {
        check_features(probe, "Summary::features", &found, &cycle);
    }
}

fn identify<T: Scalar>(probe: &mut Probe) {
    let amplitude: T = probe.given();
    let switch_level = if probe.random.below(2) == 0 {
        probe.perhaps()
    } else {
        amplitude * T::from_f64(probe.random.between(0.0, 1.0))
    };
    let bias =
        if probe.random.below(2) == 0 { T::zero() } else { amplitude * T::from_f64(probe.random.between(-0.1, 0.1)) };
    let test = Oscillation {
        relay_level: probe.given(),
        switch_level,
        amplitude,
        bias,
        period_s: probe.given(),
        delay_s: probe.perhaps(),
    };
    probe.formula("Oscillation::omega_rad_s", &[test.omega_rad_s()], &test);
    if let Some(df) = probe.result("Oscillation::describing_function", test.describing_function()) {
        probe.note("Oscillation::describing_function", &[df.f0, df.p, df.q], true, &test);
        let found = iso::parameters(df, test.amplitude, test.omega_rad_s());
        probe.formula("parameters", &[found.alpha, found.beta, found.beta_quadratic, found.disturbance], &test);
    }
    if let Some(found) = probe.result("Oscillation::identify", test.identify()) {
        let sound = found.alpha > T::zero() && found.beta > T::zero() && found.beta_quadratic >= T::zero();
        let numbers = [found.alpha, found.beta, found.beta_quadratic, found.disturbance];
        probe.note("Oscillation::identify", &numbers, sound, &test);
    }
    let found = iso::amplitude_sensitivity(T::from_f64(1.001) + test.amplitude.abs());
    probe.formula("amplitude_sensitivity", &[found.alpha, found.beta, found.beta_quadratic], &test);
    let mut cycle = MeanCycle::symmetric(&test);
    probe.formula("MeanCycle::symmetric", &[cycle.time_positive_s, cycle.time_negative_s], &test);
    if probe.random.below(2) == 0 {
        cycle.time_negative_s = probe.given();
    }
    for (name, found) in
        [("MeanCycle::linear_drag", cycle.linear_drag()), ("MeanCycle::quadratic_drag", cycle.quadratic_drag())]
    {
        if let Some(found) = probe.result(name, found) {
            let numbers =
                [found.alpha(), found.linear_drag(), found.quadratic_drag(), found.disturbance(), found.delay_s()];
            let sound =
                found.alpha() > T::zero() && found.linear_drag() >= T::zero() && found.quadratic_drag() >= T::zero();
            probe.note(name, &numbers, sound, &cycle);
        }
    }
    for law in DragLaw::ALL {
        probe.note::<T>("DragLaw::has_linear", &[], law.has_linear() || law.has_quadratic(), &law);
        probe.note::<T>("DragLaw::has_quadratic", &[], law.has_linear() || law.has_quadratic(), &law);
    }
}

fn on_board<T: Scalar>(probe: &mut Probe) {
    let kinds = [Coordinate::Position, Coordinate::HeadingRad, Coordinate::HeadingDegrees, Coordinate::Speed];
    let coordinate = kinds[probe.random.below(4) as usize];
    let (level, half_width, interval_s) = (probe.given::<T>(), probe.given::<T>(), probe.given::<T>());
    let headings = [
        ("Protocol::heading_rad", Protocol::heading_rad(level, half_width, interval_s)),
        ("Protocol::heading_degrees", Protocol::heading_degrees(level, half_width, interval_s)),
        ("Protocol::usual", Protocol::usual(coordinate, level, half_width, interval_s)),
    ];
    for (name, protocol) in headings {
        probe.formula(name, &[protocol.highest_command, protocol.wrong_way, protocol.dwell_s], &protocol);
    }
    let excursion = half_width * T::from_f64(probe.random.between(0.5, 30.0));
    let mut protocol = Protocol::new(coordinate, level, half_width, excursion, interval_s);
    probe.formula("Protocol::new", &[protocol.highest_command, protocol.wrong_way, protocol.dwell_s], &protocol);
    protocol.cycles = 2;
    if probe.random.below(2) == 0 {
        // Times that fit the interval, so that some experiments go far.
        let times = |intervals: f64| interval_s * T::from_f64(intervals);
        (protocol.unchanged_s, protocol.patience_s, protocol.duration_s) = (times(50.0), times(200.0), times(3000.0));
    }
    if probe.draw == Draw::Any {
        for _ in 0..probe.random.below(3) {
            let value = probe.any();
            match probe.random.below(11) {
                0 => protocol.reference = value,
                1 => protocol.neutral_command = value,
                2 => protocol.lowest_command = value,
                3 => protocol.highest_command = value,
                4 => protocol.resolution = value,
                5 => protocol.largest_rate = value,
                6 => protocol.spread = value,
                7 => protocol.factor = value,
                8 => protocol.patience_s = value,
                9 => protocol.relay_offset = value,
                _ => protocol.wrong_way = value,
            }
        }
    }
    let Some(mut experiment) = probe.result("Experiment::new", Experiment::new(protocol)) else { return };
    probe.note(
        "Experiment::protocol",
        &[experiment.protocol().relay_level],
        *experiment.protocol() == protocol,
        &protocol,
    );
    let (mut position, mut velocity, mut command) = (0.0, 0.0, T::zero());
    for sample in 0..400 {
        let mut time_s = interval_s * T::from_f64(f64::from(sample));
        let mut reading = protocol.reference
            + half_width * T::from_f64(if coordinate == Coordinate::Speed { velocity } else { position });
        if probe.draw == Draw::Any && probe.random.below(200) == 0 {
            (time_s, reading) = (probe.any(), probe.any());
        }
        let step = experiment.step(reading, time_s);
        let within = |command: T| command >= protocol.lowest_command && command <= protocol.highest_command;
        let said = (protocol, reading, time_s, sample);
        probe.note("Experiment::step", &[step.command], within(step.command), &said);
        let ticked = experiment.tick(time_s);
        probe.note("Experiment::tick", &[ticked.command], within(ticked.command), &said);
        probe.note("Experiment::command", &[experiment.command()], within(experiment.command()), &said);
        if step.phase == Phase::Running {
            probe.note("Experiment::position", experiment.position().as_slice(), true, &said);
        } else {
            break;
        }
        command = step.command - protocol.neutral_command;
        velocity += 0.1 * (if command > T::zero() { 1.0 } else { -1.0 }) - 0.05 * velocity;
        position += 0.1 * velocity;
    }
    let _ = command;
    for name in ["Experiment::new", "Experiment::phase"] {
        probe.note::<T>(name, &[], !matches!(experiment.phase(), Phase::Aborted), &protocol);
    }
    probe.note::<T>("Experiment::attempt", &[], experiment.attempt() <= protocol.attempts, &protocol);
    let outcome = experiment.outcome();
    probe.note::<T>("Experiment::outcome", &[], outcome.is_some() == (experiment.phase() == Phase::Done), &protocol);
    if let Some(outcome) = outcome {
        check_features(probe, "Experiment::outcome", &outcome.features, &protocol);
        let delay_s = probe.perhaps();
        for (name, found) in [
            ("Oscillation::of", Oscillation::of(&outcome.features, outcome.relay_level, delay_s).period_s),
            ("MeanCycle::of", MeanCycle::of(&outcome.features, outcome.relay_level, delay_s).time_positive_s),
        ] {
            probe.note(name, &[found], found > T::zero(), &outcome);
        }
        if let Some(found) = probe.result("Outcome::iso", outcome.iso(delay_s)) {
            probe.note(
                "Outcome::iso",
                &[found.alpha, found.beta, found.disturbance],
                found.alpha > T::zero(),
                &outcome,
            );
        }
        for law in DragLaw::ALL {
            if let Some(found) = probe.result("Outcome::exact", outcome.exact(law, delay_s)) {
                probe.note("Outcome::exact", &[found.alpha()], found.alpha() > T::zero(), &outcome);
            }
        }
    }
    experiment.abort();
    probe.note::<T>("Experiment::abort", &[experiment.command()], experiment.phase() != Phase::Running, &protocol);
    let restarted = experiment.restart();
    probe.note::<T>("Experiment::restart", &[experiment.command()], restarted.is_ok(), &protocol);
    probe.result("Experiment::restart", restarted);
}

fn side<T: Scalar>(probe: &mut Probe) -> Option<ThrustSide<T>> {
    let (quadratic, linear) = (
        if probe.random.below(3) == 0 { probe.any() } else { probe.size() },
        if probe.random.below(2) == 0 { T::zero() } else { probe.any() },
    );
    let dead_zone: T = probe.perhaps();
    let limit = dead_zone + probe.given();
    let side = probe.result("ThrustSide::new", ThrustSide::new(quadratic, linear, dead_zone, limit))?;
    let numbers = [
        side.quadratic(),
        side.linear(),
        side.dead_zone(),
        side.limit(),
        side.smallest_thrust_n(),
        side.largest_thrust_n(),
    ];
    let sound = side.smallest_thrust_n() >= T::zero() && side.largest_thrust_n() >= side.smallest_thrust_n();
    for name in [
        "ThrustSide::new",
        "ThrustSide::quadratic",
        "ThrustSide::linear",
        "ThrustSide::dead_zone",
        "ThrustSide::limit",
        "ThrustSide::smallest_thrust_n",
        "ThrustSide::largest_thrust_n",
    ] {
        probe.note(name, &numbers, sound, &side);
    }
    Some(side)
}

/// A thrust that a side may give, or any.
fn thrust<T: Scalar>(probe: &mut Probe, side: &ThrustSide<T>) -> T {
    match probe.random.below(3) {
        0 => probe.any(),
        1 => side.largest_thrust_n() * T::from_f64(probe.random.between(0.0, 1.0)),
        _ => {
            -side.smallest_thrust_n()
                - (side.largest_thrust_n() - side.smallest_thrust_n()) * T::from_f64(probe.random.between(0.0, 1.0))
        }
    }
}

fn thrusters<T: Scalar>(probe: &mut Probe) {
    let (Some(forward), Some(backward)) = (side::<T>(probe), side::<T>(probe)) else { return };
    let thruster = Thruster::asymmetric(forward, backward);
    probe.note::<T>(
        "Thruster::asymmetric",
        &[],
        *thruster.forward() == forward && *thruster.backward() == backward,
        &thruster,
    );
    probe.note::<T>("Thruster::forward", &[], *thruster.forward() == forward, &thruster);
    probe.note::<T>("Thruster::backward", &[], *thruster.backward() == backward, &thruster);
    let wanted_n = thrust(probe, &forward);
    let within = |command: T| command <= forward.limit() && -command <= backward.limit();
    let possible = |thrust_n: T| thrust_n <= forward.largest_thrust_n() && -thrust_n <= backward.largest_thrust_n();
    let said = (thruster, wanted_n);
    if let Some(command) = probe.result("Thruster::command", thruster.command(wanted_n)) {
        probe.note("Thruster::command", &[command], within(command), &said);
    }
    if let Some(delivered) = probe.result("Thruster::command_clamped", thruster.command_clamped(wanted_n)) {
        let sound = within(delivered.command) && possible(delivered.thrust_n);
        probe.note("Thruster::command_clamped", &[delivered.command, delivered.thrust_n], sound, &said);
    }
    let command: T = probe.any();
    if command.is_finite() {
        let thrust_n = thruster.thrust(command);
        probe.note("Thruster::thrust", &[thrust_n], possible(thrust_n), &(thruster, command));
    }
    let (quadratic, linear, dead_zone, limit) =
        (forward.quadratic(), forward.linear(), forward.dead_zone(), forward.limit());
    if let Some(both) = probe.result("Thruster::affine", Thruster::affine(quadratic, linear, dead_zone, limit)) {
        probe.note::<T>("Thruster::affine", &[], both.forward() == both.backward(), &both);
    }
    let [a, b, c, d, rate]: [T; 5] = core::array::from_fn(|_| probe.given());
    if let Some(moving) = probe.result("BilinearThruster::new", BilinearThruster::new((a, b), (c, d), rate)) {
        let (wanted, speed) = (probe.any(), probe.any());
        let said = (moving, wanted, speed);
        probe.note::<T>("BilinearThruster::new", &[], true, &moving);
        if let Some(found) = probe.result("BilinearThruster::rate", moving.rate(wanted, speed)) {
            probe.note("BilinearThruster::rate", &[found], found.abs() <= rate, &said);
        }
        probe.formula("BilinearThruster::thrust", &[moving.thrust(wanted, speed)], &said);
        probe.formula("BilinearThruster::torque", &[moving.torque(wanted, speed)], &said);
    }
}

fn allocation<T: Scalar>(probe: &mut Probe) {
    let arm_m = probe.given::<T>();
    let single = Allocation::<T, 1, 1>::single();
    probe.note("Allocation::single", single.matrix().as_flattened(), true, &());
    let Some(pair) = probe.result("Allocation::pair", Allocation::pair(arm_m)) else { return };
    for (name, numbers) in [
        ("Allocation::pair", pair.inverse()),
        ("Allocation::matrix", pair.matrix()),
        ("Allocation::inverse", pair.inverse()),
    ] {
        probe.note(name, numbers.as_flattened(), true, &arm_m);
    }
    let forces: [T; 2] = core::array::from_fn(|_| probe.any());
    probe.formula("Allocation::forces", &pair.forces(&forces), &(arm_m, forces));
    probe.formula("Allocation::thrusts", &pair.thrusts(&forces), &(arm_m, forces));
    let Some(thruster) = side::<T>(probe).map(|side| Thruster::asymmetric(side, side)) else { return };
    let actual = [thruster; 2];
    let compensation = Compensation::new(pair, actual);
    probe.note("Compensation::new", compensation.offset_n(), true, &arm_m);
    let direction = [T::one(), -T::one()];
    let largest: [T; 2] = core::array::from_fn(|_| probe.perhaps());
    let against = probe
        .result("Compensation::against_dead_zone", Compensation::against_dead_zone(pair, actual, direction, largest));
    for compensation in [Some(compensation), against].into_iter().flatten() {
        let said = (compensation, forces);
        probe.note("Compensation::against_dead_zone", compensation.offset_n(), true, &said);
        probe.note("Compensation::offset_n", compensation.offset_n(), true, &said);
        probe.formula("Compensation::bias_forces", &compensation.bias_forces(), &said);
        let limit = thruster.forward().limit();
        let within = |commands: &[T; 2]| commands.iter().all(|command| command.abs() <= limit);
        if let Some(commands) = probe.result("Compensation::commands", compensation.commands(&forces)) {
            probe.note("Compensation::commands", &commands, within(&commands), &said);
            probe.formula("Compensation::delivered", &compensation.delivered(&commands, &actual), &said);
        }
        if let Some(commands) = probe.result("Compensation::commands_clamped", compensation.commands_clamped(&forces)) {
            probe.note("Compensation::commands_clamped", &commands, within(&commands), &said);
            probe.formula("Compensation::delivered", &compensation.delivered(&commands, &actual), &said);
        }
    }
}

fn made_gains<T: Scalar>(probe: &mut Probe) -> Option<Gains<T>> {
    let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][probe.random.below(3) as usize];
    let integral = if structure == Structure::Pd { T::zero() } else { probe.given() };
    let (proportional, derivative, filter_s) = (probe.given(), probe.perhaps(), probe.perhaps());
    let gains = probe.result("Gains::new", Gains::new(structure, proportional, integral, derivative, filter_s))?;
    let numbers = [gains.proportional(), gains.integral(), gains.derivative(), gains.filter_s()];
    let sound = numbers.iter().all(|number| *number >= T::zero()) && gains.structure() == structure;
    for name in [
        "Gains::new",
        "Gains::proportional",
        "Gains::integral",
        "Gains::derivative",
        "Gains::filter_s",
        "Gains::structure",
    ] {
        probe.note(name, &numbers, sound, &gains);
    }
    probe.note::<f64>("Structure::bandwidth_ratio", &[structure.bandwidth_ratio()], true, &structure);
    Some(gains)
}

fn check_margins<T: Scalar>(
    probe: &mut Probe,
    name: &'static str,
    margins: &selfosc::control::Margins<T>,
    said: &dyn core::fmt::Debug,
) {
    let numbers = [margins.phase_rad, margins.delay_s, margins.crossover_rad_s];
    let at_least_one = |margin: &T| *margin >= T::one();
    let sound = numbers.iter().all(|number| *number >= T::zero())
        && margins.phase_rad <= T::pi()
        && margins.gain.iter().chain(margins.gain_reduction.iter()).all(at_least_one);
    probe.note(name, &numbers, sound, said);
    probe.note(name, margins.gain.as_slice(), true, said);
    probe.note(name, margins.gain_reduction.as_slice(), true, said);
}

fn gains<T: Scalar>(probe: &mut Probe) {
    let (Some(gains), Some(axis)) = (made_gains::<T>(probe), axis::<T>(probe)) else { return };
    let (speed, omega) = (probe.any(), probe.size());
    let said = (axis, gains, speed, omega);
    let Some(open) = probe.result("OpenLoop::new", OpenLoop::new(&axis, &gains, speed)) else { return };
    probe.note("OpenLoop::new", &[open.delay_s()], true, &said);
    probe.note("OpenLoop::delay_s", &[open.delay_s()], true, &said);
    let (real, imaginary) = open.response(omega);
    probe.formula("OpenLoop::magnitude", &[open.magnitude(omega)], &said);
    probe.formula("OpenLoop::angle_above_critical", &[open.angle_above_critical(omega)], &said);
    probe.formula("OpenLoop::response", &[real, imaginary], &said);
    probe.note::<T>("OpenLoop::unstable_poles", &[], open.unstable_poles() < u32::MAX, &said);
    if let Some(margins) = probe.result("OpenLoop::margins", open.margins()) {
        check_margins(probe, "OpenLoop::margins", &margins, &said);
    }
    let number = probe.random.between(0.5, 2.0);
    let (least, most) = (RobustCriterion::PhaseRad(number), RobustCriterion::Sensitivity(number));
    probe.note("RobustCriterion::number", &[T::from_f64(least.number())], least.number() == number, &said);
    let [met, missed] = [2.0 * number, 0.5 * number];
    let met = least.is_met_by(met) && !least.is_met_by(missed) && most.is_met_by(missed) && !most.is_met_by(met);
    probe.note::<T>("RobustCriterion::is_met_by", &[], met, &said);
}

fn tuning<T: Scalar>(probe: &mut Probe) {
    let Some(axis) = axis::<T>(probe) else { return };
    let structure = [Structure::Pd, Structure::Pid, Structure::Ipd][probe.random.below(3) as usize];
    // Near the rate at which the axis settles, so that some succeed.
    let bandwidth = if probe.random.below(2) == 0 {
        probe.given()
    } else {
        axis.linear_drag() / axis.alpha() * T::from_f64(2.0) + T::from_f64(probe.random.between(0.0, 1.0))
    };
    let said = (axis, structure, bandwidth);
    let Some(tuning) = probe.result("Tuning::new", Tuning::new(&axis, structure, bandwidth)) else { return };
    let gains = tuning.gains();
    for name in ["Tuning::new", "Tuning::gains"] {
        let numbers = [gains.proportional(), gains.integral(), gains.derivative(), gains.filter_s()];
        probe.note(name, &numbers, numbers.iter().all(|number| *number >= T::zero()), &said);
    }
    let slope = probe.given();
    if let Some(uncertain) = probe.result("Tuning::for_slope", Tuning::for_slope(&axis, slope, structure, bandwidth)) {
        let numbers = [uncertain.gains().proportional(), uncertain.gains().integral(), uncertain.gains().derivative()];
        let holds = uncertain.slope() == slope && numbers.iter().all(|number| *number >= T::zero());
        probe.note("Tuning::for_slope", &numbers, holds, &(said, slope));
    }
    probe.note("Tuning::slope", &[tuning.slope()], tuning.slope() == axis.linear_drag(), &said);
    probe.note("Tuning::bandwidth_rad_s", &[tuning.bandwidth_rad_s()], true, &said);
    probe.note("Tuning::double_pole_rad_s", &[tuning.double_pole_rad_s()], true, &said);
    probe.note::<T>("Tuning::axis", &[], *tuning.axis() == axis, &said);
    check_margins(probe, "Tuning::margins", tuning.margins(), &said);
}

fn controller<T: Scalar>(probe: &mut Probe) {
    let Some(gains) = made_gains::<T>(probe) else { return };
    let mut controller = Controller::new(&gains);
    probe.note::<T>("Controller::new", &[], true, &gains);
    let (low, span): (T, T) = (probe.any(), probe.given());
    let mut limits = None;
    if probe.random.below(2) == 0
        && let Some(limited) = probe.result("Controller::with_limits", controller.with_limits(low, low + span))
    {
        (controller, limits) = (limited, Some((low, low + span)));
    }
    let held = controller.with_longest_hold(probe.perhaps(), probe.any());
    if let Some(held) = probe.result("Controller::with_longest_hold", held) {
        probe.note::<T>("Controller::with_longest_hold", &[], true, &held);
        controller = if probe.random.below(2) == 0 { held } else { controller };
    }
    let round = controller.on_circle(probe.given());
    if let Some(round) = probe.result("Controller::on_circle", round) {
        probe.note::<T>("Controller::on_circle", &[], true, &round);
        controller = if probe.random.below(3) == 0 { round } else { controller };
    }
    if let Some(axis) = axis::<T>(probe) {
        let top = if probe.random.below(2) == 0 { None } else { Some(probe.given()) };
        let ahead = FeedForward::new(&axis, probe.given(), top);
        if let Some(ahead) = probe.result("FeedForward::new", ahead) {
            probe.note::<T>("FeedForward::new", &[], true, &ahead);
            probe.note::<T>("Controller::with_feed_forward", &[], true, &ahead);
            controller = if probe.random.below(2) == 0 { controller.with_feed_forward(ahead) } else { controller };
        }
    }
    let within = |command: T| limits.is_none_or(|(low, high)| command >= low && command <= high);
    for _ in 0..10 {
        let (reference, measurement, dt_s) = (probe.any(), probe.any(), probe.given());
        let step = controller.step(reference, measurement, dt_s);
        let said = (controller, reference, measurement, dt_s);
        probe.note("Controller::step", &[step.command], within(step.command), &said);
        if limits.is_some() {
            probe.note("Controller::with_limits", &[step.command], within(step.command), &said);
        }
    }
    controller.reset();
    probe.note::<T>("Controller::reset", &[], true, &controller);
}

fn ultimate<T: Scalar>(probe: &mut Probe) {
    let [gain, period_s]: [T; 2] = core::array::from_fn(|_| probe.given());
    if let Some(point) = probe.result("UltimatePoint::new", UltimatePoint::new(gain, period_s)) {
        for name in ["UltimatePoint::new", "UltimatePoint::gain", "UltimatePoint::period_s"] {
            probe.note(name, &[point.gain(), point.period_s()], true, &point);
        }
        for rule in Rule::ALL {
            let (share, _, _) = rule.factors();
            probe.note::<f64>("Rule::factors", &[share], share > 0.0, &rule);
            if let Some(gains) = probe.result("Rule::gains", rule.gains(&point)) {
                let numbers = [gains.proportional(), gains.integral(), gains.derivative(), gains.filter_s()];
                probe.note("Rule::gains", &numbers, gains.proportional() > T::zero(), &(rule, point));
            }
        }
    }
    let amplitude = probe.given::<T>();
    let test = RelayTest {
        level: probe.given(),
        half_width: amplitude * T::from_f64(probe.random.between(0.0, 1.0)),
        amplitude,
        bias: if probe.random.below(2) == 0 { T::zero() } else { probe.any() },
        period_s: probe.given(),
    };
    if let Some(point) = probe.result("RelayTest::point", test.point()) {
        let sound = point.omega_rad_s > T::zero() && point.magnitude > T::zero();
        probe.note("RelayTest::point", &[point.omega_rad_s, point.magnitude, point.angle_above_critical], sound, &test);
    }
    if let Some(point) = probe.result("RelayTest::ultimate", test.ultimate()) {
        probe.note("RelayTest::ultimate", &[point.gain(), point.period_s()], point.gain() > T::zero(), &test);
    }
    let point = |probe: &mut Probe| FrequencyPoint {
        omega_rad_s: probe.given::<T>(),
        magnitude: probe.given(),
        angle_above_critical: probe.any(),
    };
    let (first, second) = (point(probe), point(probe));
    if let Some(between) = probe.result("UltimatePoint::between", UltimatePoint::between(&first, &second)) {
        let sound = between.gain() > T::zero() && between.period_s() > T::zero();
        probe.note("UltimatePoint::between", &[between.gain(), between.period_s()], sound, &(first, second));
    }
}

/// Readings of a relay's oscillation at any scale, and any numbers as a process.
fn process<T: Scalar>(probe: &mut Probe) {
    let (pace, swing, level, held_s) = (probe.size::<T>(), probe.size::<T>(), probe.given::<T>(), probe.perhaps::<T>());
    let number = |value: usize| T::from_f64(value as f64);
    let time: [T; 48] = core::array::from_fn(|k| pace * number(k));
    let command: [T; 48] = core::array::from_fn(|k| if k / 8 % 2 == 0 { level } else { T::zero() });
    let shape: [T; 8] = core::array::from_fn(|_| T::from_f64(probe.random.between(-0.1, 0.1)));
    let output: [T; 48] = core::array::from_fn(|k| {
        let side = if (k + 6) / 8 % 2 == 0 { T::one() } else { -T::one() };
        swing * (side * (number((k + 6) % 8) - T::from_f64(3.5)) + shape[k % 8])
    });
    let said = (pace, swing, level, held_s);
    let readings = probe.result("ProcessReadings::new", ProcessReadings::new(&time, &output, &command));
    let found = readings.and_then(|readings| {
        probe.note::<T>("ProcessReadings::new", &[], true, &said);
        probe.result("ProcessReadings::first_order", readings.first_order())
    });
    let process = found.unwrap_or_else(|| {
        let [drag, stiffness, dead_time_s] = [probe.given(), probe.perhaps(), probe.given()];
        FirstOrderProcess { drag, stiffness, dead_time_s, reverse: false }
    });
    let FirstOrderProcess { drag, stiffness, dead_time_s, .. } = process;
    if found.is_some() {
        let sound = drag > T::zero() && stiffness >= T::zero() && dead_time_s >= T::zero();
        probe.note("ProcessReadings::first_order", &[drag, stiffness, dead_time_s], sound, &said);
    }
    probe.formula::<T>("FirstOrderProcess::amigo", &[], &process);
    if let Some(gains) = probe.result("FirstOrderProcess::gains", process.gains(held_s)) {
        let all = [gains.proportional(), gains.integral(), gains.derivative(), gains.filter_s()];
        probe.note("FirstOrderProcess::gains", &all, all[0] > T::zero(), &(process, held_s));
    }
}
