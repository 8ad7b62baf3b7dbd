use super::*;
use crate::numeric::Real;

type Series = fn(&PowerMoments, Interval, f64) -> Moments<Interval>;

/// However early a series is cut, the bound of its rest covers the missing terms, and is at most some multiple of them.
#[test]
fn what_is_cut_off_is_enclosed() {
    let series: [(Series, &[f64]); 3] = [
        (|law, u, share| law.about_zero(u, share), &[0.1, 0.4, 0.7]),
        (|law, u, share| law.about_infinity(Interval::ONE / u, share), &[1.35, 1.9, 6.0]),
        (|law, u, share| law.about_one(u, (Interval::ONE - u) / Interval::two(), share), &[0.7, 0.9, 1.1, 1.35]),
    ];
    let mut widest = 0_f64;
    for (place, (value, at)) in series.into_iter().enumerate() {
        for exponent in [0.0, 0.3, 0.5, 1.5, 1.513, 2.2, 3.49, 4.5, 6.7, 7.9, 8.1, 11.3] {
            let law = PowerMoments::new((exponent, exponent));
            let steep = exponent >= STEEP;
            let ends: &[f64] = if steep { &[0.999, 1.0, 1.001] } else { &[] };
            for &u in at.iter().chain(ends) {
                if (steep && place == 2) || (place == 0 && u > 1.0) || (place == 1 && u < 1.0) {
                    continue;
                }
                let of = |share: f64| value(&law, Interval::point(u), share);
                let fine = of(f64::EPSILON);
                for share in [1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10] {
                    let coarse = of(share);
                    for (fine, coarse) in [
                        (fine.m, coarse.m),
                        (fine.h, coarse.h),
                        (fine.m_slope, coarse.m_slope),
                        (fine.h_slope, coarse.h_slope),
                    ] {
                        let case = format!("series {place}, exponent {exponent}, u {u}, share {share}");
                        let middle = Interval::point(fine.midpoint());
                        assert!(coarse.contains(middle.lower()), "{case}: {fine} not in {coarse}");
                        widest = widest.max((coarse.width() / share) / magnitude(fine.hull(Interval::ONE)));
                    }
                }
            }
        }
    }
    assert!(widest < 1000.0, "{widest}");
}
