//! Contraction of one box until nothing helps.

use super::bounds::Contradicting;
use super::contract::{Hat, Linear, Model, Pass};
use super::effort::Effort;
use super::field::Term;
use super::lp::Multipliers;
use super::rows::{Parted, Starts};
use super::setup::Setup;
use super::slanted::{Slant, Slanted};
use super::weak::hats;
use crate::numeric::Interval;

#[cfg(test)]
mod tests;

/// A pass that leaves more than this of every parameter's width did not help.
const HELPED: f64 = 0.9;
/// Nor is another worth it over a box that may be divided where one leaves more than this.
const WORTH: f64 = 0.75;
/// A box is too wide to follow the motion over while a parameter's range is worth more than this share of the command.
const WIDE: f64 = 0.25;
/// The gain is divided first until its ends are within this factor.
const ORDERS: f64 = 4.0;
/// Passes over one box at most.
const MOST_PASSES: usize = 30;

/// Passes over one slice at most.
const FINE_PASSES: usize = 6;
/// Records are followed as a whole where less than this of the readings' error is in doubt.
pub(super) const UNBROKEN: f64 = 1.0;
/// Passes by hats that cost as much as one of the motion.
const WEIGHED_PER_PASS: usize = 12;

/// Contractions by what is known of a motion that cost as much as one.
const PARTS_PER_PASS: usize = 6;

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
    /// So much of the readings' error is in doubt, by the slopes' ranges or by how they bend; most of it by this parameter.
    Followed { slack: f64, widest: usize },
}

/// What the search keeps for all boxes.
pub(super) struct Search<'a> {
    pub(super) setup: &'a Setup,
    pub(super) model: Model<'a>,
    /// For each record.
    hats: Vec<Vec<Hat>>,
    /// Passes over the records so far, those by hats counting by the dozen, and those that take longer as so many more.
    pub(super) passes: usize,
    before: usize,
    /// Samples of the records of which these are all, or a part.
    whole: usize,
    weighed: usize,
    parts: usize,
    /// Readings between two switchings that no motion meets, where such were found.
    pub(super) clash: Vec<Contradicting>,
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
            per_s: Some(1.0 / setup.swing_s),
            effort: Effort::default(),
            reach: usize::MAX,
            heard: None,
        };
        let records = setup.records.iter().zip(&setup.onset);
        let hats = records.map(|(readings, onset)| hats(&readings.time_s, *onset, setup.swing_s)).collect();
        Self {
            setup,
            model,
            hats,
            passes: 0,
            before: 0,
            whole: setup.samples(),
            weighed: 0,
            parts: 0,
            clash: Vec::new(),
        }
    }

    /// The same where each pass over these records is its part of one over `whole`.
    pub(super) fn part_of(self, whole: &Setup) -> Self {
        Self { whole: whole.samples(), ..self }
    }

    /// The same where so many passes were made before.
    pub(super) fn after(self, passes: usize) -> Self {
        Self { passes, before: passes, ..self }
    }

    /// One more pass.
    pub(super) fn count_pass(&mut self) {
        let parts = self.whole as f64 / self.setup.samples() as f64;
        let taken = (parts * self.model.effort.passes(self.whole)) as usize;
        self.passes = (self.passes + 1).max(self.before + taken);
    }

    /// A contraction without a motion.
    pub(super) fn count_part(&mut self) {
        self.parts += 1;
        if self.parts.is_multiple_of(PARTS_PER_PASS) {
            self.count_pass();
        }
    }

    fn parameters(&self) -> usize {
        self.setup.layout.parameters()
    }

    /// The inequalities by hats; speeds from the readings at the windows' beginnings go into the box. `None` where there is no motion.
    pub(super) fn weighed(&self, at: &mut [Interval]) -> Option<Linear> {
        self.model.weighed(&self.hats, at)
    }

    /// Speeds from the readings; those at the windows' beginnings go into the box. Then the hats.
    pub(super) fn weigh(&mut self, at: &mut [Interval]) -> Result<(), Empty> {
        self.weighed += 1;
        self.model.effort.weighed(self.setup.samples());
        if self.weighed.is_multiple_of(WEIGHED_PER_PASS) {
            self.count_pass();
        }
        let weighed = self.weighed(at);
        if weighed.is_none() && self.clash.is_empty() {
            self.clash = self.model.clashes(at);
        }
        let mut linear = weighed.ok_or(Empty { method: Method::Weigh, multipliers: Vec::new(), linear: None })?;
        self.model.bound(&mut linear);
        let places: Vec<usize> = (0..self.parameters()).collect();
        match linear.contract(at, &places, &places) {
            Pass::Empty(multipliers) => Err(Empty { method: Method::Weigh, multipliers, linear: Some(linear) }),
            Pass::Contracted => Ok(()),
        }
    }

    /// The inequalities of all windows over a box, each linked to the next, about `centre`. What a window's end says of the next
    /// one's beginning goes into the box. `None` where there is no enclosure.
    pub(super) fn chained(
        &mut self,
        at: &mut [Interval],
        centre: Vec<f64>,
        starts: Starts,
    ) -> Result<Option<Linear>, Empty> {
        self.count_pass();
        let chained = self.model.chained(at, centre, starts);
        chained.map_err(|Parted| Empty { method: Method::Chain, multipliers: Vec::new(), linear: None })
    }

    /// Velocities, and forces behind a lag, at the windows' beginnings, each by what the windows beside it tell: they go into the box.
    pub(super) fn settle(&self, linear: &mut Linear, at: &mut [Interval]) -> Result<(), Empty> {
        let layout = &self.setup.layout;
        for window in 0..layout.windows().len() {
            let beside = linear.beside(window);
            let own: Vec<usize> = (1..layout.state_size()).map(|component| layout.start(window, component)).collect();
            if let Pass::Empty(multipliers) = beside.contract(at, &beside.places(), &own) {
                return Err(Empty { method: Method::Chain, multipliers, linear: Some(beside) });
            }
            for place in own {
                linear.deviations[place] = at[place] - Interval::point(linear.centre[place]);
            }
        }
        Ok(())
    }

    /// The largest share of a reading's error that the slopes' ranges take, and the parameter most of it is due to.
    pub(super) fn slack(&self, linear: &Linear) -> (f64, usize) {
        self.slack_by(linear, self.parameters())
    }

    /// The same by the first of the unknowns.
    pub(super) fn slack_by(&self, linear: &Linear, unknowns: usize) -> (f64, usize) {
        let mut by = vec![0.0; unknowns];
        let mut largest = 0.0f64;
        let error = self.setup.records.iter().fold(f64::INFINITY, |least, readings| least.min(readings.error));
        for row in 0..linear.rows.slopes.len() {
            let mut sum = 0.0;
            for (unknown, part) in linear.in_doubt(row) {
                sum += part;
                if let Some(by) = by.get_mut(unknown) {
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

    /// Whether a box is too wide to follow the motion over, and its widest parameter.
    pub(super) fn too_wide(&self, at: &[Interval]) -> (bool, usize) {
        let (share, widest) = self.widest(at);
        (share > WIDE, widest)
    }

    /// What is left of each parameter, the least.
    pub(super) fn rest(&self, before: &[Interval], after: &[Interval]) -> f64 {
        let shares = before.iter().zip(after).take(self.parameters());
        shares.map(|(b, a)| if b.width() > 0.0 { a.width() / b.width() } else { 1.0 }).fold(1.0, f64::min)
    }

    /// Contracts a box over which the motion is followed, by the motion alone: over whole records, where nothing but their
    /// beginnings is unknown beside the parameters, or window by window where that leaves too much in doubt.
    pub(super) fn contract_fine(&mut self, at: &mut [Interval], own: &mut Option<Slanted>) -> Result<Left, Empty> {
        let parameters: Vec<usize> = (0..self.parameters()).collect();
        let places: Vec<usize> = (0..at.len()).collect();
        let (mut left, mut broken) = (Left::Wide(0), false);
        for pass in 0..MOST_PASSES {
            let before = at.to_vec();
            let centre: Vec<f64> = at.iter().map(|side| side.midpoint()).collect();
            let known = |own: &Option<Slanted>| own.as_ref().is_some_and(|own| own.surface.is_some());
            let was_known = known(own);
            let slanted = if broken { Slant::NoEnclosure } else { self.slant(at, own, UNBROKEN)? };
            // What was known of a larger box hides what a motion over this one tells; one before it is divided is less than two after.
            let stale = was_known && !known(own);
            if let Slant::Contracted(followed) = slanted {
                left = followed;
            } else {
                broken = true;
                let Some(linear) = self.chained(at, centre, Starts::Given)? else { return Ok(left) };
                let (slack, widest) = self.slack(&linear);
                left = Left::Followed { slack, widest };
                if let Pass::Empty(multipliers) = linear.contract(at, &places, &parameters) {
                    return Err(Empty { method: Method::Chain, multipliers, linear: Some(linear) });
                }
            }
            if pass + 1 >= FINE_PASSES || (self.rest(&before, at) > HELPED && !stale) {
                break;
            }
        }
        Ok(left)
    }

    /// Contracts a box until nothing helps; not `weighing`, by the motion alone.
    pub(super) fn contract(&mut self, at: &mut [Interval], mut weighing: bool) -> Result<Left, Empty> {
        let mut left = Left::Wide(0);
        for _ in 0..MOST_PASSES {
            let before = at.to_vec();
            if weighing {
                self.weigh(at)?;
                weighing = self.rest(&before, at) < WORTH;
                if weighing {
                    continue;
                }
            }
            let (wide, widest) = self.too_wide(at);
            if wide {
                return Ok(Left::Wide(widest));
            }
            let before = at.to_vec();
            let centre = at.iter().map(|side| side.midpoint()).collect();
            let Some(mut linear) = self.chained(at, centre, Starts::Drawn)? else { return Ok(Left::Wide(widest)) };
            let (slack, widest) = self.slack(&linear);
            left = Left::Followed { slack, widest };
            self.settle(&mut linear, at)?;
            let places: Vec<usize> = (0..at.len()).collect();
            let unknowns: Vec<usize> = (0..self.parameters()).collect();
            match linear.contract(at, &places, &unknowns) {
                Pass::Empty(multipliers) => {
                    return Err(Empty { method: Method::Chain, multipliers, linear: Some(linear) });
                }
                Pass::Contracted => {}
            }
            if self.rest(&before, at) > WORTH {
                return Ok(left);
            }
        }
        Ok(left)
    }
}
