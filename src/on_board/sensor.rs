//! From readings to the coordinate that the relay sees.

use super::{Coordinate, Fault, Protocol};
use crate::numeric::Scalar;

/// The last sample, and what follows from those before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sensor<T> {
    time_s: T,
    reading: T,
    /// The coordinate: for a heading without jumps, for a speed its integral.
    position: T,
    /// Since when the reading is what it is.
    changed_s: T,
}

impl<T: Scalar> Sensor<T> {
    /// The first sample; a heading starts within half a turn of the reference.
    pub(super) fn first(protocol: &Protocol<T>, reading: T, time_s: T) -> Result<Self, Fault> {
        finite("reading", reading)?;
        finite("time in s", time_s)?;
        let position = match protocol.coordinate {
            Coordinate::Position => reading,
            Coordinate::HeadingRad | Coordinate::HeadingDegrees => nearest(protocol, reading, protocol.reference),
            Coordinate::Speed => T::zero(),
        };
        Ok(Self { time_s, reading, position, changed_s: time_s })
    }

    /// The next sample.
    pub(super) fn next(&self, protocol: &Protocol<T>, reading: T, time_s: T) -> Result<Self, Fault> {
        finite("reading", reading)?;
        finite("time in s", time_s)?;
        let interval_s = time_s - self.time_s;
        if !(interval_s > T::zero()) {
            return Err(Fault::TimeOrder { time_s: time_s.value(), previous_s: self.time_s.value() });
        }
        let limit_s = T::from_f64(Protocol::<T>::LONGEST_GAP) * protocol.interval_s;
        if !(interval_s <= limit_s) {
            return Err(Fault::Gap { gap_s: interval_s.value(), limit_s: limit_s.value() });
        }
        let (position, change) = match protocol.coordinate {
            Coordinate::Position => (reading, reading - self.reading),
            Coordinate::HeadingRad | Coordinate::HeadingDegrees => {
                let position = nearest(protocol, reading, self.position);
                (position, position - self.position)
            }
            Coordinate::Speed => {
                let mean = (reading + self.reading) / T::two();
                (self.position + mean * interval_s, reading - self.reading)
            }
        };
        finite("coordinate", position)?;
        let limit = protocol.largest_rate * interval_s + protocol.resolution;
        if !(change.abs() <= limit) {
            return Err(Fault::Jump { change: change.value(), limit: limit.value() });
        }
        let moved = reading != self.reading;
        let changed_s = if moved { time_s } else { self.changed_s };
        let unchanged_s = time_s - changed_s;
        if unchanged_s > protocol.unchanged_s {
            return Err(Fault::Stuck { reading: reading.value(), unchanged_s: unchanged_s.value() });
        }
        Ok(Self { time_s, reading, position, changed_s })
    }

    /// All that it is, exactly.
    #[cfg(feature = "std")]
    pub(super) fn key(&self) -> [u64; 4] {
        let Self { time_s, reading, position, changed_s } = self;
        [time_s, reading, position, changed_s].map(|value| value.value().to_bits())
    }

    /// The coordinate now.
    pub(super) fn position(&self) -> T {
        self.position
    }
}

/// The heading that differs from the reading by whole turns and is nearest to another heading.
fn nearest<T: Scalar>(protocol: &Protocol<T>, reading: T, other: T) -> T {
    let turn = match protocol.coordinate {
        Coordinate::HeadingDegrees => T::from_f64(360.0),
        _ => T::two() * T::pi(),
    };
    reading + turn * ((other - reading) / turn + T::from_f64(0.5)).floor()
}

fn finite<T: Scalar>(quantity: &'static str, value: T) -> Result<(), Fault> {
    if value.is_finite() { Ok(()) } else { Err(Fault::NotFinite { quantity, value: value.value() }) }
}
