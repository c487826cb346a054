//! End-to-end runs of the real command, in one binary.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod baselines;
mod calibration;
mod curve_files;
mod curves;
mod curves_golden;
mod decoding;
mod exit_codes;
mod experiment_files;
mod experiment_folder;
mod experiments;
mod exr_layers;
mod figures;
mod foreseen;
mod fovqa;
mod frame_numbers;
mod gate;
mod gate_baselines;
mod gate_outcomes;
mod gate_reports;
mod gate_rules;
mod gate_verdicts;
mod gaze_files;
mod golden;
mod jpeg;
mod motion_and_depth;
mod moving_frames;
mod output;
mod png;
mod profiles;
mod published_numbers;
mod questionable_views;
mod recorded;
mod results_folder;
mod resume;
mod sequences;
mod shards;
mod signal;
mod special_files;
mod stereo_layers;
mod temporal;
mod visible_difference;
mod visible_difference_errors;
mod wide_fields;
