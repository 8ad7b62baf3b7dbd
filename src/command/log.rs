//! How a log is read: the flags of every subcommand that takes one.

use std::num::NonZeroUsize;

use clap::Args;

use super::number::{count, finite, time_unit};
use crate::experiment::{Columns, TimeUnit};

#[derive(Debug, Args)]
pub(super) struct LogArguments {
    /// Unit of the times [default: that which the column's name ends in, as _ms does, else s]
    #[arg(long, value_name = "UNIT", value_parser = time_unit)]
    time_unit: Option<TimeUnit>,
    /// Uses samples from this time on, in s on the log's clock
    #[arg(long, value_name = "T", value_parser = finite, allow_negative_numbers = true)]
    from: Option<f64>,
    /// Uses samples up to this time, in s on the log's clock
    #[arg(long, value_name = "T", value_parser = finite, allow_negative_numbers = true)]
    to: Option<f64>,
    /// Uses this part of a log whose clock starts again, counted from 1
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    part: Option<NonZeroUsize>,
    /// The samples were taken at even intervals, whatever their stamps: those are of arrival
    #[arg(long)]
    even_stamps: bool,
    /// Leaves out rows without three numbers, or with a time that does not come after the one before: at most a fifth of all
    #[arg(long)]
    skip_bad_rows: bool,
    /// For topics logged in turn: where its cell is blank a command holds, from the output before it on; rows without output are passed over
    #[arg(long)]
    hold_command: bool,
}

impl LogArguments {
    /// These columns, read so.
    pub(super) fn of(&self, columns: Columns) -> Columns {
        Columns {
            time_unit: self.time_unit,
            from_s: self.from,
            to_s: self.to,
            part: self.part,
            even_stamps: self.even_stamps,
            skip_bad_rows: self.skip_bad_rows,
            hold_command: self.hold_command,
            ..columns
        }
    }
}
