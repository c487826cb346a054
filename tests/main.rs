//! End-to-end runs of the real command, in one binary.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod curve_files;
mod curves;
mod curves_golden;
mod decoding;
mod experiment_files;
mod experiment_folder;
mod experiments;
mod figures;
mod fovqa;
mod golden;
mod motion_and_depth;
mod moving_frames;
mod output;
mod profiles;
mod published_numbers;
mod recorded;
mod results_folder;
mod resume;
mod sequences;
mod shards;
mod signal;
mod temporal;
mod visible_difference;
mod visible_difference_errors;
