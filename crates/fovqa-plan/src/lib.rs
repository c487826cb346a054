//! What is to be done, as plain data: the scenes, methods and metrics of a comparison ([`Plan`]), an experiment
//! around it ([`Experiment`]: tables, figures and the rules of a gate), and curves ([`CurvePlan`]).
//!
//! Nothing here knows of TOML or reads a file. `fovqa-config` makes a plan of an experiment file, the command
//! line makes one of its arguments, and a program may build one by hand.

mod curves;
mod experiment;
mod gates;
mod output;
mod plan;
mod plots;
mod resolved;
mod settings;
mod source;

pub use curves::{
    CurvePlan, CurvePlot, CurvePlotKind, CurveTable, CurveTableKind, CurvesFile, PanelOf, RateKind,
    RateUnit,
};
pub use experiment::Experiment;
pub use gates::{Aggregate, Allowance, GateRule, Quantity, better};
pub use output::{OutputSettings, TableFormat};
pub use plan::{Eye, EyeView, MetricChoice, Plan, Scene};
pub use plots::{Plot, PlotKind};
pub use resolved::{Resolved, ResolvedEye, ResolvedScene, other_parameter};
pub use settings::{Gaze, Nonfinite, Settings};
pub use source::SourceSpec;
