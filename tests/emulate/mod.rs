//! Experiments with methods that are emulated from the reference.

mod eyes;
mod interrupted;
mod mistakes;
mod scores;
