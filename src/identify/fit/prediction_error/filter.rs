//! Extended Kalman filter in continuous and discrete time (Jazwinski 1970, chapter 8): predicts each reading from those
//! before it. The estimate maximises the innovations' likelihood; its derivatives are carried along.
//!
//! States are position, velocity, process force and coloured error of the reading, the filtered position where the sensor
//! filters, and the late speed where drag follows it. The derivatives with respect to
//! structural parameters are those of the predictor with the gain as it is (Ljung 1999, section 10.2: what a change of the
//! gain adds has expectation zero); with respect to the noise they are complete for the motion as linearised.

mod driven;
mod observe;
mod pass;
mod transition;

use super::actuator::{Actuator, Force, IntegrationStop};
use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::motion::{Dynamics, Point};
use super::observations::Observations;
use driven::Drives;
pub(super) use pass::{FilterPass, Innovation, Score};
use transition::{FILTERED, LATE, LateSpeed, LowPass, Square, Transition, Vector, add};

/// Parts of the record whose scores are kept apart.
pub(super) const PARTS: usize = 8;
/// The longest step, in time constants of the motion.
const LONGEST_STEP: f64 = 0.3;
/// Steps per sample beyond which a motion is faster than the record can show.
const MOST_STEPS: f64 = 12.0;

/// Least rate of a motion, per s: a vehicle that nothing slows has none.
const SLOWEST_RATE: f64 = 1e-12;
/// The most steps across a gap of the log.
const MOST_SUBSTEPS: f64 = 1e3;
/// Innovations that leave all bounds, in ranges of the output.
const BOUNDS: f64 = 1e3;
/// Standard deviation of the filtered position where the record begins, in ranges of the output.
const UNKNOWN_PATH: f64 = 0.1;
/// The same of the late speed, in highest speeds.
const UNKNOWN_SPEED: f64 = 0.5;
/// A turn within this part of a step from its ends does not divide it.
const TURN_INSIDE: f64 = 0.02;
/// Decay over a step below which a coloured error is a random walk: the next term is half of it.
const SLOW_DECAY: f64 = 1e-6;

/// The noise of the model as sizes.
struct NoiseSizes {
    white: f64,
    force: f64,
    colour: f64,
    colour_rate: f64,
    tracking: f64,
}

impl NoiseSizes {
    fn of(model: &VehicleModel) -> Self {
        Self {
            white: model.size(NoiseParameter::White),
            force: model.size(NoiseParameter::Force),
            colour: model.size(NoiseParameter::Colour),
            colour_rate: model.size(NoiseParameter::ColourRate),
            tracking: model.size(NoiseParameter::Tracking),
        }
    }
}

/// Sensitivities of the states to the estimated parameters.
struct Sensitivities<const N: usize> {
    structure: Vec<(Parameter, Vector<N>)>,
    noise: Vec<(NoiseParameter, Vector<N>, Square<N>)>,
}

struct Filter<'a, const N: usize> {
    model: &'a VehicleModel,
    dynamics: Dynamics,
    sizes: NoiseSizes,
    stochastic: bool,
    /// Place of the state that is read.
    read: usize,
    state: Vector<N>,
    covariance: Square<N>,
    sensitivities: Sensitivities<N>,
}

/// Purpose of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Evaluation {
    /// The likelihood alone.
    Likelihood,
    /// Its derivatives too.
    Score,
    /// And those of every prediction.
    Slopes,
}

/// Runs through the record; `None` where the motion diverges.
pub(super) fn run(observations: &Observations, model: &VehicleModel, wanted: Evaluation) -> Option<FilterPass> {
    if model.value(Parameter::MemoryS) > 0.0 {
        run_with::<6>(observations, model, wanted)
    } else if model.value(Parameter::FilterS) > 0.0 {
        run_with::<5>(observations, model, wanted)
    } else {
        run_with::<4>(observations, model, wanted)
    }
}

fn run_with<const N: usize>(
    observations: &Observations,
    model: &VehicleModel,
    wanted: Evaluation,
) -> Option<FilterPass> {
    let derivatives = wanted != Evaluation::Likelihood;
    let actuator = Actuator::new(&observations.pieces, model, observations.range);
    let late = model.mean_lag_s(&[Parameter::DelayS, Parameter::LagS, Parameter::RampS, Parameter::PauseS]);
    let kicks = observations.kicks.iter().filter(|kick| kick.variance_s2 > 0.0);
    let kicks =
        kicks.map(|kick| (kick.at_s + late, IntegrationStop::Kick { jump: kick.jump, variance_s2: kick.variance_s2 }));
    let first = observations.first;
    let mut now = observations.time_s[first];
    let stops = actuator.stops(now, kicks, observations.switched);
    let mut next_stop = 0;
    let mut segment = actuator.segment_at(now);
    let mut filter = Filter::<N>::new(model, observations, derivatives);
    let longest = LONGEST_STEP / filter.dynamics.rate(observations.fastest).max(SLOWEST_RATE);
    if longest < observations.interval_s / MOST_STEPS {
        return None;
    }
    let samples = observations.time_s.len();
    let mut innovations = Vec::with_capacity(samples - first);
    let (mut parts, mut slopes) = (Vec::new(), Vec::new());
    let mut part = Score::zero();
    let (mut log_likelihood, mut all_steps) = (0.0, 0);
    for sample in first..samples {
        let target = observations.time_s[sample];
        loop {
            let stop = stops.get(next_stop).filter(|(time_s, _)| *time_s <= target);
            let end = stop.map_or(target, |(time_s, _)| *time_s);
            let span = end - now;
            if span > 0.0 {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
                let steps = (span / longest).ceil().clamp(1.0, MOST_SUBSTEPS) as usize;
                all_steps += steps;
                let h_s = span / steps as f64;
                let mut begin = actuator.at(segment, now);
                for index in 0..steps {
                    let from = now + index as f64 * h_s;
                    // Drag bends where the vehicle turns: a step ends there.
                    let turn = filter.turn_after(&begin, h_s);
                    for (since, h_s) in turn.map_or([(0.0, h_s), (h_s, 0.0)], |turn| [(0.0, turn), (turn, h_s - turn)])
                    {
                        if h_s > 0.0 {
                            let middle = actuator.at(segment, from + since + 0.5 * h_s);
                            let last = actuator.at(segment, from + since + h_s);
                            filter.advance([begin, middle, last], h_s);
                            begin = last;
                        }
                    }
                }
                now = end;
            }
            let Some((_, stop)) = stop else { break };
            next_stop += 1;
            match *stop {
                IntegrationStop::Segment { jump, paused } => {
                    segment += 1;
                    filter.jump(jump, paused);
                }
                IntegrationStop::Refine => {}
                IntegrationStop::Kick { jump, variance_s2 } => filter.kick(jump, variance_s2),
            }
        }
        let weight = observations.weight[sample];
        if wanted == Evaluation::Slopes {
            slopes.push(filter.slopes());
        }
        let done = (sample + 1 - first) * PARTS / (samples - first);
        if weight == 0.0 {
            innovations.push(Innovation { error: 0.0, variance: 1.0 });
            if derivatives && done > parts.len() {
                parts.push(part.take());
            }
            continue;
        }
        let innovation = filter.observe(observations.output[sample], weight, &mut part);
        if !(innovation.variance > 0.0 && innovation.error.abs() < BOUNDS * observations.span) {
            return None;
        }
        log_likelihood += weight * innovation.log_density();
        innovations.push(innovation);
        if derivatives && done > parts.len() {
            parts.push(part.take());
        }
    }
    log_likelihood.is_finite().then_some(FilterPass {
        log_likelihood,
        innovations,
        parts,
        slopes,
        stochastic: filter.stochastic,
        steps: all_steps,
    })
}

impl<'a, const N: usize> Filter<'a, N> {
    fn new(model: &'a VehicleModel, observations: &Observations, derivatives: bool) -> Self {
        let dynamics = Dynamics {
            alpha: model.value(Parameter::Alpha),
            linear: model.value(Parameter::LinearDrag),
            quadratic: model.value(Parameter::QuadraticDrag),
            cubic: model.value(Parameter::CubicDrag),
            skew: model.value(Parameter::Skew),
            stiffness: model.value(Parameter::Stiffness),
        };
        let sizes = NoiseSizes::of(model);
        let kicked = observations.kicks.iter().any(|kick| kick.variance_s2 > 0.0);
        let random = sizes.force + sizes.colour + sizes.tracking > 0.0;
        let mut covariance = [[0.0; N]; N];
        // The disturbance is the process force's value where the record begins.
        let unseen_s = observations.time_s[observations.first] - observations.time_s[0];
        covariance[2][2] = sizes.force * unseen_s;
        let forgotten = sizes.colour_rate + 1.0 / observations.duration_s();
        covariance[3][3] = 0.5 * sizes.colour / forgotten;
        let read = if N > FILTERED && model.value(Parameter::FilterS) > 0.0 { FILTERED } else { 0 };
        if read == FILTERED {
            // The filtered position before the record is unknown: deviation [`UNKNOWN_PATH`] times the span.
            covariance[FILTERED][FILTERED] = (UNKNOWN_PATH * observations.span).powi(2);
        }
        if N > LATE {
            // The velocity before the record is unknown.
            covariance[LATE][LATE] = (UNKNOWN_SPEED * observations.fastest).powi(2);
        }
        let mut sensitivities = Sensitivities { structure: Vec::new(), noise: Vec::new() };
        if derivatives {
            sensitivities.structure.extend(model.structure().map(|parameter| {
                let mut column = [0.0; N];
                match parameter {
                    Parameter::Position => column[0] = 1.0,
                    Parameter::Velocity => column[1] = 1.0,
                    _ => {}
                }
                if read == FILTERED {
                    column[FILTERED] = match parameter {
                        Parameter::Position => 1.0,
                        Parameter::Velocity => -model.value(Parameter::FilterS),
                        Parameter::FilterS => -model.value(Parameter::Velocity),
                        _ => 0.0,
                    };
                }
                (parameter, column)
            }));
            for noise in NoiseParameter::ALL.into_iter().filter(|noise| model.noise_free[*noise as usize]) {
                let mut begin = [[0.0; N]; N];
                match noise {
                    NoiseParameter::Force => begin[2][2] = covariance[2][2],
                    NoiseParameter::Colour => begin[3][3] = covariance[3][3],
                    NoiseParameter::ColourRate => begin[3][3] = -covariance[3][3] * sizes.colour_rate / forgotten,
                    _ => {}
                }
                sensitivities.noise.push((noise, [0.0; N], begin));
            }
        }
        let mut state = [0.0; N];
        (state[0], state[1]) = (model.value(Parameter::Position), model.value(Parameter::Velocity));
        if read == FILTERED {
            // As if it had moved evenly before.
            state[FILTERED] = state[0] - model.value(Parameter::FilterS) * state[1];
        }
        Self {
            model,
            dynamics,
            sizes,
            stochastic: kicked || random || N > FILTERED,
            read,
            state,
            covariance,
            sensitivities,
        }
    }

    /// When within a step the velocity passes zero, if well inside.
    fn turn_after(&self, force: &Force, h_s: f64) -> Option<f64> {
        let velocity = self.state[1];
        let force = force.value + self.offset();
        let turn = -velocity / self.dynamics.acceleration(self.state[0], velocity, force);
        (turn > TURN_INSIDE * h_s && turn < (1.0 - TURN_INSIDE) * h_s).then_some(turn)
    }

    /// Force in addition to the actuator's, at the beginning of a step.
    fn offset(&self) -> f64 {
        let late = if N > LATE { self.model.value(Parameter::Memory) * self.state[LATE] } else { 0.0 };
        self.model.value(Parameter::Disturbance) + self.state[2] - late
    }

    fn advance(&mut self, forces: [Force; 3], h_s: f64) {
        let before = self.state;
        let alpha = self.dynamics.alpha;
        let begin = Point {
            position: before[0],
            velocity: before[1],
            acceleration: self.dynamics.acceleration(before[0], before[1], forces[0].value + self.offset()),
        };
        let (memory, memory_s) = (self.model.value(Parameter::Memory), self.model.value(Parameter::MemoryS));
        let late =
            (N > LATE).then(|| LateSpeed::along(memory_s, h_s, before[LATE], begin.velocity, begin.acceleration));
        let offset = self.model.value(Parameter::Disturbance) + before[2];
        let late_force = |k: usize| late.map_or(0.0, |late| memory * late.values[k]);
        let pushed = core::array::from_fn(|k| forces[k].value + offset - late_force(k));
        let step = self.dynamics.step((begin.position, begin.velocity), pushed, h_s);
        let mut transition = Transition::new(&step, alpha);
        transition.colour = libm::exp(-self.sizes.colour_rate * h_s);
        self.state[..4].copy_from_slice(&[
            step.end.position,
            step.end.velocity,
            before[2],
            transition.colour * before[3],
        ]);
        let positions = [before[0], step.middle.position, step.end.position];
        let velocities = [before[1], step.middle.velocity, step.end.velocity];
        let sensor = (self.read == FILTERED).then(|| LowPass::new(self.model.value(Parameter::FilterS), h_s));
        if let Some(sensor) = &sensor {
            transition.filter(sensor, &step, h_s, alpha);
            self.state[FILTERED] = sensor.after(before[FILTERED], &positions);
        }
        let wake = late.map(|late| (late, LowPass::new(memory_s, h_s)));
        if let Some((late, low_pass)) = &wake {
            transition.remember(late, low_pass, &step, memory / alpha);
            self.state[LATE] = low_pass.after(before[LATE], &velocities);
        }
        let drives =
            Drives { dynamics: &self.dynamics, step: &step, begin: &begin, forces: &forces, late, memory, h_s };
        for (parameter, column) in &mut self.sensitivities.structure {
            let [end, velocity, middle] = drives.by(*parameter);
            *column = transition.apply(column);
            column[0] += end;
            column[1] += velocity;
            if let Some(sensor) = &sensor {
                column[FILTERED] += sensor.weights[1] * middle + sensor.weights[2] * end;
                if *parameter == Parameter::FilterS {
                    column[FILTERED] += sensor.after_by_time(before[FILTERED], &positions);
                }
            }
            if let Some((_, low_pass)) = &wake {
                column[LATE] += transition.late[2] * velocity;
                if *parameter == Parameter::MemoryS {
                    column[LATE] += low_pass.after_by_time(before[LATE], &velocities);
                }
            }
        }
        if self.stochastic {
            self.spread(&transition, &before, h_s);
        }
    }

    /// Covariance over a step, with its sensitivities.
    fn spread(&mut self, transition: &Transition, before: &Vector<N>, h_s: f64) {
        let alpha = self.dynamics.alpha;
        let NoiseSizes { force, colour, colour_rate, tracking, .. } = self.sizes;
        // A force that walks at random, integrated twice; drag within a step is neglected.
        let walk = |intensity: f64| {
            let (h2, h3) = (h_s * h_s, h_s * h_s * h_s);
            let mut q = [[0.0; N]; N];
            q[2][2] = intensity * h_s;
            (q[1][2], q[2][1]) = (0.5 * intensity * h2 / alpha, 0.5 * intensity * h2 / alpha);
            (q[0][2], q[2][0]) = (intensity * h3 / (6.0 * alpha), intensity * h3 / (6.0 * alpha));
            q[1][1] = intensity * h3 / (3.0 * alpha * alpha);
            (q[0][1], q[1][0]) =
                (intensity * h2 * h2 / (8.0 * alpha * alpha), intensity * h2 * h2 / (8.0 * alpha * alpha));
            q[0][0] = intensity * h2 * h3 / (20.0 * alpha * alpha);
            q
        };
        let white = |intensity: f64| {
            let mut q = [[0.0; N]; N];
            q[1][1] = intensity * h_s;
            (q[0][1], q[1][0]) = (0.5 * intensity * h_s * h_s, 0.5 * intensity * h_s * h_s);
            q[0][0] = intensity * h_s * h_s * h_s / 3.0;
            q
        };
        // Variance that the coloured error gains, and its derivative with respect to the logarithm of the rate.
        let decayed = 2.0 * colour_rate * h_s;
        let (gained, gained_by_rate) = if decayed > SLOW_DECAY {
            let gained = -colour * libm::expm1(-decayed) / (2.0 * colour_rate);
            (gained, colour * h_s * libm::exp(-decayed) - gained)
        } else {
            (colour * h_s, 0.0)
        };
        let covariance = self.covariance;
        for (noise, column, derivative) in &mut self.sensitivities.noise {
            *column = transition.apply(column);
            *derivative = transition.turn(derivative);
            match noise {
                NoiseParameter::Force => add(derivative, &walk(force)),
                NoiseParameter::Tracking => add(derivative, &white(tracking)),
                NoiseParameter::Colour => derivative[3][3] += gained,
                NoiseParameter::ColourRate => {
                    derivative[3][3] += gained_by_rate;
                    let by_log = -h_s * colour_rate * transition.colour;
                    column[3] += by_log * before[3];
                    // F P dF' and its transpose.
                    let along = transition.apply(&covariance[3]);
                    for (other, value) in along.iter().enumerate() {
                        derivative[3][other] += by_log * value;
                        derivative[other][3] += by_log * value;
                    }
                }
                NoiseParameter::White => {}
            }
        }
        self.covariance = transition.turn(&covariance);
        if force > 0.0 {
            add(&mut self.covariance, &walk(force));
        }
        if tracking > 0.0 {
            add(&mut self.covariance, &white(tracking));
        }
        self.covariance[3][3] += gained;
    }

    /// The force jumps: the velocity lags behind a later jump, by delay or, at the end of a pause, by its length.
    fn jump(&mut self, jump: f64, paused: bool) {
        for (parameter, column) in &mut self.sensitivities.structure {
            if *parameter == Parameter::DelayS || (paused && *parameter == Parameter::PauseS) {
                column[1] -= jump / self.dynamics.alpha;
            }
        }
    }

    /// The force jumps at an instant that is off by a random d of given variance: velocity is off by `-jump d / alpha`, and
    /// position by `jump d^2 / (2 alpha)`, of given mean and of the variance of uniform d.
    fn kick(&mut self, jump: f64, variance_s2: f64) {
        let per_second = jump / self.dynamics.alpha;
        self.covariance[1][1] += per_second * per_second * variance_s2;
        self.state[0] += 0.5 * per_second * variance_s2;
        self.covariance[0][0] += 0.2 * (per_second * variance_s2).powi(2);
        for (parameter, column) in &mut self.sensitivities.structure {
            if *parameter == Parameter::Alpha {
                column[0] -= 0.5 * per_second * variance_s2 / self.dynamics.alpha;
            }
        }
    }
}
