//! The records with what the answer predicts of them, for programs that draw.

use core::fmt::Write;

use crate::identify::{Identification, Reported};

/// A line a sample: the record counted from 1, time in s, output and command as the methods see them, the reported model's output and the
/// reading less that; the last two are empty where nothing is predicted.
pub(crate) fn samples(found: &Identification) -> String {
    let mut text = String::from("record,time_s,output,input,model,residual\n");
    for (index, source) in found.sources().iter().enumerate() {
        let record = &source.log.record;
        let motion = found.reported().and_then(|reported: &Reported| reported.predicted_motion(record));
        for (sample, ((time_s, output), input)) in
            record.time_s().iter().zip(record.output()).zip(record.input()).enumerate()
        {
            let of = motion.as_ref().and_then(|motion| motion.output.get(sample.checked_sub(motion.first_sample)?));
            let model = of.map_or_else(String::new, |model| format!("{model},{}", output - model));
            let model = if model.is_empty() { "," } else { &model };
            // Writing to a text does not fail.
            let _ = writeln!(text, "{},{time_s},{output},{input},{model}", index + 1);
        }
    }
    text
}
