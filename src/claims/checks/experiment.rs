//! The experiment around the axis: eqs. 36, 43 and 44, the procedure, and the harmonic balance on true orbits (eqs. 16-17).

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix};

use super::algebra::exactly;
use super::existence::STEPS;
use super::family::cycle;
use super::vehicle_proofs::uncoupled_axis;
use super::{Case, ClaimPart, Distortion, Draw, Verdict, claim, tolerance};
use crate::describing::ClosedForm;
use crate::experiment::{Record, Sensor, SimulatedExperiment};
use crate::features::RecordFeatures;
use crate::identify::iso::{Oscillation, disturbance_from_times};
use crate::nonlinearity::{RelayHysteresis, Sinusoid};
use crate::numeric::quadrature::integrate;
use crate::numeric::{runge_kutta, scan};
use crate::orbit::{LimitCycle, ListedOrbit, limit_cycle, orbits};
use crate::plant::{DragAxis, State, StateSpace, TransferFunction};
use crate::proof::polynomial::Rational;

/// An axis with drag of either kind, a disturbance and a delay, under its relay.
struct RelayedAxis {
    axis: DragAxis<f64>,
    relay: RelayHysteresis<f64>,
}

impl RelayedAxis {
    /// Drag of the kinds stated, disturbances up to half the level, delays up to `longest_s`.
    fn draw(draw: &mut Draw, (linear, quadratic): (bool, bool), longest_s: f64) -> Option<Self> {
        let mut drag = |name, present| if present { draw.log_uniform(name, 0.2, 3.0) } else { 0.0 };
        let (linear, quadratic) = (drag("linear_drag", linear), drag("quadratic_drag", quadratic));
        let (alpha, level) = (draw.log_uniform("alpha", 0.3, 3.0), draw.uniform("level", 0.5, 2.0));
        let disturbance = level * draw.uniform("disturbance_over_level", -0.5, 0.5);
        let delay_s = if longest_s > 0.0 { draw.uniform("delay_s", 0.0, longest_s) } else { 0.0 };
        let axis = DragAxis::mixed(alpha, linear, quadratic).ok()?;
        let axis = axis.with_disturbance(disturbance).ok()?.with_delay_s(delay_s).ok()?;
        let relay = RelayHysteresis::new(level, draw.log_uniform("half_width", 0.1, 1.0), 0.0).ok()?;
        Some(Self { axis, relay })
    }

    fn cycle(&self) -> Option<LimitCycle<f64>> {
        limit_cycle(&self.axis, &self.relay).ok()
    }
}

claim! {
    DELAYS_ADD = "delays-add" Theorem
    "A delay T_d before the axis and one after it are one delay 2 T_d before it: the same record, T_d later";
    cases |all| all.min(200);
    printed Holds delays_add(2.0, 0.0, 2);
    // A single delay for two.
    false delays_add(1.0, 0.0, 2);
    needs "whole-samples" delays_add(2.0, 0.5, 1);
    not_proved "a shift of time in two simulations: there is no formula of the code to be compared";
}

/// Two simulations from rest, the first with sensor and input delay of a whole number of samples and a `fraction`, the
/// second with `factor` times the delay at the input; the relay switching at samples, or (of `kinds` = 2) else at any time.
fn delays_add(draw: &mut Draw, factor: f64, fraction: f64, kinds: usize) -> Option<Case> {
    const RATE_HZ: f64 = 20.0;
    let RelayedAxis { axis, relay } = RelayedAxis::draw(draw, (true, true), 0.0)?;
    let (late, held) = (1 + draw.index("samples_less_one", 5), draw.index("watching", kinds) == 0);
    let delay_s = draw.note("delay_s", (late as f64 + fraction) / RATE_HZ);
    let run = |input_s: f64, sensor_s: f64| -> Option<Record> {
        let experiment = SimulatedExperiment::new(axis.with_delay_s(input_s).ok()?, relay, RATE_HZ).ok()?;
        let sensor = Sensor { delay_s: sensor_s, ..Sensor::default() };
        let experiment = experiment.with_sensor(sensor).ok()?;
        if held { experiment.held() } else { experiment }.run(30.0).ok()
    };
    let (Some(apart), Some(joined)) = (run(delay_s, delay_s), run(factor * delay_s, 0.0)) else {
        return Some(Case::truth(false));
    };
    let reached = joined.output().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let distance = |(x, y): (&f64, &f64)| (x - y).abs();
    let outputs = apart.output()[late..].iter().zip(joined.output()).map(distance).fold(0.0, f64::max);
    let commands = apart.input()[late..].iter().zip(joined.input()).map(distance).fold(0.0, f64::max);
    // Readings between samples cannot be compared; the commands' pattern can.
    let same = Case::truth(draw.note("difference_of_commands", commands) == 0.0);
    let compared = if fraction == 0.0 { outputs } else { 0.0 };
    Some(same.and(draw.equal(("difference_of_readings", compared), 0.0, reached, tolerance::CANCELLING)))
}

claim! {
    HEAVE = "heave" Theorem
    "In heave weight less buoyancy acts as the disturbance: with linear drag the switching times give tau_ZE + W - B";
    printed Holds heave(1.0, &Heave::ASSUMED);
    // Buoyancy less weight.
    false heave(-1.0, &Heave::ASSUMED);
    needs "level" heave(1.0, &Heave { tilt_rad: 0.3, ..Heave::ASSUMED });
    needs "linear-drag" heave(1.0, &Heave { quadratic: 20.0, ..Heave::ASSUMED });
    needs "within-relay" heave(1.0, &Heave { surplus: 3.0, ..Heave::ASSUMED });
    proof prove_heave;
}

/// Weight less buoyancy is the constant force of eq. 5 in heave, and times at which it has mean zero with the command give it.
fn prove_heave(distortion: Distortion) -> Verdict {
    let functions = |[level, positive_s, external, weight, buoyancy]: [Rational; 5], factor: Rational| {
        let surplus = external + weight - buoyancy;
        let negative_s = positive_s * (level + surplus) / (level - surplus);
        let impulse = level * (positive_s - negative_s) + surplus * (positive_s + negative_s);
        Some([impulse, factor * disturbance_from_times(level, positive_s, negative_s) - surplus])
    };
    uncoupled_axis(&ClaimPart::WHOLE, distortion)
        .and(|| exactly(ClaimPart::WHOLE, distortion, &[[2.0, 1.0, 0.25, 3.0, 2.5]], functions))
}

/// Conditions of heave.
struct Heave {
    tilt_rad: f64,
    quadratic: f64,
    /// Largest `tau_ZE + W - B` over the relay's level.
    surplus: f64,
}

impl Heave {
    const ASSUMED: Self = Self { tilt_rad: 0.0, quadratic: 0.0, surplus: 0.8 };
}

/// The disturbance found from the limit cycle, against weight, buoyancy and external force.
fn heave(draw: &mut Draw, sign: f64, under: &Heave) -> Option<Case> {
    let (weight, level) = (draw.uniform("weight_n", 20.0, 60.0), draw.uniform("level_n", 1.0, 3.0));
    let external = 0.1 * level * draw.uniform("external_over_tenth_of_level", -1.0, 1.0);
    let buoyancy = weight + level * draw.uniform("buoyancy_over_weight_over_level", 0.3, under.surplus - 0.1);
    // Along the body's own axis a tilted vehicle feels only a part.
    let felt = (weight - buoyancy) * libm::cos(under.tilt_rad).powi(2) + external;
    let (alpha, drag) = (draw.uniform("alpha", 5.0, 10.0), [draw.uniform("drag", 1.0, 5.0), under.quadratic]);
    let relay = [level, draw.uniform("half_width_m", 0.1, 0.5)];
    let Some(cycle) = cycle(alpha, drag, felt, 0.2, relay) else { return Some(Case::truth(false)) };
    let found = disturbance_from_times(level, cycle.time_positive_s, cycle.time_negative_s);
    let expected = sign * (external + weight - buoyancy);
    Some(draw.equal(("disturbance_n", found), expected, level, tolerance::CANCELLING))
}

claim! {
    SURGE = "surge" Theorem
    "The relay fed with minus the integral of the speed makes surge oscillate as yaw does";
    cases |all| all.min(200);
    printed Holds surge(|[_, way]| way);
    // The integral with its own sign.
    false surge(|[_, way]| -way);
    needs "integrated" surge(|[speed, _]| speed);
    not_proved "two integrations step by step: there is no formula of the code to be compared";
}

/// The speed's own first-order equation and an integrator, integrated step by step, against the limit cycle of eq. 36.
fn surge(draw: &mut Draw, measured: fn([f64; 2]) -> f64) -> Option<Case> {
    let RelayedAxis { axis, relay } = RelayedAxis::draw(draw, (true, true), 0.5)?;
    let Ok(cycle) = limit_cycle(&axis, &relay) else { return Some(Case::truth(false)) };
    let moved = |state: [f64; 2], command: f64, time_s: f64| {
        runge_kutta(state, time_s, |[speed, _]| {
            let drag = (axis.linear_drag() + axis.quadratic_drag() * speed.abs()) * speed;
            [(command * relay.level() + axis.disturbance() - drag) / axis.alpha(), speed]
        })
    };
    let step_s = cycle.period_s / f64::from(STEPS);
    // Where the positive command has just arrived, on the cycle.
    let mut state = [cycle.lower_switch.velocity, cycle.lower_switch.position];
    let (mut time_s, mut maximum, mut switchings) = (0.0, state[1], [0.0; 3]);
    for (command, switching) in [1.0, -1.0, 1.0].into_iter().zip(&mut switchings) {
        let left = |state: [f64; 2]| command * measured(state) - relay.half_width();
        let mut next = moved(state, command, step_s);
        while left(next) < 0.0 && time_s < 2.5 * cycle.period_s {
            (state, time_s) = (next, time_s + step_s);
            maximum = maximum.max(state[1]);
            next = moved(state, command, step_s);
        }
        let Some(part_s) = scan::bracketed(&mut |part_s| Some(left(moved(state, command, part_s))), 0.0, step_s) else {
            return Some(Case::truth(false));
        };
        *switching = time_s + part_s;
        // The command acts on until the opposite one arrives, which no further switching precedes.
        state = moved(state, command, part_s);
        let steps = libm::ceil(axis.delay_s() / step_s).max(1.0);
        (0..steps as u32).for_each(|_| state = moved(state, command, axis.delay_s() / steps));
        time_s = *switching + axis.delay_s();
    }
    let [rising, falling, next] = switchings;
    let times = [
        ("period_s", next - rising, cycle.period_s, cycle.period_s),
        ("time_negative_s", falling - rising, cycle.time_negative_s, cycle.period_s),
    ];
    let reached = Case::truth(maximum <= cycle.maximum + tolerance::INTEGRATED * cycle.amplitude);
    Some(draw.equations(times, tolerance::INTEGRATED).and(reached))
}

claim! {
    PROCEDURE = "procedure" Statement
    "Means over the cycles of a dense record, through condition 40 and Table 3, give what the exact limit cycle's features give";
    cases |all| all.min(200);
    printed Holds procedure(1000.0, 1.0, CLEAR);
    // Without the delay.
    false procedure(1000.0, 0.0, CLEAR);
    needs "dense" procedure(20.0, 1.0, CLEAR);
    needs "clear-of-condition-40" procedure(1000.0, 1.0, (0.97, 1.0));
    not_proved "means over the samples of a record: how far they are off is known by order of magnitude alone";
}

/// `(x_a + abs(x_0))/X_m`, from and to, where eq. 31 is far from the end of its domain.
const CLEAR: (f64, f64) = (0.0, 0.8);

/// Parameters from a simulated record, given its samples a period, against those from the limit cycle.
fn procedure(draw: &mut Draw, samples: f64, delay: f64, condition_40: (f64, f64)) -> Option<Case> {
    let case = RelayedAxis::draw(draw, (true, true), 0.3)?;
    let Some(cycle) = case.cycle() else { return Some(Case::truth(false)) };
    let share = (case.relay.half_width() + cycle.bias.abs()) / cycle.amplitude;
    if !(condition_40.0..condition_40.1).contains(&share) {
        return None;
    }
    let start = State { position: cycle.lower_switch.position, velocity: cycle.lower_switch.velocity };
    let record = SimulatedExperiment::new(case.axis, case.relay, samples / cycle.period_s)
        .and_then(|experiment| experiment.from_state(start))
        .and_then(|experiment| experiment.run(5.0 * cycle.period_s));
    let Ok(record) = record else { return Some(Case::truth(false)) };
    let Ok(found) = RecordFeatures::of(&record) else { return Some(Case::truth(false)) };
    let exact = Oscillation {
        relay_level: case.relay.level(),
        switch_level: case.relay.half_width(),
        amplitude: cycle.amplitude,
        bias: cycle.bias,
        period_s: cycle.period_s,
        delay_s: case.axis.delay_s(),
    };
    let measured = Oscillation::of(&found.features, found.relay.level, delay * case.axis.delay_s());
    let (exact, measured) = (exact.identify().ok()?, measured.identify().ok()?);
    // The motion of a sample is a share of the amplitude; the level it is read at is smaller.
    let ratio = cycle.amplitude / case.relay.half_width();
    let equations = [
        ("alpha", measured.alpha, exact.alpha, exact.alpha * ratio),
        ("beta", measured.beta, exact.beta, exact.beta * ratio),
        ("beta_xx", measured.beta_quadratic, exact.beta_quadratic, exact.beta_quadratic * ratio),
    ];
    Some(draw.equations(equations, tolerance::SAMPLED))
}

claim! {
    HARMONIC_BALANCE = "harmonic-balance" Theorem
    "With a linear plant 1 + N G(jw) = 0 on the true orbit, N being the relay's true gain there and not the sinusoid's";
    cases |all| all.min(100);
    printed Approximate balance(Gain::OfSinusoid, 1.0);
    corrected balance(Gain::OfOrbit, 1.0);
    // The plant without the delay.
    false balance(Gain::OfOrbit, 0.0);
    needs "linear-plant" quadratic_balance();
    not_proved "the orbits of a plant of any order come from a search, not from a formula";
}

/// Which gain the relay is given.
#[derive(Clone, Copy)]
enum Gain {
    /// Describing function at the orbit's amplitude.
    OfSinusoid,
    /// First harmonic of the command over that of the relay's input, on the orbit.
    OfOrbit,
}

/// First harmonic `X_1` of `x(t)` over a period, as `(2/T) integral of x exp(-jwt)`, by pieces that are smooth.
fn first_harmonic(x: impl Fn(f64) -> f64, ends: &[f64], period_s: f64) -> Complex<f64> {
    let omega = 2.0 * PI / period_s;
    let part = |weight: fn(f64) -> f64| -> f64 {
        let piece = |pair: &[f64]| integrate(&mut |t| x(t) * weight(omega * t), pair[0], pair[1], 1e-13, 200).value;
        ends.windows(2).map(piece).sum::<f64>() * 2.0 / period_s
    };
    Complex::new(part(libm::cos), -part(libm::sin))
}

/// First harmonic of a square wave `+-level` that steps up at time `on_s`, the times at either level equal.
fn square_wave(level: f64, omega: f64, on_s: f64) -> Complex<f64> {
    Complex::new(0.0, -4.0 * level / PI) * Complex::new(0.0, -omega * on_s).exp()
}

/// A plant with or without integrator, three poles and a delay, in a symmetric oscillation.
fn oscillating(draw: &mut Draw) -> Option<(TransferFunction, RelayHysteresis<f64>, ListedOrbit)> {
    let (a, b) = (draw.log_uniform("first_pole_rad_s", 0.3, 3.0), draw.log_uniform("second_pole_rad_s", 0.3, 3.0));
    let c = if draw.index("integrating", 2) == 1 { 0.0 } else { draw.log_uniform("third_pole_rad_s", 0.1, 1.0) };
    let denominator = [1.0, a + b + c, a * b + b * c + c * a, a * b * c];
    let plant = TransferFunction::new(&[1.0], &denominator).ok()?;
    let delay_s = draw.uniform("delay_s", 0.1, 1.0);
    let plant = plant.with_delay(delay_s).ok()?;
    let relay =
        RelayHysteresis::new(draw.uniform("level", 0.5, 2.0), draw.uniform("half_width", 0.0, 0.1), 0.0).ok()?;
    let found = orbits(&plant, &relay.into(), Some(1.5..=40.0)).ok()?.orbits;
    let symmetric = |orbit: &ListedOrbit| orbit.time_high_s.intersection(orbit.time_low_s).is_some();
    Some((plant, relay, found.into_iter().find(symmetric)?))
}

/// First harmonic of the output under a square wave `+-level` that steps up at time zero: the half-period from the state that it
/// turns into its opposite (Åström), and the second half alike.
fn forced_output(plant: &TransferFunction, level: f64, period_s: f64) -> Option<Complex<f64>> {
    let plant = StateSpace::realise(plant).ok()?;
    let half = plant.flow(0.5 * period_s);
    let matrix = DMatrix::identity(plant.order(), plant.order()) + half.state;
    let start = matrix.lu().solve(&(half.input * -level))?;
    let output = |time: f64| plant.output(&plant.flow(time).apply(&start, level));
    Some(2.0 * first_harmonic(output, &[0.0, 0.5 * period_s], period_s))
}

fn balance(draw: &mut Draw, gain: Gain, delay: f64) -> Option<Case> {
    let (plant, relay, orbit) = oscillating(draw)?;
    let period_s = draw.note("period_s", orbit.period_s.midpoint());
    let (omega, delay_s) = (2.0 * PI / period_s, plant.delay_s());
    let sine = match gain {
        Gain::OfOrbit => {
            // The plant's input steps up at time zero, the command a delay before; the relay sees minus the output.
            let output = forced_output(&plant, relay.level(), period_s);
            output.map(|output| square_wave(relay.level(), omega, -delay_s) / -output)
        }
        Gain::OfSinusoid => {
            let df =
                Sinusoid::new(0.0, orbit.amplitude().midpoint()).ok().and_then(|s| relay.describing_function(&s).ok());
            df.map(|df| Complex::new(df.p, df.q))
        }
    };
    let plant = plant.with_delay(delay * delay_s).and_then(|plant| plant.response(omega));
    let (Some(sine), Ok(response)) = (sine, plant) else { return Some(Case::truth(false)) };
    Some(draw.equal(("one_plus_n_g", (sine * response + 1.0).norm()), 0.0, 1.0, tolerance::CANCELLING))
}

/// Quadratic drag with the linear drag of the same first harmonic.
fn quadratic_balance(draw: &mut Draw) -> Option<Case> {
    let case = RelayedAxis::draw(draw, (false, true), 0.0)?;
    let (axis, level) = (case.axis, case.relay.level());
    let (axis, cycle) =
        axis.with_disturbance(0.0).ok().and_then(|axis| Some((axis, limit_cycle(&axis, &case.relay).ok()?)))?;
    let at = |switch: crate::orbit::Switching<f64>| State { position: switch.position, velocity: switch.velocity };
    let (half, period_s) = (cycle.time_positive_s, cycle.period_s);
    let position = |t: f64| {
        let falling = axis.advance(at(cycle.upper_switch), -level, (t - half).max(0.0));
        let rising = axis.advance(at(cycle.lower_switch), level, t.min(half));
        if t < half { rising.position } else { falling.position }
    };
    // From rest to rest the motion is smooth; the ends cut it there too.
    let omega = 2.0 * PI / period_s;
    let output = first_harmonic(position, &[0.0, half, period_s], period_s);
    let drag = 8.0 / (3.0 * PI) * axis.quadratic_drag() * output.norm() * omega;
    let response = Complex::new(-axis.alpha() * omega * omega, drag * omega).inv();
    let gain = square_wave(level, omega, 0.0) / -output;
    Some(draw.equal(("one_plus_n_g", (gain * response + 1.0).norm()), 0.0, 1.0, tolerance::CANCELLING))
}
