//! The experiment file: TOML to a checked [`Plan`].
//!
//! A file is parsed to tables that know where each word stands ([`Experiment::read`]), held against
//! one grammar (which is the JSON Schema too, [`schema`]), and resolved to a plan. A file of curves
//! ([`CurvesFile`]) goes the same way.

mod curves;
mod experiment;
mod fault;
mod file;
mod gates;
mod grammar;
mod nearest;
mod node;
mod plan;
mod plots;
mod resolve;
mod resolved;

pub use curves::{
    CurveBudget, CurvePlan, CurvePlot, CurvePlotKind, CurveRange, CurveSetting, CurveSource,
    CurveSpec, CurveTable, CurveTableKind, CurvesFile, PanelOf, RateKind, RateUnit,
};
pub use experiment::Experiment;
pub use fault::{ExperimentError, Fault};
pub use gates::{Aggregate, Allowance, GateRule, Quantity};
pub use grammar::{curves_schema, resolution, schema};
pub use nearest::nearest;
pub use plan::{Eye, EyeView, Gaze, MetricChoice, Nonfinite, Plan, Scene, Settings};
pub use plots::{Plot, PlotKind};
pub use resolved::{Resolved, ResolvedEye, ResolvedScene, other_parameter};
