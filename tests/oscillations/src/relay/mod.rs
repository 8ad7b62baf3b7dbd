//! Linear plants with dead time under a two-level relay with hysteresis.

pub mod answer;
pub mod attraction;
pub mod control_loop;

pub mod draw;
pub mod judge;
pub mod motion;
pub mod orbit;
pub mod reached;
pub mod report;
pub mod search;
pub mod settle;
pub mod simulation;
pub mod starts;
pub mod switching_conditions;
