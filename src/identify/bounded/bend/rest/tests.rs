use super::*;
use crate::numeric::Real;

const PART_S: f64 = 0.4;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

/// What `t (part - t)` is at most in the first part, of whose ends both are nothing, where it bends by so much.
fn arch(bent: f64) -> f64 {
    let mut sums = [[Sizes::ZERO; 2]; 2];
    let bent = [Sizes::ZERO, Sizes::splat(point(bent))];
    add_largest(&mut sums, Sizes::splat(point(2.0)), [[Balls::ZERO; 2]; 3].into_iter(), point(PART_S), bent);
    0.5 * sums[0][1].interval().upper()
}

#[test]
fn what_bends_between_the_ends_of_a_part_is_counted_and_by_the_ends_alone_it_is_missed() {
    let (top, own) = (0.25 * PART_S * PART_S, arch(1.0));
    assert!(own >= top && own < 1.0001 * top, "{own} for {top}");
    assert!(arch(0.0) < top);
}

#[test]
fn parts_are_as_many_as_the_fastest_rate_asks_for_and_end_with_the_step() {
    let h_s = 0.9;
    for (fastest, count) in [(0.0, 1), (0.2, 1), (1.0, 4), (2.0, 7), (1e3, 16), (f64::INFINITY, 16)] {
        let ends = parts(point(h_s), fastest);
        assert_eq!(ends.len(), count, "{fastest}");
        for (part, end) in ends.iter().enumerate() {
            let exact = h_s * (part + 1) as f64 / count as f64;
            assert!(end.inflate(1e-15).contains(exact) && end.width() < 1e-15, "{end:?} for {exact}");
        }
    }
}

#[test]
fn states_are_as_large_as_at_the_ends_of_each_part() {
    let state = |v: f64| [Balls::ZERO, Balls::points([0.0, 0.0, v, 0.0]), Balls::ZERO];
    for values in [[3.0, 1.0, 2.0], [-1.0, 4.0, -2.0], [0.5, -1.0, 2.0]] {
        let mut sums = [[Sizes::ZERO; 3]; 2];
        add_largest(
            &mut sums,
            Sizes::splat(Interval::ONE),
            values.map(state).into_iter(),
            point(0.4),
            [Sizes::ZERO; 3],
        );
        for (sum, around) in sums.iter().zip(values.windows(2)) {
            let largest = around.iter().fold(0.0f64, |most, value| most.max(value.abs()));
            let size = sum[VELOCITY].spread(2).interval().upper();
            assert!(size >= largest && size < largest + 1e-12, "{size} for {largest}");
        }
    }
}

#[test]
fn growth_is_no_less_than_the_exponential_s_and_without_the_square_it_is() {
    for grown in [-2.0, -0.7, -0.1, -1e-3, 1e-3, 0.2, 0.6] {
        let Growth { kept, mean, longest } = Growth::by(point(grown));
        let (exact, exact_mean) = (libm::exp(grown), libm::expm1(grown) / grown);
        assert!(kept.upper() >= exact, "{grown}: {kept:?} for {exact}");
        assert!(mean.upper() >= exact_mean, "{grown}: {mean:?} for {exact_mean}");
        assert!(longest.upper() >= exact.max(1.0), "{grown}: {longest:?}");
        if (-0.7..0.0).contains(&grown) {
            assert!(kept.upper() < 1.3 * exact && mean.upper() < 1.03 * exact_mean, "{grown}: {kept:?}, {mean:?}");
            assert!(1.0 + grown < exact && 1.0 + 0.5 * grown < exact_mean);
        }
    }
}

#[test]
fn a_rest_counts_what_is_left_by_the_end_of_the_part_in_which_it_is_asked_for() {
    let size = |size: f64| [Interval::symmetric(size); 3];
    let rest = Rest { until: vec![(0.4, size(1.0)), (0.8, size(2.0))], at_end: size(1.5) };
    for (time_s, exact) in [(0.1, 1.0), (0.4, 1.0), (0.41, 2.0), (0.8, 2.0), (0.9, 2.0)] {
        assert_eq!(rest.after(point(time_s))[VELOCITY].upper(), exact, "after {time_s} s");
    }
    let across = Interval::new(0.3, 0.5).expect("an interval");
    assert_eq!(rest.after(across)[VELOCITY].upper(), 2.0);
    assert_eq!(rest.at_end()[VELOCITY].upper(), 1.5);
}
