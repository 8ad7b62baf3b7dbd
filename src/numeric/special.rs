//! Bessel functions of order 0 and 1 and powers of the sine, to a few units in the last place.

use super::Scalar;

/// A function known at the real part of `x` by value and slope, carried over to the arithmetic of `x`: a float gets the
/// value, a dual number of first order its derivatives. An infinite slope becomes the largest number.
pub(crate) fn lift<T: Scalar>(x: T, value: f64, slope: f64) -> T {
    let slope = slope.clamp(-f64::MAX, f64::MAX);
    T::from_f64(value) + T::from_f64(slope) * (x - T::from_f64(x.value()))
}

/// `J_0(x)`.
///
/// ```
/// use selfosc::numeric::special::bessel_j0;
/// assert!(bessel_j0(2.404_825_557_695_773f64).abs() < 1e-15);
/// ```
pub fn bessel_j0<T: Scalar>(x: T) -> T {
    let at = x.value();
    lift(x, libm::j0(at), -libm::j1(at))
}

/// `J_1(x)`.
///
/// ```
/// use selfosc::numeric::special::bessel_j1;
/// assert!((bessel_j1(1e-3f64) / 1e-3 - 0.499_999_937_5).abs() < 1e-13);
/// ```
pub fn bessel_j1<T: Scalar>(x: T) -> T {
    let at = x.value();
    let value = libm::j1(at);
    let slope = if at == 0.0 { 0.5 } else { libm::j0(at) - value / at };
    lift(x, value, slope)
}

/// `exp(-x) I_0(x)`, domain `x >= 0`: it neither overflows nor vanishes.
///
/// ```
/// use selfosc::numeric::special::bessel_i0_scaled;
/// assert!((bessel_i0_scaled(1.0f64) * 1f64.exp() - 1.266_065_877_752_008_4).abs() < 1e-15);
/// ```
pub fn bessel_i0_scaled<T: Scalar>(x: T) -> T {
    modified(x, 0.0, T::one())
}

/// `exp(-x) I_1(x)`, domain `x >= 0`.
///
/// ```
/// use selfosc::numeric::special::bessel_i1_scaled;
/// assert!((bessel_i1_scaled(1.0f64) * 1f64.exp() - 0.565_159_103_992_485_1).abs() < 1e-15);
/// ```
pub fn bessel_i1_scaled<T: Scalar>(x: T) -> T {
    modified(x, 1.0, x / T::two())
}

/// From where on the asymptotic series reaches full precision: its smallest term is about `exp(-2 x)`.
const ASYMPTOTIC: f64 = 24.0;

/// `exp(-x) I_order(x)` by the power series, whose terms are all positive (DLMF 10.25.2), or the asymptotic one (10.40.1).
fn modified<T: Scalar>(x: T, order: f64, first: T) -> T {
    let near = x.value() < ASYMPTOTIC;
    let argument = if near { x * x / T::from_f64(4.0) } else { T::one() / (T::from_f64(8.0) * x) };
    let (mut term, mut sum) = (if near { first } else { T::one() }, T::zero());
    let mut k = 0.0;
    while term.abs() > sum.abs() * T::epsilon() * T::from_f64(0.125) {
        sum = sum + term;
        k += 1.0;
        let odd = 2.0 * k - 1.0;
        let factor = if near { 1.0 / (k * (k + order)) } else { (odd * odd - 4.0 * order * order) / k };
        term = term * argument * T::from_f64(factor);
    }
    sum * if near { (-x).exp() } else { T::one() / (T::two() * T::pi() * x).sqrt() }
}

/// Mean of `abs(sin)^exponent` over a period, `Gamma((p + 1)/2)/(sqrt(pi) Gamma(p/2 + 1))` (DLMF 5.12.2), domain
/// `exponent >= 0`.
///
/// ```
/// use selfosc::numeric::special::mean_power_of_sine;
/// assert!((mean_power_of_sine(2.0) - 0.5).abs() < 1e-15);
/// ```
#[must_use]
pub fn mean_power_of_sine(exponent: f64) -> f64 {
    let (a, b) = (0.5 * exponent + 0.5, 0.5 * exponent + 1.0);
    // Beyond, the gamma function overflows.
    let ratio =
        if b < 170.0 { libm::tgamma(a) / libm::tgamma(b) } else { libm::exp(libm::lgamma(a) - libm::lgamma(b)) };
    ratio / libm::sqrt(core::f64::consts::PI)
}
