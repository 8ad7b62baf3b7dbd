use super::super::super::field::TERMS;
use super::super::super::mix::{By, Mix};
use super::*;

const GAIN: f64 = 1.5;
const RATE: f64 = 0.8;
const DROP: f64 = -2.0;

/// Linear drag, with a gain within this share of the middle one.
fn field(share: f64) -> Field {
    let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
    let gain = Interval::point(GAIN).inflate(share * GAIN);
    for (term, value) in [(Term::Gain, gain), (Term::Linear, Interval::point(RATE))] {
        (terms[term as usize], active[term as usize]) = (value, true);
    }
    Field { terms, active, middle_speed: 0.0 }
}

/// Way and velocity that a switching later by z has added after `since_s`, by the exponential.
fn added(gain: f64, z: f64, since_s: f64) -> [f64; 2] {
    let velocity = gain * DROP * ((-RATE * (since_s - z)).exp() - (-RATE * since_s).exp()) / RATE;
    [(gain * DROP * z - velocity) / RATE, velocity]
}

/// How often what a switching added is missed: as it is; without each of its parts.
fn missed(doubt_s: f64, share: f64) -> [usize; 4] {
    let (over, at, since_s) = (field(share), field(0.0), 0.5 * doubt_s);
    let [drop, damping, since] = [DROP, -RATE, since_s].map(Interval::point);
    let whole = Switching::new(&over, &at, drop, damping, since, doubt_s);
    let none = [Interval::ZERO; 2];
    let sure = whole.first.map(|first| Interval::point(first.midpoint()));
    let variants = [
        whole,
        Switching { twice: none, ..whole },
        Switching { mixed: none, ..whole },
        Switching { first: sure, ..whole },
    ];
    let mut missed = [0; 4];
    for part in [-1.0, -0.6, -0.2, 0.2, 0.6, 1.0] {
        let (z, half) = (Interval::point(part * since_s), Interval::point(0.5));
        for gain in [-0.999, 0.0, 0.999].map(|part| GAIN * (1.0 + part * share)) {
            let more = Interval::point(gain) - Interval::point(GAIN);
            for (k, exact) in added(gain, part * since_s, since_s).into_iter().enumerate() {
                for (missed, own) in missed.iter_mut().zip(&variants) {
                    let form =
                        own.first[k] * z + own.twice[k] * half * z.square() + more * own.mixed[k] * z + own.rest[k];
                    *missed += usize::from(!form.inflate(1e-14).contains(exact));
                }
            }
        }
    }
    missed
}

#[test]
fn what_a_switching_in_doubt_adds_is_as_the_exponential_has_it_and_without_a_part_of_it_is_not() {
    for (doubt_s, share) in [(0.4, 0.0), (0.4, 0.1), (0.02, 0.1), (1.5, 0.3)] {
        assert_eq!(missed(doubt_s, share)[0], 0, "{doubt_s} s, {share}");
    }
    let [_, twice, _, doubt] = missed(0.02, 0.0);
    assert!(twice > 8, "without the second order {twice} of 36 were missed");
    assert!(doubt > 8, "without the doubt {doubt} of 36 were missed");
    let [_, _, mixed, _] = missed(0.02, 0.1);
    assert!(mixed > 8, "without the gain's share {mixed} of 36 were missed");
}

#[test]
fn what_bends_is_shared_among_unknowns_that_each_move_the_delay_and_the_gain() {
    let [delay, gain, z] = [[1.0, -2.0], [0.5, 1.0], [0.3, -0.7]];
    let mixes: Vec<Mix> = (0..2).map(|k| Mix::of([(By::Delay, delay[k]), (By::Term(Term::Gain), gain[k])])).collect();
    let deviations = z.map(Interval::point);
    let (bundles, pairs) = (Bundle::of(&mixes, &deviations), Pairs::of(&mixes, &deviations));
    let [drop, damping, since] = [DROP, -RATE, 0.1].map(Interval::point);
    let switching = Switching::new(&field(0.1), &field(0.0), drop, damping, since, 0.2);
    let mut bends = vec![[Balls::ZERO; 3]; pairs.count()];
    switching.bend(&pairs, &bundles, 0, &mut bends);
    let sum = |weights: [f64; 2]| weights[0] * z[0] + weights[1] * z[1];
    for k in [POSITION, VELOCITY] {
        let own = 0.5 * switching.twice[k].midpoint() * sum(delay) * sum(delay)
            + switching.mixed[k].midpoint() * sum(gain) * sum(delay);
        let total = pairs.total(&bends, k);
        assert!((total.midpoint() - own).abs() < 1e-12 && total.width() < 1e-12, "{own} and {total:?}");
    }
}
