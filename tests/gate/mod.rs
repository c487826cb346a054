//! `fovqa gate`, `fovqa baseline`: rules, verdicts, reports.

pub(crate) mod baseline_command;
mod baselines;
mod calibration;
pub(crate) mod experiments;
mod outcomes;
mod per_frame;
mod places;
mod reports;
mod rules;
mod spread;
mod values;
