//! End-to-end runs of the real command, in one binary.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod bad_input;
mod decoding;
mod fovqa;
mod golden;
mod output;
mod sequences;
mod signal;
