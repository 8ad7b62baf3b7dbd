//! Laws of the vehicle: thrusters, allocation and compensation, motion.

mod allocation;
mod bodies;
mod dynamics;
mod kinematics;
mod reduction;
mod simulation;
mod thruster;
mod thruster_map;
mod trial;

use proptest::test_runner::{Config, FileFailurePersistence};

/// Failing cases are kept beside the tests.
pub(crate) fn config(cases: u32) -> Config {
    Config {
        cases,
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..Config::default()
    }
}
