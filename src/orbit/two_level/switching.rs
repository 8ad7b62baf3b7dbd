//! The switching conditions: the periodic output where the command changes, over boxes of half-periods.

use core::f64::consts::PI;

use super::kernel::{Moment, Periodic, rise_at_zero};
use super::modes::Mode;
use crate::numeric::{Component, Interval, Real};
use crate::proof::Gradient;

/// A loop in numbers that the conditions need.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SwitchedLoop {
    pub(super) modes: Vec<Mode>,
    pub(super) delay: Interval,
    pub(super) high: Interval,
    pub(super) low: Interval,
    /// Output at which the command becomes low (rising past it), and high (falling past it).
    pub(super) upper: Interval,
    pub(super) lower: Interval,
    /// Share of the period at the upper level that makes the input's mean vanish: of plants with a pole at zero.
    pub(super) share: Option<Interval>,
    /// The loop's output less that of the conditions.
    pub(super) shift: Interval,
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

/// A moment `rises high + falls low + shift` after the rise of the plant's input, with the input at a level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place<const N: usize> {
    pub(super) rises: f64,
    pub(super) falls: f64,
    pub(super) shift: Gradient<N>,
    pub(super) input_high: bool,
}

/// A moment `[0] high + [1] low + [2] s` after the command becomes high, less than a period.
type Offset = [f64; 3];
/// The command becomes high: the output falls past the lower level.
pub(super) const ON: Offset = [0.0; 3];
/// The command becomes low: the output rises past the upper level.
pub(super) const OFF: Offset = [1.0, 0.0, 0.0];

const UNIT_SHARE: Interval = Interval::ZERO.hull(Interval::ONE);
const NOT_NEGATIVE: Interval = Interval::ZERO.hull(Interval::point(f64::INFINITY));

impl<const N: usize> Times<N> {
    /// The unknowns are the half-periods, or the period where the share of the upper level is fixed.
    pub(super) fn new(unknowns: [Gradient<N>; N], share: Option<Interval>) -> Self {
        let (first, last) = (unknowns[0], unknowns[N - 1]);
        let Some(high) = share else { return Self::free(first, last) };
        let of = |share: Interval| first * Gradient::constant(share);
        Self { high: of(high), low: of(Interval::ONE - high), period: first, share }
    }

    pub(super) fn free(high: Gradient<N>, low: Gradient<N>) -> Self {
        Self { high, low, period: high + low, share: None }
    }

    pub(super) fn half_periods(&self) -> [Interval; 2] {
        [self.high.value(), self.low.value()]
    }

    /// `rises high + falls low + shift`.
    fn combination(&self, rises: f64, falls: f64, shift: Gradient<N>) -> Gradient<N> {
        let times = |factor: f64, time: Gradient<N>| match factor {
            0.0 => Gradient::constant(Interval::ZERO),
            factor => time * Gradient::constant(Interval::point(factor)),
        };
        // With a fixed share a single product: nothing is counted twice.
        let whole = self.fixed_share(rises, falls).map(|whole| self.period * Gradient::constant(whole));
        whole.unwrap_or_else(|| times(rises, self.high) + times(falls, self.low)) + shift
    }

    /// The share of the period that `rises high + falls low` is where that is fixed.
    fn fixed_share(&self, rises: f64, falls: f64) -> Option<Interval> {
        let high = self.share?;
        Some(Interval::point(rises) * high + Interval::point(falls) * (Interval::ONE - high))
    }

    /// The time of a place after the input's rise.
    pub(super) fn time(&self, place: &Place<N>) -> Gradient<N> {
        self.combination(place.rises, place.falls, place.shift)
    }

    /// Times since the input's last rise and fall there, with the moments they are; `None` where no half-periods fit the place.
    fn moments(&self, place: &Place<N>) -> Option<[(Gradient<N>, Moment); 2]> {
        let Place { rises, falls, shift, input_high } = *place;
        let moment = |rises: f64, falls: f64| {
            let time = self.combination(rises, falls, shift);
            let rest = self.combination(1.0 - rises, 1.0 - falls, -shift).value().intersection(NOT_NEGATIVE)?;
            let within = time.value().intersection(NOT_NEGATIVE)?;
            let period = self.period.value();
            let fixed = self.fixed_share(rises, falls).map(|whole| whole + shift.value() / period);
            Some((time, Moment { time: within, rest, share: unit_share(fixed.unwrap_or(within / period)) }))
        };
        let since_fall = if input_high { moment(rises, falls + 1.0) } else { moment(rises - 1.0, falls) };
        Some([moment(rises, falls)?, since_fall?])
    }
}

fn unit_share(share: Interval) -> Interval {
    share.intersection(UNIT_SHARE).unwrap_or(UNIT_SHARE)
}

impl SwitchedLoop {
    /// Where in the input's period a moment may be, for some of the half-periods; `None` for too many places.
    fn places<const N: usize>(&self, times: &Times<N>, [high, low, after_s]: Offset) -> Option<Vec<Place<N>>> {
        let shift = Gradient::constant(Interval::point(after_s) - self.delay);
        // 0 <= offset - delay + n T <= T, and the offset is less than a period.
        let before = -times.combination(high, low, shift).value();
        let turns = if before == Interval::ZERO { before } else { before / times.period.value() };
        let (first, last) = (libm::ceil(turns.lower()).max(0.0), (libm::floor(turns.upper()) + 1.0).max(0.0));
        if !(last - first <= 2.0) {
            return None;
        }
        let turns = (0..=(last - first) as u32).map(|step| first + f64::from(step));
        let places = turns.flat_map(|turn| {
            [true, false].map(|input_high| Place { rises: turn + high, falls: turn + low, shift, input_high })
        });
        Some(places.filter(|place| times.moments(place).is_some()).collect())
    }

    /// The only place of a change, given its enclosed half-periods: just before the input's own change where they coincide
    /// for want of a delay. `None` where they may coincide otherwise.
    pub(super) fn place<const N: usize>(&self, times: &Times<N>, change: Offset) -> Option<Place<N>> {
        let mut places = self.places(times, change)?;
        if self.delay.upper() == 0.0 {
            places.retain(|place| place.input_high == (change[0] > 0.0));
        }
        <[_; 1]>::try_from(places).ok().map(|[place]| place)
    }

    /// The output at a moment, over a box of half-periods, less the constant that is free with a pole at zero;
    /// `None` where the box is too wide.
    fn output<const N: usize>(&self, periodic: &Periodic<'_>, times: &Times<N>, offset: Offset) -> Option<Gradient<N>> {
        let places = self.places(times, offset)?;
        places.iter().filter_map(|place| self.output_at(periodic, times, place)).reduce(Component::either)
    }

    pub(super) fn output_at<const N: usize>(
        &self,
        periodic: &Periodic<'_>,
        times: &Times<N>,
        place: &Place<N>,
    ) -> Option<Gradient<N>> {
        let [since_rise, since_fall] = times.moments(place)?.map(|(time, moment)| {
            let answer = periodic.answer(&moment);
            let [by_time, by_period] = answer.slopes();
            let slope = |at: usize| by_time * time.slopes()[at] + by_period * times.period.slopes()[at];
            Gradient::new(answer.value(), core::array::from_fn(slope))
        });
        let swing = (since_rise - since_fall) * Gradient::constant(self.high - self.low);
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
        let [high, low] = times.half_periods();
        let over = step / period.square();
        let [by_high, by_low] = [over * low, -(over * high)];
        let slopes = core::array::from_fn(|at| by_high * times.high.slopes()[at] + by_low * times.low.slopes()[at]);
        Gradient::new(self.low + step * unit_share(high / period), slopes)
    }

    /// How far the output is from its levels where the command changes; its rise less the hysteresis where a pole at zero
    /// makes its constant free. Unknown over a box that is too wide.
    pub(super) fn misses<const N: usize>(&self, unknowns: [Gradient<N>; N]) -> [Gradient<N>; N] {
        let times = Times::new(unknowns, self.share);
        let period = times.period.value();
        if let (Some(share), false) = (self.share, period.is_bounded()) {
            return [Gradient::constant(self.rise_far(period, share).unwrap_or(Interval::ENTIRE)); N];
        }
        let found = Periodic::new(&self.modes, period)
            .and_then(|periodic| Some((self.output(&periodic, &times, OFF)?, self.output(&periodic, &times, ON)?)));
        let Some((off, on)) = found else { return [Gradient::UNKNOWN; N] };
        let level = Gradient::constant;
        match self.share {
            Some(_) => [off - on - level(self.upper - self.lower); N],
            None => core::array::from_fn(|row| [off - level(self.upper), on - level(self.lower)][row]),
        }
    }

    /// That rise over an unbounded range of periods, divided by the largest power of the period that it has.
    fn rise_far(&self, period: Interval, share: Interval) -> Option<Interval> {
        let shorter = share.lower().min((Interval::ONE - share).lower());
        if !(self.delay.upper() <= (Interval::point(shorter) * period).lower()) {
            return None;
        }
        let times = Times::new([Gradient::<1>::constant(period)], self.share);
        let away: Vec<Mode> = self.modes.iter().filter(|mode| mode.inverse.is_some()).cloned().collect();
        let periodic = Periodic::new(&away, period)?;
        let bounded = (self.output(&periodic, &times, OFF)? - self.output(&periodic, &times, ON)?).value();
        let mut ascending = rise_at_zero(&self.modes, share, self.delay);
        ascending.iter_mut().for_each(|coefficient| *coefficient *= self.high - self.low);
        ascending[0] += bounded - (self.upper - self.lower);
        let over = (Interval::ONE / period).intersection(NOT_NEGATIVE)?;
        let from = ascending.iter().position(|&coefficient| coefficient != Interval::ZERO)?;
        let last = ascending.iter().rposition(|&coefficient| coefficient != Interval::ZERO)?;
        Some(ascending[from..=last].iter().fold(Interval::ZERO, |sum, &coefficient| sum * over + coefficient))
    }

    /// Whether no half-periods of a box are those of an orbit: the output is past a level before it may be.
    pub(super) fn refuses<const N: usize>(&self, sides: [Interval; N]) -> bool {
        let middle = sides.map(|side| Gradient::constant(Interval::point(side.midpoint())));
        let boxes = [Gradient::variables(sides), middle].map(|unknowns| Times::new(unknowns, self.share));
        let [Some(wide), Some(narrow)] = boxes.map(|times| Periodic::new(&self.modes, times.period.value())) else {
            return false;
        };
        // By the mean value theorem.
        let value = |offset: Offset| {
            let around = self.output(&wide, &boxes[0], offset)?;
            let at = self.output(&narrow, &boxes[1], offset)?.value();
            let terms = around.slopes().into_iter().zip(sides);
            let spread = terms.fold(at, |sum, (slope, side)| sum + slope * (side - Interval::point(side.midpoint())));
            Some(spread.intersection(around.value()).unwrap_or(spread))
        };
        let constant = match self.share {
            Some(_) => value(ON).map_or(Interval::ENTIRE, |at_on| self.lower - at_on),
            None => Interval::ZERO,
        };
        let past = |high: Offset, low: Offset| {
            value(high).is_some_and(|value| self.upper.precedes(value + constant))
                || value(low).is_some_and(|value| (value + constant).precedes(self.lower))
        };
        // In the middle, and late, where the output may have come through the level the wrong way.
        let mut shares = [0.5, 0.95].into_iter();
        // Where a pair of poles has swung over.
        let half_turns = self.modes.iter().filter_map(|mode| Some(PI / mode.algebra.frequency?.midpoint()));
        let swings =
            half_turns.flat_map(|half_turn_s| [0.5, 1.0, 1.5].map(|turns| self.delay.upper() + turns * half_turn_s));
        let [high, low] = boxes[0].half_periods();
        let mut within = swings.filter(|&after_s| after_s < high.lower().min(low.lower()));
        shares.any(|share| past([share, 0.0, 0.0], [1.0, share, 0.0]))
            || within.any(|after_s| past([0.0, 0.0, after_s], [1.0, 0.0, after_s]))
    }

    /// A period below which the output cannot move between the levels; zero without hysteresis.
    ///
    /// Where `abs(A) T <= 1`, `abs(B_j(x)/j!) <= 4/(2 pi)^j` bounds `abs(W)/T` by
    /// `4/(2 pi)^2/(1 - 1/(2 pi)) reach < 0.1206 reach`; the output's rise is a sum of four answers.
    pub(super) fn shortest_period(&self) -> f64 {
        let reach: f64 = self.modes.iter().map(Mode::reach).sum();
        let fastest = self.modes.iter().map(|mode| mode.algebra.size()).fold(0.0, f64::max);
        // 0.121 has room for rounding.
        let rate = 4.0 * 0.121 * reach * (self.high - self.low).upper();
        ((self.upper - self.lower).lower() / rate).min(1.0 / fastest).max(0.0)
    }
}
