//! Motion of the model over a shooting interval of the record, with its derivatives.

use super::input::Edge;
use crate::identify::answer::IdentifyError;
use crate::numeric::{self, Real, Scalar};

type Partials = numeric::Gradient<f64, 4>;
use crate::plant::{DragAxis, State};

/// Unknowns of a shooting interval: instant of its uncertain edge, state at its beginning, disturbance, then the common unknowns.
pub(super) const UNKNOWNS: usize = 8;
pub(super) const INSTANT: usize = 0;
pub(super) const POSITION: usize = 1;
pub(super) const VELOCITY: usize = 2;
pub(super) const DISTURBANCE: usize = 3;
/// The first unknown common to all records: alpha, linear drag, quadratic drag, delay.
pub(super) const COMMON: usize = 4;
/// The last of them.
const DELAY: usize = UNKNOWNS - 1;
/// Number of common unknowns.
pub(super) const SHARED: usize = UNKNOWNS - COMMON;

pub(super) type UnknownsGradient = [f64; UNKNOWNS];

/// A number and its derivatives with respect to the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutputSensitivity {
    pub(super) value: f64,
    pub(super) gradient: UnknownsGradient,
}

/// A shooting interval of the record: between successive nodes.
#[derive(Clone, Debug)]
pub(super) struct ShootingInterval {
    pub(super) begin_s: f64,
    pub(super) end_s: f64,
    /// Samples in it: indices into the record.
    pub(super) samples: core::ops::Range<usize>,
    /// Where the model begins it; not where the shooting interval before ends, until the estimate has settled.
    pub(super) start: State<f64>,
}

/// Edges that act during a shooting interval, and the command before them.
pub(super) struct ActingEdges<'a> {
    pub(super) before: f64,
    pub(super) edges: &'a [Edge],
    /// Deviation of each edge from its time, as estimated.
    pub(super) deviations: &'a [f64],
}

/// Common unknowns: alpha, linear drag, quadratic drag, delay in s.
pub(super) type CommonParameters = [f64; SHARED];

/// The motion under a piecewise constant force, with its derivatives.
struct ConstantForceFlow {
    shared: CommonParameters,
    disturbance: f64,
    input: f64,
    now: OutputSensitivity,
    position: OutputSensitivity,
    velocity: OutputSensitivity,
}

impl ConstantForceFlow {
    /// Position and velocity at `time`, `input` acting since `now`.
    ///
    /// The passage depends on speed, drive and drags (all over the inertia) and the duration; the last derivative is the
    /// equation of motion itself, so that four are carried through the closed forms.
    fn at(&self, time: &OutputSensitivity) -> Result<[OutputSensitivity; 2], IdentifyError> {
        let [alpha, linear, quadratic, _] = self.shared;
        let force = (self.input + self.disturbance) / alpha;
        let [speed, drive, linear, quadratic] =
            Partials::variables([self.velocity.value, force, linear / alpha, quadratic / alpha]);
        let axis = DragAxis::mixed(Partials::one(), linear, quadratic)?;
        let state = State { position: Partials::zero(), velocity: speed };
        let duration = time.value - self.now.value;
        let end = axis.advance(state, drive, Partials::from_f64(duration));
        let speed = end.velocity.value();
        let acceleration = force - (linear.value() + quadratic.value() * speed.abs()) * speed;
        let position = self.sensitive(end.position, speed, time);
        let velocity = self.sensitive(end.velocity, acceleration, time);
        let mut moved = position;
        moved.value += self.position.value;
        moved.gradient.iter_mut().zip(self.position.gradient).for_each(|(sum, before)| *sum += before);
        Ok([moved, velocity])
    }

    /// By the chain rule from the flow's own variables and its rate to the unknowns.
    fn sensitive(&self, number: Partials, rate: f64, time: &OutputSensitivity) -> OutputSensitivity {
        let [by_speed, by_drive, by_linear, by_quadratic] = number.slopes();
        let [alpha, linear, quadratic, _] = self.shared;
        let mut gradient = self.velocity.gradient.map(|slope| by_speed * slope);
        for k in [INSTANT, DELAY] {
            gradient[k] += rate * (time.gradient[k] - self.now.gradient[k]);
        }
        let force = self.input + self.disturbance;
        gradient[DISTURBANCE] += by_drive / alpha;
        gradient[COMMON] -= (by_drive * force + by_linear * linear + by_quadratic * quadratic) / (alpha * alpha);
        gradient[COMMON + 1] += by_linear / alpha;
        gradient[COMMON + 2] += by_quadratic / alpha;
        OutputSensitivity { value: number.value(), gradient }
    }
}

/// Index, among the edges of a shooting interval, of the edge whose instant is estimated.
pub(super) fn uncertain(edges: &[Edge]) -> Option<usize> {
    edges.iter().position(|edge| edge.std_s > 0.0)
}

/// Outputs at the shooting interval's samples (every `stride`-th) into `rows`, and position and velocity at its end.
pub(super) fn integrate(
    interval: &ShootingInterval,
    drive: &ActingEdges<'_>,
    time_s: &[f64],
    (shared, disturbance): (&CommonParameters, f64),
    stride: usize,
    rows: &mut Vec<(usize, OutputSensitivity)>,
) -> Result<[OutputSensitivity; 2], IdentifyError> {
    let exactly = |value: f64| OutputSensitivity { value, gradient: [0.0; UNKNOWNS] };
    let seed = |value: f64, index: usize| {
        let mut unknown = exactly(value);
        unknown.gradient[index] = 1.0;
        unknown
    };
    let mut flow = ConstantForceFlow {
        shared: *shared,
        disturbance,
        input: drive.before,
        now: exactly(interval.begin_s),
        position: seed(interval.start.position, POSITION),
        velocity: seed(interval.start.velocity, VELOCITY),
    };
    let free = uncertain(drive.edges);
    let mut next = 0;
    let mut act = |until: f64, flow: &mut ConstantForceFlow| {
        while let Some(edge) = drive.edges.get(next) {
            let mut time = seed(edge.time_s + drive.deviations[next] + shared[SHARED - 1], DELAY);
            if free == Some(next) {
                time.gradient[INSTANT] = 1.0;
            }
            if time.value > until {
                break;
            }
            if time.value > flow.now.value {
                [flow.position, flow.velocity] = flow.at(&time)?;
                flow.now = time;
            }
            flow.input = edge.input;
            next += 1;
        }
        Ok::<(), IdentifyError>(())
    };
    for sample in interval.samples.clone().step_by(stride) {
        act(time_s[sample], &mut flow)?;
        let [output, _] = flow.at(&exactly(time_s[sample]))?;
        rows.push((sample, output));
    }
    act(interval.end_s, &mut flow)?;
    flow.at(&exactly(interval.end_s))
}
