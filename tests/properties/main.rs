//! Properties of the library, each against an oracle that is not the code under test.

mod interval;
mod oracle;
mod tolerance;
