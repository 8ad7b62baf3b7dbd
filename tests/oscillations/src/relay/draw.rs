//! Random loops of first to third order, each the same for its seed.

use super::control_loop::RelayLoop;
use crate::plant::{Plant, multiply};
use crate::random::Random;

/// First seed of reports: development uses seeds below 1000, reports those from here on.
pub const FIRST_REPORT_SEED: u64 = 1_000_000;

/// What a plant is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    /// `1/(tau s + 1)`.
    Lag,
    /// The lag before once more.
    SameLag,
    /// `1/(tau s - 1)`.
    Unstable,
    /// `1/(tau s)`.
    Integrator,
    /// `1/(tau^2 s^2 + 2 zeta tau s + 1)`.
    Pair,
    /// The same with negative damping.
    UnstablePair,
}

use Part::{Integrator, Lag, Pair, SameLag, Unstable, UnstablePair};

/// The plants, each as often as it is listed within its order; the orders are equally likely.
const FIRST: &[&[Part]] = &[&[Lag], &[Lag], &[Integrator], &[Unstable]];
const SECOND: &[&[Part]] = &[
    &[Lag, Lag],
    &[Lag, Lag],
    &[Lag, SameLag],
    &[Pair],
    &[Pair],
    &[Integrator, Lag],
    &[Integrator, Lag],
    &[Integrator, Integrator],
    &[Unstable, Lag],
    &[Unstable, Lag],
    &[Unstable, Integrator],
    &[UnstablePair],
];
const THIRD: &[&[Part]] = &[
    &[Lag, Lag, Lag],
    &[Lag, SameLag, SameLag],
    &[Lag, SameLag, Lag],
    &[Pair, Lag],
    &[Pair, Lag],
    &[Integrator, Lag, Lag],
    &[Integrator, Lag, SameLag],
    &[Integrator, Pair],
    &[Integrator, Pair],
    &[Integrator, Integrator, Lag],
    &[Unstable, Lag, Lag],
    &[Unstable, Pair],
    &[UnstablePair, Lag],
];

/// The loop of a seed.
///
/// Times: the first part's 0.1 to 10 s, further ones 0.05 to 1 times that (uniform logarithms), damping 0.05 to 0.9; gain 0.3 to 3.
/// From second order on one plant in four has a zero at 0.05 to 2 times the first time, two in five of them in the right half plane.
/// Dead time: none in one of five, else uniform up to three times the first time (up to 0.6 times in two of three plants with an
/// unstable pole, which tolerate no more). Levels: 0.3 to 3, the lower one 0.3 to 3 times the upper one, equal in one of five,
/// zero in one of ten without integrator. Half-width: none in one of four with dead time, else 0.005 to 0.5 times the output that
/// half the step between the levels makes. Reference: zero in half the loops where the relay can hold the output there, else
/// uniform in the middle 80 % of what the levels reach.
#[must_use]
pub fn draw(seed: u64) -> RelayLoop {
    let mut random = Random::new(seed, 1);
    let parts = {
        let order = random.pick(&[FIRST, SECOND, THIRD]);
        random.pick(order)
    };
    let time = random.log_uniform(0.1, 10.0);
    let gain = random.log_uniform(0.3, 3.0);
    let (mut den, mut num) = (vec![1.0], vec![gain]);
    let mut tau = time;
    for (index, part) in parts.iter().enumerate() {
        if index > 0 && *part != SameLag {
            tau = time * random.log_uniform(0.05, 1.0);
        }
        let zeta = random.log_uniform(0.05, 0.9);
        den = multiply(
            &den,
            &match part {
                Lag | SameLag => vec![tau, 1.0],
                Unstable => vec![tau, -1.0],
                Integrator => vec![tau, 0.0],
                Pair => vec![tau * tau, 2.0 * zeta * tau, 1.0],
                UnstablePair => vec![tau * tau, -2.0 * zeta * tau, 1.0],
            },
        );
    }
    if den.len() > 2 && random.chance(0.25) {
        let sign = if random.chance(0.4) { -1.0 } else { 1.0 };
        num = multiply(&num, &[sign * time * random.log_uniform(0.05, 2.0), 1.0]);
    }
    let unstable = parts.iter().any(|part| matches!(part, Unstable | UnstablePair));
    let integrators = parts.iter().filter(|part| **part == Integrator).count();
    let delay = if random.chance(0.2) {
        0.0
    } else if unstable && random.chance(2.0 / 3.0) {
        time * random.uniform(0.0, 0.6)
    } else {
        time * random.uniform(0.0, 3.0)
    };

    let high = random.log_uniform(0.3, 3.0);
    let low = if integrators == 0 && !unstable && random.chance(0.1) {
        0.0
    } else if random.chance(0.2) {
        -high
    } else {
        -high * random.log_uniform(0.3, 3.0)
    };
    let reach = 0.5 * gain * (high - low);
    let half_width = if delay > 0.0 && random.chance(0.25) { 0.0 } else { reach * random.log_uniform(0.005, 0.5) };
    // A pole at the origin lets the output rest anywhere; an unstable one changes the sign of the static gain.
    let middle =
        if integrators > 0 { 0.0 } else { 0.5 * gain * (high + low) * if unstable_gain(&den) { -1.0 } else { 1.0 } };
    let zero_is_held = low < 0.0 && (middle.abs() + half_width < reach || integrators > 0);
    let reference = if zero_is_held && random.chance(0.5) {
        0.0
    } else {
        middle + 0.8 * (reach - half_width).max(0.0) * random.uniform(-1.0, 1.0)
    };
    RelayLoop { plant: Plant { num, den, delay }, high, low, half_width, reference }
}

fn unstable_gain(den: &[f64]) -> bool {
    den.last().is_some_and(|&constant| constant < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_loop_can_be_simulated_and_the_kinds_are_all_there() {
        let loops: Vec<RelayLoop> = (0..1000).map(draw).collect();
        assert!(loops.iter().all(|one| one.check().is_ok()));
        let share = |what: fn(&RelayLoop) -> bool| loops.iter().filter(|one| what(one)).count();
        for order in 1..=3 {
            let count = loops.iter().filter(|one| one.plant.order() == order).count();
            assert!(count > 250, "{count} of order {order}");
        }
        assert!(share(|one| one.plant.delay == 0.0) > 100);
        assert!(share(|one| one.half_width == 0.0) > 100);
        assert!(share(|one| one.low == 0.0) > 20);
        assert!(share(|one| one.plant.den.last() == Some(&0.0)) > 200);
        assert!(share(|one| one.plant.num.len() == 2) > 100);
        assert_eq!(draw(7), draw(7));
    }
}
