//! Turns TOML files into plans: an experiment file ([`read_experiment`]), a curves file
//! ([`read_curves`]) or a study file ([`read_study`]).
//!
//! A file is parsed into tables that know the position of each word. It is checked against one
//! grammar, from which the JSON Schema ([`schema`]) is made as well, and then resolved to a plan.

mod curves;
mod experiment;
mod fault;
mod file;
mod file_kind;
mod grammar;
mod nearest;
mod node;
mod resolve;
mod study;

pub use curves::{parse_curves, read_curves};
pub use experiment::{parse_experiment, read_experiment};
pub use fault::{ExperimentError, Fault};
pub use file_kind::{FileKind, file_kind};
pub use grammar::{curves_schema, resolution, schema, study_schema};
pub use nearest::nearest;
pub use study::{parse_study, read_study};
