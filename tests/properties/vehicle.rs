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
