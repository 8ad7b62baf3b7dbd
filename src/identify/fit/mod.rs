//! Models fitted to whole records: by prediction errors, by multiple shooting, and to the features of several experiments.

internal! {
    mod joint;
    mod prediction_error;
    mod select;
    mod shooting;
}
mod start;

internal! { use shooting::{Between, Fit, FittedRecord, RecordFit}; }
