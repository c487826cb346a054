//! The experiment file: TOML to a checked [`Plan`].
//!
//! A file is parsed to tables that know where each word stands ([`Experiment::read`]), held against
//! one grammar (which is the JSON Schema too, [`schema`]), and resolved to a plan.

mod experiment;
mod fault;
mod grammar;
mod nearest;
mod node;
mod plan;
mod plots;
mod resolve;
mod resolved;

pub use experiment::Experiment;
pub use fault::{ExperimentError, Fault};
pub use grammar::schema;
pub use nearest::nearest;
pub use plan::{Eye, EyeView, Gaze, MetricChoice, Nonfinite, Plan, Scene, Settings};
pub use plots::{Plot, PlotKind};
pub use resolved::{Resolved, ResolvedEye, ResolvedScene};
