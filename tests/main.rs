//! End-to-end runs of the real command, in one binary.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod browser;
mod command;
mod curves;
mod emulate;
mod formats;
mod foveate;
mod fovqa;
mod frames;
mod gallery;
mod gate;
mod metrics;
mod published;
mod runs;
mod study;
mod sweeps;
