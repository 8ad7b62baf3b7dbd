//! What the design equations promise, computed without them: poles as eigenvalues, bandwidth from the frequency
//! response.

use nalgebra::Complex;

use super::{ControlError, OpenLoop, Structure, Tuning};
use crate::plant::{TransferFunction, product};

/// Order of the rational approximation of the delay.
const PADE_ORDER: usize = 6;
/// A delay this short against the loop's time constants moves no pole by more than that, relative.
const NEGLIGIBLE: f64 = 1e-9;
/// Points at which the response is looked at, a ratio of 1.01 apart, from a hundredth of the bandwidth asked for.
const POINTS: i32 = 1500;

impl OpenLoop<f64> {
    /// Poles of the closed loop, rad/s, slowest first: eigenvalues, with the delay as a Padé approximant of sixth
    /// order. Poles much faster than `1/delay` belong to the approximant rather than to the loop.
    ///
    /// ```
    /// use selfosc::control::{Structure, Tuning, OpenLoop};
    /// use selfosc::plant::DragAxis;
    /// let tuning = Tuning::new(&DragAxis::linear(1.0, 0.2)?, Structure::Ipd, 0.5)?;
    /// let poles = OpenLoop::new(tuning.axis(), tuning.gains(), 0.0)?.closed_loop_poles()?;
    /// let triple = -tuning.double_pole_rad_s();
    /// assert!(poles[..3].iter().all(|pole| (pole.re - triple).abs() < 1e-3 && pole.im.abs() < 1e-3));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ControlError::Plant`] where the eigenvalues do not converge.
    pub fn closed_loop_poles(&self) -> Result<Vec<Complex<f64>>, ControlError> {
        let (numerator, denominator) = self.polynomials();
        // A bound of all poles without delay; the approximant's own would be too far from them for an eigenvalue
        // iteration.
        let pace = 1.0 + numerator.iter().chain(&denominator).map(|c| (c / denominator[0]).abs()).fold(0.0, f64::max);
        let delay_s = if self.delay_s() * pace < NEGLIGIBLE { 0.0 } else { self.delay_s() };
        let delay = TransferFunction::pade(delay_s, PADE_ORDER)?;
        let fed_back = product(&numerator, delay.numerator());
        let mut characteristic = product(&denominator, delay.denominator());
        let offset = characteristic.len() - fed_back.len();
        for (place, term) in characteristic[offset..].iter_mut().zip(fed_back) {
            *place += term;
        }
        let mut poles = TransferFunction::new(&[1.0], &characteristic)?.poles()?;
        poles.sort_by(|a, b| b.re.total_cmp(&a.re));
        Ok(poles)
    }
}

impl Tuning<f64> {
    /// The bandwidth of the answer to the reference with filter and delay, rad/s: the first frequency at which it is
    /// -3 dB, `None` if that is not within a hundredth and three hundred thousand times the bandwidth asked for.
    #[must_use]
    pub fn achieved_bandwidth_rad_s(&self) -> Option<f64> {
        let open_loop = OpenLoop::new(self.axis(), self.gains(), 0.0).ok()?;
        let excess = |omega: f64| 2.0 * self.answer(&open_loop, omega).norm_sqr() - 1.0;
        let at = |k: i32| 0.01 * self.bandwidth_rad_s() * 1.01_f64.powi(k);
        let above = (0..POINTS).find(|k| excess(at(*k)) > 0.0 && excess(at(k + 1)) <= 0.0)?;
        crate::numeric::scan::bracketed(&mut |omega| Some(excess(omega)), at(above), at(above + 1))
    }

    /// Coordinate over reference at `s = jw`.
    fn answer(&self, open_loop: &OpenLoop<f64>, omega: f64) -> Complex<f64> {
        let (s, gains) = (Complex::new(0.0, omega), self.gains());
        let (re, im) = open_loop.response(omega);
        let l = Complex::new(re, im);
        let integral = gains.integral() / s;
        let all = integral + gains.proportional() + s * gains.derivative() / (s * gains.filter_s() + 1.0);
        let on_reference = match gains.structure() {
            Structure::Pd | Structure::Pid => integral + gains.proportional(),
            Structure::Ipd => integral,
        };
        on_reference / all * l / (l + 1.0)
    }
}
