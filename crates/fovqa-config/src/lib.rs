//! TOML files to plans: an experiment file ([`read_experiment`]) and a file of curves ([`read_curves`]).
//!
//! A file is parsed to tables that know where each word stands, held against one grammar (which is the JSON
//! Schema too, [`schema`]), and resolved to a plan.

mod curves;
mod experiment;
mod fault;
mod file;
mod grammar;
mod nearest;
mod node;
mod resolve;

pub use curves::{is_curves, parse_curves, read_curves};
pub use experiment::{parse_experiment, read_experiment};
pub use fault::{ExperimentError, Fault};
pub use grammar::{curves_schema, resolution, schema};
pub use nearest::nearest;
