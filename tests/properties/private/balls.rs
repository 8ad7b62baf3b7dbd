use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{Balls, Sizes};
use crate::numeric::{Interval, Real};

/// Products of a sum, at most.
const MOST: usize = 40;
/// Integers below this are products of two without loss in 128 bits, while floats round them.
const LARGEST: i64 = 1 << 40;

/// Middles and radii as integers, of which floats keep all digits.
fn random(random: &mut Pcg64Mcg, radius: i64) -> [i64; 2] {
    [random.random_range(-LARGEST..LARGEST), if radius > 0 { random.random_range(0..radius) } else { 0 }]
}

fn interval([middle, radius]: [i64; 2]) -> Interval {
    Interval::new((middle - radius) as f64, (middle + radius) as f64).expect("ordered")
}

/// The ends of a sum of products of intervals, exact.
fn exact(pairs: &[([i64; 2], [i64; 2])]) -> [i128; 2] {
    pairs.iter().fold([0, 0], |[low, high], ([a, p], [b, q])| {
        let ends = [(a - p, b - q), (a - p, b + q), (a + p, b - q), (a + p, b + q)];
        let products = ends.map(|(a, b)| i128::from(a) * i128::from(b));
        let least = products.iter().min().expect("four");
        let most = products.iter().max().expect("four");
        [low + least, high + most]
    })
}

/// Whether an interval of whole numbers, as all floats of this size are, holds these.
fn holds(interval: Interval, [low, high]: [i128; 2]) -> bool {
    interval.lower() as i128 <= low && high <= interval.upper() as i128
}

#[test]
fn sums_of_products_hold_the_exact_ones_and_without_their_roundings_do_not() {
    let mut source = Pcg64Mcg::seed_from_u64(11);
    let mut missed = 0;
    for trial in 0..2000 {
        let radius = [0, 8, 1 << 20, 1 << 39][trial % 4];
        let terms = 1 + trial % MOST;
        let lanes: Vec<Vec<([i64; 2], [i64; 2])>> = (0..Balls::COUNT)
            .map(|_| (0..terms).map(|_| (random(&mut source, radius), random(&mut source, radius))).collect())
            .collect();
        let side = |term: usize, first: bool| {
            Balls::new(core::array::from_fn(|lane| {
                let (a, b) = lanes[lane][term];
                interval(if first { a } else { b })
            }))
        };
        let sum = Balls::dot((0..terms).map(|term| (side(term, true), side(term, false))));
        let halves = (0..terms).map(|term| side(term, true) * side(term, false)).reduce(|sum, term| sum + term);
        let halves = halves.expect("a term").intervals();
        for (lane, pairs) in lanes.iter().enumerate() {
            let exact = exact(pairs);
            assert!(holds(sum.interval_at(lane), exact), "{:?} does not hold {exact:?}", sum.interval_at(lane));
            assert!(holds(halves[lane], exact), "{:?} does not hold {exact:?}", halves[lane]);
            let rounded: f64 = pairs.iter().map(|([a, _], [b, _])| *a as f64 * *b as f64).sum();
            missed += usize::from(radius == 0 && (rounded as i128 != exact[0]));
        }
    }
    assert!(missed > 1000, "floats alone missed {missed} of 2000");
}

#[test]
fn a_sum_of_narrow_ones_is_hardly_wider_than_in_intervals() {
    let narrow = |value: f64| Interval::point(value).inflate(1e-6);
    let pairs: Vec<(f64, f64)> = (1..=10).map(|k| (f64::from(k) * 0.3 - 1.0, 2.0 - f64::from(k) * 0.7)).collect();
    let balls =
        Balls::dot(pairs.iter().map(|(a, b)| (Balls::splat(narrow(*a)), Balls::splat(narrow(*b))))).interval_at(3);
    let interval = Interval::dot(pairs.iter().map(|(a, b)| (narrow(*a), narrow(*b))));
    assert!(interval.width() <= balls.width() && balls.width() < 1.000_001 * interval.width());
}

#[test]
fn what_is_not_finite_says_nothing() {
    let large = Balls::splat(Interval::point(1e200));
    let all = Balls::splat(Interval::ENTIRE);
    for value in [large * large, large * large - large * large, all, all * Balls::ZERO, all + large, -all] {
        assert_eq!(value.intervals(), [Interval::ENTIRE; 4]);
    }
    // What underflows is not lost.
    let small = Balls::splat(Interval::point(1e-200));
    assert!((small * small).interval_at(0).upper() > 0.0);
}

#[test]
fn shares_hold_the_quotient_and_sizes_exceed_every_element() {
    let value = Interval::new(-0.7, 0.3).expect("ordered");
    for parts in 1..=12 {
        let exact = Interval::point(0.1) / Interval::point(parts as f64);
        let share = Balls::splat(Interval::point(0.1)).share(parts).interval_at(1);
        assert!(exact.is_subset_of(share) && share.width() < 1e-14);
        let size = Balls::splat(value).sizes();
        let sum = Balls::within(Sizes::dot([(size, size.share(parts)), (size, size)].into_iter())).interval_at(2);
        let least = 0.49 * (1.0 + 1.0 / parts as f64);
        assert!(sum.upper() >= least && sum.upper() < least * 1.000_000_1, "{sum:?} {least}");
    }
}
