//! The experiment file: TOML to a checked [`Plan`].

mod plan;

pub use plan::{Eye, EyeView, Gaze, MetricChoice, Nonfinite, Plan, Scene, Settings};
