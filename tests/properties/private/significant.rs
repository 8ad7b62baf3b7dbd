use super::significant;

#[test]
fn every_number_keeps_its_digits() {
    for (value, shown) in [
        (0.0, "0"),
        (-0.0, "0"),
        (1.0, "1.00000"),
        (-12.345_678, "-12.3457"),
        (999_999.9, "1000000"),
        (0.000_123_456_78, "0.000123457"),
        (9.999_999e-5, "0.000100000"),
        (3.2e-5, "3.20000e-5"),
        (2.5e9, "2.50000e9"),
    ] {
        assert_eq!(significant(value, 6), shown);
    }
}
