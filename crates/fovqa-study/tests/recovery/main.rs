//! Simulated observers whose true values are known.
//!
//! `make recovery` repeats each simulated study 300 times, and counts how often the truth lies within
//! the interval of 95 %. The example data in `configs/studies/data` have the same observers.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "the table of `make recovery`")]

mod analyses;
mod anova;
mod coverage;
mod examples;
mod metrics;
mod observers;
mod pairs;
mod psychometric;
mod ratings;
mod staircase;
