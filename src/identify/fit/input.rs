//! The command between the samples of a log.

use crate::experiment::Record;

/// What the command does between two samples of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// It changes at the sample with which its new value is logged: the relay worked on that very sample.
    AtSamples,
    /// It changes at an unknown instant since the sample before; every such instant is estimated.
    Anywhere,
    /// It passes evenly from one sample's value to the next's: a rudder, a ramp.
    Evenly,
}

/// A change of the command.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// When, on the log's clock; the middle of what is possible where it is not known.
    pub(super) time_s: f64,
    /// Command afterwards.
    pub(super) input: f64,
    /// Standard deviation of the time; zero where it is known.
    pub(super) std_s: f64,
}

/// The most distinct values that a switched command has.
const MOST_LEVELS: usize = 4;

/// Whether a command is switched between few values rather than moved.
pub(super) fn switched(record: &Record) -> bool {
    let mut levels: Vec<f64> = Vec::new();
    for &value in record.input() {
        if !levels.contains(&value) {
            levels.push(value);
        }
        if levels.len() > MOST_LEVELS {
            return false;
        }
    }
    true
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
            _ if change == 0.0 => {}
            Between::AtSamples => edges.push(Edge { time_s: time[after], input: input[after], std_s: 0.0 }),
            Between::Anywhere => edges.push(Edge {
                time_s: time[before] + 0.5 * interval,
                input: input[after],
                std_s: interval / 12f64.sqrt(),
            }),
            // Two constant pieces with the ramp's impulse and its moment.
            Between::Evenly => {
                for (share, part) in [(1.0 / 6.0, 0.0), (5.0 / 6.0, 0.5), (1.0, 1.0)] {
                    let time_s = time[before] + part * interval;
                    edges.push(Edge { time_s, input: input[before] + share * change, std_s: 0.0 });
                }
            }
        }
    }
    edges
}
