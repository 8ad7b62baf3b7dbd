//! The switching conditions: the periodic output where the command changes, over boxes of half-periods.

use super::kernel::{Moment, Periodic, rise_at_zero};
use super::modes::Mode;
use crate::numeric::{Interval, Real};
use crate::proof::Gradient;

/// A loop in numbers that the conditions need.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Conditions {
    pub(super) modes: Vec<Mode>,
    pub(super) delay: Interval,
    pub(super) high: Interval,
    pub(super) low: Interval,
    /// Output at which the command becomes low (rising past it), and high (falling past it).
    pub(super) upper: Interval,
    pub(super) lower: Interval,
    /// Share of the period at the upper level that makes the input's mean vanish: of plants with a pole at zero.
    pub(super) share: Option<Interval>,
}

/// The half-periods as functions of `N` unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Times<const N: usize> {
    pub(super) high: Gradient<N>,
    pub(super) low: Gradient<N>,
    pub(super) period: Gradient<N>,
    /// Share of the upper level where it is fixed.
    share: Option<Interval>,
}

/// A moment in the period of the plant's input: `rises high + falls low - delay + after_s` after the input's rise, with the input at
/// a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) rises: f64,
    pub(super) falls: f64,
    pub(super) after_s: f64,
    pub(super) input_high: bool,
}

/// A moment after the command becomes high: `high high + low low + after_s`, less than a period.
#[derive(Clone, Copy, Debug)]
struct Offset {
    high: f64,
    low: f64,
    after_s: f64,
}

/// The command's changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// It becomes high: the output falls past the lower level.
    On,
    /// It becomes low: the output rises past the upper level.
    Off,
}

impl Change {
    fn offset(self) -> Offset {
        let high = match self {
            Self::On => 0.0,
            Self::Off => 1.0,
        };
        Offset { high, low: 0.0, after_s: 0.0 }
    }
}

impl Times<2> {
    pub(super) fn free([high, low]: [Gradient<2>; 2]) -> Self {
        Self { high, low, period: high + low, share: None }
    }
}

impl Times<1> {
    pub(super) fn shared(period: Gradient<1>, share: Interval) -> Self {
        let of = |share: Interval| period * Gradient::constant(share);
        Self { high: of(share), low: of(Interval::ONE - share), period, share: Some(share) }
    }
}

impl<const N: usize> Times<N> {
    /// `rises high + falls low + shift`.
    fn combination(&self, rises: f64, falls: f64, shift: Interval) -> Gradient<N> {
        let factor = |factor: f64, time: Gradient<N>| match factor {
            0.0 => Gradient::constant(Interval::ZERO),
            factor => time * Gradient::constant(Interval::point(factor)),
        };
        let shift = Gradient::constant(shift);
        if let Some(share) = self.share {
            // A single product: nothing is counted twice.
            let rest = Interval::ONE - share;
            let whole = Interval::point(rises) * share + Interval::point(falls) * rest;
            return self.period * Gradient::constant(whole) + shift;
        }
        factor(rises, self.high) + factor(falls, self.low) + shift
    }

    /// The share of the period that a combination is.
    fn share_of(&self, rises: f64, falls: f64, delay: Interval, time: Interval) -> Interval {
        let period = self.period.value();
        let share = match self.share {
            Some(share) => {
                Interval::point(rises) * share + Interval::point(falls) * (Interval::ONE - share) - delay / period
            }
            None => time / period,
        };
        share.intersection(UNIT_SHARE).unwrap_or(UNIT_SHARE)
    }
}

const UNIT_SHARE: Interval = match Interval::new(0.0, 1.0) {
    Some(share) => share,
    None => Interval::ONE,
};
const NOT_NEGATIVE: Interval = match Interval::new(0.0, f64::INFINITY) {
    Some(all) => all,
    None => Interval::ENTIRE,
};

fn clipped(time: Interval) -> Option<Interval> {
    time.intersection(NOT_NEGATIVE)
}

impl Conditions {
    /// Where in the input's period a moment may be, for some of the half-periods; `None` for too many places.
    fn places<const N: usize>(&self, times: &Times<N>, offset: Offset) -> Option<Vec<Place>> {
        let Offset { high, low, after_s } = offset;
        // 0 <= offset - delay + n T <= T, and the offset is less than a period.
        let before = -times.combination(high, low, Interval::point(after_s) - self.delay).value();
        let turns = if before == Interval::ZERO { before } else { before / times.period.value() };
        let (first, last) = (libm::ceil(turns.lower()).max(0.0), (libm::floor(turns.upper()) + 1.0).max(0.0));
        if !(last - first <= 2.0) {
            return None;
        }
        let mut places = Vec::new();
        for step in 0..=(last - first) as u32 {
            let turn = first + f64::from(step);
            for input_high in [true, false] {
                let place = Place { rises: turn + high, falls: turn + low, after_s, input_high };
                if self.moments(times, &place).is_some() {
                    places.push(place);
                }
            }
        }
        Some(places)
    }

    /// Times since the input's last rise and fall there, with the moments they are; `None` where no half-periods fit the place.
    fn moments<const N: usize>(&self, times: &Times<N>, place: &Place) -> Option<[(Gradient<N>, Moment); 2]> {
        let Place { rises, falls, after_s, input_high } = *place;
        let late = self.delay - Interval::point(after_s);
        let moment = |rises: f64, falls: f64| {
            let time = times.combination(rises, falls, -late);
            let rest = times.combination(1.0 - rises, 1.0 - falls, late);
            let (within, rest) = (clipped(time.value())?, clipped(rest.value())?);
            let share = times.share_of(rises, falls, late, within);
            Some((time, Moment { time: within, rest, share }))
        };
        let since_rise = moment(rises, falls)?;
        let since_fall = if input_high { moment(rises, falls + 1.0) } else { moment(rises - 1.0, falls) }?;
        Some([since_rise, since_fall])
    }

    /// The output where a change is, over a box of half-periods, less the constant that is free with a pole at zero;
    /// `None` where the box is too wide.
    pub(super) fn output<const N: usize>(
        &self,
        periodic: &Periodic<'_>,
        times: &Times<N>,
        change: Change,
    ) -> Option<Gradient<N>> {
        let places = self.places(times, change.offset())?;
        places.iter().filter_map(|place| self.output_at(periodic, times, place)).reduce(hull)
    }

    pub(super) fn output_at<const N: usize>(
        &self,
        periodic: &Periodic<'_>,
        times: &Times<N>,
        place: &Place,
    ) -> Option<Gradient<N>> {
        let moments = self.moments(times, place)?;
        let step = self.high - self.low;
        let answer = |(time, moment): &(Gradient<N>, Moment)| {
            let answer = periodic.answer(moment);
            let slopes = core::array::from_fn(|at| {
                answer.by_time * time.slopes()[at] + answer.by_period * times.period.slopes()[at]
            });
            Gradient::new(answer.value, slopes)
        };
        let swing = (answer(&moments[0]) - answer(&moments[1])) * Gradient::constant(step);
        let (present, mean) = periodic.gains();
        let input = if place.input_high { self.high } else { self.low };
        let constant = Gradient::constant(present * input);
        Some(swing + constant + self.mean_input(times) * Gradient::constant(mean))
    }

    /// Mean of the plant's input; zero for plants with a pole at zero.
    fn mean_input<const N: usize>(&self, times: &Times<N>) -> Gradient<N> {
        let period = times.period.value();
        if self.share.is_some() || !period.is_bounded() {
            return Gradient::constant(Interval::ZERO);
        }
        let step = self.high - self.low;
        let (high, low) = (times.high.value(), times.low.value());
        let share = (high / period).intersection(UNIT_SHARE).unwrap_or(UNIT_SHARE);
        let over = step / period.square();
        let [by_high, by_low] = [over * low, -(over * high)];
        let slopes = core::array::from_fn(|at| by_high * times.high.slopes()[at] + by_low * times.low.slopes()[at]);
        Gradient::new(self.low + step * share, slopes)
    }

    /// How far the output is from its levels where the command changes; unknown over a box that is too wide.
    pub(super) fn misses(&self, unknowns: [Gradient<2>; 2]) -> [Gradient<2>; 2] {
        let times = Times::free(unknowns);
        let found = Periodic::new(&self.modes, times.period.value()).and_then(|periodic| {
            let at = |change| self.output(&periodic, &times, change);
            Some([at(Change::Off)?, at(Change::On)?])
        });
        match found {
            Some([off, on]) => [off - Gradient::constant(self.upper), on - Gradient::constant(self.lower)],
            None => [Gradient::new(Interval::ENTIRE, [Interval::ENTIRE; 2]); 2],
        }
    }

    /// The same where a pole at zero makes the output's constant free: the output's rise less the hysteresis.
    pub(super) fn rise_miss(&self, period: Gradient<1>, share: Interval) -> Gradient<1> {
        if !period.value().is_bounded() {
            return Gradient::constant(self.rise_far(period.value(), share).unwrap_or(Interval::ENTIRE));
        }
        let times = Times::shared(period, share);
        let found = Periodic::new(&self.modes, period.value()).and_then(|periodic| {
            let at = |change| self.output(&periodic, &times, change);
            Some(at(Change::Off)? - at(Change::On)? - Gradient::constant(self.upper - self.lower))
        });
        found.unwrap_or(Gradient::new(Interval::ENTIRE, [Interval::ENTIRE]))
    }

    /// That miss over an unbounded range of periods, divided by the largest power of the period that it has.
    fn rise_far(&self, period: Interval, share: Interval) -> Option<Interval> {
        let rest = Interval::ONE - share;
        if !(self.delay.upper() <= (share * period).lower() && self.delay.upper() <= (rest * period).lower()) {
            return None;
        }
        let times = Times::shared(Gradient::constant(period), share);
        let away: Vec<Mode> = self.modes.iter().filter(|mode| mode.inverse.is_some()).cloned().collect();
        let without = Self { modes: away, ..self.clone() };
        let periodic = Periodic::new(&without.modes, period)?;
        let at = |change| without.output(&periodic, &times, change);
        let bounded = (at(Change::Off)? - at(Change::On)?).value() - (self.upper - self.lower);
        let mut ascending = rise_at_zero(&self.modes, share, self.delay);
        ascending.iter_mut().for_each(|coefficient| *coefficient *= self.high - self.low);
        ascending[0] += bounded;
        let over = (Interval::ONE / period).intersection(NOT_NEGATIVE)?;
        let from = ascending.iter().position(|&coefficient| coefficient != Interval::ZERO)?;
        let last = ascending.iter().rposition(|&coefficient| coefficient != Interval::ZERO)?;
        Some(ascending[from..=last].iter().fold(Interval::ZERO, |sum, &coefficient| sum * over + coefficient))
    }

    /// Whether no half-periods of a box are those of an orbit: the output is past a level before it may be. `over` is the box,
    /// `middle` its middle.
    pub(super) fn refuses<const N: usize>(&self, over: &Times<N>, middle: &Times<N>, sides: &[Interval; N]) -> bool {
        let (Some(wide), Some(narrow)) =
            (Periodic::new(&self.modes, over.period.value()), Periodic::new(&self.modes, middle.period.value()))
        else {
            return false;
        };
        // By the mean value theorem.
        let value = |offset: Offset| {
            let [around, at] = [(&wide, over), (&narrow, middle)].map(|(periodic, times)| {
                let places = self.places(times, offset)?;
                places.iter().filter_map(|place| self.output_at(periodic, times, place)).reduce(hull)
            });
            let (around, at) = (around?, at?);
            let spread = around
                .slopes()
                .iter()
                .zip(sides)
                .fold(at.value(), |sum, (&slope, &side)| sum + slope * (side - Interval::point(side.midpoint())));
            Some(spread.intersection(around.value()).unwrap_or(spread))
        };
        let constant = if self.share.is_some() {
            let Some(at_on) = value(Change::On.offset()) else { return false };
            self.lower - at_on
        } else {
            Interval::ZERO
        };
        let past = |high: Offset, low: Offset| {
            value(high).is_some_and(|value| self.upper.precedes(value + constant))
                || value(low).is_some_and(|value| (value + constant).precedes(self.lower))
        };
        let at = |high: f64, low: f64, after_s: f64| Offset { high, low, after_s };
        // In the middle, and late, where the output may have come through the level the wrong way.
        if [0.5, 0.95].iter().any(|&share| past(at(share, 0.0, 0.0), at(1.0, share, 0.0))) {
            return true;
        }
        // Where a pair of poles has swung over.
        let shortest = over.high.value().lower().min(over.low.value().lower());
        let swings = self.modes.iter().filter_map(|mode| mode.algebra.half_turn_s());
        let after = swings.flat_map(|half| [0.5, 1.0, 1.5].map(|turns| self.delay.upper() + turns * half));
        after.filter(|&after_s| after_s < shortest).any(|after_s| past(at(0.0, 0.0, after_s), at(1.0, 0.0, after_s)))
    }

    /// The only place of a change, given its enclosed half-periods; just before the input's own change where they
    /// coincide for want of a delay. `None` where they may coincide otherwise.
    pub(super) fn place<const N: usize>(&self, times: &Times<N>, change: Change) -> Option<Place> {
        if self.delay.upper() == 0.0 {
            return Some(match change {
                Change::On => Place { rises: 1.0, falls: 1.0, after_s: 0.0, input_high: false },
                Change::Off => Place { rises: 1.0, falls: 0.0, after_s: 0.0, input_high: true },
            });
        }
        match self.places(times, change.offset())?.as_slice() {
            [place] => Some(*place),
            _ => None,
        }
    }

    /// The time of a place after the input's rise.
    pub(super) fn time<const N: usize>(&self, times: &Times<N>, place: &Place) -> Interval {
        times.combination(place.rises, place.falls, -self.delay).value()
    }
}

fn hull<const N: usize>(a: Gradient<N>, b: Gradient<N>) -> Gradient<N> {
    let slopes = core::array::from_fn(|at| a.slopes()[at].hull(b.slopes()[at]));
    Gradient::new(a.value().hull(b.value()), slopes)
}

impl Conditions {
    /// A period below which the output cannot move between the levels; zero without hysteresis.
    pub(super) fn shortest_period(&self, longest: f64) -> f64 {
        let width = (self.upper - self.lower).lower();
        let step = Interval::point(4.0) * (self.high - self.low).abs();
        // The output's rise is a sum of four answers.
        let too_small =
            |period: f64| (step * Interval::point(super::kernel::bound(&self.modes, period))).upper() < width;
        if !(width > 0.0) {
            return 0.0;
        }
        (0..60).map(|halvings| longest * 0.5_f64.powi(halvings)).find(|&period| too_small(period)).unwrap_or(0.0)
    }
}
