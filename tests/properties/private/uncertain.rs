use super::Uncertain;

#[test]
fn digits_follow_the_uncertainty() {
    for (value, half_width, shown) in [
        (0.033_012, 0.000_358, "0.03301 \u{b1} 0.00036 (1.1 %)"),
        (0.033_012, 0.000_089_6, "0.033012 \u{b1} 0.000090 (0.27 %)"),
        (0.003_2, 0.014_09, "0.003 \u{b1} 0.014"),
        (-0.000_4, 0.099_9, "0.00 \u{b1} 0.10"),
        (12_345.6, 2_310.0, "12300 \u{b1} 2300 (19 %)"),
        (1.234_56e-7, 2.3e-9, "1.235e-7 \u{b1} 0.023e-7 (1.9 %)"),
        (9.87e9, 1.2e8, "9.87e9 \u{b1} 0.12e9 (1.2 %)"),
    ] {
        assert_eq!(Uncertain::new(value, half_width).to_string(), shown);
    }
}

#[test]
fn the_longer_side_counts_and_no_side_leaves_four_digits() {
    assert_eq!(Uncertain::between(1.0, 0.9, 1.3).half_width, "0.30");
    let exact = Uncertain::new(0.2, 0.0);
    assert_eq!((exact.value.as_str(), exact.half_width.as_str()), ("0.2000", "0"));
}
