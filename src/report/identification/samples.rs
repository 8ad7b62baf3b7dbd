//! The records with what the answer predicts of them, for programs that draw.

use core::fmt::Write;

use crate::identify::{Identification, PredictedMotion, Reported};

/// A line a sample: number of the record from 1, time in s, output and command as the methods see them, the reported model's output, and the
/// residual, output less model. The last two are empty where nothing is predicted and at outliers.
pub(crate) fn samples(found: &Identification) -> String {
    let mut text = String::from("record,time_s,output,input,model,residual\n");
    for (index, source) in found.sources().iter().enumerate() {
        let record = &source.log.record;
        let motion = found.reported().and_then(|reported: &Reported| reported.predicted_motion(record));
        for (sample, ((time_s, output), input)) in
            record.time_s().iter().zip(record.output()).zip(record.input()).enumerate()
        {
            let of = |motion: &PredictedMotion| *motion.output.get(sample.checked_sub(motion.first_sample)?)?;
            let model = motion.as_ref().and_then(of);
            let model = model.map_or_else(|| ",".to_owned(), |model| format!("{model},{}", output - model));
            // Writing to a text does not fail.
            let _ = writeln!(text, "{},{time_s},{output},{input},{model}", index + 1);
        }
    }
    text
}
