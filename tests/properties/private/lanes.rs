use super::{Lanes, Real};

/// Every exponent from subnormal numbers up, at mantissas spread evenly; both signs; what is beside each place where a formula changes.
fn arguments() -> Vec<f64> {
    let spread = (0..400_000_u32).map(|place| {
        let mantissa = 1.0 + (f64::from(place) * 0.618_033_988_749_894_8).fract();
        mantissa * 2.0_f64.powi((place % 140) as i32 - 80)
    });
    let edges =
        [0.0, f64::MIN_POSITIVE, 5e-324, 0.4375, 0.5, 0.6875, 0.975, 1.0, 1.1875, 2.4375, 2.0_f64.powi(66), f64::MAX];
    let beside = edges.into_iter().flat_map(|edge: f64| [edge.next_down(), edge, edge.next_up()]);
    let positive: Vec<f64> = beside.chain(spread).filter(|x| x.is_finite()).collect();
    positive.iter().flat_map(|x| [*x, -*x]).collect()
}

/// The first argument at which a lane and one float alone differ.
fn differs(arguments: &[f64], together: fn(Lanes) -> Lanes, alone: fn(f64) -> f64) -> Option<f64> {
    arguments.as_chunks().0.iter().find_map(|four| {
        let values = together(Lanes::new(*four)).values();
        (0..Lanes::COUNT).find(|&lane| values[lane].to_bits() != alone(four[lane]).to_bits()).map(|lane| four[lane])
    })
}

#[test]
fn inverse_functions_have_the_bits_of_one_float() {
    let all = arguments();
    assert!(all.len() > 500_000);
    assert_eq!(differs(&all, Lanes::atan, Real::atan), None);
    let within: Vec<f64> = all.iter().copied().filter(|x| x.abs() <= 1.0).collect();
    assert_eq!(differs(&within, Lanes::asin, Real::asin), None);
    let near: Vec<f64> = all.into_iter().filter(|x| x.abs() < 0.5).collect();
    assert_eq!(differs(&near, Lanes::asin, Real::asin), None);
    // A series, or the platform's function, would be seen.
    assert_ne!(differs(&near, Lanes::asin, |x| x + x.powi(3) / 6.0), None);
    assert_ne!(differs(&near, |x| x.atan() * Lanes::from_f64(1.0 + f64::EPSILON), Real::atan), None);
}

#[test]
fn bounds_are_those_of_all_lanes_or_none() {
    for lane in 0..Lanes::COUNT {
        let mut values = [1.0, 2.0, 3.0, 4.0];
        values[lane] = -5.0;
        assert_eq!(Lanes::new(values).bounds().0, -5.0);
        values[lane] = 9.0;
        assert_eq!(Lanes::new(values).bounds().1, 9.0);
        for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            values[lane] = none;
            assert!(Lanes::new(values).bounds().0.is_nan() && Lanes::new(values).bounds().1.is_nan());
        }
    }
}

#[test]
fn the_smaller_and_the_larger_are_those_of_one_float() {
    let values = [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for [a, b] in values.into_iter().flat_map(|a| values.map(|b| [a, b])) {
        let together =
            |f: fn(Lanes, Lanes) -> Lanes| f(Lanes::from_f64(a), Lanes::from_f64(b)).values().map(f64::to_bits);
        assert_eq!(together(Lanes::min), [Real::min(a, b).to_bits(); Lanes::COUNT], "{a} and {b}");
        assert_eq!(together(Lanes::max), [Real::max(a, b).to_bits(); Lanes::COUNT], "{a} and {b}");
    }
}

#[test]
fn the_power_of_two_is_that_of_one_float_and_rounds_nothing() {
    for x in arguments().into_iter().filter(|x| *x > 0.0) {
        let scale = x.near_reciprocal();
        assert_eq!(Lanes::from_f64(x).near_reciprocal().values(), [scale; Lanes::COUNT]);
        assert_eq!(x * scale / scale, x);
        assert!((f64::EPSILON / 4.0..4.0).contains(&(x * scale)), "{x:e} by {scale:e}");
    }
}
