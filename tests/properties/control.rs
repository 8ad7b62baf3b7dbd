//! Controllers: design, margins, what runs, and the critical point.

mod controller;
mod design;
mod high_frequency;
mod margins;
mod oracle;
mod robust;
mod ultimate;
mod vehicle;
pub(crate) mod worst_case;
