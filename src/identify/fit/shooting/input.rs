//! The command between the samples of a log.

use crate::experiment::Record;

/// Course of the command between two samples of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Between {
    /// It changes at the sample with which its new value is logged: the relay worked on that very sample.
    AtSamples,
    /// It changes at an unknown instant since the sample before; every such instant is estimated.
    Anywhere,
    /// Linear from each sample to the next.
    Evenly,
    /// It moves steadily, but its corners lie between samples, as a rudder's at a limited rate do: it bends where the straight
    /// lines from either side meet, or follows the curve through its neighbours. Where it jumps, the instant is estimated.
    Bent,
}

/// A change of the command.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// When, on the log's clock; the middle of its interval where it is uncertain.
    pub(super) time_s: f64,
    /// Command afterwards.
    pub(super) input: f64,
    /// Standard deviation of the time; zero where it is known.
    pub(super) std_s: f64,
    /// Variance of a further impulse of the command, in command units times s, squared.
    variance: f64,
}

/// The changes of the command after its first value.
pub(super) fn edges(record: &Record, between: Between) -> Vec<Edge> {
    let (time, input) = (record.time_s(), record.input());
    let mut edges = Vec::new();
    for after in 1..record.samples() {
        let before = after - 1;
        let interval = time[after] - time[before];
        let change = input[after] - input[before];
        match between {
            Between::AtSamples | Between::Anywhere if change == 0.0 => {}
            Between::AtSamples => {
                edges.push(Edge { time_s: time[after], input: input[after], std_s: 0.0, variance: 0.0 })
            }
            Between::Anywhere => edges.push(Edge {
                time_s: time[before] + 0.5 * interval,
                input: input[after],
                std_s: interval / 12f64.sqrt(),
                variance: 0.0,
            }),
            Between::Evenly | Between::Bent => {
                let bulge = if between == Between::Bent { bulges(input, before) } else { Bulge::NONE };
                if change == 0.0 && bulge == Bulge::NONE {
                    continue;
                }
                // Two constant pieces with the ramp's impulse and its moment.
                for (level, part, variance) in [
                    (input[before] + change / 6.0 + bulge.mean, 0.0, 0.0),
                    (input[before] + change / 1.2 + bulge.mean, 0.5, (bulge.std * interval).powi(2)),
                    (input[after], 1.0, 0.0),
                ] {
                    let time_s = time[before] + part * interval;
                    edges.push(Edge { time_s, input: level, std_s: 0.0, variance });
                }
            }
        }
    }
    edges
}

/// How far the command lies above the straight line between two samples, on the mean over the interval.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bulge {
    mean: f64,
    std: f64,
}

impl Bulge {
    const NONE: Self = Self { mean: 0.0, std: 0.0 };
}

/// The bulge between samples `before` and the next, from the differences of slope at both and at their neighbours.
fn bulges(input: &[f64], before: usize) -> Bulge {
    let turn = |at: Option<usize>| match at.and_then(|at| input.get(at.checked_sub(1)?..at + 2)) {
        Some(&[left, middle, right]) => right - 2.0 * middle + left,
        _ => 0.0,
    };
    let (left, right) = (turn(Some(before)), turn(Some(before + 1)));
    let least = left.abs().min(right.abs());
    if left * right <= 0.0 {
        // A step or a whole ramp between the two samples, at any instant.
        return Bulge { mean: 0.0, std: least / 12f64.sqrt() };
    }
    // A corner alone turns at two samples, in shares that say where it is; a curve turns at all of them alike.
    let beyond = turn(before.checked_sub(1)).abs() + turn(Some(before + 2)).abs();
    let alone = (1.0 - beyond / (left + right).abs()).max(0.0);
    let corner = 0.5 * left * right / (left + right);
    let curve = least.copysign(left) / 12.0;
    Bulge { mean: -(alone * corner + (1.0 - alone) * curve), std: 0.0 }
}

/// Most by which an edge may err, in intervals between samples: it must not change places with another.
const LARGEST_SHIFT: f64 = 0.2;

/// Makes the instant of the largest change in each shooting interval uncertain, by as much as the impulses within the interval are: one
/// instant per interval is the least number of unknowns. `interval_of` numbers the interval in which an edge acts.
pub(super) fn gather(edges: &mut [Edge], before: f64, interval_of: impl Fn(f64) -> usize) {
    let mut from = 0;
    let mut level = before;
    while from < edges.len() {
        let interval = interval_of(edges[from].time_s);
        let (mut to, mut variance, mut largest) = (from, 0.0, (0.0, from));
        while to < edges.len() && interval_of(edges[to].time_s) == interval {
            variance += edges[to].variance;
            let change = (edges[to].input - level).abs();
            if change > largest.0 {
                largest = (change, to);
            }
            level = edges[to].input;
            to += 1;
        }
        if variance > 0.0 {
            let interval_s = edges.get(largest.1 + 1).map_or(0.0, |next| 2.0 * (next.time_s - edges[largest.1].time_s));
            edges[largest.1].std_s = (variance.sqrt() / largest.0).min(LARGEST_SHIFT * interval_s);
        }
        from = to;
    }
}
