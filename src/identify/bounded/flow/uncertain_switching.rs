//! Switchings at uncertain instants.
//!
//! Moving a switching later by z subtracts its jump during z: an impulse at the switching of the size `gain (u_before - u_after) z`, which
//! the motion carries on. While the instant is uncertain the impulse may have happened at any time since the earliest instant.

use super::super::sensitivities::Block;
use super::super::vector_field::{FORCE, State, Term, VELOCITY};
use super::Flow;
use crate::numeric::{Balls, Interval};

/// A switching that may have happened.
pub(super) struct Uncertain {
    pub(super) edge: usize,
    /// The states to which a unit impulse at the switching may have led by now.
    pub(super) impulse: State,
}

impl Flow<'_> {
    /// Columns with the contributions that uncertain switchings may have made.
    pub(super) fn with_uncertain(&self, block: &Block, mut columns: [Balls; 3]) -> [Balls; 3] {
        for Uncertain { edge, impulse } in &self.uncertain {
            if let Some(shifts) = block.shifts(*edge) {
                for (values, impulse) in columns.iter_mut().zip(impulse) {
                    *values = *values + shifts * Balls::splat(self.scaled(*edge, *impulse).hull(Interval::ZERO));
                }
            }
        }
        columns
    }

    /// A unit impulse times the size that a later switching gives it.
    fn scaled(&self, edge: usize, impulse: Interval) -> Interval {
        let field = &self.input.fields.over;
        let factor = field.term(if self.lagged() { Term::LagRate } else { Term::Gain });
        factor * self.input.command.drop_at(edge) * impulse
    }

    /// A unit impulse at this instant.
    pub(super) fn unit_impulse(&self) -> State {
        let mut impulse = [Interval::ZERO; 3];
        impulse[if self.lagged() { FORCE } else { VELOCITY }] = Interval::ONE;
        impulse
    }

    /// At the latest instant of a switching its contribution is certain.
    pub(super) fn settle(&mut self, edge: usize) {
        let Some(place) = self.uncertain.iter().position(|own| own.edge == edge) else { return };
        let Uncertain { impulse, .. } = self.uncertain.swap_remove(place);
        let added = impulse.map(|impulse| Balls::splat(self.scaled(edge, impulse)));
        for (block, columns) in self.blocks.iter().zip(&mut self.columns) {
            if let Some(shifts) = block.shifts(edge) {
                for (values, added) in columns.iter_mut().zip(added) {
                    *values = *values + shifts * added;
                }
            }
        }
    }
}
