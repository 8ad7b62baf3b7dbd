//! Fisher's information of a record on the parameters that records share, with the record's own parameters projected out.

use nalgebra::{DMatrix, SMatrix};

use super::filter;
use super::model::{NoiseParameter, Parameter, VehicleModel};
use super::observations::Observations;
use crate::experiment::Record;
use crate::identify::signal::{Clock, SwitchingInstant};
use crate::plant::{DragAxis, State};

/// Inertia, linear drag, quadratic drag, delay.
pub(crate) const SHARED: [Parameter; 4] =
    [Parameter::Alpha, Parameter::LinearDrag, Parameter::QuadraticDrag, Parameter::DelayS];
/// Every record's own.
const OWN: [Parameter; 3] = [Parameter::Disturbance, Parameter::Position, Parameter::Velocity];

/// Readings omitted at the beginning beyond the delay, in half-periods.
const UNSEEN: f64 = 0.05;

/// Information about [`SHARED`], in their order.
pub(crate) type Information = SMatrix<f64, 4, 4>;

/// The information of a record that the axis made, read with an error of this variance, and the part of its readings that count
/// where cycles repeat reading for reading. `None` where the motion diverges, or the information on the record's own parameters is singular.
pub(crate) fn of_record(record: &Record, axis: &DragAxis<f64>, variance: f64) -> Option<(Information, f64)> {
    let mut observations = Observations::new(record, Clock::Stamps, SwitchingInstant::AtSamples);
    observations.skip(axis.delay_s() + UNSEEN * observations.half_period_s);
    let State { position, velocity } = observations.start_state();
    let mut model = VehicleModel::plain(SwitchingInstant::AtSamples);
    for (parameter, value) in [
        (Parameter::Alpha, axis.alpha()),
        (Parameter::LinearDrag, axis.linear_drag()),
        (Parameter::QuadraticDrag, axis.quadratic_drag()),
        (Parameter::DelayS, axis.delay_s()),
        (Parameter::Disturbance, axis.disturbance()),
        (Parameter::Position, position),
        (Parameter::Velocity, velocity),
    ] {
        model.set(parameter, value, true);
    }
    model.set_noise(NoiseParameter::White, variance, false);
    let all = filter::run(&observations, &model, filter::Evaluation::Score)?.score().structure_information;
    let part = |rows: &[Parameter], columns: &[Parameter]| {
        DMatrix::from_fn(rows.len(), columns.len(), |row, column| all[rows[row] as usize][columns[column] as usize])
    };
    let own = part(&OWN, &OWN).cholesky()?;
    let across = part(&OWN, &SHARED);
    let left = part(&SHARED, &SHARED) - across.transpose() * own.solve(&across);
    #[allow(clippy::cast_precision_loss, reason = "a count of samples")]
    let readings = (observations.time_s.len() - observations.first) as f64;
    Some((Information::from_fn(|row, column| left[(row, column)]), observations.count() / readings))
}
