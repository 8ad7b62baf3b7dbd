//! From records and settings to constraints and a box to search.

use super::bounds::{Quantity, QuantityRange};
use super::command::Command;
use super::field::Term;
use super::problem::{Layout, Readings, Window};
use super::settings::{BoundedModel, DelayBound, SwitchedWhen};
use crate::experiment::Record;
use crate::identify::IdentifyError;
use crate::numeric::{Interval, Limit, OutOfDomain};

/// Room for what rounding did to a reading on its way into the file, in steps of the sensor.
const READING: f64 = 1e-9;
/// Linear drag that drives is looked for up to this over the mean time between switchings.
const DRIVING: f64 = 2.5;
/// Lags are looked for up to the mean time between switchings over this: longer ones change places with drag's own time.
const LEAST_LAG_RATE: f64 = 4.0;
/// Most windows of a record: the linear programmes grow with them.
const MOST_WINDOWS: usize = 40;

/// How records are cut into windows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cutting {
    /// Windows between two switchings of the command.
    per_swing: f64,
    /// Fewest samples of a window.
    fewest: usize,
}

/// Of whole records.
const WHOLE: Cutting = Cutting { per_swing: 1.0, fewest: 6 };

/// How much of every record is its beginning, which over wide boxes tells nearly what all of it tells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    /// Up to this switching.
    pub(super) swings: usize,
    /// Over wide boxes longer windows tell less, as what is in doubt grows with the square of their length.
    cutting: Cutting,
}

pub(super) const SEARCHED: Beginning = Beginning { swings: 3, cutting: Cutting { per_swing: 4.0, fewest: 6 } };
/// Where fewer boxes are worth larger linear programmes.
pub(super) const PROVED: Beginning = Beginning { swings: 3, cutting: Cutting { per_swing: 10.0, fewest: 2 } };

/// Constraints, unknowns, and the box.
#[derive(Clone, Debug)]
pub(super) struct Setup {
    pub(super) records: Vec<Readings>,
    pub(super) layout: Layout,
    pub(super) known_delay_s: Interval,
    pub(super) middle_speed: f64,
    /// No speed beyond this is looked for.
    pub(super) fastest: f64,
    /// Mean time between switchings.
    pub(super) swing_s: f64,
    /// Half the range of the output.
    pub(super) reach: f64,
    pub(super) typical_speed: f64,
    /// Least coefficient of linear drag over alpha.
    pub(super) least_linear: f64,
    /// Sample of each record from which on it is followed; where the longest delay is not over by then, from when it is.
    pub(super) onset: Vec<usize>,
    pub(super) search: Vec<Interval>,
}

fn refuse(quantity: &'static str, value: f64, unit: &'static str, limit: Limit, remedy: &'static str) -> IdentifyError {
    OutOfDomain { quantity, value, unit, limit, remedy }.into()
}

fn interval(low: f64, high: f64) -> Interval {
    Interval::new(low.min(high), high.max(low)).unwrap_or(Interval::ENTIRE)
}

/// A record's orders of magnitude.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    /// Half the range of the output.
    reach: f64,
    swing_s: f64,
    force: f64,
    /// Root mean square of the speed.
    speed: f64,
    /// The largest mean speed over a tenth of a swing.
    pub(super) fastest: f64,
}

impl Scales {
    pub(super) fn of(readings: &Readings) -> Self {
        let (time, value) = (&readings.time_s, &readings.value);
        let (low, high) = value.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
        let lasted = time[time.len() - 1] - time[0];
        let swing_s = readings.swing_s();
        let (mut squares, mut count, mut fastest) = (0.0, 0.0, 0.0f64);
        let mut first = 0;
        for last in 1..time.len() {
            while time[last] - time[first + 1] > 0.1 * swing_s && first + 1 < last {
                first += 1;
            }
            let speed = (value[last] - value[first]).abs() / (time[last] - time[first]);
            let sure = (speed - 2.0 * readings.error / (time[last] - time[first])).max(0.0);
            squares += speed * sure;
            count += 1.0;
            fastest = fastest.max(speed + 2.0 * readings.error / (time[last] - time[first]));
        }
        let reach = (0.5 * (high - low)).max(readings.error);
        let speed = libm::sqrt(squares / count).max(reach / lasted);
        Self { reach, swing_s, force: readings.command.largest(), speed, fastest }
    }
}

impl BoundedModel {
    fn check(&self) -> Result<(), IdentifyError> {
        for (quantity, value, unit) in [
            ("largest error of a reading", self.error, "output"),
            ("largest error of a stamp", self.jitter_s, "s"),
            ("step of the sensor", self.quantum.unwrap_or(0.0), "output"),
        ] {
            if !Limit::NonNegative.holds(value) {
                return Err(refuse(quantity, value, unit, Limit::NonNegative, "give the sensor's largest error"));
            }
        }
        if !(self.reach > 1.0 && self.reach <= 1e6) {
            let limit = Limit::Within(1.0, 1e6);
            return Err(refuse("reach of the search", self.reach, "", limit, "100 looks through four decades"));
        }
        let delays = match self.delay {
            DelayBound::KnownS(delay_s) => [delay_s; 2],
            DelayBound::WithinS(range) => range,
            DelayBound::Unknown => [0.0; 2],
        };
        if !(delays[0] >= 0.0 && delays[0] <= delays[1] && delays[1].is_finite()) {
            return Err(refuse(
                "least delay",
                delays[0],
                "s",
                Limit::NonNegative,
                "give the lower bound of the delay first",
            ));
        }
        Ok(())
    }

    /// Step of a record's sensor, zero for none.
    pub(super) fn step(&self, record: &Record) -> f64 {
        self.quantum.or_else(|| record.quantum()).unwrap_or(0.0)
    }

    pub(super) fn terms(&self) -> Vec<Term> {
        let mut terms = vec![Term::Gain];
        for (term, used) in [
            (Term::Linear, self.law.has_linear()),
            (Term::Quadratic, self.law.has_quadratic()),
            (Term::Cubic, self.cubic),
            (Term::Stiffness, self.stiffness),
            (Term::LagRate, self.lag),
        ] {
            if used {
                terms.push(term);
            }
        }
        terms
    }
}

impl Readings {
    /// Of every record, with the errors that are granted.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] that names what is missing.
    pub(super) fn of(records: &[&Record], settings: &BoundedModel) -> Result<Vec<Self>, IdentifyError> {
        settings.check()?;
        if records.is_empty() {
            return Err(refuse("number of records", 0.0, "", Limit::AtLeast(1.0), "give a record"));
        }
        let mut readings = Vec::new();
        for record in records {
            let quantum = settings.step(record);
            let error = 0.5 * quantum * (1.0 + READING) + settings.error;
            if error <= 0.0 {
                let remedy = "the record shows no step of its sensor: give its step, or its largest error";
                return Err(refuse("largest error of a reading", error, "output", Limit::Positive, remedy));
            }
            let command = Command::of(record, settings.switching == SwitchedWhen::Anywhere, settings.jitter_s);
            if command.largest() <= 0.0 {
                return Err(refuse(
                    "largest command",
                    0.0,
                    "force",
                    Limit::Positive,
                    "choose the column of the command",
                ));
            }
            if command.edges() == 0 {
                let remedy = "give a record in which the command changes";
                return Err(refuse("switchings of the command", 0.0, "", Limit::AtLeast(1.0), remedy));
            }
            if command.spans().windows(2).any(|pair| pair[0].1 > pair[1].0) {
                let limit = Limit::Words("at most half the shortest time between two changes of the command");
                let remedy =
                    "give the largest error that a stamp may have, or a log of a command that changes less often";
                return Err(refuse("largest error of a stamp", settings.jitter_s, "s", limit, remedy));
            }
            readings.push(Self {
                time_s: record.time_s().to_vec(),
                value: record.output().to_vec(),
                error,
                jitter_s: settings.jitter_s,
                command,
            });
        }
        Ok(readings)
    }
}

impl Setup {
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] that names what is missing.
    pub(super) fn new(records: &[&Record], settings: &BoundedModel) -> Result<Self, IdentifyError> {
        let readings = Readings::of(records, settings)?;
        let scales: Vec<Scales> = readings.iter().map(Scales::of).collect();
        Self::of(readings, settings, &scales)
    }

    /// From readings, looking for parameters of these orders of magnitude.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] for a record that is too short for its delay.
    pub(super) fn of(
        readings: Vec<Readings>,
        settings: &BoundedModel,
        scales: &[Scales],
    ) -> Result<Self, IdentifyError> {
        let swing_s = scales.iter().map(|scale| scale.swing_s).fold(f64::INFINITY, f64::min);
        let delay = match settings.delay {
            DelayBound::KnownS(delay_s) => Interval::point(delay_s),
            DelayBound::WithinS([low, high]) => interval(low, high),
            DelayBound::Unknown => interval(0.0, swing_s),
        };
        let both = settings.law.has_linear() && settings.law.has_quadratic();
        let speed = scales.iter().map(|scale| scale.speed).sum::<f64>() / scales.len() as f64;
        let middle_speed = if both { speed } else { 0.0 };
        let fastest = 4.0 * scales.iter().map(|scale| scale.fastest).fold(0.0, f64::max);
        let onset = vec![0; readings.len()];
        let layout = Self::lay(&readings, settings, delay, WHOLE, &onset)?;
        let first = &scales[0];
        // A force moves the vehicle by its reach in a swing.
        let gain = 4.0 * first.reach / (first.force * first.swing_s * first.swing_s);
        let rate = 1.0 / first.swing_s;
        let reach = settings.reach;
        let least_linear = if settings.either_sign { -DRIVING * rate } else { 0.0 };
        let terms = layout.terms().iter().map(|term| {
            let linear = interval(least_linear, reach * rate);
            let quadratic = interval(0.0, reach * rate / first.speed);
            match term {
                Term::Gain => interval(gain / reach, gain * reach),
                Term::Linear => linear + Interval::point(2.0 * middle_speed) * quadratic,
                Term::Quadratic => quadratic,
                Term::Cubic => interval(0.0, reach * rate / (first.speed * first.speed)),
                Term::Stiffness => interval(0.0, reach * rate * rate),
                Term::LagRate => interval(LEAST_LAG_RATE * rate, 1000.0 * rate),
                Term::Disturbance => Interval::ZERO,
            }
        });
        let mut search: Vec<Interval> = terms.collect();
        search.extend(layout.delay().map(|_| delay));
        for (record, readings) in readings.iter().enumerate() {
            // A disturbance stronger than the command is no oscillation's.
            search.push(Interval::symmetric(gain * reach * readings.command.largest()));
            search.extend((0..layout.instants(record)).map(|edge| readings.command.span(edge)));
        }
        let mut setup = Self {
            layout,
            known_delay_s: delay,
            middle_speed,
            fastest,
            swing_s,
            reach: scales.iter().map(|scale| scale.reach).fold(0.0, f64::max),
            typical_speed: speed,
            least_linear,
            onset,
            search,
            records: readings,
        };
        setup.states();
        Ok(setup)
    }

    /// Windows of every record from its onset, or from where every command that acts is in the log.
    fn lay(
        readings: &[Readings],
        settings: &BoundedModel,
        delay: Interval,
        cutting: Cutting,
        onset: &[usize],
    ) -> Result<Layout, IdentifyError> {
        let mut windows = Vec::new();
        let mut instants = Vec::new();
        for (record, readings) in readings.iter().enumerate() {
            let samples = readings.time_s.len();
            let acted_s = readings.acted_s(delay);
            let first = readings.time_s.partition_point(|time| *time < acted_s).max(onset[record]);
            if samples < first + 3 * cutting.fewest {
                let remedy = "give a longer record, or bound the delay";
                return Err(refuse(
                    "longest delay",
                    delay.upper(),
                    "s",
                    Limit::Words("well within the record"),
                    remedy,
                ));
            }
            let swings = (readings.command.edges() + 1 - readings.skipped(onset[record])) as f64;
            let count = (cutting.per_swing * swings).ceil().clamp(2.0, MOST_WINDOWS as f64);
            let most = (samples - first) / cutting.fewest;
            let count = (count as usize).min(most).max(1);
            let nodes: Vec<usize> = (0..=count).map(|index| first + (samples - 1 - first) * index / count).collect();
            windows.extend(nodes.windows(2).map(|pair| Window { record, first: pair[0], last: pair[1] }));
            instants.push(readings.command.instants());
        }
        let delayed = !delay.is_point();
        Ok(Layout::new(settings.terms(), delayed, instants, windows))
    }

    /// States at the windows' beginnings, from the readings there alone.
    fn states(&mut self) {
        self.search.truncate(self.layout.parameters());
        self.search.extend(self.layout.states(&self.records, self.fastest));
    }

    fn delay_s(&self) -> Interval {
        self.layout.delay().map_or(self.known_delay_s, |place| self.search[place])
    }

    /// The same constraints but for those before the switching of this number of every record, which is after the longest delay. `None`
    /// where too little is left.
    pub(super) fn after(&self, settings: &BoundedModel, edge: usize) -> Option<Self> {
        let delay_s = self.delay_s();
        let mut setup = self.clone();
        for (readings, onset) in self.records.iter().zip(&mut setup.onset) {
            let (first, last) = *readings.command.spans().get(edge)?;
            *onset = readings.time_s.partition_point(|time| *time < last.max(first));
            if first < readings.acted_s(delay_s) || *onset >= readings.time_s.len() {
                return None;
            }
        }
        setup.layout = Self::lay(&self.records, settings, delay_s, WHOLE, &setup.onset).ok()?;
        setup.states();
        Some(setup)
    }

    /// The beginnings of all records: what they leave encloses what the whole records leave. `None` where that would save little.
    pub(super) fn beginnings(&self, settings: &BoundedModel, beginning: Beginning) -> Option<Self> {
        let mut setup = self.ended(settings, beginning)?;
        let delay_s = self.delay_s();
        for (readings, onset) in setup.records.iter_mut().zip(&mut setup.onset) {
            // What acts later than the longest delay before the onset was commanded after that.
            let begin = Interval::point(readings.time_s[*onset]) - delay_s;
            let left_out = readings.time_s.partition_point(|time| *time < begin.lower()).min(*onset).saturating_sub(1);
            *readings = readings.from(left_out);
            *onset -= left_out;
        }
        setup.layout = Self::lay(&setup.records, settings, delay_s, beginning.cutting, &setup.onset).ok()?;
        setup.states();
        Some(setup)
    }

    /// The same with all readings before the onset, as the records have them.
    pub(super) fn ended(&self, settings: &BoundedModel, beginning: Beginning) -> Option<Self> {
        let Beginning { swings, cutting } = beginning;
        let mut setup = self.clone();
        for (readings, onset) in setup.records.iter_mut().zip(&setup.onset) {
            let skipped = readings.skipped(*onset);
            // Unknown instants are parameters of their own, and all of them would have to be known after.
            if readings.command.instants() > 0 || readings.command.edges() < skipped + 2 * swings {
                return None;
            }
            let (end, _) = readings.command.spans()[skipped + swings];
            *readings = readings.until(readings.time_s.partition_point(|time| *time < end));
        }
        setup.layout = Self::lay(&setup.records, settings, self.delay_s(), cutting, &setup.onset).ok()?;
        setup.states();
        Some(setup)
    }

    /// Windows of a record, at most.
    pub(super) fn most_windows(&self) -> usize {
        let of = |record| self.layout.windows().iter().filter(|window| window.record == record).count();
        (0..self.records.len()).map(of).max().unwrap_or(0)
    }

    /// A box with what the beginnings leave of the parameters, and of the states at the records' beginnings.
    pub(super) fn begun(&self, beginnings: &Self, at: &[Interval]) -> Vec<Interval> {
        let mut own = self.within(at).search;
        for (place, from) in self.layout.of_whole().into_iter().zip(beginnings.layout.of_whole()) {
            own[place] = at[from];
        }
        own
    }

    /// Windows of each record that hold so many swings, twice as many, and so on; at last all.
    pub(super) fn reaches(&self, beginning: usize) -> Vec<usize> {
        let all = self.most_windows();
        let swings = |(readings, onset): (&Readings, &usize)| readings.command.edges() + 1 - readings.skipped(*onset);
        let most = self.records.iter().zip(&self.onset).map(swings).max().unwrap_or(1);
        let reaches = core::iter::successors(Some((all * beginning).div_ceil(most)), |reach| Some(2 * reach));
        reaches.take_while(|reach| *reach < all).chain([all]).collect()
    }

    /// The same with the windows of the `beginnings` first.
    pub(super) fn opened(&self, beginnings: &Self) -> Self {
        let mut windows = Vec::new();
        for record in 0..self.records.len() {
            let of = |setup: &Self| -> Vec<Window> {
                setup.layout.windows().iter().copied().filter(|window| window.record == record).collect()
            };
            let opening = of(beginnings);
            let end = opening.last().map_or(0, |window| window.last);
            windows.extend(opening);
            let rest = of(self).into_iter().filter(|window| window.last > end);
            windows.extend(rest.map(|window| Window { first: window.first.max(end), ..window }));
        }
        let mut setup = Self { layout: self.layout.clone().with_windows(windows), ..self.clone() };
        setup.states();
        setup
    }

    /// Number of readings.
    pub(super) fn samples(&self) -> usize {
        self.records.iter().zip(&self.onset).map(|(readings, onset)| readings.value.len() - onset).sum()
    }

    /// The same with the parameters known to lie in `at`.
    pub(super) fn within(&self, at: &[Interval]) -> Self {
        let mut setup = self.clone();
        setup.search = at[..self.layout.parameters()].to_vec();
        setup.states();
        setup
    }

    /// The same constraints with the parameters known to lie in `at`: a shorter delay leaves more readings.
    pub(super) fn narrowed(&self, settings: &BoundedModel, at: &[Interval]) -> Result<Self, IdentifyError> {
        let Some(place) = self.layout.delay() else { return Ok(self.within(at)) };
        let mut setup = self.clone();
        setup.layout = Self::lay(&self.records, settings, at[place], WHOLE, &self.onset)?;
        setup.search = at[..self.layout.parameters()].to_vec();
        if setup.layout.delay().is_none() {
            setup.known_delay_s = at[place];
            setup.search.remove(place);
        }
        setup.states();
        Ok(setup)
    }

    /// A box of parameters in words.
    pub(super) fn ranges(&self, at: &[Interval]) -> Vec<QuantityRange> {
        let range = |quantity, side: Interval| QuantityRange { quantity, low: side.lower(), high: side.upper() };
        let mut ranges: Vec<QuantityRange> = Vec::new();
        for (place, term) in self.layout.terms().iter().enumerate() {
            let quantity = match term {
                Term::Gain => Quantity::Gain,
                Term::Linear => Quantity::LinearRate,
                Term::Quadratic => Quantity::QuadraticRate,
                Term::Cubic => Quantity::CubicRate,
                Term::Stiffness => Quantity::StiffnessRate,
                Term::LagRate => Quantity::LagRate,
                Term::Disturbance => continue,
            };
            let side = if *term == Term::Linear { self.linear(at) } else { at[place] };
            ranges.push(range(quantity, side));
        }
        if let Some(place) = self.layout.delay() {
            ranges.push(range(Quantity::DelayS, at[place]));
        }
        for record in 0..self.records.len() {
            ranges.push(range(Quantity::DeltaRate(record), at[self.layout.disturbance(record)]));
        }
        ranges.push(range(Quantity::Speed, Interval::symmetric(self.fastest)));
        ranges
    }

    /// The linear drag over alpha, which in the box stands with the quadratic one's share at the middle speed.
    fn linear(&self, at: &[Interval]) -> Interval {
        let side = |term| self.layout.place_of(term).map_or(Interval::ZERO, |place| at[place]);
        side(Term::Linear) - Interval::point(2.0 * self.middle_speed) * side(Term::Quadratic)
    }
}
