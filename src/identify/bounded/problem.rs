//! The constraint satisfaction problem: records, unknowns, and the box in which they are searched.

use super::answer::{Quantity, QuantityRange};
use super::record::{Command, Readings, Scales};
use super::settings::{BoundedModel, DelayBound, SwitchedWhen};
use super::unknowns::{Shooting, Unknowns};
use super::vector_field::FieldTerm;
use super::work::Work;
use crate::experiment::Record;
use crate::identify::IdentifyError;
use crate::numeric::{Interval, Limit, OutOfDomain};

/// Room for the rounding of numbers on their way into a file: of a reading in steps of the sensor, of the rest in shares of themselves.
pub(super) const ROUNDING: f64 = 1e-9;
/// Largest negative drag rate that is searched, over the mean half-period: an unstable vehicle that grows by `e^2.5` in it.
const DRIVING: f64 = 2.5;
/// Longest lag that is searched: the mean half-period over this. A longer lag exchanges with the time constant of the drag.
const LEAST_LAG_RATE: f64 = 4.0;
/// Speeds are searched up to this times the largest mean speed of the readings.
const FASTEST: f64 = 4.0;
/// Most shooting intervals of a record: the linear programmes grow with them.
const MOST_INTERVALS: usize = 40;
/// Fewest samples of a shooting interval.
const FEWEST_SAMPLES: usize = 6;
/// Half-periods of the first horizon: over wide boxes they narrow nearly as far as the whole record.
const FIRST_HORIZON: usize = 3;
/// Shooting intervals of a half-period in the first horizon; there boxes are wide, and the error of the sensitivities grows with the
/// square of an interval's length. Later there is a single interval for each half-period.
const PER_HALF_PERIOD: usize = 4;

/// Records, unknowns and search box.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    pub(super) records: Vec<Readings>,
    pub(super) unknowns: Unknowns,
    pub(super) known_delay_s: Interval,
    /// The speed about which quadratic drag is written.
    pub(super) middle_speed: f64,
    /// The largest speed that is searched.
    pub(super) fastest: f64,
    pub(super) half_period_s: f64,
    /// Half the range of the output.
    pub(super) amplitude: f64,
    pub(super) typical_speed: f64,
    /// Least coefficient of linear drag over alpha.
    pub(super) least_linear: f64,
    pub(super) search: Vec<Interval>,
    /// Shooting intervals of each record that are followed, from its first on.
    pub(super) horizon: usize,
    pub(super) work: Work,
}

fn refuse(quantity: &'static str, value: f64, unit: &'static str, limit: Limit, remedy: &'static str) -> IdentifyError {
    OutOfDomain { quantity, value, unit, limit, remedy }.into()
}

fn interval(low: f64, high: f64) -> Interval {
    Interval::new(low.min(high), high.max(low)).unwrap_or(Interval::ENTIRE)
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
            let remedy = "give the lower bound of the delay first";
            return Err(refuse("least delay", delays[0], "s", Limit::NonNegative, remedy));
        }
        Ok(())
    }

    /// Step of a record's sensor, zero for none.
    pub(super) fn step(&self, record: &Record) -> f64 {
        self.quantum.or_else(|| record.quantum()).unwrap_or(0.0)
    }

    fn terms(&self) -> Vec<FieldTerm> {
        let used = [
            (FieldTerm::Gain, true),
            (FieldTerm::Linear, self.law.has_linear()),
            (FieldTerm::Quadratic, self.law.has_quadratic()),
            (FieldTerm::Cubic, self.cubic),
            (FieldTerm::Stiffness, self.stiffness),
            (FieldTerm::LagRate, self.lag),
        ];
        used.into_iter().filter(|(_, used)| *used).map(|(term, _)| term).collect()
    }
}

impl Readings {
    /// Of every record, with the errors that are granted.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] that names the quantity.
    pub(super) fn of(records: &[&Record], settings: &BoundedModel) -> Result<Vec<Self>, IdentifyError> {
        settings.check()?;
        if records.is_empty() {
            return Err(refuse("number of records", 0.0, "", Limit::AtLeast(1.0), "give a record"));
        }
        let readings = |record: &&Record| {
            let error = 0.5 * settings.step(record) * (1.0 + ROUNDING) + settings.error;
            if error <= 0.0 {
                let remedy = "the record shows no step of its sensor: give its step, or its largest error";
                return Err(refuse("largest error of a reading", error, "output", Limit::Positive, remedy));
            }
            let command = Command::of(record, settings.switching == SwitchedWhen::Anywhere, settings.jitter_s);
            if command.largest() <= 0.0 {
                let remedy = "choose the column of the command";
                return Err(refuse("largest command", 0.0, "force", Limit::Positive, remedy));
            }
            if command.edges() == 0 {
                let remedy = "give a record in which the command changes";
                return Err(refuse("switchings of the command", 0.0, "", Limit::AtLeast(1.0), remedy));
            }
            if command.spans.windows(2).any(|pair| pair[0].upper() > pair[1].lower()) {
                let limit = Limit::Words("at most half the shortest time between two changes of the command");
                let remedy =
                    "give the largest error that a stamp may have, or a log of a command that changes less often";
                return Err(refuse("largest error of a stamp", settings.jitter_s, "s", limit, remedy));
            }
            let (time_s, value) = (record.time_s().to_vec(), record.output().to_vec());
            Ok(Self { time_s, value, error, jitter_s: settings.jitter_s, command })
        };
        records.iter().map(readings).collect()
    }
}

/// Shooting intervals of a record from where every command that acts is in the log; `None` where that leaves too few samples.
fn divide(record: usize, readings: &Readings, delay: Interval) -> Option<Vec<Shooting>> {
    let samples = readings.time_s.len();
    let acted_s = readings.acted_s(delay);
    let first = readings.time_s.partition_point(|time| *time < acted_s);
    if samples < first + 3 * FEWEST_SAMPLES {
        return None;
    }
    let edges = readings.command.edges();
    let split = |from: usize, to: usize, count: usize| {
        let count = count.min((to - from) / FEWEST_SAMPLES).max(1);
        let node = move |index: usize| from + (to - from) * index / count;
        (0..count).map(move |index| Shooting { record, first: node(index), last: node(index + 1) })
    };
    let last = samples - 1;
    let end = readings
        .command
        .spans
        .get(FIRST_HORIZON)
        .map_or(last, |span| readings.time_s.partition_point(|time| *time < span.lower()).saturating_sub(1));
    if edges < 2 * FIRST_HORIZON || end < first + FEWEST_SAMPLES || last < end + FEWEST_SAMPLES {
        return Some(split(first, last, (edges + 1).clamp(2, MOST_INTERVALS)).collect());
    }
    let early = FIRST_HORIZON * PER_HALF_PERIOD;
    Some(
        split(first, end, early)
            .chain(split(end, last, (edges + 1 - FIRST_HORIZON).min(MOST_INTERVALS - early)))
            .collect(),
    )
}

fn unknowns(readings: &[Readings], settings: &BoundedModel, delay: Interval) -> Result<Unknowns, IdentifyError> {
    let mut shooting = Vec::new();
    for (record, readings) in readings.iter().enumerate() {
        shooting.extend(divide(record, readings, delay).ok_or_else(|| {
            let limit = Limit::Words("well within the record");
            refuse("longest delay", delay.upper(), "s", limit, "give a longer record, or bound the delay")
        })?);
    }
    let instants = readings.iter().map(|own| own.command.unknown_instants()).collect();
    Ok(Unknowns::new(settings.terms(), !delay.is_point(), instants, shooting))
}

impl Problem {
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] that names the quantity.
    pub(super) fn new(records: &[&Record], settings: &BoundedModel) -> Result<Self, IdentifyError> {
        let readings = Readings::of(records, settings)?;
        let scales: Vec<Scales> = readings.iter().map(Readings::scales).collect();
        Self::of(readings, settings, &scales)
    }

    /// From readings, and parameters of these orders of magnitude.
    ///
    /// # Errors
    /// [`IdentifyError::OutOfDomain`] for a record that is too short for its delay.
    pub(super) fn of(
        records: Vec<Readings>,
        settings: &BoundedModel,
        scales: &[Scales],
    ) -> Result<Self, IdentifyError> {
        let half_period_s = scales.iter().map(|scale| scale.half_period_s).fold(f64::INFINITY, f64::min);
        let delay = match settings.delay {
            DelayBound::KnownS(delay_s) => Interval::point(delay_s),
            DelayBound::WithinS([low, high]) => interval(low, high),
            DelayBound::Unknown => interval(0.0, half_period_s),
        };
        let both = settings.law.has_linear() && settings.law.has_quadratic();
        let speed = scales.iter().map(|scale| scale.speed).sum::<f64>() / scales.len() as f64;
        let middle_speed = if both { speed } else { 0.0 };
        let unknowns = unknowns(&records, settings, delay)?;
        let first = &scales[0];
        // A force moves the vehicle by its amplitude in a half-period.
        let gain = 4.0 * first.amplitude / (first.force * first.half_period_s * first.half_period_s);
        let (rate, reach) = (1.0 / first.half_period_s, settings.reach);
        let least_linear = if settings.either_sign { -DRIVING * rate } else { 0.0 };
        let range = |term: &FieldTerm| {
            let linear = interval(least_linear, reach * rate);
            let quadratic = interval(0.0, reach * rate / first.speed);
            match term {
                FieldTerm::Gain => interval(gain / reach, gain * reach),
                FieldTerm::Linear => linear + Interval::point(2.0 * middle_speed) * quadratic,
                FieldTerm::Quadratic => quadratic,
                FieldTerm::Cubic => interval(0.0, reach * rate / (first.speed * first.speed)),
                FieldTerm::Stiffness => interval(0.0, reach * rate * rate),
                FieldTerm::LagRate => interval(LEAST_LAG_RATE * rate, 1000.0 * rate),
                FieldTerm::Disturbance => Interval::ZERO,
            }
        };
        let mut search: Vec<Interval> = unknowns.terms.iter().map(range).collect();
        search.extend(unknowns.delay().map(|_| delay));
        for (record, readings) in records.iter().enumerate() {
            // Under a disturbance stronger than the command there is no oscillation.
            search.push(Interval::symmetric(gain * reach * readings.command.largest()));
            search.extend(&readings.command.spans[..unknowns.instants(record)]);
        }
        let problem = Self {
            known_delay_s: delay,
            middle_speed,
            fastest: FASTEST * scales.iter().map(|scale| scale.fastest).fold(0.0, f64::max),
            half_period_s,
            amplitude: scales.iter().map(|scale| scale.amplitude).fold(0.0, f64::max),
            typical_speed: speed,
            least_linear,
            search: Vec::new(),
            horizon: usize::MAX,
            work: Work::default(),
            records,
            unknowns,
        };
        Ok(problem.within(&search))
    }

    /// The same with the parameters in `at`, and the states as the readings tell them.
    pub(super) fn within(&self, at: &[Interval]) -> Self {
        let mut search = at[..self.unknowns.parameters()].to_vec();
        search.extend(self.unknowns.states(&self.records, self.fastest));
        Self { search, ..self.clone() }
    }

    /// The same with a narrower range of the delay, after which more readings can be used.
    pub(super) fn narrowed(&self, settings: &BoundedModel, at: &[Interval]) -> Result<Self, IdentifyError> {
        let Some(place) = self.unknowns.delay() else { return Ok(self.within(at)) };
        let mut problem = self.clone();
        problem.unknowns = unknowns(&self.records, settings, at[place])?;
        let mut parameters = at[..self.unknowns.parameters()].to_vec();
        if problem.unknowns.delay().is_none() {
            problem.known_delay_s = parameters.remove(place);
        }
        Ok(problem.within(&parameters))
    }

    /// Numbers of shooting intervals: the first horizon, then twice as many later ones each time, at last all.
    pub(super) fn horizons(&self) -> Vec<usize> {
        let all = (0..self.records.len()).map(|record| self.unknowns.intervals(record)).max().unwrap_or(0);
        let first = FIRST_HORIZON * PER_HALF_PERIOD;
        let doubled = core::iter::successors(Some(FIRST_HORIZON), |later| Some(2 * later));
        let horizons = core::iter::once(first).chain(doubled.map(|later| first + later));
        horizons.take_while(|horizon| *horizon < all).chain([all]).collect()
    }

    /// The same with the records cut at a horizon.
    pub(super) fn until(&self, horizon: usize) -> Self {
        let mut problem = Self { horizon, ..self.clone() };
        for (record, readings) in problem.records.iter_mut().enumerate() {
            let own = self.unknowns.shooting.iter().filter(|own| own.record == record);
            let samples = own.take(horizon).last().map_or(0, |own| own.last) + 1;
            readings.time_s.truncate(samples);
            readings.value.truncate(samples);
        }
        problem
    }

    /// Shooting intervals that are followed.
    pub(super) fn followed(&self) -> impl Iterator<Item = (usize, Shooting)> + '_ {
        let shooting = self.unknowns.shooting.iter().copied().enumerate();
        shooting.filter(|(index, own)| index - self.unknowns.first(own.record) < self.horizon)
    }

    pub(super) fn delay_s(&self, at: &[Interval]) -> Interval {
        self.unknowns.delay().map_or(self.known_delay_s, |place| at[place])
    }

    /// The range of a term over a box; zero for a term that the equation does not have.
    pub(super) fn term(&self, term: FieldTerm, at: &[Interval]) -> Interval {
        self.unknowns.place_of(term).map_or(Interval::ZERO, |place| at[place])
    }

    /// The linear drag over alpha, without the share of the quadratic drag at the middle speed.
    pub(super) fn linear_drag(&self, at: &[Interval]) -> Interval {
        self.term(FieldTerm::Linear, at)
            - Interval::point(2.0 * self.middle_speed) * self.term(FieldTerm::Quadratic, at)
    }

    pub(super) fn least_error(&self) -> f64 {
        self.records.iter().fold(f64::INFINITY, |least, readings| least.min(readings.error))
    }

    pub(super) fn largest_command(&self) -> f64 {
        self.records.iter().map(|readings| readings.command.largest()).fold(0.0, f64::max)
    }

    /// A box of parameters by its quantities, in the coordinates of the search.
    pub(super) fn ranges(&self, at: &[Interval]) -> Vec<QuantityRange> {
        let unknowns = &self.unknowns;
        let side =
            |term: &FieldTerm| if *term == FieldTerm::Linear { self.linear_drag(at) } else { self.term(*term, at) };
        let terms = unknowns.terms.iter().map(|term| (term.quantity(), side(term)));
        let delay = unknowns.delay().map(|place| (Quantity::DelayS, at[place]));
        let disturbances =
            (0..unknowns.records()).map(|record| (Quantity::DeltaRate(record), at[unknowns.disturbance(record)]));
        let speed = (Quantity::Speed, Interval::symmetric(self.fastest));
        terms.chain(delay).chain(disturbances).chain([speed]).map(QuantityRange::of).collect()
    }
}
