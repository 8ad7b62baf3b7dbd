//! Contraction of one box until nothing helps.

use super::contract::{Cut, Linear, Model, Pass, Span};
use super::field::Term;
use super::lp::Multipliers;
use super::setup::Setup;
use super::trajectory::Node;
use super::weak::{Hat, hats};
use crate::numeric::Interval;

/// A pass that leaves more than this of every parameter's width did not help.
const HELPED: f64 = 0.9;
/// A box is too wide to follow the motion over while a parameter's range is worth more than this share of the command.
const WIDE: f64 = 0.5;
/// The same where the motion takes many steps.
const STIFF: f64 = 0.1;
/// Steps between two samples that are many.
const MANY: f64 = 3.0;
/// The gain is divided first until its ends are within this factor.
const ORDERS: f64 = 4.0;
/// Passes over one box at most.
const MOST_PASSES: usize = 30;

/// Passes over one slice at most.
const FINE_PASSES: usize = 6;
/// Records are followed as a whole where the slopes' ranges take less than this of the readings' error.
const UNBROKEN: f64 = 1.0;
/// Passes by hats that cost as much as one of the motion.
const WEIGHED_PER_PASS: usize = 12;

/// How a pass came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    /// Speeds from the readings, then the hats.
    Weigh,
    /// Whole records.
    Whole,
    /// All windows, each linked to the next.
    Chain,
}

/// A pass that made a box smaller, for the certificate.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) method: Method,
    pub(super) cuts: Vec<Cut>,
}

/// A box in which nothing is.
#[derive(Clone, Debug)]
pub(super) struct Empty {
    pub(super) method: Method,
    pub(super) multipliers: Multipliers,
    /// The inequalities that contradict each other; none where an enclosure and a reading have nothing in common.
    pub(super) linear: Option<Linear>,
}

/// How a box was left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Left {
    /// Too wide for the motion; this parameter is the widest.
    Wide(usize),
    /// The slopes' ranges take this share of the readings' error, most of it by this parameter.
    Followed { slack: f64, widest: usize },
}

/// What the search keeps for all boxes.
pub(super) struct Search<'a> {
    pub(super) setup: &'a Setup,
    pub(super) model: Model<'a>,
    /// For each record.
    hats: Vec<Vec<Hat>>,
    /// Passes over the records so far, those by hats counting by the dozen.
    pub(super) passes: usize,
    weighed: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(setup: &'a Setup) -> Self {
        let model = Model {
            records: &setup.records,
            layout: &setup.layout,
            middle_speed: setup.middle_speed,
            known_delay_s: setup.known_delay_s,
            least_linear: setup.least_linear,
            fastest: setup.fastest,
        };
        let hats = setup.records.iter().map(|readings| hats(&readings.time_s, setup.swing_s)).collect();
        Self { setup, model, hats, passes: 0, weighed: 0 }
    }

    fn parameters(&self) -> usize {
        self.setup.layout.parameters()
    }

    /// Whole records, one span each.
    pub(super) fn whole(&self) -> Vec<Span> {
        let windows = self.setup.layout.windows();
        let mut spans: Vec<Span> = Vec::new();
        for (index, window) in windows.iter().enumerate() {
            match spans.last_mut() {
                Some(span) if windows[span.from].record == window.record => span.to = index + 1,
                _ => spans.push(Span { from: index, to: index + 1 }),
            }
        }
        spans
    }

    /// Speeds from the readings; those at the windows' beginnings go into the box. Then the hats.
    pub(super) fn weigh(&mut self, at: &mut [Interval]) -> Result<Vec<Cut>, Empty> {
        let nothing = || Empty { method: Method::Weigh, multipliers: Vec::new(), linear: None };
        self.weighed += 1;
        if self.weighed % WEIGHED_PER_PASS == 0 {
            self.passes += 1;
        }
        let layout = &self.setup.layout;
        let mut linear = self.model.about(at, vec![0.0; at.len()]);
        for (record, hats) in self.hats.iter().enumerate() {
            let pushes = self.model.pushes(record, at, self.setup.fastest);
            let speeds = self.model.speeds(record, at, &pushes, self.setup.fastest).ok_or_else(nothing)?;
            if !self.model.travelled(record, &speeds) {
                return Err(nothing());
            }
            for (index, window) in layout.windows().iter().enumerate().filter(|(_, window)| window.record == record) {
                let place = layout.start(index, 1);
                at[place] = at[place].intersection(speeds.at_samples[window.first]).ok_or_else(nothing)?;
            }
            self.model.weigh(record, hats, at, &speeds, &mut linear);
        }
        self.model.bound(&mut linear);
        let places: Vec<usize> = (0..self.parameters()).collect();
        match linear.contract(at, &places, &places) {
            Pass::Empty(multipliers) => Err(Empty { method: Method::Weigh, multipliers, linear: Some(linear) }),
            Pass::Contracted(cuts) => Ok(cuts),
        }
    }

    /// The inequalities of all windows over a box, each linked to the next, about `centre`. What a window's end says of the next
    /// one's beginning goes into the box. `None` where there is no enclosure.
    pub(super) fn chained(&mut self, at: &mut [Interval], centre: Vec<f64>) -> Result<Option<Linear>, Empty> {
        self.passes += 1;
        let layout = &self.setup.layout;
        let windows = layout.windows();
        let mut linear = self.model.about(at, centre);
        for index in 0..windows.len() {
            let span = Span { from: index, to: index + 1 };
            let Some(motion) = self.model.motion(span, at, &linear.centre) else { return Ok(None) };
            let linked = windows.get(index + 1).is_some_and(|next| next.record == windows[index].record);
            self.model.linearise(span, &motion, linked, &mut linear);
            if linked {
                self.carry(at, index + 1, &motion)?;
                for component in 0..layout.state_size() {
                    let place = layout.start(index + 1, component);
                    linear.deviations[place] = at[place] - Interval::point(linear.centre[place]);
                }
            }
        }
        self.model.bound(&mut linear);
        Ok(Some(linear))
    }

    /// The state at the end of a motion is that at the beginning of the next window.
    fn carry(&self, at: &mut [Interval], next: usize, motion: &[Node]) -> Result<(), Empty> {
        let layout = &self.setup.layout;
        let end = motion.last().map(|node| node.over);
        for (component, value) in end.iter().flatten().enumerate().take(layout.state_size()) {
            let place = layout.start(next, component);
            let met = at[place].intersection(*value);
            at[place] = met.ok_or(Empty { method: Method::Chain, multipliers: Vec::new(), linear: None })?;
        }
        Ok(())
    }

    /// Every window by itself bounds the state at its beginning.
    fn sweep(&mut self, at: &mut [Interval]) -> Result<(), Empty> {
        self.passes += 1;
        let layout = &self.setup.layout;
        for index in 0..layout.windows().len() {
            let span = Span { from: index, to: index + 1 };
            let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
            let Some(motion) = self.model.motion(span, at, &centre) else { return Ok(()) };
            let mut linear = self.model.about(at, centre);
            self.model.linearise(span, &motion, false, &mut linear);
            let (_, places) = layout.columns(index);
            let own: Vec<usize> = (1..layout.state_size()).map(|component| layout.start(index, component)).collect();
            if let Pass::Empty(multipliers) = linear.contract(at, &places, &own) {
                return Err(Empty { method: Method::Chain, multipliers, linear: Some(linear) });
            }
        }
        Ok(())
    }

    /// The largest share of a reading's error that the slopes' ranges take, and the parameter most of it is due to.
    pub(super) fn slack(&self, linear: &Linear) -> (f64, usize) {
        let mut by = vec![0.0; self.parameters()];
        let mut largest = 0.0f64;
        let error = self.setup.records.iter().fold(f64::INFINITY, |least, readings| least.min(readings.error));
        for slopes in &linear.rows.slopes {
            let mut sum = 0.0;
            for (unknown, slope) in slopes {
                let part = slope.radius() * linear.deviations[*unknown].magnitude();
                sum += part;
                if let Some(by) = by.get_mut(*unknown) {
                    *by += part;
                }
            }
            largest = largest.max(sum / error);
        }
        let widest = (0..by.len()).max_by(|a, b| by[*a].total_cmp(&by[*b])).unwrap_or(0);
        (largest, widest)
    }

    /// The force that a parameter's range is worth, over the largest command: the widest parameter.
    pub(super) fn widest(&self, at: &[Interval]) -> (f64, usize) {
        let layout = &self.setup.layout;
        let force = self.setup.records.iter().map(|readings| readings.command.largest()).fold(0.0, f64::max);
        let speed = self.setup.typical_speed;
        if at[0].upper() > ORDERS * at[0].lower() {
            return (f64::INFINITY, 0);
        }
        let acceleration = at[0].upper() * force;
        let share = |place: usize| -> f64 {
            let width = at[place].width();
            let Some(term) = layout.terms().get(place) else {
                let delayed = layout.delay() == Some(place);
                return if delayed { 8.0 * width / self.setup.swing_s } else { width / acceleration };
            };
            let unit = match term {
                Term::Gain => force,
                Term::Linear => speed,
                Term::Quadratic if layout.place_of(Term::Linear).is_some() => 0.5 * speed * speed,
                Term::Quadratic => speed * speed,
                Term::Cubic => speed * speed * speed,
                Term::Stiffness => self.setup.reach,
                Term::LagRate => return width / at[place].upper() / (at[place].lower() * self.setup.swing_s),
                Term::Disturbance => 1.0,
            };
            width * unit / acceleration
        };
        // Instants are not divided.
        let mut places: Vec<usize> = (0..layout.common()).collect();
        places.extend((0..layout.records()).map(|record| layout.disturbance(record)));
        places.into_iter().map(|place| (share(place), place)).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, 0))
    }

    /// Whether following the motion over a box takes many steps.
    pub(super) fn stiff(&self, at: &[Interval]) -> bool {
        let field = self.setup.layout.field(0, at, self.setup.middle_speed);
        let interval_s = self.setup.records.iter().map(|readings| {
            (readings.time_s[readings.time_s.len() - 1] - readings.time_s[0]) / readings.time_s.len() as f64
        });
        field.fastest(Interval::symmetric(self.setup.typical_speed)) * interval_s.fold(0.0, f64::max) > MANY * 0.3
    }

    /// What is left of each parameter, the least.
    pub(super) fn rest(&self, before: &[Interval], after: &[Interval]) -> f64 {
        let shares = before.iter().zip(after).take(self.parameters());
        shares.map(|(b, a)| if b.width() > 0.0 { a.width() / b.width() } else { 1.0 }).fold(1.0, f64::min)
    }

    /// The inequalities of whole records over a box about `centre`; `None` where there is no enclosure.
    pub(super) fn unbroken(&mut self, at: &[Interval], centre: Vec<f64>) -> Option<Linear> {
        self.passes += 1;
        let mut linear = self.model.about(at, centre);
        for span in self.whole() {
            let motion = self.model.motion(span, at, &linear.centre)?;
            self.model.linearise(span, &motion, false, &mut linear);
        }
        self.model.bound(&mut linear);
        Some(linear)
    }

    /// Parameters, and the state at every record's beginning.
    pub(super) fn of_whole(&self) -> Vec<usize> {
        let layout = &self.setup.layout;
        let starts = self.whole().into_iter();
        let starts = starts.flat_map(|span| (0..layout.state_size()).map(move |k| layout.start(span.from, k)));
        (0..self.parameters()).chain(starts).collect()
    }

    /// Contracts a box over which the motion is followed, by the motion alone: over whole records, where nothing but their
    /// beginnings is unknown beside the parameters, or window by window if the slopes' ranges take less so.
    pub(super) fn contract_fine(&mut self, at: &mut [Interval], made: &mut Vec<Made>) -> Result<Left, Empty> {
        let (whole, parameters) = (self.of_whole(), (0..self.parameters()).collect::<Vec<_>>());
        let places: Vec<usize> = (0..at.len()).collect();
        let (mut left, mut broken) = (Left::Wide(0), false);
        for pass in 0..MOST_PASSES {
            let before = at.to_vec();
            let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
            let unbroken = if broken { None } else { self.unbroken(at, centre.clone()) };
            let found =
                unbroken.map(|linear| (self.slack(&linear), linear)).filter(|((slack, _), _)| *slack <= UNBROKEN);
            broken = found.is_none();
            let ((slack, widest), linear) = match found {
                Some(found) => found,
                None => match self.chained(at, centre)? {
                    Some(linear) => (self.slack(&linear), linear),
                    None => return Ok(left),
                },
            };
            left = Left::Followed { slack, widest };
            let (method, of, unknowns) =
                if broken { (Method::Chain, &places, &parameters) } else { (Method::Whole, &whole, &whole) };
            match linear.contract(at, of, unknowns) {
                Pass::Empty(multipliers) => return Err(Empty { method, multipliers, linear: Some(linear) }),
                Pass::Contracted(cuts) => made.push(Made { method, cuts }),
            }
            if pass + 1 >= FINE_PASSES || self.rest(&before, at) > HELPED {
                break;
            }
        }
        Ok(left)
    }

    /// Contracts a box until nothing helps.
    pub(super) fn contract(&mut self, at: &mut [Interval], made: &mut Vec<Made>) -> Result<Left, Empty> {
        let mut weighing = true;
        let mut sweeping = true;
        let mut left = Left::Wide(0);
        for _ in 0..MOST_PASSES {
            let before = at.to_vec();
            if weighing {
                let cuts = self.weigh(at)?;
                made.push(Made { method: Method::Weigh, cuts });
                weighing = self.rest(&before, at) < HELPED;
                if weighing {
                    continue;
                }
            }
            let (share, widest) = self.widest(at);
            if share > if self.stiff(at) { STIFF } else { WIDE } {
                return Ok(Left::Wide(widest));
            }
            if sweeping {
                self.sweep(at)?;
                sweeping = false;
            }
            let before = at.to_vec();
            let centre = at.iter().map(|side| side.midpoint()).collect();
            let Some(linear) = self.chained(at, centre)? else { return Ok(Left::Wide(widest)) };
            let (slack, widest) = self.slack(&linear);
            left = Left::Followed { slack, widest };
            let unknowns: Vec<usize> = (0..self.parameters()).collect();
            let places: Vec<usize> = (0..at.len()).collect();
            match linear.contract(at, &places, &unknowns) {
                Pass::Empty(multipliers) => {
                    return Err(Empty { method: Method::Chain, multipliers, linear: Some(linear) });
                }
                Pass::Contracted(cuts) => made.push(Made { method: Method::Chain, cuts }),
            }
            if self.rest(&before, at) > HELPED {
                return Ok(left);
            }
        }
        Ok(left)
    }
}
