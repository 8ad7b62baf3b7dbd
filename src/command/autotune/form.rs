//! Gains in the forms that people type in.

use clap::ValueEnum;

use crate::control::Gains;
use crate::numeric::significant;

/// A form of the gains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum GainForm {
    /// u = Kp e + Ki int e + Kd de/dt
    Parallel,
    /// u = K (e + int e/Ti + Td de/dt), the ISA form
    Ideal,
    /// u = K (1 + 1/(Ti s)) (1 + Td s) e
    Series,
    /// Klipper's printer.cfg, gains in 255ths of full power
    Klipper,
    /// Marlin's M301, gains in 255ths of full power
    Marlin,
    /// RepRapFirmware's M301, gains in 255ths of full power
    Reprap,
    /// ESPHome's climate pid, gains in shares of full power
    Esphome,
}

impl GainForm {
    /// Whether the gains are in shares of full power: those of a firmware.
    pub(super) fn is_of_firmware(self) -> bool {
        matches!(self, Self::Klipper | Self::Marlin | Self::Reprap | Self::Esphome)
    }

    /// The lines to type. `full_power` is the command at full power, of a firmware; `interval_s` the controller's.
    pub(super) fn lines(
        self,
        gains: &Gains<f64>,
        sign: f64,
        full_power: f64,
        interval_s: f64,
    ) -> Result<String, &'static str> {
        let [p, i, d] = [gains.proportional(), gains.integral(), gains.derivative()].map(|gain| sign * gain);
        let number = |value: f64| significant(value, 5);
        if self.is_of_firmware() && p < 0.0 {
            return Err(
                "the output falls as the command rises, and firmware takes no negative gains: log the power of the heater, \
                        not the level of an inverted pin, or choose --form parallel",
            );
        }
        // Firmware counts the command as a share of full power, or in 255ths.
        let of_full = |full: f64| [p, i, d].map(|gain| gain * full / full_power);
        Ok(match self {
            Self::Parallel => format!(
                "Kp {}\nKi {} / s\nKd {} s\nfilter of the derivative {} s",
                number(p),
                number(i),
                number(d),
                number(gains.filter_s())
            ),
            Self::Ideal => format!("K  {}\nTi {} s\nTd {} s", number(p), number(p / i), number(d / p)),
            Self::Series => {
                // K' = K (1 + r)/2, Ti' = Ti (1 + r)/2, Td' = 2 Td/(1 + r) with r = sqrt(1 - 4 Td/Ti).
                let (integral_s, derivative_s) = (p / i, d / p);
                let root = 1.0 - 4.0 * derivative_s / integral_s;
                if root < 0.0 {
                    return Err("no series controller has these gains; choose --form ideal, or --pi");
                }
                let half = 0.5 * (1.0 + root.sqrt());
                format!(
                    "K  {}\nTi {} s\nTd {} s",
                    number(p * half),
                    number(integral_s * half),
                    number(derivative_s / half)
                )
            }
            Self::Klipper => {
                let [p, i, d] = of_full(255.0);
                format!("control: pid\npid_Kp: {}\npid_Ki: {}\npid_Kd: {}", plain(p), plain(i), plain(d))
            }
            Self::Marlin => {
                let [p, i, d] = of_full(255.0);
                format!("M301 P{} I{} D{}", plain(p), plain(i), plain(d))
            }
            Self::Reprap => {
                let [p, i, d] = of_full(255.0);
                format!("M301 H1 P{} I{} D{}", plain(p), plain(i), plain(d))
            }
            Self::Esphome => {
                let [p, i, d] = of_full(1.0);
                let samples = (gains.filter_s() / interval_s).ceil().max(1.0);
                format!(
                    "control_parameters:\n  kp: {}\n  ki: {}\n  kd: {}\n  derivative_averaging_samples: {samples:.0}",
                    plain(p),
                    plain(i),
                    plain(d)
                )
            }
        })
    }
}

/// Five digits without an exponent, in which firmware reads another parameter.
fn plain(value: f64) -> String {
    let decimals = if value == 0.0 { 0.0 } else { 4.0 - libm::floor(libm::log10(value.abs())) };
    format!("{value:.*}", decimals.clamp(0.0, 12.0) as usize)
}
