//! Motion of the model over a stretch of the record, with its derivatives.

use nalgebra::{Const, U1};
use num_dual::DualSVec64;

use super::input::Edge;
use crate::identify::IdentifyError;
use crate::plant::{DragAxis, State};

/// Unknowns of a stretch: instant of its uncertain edge, state at its beginning, disturbance, then what is common to all.
pub(super) const UNKNOWNS: usize = 8;
pub(super) const INSTANT: usize = 0;
pub(super) const POSITION: usize = 1;
pub(super) const VELOCITY: usize = 2;
pub(super) const DISTURBANCE: usize = 3;
/// The first unknown common to all records: alpha, linear drag, quadratic drag, delay.
pub(super) const COMMON: usize = 4;
/// Number of common unknowns.
pub(super) const SHARED: usize = UNKNOWNS - COMMON;

type Dual = DualSVec64<UNKNOWNS>;
pub(super) type Gradient = [f64; UNKNOWNS];

/// A number and its derivatives with respect to the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sensitive {
    pub(super) value: f64,
    pub(super) gradient: Gradient,
}

/// A stretch of the record: from one node to the next.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub(super) begin_s: f64,
    pub(super) end_s: f64,
    /// Samples in it: indices into the record.
    pub(super) samples: core::ops::Range<usize>,
    /// Where the model begins it; not where the stretch before ends, until the estimate has settled.
    pub(super) start: State<f64>,
}

/// Edges that act during a stretch, and the command before them.
pub(super) struct Drive<'a> {
    pub(super) before: f64,
    pub(super) edges: &'a [Edge],
    /// Deviation of each edge from its time, as estimated.
    pub(super) deviations: &'a [f64],
}

/// Common unknowns: alpha, linear drag, quadratic drag, delay in s.
pub(super) type Shared = [f64; SHARED];

fn seed(value: f64, index: usize) -> Dual {
    Dual::from_re(value).derivative(index)
}

fn sensitive(value: &Dual) -> Sensitive {
    Sensitive { value: value.re, gradient: value.eps.unwrap_generic(Const, U1).into() }
}

/// Index, among the edges of a stretch, of the one whose instant is estimated.
pub(super) fn uncertain(edges: &[Edge]) -> Option<usize> {
    edges.iter().position(|edge| edge.std_s > 0.0)
}

/// Outputs at the stretch's samples (every `stride`-th) into `rows`, and position and velocity at its end.
pub(super) fn integrate(
    stretch: &Stretch,
    drive: &Drive<'_>,
    time_s: &[f64],
    (shared, disturbance): (&Shared, f64),
    stride: usize,
    rows: &mut Vec<(usize, Sensitive)>,
) -> Result<[Sensitive; 2], IdentifyError> {
    let common = |k: usize| seed(shared[k], COMMON + k);
    let axis = DragAxis::mixed(common(0), common(1), common(2))?
        .with_disturbance(seed(disturbance, DISTURBANCE))?
        .with_delay_s(common(3))?;
    let mut now = Dual::from_re(stretch.begin_s);
    let mut state =
        State { position: seed(stretch.start.position, POSITION), velocity: seed(stretch.start.velocity, VELOCITY) };
    let mut input = drive.before;
    let free = uncertain(drive.edges);
    let mut next = 0;
    let mut act = |until: f64, now: &mut Dual, state: &mut State<Dual>, input: &mut f64| {
        while let Some(edge) = drive.edges.get(next) {
            let time = edge.time_s + drive.deviations[next];
            let time = if free == Some(next) { seed(time, INSTANT) } else { Dual::from_re(time) };
            let time = time + axis.delay_s();
            if time.re > until {
                return;
            }
            if time.re > now.re {
                *state = axis.advance(*state, Dual::from_re(*input), time - *now);
                *now = time;
            }
            *input = edge.input;
            next += 1;
        }
    };
    for sample in stretch.samples.clone().step_by(stride) {
        act(time_s[sample], &mut now, &mut state, &mut input);
        let output = axis.advance(state, Dual::from_re(input), Dual::from_re(time_s[sample]) - now).position;
        rows.push((sample, sensitive(&output)));
    }
    act(stretch.end_s, &mut now, &mut state, &mut input);
    let end = axis.advance(state, Dual::from_re(input), Dual::from_re(stretch.end_s) - now);
    Ok([sensitive(&end.position), sensitive(&end.velocity)])
}
