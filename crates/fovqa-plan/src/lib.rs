//! Plans as plain data: the scenes, methods and metrics of a comparison ([`Plan`]), an experiment
//! that contains a plan ([`Experiment`], with tables, figures and the rules of a gate), and curves
//! ([`CurvePlan`]).
//!
//! This crate does not depend on TOML and reads no files. `fovqa-config` makes a plan from an
//! experiment file, the command line makes one from its arguments, and a program can build one
//! itself.

mod builtin;
mod crops;
mod curve_data;
mod curves;
mod emulation;
mod experiment;
mod eye;
mod figure_form;
mod figures;
mod gates;
mod output;
mod plan;
mod plots;
mod report;
mod reprojection;
mod resolved;
mod settings;
mod source;
mod spacing;
mod spread_test;
mod study;
mod sweep;

pub use builtin::BuiltinFrames;
pub use crops::CropRegion;
pub use curve_data::{GivenSeries, GivenValues, ResponsePlot};
pub use curves::{
    AcuityScale, CurvePlan, CurvePlot, CurvePlotKind, CurveTable, CurveTableKind, CurvesFile,
    DensityStyle, PanelOf, RateKind, RateUnit, TableAcross,
};
pub use emulation::{Emulation, emulation_keys};
pub use experiment::Experiment;
pub use eye::Eye;
pub use figure_form::{FigureForm, without_effect_on_all};
pub use figures::{
    AxisScale, AxisSettings, Colour, FigureFormat, FigureSettings, PaletteChoice, PaletteName,
};
pub use gates::{Aggregate, Allowance, GateRule, Quantity, better};
pub use output::{OutputSettings, TableFormat};
pub use plan::{EyeView, MetricChoice, Plan, Scene};
pub use plots::{AveragePlace, ErrorBars, Plot, PlotKind, SpreadOver, SpreadShape, TableLayout};
pub use report::{FrameChoice, FrameWord, ReportSettings, WantedPictures};
pub use reprojection::{Reproject, Reprojection};
pub use resolved::{Resolved, ResolvedEye, ResolvedScene, other_parameter};
pub use settings::{Gaze, Nonfinite, Settings};
pub use source::SourceSpec;
pub use spacing::spaced;
pub use spread_test::SpreadTest;
pub use study::{OpinionScores, PrintedNumber, StudyAnalysis, StudyFile};
pub use sweep::{Sweep, SweptKey, shown as shown_value, swept_label};
