//! The command `fovqa`, which the package installs.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the command with arguments, of which the first is the name of the program. Returns the exit code.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| fovqa_cli::run_command(arguments))
}
