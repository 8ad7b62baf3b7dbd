//! Orders, and the rudder that follows them: a function of time that is linear between its bends.

use serde::Serialize;

/// Who gives the orders.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Commander {
    /// A relay with hysteresis: minus the level from `centre + half_width` up, plus the level from `centre - half_width` down.
    Relay {
        /// Levels with the times in s (since the beginning of the record) from which they hold; the first from ever.
        levels: Vec<(f64, f64)>,
        /// Half the width of the hysteresis.
        half_width: f64,
        /// The middle of the hysteresis.
        centre: f64,
        /// Whether it looks at the motion itself, all the time, rather than at readings.
        ideal: bool,
    },
    /// Orders in advance: time in s since the beginning of the record, and level from then on.
    Sequence {
        /// The changes, in the order of time.
        changes: Vec<(f64, f64)>,
    },
}

/// The relay's memory, or the place in a sequence.
#[derive(Clone, Debug)]
pub(crate) struct Orders<'a> {
    commander: &'a Commander,
    high: bool,
}

impl<'a> Orders<'a> {
    pub(crate) fn new(commander: &'a Commander, high: bool) -> Self {
        Self { commander, high }
    }

    /// Levels in force at a time.
    fn at(levels: &[(f64, f64)], time_s: f64) -> f64 {
        let begun = levels.iter().rev().find(|(from_s, _)| *from_s <= time_s);
        begun.or(levels.first()).map_or(0.0, |(_, level)| *level)
    }

    /// The order in force, the relay left as it is.
    pub(crate) fn standing(&self, time_s: f64) -> f64 {
        match self.commander {
            Commander::Relay { levels, .. } => {
                let level = Self::at(levels, time_s);
                if self.high { level } else { -level }
            }
            Commander::Sequence { changes } => Self::at(changes, time_s),
        }
    }

    /// The order upon a reading.
    pub(crate) fn upon(&mut self, reading: f64, time_s: f64) -> f64 {
        if let Commander::Relay { half_width, centre, ideal: false, .. } = self.commander {
            if reading - centre >= *half_width {
                self.high = false;
            } else if reading - centre <= -half_width {
                self.high = true;
            }
        }
        self.standing(time_s)
    }

    /// Where the motion next makes an ideal relay switch: the position, and whether it is passed upwards.
    pub(crate) fn watched(&self) -> Option<(f64, bool)> {
        match self.commander {
            Commander::Relay { half_width, centre, ideal: true, .. } => {
                Some((centre + if self.high { *half_width } else { -half_width }, self.high))
            }
            _ => None,
        }
    }

    /// An ideal relay has seen its level passed.
    pub(crate) fn switch(&mut self) {
        self.high = !self.high;
    }
}

/// A stretch of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// When it begins, in s.
    pub begin_s: f64,
    /// Value then.
    pub value: f64,
    /// Change per s.
    pub slope: f64,
}

impl Segment {
    /// The value at a time.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        self.value + self.slope * (time_s - self.begin_s)
    }
}

/// The command behind the rate limit, before the delay.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    segments: Vec<Segment>,
    rate_limit: Option<f64>,
    /// Time and target of every order, the first from ever.
    orders: Vec<(f64, f64)>,
}

impl History {
    /// From ever on this value.
    #[must_use]
    pub fn new(value: f64, rate_limit: Option<f64>) -> Self {
        let first = Segment { begin_s: f64::NEG_INFINITY, value, slope: 0.0 };
        Self { segments: vec![first], rate_limit, orders: vec![(f64::NEG_INFINITY, value)] }
    }

    /// The segments, in the order of time.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The value at a time.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        let index = self.segments.partition_point(|segment| segment.begin_s <= time_s);
        let segment = self.segments[index.max(1) - 1];
        if segment.slope == 0.0 { segment.value } else { segment.at(time_s) }
    }

    /// An order at a time not before any earlier one.
    pub fn order(&mut self, time_s: f64, target: f64) {
        if target == self.target() {
            return;
        }
        self.orders.push((time_s, target));
        let value = self.at(time_s);
        self.segments.retain(|segment| segment.begin_s < time_s);
        match self.rate_limit {
            None => self.segments.push(Segment { begin_s: time_s, value: target, slope: 0.0 }),
            Some(limit) => {
                let slope = limit * (target - value).signum();
                self.segments.push(Segment { begin_s: time_s, value, slope });
                let reached_s = time_s + (target - value).abs() / limit;
                self.segments.push(Segment { begin_s: reached_s, value: target, slope: 0.0 });
            }
        }
    }

    /// The order in force.
    #[must_use]
    pub fn target(&self) -> f64 {
        self.orders[self.orders.len() - 1].1
    }

    /// Time and target of every order; the first holds from ever.
    #[must_use]
    pub fn orders(&self) -> &[(f64, f64)] {
        &self.orders
    }

    /// What another actuator makes of the same orders.
    pub(crate) fn of(orders: &[(f64, f64)], rate_limit: Option<f64>) -> Self {
        let mut history = Self::new(orders[0].1, rate_limit);
        orders[1..].iter().for_each(|(time_s, target)| history.order(*time_s, *target));
        history
    }
}
