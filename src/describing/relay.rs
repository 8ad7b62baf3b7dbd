//! The mean output of a relay, from its own switching times.

use crate::numeric::Real;

/// Mean output `F_0 = C (t_plus - t_minus)/(t_plus + t_minus)` of a relay `+-level`, from the time per period at either
/// output (eq. 32, where `T_H`, `T_L` are times on the characteristic seen from its input). Output units.
///
/// Exact for any waveform: it is the mean of a two-valued signal.
///
/// ```
/// use selfosc::describing::bias_of_output;
/// assert_eq!(bias_of_output(2.0, 3.0, 1.0), 1.0);
/// ```
pub fn bias_of_output<T: Real>(level: T, time_high_s: T, time_low_s: T) -> T {
    level * (time_high_s - time_low_s) / (time_high_s + time_low_s)
}
