//! Readings that no neighbour supports.

use crate::experiment::Record;

/// Standard deviation of a normal distribution over the median of its magnitude.
const NORMAL_OVER_MEDIAN: f64 = 1.483;
/// And at least this number of sensor steps.
const FAR_STEPS: f64 = 3.0;
/// Neighbours further apart than this number of intervals are not used.
const NEIGHBOURHOOD: f64 = 4.5;
/// Readings further from the line through their neighbours than this many robust standard deviations are outliers.
const FAR: f64 = 6.0;
/// A record with a larger share of them has no outliers but another noise.
const MOST_OUTLIERS: f64 = 0.1;

/// Readings far from the line through their neighbours, the farthest first, each judged after removal of its predecessors.
pub(crate) fn outliers(record: &Record) -> Vec<usize> {
    let (time, output) = (record.time_s(), record.output());
    let off = |a: usize, b: usize, c: usize| {
        let part = (time[b] - time[a]) / (time[c] - time[a]);
        output[b] - output[a] - part * (output[c] - output[a])
    };
    let mut sizes: Vec<f64> = (1..output.len() - 1).map(|k| off(k - 1, k, k + 1).abs()).collect();
    let middle = sizes.len() / 2;
    let typical = NORMAL_OVER_MEDIAN * *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
    let limit = (FAR * typical).max(FAR_STEPS * record.quantum().unwrap_or(0.0));
    let mut kept: Vec<usize> = (0..output.len()).collect();
    loop {
        let size = |place: usize| {
            if place == 0 || place + 1 >= kept.len() {
                return 0.0;
            }
            let (a, b, c) = (kept[place - 1], kept[place], kept[place + 1]);
            if time[c] - time[a] > NEIGHBOURHOOD * record.interval_s() { 0.0 } else { off(a, b, c).abs() }
        };
        let far = |place: usize| {
            let here = size(place);
            here > limit && here >= size(place - 1) && here > size(place + 1)
        };
        let out: Vec<usize> = (1..kept.len() - 1).filter(|place| far(*place)).map(|place| kept[place]).collect();
        if out.is_empty() {
            break;
        }
        kept.retain(|sample| out.binary_search(sample).is_err());
        if ((output.len() - kept.len()) as f64) > MOST_OUTLIERS * output.len() as f64 {
            return Vec::new();
        }
    }
    (0..output.len()).filter(|sample| kept.binary_search(sample).is_err()).collect()
}
