//! The unknowns, and the place of each in a box: terms and delay, common to all records; each record's disturbance and instants of
//! switchings; the state at the beginning of each shooting interval.

use super::record::Readings;
use super::sensitivities::Variable;
use super::vector_field::{FieldTerm, StateBox, TERMS, VectorField};
use crate::numeric::Interval;

/// Samples `first` to `last` of a record, the state unknown at the first. The next shooting interval begins with the last (Bock 1983).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shooting {
    pub(super) record: usize,
    pub(super) first: usize,
    pub(super) last: usize,
}

/// The unknowns of a problem.
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    pub(super) terms: Vec<FieldTerm>,
    has_delay: bool,
    /// Switchings at unknown instants, by record.
    instants: Vec<usize>,
    pub(super) shooting: Vec<Shooting>,
}

impl Unknowns {
    pub(super) fn new(terms: Vec<FieldTerm>, has_delay: bool, instants: Vec<usize>, shooting: Vec<Shooting>) -> Self {
        Self { terms, has_delay, instants, shooting }
    }

    /// The same with other shooting intervals.
    pub(super) fn with_shooting(&self, shooting: Vec<Shooting>) -> Self {
        Self { shooting, ..self.clone() }
    }

    pub(super) fn records(&self) -> usize {
        self.instants.len()
    }
    /// Number of terms and delay.
    pub(super) fn common(&self) -> usize {
        self.terms.len() + usize::from(self.has_delay)
    }
    pub(super) fn place_of(&self, term: FieldTerm) -> Option<usize> {
        self.terms.iter().position(|own| *own == term)
    }
    pub(super) fn delay(&self) -> Option<usize> {
        self.has_delay.then_some(self.terms.len())
    }
    pub(super) fn state_size(&self) -> usize {
        if self.terms.contains(&FieldTerm::LagRate) { 3 } else { 2 }
    }
    pub(super) fn disturbance(&self, record: usize) -> usize {
        self.common() + record + self.instants[..record].iter().sum::<usize>()
    }
    pub(super) fn instant(&self, record: usize, edge: usize) -> usize {
        self.disturbance(record) + 1 + edge
    }
    pub(super) fn instants(&self, record: usize) -> usize {
        self.instants[record]
    }
    /// Number of unknowns that are not states.
    pub(super) fn parameters(&self) -> usize {
        self.common() + self.records() + self.instants.iter().sum::<usize>()
    }
    /// A component of the state at the beginning of a shooting interval.
    pub(super) fn start(&self, interval: usize, component: usize) -> usize {
        self.parameters() + interval * self.state_size() + component
    }

    /// The components of that state that are refined by the intervals beside: no position, which the reading tells.
    pub(super) fn refined(&self, interval: usize) -> Vec<usize> {
        (1..self.state_size()).map(|component| self.start(interval, component)).collect()
    }

    /// The first shooting interval of a record.
    pub(super) fn first(&self, record: usize) -> usize {
        self.shooting.iter().position(|own| own.record == record).unwrap_or(0)
    }

    /// The number of shooting intervals of a record.
    pub(super) fn intervals(&self, record: usize) -> usize {
        self.shooting.iter().filter(|own| own.record == record).count()
    }

    /// Parameters, and the state at the beginning of each record.
    pub(super) fn of_single_shooting(&self) -> Vec<usize> {
        let state = |record| (0..self.state_size()).map(move |component| self.start(self.first(record), component));
        (0..self.parameters()).chain((0..self.records()).flat_map(state)).collect()
    }

    /// The states at the beginnings, from the reading there and the largest speed alone.
    pub(super) fn states(&self, records: &[Readings], fastest: f64) -> Vec<Interval> {
        let mut states = Vec::with_capacity(self.shooting.len() * self.state_size());
        for interval in &self.shooting {
            let readings = &records[interval.record];
            // A stamp is off by at most J, the output by at most V J.
            let stray = (Interval::point(readings.jitter_s) * Interval::point(fastest)).upper();
            let error = (Interval::point(readings.error) + Interval::point(stray)).upper();
            states.push(Interval::point(readings.value[interval.first]) + Interval::symmetric(error));
            states.push(Interval::symmetric(fastest));
            if self.state_size() == 3 {
                // A first-order lag keeps the force between the commands.
                states.push(Interval::symmetric(readings.command.largest()));
            }
        }
        states
    }

    /// Of one shooting interval: the variables of its sensitivities, and the place of each in a box.
    pub(super) fn variables(&self, interval: usize) -> (Vec<Variable>, Vec<usize>) {
        let record = self.shooting[interval].record;
        let terms = self.terms.iter().enumerate().map(|(place, term)| (Variable::FieldTerm(*term), place));
        let delay = self.delay().map(|place| (Variable::Delay, place));
        let disturbance = (Variable::FieldTerm(FieldTerm::Disturbance), self.disturbance(record));
        let instants = (0..self.instants[record]).map(|edge| (Variable::Switching(edge), self.instant(record, edge)));
        let states = (0..self.state_size()).map(|k| (Variable::Initial(k), self.start(interval, k)));
        terms.chain(delay).chain([disturbance]).chain(instants).chain(states).unzip()
    }

    /// The equation of one record over a box.
    pub(super) fn field(&self, record: usize, at: &[Interval], middle_speed: f64) -> VectorField {
        let (mut terms, mut active) = ([Interval::ZERO; TERMS], [false; TERMS]);
        let disturbance = (self.disturbance(record), &FieldTerm::Disturbance);
        for (place, term) in self.terms.iter().enumerate().chain([disturbance]) {
            (terms[*term as usize], active[*term as usize]) = (at[place], true);
        }
        VectorField { terms, active, middle_speed }
    }

    /// The state at the beginning of a shooting interval over a box.
    pub(super) fn state(&self, interval: usize, at: &[Interval]) -> StateBox {
        let component = |k| if k < self.state_size() { at[self.start(interval, k)] } else { Interval::ZERO };
        core::array::from_fn(component)
    }
}
