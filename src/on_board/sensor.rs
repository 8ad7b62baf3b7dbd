//! From readings to the coordinate that the relay sees.

use super::{Coordinate, Fault, Protocol};
use crate::numeric::Scalar;

/// The last sample, and the state from those before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SensorState<T> {
    pub(super) time_s: T,
    pub(super) reading: T,
    /// The coordinate: for a heading without jumps, for a speed its integral.
    pub(super) position: T,
    /// Since when the reading is the same.
    pub(super) changed_s: T,
}

impl<T: Scalar> SensorState<T> {
    /// The first sample; a heading starts within half a turn of the reference.
    pub(super) fn first(protocol: &Protocol<T>, reading: T, time_s: T) -> Result<Self, Fault> {
        finite("reading", reading)?;
        finite("time in s", time_s)?;
        // Two stamps are off by half the spacing of numbers each: the interval between them is to be good to an eighth, to the end.
        let last_s = time_s.abs() + protocol.duration_s;
        if !(last_s + protocol.interval_s / T::from_f64(16.0) > last_s) {
            return Err(coarse_time(last_s, protocol.interval_s));
        }
        heading(protocol, reading)?;
        let position = match protocol.coordinate {
            Coordinate::Position => reading,
            Coordinate::HeadingRad | Coordinate::HeadingDegrees => nearest(protocol, reading, protocol.reference),
            Coordinate::Speed => T::zero(),
        };
        Ok(Self { time_s, reading, position, changed_s: time_s })
    }

    /// Time since the sample; a fault where the clock runs backwards, or no sample has come for too long.
    pub(super) fn age_s(&self, protocol: &Protocol<T>, time_s: T) -> Result<T, Fault> {
        finite("time in s", time_s)?;
        let age_s = time_s - self.time_s;
        if !(age_s >= T::zero()) {
            return Err(self.out_of_order(time_s));
        }
        let limit_s = T::from_f64(Protocol::<T>::LONGEST_GAP) * protocol.interval_s;
        if !(age_s <= limit_s) {
            return Err(gap(age_s, limit_s));
        }
        Ok(age_s)
    }

    #[cold]
    fn out_of_order(&self, time_s: T) -> Fault {
        Fault::TimeOrder { time_s: time_s.value(), previous_s: self.time_s.value() }
    }

    /// Takes the next sample; the coordinate. Upon a fault nothing changes.
    pub(super) fn step(&mut self, protocol: &Protocol<T>, reading: T, time_s: T) -> Result<T, Fault> {
        finite("reading", reading)?;
        let interval_s = self.age_s(protocol, time_s)?;
        if interval_s == T::zero() {
            return Err(self.out_of_order(time_s));
        }
        heading(protocol, reading)?;
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
            return Err(jump(change, limit));
        }
        if reading != self.reading {
            self.changed_s = time_s;
        } else if time_s - self.changed_s > protocol.unchanged_s {
            return Err(stuck(reading, time_s - self.changed_s));
        }
        (self.time_s, self.reading, self.position) = (time_s, reading, position);
        Ok(position)
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

/// A whole turn of a heading.
fn turn<T: Scalar>(coordinate: Coordinate) -> Option<T> {
    match coordinate {
        Coordinate::Position | Coordinate::Speed => None,
        Coordinate::HeadingRad => Some(T::two() * T::pi()),
        Coordinate::HeadingDegrees => Some(T::from_f64(360.0)),
    }
}

/// Whether a reading can be a heading, where it has to be.
fn heading<T: Scalar>(protocol: &Protocol<T>, reading: T) -> Result<(), Fault> {
    let Some(turn) = turn::<T>(protocol.coordinate) else { return Ok(()) };
    let limit = T::from_f64(Protocol::<T>::MOST_TURNS) * turn;
    if reading.abs() <= limit { Ok(()) } else { Err(range(reading, limit)) }
}

/// The heading that differs from the reading by whole turns and is nearest to another heading.
fn nearest<T: Scalar>(protocol: &Protocol<T>, reading: T, other: T) -> T {
    let Some(turn) = turn::<T>(protocol.coordinate) else { return reading };
    reading + turn * ((other - reading) / turn + T::from_f64(0.5)).floor()
}

fn finite<T: Scalar>(quantity: &'static str, value: T) -> Result<(), Fault> {
    if value.is_finite() { Ok(()) } else { Err(not_finite(quantity, value)) }
}

// Faults are made aside: they come once, and the way of a sound sample stays short.
#[cold]
fn not_finite<T: Scalar>(quantity: &'static str, value: T) -> Fault {
    Fault::NotFinite { quantity, value: value.value() as f32 }
}
#[cold]
fn coarse_time<T: Scalar>(time_s: T, interval_s: T) -> Fault {
    Fault::CoarseTime { time_s: time_s.value(), interval_s: interval_s.value() }
}
#[cold]
fn gap<T: Scalar>(gap_s: T, limit_s: T) -> Fault {
    Fault::Gap { gap_s: gap_s.value(), limit_s: limit_s.value() }
}
#[cold]
fn range<T: Scalar>(reading: T, limit: T) -> Fault {
    Fault::Range { reading: reading.value(), limit: limit.value() }
}
#[cold]
fn jump<T: Scalar>(change: T, limit: T) -> Fault {
    Fault::Jump { change: change.value(), limit: limit.value() }
}
#[cold]
fn stuck<T: Scalar>(reading: T, unchanged_s: T) -> Fault {
    Fault::Stuck { reading: reading.value(), unchanged_s: unchanged_s.value() }
}
