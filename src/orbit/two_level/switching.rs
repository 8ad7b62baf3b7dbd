//! The switching conditions: the periodic output where the command changes, over boxes of half-periods.

use super::kernel::{Moment, Periodic, divisor};
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

/// Where in the period of the plant's input a command changes: `rises high + falls low - delay` after the input's rise, with the
/// input at a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) rises: f64,
    pub(super) falls: f64,
    pub(super) input_high: bool,
}

/// The command's changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    /// It becomes high: the output falls past the lower level.
    On,
    /// It becomes low: the output rises past the upper level.
    Off,
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
            // One product, so that nothing is counted twice.
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
    /// Where a change may be, for some of the half-periods; `None` for too many places.
    pub(super) fn places<const N: usize>(&self, times: &Times<N>, change: Change) -> Option<Vec<Place>> {
        let period = times.period.value();
        let turns = |time: Interval| if time.upper() == 0.0 { Interval::ZERO } else { time / period };
        // On: 0 <= n T - delay <= T. Off: 0 <= high + m T - delay <= T.
        let count = match change {
            Change::On => turns(self.delay),
            Change::Off => turns(self.delay - times.high.value()),
        };
        let (first, last) = (libm::ceil(count.lower()), libm::floor(count.upper()) + 1.0);
        // The off change is at most a period before the input's rise.
        let (first, last) = if change == Change::Off { (first.max(0.0), last.max(0.0)) } else { (first, last) };
        if !(last - first <= 2.0) {
            return None;
        }
        let mut places = Vec::new();
        for step in 0..=(last - first) as u32 {
            let falls = first + f64::from(step);
            let rises = if change == Change::On { falls } else { falls + 1.0 };
            for input_high in [true, false] {
                let place = Place { rises, falls, input_high };
                if self.moments(times, &place).is_some() {
                    places.push(place);
                }
            }
        }
        Some(places)
    }

    /// Times since the input's last rise and fall there, with the moments they are; `None` where no half-periods fit the place.
    fn moments<const N: usize>(&self, times: &Times<N>, place: &Place) -> Option<[(Gradient<N>, Moment); 2]> {
        let Place { rises, falls, input_high } = *place;
        let moment = |rises: f64, falls: f64| {
            let time = times.combination(rises, falls, -self.delay);
            let rest = times.combination(1.0 - rises, 1.0 - falls, self.delay);
            let (within, rest) = (clipped(time.value())?, clipped(rest.value())?);
            let share = times.share_of(rises, falls, self.delay, within);
            Some((time, Moment { time: within, rest, share }))
        };
        let since_rise = moment(rises, falls)?;
        let since_fall = if input_high { moment(rises, falls + 1.0) } else { moment(rises - 1.0, falls) }?;
        Some([since_rise, since_fall])
    }

    /// The output less its free constant where a change is, over a box of half-periods; `None` where the box is too wide.
    pub(super) fn output<const N: usize>(
        &self,
        periodic: &Periodic<'_>,
        times: &Times<N>,
        change: Change,
    ) -> Option<Gradient<N>> {
        let places = self.places(times, change)?;
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
        let constant = Gradient::constant(present * input * divisor(&self.modes, times.period.value()));
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

    /// The same where a pole at zero leaves the output's constant free: the output's rise less the hysteresis, divided by a power
    /// of the period where that is unbounded.
    pub(super) fn rise_miss(&self, period: Gradient<1>, share: Interval) -> Gradient<1> {
        let times = Times::shared(period, share);
        let found = Periodic::new(&self.modes, period.value()).and_then(|periodic| {
            let at = |change| self.output(&periodic, &times, change);
            let hysteresis = (self.upper - self.lower) * divisor(&self.modes, period.value());
            Some(at(Change::Off)? - at(Change::On)? - Gradient::constant(hysteresis))
        });
        found.unwrap_or(Gradient::new(Interval::ENTIRE, [Interval::ENTIRE]))
    }

    /// The one place of a change, given its enclosed half-periods; just before the input's own change where they coincide
    /// for want of a delay. `None` where they may coincide otherwise.
    pub(super) fn place<const N: usize>(&self, times: &Times<N>, change: Change) -> Option<Place> {
        if self.delay.upper() == 0.0 {
            return Some(match change {
                Change::On => Place { rises: 1.0, falls: 1.0, input_high: false },
                Change::Off => Place { rises: 1.0, falls: 0.0, input_high: true },
            });
        }
        match self.places(times, change)?.as_slice() {
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
    /// A period below which the output cannot move from one level to the other; zero without hysteresis.
    pub(super) fn shortest_period(&self, longest: f64) -> f64 {
        let width = (self.upper - self.lower).lower();
        let step = Interval::point(4.0) * (self.high - self.low).abs();
        // The output's rise is a sum of four answers.
        let too_small = |period: f64| (step * Interval::point(super::kernel::bound(&self.modes, period))).upper() < width;
        if !(width > 0.0) {
            return 0.0;
        }
        (0..60).map(|halvings| longest * 0.5_f64.powi(halvings)).find(|&period| too_small(period)).unwrap_or(0.0)
    }
}
