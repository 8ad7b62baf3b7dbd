//! Roundings that repeat: where the cycle locks to the sampling, wholly or nearly, many half cycles are a single experiment made several
//! times, and their readings count once.

use super::numbers::ends;

/// The half cycles with which each is compared.
const MOST_COMPARED: usize = 64;
/// The part of a step from which on roundings no longer correlate.
const STILL_ALIKE: f64 = 0.211;

/// Half cycles of rounded readings that repeat, by whole steps apart or by their mirror image too, are a single experiment made
/// several times: each reading weighs 1/n, with n the number of its repetitions.
pub(crate) fn weights_of_repeats(output: &[f64], input: &[f64], step: f64) -> Vec<f64> {
    let mut bounds = vec![0];
    bounds.extend((1..input.len()).filter(|k| input[*k] != input[*k - 1]));
    bounds.push(input.len());
    let (low, high) = ends(input);
    // In steps, so that the mirror image of a rounded reading is rounded too.
    let half = |pair: &[usize]| {
        let sign = if input[pair[0]] < f64::midpoint(low, high) { -1.0 } else { 1.0 };
        let steps = |value: &f64| sign * ((value - output[0]) / step).round();
        (pair[0], output[pair[0]..pair[1]].iter().map(steps).collect::<Vec<f64>>())
    };
    let mut halves: Vec<(usize, Vec<f64>)> = bounds.windows(2).map(half).filter(|(_, half)| half.len() > 2).collect();
    halves.sort_by_key(|(_, half)| half.len());
    let mut weight = vec![1.0; output.len()];
    for (place, (begin, half)) in halves.iter().enumerate() {
        let from = halves.partition_point(|(_, other)| 10 * other.len() < 9 * half.len());
        let until = halves.partition_point(|(_, other)| 9 * other.len() <= 10 * half.len());
        let (sum, count) = spread_over(until - from, MOST_COMPARED)
            .filter(|index| from + index != place)
            .fold((0.0, 0.0), |(sum, count), index| (sum + likeness(half, &halves[from + index].1), count + 1.0));
        let likes = if count > 0.0 { sum / count * (until - from - 1) as f64 } else { 0.0 };
        weight[*begin..begin + half.len()].fill(1.0 / (1.0 + likes));
    }
    weight
}

/// How the roundings of two half cycles correlate, given their readings in steps from the switching on.
///
/// Where the motions differ by n + d steps, a share d of the readings differs by n + 1 steps, and the
/// roundings correlate by `1 - 6 d + 6 d^2` (Bennett 1948).
fn likeness(half: &[f64], other: &[f64]) -> f64 {
    let apart = || half.iter().zip(other).map(|(a, b)| a - b);
    let count = half.len().min(other.len()) as f64;
    let whole = (apart().sum::<f64>() / count).floor();
    let of = |steps: f64| apart().filter(|apart| *apart == steps).count() as f64;
    let d = 1.0 - of(whole).max(of(whole + 1.0)) / count;
    if d < STILL_ALIKE { 1.0 - 6.0 * d * (1.0 - d) } else { 0.0 }
}

/// At most `most` of the numbers below `count`, spread evenly and in step with no period (Weyl 1916).
fn spread_over(count: usize, most: usize) -> impl Iterator<Item = usize> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let all = count <= most;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number below the count")]
    let spread = move |k: usize| ((k as f64 * GOLDEN).fract() * count as f64) as usize;
    (0..count.min(most)).map(move |k| if all { k } else { spread(k) })
}

#[cfg(test)]
mod tests {
    use super::{spread_over, weights_of_repeats as weights};

    const STEP: f64 = 0.5;
    const LENGTH: usize = 20;

    /// Readings of half cycles, each begun so many steps from the first, rounded; the command changes between them.
    fn half_cycles(begins: impl Iterator<Item = f64>) -> (Vec<f64>, Vec<f64>) {
        let motion = |k: usize| 9.3 * (0.15 * k as f64).sin() + 0.7 * k as f64;
        let half = |(index, begin): (usize, f64)| {
            let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
            (0..LENGTH).map(move |k| (STEP * sign * (begin + motion(k)).round(), sign))
        };
        begins.enumerate().flat_map(half).unzip()
    }

    fn counted(begins: impl Iterator<Item = f64>) -> f64 {
        let (output, input) = half_cycles(begins);
        weights(&output, &input, STEP).iter().sum::<f64>() / LENGTH as f64
    }

    #[test]
    fn half_cycles_that_repeat_count_once_however_many() {
        for count in [2, 7, 64, 65, 130, 400] {
            let alike = counted((0..count).map(|_| 0.2));
            assert!((alike - 1.0).abs() < 1e-9, "{count} alike count {alike}");
            let steps_apart = counted((0..count).map(|index| 0.2 + 3.0 * f64::from(index % 5)));
            assert!((steps_apart - 1.0).abs() < 1e-9, "{count} whole steps apart count {steps_apart}");
        }
    }

    /// Two kinds in turn, in every order of which a fixed stride would see one kind alone.
    #[test]
    fn a_cycle_of_several_half_cycles_counts_as_many() {
        for period in [2, 3, 4] {
            let counted = counted((0..64 * period).map(|index| f64::from(index % period) / f64::from(period)));
            assert!((counted / f64::from(period) - 1.0).abs() < 0.1, "{period} kinds count {counted}");
        }
    }

    #[test]
    fn half_cycles_that_are_not_alike_all_count() {
        let (output, input) = half_cycles((0..90).map(|_| 0.2));
        // Steps without a pattern: the upper bits of a linear congruential generator (Knuth).
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            STEP * f64::from((state >> 62) as u8)
        };
        let noisy: Vec<f64> = output.iter().map(|y| y + noise()).collect();
        let counted: f64 = weights(&noisy, &input, STEP).iter().sum();
        assert!(counted > 0.9 * output.len() as f64, "{counted} of {}", output.len());
    }

    #[test]
    fn a_spread_sample_favours_no_period() {
        for period in [2, 3, 5] {
            let seen = spread_over(960, 64).filter(|index| index % period == 0).count();
            assert!(seen * period > 32 && seen * period < 128, "{seen} of 64 at period {period}");
        }
        assert!(spread_over(5, 64).eq(0..5));
    }
}
