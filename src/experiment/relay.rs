//! The relay as a state machine.

use crate::nonlinearity::RelayHysteresis;
use crate::numeric::Scalar;

/// A relay with hysteresis that remembers which of its two outputs it has.
///
/// ```
/// use selfosc::experiment::RelayState;
/// use selfosc::nonlinearity::RelayHysteresis;
/// let mut relay = RelayState::new(RelayHysteresis::new(1.0, 0.2, 0.0)?, false);
/// assert_eq!(relay.step(0.1), -1.0);
/// assert_eq!(relay.step(0.3), 1.0);
/// assert_eq!(relay.step(-0.1), 1.0);
/// # Ok::<(), selfosc::nonlinearity::NonlinearityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelayState<T> {
    characteristic: RelayHysteresis<T>,
    high: bool,
}

impl<T: Scalar> RelayState<T> {
    /// A relay at its high or low output.
    pub fn new(characteristic: RelayHysteresis<T>, high: bool) -> Self {
        Self { characteristic, high }
    }

    /// The characteristic: levels and half-width.
    pub fn characteristic(&self) -> &RelayHysteresis<T> {
        &self.characteristic
    }

    /// Output after the input has become `input`: high from `half_width` upwards, low from `-half_width` downwards, else as
    /// it was. An input that is not a number changes nothing.
    pub fn step(&mut self, input: T) -> T {
        self.high = self.high_after(input);
        self.output()
    }

    /// Whether that input would change it.
    pub(crate) fn changes(&self, input: T) -> bool {
        self.high != self.high_after(input)
    }

    fn high_after(&self, input: T) -> bool {
        if input >= self.characteristic.half_width() {
            true
        } else if input <= -self.characteristic.half_width() {
            false
        } else {
            self.high
        }
    }

    /// The output it has now.
    pub fn output(&self) -> T {
        let level = self.characteristic.level();
        self.characteristic.offset() + if self.high { level } else { -level }
    }
}
