//! Switchings in gaps of the log within a search: their instants depend on the model, and the model on them.

use std::sync::OnceLock;

use rayon::prelude::*;

use super::super::confounded_lags;
use super::super::instants;
use super::super::model::VehicleModel;
use super::super::observations::Observations;
use super::super::scoring::{Fitted, climb};
use super::{StructureSearch, reading_index};

impl StructureSearch<'_> {
    /// Places the switchings in gaps where the likeliest model of each reading makes the record likeliest; whether any of them moved.
    ///
    /// Total lag and instants of switching are confounded: models with other lags get instants of their own before the comparison.
    pub(super) fn read_gaps(&mut self, tried: &[Fitted]) -> bool {
        let told = |model: &&VehicleModel| {
            let told = instants::told(self.observations(model), model)?;
            let fitted = climb(&told, (*model).clone())?;
            let told = instants::told(&told, &fitted.model)?;
            let Fitted { model, log_likelihood, .. } = climb(&told, fitted.model)?;
            Some((2.0 * log_likelihood - told.price(model.freedom()), model, told))
        };
        let mut ends: Vec<(f64, VehicleModel, Observations)> =
            self.confounded_models(tried).par_iter().filter_map(told).collect();
        ends.sort_by(|a, b| b.0.total_cmp(&a.0));
        let readings = [const { OnceLock::new() }; 4];
        let mut moved = false;
        for (_, model, told) in ends {
            let reading = &readings[reading_index(&model)];
            if reading.get().is_none() {
                moved |= instants::differ(&told, self.observations(&model));
                let _ = reading.set(told);
            }
        }
        if moved {
            self.readings = readings;
        }
        moved
    }

    /// The best model of each reading, and those that differ from the best of all in their confounded lags alone.
    fn confounded_models<'b>(&self, tried: &'b [Fitted]) -> Vec<&'b VehicleModel> {
        let best = &tried[self.best(tried)].model;
        let others = confounded_lags::chains(best, self.known.delay_s, self.observations(best));
        let mut order: Vec<&Fitted> = tried.iter().collect();
        order.sort_by(|a, b| self.value(b).total_cmp(&self.value(a)));
        let mut models: Vec<&VehicleModel> = Vec::new();
        for Fitted { model, .. } in order {
            let first = models.iter().all(|other| reading_index(other) != reading_index(model));
            let other = others.iter().any(|other| other.is_alike(model));
            if (first || other) && !models.iter().any(|other| other.is_alike(model)) {
                models.push(model);
            }
        }
        models
    }

    /// The models fitted to the readings as they are now.
    pub(super) fn again(&self, models: &[Fitted]) -> Option<Vec<Fitted>> {
        let again: Vec<Fitted> = models.par_iter().filter_map(|fitted| self.climb(fitted.model.clone())).collect();
        (!again.is_empty()).then_some(again)
    }
}
